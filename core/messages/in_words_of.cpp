#include "core/messages/in_words_of.h"

#include <algorithm>
#include <array>
#include <utility>

namespace trc {
namespace {

struct OwnHelp {
  Code code{};
  bool klartext_alone = false;  // for programs of G functions the row of the code has the help
  std::string_view english;
  std::string_view german;
};

constexpr std::string_view smaller_tool_or_masking =
    "Use a smaller tool: SurveyRadii (trc radii) says which one fits. The setting contour_masking "
    "masks such blocks where it is not on yet, and with it options.remove_masked_blocks leaves out "
    "whole loops.";
constexpr std::string_view smaller_tool_or_masking_in_german =
    "Einen kleineren Fräser nehmen: SurveyRadii (trc radii) sagt, welcher passt. Die Einstellung "
    "contour_masking blendet solche Sätze aus, wo sie noch nicht eingeschaltet ist, und dann lässt "
    "options.remove_masked_blocks ganze Schleifen weg.";

// Help for codes whose rows name words of ISG, as far as programs of other controls meet them.
constexpr auto own_helps = std::to_array<OwnHelp>({
    {.code = Code::circle_center_misfit,
     .klartext_alone = true,
     .english = "Correct CC or the end point.",
     .german = "CC oder den Endpunkt berichtigen."},
    {.code = Code::circular_selection_block,
     .english = "Let the first motion after G41 or G42 be a straight line, or set selection_mode "
                "to on_path or perpendicular.",
     .german = "Die erste Bewegung nach G41 oder G42 als Gerade programmieren, oder "
               "selection_mode auf on_path oder perpendicular setzen."},
    {.code = Code::tool_not_smaller_than_arc,
     .english = "Use a smaller tool or a larger arc. With contour_masking and "
                "options.conv_cir_to_lin such arcs become lines.",
     .german = "Einen kleineren Fräser oder einen größeren Bogen nehmen. Mit contour_masking und "
               "options.conv_cir_to_lin werden solche Bögen zu Geraden."},
    {.code = Code::arc_radii_differ,
     .english = "Correct the centre or the end point, or let circle_center_mode.correction move "
                "the centre.",
     .german = "Mittelpunkt oder Endpunkt berichtigen, oder den Mittelpunkt durch "
               "circle_center_mode.correction verschieben lassen."},
    {.code = Code::line_reversed,
     .english = smaller_tool_or_masking,
     .german = smaller_tool_or_masking_in_german},
    {.code = Code::arc_wrapped,
     .english = smaller_tool_or_masking,
     .german = smaller_tool_or_masking_in_german},
    {.code = Code::circle_incomplete,
     .klartext_alone = true,
     .english = "Program CC before it, or CR with R, or L if it is meant to be straight.",
     .german = "Davor CC programmieren, oder CR mit R, oder L, wenn es eine Gerade sein soll."},
    {.code = Code::deselection_without_motion,
     .english = "Program a retract motion after G40.",
     .german = "Hinter G40 die Abfahrbewegung programmieren."},
    {.code = Code::tool_radius_out_of_range,
     .english = "Check its unit: the radius of the setup is in mm, that of a word in the unit of "
                "the program.",
     .german = "Die Einheit prüfen: der Radius der Einstellungen gilt in mm, der eines Wortes in "
               "der Einheit des Programms."},
    {.code = Code::position_unknown,
     .klartext_alone = true,
     .english = "Program both axes of the plane in a straight line, absolutely, after the "
                "change, before incremental words, circles or RL.",
     .german = "Hinter dem Wechsel beide Achsen der Ebene als Gerade absolut programmieren, vor "
               "inkrementalen Wörtern, Kreisen oder RL."},
    {.code = Code::circular_deselection_block,
     .english = "Let the first motion after G40 be a straight line, or set selection_mode to "
                "on_path or perpendicular.",
     .german = "Die erste Bewegung nach G40 als Gerade programmieren, oder selection_mode auf "
               "on_path oder perpendicular setzen."},
    {.code = Code::clearance_violated,
     .english = "Do not machine it. Use a smaller tool or correct the contour, or have the loops "
                "taken out by contour_masking and options.remove_masked_blocks.",
     .german = "Nicht fertigen. Einen kleineren Fräser nehmen oder die Kontur berichtigen, oder "
               "die Schleifen durch contour_masking und options.remove_masked_blocks "
               "herausnehmen lassen."},
    {.code = Code::center_corrected,
     .klartext_alone = true,
     .english = "Correct the centre or the end point; the arc runs about the shifted centre.",
     .german = "Mittelpunkt oder Endpunkt berichtigen; der Bogen läuft um den verschobenen "
               "Mittelpunkt."},
    {.code = Code::subprogram_unknown,
     .english = "Put it into the same text, or give its text in `subprograms` of the setup.",
     .german = "Es in denselben Text stellen oder seinen Text in `subprograms` des Setups "
               "angeben."},
});

static_assert(std::ranges::is_sorted(own_helps, {}, &OwnHelp::code));

bool goes_on(std::string_view text, std::size_t at) {
  return at < text.size() && text[at] >= '0' && text[at] <= '9';
}

}  // namespace

std::string_view help_in(ControlWords words, Code code, Language language) {
  if (words == ControlWords::isg) return {};
  const auto found = std::ranges::lower_bound(own_helps, code, {}, &OwnHelp::code);
  if (found == own_helps.end() || found->code != code) return {};
  if (found->klartext_alone && words != ControlWords::klartext) return {};
  return language == Language::german ? found->german : found->english;
}

std::string in_words_of(ControlWords words, std::string text) {
  if (words != ControlWords::klartext) return text;
  constexpr auto klartext = std::to_array<std::pair<std::string_view, std::string_view>>(
      {{"G40", "R0"}, {"G41", "RL"}, {"G42", "RR"}});
  for (const auto& [isg, own] : klartext) {
    for (std::size_t at = text.find(isg); at != std::string::npos; at = text.find(isg, at)) {
      if (goes_on(text, at + isg.size()))
        at += isg.size();
      else
        text.replace(at, isg.size(), own);
    }
  }
  return text;
}

}  // namespace trc
