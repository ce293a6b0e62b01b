#pragma once

#include <string>
#include <string_view>

namespace trc {

// The detail of a diagnostic with what it says in English between words of the program, or around
// them, in German: "G41 or G42 in line 3 (N20)". The words themselves stay.
[[nodiscard]] std::string with_german_fragments(std::string_view text);

}  // namespace trc
