#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace trc::fuzz {

// Reads choices from the bytes of a fuzzer, in order. Past the end every choice is 0, so that any
// bytes mean something and a cut-off input means nearly the same as the whole.
class Choices {
 public:
  explicit Choices(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  [[nodiscard]] bool used_up() const { return bytes_.empty(); }

  unsigned byte() {
    if (bytes_.empty()) return 0;
    const unsigned first = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return first;
  }
  bool flag() { return (byte() & 1U) != 0; }
  // 0 … count - 1.
  unsigned below(unsigned count) { return byte() % count; }

  template <class T, std::size_t n>
  const T& of(const std::array<T, n>& values) {
    return values[byte() % n];
  }

  // Whole numbers and quarters that meet each other, such numbers and a hair, or anything.
  double number() {
    const unsigned first = byte();
    const double whole = static_cast<double>(first % 64) - 32;
    switch (first / 64) {
      case 0:
        return whole;
      case 1:
        return whole / 4;
      case 2: {
        const unsigned second = byte();
        const double hair = std::pow(10.0, -1.0 - second % 16);
        return whole + (second < 128 ? hair : -hair);
      }
      default:
        break;
    }
    const auto ten_thousandths = static_cast<std::int16_t>(byte() << 8U | byte());
    return ten_thousandths * std::pow(10.0, static_cast<double>(first % 8) - 4);
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace trc::fuzz
