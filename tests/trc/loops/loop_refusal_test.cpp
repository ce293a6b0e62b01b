#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "core/messages/diagnostic_text.h"
#include "core/session/program_session.h"

// Where REMOVE_MASKED_BLOCKS finds no way because an end of the contour has no room for the tool,
// the refusal says which tool has.

namespace trc {
namespace {

// A slot of 8 mm whose bottom is y = 0. `contour` begins and ends with a line of the bottom.
std::string program(double radius, const std::string& contour) {
  return "N10 G00 X0 Y30 F1000\nN20 V.G.WZ_AKT.R=" + std::to_string(radius) +
         "\nN30 #TRC [REMOVE_MASKED_BLOCKS=1]\nN40 G26 G139 G141\n" + contour + "N900 M30\n";
}

std::optional<Diagnostic> refusal_of(const std::string& text) {
  ProgramSession session({});
  Answers out;
  if (session.feed(text, out) && session.finish(out)) return {};
  return out.take().diagnostics.back();
}

double value_of(const Diagnostic& diagnostic, const std::string& name) {
  for (const DiagnosticValue& value : diagnostic.values)
    if (value.name == name) return value.value;
  return -1;
}

TEST(LoopRefusal, SaysWhichToolHasRoomAtTheFirstPoint) {
  // On the bottom of the slot, 3 mm from its right wall.
  const std::string contour =
      "N50 G41 G01 X1 Y0\nN60 X4\nN70 Y40\nN80 X80\nN90 Y-40\nN100 X-80\nN110 Y40\nN120 X-4\n"
      "N130 Y0\nN140 X1\nN150 G40 Y30\n";
  const auto refusal = refusal_of(program(3.5, contour));
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->code, Code::line_reversed);
  EXPECT_EQ(refusal->detail, "the tool has no room at the first point of the contour");
  EXPECT_NEAR(value_of(*refusal, "largest_radius"), 3, 2e-4);
  EXPECT_FALSE(refusal_of(program(2.9998, contour)));
  EXPECT_TRUE(refusal_of(program(3.001, contour)));
}

TEST(LoopRefusal, SaysWhichToolHasRoomAtTheLastPoint) {
  const std::string contour = "N50 G41 G01 X-80 Y40\nN60 X-4\nN70 Y0\nN80 X2\nN90 G40 Y30\n";
  const auto refusal = refusal_of(program(7, contour));
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->detail, "the tool has no room at the last point of the contour");
  EXPECT_NEAR(value_of(*refusal, "largest_radius"), 6, 2e-4);
  EXPECT_FALSE(refusal_of(program(5.9998, contour)));
  EXPECT_TRUE(refusal_of(program(6.001, contour)));
}

// Out of a room through a neck between its right wall and the last point.
TEST(LoopRefusal, SaysNothingOfARadiusWhereTheWayIsCutOff) {
  const std::string contour =
      "N50 G41 G01 X-60 Y-100\nN60 X80\nN70 Y-20\nN80 X5\nN90 Y0\nN100 X60\nN110 Y100\n"
      "N120 X-60\nN130 Y0\nN140 X-6\nN150 G40 Y50\n";
  const auto refusal = refusal_of(program(10, contour));
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->detail, "REMOVE_MASKED_BLOCKS finds no way past this block");
  EXPECT_EQ(value_of(*refusal, "largest_radius"), -1);
  EXPECT_FALSE(refusal_of(program(5, contour)));
}

// A pocket of 40 by 30 mm: what leads into it begins beside its left wall, or what leads out of it
// turns back and crosses a wall.
TEST(LoopRefusal, NamesTheLeadThatIsInTheWay) {
  const auto entered = [](const std::string& in, const std::string& out) {
    return refusal_of(program(2.5, "N50 G0 X20 Y15\nN60 G41 G1 " + in +
                                       "\nN70 X20 Y0\nN80 X40\nN90 Y30\nN100 X0\nN110 Y0\n"
                                       "N120 X20\nN130 " +
                                       out + "\nN140 G40 X20 Y15\n"));
  };
  EXPECT_FALSE(entered("X14 Y10", "X25 Y8"));
  const auto at_the_begin = entered("X1 Y10", "X25 Y8");
  ASSERT_TRUE(at_the_begin);
  EXPECT_EQ(at_the_begin->detail, "the tool has no room where the lead-in begins");
  EXPECT_NE(help_of(*at_the_begin).find("Let the lead be wider"), std::string::npos);
  const auto on_the_way = entered("X14 Y10", "X25 Y8\nN135 Y-8");
  ASSERT_TRUE(on_the_way);
  EXPECT_EQ(on_the_way->detail, "REMOVE_MASKED_BLOCKS finds no way past this lead");
  EXPECT_NE(help_of(*on_the_way).find("Let the lead be wider"), std::string::npos);
}

}  // namespace
}  // namespace trc
