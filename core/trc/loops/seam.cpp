#include "core/trc/loops/seam.h"

#include "core/geometry/along.h"

namespace trc {

bool Seam::is_near(const PathPlace& place) const {
  if (!is_closed()) return false;
  return (place.block == 0 && place.along <= reach()) || is_at_end(place);
}

bool Seam::is_at_end(const PathPlace& place) const {
  const Point point = point_along(path_.block(place.block).path, place.along);
  return path_.number_of(place.block) + most_blocks >= path_.end_of_contour() &&
         (point - path_.ends_at(path_.end() - 1)).norm() <= reach();
}

bool Seam::is_between(const PathPlace& from, const PathPlace& to, const Point& point) const {
  if (!is_closed()) return false;
  const std::size_t last = path_.end_of_contour() - 1;
  const std::size_t first_number = path_.number_of(from.block);
  const std::size_t last_number = path_.number_of(to.block);
  return first_number < most_blocks && last_number + most_blocks > last &&
         2 * (last_number - first_number) >= last &&
         (point - path_.begins_at(0)).norm() <= reach() &&
         (point - path_.ends_at(path_.end() - 1)).norm() <= reach() &&
         !encloses_room(0, first_number, from.along) &&
         !encloses_room(last_number + 1, last + 1,
                        length_of(path_.block(to.block).path) - to.along);
}

// A contour that goes round the tool is longer than its radius.
bool Seam::encloses_room(std::size_t first, std::size_t end, double rest) const {
  double length = rest;
  for (std::size_t number = first; number < end; ++number)
    length += length_of(path_.contour_block(number).programmed);
  return length > path_.radius_of_tool(0);
}

bool Seam::is_closed() const {
  if (path_.begin() > 0) return false;
  const Point begin = start_of(path_.contour_block(0).programmed);
  const Point end = end_of(path_.contour_block(path_.end_of_contour() - 1).programmed);
  return (end - begin).norm() <= tolerances_.input_resolution;
}

}  // namespace trc
