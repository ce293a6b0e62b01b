#include "client/load/histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace trc::load {
namespace {

// Each duration below 2^fine_bits ns has its own bucket; above, each doubling has half as many.
constexpr unsigned fine_bits = 11;
constexpr std::uint64_t per_doubling = std::uint64_t{1} << (fine_bits - 1);

}  // namespace

std::size_t Histogram::bucket_of(Duration duration) {
  const auto value = static_cast<std::uint64_t>(duration.count());
  const unsigned width = static_cast<unsigned>(std::bit_width(value));
  if (width <= fine_bits) return value;
  const unsigned shift = width - fine_bits;
  return shift * per_doubling + (value >> shift);
}

Histogram::Duration Histogram::upper_end_of(std::size_t bucket) {
  if (bucket < 2 * per_doubling) return Duration(bucket);
  const std::size_t shift = bucket / per_doubling - 1;
  const std::uint64_t first = (bucket - shift * per_doubling) << shift;
  return Duration(first + (std::uint64_t{1} << shift) - 1);
}

void Histogram::add(Duration duration) {
  const Duration held = std::clamp(duration, Duration::zero(), longest);
  ++counts_[bucket_of(held)];
  ++count_;
  max_ = std::max(max_, duration);
}

void Histogram::add(const Histogram& other) {
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
  count_ += other.count_;
  max_ = std::max(max_, other.max_);
}

Histogram::Duration Histogram::at(double share) const {
  const double wanted = std::ceil(share * static_cast<double>(count_));
  const auto rank = static_cast<std::uint64_t>(std::max(wanted, 1.0));
  std::uint64_t below = 0;
  for (std::size_t bucket = 0; bucket < counts_.size(); ++bucket) {
    below += counts_[bucket];
    if (below >= rank) return std::min(upper_end_of(bucket), max_);
  }
  return max_;
}

}  // namespace trc::load
