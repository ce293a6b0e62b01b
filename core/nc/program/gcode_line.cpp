#include "core/nc/program/gcode_line.h"

#include <array>
#include <charconv>
#include <cmath>

#include "core/nc/text/characters.h"
#include "core/nc/text/gcode_words.h"
#include "core/nc/text/number_format.h"

namespace trc::program {

LineHead head_of(std::string_view line) {
  LineHead head;
  std::size_t at = behind_blanks(line, 0);
  if (at < line.size() && line[at] == '/') {
    head.to_skip = true;
    ++at;
    if (at + 1 < line.size() && is_digit(line[at]) && !is_digit(line[at + 1])) ++at;
    at = behind_blanks(line, at);
  }
  if (at < line.size() && upper(line[at]) == 'N') {
    const std::size_t begin = at;
    at = behind_blanks(line, at + 1);
    const std::size_t digits = at;
    while (at < line.size() && is_digit(line[at])) ++at;
    constexpr std::size_t most_digits = 15;
    if (at > digits && at - digits <= most_digits) {
      head.number = 0;
      for (std::size_t digit = digits; digit < at; ++digit)
        head.number = head.number * 10 + (line[digit] - '0');
      head.number_begin = begin;
      head.number_end = at;
    } else {
      at = begin;
    }
  }
  head.behind = behind_blanks(line, at);
  return head;
}

std::size_t behind_comment(std::string_view line, std::size_t at) {
  GcodeReader reader(line.substr(at));
  const GcodeWord word = reader.next();
  return word.kind == GcodeWord::Kind::comment ? at + word.end : 0;
}

bool is_over(std::string_view line, std::size_t at) {
  for (at = behind_blanks(line, at); at < line.size(); at = behind_blanks(line, at)) {
    if (line[at] != '(' && line[at] != ';') return false;
    at = behind_comment(line, at);
    if (at == 0) return false;
  }
  return true;
}

std::string comments_of(std::string_view line, std::size_t at) {
  std::string comments;
  for (at = behind_blanks(line, at); at < line.size(); at = behind_blanks(line, at)) {
    const std::size_t behind = behind_comment(line, at);
    if (behind == 0) break;
    if (!comments.empty()) comments += ' ';
    comments.append(line.substr(at, behind - at));
    at = behind;
  }
  return comments;
}

bool has_word_at(std::string_view line, std::size_t at, std::string_view word) {
  if (line.size() < at + word.size()) return false;
  for (std::size_t sign = 0; sign < word.size(); ++sign)
    if (upper(line[at + sign]) != word[sign]) return false;
  return true;
}

std::size_t length_of_word_at(std::string_view line, std::size_t at, std::string_view word) {
  constexpr std::size_t shortest = 2;
  std::size_t length = word.size();
  while (length >= shortest && !has_word_at(line, at, word.substr(0, length))) --length;
  const bool goes_on = at + length < line.size() && is_letter(line[at + length]);
  return length < shortest || (goes_on && length < word.size()) ? 0 : length;
}

bool has_function(std::string_view line, char letter, int first, int second) {
  for (std::size_t at = 0; at < line.size() && line[at] != ';';) {
    if (line[at] == '(') {
      at = behind_comment(line, at);
      if (at == 0) return false;
      continue;
    }
    const bool is_letter_of_it = upper(line[at]) == letter;
    at = behind_blanks(line, at + 1);
    if (!is_letter_of_it || at >= line.size() || !is_digit(line[at])) continue;
    double number = 0;
    bool whole = false;
    if (read_number(line.substr(at), number, whole) == 0) continue;
    if (std::floor(number) == first || std::floor(number) == second) return true;
  }
  return false;
}

void append_value(std::string& out, double value, PointStyle style, int decimals) {
  const std::size_t begin = out.size();
  append_units(out, to_units(value, decimals), decimals);
  if (style == PointStyle::with_point && out.find('.', begin) == std::string::npos) out += '.';
}

void append_exactly(std::string& out, double value, int decimals) {
  std::array<char, 400> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::fixed, decimals);
  out.append(digits.data(), end.ptr);
}

}  // namespace trc::program
