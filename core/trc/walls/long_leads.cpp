#include "core/trc/walls/long_leads.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "core/geometry/along.h"

namespace trc {
namespace {

// With what an overrun goes over.
constexpr std::size_t most_lead_blocks = 4;
// Up to here two places on a contour are one, mm.
constexpr double same_place = 1e-7;

// The contour between the two visits of a candidate, as a polygon.
class Ring {
 public:
  Ring(const ContourView& contour, const EndsMeeting& closing) {
    for (std::size_t number = closing.first.number; number <= closing.second.number; ++number) {
      const Segment segment = contour.segment(number);
      const double length = length_of(segment);
      const double from = number == closing.first.number ? closing.first.along : 0;
      const double to = number == closing.second.number ? closing.second.along : length;
      constexpr double chord = 0.25;  // rad
      const auto* arc = std::get_if<Arc>(&segment);
      const double turn = arc != nullptr ? std::abs(arc->sweep) * (to - from) / length : 0;
      const auto chords = static_cast<int>(std::ceil(std::max(1.0, turn / chord)));
      for (int part = 0; part < chords; ++part)
        corners_.push_back(point_along(segment, from + (to - from) * part / chords));
    }
  }

  // Whether the point is on that side of it. Inside, where the ring goes round it.
  [[nodiscard]] bool has_on(Side side, const Point& point) const {
    double area = 0;
    int turns = 0;
    for (std::size_t index = 0; index < corners_.size(); ++index) {
      const Vector from = corners_[index] - point;
      const Vector to = corners_[(index + 1) % corners_.size()] - point;
      area += cross(from, to);
      if (from.y() <= 0 && to.y() > 0 && cross(from, to) > 0) ++turns;
      if (from.y() > 0 && to.y() <= 0 && cross(from, to) < 0) --turns;
    }
    const bool is_inside = turns != 0;
    const bool tool_is_inside = (area > 0) == (side == Side::left);
    return is_inside == tool_is_inside;
  }

 private:
  std::vector<Point> corners_;
};

// Whether an arc leads away from where the contour closes, at once or behind an overrun of blocks
// that end where the first ones do.
bool leaves_by_arc(const ContourView& contour, const EndsMeeting& closing, double tolerance) {
  std::size_t wall = closing.first.number;
  if (closing.first.along > same_place) ++wall;
  for (std::size_t number = closing.second.number + 1; number < contour.count; ++number, ++wall) {
    const Segment out = contour.segment(number);
    if ((end_of(out) - end_of(contour.segment(wall))).norm() > tolerance) return is_arc(out);
  }
  return false;
}

}  // namespace

bool are_few_outside(const ContourView& contour, std::size_t first, std::size_t second) {
  return first <= most_lead_blocks && contour.count - 1 - second <= most_lead_blocks;
}

bool is_between_long_leads(const ContourView& contour, const EndsMeeting& closing,
                           double tolerance) {
  const auto is_end = [&](const ContourPlace& place) {
    return place.along <= same_place ||
           place.along >= length_of(contour.segment(place.number)) - same_place;
  };
  const double shortest = 10 * tolerance;
  if (contour.tool_side == Side::off ||
      !are_few_outside(contour, closing.first.number, closing.second.number) ||
      !(is_end(closing.first) || is_end(closing.second)))
    return false;
  // Straight on, the first and the last block may be walls that a circle stands beside.
  if (closing.first.number == 0 ||
      !std::holds_alternative<Arc>(contour.segment(closing.first.number - 1)) ||
      !leaves_by_arc(contour, closing, tolerance))
    return false;
  double length = closing.second.along - closing.first.along;
  for (std::size_t number = closing.first.number; number < closing.second.number; ++number)
    length += length_of(contour.segment(number));
  if (length <= shortest) return false;
  const Ring ring(contour, closing);
  return ring.has_on(contour.tool_side, start_of(contour.segment(0))) &&
         ring.has_on(contour.tool_side, end_of(contour.segment(contour.count - 1)));
}

}  // namespace trc
