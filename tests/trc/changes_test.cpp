#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "tests/support/run.h"
#include "tests/support/slow_clearance.h"

// Modes and changes that are composed of what the slow computation knows:
// changes of side and radius in the middle of a contour, and the selection modes
// G236 and G237 and G05. Random contours; each failure prints its seed.

namespace trc::support {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::uint64_t contours = 250;

struct Sample {
  TrcMode mode{};
  Contour contour{};
};

// A contour without violation, for G138 or G139.
Sample clean_sample(std::uint64_t seed, Flavor flavor) {
  Random random(seed);
  Sample result;
  result.mode = random_mode(random);
  if (result.mode.selection == Selection::without_block) result.mode.selection = Selection::direct;
  result.contour = random_clean_contour(random, flavor, result.mode, 5);
  return result;
}

template <class Claim>
void for_each_sample(std::uint64_t first_seed, const Claim& claim) {
  for (const Flavor flavor : {Flavor::mixed, Flavor::lines, Flavor::convex})
    for (std::uint64_t k = 0; k < contours && !::testing::Test::HasFailure(); ++k) {
      const std::uint64_t seed = first_seed + 10'000 * static_cast<std::uint64_t>(flavor) + k;
      const Sample tested = clean_sample(seed, flavor);
      std::ostringstream story;
      story << "seed " << seed << ", " << name_of(flavor) << ", " << text_of(tested.mode) << '\n'
            << tested.contour;
      SCOPED_TRACE(story.str());
      claim(tested);
    }
}

bool judged_clean(const SlowOutcome& outcome) {
  return outcome.faults.empty() && !outcome.borderline;
}

double tolerance_for(const Contour& contour, const TrcMode& mode) {
  double size = 1 + mode.tool_radius + contour.retract.end.norm();
  for (const Segment& block : contour.blocks) size = std::max(size, point_at(block, 1).norm());
  return 1e-6 * size;
}

// Rule 9.0: leaving by the retract rule of the old side, coming by the
// approach rule of the new one, and a straight line between.
TEST(SideChange, IsADeselectionAndASelectionOnOneLine) {
  std::size_t judged = 0;
  for_each_sample(1'000'000, [&](const Sample& first) {
    Random random(static_cast<std::uint64_t>(first.contour.blocks.size()) * 77 + 5);
    TrcMode second_mode = first.mode;
    second_mode.side = other(first.mode.side);
    Contour second = random_clean_contour(random, Flavor::mixed, second_mode, 5);
    const Point end = point_at(first.contour.blocks.back(), 1);
    second = Motion{.shift = end - second.approach.start}(second);
    second.approach.start = end;
    Contour left = first.contour;
    left.retract = second.approach;
    const SlowOutcome before = slow_trc(left, first.mode);
    const SlowOutcome after = slow_trc(second, second_mode);
    if (!judged_clean(before) || !judged_clean(after)) return;
    ++judged;

    std::vector<SlowBlock> expected(before.path.begin(), before.path.end() - 1);
    SlowBlock change;
    change.start = before.path.back().start;
    change.end = after.path.front().end;
    expected.push_back(change);
    expected.insert(expected.end(), after.path.begin() + 1, after.path.end());

    Channel channel(first.mode, left.approach.start);
    channel.note(channel.program().select(first.mode.side, channel.place(0)));
    channel.move(left.approach, 0);
    std::size_t ordinal = 0;
    for (const Segment& block : left.blocks) channel.move(block, ++ordinal);
    channel.note(channel.program().select(second_mode.side, channel.place(ordinal + 1)));
    channel.move(second.approach, ++ordinal);
    for (const Segment& block : second.blocks) channel.move(block, ++ordinal);
    channel.note(channel.program().deselect(channel.place(ordinal + 1)));
    channel.move(second.retract, ++ordinal);
    const Outcome outcome = channel.finish(ordinal);
    ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
    EXPECT_EQ(first_gap(outcome.blocks), "");
    const double tolerance = tolerance_for(left, first.mode) + tolerance_for(second, second_mode);
    EXPECT_EQ(geometric_difference(outcome.blocks, expected, tolerance), "") << second;
  });
  EXPECT_GT(judged, contours);
}

// REVERSE=1: there and back on the other side is the same path twice.
TEST(Reverse, GoesBackOnThePathItCameBy) {  // D-141
  for_each_sample(2'000'000, [&](const Sample& tested) {
    TrcMode mode = tested.mode;
    mode.selection = Selection::direct;
    mode.options.reverse = true;
    const SlowOutcome there = slow_trc(tested.contour, mode);
    if (!judged_clean(there)) return;
    const Contour back = reversed(tested.contour);

    Channel channel(mode, tested.contour.approach.start);
    channel.note(channel.program().select(mode.side, channel.place(0)));
    channel.move(tested.contour.approach, 0);
    std::size_t ordinal = 0;
    for (const Segment& block : tested.contour.blocks) channel.move(block, ++ordinal);
    channel.note(channel.program().select(other(mode.side), channel.place(ordinal + 1)));
    for (const Segment& block : back.blocks) channel.move(block, ++ordinal);
    channel.note(channel.program().deselect(channel.place(ordinal + 1)));
    channel.move(back.retract, ++ordinal);
    const Outcome outcome = channel.finish(ordinal);
    ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());

    std::vector<SlowBlock> expected(there.path.begin(), there.path.end() - 1);
    for (std::size_t k = there.path.size() - 1; k-- > 0;) {
      SlowBlock block = there.path[k];
      std::swap(block.start, block.end);
      block.sweep = -block.sweep;
      expected.push_back(block);
    }
    EXPECT_EQ(first_gap(outcome.blocks), "");
    EXPECT_EQ(geometric_difference(outcome.blocks, expected, tolerance_for(tested.contour, mode)),
              "")
        << text_of(outcome.blocks);
  });
}

