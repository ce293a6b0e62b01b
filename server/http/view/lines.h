#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trc/v1/http.pb.h"

namespace trc::server::http {

// A text as lines.
class Lines {
 public:
  // None of its lines is found yet.
  explicit Lines(std::shared_ptr<const std::string> text) : text_(std::move(text)) {}

  // Finds the lines that begin within so many bytes.
  void find_to(std::size_t bytes);

  [[nodiscard]] std::size_t count() const { return begins_.size(); }
  // `index` from 0; without the line end.
  [[nodiscard]] std::string_view line(std::size_t index) const;
  [[nodiscard]] const std::string& text() const { return *text_; }
  // For compensated text: the line of the program that each line comes from; 0: unknown.
  void set_sources(std::vector<std::uint32_t> sources) { sources_ = std::move(sources); }
  [[nodiscard]] const std::vector<std::uint32_t>& sources() const { return sources_; }

  // From a 1-based line on, at most 1000, long ones cut.
  [[nodiscard]] v1::ViewLines some(std::uint64_t first, std::uint64_t count) const;

 private:
  std::shared_ptr<const std::string> text_;
  std::size_t found_to_ = 0;
  std::deque<std::size_t> begins_;  // never moves as it grows
  std::vector<std::uint32_t> sources_;
};

// Where a motion ends, and its line.
struct LineEnd {
  double x = 0;
  double y = 0;
  double z = 0;
  std::uint32_t line = 0;
};

// Finds the line of the program that each line of compensated text comes from. Path and text have
// the same motions in the same order, so the ends of motions tell it.
class LineSources {
 public:
  // `next_end` gives the end of the next motion on the path, with the line of the program; false:
  // there is none any more. `lines` are those of the text.
  LineSources(std::size_t lines, std::function<bool(LineEnd& end)> next_end)
      : sources_(lines), next_end_(std::move(next_end)) {}

  // The end of the next motion of the text.
  void take(const LineEnd& reached);
  // As of Lines::set_sources.
  [[nodiscard]] std::vector<std::uint32_t> found() { return std::move(sources_); }

 private:
  std::vector<std::uint32_t> sources_;
  std::function<bool(LineEnd& end)> next_end_;
  std::deque<LineEnd> ahead_;  // on the path
};

}  // namespace trc::server::http
