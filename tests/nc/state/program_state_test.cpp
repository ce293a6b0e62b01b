#include "core/nc/state/program_state.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace trc {
namespace {

class Program : public ::testing::Test {
 protected:
  ProgramState make(ProgramSetup setup = {}) {
    if (setup.mode.tool_radius == 0 && !setup.tool_radius_given) setup.mode.tool_radius = 1;
    return ProgramState(setup, {}, diagnostics_, blocks_);
  }
  ProgramState make_without_radius(const ProgramSetup& setup = {}) {
    return ProgramState(setup, {}, diagnostics_, blocks_);
  }
  static Source at(std::int64_t number) { return {.number = number}; }
  static MoveRequest line(double x, double y) { return {.end = {x, y, std::nullopt}}; }

  [[nodiscard]] Code code() const {
    return diagnostics_.pending().empty() ? Code{} : diagnostics_.pending().back().code;
  }
  [[nodiscard]] const MotionBlock& motion() const { return std::get<MotionBlock>(blocks_.back()); }

  Diagnostics diagnostics_;
  std::vector<Block> blocks_;
};

TEST_F(Program, BlocksShareTheirJointsBitForBit) {
  ProgramState state = make();
  state.move(line(0.1, 0.2));
  state.move({.end = {0.3, std::nullopt, 5.0}, .incremental = true});
  state.move({.kind = MotionKind::clockwise,
              .end = {1.0, 0.2, std::nullopt},
              .center = {0.3, 0.0, std::nullopt}});
  for (std::size_t i = 1; i < blocks_.size(); ++i) {
    const auto& before = std::get<MotionBlock>(blocks_[i - 1]);
    const auto& after = std::get<MotionBlock>(blocks_[i]);
    EXPECT_EQ(end_of(before.path), start_of(after.path));
    EXPECT_EQ(before.normal.to, after.normal.from);
  }
  EXPECT_EQ(blocks_.size(), 3U);
}

TEST_F(Program, AnAbsentCoordinateKeepsItsValue) {
  ProgramState state = make({.start = {1, 2, 3}});
  state.move({.end = {10.0, std::nullopt, std::nullopt}});
  EXPECT_EQ(std::get<Line>(motion().path), (Line{.start = {1, 2}, .end = {10, 2}}));
  EXPECT_EQ(state.position(), (Position{10, 2, 3}));
}

TEST_F(Program, EachPlaneHasItsOwnFirstAxis) {
  ProgramState state = make({.start = {1, 2, 3}});
  state.set_plane(Plane::zx, at(1));
  state.move({.end = {4.0, 5.0, 6.0}});
  EXPECT_EQ(std::get<Line>(motion().path), (Line{.start = {3, 1}, .end = {6, 4}}));
  EXPECT_EQ(motion().normal, (AxisTravel{.from = 2, .to = 5}));
  state.set_plane(Plane::yz, at(2));
  state.move({.end = {7.0, 8.0, 9.0}});
  EXPECT_EQ(std::get<Line>(motion().path), (Line{.start = {5, 6}, .end = {8, 9}}));
  EXPECT_EQ(motion().normal, (AxisTravel{.from = 4, .to = 7}));
}

TEST_F(Program, ACircleOfG18IsClockwiseSeenFromTheThirdAxis) {
  ProgramState state = make();
  state.set_plane(Plane::zx, at(1));
  state.move({.kind = MotionKind::counter_clockwise,
              .end = {10.0, std::nullopt, -10.0},
              .center = {std::nullopt, std::nullopt, -10.0}});
  const Arc& arc = std::get<Arc>(motion().path);
  EXPECT_EQ(arc.center, Point(-10, 0));
  EXPECT_NEAR(arc.sweep, std::numbers::pi / 2, 1e-12);
}

TEST_F(Program, AMotionAcrossThePlaneIsNoRelevantBlock) {
  ProgramState state = make();
  state.move({.end = {std::nullopt, std::nullopt, 5.0}});
  const auto& passive = std::get<PassiveBlock>(blocks_.back());
  EXPECT_TRUE(passive.moves);
  EXPECT_EQ(passive.normal, (AxisTravel{.from = 0, .to = 5}));
  state.move({.end = {0.0, 0.0, 5.0}});
  EXPECT_FALSE(std::get<PassiveBlock>(blocks_.back()).moves);
}

TEST_F(Program, StepsTooShortToTravelAddUp) {
  ProgramState state = make();
  constexpr double step = 4e-7;
  for (int i = 0; i < 10; ++i)
    state.move({.end = {step, std::nullopt, std::nullopt}, .incremental = true});
  EXPECT_NEAR(state.position()[0], 9 * step, 1e-15) << "travelled in threes, one step is left over";
  state.move({.end = {1.0, std::nullopt, std::nullopt}, .incremental = true});
  EXPECT_NEAR(state.position()[0], 1 + 10 * step, 1e-15);
}

TEST_F(Program, TrackingAxesTravelOnceOneIsProgrammed) {
  ProgramState state = make({.tracking_axes = {"A", "U"}});
  state.move(line(1, 0));
  EXPECT_TRUE(motion().tracking.empty());
  state.move({.end = {2.0, std::nullopt, std::nullopt}, .tracking = {std::nullopt, 5.0}});
  EXPECT_EQ(motion().tracking, (TrackingTravel{{.from = 0, .to = 0}, {.from = 0, .to = 5}}));
  state.move(
      {.end = {3.0, std::nullopt, std::nullopt}, .incremental = true, .tracking = {90.0, 1.0}});
  EXPECT_EQ(motion().tracking, (TrackingTravel{{.from = 0, .to = 90}, {.from = 5, .to = 6}}));
  state.pass(at(4), "M8");
  EXPECT_EQ(std::get<PassiveBlock>(blocks_.back()).tracking,
            (TrackingTravel{{.from = 90, .to = 90}, {.from = 6, .to = 6}}));
}

TEST_F(Program, CoordinatesBeyondTheRangeAreRefused) {
  make().move(line(1e6 + 1, 0));
  EXPECT_EQ(code(), Code::end_point_out_of_range);
}

TEST_F(Program, NumbersThatAreNoneAreRefused) {
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), infinite, -infinite}) {
    diagnostics_ = {};
    EXPECT_FALSE(make().move(line(0, bad)));
    EXPECT_EQ(code(), Code::field_invalid);
    diagnostics_ = {};
    EXPECT_FALSE(make().move({.kind = MotionKind::clockwise,
                              .end = {1.0, 1.0, std::nullopt},
                              .center = {bad, std::nullopt, std::nullopt}}));
    EXPECT_EQ(code(), Code::field_invalid);
    diagnostics_ = {};
    EXPECT_FALSE(make().move({.end = {1.0, 1.0, std::nullopt}, .tracking = {bad}}));
    EXPECT_EQ(code(), Code::field_invalid);
    diagnostics_ = {};
    EXPECT_FALSE(make().move({.end = {1.0, 1.0, std::nullopt}, .feed = bad}));
    EXPECT_EQ(code(), Code::field_invalid);
    diagnostics_ = {};
    EXPECT_FALSE(make().set_tool_radius(bad, at(1)));
    EXPECT_EQ(code(), Code::tool_radius_out_of_range);
  }
}

