#include "core/survey/survey.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/session/program_session.h"
#include "core/verify/shape.h"
#include "tests/support/cam_programs.h"
#include "tests/support/slot.h"

namespace trc::survey {
namespace {

using support::slot;

// A pocket of 40 by 30 mm with fillets of 4 mm in its corners, inside. The tool enters and leaves
// in the middle of a side.
constexpr std::string_view pocket =
    "N10 G90 G17 G00 X20 Y15\n"
    "N20 G138 G41 G01 X20 Y0 F500\n"
    "N30 X36\n"
    "N40 G03 X40 Y4 J4\n"
    "N50 G01 Y26\n"
    "N60 G03 X36 Y30 I-4\n"
    "N70 G01 X4\n"
    "N80 G03 X0 Y26 J-4\n"
    "N90 G01 Y4\n"
    "N100 G03 X4 Y0 I4\n"
    "N110 G01 X20\n"
    "N120 G40 X20 Y15\n"
    "N130 M30\n";

Survey survey_of(std::string_view text, SurveySetup setup = {}) {
  Survey survey(std::move(setup), text_reader(text, {}, {}));
  EXPECT_TRUE(survey.read());
  return survey;
}

struct Single {
  std::optional<Diagnostic> refusal{};
  Summary summary{};
  verify::ClearanceReport clearance{};
};

Single single_run(std::string_view text, double radius, SessionSetup session = {}) {
  if (session.verify == Verify::off) session.verify = Verify::enforce;
  session.program.mode.tool_radius = radius - session.program.nominal_radius;
  session.program.tool_radius_given = true;
  ProgramSession run({.session = session, .nc_text = false});
  Answers out;
  if (run.feed(text, out)) run.finish(out);
  Single result{.summary = run.summary(), .clearance = *run.clearance()};
  for (const Diagnostic& told : out.take().diagnostics)
    if (told.severity == Severity::error && !result.refusal) result.refusal = told;
  return result;
}

void expect_same(const Surveyed& found, const Single& single) {
  SCOPED_TRACE("radius " + std::to_string(found.radius));
  ASSERT_EQ(found.accepted(), !single.refusal.has_value());
  if (single.refusal) {
    EXPECT_EQ(found.refusal->code, single.refusal->code);
    EXPECT_EQ(found.refusal->source, single.refusal->source);
    EXPECT_EQ(found.refusal->point.has_value(), single.refusal->point.has_value());
    return;
  }
  EXPECT_EQ(found.summary.compensated_length, single.summary.compensated_length);
  EXPECT_EQ(found.summary.programmed_length, single.summary.programmed_length);
  EXPECT_EQ(found.summary.blocks_out, single.summary.blocks_out);
  EXPECT_EQ(found.clearance.touched_length, single.clearance.touched_length);
  ASSERT_EQ(found.clearance.worst.has_value(), single.clearance.worst.has_value());
  if (found.clearance.worst) {
    EXPECT_EQ(found.clearance.worst->distance, single.clearance.worst->distance);
  }
}

std::vector<std::uint32_t> lines_of(const std::vector<Source>& places) {
  std::vector<std::uint32_t> lines;
  for (const Source& place : places) lines.push_back(place.line);
  return lines;
}

TEST(Survey, GivesWhatASingleRunGives) {
  for (const std::string_view text : {pocket, slot}) {
    Survey survey = survey_of(text);
    for (const double radius : {0.5, 2.0, 3.9999, 4.0, 4.1, 5.0, 12.0})
      expect_same(survey.run(radius), single_run(text, radius));
  }
}

// Leads, overruns and laps: which walls there are may change with the radius.
TEST(Survey, GivesWhatSingleRunsGiveOfProgramsWithLeads) {
  std::size_t accepted = 0;
  for (const support::CamContour& contour : support::cam_contours())
    for (const support::Lead lead : support::all_leads)
      for (const support::Laps laps : {support::Laps::one, support::Laps::two,
                                       support::Laps::rough_and_finish, support::Laps::depths}) {
        const support::CamProgram program{.contour = contour,
                                          .in = lead,
                                          .out = lead,
                                          .overrun = support::Overrun::along,
                                          .laps = laps};
        SCOPED_TRACE(name_of(program));
        const std::string text = text_of(program, "G26\nG141\n#TRC[REMOVE_MASKED_BLOCKS=1]");
        Survey survey = survey_of(text);
        for (const double share : {0.05, 0.9, 1.0, 1.1, 1.0, 3.0}) {
          const double radius = share * contour.tool_radius;
          SessionSetup session;
          session.program.every_radius = radius;
          const Single single = single_run(text, radius, session);
          const Surveyed found = survey.run(radius);
          expect_same(found, single);
          EXPECT_EQ(found.clearance.gouging, single.clearance.gouging);
          EXPECT_EQ(found.clearance.checked, single.clearance.checked);
          EXPECT_EQ(found.clearance.walls, single.clearance.walls);
          EXPECT_EQ(found.clearance.wall_length, single.clearance.wall_length);
          EXPECT_EQ(found.clearance.steps, single.clearance.steps);
          accepted += found.accepted() ? 1U : 0U;
        }
      }
  EXPECT_GT(accepted, 100U);
}

TEST(Survey, SaysWhyARadiusIsRefusedAndWhere) {
  Survey survey = survey_of(pocket);
  EXPECT_TRUE(survey.run(3).reaches_all);
  const Surveyed refused = survey.run(5);
  ASSERT_FALSE(refused.accepted());
  EXPECT_FALSE(refused.reaches_all);
  EXPECT_EQ(refused.refusal->code, Code::tool_not_smaller_than_arc);
  EXPECT_EQ(refused.refusal->source.line, 4U);
  EXPECT_EQ(lines_of(refused.limits), std::vector<std::uint32_t>{4});
}

TEST(Survey, FindsTheArcThatLimitsTheRadius) {
  const Largest largest = survey_of(pocket).largest();
  ASSERT_TRUE(largest.is_limited);
  EXPECT_NEAR(largest.radius, 4, 1e-3 + 1e-9);
  EXPECT_FALSE(single_run(pocket, largest.radius).refusal.has_value());
  EXPECT_TRUE(single_run(pocket, largest.radius + 1e-3).refusal.has_value());
  EXPECT_EQ(lines_of(largest.limits), std::vector<std::uint32_t>{4});
}

// The walls are 8 mm apart, and each stands at a block of its own.
TEST(Survey, FindsTheTwoWallsThatLimitTheRadius) {
  Survey survey = survey_of(slot);
  const Largest largest = survey.largest();
  ASSERT_TRUE(largest.is_limited);
  EXPECT_NEAR(largest.radius, 4, 1e-3 + 1e-9);
  EXPECT_EQ(lines_of(largest.limits), (std::vector<std::uint32_t>{3, 5}));
  EXPECT_LE(largest.runs, 20U);
}

// At the first and the last block the corner at the other end takes all of the block.
TEST(Survey, IsLimitedByTwoBlocksAtTheEndsOfTheContourToo) {
  const std::string pocket_from = "N10 G00 X10 Y10\nN20 G138 G41 G01 X";
  const std::string walls = " Y0 F500\nN30 X20\nN40 Y20\nN50 X0\nN60 Y0\nN70 X";
  const std::string end = "\nN80 G40 X10 Y10\nN90 M30\n";
  struct Case {
    std::string begin{};
    std::vector<std::uint32_t> limits{};
  };
  for (const Case& asked : {Case{"19", {3, 4}}, Case{"1", {6, 7}}}) {
    const std::string text = pocket_from + asked.begin + walls + asked.begin + end;
    const Largest largest = survey_of(text).largest();
    EXPECT_DOUBLE_EQ(largest.radius, 1);
    EXPECT_EQ(lines_of(largest.limits), asked.limits);
  }
}

TEST(Survey, UsesWhatTheListHasTold) {
  Survey survey = survey_of(slot);
  static_cast<void>(survey.run(3.9));
  static_cast<void>(survey.run(4.2));
  const Largest with_list = survey.largest();
  const Largest alone = survey_of(slot).largest();
  EXPECT_EQ(with_list.radius, alone.radius);
  EXPECT_LT(with_list.runs, alone.runs);
}

TEST(Survey, EveryRadiusFitsRoundAConvexPart) {
  const Largest largest = survey_of(
                              "N10 G90 G17 G00 X-50 Y-50\n"
                              "N20 G138 G42 G01 X0 Y0 F500\n"
                              "N30 X40\nN40 Y30\nN50 X0\nN60 Y0\n"
                              "N70 G40 X-50 Y-50\n")
                              .largest();
  EXPECT_FALSE(largest.is_limited);
  EXPECT_GT(largest.radius, 100);
}

TEST(Survey, TakesThePlaceOfEveryRadiusOfTheProgram) {
  constexpr std::string_view text =
      "N10 G90 G17 G00 X-20 Y4\n"
      "N15 V.G.WZ_AKT.R = 77\n"
      "N20 D9 G138 G41 G01 X-10 Y0 F500\n"
      "N30 X30\n"
      "N60 G40 X30 Y40\n";
  SurveySetup setup;
  setup.session.program.tools = {{1, {33, 1}}};
  Survey survey = survey_of(text, setup);
  EXPECT_NEAR(survey.run(3).clearance.worst->required, 3, 0);
}

TEST(Survey, AddsWearAndAllowanceToEachRadius) {
  SurveySetup setup;
  setup.session.program.wear = -0.25;
  setup.session.program.allowance = 0.5;
  Survey survey = survey_of(pocket, setup);
  EXPECT_DOUBLE_EQ(survey.run(3).clearance.worst->required, 3.25);
  EXPECT_NEAR(survey.largest().radius, 3.75, 1e-3 + 1e-9);
}

TEST(Survey, KeepsWhatTheProgramAddsToTheRadius) {
  constexpr std::string_view text =
      "N10 G90 G17 G00 X-20 Y4\n"
      "N15 V.G.WZ_AKT.R = V.G.WZ_AKT.R + 0.5\n"
      "N20 G138 G41 G01 X-10 Y0 F500\n"
      "N30 X30\n"
      "N60 G40 X30 Y40\n";
  Survey survey = survey_of(text);
  EXPECT_DOUBLE_EQ(survey.run(3).clearance.worst->required, 3.5);
}

TEST(Survey, AsksAboutToolsOfACentrePath) {
  SurveySetup setup;
  setup.session.program.nominal_radius = 3;
  constexpr std::string_view text =
      "N10 G90 G17 G00 X-20 Y4\n"
      "N20 G138 G41 G01 X-10 Y0 F500\n"
      "N30 X30\n"
      "N60 G40 X30 Y40\n";
  Survey survey = survey_of(text, setup);
  EXPECT_DOUBLE_EQ(survey.run(3.2).clearance.worst->required, 3.2);
  expect_same(survey.run(3.2), single_run(text, 3.2, setup.session));
  const Surveyed refused = survey.run(6);
  ASSERT_FALSE(refused.accepted());
  EXPECT_EQ(refused.refusal->code, Code::wear_too_large);
  expect_same(refused, single_run(text, 6, setup.session));
}

// Under G239 the motion after G40 begins where the tool stands.
TEST(Survey, ReadsAnewWhereBlocksDependOnTheRadius) {
  constexpr std::string_view text =
      "N10 G90 G17 G00 X0 Y0\n"
      "N20 G239 G41 G01 X30 Y20 F1000\n"
      "N30 X60\n"
      "N40 G40\n"
      "N50 G01 X90\n"
      "N60 G00 Y0\n";
  Survey survey = survey_of(text);
  for (const double radius : {1.0, 7.5}) expect_same(survey.run(radius), single_run(text, radius));
}

TEST(Survey, RefusesAProgramThatCannotBeRead) {
  Survey survey({}, text_reader("N10 G999\n", {}, {}));
  EXPECT_FALSE(survey.read());
  ASSERT_FALSE(survey.diagnostics().empty());
  EXPECT_EQ(survey.diagnostics().front().code, Code::nc_unknown_function);
}

double length_of_all(const std::vector<verify::UncutWall>& walls) {
  return std::accumulate(
      walls.begin(), walls.end(), 0.0,
      [](double sum, const verify::UncutWall& wall) { return sum + verify::extent_of(wall.path); });
}

// A right angle keeps a tool of R away from R mm of both walls.
TEST(Survey, TellsWhatIsLeftInCorners) {
  Survey survey = survey_of(slot, {.uncut = true});
  const Surveyed found = survey.run(3);
  ASSERT_TRUE(found.uncut_known);
  EXPECT_FALSE(found.uncut_by_removal);
  EXPECT_NEAR(found.uncut_length, 12, 1e-6);
  EXPECT_NEAR(length_of_all(found.uncut), found.uncut_length, 1e-6);
  EXPECT_NEAR(found.wall_length, 88, 1e-6);
}

// A notch half as wide as deep: KERF_MASKING leaves it out where the tool does not fit.
TEST(Survey, ANotchThatKerfMaskingFillsIsNotReached) {
  Survey survey = survey_of(
      "N10 G00 X-60 Y0 F1000\n"
      "N30 #TRC[KERF_MASKING=1]\n"
      "N40 G26 G41 G01 X-40\n"
      "N50 X-5\n"
      "N60 X0 Y-20\n"
      "N70 X5 Y0\n"
      "N80 X40\n"
      "N90 G40 X60\n"
      "N100 M30\n");
  EXPECT_TRUE(survey.run(1).reaches_all);
  const Surveyed found = survey.run(10);
  EXPECT_TRUE(found.accepted());
  EXPECT_FALSE(found.reaches_all);
  EXPECT_EQ(lines_of(found.limits), (std::vector<std::uint32_t>{5, 6}));
  const Largest largest = survey.largest();
  EXPECT_TRUE(largest.is_limited);
  EXPECT_GT(largest.radius, 1);
  EXPECT_LT(largest.radius, 10);
}

TEST(Survey, TellsWhatARefusedRadiusCouldNotReach) {
  Survey survey = survey_of(pocket, {.uncut = true});
  const Surveyed found = survey.run(6);
  ASSERT_FALSE(found.accepted());
  ASSERT_TRUE(found.uncut_known);
  EXPECT_TRUE(found.uncut_by_removal);
  EXPECT_NEAR(length_of_all(found.uncut), found.uncut_length, 1e-6);
  // Its four fillets, and of each wall beside them 2 mm.
  EXPECT_NEAR(found.uncut_length, 4 * (2 * std::acos(-1.0) + 2 * 2), 1e-6);
}

TEST(Survey, MeasuresWhatGougesWhereTheSetupAsksForAReport) {
  SurveySetup setup;
  setup.session.verify = Verify::report;
  Survey survey = survey_of(slot, setup);
  const Surveyed found = survey.run(5);
  expect_same(found, single_run(slot, 5, setup.session));
  EXPECT_FALSE(found.reaches_all);
}

}  // namespace
}  // namespace trc::survey
