#include "core/verify/clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "core/verify/disk.h"
#include "core/verify/nearest.h"
#include "core/verify/shape.h"

namespace trc::verify {
namespace {

using std::numbers::pi;

std::shared_ptr<const TrcMode> left_of_contour(double radius) {
  TrcMode mode;
  mode.side = Side::left;
  mode.tool_radius = radius;
  mode.selection_number = 1;
  return std::make_shared<const TrcMode>(mode);
}

Source source(std::uint64_t index) {
  return {.index = index,
          .number = static_cast<std::int64_t>(index) * 10,
          .line = static_cast<std::uint32_t>(index) + 1};
}

MotionBlock contour(std::uint64_t index, Segment path, double radius = 10) {
  return {.source = source(index), .path = path, .mode = left_of_contour(radius)};
}

CompensatedBlock path_block(std::uint64_t index, Segment path, Origin origin = Origin::programmed) {
  return {.source = source(index), .origin = origin, .path = path};
}

std::vector<Point> points_of(const Segment& segment, int samples) {
  std::vector<Point> points;
  for (int i = 0; i <= samples; ++i)
    points.push_back(place_at(segment, static_cast<double>(i) / samples).point);
  return points;
}

// The smallest distance of many points, for comparison.
double sampled_gap(const Segment& a, const Segment& b, int samples) {
  double smallest = std::numeric_limits<double>::infinity();
  const std::vector<Point> on_b = points_of(b, samples);
  for (const Point& p : points_of(a, samples))
    for (const Point& q : on_b) smallest = std::min(smallest, (p - q).squaredNorm());
  return std::sqrt(smallest);
}

class Chance {
 public:
  explicit Chance(std::uint64_t seed) : generator_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11U) * 0x1.0p-53;
  }
  Point point() { return {between(-50, 50), between(-50, 50)}; }
  Segment segment() {
    const Point start = point();
    if (between(0, 1) < 0.5) return Line{.start = start, .end = point()};
    const Point center = point();
    const double sweep = between(0, 1) < 0.15 ? 2 * pi : between(-2 * pi, 2 * pi);
    const Vector from = start - center;
    const Vector to(std::cos(sweep) * from.x() - std::sin(sweep) * from.y(),
                    std::sin(sweep) * from.x() + std::cos(sweep) * from.y());
    return Arc{.start = start, .end = center + to, .center = center, .sweep = sweep};
  }

 private:
  std::mt19937_64 generator_;
};

TEST(Gap, AgreesWithManyPointsOnRandomSegments) {
  constexpr std::uint64_t seed = 20261121;
  SCOPED_TRACE(seed);
  Chance chance(seed);
  constexpr int samples = 300;
  for (int i = 0; i < 300; ++i) {
    const Segment a = chance.segment();
    const Segment b = chance.segment();
    const Gap gap = gap_between(a, b);
    const double sampled = sampled_gap(a, b, samples);
    const double step = (extent_of(a) + extent_of(b)) / samples;
    EXPECT_LE(gap.distance, sampled + 1e-9) << i;
    EXPECT_GE(gap.distance, sampled - step) << i;
    EXPECT_NEAR(gap_between(b, a).distance, gap.distance, 1e-9) << i;
    EXPECT_NEAR((nearest_point(b, gap.on_a) - gap.on_a).norm(), gap.distance, 1e-9) << i;
  }
}

// Rounding may swap the ends of a full circle, or of an arc of almost no length.
TEST(Gap, OfArcsWhoseEndsNearlyMeet) {
  constexpr double little = 1e-13;  // rad
  for (const double off : {-little, 0.0, little}) {
    for (const double sense : {-1.0, 1.0}) {
      const Point end(10 * std::cos(off), 10 * std::sin(off));
      const Arc circle{.start = {10, 0}, .end = end, .center = {0, 0}, .sweep = sense * 2 * pi};
      const Arc dot{.start = {10, 0}, .end = end, .center = {0, 0}, .sweep = sense * little};
      for (const double angle : {0.0, off / 2, pi, pi - off / 2, pi + off / 2, 1.0}) {
        const Point away(12 * std::cos(angle), 12 * std::sin(angle));
        EXPECT_NEAR((nearest_point(circle, away) - away).norm(), 2, 1e-9) << off << ' ' << angle;
        EXPECT_NEAR((nearest_point(dot, away) - away).norm(), (away - Point(10, 0)).norm(), 1e-9)
            << off << ' ' << angle;
      }
    }
  }
}

