#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace trc::cli {

struct ShapeRequest {
  std::string shape{};
  std::uint64_t blocks = 100;  // contour blocks between approach and retract
  std::uint64_t seed = 1;
  double tool_radius = 5;  // mm
};

struct ShapeRow {
  std::string_view name;
  std::string_view meaning;
};

// What `generate` knows.
[[nodiscard]] const std::vector<ShapeRow>& shapes();

// Takes the next piece of text; false: no more is wanted.
using TextSink = std::function<bool(std::string_view)>;

// Writes the program of a sample contour: selection with G139 and G25, the
// contour, deselection. Every contour can be compensated with its radius without
// a violation, and its path does not gouge. Closed shapes are travelled again and
// again until the number of blocks is reached, so that coordinates stay small. The same request
// gives the same text on every machine.
//
// Returns what is wrong with the request, empty if nothing: an unknown shape or a
// spiral that would grow beyond the range of coordinates.
[[nodiscard]] std::string generate(const ShapeRequest& request, const TextSink& sink);

}  // namespace trc::cli
