#include "server/work/open_streams.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>
#include <thread>

namespace trc::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class ListedStream final : public OpenStream {
 public:
  void end_if_idle(Clock::time_point since) override { asked_until = since; }
  void beat_if_silent(Clock::time_point since) override { silent_since = since; }
  void evict() override { evicted = true; }
  void cut_off() override { ++cut_offs; }
  [[nodiscard]] std::uint64_t held_bytes() const override { return holds; }
  std::atomic<bool> evicted = false;
  std::atomic<int> cut_offs = 0;
  std::uint64_t holds = 0;
  std::atomic<Clock::time_point> silent_since{Clock::time_point::min()};
  std::atomic<Clock::time_point> asked_until{Clock::time_point::min()};
};

TEST(OpenStreams, AdmitsUpToTheLimitAndAgainWhenOneHasLeft) {
  OpenStreams streams(2, seconds(300));
  const auto stream = std::make_shared<ListedStream>();
  auto first = streams.admit(stream);
  auto second = streams.admit(stream);
  EXPECT_EQ(first.answer, OpenStreams::Answer::admitted);
  EXPECT_EQ(second.answer, OpenStreams::Answer::admitted);
  EXPECT_EQ(streams.admit(stream).answer, OpenStreams::Answer::full);
  EXPECT_EQ(streams.count(), 2U);
  first.ticket = {};
  EXPECT_EQ(streams.count(), 1U);
  EXPECT_EQ(streams.admit(stream).answer, OpenStreams::Answer::admitted);
}

TEST(OpenStreams, AdmitsNoneWhileDraining) {
  OpenStreams streams(2, seconds(300));
  const auto stream = std::make_shared<ListedStream>();
  auto open = streams.admit(stream);
  streams.drain();
  EXPECT_TRUE(streams.draining());
  EXPECT_EQ(streams.admit(stream).answer, OpenStreams::Answer::draining);
}

TEST(OpenStreams, WaitsForTheLastStreamButNotLongerThanTold) {
  OpenStreams streams(2, seconds(300));
  EXPECT_TRUE(streams.wait_until_none(Clock::now()));
  auto open = streams.admit(std::make_shared<ListedStream>());
  EXPECT_FALSE(streams.wait_until_none(Clock::now() + milliseconds(20)));
  std::thread leaver([&] {
    std::this_thread::sleep_for(milliseconds(20));
    open.ticket = {};
  });
  EXPECT_TRUE(streams.wait_until_none(Clock::now() + seconds(30)));
  leaver.join();
}

TEST(OpenStreams, AreCutOffUntilTheyHaveEndedButNotLongerThanTold) {
  OpenStreams streams(2, seconds(300));
  const auto stream = std::make_shared<ListedStream>();
  auto open = streams.admit(stream);
  streams.cut_off(Clock::now() + milliseconds(50));
  EXPECT_EQ(streams.count(), 1U);
  EXPECT_GT(stream->cut_offs.load(), 1);
  std::thread leaver([&] {
    std::this_thread::sleep_for(milliseconds(20));
    open.ticket = {};
  });
  streams.cut_off(Clock::now() + seconds(30));
  EXPECT_EQ(streams.count(), 0U);
  leaver.join();
}

TEST(OpenStreams, AsksStreamsWhetherTheyAreIdle) {
  OpenStreams streams(2, seconds(1));
  const auto stream = std::make_shared<ListedStream>();
  const auto admitted = streams.admit(stream);
  const auto give_up = Clock::now() + seconds(30);
  while (stream->asked_until.load() == Clock::time_point::min() && Clock::now() < give_up)
    std::this_thread::sleep_for(milliseconds(5));
  ASSERT_NE(stream->asked_until.load(), Clock::time_point::min());
  EXPECT_LE(stream->asked_until.load(), Clock::now() - seconds(1));
}

class StreamWithoutMemory final : public OpenStream {
 public:
  void end_if_idle(Clock::time_point /*since*/) override {
    if (++asked < 3) throw std::bad_alloc();
  }
  void beat_if_silent(Clock::time_point /*since*/) override {}
  void evict() override {}
  void cut_off() override {}
  [[nodiscard]] std::uint64_t held_bytes() const override { return 0; }
  std::atomic<int> asked = 0;
};

TEST(OpenStreams, AreAskedAgainWhereARoundFindsNoMemory) {
  OpenStreams streams(2, seconds(1));
  const auto stream = std::make_shared<StreamWithoutMemory>();
  const auto admitted = streams.admit(stream);
  const auto give_up = Clock::now() + seconds(30);
  while (stream->asked < 3 && Clock::now() < give_up) std::this_thread::sleep_for(milliseconds(5));
  EXPECT_GE(stream->asked.load(), 3);
}

TEST(OpenStreams, EvictsTheLargest) {
  OpenStreams streams(3, seconds(300));
  const auto small = std::make_shared<ListedStream>();
  const auto large = std::make_shared<ListedStream>();
  small->holds = 10;
  large->holds = 20;
  [[maybe_unused]] const auto tickets = {streams.admit(small), streams.admit(large)};
  EXPECT_TRUE(streams.evict_largest());
  EXPECT_TRUE(large->evicted);
  EXPECT_FALSE(small->evicted);
  EXPECT_TRUE(streams.is_evicting());
  large->holds = 0;
  EXPECT_FALSE(streams.is_evicting());
  small->holds = 0;
  EXPECT_FALSE(streams.evict_largest());
}

}  // namespace
}  // namespace trc::server