// D-23 and D-14: within 0.001 degrees of a reversal the two blocks share the point at R from
// the first one. It is at R from the second one, too, to less than the clearance of D-36: the
// two perpendicular points lie beside each other along the contour, not across it. What the
// second block rises into the strip of the first (0.4 um on 50 mm) is in the program.
TEST(Reverse, KeepsBothBlocksAtTheirRadiusWithinItsTolerance) {
  const Tolerances tolerances;
  for (const double radius : {0.5, 10.0, 200.0})
    for (const double off : {-1.7e-5, -8e-6, 0.0, 8e-6, 1.7e-5})
      for (const Side side : {Side::left, Side::right}) {
        TrcMode mode;
        mode.tool_radius = radius;
        mode.side = side;
        mode.selection = Selection::direct;
        mode.options.reverse = true;
        const Line there{.start = {0, 0}, .end = {100, 0}};
        const Line back{.start = {100, 0}, .end = {100 - 50 * std::cos(off), 50 * std::sin(off)}};
        Channel channel(mode, {-30, 0});
        channel.note(channel.program().select(side, channel.place(0)));
        channel.move(Line{.start = {-30, 0}, .end = there.start}, 0);
        channel.move(there, 1);
        channel.note(channel.program().select(other(side), channel.place(2)));
        channel.move(back, 2);
        channel.note(channel.program().deselect(channel.place(3)));
        channel.move(Line{.start = back.end, .end = {20, 0}}, 3);
        const Outcome outcome = channel.finish(3);
        ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
        EXPECT_EQ(first_gap(outcome.blocks), "");
        ASSERT_EQ(outcome.blocks.size(), 4U) << "nothing is inserted";
        const double hand = side == Side::left ? 1 : -1;
        const Line& first = std::get<Line>(outcome.blocks[1].path);
        const Line& second = std::get<Line>(outcome.blocks[2].path);
        EXPECT_EQ(first.end, Point(100, hand * radius));
        const double slack = tolerances.clearance * std::max(radius, 1.0);
        for (const Point& point : {second.start, second.end}) {
          EXPECT_NEAR(slow_distance(point, back), radius, slack) << off;
          EXPECT_GE(slow_distance(point, there), radius - std::max(-hand * 50 * off, 0.0) - slack);
        }
      }
}

