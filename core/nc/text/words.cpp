#include "core/nc/text/words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/base/utf8.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/decimal.h"
#include "core/nc/text/expression.h"

namespace trc {
namespace {

enum class Class : std::uint8_t {
  other,
  blank,
  letter,
  digit,
  number_sign,  // + - .
  command,      // #
  parenthesis,  // (
  semicolon,
  closing,       // )
  continuation,  // backslash
  control,
  high,  // not ASCII
};

constexpr std::array<Class, 256> make_classes() {
  std::array<Class, 256> classes{};
  for (std::size_t byte = 0; byte < classes.size(); ++byte) {
    if (byte < 0x20 || byte == 0x7f) classes[byte] = Class::control;
    if (byte >= 0x80) classes[byte] = Class::high;
    if (byte >= '0' && byte <= '9') classes[byte] = Class::digit;
    if ((byte >= 'A' && byte <= 'Z') || (byte >= 'a' && byte <= 'z')) classes[byte] = Class::letter;
  }
  for (const char sign : {'+', '-', '.'})
    classes[static_cast<unsigned char>(sign)] = Class::number_sign;
  classes[' '] = classes['\t'] = Class::blank;
  classes['#'] = Class::command;
  classes['('] = Class::parenthesis;
  classes[')'] = Class::closing;
  classes[';'] = Class::semicolon;
  classes['\\'] = Class::continuation;
  return classes;
}

constexpr std::array<Class, 256> classes = make_classes();

Class class_of(char byte) { return classes[static_cast<unsigned char>(byte)]; }

struct CommentEnd {
  std::size_t at = 0;  // after the closing parenthesis, or at the line end
  bool closed = false;
};

// The end of the comment that starts at `begin` with a parenthesis.
CommentEnd end_of_comment(std::string_view text, std::size_t begin) {
  std::size_t depth = 0;
  std::size_t at = begin;
  for (; at < text.size() && !is_line_end(text[at]); ++at) {
    if (text[at] == '(') ++depth;
    if (text[at] == ')' && --depth == 0) return {.at = at + 1, .closed = true};
  }
  return {.at = at};
}

std::size_t end_of_line(std::string_view text, std::size_t begin) {
  const std::size_t end = text.find_first_of("\r\n", begin);
  return end == std::string_view::npos ? text.size() : end;
}

enum class ControlCharacters : std::uint8_t { pass, are_bad };

std::size_t first_bad_byte(std::string_view text, ControlCharacters control) {
  for (std::size_t at = 0; at < text.size();) {
    const Class kind = class_of(text[at]);
    if (kind == Class::high) {
      const std::size_t length = utf8_character(text.substr(at));
      if (length == 0) return at;
      at += length;
      continue;
    }
    if (kind == Class::control && control == ControlCharacters::are_bad && !is_line_end(text[at]))
      return at;
    ++at;
  }
  return std::string_view::npos;
}

}  // namespace

std::size_t behind_spindle_words(std::string_view text) {
  if (text.empty() || upper(text.front()) != 'S') return 0;
  const std::size_t open = text.find_first_not_of("0123456789 \t", 1);
  if (open == std::string_view::npos || text[open] != '[') return 0;
  const std::size_t close = text.find(']', open);
  if (close == std::string_view::npos) return 0;
  const std::string words = in_upper_case(text.substr(open, close - open));
  const auto is_function = [&](std::size_t at) {
    return words[at] == 'M' && at + 1 < words.size() && is_digit(words[at + 1]);
  };
  bool commands = words.find("REV") != std::string::npos || words.find("POS") != std::string::npos;
  for (std::size_t at = 0; at < words.size(); ++at) commands |= is_function(at);
  return commands ? close + 1 : 0;
}

std::size_t behind_suppressed_offsets(std::string_view text) {
  if (!text.starts_with('#')) return 0;
  std::size_t at = 1;
  for (const std::string_view name : {"SUPPRESS", "OFFSETS"}) {
    while (const std::size_t blank = blank_at_start(text.substr(at))) at += blank;
    if (in_upper_case(text.substr(at, name.size())) != name) return 0;
    at += name.size();
  }
  if (at < text.size() && (is_letter(text[at]) || text[at] == '_')) return 0;
  const std::string_view kinds = without_blanks_in_front(text.substr(at));
  const std::size_t close = kinds.starts_with('[') ? kinds.find(']') : std::string_view::npos;
  return close == std::string_view::npos ? at : text.size() - kinds.size() + close + 1;
}

bool begins_zero_offset(std::string_view text) {
  constexpr std::string_view beginning = "V.G.NP";
  return in_upper_case(text.substr(0, beginning.size())) == beginning &&
         text.size() > beginning.size() &&
         (text[beginning.size()] == '[' || text[beginning.size()] == '_');
}

std::size_t first_byte_that_is_no_text(std::string_view text) {
  return first_bad_byte(text, ControlCharacters::are_bad);
}

std::size_t first_byte_that_is_no_utf8(std::string_view text) {
  return first_bad_byte(text, ControlCharacters::pass);
}

bool is_continued(std::string_view line) {
  const std::string_view block = without_blanks_behind(line);
  if (!block.ends_with('\\') || without_blanks_in_front(line).starts_with('%')) return false;
  const std::size_t last = block.size() - 1;
  for (std::size_t at = 0; at < last; ++at) {
    if (line[at] == '(') {
      at = end_of_comment(line, at).at - 1;
    } else if (line[at] == ';') {
      return false;
    }
    if (at >= last) return false;
  }
  return true;
}

Word WordReader::fail(Code code, const char* at, std::string_view detail) {
  fault_ = {.code = code, .begin = place_of(at), .detail = std::string(detail)};
  return {.kind = WordKind::fault, .begin = fault_.begin, .end = fault_.begin};
}

Word WordReader::no_text(const char* begin, std::size_t bad) {
  const char* at = begin + bad;
  return fail(Code::nc_not_text, at, name_of_character({at, static_cast<std::size_t>(end_ - at)}));
}

inline void WordReader::pass_blanks() {
  while (const std::size_t length = blank_at_start({at_, static_cast<std::size_t>(end_ - at_)}))
    at_ += length;
}

inline bool WordReader::skip_blanks() {
  for (;;) {
    pass_blanks();
    if (at_ == end_ || *at_ != '\\') return true;
    if (!skip_line_end()) return false;
  }
}

// Skips a `\` with the line end of a continued line. False at any other `\`.
bool WordReader::skip_line_end() {
  const char* behind = at_ + 1;
  while (const std::size_t length =
             blank_at_start({behind, static_cast<std::size_t>(end_ - behind)}))
    behind += length;
  if (behind == end_ || !is_line_end(*behind)) return false;
  if (*behind == '\r' && behind + 1 != end_ && behind[1] == '\n') ++behind;
  at_ = behind + 1;
  return true;
}

Word WordReader::next() {
  if (!skip_blanks()) return fail(Code::nc_syntax, at_, "\\ inside a line");
  if (at_ == end_) return {.begin = place_of(at_), .end = place_of(at_)};
  switch (class_of(*at_)) {
    case Class::letter:
      return address();
    case Class::digit:
    case Class::number_sign:
      return number_alone();
    case Class::parenthesis:
    case Class::semicolon:
      return comment();
    case Class::command:
      return command();
    default:
      return other_sign();
  }
}

Word WordReader::other_sign() {
  const std::string_view rest(at_, static_cast<std::size_t>(end_ - at_));
  if (class_of(*at_) == Class::control || utf8_character(rest) == 0) return no_text(at_, 0);
  if (*at_ == '$') return fail(Code::nc_unsupported, at_, "$, a control statement");
  if (*at_ == '/') {
    const std::uint32_t begin = place_of(at_);
    while (++at_ != end_ && is_digit(*at_)) continue;
    return {.kind = WordKind::skip, .begin = begin, .end = place_of(at_)};
  }
  return fail(Code::nc_syntax, at_, name_of_character(rest));
}

Word WordReader::number_alone() {
  Word word{.kind = WordKind::number, .begin = place_of(at_)};
  const char* const begin = at_;
  if (!number(word.value, word.whole)) return fail(Code::nc_number, begin, {begin, 1});
  word.end = place_of(at_);
  return word;
}

Word WordReader::comment() {
  const char* const begin = at_;
  const std::size_t place = place_of(begin);
  const bool in_parentheses = *begin == '(';
  const CommentEnd comment_end = in_parentheses
                                     ? end_of_comment(line_, place)
                                     : CommentEnd{.at = end_of_line(line_, place), .closed = true};
  at_ = line_.data() + comment_end.at;
  // The text after a forgotten parenthesis would be lost silently.
  if (!comment_end.closed) return fail(Code::nc_unclosed, begin, "(, a comment without )");
  // One extra closing parenthesis is common and harmless.
  while (in_parentheses && peek() == ')') ++at_;
  const std::size_t bad =
      first_byte_that_is_no_text({begin, static_cast<std::size_t>(at_ - begin)});
  if (comment_bytes_ == CommentBytes::utf8 && bad != std::string_view::npos)
    return no_text(begin, bad);
  return {.kind = WordKind::comment, .begin = place_of(begin), .end = place_of(at_)};
}

Word WordReader::command() {
  const char* const begin = at_;
  std::size_t depth = 0;
  bool quoted = false;
  for (++at_; at_ != end_; ++at_) {
    if (*at_ == '"') quoted = !quoted;
    if (quoted) continue;
    if (*at_ == '[') ++depth;
    if (*at_ == ']' && depth > 0) --depth;
    if (depth == 0 && (*at_ == '(' || *at_ == ';')) break;
  }
  if (const std::size_t length = behind_suppressed_offsets(line_.substr(place_of(begin))))
    at_ = begin + length;
  const std::string_view text(begin, static_cast<std::size_t>(at_ - begin));
  const std::size_t bad = first_byte_that_is_no_text(text);
  if (bad != std::string_view::npos) return no_text(begin, bad);
  std::string_view words = without_blanks_behind(text);
  while (is_line_end(words.back()))
    words = without_blanks_behind(words.substr(0, words.size() - 1));
  return {.kind = WordKind::command,
          .begin = place_of(begin),
          .end = static_cast<std::uint32_t>(place_of(begin) + words.size())};
}

inline bool WordReader::number(double& value, bool& whole) {
  return take_number(line_, at_, value, whole) &&
         std::abs(value) <= std::numeric_limits<double>::max();
}

// L NAME, LL NAME, LM06
Word WordReader::subprogram_call(const char* begin) {
  const auto of_name = [](char sign) {
    return is_letter(sign) || is_digit(sign) || sign == '_' || sign == '.';
  };
  const char* end = std::find_if_not(begin, end_, of_name);
  const bool is_bare = std::all_of(begin, end, [](char sign) { return upper(sign) == 'L'; });
  if (is_bare && end != end_ && *end == ' ') {
    // L X+10 is a motion of Klartext.
    const char* const name = std::find_if(end, end_, [](char sign) { return sign != ' '; });
    const char* const behind = std::find_if_not(name, end_, of_name);
    if (behind - name > 1)
      return fail(Code::nc_unsupported, begin,
                  std::string(begin, behind) + ", a subprogram that is not given");
  }
  return fail(Code::nc_unsupported, begin, std::string(begin, end) + ", a subprogram call");
}

// Blanks and one `=` may come before the number.
Word WordReader::address() {
  const char* const begin = at_++;
  Word word{.kind = WordKind::address, .letter = upper(*begin), .begin = place_of(begin)};
  if (word.letter == 'L') return subprogram_call(begin);
  if (word.letter == 'P') {
    const char* const behind = std::find_if_not(begin, end_, is_letter);
    return fail(Code::nc_unsupported, begin,
                behind - begin > 1 ? std::string(begin, behind) : "P, a parameter");
  }
  const std::string_view rest = line_.substr(word.begin);
  if (const std::size_t length = word.letter == 'S' ? behind_spindle_words(rest) : 0; length > 0) {
    at_ = begin + length;
    word.end = place_of(at_);
    word.has_argument = true;
    return word;
  }
  if (word.letter == 'V' && peek() == '.' && at_ + 1 != end_ && class_of(at_[1]) == Class::letter)
    return variable();
  bool assigned = false;
  if (!is_digit(peek())) {
    assigned = skip_blanks() && peek() == '=';
    if (assigned) ++at_;
    if (!skip_blanks()) return no_number(word);
  }
  const char* const value = at_;
  if (!number(word.value, word.whole)) return no_number(word);
  word.end = place_of(at_);
  if (assigned && goes_on_as_expression()) return expression(value, word);

  // G159=3, S2=500; or an axis with a name of its own: X1=10.
  pass_blanks();
  if (peek() != '=') return word;
  ++at_;
  if (!skip_blanks() || !number(word.argument, word.whole))
    return fail(Code::nc_number, at_, {&word.letter, 1});
  word.has_argument = true;
  word.end = place_of(at_);
  return word;
}

// After the first number of X=100/2 and X=4 + 5.
bool WordReader::goes_on_as_expression() {
  const char* const behind = at_;
  pass_blanks();
  const char sign = peek();
  at_ = behind;
  return sign == '+' || sign == '-' || sign == '*' || sign == '/';
}

Word WordReader::expression(const char* begin, Word word) {
  std::size_t length = 0;
  if (auto fault = read_expression(line_.substr(place_of(begin)), word.value, length)) {
    fault->begin += place_of(begin);
    fault_ = *std::move(fault);
    return {.kind = WordKind::fault, .begin = fault_.begin, .end = fault_.begin};
  }
  at_ = begin + length;
  word.whole = false;
  word.end = place_of(at_);
  return word;
}

Word WordReader::no_number(const Word& word) {
  const char* const begin = line_.data() + word.begin;
  const char sign = upper(peek());
  const bool name = at_ == begin + 1 && class_of(sign) == Class::letter;
  const bool variable = sign == 'V' && at_ + 1 != end_ && at_[1] == '.';
  if (sign == '[' || sign == 'P' || variable || name) {
    // A word of another language is reported whole: TRANS, not TR.
    const char* end = at_ + 1;
    while (name && end != end_ && (class_of(*end) == Class::letter || *end == '_')) ++end;
    return fail(Code::nc_unsupported, begin,
                std::string(begin, end).append(", an expression or a name"));
  }
  std::string detail(1, word.letter);
  if (class_of(sign) == Class::high)
    detail.append(" before ")
        .append(name_of_character({at_, static_cast<std::size_t>(end_ - at_)}));
  return fail(Code::nc_number, begin, detail);
}

std::string WordReader::variable_name() {
  std::string name;
  for (; at_ != end_; ++at_) {
    if (class_of(*at_) != Class::letter && !is_digit(*at_) && *at_ != '.' && *at_ != '_') break;
    name += upper(*at_);
  }
  return name;
}

// "V.G.WZ_AKT.R + 0.2" after the sign of "V.G.WZ_AKT.R =": the tool wear.
bool WordReader::sum(const std::string& variable, Word& word) {
  if (variable_name() != variable || !skip_blanks()) return false;
  const char sign = peek();
  if (sign != '+' && sign != '-') return false;
  ++at_;
  if (!skip_blanks() || (!is_digit(peek()) && peek() != '.') || !number(word.value, word.whole))
    return false;
  if (sign == '-') word.value = -word.value;
  word.relative = true;
  word.end = place_of(at_);
  pass_blanks();
  const char next = peek();
  return next != '+' && next != '-' && next != '*' && next != '/';
}

Word WordReader::variable() {
  const char* const begin = at_ - 1;
  at_ = begin;
  std::string name = variable_name();
  if (name != "V.G.WZ_AKT.R" && name != "V.G.WZR")
    return fail(Code::nc_unsupported, begin,
                name == "V.G.WZ" && peek() == '['
                    ? "V.G.WZ[ ] beside other words: write it into a line of its own"
                : begins_zero_offset(line_.substr(place_of(begin)))
                    ? "V.G.NP, a zero offset, in a contour or beside other words"
                    : name.append(", a variable"));
  Word word{.kind = WordKind::variable, .begin = place_of(begin)};
  if (!skip_blanks() || peek() != '=')
    return fail(Code::nc_syntax, begin, name.append(" without ="));
  ++at_;
  const bool readable = skip_blanks();
  const bool names = readable && upper(peek()) == 'V';
  if (names && sum(name, word)) return word;
  if (names || (readable && (peek() == '[' || class_of(peek()) == Class::letter)))
    return fail(Code::nc_unsupported, begin, name.append(" with an expression"));
  if (!readable || !number(word.value, word.whole)) return fail(Code::nc_number, begin, name);
  word.end = place_of(at_);
  return word;
}

}  // namespace trc
