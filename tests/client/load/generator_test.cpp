#include "client/load/generator.h"

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include "tests/client/load/meddling_server.h"

namespace trc::load {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

struct Run {
  Plan plan{};
  Layout layout = Layout::columns;
  std::uint64_t blocks = 300;
};

Outcome run_against(const MeddlingServer& server, const Run& run) {
  const Job job({.shape = "random", .blocks = run.blocks}, run.layout, 64, {});
  std::string refused;
  const ExpectedResult expected = expected_of(job, refused);
  EXPECT_EQ(refused, "");
  const auto channel = grpc::CreateChannel(server.address(), grpc::InsecureChannelCredentials());
  Generator generator(run.plan, job, &expected, 0, {channel});
  const std::atomic<bool> stop{false};
  return generator.run(stop);
}

Plan plan_of_jobs(std::uint64_t jobs) {
  return {.jobs = jobs, .duration = seconds(30), .verify = 1, .first_window = 4};
}

TEST(Load, FindsEveryStreamRightAtAnHonestServer) {
  const MeddlingServer server({});
  for (const Layout layout : {Layout::columns, Layout::blocks, Layout::text}) {
    const Outcome outcome = run_against(server, {.plan = plan_of_jobs(5), .layout = layout});
    EXPECT_EQ(outcome.tally.completed, 5U);
    EXPECT_EQ(outcome.tally.verified, 5U);
    EXPECT_EQ(outcome.tally.differing, 0U) << outcome.tally.first_difference;
    EXPECT_TRUE(outcome.tally.errors.empty()) << outcome.tally.first_error;
    EXPECT_EQ(outcome.tally.blocks_in, 5 * (layout == Layout::text ? 305U : 304U));
  }
}

TEST(Load, CatchesOneBitOfOneCoordinate) {
  const MeddlingServer server({.flip_bit = true});
  const Outcome outcome = run_against(server, {.plan = plan_of_jobs(4)});
  EXPECT_EQ(outcome.tally.verified, 4U);
  EXPECT_EQ(outcome.tally.differing, 1U);
  EXPECT_EQ(outcome.tally.first_difference,
            "stream 0: what follows 0 blocks is not what the core gives");
}

TEST(Load, CatchesOneBitOfText) {
  const MeddlingServer server({.flip_text_bit = true});
  const Outcome outcome = run_against(server, {.plan = plan_of_jobs(3), .layout = Layout::text});
  EXPECT_EQ(outcome.tally.differing, 1U);
}

TEST(Load, TakesNoPathWithoutItsSummaryForAWholeOne) {
  const MeddlingServer server({.lose_summary = true});
  const Outcome outcome = run_against(server, {.plan = plan_of_jobs(2)});
  EXPECT_EQ(outcome.tally.completed, 0U);
  ASSERT_EQ(outcome.tally.errors.size(), 1U);
  EXPECT_EQ(outcome.tally.errors.begin()->second, 2U);
}

// 100 streams a second against a server that is deaf for the first 400 ms: forty of them were meant
// to begin meanwhile, and all of those have waited for it, on the average for half of it.
TEST(Load, OpenLoopCountsAStallForAllWhoMeantToComeDuringIt) {
  const MeddlingServer server({.stall = milliseconds(400)});
  const Outcome outcome = run_against(
      server, {.plan = {.streams = 2, .rate = 100, .duration = seconds(1), .grace = seconds(20)},
               .blocks = 10});
  const Histogram& stream = outcome.tally.stream;
  EXPECT_NEAR(static_cast<double>(stream.count()), 100, 1);
  EXPECT_LE(outcome.most_open, 2U);
  // A third of all began in the first 330 ms and so took 70 ms at least.
  EXPECT_GT(stream.at(0.70), milliseconds(60));
  // The first one waited for all of it but what the run took to begin.
  EXPECT_GT(stream.max(), milliseconds(300));
  EXPECT_TRUE(outcome.tally.errors.empty()) << outcome.tally.first_error;
}

// A closed loop begins no stream while the server is deaf: only those under way know of a stall.
TEST(Load, ClosedLoopShowsAStallToThoseUnderWayAlone) {
  const MeddlingServer server({.stall = milliseconds(400)});
  Plan plan = plan_of_jobs(100);
  plan.streams = 2;
  const Outcome outcome = run_against(server, {.plan = plan, .blocks = 10});
  EXPECT_EQ(outcome.tally.stream.count(), 100U);
  // Either side of half of it: a stream may have begun after the stall on a slow machine.
  EXPECT_GT(outcome.tally.stream.max(), milliseconds(200));
  EXPECT_LT(outcome.tally.stream.at(0.9), milliseconds(200));
}

// Nothing is left out because it did not end in time.
TEST(Load, CountsStreamsThatNeverEnded) {
  const MeddlingServer server({.stall = milliseconds(1500)});
  const Outcome outcome = run_against(
      server, {.plan = {.streams = 3, .rate = 50, .duration = milliseconds(400)}, .blocks = 10});
  EXPECT_EQ(outcome.tally.completed, 0U);
  EXPECT_NEAR(static_cast<double>(outcome.tally.unfinished), 20, 1);
  EXPECT_EQ(outcome.tally.stream.count(), outcome.tally.unfinished);
}

TEST(Load, BeginsWithTheRampAndMeasuresAfterIt) {
  const MeddlingServer server({});
  const Outcome outcome = run_against(server, {.plan = {.streams = 20,
                                                        .rate = 100,
                                                        .ramp = seconds(1),
                                                        .duration = milliseconds(500),
                                                        .grace = seconds(10)},
                                               .blocks = 10});
  // Fifty in the ramp, and fifty after it.
  EXPECT_NEAR(static_cast<double>(outcome.tally.stream.count()), 50, 2);
  EXPECT_NEAR(outcome.seconds, 0.5, 0.2);
}

}  // namespace
}  // namespace trc::load
