#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace trc::server {

// Length in bytes of the UTF-8 character at the front of a text that is not empty; 0 when there is
// none. Overlong forms, surrogates and code points beyond U+10FFFF are none.
std::size_t utf8_length(std::string_view text);

// The text as a person may be shown it, and as a protobuf string may hold it: bytes that are not
// UTF-8 become U+FFFD, control characters a blank, and what is longer than `most` bytes is cut
// between two characters.
std::string presentable(std::string_view text, std::size_t most = 200);

inline constexpr std::string_view replacement_character = "\xEF\xBF\xBD";

}  // namespace trc::server
