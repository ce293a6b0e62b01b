#include "core/trc/selection/on_path.h"

#include <cmath>
#include <numbers>

namespace trc::selection {
namespace {

constexpr double pi = std::numbers::pi;

// The point of the programmed block at the distance of the tool radius from the
// corner, nearest to it along the block: before the corner on the way in, after it
// on the way out.
struct Departure {
  Point point = Point::Zero();
  double cut = 0;
};

enum class End { before, after };

double extent_of(const Segment& programmed) {
  const auto* arc = std::get_if<Arc>(&programmed);
  return arc != nullptr ? std::abs(arc->sweep) : length_of(programmed);
}

// A block as long as is needed, within 0.1 um (D-14), is left at its far end.
Departure within(const Segment& block, End end, const Departure& departure,
                 const Tolerances& tolerances) {
  const double extent = extent_of(block);
  const auto* arc = std::get_if<Arc>(&block);
  const double slack =
      arc != nullptr ? tolerances.on_contour / radius_of(*arc) : tolerances.on_contour;
  if (std::abs(departure.cut - extent) > slack) return departure;
  return {.point = end == End::before ? start_of(block) : end_of(block), .cut = extent};
}

std::optional<Departure> departure(const Segment& block, const OffsetCurve& path, double radius,
                                   End end, const Tolerances& tolerances) {
  if (!path.circular) {
    const double along = end == End::before ? -radius : radius;
    return within(block, end, {.point = path.anchor + along * path.tangent, .cut = radius},
                  tolerances);
  }
  std::optional<Departure> nearest;
  const Circle reach{.center = path.anchor, .radius = radius};
  for (const Point& point : intersect(path.circle, reach, tolerances.same_point)) {
    const double cut = end == End::before ? cut_before_anchor(path, point, tolerances.same_point)
                                          : cut_after_anchor(path, point, tolerances.same_point);
    if (!nearest || cut < nearest->cut) nearest = Departure{.point = point, .cut = cut};
  }
  if (nearest) nearest = within(block, end, *nearest, tolerances);
  return nearest;
}

// The swing around the corner, clockwise for G41.
Segment swing(const Corner& corner, const Point& from, const Point& to, AroundCorner around) {
  if (around == AroundCorner::line) return Line{.start = from, .end = to};
  const Point& center = corner.programmed;
  double sweep = turn_between(from - center, to - center);
  if (sweep * corner.shift > 0) sweep -= std::copysign(2 * pi, sweep);
  return Arc{.start = from, .end = to, .center = center, .sweep = sweep};
}

// Beyond 180 degrees a line would come nearer to the corner than the tool radius.
AroundCorner possible(AroundCorner wanted, double angle, const Tolerances& tolerances) {
  return angle <= pi + tolerances.tangent ? wanted : AroundCorner::arc;
}

// The block without limits: the whole circle, or a line as long as coordinates reach.
Segment unlimited(const Segment& block, const Tolerances& tolerances) {
  if (const auto* arc = std::get_if<Arc>(&block)) {
    Arc circle = *arc;
    circle.sweep = std::copysign(2 * pi, arc->sweep);
    return circle;
  }
  return Line{.start = Point::Zero(), .end = {2 * tolerances.largest_coordinate, 0}};
}

double length_of_cut(const Segment& block, double cut) {
  const auto* arc = std::get_if<Arc>(&block);
  return arc != nullptr ? cut * radius_of(*arc) : cut;
}

}  // namespace

std::optional<double> needed_on_path(const Corner& corner, const Segment& selection,
                                     const Vector& tangent, AroundCorner around,
                                     const Tolerances& tolerances) {
  const auto joint =
      approach_on_path(corner, unlimited(selection, tolerances), tangent, around, tolerances);
  if (!joint) return std::nullopt;
  return length_of_cut(selection, joint->cut_before);
}

std::optional<double> needed_off_path(const Corner& corner, const Segment& deselection,
                                      const Vector& tangent, AroundCorner around,
                                      const Tolerances& tolerances) {
  const auto joint =
      retract_on_path(corner, unlimited(deselection, tolerances), tangent, around, tolerances);
  if (!joint) return std::nullopt;
  return length_of_cut(deselection, joint->cut_after);
}

std::optional<Joint> approach_on_path(const Corner& corner, const Segment& selection,
                                      const Vector& tangent, AroundCorner around,
                                      const Tolerances& tolerances) {
  const OffsetCurve path = offset_curve(selection, tangent, corner.programmed, 0);
  const double angle = transition_angle(corner, tolerances);
  std::optional<Joint> joint;
  if (angle < pi / 2 - tolerances.tangent) {
    if (const auto meeting = nearest_meeting(path, corner.after, tolerances))
      joint = Joint(*meeting);
  } else if (const auto leave =
                 departure(selection, path, corner.tool_radius(), End::before, tolerances)) {
    joint.emplace();
    joint->cut_before = leave->cut;
    joint->end = leave->point;
    joint->start = corner.after.anchor;
    if ((joint->start - joint->end).norm() <= tolerances.same_point) {
      joint->end = joint->start;
    } else {
      joint->insert(swing(corner, joint->end, joint->start, possible(around, angle, tolerances)));
    }
  }
  if (joint && joint->cut_before > extent_of(selection)) joint.reset();
  return joint;
}

std::optional<Joint> retract_on_path(const Corner& corner, const Segment& deselection,
                                     const Vector& tangent, AroundCorner around,
                                     const Tolerances& tolerances) {
  const OffsetCurve path = offset_curve(deselection, tangent, corner.programmed, 0);
  const double angle = transition_angle(corner, tolerances);
  std::optional<Joint> joint;
  if (angle < pi / 2 - tolerances.tangent) {
    if (const auto meeting = nearest_meeting(corner.before, path, tolerances))
      joint = Joint(*meeting);
  } else if (const auto arrive =
                 departure(deselection, path, corner.tool_radius(), End::after, tolerances)) {
    joint.emplace();
    joint->cut_after = arrive->cut;
    joint->end = corner.before.anchor;
    joint->start = arrive->point;
    if ((joint->start - joint->end).norm() <= tolerances.same_point) {
      joint->start = joint->end;
    } else {
      joint->insert(swing(corner, joint->end, joint->start, possible(around, angle, tolerances)));
    }
  }
  if (joint && joint->cut_after > extent_of(deselection)) joint.reset();
  return joint;
}

}  // namespace trc::selection
