#pragma once

#include <string_view>

namespace trc::wire {

// The German of SettingMeaning::meaning; empty: there is no such setting.
[[nodiscard]] std::string_view german_meaning_of(std::string_view key);

// The German of what a setting takes, or of its unit. Words that are written into a program or a
// setting stay as they are.
[[nodiscard]] std::string_view german_values_of(std::string_view values);

}  // namespace trc::wire