TEST(Gap, IsNotSmallerThanPiecesAreApart) {
  constexpr std::uint64_t seed = 20261124;
  SCOPED_TRACE(seed);
  Chance chance(seed);
  int apart = 0;
  for (int i = 0; i < 3000; ++i) {
    const Piece a = piece_of(chance.segment());
    const Piece b = piece_of(chance.segment());
    const double distance = chance.between(0, 50);
    if (!Compared(a).is_apart_from(b, distance)) continue;
    ++apart;
    EXPECT_GE(gap_between(segment_of(a), segment_of(b)).distance, distance - 1e-9) << i;
  }
  EXPECT_GT(apart, 100);
}

TEST(Disk, HoldsAllOfThePiece) {
  constexpr std::uint64_t seed = 20261123;
  SCOPED_TRACE(seed);
  Chance chance(seed);
  for (int i = 0; i < 300; ++i) {
    const Segment segment = chance.segment();
    const Disk disk = disk_of(piece_of(segment));
    for (const Point& point : points_of(segment, 100))
      EXPECT_LE((point - disk.center).norm(), disk.radius + 1e-9) << i;
  }
}

TEST(Gap, IsZeroWhereSegmentsCross) {
  EXPECT_NEAR(gap_between(Line{{-10, 0}, {10, 0}}, Line{{0, -10}, {0, 10}}).distance, 0, 1e-12);
  EXPECT_NEAR(gap_between(Line{{-20, 5}, {20, 5}}, Arc{{10, 0}, {-10, 0}, {0, 0}, pi}).distance, 0,
              1e-12);
  EXPECT_GT(gap_between(Line{{-20, 5}, {20, 5}}, Arc{{10, 0}, {-10, 0}, {0, 0}, -pi}).distance, 1);
}

// Rounding puts the place where they cross on neither of them, or on both.
TEST(Gap, OfLinesOneAfterTheOtherIsWhatLiesBetweenThem) {
  Chance random(4711);
  for (int i = 0; i < 100'000; ++i) {
    const Point from(random.between(-3000, 3000), random.between(-3000, 3000));
    const double angle = random.between(0, 2 * pi);
    const Vector along(std::cos(angle), std::sin(angle));
    const double between = random.between(1, 1000);
    const double length = random.between(1, 2000);
    const Line a{from, from + length * along};
    const Line b{from + (length + between) * along, from + (2 * length + between) * along};
    ASSERT_NEAR(gap_between(a, b).distance, between, 1e-9) << i;
    ASSERT_NEAR(gap_between(b, a).distance, between, 1e-9) << i;
  }
}

TEST(Clearance, OfAnEquidistantIsTheToolRadius) {
  const std::vector<Block> programmed{contour(0, Line{{-20, 0}, {0, 0}}),
                                      contour(1, Line{{0, 0}, {50, 0}}),
                                      contour(2, Line{{50, 0}, {50, 50}})};
  const std::vector<CompensatedBlock> path{path_block(0, Line{{-20, 0}, {0, 10}}, Origin::approach),
                                           path_block(1, Line{{0, 10}, {40, 10}}),
                                           path_block(2, Line{{40, 10}, {40, 50}})};
  const ClearanceReport report = measure_clearance(programmed, path, 1e-4);
  EXPECT_EQ(report.checked, 2u);
  EXPECT_EQ(report.gouging, 0u);
  ASSERT_TRUE(report.worst);
  EXPECT_NEAR(report.worst->distance, 10, 1e-12);
}

TEST(Clearance, FindsTheWorstPointAndBothBlocks) {
  // The path runs 3 mm too far into the corner.
  const std::vector<Block> programmed{contour(0, Line{{-20, 0}, {0, 0}}),
                                      contour(1, Line{{0, 0}, {50, 0}}),
                                      contour(2, Line{{50, 0}, {50, 50}})};
  const std::vector<CompensatedBlock> path{path_block(1, Line{{0, 10}, {43, 10}}),
                                           path_block(2, Line{{43, 10}, {40, 50}})};
  const ClearanceReport report = measure_clearance(programmed, path, 1e-4);
  EXPECT_EQ(report.gouging, 2u);
  ASSERT_TRUE(report.worst);
  EXPECT_NEAR(report.worst->distance, 7, 1e-12);
  EXPECT_EQ(report.worst->required, 10);
  EXPECT_NEAR(report.worst->place[0], 43, 1e-9);
  EXPECT_NEAR(report.worst->place[1], 10, 1e-9);
  EXPECT_EQ(report.worst->path.number, 10);
  EXPECT_EQ(report.worst->contour.number, 20);
}

