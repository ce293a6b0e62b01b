#include "core/trc/corner/bow_tie.h"

#include <algorithm>

#include "core/geometry/along.h"
#include "core/geometry/distance.h"

namespace trc {

std::optional<BowTie> bow_tie_of(const Segment& before, const Segment& between,
                                 const Segment& after, double largest,
                                 const Tolerances& tolerances) {
  const double longest = longest_in_bow_tie(largest);
  if (length_of(between) > longest) return std::nullopt;
  const Point& begin = start_of(between);
  const Point& end = end_of(between);
  const double of_begin = distance(begin, after);
  const double of_end = distance(end, before);
  if (std::min(of_begin, of_end) > largest) return std::nullopt;
  const double slack = slack_of_places(tolerances);
  for (const Crossing& crossing : crossings(Track(before), Track(after), slack)) {
    const Vector to_begin = begin - crossing.point;
    const Vector to_end = end - crossing.point;
    if (to_begin.norm() > longest || to_end.norm() > longest) continue;
    // A closed circle passes the crossing once more, at its other end.
    const double beyond = length_of(before) - crossing.along_first;
    if (std::max(beyond, crossing.along_second) > 2 * longest) continue;
    const double turn = cross(to_begin, to_end);
    if (turn == 0) continue;  // nothing lies between them
    return BowTie{.along_before = crossing.along_first,
                  .along_after = crossing.along_second,
                  .tip_at_end = of_begin <= of_end,
                  .turns_left = turn > 0};
  }
  return std::nullopt;
}

}  // namespace trc
