#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/geometry/segment.h"

namespace trc {

// G17 (XY), G18 (ZX), G19 (YZ). The third main axis stands across the plane so
// that the three axes are right-handed.
enum class Plane : std::uint8_t { xy, zx, yz };

// Machine coordinates X Y Z, mm.
using Position = std::array<double, 3>;

struct PlaneAxes {
  std::size_t first = 0;
  std::size_t second = 1;
  std::size_t third = 2;
};

[[nodiscard]] constexpr PlaneAxes axes_of(Plane plane) {
  switch (plane) {
    case Plane::zx:
      return {.first = 2, .second = 0, .third = 1};
    case Plane::yz:
      return {.first = 1, .second = 2, .third = 0};
    case Plane::xy:
      break;
  }
  return {};
}

[[nodiscard]] inline Point to_plane(Plane plane, const Position& position) {
  const PlaneAxes axes = axes_of(plane);
  return {position[axes.first], position[axes.second]};
}

// The machine position of a point in the plane at height `third`.
[[nodiscard]] inline Position from_plane(Plane plane, const Point& point, double third) {
  // Each case as a whole: a processor waits for numbers that are stored one by one by index and
  // then copied together.
  switch (plane) {
    case Plane::zx:
      return {point.y(), third, point.x()};
    case Plane::yz:
      return {third, point.x(), point.y()};
    case Plane::xy:
      break;
  }
  return {point.x(), point.y(), third};
}

}  // namespace trc
