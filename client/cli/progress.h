#pragma once

#include <chrono>
#include <cstdint>

namespace trc::cli {

// A line on the terminal that says how far the work is, once it takes longer
// than a second. Nothing when standard error is no terminal, when the result
// itself is printed there, or when nothing but errors is wanted.
class Progress {
 public:
  explicit Progress(bool result_on_screen, bool quiet = false);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(std::uint64_t bytes_read);
  // Takes the line away, so that another can be written.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool enabled_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_ + std::chrono::seconds(1);
};

}  // namespace trc::cli