TEST(Clearance, SeesContourBlocksFarAwayInTheProgram) {
  // A wall that comes back 15 mm beside the first one, many blocks later.
  std::vector<Block> programmed{contour(0, Line{{-20, 0}, {0, 0}}),
                                contour(1, Line{{0, 0}, {100, 0}})};
  for (std::uint64_t i = 2; i < 200; ++i) {
    const auto x = 1000.0 + 20.0 * static_cast<double>(i);
    programmed.emplace_back(contour(i, Line{{x, 0}, {x + 20, 0}}));
  }
  programmed.emplace_back(contour(200, Line{{100, 15}, {0, 15}}));
  const std::vector<CompensatedBlock> path{path_block(1, Line{{0, 10}, {100, 10}})};
  const ClearanceReport report = measure_clearance(programmed, path, 1e-4);
  ASSERT_TRUE(report.worst);
  EXPECT_NEAR(report.worst->distance, 5, 1e-12);
  EXPECT_EQ(report.worst->contour.index, 200u);
}

// A square from (10,0) round again and along its first side up to (30,0), by `low` below it there;
// the path of its third block is by `moved` too near.
ClearanceReport square_with_overrun(double low, double moved) {
  const std::vector<Point> corners{{-20, 0}, {10, 0}, {50, 0},   {50, 50},
                                   {0, 50},  {0, 0},  {30, -low}};
  const std::vector<Point> beside{{10, 10}, {40, 10},         {40, 40},
                                  {10, 40}, {10 - moved, 10}, {30, 10 - low}};
  std::vector<Block> programmed;
  std::vector<CompensatedBlock> path;
  for (std::uint64_t i = 0; i + 1 < corners.size(); ++i) {
    programmed.emplace_back(contour(i, Line{corners[i], corners[i + 1]}));
    if (i > 0) path.push_back(path_block(i, Line{beside[i - 1], beside[i]}));
  }
  return measure_clearance(programmed, path, 1e-4);
}

// Inside and outside corners of 60 degrees in turn: of each block of 10 mm the path touches 3 mm,
// and its mitre reaches 7 mm beyond.
TEST(Clearance, CountsWhatIsTouchedBesideALongMitre) {
  const double radius = 7 / std::tan(pi / 6);
  std::vector<Point> corners{{-10, 20}, {0, 0}};
  std::vector<Block> programmed{contour(0, Line{corners[0], corners[1]}, radius)};
  std::vector<CompensatedBlock> path;
  for (std::uint64_t i = 1; i <= 6; ++i) {
    const double slope = i % 2 == 1 ? -pi / 6 : pi / 6;
    const Vector along(std::cos(slope), std::sin(slope));
    const Point start = corners.back();
    corners.emplace_back(start + 10 * along);
    programmed.emplace_back(contour(i, Line{start, corners.back()}, radius));
    const Vector beside = radius * left_of(along);
    // An inside corner comes after each block that goes down.
    const double from = i == 1 ? 0 : i % 2 == 1 ? -7 : 7;
    const double to = i == 6 ? 10 : i % 2 == 1 ? 3 : 17;
    path.push_back(path_block(i, Line{start + from * along + beside, start + to * along + beside}));
  }
  const ClearanceReport report = measure_clearance(programmed, path, 1e-4);
  EXPECT_EQ(report.gouging, 0u);
  EXPECT_NEAR(report.wall_length, 60, 1e-9);
  EXPECT_NEAR(report.touched_length, 18, 1e-9);
}

// Between the corners of a fine polygon the tool leaves less material than coordinates resolve.
TEST(Clearance, CountsAFinePocketAsTouched) {
  constexpr int chords = 1000;
  const double flat = std::cos(pi / chords);
  const auto corner = [&](int number, double radius) {
    const double angle = 2 * pi * number / chords;
    return Point(radius * std::cos(angle), radius * std::sin(angle));
  };
  std::vector<Block> programmed{contour(0, Line{{0, 0}, corner(0, 20)})};
  std::vector<CompensatedBlock> path;
  for (int i = 0; i < chords; ++i) {
    const auto index = static_cast<std::uint64_t>(i + 1);
    programmed.emplace_back(contour(index, Line{corner(i, 20), corner(i + 1, 20)}));
    const double inside = 20 - 10 / flat;
    // Of some chords there is no path: the tool turns in one place.
    if (i % 10 != 9)
      path.push_back(
          path_block(index, Line{corner(i, inside), corner(i % 10 == 8 ? i + 2 : i + 1, inside)}));
  }
  const ClearanceReport report = measure_clearance(programmed, path, 1e-3);
  EXPECT_EQ(report.gouging, 0u);
  EXPECT_NEAR(report.touched_length, report.wall_length, 1e-9);
}

