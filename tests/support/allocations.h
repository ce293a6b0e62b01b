#pragma once

#include <cstddef>

// Linked with allocations.cpp, which replaces the allocation functions, a program counts what it
// takes from the heap. The sanitizers replace them too: the two exclude each other.

namespace trc::support {

// How often this program has taken memory from the heap.
[[nodiscard]] std::size_t allocations();

}  // namespace trc::support
