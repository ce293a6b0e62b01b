#include "core/nc/state/lead.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/parallel.h"
#include "core/geometry/turn.h"

namespace trc {
namespace {

Vector turned(const Vector& v, double angle) {
  return std::cos(angle) * v + std::sin(angle) * left_of(v);
}

// A lead to the contour is a lead from it, travelled backwards.
ContourEnd backwards(const ContourEnd& end) {
  return {.point = end.point, .tangent = -end.tangent, .side = -end.side, .reach = end.reach};
}

Segment backwards(const Segment& segment) {
  if (const auto* arc = std::get_if<Arc>(&segment))
    return Arc{.start = arc->end, .end = arc->start, .center = arc->center, .sweep = -arc->sweep};
  const Line& line = std::get<Line>(segment);
  return Line{.start = line.end, .end = line.start};
}

// The sweep of the arc of LCT, on the tool path about `center`: up to where the tangent leads to
// the point. `turn`: 1 counter-clockwise, -1 clockwise.
std::optional<double> sweep_to_tangent(const Point& begin, const Point& center, const Point& to,
                                       double turn, double same_point) {
  const Vector arm = begin - center;
  const Vector way = to - center;
  const double radius = arm.norm();
  if (way.norm() + same_point < radius) return {};
  const double lead = std::acos(std::min(1.0, radius / way.norm()));
  double sweep = turn * turn_between(arm, way) - lead;
  while (sweep < 0) sweep += full_turn;
  while (sweep >= full_turn) sweep -= full_turn;
  // The sweep is 0 if rounding has put the beginning after its tangent.
  if ((full_turn - sweep) * radius <= same_point) sweep = 0;
  return sweep;
}

}  // namespace

std::optional<LeadPath> path_from(const ContourEnd& end, const Lead& lead, const Point& to,
                                  double same_point) {
  const Point tool = parallel_point(end.point, end.tangent, end.shift());
  if (lead.form == Lead::Form::tangent) {
    const double length = lead.length + (lead.from_edge ? end.reach : 0);
    if (!(length > same_point)) return {};
    const Vector way = length * end.tangent;
    return LeadPath{.contour = Line{.start = end.point, .end = end.point + way},
                    .away = tool + way};
  }
  if (lead.form == Lead::Form::normal)
    return LeadPath{.away = tool + end.side * lead.length * left_of(end.tangent)};
  double turn = lead.radius < 0 ? -end.side : end.side;
  const double beside = cross(end.tangent, to - end.point);
  if (lead.bends_to_tool && beside != 0) turn = beside > 0 ? 1 : -1;
  const double radius = std::abs(lead.radius) + turn * end.shift();
  const Point center = end.point + turn * radius * left_of(end.tangent);
  double sweep = lead.angle;
  if (lead.form == Lead::Form::arc_and_line) {
    const auto found = sweep_to_tangent(tool, center, to, turn, same_point);
    if (!found) return {};
    sweep = *found;
  }
  if (!(radius > same_point)) return {};
  if (sweep * std::abs(lead.radius) <= same_point) return LeadPath{.away = tool};
  const Vector arm = end.point - center;
  const Arc arc{.start = end.point,
                .end = sweep == full_turn ? end.point : Point(center + turned(arm, turn * sweep)),
                .center = center,
                .sweep = turn * sweep};
  return LeadPath{.contour = arc,
                  .away = parallel_point(arc.end, tangent_at_end(arc), end.shift())};
}

std::optional<LeadPath> path_to(const ContourEnd& begin, const Lead& lead, const Point& from,
                                double same_point) {
  auto path = path_from(backwards(begin), lead, from, same_point);
  if (path && path->contour) path->contour = backwards(*path->contour);
  return path;
}

}  // namespace trc
