#include "proto/wire/setup.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "core/nc/dialect/dialect.h"
#include "proto/wire/options.h"

namespace trc::wire {
namespace {

PathSettings every_setting() {
  PathSettings settings;
  ProgramSetup& program = settings.session.program;
  program.mode = {.plane = Plane::yz,
                  .tool_radius = 12.5,
                  .selection = Selection::perpendicular,
                  .transition = Transition::circular,
                  .masking = Masking::on,
                  .feed_adaptation = FeedAdaptation::on,
                  .tangfeed_minimum = 3,
                  .options = {.kerf_masking = true, .stretch_factor = 4}};
  program.start = {1, -2, 0.5};
  program.absolute_center = true;
  program.circle = {.correct_center = false,
                    .largest_shift = 1,
                    .largest_shift_factor = 0.1,
                    .largest_radius_difference = 0.5,
                    .largest_radius_factor = 0};
  program.tracking_axes = {"C", "E2"};
  program.tools = {{0, 0},
                   {5, {2.5, -0.02}},
                   {7, -3},
                   {row_of_edge(5, 2), 2},
                   {first_named_tool, 4},
                   {row_of_edge(first_named_tool, 3), {4, 0.1}}};
  program.tool_names = {{"FINISH", first_named_tool}};
  program.wear = 0.03;
  program.allowance = -0.2;
  program.nominal_radius = 5;
  program.max_wear = 0.5;
  program.block_skip = BlockSkip::leave_out;
  program.pass_words = {"G777", "POPEN"};
  program.encoding = Encoding::utf8;
  program.renumbers = true;
  CompensatorSetup& compensator = settings.session.compensator;
  compensator.limits.look_ahead_blocks = 200;
  compensator.limits.passive_blocks = 7;
  compensator.implicit_contour_masking = true;
  compensator.circular_kerf_masking = false;
  compensator.leads = {.find = LeadSettings::Find::counted,
                       .blocks_in = 3,
                       .blocks_out = 1,
                       .closing_tolerance = 0.05};
  compensator.largest_masked_share = 0.25;
  compensator.smallest_feed_factor = 0.5;
  compensator.tolerances.input_resolution = 0.01;
  compensator.inverse_path = true;
  settings.session.program.decimals = 6;
  settings.response_layout = Layout::columns;
  settings.want_resume_tokens = true;
  settings.client_tag = "cell 4";
  settings.resume_token = std::string("\0token", 6);
  return settings;
}

TEST(Setup, ReadsBackEveryField) {
  const PathSettings sent = every_setting();
  v1::ProgramSetup message;
  to_proto(ProgramSettings{.path = sent, .nc_text = false, .file_name = "a.nc"}, message);
  FieldFaults faults;
  const ProgramSettings read = from_proto(message, FieldPath("setup"), faults);
  ASSERT_TRUE(faults.empty()) << faults.listed()[0].field;
  EXPECT_FALSE(read.nc_text);
  EXPECT_EQ(read.path.session.program.decimals, 6);
  EXPECT_EQ(read.file_name, "a.nc");

  const ProgramSetup& program = read.path.session.program;
  const ProgramSetup& expected = sent.session.program;
  EXPECT_EQ(program.mode, expected.mode);
  EXPECT_EQ(program.start, expected.start);
  EXPECT_EQ(program.absolute_center, expected.absolute_center);
  EXPECT_EQ(program.circle.correct_center, expected.circle.correct_center);
  EXPECT_EQ(program.circle.largest_shift, expected.circle.largest_shift);
  EXPECT_EQ(program.circle.largest_shift_factor, expected.circle.largest_shift_factor);
  EXPECT_EQ(program.circle.largest_radius_difference, expected.circle.largest_radius_difference);
  EXPECT_EQ(program.circle.largest_radius_factor, expected.circle.largest_radius_factor);
  EXPECT_EQ(program.tracking_axes, expected.tracking_axes);
  EXPECT_EQ(program.tools, expected.tools);
  EXPECT_EQ(program.tool_names, expected.tool_names);
  EXPECT_EQ(program.wear, expected.wear);
  EXPECT_EQ(program.allowance, expected.allowance);
  EXPECT_EQ(program.nominal_radius, expected.nominal_radius);
  EXPECT_EQ(program.max_wear, expected.max_wear);
  EXPECT_EQ(program.block_skip, expected.block_skip);
  EXPECT_EQ(program.pass_words, expected.pass_words);
  EXPECT_EQ(program.encoding, expected.encoding);
  EXPECT_EQ(program.renumbers, expected.renumbers);
  const CompensatorSetup& compensator = read.path.session.compensator;
  EXPECT_EQ(compensator.start, expected.start);
  EXPECT_EQ(compensator.limits.look_ahead_blocks, 200U);
  EXPECT_EQ(compensator.limits.passive_blocks, 7U);
  EXPECT_TRUE(compensator.implicit_contour_masking);
  EXPECT_FALSE(compensator.circular_kerf_masking);
  EXPECT_EQ(compensator.leads.find, LeadSettings::Find::counted);
  EXPECT_EQ(compensator.leads.blocks_in, 3U);
  EXPECT_EQ(compensator.leads.blocks_out, 1U);
  EXPECT_EQ(compensator.leads.closing_tolerance, 0.05);
  EXPECT_EQ(compensator.largest_masked_share, 0.25);
  EXPECT_TRUE(compensator.inverse_path);
  EXPECT_EQ(compensator.smallest_feed_factor, 0.5);
  EXPECT_EQ(compensator.tolerances.input_resolution, 0.01);
  EXPECT_EQ(read.path.response_layout, Layout::columns);
  EXPECT_TRUE(read.path.want_resume_tokens);
  EXPECT_EQ(read.path.client_tag, "cell 4");
  EXPECT_EQ(read.path.resume_token, sent.resume_token);

  v1::ProgramSetup again;
  to_proto(read, again);
  EXPECT_EQ(again.SerializeAsString(), message.SerializeAsString());
}

// Whatever their encoding (D-80).
TEST(Setup, TextsOfSubprogramsAreBytes) {
  ProgramSettings sent;
  sent.path.session.program.subprograms = {{"O1", "(fräsen)\n"}, {"O2", "(fr\xE4sen)\n"}};
  v1::ProgramSetup message;
  to_proto(sent, message);
  EXPECT_EQ(message.subprograms().size(), 1U);
  EXPECT_EQ(message.subprogram_files().at("O2"), "(fr\xE4sen)\n");
  FieldFaults faults;
  const ProgramSettings read = from_proto(message, FieldPath("setup"), faults);
  EXPECT_TRUE(faults.empty());
  EXPECT_EQ(read.path.session.program.subprograms, sent.path.session.program.subprograms);
  (*message.mutable_subprogram_files())["O1"] = "M17\n";
  static_cast<void>(from_proto(message, FieldPath("setup"), faults));
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults.listed()[0].field, "setup.subprogram_files");
}

TEST(Setup, EmptyMessageMeansTheInitialState) {
  FieldFaults faults;
  const ProgramSettings read = from_proto(v1::ProgramSetup(), FieldPath("setup"), faults);
  ASSERT_TRUE(faults.empty());
  EXPECT_EQ(read.path.session.program.mode, TrcMode{});
  EXPECT_EQ(read.path.session.program.start, Position{});
  EXPECT_EQ(read.path.session.program.tracking_axes, ProgramSetup{}.tracking_axes);
  EXPECT_EQ(read.path.session.compensator.limits.passive_blocks, Limits{}.passive_blocks);
  EXPECT_EQ(read.path.response_layout, Layout::blocks);
  EXPECT_TRUE(read.nc_text);
  EXPECT_EQ(read.path.session.program.decimals, std::nullopt);
}

// A double would show other digits of the first, and the bounds of any double for the second.
TEST(Setup, RefusedNumbersAreShownAsTheyAre) {
  v1::ProgramSetup setup;
  setup.set_max_executed_lines(18446744073709551615U);
  setup.mutable_path()->mutable_options()->set_stretch_factor(
      std::numeric_limits<double>::quiet_NaN());
  FieldFaults faults;
  static_cast<void>(from_proto(setup, FieldPath("setup"), faults));
  ASSERT_EQ(faults.count(), 2U);
  for (const FieldFault& fault : faults.listed())
    EXPECT_EQ(fault.description, fault.field == "setup.max_executed_lines"
                                     ? "is 18446744073709551615, allowed is 1 to 1000000000"
                                     : "is NaN, allowed is 1 to 9")
        << fault.field;
}

// What a dialect begins with is left out of the message, and nothing else.
TEST(Setup, ModesAtTheStartReadBackInEveryDialect) {
  for (const Dialect& dialect : all_dialects())
    for (const Selection selection : {Selection::direct, Selection::indirect})
      for (const Transition transition : {Transition::linear, Transition::circular})
        for (const FeedAdaptation feed : {FeedAdaptation::off, FeedAdaptation::on}) {
          ProgramSettings settings;
          ProgramSetup& program = settings.path.session.program;
          program.dialect = dialect.name;
          program.mode.selection = selection;
          program.mode.transition = transition;
          program.mode.feed_adaptation = feed;
          v1::ProgramSetup message;
          to_proto(settings, message);
          FieldFaults faults;
          const TrcMode mode =
              from_proto(message, FieldPath("setup"), faults).path.session.program.mode;
          EXPECT_TRUE(faults.empty());
          EXPECT_EQ(selection, mode.selection) << dialect.spelling;
          EXPECT_EQ(transition, mode.transition) << dialect.spelling;
          EXPECT_EQ(feed, mode.feed_adaptation) << dialect.spelling;
        }
}

TEST(Setup, AxesOfASplitCountAsAxnrDoes) {  // D-58
  for (std::uint32_t axnr = 1; axnr <= 3; ++axnr) {
    v1::TrcOptions message;
    v1::SplitOption& split = *message.mutable_split();
    split.set_measure(v1::SplitOption::MEASURE_AXIS);
    split.set_axis(axnr);
    split.set_dist_seg1(5);
    split.set_feed_seg1(200);
    FieldFaults faults;
    const TrcOptionChanges read = from_proto(message, FieldPath("options"), faults);
    ASSERT_TRUE(faults.empty());
    EXPECT_EQ(read.split->axis + 1U, axnr);
  }
}

TEST(Setup, OptionsReadBackOneByOne) {
  // Each option alone, so that none can hide behind another.
  const auto changes_with = [](auto set) {
    TrcOptionChanges changes;
    set(changes);
    return changes;
  };
  const SplitOption split{
      .where = SplitOption::Where::pre, .along_path = true, .distance_1 = 5, .feed_1 = 200};
  const std::vector<TrcOptionChanges> all{
      changes_with([](auto& c) { c.conv_cir_to_lin = true; }),
      changes_with([](auto& c) { c.kerf_masking = true; }),
      changes_with([](auto& c) { c.reverse = true; }),
      changes_with([](auto& c) { c.ignore_cont_damage = true; }),
      changes_with([](auto& c) { c.remove_masked_blocks = true; }),
      changes_with([](auto& c) { c.ext_angle_block_intersection = true; }),
      changes_with([](auto& c) { c.g236_lin = true; }),
      changes_with([](auto& c) { c.stretch_factor = 9; }),
      changes_with([](auto& c) { c.tangential_limit = 0.1; }),
      changes_with([](auto& c) { c.perpendicular_radius_change = true; }),
      changes_with([](auto& c) { c.gen_cir_block_in_corner = true; }),
      changes_with([](auto& c) { c.suppress_trc = true; }),
      changes_with([](auto& c) { c.inverse = true; }),
      changes_with([&split](auto& c) { c.split = split; }),
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    v1::TrcOptions message;
    to_proto(all[i], message);
    FieldFaults faults;
    EXPECT_EQ(from_proto(message, FieldPath("options"), faults), all[i]) << i;
    EXPECT_TRUE(faults.empty()) << i;
    EXPECT_EQ(changes_from_initial(changed({}, all[i])), all[i]) << i;
  }
}

TEST(Setup, AbsentOptionsStayUnchanged) {
  const TrcOptions before{.reverse = true, .stretch_factor = 3};
  EXPECT_EQ(changed(before, {}), before);
  TrcOptions expected = before;
  expected.reverse = false;
  EXPECT_EQ(changed(before, {.reverse = false}), expected);
}

TEST(Setup, VariableUnderTwoNamesIsToldWithBoth) {
  v1::ProgramSetup message;
  message.set_dialect(v1::DIALECT_FANUC);
  (*message.mutable_variables())["#500"] = 3;
  (*message.mutable_variables())["500"] = 4;
  FieldFaults faults;
  (void)from_proto(message, FieldPath("setup"), faults);
  ASSERT_EQ(faults.count(), 1U);
  EXPECT_EQ(faults.listed()[0], (FieldFault{"setup.variables[500]",
                                            "names the same variable as #500; give one of them"}));
}

TEST(Setup, VariablesThatOnlyLookAlikeAreTwo) {
  v1::ProgramSetup message;
  message.set_dialect(v1::DIALECT_SINUMERIK);
  for (const char* const name : {"R1", "R10", "_R1", "_R01", "R_1", "$R[1]"})
    (*message.mutable_variables())[name] = 1;
  FieldFaults faults;
  EXPECT_EQ(from_proto(message, FieldPath("setup"), faults).path.session.program.variables.size(),
            6U);
  EXPECT_TRUE(faults.empty());
}

struct RefusedSetup {
  std::string name;
  std::string setup;  // v1::ProgramSetup in protobuf text format
  std::string field;
};

class RefusedSetups : public ::testing::TestWithParam<RefusedSetup> {};

TEST_P(RefusedSetups, NameTheField) {
  v1::ProgramSetup message;
  ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(GetParam().setup, &message));
  FieldFaults faults;
  (void)from_proto(message, FieldPath("setup"), faults);
  ASSERT_EQ(faults.count(), 1U);
  EXPECT_EQ(faults.listed()[0].field, GetParam().field);
  EXPECT_FALSE(faults.listed()[0].description.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Program, RefusedSetups,
    ::testing::Values(
        RefusedSetup{"RadiusNotANumber", "path { tool_radius: nan }", "setup.path.tool_radius"},
        RefusedSetup{"RadiusTooLarge", "path { tool_radius: 214748.3648 }",
                     "setup.path.tool_radius"},
        RefusedSetup{"UnknownPlane", "path { plane: 7 }", "setup.path.plane"},
        RefusedSetup{"UnknownMode", "path { selection_mode: -1 }", "setup.path.selection_mode"},
        RefusedSetup{"StartInfinite", "path { start_position { y: inf } }",
                     "setup.path.start_position.y"},
        RefusedSetup{"NegativeTangfeed", "path { tangfeed_min_radius: -1 }",
                     "setup.path.tangfeed_min_radius"},
        RefusedSetup{"FeedFactorZero", "path { min_feed_factor: 0 }", "setup.path.min_feed_factor"},
        RefusedSetup{"StretchFactor", "path { options { stretch_factor: 10 } }",
                     "setup.path.options.stretch_factor"},
        RefusedSetup{"TangentialLimit", "path { options { tangential_limit: 3.5 } }",
                     "setup.path.options.tangential_limit"},
        RefusedSetup{"CircleShift", "path { circle_center_mode { max_shift: -1 } }",
                     "setup.path.circle_center_mode.max_shift"},
        RefusedSetup{"PassiveBlocks", "path { max_passive_blocks: 0 }",
                     "setup.path.max_passive_blocks"},
        RefusedSetup{"AxisName", "path { axis_names: 'C' axis_names: '1' }",
                     "setup.path.axis_names[1]"},
        RefusedSetup{"AxisTwice", "path { axis_names: 'C' axis_names: 'C' }",
                     "setup.path.axis_names[1]"},
        RefusedSetup{"MainAxis", "path { axis_names: 'X' }", "setup.path.axis_names[0]"},
        RefusedSetup{"ClientTag", "path { client_tag: 'a\\nb' }", "setup.path.client_tag"},
        RefusedSetup{"NameOfAnotherTool",
                     "tools { number: 1 name: 'A' } tools { number: 2 name: 'a' }",
                     "setup.tools[1].name"},
        RefusedSetup{"ToolEdge", "tools { number: 1 edge: 100 }", "setup.tools[0].edge"},
        RefusedSetup{"ToolTwice", "tools { number: 1 } tools { number: 1 }",
                     "setup.tools[1].number"},
        RefusedSetup{"ToolRadius", "tools { radius: inf }", "setup.tools[0].radius"},
        RefusedSetup{"ToolWear", "tools { wear: inf }", "setup.tools[0].wear"},
        RefusedSetup{"Wear", "path { wear: nan }", "setup.path.wear"},
        RefusedSetup{"Allowance", "path { allowance: 3e5 }", "setup.path.allowance"},
        RefusedSetup{"NominalRadius", "path { nominal_radius: 0 }", "setup.path.nominal_radius"},
        RefusedSetup{"PassWordOfAnAxis", "pass_words: \"XY\"", "setup.pass_words[0]"},
        RefusedSetup{"PassWordOfAnAddress", "pass_words: \"x10\"", "setup.pass_words[0]"},
        RefusedSetup{"PassWordOfAFunction", "pass_words: \"G777\" pass_words: \"G41\"",
                     "setup.pass_words[1]"},
        RefusedSetup{"PassWordOfAStatement", "dialect: DIALECT_FANUC pass_words: \"GOTO\"",
                     "setup.pass_words[0]"},
        RefusedSetup{"PassWordOfTwoWords", "pass_words: \"G777 X10\"", "setup.pass_words[0]"},
        RefusedSetup{"MaxWear", "path { max_wear: -1 }", "setup.path.max_wear"},
        RefusedSetup{"Decimals", "decimals: 9", "setup.decimals"},
        RefusedSetup{"VariableNotANumber",
                     "variables { key: '#1' value: 1 } variables { key: '#2' value: nan }",
                     "setup.variables[#2]"},
        RefusedSetup{"VariableOfFanucTwice",
                     "dialect: DIALECT_FANUC variables { key: '# 500' value: 3 } "
                     "variables { key: '0500' value: 4 }",
                     "setup.variables[0500]"},
        RefusedSetup{"VariableOfLinuxcncTwice",
                     "dialect: DIALECT_LINUXCNC variables { key: '#<AB>' value: 3 } "
                     "variables { key: '#<ab>' value: 4 }",
                     "setup.variables[#<ab>]"},
        RefusedSetup{"VariableOfSinumerikTwice",
                     "dialect: DIALECT_SINUMERIK variables { key: 'R01' value: 3 } "
                     "variables { key: 'r[1]' value: 4 }",
                     "setup.variables[r[1]]"},
        RefusedSetup{"VariableOfIsgTwice",
                     "variables { key: 'V.E.A' value: 3 } variables { key: 'v.e.a' value: 3 }",
                     "setup.variables[v.e.a]"},
        RefusedSetup{"Output", "output: 3", "setup.output"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace trc::wire
