#include "tests/programs/twins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace trc::support {
namespace {

// Comments name the subprograms, which the other one does not have.
std::vector<CompensatedBlock> motions_of(const ProgramRun& ran) {
  std::vector<CompensatedBlock> motions;
  for (const CompensatedBlock& block : ran.blocks)
    if (block.origin != Origin::passthrough) motions.push_back(block);
  return motions;
}

}  // namespace

TEST_P(Twins, HaveTheSamePath) {
  const ProgramRun computed = to_blocks(twin().computed, setup());
  const ProgramRun flat = to_blocks(twin().flat, setup());
  ASSERT_FALSE(computed.stopped) << computed.report();
  ASSERT_FALSE(flat.stopped) << flat.report();
  const auto left = motions_of(computed);
  const auto right = motions_of(flat);
  ASSERT_EQ(left.size(), right.size());
  ASSERT_GT(left.size(), 2u);
  for (std::size_t at = 0; at < left.size(); ++at) {
    SCOPED_TRACE("block " + std::to_string(at));
    EXPECT_EQ(left[at].origin, right[at].origin);
    EXPECT_EQ(left[at].rapid, right[at].rapid);
    EXPECT_NEAR(left[at].feed, right[at].feed, 1e-6);
    ASSERT_EQ(left[at].path.index(), right[at].path.index());
    EXPECT_LT((start_of(left[at].path) - start_of(right[at].path)).norm(), 1e-6);
    EXPECT_LT((end_of(left[at].path) - end_of(right[at].path)).norm(), 1e-6);
    EXPECT_NEAR(left[at].normal.to, right[at].normal.to, 1e-6);
    if (const Arc* arc = std::get_if<Arc>(&left[at].path)) {
      EXPECT_LT((arc->center - std::get<Arc>(right[at].path).center).norm(), 1e-5);
      EXPECT_NEAR(arc->sweep, std::get<Arc>(right[at].path).sweep, 1e-6);
    }
  }
}

TEST_P(Twins, ComeOutTheSameHoweverTheyAreCut) {
  const ProgramRun whole = to_text(twin().computed, setup());
  ASSERT_FALSE(whole.stopped) << whole.report();
  for (const std::size_t piece : {1U, 2U, 3U, 7U, 61U, 250U})
    EXPECT_EQ(to_text(twin().computed, setup(), piece).text, whole.text) << piece;
}

// The flat program computes nothing any more, and means the same.
TEST_P(Twins, ComeOutAsAProgramThatIsRead) {
  const ProgramRun computed = to_text(twin().computed, setup());
  ProgramSession again(setup());
  Answers answers;
  EXPECT_TRUE(again.feed(computed.text, answers)) << computed.text;
  EXPECT_TRUE(again.finish(answers)) << computed.text;
  EXPECT_FALSE(again.is_computing()) << computed.text;
}

TEST_P(Twins, ComputeWhereTheFlatOneDoesNot) {
  ProgramSession computed(setup());
  ProgramSession flat(setup());
  Answers answers;
  EXPECT_TRUE(computed.feed(twin().computed, answers));
  EXPECT_TRUE(flat.feed(twin().flat, answers));
  EXPECT_TRUE(computed.is_computing());
  EXPECT_FALSE(flat.is_computing());
}

// A program without faults has none when its lines are looked at after one that was put in.
TEST_P(Twins, TellNothingElseAfterAnError) {
  const DialectName dialect = GetParam().dialect;
  const std::string fault = dialect == DialectName::fanuc      ? "#33=#5041\n"
                            : dialect == DialectName::linuxcnc ? "#4999=#5420\n"
                                                               : "R999=$AA_IM[X]\n";
  std::string text = twin().computed;
  const bool has_head = std::string_view("%OoP(").find(text.front()) != std::string_view::npos;
  text.insert(has_head ? text.find('\n') + 1 : 0, fault);
  const ProgramRun ran = to_text(text, setup());
  ASSERT_TRUE(ran.stopped) << text;
  EXPECT_EQ(std::ranges::count(ran.diagnostics, Severity::error, &Diagnostic::severity), 1)
      << ran.report() << text;
}

}  // namespace trc::support