// The tool radius changes from `mode.tool_radius` to `radius` before block `at`.
Outcome with_radius_change(const Contour& contour, const TrcMode& mode, std::size_t at,
                           double radius) {
  Channel channel(mode, contour.approach.start);
  channel.note(channel.program().select(mode.side, channel.place(0)));
  channel.move(contour.approach, 0);
  std::size_t ordinal = 0;
  for (const Segment& block : contour.blocks) {
    if (++ordinal == at) channel.note(channel.program().set_tool_radius(radius, channel.place(at)));
    channel.move(block, ordinal);
  }
  channel.note(channel.program().deselect(channel.place(ordinal + 1)));
  channel.move(contour.retract, ++ordinal);
  return channel.finish(ordinal);
}

std::size_t place_of_block(const SlowOutcome& outcome, std::size_t ordinal) {
  std::size_t k = 0;
  while (outcome.path[k].ordinal != ordinal || outcome.path[k].origin != Origin::programmed) ++k;
  return k;
}

// Calls `claim(sample, block, old path, new path, outcome)` for radius changes
// before a block that is a line, or an arc of at most half a turn.
template <class Claim>
std::size_t for_each_radius_change(std::uint64_t first_seed, bool perpendicular,
                                   const Claim& claim) {
  std::size_t judged = 0;
  for_each_sample(first_seed, [&](const Sample& tested) {
    if (tested.contour.blocks.size() < 2) return;
    TrcMode before = tested.mode;
    before.options.perpendicular_radius_change = perpendicular;
    TrcMode after = before;
    after.tool_radius *= tested.contour.blocks.size() % 2 == 0 ? 1.1 : 0.9;
    const std::size_t at = 2 + tested.contour.blocks.size() % (tested.contour.blocks.size() - 1);
    const SlowOutcome old_path = slow_trc(tested.contour, before);
    const SlowOutcome new_path = slow_trc(tested.contour, after);
    if (!judged_clean(old_path) || !judged_clean(new_path)) return;
    const Outcome outcome = with_radius_change(tested.contour, before, at, after.tool_radius);
    if (outcome.stopped) return;  // the tapered block may be the one that is violated
    ++judged;
    EXPECT_EQ(first_gap(outcome.blocks), "");
    claim(tested, at, old_path, new_path, after.tool_radius, outcome);
  });
  return judged;
}

TEST(RadiusChange, TapersTheBlockBetweenTheOldAndTheNewCorner) {  // D-20
  const std::size_t judged = for_each_radius_change(
      3'000'000, false,
      [](const Sample& tested, std::size_t at, const SlowOutcome& old_path,
         const SlowOutcome& new_path, double, const Outcome& outcome) {
        const Segment& programmed = tested.contour.blocks[at - 1];
        const auto* arc = std::get_if<Arc>(&programmed);
        if (arc != nullptr && std::abs(arc->sweep) > pi) return;
        const std::size_t k_old = place_of_block(old_path, at);
        const std::size_t k_new = place_of_block(new_path, at);
        std::vector<SlowBlock> expected(old_path.path.begin(),
                                        old_path.path.begin() + static_cast<long>(k_old));
        SlowBlock taper = old_path.path[k_old];
        taper.end = new_path.path[k_new].end;
        if (arc != nullptr) {
          // The programmed centre, projected on the bisector of the new ends.
          const Point start = narrow(taper.start);
          const Point end = narrow(taper.end);
          const Vector chord = (end - start).normalized();
          const Vector normal{-chord.y(), chord.x()};
          const Point middle = (start + end) / 2;
          const Point center = middle + normal.dot(arc->center - middle) * normal;
          const Vector from = start - center;
          const Vector to = end - center;
          double sweep = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
          if (sweep * arc->sweep < 0) sweep += arc->sweep > 0 ? 2 * pi : -2 * pi;
          taper.center = wide(center);
          taper.sweep = sweep;
        }
        expected.push_back(taper);
        expected.insert(expected.end(), new_path.path.begin() + static_cast<long>(k_new) + 1,
                        new_path.path.end());
        EXPECT_EQ(geometric_difference(outcome.blocks, expected,
                                       10 * tolerance_for(tested.contour, tested.mode)),
                  "")
            << "change before block " << at << '\n'
            << text_of(outcome.blocks);
      });
  EXPECT_GT(judged, contours / 2);
}

