#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "core/geometry/along.h"
#include "core/geometry/distance.h"
#include "core/session/program_session.h"

// Programs whose contours come back to places they have been in: what counts as their start and
// end, as laps, and as parts that only touch (D-38, D-44).

namespace trc {
namespace {

struct Result {
  std::vector<CompensatedBlock> blocks{};
  std::vector<Diagnostic> diagnostics{};
  bool whole = false;

  [[nodiscard]] bool tells(Code code) const {
    return std::any_of(diagnostics.begin(), diagnostics.end(),
                       [&](const Diagnostic& told) { return told.code == code; });
  }
  // The block numbers that have a path of their own.
  [[nodiscard]] std::set<std::int64_t> travelled() const {
    std::set<std::int64_t> numbers;
    for (const CompensatedBlock& block : blocks)
      if (block.origin == Origin::programmed) numbers.insert(block.source.number);
    return numbers;
  }
  [[nodiscard]] double clearance_to(const std::vector<Segment>& walls) const {
    double least = INFINITY;
    for (const CompensatedBlock& block : blocks)
      if (block.origin == Origin::programmed || block.origin == Origin::transition)
        for (const Segment& wall : walls)
          for (int step = 0; step <= 64; ++step)
            least = std::min(
                least, distance(point_along(block.path, length_of(block.path) * step / 64), wall));
    return least;
  }
};

Result run(const std::string& modes, double radius, const std::string& contour,
           Verify verify = Verify::off) {
  ProgramSessionSetup setup;
  setup.nc_text = false;
  setup.session.verify = verify;
  ProgramSession session(setup);
  Answers out;
  const std::string program =
      "V.G.WZ_AKT.R=" + std::to_string(radius) + "\n" + modes + "\n" + contour + "N900 M30\n";
  const bool whole = session.feed(program, out) && session.finish(out);
  Answer answer = out.take();
  return {.blocks = std::move(answer.blocks),
          .diagnostics = std::move(answer.diagnostics),
          .whole = whole};
}

constexpr const char* removing = "G141 G26\n#TRC[REMOVE_MASKED_BLOCKS=1]";

// An outside contour begun on one side of an inside fillet of 1 mm, left on the other one.
TEST(ClosingPrograms, AnOverrunMayGoPastAFilletTheToolDoesNotFitInto) {  // D-38
  const Result outcome =
      run(removing, 2.5,
          "N10 G0 X27.5 Y34.25 F800\nN20 G41 G1 X23.75 Y34.25\n"
          "N30 G3 X20 Y30.5 I0 J-3.75\nN40 G1 Y21\nN50 G3 X21 Y20 I1 J0\n"
          "N60 G1 X40\nN70 Y0\nN80 X0\nN90 Y40\nN100 X20\nN110 Y30.5\nN120 Y21\n"
          "N130 G3 X21 Y20 I1 J0\nN140 G1 X30.5\nN150 G3 X34.25 Y23.75 I0 J3.75\n"
          "N160 G40 G1 X34.25 Y27.5\n");
  ASSERT_TRUE(outcome.whole);
  EXPECT_EQ(outcome.travelled(),
            (std::set<std::int64_t>{30, 40, 60, 70, 80, 90, 100, 110, 120, 140, 150}));
  const Line right{Point(20, 21), Point(20, 40)};
  const Line bottom{Point(21, 20), Point(40, 20)};
  EXPECT_NEAR(outcome.clearance_to({right, bottom}), 2.5, 1e-9);
}

// A disc in chords of 0.1 mm, its leads along the tangent before the first chord and after
// the last one: so near to the chords that they seem to repeat them.
TEST(ClosingPrograms, TangentialLeadsBesideFineChordsAreNoOverrun) {  // D-38
  const auto position = [](double x, double y) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "X%.3f Y%.3f", x, y);
    return std::string(text.data());
  };
  for (const double radius : {10.0, 50.0, 200.0})
    for (const double lead : {0.3, 0.5, 1.0})
      for (const bool left : {false, true}) {
        SCOPED_TRACE(testing::Message() << radius << ' ' << lead << ' ' << left);
        const double way = left ? -1 : 1;
        const auto count = static_cast<int>(2 * std::numbers::pi * radius / 0.1);
        std::string contour = "G0 " + position(-way * lead, -20) + " F800\nG138 " +
                              (left ? "G41" : "G42") + " G1 " + position(-way * lead, 0) + "\n";
        std::vector<Segment> walls;
        Point last(0, 0);
        contour += position(0, 0) + "\n";
        for (int chord = 1; chord <= count; ++chord) {
          const double angle = 2 * std::numbers::pi * chord / count;
          const auto rounded = [](double value) { return std::round(1000 * value) / 1000; };
          const Point next(rounded(way * radius * std::sin(angle)),
                           rounded(radius * (1 - std::cos(angle))));
          contour += position(next.x(), next.y()) + "\n";
          walls.emplace_back(Line{.start = last, .end = next});
          last = next;
        }
        contour += position(way * lead, 0) + "\nG40 " + position(way * lead, -20) + "\n";
        for (const char* modes : {removing, "G140 G26"}) {
          const Result outcome = run(modes, 5, contour, Verify::enforce);
          EXPECT_TRUE(outcome.whole) << modes;
          EXPECT_TRUE(outcome.diagnostics.empty()) << modes;
        }
      }
}

