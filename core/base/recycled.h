#pragma once

#include <array>
#include <cstddef>
#include <new>

namespace trc {

// Storage for objects of `Size` bytes that are created and destroyed all the time: the storage of
// the last few destroyed ones is used again, so that a stream in its steady state does not
// allocate. For the operators new and delete of a class.
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
  // The store of one thread. Streams move between threads: one store may fill, another run empty.
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