TEST_F(Program, ANegativeRadiusSwapsTheSide) {
  ProgramState state = make();
  state.set_tool_radius(-5, at(1));
  state.select(Side::left, at(2));
  EXPECT_EQ(state.mode().side, Side::right);
  EXPECT_EQ(state.mode().tool_radius, 5);
  state.set_tool_radius(5, at(3));
  EXPECT_EQ(state.mode().side, Side::left);
  EXPECT_EQ(state.mode().selection_number, 1U) << "no new selection";
}

TEST_F(Program, BlocksKeepTheModeTheyWereProgrammedUnder) {
  ProgramState state = make();
  state.set_tool_radius(5, at(1));
  state.select(Side::left, at(2));
  state.move(line(10, 0));
  state.set_transition(Transition::circular, at(3));
  state.move(line(20, 0));
  const auto& first = std::get<MotionBlock>(blocks_[0]);
  const auto& second = std::get<MotionBlock>(blocks_[1]);
  EXPECT_EQ(first.mode->transition, Transition::linear);
  EXPECT_EQ(second.mode->transition, Transition::circular);
}

TEST_F(Program, ASelectionIsCountedOnceAndASideChangeBelongsToIt) {
  ProgramState state = make();
  state.select(Side::left, at(1));
  state.move(line(10, 0));
  state.move(line(20, 0));
  state.select(Side::right, at(2));
  EXPECT_EQ(state.mode().selection_number, 1U);
  state.deselect(at(3));
  EXPECT_EQ(state.mode().selection_number, 0U);
  state.move(line(30, 0));
  state.select(Side::left, at(4));
  EXPECT_EQ(state.mode().selection_number, 2U);
}

