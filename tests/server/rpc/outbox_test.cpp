#include "server/rpc/outbox.h"

#include <gtest/gtest.h>

#include <string>

namespace trc::server {
namespace {

using wire::Layout;

CompensatedBlock block(std::uint64_t index) {
  CompensatedBlock made;
  made.source.index = index;
  return made;
}

TEST(Outbox, LeavesInSlicesThatFitAMessage) {
  Outbox outbox;
  for (std::uint64_t i = 0; i < 1000; ++i) outbox.content().blocks().push_back(block(i));
  std::uint64_t next = 0;
  int slices = 0;
  while (!outbox.empty()) {
    const Outbox::Slice slice = outbox.take(Layout::blocks, 9'000);
    EXPECT_EQ(slice.first_block, next);
    ASSERT_FALSE(slice.blocks.empty());
    EXPECT_LE(slice.blocks.size(), 9'000 / 90U);
    for (const CompensatedBlock& got : slice.blocks) EXPECT_EQ(got.source.index, next++);
    ++slices;
  }
  EXPECT_EQ(next, 1000U);
  EXPECT_GT(slices, 10);
}

// A masked selection has a note for every loop, all after one block.
TEST(Outbox, DiagnosticsLeaveInSlicesThatFitAMessage) {
  Outbox outbox;
  outbox.content().blocks().push_back(block(0));
  std::vector<Diagnostic> notes(1000);
  for (std::uint64_t i = 0; i < notes.size(); ++i) notes[i].source.index = i;
  outbox.content().tell(std::move(notes));
  std::uint64_t next = 0;
  int slices = 0;
  while (!outbox.empty()) {
    const Outbox::Slice slice = outbox.take(Layout::blocks, 20'000);
    EXPECT_EQ(slice.blocks.size(), slices == 0 ? 1U : 0U);
    ASSERT_FALSE(slice.diagnostics.empty());
    EXPECT_LE(slice.diagnostics.size(), 20'000 / 200U);
    for (const Diagnostic& got : slice.diagnostics) EXPECT_EQ(got.source.index, next++);
    ++slices;
  }
  EXPECT_EQ(next, 1000U);
  EXPECT_GT(slices, 9);
}

TEST(Outbox, OneDiagnosticAlwaysLeavesHoweverLarge) {
  Outbox outbox;
  Diagnostic large;
  large.detail.assign(60'000, 'x');
  outbox.content().tell({large, large});
  EXPECT_EQ(outbox.take(Layout::blocks, 1000).diagnostics.size(), 1U);
  EXPECT_EQ(outbox.take(Layout::blocks, 1000).diagnostics.size(), 1U);
  EXPECT_TRUE(outbox.empty());
}

TEST(Outbox, CountsBlocksOverAllRequests) {
  Outbox outbox;
  outbox.content().blocks().assign(3, block(0));
  EXPECT_EQ(outbox.take(Layout::blocks, 1'000'000).first_block, 0U);
  outbox.forget_taken();
  outbox.content().blocks().assign(2, block(0));
  const Outbox::Slice slice = outbox.take(Layout::blocks, 1'000'000);
  EXPECT_EQ(slice.first_block, 3U);
  EXPECT_EQ(slice.blocks.size(), 2U);
  EXPECT_TRUE(outbox.empty());
}

TEST(Outbox, OneBlockAlwaysLeavesHoweverLarge) {
  Outbox outbox;
  CompensatedBlock large = block(0);
  large.text.assign(60'000, 'M');
  outbox.content().blocks().assign(2, large);
  EXPECT_EQ(outbox.take(Layout::blocks, 1000).blocks.size(), 1U);
  EXPECT_EQ(outbox.take(Layout::blocks, 1000).blocks.size(), 1U);
  EXPECT_TRUE(outbox.empty());
}

TEST(Outbox, TextLeavesInWholeLines) {
  Outbox outbox;
  std::string text;
  for (int i = 0; i < 100; ++i) text += "N" + std::to_string(i * 10) + " X1 Y2\n";
  outbox.content().text() = text;
  std::string joined;
  while (!outbox.empty()) {
    const Outbox::Slice slice = outbox.take(Layout::blocks, 64);
    ASSERT_FALSE(slice.text.empty());
    EXPECT_EQ(slice.text.back(), '\n');
    EXPECT_LT(slice.text.size(), 64U + 16U);
    joined += slice.text;
  }
  EXPECT_EQ(joined, text);
}

TEST(Outbox, DiagnosticsComeAfterWhatWasCertainBefore) {
  Outbox outbox;
  outbox.content().blocks().assign(2, block(0));
  outbox.content().tell({diagnostic(Code::stretch_factor_out_of_range, {})});
  outbox.content().blocks().push_back(block(1));

  const Outbox::Slice first = outbox.take(Layout::blocks, 1'000'000);
  EXPECT_EQ(first.blocks.size(), 2U);
  ASSERT_EQ(first.diagnostics.size(), 1U);
  EXPECT_EQ(first.diagnostics.front().code, Code::stretch_factor_out_of_range);
  const Outbox::Slice second = outbox.take(Layout::blocks, 1'000'000);
  EXPECT_EQ(second.blocks.size(), 1U);
  EXPECT_TRUE(second.diagnostics.empty());
  EXPECT_TRUE(outbox.empty());
}

TEST(Outbox, ADiagnosticAloneIsASliceToo) {
  Outbox outbox;
  outbox.content().tell({diagnostic(Code::program_empty, {})});
  EXPECT_FALSE(outbox.empty());
  EXPECT_EQ(outbox.take(Layout::blocks, 1000).diagnostics.size(), 1U);
  EXPECT_TRUE(outbox.empty());
}

TEST(Outbox, PortionsLeaveBeforeWhatCameAfterThem) {
  Outbox outbox;
  outbox.go_on_behind(5);
  std::uint64_t given = 5;
  for (int portion = 0; portion < 4; ++portion) {
    for (int i = 0; i < 100; ++i) {
      outbox.content().blocks().push_back(block(given++));
      if (portion == 1 && i == 49)
        outbox.content().tell({diagnostic(Code::stretch_factor_out_of_range, {})});
    }
    if (portion < 3) outbox.content().portion();
  }
  const std::size_t held = 400 * sizeof(CompensatedBlock) + sizeof(Diagnostic);
  EXPECT_TRUE(outbox.holds(held));
  EXPECT_FALSE(outbox.holds(held + 1));
  EXPECT_TRUE(outbox.has_grown());
  EXPECT_FALSE(outbox.has_grown());

  std::uint64_t next = 5;
  while (!outbox.empty()) {
    const Outbox::Slice slice = outbox.take(Layout::blocks, 3000);
    EXPECT_EQ(slice.first_block, next);
    for (const CompensatedBlock& got : slice.blocks) EXPECT_EQ(got.source.index, next++);
    EXPECT_EQ(slice.diagnostics.size(), next == 5 + 150 ? 1U : 0U);
    outbox.forget_taken();
  }
  EXPECT_EQ(next, given);
  EXPECT_EQ(outbox.blocks_taken(), given);
  EXPECT_FALSE(outbox.holds(1));
}

}  // namespace
}  // namespace trc::server
