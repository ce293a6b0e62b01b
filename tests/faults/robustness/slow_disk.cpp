// Preloaded into a process: a disk on which everything that goes to a file takes as many
// milliseconds as SLOW_DISK_MS says.

#include <dlfcn.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace {

void wait() {
  const char* told = std::getenv("SLOW_DISK_MS");
  const long milliseconds = told == nullptr ? 0 : std::atol(told);
  const timespec pause{.tv_sec = milliseconds / 1000, .tv_nsec = milliseconds % 1000 * 1'000'000};
  nanosleep(&pause, nullptr);
}

void wait_for(int file) {
  struct stat status {};
  if (fstat(file, &status) == 0 && S_ISREG(status.st_mode)) wait();
}

// The function that the one here stands before.
template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* bytes, std::size_t count) {
  wait_for(file);
  return next<ssize_t(int, const void*, std::size_t)>("write")(file, bytes, count);
}

ssize_t writev(int file, const iovec* parts, int count) {
  wait_for(file);
  return next<ssize_t(int, const iovec*, int)>("writev")(file, parts, count);
}

int fsync(int file) {
  wait_for(file);
  return next<int(int)>("fsync")(file);
}

int rename(const char* from, const char* to) noexcept {
  wait();
  return next<int(const char*, const char*)>("rename")(from, to);
}

}  // extern "C"