TEST_F(Program, TheModeOfTheDeselectionIsRemembered) {  // D-149
  ProgramState state = make();
  state.set_selection(Selection::direct, at(1));
  state.select(Side::left, at(2));
  state.move(line(10, 0));
  state.move(line(20, 0));
  state.deselect(at(3));
  state.set_selection(Selection::perpendicular, at(4));
  state.move(line(30, 0));
  EXPECT_EQ(motion().mode->deselection, Selection::direct);
  EXPECT_EQ(motion().mode->selection, Selection::perpendicular);
}

TEST_F(Program, G05ActsOnTheNextSelectionBlockOnly) {
  ProgramState state = make();
  state.set_tangential(at(1));
  state.select(Side::left, at(1));
  state.move({.end = {std::nullopt, std::nullopt, 1.0}});
  state.move(line(10, 0));
  EXPECT_TRUE(motion().mode->tangential);
  state.move(line(20, 0));
  EXPECT_FALSE(motion().mode->tangential);
  state.deselect(at(2));
  state.move(line(30, 0));
  EXPECT_FALSE(motion().mode->tangential);
}

TEST_F(Program, G239LeavesThePositionOnTheEquidistant) {
  ProgramState state = make();
  state.set_selection(Selection::without_block, at(1));
  state.set_tool_radius(10, at(2));
  state.select(Side::left, at(3));
  state.move(line(30, 20));
  state.move({.end = {120.0, std::nullopt, std::nullopt}});
  state.deselect(at(4));
  EXPECT_EQ(state.position(), (Position{120, 30, 0}));
  state.move({.end = {150.0, std::nullopt, std::nullopt}});
  EXPECT_EQ(std::get<Line>(motion().path), (Line{.start = {120, 30}, .end = {150, 30}}));
}

TEST_F(Program, G239WithAnApproachAloneLeavesThePositionAsProgrammed) {
  ProgramState state = make();
  state.set_selection(Selection::without_block, at(1));
  state.set_tool_radius(10, at(2));
  state.select(Side::left, at(3));
  state.move(line(30, 20));
  state.deselect(at(4));
  EXPECT_EQ(state.position(), (Position{30, 20, 0}));
}

TEST_F(Program, G239OnAnArcTakesItsEndTangentAndTheLastRadius) {
  ProgramState state = make();
  state.set_selection(Selection::without_block, at(1));
  state.set_tool_radius(2, at(2));
  state.select(Side::right, at(3));
  state.move(line(10, 0));
  state.move({.kind = MotionKind::counter_clockwise,
              .end = {0.0, 10.0, std::nullopt},
              .center = {-10.0, 0.0, std::nullopt}});
  state.set_tool_radius(7, at(4));  // no block has it yet
  state.deselect(at(5));
  EXPECT_NEAR(state.position()[0], 0, 1e-12);
  EXPECT_NEAR(state.position()[1], 12, 1e-12) << "outside of the circle, radius 2";
}

