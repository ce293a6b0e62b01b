#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "tests/support/run.h"

// The table of inserted blocks, rule 4.2, and the geometry it stands
// for (T-10). The corner lies in the middle of a contour of two blocks whose
// approach and retract blocks are collinear with it, so that nothing but the
// corner inserts blocks.

namespace trc::support {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double radius = 5;
constexpr double arc_radius = 60;
constexpr double heading = 0.3;  // of the block before the corner, rad
const Point corner{12, -7};

Vector direction(double angle) { return {std::cos(angle), std::sin(angle)}; }
Vector left(const Vector& v) { return {-v.y(), v.x()}; }

// Which way an arc bends, seen along its travel.
enum class Bend { straight, left, right };

// A block that ends in `end` with direction `travel`, or starts there.
Segment block_before(const Point& end, const Vector& travel, Bend bend) {
  if (bend == Bend::straight) return Line{.start = end - 50 * travel, .end = end};
  const double sense = bend == Bend::left ? 1 : -1;
  const Point center = end + sense * arc_radius * left(travel);
  const Vector spoke = end - center;
  const double sweep = sense * 0.8;
  const Vector start{spoke.x() * std::cos(sweep) + spoke.y() * std::sin(sweep),
                     spoke.y() * std::cos(sweep) - spoke.x() * std::sin(sweep)};
  return Arc{.start = center + start, .end = end, .center = center, .sweep = sweep};
}

Segment block_after(const Point& start, const Vector& travel, Bend bend) {
  return reversed(block_before(start, -travel,
                               bend == Bend::left    ? Bend::right
                               : bend == Bend::right ? Bend::left
                                                     : bend));
}

Vector tangent(const Segment& segment, bool at_end) {
  if (const auto* line = std::get_if<Line>(&segment)) return (line->end - line->start).normalized();
  const auto& arc = std::get<Arc>(segment);
  const Vector spoke = (at_end ? arc.end : arc.start) - arc.center;
  return (arc.sweep > 0 ? left(spoke) : Vector(-left(spoke))).normalized();
}

// G41 along `heading` and then round a corner of `angle` degrees on the tool side.
Contour corner_contour(double angle, Bend before, Bend after) {
  const double turn = pi - angle * pi / 180;
  Contour contour;
  contour.blocks = {block_before(corner, direction(heading), before),
                    block_after(corner, direction(heading + turn), after)};
  const Point start = point_at(contour.blocks.front(), 0);
  const Point end = point_at(contour.blocks.back(), 1);
  contour.approach = {.start = start - 20 * tangent(contour.blocks.front(), false), .end = start};
  contour.retract = {.start = end, .end = end + 20 * tangent(contour.blocks.back(), true)};
  return contour;
}

TrcMode mode_for(Transition transition) {
  TrcMode mode;
  mode.side = Side::left;
  mode.tool_radius = radius;
  mode.selection = Selection::indirect;
  mode.transition = transition;
  return mode;
}

std::vector<CompensatedBlock> with_origin(const std::vector<CompensatedBlock>& blocks,
                                          Origin origin) {
  std::vector<CompensatedBlock> result;
  for (const CompensatedBlock& block : blocks)
    if (block.origin == origin) result.push_back(block);
  return result;
}

// What the corner looks like, from the rules of sections 2 and 4.2.
struct Corner {
  Vector d1 = direction(heading);
  Vector d2 = Vector::Zero();
  Point q = Point::Zero();
  Point p = Point::Zero();
  double extension = 0;  // from Q to the corner point X, mm

