#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "core/session/program_session.h"
#include "core/verify/clearance.h"

// Contours the tool screws itself down to, or up from, in whole turns (D-106).

namespace trc {
namespace {

struct Result {
  bool whole = false;
  std::vector<Diagnostic> diagnostics{};
  double coverage = 0;
  double clearance = 0;
};

Result run(const std::string& modes, double radius, const std::string& contour) {
  ProgramSessionSetup setup;
  setup.nc_text = false;
  setup.session.verify = Verify::enforce;
  ProgramSession session(setup);
  Answers out;
  const bool whole = session.feed("G162 V.G.WZ_AKT.R=" + std::to_string(radius) + "\n" + modes +
                                      "\n" + contour + "N900 M30\n",
                                  out) &&
                     session.finish(out);
  const verify::ClearanceReport* const measured = session.clearance();
  if (measured == nullptr || !measured->worst)
    return {.whole = whole, .diagnostics = out.take().diagnostics};
  return {.whole = whole,
          .diagnostics = out.take().diagnostics,
          .coverage = measured->coverage(),
          .clearance = measured->worst->distance};
}

constexpr const char* all_modes[] = {"G140 G26", "G141 G26",
                                     "G141 G26\n#TRC[REMOVE_MASKED_BLOCKS=1]"};

void expect_machined(double radius, const std::string& contour) {
  for (const char* modes : all_modes) {
    const Result outcome = run(modes, radius, contour);
    EXPECT_TRUE(outcome.whole) << modes << contour;
    EXPECT_TRUE(outcome.diagnostics.empty()) << modes << contour;
    EXPECT_NEAR(outcome.coverage, 1, 1e-3) << modes << contour;
    EXPECT_NEAR(outcome.clearance, radius, 0.004) << modes << contour;
  }
}

std::string turns(int number, const std::string& words) {
  std::string lines;
  for (int turn = 1; turn <= number; ++turn) lines += words + " Z-" + std::to_string(turn) + "\n";
  return lines;
}

constexpr const char* pocket =
    "G1 X10\nG3 X13 Y3 I0 J3\nG1 Y20\nG3 X10 Y23 I-3\nG1 X-10\nG3 X-13 Y20 J-3\nG1 Y3\n"
    "G3 X-10 Y0 I3\nG1 X0\n";

// The circle of the turns touches the wall where the pocket begins.
TEST(EntryTurns, LeadIntoAPocket) {
  for (const int number : {1, 2, 5, 9})
    expect_machined(2, "G0 X0 Y5 Z0 F800\nG41 G1 X-4 Y4\n" + turns(number, "G3 X-4 Y4 I4 J0") +
                           "G3 X0 Y0 I4 J0\n" + pocket + "G3 X4 Y4 J4\nG40 G1 X0 Y5\n");
}

// About a post they are larger than it is.
TEST(EntryTurns, LeadToAPost) {
  const std::string post = "G1 X1\nG2 X1 Y-2 J-1\nG1 X-1\nG2 X-1 Y0 J1\nG1 X0\n";
  for (const int number : {1, 3})
    expect_machined(2, "G0 X0 Y5 Z0 F800\nG41 G1 X-4 Y4\n" + turns(number, "G3 X-4 Y4 I4 J0") +
                           "G3 X0 Y0 I4 J0\n" + post + "G3 X4 Y4 J4\nG40 G1 X0 Y5\n");
}

// In half turns, and with three decimals, which have each of them touch the wall by a little.
TEST(EntryTurns, MayTouchAsCirclesAreRounded) {
  std::string helix;
  for (const char* depth : {"-1", "-2", "-3"})
    helix += std::string("G3 X-0.083 Y5.656 I2.787 J2.869 Z") + depth +
             "\nG3 X-5.656 Y-0.083 I-2.787 J-2.869\n";
  expect_machined(2,
                  "G0 X-3.587 Y3.484 Z0 F800\nG41 G1 X-5.656 Y-0.083\n" + helix +
                      "G3 X0 Y0 I2.787 J2.869\nG1 X6.967 Y7.174\nG3 X6.905 Y11.416 I-2.152 J2.09\n"
                      "G1 X-5.29 Y23.26\nG3 X-9.532 Y23.198 I-2.09 J-2.152\nG1 X-23.466 Y8.851\n"
                      "G3 X-23.404 Y4.609 I2.152 J-2.09\nG1 X-11.209 Y-7.236\n"
                      "G3 X-6.967 Y-7.174 I2.09 J2.152\nG1 X0 Y0\n"
                      "G3 X-0.083 Y5.656 I-2.869 J2.787\nG40 G1 X-3.587 Y3.484\n");
}

// So are turns made of chords: beside the wall, and where the lead touches it.
TEST(EntryTurns, MayBeMadeOfChords) {
  const auto chords = [](const Point& center, double radius, int chords_of_turn) {
    std::string lines;
    for (int chord = 1; chord <= 3 * chords_of_turn; ++chord) {
      const double angle = std::numbers::pi * (1 + 2.0 * chord / chords_of_turn);
      std::array<char, 80> line{};
      std::snprintf(line.data(), line.size(), "G1 X%.3f Y%.3f Z%.4f\n",
                    center.x() + radius * std::cos(angle), center.y() + radius * std::sin(angle),
                    -0.02 * chord);
      lines += line.data();
    }
    return lines;
  };
  for (const int of_turn : {12, 36, 120}) {
    expect_machined(2, "G0 X0 Y5 Z0 F800\nG41 G1 X-4 Y4\n" + chords(Point(0, 4), 4, of_turn) +
                           "G3 X0 Y0 I4 J0\n" + pocket + "G3 X4 Y4 J4\nG40 G1 X0 Y5\n");
    expect_machined(2, "G0 X0 Y12 Z0 F800\nG41 G1 X-3 Y12\n" + chords(Point(0, 12), 3, of_turn) +
                           "G1 X-3 Y3\nG3 X0 Y0 I3 J0\n" + pocket + "G3 X4 Y4 J4\nG40 G1 X0 Y5\n");
  }
}

// A second lap, whose lead goes round the circle of the turns too.
TEST(EntryTurns, LeadToSeveralLaps) {
  const std::string in = "G3 X-4.715 Y3.126 I-3.92 J-0.795\nG3 X0 Y0 I3.92 J0.795\n";
  const std::string out = "G3 X3.126 Y4.715 I-0.795 J3.92\n";
  const std::string lap =
      "G1 X9.801 Y1.987\nG3 X12.145 Y5.523 I-0.596 J2.94\nG1 X8.767 Y22.184\n"
      "G3 X5.231 Y24.528 I-2.94 J-0.596\nG1 X-14.37 Y20.555\nG3 X-16.714 Y17.019 I0.596 J-2.94\n"
      "G1 X-13.337 Y0.357\nG3 X-9.801 Y-1.987 I2.94 J0.596\nG1 X0 Y0\n";
  expect_machined(2, "G0 X-0.993 Y4.9 Z0 F800\nG41 G1 X-4.715 Y3.126\n" +
                         turns(3, "G3 X-4.715 Y3.126 I3.92 J0.795") + "G3 X0 Y0 I3.92 J0.795\n" +
                         lap + out + "G1 Z-4\n" + in + lap + out + "G40 G1 X-0.993 Y4.9\n");
}

// Up out of it, the same way.
TEST(EntryTurns, LeadOutOfAPocket) {
  expect_machined(2, std::string("G0 X0 Y5 Z-3 F800\nG41 G1 X-4 Y4\nG3 X0 Y0 I4 J0\n") + pocket +
                         "G3 X4 Y4 J4\nG3 X4 Y4 I-4 Z-2\nG3 X4 Y4 I-4 Z-1\nG3 X4 Y4 I-4 Z0\n"
                         "G40 G1 X0 Y5\n");
}

// A bore in circles is no lead to what lies beside it.
TEST(EntryTurns, OfABoreStayWalls) {
  const Result outcome = run("G140 G26", 2,
                             "G0 X0 Y0 Z0 F800\nG41 G1 X0 Y-4\n" + turns(3, "G3 X0 Y-4 I0 J4") +
                                 "G3 X4 Y0 I0 J4\nG40 G1 X0 Y0\n");
  EXPECT_TRUE(outcome.whole);
  EXPECT_TRUE(outcome.diagnostics.empty());
  EXPECT_NEAR(outcome.coverage, 1, 1e-3);
}

}  // namespace
}  // namespace trc