// The tool turns in the centre of a fillet of its own radius, which has no path.
TEST(Clearance, CountsAFilletOfTheToolRadiusAsTouched) {
  const std::vector<Block> programmed{
      contour(0, Line{{-20, 0}, {0, 0}}), contour(1, Line{{0, 0}, {20, 0}}),
      contour(2, Arc{{20, 0}, {30, 10}, {20, 10}, pi / 2}), contour(3, Line{{30, 10}, {30, 50}})};
  const std::vector<CompensatedBlock> path{path_block(1, Line{{0, 10}, {20, 10}}),
                                           path_block(3, Line{{20, 10}, {20, 50}})};
  const ClearanceReport report = measure_clearance(programmed, path, 1e-4);
  EXPECT_NEAR(report.wall_length, 60 + 5 * pi, 1e-9);
  EXPECT_NEAR(report.touched_length, report.wall_length, 1e-9);
}

TEST(Clearance, TellsATouchAsNearAsItIs) {
  const ClearanceReport report = square_with_overrun(0.003, 0);
  EXPECT_EQ(report.gouging, 0u);
  EXPECT_FALSE(report.gouge);
  ASSERT_TRUE(report.worst);
  EXPECT_NEAR(report.worst->distance, 10 - 0.003, 1e-6);
  EXPECT_EQ(report.worst->required, 10);
  EXPECT_NEAR(report.worst->place[0], 30, 1e-4);
  EXPECT_EQ(report.worst->path.number, 50);
  EXPECT_EQ(report.worst->contour.number, 10);
}

TEST(Clearance, TellsTheWorstGougeBesideATouch) {
  const ClearanceReport report = square_with_overrun(0.003, 0.002);
  EXPECT_GT(report.gouging, 0u);
  ASSERT_TRUE(report.worst && report.gouge);
  EXPECT_NEAR(report.worst->distance, 10 - 0.003, 1e-6);
  EXPECT_NEAR(report.gouge->distance, 10 - 0.002, 1e-6);
  EXPECT_EQ(report.gouge->contour.number, 40);
}

TEST(Clearance, IsNegativeOnTheWrongSide) {
  const std::vector<Block> programmed{contour(0, Line{{-20, 0}, {0, 0}}),
                                      contour(1, Line{{0, 0}, {100, 0}})};
  const std::vector<CompensatedBlock> path{path_block(1, Line{{0, -10}, {100, -10}})};
  const ClearanceReport report = measure_clearance(programmed, path, 1e-4);
  EXPECT_EQ(report.gouging, 1u);
  EXPECT_NEAR(report.worst->distance, -10, 1e-12);
}

TEST(Clearance, AsksForTheSmallerRadiusWhereItChanges) {
  const std::vector<Block> programmed{contour(0, Line{{-20, 0}, {0, 0}}, 10),
                                      contour(1, Line{{0, 0}, {100, 0}}, 10),
                                      contour(2, Line{{100, 0}, {200, 0}}, 20)};
  const std::vector<CompensatedBlock> path{path_block(1, Line{{0, 10}, {100, 10}}),
                                           path_block(2, Line{{100, 10}, {200, 20}})};
  EXPECT_EQ(measure_clearance(programmed, path, 1e-4).gouging, 0u);
}

// D-159: only the block at the change may come as near as the smaller radius allows.
TEST(Clearance, AsksForTheRadiusOfThePathBesideWallsOfASmallerOne) {
  const std::vector<Block> programmed{
      contour(0, Line{{-20, 0}, {0, 0}}, 5), contour(1, Line{{0, 0}, {100, 0}}, 5),
      contour(2, Line{{100, 0}, {100, 40}}, 1), contour(3, Line{{100, 40}, {40, 8}}, 1)};
  const std::vector<CompensatedBlock> path{path_block(1, Line{{0, 5}, {97, 5}}),
                                           path_block(2, Line{{97, 5}, {99, 37}})};
  const ClearanceReport report = measure_clearance(programmed, path, 1e-4);
  ASSERT_EQ(report.gouging, 1u);
  EXPECT_NEAR(report.gouge->distance, 3, 1e-9);
  EXPECT_EQ(report.gouge->required, 5);
}

