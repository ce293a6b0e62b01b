#pragma once

#include <stdexcept>
#include <string>

namespace trc {

// A promise of the core was broken: a bug, not a fault in the program. The edge
// catches it, ends that one session and says so.
class BrokenInvariant : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

inline void check(bool holds, const char* promise) {
  if (!holds) throw BrokenInvariant(promise);
}

}  // namespace trc
