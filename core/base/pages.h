#pragma once

#include <cstddef>
#include <utility>

namespace trc {

// Pages taken from the system, outside the heap, for data that grows large and is freed in pieces
// of this size. Up to `most_spare` freed pieces are kept for reuse by any thread: a new page takes
// the kernel a microsecond or two.
class PagePiece {
 public:
  static constexpr std::size_t bytes = 256 << 10U;
  static constexpr std::size_t most_spare = 1024;

  // Throws std::bad_alloc where there is no memory. The content is undefined.
  PagePiece();
  PagePiece(PagePiece&& other) noexcept : memory_(std::exchange(other.memory_, nullptr)) {}
  PagePiece& operator=(PagePiece&& other) noexcept {
    std::swap(memory_, other.memory_);
    return *this;
  }
  PagePiece(const PagePiece&) = delete;
  PagePiece& operator=(const PagePiece&) = delete;
  ~PagePiece();

  [[nodiscard]] std::byte* memory() const { return memory_; }

  // The pieces in use by all threads.
  [[nodiscard]] static std::size_t count();
  // Gives the spare pieces back to the system.
  static void give_back_spare();

 private:
  std::byte* memory_;
};

// Gives the pages that lie wholly in this memory back to the system; their content is lost. To be
// called before much memory is freed: the heap would give it back all at once, under a lock that
// every other thread waits for.
void give_back_pages(void* memory, std::size_t bytes);

}  // namespace trc
