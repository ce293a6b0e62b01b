#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/program_run.h"

// A window of any length gives the path of the whole contour (D-10, D-158): closed contours with
// leads and laps, and without anything to remove.

namespace trc::support {
namespace {

enum class Leads { arcs, square_lines };
enum class Depth { one, plunges, ramps };

// An ellipse of chords that begins in the middle of one, with the tool left of it.
struct LedRing {
  std::size_t chords = 0;
  bool inside = true;  // the tool
  Leads leads = Leads::arcs;
  std::size_t laps = 1;
  Depth depth = Depth::one;

  [[nodiscard]] std::size_t blocks() const { return laps * (chords + 1) + 2; }
  [[nodiscard]] std::string text(const std::string& modes) const;
};

std::string words(double x, double y) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), " X%.3f Y%.3f", x, y);
  return text.data();
}

std::string LedRing::text(const std::string& modes) const {
  const double direction = inside ? 1 : -1;
  std::vector<Point> corners;
  for (std::size_t corner = 0; corner < chords; ++corner) {
    const double angle =
        2 * std::numbers::pi * (static_cast<double>(corner) + 0.5) / static_cast<double>(chords);
    corners.emplace_back(50 * std::cos(angle), direction * 30 * std::sin(angle));
  }
  const double begin = (corners.front().x() + corners.back().x()) / 2;
  const double beside = begin - direction * 6;
  const std::string center = std::string(" I") + (inside ? "-6" : "6");
  std::string program = "V.G.WZ_AKT.R=3\nG26 " + modes + "\nG0" + words(begin - direction * 12, 0) +
                        " Z0\nG138 G41 G1";
  if (leads == Leads::arcs)
    program += words(beside, -direction * 6) + " F500\nG3" + words(begin, 0) + " J" +
               (inside ? "6" : "-6");
  else
    program += words(beside, 0) + " F500\nG1" + words(begin, 0);
  for (std::size_t lap = 1; lap <= laps; ++lap) {
    const std::string deeper = " Z-" + std::to_string(lap);
    program += "\nG1";
    if (depth == Depth::plunges) program += deeper + "\nG1";
    for (std::size_t corner = 0; corner < chords; ++corner)
      program += words(corners[corner].x(), corners[corner].y()) +
                 (depth == Depth::ramps && corner == 0 ? deeper : "") + "\n";
    program += words(begin, 0);
  }
  program += leads == Leads::arcs ? "\nG3" + words(beside, direction * 6) + center
                                  : "\nG1" + words(beside, 0);
  return program + "\nG40 G1" + words(begin - direction * 12, 0) + "\nM30\n";
}

std::vector<LedRing> led_rings(std::size_t most_blocks) {
  std::vector<LedRing> rings;
  for (const std::size_t chords : {6U, 9U, 24U, 57U})
    for (const bool inside : {true, false})
      for (const Leads leads : {Leads::arcs, Leads::square_lines})
        for (const std::size_t laps : {1U, 2U, 3U, 5U})
          for (const Depth depth : {Depth::one, Depth::plunges, Depth::ramps}) {
            const LedRing ring{chords, inside, leads, laps, depth};
            if (ring.blocks() <= most_blocks && (laps > 1 || depth == Depth::one))
              rings.push_back(ring);
          }
  return rings;
}

// All that is told but that the contour is longer than the window.
std::string report_of(const ProgramRun& run) {
  ProgramRun told = run;
  std::erase_if(told.diagnostics, [](const Diagnostic& diagnostic) {
    return diagnostic.code == Code::beyond_window;
  });
  return told.report();
}

void expect_path_of_the_whole(const std::string& modes, SessionSetup setup) {
  std::size_t compared = 0;
  for (const LedRing& ring : led_rings(180)) {
    const std::string text = ring.text(modes);
    setup.compensator.limits.look_ahead_blocks = 0;
    const ProgramRun whole = to_blocks(text, {.session = setup}, 0, German::as_it_is);
    // Square leads take the tool off a first chord that is shorter than its radius.
    if (!report_of(whole).empty()) continue;
    const std::size_t step = 1 + ring.blocks() / 40;
    for (std::size_t window = 3; window <= 2 * ring.blocks(); window += step) {
      setup.compensator.limits.look_ahead_blocks = window;
      const ProgramRun seen = to_blocks(text, {.session = setup}, 0, German::as_it_is);
      ASSERT_EQ(report_of(seen), "") << "window " << window << '\n' << text;
      ASSERT_EQ(seen.listing(), whole.listing()) << "window " << window << '\n' << text;
      ++compared;
    }
  }
  EXPECT_GT(compared, 1'000U);
}

TEST(WindowOverLeads, LeavesOutNothing) {
  expect_path_of_the_whole("G141\n#TRC[REMOVE_MASKED_BLOCKS=1]", {});
}

TEST(WindowOverLeads, ShowsNoBottleneck) { expect_path_of_the_whole("G141", {}); }

TEST(WindowOverLeads, RefusesNoBottleneck) {
  SessionSetup implicit;
  implicit.compensator.implicit_contour_masking = true;
  expect_path_of_the_whole("G140", implicit);
}

// What a program gives up to a lap that its window has not shown whole is refused, or there.
TEST(WindowOverLeads, LosesNoLapOfOtherDepthWithoutAnError) {
  SessionSetup setup;
  for (const LedRing& ring : led_rings(180)) {
    if (ring.depth != Depth::plunges) continue;
    const std::string text = ring.text("G141\n#TRC[REMOVE_MASKED_BLOCKS=1]");
    for (std::size_t window = 1; window <= 2 * ring.blocks(); window += 1 + ring.blocks() / 20) {
      setup.compensator.limits.look_ahead_blocks = window;
      const ProgramRun seen = to_blocks(text, {.session = setup}, 0, German::as_it_is);
      if (seen.stopped) continue;
      const auto moves = moving(seen.blocks);
      EXPECT_GE(moves.size(), ring.laps * ring.chords) << "window " << window << '\n' << text;
    }
  }
}

}  // namespace
}  // namespace trc::support
