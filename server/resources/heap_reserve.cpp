#include "server/resources/heap_reserve.h"

#include <sys/mman.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <new>
#include <thread>

#include "core/base/page_account.h"
#include "core/base/pages.h"

namespace trc::server {
namespace {

// Room for the stacks of a few threads, 8 MiB each; less if there is not enough room.
constexpr std::size_t most_bytes = 64U << 20U;
constexpr std::size_t least_bytes = 8U << 20U;
// The most that a turn may take while the reserve is not whole: strings and error messages.
constexpr std::size_t trifle_bytes = 4U << 10U;

// Reserved memory that is never written to.
class Room {
 public:
  // Pages of the system, which stacks can use as well.
  static Room of_pages(std::size_t bytes) {
    void* memory = mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return memory == MAP_FAILED ? Room() : Room(memory, bytes);
  }
  // Free memory of the heap. A small block at the end of the heap can keep it from giving back any
  // address space.
  static Room of_heap(std::size_t bytes) { return {std::malloc(bytes), 0}; }

  Room() = default;
  [[nodiscard]] bool is_there() const { return memory_ != nullptr; }
  void free() {
    if (bytes_of_pages_ > 0)
      munmap(memory_, bytes_of_pages_);
    else
      std::free(memory_);
    *this = Room();
  }

 private:
  Room(void* memory, std::size_t bytes_of_pages)
      : memory_(memory), bytes_of_pages_(bytes_of_pages) {}

  void* memory_ = nullptr;
  std::size_t bytes_of_pages_ = 0;
};

Room take_room() {
  // In a turn an allocation fails at once if there is no room.
  const HeapReserve::Turn turn;
  for (const auto take : {&Room::of_pages, &Room::of_heap}) {
    for (std::size_t bytes = most_bytes; bytes >= least_bytes; bytes /= 2) {
      const Room room = take(bytes);
      if (room.is_there()) return room;
    }
  }
  return {};
}

std::atomic<bool> installed = false;
std::mutex mutex;
Room reserve;
std::atomic<bool> used = false;
thread_local int turns = 0;

bool is_whole() {
  const std::lock_guard lock(mutex);
  return reserve.is_there();
}

// Without memory a thread of gRPC or of the log would end the process. Streams are about to end and
// to free their memory (MemoryWatch), so the thread waits. False after too long a wait.
bool wait_for_memory() {
  using Clock = std::chrono::steady_clock;
  constexpr auto step = std::chrono::milliseconds(5);
  constexpr auto longest = std::chrono::seconds(1);
  thread_local Clock::time_point since;
  thread_local Clock::time_point last;
  const auto now = Clock::now();
  if (now - last > 20 * step) since = now;
  if (now - since > longest) return false;
  std::this_thread::sleep_for(step);
  last = Clock::now();
  return true;
}

}  // namespace

void HeapReserve::install() {
  // Creates the statics that make_room uses.
  PagePiece::give_back_spare();
  installed = true;
  refill();
  std::set_new_handler([] {
    if (!make_room()) throw std::bad_alloc();
  });
  let_pages_ask([] { return lets_take(PagePiece::bytes); });
}

bool HeapReserve::make_room() noexcept {
  if (!installed) return false;
  bool was_there = false;
  {
    const std::lock_guard lock(mutex);
    was_there = reserve.is_there();
    if (was_there) used = true;
    reserve.free();
  }
  PagePiece::give_back_spare();
  if (turns > 0) return false;
  return was_there || wait_for_memory();
}

bool HeapReserve::refill() noexcept {
  if (!installed || is_whole()) return true;
  // Outside the lock: an empty heap asks for the reserve.
  Room room = take_room();
  const std::lock_guard lock(mutex);
  if (!room.is_there()) return !used;
  reserve = room;
  used = false;
  return true;
}

HeapReserve::Turn::Turn() { ++turns; }
HeapReserve::Turn::~Turn() { --turns; }

bool HeapReserve::lets_take(std::size_t bytes) noexcept {
  return bytes <= trifle_bytes || turns == 0 || !used.load(std::memory_order_relaxed);
}

}  // namespace trc::server
