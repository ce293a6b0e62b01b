#pragma once

#include <cstddef>
#include <cstring>
#include <string_view>
#include <vector>

namespace trc {

// Text that is put together word by word: room for a word is asked for once, then it is written in
// place.
class TextBuffer {
 public:
  void clear() { size_ = 0; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::string_view view() const { return {bytes_.data(), size_}; }

  // The end of the text so far, with room for `size` bytes after it.
  [[nodiscard]] char* room(std::size_t size) {
    if (bytes_.size() - size_ < size) bytes_.resize(2 * bytes_.size() + size);
    return bytes_.data() + size_;
  }
  // Sets the end of the text; `end` lies within the room.
  void end_at(const char* end) { size_ = static_cast<std::size_t>(end - bytes_.data()); }

  void append(std::string_view text) {
    if (text.empty()) return;  // data() may be null
    char* const at = room(text.size());
    std::memcpy(at, text.data(), text.size());
    end_at(at + text.size());
  }
  void append(char sign) {
    *room(1) = sign;
    ++size_;
  }

 private:
  std::vector<char> bytes_;  // may be longer than the text
  std::size_t size_ = 0;
};

}  // namespace trc
