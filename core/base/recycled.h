#pragma once

#include <array>
#include <cstddef>
#include <new>

namespace trc {

// Storage for objects of `Size` bytes that come and go all the time: that of the last few
// that went serves the next ones, so that a stream in its steady state does not allocate.
// For the operators new and delete of a class.
template <std::size_t Size>
class Recycled {
 public:
  [[nodiscard]] static void* take() {
    Store& store = kept();
    return store.count > 0 ? store.places[--store.count] : ::operator new(Size);
  }
  static void give_back(void* place) noexcept {
    Store& store = kept();
    if (store.count < store.places.size()) {
      store.places[store.count++] = place;
    } else {
      ::operator delete(place);
    }
  }

 private:
  // Of one thread. Streams wander between threads; what one has too many another has too few.
  struct Store {
    Store() = default;
    Store(const Store&) = delete;
    Store& operator=(const Store&) = delete;
    ~Store() {
      while (count > 0) ::operator delete(places[--count]);
    }
    std::array<void*, 64> places{};
    std::size_t count = 0;
  };
  static Store& kept() {
    thread_local Store store;
    return store;
  }
};

}  // namespace trc
