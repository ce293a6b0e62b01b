#include "client/cli/source_lines.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "core/nc/text/characters.h"

namespace trc::cli {
namespace {

constexpr std::size_t most_kept = 16UL << 20U;
constexpr std::size_t longest_line = 64UL << 10U;

}  // namespace

SourceLines::SourceLines(Input& input) {
  std::error_code none;
  if (std::filesystem::is_regular_file(input.path(), none)) {
    path_ = input.path();
    return;
  }
  input.watch([this](std::string_view piece) {
    kept_ += piece.substr(0, most_kept - std::min(most_kept, kept_.size()));
  });
}

void SourceLines::rewind() {
  position_ = 0;
  next_line_ = 1;
  if (!path_.empty()) file_ = std::ifstream(path_, std::ios::binary);
}

int SourceLines::peek_byte() {
  if (!path_.empty()) return file_.rdbuf()->sgetc();
  return position_ == kept_.size() ? -1 : static_cast<unsigned char>(kept_[position_]);
}

int SourceLines::next_byte() {
  const auto take = [this] {
    const int byte = peek_byte();
    if (path_.empty())
      position_ += byte >= 0 ? 1 : 0;
    else
      file_.rdbuf()->sbumpc();
    return byte;
  };
  const int byte = take();
  if (byte != '\r') return byte;
  if (peek_byte() == '\n') take();
  return '\n';
}

std::optional<std::string> SourceLines::line(std::uint32_t number) {
  if (number == 0) return std::nullopt;
  if (number < next_line_ || (!path_.empty() && !file_.is_open())) rewind();
  std::string text;
  int byte = 0;
  while (next_line_ < number && (byte = next_byte()) >= 0)
    if (byte == '\n') ++next_line_;
  if (next_line_ < number) return std::nullopt;
  bool any = false;
  while ((byte = next_byte()) >= 0 && byte != '\n') {
    any = true;
    if (text.size() < longest_line) text += static_cast<char>(byte);
  }
  if (byte < 0 && !any) return std::nullopt;
  ++next_line_;
  // The mark is no part of the program, and columns do not count it.
  if (number == 1 && text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  return text;
}

}  // namespace trc::cli