TEST_F(Program, G239UnderSuppressTrcLeavesThePositionOnTheContour) {
  ProgramState state = make();
  state.set_options({.suppress_trc = true}, at(1));
  state.set_selection(Selection::without_block, at(1));
  state.set_tool_radius(10, at(2));
  state.select(Side::left, at(3));
  state.move(line(30, 20));
  state.move(line(60, 20));
  state.deselect(at(4));
  EXPECT_EQ(state.position(), (Position{60, 20, 0}));
}

TEST_F(Program, G239AfterAConvertedCircleTakesTheChord) {
  ProgramState state = make();
  state.set_options({.conv_cir_to_lin = true}, at(1));
  state.set_masking(Masking::on, at(1));
  state.set_selection(Selection::without_block, at(1));
  state.set_tool_radius(10, at(2));
  state.select(Side::left, at(3));
  state.move(line(30, 0));
  state.move({.kind = MotionKind::counter_clockwise,
              .end = {30.0, 4.0, std::nullopt},
              .center = {0.0, 2.0, std::nullopt}});
  state.deselect(at(4));
  EXPECT_NEAR(state.position()[0], 20, 1e-12);
  EXPECT_NEAR(state.position()[1], 4, 1e-12);
}

TEST_F(Program, TheFirstBlockOfG237IsContourAlready) {
  ProgramState state = make();
  state.set_selection(Selection::perpendicular, at(1));
  state.set_tool_radius(10, at(2));
  state.select(Side::left, at(3));
  state.move(line(30, 0));
  state.set_selection(Selection::direct, at(4));
  state.deselect(at(5));
  EXPECT_FALSE(state.select(Side::left, at(6)));
  EXPECT_EQ(code(), Code::deselection_without_motion);
}

TEST_F(Program, AnAbsoluteCentreThatIsHalfProgrammedTakesTheStartForTheRest) {
  ProgramState state = make({.start = {10, 5, 0}, .absolute_center = true});
  state.move({.kind = MotionKind::counter_clockwise, .center = {20.0, std::nullopt, std::nullopt}});
  EXPECT_EQ(std::get<Arc>(motion().path).center, Point(20, 5));
  state.set_absolute_center(false);
  state.move({.kind = MotionKind::counter_clockwise, .center = {20.0, std::nullopt, std::nullopt}});
  EXPECT_EQ(std::get<Arc>(motion().path).center, Point(30, 5));
}

TEST_F(Program, AfterAShiftStraightMotionsGoOnWhileTrcIsOff) {
  ProgramState state = make();
  state.forget_position({true, true, true}, {.index = 3, .number = 7, .line = 4});
  EXPECT_TRUE(state.move({.end = {5.0, std::nullopt, std::nullopt}}));
  state.select(Side::left, at(1));
  EXPECT_FALSE(state.move(line(20, 20)));
  EXPECT_EQ(code(), Code::position_unknown);
  EXPECT_EQ(diagnostics_.pending().back().detail, "Y, unknown since the change in line 4 (N7)");
}

TEST_F(Program, AShiftOfOneAxisLeavesTheOthersKnown) {
  ProgramState state = make();
  state.forget_position({false, false, true}, at(7));
  state.select(Side::left, at(1));
  EXPECT_TRUE(state.move(line(20, 20)));
  EXPECT_EQ(code(), Code{});
}

TEST_F(Program, ASelectionNeedsARadiusWithItsFirstMotion) {  // D-40
  ProgramState state = make_without_radius();
  EXPECT_TRUE(state.select(Side::left, at(40)));
  EXPECT_TRUE(state.pass(at(45), "M8"));
  EXPECT_TRUE(state.move({.end = {std::nullopt, std::nullopt, -5.0}}));
  EXPECT_FALSE(state.move(line(10, 0)));
  EXPECT_EQ(code(), Code::no_tool_radius);
  EXPECT_NE(diagnostics_.pending().back().detail.find("N40"), std::string::npos);
}

