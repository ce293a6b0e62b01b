#pragma once

#include <string>
#include <string_view>

#include "core/nc/state/dialect_name.h"

namespace trc {

// The text in capitals, without blanks.
[[nodiscard]] std::string in_capitals(std::string_view text);

// The program with the settings of its variables (#500=#500+1, R1=R1+1) as comments: another
// control has no such variables.
[[nodiscard]] std::string with_settings_as_comments(std::string_view program, DialectName dialect);

// The text as a comment of the dialect. A bracket in it would end a comment in brackets, and its
// rest would be read as words.
[[nodiscard]] std::string spelled_comment(std::string comment, DialectName to);

}  // namespace trc
