#include "core/trc/walls/outline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

#include "core/geometry/along.h"

namespace trc {

void Outline::append(const ContourView& contour, const ContourPlace& from, const ContourPlace& to) {
  for (std::size_t number = from.number; number <= to.number && number < contour.count; ++number) {
    contour.pass();
    const Segment segment = contour.segment(number);
    const double length = length_of(segment);
    const double begin = number == from.number ? from.along : 0;
    const double end = number == to.number ? to.along : length;
    if (end <= begin) continue;
    constexpr double chord = 0.25;  // rad
    const auto* arc = std::get_if<Arc>(&segment);
    const double turn = arc != nullptr ? std::abs(arc->sweep) * (end - begin) / length : 0;
    const auto chords = static_cast<int>(std::ceil(std::max(1.0, turn / chord)));
    for (int part = 0; part < chords; ++part)
      corners_.push_back(point_along(segment, begin + (end - begin) * part / chords));
  }
}

double Outline::area() const {
  if (corners_.empty()) return 0;
  double doubled = 0;
  Vector from = corners_.back() - corners_.front();
  for (const Point& corner : corners_) {
    const Vector to = corner - corners_.front();
    doubled += cross(from, to);
    from = to;
  }
  return doubled / 2;
}

bool Outline::has_on(Side side, const Point& point) const {
  int turns = 0;
  for (std::size_t index = 0; index < corners_.size(); ++index) {
    const Vector from = corners_[index] - point;
    const Vector to = corners_[(index + 1) % corners_.size()] - point;
    if (from.y() <= 0 && to.y() > 0 && cross(from, to) > 0) ++turns;
    if (from.y() > 0 && to.y() <= 0 && cross(from, to) < 0) --turns;
  }
  const bool is_inside = turns != 0;
  const bool tool_is_inside = (area() > 0) == (side == Side::left);
  return is_inside == tool_is_inside;
}

}  // namespace trc
