#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "client/plot/outline.h"
#include "core/geometry/plane.h"

namespace trc::plot {

// Where mm land on the sheet. One scale for both axes: a circle stays a circle.
// Sheet units are pixels, y downwards.
struct Frame {
  Bounds world{};    // mm shown
  double scale = 1;  // pixels per mm
  double left = 0;   // of the drawing field on the sheet
  double top = 0;
  double width = 0;  // of the drawing field
  double height = 0;

  [[nodiscard]] double x(double mm) const { return left + (mm - world.low.x()) * scale; }
  [[nodiscard]] double y(double mm) const { return top + (world.high.y() - mm) * scale; }
  [[nodiscard]] Point on_sheet(const Point& mm) const { return {x(mm.x()), y(mm.y())}; }
};

// A field of at most `widest` x `tallest` pixels, as large as the shape of
// `contents` allows, with a margin around it. Contents without extent get 1 mm.
[[nodiscard]] Frame fit(const Bounds& contents, double widest, double tallest);

// Round numbers (1, 2 or 5 times a power of ten apart) in [low, high], in any unit.
struct Ticks {
  double step = 1;
  int decimals = 0;  // that tell neighbours apart
  std::vector<double> at{};
};
[[nodiscard]] Ticks ticks_between(double low, double high, double smallest_step);

// Fixed point with at most `decimals` digits, without trailing zeros and without "-0".
[[nodiscard]] std::string decimal(double value, int decimals);

// Pixels as a drawing has them, a number or a point.
[[nodiscard]] std::string px(double value);
[[nodiscard]] std::string pair(const Point& point);

// The attribute `d` of a path along the segments, which moves where one does not begin where the
// one before has ended.
[[nodiscard]] std::string path_data(std::span<const Segment> segments, const Frame& frame);

// Of the first and second axis of a plane.
[[nodiscard]] std::array<const char*, 2> axis_names(Plane plane);

}  // namespace trc::plot
