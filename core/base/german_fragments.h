#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace trc {

// The detail of a diagnostic with what it says in English between words of the program, or around
// them, in German: "G41 or G42 in line 3 (N20)". The words themselves stay.
[[nodiscard]] std::string with_german_fragments(std::string_view text);

// Whether such a piece of the text begins in front of `at` and goes on there.
[[nodiscard]] bool goes_on_in_fragment(std::string_view text, std::size_t at);

}  // namespace trc
