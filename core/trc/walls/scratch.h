#pragma once

#include <array>
#include <cstddef>
#include <memory_resource>

namespace trc {

// Memory for one question, on the stack: enough for small contours, which are the most frequent
// from CAM. Any more comes from the heap.
class Scratch {
 public:
  Scratch() = default;
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  [[nodiscard]] std::pmr::memory_resource* memory() { return &memory_; }

 private:
  alignas(std::max_align_t) std::array<std::byte, 16'384> room_;
  std::pmr::monotonic_buffer_resource memory_{room_.data(), room_.size()};
};

}  // namespace trc
