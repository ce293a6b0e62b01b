// Preloaded into a process: its wall clock is off by as many seconds as the file named by
// SHIFTED_CLOCK says, eight bytes that may change at any time. The monotonic clock is left alone.
//
// Debian's libfaketime shifts what is read from the clock, but not the waits of Abseil until a time
// of it: gRPC's threads then spin, or wait for hours.

#include <dlfcn.h>
#include <fcntl.h>
#include <linux/futex.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cstdarg>
#include <cstdint>
#include <cstdlib>
#include <ctime>

namespace {

using Shift = std::atomic<std::int64_t>;

// No static variable here may be made by whoever comes first: others would wait for that by
// syscall(), which is one of these functions.

const Shift* mapped() {
  const char* path = std::getenv("SHIFTED_CLOCK");
  const int file = path == nullptr ? -1 : open(path, O_RDONLY | O_CLOEXEC);
  void* memory =
      file < 0 ? MAP_FAILED : mmap(nullptr, sizeof(std::int64_t), PROT_READ, MAP_SHARED, file, 0);
  if (file >= 0) close(file);
  return memory == MAP_FAILED ? nullptr : static_cast<const Shift*>(memory);
}

std::time_t shift() {
  static constinit std::atomic<const Shift*> seconds = nullptr;
  if (seconds.load() == nullptr) seconds.store(mapped());
  return seconds.load() == nullptr ? 0 : seconds.load()->load();
}

// The function that the one here stands before.
template <class Function>
class Next {
 public:
  explicit constexpr Next(const char* name) : name_(name) {}
  Function* operator*() {
    if (found_.load() == nullptr)
      found_.store(reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name_)));
    return found_.load();
  }

 private:
  const char* name_;
  std::atomic<Function*> found_ = nullptr;
};

// A time of the shifted clock as the kernel knows it. One of the monotonic clock is far from it.
timespec unshifted(timespec time) {
  constexpr std::time_t any_wall_clock = 1'000'000'000;
  if (time.tv_sec >= any_wall_clock) time.tv_sec -= shift();
  return time;
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* time) noexcept {
  static constinit Next<int(clockid_t, timespec*)> real("clock_gettime");
  const int result = (*real)(clock, time);
  if (result == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE))
    time->tv_sec += shift();
  return result;
}

int gettimeofday(timeval* time, void* zone) noexcept {
  static constinit Next<int(timeval*, void*)> real("gettimeofday");
  const int result = (*real)(time, zone);
  if (result == 0) time->tv_sec += shift();
  return result;
}

std::time_t time(std::time_t* seconds) noexcept {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  if (seconds != nullptr) *seconds = now.tv_sec;
  return now.tv_sec;
}

int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex,
                           const timespec* until) {
  static constinit Next<int(pthread_cond_t*, pthread_mutex_t*, const timespec*)> real(
      "pthread_cond_timedwait");
  const timespec time = unshifted(*until);
  return (*real)(condition, mutex, &time);
}

long syscall(long number, ...) noexcept {
  static constinit Next<long(long, ...)> real("syscall");
  va_list list;
  va_start(list, number);
  long arguments[6];
  for (long& argument : arguments) argument = va_arg(list, long);
  va_end(list);
  timespec time{};
  const bool waits_until = number == SYS_futex && (arguments[1] & FUTEX_CLOCK_REALTIME) != 0;
  if (waits_until && arguments[3] != 0) {
    time = unshifted(*reinterpret_cast<const timespec*>(arguments[3]));
    arguments[3] = reinterpret_cast<long>(&time);
  }
  return (*real)(number, arguments[0], arguments[1], arguments[2], arguments[3], arguments[4],
                 arguments[5]);
}

}  // extern "C"