  explicit Corner(double angle)
      : d2(direction(heading + pi - angle * pi / 180)),
        q(corner + radius * left(d1)),
        p(corner + radius * left(d2)),
        extension(radius * std::tan((angle - 180) / 2 * pi / 180)) {}
};

void expect_at(const Point& actual, const Point& expected, const char* what) {
  EXPECT_NEAR(actual.x(), expected.x(), 1e-9) << what;
  EXPECT_NEAR(actual.y(), expected.y(), 1e-9) << what;
}

const Point& start(const CompensatedBlock& block) {
  return std::visit([](const auto& shape) -> const Point& { return shape.start; }, block.path);
}
const Point& end(const CompensatedBlock& block) {
  return std::visit([](const auto& shape) -> const Point& { return shape.end; }, block.path);
}

// On the equidistant of a programmed block, or on its extension.
void expect_on_equidistant(const Point& point, const Segment& programmed) {
  if (const auto* line = std::get_if<Line>(&programmed)) {
    const Vector along = (line->end - line->start).normalized();
    EXPECT_NEAR(left(along).dot(point - line->start), radius, 1e-9);
    return;
  }
  const auto& arc = std::get<Arc>(programmed);
  const double expected = arc.sweep > 0 ? arc_radius - radius : arc_radius + radius;
  EXPECT_NEAR((point - arc.center).norm(), expected, 1e-9);
}

struct Sequence {
  const char* name;
  Bend before;
  Bend after;
  // The table's rows: blocks inserted by G25 up to 270 degrees and above.
  std::size_t blunt;
  std::size_t acute;
};

constexpr Sequence sequences[] = {
    {"LinLin", Bend::straight, Bend::straight, 0, 1},
    {"LinCirLeft", Bend::straight, Bend::left, 1, 2},
    {"LinCirRight", Bend::straight, Bend::right, 1, 2},
    {"CirLinLeft", Bend::left, Bend::straight, 1, 2},
    {"CirLinRight", Bend::right, Bend::straight, 1, 2},
    {"CirCirLeft", Bend::left, Bend::left, 2, 3},
    {"CirCirRight", Bend::right, Bend::right, 2, 3},
    {"CirCirChanging", Bend::left, Bend::right, 2, 3},
};

void PrintTo(const Sequence& sequence, std::ostream* out) { *out << sequence.name; }

class CornerTable : public ::testing::TestWithParam<std::tuple<double, Sequence, Transition>> {
 protected:
  [[nodiscard]] double angle() const { return std::get<0>(GetParam()); }
  [[nodiscard]] Sequence sequence() const { return std::get<1>(GetParam()); }
  [[nodiscard]] Transition transition() const { return std::get<2>(GetParam()); }
  [[nodiscard]] bool before_is_line() const { return sequence().before == Bend::straight; }
  [[nodiscard]] bool after_is_line() const { return sequence().after == Bend::straight; }
  [[nodiscard]] Contour contour() const {
    return corner_contour(angle(), sequence().before, sequence().after);
  }
  [[nodiscard]] std::size_t expected_count() const {
    if (angle() <= 180) return 0;
    if (transition() == Transition::circular) return 1;
    return angle() <= 270 ? sequence().blunt : sequence().acute;
  }
};

TEST_P(CornerTable, InsertsWhatTheTableSays) {
  const Outcome outcome = compensate(contour(), mode_for(transition()));
  ASSERT_FALSE(outcome.stopped);
  EXPECT_EQ(with_origin(outcome.blocks, Origin::transition).size(), expected_count())
      << text_of(outcome.blocks);
  EXPECT_EQ(with_origin(outcome.blocks, Origin::programmed).size(), 2U);
  EXPECT_EQ(with_origin(outcome.blocks, Origin::approach).size(), 1U);
  EXPECT_EQ(with_origin(outcome.blocks, Origin::retract).size(), 1U);
  EXPECT_EQ(first_gap(outcome.blocks), "");
}

TEST_P(CornerTable, PutsTheJointWhereTheRulesSay) {
  const Outcome outcome = compensate(contour(), mode_for(transition()));
  ASSERT_FALSE(outcome.stopped);
  const auto programmed = with_origin(outcome.blocks, Origin::programmed);
  const auto inserted = with_origin(outcome.blocks, Origin::transition);
  ASSERT_EQ(programmed.size(), 2U);
  ASSERT_EQ(inserted.size(), expected_count());
  const Point before_end = end(programmed[0]);
  const Point after_start = start(programmed[1]);
  const Corner at(angle());

  if (angle() <= 180) {
    EXPECT_EQ(before_end, after_start);
    expect_on_equidistant(before_end, contour().blocks[0]);
    expect_on_equidistant(before_end, contour().blocks[1]);
    if (angle() == 180) expect_at(before_end, at.q, "Q");
    if (angle() == 180) expect_at(before_end, at.p, "P");
    return;
  }
  if (transition() == Transition::circular) {
    expect_at(before_end, at.q, "Q");
    expect_at(after_start, at.p, "P");
    ASSERT_TRUE(is_arc(inserted[0].path));
    const Arc& arc = std::get<Arc>(inserted[0].path);
    expect_at(arc.center, corner, "corner");
    EXPECT_NEAR(arc.sweep, -(angle() - 180) * pi / 180, 1e-9);
    return;
  }
  // G25: lines are stretched along themselves, arcs by tangent lines, to X or,
  // above 270 degrees, to A and B.
  const bool pointed = angle() <= 270;
  const Point a = at.q + (pointed ? at.extension : radius) * at.d1;
  const Point b = pointed ? a : Point(at.p - radius * at.d2);
  std::vector<Point> joints{before_end};
  for (const CompensatedBlock& block : inserted) {
    EXPECT_FALSE(is_arc(block.path));
    joints.push_back(end(block));
  }
  std::vector<Point> expected;
  if (!before_is_line()) expected.push_back(at.q);
  expected.push_back(a);
  if (!pointed) expected.push_back(b);
  if (!after_is_line()) expected.push_back(at.p);
  ASSERT_EQ(joints.size(), expected.size());
  for (std::size_t k = 0; k < joints.size(); ++k)
    expect_at(joints[k], expected[k], ("joint " + std::to_string(k)).c_str());
  expect_at(after_start, expected.back(), "start of the block after the corner");
}

TEST_P(CornerTable, IsMirroredWithTheOtherSide) {
  TrcMode mode = mode_for(transition());
  const Outcome left_side = compensate(contour(), mode);
  mode.side = Side::right;
  const Motion mirror{.mirrored = true};
  const Outcome right_side = compensate(mirror(contour()), mode);
  ASSERT_FALSE(right_side.stopped);
  EXPECT_EQ(difference(right_side.blocks, left_side.blocks, mirror, 1e-9), "");
}

TEST_P(CornerTable, TurnsAndShiftsWithTheProgram) {
  const Outcome here = compensate(contour(), mode_for(transition()));
  for (const double turn : {0.7, pi / 2, -2.5}) {
    const Motion motion{.turn = turn, .shift = {310, -45}};
    const Outcome there = compensate(motion(contour()), mode_for(transition()));
    ASSERT_FALSE(there.stopped);
    EXPECT_EQ(difference(there.blocks, here.blocks, motion, 1e-8), "");
  }
}

std::string name_of_case(
    const ::testing::TestParamInfo<std::tuple<double, Sequence, Transition>>& tested) {
  const auto& [angle, sequence, transition] = tested.param;
  const auto tenths = static_cast<int>(std::lround(angle * 10));
  return "Angle" + std::to_string(tenths / 10) + (tenths % 10 != 0 ? "AndAHalf" : "") +
         sequence.name + (transition == Transition::linear ? "G25" : "G26");
}

INSTANTIATE_TEST_SUITE_P(
    T10, CornerTable,
    ::testing::Combine(::testing::Values(90, 180, 180.5, 181, 225, 270, 271, 300, 350),
                       ::testing::ValuesIn(sequences),
                       ::testing::Values(Transition::linear, Transition::circular)),
    name_of_case);

// The tables of rule 3: at the corner between the selection block and the contour, and
// mirrored between the contour and the block of G40, the selection block counts as a line.
class SelectionTable : public ::testing::TestWithParam<std::tuple<double, Bend, Transition>> {
 protected:
  [[nodiscard]] double angle() const { return std::get<0>(GetParam()); }
  [[nodiscard]] Bend bend() const { return std::get<1>(GetParam()); }
  [[nodiscard]] Transition transition() const { return std::get<2>(GetParam()); }
  [[nodiscard]] bool goes_round_an_arc() const {
    return angle() > 180 && transition() == Transition::circular;
  }

