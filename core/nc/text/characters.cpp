#include "core/nc/text/characters.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "core/base/utf8.h"

namespace trc {

std::string in_upper_case(std::string_view text) {
  std::string result(text);
  for (char& letter : result) letter = upper(letter);
  return result;
}

std::string in_capitals_as_utf8(std::string_view text) {
  std::string result = in_upper_case(as_utf8(text));
  // U+00E0 to U+00FE and their capitals differ in one bit of the second byte.
  constexpr char lead = '\xC3';
  constexpr char division_sign = '\xB7';
  for (std::size_t at = 1; at < result.size(); ++at) {
    const bool small = result[at] >= '\xA0' && result[at] <= '\xBE' && result[at] != division_sign;
    if (result[at - 1] == lead && small) result[at] = static_cast<char>(result[at] - 0x20);
  }
  return result;
}

namespace {

bool is_control(char byte) { return static_cast<unsigned char>(byte) < 0x20 || byte == 0x7f; }

// Characters that are invisible, or look like those of an NC program.
struct NamedCharacter {
  std::uint32_t point = 0;
  std::string_view name;
};
constexpr auto deceptive_characters = std::to_array<NamedCharacter>({
    {0x00ad, "a soft hyphen, which cannot be seen"},
    {0x2002, "a wide space"},
    {0x2003, "a wide space"},
    {0x2007, "a space as wide as a digit"},
    {0x2009, "a thin space"},
    {0x200a, "a thin space"},
    {0x200b, "a zero width space, which cannot be seen"},
    {0x200c, "a zero width character, which cannot be seen"},
    {0x200d, "a zero width character, which cannot be seen"},
    {0x200e, "a direction mark, which cannot be seen"},
    {0x200f, "a direction mark, which cannot be seen"},
    {0x2010, "a hyphen that is no minus sign"},
    {0x2011, "a hyphen that is no minus sign"},
    {0x2012, "a dash that is no minus sign"},
    {0x2013, "a dash that is no minus sign"},
    {0x2014, "a dash that is no minus sign"},
    {0x2028, "a line separator, which cannot be seen"},
    {0x2029, "a paragraph separator, which cannot be seen"},
    {0x202f, "a narrow no-break space"},
    {0x2060, "a word joiner, which cannot be seen"},
    {0x2212, "a minus sign that is not the one of the keyboard"},
    {0x3000, "a wide space"},
    {0xfeff, "a byte order mark, which cannot be seen"},
});

std::string hexadecimal(std::uint32_t value) {
  std::array<char, 8> digits{};
  const auto written =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, /*base=*/16);
  std::string text(digits.data(), written.ptr);
  for (char& digit : text)
    if (digit >= 'a') digit = static_cast<char>(digit - 'a' + 'A');
  return text.insert(0, text.size() < 4 ? 4 - text.size() : 0, '0');
}

}  // namespace

std::uint32_t code_point(std::string_view character) {
  const auto lead = static_cast<unsigned char>(character.front());
  if (character.size() == 1) return lead;
  std::uint32_t point = lead & (0x7fU >> character.size());
  for (const char byte : character.substr(1))
    point = point << 6U | (static_cast<unsigned char>(byte) & 0x3fU);
  return point;
}

std::size_t behind_blanks(std::string_view line, std::size_t at) {
  while (at < line.size()) {
    const std::size_t blank = blank_at_start(line.substr(at));
    if (blank == 0) break;
    at += blank;
  }
  return at;
}

std::string_view without_blanks_in_front(std::string_view text) {
  while (const std::size_t length = blank_at_start(text)) text.remove_prefix(length);
  return text;
}

std::string_view without_blanks_behind(std::string_view text) {
  for (;;) {
    if (text.ends_with(' ') || text.ends_with('\t')) {
      text.remove_suffix(1);
    } else if (text.ends_with("\xC2\xA0")) {
      text.remove_suffix(2);
    } else {
      return text;
    }
  }
}

bool same_name(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, upper, upper);
}

std::string name_of_character(std::string_view text) {
  if (text.empty()) return {};
  const std::size_t length = utf8_character(text);
  if (length == 0) return "no UTF-8";
  const bool control = is_control(text.front());
  if (length == 1 && !control) return std::string(text.substr(0, 1));
  const std::uint32_t point = code_point(text.substr(0, length));
  std::string name = "U+" + hexadecimal(point);
  if (control) return name + ", a control character";
  const auto* const named = std::ranges::find(deceptive_characters, point, &NamedCharacter::point);
  if (named != deceptive_characters.end()) return name.append(", ").append(named->name);
  return std::string(text.substr(0, length)).append(", ").append(name);
}

}  // namespace trc
