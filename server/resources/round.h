#pragma once

#include <new>

namespace trc::server {

// A round of a thread that serves all streams. Where there is no memory for it just now the next
// one does its work: a thread that ended by an exception would end the process.
template <class Work>
void do_round(const Work& work) {
  try {
    work();
  } catch (const std::bad_alloc&) {
    return;
  }
}

}  // namespace trc::server
