#include "core/nc/state/corner_cut.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/geometry/intersect.h"
#include "core/geometry/parallel.h"
#include "core/geometry/turn.h"

namespace trc {
namespace {

constexpr double nearly_back = std::numbers::pi - 1e-3;

// The distance of the point along the segment, mm; the point lies on its line or circle.
double way_to(const Segment& segment, const Point& point) {
  if (const auto* line = std::get_if<Line>(&segment))
    return (point - line->start).dot(tangent_of(*line));
  const Arc& arc = std::get<Arc>(segment);
  const double turn = arc.sweep > 0 ? 1 : -1;
  double angle = turn * turn_between(arc.start - arc.center, point - arc.center);
  if (angle < 0) angle += full_turn;
  return angle * radius_of(arc);
}

Segment ended_at(const Segment& segment, const Point& point) {
  if (const auto* line = std::get_if<Line>(&segment)) return Line{line->start, point};
  Arc arc = std::get<Arc>(segment);
  arc.sweep = std::copysign(way_to(segment, point) / radius_of(arc), arc.sweep);
  arc.end = point;
  return arc;
}

Segment begun_at(const Segment& segment, const Point& point) {
  if (const auto* line = std::get_if<Line>(&segment)) return Line{point, line->end};
  Arc arc = std::get<Arc>(segment);
  arc.sweep -= std::copysign(way_to(segment, point) / radius_of(arc), arc.sweep);
  arc.start = point;
  return arc;
}

// The centres of the circles that touch the segment from the side of `shift`.
struct Parallel {
  std::optional<StraightLine> line{};
  std::optional<Circle> circle{};
};

std::optional<Parallel> parallel_to(const Segment& segment, double shift, double same_point) {
  if (const auto* line = std::get_if<Line>(&segment)) {
    const Vector tangent = tangent_of(*line);
    return Parallel{.line = StraightLine{parallel_point(line->start, tangent, shift), tangent}};
  }
  const Arc& arc = std::get<Arc>(segment);
  const double radius = parallel_radius(arc, shift);
  if (radius <= same_point) return {};
  return Parallel{.circle = Circle{arc.center, radius}};
}

Meetings meetings_of(const Parallel& a, const Parallel& b, double same_point) {
  if (a.line && b.line) return intersect(*a.line, *b.line);
  if (a.line) return intersect(*a.line, *b.circle, same_point);
  if (b.line) return intersect(*b.line, *a.circle, same_point);
  return intersect(*a.circle, *b.circle, same_point);
}

// The point where a circle about the centre touches the segment.
Point touched(const Segment& segment, const Point& center) {
  if (const auto* line = std::get_if<Line>(&segment)) {
    const Vector tangent = tangent_of(*line);
    return line->start + (center - line->start).dot(tangent) * tangent;
  }
  const Arc& arc = std::get<Arc>(segment);
  return arc.center + radius_of(arc) * (center - arc.center).normalized();
}

std::optional<CutCorner> round_corner(const Segment& before, const Segment& after, double turn,
                                      double radius, double same_point) {
  const double shift = turn > 0 ? radius : -radius;
  const auto first = parallel_to(before, shift, same_point);
  const auto second = parallel_to(after, shift, same_point);
  if (!first || !second) return {};
  const Point corner = end_of(before);
  std::optional<Point> nearest;
  for (const Point& center : meetings_of(*first, *second, same_point)) {
    const double on_before = way_to(before, touched(before, center));
    const double on_after = way_to(after, touched(after, center));
    const bool has_room = on_before > same_point && on_before < length_of(before) - same_point &&
                          on_after > same_point && on_after < length_of(after) - same_point;
    if (has_room && (!nearest || (center - corner).norm() < (*nearest - corner).norm()))
      nearest = center;
  }
  if (!nearest) return {};
  const Segment cut_before = ended_at(before, touched(before, *nearest));
  const Segment cut_after = begun_at(after, touched(after, *nearest));
  double sweep = turn_between(tangent_at_end(cut_before), tangent_at_start(cut_after));
  if (sweep * turn < 0) sweep += turn > 0 ? full_turn : -full_turn;
  return CutCorner{.before = cut_before,
                   .between = Arc{.start = end_of(cut_before),
                                  .end = start_of(cut_after),
                                  .center = *nearest,
                                  .sweep = sweep},
                   .after = cut_after};
}

std::optional<CutCorner> cut_lines(const Line& before, const Line& after, const CornerCut& cut,
                                   const Tolerances& tolerances) {
  const Vector in = tangent_of(before);
  const Vector out = tangent_of(after);
  const double turn = turn_between(in, out);
  double leg = cut.size;
  if (cut.form == CornerCut::Form::round) leg = cut.size * std::tan(std::abs(turn) / 2);
  if (cut.form == CornerCut::Form::width) leg = cut.size / (2 * std::cos(turn / 2));
  const double shorter = std::min(length_of(before), length_of(after));
  if (!(leg > tolerances.same_point && leg <= shorter + tolerances.input_resolution)) return {};
  // Two roundings may meet, as at the end of a slot: a gap between them within rounding of
  // coordinates is removed (D-63).
  double size = cut.size;
  if (std::abs(shorter - leg) <= tolerances.input_resolution) {
    size *= shorter / leg;
    leg = shorter;
  }
  const Point begin = leg == length_of(before) ? before.start : Point(before.end - leg * in);
  const Point end = leg == length_of(after) ? after.end : Point(after.start + leg * out);
  CutCorner corner{.before = Line{before.start, begin}, .after = Line{end, after.end}};
  if (cut.form != CornerCut::Form::round) {
    corner.between = Line{.start = begin, .end = end};
    return corner;
  }
  const Vector to_center = turn > 0 ? left_of(in) : Vector(-left_of(in));
  corner.between =
      Arc{.start = begin, .end = end, .center = begin + size * to_center, .sweep = turn};
  return corner;
}

}  // namespace

bool turns_back(const Segment& before, const Segment& after) {
  return std::abs(turn_between(tangent_at_end(before), tangent_at_start(after))) > nearly_back;
}

std::optional<CutCorner> cut_corner(const Segment& before, const Segment& after,
                                    const CornerCut& cut, const Tolerances& tolerances) {
  const double same_point = tolerances.same_point;
  if (std::min(length_of(before), length_of(after)) <= same_point) return {};
  if (turns_back(before, after)) return {};
  const double turn = turn_between(tangent_at_end(before), tangent_at_start(after));
  if (!is_arc(before) && !is_arc(after))
    return cut_lines(std::get<Line>(before), std::get<Line>(after), cut, tolerances);
  if (cut.form != CornerCut::Form::round || std::abs(turn) <= tolerances.tangent) return {};
  return round_corner(before, after, turn, cut.size, same_point);
}

}  // namespace trc
