#pragma once

#include <limits>
#include <string_view>

namespace trc::wire {

// What one field of the setup is for: the one place where that is written down for people.
struct SettingMeaning {
  static constexpr double unbounded = std::numeric_limits<double>::infinity();

  std::string_view key{};      // as settings() names it
  std::string_view meaning{};  // a few words
  std::string_view unit{};     // "mm", "degrees", "mm/min"; empty: none
  std::string_view initial{};  // as --set takes it; empty: none
  double least = -unbounded;   // in the unit; of what is no number neither says anything
  double most = unbounded;
};

// The row of a key; of a `#TRC` option its words are those of trc_keywords().
[[nodiscard]] const SettingMeaning& meaning_of(std::string_view key);

}  // namespace trc::wire
