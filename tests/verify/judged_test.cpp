#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/verify/clearance.h"
#include "tests/support/big_contours.h"
#include "tests/support/on_circle.h"
#include "tests/support/random.h"
#include "tests/support/run.h"
#include "tests/support/slow_verification.h"
#include "tests/support/small_contours.h"

// The measurement against one that compares every pair, and its cost where many walls are equally
// far away.

namespace trc::support {
namespace {

using std::numbers::pi;
using verify::ClearanceReport;
using verify::measure_clearance;

constexpr double allowed = 1e-4;

struct Measured {
  std::vector<Block> programmed{};
  std::vector<CompensatedBlock> path{};
};

Measured measured(const Contour& contour, const TrcMode& given,
                  const std::vector<CompensatedBlock>& path) {
  TrcMode mode = given;
  mode.selection_number = 1;
  const auto shared = std::make_shared<const TrcMode>(mode);
  Measured result{.path = path};
  const auto add = [&](const Segment& block) {
    const std::size_t ordinal = result.programmed.size();
    result.programmed.emplace_back(
        MotionBlock{.source = {.index = ordinal, .number = static_cast<std::int64_t>(ordinal)},
                    .path = block,
                    .mode = shared});
  };
  add(contour.approach);
  for (const Segment& block : contour.blocks) add(block);
  return result;
}

void expect_as_judged(const Measured& given, const std::string& what) {
  SCOPED_TRACE(what);
  const LeadSettings leads{.input_resolution = 0};
  const ClearanceReport found = measure_clearance(given.programmed, given.path, allowed, leads);
  const ClearanceReport judged = slow_verification(given.programmed, given.path, allowed, leads);
  EXPECT_EQ(found.checked, judged.checked);
  EXPECT_EQ(found.gouging, judged.gouging);
  if (!judged.worst) {
    // It looks no farther than 1 mm and a hundredth of the radius beyond the tool.
    constexpr double far = 0.9;
    if (found.worst) {
      EXPECT_GT(found.worst->margin(), far);
    }
    return;
  }
  ASSERT_TRUE(found.worst.has_value());
  EXPECT_NEAR(found.worst->margin(), judged.worst->margin(), 2 * verify::margin_resolution);
}

TEST(Judged, HardContours) {
  std::size_t gouging = 0;
  for (const Hardship hardship : all_hardships)
    for (std::uint64_t seed = 81'000'000; seed < 81'000'250; ++seed) {
      Random random(seed);
      SmallContour made = small_contour(random, hardship);
      made.mode.masking = Masking::off;
      made.mode.options.remove_masked_blocks = false;
      made.mode.options.ignore_cont_damage = random.chance(0.9);
      const Outcome outcome = compensate(made.contour, made.mode);
      const Measured given = measured(made.contour, made.mode, outcome.blocks);
      expect_as_judged(given, name_of(hardship) + " " + std::to_string(seed));
      if (measure_clearance(given.programmed, given.path, allowed).gouging > 0) ++gouging;
    }
  EXPECT_GT(gouging, 100U);
}

TEST(Judged, BigShapes) {
  for (const BigShape shape : all_big_shapes)
    for (const double radius : {0.3, 1.0, 4.0}) {
      const std::vector<Segment> blocks = big_contour(shape, 1500);
      TrcMode mode;
      mode.side = Side::right;
      mode.tool_radius = radius;
      mode.selection = Selection::direct;
      mode.transition = Transition::circular;
      mode.options.ignore_cont_damage = true;
      const Point start = start_of(blocks.front());
      const Point outside = start + 3 * radius * start.normalized();
      const Contour contour{
          .approach = Line{outside, start}, .blocks = blocks, .retract = Line{start, outside}};
      const Outcome outcome = compensate(contour, mode);
      expect_as_judged(measured(contour, mode, outcome.blocks),
                       name_of(shape) + " R" + std::to_string(radius));
    }
}

std::shared_ptr<const TrcMode> left(double radius) {
  TrcMode mode;
  mode.side = Side::left;
  mode.tool_radius = radius;
  mode.selection_number = 1;
  return std::make_shared<const TrcMode>(mode);
}

// A contour whose path is given block by block: what is offset, and where to.
class Pairs {
 public:
  explicit Pairs(double radius) : mode_(left(radius)) {
    add({}, Line{{-1e5, 0}, {-1e5, 1}});
    given_.path.clear();
  }
  void add(const Segment& path, const Segment& contour) {
    const std::size_t index = given_.programmed.size();
    given_.programmed.emplace_back(
        MotionBlock{.source = {.index = index}, .path = contour, .mode = mode_});
    given_.path.push_back({.source = {.index = index}, .origin = Origin::programmed, .path = path});
  }
  // Steps per block of the path.
  [[nodiscard]] double cost() const {
    const ClearanceReport report = measure_clearance(given_.programmed, given_.path, allowed);
    EXPECT_EQ(report.gouging, 0U);
    EXPECT_GT(report.checked, 0U);
    return static_cast<double>(report.steps) / static_cast<double>(report.checked);
  }
  [[nodiscard]] const Measured& given() const { return given_; }

