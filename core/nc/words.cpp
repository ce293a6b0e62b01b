#include "core/nc/words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <utility>

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
bool is_digit(char byte) { return byte >= '0' && byte <= '9'; }
bool is_blank(char byte) { return byte == ' ' || byte == '\t'; }
bool is_line_end(char byte) { return byte == '\n' || byte == '\r'; }
char upper(char letter) {
  return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
}

// Where the comment that starts at `begin` with a parenthesis ends: behind its
// closing one, or at the line end.
std::size_t end_of_comment(std::string_view text, std::size_t begin) {
  std::size_t depth = 0;
  std::size_t at = begin;
  for (; at < text.size() && !is_line_end(text[at]); ++at) {
    if (text[at] == '(') ++depth;
    if (text[at] == ')' && --depth == 0) return at + 1;
  }
  return at;
}

std::size_t end_of_line(std::string_view text, std::size_t begin) {
  const std::size_t end = text.find_first_of("\r\n", begin);
  return end == std::string_view::npos ? text.size() : end;
}

// Powers of ten that a double holds exactly.
constexpr std::array<double, 23> powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                               1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                               1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// Whole numbers up to here are exact too, so that one division rounds correctly.
constexpr std::uint64_t largest_exact = std::uint64_t{1} << 53;
constexpr std::size_t digits_that_fit = 19;  // in 64 bits