// The lap in that many depths, N10 to N90, N110 …; `back` leads from one to the next.
std::string in_depths(int count, const std::vector<std::string>& lap, const std::string& back) {
  std::string contour;
  for (int depth = 0; depth < count; ++depth) {
    if (depth > 0) contour += back + "\nZ-" + std::to_string(depth) + "\n";
    for (std::size_t block = 0; block < lap.size(); ++block)
      contour += "N" + std::to_string(100 * depth + 10 * static_cast<int>(block + 1)) + " " +
                 lap[block] + "\n";
  }
  return contour;
}

std::string in_three_depths(const std::vector<std::string>& lap, const std::string& back) {
  return in_depths(3, lap, "G1 " + back);
}

// All of the lap is, but for its first and last block, which are leads.
void expect_all_depths(const Result& outcome, int blocks, int depths = 3) {
  ASSERT_TRUE(outcome.whole);
  const std::set<std::int64_t> travelled = outcome.travelled();
  for (int depth = 0; depth < depths; ++depth)
    for (int block = 2; block < blocks; ++block)
      EXPECT_TRUE(travelled.contains(100 * depth + 10 * block))
          << "depth " << depth << ' ' << block;
}

// A slender boss by half circles, longer than three quarters of the way round it.
TEST(ClosingPrograms, DepthsMayHaveLeadsNearlyAsLongAsALap) {  // D-57
  const std::vector<std::string> lap{"G3 X0 Y-4 J12", "G2 Y4 J4", "G1 X42",
                                     "G2 Y-4 J-4",    "G1 X0",    "G3 Y-31 J-13.5"};
  const Result outcome =
      run(removing, 10,
          "G0 X-4 Y-28 F800\nG41 G1 X0 Y-28\n" + in_three_depths(lap, "Y-28") + "G40 G1 X29\n");
  expect_all_depths(outcome, 6);
  EXPECT_NEAR(
      outcome.clearance_to({Line{Point(0, -4), Point(42, -4)}, Line{Point(0, 4), Point(42, 4)}}),
      10, 1e-9);
}

// A post of 10 mm, which is shorter round than what leads from one depth to the next.
TEST(ClosingPrograms, DepthsMayHaveLeadsLongerThanALap) {  // D-107
  const std::vector<std::string> lap{"G1 X12 Y-17", "G3 X0 Y-5 I-12 J0",    "G2 Y5 J5",
                                     "G2 Y-5 J-5",  "G3 X-12 Y-17 I0 J-12", "G1 Y-32"};
  for (const char* modes : {removing, "G141 G26", "G140 G26"}) {
    const Result outcome = run(
        modes, 6,
        "G0 X14 Y-36 F800\nG41 G1 X12 Y-32\n" + in_three_depths(lap, "X12 Y-32") + "G40 G1 Y-40\n",
        Verify::enforce);
    expect_all_depths(outcome, 6);
    EXPECT_TRUE(outcome.diagnostics.empty()) << modes;
  }
}

// A bore of 40 mm and a post of 40 mm, one circle a lap.
TEST(ClosingPrograms, TwoDepthsMayBeOfOneCircleEach) {  // D-107
  struct Lap {
    const char* name;
    const char* begin;
    std::vector<std::string> blocks;
    const char* link;
  };
  const std::vector<Lap> laps{{"bore",
                               "G0 X2 Y-14 F800\nG41 G1 X6 Y-14\n",
                               {"G3 X20 Y0 I0 J14", "G3 X20 Y0 I-20 J0", "G3 X6 Y14 I-14 J0"},
                               "X6 Y-14"},
                              {"post",
                               "G0 X38 Y14 F800\nG41 G1 X34 Y14\n",
                               {"G3 X20 Y0 I0 J-14", "G2 X20 Y0 I-20 J0", "G3 X34 Y-14 I14 J0"},
                               "X34 Y14"}};
  for (const Lap& lap : laps)
    for (const char* modes : {removing, "G141 G26", "G140 G26"})
      for (const char* motion : {"G1 ", "G0 "}) {
        const Result outcome = run(
            modes, 4,
            lap.begin + in_depths(2, lap.blocks, motion + std::string(lap.link)) + "G40 G1 Y0\n",
            Verify::enforce);
        expect_all_depths(outcome, 3, 2);
        EXPECT_TRUE(outcome.diagnostics.empty()) << lap.name << ' ' << modes << ' ' << motion;
      }
}

