#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

namespace trc::load {

// Counts durations in buckets that are as wide as 1/1024 of what they hold, so that a percentile is
// told to three digits whatever its size, in memory that does not grow. From 1 ns to 18 minutes;
// what is longer counts as that.
class Histogram {
 public:
  using Duration = std::chrono::nanoseconds;

  Histogram() : counts_(bucket_of(longest) + 1) {}

  void add(Duration duration);
  void add(const Histogram& other);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  // The duration that a share of all, 0 … 1, does not exceed; 0 when there is none.
  [[nodiscard]] Duration at(double share) const;
  // Exactly.
  [[nodiscard]] Duration max() const { return max_; }

 private:
  static constexpr Duration longest{(std::int64_t{1} << 40U) - 1};

  static std::size_t bucket_of(Duration duration);
  static Duration upper_end_of(std::size_t bucket);

  std::vector<std::uint64_t> counts_;
  std::uint64_t count_ = 0;
  Duration max_{};
};

}  // namespace trc::load
