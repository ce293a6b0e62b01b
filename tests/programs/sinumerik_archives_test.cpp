#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "core/messages/diagnostic_text.h"
#include "tests/programs/computing.h"

// Archives of Sinumerik: several programs in one text, each after its header.

namespace trc::support::sinumerik_archives {
namespace {

ProgramSessionSetup setup() { return computing_setup(DialectName::sinumerik, 5); }

std::string flat(const std::string& text) { return flat_of(text, setup()); }
std::pair<int, unsigned> told(const std::string& text) { return refusal_of(text, setup()); }

const std::string contour = "G41 G1 X0 Y0 F500\nX20\nY20\nG40 X40\n";
const std::string sub = "%_N_KONT_A_SPF\n" + contour + "M17\n";
const std::string main_program = "%_N_TEIL_MPF\nG17 G90 G54\nT1 D1 M6\nG0 X-20 Y-20\nKONT_A\nM30\n";

TEST(SinumerikArchives, KeepProgramsThatNobodyCalls) {  // D-157
  const std::string other = "%_N_B_MPF\nR5=1\nG0 X=R5\nM30\n%_N_SUB_C_SPF\nG0 X5\nM17\n";
  EXPECT_EQ(flat("%_N_A_MPF\nR1=20\nG0 X=R1\nM30\n" + other), "%_N_A_MPF\nG0 X=20\nM30\n" + other);
  EXPECT_EQ(flat("%_N_A_MPF\nG0 X=10+10\nM30\n" + other), "%_N_A_MPF\nG0 X=20\nM30\n" + other);
  // One that is called has come out where it is.
  EXPECT_EQ(flat("%_N_A_MPF\nSUB_C\nM30\n" + other),
            "%_N_A_MPF\n; SUB_C\nG0 X5\nM30\n%_N_B_MPF\nR5=1\nG0 X=R5\nM30\n");
}

TEST(SinumerikArchives, LoseNoContourAfterTheirEnd) {
  EXPECT_EQ(told("%_N_A_MPF\nR1=20\nG0 X=R1\nM30\n%_N_C_SPF\n" + contour + "M17\n"),
            std::pair(900015, 6U));
  EXPECT_EQ(told("%_N_A_MPF\nR1=20\nG0 X=R1\n%_N_C_SPF\nG0 X5\nM17\n"), std::pair(900310, 3U));
}

TEST(SinumerikArchives, HaveTheirMainProgramBeforeItsSubprograms) {  // D-157
  EXPECT_EQ(told(main_program + sub), std::pair(0, 0U));
  EXPECT_EQ(told(sub + main_program), std::pair(900003, 7U));
  EXPECT_EQ(told("%_N_KONT_A_SPF\nR1=5\n" + contour + "M17\n" + main_program),
            std::pair(900003, 8U));
  EXPECT_EQ(to_text(sub + main_program, setup(), 1).diagnostics.back().detail,
            "KONT_A_SPF, a subprogram before what calls it");
}

// The tool stands where the caller has brought it.
TEST(SinumerikArchives, OfASubprogramAloneBeginNoContourByChance) {
  ProgramSessionSetup assumed = setup();
  assumed.session.program.start_is_assumed = true;
  const std::string lines = contour + "M17\n";
  EXPECT_EQ(refusal_of(sub, assumed), std::pair(900106, 2U));
  const ProgramRun ran = to_text(sub, assumed);
  ASSERT_EQ(ran.diagnostics.size(), 1U);
  EXPECT_NE(help_of(ran.diagnostics.front()).find("start_position"), std::string::npos);
  EXPECT_EQ(refusal_of("G0 X0 Y0\n" + lines, assumed), std::pair(0, 0U));
  EXPECT_EQ(refusal_of("G0 Y-20\n" + lines, assumed), std::pair(0, 0U));
  EXPECT_EQ(refusal_of("G0 Y0\n" + lines, assumed), std::pair(900106, 2U));
  EXPECT_EQ(refusal_of(sub, setup()), std::pair(0, 0U));
}

TEST(SinumerikArchives, NameTheLineThatCallsWhatIsMissingAfterACall) {
  const ProgramRun ran = to_text("G0 X-20 Y-20\nKONT_A\nL500\nM30\n" + sub, setup());
  ASSERT_EQ(ran.diagnostics.size(), 1U) << ran.report();
  EXPECT_EQ(ran.diagnostics.front().source.line, 3U);
  EXPECT_TRUE(ran.diagnostics.front().calls.empty());
}

}  // namespace
}  // namespace trc::support::sinumerik_archives
