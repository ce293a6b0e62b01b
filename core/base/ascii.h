#pragma once

#include <string>
#include <string_view>

namespace trc {

// Of ASCII letters only, whatever the locale.
[[nodiscard]] std::string in_lower_case(std::string_view text);

// Without these signs at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text, std::string_view signs = " \t");

}  // namespace trc
