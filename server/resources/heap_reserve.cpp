#include "server/resources/heap_reserve.h"

#include <sys/mman.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <new>
#include <thread>

#include "core/base/page_account.h"
#include "core/base/pages.h"

namespace trc::server {
namespace {

// Room for the stacks of some threads, of 8 MiB each; less where there is no room for it.
constexpr std::size_t most_bytes = 64U << 20U;
constexpr std::size_t least_bytes = 8U << 20U;
// What a turn may take while the reserve is not whole: strings, and messages about what went wrong.
constexpr std::size_t trifle_bytes = 4U << 10U;

// Pages that nobody writes to.
class Pages {
 public:
  Pages() = default;
  explicit Pages(std::size_t bytes) : bytes_(bytes) {
    void* memory = mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory != MAP_FAILED) memory_ = memory;
  }
  [[nodiscard]] bool are_there() const { return memory_ != nullptr; }
  void free() {
    if (are_there()) munmap(memory_, bytes_);
    memory_ = nullptr;
  }

 private:
  void* memory_ = nullptr;
  std::size_t bytes_ = 0;
};

std::atomic<bool> installed = false;
std::mutex mutex;
Pages reserve;
std::atomic<bool> used = false;
thread_local int turns = 0;

// A thread of gRPC or of the log would end the process. Streams are about to end and to give back
// what they hold (MemoryWatch), so it waits for that. False where that takes too long.
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
  // What make_room uses has to be there before.
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
    was_there = reserve.are_there();
    if (was_there) used = true;
    reserve.free();
  }
  PagePiece::give_back_spare();
  if (turns > 0) return false;
  return was_there || wait_for_memory();
}

bool HeapReserve::refill() noexcept {
  if (!installed) return true;
  const std::lock_guard lock(mutex);
  for (std::size_t bytes = most_bytes; !reserve.are_there() && bytes >= least_bytes; bytes /= 2)
    reserve = Pages(bytes);
  if (!reserve.are_there()) return !used;
  used = false;
  return true;
}

HeapReserve::Turn::Turn() { ++turns; }
HeapReserve::Turn::~Turn() { --turns; }

bool HeapReserve::lets_take(std::size_t bytes) noexcept {
  return bytes <= trifle_bytes || turns == 0 || !used.load(std::memory_order_relaxed);
}

}  // namespace trc::server
