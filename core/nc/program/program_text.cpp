#include "core/nc/program/program_text.h"

#include <algorithm>
#include <utility>

#include "core/nc/text/characters.h"

namespace trc::program {

ProgramText::ProgramText(std::string name, std::string text, std::uint32_t first_line,
                         Checkpoint* checkpoint)
    : name_(std::move(name)), text_(std::move(text)), first_line_(first_line) {
  // The ProgramReader has taken the mark of the program itself.
  if (!name_.empty() && text_.starts_with(byte_order_mark)) text_.erase(0, byte_order_mark.size());
  for (std::size_t begin = 0; begin < text_.size();) {
    if (checkpoint != nullptr) checkpoint->pass();
    begins_.push_back(static_cast<std::uint32_t>(begin));
    const std::size_t end = std::min(text_.find_first_of("\r\n", begin), text_.size());
    begin = end + (text_.compare(end, 2, "\r\n") == 0 ? 2 : 1);
  }
}

}  // namespace trc::program
