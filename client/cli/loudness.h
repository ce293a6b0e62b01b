#pragma once

namespace trc::cli {

// How much is told on standard error beside errors.
struct Loudness {
  bool quiet = false;    // -q: errors alone
  bool verbose = false;  // -v: what was taken, and times
};

}  // namespace trc::cli