// A post of 40 mm and a tool of 36, whose leads cross on their way to the second depth.
TEST(ClosingPrograms, DepthsMayHaveLongLeadsThatCross) {  // D-107
  const std::string lap =
      "G1 X-49.167 Y-6.836\nG2 X8.636 Y-56.743 I3.948 J-53.855\n"
      "G3 X48.529 Y-53.819 I19.946 J1.462\nG3 X8.636 Y-56.743 I-19.946 J-1.462\n"
      "G2 X-41.271 Y-114.547 I-53.855 J-3.948\n";
  const Result outcome = run(removing, 18,
                             "G0 X-96.058 Y-31.931 F800\nG42 G1 X-81.481 Y-9.204\n" + lap +
                                 "G1 Z-2\nX-81.481 Y-9.204\n" + lap + "G40 G1 X-68.199 Y-116.521\n",
                             Verify::enforce);
  EXPECT_TRUE(outcome.whole);
  EXPECT_TRUE(outcome.diagnostics.empty());
}

// A bar of 3 mm, whose laps have few blocks, as the leads between them.
TEST(ClosingPrograms, NoLapOfASlenderBossIsALead) {  // D-57
  const std::vector<std::string> lap{
      "G3 X-6 Y-2 I-4 J0", "G1 X-40 Y-2", "G1 Y1", "G1 X40", "G1 Y-2", "G1 X-6", "G3 X-10 Y-6 J-4"};
  const Result outcome =
      run(removing, 1,
          "G0 X-4 Y-10 F800\nG41 G1 X-2 Y-6\n" + in_three_depths(lap, "X-2 Y-6") + "G40 G1 Y-10\n");
  expect_all_depths(outcome, 7);
}

// A second lap 5 um beside the first one: the way goes on there, and would leave out the first one.
TEST(ClosingPrograms, NoLapIsLeftOutForAnotherOne) {  // D-39
  const Result outcome =
      run(removing, 4,
          "N10 G0 X-5 Y-29 F500\nN20 G42 G1 X-5 Y-25\nN30 G2 X0 Y-20 I5 J0\nN40 G1 X20\nN50 Y20\n"
          "N60 X-20\nN70 Y-20\nN80 X0\nN90 X20 Y-19.995\nN100 Y20.005\nN110 X-20\n"
          "N120 Y-19.995\nN130 X0\nN140 G2 X5 Y-24.995 I0 J-5\nN150 G40 G1 X5 Y-29\n");
  EXPECT_FALSE(outcome.whole);
  EXPECT_TRUE(outcome.tells(Code::most_left_out));
}

// A bore with a slot that is too narrow for the tool, in three depths: of each lap the slot is left
// out, which are fewer blocks than lead to the next depth.
TEST(ClosingPrograms, OfEachDepthANotchMayBeLeftOut) {  // D-39
  const std::vector<std::string> lap{
      "G3 X0 Y-5 I2 J0", "G3 X0.9 Y4.918 J5",      "G1 Y14",         "G1 X-0.9",
      "G1 Y4.918",       "G3 X0 Y-5 I0.9 J-4.918", "G3 X2 Y-3 I0 J2"};
  const Result outcome =
      run(removing, 1,
          "G0 X-1 Y-2 F800\nG41 G1 X-2 Y-3\n" + in_three_depths(lap, "X-2 Y-3") + "G40 G1 X0 Y-2\n",
          Verify::enforce);
  ASSERT_TRUE(outcome.whole);
  EXPECT_TRUE(outcome.tells(Code::blocks_masked));
  const std::set<std::int64_t> travelled = outcome.travelled();
  for (int depth = 0; depth < 3; ++depth)
    for (const int block : {10, 20, 60, 70})
      EXPECT_TRUE(travelled.contains(100 * depth + block)) << depth << ' ' << block;
}

