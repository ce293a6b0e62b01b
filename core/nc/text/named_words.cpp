#include "core/nc/text/named_words.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/nc/text/characters.h"

namespace trc {
namespace {

bool begins_number(char sign) {
  return is_digit(sign) || sign == '+' || sign == '-' || sign == '.';
}

// An index that is no small number.
constexpr int some_spindle = 1000;

bool has_spindles(char letter) { return letter == 'S' || letter == 'M' || letter == 'H'; }

// The colon of a label such as `L1:` that begins at `begin`, else npos. A label is the first word
// of a block; only the block number may precede it.
std::size_t colon_of_label(std::string_view line, std::size_t begin) {
  constexpr std::string_view number_signs = "/:Nn0123456789 \t";
  constexpr auto none = std::string_view::npos;
  if (upper(line[begin]) == 'N') return none;
  if (line.substr(0, begin).find_first_not_of(number_signs) != none) return none;
  std::size_t at = begin + 1;
  while (at < line.size() && (is_letter(line[at]) || is_digit(line[at]) || line[at] == '_')) ++at;
  const bool labelled = at > begin + 1 && at < line.size() && line[at] == ':';
  return labelled ? at : none;
}

}  // namespace

void NamedWordReader::skip_blanks() {
  while (const std::size_t blank = blank_at_start(line_.substr(at_))) at_ += blank;
}

// Passes over the rest of the line: its meaning depends on the part with the fault.
NamedWord NamedWordReader::fail(Code code, std::size_t begin, std::string detail) {
  fault_ = {.code = code, .begin = static_cast<std::uint32_t>(begin), .detail = std::move(detail)};
  at_ = line_.size();
  return {.kind = NamedWord::Kind::fault, .begin = fault_.begin, .end = fault_.begin};
}

NamedWord NamedWordReader::next() {
  skip_blanks();
  const std::size_t begin = at_;
  if (begin >= line_.size()) return {};
  const char sign = peek();
  if (is_letter(sign) || sign == '_') {
    const bool named = is_letter(peek(1)) || peek(1) == '_' || sign == '_';
    // N10G1X5: a number is never part of a name of more than one letter.
    return named ? name() : address();
  }
  if (sign == ':' && is_digit(peek(1))) return address();  // the number of a main block
  if (sign == ';') {
    at_ = line_.size();
    return {.kind = NamedWord::Kind::comment,
            .begin = static_cast<std::uint32_t>(begin),
            .end = static_cast<std::uint32_t>(at_)};
  }
  if (sign == '(') {  // 810 and 820: a comment; a call has its name directly before
    const std::size_t close = line_.find(')', begin);
    if (close == std::string_view::npos)
      return fail(Code::nc_unclosed, begin, "(, a comment without )");
    at_ = close + 1;
    return {.kind = NamedWord::Kind::comment,
            .begin = static_cast<std::uint32_t>(begin),
            .end = static_cast<std::uint32_t>(at_)};
  }
  if (sign == '/') {
    ++at_;
    while (is_digit(peek())) ++at_;
    return {.kind = NamedWord::Kind::skip,
            .begin = static_cast<std::uint32_t>(begin),
            .end = static_cast<std::uint32_t>(at_)};
  }
  if (sign == '$' && is_assigned()) {
    ++at_;
    NamedWord variable = name();
    --variable.begin;
    variable.name.insert(0, "$");
    return variable;
  }
  if (sign == '$') return fail(Code::nc_unsupported, begin, "$, a system variable");
  const auto byte = static_cast<unsigned char>(sign);
  if (byte < 0x20 || byte >= 0x7f)
    return fail(Code::nc_not_text, begin,
                name_of_character(line_.substr(begin)) + ", outside a comment");
  return fail(Code::nc_syntax, begin, std::string(1, sign));
}

// $AC_TIMER[1]=0, from the $ on.
bool NamedWordReader::is_assigned() const {
  std::size_t at = at_ + 1;
  while (at < line_.size() && (is_letter(line_[at]) || is_digit(line_[at]) || line_[at] == '_'))
    ++at;
  if (at == at_ + 1) return false;
  if (at < line_.size() && line_[at] == '[') at = line_.find(']', at);
  at = at < line_.size() ? line_.find_first_not_of(" \t]", at) : at;
  return at < line_.size() && line_[at] == '=' && line_.compare(at, 2, "==") != 0;
}

bool NamedWordReader::read_plain_number(NamedWord& word) {
  const std::size_t length = read_named_number(line_.substr(at_), word.value, word.whole);
  at_ += length;
  if (peek() == ',' && is_digit(peek(1))) {
    fault_ = {.code = Code::nc_number,
              .begin = static_cast<std::uint32_t>(at_),
              .detail = "a decimal comma: write a point"};
    return false;
  }
  const std::size_t next = line_.find_first_not_of(" \t", at_);
  const char behind = next == std::string_view::npos ? '\0' : line_[next];
  const bool expression = behind == '+' || behind == '-' || behind == '*' || behind == '/';
  if (length > 0 && std::isfinite(word.value) && !expression) return true;
  fault_ = {.code = expression ? Code::nc_unsupported : Code::nc_number,
            .begin = static_cast<std::uint32_t>(word.begin),
            .detail = expression ? "an expression" : std::string(1, line_[word.begin])};
  return false;
}

// After `=`: a number, a text, AC(…), IC(…), PM(…) of a feed, QU(…) of M and H. For anything else
// `fault_` says what it is.
bool NamedWordReader::read_value(NamedWord& word) {
  skip_blanks();
  if (begins_number(peek())) return read_plain_number(word);
  if (peek() == '"') {
    const std::size_t close = line_.find('"', at_ + 1);
    word.is_text = true;
    word.name = line_.substr(at_ + 1, close == std::string_view::npos ? close : close - at_ - 1);
    at_ = close == std::string_view::npos ? line_.size() : close + 1;
    if (close != std::string_view::npos) return true;
    fault_ = {.code = Code::nc_unclosed, .begin = word.begin, .detail = "\""};
    return false;
  }
  std::string function;
  while (is_letter(peek())) function += upper(line_[at_++]);
  skip_blanks();
  word.is_way_round = function == "DC" || function == "ACP" || function == "ACN";
  const bool reference = function == "AC" || function == "IC" || word.is_way_round;
  const bool feed = function == "PM";
  const bool quick = function == "QU" && (word.letter == 'M' || word.letter == 'H');
  if ((reference || feed || quick) && peek() == '(') {
    ++at_;
    skip_blanks();
    word.reference = function == "IC" ? NamedWord::Reference::incremental
                     : feed || quick  ? NamedWord::Reference::modal
                                      : NamedWord::Reference::absolute;
    if (begins_number(peek())) {
      if (!read_plain_number(word)) return false;
      skip_blanks();
      if (peek() == ')') return ++at_, true;
    }
  }
  fault_ = {
      .code = Code::nc_unsupported, .begin = word.begin, .detail = "a variable or an expression"};
  return false;
}

NamedWord NamedWordReader::address() {
  NamedWord word{.kind = NamedWord::Kind::address,
                 .letter = peek() == ':' ? 'N' : upper(peek()),
                 .begin = static_cast<std::uint32_t>(at_)};
  if (const std::size_t colon = colon_of_label(line_, at_); colon != std::string_view::npos) {
    word.kind = NamedWord::Kind::label;
    at_ = colon + 1;
    word.end = static_cast<std::uint32_t>(at_);
    return word;
  }
  ++at_;
  skip_blanks();
  const auto failed = [&] {
    TextFault found = fault_;
    return fail(found.code, word.begin, std::move(found.detail));
  };
  if (peek() == '[' && has_spindles(word.letter)) {  // S[1]=500, M[SPI(2)]=3
    at_ = std::min(line_.find(']', at_), line_.size() - 1) + 1;
    skip_blanks();
    word.index = some_spindle;
  }
  if (word.index < 0 && begins_number(peek())) {
    const std::size_t digits = at_;
    if (!read_plain_number(word)) return failed();
    word.end = static_cast<std::uint32_t>(at_);
    skip_blanks();
    if (peek() != '=' || !is_digit(line_[digits])) {
      at_ = word.end;
      return word;
    }
    word.index = is_whole(word.value) && word.value < some_spindle ? static_cast<int>(word.value)
                                                                   : some_spindle;
  }
  if (word.letter == 'R' && word.index >= 0)
    return fail(Code::nc_unsupported, word.begin, "R, a variable");
  if (peek() != '=') return fail(Code::nc_number, word.begin, std::string(1, word.letter));
  ++at_;
  const bool is_main_axis = word.letter >= 'X' && word.letter <= 'Z' && word.index < 0;
  word.is_variable = is_main_axis && read_variable();
  if (!word.is_variable && !read_value(word)) return failed();
  word.end = static_cast<std::uint32_t>(at_);
  return word;
}

// A variable alone after `=`. The position does not change if there is none, or if more follows.
bool NamedWordReader::read_variable() {
  const std::size_t begin = at_;
  skip_blanks();
  if (is_letter(peek()) || peek() == '_') {
    // R9 ends with its number: X=R9G41 has two words.
    const bool is_parameter = upper(peek()) == 'R' && is_digit(peek(1));
    if (is_parameter) ++at_;
    while ((is_letter(peek()) && !is_parameter) || is_digit(peek()) || peek() == '_') ++at_;
    const std::size_t end = at_;
    skip_blanks();
    const bool goes_on = std::string_view("+-*/([<>=.").find(peek()) != std::string_view::npos;
    at_ = goes_on ? begin : end;
    return !goes_on;
  }
  at_ = begin;
  return false;
}

// CTRANS(X,10):CROT(Z,30), $P_UIFR[2], from the beginning of the value. The position does not
// change if it is no frame.
bool NamedWordReader::read_frame() {
  const std::size_t begin = at_;
  for (;;) {
    skip_blanks();
    if (peek() == '$') ++at_;
    const std::size_t name = at_;
    while (is_letter(peek()) || is_digit(peek()) || peek() == '_') ++at_;
    if (at_ == name || is_digit(line_[name])) break;
    skip_blanks();
    const std::size_t close = peek() == '('   ? end_of_call(at_)
                              : peek() == '[' ? line_.find(']', at_) + 1
                                              : at_;
    if (close == std::string_view::npos || close < at_) break;
    at_ = close;
    skip_blanks();
    if (peek() != ':') return true;
    ++at_;
  }
  at_ = begin;
  return false;
}

// A value that the control counts and measures itself (D-88): $AC_PARAM[2]*2+1, with such names
// only. The position does not change if it is no such value.
bool NamedWordReader::read_value_of_control() {
  const std::size_t begin = at_;
  int depth = 0;
  bool has_name = false;
  for (;;) {
    for (skip_blanks(); peek() == '(' || peek() == '-'; skip_blanks()) depth += line_[at_++] == '(';
    if (peek() == '$' && upper(peek(1)) == 'A') {
      has_name = true;
      for (++at_; is_letter(peek()) || is_digit(peek()) || peek() == '_';) ++at_;
      if (peek() == '[') at_ = std::min(line_.find(']', at_), line_.size() - 1) + 1;
    } else {
      NamedWord number;
      const std::size_t length = read_named_number(line_.substr(at_), number.value, number.whole);
      if (length == 0) break;
      at_ += length;
    }
    for (skip_blanks(); peek() == ')'; skip_blanks()) --depth, ++at_;
    if (std::string_view("+-*/").find(peek()) != std::string_view::npos) {
      ++at_;
      continue;
    }
    if (depth != 0 || !has_name) break;
    return true;
  }
  at_ = begin;
  return false;
}

std::size_t NamedWordReader::end_of_call(std::size_t begin) const {
  std::size_t depth = 0;
  bool quoted = false;
  for (std::size_t at = begin; at < line_.size(); ++at) {
    if (line_[at] == '"') quoted = !quoted;
    if (quoted) continue;
    if (line_[at] == '(') ++depth;
    if (line_[at] == ')' && --depth == 0) return at + 1;
  }
  return std::string_view::npos;
}

NamedWord NamedWordReader::name() {
  NamedWord word{.kind = NamedWord::Kind::name, .begin = static_cast<std::uint32_t>(at_)};
  std::string spelled;
  while (is_letter(peek()) || is_digit(peek()) || peek() == '_') spelled += upper(line_[at_++]);
  word.end = static_cast<std::uint32_t>(at_);
  skip_blanks();
  // ACC[X]=80: of an axis or a position.
  const std::size_t index_end = peek() == '[' ? line_.find(']', at_) : std::string_view::npos;
  if (index_end != std::string_view::npos) {
    at_ = index_end + 1;
    word.end = static_cast<std::uint32_t>(at_);
    skip_blanks();
    if (peek() != '=') return fail(Code::nc_unsupported, word.begin, spelled + "[, a variable");
  }
  if (peek() == '(') {
    const std::size_t close = end_of_call(at_);
    if (close == std::string_view::npos) return fail(Code::nc_unclosed, word.begin, spelled + "(");
    word.kind = NamedWord::Kind::call;
    word.end = static_cast<std::uint32_t>(close);
  } else if (peek() == '"') {  // CALL "POCKET", EXTCALL "POCKET"
    const std::size_t close = line_.find('"', at_ + 1);
    if (close == std::string_view::npos) return fail(Code::nc_unclosed, word.begin, spelled);
    if (spelled == "EXTCALL") word.kind = NamedWord::Kind::call;
    word.end = static_cast<std::uint32_t>(close + 1);
  } else if (peek() == '=') {
    ++at_;
    word.kind = NamedWord::Kind::assignment;
    const bool is_frame =
        spelled.starts_with("P_") && word.begin > 0 && line_[word.begin - 1] == '$';
    const bool is_of_control =
        spelled.starts_with("A") && word.begin > 0 && line_[word.begin - 1] == '$';
    word.is_variable = (is_frame && read_frame()) || (is_of_control && read_value_of_control());
    if (!word.is_variable && !read_value(word)) {
      TextFault found = fault_;
      return fail(found.code, word.begin, spelled + "=, " + found.detail);
    }
    word.end = static_cast<std::uint32_t>(at_);
  } else if (peek() == ':') {
    word.kind = NamedWord::Kind::label;
    word.end = static_cast<std::uint32_t>(at_ + 1);
  }
  at_ = word.end;
  if (!word.is_text) word.name = std::move(spelled);
  return word;
}

}  // namespace trc
