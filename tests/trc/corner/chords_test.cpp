#include "core/trc/corner/chords.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

namespace trc {
namespace {

constexpr double tool_radius = 5;
constexpr double shift = -tool_radius;  // the tool is to the right

Line line_at(double angle) {
  return {.start = Point::Zero(), .end = Point(std::cos(angle), std::sin(angle))};
}

// Begins in the origin; `radius` > 0: counter-clockwise.
Arc arc_at(double angle, double radius, double sweep) {
  const Vector left(-std::sin(angle), std::cos(angle));
  const Point center = radius * left;
  const double turn = std::copysign(sweep, radius);
  const Vector radial = -center;
  const Point end =
      center + std::cos(turn) * radial + std::sin(turn) * Vector(-radial.y(), radial.x());
  return {.start = Point::Zero(), .end = end, .center = center, .sweep = turn};
}

TEST(Chords, CutOfTwoLinesIsThatOfTheBisector) {
  constexpr double turn = -0.02;
  const ChordCut cut =
      cut_between(course_of(line_at(0), shift), course_of(line_at(turn), shift), shift);
  EXPECT_DOUBLE_EQ(cut.before, cut.after);
  EXPECT_NEAR(cut.before, tool_radius * std::tan(0.01), 1e-12);
  const ChordCut outside =
      cut_between(course_of(line_at(0), shift), course_of(line_at(-turn), shift), shift);
  EXPECT_EQ(outside.before, 0);
  EXPECT_EQ(outside.after, 0);
}

// The path beside the line is y = -R, which the circle beside the arc meets at a known height above
// its centre.
TEST(Chords, CutBesideAnArcIsWhereThePathsMeet) {
  constexpr double turn = 0.02;
  for (const double radius : {12.0, 20.0, 300.0, -8.0, -30.0}) {
    SCOPED_TRACE(radius);
    const Arc arc = arc_at(-turn, radius, 0.05);
    const ChordCourse course = course_of(arc, shift);
    const double beside = std::abs(radius + tool_radius);
    EXPECT_NEAR(course.room, 0.05 * beside, 1e-9);
    const double height = -tool_radius - arc.center.y();
    const double meeting = std::asin(std::sqrt(beside * beside - height * height) / beside);
    const ChordCut cut = cut_between(course_of(line_at(0), shift), course, shift);
    EXPECT_NEAR(cut.after, std::abs(meeting - turn) * beside, 2e-3 * cut.after);
    EXPECT_NEAR(cut.before + cut.after, tool_radius * turn, 1e-4);
  }
}

TEST(Chords, RightAngleIsNoRounding) {
  const ChordCut cut =
      cut_by_rounding(course_of(line_at(0), shift), course_of(line_at(-1.6), shift), shift);
  EXPECT_EQ(cut.before, 0);
  EXPECT_EQ(cut.after, 0);
}

ChordChoice choice_of(std::size_t first, std::size_t count, bool straight, double turn,
                      double room) {
  ChordCourse course = course_of(line_at(turn), shift);
  course.room = room;
  const double cost = static_cast<double>(count * count) + (straight && count == 1 ? 0.5 : 0);
  return {.chord = {.first = first, .count = count, .straight = straight},
          .course = course,
          .cost = cost};
}

TEST(Chords, AreDividedAsCheaplyAsCornersAllow) {
  // The second block turns there and the third one back: by itself it keeps nothing.
  const std::vector<ChordChoice> choices = {
      choice_of(0, 1, false, 0, 0.1),    choice_of(1, 1, false, -0.04, 0.1),
      choice_of(0, 2, true, -0.02, 0.2), choice_of(2, 1, false, -0.08, 0.1),
      choice_of(1, 2, true, -0.06, 0.1), choice_of(0, 3, true, -0.04, 0.3)};
  const auto chords = cheapest_division(choices, 3, std::nullopt, std::nullopt, shift);
  ASSERT_EQ(chords.size(), 2U);
  EXPECT_EQ(chords[0].count, 2U);
  EXPECT_EQ(chords[1].first, 2U);
  // With something after it that leaves nothing of the last one, all are one.
  const auto behind = course_of(line_at(-0.1), shift);
  const auto joined = cheapest_division(choices, 3, std::nullopt, behind, shift);
  ASSERT_EQ(joined.size(), 1U);
  EXPECT_EQ(joined[0].count, 3U);
  const auto too_much = course_of(line_at(-0.5), shift);
  EXPECT_TRUE(cheapest_division(choices, 3, std::nullopt, too_much, shift).empty());
}

}  // namespace
}  // namespace trc
