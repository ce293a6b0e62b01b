#pragma once

#include <cstddef>

namespace trc::server {

// Address space held in reserve for the time when there is no more: gRPC ends the whole process
// when one of its allocations fails, or uses memory that it did not get. The first allocation
// that finds the heap empty frees the reserve. In a turn of a stream it fails all the same, and
// the stream ends and releases its memory; elsewhere it succeeds with the memory of the reserve.
// Until the reserve is whole again, turns only get tiny pieces, so that it is left to other
// threads.
class HeapReserve {
 public:
  // Handler of allocations that fail (std::set_new_handler), for as long as the process lives.
  static void install();
  // After a failed allocation: frees the reserve, or waits a little for memory from streams. False
  // when it makes no sense to try again: in a turn, and after a second.
  static bool make_room() noexcept;
  // Takes the reserve again where it was freed and there is room for it. False while there is none.
  // Costs nothing resident.
  static bool refill() noexcept;

  // A turn of a stream, or other work that may fail, in this thread.
  class Turn {
   public:
    Turn();
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
  };

  // Whether this thread may take so many bytes; `operator new` asks.
  [[nodiscard]] static bool lets_take(std::size_t bytes) noexcept;
};

}  // namespace trc::server
