#include "client/cli/progress.h"

#include <unistd.h>

#include <cstdio>

namespace trc::cli {

Progress::Progress(bool result_on_screen, bool quiet)
    : enabled_(!quiet && isatty(STDERR_FILENO) == 1 &&
               !(result_on_screen && isatty(STDOUT_FILENO) == 1)) {}

void Progress::update(std::uint64_t bytes_read) {
  if (!enabled_) return;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(200);
  shown_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::fprintf(stderr, "\r%.1f MB read, %.0f s\x1b[K", static_cast<double>(bytes_read) / 1e6,
               seconds);
  std::fflush(stderr);
}

void Progress::clear() {
  if (!shown_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace trc::cli
