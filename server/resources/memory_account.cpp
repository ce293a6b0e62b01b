#include "server/resources/memory_account.h"

#include <malloc.h>

#include <cstddef>
#include <cstdlib>
#include <new>

#include "core/base/page_account.h"
#include "server/resources/heap_reserve.h"

namespace {

thread_local std::int64_t taken = 0;

}  // namespace

#if !defined(__SANITIZE_THREAD__)  // counts_heap

namespace {

void* counted(void* memory) noexcept {
  if (memory != nullptr) taken += static_cast<std::int64_t>(malloc_usable_size(memory));
  return memory;
}

void* take(std::size_t bytes) noexcept { return counted(std::malloc(bytes == 0 ? 1 : bytes)); }

void* take(std::size_t bytes, std::align_val_t alignment) noexcept {
  void* memory = nullptr;
  const auto boundary = static_cast<std::size_t>(alignment);
  return posix_memalign(&memory, boundary, bytes) == 0 ? counted(memory) : nullptr;
}

void give_back(void* memory) noexcept {
  if (memory == nullptr) return;
  taken -= static_cast<std::int64_t>(malloc_usable_size(memory));
  std::free(memory);
}

// Behaves as the standard requires when the heap is empty.
template <class Take>
void* take_or_throw(std::size_t bytes, Take take_once) {
  if (!trc::server::HeapReserve::lets_take(bytes)) throw std::bad_alloc();
  for (;;) {
    if (void* memory = take_once()) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

}  // namespace

// All operators are replaced: a checker that replaces some would mix its own with these.
void* operator new(std::size_t bytes) {
  return take_or_throw(bytes, [bytes] { return take(bytes); });
}
void* operator new[](std::size_t bytes) {
  return take_or_throw(bytes, [bytes] { return take(bytes); });
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return take_or_throw(bytes, [=] { return take(bytes, alignment); });
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return take_or_throw(bytes, [=] { return take(bytes, alignment); });
}
void* operator new(std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
  return take(bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
  return take(bytes);
}
void* operator new(std::size_t bytes, std::align_val_t alignment,
                   const std::nothrow_t& /*tag*/) noexcept {
  return take(bytes, alignment);
}
void* operator new[](std::size_t bytes, std::align_val_t alignment,
                     const std::nothrow_t& /*tag*/) noexcept {
  return take(bytes, alignment);
}

void operator delete(void* memory) noexcept { give_back(memory); }
void operator delete[](void* memory) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t /*bytes*/) noexcept { give_back(memory); }
void operator delete[](void* memory, std::size_t /*bytes*/) noexcept { give_back(memory); }
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept { give_back(memory); }
void operator delete[](void* memory, std::align_val_t /*alignment*/) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
  give_back(memory);
}
void operator delete[](void* memory, std::size_t /*bytes*/,
                       std::align_val_t /*alignment*/) noexcept {
  give_back(memory);
}
void operator delete(void* memory, const std::nothrow_t& /*tag*/) noexcept { give_back(memory); }
void operator delete[](void* memory, const std::nothrow_t& /*tag*/) noexcept { give_back(memory); }

#endif

namespace trc::server {

std::int64_t bytes_taken_by_thread() { return taken + page_bytes_of_thread(); }

}  // namespace trc::server
