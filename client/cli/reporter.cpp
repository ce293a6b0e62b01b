#include "client/cli/reporter.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/number_text.h"
#include "core/messages/diagnostic_text.h"
#include "core/messages/explanation.h"
#include "core/messages/in_words_of.h"
#include "core/nc/dialect/dialect.h"
#include "core/nc/text/characters.h"
#include "proto/wire/setup.h"

namespace trc::cli {

DialectName dialect_of(const v1::ProgramSetup& setup) {
  wire::FieldFaults faults;
  return wire::from_proto(setup, wire::FieldPath("setup"), faults).path.session.program.dialect;
}

namespace {

// Words of the help that name fields of the setup, and the words of the command line for them.
constexpr auto words_of_options = std::to_array<std::pair<std::string_view, std::string_view>>(
    {{"SurveyRadii (trc radii)", "trc radii"},
     {"leads in the setup", "--set leads=blocks:1,1"},
     {"leads im Setup", "--set leads=blocks:1,1"},
     {", `dialect` in the setup", ""},
     {", `dialect` im Setup", ""},
     {"the radius of the setup", "that of --radius and --tools"},
     {"der Radius der Einstellungen", "der von --radius und --tools"},
     {"The setting contour_masking", "--set contour_masking=on"},
     {"Die Einstellung contour_masking", "--set contour_masking=on"},
     {"With contour_masking", "With --set contour_masking=on"},
     {"Mit contour_masking", "Mit --set contour_masking=on"},
     {"by contour_masking", "by --set contour_masking=on"},
     {"durch contour_masking", "durch --set contour_masking=on"},
     {"options.remove_masked_blocks", "--set remove_masked_blocks=true"},
     {"options.conv_cir_to_lin", "--set conv_cir_to_lin=true"},
     {"circle_center_mode.reference ABSOLUTE in the setup",
      "--set circle_center_mode.reference=absolute"},
     {"circle_center_mode.reference ABSOLUTE im Setup",
      "--set circle_center_mode.reference=absolute"},
     {"circle_center_mode.reference START in the setup",
      "--set circle_center_mode.reference=start"},
     {"circle_center_mode.reference START im Setup", "--set circle_center_mode.reference=start"},
     {"let circle_center_mode.correction", "let --set circle_center_mode.correction=on"},
     {"durch circle_center_mode.correction", "durch --set circle_center_mode.correction=on"},
     {"set selection_mode to on_path or perpendicular",
      "say --set selection_mode=on_path or perpendicular"},
     {"selection_mode auf on_path oder perpendicular setzen",
      "--set selection_mode=on_path oder perpendicular angeben"},
     {"say by block_skip of the setup whether such lines are executed",
      "say how it stands: --set block_skip=execute or leave_out"},
     {"mit block_skip im Setup sagen, ob solche Sätze ausgeführt werden",
      "sagen, wie er steht: --set block_skip=execute oder leave_out"},
     {"declare it in pass_words of the setup; a subprogram is given in `subprograms`",
      "declare it: --set pass_words=NAME; a subprogram is given with --subprograms"},
     {"ihn in pass_words des Setups angeben; ein Unterprogramm gehört in `subprograms`",
      "ihn angeben: --set pass_words=NAME; ein Unterprogramm gibt --subprograms"},
     {"`whole_numbers` UNITS (X10 is 10 mm) or INCREMENTS (X10 is 0.010 mm) in the setup",
      "--whole-numbers units (X10 is 10 mm) or increments (X10 is 0.010 mm)"},
     {"`whole_numbers` UNITS (X10 ist 10 mm) oder INCREMENTS (X10 ist 0.010 mm) im Setup",
      "--whole-numbers units (X10 ist 10 mm) oder increments (X10 ist 0.010 mm)"},
     {"into the same text, or give its text in `subprograms` of the setup",
      "into the same file, or give its file: --subprograms FILE, or the folder"},
     {"in denselben Text stellen oder seinen Text in `subprograms` des Setups angeben",
      "in dieselbe Datei stellen oder seine Datei angeben: --subprograms FILE, oder den Ordner"},
     {"or give tool_radius in the setup", "or give the radius: --radius 5"},
     {"oder tool_radius im Setup angeben", "oder den Radius angeben: --radius 5"},
     {"Give tool_radius in the setup", "Give the radius: --radius 5"},
     {"tool_radius im Setup angeben", "Den Radius angeben: --radius 5"},
     {"`tools` of the setup",
      "--tools tools.csv, --set tools=1:5, by name --set 'tools=\"MILL\":5'"},
     {"`tools` des Setups",
      "--tools tools.csv, --set tools=1:5, mit Namen --set 'tools=\"MILL\":5'"},
     {"`variables` of the setup", "--variable NAME=VALUE"},
     {"`variables` des Setups", "--variable NAME=WERT"},
     {"tool_radius, without a table", "--radius 5, without a table"},
     {"tool_radius, ohne Werkzeugtabelle", "--radius 5, ohne Werkzeugtabelle"},
     {"in the table of the setup", "in the table of --tools"},
     {"in der Tabelle des Setups", "in der Tabelle von --tools"},
     {"may be declared in pass_words", "may be declared: --set pass_words=NAME"},
     {"in pass_words angegeben werden", "mit --set pass_words=NAME angegeben werden"},
     {"in `subprograms` (--subprograms)", "with --subprograms"},
     {"in `subprograms` angeben (--subprograms)", "mit --subprograms angeben"}});

// Replaces the names of fields in help that has no text of its own for the command line.
std::string without_names_of_fields(std::string help) {
  for (const auto& [field, own] : words_of_options)
    if (const std::size_t at = help.find(field); at != std::string::npos)
      help.replace(at, field.size(), own);
  return help;
}

bool is_number(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, is_digit);
}

// The tool that a detail names, as --set tools= has it: D7, 7, the name "MILL", D2 of one of these,
// T1 D2 of Sinumerik, 5.1 of Klartext, which is its second edge. Empty: none.
std::string named_tool(std::string_view detail) {
  constexpr std::string_view of = " of ";
  const auto number_behind_letter = [](std::string_view word) {
    if (!word.empty() && is_letter(word.front())) word.remove_prefix(1);
    return is_number(word) ? std::string(word) : std::string();
  };
  if (const std::size_t at = detail.find(of); at != std::string_view::npos) {
    const std::string edge = number_behind_letter(detail.substr(0, at));
    const std::string tool = named_tool(detail.substr(at + of.size()));
    return edge.empty() || tool.empty() ? std::string() : tool + "/" + edge;
  }
  if (detail.size() > 2 && detail.starts_with('"'))
    return std::string(detail.substr(0, detail.find('"', 1) + 1));
  if (const std::size_t at = detail.find(" D"); at != std::string_view::npos) {
    const std::string tool = number_behind_letter(detail.substr(0, at));
    const std::string edge = number_behind_letter(detail.substr(at + 1));
    return tool.empty() || edge.empty() ? std::string() : tool + (edge == "1" ? "" : "/" + edge);
  }
  const std::size_t point = std::min(detail.find('.'), detail.size());
  std::string tool = number_behind_letter(detail.substr(0, point));
  if (point == detail.size() || tool.empty()) return tool;
  std::uint32_t index = 0;
  const char* const end = detail.data() + detail.size();
  const auto read = std::from_chars(detail.data() + point + 1, end, index);
  return read.ec == std::errc{} && read.ptr == end ? tool + "/" + std::to_string(index + 1)
                                                   : std::string();
}

// Puts the missing tool into the setting that would define it.
std::string with_missing_tool(std::string help, std::string_view detail) {
  const std::string tool = named_tool(detail);
  const std::size_t at = help.find("tools=");
  if (at == std::string::npos || tool.empty()) return help;
  const std::size_t begin = help.find('=', at) + 1;
  help.replace(begin, help.find(':', begin) - begin, tool);
  if (tool.front() != '"') return help;
  help.insert(std::min(help.find_first_of(",.", begin + tool.size()), help.size()), "'");
  return help.insert(at, "'");
}

// Puts the wear that is too large into the setting that would allow it.
std::string with_wear(std::string help, std::span<const DiagnosticValue> values) {
  constexpr std::string_view named = "max_wear=";
  const std::size_t at = help.find(named);
  const auto wear = std::ranges::find(values, "wear", &DiagnosticValue::name);
  if (wear == values.end() || at == std::string::npos) return help;
  const std::size_t begin = at + named.size();
  const std::size_t end = help.find_first_not_of("0123456789", begin);
  return help.replace(begin, end - begin, shortest(std::ceil(std::abs(wear->value))));
}

// Puts the unknown function into the setting that passes it on.
std::string with_name_of_function(std::string help, std::string_view detail) {
  constexpr std::string_view name = "NAME";
  const std::size_t at = help.find("pass_words=NAME");
  const bool is_word = !detail.empty() && detail.find_first_of(" ,") == std::string_view::npos;
  if (!is_word || at == std::string::npos) return help;
  return help.replace(help.find(name, at), name.size(), detail);
}

}  // namespace

