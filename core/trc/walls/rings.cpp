#include "core/trc/walls/rings.h"

#include <algorithm>

#include "core/geometry/along.h"
#include "core/geometry/distance.h"

namespace trc {

Visits visits_of(const ContourView& contour, const Closing& closing, double tolerance,
                 std::pmr::memory_resource* memory) {
  const ContourPlace& first = closing.first;
  const ContourPlace& second = closing.second;
  const Point& point = closing.point;
  Visits visits(memory);
  double way = 0;
  const double near = tolerance + closing.gap;
  // Blocks that meet in the point are one visit, and so are short ones around it.
  const auto note = [&](std::size_t number, double along) {
    const bool is_same = !visits.empty() && way + along - visits.back().way <= 4 * near;
    if (!is_same) visits.push_back({.place = {number, along}, .way = way + along});
  };
  for (std::size_t number = 0; number < second.number; ++number) {
    contour.pass();
    const Segment segment = contour.segment(number);
    const double length = length_of(segment);
    if (number == first.number) visits.push_back({.place = first, .way = way + first.along});
    // Most blocks are farther away than they are long.
    const double within = (length + near) * (1 + 1e-9);  // more than rounding of the squares
    const bool may_be_near = (start_of(segment) - point).squaredNorm() <= within * within;
    if (number >= first.number && may_be_near && distance(point, segment) <= near) {
      const double along = nearest_along(segment, point);
      if (number > first.number || along > first.along) note(number, along);
      // A closed circle visits the point with both of its ends.
      if (along < length && (end_of(segment) - point).norm() <= near) note(number, length);
    }
    way += length;
  }
  const Visit last{.place = second, .way = way + second.along};
  if (first.number == second.number) {
    visits.assign({{first, way + first.along}, last});
    return visits;
  }
  if (visits.size() > 1 && last.way - visits.back().way <= 4 * near) visits.pop_back();
  visits.push_back(last);
  return visits;
}

double longest_ring(std::span<const Visit> visits) {
  double longest = 0;
  for (std::size_t index = 1; index < visits.size(); ++index)
    longest = std::max(longest, visits[index].way - visits[index - 1].way);
  return longest;
}

std::size_t laps_of(std::span<const Visit> visits) {
  const double least = share_of_lead_ring * longest_ring(visits);
  std::size_t laps = 0;
  for (std::size_t index = 1; index < visits.size(); ++index)
    laps += visits[index].way - visits[index - 1].way >= least ? 1 : 0;
  return laps;
}

}  // namespace trc