// A slope up to a half circle whose end is `low` too low, and into a rise after it.
Outcome over_half_a_circle(double low) {
  const Point start(0, 10);
  const Point end(20, 10 - low);
  const Point middle = 0.5 * (start + end);
  const double half = 0.5 * (end - start).norm();
  const Point center = middle + low / 2 * left_of((end - start).normalized());
  const Arc arc{
      .start = start, .end = end, .center = center, .sweep = -pi - 2 * std::atan(low / 2 / half)};
  TrcMode mode;
  mode.side = Side::left;
  mode.tool_radius = 2;
  const Contour contour{.approach = {{-20, -10}, {0, 0}},
                        .blocks = {Line{{0, 0}, start}, arc, Line{end, {40, 20}}},
                        .retract = {{40, 20}, {50, 30}}};
  return with_radius_change(contour, mode, 2, 1.7);
}

TEST(RadiusChange, AnArcCutShortBeforeHalfATurnIsNotSplit) {  // D-20
  const Outcome exact = over_half_a_circle(0);
  ASSERT_FALSE(exact.stopped);
  for (const double low : {1e-4, 1e-3, 3e-3, 0.5}) {
    SCOPED_TRACE(low);
    const Outcome outcome = over_half_a_circle(low);
    ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
    EXPECT_EQ(first_gap(outcome.blocks), "");
    for (const CompensatedBlock& block : outcome.blocks)
      EXPECT_NE(block.origin, Origin::radius_change);
    // Lower down the slope and the arc are no longer tangential.
    if (low > 0.01) continue;
    ASSERT_EQ(outcome.blocks.size(), exact.blocks.size());
    for (std::size_t k = 0; k < exact.blocks.size(); ++k)
      EXPECT_LE((end_of(outcome.blocks[k].path) - end_of(exact.blocks[k].path)).norm(), low);
  }
}

TEST(RadiusChange, PerpendicularInsertsOneLineAcrossTheContour) {  // D-21
  const std::size_t judged = for_each_radius_change(
      4'000'000, true,
      [](const Sample& tested, std::size_t at, const SlowOutcome& old_path,
         const SlowOutcome& new_path, double radius, const Outcome& outcome) {
        const auto* line = std::get_if<Line>(&tested.contour.blocks[at - 1]);
        if (line == nullptr) return;
        const std::size_t k_old = place_of_block(old_path, at);
        const std::size_t k_new = place_of_block(new_path, at);
        const Vector along = (line->end - line->start).normalized();
        const double hand = tested.mode.side == Side::left ? 1 : -1;
        const Point from = narrow(old_path.path[k_old].start);
        const Point to =
            from + hand * (radius - tested.mode.tool_radius) * Vector(-along.y(), along.x());
        std::vector<SlowBlock> expected(old_path.path.begin(),
                                        old_path.path.begin() + static_cast<long>(k_old));
        SlowBlock step;
        step.start = wide(from);
        step.end = wide(to);
        expected.push_back(step);
        SlowBlock rest = new_path.path[k_new];
        rest.start = wide(to);
        expected.push_back(rest);
        expected.insert(expected.end(), new_path.path.begin() + static_cast<long>(k_new) + 1,
                        new_path.path.end());
        EXPECT_EQ(geometric_difference(outcome.blocks, expected,
                                       10 * tolerance_for(tested.contour, tested.mode)),
                  "")
            << "change before block " << at << '\n'
            << text_of(outcome.blocks);
        EXPECT_EQ(std::count_if(outcome.blocks.begin(), outcome.blocks.end(),
                                [](const CompensatedBlock& block) {
                                  return block.origin == Origin::radius_change;
                                }),
                  1);
      });
  EXPECT_GT(judged, contours / 2);
}