Diagnostic for_command_line(Diagnostic found, DialectName dialect) {
  const ControlWords words = dialect_of(dialect).words;
  const std::string_view own = help_on_command_line(found.code, found.language);
  const bool has_own = !own.empty() && help_in(words, found.code, found.language).empty();
  DiagnosticTexts texts = texts_of(found);
  const bool is_of_row =
      texts.help == help_of({.code = found.code, .words = words}, found.language);
  texts.help = has_own && is_of_row ? in_words_of(words, std::string(own))
                                    : without_names_of_fields(std::move(texts.help));
  if (found.code == Code::tool_unknown || found.code == Code::no_tool_radius)
    texts.help = with_missing_tool(std::move(texts.help), found.detail);
  if (found.code == Code::wear_too_large)
    texts.help = with_wear(std::move(texts.help), found.values);
  if (found.code == Code::nc_unknown_function)
    texts.help = with_name_of_function(std::move(texts.help), found.detail);
  found.texts = std::make_shared<const DiagnosticTexts>(std::move(texts));
  found.words = words;
  return found;
}

Reporter::Reporter(Input& input, const v1::ProgramSetup& setup, Progress& progress, bool quiet)
    : input_(input),
      lines_(input),
      subprograms_(setup),
      writing_{.dialect = dialect_of(setup)},
      in_colour_(colours_wanted()),
      quiet_(quiet),
      progress_(progress) {}

