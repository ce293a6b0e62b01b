#include "core/nc/state/circle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace trc {
namespace {

constexpr double pi = std::numbers::pi;
const CircleCheck initial{};

Arc arc_of(const CircleResult& result) {
  const Arc* arc = std::get_if<Arc>(&result);
  EXPECT_NE(arc, nullptr);
  return arc == nullptr ? Arc{} : *arc;
}

Code code_of(const CircleResult& result) {
  const CircleFault* fault = std::get_if<CircleFault>(&result);
  return fault == nullptr ? Code{} : fault->code;
}

double value_of(const CircleResult& result, std::string_view name) {
  const CircleFault* fault = std::get_if<CircleFault>(&result);
  if (fault != nullptr)
    for (const DiagnosticValue& value : fault->values)
      if (value.name == name) return value.value;
  return std::nan("");
}

CircleResult about(const Point& center, const Point& start, const Point& end, bool clockwise,
                   const CircleCheck& check = initial, ArcUse use = ArcUse::as_programmed) {
  return arc_about(center, {.start = start, .end = end, .clockwise = clockwise}, check, use, {});
}

CircleResult of_radius(double radius, const Point& start, const Point& end, bool clockwise) {
  return arc_of_radius(radius, {.start = start, .end = end, .clockwise = clockwise}, initial, {});
}

TEST(CircleAboutACentre, TurnsTheWayItIsProgrammed) {
  EXPECT_DOUBLE_EQ(arc_of(about({0, 0}, {10, 0}, {0, 10}, false)).sweep, pi / 2);
  EXPECT_DOUBLE_EQ(arc_of(about({0, 0}, {10, 0}, {0, 10}, true)).sweep, -1.5 * pi);
  EXPECT_DOUBLE_EQ(arc_of(about({0, 0}, {10, 0}, {-10, 0}, false)).sweep, pi);
  EXPECT_DOUBLE_EQ(arc_of(about({0, 0}, {10, 0}, {-10, 0}, true)).sweep, -pi);
}

TEST(CircleAboutACentre, KeepsACentreThatFitsAsItIs) {
  EXPECT_EQ(arc_of(about({0.1, 0.2}, {10.1, 0.2}, {0.1, 10.2}, false)).center, Point(0.1, 0.2));
}

TEST(CircleAboutACentre, IsFullWhenStartAndEndAreOnePoint) {
  const Arc ccw = arc_of(about({5, 0}, {0, 0}, {0, 0}, false));
  EXPECT_EQ(ccw.sweep, 2 * pi);
  EXPECT_EQ(ccw.end, ccw.start);
  EXPECT_EQ(arc_of(about({5, 0}, {0, 0}, {0, 0}, true)).sweep, -2 * pi);
}

// Rounding noise on either side of the start must not decide between a full
// circle and none.
TEST(CircleAboutACentre, IsFullOnBothSidesOfTheStartUpToOnePoint) {
  for (const double noise : {1e-15, 1e-12, 1e-9, 9e-7}) {
    for (const double sign : {-1.0, 1.0}) {
      for (const bool clockwise : {false, true}) {
        const Arc arc = arc_of(about({10, 0}, {0, 0}, {0, sign * noise}, clockwise));
        EXPECT_EQ(arc.sweep, clockwise ? -2 * pi : 2 * pi) << sign * noise;
        EXPECT_EQ(arc.end, Point(0, 0));
      }
    }
  }
}

TEST(CircleAboutACentre, BeyondOnePointTheSideOfTheEndDecides) {
  constexpr double step = 1e-4;  // along the circle, from its rightmost point upwards
  const Point start(10, 0);
  const Point ahead(10 * std::cos(step / 10), 10 * std::sin(step / 10));
  const Point behind(10 * std::cos(step / 10), -10 * std::sin(step / 10));
  EXPECT_NEAR(arc_of(about({0, 0}, start, ahead, false)).sweep, step / 10, 1e-12);
  EXPECT_NEAR(arc_of(about({0, 0}, start, behind, false)).sweep, 2 * pi - step / 10, 1e-12);
}

TEST(CircleAboutACentre, WithoutRadiusIsRefused) {
  EXPECT_EQ(code_of(about({3, 4}, {3, 4}, {10, 0}, false)), Code::circle_radius_zero);
  EXPECT_EQ(code_of(about({3, 4}, {3, 4}, {3, 4}, false)), Code::circle_radius_zero);
}

TEST(CircleCentreCorrection, PutsTheCentreOnThePerpendicularBisector) {
  const Arc arc = arc_of(about({10.3, 0.7}, {0, 0}, {20, 0}, false));
  EXPECT_NEAR(arc.center.x(), 10, 1e-12);
  EXPECT_NEAR(arc.center.y(), 0.7, 1e-12);
}

TEST(CircleCentreCorrection, MakesBothRadiiEqualAndMovesByTheNamedShift) {
  constexpr unsigned seed = 7;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(-500, 500);
  std::uniform_real_distribution<double> offset(-0.5, 0.5);
  int corrected = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Point center(coordinate(random), coordinate(random));
    const Point start(coordinate(random), coordinate(random));
    const double turn = coordinate(random);
    const Vector spoke = start - center;
    const Vector turned(std::cos(turn) * spoke.x() - std::sin(turn) * spoke.y(),
                        std::sin(turn) * spoke.x() + std::cos(turn) * spoke.y());
    const Point end = center + turned + Vector(offset(random), offset(random));
    const CircleResult result = about(center, start, end, i % 2 == 0);
    if (const CircleFault* fault = std::get_if<CircleFault>(&result)) {
      EXPECT_EQ(fault->code, Code::circle_center_misfit);
      const double smallest =
          std::min({value_of(result, "start_radius"), value_of(result, "end_radius"),
                    value_of(result, "corrected_radius")});
      const double shift = value_of(result, "center_shift");
      if (smallest < 20) {
        EXPECT_GT(shift, 0.05 * smallest);
      } else {
        EXPECT_GT(shift, 2);
        EXPECT_GT(shift, 0.05 * value_of(result, "corrected_radius"));
      }
      continue;
    }
    ++corrected;
    const Arc& arc = std::get<Arc>(result);
    EXPECT_EQ(arc.start, start);
    EXPECT_EQ(arc.end, end);
    EXPECT_NEAR((arc.start - arc.center).norm(), (arc.end - arc.center).norm(), 1e-9);
    EXPECT_GT(std::abs(arc.sweep), 0);
    EXPECT_LE(std::abs(arc.sweep), 2 * pi);
    // The shift runs along the chord: no point of the bisector is nearer.
    const Vector shift = arc.center - center;
    EXPECT_NEAR(cross(shift, (arc.end - arc.start).normalized()), 0, 1e-9);
  }
  EXPECT_GT(corrected, 15'000);
}

// T-04: the numbers of the worked example of G239 with a circle after G40.
TEST(CircleCentreCorrection, RefusesTheMisfitOfTheWorkedExample) {
  const CircleResult result = about({90, 0}, {90, 50}, {140, -30}, true);
  EXPECT_EQ(code_of(result), Code::circle_center_misfit);
  EXPECT_NEAR(value_of(result, "center_shift"), 4.770, 5e-4);
  EXPECT_NEAR(value_of(result, "corrected_radius"), 54.104, 5e-4);
  EXPECT_NEAR(value_of(result, "start_radius"), 50, 1e-12);
  EXPECT_NEAR(value_of(result, "end_radius"), 58.31, 5e-3);
}

// Radii that differ by 1.5 um: along a chord of 7 um that is a shift of 0.14 mm.
TEST(CircleCentreCorrection, OfAShortArcIsJudgedByWhatItDoesToTheArc) {
  const Point start(10, 0);
  const Point end(10.007, 0.001);
  const Arc arc = arc_of(about({10.053, 0.65}, start, end, false));
  EXPECT_NEAR(arc.center.x(), 9.9136, 1e-4);
  EXPECT_NEAR(arc.center.y(), 0.6301, 1e-4);
  EXPECT_NEAR(width_about({10.053, 0.65}, arc), 1.53e-3, 1e-5);
  // An end that is off by more than three digits.
  EXPECT_EQ(code_of(about({10.053, 0.65}, start, {10.007, 0.004}, false)),
            Code::circle_center_misfit);
  // For an arc of almost a whole turn the whole arc would be shifted.
  EXPECT_EQ(code_of(about({10.053, 0.65}, start, end, true)), Code::circle_center_misfit);
  // Four decimals of an inch.
  CircleCheck inch;
  inch.last_digit = last_digit(LengthUnit::inch);
  EXPECT_GT(arc_of(about({10.053, 0.65}, start, {10.007, 0.004}, false, inch)).sweep, 0);
}

TEST(CircleCentreCorrection, RefusesOnlyBeyondBothLimitsFromTwentyMillimetresOn) {
  // Radius 100: a shift of 4 is more than 2 mm but less than 5 %.
  EXPECT_EQ(code_of(about({4, -60}, {-80, 0}, {80, 0}, true)), Code{});
  // Radius 30: a shift of 1.8 is more than 5 % but less than 2 mm.
  EXPECT_EQ(code_of(about({1.8, -18}, {-24, 0}, {24, 0}, true)), Code{});
  // Radius 30: a shift of 2.5 is more than either.
  EXPECT_EQ(code_of(about({2.5, -18}, {-24, 0}, {24, 0}, true)), Code::circle_center_misfit);
}

TEST(CircleCentreCorrection, AllowsFivePercentOfSmallArcs) {
  EXPECT_EQ(code_of(about({0.4, -6}, {-8, 0}, {8, 0}, true)), Code{});
  const CircleResult refused = about({1.5, -6}, {-8, 0}, {8, 0}, true);
  EXPECT_EQ(code_of(refused), Code::circle_center_misfit);
  EXPECT_NEAR(value_of(refused, "largest_shift"), 0.05 * std::hypot(6.5, 6), 1e-9);
  // The programmed radius counts: an arc of 1 mm is no arc of 5 mm.
  EXPECT_EQ(code_of(about({0.9, 0}, {0, 0}, {5, 5}, true)), Code::circle_center_misfit);
  // Three decimals of the smallest arcs.
  EXPECT_EQ(code_of(about({0.0104, 0}, {0, 0}, {0.02, 0}, true)), Code{});
}

TEST(CircleWithoutCorrection, RefusesRadiiThatDifferTooMuch) {
  const CircleCheck g164{.correct_center = false};
  const CircleResult result = about({0, 0}, {50, 0}, {0, 50.2}, false, g164);
  EXPECT_EQ(code_of(result), Code::circle_radii_differ);
  EXPECT_EQ(value_of(result, "start_radius"), 50);
  EXPECT_EQ(value_of(result, "end_radius"), 50.2);
  EXPECT_EQ(value_of(result, "largest_difference"), 0.1);
  // For a small circle one percent of its radius counts.
  EXPECT_EQ(code_of(about({0, 0}, {5, 0}, {0, 5.06}, false, g164)), Code::circle_radii_differ);
}

TEST(CircleWithoutCorrection, ASpiralHasNoEquidistant) {
  const CircleCheck g164{.correct_center = false};
  EXPECT_EQ(code_of(about({0, 0}, {50, 0}, {0, 50.05}, false, g164, ArcUse::with_equidistant)),
            Code::arc_radii_differ);
  EXPECT_EQ(code_of(about({0, 0}, {50, 0}, {0, 50.05}, false, g164, ArcUse::as_programmed)),
            Code{});
  EXPECT_EQ(code_of(about({0, 0}, {50, 0}, {0, 50.00005}, false, g164, ArcUse::with_equidistant)),
            Code{});
}

TEST(CircleOfARadius, IsTheShorterArcWhenPositiveAndTheLongerWhenNegative) {
  const Point start(0, 0);
  const Point end(10, 0);
  const Arc short_ccw = arc_of(of_radius(10, start, end, false));
  EXPECT_NEAR(short_ccw.center.x(), 5, 1e-12);
  EXPECT_NEAR(short_ccw.center.y(), std::sqrt(75), 1e-12);
  EXPECT_NEAR(short_ccw.sweep, pi / 3, 1e-12);
  EXPECT_NEAR(arc_of(of_radius(-10, start, end, false)).sweep, 5 * pi / 3, 1e-12);
  EXPECT_NEAR(arc_of(of_radius(-10, start, end, false)).center.y(), -std::sqrt(75), 1e-12);
  EXPECT_NEAR(arc_of(of_radius(10, start, end, true)).sweep, -pi / 3, 1e-12);
  EXPECT_NEAR(arc_of(of_radius(-10, start, end, true)).sweep, -5 * pi / 3, 1e-12);
}

TEST(CircleOfARadius, MayBeASemicircle) {
  const Arc arc = arc_of(of_radius(5, {0, 0}, {10, 0}, false));
  EXPECT_NEAR(arc.sweep, pi, 1e-12);
  EXPECT_NEAR(arc.center.x(), 5, 1e-12);
  EXPECT_NEAR(arc.center.y(), 0, 1e-12);
}

TEST(CircleOfARadius, ForgivesOneDigitOfThreeDecimals) {
  const Arc arc = arc_of(of_radius(35.355, {0, 0}, {50, 50}, true));  // half the chord: 35.35534
  EXPECT_NEAR(arc.sweep, -pi, 1e-12);
  EXPECT_EQ(code_of(of_radius(35.3, {0, 0}, {50, 50}, true)), Code::circle_center_misfit);
}

TEST(CircleOfARadius, CannotBeFullOrWithoutRadius) {
  EXPECT_EQ(code_of(of_radius(5, {1, 2}, {1, 2}, false)), Code::full_circle_with_radius_word);
  EXPECT_EQ(code_of(of_radius(0, {0, 0}, {10, 0}, false)), Code::circle_radius_zero);
}

}  // namespace
}  // namespace trc
