#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

namespace trc::load {

// When streams are meant to begin, fixed before the run: what the server does cannot move it. The
// rate grows from nothing to its full height during the ramp.
class Schedule {
 public:
  using Duration = std::chrono::nanoseconds;

  // `rate`: streams a second.
  Schedule(double rate, Duration ramp) : rate_(rate), ramp_(seconds(ramp)) {}

  // From the start of the run to the start of a stream, counted from 0.
  [[nodiscard]] Duration begin_of(std::uint64_t stream) const {
    const auto number = static_cast<double>(stream);
    const double in_ramp = rate_ * ramp_ / 2;
    const double at = number < in_ramp ? std::sqrt(2 * ramp_ * number / rate_)
                                       : ramp_ + (number - in_ramp) / rate_;
    return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(at));
  }

 private:
  static double seconds(Duration duration) {
    return std::chrono::duration<double>(duration).count();
  }

  double rate_;
  double ramp_;  // s
};

// Whether the stream of this number belongs to a share of all, spread evenly: of any N streams in a
// row the share is taken, to one. A share above 0 takes the first.
[[nodiscard]] inline bool is_sampled(std::uint64_t stream, double share) {
  const auto number = static_cast<double>(stream);
  return std::ceil((number + 1) * share) > std::ceil(number * share);
}

}  // namespace trc::load
