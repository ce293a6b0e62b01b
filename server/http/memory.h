#pragma once

#include <atomic>
#include <cstddef>
#include <utility>

namespace trc::server::http {

// The memory that bodies, answers held back and views may take together.
class Memory {
 public:
  explicit Memory(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  [[nodiscard]] std::size_t used_bytes() const { return used_; }
  [[nodiscard]] std::size_t most_bytes() const { return most_bytes_; }

 private:
  friend class Share;
  const std::size_t most_bytes_;
  std::atomic<std::size_t> used_{0};
};

// A part of it, given back when it is destroyed.
class Share {
 public:
  explicit Share(Memory& memory) : memory_(&memory) {}
  Share(Share&& other) noexcept : memory_(other.memory_), bytes_(std::exchange(other.bytes_, 0)) {}
  Share& operator=(Share&& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~Share() { release(); }

  [[nodiscard]] std::size_t bytes() const { return bytes_; }

  // False, and nothing is taken, when there is not as much.
  [[nodiscard]] bool take(std::size_t bytes) {
    if (memory_->used_.fetch_add(bytes) + bytes > memory_->most_bytes_) {
      memory_->used_ -= bytes;
      return false;
    }
    bytes_ += bytes;
    return true;
  }
  void release() { memory_->used_ -= std::exchange(bytes_, 0); }

 private:
  Memory* memory_;
  std::size_t bytes_ = 0;
};

}  // namespace trc::server::http
