#include <gtest/gtest.h>

#include <string>

#include "tests/programs/computing.h"

// APPR and DEP of Klartext, and what stands between the motions of a contour.

namespace trc::support::klartext_leads {
namespace {

ProgramRun run(const std::string& text) {
  return to_blocks(
      "BEGIN PGM A MM\nTOOL CALL 5 Z S1000\nL X-40 Y-40 R0 FMAX\n" + text + "END PGM A MM\n",
      computing_setup(DialectName::heidenhain, 5));
}

// Code and detail of the first error.
std::string told(const std::string& text) {
  const ProgramRun ran = run(text);
  if (!ran.stopped) return "";
  const Diagnostic& first = ran.diagnostics.front();
  return std::to_string(static_cast<int>(first.code)) + " " + first.detail;
}

Point end_of_path(const std::string& text) {
  const ProgramRun ran = run(text);
  EXPECT_FALSE(ran.stopped) << ran.report();
  return ran.blocks.empty() ? Point::Zero() : end_of(ran.blocks.back().path);
}

const std::string wall = "L X+0 Y+0 RL F300\nL Y+60\n";

// What DEP LCT leaves out is that of the last point of the contour, not of the arc.
TEST(KlartextLeads, ACoordinateLeftOutStays) {
  EXPECT_LT((end_of_path(wall + "DEP LCT X-40 R8\n") - Point(-40, 60)).norm(), 1e-9);
  EXPECT_LT((end_of_path(wall + "DEP LCT X-40 Y+60 R8\n") - Point(-40, 60)).norm(), 1e-9);
  EXPECT_LT((end_of_path(wall + "L X+60\nDEP LCT Y+90 R8\n") - Point(60, 90)).norm(), 1e-9);
  EXPECT_LT((end_of_path(wall + "DEP LCT IX-30 R8\n") - Point(-30, 60)).norm(), 1e-9);
}

// The line between the arc and the point runs without compensation: it must not lead through the
// wall (D-161).
TEST(KlartextLeads, AcrossTheWallAreRefused) {
  const std::string refused =
      "900003 a lead by LCT whose line comes nearer to the contour than the radius of the tool";
  EXPECT_EQ(told(wall + "DEP LCT X+40 Y+30 R8\n"), refused);
  EXPECT_EQ(told(wall + "DEP LCT X-40 Y+30 R8\n"), "");
  EXPECT_EQ(told(wall + "DEP LCT R8\n"), refused);
  EXPECT_EQ(told(wall + "DEP LCT X-3 Y+20 R8\n"), refused);
  EXPECT_EQ(told(wall + "DEP LCT X-30 Y+100 R8\n"), "");
  const std::string back = "L Y+60\nL X-40 R0\n";
  EXPECT_EQ(told("L X+40 Y+30 R0 FMAX\nAPPR LCT X+0 Y+0 R8 RL F300\n" + back), refused);
  EXPECT_EQ(told("L X-40 Y+30 R0 FMAX\nAPPR LCT X+0 Y+0 R8 RL F300\n" + back), "");
  // Down to the depth the tool goes after the line.
  EXPECT_EQ(told("L X+40 Y+30 Z+2 R0 FMAX\nAPPR LCT X+0 Y+0 Z-5 R8 RL F300\n" + back), "");
}

// The contour of the arc begins in the centre of the bore, its path a radius beside it.
TEST(KlartextLeads, BeginWhereTheToolStands) {  // D-129
  const ProgramRun ran =
      run("CC X+0 Y+0\nL X+0 Y+0 R0 FMAX\nAPPR CT X+30 Y+0 CCA180 R10 RL F300\nCP IPA+360 DR+\n"
          "DEP CT CCA180 R10\n");
  ASSERT_FALSE(ran.stopped) << ran.report();
  bool is_at_lead = false;
  for (const CompensatedBlock& block : ran.blocks) {
    EXPECT_LE(end_of(block.path).norm(), 60) << listing_of({block});
    is_at_lead |= (start_of(block.path) - Point(5, 0)).norm() < 1e-9;
  }
  EXPECT_TRUE(is_at_lead) << ran.listing();
}

TEST(KlartextContours, ChangeTheirSideAfterR0Alone) {  // D-162
  const std::string right = "L X+40\nL Y+0\nL X+100 R0\n";
  EXPECT_EQ(told(wall + "L X+40 RR\n" + right), "900003 RR after RL without R0 in between");
  EXPECT_EQ(told("L X+0 Y+0 RR F300\nL Y+60\nL X+40 RL\n" + right),
            "900003 RL after RR without R0 in between");
  EXPECT_EQ(told(wall + "L X-40 Y+90 R0\nL X+0 Y+60 RR\n" + right), "");
  EXPECT_EQ(told("L X+0 Y+0 RL F300\nL Y+60 RL\nL X-40 R0\n"), "");
}

TEST(KlartextContours, SayWhatIsWrongWithTheirLeads) {
  EXPECT_EQ(told("APPR LT X+0 Y+0 LEN0 RL F300\nL Y+60\n").substr(7), "LEN0, not above 0");
  EXPECT_EQ(told(wall + "DEP LN LEN-5\n").substr(7), "LEN-5, not above 0");
  EXPECT_EQ(told(wall + "DEP LN\n").substr(7), "DEP LN without LEN");
  EXPECT_EQ(told(wall + "CHF 4\nCT X+40 Y+60\nL X+80 R0\n").substr(7),
            "CT directly after RND or CHF");
}

}  // namespace
}  // namespace trc::support::klartext_leads
