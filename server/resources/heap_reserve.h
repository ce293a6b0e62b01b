#pragma once

namespace trc::server {

// Address space held back for the moment in which there is no more: gRPC ends the whole process
// where an allocation of its own fails. What first finds the heap empty frees the reserve. In a
// turn of a stream the allocation fails all the same, and the stream ends and gives back what it
// held; elsewhere it succeeds out of what the reserve has left free.
class HeapReserve {
 public:
  // Handler of allocations that fail (std::set_new_handler), for as long as the process lives.
  static void install();
  // Takes the reserve again where it was freed and there is room for it. Costs nothing resident.
  static void refill() noexcept;

  // A turn of a stream, in this thread.
  class Turn {
   public:
    Turn();
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
  };
};

}  // namespace trc::server
