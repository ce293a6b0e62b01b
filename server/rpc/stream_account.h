#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "server/backend.h"
#include "server/resources/heap_reserve.h"
#include "server/resources/memory_account.h"
#include "server/resources/memory_budget.h"
#include "server/resources/peers.h"
#include "server/rpc/status.h"

namespace trc::server {

// Thrown out of work that passes a limit: the stream ends with it.
struct Refused {
  Ending ending;
};

// What one stream takes, memory and computing time, and the limits of both.
class StreamAccount {
 public:
  StreamAccount(Backend& backend, Peer& peer);

  // A turn, in the thread that takes it: what it takes is the stream's.
  class Turn {
   public:
    explicit Turn(StreamAccount& account);
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    StreamAccount& account_;
    MemoryAccount::Turn memory_;
    HeapReserve::Turn reserve_;
  };

  // To be called in a turn, again and again where much may be taken. Throws Refused.
  void check();
  // Whether some milliseconds have gone by since the last time; costs next to nothing.
  [[nodiscard]] bool is_due();
  // Something has come out: the time of a selection counts from here.
  void progressed() { since_progress_ = {}; }
  // How much of its path has been measured.
  struct Measuring {
    std::uint64_t blocks = 0;
    std::uint64_t all = 0;
    [[nodiscard]] bool goes_on() const { return blocks < all; }
  };
  void measures(const Measuring& measuring) {
    measured_blocks_.store(measuring.blocks, std::memory_order_relaxed);
    blocks_to_measure_.store(measuring.all, std::memory_order_relaxed);
  }
  // From any thread: for people, not exact.
  [[nodiscard]] Measuring measuring() const {
    return {.blocks = measured_blocks_.load(std::memory_order_relaxed),
            .all = blocks_to_measure_.load(std::memory_order_relaxed)};
  }
  // Bytes of the answer that waits for its reader.
  void answers(std::size_t bytes) { answer_bytes_ = bytes; }

  // The stream is to end where its turn passes by next. From any thread; the last reason counts.
  void end_with(Refusal why) { ends_with_ = why; }
  [[nodiscard]] std::uint64_t held_bytes() const { return share_.bytes(); }
  // Counts as nothing from here on: what it holds is about to be freed.
  void close();

 private:
  void note_time();
  // Throws when the stream has grown too large.
  void check_memory();

  Backend& backend_;
  MemoryAccount memory_;
  MemoryBudget::Share share_;
  std::size_t answer_bytes_ = 0;
  std::chrono::nanoseconds mark_{};  // thread time up to which it is noted
  std::chrono::nanoseconds since_progress_{};
  std::chrono::nanoseconds in_all_{};
  long tick_ = 0;
  std::atomic<std::optional<Refusal>> ends_with_{};
  std::atomic<std::uint64_t> measured_blocks_ = 0;
  std::atomic<std::uint64_t> blocks_to_measure_ = 0;
  bool closed_ = false;
};

}  // namespace trc::server
