#include "core/base/pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <memory>

namespace trc {

void give_back_pages(void* memory, std::size_t bytes) {
  static const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* first = memory;
  if (std::align(page, page, first, bytes) == nullptr) return;
  // Where the system refuses, the heap keeps them.
  madvise(first, bytes / page * page, MADV_DONTNEED);
}

}  // namespace trc
