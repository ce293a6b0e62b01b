#include "core/nc/text/gcode_words.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/nc/text/characters.h"

namespace trc {
namespace {

bool begins_number(char sign) {
  return is_digit(sign) || sign == '+' || sign == '-' || sign == '.';
}

// The parenthesis that closes the comment: the match of the first one, or, if the inner ones are
// not in pairs, the first closing one.
std::size_t end_of_comment(std::string_view line, std::size_t begin) {
  std::size_t depth = 0;
  for (std::size_t at = begin; at < line.size(); ++at) {
    if (line[at] == '(') ++depth;
    if (line[at] == ')' && --depth == 0) return at;
  }
  return line.find(')', begin);
}

// (RPT N10,N20), (GOTO N10), (CALL 5), (IF (P1 …: jumps and calls of Fagor.
bool is_statement(std::string_view comment) {
  std::string text;
  for (const char sign : comment.substr(1, 12))
    if (sign != ' ') text += upper(sign);
  const auto begins = [&](std::string_view word, std::string_view behind) {
    return text.starts_with(word) && text.size() > word.size() &&
           (behind.find(text[word.size()]) != std::string_view::npos);
  };
  constexpr std::string_view digits = "0123456789";
  const std::size_t assigned = text.find('=');
  return begins("RPTN", digits) || begins("GOTON", digits) || begins("CALL", digits) ||
         begins("PCALL", digits) || begins("MCALL", digits) || begins("IF(", "P(") ||
         (begins("P", digits) && assigned != std::string::npos && assigned + 1 < text.size() &&
          (digits.find(text[assigned + 1]) != std::string_view::npos || text[assigned + 1] == 'P'));
}

}  // namespace

void GcodeReader::skip_blanks() {
  while (const std::size_t blank = blank_at_start(line_.substr(at_))) at_ += blank;
}

GcodeWord GcodeReader::fail(Code code, std::size_t begin, std::size_t end, std::string detail) {
  fault_ = {.code = code, .begin = static_cast<std::uint32_t>(begin), .detail = std::move(detail)};
  at_ = end;
  return {.kind = GcodeWord::Kind::fault,
          .begin = static_cast<std::uint32_t>(begin),
          .end = static_cast<std::uint32_t>(end)};
}

GcodeWord GcodeReader::next() {
  skip_blanks();
  const std::size_t begin = at_;
  if (begin >= line_.size()) return {};
  const char sign = peek();
  if (sign == '(' || sign == ';') return comment();
  if (is_letter(sign)) return address(begin);
  const bool all_spindles = sign == '$' && peek(1) == '-' && is_digit(peek(2));
  if (((sign == ':' || sign == '$') && is_digit(peek(1))) || all_spindles) return address(begin);
  if (sign == '<' && line_.find('>', begin) != std::string_view::npos) {  // the name of the program
    at_ = line_.find('>', begin) + 1;
    return {.kind = GcodeWord::Kind::comment,
            .begin = static_cast<std::uint32_t>(begin),
            .end = static_cast<std::uint32_t>(at_)};
  }
  if (sign == ',') {  // controls skip blanks, also between the two signs of ,R
    ++at_;
    skip_blanks();
    if (is_letter(peek())) return address(begin);
  }
  if ((sign == '@' || sign == '^') && begins_number(peek(1))) return polar(begin);
  if (is_digit(sign)) {
    const std::size_t end = std::min(line_.find_first_not_of("0123456789.", begin), line_.size());
    return fail(Code::nc_syntax, begin, end,
                std::string(line_.substr(begin, end - begin))
                    .append(", a number without a letter: that of a program begins with O"));
  }
  if (sign == '/') {
    ++at_;
    while (is_digit(peek())) ++at_;
    return {.kind = GcodeWord::Kind::skip,
            .begin = static_cast<std::uint32_t>(begin),
            .end = static_cast<std::uint32_t>(at_)};
  }
  if (sign == '#' || sign == '[')
    return fail(Code::nc_unsupported, begin, line_.size(),
                sign == '#' ? "#, a variable" : "[, an expression");
  const auto byte = static_cast<unsigned char>(sign);
  if (byte < 0x20 || byte >= 0x7f)
    return fail(Code::nc_not_text, begin, line_.size(),
                name_of_character(line_.substr(begin)) + ", outside a comment");
  // After these the rest of the line is no words: a name of Okuma, a comment of another control.
  const bool takes_line = sign == '$' || sign == '\'' || sign == '"';
  return fail(Code::nc_syntax, begin, takes_line ? line_.size() : begin + 1, std::string(1, sign));
}

GcodeWord GcodeReader::comment() {
  const std::size_t begin = at_;
  const std::size_t close = peek() == ';' ? line_.size() : end_of_comment(line_, begin);
  if (close == std::string_view::npos)
    return fail(Code::nc_unclosed, begin, line_.size(), "(, a comment without )");
  if (peek() == '(' && is_statement(line_.substr(begin, close - begin)))
    return fail(Code::nc_unsupported, begin, close + 1, "a statement in parentheses");
  at_ = std::min(close + 1, line_.size());
  return {.kind = GcodeWord::Kind::comment,
          .begin = static_cast<std::uint32_t>(begin),
          .end = static_cast<std::uint32_t>(at_)};
}

// IF, WHILE, GOTO, sub, …: adjacent letters are no words.
GcodeWord GcodeReader::name(std::size_t begin) {
  std::size_t end = begin;
  std::string detail;
  while (end < line_.size() && is_letter(line_[end])) detail += upper(line_[end++]);
  return fail(Code::nc_unsupported, begin, line_.size(), detail + ", a statement");
}

// @12 ^30 of LinuxCNC.
GcodeWord GcodeReader::polar(std::size_t begin) {
  constexpr std::string_view signs = "@^+-.0123456789 \t";
  at_ = std::min(line_.find_first_not_of(signs, begin), line_.size());
  return {.kind = GcodeWord::Kind::address,
          .letter = '@',
          .has_number = true,
          .begin = static_cast<std::uint32_t>(begin),
          .end = static_cast<std::uint32_t>(
              begin + without_blanks_behind(line_.substr(begin, at_ - begin)).size())};
}

// O<PART1>: a program may have a name instead of a number. With more text after it, it is an O word
// of LinuxCNC.
GcodeWord GcodeReader::name_of_program(GcodeWord word) {
  const std::size_t close = line_.find('>', at_);
  const std::size_t behind =
      close == std::string_view::npos ? close : line_.find_first_not_of(" \t", close + 1);
  const bool is_name =
      word.letter == 'O' && close != std::string_view::npos &&
      (behind == std::string_view::npos || line_[behind] == '(' || line_[behind] == ';');
  if (!is_name)
    return fail(Code::nc_unsupported, word.begin, line_.size(), "O<…>, a subprogram or a loop");
  at_ = close + 1;
  word.end = static_cast<std::uint32_t>(at_);
  return word;
}

// `X - 10.`: the length of the sign and the blanks before the digits; 0: the number has no blanks.
std::size_t GcodeReader::blanks_behind_sign() const {
  if (peek() != '+' && peek() != '-') return 0;
  const std::size_t digits = line_.find_first_not_of(" \t", at_ + 1);
  const bool apart = digits != std::string_view::npos && digits > at_ + 1 &&
                     (is_digit(line_[digits]) || line_[digits] == '.');
  return apart ? digits - at_ : 0;
}

// The number of bytes of the number from `at_` on; 0: none.
std::size_t GcodeReader::read_value(GcodeWord& word) const {
  if (blanks_ == Blanks::between_words) {
    const std::size_t blanks = blanks_behind_sign();
    const std::size_t length = read_number(line_.substr(at_ + blanks), word.value, word.whole);
    if (blanks > 0 && peek() == '-') word.value = -word.value;
    return length > 0 ? blanks + length : 0;
  }
  std::string number;
  std::string_view text = line_.substr(at_);
  text = without_blanks_behind(
      text.substr(0, std::min(text.find_first_not_of("+-.0123456789 \t"), text.size())));
  for (const char sign : text)
    if (sign != ' ' && sign != '\t') number += sign;
  std::size_t left = read_number(number, word.value, word.whole);
  std::size_t length = 0;
  for (; left > 0; ++length)
    if (text[length] != ' ' && text[length] != '\t') --left;
  return length;
}

// `begin`: of the word; `at_` is at its letter.
GcodeWord GcodeReader::address(std::size_t begin) {
  const bool comma = begin != at_;
  GcodeWord word{.kind = GcodeWord::Kind::address,
                 .letter = upper(peek()),
                 .comma = comma,
                 .begin = static_cast<std::uint32_t>(begin)};
  if (word.letter == ':') word.letter = 'O';
  ++at_;
  if (is_letter(peek()) && word.letter != 'N') return name(begin);
  skip_blanks();
  const char sign = peek();
  if (sign == '#') return fail(Code::nc_unsupported, begin, line_.size(), "#, a variable");
  if (sign == '[') return fail(Code::nc_unsupported, begin, line_.size(), "[, an expression");
  if (sign == '<') return name_of_program(word);
  // N12 without blanks is a number; a bare N is no number at all.
  const std::size_t length = begins_number(sign) ? read_value(word) : 0;
  at_ += length;
  word.has_number = length > 0;
  word.end = static_cast<std::uint32_t>(at_);
  const bool needs_number = word.letter != 'N' && word.letter != 'O';
  if ((needs_number && !word.has_number) || !std::isfinite(word.value))
    return fail(Code::nc_number, begin, std::max(at_, begin + 1), std::string(1, word.letter));
  if (!word.has_number) {
    at_ = begin + 1;
    word.end = static_cast<std::uint32_t>(at_);
  }
  return word;
}

}  // namespace trc
