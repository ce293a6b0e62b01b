#pragma once

#include <atomic>
#include <cstdint>

namespace trc::server {

// The bytes that the sessions of all streams may hold together.
class MemoryBudget {
 public:
  // What one stream has taken; given back when it is destroyed.
  class Share {
   public:
    explicit Share(MemoryBudget& budget) : budget_(budget) {}
    ~Share() { budget_.used_ -= bytes_; }
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;

    // The stream now holds so many bytes. False when the budget is exceeded by that; the share then
    // stays as it was.
    bool resize(std::uint64_t bytes) {
      if (bytes > bytes_) {
        const std::uint64_t more = bytes - bytes_;
        if (budget_.used_.fetch_add(more) + more > budget_.most_) {
          budget_.used_ -= more;
          return false;
        }
      } else {
        budget_.used_ -= bytes_ - bytes;
      }
      bytes_ = bytes;
      return true;
    }

   private:
    MemoryBudget& budget_;
    std::uint64_t bytes_ = 0;
  };

  explicit MemoryBudget(std::uint64_t most_bytes) : most_(most_bytes) {}

  [[nodiscard]] std::uint64_t used_bytes() const { return used_; }
  [[nodiscard]] std::uint64_t most_bytes() const { return most_; }

 private:
  const std::uint64_t most_;
  std::atomic<std::uint64_t> used_{0};
};

}  // namespace trc::server
