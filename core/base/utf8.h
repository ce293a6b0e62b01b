#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace trc {

// Bytes of the UTF-8 character at the start of `text`; 0: it is none.
[[nodiscard]] std::size_t utf8_character(std::string_view text);
[[nodiscard]] bool is_utf8(std::string_view text);

// The text itself where all of it is UTF-8, else with each byte read as a character of Latin-1.
// Messages and the lookup of names use it for text in either encoding.
[[nodiscard]] std::string as_utf8(std::string_view text);

}  // namespace trc
