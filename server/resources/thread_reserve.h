#pragma once

#include <pthread.h>

#include <cstddef>

namespace trc::server {

// Threads made at the start, which wait for the moment in which the system gives no more: its
// limits of them (of a cgroup, pids.max, or of a user) are shared with whoever else is under them.
// gRPC 1.51 notes a thread down before it asks for it and gives it work whether or not it came
// about: streams would then wait for ever. So its threads, and those of other libraries, are taken
// from here where the system has none. Who can do without a thread says so.
class ThreadReserve {
 public:
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);

  // As many as gRPC may come to want after the start.
  [[nodiscard]] static std::size_t usual();
  // As many as all begin with together, at most.
  [[nodiscard]] static std::size_t at_start();
  // From now on so many threads are held ready, made by `create`; what is more ends. False where
  // the system does not give them.
  static bool install(std::size_t threads, Create create = pthread_create);
  // Makes those that were given away anew. False where the system does not give them.
  static bool refill() noexcept;
  // What pthread_create does, in a thread of the reserve, with a stack of the usual size. False
  // where none is left, and to who can do without: the first is remembered.
  static bool give(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
                   void* argument) noexcept;
  // Whether somebody went without a thread that he needed. Only a new start mends that.
  [[nodiscard]] static bool failed() noexcept;

  // What this thread asks for while it lives it can do without.
  class Dispensable {
   public:
    Dispensable();
    ~Dispensable();
    Dispensable(const Dispensable&) = delete;
    Dispensable& operator=(const Dispensable&) = delete;
  };
};

}  // namespace trc::server
