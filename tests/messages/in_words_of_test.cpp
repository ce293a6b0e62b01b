#include "core/messages/in_words_of.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "core/messages/diagnostic_text.h"
#include "core/messages/english.h"

namespace trc {
namespace {

constexpr Language languages[] = {Language::english, Language::german};

TEST(ControlWords, OfKlartextStandForTheSides) {
  EXPECT_EQ(in_words_of(ControlWords::klartext, "Let G41 or G42 follow G40, not G410."),
            "Let RL or RR follow R0, not G410.");
  EXPECT_EQ(in_words_of(ControlWords::g_functions, "after G40"), "after G40");
}

TEST(ControlWords, NameNoFunctionThatOnlyIsgHas) {
  for (const Code code :
       {Code::circular_selection_block, Code::tool_not_smaller_than_arc, Code::arc_radii_differ,
        Code::line_reversed, Code::arc_wrapped, Code::deselection_without_motion,
        Code::circular_deselection_block, Code::clearance_violated}) {
    for (const ControlWords words : {ControlWords::g_functions, ControlWords::klartext}) {
      for (const Language language : languages) {
        const std::string help = help_of({.code = code, .words = words}, language);
        EXPECT_FALSE(help.empty());
        for (const std::string_view isg : {"G141", "#TRC", "G16", "G23", "G13", "G25", "G26"})
          EXPECT_EQ(help.find(isg), std::string::npos) << help;
      }
    }
    EXPECT_TRUE(help_in(ControlWords::isg, code, Language::english).empty());
  }
}

TEST(ControlWords, AreThoseOfTheTableWhereThatNamesNoneOfIsg) {
  const Diagnostic found{.code = Code::bottleneck, .words = ControlWords::klartext};
  EXPECT_EQ(help_of(found), english_row_of(Code::bottleneck).remedy);
}

TEST(ControlWords, OfAMessageAreThoseOfItsProgram) {
  const Diagnostic found{.code = Code::deselection_without_motion, .words = ControlWords::klartext};
  EXPECT_EQ(message_of(found),
            "RL or RR follows R0 although no motion in the plane has left the contour");
  EXPECT_EQ(texts_of(found).help, "Program a retract motion after R0.");
}

}  // namespace
}  // namespace trc
