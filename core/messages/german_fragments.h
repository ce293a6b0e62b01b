#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace trc {

// The detail of a diagnostic with its English parts, between or around words of the program, put
// into German: "G41 or G42 in line 3 (N20)". The words of the program stay.
[[nodiscard]] std::string with_german_fragments(std::string_view text);

// Whether such an English part begins before `at` and continues there.
[[nodiscard]] bool goes_on_in_fragment(std::string_view text, std::size_t at);

}  // namespace trc
