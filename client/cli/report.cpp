#include "client/cli/report.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "client/cli/printable.h"
#include "core/base/utf8.h"
#include "core/messages/diagnostic_text.h"
#include "core/nc/text/characters.h"

namespace trc::cli {
namespace {

// The longest shown part of a line, in characters.
constexpr std::size_t widest = 120;

constexpr std::string_view bold = "1";
constexpr std::string_view red = "1;31";
constexpr std::string_view green = "1;32";
constexpr std::string_view magenta = "1;35";
constexpr std::string_view cyan = "1;36";

std::string_view word_for(Severity severity, Language language) {
  const bool german = language == Language::german;
  switch (severity) {
    case Severity::note:
      return german ? "Hinweis" : "note";
    case Severity::warning:
      return german ? "Warnung" : "warning";
    case Severity::error:
      break;
  }
  return german ? "Fehler" : "error";
}

std::string_view colour_of(Severity severity) {
  switch (severity) {
    case Severity::note:
      return cyan;
    case Severity::warning:
      return magenta;
    case Severity::error:
      break;
  }
  return red;
}

// A character in one column of the screen. The text comes from the program or from a server, so its
// control characters must not reach the terminal.
struct Character {
  std::string shown{};
  std::size_t begin = 0;  // bytes of the text before it
};

std::vector<Character> characters_of(std::string_view text) {
  std::vector<Character> characters;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_character(text.substr(at));
    const std::string_view one = text.substr(at, std::max<std::size_t>(1, length));
    Character next{.begin = at};
    next.shown = printable_character(one);
    characters.push_back(std::move(next));
    at += one.size();
  }
  return characters;
}

std::string painted(std::string text, std::string_view colour, const Shown& shown) {
  if (!shown.in_colour) return text;
  return "\x1b[" + std::string(colour) + "m" + text + "\x1b[0m";
}

// 1-based byte; 0: not known.
std::size_t column_of(const Diagnostic& diagnostic, const std::optional<std::string>& line) {
  const bool of_command = line && diagnostic.column > 0 && diagnostic.column <= line->size() &&
                          (*line)[diagnostic.column - 1] == '#';
  if ((diagnostic.column > 0 && !of_command) || !line || diagnostic.detail.empty())
    return diagnostic.column;
  const std::size_t at = line->find(diagnostic.detail);
  const bool once = at != std::string::npos && line->find(diagnostic.detail, at + 1) == line->npos;
  return once ? at + 1 : diagnostic.column;
}

// The place after `="MILL"` or `=R7*2`, if that follows.
std::size_t behind_value(std::string_view line, std::size_t at) {
  if (at >= line.size() || line[at] != '=') return at;
  const bool quoted = line.substr(at + 1).starts_with('"');
  const std::size_t close = quoted ? line.find('"', at + 2) : line.npos;
  if (close != line.npos) return close + 1;
  return std::min(line.find_first_of(" \t;(", at + 1), line.size());
}

// The length in bytes of the word at the column: the detail, or its first part, if it is there;
// otherwise a name, or a letter and its number.
std::size_t word_length(std::string_view line, std::size_t begin, std::string_view detail) {
  if (!line.substr(begin).starts_with(detail)) detail = detail.substr(0, detail.find(", "));
  if (!detail.empty() && line.substr(begin).starts_with(detail)) return detail.size();
  if (line[begin] == '#') {
    const std::size_t close = line.find(']', begin);
    return (close == line.npos ? line.find_last_not_of(" \r") : close) + 1 - begin;
  }
  // V.G.WZ_AKT.R is a name as well.
  const bool is_dotted = line.substr(begin + 1).starts_with('.') && is_letter(line[begin]) &&
                         begin + 2 < line.size() && is_letter(line[begin + 2]);
  const bool is_name = is_dotted || (begin + 1 < line.size() && is_letter(line[begin + 1]) &&
                                     (is_letter(line[begin]) || line[begin] == '$'));
  const auto goes_on = [&](char sign) {
    return is_digit(sign) || (is_name ? is_letter(sign) || sign == '_' || (is_dotted && sign == '.')
                                      : sign == '.' || sign == '+' || sign == '-');
  };
  std::size_t end = begin + 1;
  while (end < line.size() && goes_on(line[end])) ++end;
  return behind_value(line, end) - begin;
}

// The line of the program, with the mark below it.
std::string excerpt_of(const Diagnostic& diagnostic, std::size_t column, const Shown& shown) {
  const std::string& line = *shown.source_line;
  const std::vector<Character> all = characters_of(line);
  const auto at_byte = [&](std::size_t byte) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const Character& one) { return one.begin >= byte; });
    return static_cast<std::size_t>(found - all.begin());
  };
  const bool marked = column > 0 && column <= line.size();
  const std::size_t mark = marked ? at_byte(column - 1) : 0;
  const std::size_t mark_end =
      marked ? at_byte(column - 1 + word_length(line, column - 1, diagnostic.detail)) : 0;
  const std::size_t from = all.size() > widest && mark > widest / 2 ? mark - widest / 2 : 0;
  const std::size_t to = std::min(all.size(), from + widest);

  const std::string number = std::to_string(diagnostic.source.line);
  const std::size_t width = std::max<std::size_t>(5, number.size());
  std::string text = std::string(width - number.size(), ' ') + number + " | ";
  if (from > 0) text += "…";
  for (std::size_t i = from; i < to; ++i) text += all[i].shown;
  if (to < all.size()) text += "…";
  text += '\n';
  if (!marked) return text;
  text += std::string(width, ' ') + " | " + std::string(mark - from + (from > 0 ? 1 : 0), ' ');
  const std::size_t tildes = std::min(mark_end, to) - std::min(to, mark + 1);
  return text + painted("^" + std::string(mark_end > mark ? tildes : 0, '~'), green, shown) + '\n';
}

