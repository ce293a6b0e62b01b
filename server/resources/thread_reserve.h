#pragma once

#include <pthread.h>

#include <cstddef>

namespace trc::server {

// Threads made at the start and kept for the time when the system gives no more: its limits
// (pids.max of a cgroup, or that of a user) are shared with other processes. gRPC 1.51 registers a
// thread before it creates it and gives it work even if the creation failed: streams would then
// wait forever. So its threads, and those of other libraries, are taken from here when the system
// has none. Code that can do without a thread says so by Dispensable.
class ThreadReserve {
 public:
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);

  // The number that gRPC may want after the start.
  [[nodiscard]] static std::size_t usual();
  // The largest number that all libraries begin with together.
  [[nodiscard]] static std::size_t at_start();
  // From now on keeps so many threads ready, made by `create`; surplus ones end. False where the
  // system does not give them.
  static bool install(std::size_t threads, Create create = pthread_create);
  // Makes new ones for those given away. False where the system does not give them.
  static bool refill() noexcept;
  // As pthread_create, with a thread of the reserve and a stack of the usual size. False where none
  // is left, which is remembered, and for callers that can do without.
  static bool give(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
                   void* argument) noexcept;
  // Whether a thread that was needed could not be given. Only a restart repairs that.
  [[nodiscard]] static bool failed() noexcept;

  // While it lives, this thread can do without the threads that it asks for.
  class Dispensable {
   public:
    Dispensable();
    ~Dispensable();
    Dispensable(const Dispensable&) = delete;
    Dispensable& operator=(const Dispensable&) = delete;
  };
};

}  // namespace trc::server