// Rule 3.4: the block programmed with G41 is the first contour block.
TEST(Perpendicular, StepsSidewaysAtBothEnds) {
  for_each_sample(5'000'000, [](const Sample& tested) {
    Contour contour = tested.contour;
    contour.blocks.insert(contour.blocks.begin(), contour.approach);
    contour.approach = {.start = contour.approach.start - Vector(100, 30),
                        .end = contour.approach.start};
    TrcMode mode = tested.mode;
    mode.selection = Selection::direct;
    const SlowOutcome direct = slow_trc(contour, mode);
    if (!judged_clean(direct)) return;
    std::vector<SlowBlock> expected = direct.path;
    expected.front().start = wide(contour.approach.end);
    SlowBlock leave = expected.back();
    leave.end = wide(contour.retract.start);
    expected.back().start = leave.end;
    expected.insert(expected.end() - 1, leave);

    mode.selection = Selection::perpendicular;
    Channel channel(mode, contour.approach.end);
    channel.note(channel.program().select(mode.side, channel.place(0)));
    std::size_t ordinal = 0;
    for (const Segment& block : contour.blocks) channel.move(block, ordinal++);
    channel.note(channel.program().deselect(channel.place(ordinal)));
    channel.move(contour.retract, ordinal);
    const Outcome outcome = channel.finish(ordinal);
    ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
    EXPECT_EQ(first_gap(outcome.blocks), "");
    EXPECT_EQ(geometric_difference(outcome.blocks, expected, tolerance_for(contour, mode)), "")
        << text_of(outcome.blocks);
    EXPECT_EQ(outcome.blocks.back().origin, Origin::uncompensated);
  });
}

double transition_angle(const Vector& before, const Vector& after, Side side) {
  const double turn =
      std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
  return pi - (side == Side::left ? turn : -turn);
}

// Rule 3.3 and D-02, for 90 degrees and more; sharper ones are T-19.
TEST(OnThePath, TurnsAboutTheCornersFromThePathAndBackToIt) {
  std::size_t judged = 0;
  for_each_sample(6'000'000, [&](const Sample& tested) {
    TrcMode mode = tested.mode;
    mode.selection = Selection::direct;
    const Contour& contour = tested.contour;
    const double hand = mode.side == Side::left ? 1 : -1;
    const double radius = mode.tool_radius;
    const Vector in = start_tangent(contour.approach);
    const Vector out = start_tangent(contour.retract);
    const double entry = transition_angle(in, start_tangent(contour.blocks.front()), mode.side);
    const double exit = transition_angle(end_tangent(contour.blocks.back()), out, mode.side);
    if (entry < pi / 2 + 1e-3 || exit < pi / 2 + 1e-3 || entry > 2 * pi - 1e-3 ||
        exit > 2 * pi - 1e-3)
      return;
    if ((contour.retract.end - contour.retract.start).norm() < radius) return;
    const SlowOutcome direct = slow_trc(contour, mode);
    if (!judged_clean(direct)) return;
    ++judged;
    std::vector<SlowBlock> expected(direct.path.begin() + 1, direct.path.end() - 1);
    const Point corner = contour.approach.end;
    const Point last = contour.retract.start;
    SlowBlock way_in;
    way_in.start = wide(contour.approach.start);
    way_in.end = wide(corner - radius * in);
    SlowBlock turn_in;
    turn_in.is_arc = true;
    turn_in.start = way_in.end;
    turn_in.end = direct.path.front().end;
    turn_in.center = wide(corner);
    turn_in.sweep = -hand * (entry - pi / 2);
    SlowBlock turn_out = turn_in;
    turn_out.start = direct.path.back().start;
    turn_out.end = wide(last + radius * out);
    turn_out.center = wide(last);
    turn_out.sweep = -hand * (exit - pi / 2);
    SlowBlock way_out;
    way_out.start = turn_out.end;
    way_out.end = wide(contour.retract.end);
    expected.insert(expected.begin(), {way_in, turn_in});
    expected.push_back(turn_out);
    expected.push_back(way_out);

    mode.selection = Selection::on_path;
    const Outcome outcome = compensate(contour, mode);
    ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
    EXPECT_EQ(first_gap(outcome.blocks), "");
    EXPECT_EQ(geometric_difference(outcome.blocks, expected, tolerance_for(contour, mode)), "")
        << text_of(outcome.blocks);
  });
  EXPECT_GT(judged, contours / 4);
}

