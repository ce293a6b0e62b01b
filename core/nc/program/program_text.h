#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace trc::program {

// A text of lines: the program, or a subprogram that the setup gives.
class ProgramText {
 public:
  // `first_line` is the number of its first line.
  ProgramText(std::string name, std::string text, std::uint32_t first_line = 1);

  // Empty for the program itself.
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::size_t size() const { return lines_.size(); }
  [[nodiscard]] std::string_view line(std::size_t index) const {
    return std::string_view(text_).substr(lines_[index].begin,
                                          lines_[index].end - lines_[index].begin);
  }
  // "\n", "\r\n", "\r"; empty at the end of the text.
  [[nodiscard]] std::string_view line_end(std::size_t index) const;
  // 1-based.
  [[nodiscard]] std::uint32_t number(std::size_t index) const {
    return first_line_ + static_cast<std::uint32_t>(index);
  }
  // Whether lines in front of the first one are missing.
  [[nodiscard]] bool is_cut() const { return first_line_ > 1; }

 private:
  struct Line {
    std::size_t begin = 0;
    std::size_t end = 0;
  };

  std::string name_;
  std::string text_;
  std::uint32_t first_line_;
  std::vector<Line> lines_{};
};

}  // namespace trc::program
