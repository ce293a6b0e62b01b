#include "core/messages/diagnostic_text.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/messages/english.h"

namespace trc {
namespace {

TEST(Message, HoldsCauseDetailAndValues) {
  Diagnostic shown = diagnostic(Code::circle_radii_differ, {}, "J5");
  shown.values = {{"start_radius", 5}, {"end_radius", 5.25}};
  EXPECT_EQ(message_of(shown),
            "start and end of the arc are not equally far from its centre (G164): J5 "
            "(start radius 5.000 mm, end radius 5.250 mm)");
}

std::string values_in(std::vector<DiagnosticValue> values) {
  Diagnostic shown = diagnostic(Code::program_empty, {});
  shown.values = std::move(values);
  const std::string text = message_of(shown);
  return text.substr(text.find(" (") + 1);
}

TEST(Message, TellsLengthsApartThatDiffer) {
  EXPECT_EQ(values_in({{"start_radius", 5}, {"end_radius", 5.00012}}),
            "(start radius 5.0000 mm, end radius 5.0001 mm)");
  EXPECT_EQ(values_in({{"radius", 5}, {"limit", 5.0001}}), "(radius 5.000 mm, limit 5.0001)");
  EXPECT_EQ(values_in({{"gap", 0.00001234}}), "(gap 1.23e-05 mm)");
  EXPECT_EQ(values_in({{"gap", 3.47e-18}}), "(gap 0.000 mm)");
  EXPECT_EQ(values_in({{"gap", -3.47e-18}}), "(gap 0.000 mm)");
  EXPECT_EQ(values_in({{"coordinate", 1e300}, {"largest", 1e7}}),
            "(coordinate 1e+300 mm, largest 10000000.000 mm)");
  EXPECT_EQ(values_in({{"coordinate", std::numeric_limits<double>::quiet_NaN()}}),
            "(coordinate nan mm)");
}

TEST(Message, SaysWhatAValueCounts) {
  EXPECT_EQ(values_in({{"turn", 90}, {"tool_radius", 4}}),
            "(turn 90.000 degrees, tool radius 4.000 mm)");
  EXPECT_EQ(values_in({{"angle", 201.5}, {"largest_angle", 180}}),
            "(angle 201.500 degrees, largest angle 180.000 degrees)");
  EXPECT_EQ(values_in({{"left_out_length", 57.9043302}, {"max_masked_share", 0.5}}),
            "(length left out 57.904 mm, largest share 50 %)");
  EXPECT_EQ(values_in({{"lines", 12}}), "(in 12 lines)");
  EXPECT_EQ(values_in({{"feed", -1}}), "(feed -1 mm/min)");
}

TEST(Message, SaysLengthsInTheUnitOfTheProgram) {
  Diagnostic found = diagnostic(Code::bottleneck, {});
  found.values = {{"clearance", 2.54}, {"tool_radius", 6.35}, {"turn", 90}, {"feed", 254}};
  found.inch = true;
  EXPECT_EQ(
      message_of(found),
      std::string(english_row_of(Code::bottleneck).cause) +
          " (clearance 0.1000 in, tool radius 0.2500 in, turn 90.000 degrees, feed 10 in/min)");
  found.values = {{"start_radius", 25.4}, {"end_radius", 25.4001}, {"gap", 0.00002}};
  EXPECT_EQ(message_of(found), std::string(english_row_of(Code::bottleneck).cause) +
                                   " (start radius 1.000000 in, end radius 1.000004 in, gap "
                                   "7.87e-07 in)");
  // 0.75 - 0.5 inch of the program are 0.25 inch of the tool, whatever is left of the sum.
  found.values = {{"programmed_length", 6.350000000000001}, {"tool_radius", 6.35}};
  EXPECT_TRUE(message_of(found).ends_with(" 0.2500 in, tool radius 0.2500 in)"))
      << message_of(found);
}

TEST(Message, SaysOfAnArcThatIsTooSmallWhichToolAndArc) {
  Diagnostic found = diagnostic(Code::tool_not_smaller_than_arc, {});
  found.values = {{"contour_radius", 3}, {"tool_radius", 5}, {"difference", -2}};
  EXPECT_EQ(message_of(found),
            "tool ⌀10.000 mm does not fit into the arc of radius 3.000 mm: its radius is not "
            "smaller than that of the arc (tool radius 5.000 mm, difference -2.000 mm)");
  EXPECT_EQ(message_of(found, Language::german),
            "Werkzeug ⌀10.000 mm passt nicht in den Bogen mit Radius 3.000 mm: sein Radius ist "
            "nicht kleiner als der des Bogens (Werkzeugradius 5.000 mm, Unterschied -2.000 mm)");
}

TEST(Help, NamesTheDialectThatTheProgramLooksLike) {
  const auto help_for = [](const char* detail, Language language = Language::english) {
    return help_of(diagnostic(Code::other_dialect, {}, detail), language);
  };
  for (const char* name : {"fanuc", "linuxcnc", "sinumerik", "heidenhain"})
    for (const Language language : {Language::english, Language::german}) {
      const std::string help = help_for(("O1, as in " + std::string(name)).c_str(), language);
      EXPECT_NE(help.find("--dialect " + std::string(name)), std::string::npos) << help;
    }
  EXPECT_EQ(help_for("G41.1"), std::string(english_row_of(Code::other_dialect).remedy));
}

TEST(Message, NamesAnotherBlockByItsLine) {
  std::vector<DiagnosticValue> values;
  append_place(values, "first", {.index = 5, .number = 70, .line = 7});
  EXPECT_EQ(values_in(values), "(first block line 7 (N70))");
}

TEST(Message, IsTheCauseAloneWhenThereIsNoMore) {
  EXPECT_EQ(message_of(diagnostic(Code::program_empty, {})), "the program has no block");
}

TEST(Help, IsAboutWhatTheBlockGives) {
  Diagnostic arc = diagnostic(Code::circle_center_misfit, {});
  EXPECT_NE(help_of(arc).find("Correct I, J, K"), std::string::npos);
  arc.values = {{"radius", 5}, {"smallest_radius", 22.4}};
  EXPECT_EQ(help_of(arc).find("I, J, K"), std::string::npos) << help_of(arc);
  EXPECT_NE(help_of(arc).find("Correct the radius"), std::string::npos) << help_of(arc);
  EXPECT_NE(help_of(arc, Language::german).find("Den Radius"), std::string::npos);

  // A reason has a help of its own, whichever code it comes with.
  const auto help_for = [](Code code, const char* detail, ControlWords words) {
    Diagnostic found = diagnostic(code, {}, detail);
    found.words = words;
    return help_of(found);
  };
  EXPECT_EQ(help_for(Code::nc_number, "APPR LT without LEN", ControlWords::klartext),
            "Write what is missing in the block.");
  EXPECT_EQ(help_for(Code::circle_incomplete, "C without DR", ControlWords::klartext),
            "Write DR+ or DR- in the block.");
  EXPECT_EQ(help_for(Code::nc_unsupported, "LX+40", ControlWords::klartext),
            "Check its spelling. If this is a program of another control, declare its dialect "
            "(--dialect, `dialect` in the setup).");
  // Without a help for the reason that of the code is given.
  EXPECT_EQ(help_for(Code::nc_number, "Y", ControlWords::isg),
            english_row_of(Code::nc_number).remedy);
  EXPECT_NE(help_for(Code::circle_incomplete, "", ControlWords::klartext).find("CC"),
            std::string::npos);
}

}  // namespace
}  // namespace trc