 private:
  std::shared_ptr<const TrcMode> mode_;
  Measured given_;
};

// Half circles about one centre, ring after ring, with steps between them.
Pairs rings(std::size_t blocks) {
  Pairs pairs(1);
  const std::size_t count = blocks / 3;
  for (std::size_t ring = 0; ring < count; ++ring) {
    const double radius = 10 + 5 * static_cast<double>(ring);
    for (const double from : {0.1, 0.1 + pi}) {
      const auto half = [&](double r) {
        return Arc{on_circle(Point::Zero(), r, from), on_circle(Point::Zero(), r, from + pi),
                   Point::Zero(), pi};
      };
      pairs.add(half(radius - 1), half(radius));
    }
    const auto step = [&](double along) {
      return Line{on_circle(Point::Zero(), radius + along, 0.1),
                  on_circle(Point::Zero(), radius + along + 3, 0.1)};
    };
    pairs.add(Line{start_of(step(-1)) + Point(-1e3, 1e6), start_of(step(-1)) + Point(-1e3, 1e6)},
              step(0));
  }
  return pairs;
}

// Slanted lines to and fro, far longer than they are apart.
Pairs hatch(std::size_t blocks) {
  Pairs pairs(1);
  const Vector along = on_circle(Point::Zero(), 1e4, 0.4);
  const Vector across = 3 * left_of(along.normalized());
  for (std::size_t i = 0; i < blocks; ++i) {
    const Point start = static_cast<double>(i) * across;
    const Vector offset = left_of(along.normalized());
    Line wall{start, start + along};
    Line path{start + offset, start + along + offset};
    if (i % 2 == 1) {
      // Left of the way back is the other side: the lines are 5 mm and 1 mm apart in turn.
      wall = {start + along + offset, start + offset};
      path = {start + along, start};
    }
    pairs.add(path, wall);
  }
  return pairs;
}

// A tool that just fits into a ring of short lines: its path stands still, and every wall is as far
// away.
Pairs fitting(std::size_t blocks, double room) {
  const double radius = 5 + room;
  Pairs pairs(5 - 1e-7);
  const auto corner = [&](std::size_t number, double r) {
    return on_circle(Point::Zero(), r,
                     2 * pi * static_cast<double>(number) / static_cast<double>(blocks));
  };
  for (std::size_t i = 0; i < blocks; ++i) {
    // The walls are tangents of the circle, so that none is nearer.
    const double outer = radius / std::cos(pi / static_cast<double>(blocks));
    pairs.add(Line{corner(i, room), corner(i + 1, room)},
              Line{corner(i, outer), corner(i + 1, outer)});
  }
  return pairs;
}

// A fitting ring beside a wall far away: the middle of all walls is not that of the ring.
Pairs fitting_beside(std::size_t blocks, double room) {
  Pairs pairs = fitting(blocks, room);
  pairs.add(Line{{900, 30}, {900, 31}}, Line{{905 + room, 30}, {905 + room, 31}});
  return pairs;
}

// Blocks far shorter than the tool, on a circle.
Pairs fine(std::size_t blocks) { return fitting(blocks, 45); }

TEST(Judged, EqualDistances) {
  expect_as_judged(rings(300).given(), "rings");
  expect_as_judged(hatch(300).given(), "hatch");
  expect_as_judged(fitting(300, 0).given(), "fitting");
  for (const double room : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1}) {
    expect_as_judged(fitting(300, room).given(), "fitting with room " + std::to_string(room));
    expect_as_judged(fitting_beside(300, room).given(), "beside, room " + std::to_string(room));
  }
  expect_as_judged(fine(300).given(), "fine");
}

// The cost is n·log n: with ten times as many blocks, each costs hardly more.
TEST(Judged, EqualDistancesCostLittle) {
  const auto expect_cheap = [](auto pairs, const char* what) {
    const double few = pairs(2'000).cost();
    const double many = pairs(20'000).cost();
    EXPECT_LT(few, 100) << what;
    EXPECT_LT(many, 1.5 * few + 10) << what;
  };
  expect_cheap(rings, "rings");
  expect_cheap(hatch, "hatch");
  expect_cheap([](std::size_t blocks) { return fitting(blocks, 0); }, "fitting");
  expect_cheap(fine, "fine");
}

// A tool goes round with a little room: all walls are nearly as far as the nearest one.
TEST(Judged, RoomToSpareCostsLittle) {
  for (const double room : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1})
    for (const std::size_t blocks : {2'000U, 8'000U, 20'000U}) {
      EXPECT_LT(fitting(blocks, room).cost(), 250) << blocks << ", room " << room;
      EXPECT_LT(fitting_beside(blocks, room).cost(), 250) << blocks << ", room " << room;
    }
}

// A contour the tool fits into anywhere.
Measured measured_with_room(BigShape shape, std::size_t count) {
  const std::vector<Segment> blocks = big_contour(shape, count);
  TrcMode mode;
  mode.side = Side::right;
  mode.tool_radius = 0.3;
  mode.transition = Transition::circular;
  const Point start = start_of(blocks.front());
  const Point outside = start + start.normalized();
  const Contour contour{
      .approach = Line{outside, start}, .blocks = blocks, .retract = Line{start, outside}};
  return measured(contour, mode, compensate(contour, mode).blocks);
}

TEST(Judged, ShapesWithRoomCostTheSameABlock) {
  for (const BigShape shape : {BigShape::comb, BigShape::gear, BigShape::spiral})
    for (const std::size_t count : {1'000U, 10'000U, 100'000U}) {
      const Measured given = measured_with_room(shape, count);
      const ClearanceReport found = measure_clearance(given.programmed, given.path, allowed);
      EXPECT_GE(found.checked, count);
      EXPECT_EQ(found.gouging, 0U);
      EXPECT_LT(found.steps, 30 * found.checked) << name_of(shape) << ", " << count;
    }
}

// A client that has gone ends its measurement: the work passes its checkpoint all the time and says
// how far it is. A thousand blocks take no more than some milliseconds.
TEST(Judged, IsInterruptedAllTheTime) {
  for (const BigShape shape : {BigShape::wave, BigShape::gear, BigShape::spiral}) {
    const Measured given = measured_with_room(shape, 100'000);
    verify::MeasuredPath held;
    for (const Block& block : given.programmed) held.add(std::get<MotionBlock>(block));
    for (const CompensatedBlock& block : given.path) held.add(block);
    const std::size_t all = held.path().end() - held.path().begin();
    std::vector<std::size_t> told;
    std::size_t passed = 0;
    std::size_t passed_before = 0;
    std::size_t told_before = 0;
    std::size_t most_blocks = 0;  // between two times that it passes by
    Checkpoint checkpoint([&] {
      ++passed;
      if (told.size() == 1) ++passed_before;
      most_blocks = std::max(most_blocks, told.back() - std::exchange(told_before, told.back()));
    });
    const ClearanceReport found = measure_clearance(held, held.programmed().end(),
                                                    {.allowed = allowed,
                                                     .progress =
                                                         [&](std::size_t measured, std::size_t of) {
                                                           EXPECT_EQ(of, all);
                                                           told.push_back(measured);
                                                         }},
                                                    checkpoint);
    EXPECT_GE(found.checked, 100'000U);
    EXPECT_GT(passed, 1'000U) << name_of(shape);
    EXPECT_GT(passed_before, 1'000U) << name_of(shape) << ", while walls are looked for";
    EXPECT_LT(most_blocks, 1'000U) << name_of(shape);
    EXPECT_EQ(told.front(), 0U);
    EXPECT_EQ(told.back(), all);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_GT(told.size(), 1'000U) << name_of(shape);
  }
}

// An exception that the checkpoint throws ends the measurement.
TEST(Judged, IsMeasuredNoFurtherOnceNobodyWaits) {
  const Measured given = measured_with_room(BigShape::wave, 100'000);
  verify::MeasuredPath held;
  for (const Block& block : given.programmed) held.add(std::get<MotionBlock>(block));
  for (const CompensatedBlock& block : given.path) held.add(block);
  struct Gone {};
  std::size_t measured = 0;
  bool is_gone = false;
  Checkpoint checkpoint([&] {
    if (is_gone) throw Gone{};
    is_gone = measured > 50'000;
  });
  EXPECT_THROW(static_cast<void>(measure_clearance(
                   held, held.programmed().end(),
                   {.allowed = allowed,
                    .progress = [&](std::size_t blocks, std::size_t) { measured = blocks; }},
                   checkpoint)),
               Gone);
  EXPECT_GT(measured, 50'000U);
  EXPECT_LT(measured, 52'000U);
}

}  // namespace
}  // namespace trc::support
