#include "core/base/pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <memory>
#include <mutex>
#include <new>
#include <vector>

namespace trc {
namespace {

class SparePieces {
 public:
  // The last one to come, whose pages are most likely in a cache; null where there is none.
  [[nodiscard]] std::byte* take() {
    const std::lock_guard lock(mutex_);
    ++in_use_;
    if (spare_.empty()) return nullptr;
    std::byte* piece = spare_.back();
    spare_.pop_back();
    return piece;
  }
  // Whether it has been kept.
  [[nodiscard]] bool keep(std::byte* piece) {
    const std::lock_guard lock(mutex_);
    --in_use_;
    if (spare_.size() == PagePiece::most_spare) return false;
    spare_.push_back(piece);
    return true;
  }
  [[nodiscard]] std::vector<std::byte*> take_all() {
    const std::lock_guard lock(mutex_);
    return std::exchange(spare_, {});
  }
  [[nodiscard]] std::size_t in_use() {
    const std::lock_guard lock(mutex_);
    return in_use_;
  }

 private:
  std::mutex mutex_;
  std::vector<std::byte*> spare_;
  std::size_t in_use_ = 0;
};

// Never destroyed: what is, may let go of pieces later.
SparePieces& spare_pieces() {
  static auto* pieces = new SparePieces();
  return *pieces;
}

}  // namespace

PagePiece::PagePiece() : memory_(spare_pieces().take()) {
  if (memory_ != nullptr) return;
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  memory_ = static_cast<std::byte*>(memory);
}

PagePiece::~PagePiece() {
  if (memory_ != nullptr && !spare_pieces().keep(memory_)) munmap(memory_, bytes);
}

std::size_t PagePiece::count() { return spare_pieces().in_use(); }

// One by one: other threads get pages in between.
void PagePiece::give_back_spare() {
  for (std::byte* piece : spare_pieces().take_all()) munmap(piece, bytes);
}

void give_back_pages(void* memory, std::size_t bytes) {
  static const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* first = memory;
  if (std::align(page, page, first, bytes) == nullptr) return;
  // Where the system refuses, the heap keeps them.
  madvise(first, bytes / page * page, MADV_DONTNEED);
}

}  // namespace trc
