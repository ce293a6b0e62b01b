#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace trc::server {

// The bytes that streams may hold: those of one peer, or all of them.
class MemoryBudget {
 public:
  explicit MemoryBudget(std::uint64_t most_bytes) : most_(most_bytes) {}
  MemoryBudget(const MemoryBudget&) = delete;
  MemoryBudget& operator=(const MemoryBudget&) = delete;

  // The state of a stream that has grown.
  enum class Standing {
    good,
    all_full,   // together with others; waiting helps
    peer_full,  // together with those of its peer; waiting helps
    alone,      // it alone exceeds the limit of its peer, or of all together
  };

  // The share of one stream; given back when it is destroyed.
  class Share {
   public:
    Share(MemoryBudget& all, MemoryBudget& peer) : all_(all), peer_(peer) {}
    ~Share() { release(); }
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;

    // The stream holds so many bytes, taken already: if they are too many, it has to end, but only
    // when it has grown; a small stream never has to, since the others are the cause.
    Standing hold(std::uint64_t bytes) {
      const std::uint64_t before = bytes_;
      bytes_ = bytes;
      all_.used_ += bytes - before;
      peer_.used_ += bytes - before;
      if (bytes <= before || bytes <= all_.spared()) return Standing::good;
      if (bytes > all_.most_ || bytes > peer_.most_) return Standing::alone;
      if (all_.used_ > all_.most_) return Standing::all_full;
      return peer_.used_ > peer_.most_ ? Standing::peer_full : Standing::good;
    }
    // From here on its memory does not count: it is about to be freed.
    void release() { hold(0); }

    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

   private:
    MemoryBudget& all_;
    MemoryBudget& peer_;
    std::atomic<std::uint64_t> bytes_ = 0;
  };

  [[nodiscard]] std::uint64_t used_bytes() const { return used_; }
  [[nodiscard]] std::uint64_t most_bytes() const { return most_; }

 private:
  // The bytes that a stream may always hold.
  [[nodiscard]] std::uint64_t spared() const {
    constexpr std::uint64_t few = 1U << 20U;
    return std::min(few, most_ / 64);
  }

  const std::uint64_t most_;
  std::atomic<std::uint64_t> used_{0};
};

}  // namespace trc::server
