#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "client/load/sample_contour.h"

namespace trc::load {

// A sample contour as an NC program, line by line: selection with G42 and the modes of its head,
// the contour, deselection.
class SampleProgram {
 public:
  // `head`: the words of the first lines.
  SampleProgram(const SampleContour& contour, std::vector<std::string> head)
      : contour_(contour), head_(std::move(head)) {}

  // Lines.
  [[nodiscard]] std::uint64_t size() const { return head_.size() + contour_.size() + 4; }
  // Appends a line, index < size(), with its end.
  void append(std::uint64_t index, std::string& out) const;

 private:
  void append_element(std::uint64_t index, std::string& out) const;

  const SampleContour& contour_;
  std::vector<std::string> head_;
};

// Takes the next piece of text; false: no more is wanted.
using TextSink = std::function<bool(std::string_view)>;

// Writes the program of a sample contour with G139 and G25. Returns what is wrong with the request,
// empty if nothing.
[[nodiscard]] std::string generate(const ShapeRequest& request, const TextSink& sink);

}  // namespace trc::load
