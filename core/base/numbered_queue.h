#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/pages.h"

namespace trc {

// A sequence that grows at its end and is forgotten at its begin, whose elements keep their
// number and their place in memory all the time. It takes little more memory than its elements:
// it is never copied to grow, and a window over an endless stream needs room for the window.
template <class T>
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
  [[nodiscard]] T& back() { return (*this)[end_ - 1]; }
  [[nodiscard]] const T& back() const { return (*this)[end_ - 1]; }

  T& push_back(T element) { return next() = std::move(element); }
  // One more at the end, with whatever value: the caller gives it one.
  T& next() {
    const std::size_t chunk = end_ / chunk_size - first_chunk_;
    if (chunks_.empty() || chunk == chunks_.size()) return first_of_chunk();
    return chunks_[chunk][end_++ % chunk_size];
  }

  // Forgets the elements before `number`, which is at most end().
  void drop_before(std::size_t number) {
    for (; begin_ < number; ++begin_) release((*this)[begin_]);
    const std::size_t chunk = begin_ / chunk_size;
    const auto lies_before = [chunk](const Run& run) { return run.end_chunk <= chunk; };
    if (runs_.empty() || !lies_before(runs_.front())) return;
    const auto kept = std::find_if_not(runs_.begin(), runs_.end(), lies_before);
    const std::size_t gone = std::prev(kept)->end_chunk - first_chunk_;
    if (runs_.front().chunks == 1) spare_ = std::move(runs_.front());
    runs_.erase(runs_.begin(), kept);
    chunks_.erase(chunks_.begin(), chunks_.begin() + static_cast<std::ptrdiff_t>(gone));
    first_chunk_ += gone;
  }
  // Forgets the elements from `number` on. Where that is all of them, `number` comes next.
  void truncate(std::size_t number) {
    while (end_ > std::max(begin_, number)) release((*this)[--end_]);
    if (number < begin_) *this = NumberedQueue(number);
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
  static constexpr std::size_t chunk_size = 256;
  // A queue that has grown to so many chunks takes several at a time: less for the heap to
  // divide, and whole pages for the system when they go.
  static constexpr std::size_t long_queue = 64;
  static constexpr std::size_t chunks_at_a_time = 16;

  // Chunks that lie together in memory.
  struct Run {
    explicit Run(std::size_t count)
        : memory(std::make_unique<T[]>(count * chunk_size)), chunks(count) {}
    Run(Run&&) noexcept = default;
    Run& operator=(Run&& other) noexcept {
      std::swap(memory, other.memory);
      std::swap(chunks, other.chunks);
      std::swap(end_chunk, other.end_chunk);
      return *this;
    }
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;
    ~Run() {
      if constexpr (std::is_trivially_destructible_v<T>)
        if (memory && chunks > 1) give_back_pages(memory.get(), chunks * chunk_size * sizeof(T));
    }

    std::unique_ptr<T[]> memory;
    std::size_t chunks;
    std::size_t end_chunk = 0;  // the number of the chunk behind it
  };

  [[gnu::noinline]] T& first_of_chunk() {
    if (chunks_.empty()) first_chunk_ = end_ / chunk_size;
    Run& run = runs_.emplace_back(spare_ ? *std::exchange(spare_, std::nullopt)
                                         : Run(chunks_.size() < long_queue ? 1 : chunks_at_a_time));
    for (std::size_t chunk = 0; chunk < run.chunks; ++chunk)
      chunks_.push_back(run.memory.get() + chunk * chunk_size);
    run.end_chunk = first_chunk_ + chunks_.size();
    return (*this)[end_++];
  }
  static void release(T& element) {
    if constexpr (!std::is_trivially_destructible_v<T>) element = T{};
  }

  std::vector<Run> runs_;
  std::vector<T*> chunks_;    // of the runs
  std::optional<Run> spare_;  // the next chunk, where one has been emptied
  std::size_t first_chunk_ = 0;
  std::size_t begin_;
  std::size_t end_;
};

}  // namespace trc
