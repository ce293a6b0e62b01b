#include "server/resources/limits.h"

#include <gtest/gtest.h>

#include <string>

namespace trc::server {
namespace {

constexpr std::uint64_t gib = std::uint64_t{1} << 30U;

TEST(Limits, AreFilledInFromTheMemoryThereIs) {
  Config large;
  EXPECT_EQ(fill_in_limits(large, 64 * gib), std::nullopt);
  EXPECT_EQ(large.memory_limit_mib, 65536U);
  EXPECT_EQ(large.max_session_memory_mib, 1024U);
  EXPECT_EQ(large.max_streams, 1000U);
  // An incoming and an outgoing message of each.
  EXPECT_EQ(large.max_grpc_buffer_mib, 1188U);
  EXPECT_EQ(large.max_streams_per_peer, 750U);
  EXPECT_EQ(large.max_memory_per_peer_mib, 768U);

  Config small;
  EXPECT_EQ(fill_in_limits(small, gib), std::nullopt);
  EXPECT_EQ(small.max_session_memory_mib, 512U);
  EXPECT_EQ(small.max_grpc_buffer_mib, 256U);
  EXPECT_EQ(small.max_streams, 215U);
}

// What HTTP may hold is not given to streams as well.
TEST(Limits, OfHttpArePartOfTheSum) {
  Config small;
  small.http_listen = "127.0.0.1:0";
  EXPECT_EQ(fill_in_limits(small, gib), std::nullopt);
  EXPECT_EQ(small.http_max_memory_mib, 256U);
  EXPECT_EQ(small.max_session_memory_mib, 384U);
  EXPECT_EQ(small.max_grpc_buffer_mib, 192U);

  Config tiny;
  tiny.http_listen = "127.0.0.1:0";
  EXPECT_EQ(fill_in_limits(tiny, gib / 16), std::nullopt);

  Config wide;
  wide.http_listen = "127.0.0.1:0";
  wide.http_max_memory_mib = 600;
  wide.max_session_memory_mib = 400;
  const auto fault = fill_in_limits(wide, gib);
  ASSERT_TRUE(fault.has_value());
  EXPECT_NE(fault->find("http-max-memory-mib"), std::string::npos) << *fault;
}

// Nobody else comes where only this machine gets in.
TEST(Limits, OneAddressLeavesAQuarterOfHttpToOthers) {
  Config open;
  open.http_listen = "0.0.0.0:0";
  EXPECT_EQ(fill_in_limits(open, 64 * gib), std::nullopt);
  EXPECT_EQ(open.http_max_connections_per_peer, 192U);
  EXPECT_EQ(open.http_max_memory_per_peer_mib, 384U);
  Config local;
  local.http_listen = "127.0.0.1:0";
  EXPECT_EQ(fill_in_limits(local, 64 * gib), std::nullopt);
  EXPECT_EQ(local.http_max_connections_per_peer, 256U);
  EXPECT_EQ(local.http_max_memory_per_peer_mib, 512U);
  Config said;
  said.http_listen = "0.0.0.0:0";
  said.http_max_connections_per_peer = 256;
  EXPECT_EQ(fill_in_limits(said, 64 * gib), std::nullopt);
  EXPECT_EQ(said.http_max_connections_per_peer, 256U);
}

TEST(Limits, AreTheSameWhenFilledInTwice) {
  Config config;
  EXPECT_EQ(fill_in_limits(config, gib), std::nullopt);
  const Config once = config;
  EXPECT_EQ(fill_in_limits(config, 2 * gib), std::nullopt);
  EXPECT_EQ(config, once);
}

TEST(Limits, AreNeverZero) {
  Config tiny;
  EXPECT_EQ(fill_in_limits(tiny, gib / 16), std::nullopt);
  EXPECT_GT(tiny.max_streams, 0U);
  EXPECT_GT(tiny.max_session_memory_mib, 0U);
  Config one;
  one.max_streams = 1;
  EXPECT_EQ(fill_in_limits(one, gib), std::nullopt);
  EXPECT_EQ(one.max_streams_per_peer, 1U);
}

// Of settings that nobody has written nothing is said.
TEST(Limits, TooLittleMemoryIsNamedByItsOwnSetting) {
  for (const std::uint32_t mib : {1U, 15U}) {
    Config config;
    config.memory_limit_mib = mib;
    const auto fault = fill_in_limits(config, gib);
    ASSERT_TRUE(fault.has_value());
    EXPECT_EQ(*fault, "memory-limit-mib: the server needs 16 or more, not " + std::to_string(mib));
  }
  Config least;
  least.memory_limit_mib = 16;
  EXPECT_EQ(fill_in_limits(least, gib), std::nullopt);
  Config with_http;
  with_http.memory_limit_mib = 16;
  with_http.http_listen = "127.0.0.1:0";
  EXPECT_EQ(fill_in_limits(with_http, gib), std::nullopt);
}

TEST(Limits, BuffersMustBeEnoughForTheStreams) {
  Config config;
  config.max_grpc_buffer_mib = 96;
  EXPECT_EQ(fill_in_limits(config, 64 * gib), std::nullopt);
  EXPECT_EQ(config.max_streams, 80U);
  config.max_streams = 1000;
  const auto fault = fill_in_limits(config, 64 * gib);
  ASSERT_TRUE(fault.has_value());
  for (const char* part : {"max-grpc-buffer-mib", "max-streams", "max-message-bytes", "1188", "96"})
    EXPECT_NE(fault->find(part), std::string::npos) << *fault;
  // Smaller messages need less.
  config.max_message_bytes = 48U << 10U;
  EXPECT_EQ(fill_in_limits(config, 64 * gib), std::nullopt);
}

TEST(Limits, ATokenFitsIntoTheMessageThatBringsItBack) {
  Config config;
  config.max_message_bytes = 4096;
  EXPECT_EQ(fill_in_limits(config, gib), std::nullopt);
  EXPECT_LT(config.max_resume_token_bytes, config.max_message_bytes);
}

TEST(Limits, ABodyFitsIntoTheMemoryOfBodies) {
  Config config;
  config.http_listen = "127.0.0.1:0";
  EXPECT_EQ(fill_in_limits(config, gib / 8), std::nullopt);
  EXPECT_EQ(config.http_max_body_mib, config.http_max_memory_mib);
  Config large;
  large.http_listen = "127.0.0.1:0";
  EXPECT_EQ(fill_in_limits(large, 8 * gib), std::nullopt);
  EXPECT_EQ(large.http_max_body_mib, 64U);
}

TEST(Limits, MustFitIntoTheMemory) {
  Config config;
  config.max_session_memory_mib = 900;
  const auto fault = fill_in_limits(config, gib);
  ASSERT_TRUE(fault.has_value());
  for (const char* part : {"memory-limit-mib", "max-session-memory-mib", "1024"})
    EXPECT_NE(fault->find(part), std::string::npos) << *fault;
}

}  // namespace
}  // namespace trc::server
