#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace trc {

// Bytes of the UTF-8 character at the start of `text`; 0: it is none.
[[nodiscard]] std::size_t utf8_character(std::string_view text);
[[nodiscard]] bool is_utf8(std::string_view text);

// The text itself where all of it is UTF-8, else each of its bytes as the character of Latin-1 that
// it is: what a message, or a name that is looked up, makes of text in either encoding.
[[nodiscard]] std::string as_utf8(std::string_view text);

}  // namespace trc
