#include "core/nc/program/program_text.h"

#include <algorithm>
#include <utility>

namespace trc::program {

ProgramText::ProgramText(std::string name, std::string text, std::uint32_t first_line)
    : name_(std::move(name)), text_(std::move(text)), first_line_(first_line) {
  for (std::size_t begin = 0; begin < text_.size();) {
    const std::size_t end = std::min(text_.find_first_of("\r\n", begin), text_.size());
    lines_.push_back({.begin = begin, .end = end});
    begin = end + line_end(lines_.size() - 1).size();
    if (end == text_.size()) break;
  }
}

std::string_view ProgramText::line_end(std::size_t index) const {
  const std::size_t end = lines_[index].end;
  if (end == text_.size()) return {};
  if (text_[end] == '\n') return "\n";
  return end + 1 < text_.size() && text_[end + 1] == '\n' ? "\r\n" : "\r";
}

}  // namespace trc::program