// Three quarters of the first lap and one of the second are masked under G141 alone, and the plunge
// between them would come in the midst of the wall.
TEST(ClosingPrograms, NoPlungeIsMovedByMasking) {  // D-39
  const std::string contour =
      "N10 G0 X33 Y0.3 Z0 F800\nN20 G42 G1 X31.8 Y-1.8\nN30 G2 X30 Y0 J1.8 Z-3\n"
      "N40 G3 X0 Y30 I-30\nN50 X-30 Y0 J-30\nN60 X0 Y-30 I30\nN70 X30 Y0 J30\n"
      "N80 G2 X31.4 Y1.756 I1.8\nN90 G1 Z-6\nN100 X31.797 Y-1.803\nN110 G2 X29.997 Y-0.003 J1.8\n"
      "N120 G3 X-0.003 Y29.997 I-30\nN130 X-30.003 Y-0.003 J-30\nN140 X-0.003 Y-30.003 I30\n"
      "N150 X29.997 Y-0.003 J30\nN160 G2 X31.397 Y1.753 I1.8\nN170 G40 G1 X33 Y1\n";
  const Result outcome = run("G141 G25", 1.5, contour);
  EXPECT_FALSE(outcome.whole);
  EXPECT_TRUE(outcome.tells(Code::most_left_out));
}

// About a small post masking alone goes from one depth to the next, as what leads there is too
// tight for the tool: the way round the post is short, but it is the part.
TEST(ClosingPrograms, NoLapOfASmallPostIsLeftOutWithANote) {  // D-39
  const std::string lap =
      "G3 X129.206 Y-92.601 I0.081 J-2.999\nG2 X128.226 Y-93.202 I-0.98 J0.499\n"
      "G2 X127.126 Y-92.102 J1.1\nG2 X128.226 Y-91.002 I1.1\nG2 X129.326 Y-92.102 J-1.1\n"
      "G2 X129.206 Y-92.601 I-1.1\nG3 X128.93 Y-94.516 I2.673 J-1.362\n";
  const Result outcome = run("G141 G25", 1,
                             "G0 X133.669 Y-91.918 Z0 F800\nG41 G1 X131.798 Y-90.964\n" + lap +
                                 "G1 X131.798 Y-90.964 Z-4\n" + lap + "G1 X131.798 Y-90.964 Z-6\n" +
                                 lap + "G40 G1 X130.801 Y-95.469\n");
  EXPECT_FALSE(outcome.whole);
  EXPECT_TRUE(outcome.tells(Code::most_left_out));
}

// Nearly all blocks of a contour may lie in one notch: a keyway in a bore of two arcs, a slot in a
// boss. A larger tool leaves out as much of them.
TEST(ClosingPrograms, ANotchBetweenTwoLongArcsIsNoLap) {  // D-39
  const std::string bore =
      "N10 G0 X-10 Y0 F500\nN20 G41 G1 X-20 Y0\nN30 G3 X19.843 Y-2.5 I20 J0\nN40 G1 X33\n"
      "N50 Y2.5\nN60 X19.843\nN70 G3 X-20 Y0 I-19.843 J-2.5\nN80 G40 G1 X-10 Y0\n";
  const std::string boss =
      "N10 G0 X-30 Y0 F500\nN20 G41 G1 X-20 Y0\nN30 G2 X19.843 Y2.5 I20 J0\nN40 G1 X0\n"
      "N50 Y-2.5\nN60 X19.843\nN70 G2 X-20 Y0 I-19.843 J2.5\nN80 G40 G1 X-30 Y0\n";
  for (const std::string& program : {bore, boss})
    for (const double radius : {2.6, 3.2}) {
      const Result outcome = run(removing, radius, program);
      EXPECT_TRUE(outcome.whole) << radius << '\n' << program;
      EXPECT_TRUE(outcome.tells(Code::blocks_masked)) << radius << '\n' << program;
    }
}

// Two squares outside, one after the other from the corner in which they touch: the second would be
// cut through the first.
TEST(ClosingPrograms, PartsThatTouchAreNotTakenForLaps) {  // D-57
  const std::string contour =
      "N10 G0 X30 Y-10\nN20 G41 G1 X10 Y-6 F800\nN30 X0 Y0\nN40 Y-20\nN50 X-20\nN60 Y0\nN70 X0\n"
      "N80 Y20\nN90 X20\nN100 Y0\nN110 X0\nN120 G40 G1 X-10 Y10\n";
  const Result refused = run(removing, 3, contour);
  EXPECT_FALSE(refused.whole);
  EXPECT_TRUE(refused.tells(Code::line_reversed));
  EXPECT_TRUE(run("G141 G26", 3, contour).tells(Code::bottleneck));
}

