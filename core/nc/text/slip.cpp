#include "core/nc/text/slip.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/base/utf8.h"
#include "core/nc/text/characters.h"

namespace trc {
namespace {

bool is_high(char sign) { return static_cast<unsigned char>(sign) >= 0x80; }
bool is_o(char sign) { return sign == 'O' || sign == 'o'; }
// Letters in the place of a digit; a capital L is not taken for a 1.
bool is_letter_for_digit(char sign) { return is_o(sign) || sign == 'l'; }
bool belongs_to_number(char sign) {
  return is_digit(sign) || sign == '.' || sign == '+' || sign == '-';
}

struct Sign {
  std::size_t length = 0;  // bytes
  char instead = 0;        // on the keyboard; 0: none
  bool quotes = false;
};

// The character at the beginning of the text.
Sign sign_of(std::string_view text) {
  const std::size_t length = utf8_character(text);
  if (length == 0) return {.length = 1};
  if (length == 1) return {.length = 1, .instead = text.front()};
  const std::uint32_t point = code_point(text.substr(0, length));
  constexpr auto double_quotes =
      std::to_array<std::uint32_t>({0xab, 0xbb, 0x201c, 0x201d, 0x201e, 0x201f});
  constexpr auto single_quotes =
      std::to_array<std::uint32_t>({0x2018, 0x2019, 0x201a, 0x201b, 0x2039, 0x203a});
  if (std::ranges::find(double_quotes, point) != double_quotes.end())
    return {.length = length, .instead = '"', .quotes = true};
  if (std::ranges::find(single_quotes, point) != single_quotes.end())
    return {.length = length, .instead = '\'', .quotes = true};
  if (point == 0x2212 || (point >= 0x2010 && point <= 0x2015))
    return {.length = length, .instead = '-'};
  // Full-width: as wide as a Chinese or Japanese character.
  if (point >= 0xff01 && point <= 0xff5e)
    return {.length = length, .instead = static_cast<char>(point - 0xff01 + '!')};
  return {.length = length};
}

// X−10, Ｘ１０, T=„MILL“
std::optional<FoundSlip> other_signs(std::string_view line, std::size_t at) {
  const auto is_blank = [](char sign) { return sign == ' ' || sign == '\t' || is_line_end(sign); };
  std::size_t begin = at;
  while (begin > 0 && !is_blank(line[begin - 1]) &&
         (belongs_to_number(line[begin]) || is_high(line[begin]) || line[begin] == '='))
    --begin;
  FoundSlip found{.slip = {.kind = SlipKind::other_keyboard}, .begin = begin};
  bool seen = false;
  bool digits = false;
  std::size_t end = begin;
  while (end < line.size() && !is_blank(line[end])) {
    const Sign sign = sign_of(line.substr(end));
    const bool next_word = digits && is_letter(line[end]);
    if (next_word || line[end] == '(' || line[end] == ';') break;
    const bool other = sign.length > 1 && sign.instead != 0;
    if (sign.instead == 0) return std::nullopt;
    seen = seen || other;
    if (sign.quotes) found.slip.kind = SlipKind::quotes;
    digits = digits || is_digit(sign.instead);
    found.slip.instead += sign.instead;
    end += sign.length;
  }
  if (!seen) return std::nullopt;
  found.word = line.substr(begin, end - begin);
  return found;
}

// X10,5: at the comma or at its word.
std::optional<FoundSlip> decimal_comma(std::string_view line, std::size_t at) {
  std::size_t begin = at;
  while (begin > 0 && (belongs_to_number(line[begin]) || line[begin] == ',')) --begin;
  std::size_t comma = begin;
  if (is_letter(line[comma])) ++comma;
  while (comma < line.size() &&
         (belongs_to_number(line[comma]) || line[comma] == ' ' || line[comma] == '='))
    ++comma;
  const bool is_comma = comma > 0 && comma + 1 < line.size() && line[comma] == ',' &&
                        is_digit(line[comma - 1]) && is_digit(line[comma + 1]);
  if (!is_comma || !is_letter(line[begin])) return std::nullopt;
  std::size_t end = comma + 1;
  while (end < line.size() && is_digit(line[end])) ++end;
  const std::string word(line.substr(begin, end - begin));
  Slip slipped{.kind = SlipKind::decimal_comma, .instead = word};
  slipped.instead[comma - begin] = '.';
  return FoundSlip{.slip = slipped, .begin = begin, .word = word};
}

// IX+O: an increment of Klartext has two letters.
bool begins_increment(std::string_view line, std::size_t at) {
  return at + 2 < line.size() && upper(line[at]) == 'I' &&
         std::string_view("ABCUVWXYZ").find(upper(line[at + 1])) != std::string_view::npos &&
         (line[at + 2] == '+' || line[at + 2] == '-') &&
         (at == 0 || !(is_letter(line[at - 1]) || line[at - 1] == '_'));
}

// YO, GO1, G0l: at the letter or at its word.
std::optional<FoundSlip> letter_for_digit(std::string_view line, std::size_t at) {
  if (begins_increment(line, at)) ++at;
  const auto sign = [&](std::size_t place) { return place < line.size() ? line[place] : ' '; };
  std::size_t begin = at;
  while (begin > 0 && (is_letter_for_digit(line[begin]) || belongs_to_number(line[begin])) &&
         (belongs_to_number(line[begin - 1]) || is_letter(line[begin - 1])))
    --begin;
  if (!is_letter(line[begin]) || is_letter_for_digit(line[begin])) return std::nullopt;
  const bool is_increment = begin > 0 && begins_increment(line, begin - 1);
  if (begin > 0 && !is_increment && (is_letter(line[begin - 1]) || line[begin - 1] == '_'))
    return std::nullopt;
  std::size_t first = begin + 1;
  if (sign(first) == '+' || sign(first) == '-') ++first;
  // A letter that could begin a word is a slip only at the fault, or directly before the fault,
  // where it was taken for such a word.
  const bool behind = at > first && !is_letter_for_digit(sign(at));
  const std::size_t slip = at == begin ? first : at - (behind ? 1 : 0);
  if (!is_letter_for_digit(sign(slip))) return std::nullopt;
  if (sign(slip) == 'l' && slip > first && is_digit(sign(slip + 1))) return std::nullopt;
  std::size_t end = begin + 1;
  bool digits = false;
  for (; end < line.size() && (is_letter_for_digit(line[end]) || belongs_to_number(line[end]));
       ++end)
    digits = digits || is_digit(line[end]);
  const std::string word(line.substr(begin, end - begin));
  // GOTO, RO[1]: a name, unless a word with its number follows.
  const bool name_follows =
      (is_letter(sign(end)) && !is_digit(sign(end + 1)) && sign(end + 1) != '-' &&
       sign(end + 1) != '+' && sign(end + 1) != '.' && !is_o(sign(end + 1))) ||
      (is_letter(sign(end)) && is_letter(sign(end + 1))) || sign(end) == '_' || sign(end) == '(' ||
      sign(end) == '[' || sign(end) == '=' || sign(end) == ':';
  const char letter = upper(line[begin]);
  const bool statement = is_o(sign(begin + 1)) && (letter == 'D' || letter == 'T');  // DO1, TO
  // G00 with both zeros mistyped; other names may end in OO.
  const bool is_rapid = letter == 'G' && word.size() == 3 && is_o(word[1]) && is_o(word[2]);
  // XO, X+O
  const bool is_zero = word.size() == first - begin + 1;
  if (name_follows || statement || (!digits && !is_zero && !is_rapid)) return std::nullopt;
  Slip slipped{.instead = word};
  for (std::size_t i = 1; i < slipped.instead.size(); ++i) {
    char& one = slipped.instead[i];
    if (!is_letter_for_digit(one)) continue;
    if (slipped.kind == SlipKind::none)
      slipped.kind = is_o(one) ? SlipKind::letter_o : SlipKind::letter_l;
    one = is_o(one) ? '0' : '1';
  }
  // G10l2: no function has so many digits.
  if (letter == 'G' && std::ranges::count_if(slipped.instead, is_digit) > 3) return std::nullopt;
  if (!is_increment) return FoundSlip{.slip = slipped, .begin = begin, .word = word};
  slipped.instead.insert(0, 1, line[begin - 1]);
  return FoundSlip{.slip = slipped, .begin = begin - 1, .word = line[begin - 1] + word};
}

}  // namespace

std::optional<FoundSlip> slip_at(std::string_view line, std::size_t at) {
  if (at >= line.size()) return std::nullopt;
  if (auto found = decimal_comma(line, at)) return found;
  if (auto found = letter_for_digit(line, at)) return found;
  return other_signs(line, at);
}

}  // namespace trc
