#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/checkpoint.h"

namespace trc::program {

// A text of lines: the program, or a subprogram that the setup gives.
class ProgramText {
 public:
  // `first_line` is the number of its first line. The checkpoint is passed for each line.
  ProgramText(std::string name, std::string text, std::uint32_t first_line = 1,
              Checkpoint* checkpoint = nullptr);

  // Empty for the program itself.
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::size_t size() const { return begins_.size(); }
  [[nodiscard]] std::string_view line(std::size_t index) const {
    const std::string_view whole = with_end(index);
    return whole.substr(0, whole.size() - bytes_of_end(whole));
  }
  // "\n", "\r\n", "\r"; empty at the end of the text.
  [[nodiscard]] std::string_view line_end(std::size_t index) const {
    const std::string_view whole = with_end(index);
    return whole.substr(whole.size() - bytes_of_end(whole));
  }
  // 1-based.
  [[nodiscard]] std::uint32_t number(std::size_t index) const {
    return first_line_ + static_cast<std::uint32_t>(index);
  }
  // Whether lines before the first one are missing.
  [[nodiscard]] bool is_cut() const { return first_line_ > 1; }

 private:
  [[nodiscard]] std::string_view with_end(std::size_t index) const {
    const std::size_t end = index + 1 < begins_.size() ? begins_[index + 1] : text_.size();
    return std::string_view(text_).substr(begins_[index], end - begins_[index]);
  }
  [[nodiscard]] static std::size_t bytes_of_end(std::string_view whole) {
    if (whole.ends_with("\r\n")) return 2;
    return whole.ends_with('\n') || whole.ends_with('\r') ? 1 : 0;
  }

  std::string name_;
  std::string text_;
  std::uint32_t first_line_;
  std::vector<std::uint32_t> begins_{};  // of the lines; a text may be nothing but line ends
};

}  // namespace trc::program