// Rule 3.7: the arc comes from the start and runs into the direct
// selection point along the contour; the exit likewise.
TEST(Tangential, RunsIntoAndOutOfTheContourWithoutAKink) {
  for_each_sample(7'000'000, [](const Sample& tested) {
    TrcMode mode = tested.mode;
    mode.selection = Selection::direct;
    const Contour& contour = tested.contour;
    const SlowOutcome direct = slow_trc(contour, mode);
    if (!judged_clean(direct)) return;
    const Vector first = start_tangent(contour.blocks.front());
    const Vector last = end_tangent(contour.blocks.back());
    const Point in = narrow(direct.path.front().end);
    const Point out = narrow(direct.path.back().start);
    const auto across = [](const Vector& d, const Vector& v) {
      return std::abs(d.x() * v.y() - d.y() * v.x()) / v.norm();
    };
    // A start nearly on the tangent makes an arc beyond all coordinates (D-04).
    if (across(first, contour.approach.start - in) < 1e-3 ||
        across(last, contour.retract.end - out) < 1e-3)
      return;

    Channel channel(mode, contour.approach.start);
    channel.note(channel.program().set_tangential(channel.place(0)));
    channel.note(channel.program().select(mode.side, channel.place(0)));
    channel.move(contour.approach, 0);
    std::size_t ordinal = 0;
    for (const Segment& block : contour.blocks) channel.move(block, ++ordinal);
    channel.note(channel.program().set_tangential(channel.place(ordinal + 1)));
    channel.note(channel.program().deselect(channel.place(ordinal + 1)));
    channel.move(contour.retract, ++ordinal);
    const Outcome outcome = channel.finish(ordinal);
    ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
    EXPECT_EQ(first_gap(outcome.blocks), "");

    const std::vector<CompensatedBlock> path = moving(outcome.blocks);
    const double tolerance = 10 * tolerance_for(contour, mode);
    ASSERT_TRUE(is_arc(path.front().path)) << text_of(outcome.blocks);
    ASSERT_TRUE(is_arc(path.back().path)) << text_of(outcome.blocks);
    EXPECT_NEAR((start_tangent(path.back().path) - last).norm(), 0, 1e-6);
    EXPECT_NEAR((end_tangent(path.front().path) - first).norm(), 0, 1e-6);
    EXPECT_EQ(std::get<Arc>(path.front().path).start, contour.approach.start);
    EXPECT_EQ(std::get<Arc>(path.back().path).end, contour.retract.end);
    EXPECT_NEAR((point_at(path.front().path, 1) - in).norm(), 0, tolerance);
    std::vector<CompensatedBlock> middle(path.begin() + 1, path.end() - 1);
    EXPECT_EQ(
        geometric_difference(middle, {direct.path.begin() + 1, direct.path.end() - 1}, tolerance),
        "");
  });
}

}  // namespace
}  // namespace trc::support
