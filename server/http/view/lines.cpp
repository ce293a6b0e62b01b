#include "server/http/view/lines.h"

#include <algorithm>
#include <cmath>

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

void LineSources::take(const LineEnd& reached) {
  for (LineEnd end; ahead_.size() < farthest && next_end_(end);) ahead_.push_back(end);
  const auto found =
      std::ranges::find_if(ahead_, [&](const LineEnd& end) { return is_same(reached, end); });
  if (found == ahead_.end()) return;
  if (reached.line > 0 && reached.line <= sources_.size()) sources_[reached.line - 1] = found->line;
  ahead_.erase(ahead_.begin(), found + 1);
}

}  // namespace trc::server::http
