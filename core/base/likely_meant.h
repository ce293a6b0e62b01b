#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trc {

// How many letters have to be put in, left out or changed to make one word of the other; two
// neighbours in the wrong order count as one.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

// The candidate that `word` is a slip of the pen of: at most a third of its letters are wrong.
// Of several that are as near the first. Nothing: none is.
[[nodiscard]] std::optional<std::string> likely_meant(std::string_view word,
                                                      const std::vector<std::string>& candidates);

}  // namespace trc
