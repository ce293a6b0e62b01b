#include "core/nc/text/klartext_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/nc/text/characters.h"

namespace trc {
namespace {

using Kind = KlartextWord::Kind;

bool is_sign(char sign) { return sign == '+' || sign == '-'; }

// RLF300, RRM3: the compensation needs no blank after it.
std::size_t length_of_name(std::string_view letters) {
  const bool side = letters.size() > 2 && upper(letters[0]) == 'R' &&
                    (upper(letters[1]) == 'L' || upper(letters[1]) == 'R') &&
                    (upper(letters[2]) == 'F' || upper(letters[2]) == 'M');
  return side ? 2 : letters.size();
}

// X, IX; after DR and the like a sign may be alone.
bool takes_a_coordinate(std::string_view name) {
  if (name.starts_with('I') && name.size() == 2) name.remove_prefix(1);
  return name.size() == 1 && std::string_view("ABCUVWXYZ").find(name[0]) != std::string_view::npos;
}

// RND, CHF, R and the like: a blank may precede their value.
bool takes_a_size(std::string_view name) {
  constexpr auto names = std::to_array<std::string_view>(
      {"CCA", "CHF", "F", "LEN", "PA", "IPA", "PR", "IPR", "R", "RND"});
  return std::ranges::find(names, name) != names.end();
}

// Q13, QL1
bool begins_parameter(std::string_view text) {
  if (text.size() < 2 || upper(text[0]) != 'Q') return false;
  const char kind = upper(text[1]);
  const bool has_kind = (kind == 'L' || kind == 'R') && text.size() > 2;
  return is_digit(text[has_kind ? 2 : 1]);
}

// The position after Q13 or QL1.
std::size_t behind_parameter(std::string_view block, std::size_t at) {
  const char kind = at + 1 < block.size() ? upper(block[at + 1]) : '\0';
  at += kind == 'L' || kind == 'R' || kind == 'S' ? 2 : 1;
  return std::min(block.find_first_not_of("0123456789", at), block.size());
}

// The position after the parameter or formula that begins there: Q13, (Q1+2), Q1*2. The text after
// it, with or without a blank, is the next word.
std::size_t behind_formula(std::string_view block, std::size_t at) {
  for (;;) {
    if (at < block.size() && block[at] == '(') {
      int depth = 0;
      do {
        depth += block[at] == '(' ? 1 : block[at] == ')' ? -1 : 0;
        ++at;
      } while (depth > 0 && at < block.size() && !is_line_end(block[at]));
    } else if (at < block.size() && upper(block[at]) == 'Q') {
      at = behind_parameter(block, at);
    } else {
      at = std::min(block.find_first_not_of("0123456789.,", at), block.size());
    }
    if (at >= block.size() || std::string_view("+-*/^%").find(block[at]) == std::string_view::npos)
      return at;
    ++at;
  }
}

}  // namespace

std::size_t read_klartext_number(std::string_view text, double& value) {
  bool whole = false;
  const std::size_t comma = read_number(text, value, whole);
  const bool goes_on =
      comma > 0 && comma + 1 < text.size() && text[comma] == ',' && is_digit(text[comma + 1]);
  if (!goes_on) return comma;
  const std::size_t end = std::min(text.find_first_not_of("0123456789", comma + 1), text.size());
  const bool has_other_sign = end < text.size() && (text[end] == ',' || text[end] == '.');
  if (!whole || has_other_sign) return 0;
  std::string with_point(text.substr(0, end));
  with_point[comma] = '.';
  return read_number(with_point, value, whole);
}

bool is_continued_klartext(std::string_view line) {
  // Nearly all lines end in a digit or a sign.
  if (line.empty() || is_digit(line.back()) || is_sign(line.back())) return false;
  std::string_view block = without_blanks_behind(line);
  if (!block.ends_with('~')) return false;
  // A structure block is a title; a comment is continued like a block.
  const std::size_t statement = block.find_first_not_of("0123456789 \t/Nn");
  return statement != std::string_view::npos && block[statement] != '*';
}

bool is_klartext_comment(std::string_view block) {
  const std::size_t statement = block.find_first_not_of("0123456789 \t/Nn");
  return statement != std::string_view::npos && block[statement] == ';';
}

void KlartextReader::skip_blanks() {
  while (at_ < block_.size()) {
    const char sign = peek();
    const std::size_t blank =
        sign == '~' || is_line_end(sign) ? 1 : blank_at_start(block_.substr(at_));
    if (blank == 0) return;
    at_ += blank;
  }
}

KlartextWord KlartextReader::word(Kind kind, std::size_t begin, std::size_t end) {
  at_ = end;
  return {.kind = kind,
          .begin = static_cast<std::uint32_t>(begin),
          .end = static_cast<std::uint32_t>(end)};
}

KlartextWord KlartextReader::fail(Code code, std::size_t begin, std::string detail) {
  fault_ = {.code = code, .begin = static_cast<std::uint32_t>(begin), .detail = std::move(detail)};
  return word(Kind::fault, begin, block_.size());
}

KlartextWord KlartextReader::next() {
  skip_blanks();
  const std::size_t begin = at_;
  if (begin >= block_.size()) return word(Kind::end, begin, begin);
  const char sign = peek();
  if (sign == ';') {
    const std::size_t line_end = block_.find_first_of("\r\n", begin);
    return word(Kind::comment, begin, std::min(line_end, block_.size()));
  }
  if (sign == '"') {
    const std::size_t close = block_.find('"', begin + 1);
    if (close == std::string_view::npos)
      return fail(Code::nc_unclosed, begin, "\", a text without its end");
    return word(Kind::text, begin, close + 1);
  }
  if (sign == '/') return word(Kind::skip, begin, begin + 1);
  if (is_letter(sign)) return named();
  if (is_digit(sign) || is_sign(sign) || sign == '.') {
    KlartextWord number = word(Kind::number, begin, begin);
    return numbered(std::move(number));
  }
  const auto byte = static_cast<unsigned char>(sign);
  if (byte < 0x20 || byte >= 0x7f)
    return fail(Code::nc_not_text, begin,
                name_of_character(block_.substr(begin)) + ", outside a comment");
  return fail(Code::nc_syntax, begin, std::string(1, sign));
}

KlartextWord KlartextReader::named() {
  const std::size_t begin = at_;
  std::size_t end = begin;
  while (end < block_.size() && is_letter(block_[end])) ++end;
  end = begin + length_of_name(block_.substr(begin, end - begin));
  KlartextWord found = word(Kind::name, begin, end);
  for (const char letter : block_.substr(begin, end - begin)) found.name += upper(letter);
  skip_blanks();
  const char sign = peek();
  // F Q3, X Q1, CHF Q4 of post-processors.
  if (at_ > end && begins_parameter(block_.substr(at_)) &&
      (takes_a_coordinate(found.name) || takes_a_size(found.name))) {
    at_ = behind_formula(block_, at_);
    found.kind = Kind::variable;
    found.end = static_cast<std::uint32_t>(at_);
    return found;
  }
  const bool number = is_digit(sign) || is_sign(sign) || (sign == '.' && is_digit(peek(1)));
  if (!number) {
    at_ = end;
    return found;
  }
  // FQ5, XQL2: Q is a parameter if letters precede it.
  const bool parameter =
      found.name.size() > 1 &&
      (found.name.ends_with('Q') || found.name.ends_with("QL") || found.name.ends_with("QR"));
  found.kind = parameter ? Kind::variable : Kind::value;
  return numbered(std::move(found));
}

// The number after the name; `at_` is at the number.
KlartextWord KlartextReader::numbered(KlartextWord found) {
  if (is_sign(peek())) {
    found.negative = peek() == '-';
    // X + Q13 and X + 40 of hand-written programs.
    const std::size_t apart = std::min(block_.find_first_not_of(" \t", at_ + 1), block_.size());
    const bool may_be_apart = found.kind == Kind::value && takes_a_coordinate(found.name);
    if (may_be_apart && begins_parameter(block_.substr(apart))) at_ = apart - 1;
    const char behind = upper(peek(1));
    if (behind == 'Q' || behind == '(') {
      at_ = behind_formula(block_, at_ + 1);
      found.kind = Kind::variable;
      found.end = static_cast<std::uint32_t>(at_);
      return found;
    }
    const bool is_apart = may_be_apart && apart > at_ + 1 && apart < block_.size() &&
                          (is_digit(block_[apart]) || block_[apart] == '.');
    if (is_apart) {
      at_ = apart;
    } else if (!is_digit(behind) && behind != '.') {
      if (found.kind == Kind::number)
        return fail(Code::nc_syntax, found.begin, std::string(1, peek()));
      found.kind = Kind::sign;
      found.end = static_cast<std::uint32_t>(++at_);
      return found;
    }
  }
  const std::size_t length = read_klartext_number(block_.substr(at_), found.value);
  const std::size_t behind = at_ + length;
  if (length == 0 || !std::isfinite(found.value)) {
    const std::size_t end = block_.find_first_not_of("+-0123456789.,", at_);
    const std::string_view number = block_.substr(at_, end - at_);
    const bool has_comma = number.find(',') != std::string_view::npos;
    return fail(Code::nc_number, found.begin,
                found.name + (has_comma ? std::string(number) + ", two decimal signs" : ""));
  }
  if (is_digit(block_[at_]) || block_[at_] == '.')
    found.value = found.negative ? -std::abs(found.value) : found.value;
  at_ = behind;
  found.end = static_cast<std::uint32_t>(behind);
  return found;
}

}  // namespace trc
