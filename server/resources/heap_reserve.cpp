#include "server/resources/heap_reserve.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace trc::server {
namespace {

// Above the threshold from which the heap maps memory of its own: what is freed is free at once.
constexpr std::size_t reserve_bytes = 16U << 20U;

std::atomic<void*> reserve = nullptr;
thread_local int turns = 0;

void free_reserve() {
  void* const held = reserve.exchange(nullptr);
  std::free(held);
  if (held == nullptr || turns > 0) throw std::bad_alloc();
}

}  // namespace

void HeapReserve::install() {
  refill();
  std::set_new_handler(free_reserve);
}

void HeapReserve::refill() noexcept {
  if (reserve.load() != nullptr) return;
  void* const taken = std::malloc(reserve_bytes);
  void* none = nullptr;
  if (!reserve.compare_exchange_strong(none, taken)) std::free(taken);
}

HeapReserve::Turn::Turn() { ++turns; }
HeapReserve::Turn::~Turn() { --turns; }

}  // namespace trc::server