  // One contour block that runs on tangentially into a straight retract.
  [[nodiscard]] Contour entry() const {
    Contour contour = corner_contour(angle(), Bend::straight, bend());
    contour.approach = std::get<Line>(contour.blocks.front());
    contour.blocks.erase(contour.blocks.begin());
    return contour;
  }
  [[nodiscard]] Contour exit() const {
    Contour contour = corner_contour(angle(), bend(), Bend::straight);
    contour.retract = std::get<Line>(contour.blocks.back());
    contour.blocks.pop_back();
    return contour;
  }
  // Where the straight way over the corner turns: X, or A and B.
  [[nodiscard]] std::vector<Point> turning_points() const {
    const Corner at(angle());
    if (angle() <= 270) return {at.q + at.extension * at.d1};
    return {at.q + radius * at.d1, at.p - radius * at.d2};
  }
  // The ends of what leads from the selection block onto the contour (G139).
  [[nodiscard]] std::vector<Point> indirect_entry() const {
    const Corner at(angle());
    if (angle() <= 180) return {at.p};
    if (goes_round_an_arc()) return {at.q, at.p};
    std::vector<Point> joints = turning_points();
    if (bend() != Bend::straight) joints.push_back(at.p);
    return joints;
  }
  // The ends of the contour block and of what leads off it.
  [[nodiscard]] std::vector<Point> indirect_exit() const {
    const Corner at(angle());
    if (angle() <= 180) return {at.q};
    if (goes_round_an_arc()) return {at.q, at.p};
    std::vector<Point> joints = turning_points();
    if (bend() != Bend::straight) joints.insert(joints.begin(), at.q);
    return joints;
  }
};

TEST_P(SelectionTable, EntersIndirectlyAsG139Says) {
  const Outcome outcome = compensate(entry(), mode_for(transition()));
  ASSERT_FALSE(outcome.stopped);
  const std::vector<Point> expected = indirect_entry();
  ASSERT_EQ(outcome.blocks.size(), expected.size() + 2) << text_of(outcome.blocks);
  EXPECT_EQ(start(outcome.blocks[0]), entry().approach.start);
  for (std::size_t k = 0; k < expected.size(); ++k) {
    expect_at(end(outcome.blocks[k]), expected[k], "entry");
    EXPECT_EQ(is_arc(outcome.blocks[k].path), goes_round_an_arc() && k == 1);
  }
  if (goes_round_an_arc())
    expect_at(std::get<Arc>(outcome.blocks[1].path).center, corner, "centre");
}

TEST_P(SelectionTable, LeavesIndirectlyAsG139Says) {
  const Outcome outcome = compensate(exit(), mode_for(transition()));
  ASSERT_FALSE(outcome.stopped);
  const std::vector<Point> expected = indirect_exit();
  ASSERT_EQ(outcome.blocks.size(), expected.size() + 2) << text_of(outcome.blocks);
  for (std::size_t k = 0; k < expected.size(); ++k)
    expect_at(end(outcome.blocks[k + 1]), expected[k], "exit");
  EXPECT_EQ(end(outcome.blocks.back()), exit().retract.end);
}

TEST_P(SelectionTable, EntersAndLeavesDirectlyAsG138Says) {
  TrcMode mode = mode_for(transition());
  mode.selection = Selection::direct;
  const Corner at(angle());
  const Outcome in = compensate(entry(), mode);
  ASSERT_EQ(in.blocks.size(), 3U) << text_of(in.blocks);
  EXPECT_EQ(start(in.blocks[0]), entry().approach.start);
  expect_at(end(in.blocks[0]), at.p, "P");
  const Outcome out = compensate(exit(), mode);
  ASSERT_EQ(out.blocks.size(), 3U) << text_of(out.blocks);
  expect_at(start(out.blocks[2]), at.q, "Q");
  EXPECT_EQ(end(out.blocks[2]), exit().retract.end);
}

// G239 approaches as G138 does and ends in Q without a block of its own.
TEST_P(SelectionTable, EntersAndEndsAsG239Says) {
  TrcMode mode = mode_for(transition());
  mode.selection = Selection::without_block;
  const Corner at(angle());
  const Outcome in = compensate(entry(), mode);
  ASSERT_FALSE(in.stopped);
  expect_at(end(in.blocks[0]), at.p, "P");
  const Outcome out = compensate(exit(), mode);
  ASSERT_EQ(out.blocks.size(), 3U) << text_of(out.blocks);
  expect_at(end(out.blocks[1]), at.q, "Q");
  EXPECT_EQ(out.blocks[2].origin, Origin::uncompensated);
}

std::string name_of_selection(
    const ::testing::TestParamInfo<std::tuple<double, Bend, Transition>>& tested) {
  const auto& [angle, bend, transition] = tested.param;
  const char* shape = bend == Bend::straight ? "Lin" : bend == Bend::left ? "CirLeft" : "CirRight";
  return "Angle" + std::to_string(std::lround(angle)) + shape +
         (transition == Transition::linear ? "G25" : "G26");
}

INSTANTIATE_TEST_SUITE_P(
    Section3, SelectionTable,
    ::testing::Combine(::testing::Values(20, 90, 180, 181, 225, 270, 271, 318, 350),
                       ::testing::Values(Bend::straight, Bend::left, Bend::right),
                       ::testing::Values(Transition::linear, Transition::circular)),
    name_of_selection);

// Rule 4.4 and D-08.
TEST(ExtAngleBlockIntersection, JoinsWithoutInsertionUpTo181Degrees) {
  for (const Sequence& sequence : sequences)
    for (const Transition transition : {Transition::linear, Transition::circular})
      for (const double angle : {180.5, 181.0, 181.5}) {
        SCOPED_TRACE(std::string(sequence.name) + " at " + std::to_string(angle));
        TrcMode mode = mode_for(transition);
        mode.options.ext_angle_block_intersection = true;
        const Contour contour = corner_contour(angle, sequence.before, sequence.after);
        const Outcome outcome = compensate(contour, mode);
        ASSERT_FALSE(outcome.stopped);
        const std::size_t count = transition == Transition::circular ? 1 : sequence.blunt;
        const auto inserted = with_origin(outcome.blocks, Origin::transition);
        EXPECT_EQ(inserted.size(), angle <= 181 ? 0 : count) << text_of(outcome.blocks);
        EXPECT_EQ(first_gap(outcome.blocks), "");
        if (angle > 181) continue;
        const auto programmed = with_origin(outcome.blocks, Origin::programmed);
        ASSERT_EQ(programmed.size(), 2U);
        expect_on_equidistant(end(programmed[0]), contour.blocks[0]);
        expect_on_equidistant(end(programmed[0]), contour.blocks[1]);
      }
}

TEST(ExtAngleBlockIntersection, LinesMeetInTheCornerPointWithG26Too) {
  TrcMode mode = mode_for(Transition::circular);
  mode.options.ext_angle_block_intersection = true;
  const Outcome outcome = compensate(corner_contour(180.5, Bend::straight, Bend::straight), mode);
  const Corner at(180.5);
  const auto programmed = with_origin(outcome.blocks, Origin::programmed);
  ASSERT_EQ(programmed.size(), 2U);
  expect_at(end(programmed[0]), at.q + at.extension * at.d1, "X");
}

// Rule 4.3. At 318.37 degrees the corner point is 2.630 radii away.
class StretchFactor : public ::testing::TestWithParam<double> {};

TEST_P(StretchFactor, SetsTheLongestStretch) {
  const double factor = GetParam();
  const double angle = 318.366;
  const Corner at(angle);
  for (const Sequence& sequence : sequences) {
    SCOPED_TRACE(sequence.name);
    TrcMode mode = mode_for(Transition::linear);
    mode.options.stretch_factor = factor;
    const Outcome outcome =
        compensate(corner_contour(angle, sequence.before, sequence.after), mode);
    ASSERT_FALSE(outcome.stopped);
    const auto inserted = with_origin(outcome.blocks, Origin::transition);
    const auto programmed = with_origin(outcome.blocks, Origin::programmed);
    ASSERT_EQ(programmed.size(), 2U);
    const bool pointed = at.extension <= factor * radius;
    EXPECT_EQ(inserted.size(), pointed ? sequence.blunt : sequence.acute);
    const double stretch = pointed ? at.extension : factor * radius;
    const bool before_is_line = sequence.before == Bend::straight;
    ASSERT_TRUE(before_is_line || !inserted.empty());
    const Point a = before_is_line ? end(programmed[0]) : end(inserted[0]);
    expect_at(a, at.q + stretch * at.d1, "end of the stretch before the corner");
    const bool after_is_line = sequence.after == Bend::straight;
    const Point b = after_is_line ? start(programmed[1]) : start(inserted.back());
    expect_at(b, at.p - stretch * at.d2, "start of the stretch after the corner");
  }
}

INSTANTIATE_TEST_SUITE_P(OneToNineAndReal, StretchFactor,
                         ::testing::Values(1, 1.5, 2, 2.6, 2.65, 3, 4, 5, 6, 7, 8, 9),
                         [](const auto& tested) {
                           return "Percent" + std::to_string(std::lround(tested.param * 100));
                         });

TEST(StretchFactorLimits, DoNotChangeCornersUpTo270Degrees) {
  for (const double angle : {200.0, 269.0}) {
    TrcMode mode = mode_for(Transition::linear);
    const Contour contour = corner_contour(angle, Bend::straight, Bend::left);
    const Outcome once = compensate(contour, mode);
    mode.options.stretch_factor = 9;
    const Outcome stretched = compensate(contour, mode);
    EXPECT_EQ(difference(stretched.blocks, once.blocks, Motion{}, 0), "");
  }
}

TEST(StretchFactorLimits, KeepNinefoldStretchFromTheFarCornerPoint) {
  TrcMode mode = mode_for(Transition::linear);
  mode.options.stretch_factor = 9;
  const Corner at(350);  // the corner point is 11.43 radii away
  const Outcome outcome = compensate(corner_contour(350, Bend::straight, Bend::straight), mode);
  const auto programmed = with_origin(outcome.blocks, Origin::programmed);
  ASSERT_EQ(programmed.size(), 2U);
  ASSERT_EQ(with_origin(outcome.blocks, Origin::transition).size(), 1U);
  expect_at(end(programmed[0]), at.q + 9 * radius * at.d1, "A");
}

// D-05: an exact reversal counts as 360 degrees, whatever the side.
TEST(Reversal, GetsAStretchedEndWithG25AndAHalfCircleWithG26) {
  for (const Side side : {Side::left, Side::right}) {
    Contour contour;
    contour.approach = {.start = {-20, 0}, .end = {0, 0}};
    contour.blocks = {Line{.start = {0, 0}, .end = {50, 0}},
                      Line{.start = {50, 0}, .end = {20, 0}}};
    contour.retract = {.start = {20, 0}, .end = {-10, 0}};
    const double hand = side == Side::left ? 1 : -1;
    TrcMode mode = mode_for(Transition::linear);
    mode.side = side;
    mode.options.stretch_factor = 2;
    Outcome outcome = compensate(contour, mode);
    auto inserted = with_origin(outcome.blocks, Origin::transition);
    ASSERT_EQ(inserted.size(), 1U) << text_of(outcome.blocks);
    expect_at(start(inserted[0]), {60, 5 * hand}, "A");
    expect_at(end(inserted[0]), {60, -5 * hand}, "B");

    mode.transition = Transition::circular;
    outcome = compensate(contour, mode);
    inserted = with_origin(outcome.blocks, Origin::transition);
    ASSERT_EQ(inserted.size(), 1U);
    const Arc& arc = std::get<Arc>(inserted[0].path);
    EXPECT_NEAR(arc.sweep, -hand * pi, 1e-9);
    expect_at(arc.start, {50, 5 * hand}, "Q");
    expect_at(arc.end, {50, -5 * hand}, "P");
  }
}

// An exact reversal into an arc that bends back over the line on the tool side is
// no tip: going round it would cross the line. It is solved as an inside corner.
TEST(Reversal, IntoASlitIsAnInsideCorner) {
  for (const Side side : {Side::left, Side::right}) {
    const double hand = side == Side::left ? 1 : -1;
    Contour contour;
    contour.approach = {.start = {-20, 0}, .end = {0, 0}};
    contour.blocks = {Line{.start = {0, 0}, .end = {30, 0}}, Arc{.start = {30, 0},
                                                                 .end = {20, 10 * hand},
                                                                 .center = {30, 10 * hand},
                                                                 .sweep = -hand * pi / 2}};
    contour.retract = {.start = {20, 10 * hand}, .end = {20, 30 * hand}};
    TrcMode mode = mode_for(Transition::circular);
    mode.side = side;
    const Outcome outcome = compensate(contour, mode);
    EXPECT_TRUE(with_origin(outcome.blocks, Origin::transition).empty()) << text_of(outcome.blocks);
    const auto programmed = with_origin(outcome.blocks, Origin::programmed);
    ASSERT_EQ(programmed.size(), 2U) << text_of(outcome.blocks);
    expect_at(end(programmed[0]), {30 - std::sqrt(200.0), 5 * hand}, "X");
  }
}

}  // namespace
}  // namespace trc::support
