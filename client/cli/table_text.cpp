#include "client/cli/table_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/base/ascii.h"
#include "core/nc/text/characters.h"

namespace trc::cli {
namespace {

constexpr std::string_view ends_of_value = " \t\r;(/";
constexpr std::string_view blanks = " \t\r";

// Takes the cell in quotation marks that the row begins with. False: the row begins with none.
bool take_quoted(std::string_view& row, std::string& cell, std::string& fault) {
  const auto begin = row.find_first_not_of(blanks);
  if (begin == std::string_view::npos || row[begin] != '"') return false;
  for (std::size_t at = begin + 1; at < row.size(); ++at) {
    if (row[at] == '"' && sign_at(row, at + 1) != '"') {
      row.remove_prefix(at + 1);
      return true;
    }
    cell += row[at];
    if (row[at] == '"') ++at;
  }
  fault = "a quotation mark is not closed in its line";
  return false;
}

std::size_t end_of_value(std::string_view line, std::size_t at) {
  while (at < line.size() && !is_letter(line[at]) && ends_of_value.find(line[at]) == line.npos)
    ++at;
  return at;
}

}  // namespace

std::string_view without_quotes(std::string_view text) { return trimmed(text, " \t\r\""); }

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto end = text.find(separator);
    parts.push_back(without_quotes(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

CsvCells csv_cells(std::string_view row, char separator) {
  CsvCells read;
  for (;;) {
    std::string quoted;
    const bool is_quoted = take_quoted(row, quoted, read.fault);
    if (!read.fault.empty()) return read;
    const auto end = row.find(separator);
    const std::string_view plain = trimmed(row.substr(0, end), blanks);
    if (is_quoted && !plain.empty())
      read.fault =
          "after the closing quotation mark of \"" + quoted + "\" more of the cell follows";
    read.cells.push_back(is_quoted ? std::move(quoted) : std::string(plain));
    if (end == std::string_view::npos || !read.fault.empty()) return read;
    row.remove_prefix(end + 1);
  }
}

std::optional<double> number_from(std::string_view text) {
  const bool has_plus = text.starts_with('+');
  if (has_plus) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_whole = error == std::errc{} && end == text.data() + text.size();
  if (!is_whole || !std::isfinite(number) || (has_plus && text.front() == '-')) return {};
  return number;
}

std::optional<std::uint32_t> tool_number(std::optional<double> number) {
  if (!number || *number < 0 || *number > 2147483647 || *number != std::floor(*number)) return {};
  return static_cast<std::uint32_t>(*number);
}

LineOfWords::LineOfWords(std::string_view line) {
  for (std::size_t at = 0; at < line.size();) {
    const char sign = upper(line[at]);
    if (sign == ';') break;
    if (sign == '(') {
      at = std::min(line.find(')', at), line.size() - 1) + 1;
      continue;
    }
    const bool is_word = is_letter(sign);
    const std::size_t begin = is_word ? at + 1 : at;
    const std::size_t end = end_of_value(line, begin);
    const std::string_view value = line.substr(begin, end - begin);
    is_skippable_ |= sign == '/';
    if (is_word)
      take(sign, value);
    else if (!value.empty())
      note('"' + std::string(value) + "\" has no letter before it");
    at = std::max(end, at + 1);
  }
}

void LineOfWords::take(char letter, std::string_view value) {
  letters_ += letter;
  const std::string name(1, letter);
  if (value.empty()) return note(name + " has no number directly after it");
  const auto number = number_from(value);
  if (!number) return note(name + " is \"" + std::string(value) + "\", which is no number");
  words_.push_back({.letter = letter, .text = value, .number = *number});
}

void LineOfWords::note(std::string fault) {
  if (fault_.empty()) fault_ = std::move(fault);
}

const LineOfWords::Word* LineOfWords::find(char letter) const {
  const auto word = std::ranges::find(words_, letter, &Word::letter);
  return word == words_.end() ? nullptr : &*word;
}

bool LineOfWords::has_function(double number) const {
  return std::ranges::any_of(
      words_, [&](const Word& word) { return word.letter == 'G' && word.number == number; });
}

std::string LineOfWords::fault_but_for(std::string_view repeatable) const {
  if (is_skippable_)
    return "whether a line with the block skip / counts is not known: remove the / or the line";
  if (!fault_.empty()) return fault_;
  for (const char letter : letters_)
    if (repeatable.find(letter) == repeatable.npos && std::ranges::count(letters_, letter) > 1)
      return std::string(1, letter) + " a second time";
  return {};
}

}  // namespace trc::cli
