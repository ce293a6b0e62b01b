#pragma once

#include <cstddef>
#include <functional>
#include <new>
#include <utility>

#include "server/http/memory.h"
#include "server/resources/heap_reserve.h"
#include "server/resources/memory_account.h"

namespace trc::server::http {

// Thrown out of work for a view that finds its share used up.
struct NoMemory : std::bad_alloc {
  [[nodiscard]] const char* what() const noexcept override { return "a view finds no memory"; }
};

// The memory of a view and of the work for it: what the heap gave in their turns, charged to a
// Share as it is taken.
class ViewMemory {
 public:
  // Frees memory that matters less; false: there is none.
  using MakeRoom = std::function<bool()>;

  explicit ViewMemory(Memory& memory) : share_(memory) {}
  ViewMemory(const ViewMemory&) = delete;
  ViewMemory& operator=(const ViewMemory&) = delete;

  // Work in this thread: what it takes and does not give back counts. Turns do not overlap. Where
  // the heap has nothing left, they fail instead of using up its reserve.
  class Turn {
   public:
    Turn(ViewMemory& memory, const MakeRoom& make_room)
        : memory_(memory), make_room_(make_room), account_(memory.account_) {}
    ~Turn() { static_cast<void>(memory_.hold(0)); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

    // Charges what was taken, with so many bytes that are about to be. False: there is no room.
    [[nodiscard]] bool has_room(std::size_t more = 0) {
      while (!memory_.hold(more)) {
        const bool has_made_room = make_room_ && make_room_();
        memory_.account_.leave_out();
        if (!has_made_room) return false;
      }
      return true;
    }
    // The same for work that is left where there is none.
    void check(std::size_t more = 0) {
      if (!has_room(more)) throw NoMemory{};
    }

   private:
    ViewMemory& memory_;
    const MakeRoom& make_room_;
    MemoryAccount::Turn account_;
    HeapReserve::Turn reserve_;
  };

  // Counts memory that was not taken in a turn and goes with the view.
  void add(std::size_t bytes) { from_elsewhere_ += bytes; }
  [[nodiscard]] std::size_t bytes() const { return account_.bytes() + from_elsewhere_; }

 private:
  bool hold(std::size_t more) {
    account_.settle();
    return share_.hold(bytes() + more);
  }

  MemoryAccount account_;
  Share share_;
  std::size_t from_elsewhere_ = 0;
};

}  // namespace trc::server::http
