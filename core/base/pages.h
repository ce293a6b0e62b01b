#pragma once

#include <cstddef>

namespace trc {

// Gives the pages that lie wholly in this memory back to the system; what was in them is lost. To
// be called before much memory is freed: the heap would give it back all at once, under
// a lock for which every other thread waits.
void give_back_pages(void* memory, std::size_t bytes);

}  // namespace trc
