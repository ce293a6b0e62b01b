#include "core/trc/corner/corner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trc {
namespace {

constexpr double pi = std::numbers::pi;

Meetings meetings_of(const OffsetCurve& a, const OffsetCurve& b, double same_point) {
  const StraightLine line_a{.point = a.anchor, .direction = a.tangent};
  const StraightLine line_b{.point = b.anchor, .direction = b.tangent};
  if (!a.circular && !b.circular) return intersect(line_a, line_b);
  if (!a.circular) return intersect(line_a, b.circle, same_point);
  if (!b.circular) return intersect(line_b, a.circle, same_point);
  return intersect(a.circle, b.circle, same_point);
}

// The angle travelled on the circle from `from` to `to`, in its sense. A point up
// to `slack` mm behind counts as behind, not as almost a full turn ahead.
double travelled(const OffsetCurve& curve, const Point& from, const Point& to, double slack) {
  const Point& center = curve.circle.center;
  double angle = turn_between(from - center, to - center);
  if (!curve.counter_clockwise) angle = -angle;
  if (angle < -slack / curve.circle.radius) angle += 2 * pi;
  return angle;
}

double length_of_cut(const OffsetCurve& curve, double cut) {
  return curve.circular ? cut * curve.circle.radius : cut;
}

// How far outside its block a meeting may seem to lie by rounding alone: at a nearly
// tangential corner, the place of a meeting along the curves is the less exact, the
// smaller the turn. It is still on both curves.
double slack_of(const OffsetCurve& before, const OffsetCurve& after, const Tolerances& tolerances) {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const double size = before.anchor.cwiseAbs().sum() +
                      (before.circular ? before.circle.radius : 0) +
                      (after.circular ? after.circle.radius : 0);
  const double sine = std::abs(cross(before.tangent, after.tangent));
  const double of_place = rounding * size / std::max(sine, tolerances.tangent);
  // With a tool of hundreds of metres, one point is wider than `on_contour`.
  return std::max(std::min(of_place, tolerances.on_contour), tolerances.same_point);
}

// The gap between the two blocks along their common length, positive on the side of the shift: the
// first gap that counts, 0 if there is none. An angle and the curvatures part the blocks.
double gap_of_reversal(const Corner& corner, const Segment& before, const Segment& after,
                       const Tolerances& tolerances) {
  double opening = 0;  // curvature by which the second block leaves the first to its right
  double reach = std::numeric_limits<double>::infinity();
  for (const Segment* segment : {&before, &after}) {
    reach = std::min(reach, length_of(*segment));
    if (const auto* arc = std::get_if<Arc>(segment)) {
      const double radius = radius_of(*arc);
      opening += arc->sweep > 0 ? 1 / radius : -1 / radius;
      reach = std::min(reach, radius);
    }
  }
  const double side = corner.shift > 0 ? 1 : -1;
  const double bend = -side * opening;
  const double angle = side * corner.sine_of_turn();
  const auto gap_at = [&](double way) { return way * (angle + 0.5 * bend * way); };
  // Until it closes again, the gap is widest halfway.
  const double widest = bend != 0 ? -angle / bend : -1;
  const bool turns_over = widest > 0 && widest < reach;
  if (turns_over && std::abs(gap_at(widest)) > tolerances.input_resolution) return gap_at(widest);
  const double last = gap_at(reach);
  return std::abs(last) > tolerances.input_resolution ? last : 0;
}

}  // namespace

Reversal reversal_of(const Corner& corner, const Segment& before, const Segment& after,
                     const Tolerances& tolerances) {
  if (!may_reverse(corner)) return Reversal::none;
  return gap_of_reversal(corner, before, after, tolerances) > 0 ? Reversal::slit : Reversal::tip;
}

double outside_sweep(const Corner& corner) {
  // A reversal may have fallen on either side of 180 degrees.
  const double turn = corner.turn();
  const bool away = turn * corner.shift < 0;
  return away ? turn : turn - std::copysign(2 * pi, turn);
}

double transition_angle(const Corner& corner, const Tolerances& tolerances) {
  switch (kind_of(corner, tolerances)) {
    case CornerKind::tangential:
      return pi;
    case CornerKind::inside:
      return pi - std::abs(corner.turn());
    case CornerKind::outside:
      break;
  }
  return pi + std::abs(outside_sweep(corner));
}

