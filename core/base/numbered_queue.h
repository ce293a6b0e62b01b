#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

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
    if (begin_ / chunk_size <= first_chunk_) return;
    const std::size_t gone = std::min(begin_ / chunk_size - first_chunk_, chunks_.size());
    if (gone == 0) return;
    spare_ = std::move(chunks_.front());
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

  [[gnu::noinline]] T& first_of_chunk() {
    if (chunks_.empty()) first_chunk_ = end_ / chunk_size;
    chunks_.push_back(spare_ ? std::move(spare_) : std::make_unique<T[]>(chunk_size));
    return (*this)[end_++];
  }
  static void release(T& element) {
    if constexpr (!std::is_trivially_destructible_v<T>) element = T{};
  }

  std::vector<std::unique_ptr<T[]>> chunks_;
  std::unique_ptr<T[]> spare_;  // the next chunk, where one has been emptied
  std::size_t first_chunk_ = 0;
  std::size_t begin_;
  std::size_t end_;
};

}  // namespace trc
