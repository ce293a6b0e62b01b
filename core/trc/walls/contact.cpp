#include "core/trc/walls/contact.h"

#include "core/geometry/along.h"

namespace trc {
namespace {

// Calls visit(along) with the place nearest to the point, or both ends of a closed circle.
template <class Visit>
void for_places_near(const Segment& segment, const Point& point, double tolerance, Visit visit) {
  const double along = nearest_along(segment, point);
  visit(along);
  const double length = length_of(segment);
  const bool is_closed = is_arc(segment) && start_of(segment) == end_of(segment);
  if (is_closed && (along <= tolerance || along >= length - tolerance))
    visit(along <= tolerance ? length : 0);
}

}  // namespace

void find_contacts(const Segment& first, const Segment& second, double tolerance,
                   std::pmr::vector<Contact>& found) {
  const auto note = [&](double along_first, double along_second) {
    const Point one = point_along(first, along_first);
    const double gap = (one - point_along(second, along_second)).norm();
    if (gap <= tolerance)
      found.push_back(
          {.along_first = along_first, .along_second = along_second, .gap = gap, .point = one});
  };
  for (const double along : {0.0, length_of(first)})
    for_places_near(second, point_along(first, along), tolerance,
                    [&](double along_second) { note(along, along_second); });
  for (const double along : {0.0, length_of(second)})
    for_places_near(first, point_along(second, along), tolerance,
                    [&](double along_first) { note(along_first, along); });
  constexpr double slack = 1e-9;  // mm, by which rounding puts a crossing beyond an end
  for (const Crossing& crossing : crossings(Track(first), Track(second), slack))
    note(crossing.along_first, crossing.along_second);
}

}  // namespace trc
