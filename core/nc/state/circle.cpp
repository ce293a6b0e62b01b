#include "core/nc/state/circle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/turn.h"

namespace trc {
namespace {

// mm; on smaller arcs only the share of the radius limits the shift of a centre (D-41).
constexpr double small_radius = 20;
// mm; a shift that rounded coordinates cause on the smallest arcs is no misfit.
constexpr double rounded_shift = 0.01;

bool is_full_circle(const CircleEnds& ends, double same_point) {
  return (ends.end - ends.start).norm() <= same_point;
}

Arc full_circle(const Point& center, const CircleEnds& ends) {
  return {.start = ends.start,
          .end = ends.start,
          .center = center,
          .sweep = ends.clockwise ? -full_turn : full_turn};
}

Arc part_of_circle(const Point& center, const CircleEnds& ends) {
  double sweep = turn_between(ends.start - center, ends.end - center);
  if (ends.clockwise && sweep >= 0) sweep -= full_turn;
  if (!ends.clockwise && sweep <= 0) sweep += full_turn;
  return {.start = ends.start, .end = ends.end, .center = center, .sweep = sweep};
}

}  // namespace

// Seen from the programmed centre an arc of up to half a turn leads from one radius to the other; a
// longer arc also passes its extremes, in the directions of its chord.
double width_about(const Point& programmed_center, const Arc& arc) {
  if (std::abs(arc.sweep) > std::numbers::pi) return 2 * (arc.center - programmed_center).norm();
  return std::abs((arc.start - programmed_center).norm() - (arc.end - programmed_center).norm());
}

CircleResult arc_about(const Point& center, const CircleEnds& ends, const CircleCheck& check,
                       ArcUse use, const Tolerances& tolerances) {
  const double start_radius = (ends.start - center).norm();
  if (start_radius <= tolerances.same_point)
    return CircleFault{.code = Code::circle_radius_zero, .values = {{"radius", start_radius}}};
  if (is_full_circle(ends, tolerances.same_point)) return full_circle(center, ends);

  const double end_radius = (ends.end - center).norm();
  if (start_radius == end_radius) return part_of_circle(center, ends);

  // The valid centres lie on the perpendicular bisector of start and end; the nearest one is the
  // foot of the programmed centre on it.
  const Point middle = (ends.start + ends.end) / 2;
  const Vector chord = (ends.end - ends.start).normalized();
  const double shift = std::abs(chord.dot(center - middle));
  const Point corrected = middle + left_of(chord) * left_of(chord).dot(center - middle);
  const double radius = (ends.start - corrected).norm();
  const Arc arc = part_of_circle(corrected, ends);
  if (width_about(center, arc) <= rounded_width(check.last_digit)) return arc;

  if (check.correct_center) {
    const double smallest_radius = std::min({start_radius, end_radius, radius});
    const double limit =
        smallest_radius < small_radius
            ? std::max(rounded_shift, check.largest_shift_factor * smallest_radius)
            : std::max(check.largest_shift, check.largest_shift_factor * radius);  // D-35
    if (shift > limit)
      return CircleFault{.code = Code::circle_center_misfit,
                         .values = {{"start_radius", start_radius},
                                    {"end_radius", end_radius},
                                    {"corrected_radius", radius},
                                    {"center_shift", shift},
                                    {"largest_shift", limit}}};
  } else {
    const double difference = std::abs(start_radius - end_radius);
    const double limit = std::min(check.largest_radius_difference,
                                  check.largest_radius_factor * std::max(start_radius, end_radius));
    if (difference > limit)
      return CircleFault{.code = Code::circle_radii_differ,
                         .values = {{"start_radius", start_radius},
                                    {"end_radius", end_radius},
                                    {"largest_difference", limit}}};
    // The control runs a spiral here, which is not the circle about either centre.
    if (use == ArcUse::with_equidistant && difference > tolerances.on_contour)
      return CircleFault{.code = Code::arc_radii_differ,
                         .values = {{"start_radius", start_radius}, {"end_radius", end_radius}}};
  }
  return arc;
}

CircleResult arc_of_radius(double radius, const CircleEnds& ends, const CircleCheck& check,
                           const Tolerances& tolerances) {
  const double size = std::abs(radius);
  if (size <= tolerances.same_point)
    return CircleFault{.code = Code::circle_radius_zero, .values = {{"radius", radius}}};
  if (is_full_circle(ends, tolerances.same_point))
    return CircleFault{.code = Code::full_circle_with_radius_word, .values = {{"radius", radius}}};

  const double half_chord = (ends.end - ends.start).norm() / 2;
  // Half a digit of the radius, and of each end on both axes.
  const double rounded_shortfall = 1.25 * check.last_digit;
  if (half_chord - size > std::max(check.largest_radius_shortfall, rounded_shortfall))
    return CircleFault{.code = Code::circle_center_misfit,
                       .values = {{"radius", radius}, {"smallest_radius", half_chord}}};
  const double height = std::sqrt(std::max(0.0, size - half_chord) * (size + half_chord));
  const bool center_on_the_left = ends.clockwise == (radius < 0);
  const Vector left = left_of((ends.end - ends.start).normalized());
  const Point middle = (ends.start + ends.end) / 2;
  return part_of_circle(middle + (center_on_the_left ? height : -height) * left, ends);
}

}  // namespace trc
