#include "core/session/not_travelled.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace trc {

NotTravelled::NotTravelled(std::span<const Diagnostic> diagnostics) {
  const auto value_of = [](const Diagnostic& note, std::string_view name) {
    for (const auto& value : note.values)
      if (value.name == name && value.value >= 0) return static_cast<std::uint64_t>(value.value);
    return note.source.index;
  };
  for (const Diagnostic& note : diagnostics)
    if (note.code == Code::blocks_masked)
      ranges_.emplace_back(value_of(note, "first_index"), value_of(note, "last_index"));
  std::sort(ranges_.begin(), ranges_.end());
}

bool NotTravelled::contains(std::uint64_t index) const {
  const auto behind =
      std::upper_bound(ranges_.begin(), ranges_.end(), index,
                       [](std::uint64_t at, const Range& range) { return at < range.first; });
  return behind != ranges_.begin() && index <= std::prev(behind)->second;
}

}  // namespace trc
