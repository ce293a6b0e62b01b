#include "client/plot/words.h"

namespace trc::plot {
namespace {

constexpr Words english{
    .layers = {"programmed beside contours", "lead-in, lead-out", "programmed contour",
               "as programmed, replaced", "masked or removed", "path beside contours",
               "compensated path", "transition block", "proposed instead"},
    .origins = {"programmed", "approach", "retract", "transition", "masked", "radius change",
                "moved (KERF_MASKING)", "chord (CONV_CIR_TO_LIN)", "", "uncompensated"},
    .rapid = ", rapid",
    .tool = "tool",
    .tool_radius = "tool radius ",
    .plane = "plane ",
    .more_warnings = " more warnings",
    .more_notes = " more notes",
    .error = "error ",
    .warning = "warning ",
    .note = "note ",
    .in_line = " in line ",
    .line = "line ",
    .block = "block ",
    .contour = " contour",
    .lead = " lead",
    .as_programmed = " as programmed",
    .changed = " contour, changed",
    .not_travelled = ", not travelled",
    .proposed_entry = "proposed entry",
    .proposed_exit = "proposed exit",
    .as_line = ", line",
    .as_quarter = ", quarter circle",
    .as_corner = ", line with G238",
};

constexpr Words german{
    .layers = {"programmiert, neben Konturen", "Ein- und Auslauf", "programmierte Kontur",
               "wie programmiert, ersetzt", "ausgeblendet oder entfernt", "Bahn neben Konturen",
               "korrigierte Bahn", "Übergangssatz", "Vorschlag stattdessen"},
    .origins = {"programmiert", "Anfahren", "Abfahren", "Übergang", "ausgeblendet", "Radiuswechsel",
                "verschoben (KERF_MASKING)", "Sehne (CONV_CIR_TO_LIN)", "", "unkorrigiert"},
    .rapid = ", Eilgang",
    .tool = "Werkzeug",
    .tool_radius = "Werkzeugradius ",
    .plane = "Ebene ",
    .more_warnings = " weitere Warnungen",
    .more_notes = " weitere Hinweise",
    .error = "Fehler ",
    .warning = "Warnung ",
    .note = "Hinweis ",
    .in_line = " in Zeile ",
    .line = "Zeile ",
    .block = "Satz ",
    .contour = " Kontur",
    .lead = " Ein- oder Auslauf",
    .as_programmed = " wie programmiert",
    .changed = " Kontur, geändert",
    .not_travelled = ", nicht befahren",
    .proposed_entry = "Vorschlag zum Anfahren",
    .proposed_exit = "Vorschlag zum Abfahren",
    .as_line = ", Gerade",
    .as_quarter = ", Viertelkreis",
    .as_corner = ", Gerade mit G238",
};

}  // namespace

const Words& words_in(Language language) { return language == Language::german ? german : english; }

std::string number_of(const Source& source, const Words& words) {
  if (source.number != Source::no_number) return "N" + std::to_string(source.number);
  if (source.line > 0) return words.line + std::to_string(source.line);
  return words.block + std::to_string(source.index + 1);
}

}  // namespace trc::plot
