#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

namespace trc::support {

// Random numbers that are the same with every standard library: only the engine
// of <random> is specified bit by bit, its distributions are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  // Uniform in [low, high).
  double between(double low, double high) {
    const double unit = static_cast<double>(engine_() >> 11U) * 0x1p-53;
    return low + (high - low) * unit;
  }

  // Uniform in 0 … count - 1.
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(between(0, static_cast<double>(count)));
  }

  bool chance(double probability) { return between(0, 1) < probability; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace trc::support
