#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/pages.h"

namespace trc {

// A sequence that grows at its end and is dropped from its start. Elements keep their number and
// their place in memory as long as they exist. It takes little more memory than its elements: it is
// never copied to grow, and a window over an endless stream needs memory for the window only. A
// queue that has been moved from may only be assigned to or destroyed. `chunk_size`: the number of
// elements that memory is taken for at once; small where there are seldom many of them.
template <class T, std::size_t chunk_size = 256>
class NumberedQueue {
 public:
  // The first element will have the number `first`.
  explicit NumberedQueue(std::size_t first = 0) : begin_(first), end_(first) {}

  // Numbers, not places: those of the elements are begin() <= number < end().
  [[nodiscard]] std::size_t begin() const { return begin_; }
  [[nodiscard]] std::size_t end() const { return end_; }
  [[nodiscard]] std::size_t size() const { return end_ - begin_; }
  [[nodiscard]] bool empty() const { return begin_ == end_; }

  [[nodiscard]] T& operator[](std::size_t number) {
    return chunks_[number / chunk_size - first_chunk_][number % chunk_size];
  }
  [[nodiscard]] const T& operator[](std::size_t number) const {
    return chunks_[number / chunk_size - first_chunk_][number % chunk_size];
  }
  [[nodiscard]] T& back() { return place_[-1]; }
  [[nodiscard]] const T& back() const { return place_[-1]; }

  [[gnu::always_inline]] T& push_back(T element) {
    return push_made([&] { return std::move(element); });
  }
  // Appends the result of make(), constructed in place.
  template <class Make>
  [[gnu::always_inline]] T& push_made(Make make) {
    if (place_ == end_of_chunk_) begin_chunk();
    ++end_;
    if constexpr (is_plain) return *::new (place_++) T(make());
    return *place_++ = make();
  }

  // Reads elements one after the other, which is faster than looking up each. References stay valid
  // until the queue is changed.
  class Reader {
   public:
    // Starts reading at the element `number`.
    Reader(const NumberedQueue& queue, std::size_t number) : queue_(queue), number_(number) {}
    // The next element; there must be one.
    [[nodiscard]] const T& next() {
      if (place_ == end_of_chunk_) go_on();
      return *place_++;
    }

   private:
    void go_on() {
      place_ = &queue_[number_];
      const std::size_t rest = chunk_size - number_ % chunk_size;
      end_of_chunk_ = place_ + rest;
      number_ += rest;
    }

    const NumberedQueue& queue_;
    std::size_t number_;  // of the first one in the next chunk
    const T* place_ = nullptr;
    const T* end_of_chunk_ = nullptr;
  };
  [[nodiscard]] Reader from(std::size_t number) const { return Reader(*this, number); }

  // Forgets the elements before `number`, which is at most end().
  void drop_before(std::size_t number) {
    if constexpr (is_plain) {
      begin_ = std::max(begin_, number);
    } else {
      for (; begin_ < number; ++begin_) (*this)[begin_] = T{};
    }
    if (begin_ >= end_of_first_) drop_runs();
  }
  // Forgets the elements from `number` on. Where that is all of them, `number` comes next.
  void truncate(std::size_t number) {
    if (number < begin_) {
      *this = NumberedQueue(number);
      return;
    }
    if (number >= end_) return;
    if constexpr (!is_plain)
      for (std::size_t gone = number; gone < end_; ++gone) (*this)[gone] = T{};
    end_ = number;
    find_place(empty() ? end_ : end_ - 1);
  }

  // Forgets all; the next element has the number `first`. The memory of some elements stays.
  void clear(std::size_t first = 0) {
    if constexpr (!is_plain)
      for (; begin_ < end_; ++begin_) (*this)[begin_] = T{};
    if (!spare_ && dropped_runs_ < runs_.size() && runs_.back().chunks() == 1)
      spare_ = std::move(runs_.back());
    runs_.clear();
    chunks_.clear();
    first_chunk_ = dropped_runs_ = dropped_chunks_ = 0;
    begin_ = end_ = first;
    place_ = end_of_chunk_ = nullptr;
    end_of_first_ = 0;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    std::size_t begin = begin_;
    std::size_t end = end_;
    archive(begin, end);
    if constexpr (Archive::is_loading::value) {
      *this = NumberedQueue(begin);
      while (end_ < end) push_back(T{});
    }
    for (std::size_t number = begin; number < end; ++number) archive((*this)[number]);
  }

