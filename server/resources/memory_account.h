#pragma once

#include <atomic>
#include <cstdint>

namespace trc::server {

// Whether the heap is counted. ThreadSanitizer has operators of its own, which know the
// calling library: they ignore memory that gRPC, built without it, passes between threads and
// frees.
#if defined(__SANITIZE_THREAD__)
inline constexpr bool counts_heap = false;
#else
inline constexpr bool counts_heap = true;
#endif

// The bytes of the heap, and of pages outside it, that this thread has taken and not given back;
// negative when it has given back memory taken by others. `operator new` counts them.
[[nodiscard]] std::int64_t bytes_taken_by_thread();

// The memory of one stream, measured where it is taken: all that a turn takes and does not give
// back belongs to the stream, be it blocks, text, diagnostics, a verification or a parsed message.
class MemoryAccount {
 public:
  // A turn of the stream, in this thread. Turns of one account do not overlap.
  class Turn {
   public:
    explicit Turn(MemoryAccount& account) : account_(account) {
      account_.mark_ = bytes_taken_by_thread();
    }
    ~Turn() { account_.settle(); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    MemoryAccount& account_;
  };

  // In a turn: accounts for memory taken and given back since the last call.
  void settle() {
    const std::int64_t now = bytes_taken_by_thread();
    bytes_ += now - mark_;
    mark_ = now;
  }

  // In a turn: what was taken and given back since the last call belongs to somebody else.
  void leave_out() { mark_ = bytes_taken_by_thread(); }

  // A turn may free a little memory that was taken outside of turns.
  [[nodiscard]] std::uint64_t bytes() const {
    return bytes_ > 0 ? static_cast<std::uint64_t>(bytes_) : 0;
  }

 private:
  std::int64_t bytes_ = 0;
  std::int64_t mark_ = 0;
};

}  // namespace trc::server
