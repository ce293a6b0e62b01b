// The built server under frames of HTTP/2 that cost a client next to nothing: a connection with too
// many of them is shut down or read no more, and others are served meanwhile.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/faults/questions.h"
#include "tests/faults/raw_connection.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {
namespace {

using server::eventually;
using std::chrono::seconds;
using testing_support::memory_tells;
using testing_support::ServerProcess;

constexpr const char* compensate_path = "/trc.v1.TrcService/CompensatePath";

// Many times: what a stream does, with the number of the stream.
template <class Frames>
std::string flood(int count, std::uint32_t& stream, const Frames& frames) {
  std::string bytes;
  for (int i = 0; i < count; ++i, stream += 2) bytes += frames(stream);
  return bytes;
}

// Sends until the server closes the connection, at most so long. How long somebody else had to wait
// meanwhile is measured.
struct FloodResult {
  bool closed = false;
  double longest_wait_s = 0;
  double resident_mib = 0;  // at most
};
template <class Frames>
FloodResult flood_until_closed(const ServerProcess& server, const std::string& head,
                               const Frames& frames, seconds longest = seconds(20)) {
  FloodResult result;
  std::atomic<bool> done = false;
  std::thread other([&] {
    const auto channel = channel_to(server.address());
    while (!done) {
      const auto begin = std::chrono::steady_clock::now();
      const auto answer = server::run_program(channel, {}, server::g239_program);
      EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
      result.longest_wait_s = std::max(result.longest_wait_s, took.count());
      result.resident_mib = std::max(result.resident_mib, server.resident_mib());
    }
  });
  const RawConnection connection(server.address(), "127.0.0.2");
  std::uint32_t stream = 1;
  const auto end = std::chrono::steady_clock::now() + longest;
  bool sends = connection.send_bytes(http2::greeting() + head);
  while (sends && std::chrono::steady_clock::now() < end)
    sends = connection.is_open() && connection.send_bytes(flood(200, stream, frames));
  result.closed = !sends;
  done = true;
  other.join();
  return result;
}

constexpr double longest_stall_s = 4 * testing_support::times_slower;
constexpr double flood_memory_mib = 384;
constexpr double unread_streams_mib = 256;
constexpr double given_back_mib = 128;

// Connections that were shut down for what they had sent.
double closed_for_floods(const ServerProcess& server) {
  double sum = 0;
  for (const char* reason : {"early_cancels", "calls", "overhead"})
    sum += metric(server.admin(),
                  std::string("trc_connections_closed_total{reason=\"") + reason + "\"}");
  return sum;
}

// CVE-2023-44487.
TEST(Floods, StreamsThatAreResetAtOnceEndTheirConnection) {
  const ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  for (const std::string path :
       {"/trc.v1.TrcService/CompensatePath", "/trc.v1.TrcService/GetServerInfo", "/none"}) {
    SCOPED_TRACE(path);
    const FloodResult result = flood_until_closed(server, "", [&](std::uint32_t stream) {
      return http2::headers(stream, path) + http2::reset(stream);
    });
    EXPECT_TRUE(result.closed);
    EXPECT_LT(result.longest_wait_s, longest_stall_s);
    EXPECT_TRUE(!memory_tells || result.resident_mib < flood_memory_mib) << result.resident_mib;
  }
  EXPECT_EQ(closed_for_floods(server), 3);
  // Once what was begun has been cleared away, its memory is given back.
  EXPECT_TRUE(!memory_tells ||
              eventually([&] { return server.resident_mib() < given_back_mib; }, 60))
      << server.resident_mib();
  EXPECT_NE(server.log().find("\"connection_closed\",\"peer\":\"ipv4:127.0.0.2:"),
            std::string::npos);
}

// Each of many connections stays within what one may do until it is looked at.
TEST(Floods, OfManyConnectionsLeaveNoMemoryBehind) {
  const ServerProcess server({"--admin-listen", "127.0.0.1:0", "--memory-limit-mib", "1024"});
  std::uint32_t stream = 1;
  const std::string bytes = http2::greeting() + flood(20'000, stream, [](std::uint32_t number) {
                              return http2::headers(number, compensate_path) + http2::reset(number);
                            });
  std::vector<std::thread> clients;
  for (int i = 0; i < 24; ++i)
    clients.emplace_back([&] {
      const RawConnection connection(server.address(), "127.0.0.2");
      for (std::size_t at = 0; at < bytes.size(); at += 65536)
        if (!connection.send_bytes(std::string_view(bytes).substr(at, 65536))) return;
    });
  for (std::thread& client : clients) client.join();
  EXPECT_TRUE(eventually([&] { return serves(server.address()); }, 60));
  EXPECT_TRUE(!memory_tells ||
              eventually([&] { return server.resident_mib() < given_back_mib; }, 90))
      << server.resident_mib();
  EXPECT_GT(closed_for_floods(server), 0);
}

