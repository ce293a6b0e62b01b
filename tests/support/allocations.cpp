#include "tests/support/allocations.h"

#include <cstdlib>
#include <new>

namespace {

std::size_t counted = 0;

}  // namespace

void* operator new(std::size_t size) {
  ++counted;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace trc::support {

std::size_t allocations() { return counted; }

}  // namespace trc::support
