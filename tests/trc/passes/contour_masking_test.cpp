#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <variant>

#include "core/session/program_session.h"
#include "tests/support/program_run.h"

// G141 alone: what is joined anew over masked blocks, and what that leaves out (D-39, D-153).

namespace trc::support {
namespace {

std::string word(char letter, double value, int decimals) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%c%.*f", letter, decimals, value);
  return text.data();
}

// A bore or a disc of 20 mm about the origin, which begins opposite to a keyway that is narrower
// than the tool: two arcs that are one circle but for the rounding of their ends.
struct Keyway {
  bool bore = false;
  double half_width = 1;
  double turned = 0;  // rad
  int decimals = 3;

  [[nodiscard]] std::string program() const {
    constexpr double radius = 20;
    const double angle = std::asin(half_width / radius);
    const double bottom = bore ? 23 : 17;
    const auto at = [&](double distance, double along) {
      return Point{distance * std::cos(along + turned), distance * std::sin(along + turned)};
    };
    const auto words = [&](const Point& point) {
      return word('X', point.x(), decimals) + word('Y', point.y(), decimals);
    };
    const auto arc = [&](const Point& start) {
      return word('I', -start.x(), decimals) + word('J', -start.y(), decimals);
    };
    const double pi = std::acos(-1.0);
    // Counter-clockwise in a bore, clockwise round a disc: the tool is left of both.
    const double side = bore ? 1 : -1;
    const Point begin = at(radius, pi);
    const Point before = at(radius, -side * angle);
    const Point after = at(radius, side * angle);
    const double beside = std::asin(half_width / bottom);
    const std::string lead = words(at(bore ? 8 : 40, pi));
    return "N1 G17 G71 G90 G162 G26 G141\nN2 G0 " + lead + "\nN3 G138 G41 G1 " + words(begin) +
           " F500\nN4 " + (bore ? "G3 " : "G2 ") + words(before) + arc(begin) + "\nN5 G1 " +
           words(at(bottom, -side * beside)) + "\nN6 " + words(at(bottom, side * beside)) +
           "\nN7 " + words(after) + "\nN8 " + (bore ? "G3 " : "G2 ") + words(begin) + arc(after) +
           "\nN9 G40 G1 " + lead + "\nN10 M30\n";
  }
};

double turn_of(const Outcome& outcome) {
  double turn = 0;
  for (const CompensatedBlock& block : outcome.blocks)
    if (const auto* arc = std::get_if<Arc>(&block.path)) turn += arc->sweep;
  return turn;
}

Outcome compensated(const std::string& program, double radius) {
  ProgramSessionSetup setup;
  setup.session.program.tool_radius = radius;
  return to_blocks(program, setup);
}

TEST(ContourMasking, GoesOnOverAKeywayInARoundedCircle) {  // D-44, D-153
  for (const bool bore : {false, true})
    for (const int decimals : {3, 4, 5, 6, 8})
      for (int turned = 0; turned < 24; ++turned) {
        const Keyway keyway{.bore = bore,
                            .half_width = 0.8 + 0.05 * (turned % 7),
                            .turned = 0.26 * turned,
                            .decimals = decimals};
        const Outcome outcome = compensated(keyway.program(), 3);
        ASSERT_FALSE(outcome.stopped) << keyway.program();
        EXPECT_EQ(first_gap(outcome.blocks), "");
        EXPECT_NEAR(std::abs(turn_of(outcome)), 2 * std::acos(-1.0), 0.02) << keyway.program();
      }
}

// The blocks beside the masked ones meet where the contour closes: nothing of them would be left.
TEST(ContourMasking, DoesNotCutOffTheBlocksBesideWhatIsMasked) {  // D-39
  const std::string program =
      "N20 G0 X4.257 Y-0.938\nN30 G26 G141\nN40 G41 G237 F1000\nN50 G1 X9.77 Y-2.061\n"
      "N140 X5.21 Y-5.525\nN150 X5.156 Y-5.26\nN190 X4.257 Y-5.858\n"
      "N200 G2 X4.257 Y-0.938 I-0.501 J2.46\nN210 G40\nN220 G0 X4.4266 Y-0.1051\nN230 M30\n";
  const Outcome outcome = compensated(program, 0.5);
  ASSERT_TRUE(outcome.error());
  EXPECT_EQ(outcome.error()->code, Code::most_left_out);
}

// Nothing is before it that could be joined anew.
TEST(ContourMasking, RefusesAFirstArcAsSmallAsTheTool) {  // D-11, D-18
  for (const std::string select : {"G0 X0 Y0\nG237 G41\n", "G138 G41 G1 X0 Y0 F500\n"})
    for (const double radius : {2.49995, 2.5, 2.50005}) {
      const Outcome outcome = compensated("G162 G26 G141\nG0 X0 Y2\n" + select +
                                              "G3 X2.5 Y2.5 I0 J2.5 F800\nG1 Y13\nX-20\n"
                                              "G40\nX0 Y20\nM30\n",
                                          radius);
      ASSERT_TRUE(outcome.error());
      EXPECT_EQ(outcome.error()->code, Code::tool_not_smaller_than_arc) << select << radius;
    }
}

}  // namespace
}  // namespace trc::support
