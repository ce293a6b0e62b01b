#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace trc::server {

// Whether a character is none to be seen, but does something where it is shown: control characters
// (C0, DEL, C1), line separators, and those that turn the direction of writing.
bool acts_on_display(std::uint32_t code_point);

// The text as a person may be shown it, and as a protobuf string may hold it: bytes that are not
// UTF-8 become U+FFFD, characters that act on the display a blank, and what is longer than `most`
// bytes is cut between two characters.
std::string presentable(std::string_view text, std::size_t most = 200);

inline constexpr std::string_view replacement_character = "\xEF\xBF\xBD";

}  // namespace trc::server
