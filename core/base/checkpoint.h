#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>

namespace trc {

// A point that long work passes again and again, so that it can be interrupted: the end of a
// selection may release millions of blocks in one call.
class Checkpoint {
 public:
  // Called from time to time. It may take long, and may throw: that abandons the session, which may
  // then only be destroyed.
  using Interrupt = std::function<void()>;

  explicit Checkpoint(Interrupt interrupt) : interrupt_(std::move(interrupt)) {}
  Checkpoint(const Checkpoint&) = delete;
  Checkpoint& operator=(const Checkpoint&) = delete;

  // To be called for every block, or more often.
  void pass() {
    if (--left_ > 0) return;
    left_ = steps;
    if (interrupt_) interrupt_();
  }
  // For work on many things at once, with a few nanoseconds each.
  void pass_many(std::size_t things) {
    constexpr std::size_t things_of_step = 16;
    left_ -= static_cast<unsigned>(std::min<std::size_t>(things / things_of_step, left_ - 1));
    pass();
  }

 private:
  static constexpr unsigned steps = 256;  // far less than a millisecond

  Interrupt interrupt_;
  unsigned left_ = steps;
};

}  // namespace trc
