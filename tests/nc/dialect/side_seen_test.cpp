#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "tests/nc/dialect/reading.h"

// G41, G42, RL and RR are read or refused by name wherever they stand. Passed on as text they would
// silently leave a contour without compensation (D-121).

namespace trc::testing {
namespace {

Reading read_as(DialectName dialect, const std::string& program) {
  ProgramSetup setup;
  setup.dialect = dialect;
  return read(program, setup);
}

bool selects(const Reading& reading) {
  const auto motions = reading.motions();
  return std::ranges::any_of(motions, [](const auto& motion) { return motion.mode->active(); });
}

TEST(SideSeen, AfterAParameterOfKlartext) {
  for (const std::string block :
       {"L X+0 Y-Q4\tRL F300", "L X+0 Y-Q4RL F300", "L X+0 Y-Q4\xC2\xA0RL F300", "L X+Q5\tY-Q4\tRL",
        "L X+0 YQ4RL", "L X+0 Y Q4\tRL", "L X+0 Y-Q4 RL ~\nF300", "L X+0 Y-Q4~\nRL F300"}) {
    const std::string behind = block + "\nL Y+40\nL X+50\nL X+80 Y+80 R0\n";
    const Reading known =
        read_as(DialectName::heidenhain, "Q4 = +10\nQ5 = +0\nL X-20 Y-20 R0 FMAX\n" + behind);
    EXPECT_FALSE(known.stopped) << block;
    EXPECT_TRUE(selects(known)) << block;
    const Reading unknown = read_as(DialectName::heidenhain, "L X-20 Y-20 R0 FMAX\n" + behind);
    EXPECT_TRUE(unknown.stopped) << block;
  }
}

TEST(SideSeen, BesideWhatTheControlDoesByItself) {
  for (const std::string block : {"L X+0 Y+0 F300 M140 MB MAX RL",
                                  "L X+0 Y+0 RL F200 M97",
                                  "L X+0 Y+0 M97 RL",
                                  "CYCL CALL POS X+0 Y+0 RL",
                                  "CYCL CALL M3 RL",
                                  "PLANE RESET MOVE RL F300",
                                  "TRANS DATUM AXIS X+5 RL",
                                  "CALL LBL 1 RL",
                                  "TCH PROBE 400 RL",
                                  "STOP RL",
                                  "CC X+0 Y+0 RL",
                                  "RND R2 RL",
                                  "CYCL DEF 7.1 X+5 RL",
                                  "Q1 = 5 RL",
                                  "L X+0 Y+0 M140 MB MAXRL F300",
                                  "L X+0 Y+0 M128 FRL",
                                  "L X+0 Y+0 M138 CRL F300",
                                  "L X+0 Y+0 M118 XRL F300",
                                  "CALL PGM A.H ~\nL X+0 Y+0 RL F300",
                                  "CALL PGM A RL",
                                  "BEGIN PGM A MM L X+0 RL",
                                  "M103 L X+0 Y+0 RL F300",
                                  "L X+Q4RR Y+0",
                                  "L A+Q4RL X+0"}) {
    const Reading reading =
        read_as(DialectName::heidenhain, "L X-20 Y-20 R0 FMAX\n" + block + "\nL X+0 Y+40\n");
    EXPECT_TRUE(reading.stopped) << block;
  }
}

TEST(SideSeen, R0AfterAFunctionWithWordsOfItsOwn) {
  const Reading reading = read_as(
      DialectName::heidenhain,
      "L X+0 Y+0 R0 FMAX\nL X+5 Y+0 RL F100\nL X+20 Y+0\nL X+30 Y-9 M103 F0.5 R0\nL X+40\n");
  EXPECT_FALSE(reading.stopped);
  ASSERT_FALSE(reading.motions().empty());
  EXPECT_FALSE(reading.last_motion().mode->active());
}

TEST(SideSeen, AfterAVariableOfSinumerik) {
  const std::string contour = "\nG1 X0 Y40\nG1 X50\nG40 X80 Y80\n";
  const Reading known =
      read_as(DialectName::sinumerik, "R9=0\nG0 X-9 Y-9\nG1 X=R9G41 Y0 F100" + contour);
  EXPECT_TRUE(known.stopped || selects(known));
  const Reading unknown =
      read_as(DialectName::sinumerik, "G0 X-9 Y-9\nG1 X=R9G41 Y0 F100" + contour);
  EXPECT_TRUE(unknown.stopped);
}

TEST(SideSeen, WhereWordsAreGluedOrTextsNotClosed) {
  using enum DialectName;
  for (const auto& [dialect, block] :
       {std::pair{sinumerik, "G41: G1 X0 Y0 F300"}, std::pair{isg, "#MSG [\"a] G41"},
        std::pair{fanuc, "G1 G41 X0, Y0 D1 F300"},
        std::pair{fanuc, "G1 G41 D1 SETVN[A] X0 Y0 F300"}, std::pair{fanuc, "G4 P100 Y50"},
        std::pair{linuxcnc, "G4 P1 Y50"}, std::pair{sinumerik, "G4 F1 Y50"}})
    EXPECT_TRUE(read_as(dialect, "G0 X-9 Y-9\n" + std::string(block) + "\nG1 X5 F100\n").stopped)
        << block;
  // Words that an M function does not use move the axes.
  const Reading moves = read_as(heidenhain, "L X+0 Y+0 R0 FMAX\nL M103 F0.5 Y+50\n");
  EXPECT_EQ(std::get<Line>(moves.last_motion().path).end, Point(0, 50));
}

TEST(SideSeen, AfterALineEndThatIsNone) {
  const Reading reading = read_as(DialectName::heidenhain, "; A\vL X+0 Y+0 RL F300\vL Y+40\n");
  EXPECT_EQ(reading.code(), Code::nc_not_text);
}

TEST(SideSeen, NotInNamesCommentsAndTexts) {
  for (const std::string line : {"MSG(\"G41 ON\")", "MSG(G42)", "; G41", "X=_NG41"}) {
    const Reading reading = read_as(DialectName::sinumerik, "G0 X0 Y0\n" + line + "\nG0 X5 Y5\n");
    EXPECT_FALSE(reading.stopped) << line;
  }
}

}  // namespace
}  // namespace trc::testing