std::string lines_of_help(const std::string& help, Language language, const Shown& shown) {
  return painted(language == Language::german ? "Hilfe:" : "help:", green, shown) + ' ' +
         printable(help) + '\n';
}

std::string severity_and_code(Severity severity, Code code, Language language, const Shown& shown) {
  return painted(std::string(word_for(severity, language)) + ' ' +
                     std::to_string(static_cast<int>(code)) + ':',
                 colour_of(severity), shown);
}

// For example "8 (N80)".
std::string name_of(const Source& source) {
  std::string name = std::to_string(source.line);
  if (source.number != Source::no_number) name += " (N" + std::to_string(source.number) + ")";
  return name;
}

std::string more(const Counted& counted, std::string_view of_what, const Shown& shown) {
  const std::vector<Source>& places = counted.first_places;
  const bool german = counted.language == Language::german;
  const std::string_view in_lines = german ? (places.size() == 1 ? ", in Zeile " : ", in Zeilen ")
                                           : (places.size() == 1 ? ", in line " : ", in lines ");
  std::string text = painted(printable(shown.file) + ':', bold, shown) + ' ' +
                     severity_and_code(counted.severity, counted.code, counted.language, shown) +
                     ' ' + std::to_string(counted.count) + std::string(of_what);
  for (std::size_t i = 0; i < places.size(); ++i)
    text.append(i > 0 ? ", " : in_lines).append(name_of(places[i]));
  if (!places.empty() && counted.count > places.size())
    text += (german ? " und " : " and ") + std::to_string(counted.count - places.size()) +
            (german ? " weiteren" : " others");
  return text + '\n';
}

}  // namespace

std::string text_of(const Diagnostic& diagnostic, const Shown& shown) {
  const std::size_t column = column_of(diagnostic, shown.source_line);
  std::string place = printable(shown.file);
  if (diagnostic.source.line > 0) place += ':' + std::to_string(diagnostic.source.line);
  if (diagnostic.source.line > 0 && column > 0) place += ':' + std::to_string(column);
  place += ':';
  // Block numbers of Klartext have no N.
  if (diagnostic.source.number != Source::no_number)
    place += (diagnostic.words != ControlWords::klartext ? " N"
              : diagnostic.language == Language::german  ? " Satz "
                                                         : " block ") +
             std::to_string(diagnostic.source.number) + ':';

  const DiagnosticTexts texts = texts_of(diagnostic);
  std::string text =
      painted(place, bold, shown) + ' ' +
      severity_and_code(diagnostic.severity, diagnostic.code, diagnostic.language, shown) + ' ' +
      painted(printable(texts.text), bold, shown) + '\n';
  if (diagnostic.source.line > 0 && shown.source_line && !shown.source_line->empty())
    text += excerpt_of(diagnostic, column, shown);
  if (!texts.help.empty()) text += lines_of_help(texts.help, diagnostic.language, shown);
  if (!diagnostic.entry_help) return text;
  Writing writing = shown.writing;
  writing.inch = diagnostic.inch;
  writing.language = diagnostic.language;
  for (const std::string& line : lines_of(*diagnostic.entry_help, writing))
    text += lines_of_help(line, diagnostic.language, shown);
  return text;
}

void Counted::add(const Diagnostic& found) {
  severity = found.severity;
  code = found.code;
  language = found.language;
  ++count;
  if (found.source.line > 0 && first_places.size() < most_places)
    first_places.push_back(found.source);
}

std::string more_like(const Counted& counted, const Shown& shown) {
  return more(counted, counted.language == Language::german ? " weitere gleiche" : " more like it",
              shown);
}

std::string more_of_code(const Counted& counted, const Shown& shown) {
  return more(counted,
              counted.language == Language::german
                  ? " weitere mit diesem Code, jede mit anderem Text"
                  : " more with this code, each in other words",
              shown);
}

bool colours_wanted() {
  const char* refused = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  return (refused == nullptr || *refused == '\0') && terminal != nullptr &&
         std::string_view(terminal) != "dumb" && isatty(STDERR_FILENO) == 1;
}

}  // namespace trc::cli
