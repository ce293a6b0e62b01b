#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trc {

// The number of letters to insert, delete or change to turn one word into the other; two neighbours
// in the wrong order count as one.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

// The candidate that was probably meant by `word`: at most a third of its letters differ. Of
// several equally near ones the first. Nothing: there is none.
[[nodiscard]] std::optional<std::string> likely_meant(std::string_view word,
                                                      const std::vector<std::string>& candidates);

}  // namespace trc
