#include "client/cli/passed_words.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/nc/text/characters.h"

namespace trc::cli {
namespace {

void count(std::vector<CountedWord>& words, std::string text, std::uint32_t line) {
  const auto known = std::ranges::find(words, text, &CountedWord::text);
  if (known != words.end())
    ++known->times;
  else
    words.push_back({.text = std::move(text), .times = 1, .line = line});
}

bool is_of_name(char sign) {
  return is_letter(sign) || is_digit(sign) || sign == '_' || sign == '#' || sign == '$';
}

bool is_of_number(char sign) { return is_digit(sign) || sign == '.'; }

std::size_t behind_blanks(std::string_view text, std::size_t at) {
  return std::min(text.find_first_not_of(' ', at), text.size());
}

// The end of a comment, a text in quotation marks or a bracket that begins there; `at`: none does.
std::size_t behind_enclosed(std::string_view text, std::size_t at) {
  if (text[at] == ';') return text.size();
  const char close = text[at] == '(' ? ')' : text[at] == '[' ? ']' : text[at] == '"' ? '"' : '\0';
  if (close == '\0') return at;
  return std::min(text.find(close, at + 1), text.size() - 1) + 1;
}

// "MILL" after T=, or the number after T.
std::string tool_behind(std::string_view text, std::size_t at) {
  if (at < text.size() && text[at] == '=') at = behind_blanks(text, at + 1);
  std::size_t end = at;
  if (at < text.size() && text[at] == '"') end = behind_enclosed(text, at);
  while (end < text.size() && is_of_number(text[end])) ++end;
  return std::string(text.substr(at, end - at));
}

void read_words(std::string_view text, std::uint32_t line, PassedWords& words) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t enclosed = behind_enclosed(text, at);
    const std::size_t begin = at;
    at = std::max(enclosed, at + 1);
    if (enclosed > begin || !(is_letter(text[begin]) || text[begin] == '#')) continue;
    const char letter = upper(text[begin]);
    const bool is_name = at < text.size() && is_of_name(text[at]) && !is_digit(text[at]);
    while (at < text.size() && (is_name ? is_of_name(text[at]) : is_of_number(text[at]))) ++at;
    const std::string word = in_upper_case(text.substr(begin, at - begin));
    if (is_name || ((letter == 'G' || letter == 'M') && word.size() > 1))
      count(words.passed, word, line);
    else if (letter == 'T' && !tool_behind(text, begin + 1).empty())
      count(words.tools, "T" + tool_behind(text, begin + 1), line);
  }
}

// TOOL CALL 5 Z, CYCL DEF 9.0 DWELL; of a motion only the M words.
void read_statement(std::string_view text, std::uint32_t line, PassedWords& words) {
  std::vector<std::string_view> parts;
  const std::string_view said = text.substr(0, text.find(';'));
  for (std::size_t at = behind_blanks(said, 0); at < said.size(); at = behind_blanks(said, at)) {
    const std::size_t begin = at;
    at = said[at] == '"' ? behind_enclosed(said, at) : std::min(said.find(' ', at), said.size());
    parts.push_back(said.substr(begin, at - begin));
  }
  if (parts.empty()) return;
  const std::string first = in_upper_case(parts[0]);
  const std::string second = parts.size() > 1 ? in_upper_case(parts[1]) : std::string();
  const bool is_frame = first == "BEGIN" || first == "END" || first == "BLK";
  if (first == "TOOL" && second == "CALL" && parts.size() > 2) {
    const bool names_tool = is_digit(parts[2][0]) || parts[2][0] == '"' || parts[2][0] == 'Q';
    if (names_tool) count(words.tools, std::string(parts[2]), line);
  } else if (first.size() > 2 && !is_digit(first[1]) && !is_frame) {
    // The number of a cycle without the one of its line.
    const std::string third = second == "DEF" && parts.size() > 2
                                  ? " " + std::string(parts[2].substr(0, parts[2].find('.')))
                                  : "";
    count(words.passed, first + (second.empty() ? "" : " " + second) + third, line);
  }
  for (const std::string_view part : parts)
    if (part.size() > 1 && upper(part[0]) == 'M' && is_digit(part[1]))
      count(words.passed, in_upper_case(part), line);
}

}  // namespace

PassedWords passed_words(const std::vector<CompensatedBlock>& blocks, DialectName dialect) {
  PassedWords words;
  for (const CompensatedBlock& block : blocks) {
    if (block.text.empty()) continue;
    if (dialect == DialectName::heidenhain)
      read_statement(block.text, block.source.line, words);
    else
      read_words(block.text, block.source.line, words);
  }
  return words;
}

}  // namespace trc::cli
