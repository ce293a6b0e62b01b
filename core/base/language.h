#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace trc {

// Of the texts of diagnostics. Names, codes, words of the program and JSON keys have none.
enum class Language : std::uint8_t { english, german };

// By the tag of a language as in "de", "de-AT" or "de_DE.UTF-8": what stands behind the first part
// does not count, nor do capitals. "C" and "POSIX" are English. Nothing: not one of ours.
[[nodiscard]] std::optional<Language> language_of_tag(std::string_view tag);

// The one that the header Accept-Language of HTTP prefers (RFC 9110, 12.5.4), English where it
// names none of ours.
[[nodiscard]] Language accepted_language(std::string_view header);

}  // namespace trc
