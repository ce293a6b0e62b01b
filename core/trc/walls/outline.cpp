#include "core/trc/walls/outline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

#include "core/geometry/along.h"

namespace trc {

void Outline::append(const ContourView& contour, const ContourPlace& from, const ContourPlace& to) {
  if (corners_.empty() && from.number <= to.number) corners_.reserve(to.number - from.number + 1);
  for (std::size_t number = from.number; number <= to.number && number < contour.count; ++number) {
    contour.pass();
    const Segment segment = contour.segment(number);
    // Most blocks are whole lines.
    const auto* line = std::get_if<Line>(&segment);
    if (line != nullptr && number != from.number && number != to.number) {
      if ((line->end - line->start).squaredNorm() > 0) add(line->start);
      continue;
    }
    const double length = length_of(segment);
    const double begin = number == from.number ? from.along : 0;
    const double end = number == to.number ? to.along : length;
    if (end <= begin) continue;
    constexpr double chord = 0.25;  // rad
    const auto* arc = std::get_if<Arc>(&segment);
    const double turn = arc != nullptr ? std::abs(arc->sweep) * (end - begin) / length : 0;
    const auto chords = static_cast<int>(std::ceil(std::max(1.0, turn / chord)));
    for (int part = 0; part < chords; ++part)
      add(point_along(segment, begin + (end - begin) * part / chords));
  }
}

void Outline::add(const Point& corner) {
  if (!corners_.empty())
    doubled_area_ +=
        cross(Vector(corners_.back() - corners_.front()), Vector(corner - corners_.front()));
  corners_.push_back(corner);
}

bool Outline::has_on(Side side, const Point& point) const {
  int turns = 0;
  Vector from = corners_.empty() ? Vector::Zero() : Vector(corners_.back() - point);
  for (const Point& corner : corners_) {
    const Vector to = corner - point;
    if (from.y() <= 0 && to.y() > 0 && cross(from, to) > 0) ++turns;
    if (from.y() > 0 && to.y() <= 0 && cross(from, to) < 0) --turns;
    from = to;
  }
  const bool is_inside = turns != 0;
  const bool tool_is_inside = (area() > 0) == (side == Side::left);
  return is_inside == tool_is_inside;
}

}  // namespace trc
