#include "core/nc/dialect/pass_words.h"

#include <algorithm>
#include <array>

#include "core/nc/dialect/dialect.h"
#include "core/nc/dialect/sinumerik_names.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/words.h"

namespace trc {
namespace {

constexpr std::string_view axis_and_center_letters = "ABCIJKQRUVWXYZ";

// Statements of one dialect or another: they cannot be declared (D-60).
constexpr auto statements = std::to_array<std::string_view>(
    {"APPR",  "BEGIN", "CALL",   "CASE",  "CHF",   "CYCL",  "DEF",   "DEP",  "DO",    "ELSE", "END",
     "FN",    "FOR",   "GOTO",   "GOTOB", "GOTOC", "GOTOF", "GOTOS", "IF",   "LBL",   "LOOP", "LP",
     "PCALL", "PROC",  "REPEAT", "RET",   "RND",   "SUB",   "THEN",  "TOOL", "TRANS", "WHILE"});

// The name of a file with its extension, which only a call of ISG has. G777.1 and X1.5 are words.
bool is_file_name(std::string_view word) {
  const std::size_t point = word.find('.');
  return point != 0 && point != std::string_view::npos &&
         word.find_first_not_of("0123456789", point + 1) != std::string_view::npos &&
         word.find_first_of("#=,;()[]\" \t") == std::string_view::npos;
}

}  // namespace

std::string called_file(std::string_view call) {
  call = without_blanks_in_front(call);
  const bool is_quoted = call.starts_with('"');
  if (is_quoted) call.remove_prefix(1);
  return in_upper_case(call.substr(0, call.find_first_of(is_quoted ? "\"" : " \t[(;\"")));
}

std::string word_to_pass(std::string_view line, std::size_t begin) {
  std::size_t at = begin;
  std::string word;
  if (at < line.size() && line[at] == '#') word += line[at++];
  while (at < line.size() && (is_letter(line[at]) || line[at] == '_')) word += upper(line[at++]);
  const bool is_function = word.size() == 1 && word != "#";
  if (is_function) {
    while (const std::size_t blank = blank_at_start(line.substr(at))) at += blank;
    while (at + 1 < line.size() && line[at] == '0' && is_digit(line[at + 1])) ++at;
  }
  while (at < line.size() &&
         (is_function ? is_digit(line[at]) || line[at] == '.' : goes_on_as_name(line[at])))
    word += upper(line[at++]);
  return word;
}

std::string fault_of_pass_word(std::string_view word, DialectName dialect) {
  constexpr std::size_t longest = 32;
  if (dialect == DialectName::isg && word.size() <= longest && is_file_name(word)) return "";
  if (word.empty() || word.size() > longest || word_to_pass(word, 0) != word)
    return "is no name and no function in capitals, such as SOFTA or G777";
  const bool is_function = word.size() > 1 && !is_letter(word[1]) && word[1] != '_';
  const bool is_program = word.front() == 'O' && is_function &&
                          word.find_first_not_of("0123456789", 1) == std::string_view::npos;
  if (is_program && dialect == DialectName::fanuc) return "";
  const bool is_subprogram = word.front() == 'L' && is_function &&
                             word.find_first_not_of("0123456789", 1) == std::string_view::npos;
  if (is_subprogram && dialect == DialectName::sinumerik) return "";
  if (word.front() != '#' && (word.size() == 1 || (is_function && word.front() != 'G')))
    return "is the word of an address";
  if (is_function && word.front() == 'G') {
    double number = 0;
    bool whole = false;
    const std::size_t length = read_number(word.substr(1), number, whole);
    if (length + 1 != word.size()) return "is no function";
    return dialect_of(dialect).function(number) == nullptr ? "" : "is known";
  }
  const bool of_axes = std::ranges::all_of(word, [](char letter) {
    return axis_and_center_letters.find(letter) != std::string_view::npos;
  });
  if (of_axes) return "names axes";
  const bool known = std::ranges::find(statements, word) != statements.end() || word == "#TRC" ||
                     (dialect == DialectName::sinumerik && is_sinumerik_word_of_any_kind(word));
  return known ? "is known" : "";
}

}  // namespace trc
