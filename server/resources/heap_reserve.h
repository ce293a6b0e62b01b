#pragma once

#include <cstddef>

namespace trc::server {

// Address space held back for the moment in which there is no more: gRPC ends the whole process
// where an allocation of its own fails, or uses what it did not get. What first finds the heap
// empty frees the reserve. In a turn of a stream the allocation fails all the same, and the stream
// ends and gives back what it held; elsewhere it succeeds out of what the reserve has left free.
// Until the reserve is whole again no turn gets more than trifles, so that it is left to the
// others.
class HeapReserve {
 public:
  // Handler of allocations that fail (std::set_new_handler), for as long as the process lives.
  static void install();
  // Where nothing more was to be had: frees the reserve, or waits a little for what streams give
  // back. False when there is no sense in trying again: in a turn, and after a second.
  static bool make_room() noexcept;
  // Takes the reserve again where it was freed and there is room for it. False while there is none.
  // Costs nothing resident.
  static bool refill() noexcept;

  // A turn of a stream, or what else may fail, in this thread.
  class Turn {
   public:
    Turn();
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
  };

  // Whether this thread may take so many bytes; asked by `operator new`.
  [[nodiscard]] static bool lets_take(std::size_t bytes) noexcept;
};

}  // namespace trc::server
