// Preloaded into a process: a disk that takes whatever is written, and says only when it is asked
// to have it that there is no room, as a network, a quota or a thin volume does.

#include <unistd.h>

#include <cerrno>

extern "C" {

int fsync(int /*file*/) {
  errno = ENOSPC;
  return -1;
}

int syncfs(int /*file*/) noexcept {
  errno = ENOSPC;
  return -1;
}

}  // extern "C"
