#pragma once

#include <string>
#include <string_view>

namespace trc {

// The detail of a diagnostic, where what it says about a word is known in German: "G68, rotation".
[[nodiscard]] std::string german_detail(std::string_view detail);

}  // namespace trc