TEST(Clearance, AsksForTheSmallerRadiusOfWhatIsInsertedBetweenTwo) {
  // At once from 10 to 8, across the contour, after the block with 10.
  const std::vector<Block> programmed{contour(0, Line{{-20, 0}, {0, 0}}, 10),
                                      contour(1, Line{{0, 0}, {100, 0}}, 10),
                                      contour(2, Line{{100, 0}, {200, 0}}, 8)};
  const std::vector<CompensatedBlock> path{
      path_block(1, Line{{0, 10}, {100, 10}}),
      path_block(1, Line{{100, 10}, {100, 8}}, Origin::radius_change),
      path_block(2, Line{{100, 8}, {200, 8}})};
  EXPECT_EQ(measure_clearance(programmed, path, 1e-4).gouging, 0u);
}

TEST(Clearance, AsksForTheSmallerRadiusOfAPieceThatGrowsToTheNewOne) {
  // The first part of a long circle is one, and carries the source of the circle.
  const std::vector<Block> programmed{
      contour(0, Line{{-20, 0}, {0, 0}}, 10), contour(1, Line{{0, 0}, {100, 0}}, 10),
      contour(2, Line{{100, 0}, {200, 0}}, 20), contour(3, Line{{200, 0}, {300, 0}}, 20)};
  const std::vector<CompensatedBlock> path{
      path_block(1, Line{{0, 10}, {100, 10}}),
      path_block(2, Line{{100, 10}, {150, 20}}, Origin::radius_change),
      path_block(2, Line{{150, 20}, {200, 20}})};
  EXPECT_EQ(measure_clearance(programmed, path, 1e-4).gouging, 0u);
}

TEST(Clearance, CountsTheChangeOfSideAsContourWhereItTurnsOnTheSpotOnly) {
  const auto right = [](const Segment& path) {
    TrcMode mode = *left_of_contour(10);
    mode.side = Side::right;
    mode.options.reverse = true;
    return MotionBlock{
        .source = source(2), .path = path, .mode = std::make_shared<const TrcMode>(mode)};
  };
  const std::vector<CompensatedBlock> path{path_block(1, Line{{0, 10}, {100, 10}})};
  const std::vector<Block> aside{contour(0, Line{{-20, 0}, {0, 0}}),
                                 contour(1, Line{{0, 0}, {100, 0}}),
                                 right(Line{{100, 0}, {100, 50}})};
  EXPECT_EQ(measure_clearance(aside, path, 1e-4).gouging, 0u);
  const std::vector<Block> back{contour(0, Line{{-20, 0}, {0, 0}}),
                                contour(1, Line{{0, 5}, {100, 5}}), right(Line{{100, 5}, {0, 5}})};
  EXPECT_EQ(measure_clearance(back, path, 1e-4).gouging, 1u);
}

// D-42: what is cut on one side is in the way of the path on the other, but at the change itself.
TEST(Clearance, LooksAcrossAChangeOfSide) {
  const auto right = [](std::uint64_t number, const Segment& path) {
    TrcMode mode = *left_of_contour(10);
    mode.side = Side::right;
    return MotionBlock{
        .source = source(number), .path = path, .mode = std::make_shared<const TrcMode>(mode)};
  };
  const std::vector<CompensatedBlock> path{path_block(1, Line{{0, 10}, {100, 10}})};
  const auto gouging_beside = [&](double nearest) {
    const std::vector<Block> programmed{
        contour(0, Line{{-20, 0}, {0, 0}}), contour(1, Line{{0, 0}, {100, 0}}),
        right(2, Line{{100, 0}, {150, 60}}), right(3, Line{{150, 60}, {150, 80}}),
        right(4, Line{{150, 80}, {50, nearest}})};
    return measure_clearance(programmed, path, 1e-4).gouging;
  };
  EXPECT_EQ(gouging_beside(14), 1U);
  EXPECT_EQ(gouging_beside(21), 0U);
}

TEST(Clearance, LeavesApproachAndRetractOut) {
  const std::vector<Block> programmed{contour(0, Line{{-20, 0}, {0, 0}}),
                                      contour(1, Line{{0, 0}, {100, 0}})};
  const std::vector<CompensatedBlock> path{
      path_block(0, Line{{50, 0}, {0, 10}}, Origin::approach),
      path_block(1, Line{{100, 10}, {100, 0}}, Origin::retract)};
  const ClearanceReport report = measure_clearance(programmed, path, 1e-4);
  EXPECT_EQ(report.checked, 0u);
  EXPECT_FALSE(report.worst);
}

}  // namespace
}  // namespace trc::verify
