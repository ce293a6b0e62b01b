#pragma once

#include <memory_resource>
#include <vector>

#include "core/trc/walls/closing.h"

namespace trc {

// The polygon along consecutive stretches of a contour and back to its start. Arcs are chords of at
// most 0.25 rad.
class Outline {
 public:
  explicit Outline(std::pmr::memory_resource* memory) : corners_(memory) {}

  void append(const ContourView& contour, const ContourPlace& from, const ContourPlace& to);

  // The area, mm²; positive where the polygon turns to the left.
  [[nodiscard]] double area() const { return doubled_area_ / 2; }
  // Whether the point is on that side of it. A point that it goes round is inside.
  [[nodiscard]] bool has_on(Side side, const Point& point) const;

 private:
  void add(const Point& corner);

  std::pmr::vector<Point> corners_;
  double doubled_area_ = 0;  // mm²
};

}  // namespace trc
