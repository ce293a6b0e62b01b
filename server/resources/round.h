#pragma once

#include <new>

namespace trc::server {

// A round of a thread that serves all streams. If there is no memory for it, its work is left to
// the next round: an exception that ended the thread would end the process.
template <class Work>
void do_round(const Work& work) {
  try {
    work();
  } catch (const std::bad_alloc&) {
    return;
  }
}

}  // namespace trc::server
