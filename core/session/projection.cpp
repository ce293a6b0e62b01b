#include "core/session/projection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/verify/shape.h"

namespace trc {
namespace {

constexpr double longest_chord = 3 * std::numbers::pi / 180;

}  // namespace

std::vector<Segment> project(Plane plane, const Segment& segment, const AxisTravel& normal,
                             Plane view) {
  if (plane == view) {
    if (verify::extent_of(segment) > 0) return {segment};
    return {};
  }
  int chords = 1;
  if (const auto* arc = std::get_if<Arc>(&segment))
    chords = std::max(1, static_cast<int>(std::ceil(std::abs(arc->sweep) / longest_chord)));
  const auto at = [&](double share) {
    const Point point = verify::place_at(segment, share).point;
    return to_plane(view,
                    from_plane(plane, point, normal.from + share * (normal.to - normal.from)));
  };
  std::vector<Segment> seen;
  Point from = at(0);
  for (int i = 1; i <= chords; ++i) {
    const Point to = at(static_cast<double>(i) / chords);
    if (to != from) seen.emplace_back(Line{.start = from, .end = to});
    from = to;
  }
  return seen;
}

}  // namespace trc