TEST_F(Program, ARadiusAfterG41IsGivenInTime) {
  ProgramState state = make_without_radius();
  state.select(Side::left, at(40));
  state.set_tool_radius(3, at(50));
  EXPECT_TRUE(state.move(line(10, 0)));
  EXPECT_EQ(motion().mode->tool_radius, 3);
}

TEST_F(Program, ARadiusOfZeroIsToldOnceUntilAnotherOneIsGiven) {
  ProgramState state = make_without_radius({.tool_radius_given = true});
  const auto count = [&] { return diagnostics_.pending().size(); };
  for (const int selection : {1, 2}) {
    state.select(Side::left, at(selection));
    EXPECT_TRUE(state.move({.end = {10.0, std::nullopt, std::nullopt}, .incremental = true}));
    EXPECT_TRUE(state.move({.end = {10.0, std::nullopt, std::nullopt}, .incremental = true}));
    state.deselect(at(selection));
    EXPECT_TRUE(state.move({.end = {10.0, std::nullopt, std::nullopt}, .incremental = true}));
  }
  EXPECT_EQ(code(), Code::tool_radius_zero);
  EXPECT_EQ(count(), 1U);
  state.set_tool_radius(2, at(3));
  state.select(Side::left, at(4));
  EXPECT_TRUE(state.move({.end = {10.0, std::nullopt, std::nullopt}, .incremental = true}));
  EXPECT_EQ(count(), 1U);
  EXPECT_TRUE(state.set_tool_radius(0, at(5)));
  EXPECT_EQ(count(), 2U);
}

TEST_F(Program, ATWordGivesItsRadiusWithM06) {
  ProgramState state = make_without_radius({.tools = {{1, 4.0}, {2, 6.0}}});
  state.prepare_tool(1);
  EXPECT_TRUE(state.load_tool(at(1)));
  state.prepare_tool(2);
  EXPECT_EQ(state.mode().tool_radius, 4);
  EXPECT_TRUE(state.load_tool(at(2)));
  EXPECT_EQ(state.mode().tool_radius, 6);
}

TEST_F(Program, ATWordAloneActsInAProgramWithoutM06) {
  ProgramState state = make_without_radius({.tools = {{2, 6.0}}});
  state.prepare_tool(2);
  state.select(Side::left, at(1));
  EXPECT_TRUE(state.move(line(10, 0)));
  EXPECT_EQ(motion().mode->tool_radius, 6);
}

TEST_F(Program, TheRadiusOfTheProgramIsNotThatOfTheToolInTheSpindle) {
  ProgramState state = make_without_radius({.tools = {{1, 4.0}, {2, 6.0}}});
  state.set_tool(1, at(1));
  state.prepare_tool(2);
  EXPECT_TRUE(state.load_tool(at(2)));
  EXPECT_EQ(state.mode().tool_radius, 4);
}

TEST_F(Program, AToolThatTheTableDoesNotHoldTakesTheRadiusAway) {
  ProgramState state = make_without_radius({.tools = {{1, 4.0}}});
  state.prepare_tool(1);
  state.load_tool(at(1));
  state.prepare_tool(9, {.source = at(2), .column = 4});
  state.load_tool(at(2));
  state.select(Side::left, at(3));
  EXPECT_FALSE(state.move(line(10, 0)));
  EXPECT_EQ(code(), Code::tool_unknown);  // D-52: where the tool is called
  EXPECT_EQ(diagnostics_.pending().back().source.number, 2);
  EXPECT_EQ(diagnostics_.pending().back().column, 4U);
  EXPECT_NE(diagnostics_.pending().back().detail.find("T9"), std::string::npos);
}

