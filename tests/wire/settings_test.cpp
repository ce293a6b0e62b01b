#include "proto/wire/settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <sstream>

#include "proto/wire/german_settings.h"
#include "proto/wire/setting_meanings.h"
#include "proto/wire/setup.h"

namespace trc::wire {
namespace {

v1::ProgramSetup set(std::initializer_list<const char*> assignments) {
  v1::ProgramSetup setup;
  for (const char* assignment : assignments) EXPECT_EQ(apply_setting(assignment, setup), "");
  return setup;
}

std::string fault_of(const char* assignment) {
  v1::ProgramSetup setup;
  return apply_setting(assignment, setup);
}

TEST(Settings, TakeNumbersAndSwitches) {
  const v1::ProgramSetup setup = set({"tool_radius=-5.25", "look_ahead_blocks=200",
                                      "implicit_contour_masking=on", "max_passive_blocks = 7"});
  EXPECT_EQ(setup.path().tool_radius(), -5.25);
  EXPECT_EQ(setup.path().look_ahead_blocks(), 200u);
  EXPECT_TRUE(setup.path().implicit_contour_masking());
  EXPECT_EQ(setup.path().max_passive_blocks(), 7u);
}

TEST(Settings, AreWrittenAsTheyAreRead) {
  const std::vector<std::string> assignments{
      "plane=zx",
      "start_position=1,-2.5,0",
      "tool_radius=4.98",
      "transition=circular",
      "options.stretch_factor=2.5",
      "implicit_contour_masking=true",
      "axis_names=A,C",
      "max_passive_blocks=7",
      "verify=enforce",
      "leads=blocks:2,1",
      "block_skip=leave_out",
      "pass_words=POPEN,G777",
      "encoding=latin1",
      "renumber=true",
      "max_executed_lines=5000",
      "tools=1:5,2:3.5:-0.02,7\"ROUGH, 10:1\"/2:5,\"A \"\"B\"\"\":3,5/3:4",
      "variables=#500=12.5,#501=-3",
  };
  v1::ProgramSetup setup;
  for (const std::string& assignment : assignments) EXPECT_EQ(apply_setting(assignment, setup), "");
  EXPECT_EQ(assignments_of(setup), assignments);
  EXPECT_TRUE(assignments_of({}).empty());
}

TEST(Settings, NameTheVariableThatHasNoNumber) {
  EXPECT_NE(fault_of("variables=#500=12.5,#501=x").find("variables: #501"), std::string::npos);
  EXPECT_NE(fault_of("variables=12.5"), "");
}

TEST(Settings, TakeLeads) {
  const v1::Leads leads = set({"leads=blocks:2,1"}).path().leads();
  EXPECT_EQ(leads.find(), v1::Leads::FIND_BLOCKS);
  EXPECT_EQ(leads.blocks_in(), 2u);
  EXPECT_EQ(leads.blocks_out(), 1u);
  EXPECT_EQ(set({"leads=NONE"}).path().leads().find(), v1::Leads::FIND_NONE);
  EXPECT_EQ(set({"leads.find=auto"}).path().leads().find(), v1::Leads::FIND_AUTO);
  EXPECT_NE(fault_of("leads=blocks"), "");
  EXPECT_NE(fault_of("leads=blocks:2"), "");
  EXPECT_NE(fault_of("leads=none:2,1").find("auto, none or blocks:IN,OUT"), std::string::npos);
}

TEST(Settings, TakeWordsAndGFunctions) {
  EXPECT_EQ(set({"plane=zx"}).path().plane(), v1::PLANE_ZX);
  EXPECT_EQ(set({"plane=G19"}).path().plane(), v1::PLANE_YZ);
  EXPECT_EQ(set({"selection_mode=g239"}).path().selection_mode(), v1::SELECTION_MODE_WITHOUT_BLOCK);
  EXPECT_EQ(set({"selection_mode=SELECTION_MODE_DIRECT"}).path().selection_mode(),
            v1::SELECTION_MODE_DIRECT);
  EXPECT_EQ(set({"transition=circular"}).path().transition(), v1::TRANSITION_CIRCULAR);
  EXPECT_EQ(set({"contour_masking=G141"}).path().contour_masking(), v1::CONTOUR_MASKING_ON);
  EXPECT_EQ(set({"circle_center_mode.reference=G161"}).path().circle_center_mode().reference(),
            v1::CENTER_REFERENCE_ABSOLUTE);
}

TEST(Settings, VerifyIsAModeThatWasASwitch) {
  EXPECT_EQ(set({"verify=ENFORCE"}).path().verify(), v1::VERIFICATION_ENFORCE);
  EXPECT_EQ(set({"verify=report"}).path().verify(), v1::VERIFICATION_REPORT);
  EXPECT_EQ(set({"verify=true"}).path().verify(), v1::VERIFICATION_ENFORCE);
  EXPECT_EQ(set({"verify=off"}).path().verify(), v1::VERIFICATION_OFF);
  EXPECT_EQ(set({"verify=false"}).path().verify(), v1::VERIFICATION_OFF);
  EXPECT_NE(fault_of("verify=loud").find("enforce, report, off"), std::string::npos);
}

TEST(Settings, ReachFieldsOfFieldsByTheirLastName) {
  EXPECT_EQ(set({"options.stretch_factor=2"}).path().options().stretch_factor(), 2);
  EXPECT_EQ(set({"stretch_factor=3"}).path().options().stretch_factor(), 3);
  EXPECT_TRUE(set({"KERF_MASKING=1"}).path().options().kerf_masking());
  EXPECT_EQ(set({"kerf-method=0"}).path().kerf_method(), v1::KERF_METHOD_LINEAR);
}

TEST(Settings, TakePositionsListsAndTools) {
  const v1::ProgramSetup setup =
      set({"start_position=1,-2.5", "start_position.z=3", "axis_names=A,C", "tools=1:5,2:3.5"});
  EXPECT_EQ(setup.path().start_position().x(), 1);
  EXPECT_EQ(setup.path().start_position().y(), -2.5);
  EXPECT_EQ(setup.path().start_position().z(), 3);
  ASSERT_EQ(setup.path().axis_names_size(), 2);
  EXPECT_EQ(setup.path().axis_names(1), "C");
  ASSERT_EQ(setup.tools_size(), 2);
  EXPECT_EQ(setup.tools(1).number(), 2u);
  EXPECT_EQ(setup.tools(1).radius(), 3.5);
  EXPECT_EQ(set({"tools=1:5:-0.02"}).tools(0).wear(), -0.02);
  const v1::ProgramSetup called = set({"tools=7\"ROUGH, 10:1\"/2:5:-0.02,\"A \"\"B\"\"\":3,5/3:4"});
  ASSERT_EQ(called.tools_size(), 3);
  EXPECT_EQ(called.tools(0).number(), 7u);
  EXPECT_EQ(called.tools(0).name(), "ROUGH, 10:1");
  EXPECT_EQ(called.tools(0).edge(), 2u);
  EXPECT_EQ(called.tools(0).wear(), -0.02);
  EXPECT_EQ(called.tools(1).number(), 0u);
  EXPECT_EQ(called.tools(1).name(), "A \"B\"");
  EXPECT_EQ(called.tools(2).name(), "");
  EXPECT_EQ(called.tools(2).edge(), 3u);
  EXPECT_EQ(set({"allowance=0.2"}).path().allowance(), 0.2);
  EXPECT_EQ(set({"nominal_radius=5"}).path().nominal_radius(), 5);
}

TEST(Settings, NameTheNearestKeysForAnUnknownOne) {
  EXPECT_NE(fault_of("tol_radius=5").find("nearest: tool_radius,"), std::string::npos);
  EXPECT_NE(fault_of("strech_factor=5").find("options.stretch_factor"), std::string::npos);
}

TEST(Settings, SayWhatAFieldTakes) {
  EXPECT_EQ(fault_of("tool_radius=5mm"), "tool_radius: \"5mm\" is not possible; it takes a number");
  EXPECT_NE(fault_of("tool_radius=nan"), "");
  EXPECT_NE(fault_of("tool_radius=inf"), "");
  EXPECT_NE(fault_of("tool_radius="), "");
  EXPECT_NE(fault_of("look_ahead_blocks=-1"), "");
  EXPECT_NE(fault_of("look_ahead_blocks=1.5"), "");
  EXPECT_NE(fault_of("implicit_contour_masking=2").find("true or false"), std::string::npos);
  EXPECT_NE(fault_of("selection_mode=G999").find("without_block (G239)"), std::string::npos);
  EXPECT_NE(fault_of("selection_mode=G25"), "");
  EXPECT_NE(fault_of("start_position=1,2,3,4"), "");
  for (const char* tools : {"1", ":5", "\"\":5", "\"A:5", "1\"A\"2:5", "1/:5", "1/x:5", "/2:5",
                            "1\"A\"/2/3:5", "-1:5", "1.5:5"})
    EXPECT_NE(fault_of((std::string("tools=") + tools).c_str()).find("as in 1:5"),
              std::string::npos)
        << tools;
  EXPECT_NE(fault_of("tool_radius").find("key=value"), std::string::npos);
}

TEST(Settings, ListEveryFieldOfAPathSetup) {
  std::string keys;
  for (const SettingRow& row : settings()) keys += row.key + " ";
  for (const char* key :
       {"plane ", "start_position ", "tool_radius ", "selection_mode ", "transition ",
        "contour_masking ", "feed_adaptation ", "circle_center_mode.max_shift ",
        "options.stretch_factor ", "look_ahead_blocks ", "kerf_method ", "axis_names ",
        "client_tag ", "block_skip ", "tools "})
    EXPECT_NE(keys.find(key), std::string::npos) << key;
  EXPECT_EQ(keys.find("resume_token "), std::string::npos);
}

bool is_taken(const std::string& assignment) {
  v1::ProgramSetup setup;
  EXPECT_EQ(apply_setting(assignment, setup), "") << assignment;
  FieldFaults faults;
  static_cast<void>(from_proto(setup, FieldPath("setup"), faults));
  return faults.empty();
}

std::string digits_of(double number) {
  std::ostringstream text;
  text << std::setprecision(17) << number;
  return text.str();
}

TEST(SettingMeanings, AreThereForEverySetting) {
  for (const SettingRow& row : settings()) {
    const SettingMeaning& about = meaning_of(row.key);
    EXPECT_NE(about.meaning, "") << row.key;
    const bool is_number = row.values == "a number" || row.values == "a whole number";
    EXPECT_EQ(std::isfinite(about.least) && std::isfinite(about.most), is_number) << row.key;
  }
}

TEST(SettingMeanings, AreThereInGerman) {
  for (const SettingRow& row : settings()) {
    const std::string_view german = german_meaning_of(row.key);
    EXPECT_FALSE(german.empty()) << row.key;
    EXPECT_NE(german, meaning_of(row.key).meaning) << row.key;
    // Words of enums stay: all else is said in German.
    if (row.values.find('(') != std::string::npos || row.values.find(", ") == std::string::npos)
      continue;
    if (row.values.find(' ') != row.values.find(", ") + 1) {
      EXPECT_NE(german_values_of(row.values), row.values) << row.key;
    }
  }
  EXPECT_EQ(german_meaning_of("no.such"), "");
  EXPECT_EQ(german_values_of("a number"), "eine Zahl");
  EXPECT_EQ(german_values_of("xy (G17), zx (G18), yz (G19)"), "xy (G17), zx (G18), yz (G19)");
}

TEST(SettingMeanings, NameTheRangeThatIsTaken) {
  for (const SettingRow& row : settings()) {
    const SettingMeaning& about = meaning_of(row.key);
    // A split and counted leads are whole or nothing: their parts are not looked at alone.
    if (!std::isfinite(about.least) || row.key.starts_with("options.split.") ||
        row.key.starts_with("leads."))
      continue;
    EXPECT_TRUE(is_taken(row.key + "=" + digits_of(about.least))) << row.key;
    EXPECT_TRUE(is_taken(row.key + "=" + digits_of(about.most))) << row.key;
    // What does not fit the field is refused before.
    if (about.most == std::numeric_limits<std::uint32_t>::max()) continue;
    const double step = row.values == "a whole number" ? 1 : 1e-6;
    EXPECT_FALSE(is_taken(row.key + "=" + digits_of(about.most + step))) << row.key;
    if (about.least == 0 && step == 1) continue;
    EXPECT_FALSE(is_taken(row.key + "=" + digits_of(about.least - (step == 1 ? 1 : 0.9 * step))))
        << row.key;
  }
}

// Said once more, the initial value changes nothing.
TEST(SettingMeanings, NameTheInitialValue) {
  const auto read_with = [](const std::string& assignment) {
    v1::ProgramSetup setup;
    if (!assignment.empty()) {
      EXPECT_EQ(apply_setting(assignment, setup), "") << assignment;
    }
    FieldFaults faults;
    const ProgramSettings read = from_proto(setup, FieldPath("setup"), faults);
    EXPECT_TRUE(faults.empty()) << assignment;
    v1::ProgramSetup again;
    to_proto(read, again);
    return again.ShortDebugString();
  };
  for (const SettingRow& row : settings()) {
    const std::string initial(meaning_of(row.key).initial);
    const bool is_part =
        row.key.starts_with("options.split.") && row.key != "options.split.measure";
    // They mean nothing without the measure.
    if (initial.empty() || is_part) continue;
    EXPECT_EQ(read_with(row.key + "=" + initial), read_with("")) << row.key;
  }
}

}  // namespace
}  // namespace trc::wire
