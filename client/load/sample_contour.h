#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/segment.h"

namespace trc::load {

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

// The shapes there are.
[[nodiscard]] const std::vector<ShapeRow>& shapes();

// What is wrong with the request, empty if nothing: an unknown shape or one that would grow
// beyond the range of coordinates.
[[nodiscard]] std::string fault_of(const ShapeRequest& request);

// One contour block from the end of the one before it, with six decimals.
struct ContourElement {
  Point end = Point::Zero();
  Point center = Point::Zero();  // of arcs
  enum class Kind : std::uint8_t { line, clockwise, counter_clockwise } kind = Kind::line;
};

// A contour for a tool to its right, with the way to it and from it. It can be compensated with its
// radius without a violation, and its path does not gouge. Closed shapes are travelled again and
// again until the number of blocks is reached, so that coordinates stay small. The same request
// gives the same contour on every machine.
class SampleContour {
 public:
  // The request must be free of faults.
  explicit SampleContour(const ShapeRequest& request);

  [[nodiscard]] std::uint64_t size() const { return blocks_; }
  // index < size()
  [[nodiscard]] const ContourElement& operator[](std::uint64_t index) const {
    const std::uint64_t behind = index - first_lap_.size();
    return index < first_lap_.size() ? first_lap_[index] : lap_[behind % lap_.size()];
  }
  // Where the contour begins.
  [[nodiscard]] const Point& start() const { return start_; }
  [[nodiscard]] Point approach_from() const;
  [[nodiscard]] Point retract_to() const;

 private:
  std::uint64_t blocks_;
  double away_;  // mm
  Point start_ = Point::Zero();
  std::vector<ContourElement> first_lap_;
  std::vector<ContourElement> lap_;
};

}  // namespace trc::load
