#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/base/diagnostic.h"

namespace trc {

// Contour blocks that the tool does not travel, as the notes name them. A transition after such a
// block may still be travelled.
class NotTravelled {
 public:
  explicit NotTravelled(std::span<const Diagnostic> diagnostics);

  [[nodiscard]] bool contains(std::uint64_t index) const;

 private:
  using Range = std::pair<std::uint64_t, std::uint64_t>;
  std::vector<Range> ranges_{};  // apart from each other, in order
};

}  // namespace trc