// The small part is begun with quarter circles; its neck of 10 mm is no place for the tool.
TEST(ClosingPrograms, APartThatTouchesAnotherOneStaysAWall) {  // D-57
  const std::string contour =
      "N10 G0 X48.5 Y86.5 F800\nN20 G41 G1 X48.5 Y77.5\nN30 G3 X56 Y70 I7.5 J0\nN40 G1 X64 Y70\n"
      "N50 Y40\nN60 X40\nN70 Y0\nN80 X0\nN90 Y40\nN100 X40\nN110 Y70\nN120 X43\nN130 Y67\n"
      "N140 G3 X53 Y67 I5 J-4.1533\nN150 G1 Y70\nN160 X56\nN170 G3 X63.5 Y77.5 I0 J7.5\n"
      "N180 G40 G1 X63.5 Y86.5\n";
  const Result outcome = run(removing, 6, contour);
  ASSERT_TRUE(outcome.whole);
  EXPECT_GE(outcome.clearance_to(
                {Line{Point(43, 70), Point(43, 67)}, Line{Point(53, 67), Point(53, 70)}}),
            6 - 1e-6);
  EXPECT_TRUE(outcome.tells(Code::blocks_masked));
}

// Of the chords of a pocket in four decimals many have no path beside them, and nothing is left
// standing there (D-44): there is nothing to tell.
TEST(ClosingPrograms, ChordsBelowTheResolutionAreNotTold) {
  const auto pocket = [](int chords) {
    std::string contour = "N1 G0 X3 Y0\nN2 G41 G1 X10 Y0 F500\n";
    for (int i = 1; i <= chords; ++i) {
      const double angle = 2 * std::numbers::pi * i / chords;
      std::array<char, 80> line{};
      std::snprintf(line.data(), line.size(), "N%d G1 X%.4f Y%.4f\n", i + 2, 10 * std::cos(angle),
                    10 * std::sin(angle));
      contour += line.data();
    }
    return contour + "N899 G40 G1 X3 Y0\n";
  };
  const Result fine = run(removing, 6, pocket(10'000));
  ASSERT_TRUE(fine.whole);
  EXPECT_LT(fine.travelled().size(), 9'000U);
  EXPECT_FALSE(fine.tells(Code::blocks_masked));
}

// Where the last wall is deeper than the first one, or less deep, an arc or a line that leads out
// or in crosses a wall: the contour does not close there, and that is told.
TEST(ClosingPrograms, AStepBetweenTheLastWallAndTheFirstIsTold) {  // D-38
  for (const double step : {0.02, 0.1, 0.5, 0.9, 1.0, -0.02, -0.1, -0.5, -0.9}) {
    for (const bool arcs : {true, false}) {
      const std::string y = std::to_string(-step);
      const std::string out = std::to_string(2 - step);
      const std::string contour =
          std::string("N1 G162 G0 X-1 Y3 F800\nN2 G138 G26 G41 G1 X-2 Y2\n") +
          (arcs ? "N3 G3 X0 Y0 I2 J0\n" : "N3 X0 Y0\n") + "N4 G1 X6\nN5 Y12\nN6 X-6\nN7 Y" + y +
          "\nN8 X0\nN9 " + (arcs ? "G3 X2 Y" + out + " I0 J2\n" : "X2 Y" + out + "\n") +
          "N10 G40 G1 X1 Y3\n";
      const Result outcome = run(removing, 1, contour);
      const bool is_told = std::ranges::any_of(outcome.diagnostics, [](const Diagnostic& told) {
        return told.severity != Severity::note;
      });
      EXPECT_TRUE(!outcome.whole || is_told) << "step " << step << (arcs ? ", arcs" : ", lines");
    }
  }
}

// The last wall misses the start, and goes on beside the first walls, in the material, until it
// crosses one of them: they are not lead-in for that, which would be cut without a word.
TEST(ClosingPrograms, AnOverrunBesideTheFirstWallsIsTold) {  // D-96
  for (const double step : {0.02, 0.1, 0.2}) {
    const std::string y = std::to_string(step);
    const std::string contour =
        "N1 G162 G0 X-6 Y-9 F800\nN2 G138 G42 G26 G1 X0 Y0\nN3 X10 Y0\nN4 X20 Y0.5\n"
        "N5 X30 Y2\nN6 X40 Y40\nN7 X0 Y40\nN8 Y" +
        y + "\nN9 X38 Y1.5\nN10 G40 G1 X42 Y-9\n";
    const Result measured = run("G140", 3, contour, Verify::report);
    EXPECT_TRUE(measured.tells(Code::clearance_violated)) << "step " << step;
    EXPECT_TRUE(run(removing, 3, contour).tells(Code::most_left_out)) << "step " << step;
  }
}

// The same contour the other way round.
TEST(ClosingPrograms, ALeadInBesideTheLastWallsIsTold) {  // D-96
  for (const double step : {0.02, 0.1, 0.2}) {
    const std::string y = std::to_string(step);
    const std::string contour =
        "N1 G162 G0 X42 Y-9 F800\nN2 G138 G41 G26 G1 X38 Y1.5\nN3 X0 Y" + y +
        "\nN4 Y40\nN5 X40\nN6 X30 Y2\nN7 X20 Y0.5\nN8 X10 Y0\nN9 X0\nN10 G40 G1 X-6 Y-9\n";
    const Result measured = run("G140", 3, contour, Verify::report);
    EXPECT_TRUE(measured.tells(Code::clearance_violated)) << "step " << step;
    EXPECT_TRUE(run(removing, 3, contour).tells(Code::most_left_out)) << "step " << step;
  }
}

// Hand-written programs begin beyond a corner and go on beyond it: they close where both cross.
TEST(ClosingPrograms, LinesThatGoOnBeyondACornerCloseThere) {  // D-38
  const std::string contour =
      "N1 G0 X-20 Y0 F800\nN2 G138 G26 G42 G1 X-12 Y-8\nN3 X-8 Y0\nN4 X15\nN5 Y15\nN6 X0\n"
      "N7 Y-6\nN8 G40 X-10 Y-10\n";
  const Result outcome = run(removing, 5, contour);
  ASSERT_TRUE(outcome.whole);
  EXPECT_TRUE(outcome.diagnostics.empty());
}

// CAM systems write the arc that leads in as chords, the last of which are nearly on the wall.
TEST(ClosingPrograms, ALeadOfChordsEndsWhereTheWallBegins) {  // D-38
  for (const double radius : {0.1, 0.5, 1.0, 2.0, 5.0})
    for (const int chords : {8, 20, 40, 90}) {
      const double size = 12 * radius;
      std::string contour =
          "N1 G162 G0 X0 Y" + std::to_string(size / 2) + " F800\nN2 G138 G26 G41 G1";
      for (int chord = 0; chord <= chords; ++chord) {
        const double angle = std::numbers::pi / 2 * (1 - static_cast<double>(chord) / chords);
        std::array<char, 80> line{};
        std::snprintf(line.data(), line.size(), "%s X%.3f Y%.3f\n", chord == 0 ? "" : "G1",
                      -2 * radius * std::sin(angle), 2 * radius * (1 - std::cos(angle)));
        contour += line.data();
      }
      const std::string right = std::to_string(size / 2);
      contour += "G1 X" + right + "\nY" + std::to_string(size) + "\nX-" + right + "\nY0\nX0\n" +
                 "G3 X" + std::to_string(2 * radius) + " Y" + std::to_string(2 * radius) + " I0 J" +
                 std::to_string(2 * radius) + "\nG40 G1 X0 Y" + right + "\n";
      const Result outcome = run(removing, radius, contour);
      EXPECT_TRUE(outcome.whole) << "R " << radius << ", " << chords << " chords";
    }
}

// A pocket of chords, entered and left at one of its corners: what the kink there costs is below
// the resolution of the input.
// A line that is hardly there takes as much of the one before it as the corner after it needs: not
// with the third axis, at another feed or at rapid, which have their place. Refused as ever.
TEST(ClosingPrograms, WhatALineHardlyThereDoesKeepsItsPlace) {  // D-44
  const auto corner = [](const std::string& before, const std::string& behind) {
    return "N1 G0 X-10 Y-10 F800\nN2 G41 G1 X0 Y0\nN3 X20\n" + before + "X19.9992 Y0.0004" +
           behind + "\nG1 F800 X20 Y30\nG40 X40\n";
  };
  EXPECT_TRUE(run("G140", 3, corner("N4 ", "")).whole);
  for (const char* behind : {" Z-5", " F50"}) {
    const Result outcome = run("G140", 3, corner("N4 ", behind));
    EXPECT_TRUE(outcome.tells(Code::line_reversed)) << behind;
  }
  EXPECT_TRUE(run("G140", 3, corner("N4 G0 ", "")).tells(Code::line_reversed));
}

TEST(ClosingPrograms, APocketOfChordsMayBeEnteredAtACorner) {  // D-44
  for (const int chords : {300, 360, 720}) {
    std::string contour = "N1 G0 X10 Y0 F800\nN2 G139 G41 G1 X20 Y0\n";
    std::vector<Segment> walls;
    Point from(20, 0);
    for (int chord = 1; chord <= chords; ++chord) {
      const double angle = 2 * std::numbers::pi * chord / chords;
      const Point to(std::round(20'000 * std::cos(angle)) / 1'000,
                     std::round(20'000 * std::sin(angle)) / 1'000);
      contour += "X" + std::to_string(to.x()) + " Y" + std::to_string(to.y()) + "\n";
      walls.emplace_back(Line{from, to});
      from = to;
    }
    const Result outcome = run(removing, 3, contour + "G40 G1 X10 Y0\n");
    ASSERT_TRUE(outcome.whole) << chords << " chords";
    EXPECT_NEAR(outcome.clearance_to(walls), 3, 0.001) << chords << " chords";
  }
}

// A post of 2 mm as ten chords, counter-clockwise, with what leads to it and from it. Its path
// keeps clear of it, and goes round all of it.
class Post {
 public:
  static Point corner(int number) {
    const double angle = 2 * std::numbers::pi * number / 10;
    return {std::cos(angle), std::sin(angle)};
  }
  static Point beyond(int number, const Vector& by) { return corner(number) + by; }
  static std::string to(const Point& point) {
    std::array<char, 80> words{};
    std::snprintf(words.data(), words.size(), " X%.3f Y%.3f\n", point.x(), point.y());
    return words.data();
  }

  Post(const std::vector<Point>& in, const std::vector<Point>& out) {
    program_ = "N1 G0" + to(in.front() + Vector(2, -1)) + "G138 F800 G42 G1" + to(in.front());
    for (std::size_t point = 1; point < in.size(); ++point) program_ += to(in[point]);
    for (int side = 1; side <= 10; ++side)
      program_ += "N" + std::to_string(100 + side) + to(corner(side));
    for (const Point& point : out) program_ += "N200" + to(point);
    program_ += "G40" + to(out.back() + Vector(1, 3));
  }

  [[nodiscard]] const std::string& program() const { return program_; }
  void expect_all_of_it(const std::string& modes) const {
    std::vector<Segment> walls;
    for (int side = 0; side < 10; ++side) walls.emplace_back(Line{corner(side), corner(side + 1)});
    const Result outcome = run(modes, 2.5, program_, Verify::enforce);
    EXPECT_TRUE(outcome.whole) << program_;
    EXPECT_TRUE(outcome.diagnostics.empty()) << program_;
    const std::set<std::int64_t> travelled = outcome.travelled();
    for (int side = 1; side <= 10; ++side)
      EXPECT_TRUE(travelled.contains(100 + side)) << program_ << side;
    EXPECT_GE(outcome.clearance_to(walls), 2.499) << program_;
  }

 private:
  std::string program_;
};

// What leads out goes along the first sides once more, and straight on.
TEST(ClosingPrograms, LeadsLongerThanAPostMayGoAlongIt) {  // D-38
  for (const double in : {1.0, 3.0, 8.0})
    for (const double out : {1.0, 3.0})
      for (const int overrun : {0, 1, 2})
        for (const double part : {0.0, 0.3}) {
          const Vector first = Post::corner(1) - Post::corner(0);
          const Vector last = Post::corner(overrun + 1) - Post::corner(overrun);
          std::vector<Point> end;
          for (int side = 1; side <= overrun; ++side) end.push_back(Post::corner(side));
          if (part > 0) end.push_back(Post::beyond(overrun, part * last));
          end.push_back(Post::beyond(overrun, part * last + out * last.normalized()));
          const Post post({Post::beyond(0, -in * first.normalized()), Post::corner(0)}, end);
          for (const char* modes : {removing, "G140 G26"}) post.expect_all_of_it(modes);
        }
}

// Lines aslant, which cross beside it; and quarter circles of 5 mm that CAM has made chords of.
TEST(ClosingPrograms, LeadsLongerThanAPostMayCrossOrBeChords) {  // D-38, D-98
  const Post aslant({Post::beyond(0, Vector(6, -6)), Post::corner(0)},
                    {Post::beyond(0, Vector(6, 6))});
  for (const char* modes : {removing, "G140 G26"}) aslant.expect_all_of_it(modes);
  const Post without_lead_in({Post::corner(0)}, {Post::beyond(0, Vector(-1, 6))});
  for (const char* modes : {removing, "G140 G26"}) without_lead_in.expect_all_of_it(modes);
  std::vector<Point> in;
  std::vector<Point> out;
  for (int chord = 0; chord <= 8; ++chord) {
    const double angle = std::numbers::pi / 16 * chord;
    out.push_back(Post::beyond(0, 5 * Vector(1 - std::cos(angle), std::sin(angle))));
    in.insert(in.begin(), Post::beyond(0, 5 * Vector(1 - std::cos(angle), -std::sin(angle))));
  }
  out.erase(out.begin());
  for (const char* modes : {removing, "G140 G26"}) Post(in, out).expect_all_of_it(modes);
}

// The finishing lap rounds the corners of the roughing lap. Where the first lap ends is within a
// block, of which the start belongs to that lap.
TEST(ClosingPrograms, ALapMayEndWithinABlock) {  // D-100
  const std::string finishing =
      "G2 X10 Y50 R10\nG1 X70\nG2 X80 Y40 R10\nG1 Y10\nG2 X70 Y0 R10\nG1 X10\nG2 X0 Y10 R10\n";
  const std::string with_leads =
      "G0 X-30 Y25 F300\nG41 G1 X-12 Y17\nG3 X0 Y25 R10\nG1 Y50\nX80\nY0\nX0\nN100 Y40\n" +
      finishing + "G1 Y25\nG3 X-10 Y35 R10\nG40 G1 X-30\n";
  const std::string without = "G0 X-30 Y-30 F300\nG41 G1 X0\nY50\nX80\nY0\nX0\nN100 Y40\n" +
                              finishing + "G1 Y20\nG40 X-30\n";
  for (const std::string& contour : {with_leads, without})
    for (const char* modes : {removing, "G140 G26"}) {
      const Result outcome = run(modes, 4, contour, Verify::enforce);
      EXPECT_TRUE(outcome.whole) << contour;
      EXPECT_TRUE(outcome.diagnostics.empty()) << contour;
      EXPECT_TRUE(outcome.travelled().contains(100)) << contour;
    }
}

// A bore in circles of 9.75 mm; half circles lead to the finishing circle of 10 mm and back,
// however often it was roughed.
TEST(ClosingPrograms, AFinishingLapMayHaveLeadsOfItsOwn) {  // D-100
  for (int laps = 1; laps <= 4; ++laps) {
    std::string contour = "G162 G0 X2 Y2 F300\nG41 G1 X0 Y9.75\n";
    for (int lap = 0; lap < laps; ++lap) contour += "G3 X0 Y9.75 I0 J-9.75\n";
    contour += "G3 X0 Y-10 I0 J-9.875\nG3 X0 Y-10 I0 J10\nG3 X0 Y9.75 I0 J9.875\nG40 G1 X5 Y5\n";
    for (const char* modes : {removing, "G140 G26"}) {
      const Result outcome = run(modes, 6.35, contour, Verify::enforce);
      EXPECT_TRUE(outcome.whole) << laps;
      EXPECT_TRUE(outcome.diagnostics.empty()) << laps;
    }
  }
}

// The last wall ends so much deeper than the first one begins. Rounding makes up to 4 um.
TEST(ClosingPrograms, AContourThatDoesNotQuiteCloseIsTold) {  // D-101
  for (const double step : {0.001, 0.003, 0.005, 0.009}) {
    const std::string y = std::to_string(-step);
    const Result outcome =
        run(removing, 1,
            "N1 G162 G0 X-1 Y3 F800\nN2 G138 G26 G41 G1 X-2 Y2\nN3 G3 X0 Y0 I2 J0\nN4 G1 X6\n"
            "N5 Y12\nN6 X-6\nN7 Y" +
                y + "\nN8 X0\nN9 G3 X2 Y" + std::to_string(2 - step) + " I0 J2\nN10 G40 G1 X1 Y3\n",
            Verify::enforce);
    ASSERT_TRUE(outcome.whole) << step;
    ASSERT_EQ(outcome.diagnostics.size(), step > 0.004 ? 1U : 0U) << step;
    if (outcome.diagnostics.empty()) continue;
    const Diagnostic& told = outcome.diagnostics.front();
    EXPECT_EQ(told.code, Code::bottleneck);
    EXPECT_EQ(told.severity, Severity::warning);
    EXPECT_NEAR(told.values.front().value, 1 - step, 1e-5);
  }
}

}  // namespace
}  // namespace trc
