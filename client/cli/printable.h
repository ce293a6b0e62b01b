#pragma once

#include <google/protobuf/message.h>

#include <cstddef>
#include <string>
#include <string_view>

// Texts of servers, files and their names, which may hold anything, for a terminal.

namespace trc::cli {

// A character as it may be shown: '?' in place of one that acts on the display, a blank in place of
// a tab. A byte that is not UTF-8 is shown as its Latin-1 letter.
[[nodiscard]] std::string printable_character(std::string_view character);

// A text in one line. What is longer than `most` bytes is cut.
[[nodiscard]] std::string printable(std::string_view text, std::size_t most = std::string::npos);

// Makes all texts of a message printable, at most 2000 bytes of each.
void make_printable(google::protobuf::Message& message);

}  // namespace trc::cli