// How many bytes the UTF-8 character at the start of `text` takes; 0: it is none.
std::size_t utf8_character(std::string_view text) {
  const auto byte = [&](std::size_t at) {
    return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U;
  };
  const auto follows = [&](std::size_t at) { return (byte(at) & 0xc0U) == 0x80U; };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  if (lead >= 0xc2 && lead <= 0xdf) return follows(1) ? 2 : 0;
  if (lead >= 0xe0 && lead <= 0xef) {
    const bool overlong = lead == 0xe0 && byte(1) < 0xa0;
    const bool surrogate = lead == 0xed && byte(1) > 0x9f;
    return follows(1) && follows(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (lead >= 0xf0 && lead <= 0xf4) {
    const bool overlong = lead == 0xf0 && byte(1) < 0x90;
    const bool too_large = lead == 0xf4 && byte(1) > 0x8f;
    return follows(1) && follows(2) && follows(3) && !overlong && !too_large ? 4 : 0;
  }
  return 0;
}

std::size_t first_bad_byte(std::string_view text, bool control_characters_pass) {
  for (std::size_t at = 0; at < text.size();) {
    const Class kind = class_of(text[at]);
    if (kind == Class::high) {
      const std::size_t length = utf8_character(text.substr(at));
      if (length == 0) return at;
      at += length;
      continue;
    }
    if (kind == Class::control && !control_characters_pass && !is_line_end(text[at])) return at;
    ++at;
  }
  return std::string_view::npos;
}

}  // namespace

std::size_t read_number(std::string_view text, double& value, bool& whole) {
  const char* const begin = text.data();
  const char* const end = begin + text.size();
  const char* at = begin;
  const bool negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  const char* const first = at;

  std::uint64_t digits = 0;  // wraps beyond `digits_that_fit`, and is not used then
  const auto read_digits = [&] {
    const char* const start = at;
    for (; at != end && is_digit(*at); ++at)
      digits = digits * 10 + static_cast<std::uint64_t>(*at - '0');
    return static_cast<std::size_t>(at - start);
  };
  const std::size_t before_point = read_digits();
  std::size_t decimals = 0;
  whole = at == end || *at != '.';
  if (!whole) {
    ++at;
    decimals = read_digits();
  }
  if (before_point + decimals == 0) return 0;
  if (before_point + decimals <= digits_that_fit && digits <= largest_exact &&
      decimals < powers_of_ten.size()) {
    value = static_cast<double>(digits) / powers_of_ten[decimals];
  } else if (std::from_chars(first, at, value, std::chars_format::fixed).ec ==
             std::errc::result_out_of_range) {
    const bool large = std::any_of(first, first + before_point, [](char d) { return d != '0'; });
    value = large ? std::numeric_limits<double>::infinity() : 0;
  }
  if (negative) value = -value;
  return static_cast<std::size_t>(at - begin);
}

std::size_t first_byte_that_is_no_text(std::string_view text) {
  return first_bad_byte(text, false);
}

std::size_t first_byte_that_is_no_utf8(std::string_view text) { return first_bad_byte(text, true); }

bool is_continued(std::string_view text) {
  std::size_t size = text.size();
  while (size > 0 && is_blank(text[size - 1])) --size;
  if (size == 0 || text[size - 1] != '\\') return false;
  const std::size_t last = size - 1;
  if (text[text.find_first_not_of(" \t")] == '%') return false;
  for (std::size_t at = 0; at < last; ++at) {
    if (text[at] == '(') {
      at = end_of_comment(text, at) - 1;
    } else if (text[at] == ';') {
      at = end_of_line(text, at);
    }
    if (at >= last) return false;
  }
  return true;
}

Word WordReader::fail(Code code, std::size_t begin, std::string detail) {
  fault_ = {.code = code, .begin = static_cast<std::uint32_t>(begin), .detail = std::move(detail)};
  return {.kind = WordKind::fault, .begin = fault_.begin, .end = fault_.begin};
}

// Blanks, and the `\` with the line end of a continued line. False at another `\`.
bool WordReader::skip_blanks() {
  while (at_ < line_.size() && is_blank(line_[at_])) ++at_;
  for (; at_ < line_.size(); ++at_) {
    const Class kind = class_of(line_[at_]);
    if (kind == Class::blank) continue;
    if (kind != Class::continuation) return true;
    const std::size_t behind = line_.find_first_not_of(" \t", at_ + 1);
    if (behind != std::string_view::npos && !is_line_end(line_[behind])) return false;
    if (behind == std::string_view::npos) return false;
    at_ = behind + (line_.substr(behind, 2) == "\r\n" ? 1 : 0);
  }
  return true;
}

Word WordReader::next() {
  if (!skip_blanks()) return fail(Code::nc_syntax, at_, "\\ inside a line");
  const std::size_t begin = at_;
  Word word{.begin = static_cast<std::uint32_t>(begin), .end = static_cast<std::uint32_t>(begin)};
  if (begin == line_.size()) return word;
  const char first = line_[begin];
  switch (class_of(first)) {
    case Class::letter:
      return address(upper(first));
    case Class::parenthesis:
    case Class::semicolon:
      return comment();
    case Class::command:
      return command();
    case Class::digit:
    case Class::number_sign:
      word.kind = WordKind::number;
      if (!signed_number(word.value, word.whole)) return fail(Code::nc_number, begin, {first});
      word.end = static_cast<std::uint32_t>(at_);
      return word;
    case Class::control:
      return fail(Code::nc_not_text, begin, "control character");
    case Class::high:
      if (utf8_character(line_.substr(begin)) == 0)
        return fail(Code::nc_not_text, begin, "no UTF-8");
      return fail(Code::nc_syntax, begin,
                  std::string(line_.substr(begin, utf8_character(line_.substr(begin)))));
    default:
      break;
  }
  if (first == '$' || first == '/')
    return fail(Code::nc_unsupported, begin,
                first == '$' ? "$, a control statement" : "/, a block to skip on demand");
  return fail(Code::nc_syntax, begin, {first});
}

Word WordReader::comment() {
  const std::size_t begin = at_;
  at_ = line_[begin] == '(' ? end_of_comment(line_, begin) : end_of_line(line_, begin);
  // One closing parenthesis too many is common and harms nobody.
  while (line_[begin] == '(' && at_ < line_.size() && line_[at_] == ')') ++at_;
  const std::string_view text = line_.substr(begin, at_ - begin);
  if (const std::size_t bad = first_byte_that_is_no_text(text); bad != std::string_view::npos)
    return fail(Code::nc_not_text, begin + bad,
                class_of(text[bad]) == Class::high ? "no UTF-8" : "control character");
  return {.kind = WordKind::comment,
          .begin = static_cast<std::uint32_t>(begin),
          .end = static_cast<std::uint32_t>(at_)};
}

Word WordReader::command() {
  const std::size_t begin = at_;
  std::size_t depth = 0;
  bool quoted = false;
  for (++at_; at_ < line_.size(); ++at_) {
    const char byte = line_[at_];
    if (byte == '"') quoted = !quoted;
    if (quoted) continue;
    if (byte == '[') ++depth;
    if (byte == ']' && depth > 0) --depth;
    if (depth == 0 && (byte == '(' || byte == ';')) break;
  }
  const std::string_view text = line_.substr(begin, at_ - begin);
  if (const std::size_t bad = first_byte_that_is_no_text(text); bad != std::string_view::npos)
    return fail(Code::nc_not_text, begin + bad,
                class_of(text[bad]) == Class::high ? "no UTF-8" : "control character");
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  return {.kind = WordKind::command,
          .begin = static_cast<std::uint32_t>(begin),
          .end = static_cast<std::uint32_t>(begin + last + 1)};
}

bool WordReader::signed_number(double& value, bool& whole) {
  const std::size_t length = read_number(line_.substr(at_), value, whole);
  at_ += length;
  return length > 0 && value <= std::numeric_limits<double>::max() &&
         value >= std::numeric_limits<double>::lowest();
}

Word WordReader::address(char letter) {
  const std::size_t begin = at_;
  Word word{
      .kind = WordKind::address, .letter = letter, .begin = static_cast<std::uint32_t>(begin)};
  ++at_;
  if (letter == 'V' && at_ + 1 < line_.size() && line_[at_] == '.' &&
      class_of(line_[at_ + 1]) == Class::letter)
    return variable();
  if (letter == 'L' || letter == 'P')
    return fail(Code::nc_unsupported, begin,
                letter == 'L' ? "L, a subprogram call" : "P, a parameter");
  if (!number(word)) return no_number(word);
  word.end = static_cast<std::uint32_t>(at_);

  // G159=3, S2=500; or an axis with a name of its own: X1=10.
  std::size_t behind = at_;
  while (behind < line_.size() && is_blank(line_[behind])) ++behind;
  if (behind == line_.size() || line_[behind] != '=') return word;
  at_ = behind + 1;
  if (!skip_blanks() || !signed_number(word.argument, word.whole))
    return fail(Code::nc_number, at_, std::string(1, letter));
  word.has_argument = true;
  word.end = static_cast<std::uint32_t>(at_);
  return word;
}

// The number of an address: blanks and one `=` may stand in front of it.
bool WordReader::number(Word& word) {
  if (at_ < line_.size() && is_digit(line_[at_])) return signed_number(word.value, word.whole);
  if (skip_blanks() && at_ < line_.size() && line_[at_] == '=') ++at_;
  return skip_blanks() && signed_number(word.value, word.whole);
}

Word WordReader::no_number(const Word& word) {
  const char byte = at_ < line_.size() ? upper(line_[at_]) : ' ';
  const bool adjacent = at_ == word.begin + 1U;
  const bool function = adjacent && class_of(byte) == Class::letter;
  if (byte == '[' || byte == 'P' || (byte == 'V' && line_.substr(at_ + 1, 1) == ".") || function)
    return fail(
        Code::nc_unsupported, word.begin,
        std::string(line_.substr(word.begin, at_ + 1 - word.begin)) + ", an expression or a name");
  return fail(Code::nc_number, word.begin, std::string(1, word.letter));
}

Word WordReader::variable() {
  const std::size_t begin = at_ - 1;
  std::size_t end = begin;
  std::string name;
  for (; end < line_.size(); ++end) {
    const char byte = line_[end];
    if (class_of(byte) != Class::letter && !is_digit(byte) && byte != '.' && byte != '_') break;
    name += upper(byte);
  }
  if (name != "V.G.WZ_AKT.R" && name != "V.G.WZR")
    return fail(Code::nc_unsupported, begin, "variable " + name);
  Word word{.kind = WordKind::variable, .begin = static_cast<std::uint32_t>(begin)};
  at_ = end;
  if (!skip_blanks() || at_ == line_.size() || line_[at_] != '=')
    return fail(Code::nc_syntax, begin, name + " without =");
  ++at_;
  const bool readable = skip_blanks();
  const char byte = at_ < line_.size() ? line_[at_] : ' ';
  if (readable && (byte == '[' || class_of(byte) == Class::letter))
    return fail(Code::nc_unsupported, begin, name + " with an expression");
  if (!readable || !signed_number(word.value, word.whole))
    return fail(Code::nc_number, begin, name);
  word.end = static_cast<std::uint32_t>(at_);
  return word;
}

}  // namespace trc