// Nobody is told how many streams a connection may have until it says that it has heard: gRPC then
// lets it begin any number. Those of health it serves by itself.
TEST(Floods, StreamsThatNobodyFollowsAreBounded) {
  const std::string no_window("\0\4\0\0\0\0", 6);
  for (const std::string path :
       {"/grpc.health.v1.Health/Watch", "/trc.v1.TrcService/GetServerInfo"}) {
    SCOPED_TRACE(path);
    const ServerProcess server({"--admin-listen", "127.0.0.1:0", "--memory-limit-mib", "512"});
    std::uint32_t stream = 1;
    const std::string bytes =
        http2::greeting(no_window) + flood(20'000, stream, [&](std::uint32_t number) {
          return http2::headers(number, path) + http2::message(number, "");
        });
    std::vector<std::unique_ptr<RawConnection>> held(20);
    std::vector<std::thread> clients;
    for (auto& connection : held)
      clients.emplace_back([&] {
        connection = std::make_unique<RawConnection>(server.address(), "127.0.0.2");
        for (std::size_t at = 0; at < bytes.size(); at += 65536)
          if (!connection->send_bytes(std::string_view(bytes).substr(at, 65536))) return;
      });
    double most_mib = 0;
    const auto end = std::chrono::steady_clock::now() + seconds(5);
    while (std::chrono::steady_clock::now() < end) {
      most_mib = std::max(most_mib, server.resident_mib());
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    for (std::thread& client : clients) client.join();
    EXPECT_TRUE(!memory_tells || most_mib < unread_streams_mib) << most_mib;
    EXPECT_TRUE(eventually([&] { return serves(server.address()); }, 60));
    EXPECT_EQ(closed_for_floods(server), 20);
  }
}

// DATA frames without a byte on one stream: no flow control holds them back.
TEST(Floods, FramesThatCarryNothingHoldNobodyUp) {
  const ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  const FloodResult result =
      flood_until_closed(server, http2::headers(1, "/trc.v1.TrcService/CompensatePath"),
                         [](std::uint32_t) { return http2::empty_data(1); });
  EXPECT_TRUE(result.closed) << "or not read any more";
  EXPECT_LT(result.longest_wait_s, longest_stall_s);
  EXPECT_TRUE(!memory_tells || result.resident_mib < flood_memory_mib) << result.resident_mib;
}

