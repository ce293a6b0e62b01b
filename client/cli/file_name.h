#pragma once

#include <string>
#include <string_view>

namespace trc::cli {

// The name of a file as text for messages and records: a byte that is no UTF-8 as \xE4. Linux takes
// any bytes for a name.
[[nodiscard]] std::string text_of_name(std::string_view name);

// The file that a text names: that of exactly this name if there is one, else with \xE4 decoded.
[[nodiscard]] std::string name_of_text(const std::string& text);

}  // namespace trc::cli
