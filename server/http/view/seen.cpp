#include "server/http/view/seen.h"

#include <vector>

#include "core/session/projection.h"
#include "core/verify/shape.h"

namespace trc::server::http {
namespace {

bool has_extent(const Segment& shape) {
  if (const auto* line = std::get_if<Line>(&shape)) return line->start != line->end;
  return verify::extent_of(shape) > 0;
}

}  // namespace

void add_seen(Elements& elements, Element element, const Movement& movement, Plane shown) {
  const Plane plane = movement.plane;
  const Segment& shape = movement.shape;
  const AxisTravel& normal = movement.normal;
  if (!verify::is_finite(shape)) return;
  element.plane = plane;
  if (plane == shown && has_extent(shape)) {
    element.third_from = static_cast<float>(normal.from);
    element.third_to = static_cast<float>(normal.to);
    return elements.add(element, shape);
  }
  std::vector<Segment> seen = project(plane, shape, normal, shown);
  // The motion runs straight towards the viewer: it has no length in the shown plane.
  if (seen.empty() && (normal.moves() || start_of(shape) != end_of(shape))) {
    const Point here = to_plane(shown, from_plane(plane, start_of(shape), normal.from));
    seen.emplace_back(Line{.start = here, .end = here});
  }
  const std::size_t third = axes_of(shown).third;
  const auto third_at = [&](std::size_t piece) {
    const double share = static_cast<double>(piece) / static_cast<double>(seen.size());
    const double across = normal.from + share * (normal.to - normal.from);
    if (plane == shown) return static_cast<float>(across);
    const Point at = share == 1 ? end_of(shape) : verify::place_at(shape, share).point;
    return static_cast<float>(from_plane(plane, at, across)[third]);
  };
  for (std::size_t i = 0; i < seen.size(); ++i) {
    element.third_from = third_at(i);
    element.third_to = third_at(i + 1);
    element.ends_block = i + 1 == seen.size();
    elements.add(element, seen[i]);
  }
}

}  // namespace trc::server::http