// Both blocks share Q (D-148).
Joint tangential_joint(const Corner& corner) {
  Joint joint;
  joint.end = corner.before.anchor;
  joint.start = joint.end;
  return joint;
}

Joint joint_across(const Point& end, const Point& start) {
  Joint joint;
  joint.end = end;
  joint.start = start;
  joint.insert(Line{.start = end, .end = start});
  return joint;
}

double cut_before_anchor(const OffsetCurve& curve, const Point& point, double slack) {
  return curve.circular ? travelled(curve, point, curve.anchor, slack)
                        : (curve.anchor - point).dot(curve.tangent);
}

double cut_after_anchor(const OffsetCurve& curve, const Point& point, double slack) {
  return curve.circular ? travelled(curve, curve.anchor, point, slack)
                        : (point - curve.anchor).dot(curve.tangent);
}

std::optional<MeetingPoint> nearest_meeting(const OffsetCurve& before, const OffsetCurve& after,
                                            const Tolerances& tolerances) {
  const double slack = slack_of(before, after, tolerances);
  std::optional<MeetingPoint> nearest;
  double nearest_after = std::numeric_limits<double>::infinity();
  double nearest_before = nearest_after;
  for (const Point& point : meetings_of(before, after, tolerances.same_point)) {
    // On a line the place is cheap to find, on a circle it takes an angle.
    if (!before.circular && cut_before_anchor(before, point, slack) < -slack) continue;
    const double cut_after = cut_after_anchor(after, point, slack);
    const double length_after = length_of_cut(after, cut_after);
    const bool tied = std::abs(length_after - nearest_after) <= tolerances.same_point;
    if (length_after < -slack || (!tied && length_after >= nearest_after)) continue;
    const double cut_before = cut_before_anchor(before, point, slack);
    const double length_before = length_of_cut(before, cut_before);
    if (length_before < -slack || (tied && length_before >= nearest_before)) continue;
    nearest_after = length_after;
    nearest_before = length_before;
    nearest = {.point = point, .cut_before = cut_before, .cut_after = cut_after};
  }
  return nearest;
}

Joint outside_joint(const Corner& corner, const TransitionRule& rule,
                    const Tolerances& tolerances) {
  const Point& q = corner.before.anchor;
  const Point& p = corner.after.anchor;
  const double sweep = outside_sweep(corner);
  Joint joint;
  joint.end = q;
  joint.start = p;
  if (rule.transition == Transition::circular) {
    joint.insert(Arc{.start = q, .end = p, .center = corner.programmed, .sweep = sweep});
    return joint;
  }
  const double stretch = rule.stretch_factor * corner.tool_radius();
  const double extension = std::abs(sweep) < pi - tolerances.tangent
                               ? corner.tool_radius() * std::tan(std::abs(sweep) / 2)
                               : std::numeric_limits<double>::infinity();
  const bool reaches = extension <= stretch + tolerances.same_point;
  const double length = reaches ? extension : stretch;
  const Point end = reaches ? mitre_point(corner) : Point(q + length * corner.before.tangent);
  const Point start = reaches ? end : Point(p - length * corner.after.tangent);
  if (corner.before.circular) {
    joint.insert(Line{.start = q, .end = end});
  } else {
    joint.end = end;
    joint.cut_before = -length;
  }
  if (!reaches) joint.insert(Line{.start = end, .end = start});
  if (corner.after.circular) {
    joint.insert(Line{.start = start, .end = p});
  } else {
    joint.start = start;
    joint.cut_after = -length;
  }
  return joint;
}

std::optional<Joint> extended_joint(const Corner& corner, const Tolerances& tolerances) {
  if (!corner.before.circular && !corner.after.circular)
    return outside_joint(corner, {.transition = Transition::linear}, tolerances);
  const double reach = 2 * corner.tool_radius() * std::tan(pi / 180);
  std::optional<Joint> nearest;
  double nearest_distance = reach;
  for (const Point& point : meetings_of(corner.before, corner.after, tolerances.same_point)) {
    const double distance =
        std::max((point - corner.before.anchor).norm(), (point - corner.after.anchor).norm());
    if (distance > nearest_distance) continue;
    nearest_distance = distance;
    nearest.emplace();
    nearest->end = nearest->start = point;
    nearest->cut_before = cut_before_anchor(corner.before, point, 2 * reach);
    nearest->cut_after = cut_after_anchor(corner.after, point, 2 * reach);
  }
  return nearest;
}

}  // namespace trc
