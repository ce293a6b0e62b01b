#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace trc {

// Language of the texts of diagnostics. Names, codes, program words and JSON keys have none.
enum class Language : std::uint8_t { english, german };

// The language of a tag such as "de", "de-AT" or "de_DE.UTF-8": only the first part counts,
// whatever its case. "C" and "POSIX" are English. Nothing: a language without texts here.
[[nodiscard]] std::optional<Language> language_of_tag(std::string_view tag);

// The language that the HTTP header Accept-Language prefers (RFC 9110, 12.5.4); English where it
// names neither.
[[nodiscard]] Language accepted_language(std::string_view header);

}  // namespace trc
