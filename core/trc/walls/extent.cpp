#include "core/trc/walls/extent.h"

#include <algorithm>

#include "core/geometry/along.h"

namespace trc {
namespace {

// What the line from `origin` sweeps over.
double swept(const Point& origin, const Point& from, const Point& to) {
  return 0.5 * cross(Vector(from - origin), Vector(to - origin));
}

void add(const Segment& block, double length, const Point& origin, Extent& extent) {
  extent.length += length;
  extent.area += swept(origin, start_of(block), end_of(block));
  // Between the arc and its chord.
  if (const auto* arc = std::get_if<Arc>(&block))
    extent.area +=
        0.5 * (arc->start - arc->center).squaredNorm() * (arc->sweep - std::sin(arc->sweep));
}

// The blocks from one place to another one, which may be the end of the contour.
Extent extent_between(const ContourView& contour, const ContourPlace& from,
                      const ContourPlace& to) {
  const Point origin = start_of(contour.segment(0));
  Extent extent;
  for (std::size_t number = from.number; number <= to.number && number < contour.count; ++number) {
    contour.pass();
    const Segment block = contour.segment(number);
    const double length = length_of(block);
    const double begin = number == from.number ? from.along : 0;
    const double end = number == to.number ? std::min(to.along, length) : length;
    if (end <= begin) continue;
    if (begin > 0 || end < length)
      add(stretch_of(block, begin, end, point_along(block, begin), point_along(block, end)),
          end - begin, origin, extent);
    else
      add(block, length, origin, extent);
  }
  return extent;
}

}  // namespace

Extent extent_of(const ContourView& contour) {
  if (contour.count == 0) return {};
  return extent_between(contour, {0, 0}, {contour.count, 0});
}

Extent extent_of_ring(const ContourView& contour, const Extent& all, const ContourPlace& begin,
                      const ContourPlace& end) {
  const Extent before = extent_between(contour, {0, 0}, begin);
  const Extent behind = extent_between(contour, end, {contour.count, 0});
  const Point first = point_along(contour.segment(begin.number), begin.along);
  const Point last = point_along(contour.segment(end.number), end.along);
  return {.length = all.length - before.length - behind.length,
          .area = all.area - before.area - behind.area +
                  swept(start_of(contour.segment(0)), last, first)};
}

}  // namespace trc
