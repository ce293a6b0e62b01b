#include "core/geometry/intersect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

// Where lines and circles meet, at places known from right triangles of whole numbers.

namespace trc {
namespace {

constexpr double same_point = 1e-6;

Circle about(double x, double y, double radius) { return {.center = {x, y}, .radius = radius}; }

// In ascending order of their coordinates.
std::vector<Point> sorted(const Meetings& meetings) {
  std::vector<Point> points(meetings.begin(), meetings.end());
  std::ranges::sort(points, [](const Point& a, const Point& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  return points;
}

void expect_points(const Meetings& meetings, const std::vector<Point>& expected) {
  const std::vector<Point> points = sorted(meetings);
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(points[i].x(), expected[i].x(), 1e-12);
    EXPECT_NEAR(points[i].y(), expected[i].y(), 1e-12);
  }
}

TEST(Intersect, LinesMeetInOnePointHoweverFarIt) {
  expect_points(intersect(StraightLine{.point = {0, 0}, .direction = {1, 0}},
                          StraightLine{.point = {3, -4}, .direction = {0.6, 0.8}}),
                {{6, 0}});
  expect_points(intersect(StraightLine{.point = {3, -4}, .direction = {-0.6, -0.8}},
                          StraightLine{.point = {100, 0}, .direction = {1, 0}}),
                {{6, 0}});
}

TEST(Intersect, ParallelLinesDoNotMeetNotEvenOnTopOfEachOther) {
  const StraightLine line{.point = {0, 0}, .direction = {0.6, 0.8}};
  expect_points(intersect(line, {.point = {1, 0}, .direction = {0.6, 0.8}}), {});
  expect_points(intersect(line, {.point = {1, 0}, .direction = {-0.6, -0.8}}), {});
  expect_points(intersect(line, line), {});
}

TEST(Intersect, ALineMeetsACircleInTwoPoints) {
  const StraightLine line{.point = {-100, 3}, .direction = {1, 0}};
  expect_points(intersect(line, about(0, 0, 5), same_point), {{-4, 3}, {4, 3}});
  expect_points(intersect(line, about(0, -1, 5), same_point), {{-3, 3}, {3, 3}});
  expect_points(intersect(line, about(0, -3, 5), same_point), {});
}

TEST(Intersect, ALineThatMissesACircleByLessThanAPointMeetsItInOneOfTheLine) {
  const auto at_height = [](double y) {
    return intersect(StraightLine{.point = {-7, y}, .direction = {1, 0}}, about(0, 0, 5),
                     same_point);
  };
  expect_points(at_height(5), {{0, 5}});
  expect_points(at_height(5 + 0.9e-6), {{0, 5 + 0.9e-6}});
  expect_points(at_height(5 + 1.1e-6), {});
}

TEST(Intersect, CirclesMeetInTwoPoints) {
  expect_points(intersect(about(0, 0, 5), about(6, 0, 5), same_point), {{3, -4}, {3, 4}});
  // The points lie behind the centre of the small circle, seen from the large one.
  const std::vector<Point> behind{{8, -6}, {8, 6}};
  expect_points(intersect(about(0, 0, 10), about(5.5, 0, 6.5), same_point), behind);
  expect_points(intersect(about(5.5, 0, 6.5), about(0, 0, 10), same_point), behind);
}

TEST(Intersect, CirclesThatTouchMeetInOnePoint) {
  expect_points(intersect(about(0, 0, 5), about(7, 0, 2), same_point), {{5, 0}});
  expect_points(intersect(about(0, 0, 5), about(3, 0, 2), same_point), {{5, 0}});
  expect_points(intersect(about(3, 0, 2), about(0, 0, 5), same_point), {{5, 0}});
}

TEST(Intersect, CirclesThatMissEachOtherByLessThanAPointMeetInOneOfTheFirst) {
  const Circle first = about(0, 0, 5);
  expect_points(intersect(first, about(7 + 0.9e-6, 0, 2), same_point), {{5, 0}});
  expect_points(intersect(about(7 + 0.9e-6, 0, 2), first, same_point), {{5 + 0.9e-6, 0}});
  expect_points(intersect(first, about(7 + 1.1e-6, 0, 2), same_point), {});
  expect_points(intersect(first, about(3 - 0.9e-6, 0, 2), same_point), {{5, 0}});
  expect_points(intersect(first, about(3 - 1.1e-6, 0, 2), same_point), {});
}

TEST(Intersect, CirclesWithOneCentreDoNotMeet) {
  expect_points(intersect(about(1, 2, 5), about(1, 2, 5), same_point), {});
  expect_points(intersect(about(1, 2, 5), about(1, 2, 4), same_point), {});
}

}  // namespace
}  // namespace trc