TEST_F(Program, G141AndKerfMaskingAreOneSwitchOfWhichTheLastWriterWins) {
  ProgramState state = make({.masking_switches_kerf = true});
  const auto write = [&](bool on) {
    TrcOptions options = state.mode().options;
    options.kerf_masking = on;
    state.set_options(options, at(1));
  };
  const auto is_on = [&] { return state.mode().options.kerf_masking; };
  state.set_masking(Masking::on, at(1));
  EXPECT_TRUE(is_on());
  write(false);
  EXPECT_FALSE(is_on());
  state.set_masking(Masking::on, at(1));
  EXPECT_TRUE(is_on());
  state.set_masking(Masking::off, at(1));
  EXPECT_FALSE(is_on());
  write(true);
  state.set_masking(Masking::off, at(1));
  EXPECT_FALSE(is_on());
}

TEST_F(Program, G141LeavesKerfMaskingAloneWithTheNewMethod) {
  ProgramState state = make();
  state.set_masking(Masking::on, at(1));
  EXPECT_FALSE(state.mode().options.kerf_masking);
}

TEST_F(Program, ACentreThatIsShiftedIsToldWithTheShift) {
  ProgramState state = make();
  EXPECT_TRUE(state.move({.kind = MotionKind::clockwise,
                          .end = {60.05, 0.0, std::nullopt},
                          .center = {30.0, std::nullopt, std::nullopt}}));
  EXPECT_EQ(code(), Code::center_corrected);
  ASSERT_FALSE(diagnostics_.pending().empty());
  EXPECT_NEAR(diagnostics_.pending().back().values.at(0).value, 0.025, 1e-9);
}

TEST_F(Program, ACentreThatRoundingHasShiftedIsNotTold) {
  ProgramState state = make();
  EXPECT_TRUE(state.move({.kind = MotionKind::clockwise,
                          .end = {60.019, 0.0, std::nullopt},
                          .center = {30.0, std::nullopt, std::nullopt}}));
  EXPECT_EQ(code(), Code{});
}

TEST_F(Program, AfterAShiftNeitherIncrementsNorCirclesNorTheApproachAreKnown) {
  for (const int kind : {0, 1, 2}) {
    diagnostics_ = {};
    ProgramState state = make();
    state.forget_position({true, true, true}, at(7));
    MoveRequest request = line(5, 5);
    if (kind == 0) request.incremental = true;
    if (kind == 1) {
      request.kind = MotionKind::clockwise;
      request.radius = 10;
    }
    if (kind == 2) state.select(Side::left, at(1));
    EXPECT_FALSE(state.move(request));
    EXPECT_EQ(code(), Code::position_unknown) << kind;
  }
}

TEST_F(Program, AStraightMotionInBothAxesMakesThePositionKnownAgain) {
  ProgramState state = make();
  state.forget_position({true, true, true}, at(7));
  EXPECT_TRUE(state.move({.end = {std::nullopt, std::nullopt, 50.0}}));
  EXPECT_TRUE(state.move(line(5, 5)));
  state.select(Side::left, at(1));
  EXPECT_TRUE(state.move({.end = {1.0, 1.0, std::nullopt}, .incremental = true}));
  EXPECT_EQ(code(), Code{});
}

TEST_F(Program, TheEndIsSaidOnce) {
  ProgramState state = make();
  state.select(Side::left, at(1));
  EXPECT_TRUE(state.end(at(2)));
  EXPECT_TRUE(state.end(at(3)));
  ASSERT_EQ(diagnostics_.pending().size(), 1U);
  EXPECT_EQ(diagnostics_.pending()[0].code, Code::ended_while_active);
}

TEST_F(Program, AnEmptySplitIsRefusedAlsoWhenItCameAsAMessage) {
  ProgramState state = make();
  TrcOptions options;
  options.split.where = SplitOption::Where::pre;
  EXPECT_FALSE(state.set_options(options, at(1)));
  EXPECT_EQ(code(), Code::trc_option_out_of_range);
}

}  // namespace
}  // namespace trc