void Reporter::report(const std::vector<Diagnostic>& diagnostics) {
  for (const Diagnostic& found : diagnostics) {
    refused_ = refused_ || found.severity == Severity::error;
    if (quiet_ && found.severity != Severity::error) continue;
    const Text text(found.severity, found.code, texts_of(found).message);
    if (const auto like = like_shown_.find(text); like != like_shown_.end()) {
      like->second.add(found);
    } else if (order_.size() < most_texts) {
      like_shown_.emplace(text, Counted{});
      order_.push_back(text);
      show(found);
    } else {
      of_other_texts_[Kind(found.severity, found.code)].add(found);
    }
  }
}

void Reporter::show(const Diagnostic& found) {
  progress_.clear();
  const auto within =
      found.calls.empty() ? std::nullopt : subprograms_.line_of(found.calls.front());
  if (within) {
    Diagnostic there = for_command_line(found, writing_.dialect);
    there.source = {.line = found.calls.front().line_within};
    std::cerr << text_of(there, {.file = within->file,
                                 .source_line = within->text,
                                 .writing = writing_,
                                 .in_colour = in_colour_});
    return;
  }
  std::cerr << text_of(for_command_line(found, writing_.dialect),
                       {.file = input_.name(),
                        .source_line = lines_.line(found.source.line),
                        .writing = writing_,
                        .in_colour = in_colour_});
}

void Reporter::finish() {
  progress_.clear();
  const Shown shown{.file = input_.name(), .in_colour = in_colour_};
  for (const Text& text : order_) {
    const Counted& like = like_shown_.at(text);
    if (like.count > 0) std::cerr << more_like(like, shown);
  }
  for (const auto& [kind, counted] : of_other_texts_) std::cerr << more_of_code(counted, shown);
  order_.clear();
  like_shown_.clear();
  of_other_texts_.clear();
}

}  // namespace trc::cli