 private:
  // Memory for elements is touched only when they come, unless assignment needs an object there.
  static constexpr bool is_plain = std::is_trivially_destructible_v<T>;
  // A queue with this many chunks takes whole pages, which are given back with their elements.
  static constexpr std::size_t long_queue = 64;
  static constexpr std::size_t chunks_of_piece = PagePiece::bytes / (chunk_size * sizeof(T));
  static_assert(chunks_of_piece > 1 && alignof(T) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);

  // Chunks that are contiguous in memory: one from the heap, or those of a page piece.
  class Run {
   public:
    explicit Run(bool is_long) {
      if (is_long) {
        piece_.emplace();
        if constexpr (!is_plain) std::uninitialized_value_construct_n(places(), elements());
      } else if constexpr (is_plain) {
        chunk_ = std::make_unique_for_overwrite<std::byte[]>(chunk_size * sizeof(T));
      } else {
        chunk_ = std::make_unique<T[]>(chunk_size);
      }
    }
    Run(Run&&) noexcept = default;
    Run& operator=(Run&& other) noexcept {
      std::swap(chunk_, other.chunk_);
      std::swap(piece_, other.piece_);
      std::swap(end, other.end);
      return *this;
    }
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;
    ~Run() {
      if constexpr (!is_plain)
        if (piece_ && piece_->memory() != nullptr) std::destroy_n(places(), elements());
    }

    [[nodiscard]] std::size_t chunks() const { return piece_ ? chunks_of_piece : 1; }
    [[nodiscard]] T* places() const {
      return piece_ ? reinterpret_cast<T*>(piece_->memory()) : reinterpret_cast<T*>(chunk_.get());
    }

    std::size_t end = 0;  // the number of the element after it

   private:
    [[nodiscard]] std::size_t elements() const { return chunks() * chunk_size; }

    std::unique_ptr<std::conditional_t<is_plain, std::byte, T>[]> chunk_;
    std::optional<PagePiece> piece_;
  };

  [[gnu::noinline]] void begin_chunk() {
    const std::size_t chunk = end_ / chunk_size;
    if (chunks_.empty()) first_chunk_ = chunk;
    if (chunk == first_chunk_ + chunks_.size()) begin_run();
    find_place(end_);
  }
  void begin_run() {
    Run& run = runs_.emplace_back(spare_ ? *std::exchange(spare_, std::nullopt)
                                         : Run(chunks_.size() >= long_queue));
    for (std::size_t chunk = 0; chunk < run.chunks(); ++chunk)
      chunks_.push_back(run.places() + chunk * chunk_size);
    run.end = (first_chunk_ + chunks_.size()) * chunk_size;
    end_of_first_ = runs_[dropped_runs_].end;
  }
  // Finds the place for the next element. `near`, end() or the last element, has a chunk.
  void find_place(std::size_t near) {
    T* chunk = chunks_[near / chunk_size - first_chunk_];
    end_of_chunk_ = chunk + chunk_size;
    place_ = chunk + near % chunk_size + (end_ - near);
  }
  [[gnu::noinline]] void drop_runs() {
    for (; dropped_runs_ < runs_.size() && runs_[dropped_runs_].end <= begin_; ++dropped_runs_) {
      Run gone = std::move(runs_[dropped_runs_]);
      dropped_chunks_ += gone.chunks();
      if (gone.chunks() == 1) spare_ = std::move(gone);
    }
    const bool all = dropped_runs_ == runs_.size();
    if (all) place_ = end_of_chunk_ = nullptr;
    end_of_first_ = all ? begin_ + 1 : runs_[dropped_runs_].end;
    // Only now and then: it moves the remaining runs.
    if (2 * dropped_runs_ < runs_.size()) return;
    const auto behind = [](auto& all_of_them, std::size_t number) {
      return all_of_them.begin() + static_cast<std::ptrdiff_t>(number);
    };
    runs_.erase(runs_.begin(), behind(runs_, std::exchange(dropped_runs_, 0)));
    chunks_.erase(chunks_.begin(), behind(chunks_, dropped_chunks_));
    first_chunk_ += std::exchange(dropped_chunks_, 0);
  }

  std::vector<Run> runs_;
  std::vector<T*> chunks_;    // of the runs
  std::optional<Run> spare_;  // the next chunk, where one has been emptied
  std::size_t first_chunk_ = 0;
  // How many at the start of runs_ and of chunks_ are used no more and still have to be erased.
  std::size_t dropped_runs_ = 0;
  std::size_t dropped_chunks_ = 0;
  std::size_t begin_;
  std::size_t end_;
  // Where the next element goes, and the end of its chunk; both null where it has none yet.
  T* place_ = nullptr;
  T* end_of_chunk_ = nullptr;
  std::size_t end_of_first_ = 0;  // of the runs, a number
};

}  // namespace trc
