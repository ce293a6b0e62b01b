#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace trc {

// May stand before a text in UTF-8.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

// Converts ASCII letters only, whatever the locale.
[[nodiscard]] constexpr char upper(char letter) {
  return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
}
[[nodiscard]] std::string in_upper_case(std::string_view text);
// For names in Latin-1 letters, encoded as Latin-1 or as UTF-8.
[[nodiscard]] std::string in_capitals_as_utf8(std::string_view text);
[[nodiscard]] bool same_name(std::string_view a, std::string_view b);
[[nodiscard]] constexpr bool is_letter(char sign) {
  return upper(sign) >= 'A' && upper(sign) <= 'Z';
}
[[nodiscard]] constexpr bool is_digit(char sign) { return sign >= '0' && sign <= '9'; }
// Whether a name may have this sign after its first one.
[[nodiscard]] constexpr bool goes_on_as_name(char sign) {
  return is_letter(sign) || is_digit(sign) || sign == '_';
}
[[nodiscard]] constexpr bool is_line_end(char sign) { return sign == '\n' || sign == '\r'; }

// 0 beyond the end of the line.
[[nodiscard]] constexpr char sign_at(std::string_view line, std::size_t at) {
  return at < line.size() ? line[at] : '\0';
}

// `character`: one character, valid UTF-8.
[[nodiscard]] std::uint32_t code_point(std::string_view character);

// Bytes of the blank at the start of `text`: space, tab or no-break space. 0: none.
[[nodiscard]] inline std::size_t blank_at_start(std::string_view text) {
  if (text.empty()) return 0;
  if (text.front() == ' ' || text.front() == '\t') return 1;
  return text.starts_with("\xC2\xA0") ? 2 : 0;
}
// The position after the blanks that begin at `at`.
[[nodiscard]] std::size_t behind_blanks(std::string_view line, std::size_t at);
[[nodiscard]] std::string_view without_blanks_in_front(std::string_view text);
[[nodiscard]] std::string_view without_blanks_behind(std::string_view text);

// The first character of `text` for a message. One that cannot be seen, or that looks like
// another one, is named: "U+200B, a zero width space". Empty for empty text.
[[nodiscard]] std::string name_of_character(std::string_view text);

}  // namespace trc