// A header that never ends: gRPC keeps some fifty bytes for each of its fields, and a field of its
// table is one byte. No rate of bytes tells it from a message that comes slowly, but gRPC has
// nothing to say meanwhile.
TEST(Floods, ASlowHeaderWithoutAnEndEndsItsConnection) {
  const ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  const RawConnection connection(server.address());
  const std::string fields(8000, '\x90');  // accept-encoding: gzip, deflate
  const std::string fields_frame = http2::frame(http2::continuation, 0, 1, fields);
  ASSERT_TRUE(connection.send_bytes(
      http2::greeting() +
      http2::frame(http2::headers_frame, 0, 1, http2::header_block(compensate_path))));
  constexpr double bytes_per_s = 1 << 20;  // half of what max-overhead-kib-per-s lets pass
  const auto begin = std::chrono::steady_clock::now();
  std::size_t sent = 0;
  double resident_mib = 0;
  bool sends = true;
  while (sends && sent < std::size_t{12} << 20U) {
    sends = connection.is_open() && connection.send_bytes(fields_frame);
    sent += fields_frame.size();
    resident_mib = std::max(resident_mib, server.resident_mib());
    std::this_thread::sleep_until(
        begin + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                    std::chrono::duration<double>(static_cast<double>(sent) / bytes_per_s)));
  }
  EXPECT_FALSE(sends);
  EXPECT_TRUE(!memory_tells || resident_mib < 256) << resident_mib;
  EXPECT_EQ(closed_for_floods(server), 1);
  EXPECT_TRUE(!memory_tells ||
              eventually([&] { return server.resident_mib() < given_back_mib; }, 60))
      << server.resident_mib();
}

struct Kind {
  const char* name;
  std::string head;
  std::function<std::string(std::uint32_t stream)> frames;
};

class Flood : public testing::TestWithParam<Kind> {};

// It may go on where it is slow enough, as on a machine that has other things to do.
TEST_P(Flood, HoldsNobodyUp) {
  const ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  const FloodResult result =
      flood_until_closed(server, GetParam().head, GetParam().frames, seconds(5));
  EXPECT_LT(result.longest_wait_s, longest_stall_s);
  EXPECT_TRUE(!memory_tells || result.resident_mib < flood_memory_mib) << result.resident_mib;
  EXPECT_TRUE(!memory_tells ||
              eventually([&] { return server.resident_mib() < given_back_mib; }, 60))
      << server.resident_mib();
  EXPECT_TRUE(serves(server.address()));
}

using http2::frame;

// A call whose headers do not end with it.
std::string open_headers(std::uint32_t stream) {
  return frame(http2::headers_frame, 0, stream, http2::header_block(compensate_path));
}

// A setting that no server acts on.
std::string setting(std::uint16_t name) { return http2::number(name, 2) + http2::number(0, 4); }

std::string many_settings() {
  std::string payload;
  for (int i = 0; i < 2700; ++i) payload += setting(0x4000);
  return payload;
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, Flood,
    testing::Values(
        Kind{"Settings", "", [](auto) { return frame(http2::settings, 0, 0, ""); }},
        Kind{"ManySettings", "",
             [payload = many_settings()](auto) { return frame(http2::settings, 0, 0, payload); }},
        Kind{"Pings", "", [](auto) { return frame(http2::ping, 0, 0, "12345678"); }},
        Kind{"WindowOfTheConnection", "",
             [](auto) { return frame(http2::window_update, 0, 0, http2::number(1, 4)); }},
        Kind{"WindowOfAStream", http2::headers(1, compensate_path),
             [](auto) { return frame(http2::window_update, 0, 1, http2::number(1, 4)); }},
        Kind{"Priorities", "",
             [](auto stream) {
               return frame(http2::priority, 0, stream, http2::number(0, 4) + '\1');
             }},
        Kind{"FramesOfNoKind", "", [](auto) { return frame(0x20, 0, 0, ""); }},
        Kind{"ResetsOfNothing", "", [](auto stream) { return http2::reset(stream); }},
        Kind{"StreamsThatStayOpen", "",
             [](auto stream) { return http2::headers(stream, compensate_path); }},
        Kind{"ContinuationsWithoutAByte", open_headers(1),
             [](auto) { return frame(http2::continuation, 0, 1, ""); }},
        Kind{"ContinuationsWithoutAnEnd", open_headers(1),
             [](auto) {
               return frame(http2::continuation, 0, 1, http2::header_block(compensate_path));
             }},
        Kind{"ContinuationsAndResets", "",
             [](auto stream) {
               std::string bytes = open_headers(stream);
               for (int i = 0; i < 20; ++i) bytes += frame(http2::continuation, 0, stream, "");
               return bytes + frame(http2::continuation, http2::end_headers, stream, "") +
                      http2::reset(stream);
             }}),
    [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace trc::faults
