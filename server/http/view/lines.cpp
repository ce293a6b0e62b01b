#include "server/http/view/lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/utf8.h"
#include "server/text.h"

namespace trc::server::http {
namespace {

// Text has rounded coordinates; mm.
constexpr double same_end = 2e-3;
// The most motions between two matches that are too short to be written or are written in parts.
constexpr std::size_t farthest = 16;

bool is_same(const LineEnd& a, const LineEnd& b) {
  return std::abs(a.x - b.x) < same_end && std::abs(a.y - b.y) < same_end &&
         std::abs(a.z - b.z) < same_end;
}

}  // namespace

void Lines::find_to(std::size_t bytes) {
  while (found_to_ < bytes) {
    begins_.push_back(found_to_);
    const std::size_t end = text_->find('\n', found_to_);
    found_to_ = end == std::string::npos ? text_->size() : end + 1;
  }
}

std::string_view Lines::line(std::size_t index) const {
  const std::size_t begin = begins_[index];
  const std::size_t end = index + 1 < begins_.size() ? begins_[index + 1] : text_->size();
  std::string_view line = std::string_view(*text_).substr(begin, end - begin);
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.remove_suffix(1);
  return line;
}

std::size_t Lines::bytes() const {
  return text_->capacity() + begins_.capacity() * sizeof(std::size_t) +
         sources_.capacity() * sizeof(std::uint32_t);
}

v1::ViewLines Lines::some(std::uint64_t first, std::uint64_t count) const {
  constexpr std::uint64_t most_lines = 1000;
  constexpr std::size_t longest = 512;
  v1::ViewLines lines;
  first = std::max<std::uint64_t>(first, 1);
  lines.set_first_line(first);
  lines.set_count(this->count());
  const std::uint64_t end =
      std::min<std::uint64_t>(first - 1 + std::min(count, most_lines), this->count());
  for (std::uint64_t i = first - 1; i < end; ++i) {
    lines.add_lines(presentable(as_utf8(line(i)), longest));
    if (!sources_.empty()) lines.add_source_lines(sources_[i]);
  }
  return lines;
}

std::vector<std::uint32_t> sources_of(std::size_t lines, const std::vector<LineEnd>& reached,
                                      const std::vector<LineEnd>& ends) {
  std::vector<std::uint32_t> sources(lines);
  std::size_t next = 0;
  for (const LineEnd& read : reached) {
    const std::size_t last = std::min(ends.size(), next + farthest);
    for (std::size_t i = next; i < last; ++i) {
      if (!is_same(read, ends[i])) continue;
      next = i + 1;
      if (read.line > 0 && read.line <= lines) sources[read.line - 1] = ends[i].line;
      break;
    }
  }
  return sources;
}

}  // namespace trc::server::http
