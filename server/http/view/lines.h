#pragma once

#include <cstddef>
#include <cstdint>
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
  [[nodiscard]] std::size_t bytes() const;

  // For compensated text: the line of the program that each line comes from; 0: unknown.
  void set_sources(std::vector<std::uint32_t> sources) { sources_ = std::move(sources); }
  [[nodiscard]] const std::vector<std::uint32_t>& sources() const { return sources_; }

  // From a 1-based line on, at most 1000, long ones cut.
  [[nodiscard]] v1::ViewLines some(std::uint64_t first, std::uint64_t count) const;

 private:
  std::shared_ptr<const std::string> text_;
  std::size_t found_to_ = 0;
  std::vector<std::size_t> begins_;
  std::vector<std::uint32_t> sources_;
};

// The line of the program that each line of compensated text comes from. Both make the same motions
// in the same order, so the ends of motions tell it. `ends` are the ends on the path with their
// lines, `reached` those read from the text.
struct LineEnd {
  double x = 0;
  double y = 0;
  double z = 0;
  std::uint32_t line = 0;
};
[[nodiscard]] std::vector<std::uint32_t> sources_of(std::size_t lines,
                                                    const std::vector<LineEnd>& reached,
                                                    const std::vector<LineEnd>& ends);

}  // namespace trc::server::http
