#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>

#include "core/verify/capsule.h"
#include "core/verify/four_walls.h"
#include "core/verify/nearest.h"
#include "core/verify/shape.h"
#include "tests/support/on_circle.h"
#include "tests/support/random.h"

// The quick tests that tell walls far from the path without measuring them never drop a near wall.

namespace trc::support {
namespace {

using std::numbers::pi;
using verify::FourRings;
using verify::FourWalls;
using verify::Piece;

constexpr double all = std::numeric_limits<double>::infinity();

// About a place: a line, a point, or an arc that ends on its circle up to `misfit`.
Piece any_piece(Random& random, const Point& about, double size, double misfit) {
  const Point start = about + Vector(random.between(-size, size), random.between(-size, size));
  if (random.chance(0.05)) return {.start = start, .end = start};
  if (random.chance(0.45))
    return {.start = start,
            .end = about + Vector(random.between(-size, size), random.between(-size, size))};
  const double radius = random.between(0.01, 2) * size;
  const double begin = random.between(-pi, pi);
  const double sweep =
      random.between(0.01, random.chance(0.8) ? pi : 2 * pi) * (random.chance(0.5) ? 1 : -1);
  const Point center = start - on_circle(Point::Zero(), radius, begin);
  return {.start = start,
          .end = on_circle(center, radius + random.between(-misfit, misfit), begin + sweep),
          .center = center,
          .sweep = sweep};
}

// One after the other, as in a contour: the second goes on where the first ends.
void join(const Piece& first, Piece& second) {
  const Vector way = first.end - second.start;
  second.start += way;
  second.end += way;
  second.center += way;
}

// An arc that begins where another one ends, or beside that, in the same direction or against it.
Piece going_on_from(Random& random, const Piece& arc) {
  const Vector out = arc.end - arc.center;
  const Point start = arc.center + random.between(0.2, 2) * out;
  const Point center = start + random.between(-3, 3) * out;
  const double begin = std::atan2(start.y() - center.y(), start.x() - center.x());
  const double sweep = random.between(0.01, pi) * (random.chance(0.5) ? 1 : -1);
  const double radius = (start - center).norm();
  return {.start = start,
          .end = on_circle(center, radius, begin + sweep),
          .center = center,
          .sweep = sweep};
}

TEST(QuickRejects, CapsulesHoldTheirPieces) {
  for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
    Random random(seed);
    const Piece piece = any_piece(random, Point::Zero(), 10, 1e-3);
    const verify::Capsule capsule = verify::capsule_of(piece);
    const Piece line{.start = capsule.center - capsule.half, .end = capsule.center + capsule.half};
    for (int place = 0; place <= 20; ++place) {
      const Point point = verify::place_at(segment_of(piece), place / 20.0).point;
      const double apart = (verify::nearest_point(segment_of(line), point) - point).norm();
      ASSERT_LE(apart, capsule.margin + 1e-9) << seed;
    }
  }
}

TEST(QuickRejects, RingsHoldTheirPieces) {
  for (std::uint64_t seed = 20'000; seed < 40'000; ++seed) {
    Random random(seed);
    const Piece piece = any_piece(random, Point::Zero(), 10, 1e-3);
    // Now and then about the centre of the piece, or about a place on its way.
    const Point center = random.chance(0.1) ? piece.center
                         : random.chance(0.1)
                             ? piece.end
                             : Point(random.between(-20, 20), random.between(-20, 20));
    const verify::Ring ring = verify::ring_of(piece, center);
    for (int place = 0; place <= 50; ++place) {
      const Point point = verify::place_at(segment_of(piece), place / 50.0).point;
      const double apart = (point - center).norm();
      ASSERT_GE(apart, ring.inner - 1e-9) << seed;
      ASSERT_LE(apart, ring.outer + 1e-9) << seed;
    }
  }
}

// Four walls at any distance from the origin, of any size.
TEST(QuickRejects, NothingNearIsLeftOut) {
  std::size_t told_apart = 0;
  for (std::uint64_t seed = 100'000; seed < 150'000; ++seed) {
    Random random(seed);
    const double size = std::pow(10, random.between(-2, 4));
    const Point about =
        Vector(random.between(-1, 1), random.between(-1, 1)) * std::pow(10, random.between(-2, 5));
    const Point middle = about + Vector(random.between(-size, size), random.between(-size, size));
    const Piece path = any_piece(random, about, size, 1e-3);
    FourWalls walls;
    FourRings rings;
    Piece made[FourWalls::count];
    const Point before = about + Vector(3 * size, -size);
    for (std::size_t place = 0; place < FourWalls::count; ++place) {
      made[place] = any_piece(random, about, size, 1e-3);
      if (random.chance(0.3)) join(path, made[place]);
      walls.set(place, verify::capsule_of(made[place]), before);
      rings.set(place, verify::ring_of(made[place], middle));
    }
    walls.finish();
    walls.move_origin(about - before);
    const std::size_t one = seed % FourWalls::count;
    const double exact = verify::gap_between(path, made[one], all).distance;
    // Its exact distance, and a little more.
    const double reach = exact * (1 + 1e-12) + 1e-12;
    const FourWalls::Bits near =
        walls.near(FourWalls::Surroundings(verify::capsule_of(path), about, reach));
    const FourWalls::Bits between =
        rings.near(FourRings::Surroundings(verify::ring_of(path, middle), reach));
    EXPECT_NE(near >> one & 1U, 0U) << seed;
    EXPECT_NE(between >> one & 1U, 0U) << seed;
    for (std::size_t place = 0; place < FourWalls::count; ++place) {
      const double gap = verify::gap_between(path, made[place], all).distance;
      if (gap <= reach) continue;
      told_apart += (near & between) >> place & 1U ? 0 : 1;
    }
  }
  EXPECT_GT(told_apart, 10'000U);
}

TEST(QuickRejects, WhatIsFarFromEverythingIsNotNear) {
  FourWalls walls;
  FourRings rings;
  walls.set(1, verify::capsule_of({.start = {5, 0}, .end = {6, 0}}), Point::Zero());
  walls.finish();
  rings.set(1, verify::ring_of({.start = {5, 0}, .end = {6, 0}}, Point::Zero()));
  const Piece path{.start = {5, 2}, .end = {6, 2}};
  const auto near = [&](double reach) {
    return walls.near(FourWalls::Surroundings(verify::capsule_of(path), Point::Zero(), reach)) &
           rings.near(FourRings::Surroundings(verify::ring_of(path, Point::Zero()), reach));
  };
  EXPECT_EQ(near(1.99), 0U);
  EXPECT_EQ(near(2), 2U);
  EXPECT_EQ(near(1e6), 2U);
}

// Coordinates that a float cannot hold.
TEST(QuickRejects, WhatIsHugeIsNear) {
  FourWalls walls;
  walls.set(2, verify::capsule_of({.start = {-1e30, 0}, .end = {1e30, 1}}), Point::Zero());
  walls.finish();
  const Piece path{.start = {5, 2}, .end = {6, 2}};
  EXPECT_NE(walls.near(FourWalls::Surroundings(verify::capsule_of(path), Point::Zero(), 3)) & 4U,
            0U);
}

// Two pieces that are said to be no nearer than `enough` are no nearer.
TEST(QuickRejects, EnoughIsTrue) {
  std::size_t far = 0;
  std::size_t told_apart = 0;
  for (std::uint64_t seed = 200'000; seed < 300'000; ++seed) {
    Random random(seed);
    const Piece a = any_piece(random, Point::Zero(), 10, random.chance(0.5) ? 0 : 1e-6);
    Piece b = any_piece(random, Point::Zero(), 10, random.chance(0.5) ? 0 : 1e-6);
    if (random.chance(0.3)) join(a, b);
    if (a.is_arc() && random.chance(0.3)) b = going_on_from(random, a);
    const double exact = verify::gap_between(a, b, all).distance;
    const double enough = exact * random.between(0.5, 1.5) - (random.chance(0.1) ? 2e-6 : 0);
    const double told = verify::gap_between(a, b, enough).distance;
    if (exact < enough - 1e-7) {
      EXPECT_NEAR(told, exact, 1e-12) << seed;
    } else if (exact > enough + 1e-7) {
      EXPECT_GE(told, enough - 1e-12) << seed;
      ++far;
    }
    if (verify::Compared(a).is_apart_from(b, enough)) {
      EXPECT_GE(exact, enough - 1e-9) << seed;
      ++told_apart;
    }
  }
  EXPECT_GT(far, 10'000U);
  EXPECT_GT(told_apart, 10'000U);
}

}  // namespace
}  // namespace trc::support
