#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

#include "server/rpc/compensate_path.h"
#include "server/rpc/compensate_program.h"
#include "tests/server/calls.h"

// Which turns are taken in gRPC's own threads: none that can become long.

namespace trc::server {
namespace {

template <class Work, class Request, class Response>
struct Stream {
  bool is_short(const Request& request) { return work.is_short(&request); }
  // Takes the request and all turns that follow.
  void take(const Request& request) {
    Turn turn = work.take(request, response);
    while (turn.next == Turn::Next::proceed) turn = work.proceed(response);
    ASSERT_TRUE(turn.next == Turn::Next::read);
  }

  Backend backend{[] {
                    Config config;
                    config.log_level = "off";
                    return config;
                  }(),
                  std::string(32, 'k')};
  CallRecord record{backend.telemetry, Method::compensate_path, "peer", {}};
  std::atomic<bool> cancelled = false;
  std::shared_ptr<Peer> peer = backend.peers.of("peer");
  StreamAccount account{backend, *peer};
  Work work{StreamContext{backend, record, cancelled, account}};
  Response response;
};
using PathStream = Stream<CompensatePath, v1::CompensatePathRequest, v1::CompensatePathResponse>;
using ProgramStream =
    Stream<CompensateProgram, v1::CompensateProgramRequest, v1::CompensateProgramResponse>;

// A zigzag; with a selection at its start.
v1::CompensatePathRequest zigzag(std::uint64_t first_block, std::uint64_t count) {
  std::vector<v1::Block> blocks;
  for (std::uint64_t i = first_block; i < first_block + count; ++i)
    blocks.push_back(i == 1 ? command(v1::COMPENSATION_SIDE_LEFT)
                            : line_to(20.0 * static_cast<double>(i), i % 2 == 0 ? 0 : 5));
  return batch(first_block, blocks, false);
}

v1::PathSetup setup() {
  v1::PathSetup setup;
  setup.set_tool_radius(1);
  return setup;
}

TEST(ShortTurns, ASetupAndAFewBlocks) {
  PathStream stream;
  EXPECT_TRUE(stream.is_short(setup_request(setup())));
  stream.take(setup_request(setup()));
  for (std::uint64_t block = 0; block < 1000; block += 100) {
    ASSERT_TRUE(stream.is_short(zigzag(block, 100))) << block;
    stream.take(zigzag(block, 100));
    EXPECT_TRUE(stream.work.is_short(nullptr));
  }
  EXPECT_FALSE(stream.is_short(zigzag(1000, 1000)));
}

TEST(ShortTurns, NotWithASelectionThatIsHeld) {
  PathStream stream;
  v1::PathSetup masked = setup();
  masked.set_contour_masking(v1::CONTOUR_MASKING_ON);
  stream.take(setup_request(masked));
  for (std::uint64_t block = 0; block < 300; block += 100) stream.take(zigzag(block, 100));
  EXPECT_FALSE(stream.is_short(zigzag(300, 1)));
  EXPECT_FALSE(stream.work.is_short(nullptr));
}

TEST(ShortTurns, NotWithTokensOrAVerification) {
  v1::PathSetup resumed = setup();
  resumed.set_resume_token("token");
  EXPECT_FALSE(PathStream().is_short(setup_request(resumed)));

  v1::PathSetup tokens = setup();
  tokens.set_want_resume_tokens(true);
  v1::PathSetup verified = setup();
  verified.set_verify(v1::VERIFICATION_ENFORCE);
  for (const v1::PathSetup& longer : {tokens, verified}) {
    PathStream stream;
    stream.take(setup_request(longer));
    EXPECT_FALSE(stream.is_short(zigzag(0, 1)));
  }
}

TEST(ShortTurns, AFewLines) {
  ProgramStream stream;
  EXPECT_TRUE(stream.is_short(setup_request(v1::ProgramSetup())));
  stream.take(setup_request(v1::ProgramSetup()));
  EXPECT_TRUE(stream.is_short(text_request(0, "N10 G01 X1 Y1 F100\n", false)));
  EXPECT_FALSE(stream.is_short(text_request(0, std::string(10'000, '\n'), false)));
}

}  // namespace
}  // namespace trc::server
