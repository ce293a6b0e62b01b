// Replaces the calls with which gRPC asks the system for memory and threads, in trcd. If malloc
// fails, gRPC 1.51 aborts or writes to address 0 (its read buffers); if a thread cannot be made,
// its work waits for ever. So these calls, for all libraries, try again when there is room, and use
// the reserve of threads.

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#include <dlfcn.h>
#include <pthread.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstddef>

#include "server/resources/heap_reserve.h"
#include "server/resources/thread_reserve.h"

using trc::server::HeapReserve;
using trc::server::ThreadReserve;

namespace {

// If there is room for a stack, the number of threads is the limit. Waiting would not help, and
// would hold up everybody the waiting thread works for.
bool has_room_for_stack() {
  constexpr std::size_t usual_bytes = 9U << 20U;
  void* const stack = mmap(nullptr, usual_bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (stack == MAP_FAILED) return false;
  munmap(stack, usual_bytes);
  return true;
}

}  // namespace

extern "C" {

// The heap functions of glibc under their other names.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
void* __libc_malloc(std::size_t bytes);
void* __libc_calloc(std::size_t count, std::size_t bytes);
void* __libc_realloc(void* memory, std::size_t bytes);
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

void* malloc(std::size_t bytes) noexcept {
  void* memory = nullptr;
  do memory = __libc_malloc(bytes);
  while (memory == nullptr && HeapReserve::make_room());
  return memory;
}

void* calloc(std::size_t count, std::size_t bytes) noexcept {
  void* memory = nullptr;
  do memory = __libc_calloc(count, bytes);
  while (memory == nullptr && HeapReserve::make_room());
  return memory;
}

void* realloc(void* old, std::size_t bytes) noexcept {
  void* memory = nullptr;
  do memory = __libc_realloc(old, bytes);
  while (memory == nullptr && bytes > 0 && HeapReserve::make_room());
  return memory;
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
                   void* argument) noexcept {
  static const auto create =
      reinterpret_cast<decltype(&pthread_create)>(dlsym(RTLD_NEXT, "pthread_create"));
  int fault = 0;
  do fault = create(thread, attributes, run, argument);
  while (fault == EAGAIN && !has_room_for_stack() && HeapReserve::make_room());
  const bool given = fault == EAGAIN && ThreadReserve::give(thread, attributes, run, argument);
  return given ? 0 : fault;
}

}  // extern "C"

#endif
