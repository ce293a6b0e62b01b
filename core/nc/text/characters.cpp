#include "core/nc/text/characters.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace trc {

std::string in_upper_case(std::string_view text) {
  std::string result(text);
  for (char& letter : result) letter = upper(letter);
  return result;
}
namespace {

bool is_control(char byte) { return static_cast<unsigned char>(byte) < 0x20 || byte == 0x7f; }

// Characters that cannot be seen, or cannot be told from those an NC program has.
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

std::uint32_t code_point(std::string_view character) {
  const auto lead = static_cast<unsigned char>(character.front());
  if (character.size() == 1) return lead;
  std::uint32_t point = lead & (0x7fU >> character.size());
  for (const char byte : character.substr(1))
    point = point << 6U | (static_cast<unsigned char>(byte) & 0x3fU);
  return point;
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
