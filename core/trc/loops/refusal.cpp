#include "core/trc/loops/refusal.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/reasons.h"
#include "core/geometry/along.h"
#include "core/geometry/distance.h"

namespace trc {
namespace {

// An end of the contour, and the centre of the tool that touches it there.
struct End {
  std::string_view reason;
  Point of_contour;
  Point of_path;
};

bool has_room(const Point& center, double radius, const HeldPath& path, const Obstacles& obstacles,
              const Tolerances& tolerances) {
  const double limit = radius - tolerances.passable * std::max(radius, 1.0);
  for (std::size_t number = path.begin_of_contour(); number < path.end_of_contour(); ++number)
    if (!obstacles.is_lead(number) && distance(center, obstacles.wall(number)) < limit)
      return false;
  return true;
}

// The largest radius of a tool that touches the contour at this end and has room. Empty if `radius`
// has room. Each smaller tool lies inside a larger one.
std::optional<double> largest_radius_at(const End& end, double radius, const HeldPath& path,
                                        const Obstacles& obstacles, const Tolerances& tolerances) {
  constexpr double exact_to = 1e-4;  // mm; the radius is reported to a micrometre
  const Vector outward = end.of_path - end.of_contour;
  const bool touches = std::abs(outward.norm() - radius) <= tolerances.on_contour;
  if (!touches || has_room(end.of_path, radius, path, obstacles, tolerances)) return {};
  double fits = 0;
  double fits_not = radius;
  while (fits_not - fits > exact_to) {
    const double middle = (fits + fits_not) / 2;
    const Point center = end.of_contour + outward * (middle / radius);
    (has_room(center, middle, path, obstacles, tolerances) ? fits : fits_not) = middle;
  }
  return fits;
}

}  // namespace

Diagnostic refusal_of(const HeldPath& path, const Obstacles& obstacles, const DeadEnd& dead_end,
                      const Tolerances& tolerances) {
  const auto& [block, onset, is_all_known] = dead_end;
  const HeldPath::ContourBlock own = path.contour_block(path.number_of(block));
  const TrcMode& mode = path.mode_of(block);
  const double radius = path.radius_of_tool(block);
  std::string_view why = obstacles.is_lead(path.number_of(block)) ? reason::no_way_past_lead
                                                                  : reason::no_way_past_block;
  std::optional<double> largest_radius;
  const auto look_at = [&](const End& end) {
    const auto most = largest_radius_at(end, radius, path, obstacles, tolerances);
    if (!most || (largest_radius && *largest_radius <= *most)) return;
    largest_radius = most;
    why = end.reason;
  };
  if (path.begin() == 0)
    look_at({obstacles.is_lead(0) ? reason::no_room_at_lead_in : reason::no_room_at_first_point,
             start_of(path.contour_block(0).programmed), path.begins_at(0)});
  if (is_all_known)
    look_at({obstacles.is_lead(path.end_of_contour() - 1) ? reason::no_room_at_lead_out
                                                          : reason::no_room_at_last_point,
             end_of(path.contour_block(path.end_of_contour() - 1).programmed),
             path.ends_at(path.end() - 1)});

  Diagnostic refusal = diagnostic(is_arc(own.programmed) ? Code::arc_wrapped : Code::line_reversed,
                                  own.source, std::string(why));
  refusal.values = {{"tool_radius", mode.cutting_radius(radius)}};
  if (largest_radius && !mode.below_nominal)
    refusal.values.push_back({"largest_radius", mode.cutting_radius(*largest_radius)});
  append_place(refusal.values, "other", path.contour_block(onset.obstacle).source);
  const Position position = from_plane(mode.plane, point_along(path.block(block).path, onset.along),
                                       path.height_of(block));
  refusal.point = DiagnosticPoint{.x = position[0], .y = position[1], .z = position[2]};
  return refusal;
}

}  // namespace trc
