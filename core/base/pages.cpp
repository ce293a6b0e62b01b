#include "core/base/pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <new>
#include <vector>

#include "core/base/page_account.h"

namespace trc {
namespace {

std::atomic<bool (*)()> may_take = nullptr;

std::byte* map_piece() {
  for (;;) {
    void* memory =
        mmap(nullptr, PagePiece::bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory != MAP_FAILED) return static_cast<std::byte*>(memory);
    // As `operator new` does.
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

thread_local std::int64_t of_thread = 0;  // pieces taken, less those given back

class Pieces {
 public:
  // Reserves room for all spare pieces: giving a piece back must not fail.
  Pieces() { spare_.reserve(PagePiece::most_spare); }

  [[nodiscard]] std::byte* take() {
    bool (*const asked)() = may_take.load(std::memory_order_relaxed);
    if (asked != nullptr && !asked()) throw std::bad_alloc();
    std::byte* piece = take_spare();
    if (piece == nullptr) piece = map_piece();
    ++in_use_;
    ++of_thread;
    return piece;
  }
  void give_back(std::byte* piece) {
    --in_use_;
    --of_thread;
    if (!keep(piece)) munmap(piece, PagePiece::bytes);
  }
  // One by one, so that other threads get pages in between.
  void give_back_spare() {
    while (std::byte* piece = take_spare()) munmap(piece, PagePiece::bytes);
  }
  [[nodiscard]] std::size_t in_use() const { return in_use_; }

 private:
  // The piece given back last, whose pages are most likely in a cache; null if none is spare.
  [[nodiscard]] std::byte* take_spare() {
    const std::lock_guard lock(mutex_);
    if (spare_.empty()) return nullptr;
    std::byte* piece = spare_.back();
    spare_.pop_back();
    return piece;
  }
  [[nodiscard]] bool keep(std::byte* piece) {
    const std::lock_guard lock(mutex_);
    if (spare_.size() == PagePiece::most_spare) return false;
    spare_.push_back(piece);
    return true;
  }

  std::mutex mutex_;
  std::vector<std::byte*> spare_;
  std::atomic<std::size_t> in_use_ = 0;
};

// Never destroyed: objects that are destroyed at exit may still give pieces back.
Pieces& pieces() {
  static auto* all = new Pieces();
  return *all;
}

}  // namespace

PagePiece::PagePiece() : memory_(pieces().take()) {}
PagePiece::~PagePiece() {
  if (memory_ != nullptr) pieces().give_back(memory_);
}

std::size_t PagePiece::count() { return pieces().in_use(); }
void PagePiece::give_back_spare() { pieces().give_back_spare(); }

std::int64_t page_bytes_of_thread() {
  return of_thread * static_cast<std::int64_t>(PagePiece::bytes);
}

void let_pages_ask(bool (*asked)()) { may_take = asked; }

void give_back_pages(void* memory, std::size_t bytes) {
  static const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* first = memory;
  if (std::align(page, page, first, bytes) == nullptr) return;
  // If the system refuses, the heap keeps the pages.
  madvise(first, bytes / page * page, MADV_DONTNEED);
}

}  // namespace trc
