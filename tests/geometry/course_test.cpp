#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

#include "core/geometry/along.h"
#include "core/geometry/box_tree.h"
#include "core/geometry/distance.h"
#include "core/geometry/four_boxes.h"
#include "tests/support/random.h"

namespace trc {
namespace {

Point near_to(const Point& place, double size, support::Random& random) {
  return place + Vector(random.between(-size, size), random.between(-size, size));
}

Segment any_segment(const Point& place, double size, support::Random& random) {
  const Point start = near_to(place, size, random);
  if (random.between(0, 1) < 0.5) return Line{.start = start, .end = near_to(start, size, random)};
  const Point middle = near_to(start, size, random);
  const double sweep = random.between(-2 * std::numbers::pi, 2 * std::numbers::pi);
  const Vector radial = start - middle;
  const Point end = middle + Vector(std::cos(sweep) * radial.x() - std::sin(sweep) * radial.y(),
                                    std::sin(sweep) * radial.x() + std::cos(sweep) * radial.y());
  return Arc{.start = start, .end = end, .center = middle, .sweep = sweep};
}

// A box may be left out only where the way comes no nearer to anything in it. Most of the boxes far
// off must be left out, or the test would save nothing.
TEST(Course, LeavesOutOnlyWhatIsNotEntered) {
  constexpr std::uint64_t seed = 20261122;
  std::cout << "seed " << seed << "\n";
  support::Random random(seed);
  std::size_t entered = 0;
  std::size_t left_out = 0;
  for (int round = 0; round < 200'000; ++round) {
    // Up to where a float resolves no more than a sixteenth of a millimetre.
    const Point place = near_to(Point::Zero(), std::pow(10, random.between(-1, 6)), random);
    const double size = std::pow(10, random.between(-2, 2));
    const Segment path = any_segment(place, size, random);
    const Segment obstacle = any_segment(place, 4 * size, random);
    const double length = length_of(path);
    const double from = random.between(0, length);
    const double to = random.between(from, length);
    const double reach = size * random.between(0.01, 4);
    FourBoxes boxes;
    const auto at = static_cast<std::size_t>(round % 4);
    boxes.set(at, kept(bounding_box(obstacle)));
    const PathPart part(path, from, to);
    const bool may_be = (boxes.entered_by(part.course(reach)) >> at & 1U) != 0;
    const bool is = part.first_entry(obstacle, reach).has_value();
    ASSERT_TRUE(may_be || !is) << "round " << round;
    entered += is ? 1 : 0;
    left_out += may_be ? 0 : 1;
  }
  EXPECT_GT(entered, 40'000);
  EXPECT_GT(left_out, 40'000);
}

TEST(Course, TellsFromTheSlopeWhatRunsAside) {
  // The obstacle is within reach of the circle about the middle, but not of the line.
  const PathPart part(Line{.start = Point(-1, 0), .end = Point(1, 0)}, 0, 2);
  FourBoxes boxes;
  boxes.set(0, kept(bounding_box(Line{.start = Point(-0.1, 1.1), .end = Point(0.1, 1.2)})));
  boxes.set(1, kept(bounding_box(Line{.start = Point(-0.1, 0.9), .end = Point(0.1, 1.2)})));
  boxes.set(2, kept(bounding_box(Line{.start = Point(1.5, 0.5), .end = Point(1.6, 0.6)})));
  EXPECT_EQ(boxes.entered_by(part.course(1)) & 7U, 6U);
}

TEST(Course, MeasuresTheMiddleFromBoxes) {
  const PathPart part(Line{.start = Point(0, 0), .end = Point(2, 0)}, 0, 2);
  FourBoxes boxes;
  boxes.set(0, kept(bounding_box(Line{.start = Point(4, 4), .end = Point(5, 9)})));
  boxes.set(3, kept(bounding_box(Line{.start = Point(0, -1), .end = Point(2, 1)})));
  const FourBoxes::Squares squares = boxes.squared_distances(part.course(1));
  EXPECT_FLOAT_EQ(squares[0], 25);
  EXPECT_EQ(squares[3], 0);
  EXPECT_EQ(squares.up_to(24) & 9U, 8U);
  EXPECT_EQ(squares.up_to(26) & 9U, 9U);
}

TEST(NearFour, DropsARange) {
  const auto left_of = [](std::size_t from, std::size_t end) {
    NearFour four{.first = 8, .bits = 15};
    four.drop(from, end);
    return four.bits;
  };
  EXPECT_EQ(left_of(0, 8), 15U);
  EXPECT_EQ(left_of(0, 9), 14U);
  EXPECT_EQ(left_of(9, 11), 9U);
  EXPECT_EQ(left_of(11, 40), 7U);
  EXPECT_EQ(left_of(12, 40), 15U);
  EXPECT_EQ(left_of(0, 40), 0U);
  EXPECT_EQ(left_of(10, 10), 15U);
}

}  // namespace
}  // namespace trc
