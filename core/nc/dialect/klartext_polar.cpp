#include "core/nc/dialect/klartext_polar.h"

#include <cmath>
#include <optional>
#include <utility>

#include "core/messages/diagnostic_text.h"
#include "core/nc/dialect/heidenhain.h"
#include "core/nc/dialect/klartext_statements.h"

// The pole of Klartext, and positions that count from it.

namespace trc {
namespace {

// CC X Z of a tool along Z: rotations about this pole are copied.
bool take_pole_across(Reading& reading, ProgramLine& line, const KlartextBlock& block) {
  if (reading.contour_open())
    return refuse_klartext(reading, line, block.begin, "CC across the plane");
  AxisBits named = 0;
  for (std::size_t axis = 0; axis < block.end.size(); ++axis)
    if (block.end[axis]) named |= main_axis_bit(axis);
  reading.klartext_modes.pole_across = (named & (named - 1)) != 0 ? named : all_axes;
  lose_klartext_pole(reading, line);
  line.klartext->loses_pole = true;
  return true;
}

}  // namespace

bool take_klartext_pole(Reading& reading, ProgramLine& line, KlartextBlock& block) {
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  if (!block.tracking.empty())
    return refuse_klartext(reading, line, block.begin, "CC with an axis that turns");
  reading.klartext_modes.pole_across = 0;
  if (!reading.contour_open()) reading.klartext_modes.pole_said = reading.klartext_modes.contours;
  if (block.end[axes.third]) return take_pole_across(reading, line, block);
  const bool alone = !block.end[axes.first] && !block.end[axes.second];
  const std::optional<Point> old = reading.klartext_modes.pole;
  Point pole = old.value_or(Point::Zero());
  bool known = true;
  bool stands_unknown = false;
  for (const auto& [axis, coordinate] :
       {std::pair{axes.first, &pole.x()}, std::pair{axes.second, &pole.y()}}) {
    const auto& word = block.end[axis];
    const bool from_tool = alone || (word && word->increment);
    stands_unknown |= from_tool && !reading.state.is_known(axis);
    known = known && !stands_unknown && (from_tool || word.has_value() || old.has_value());
    const double base = from_tool ? reading.state.position()[axis] : 0;
    if (word || alone) *coordinate = base + (word ? word->value * reading.length_unit() : 0);
  }
  if (stands_unknown) lose_klartext_pole(reading, line);
  reading.klartext_modes.pole = known ? std::optional(pole) : std::nullopt;
  line.klartext->sets_pole = known;
  line.klartext->loses_pole = !known;
  return true;
}

bool refuse_without_pole(Reading& reading, const ProgramLine& line, const KlartextBlock& block) {
  const Source& lost = reading.klartext_modes.pole_lost;
  return refuse_klartext(
      reading, line, block.begin,
      block.title() + (lost.line == 0
                           ? " without CC of both axes"
                           : ", whose pole is unknown since the change " + place_of(lost)));
}

bool find_polar_end(Reading& reading, ProgramLine& line, KlartextBlock& block, const Point& start,
                    Point& end) {
  KlartextLine& says = *line.klartext;
  const auto wrong = [&](const char* why, Code code = Code::nc_unsupported) {
    return refuse_klartext(reading, line, block.begin, block.title() + why, code);
  };
  if (!reading.klartext_modes.pole) return refuse_without_pole(reading, line, block);
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  const auto stands_at_known_place = [&] {
    return reading.state.is_known(axes.first) && reading.state.is_known(axes.second);
  };
  constexpr const char* unknown_start = ", from a place that is not known";
  constexpr Code unknown = Code::position_unknown;
  const Vector arm = start - *reading.klartext_modes.pole;
  const bool circle = block.is(KlartextStatement::polar_circle);
  says.needs_pole = true;
  double radius = arm.norm();
  if (!circle) {
    says.sets_polar_radius = block.polar_radius.has_value();
    const bool counts_on = !block.polar_radius || block.polar_radius->increment;
    says.needs_polar_radius = counts_on && reading.klartext_modes.polar_radius;
    // An IPR without an earlier PR counts from the tool position.
    const bool from_tool = counts_on && block.polar_radius && !reading.klartext_modes.polar_radius;
    says.counts_from_start |= from_tool;
    if (counts_on && !says.needs_polar_radius && !from_tool) return wrong(" without PR");
    if (from_tool && !stands_at_known_place()) return wrong(unknown_start, unknown);
    radius = (says.needs_polar_radius ? *reading.klartext_modes.polar_radius
              : from_tool             ? arm.norm()
                                      : 0) +
             (block.polar_radius ? block.polar_radius->value * reading.length_unit() : 0);
    reading.klartext_modes.polar_radius = radius;
  }
  const bool from_start = !block.polar_angle || block.polar_angle->increment;
  says.counts_from_start |= from_start || circle;
  if ((from_start || circle) && !stands_at_known_place()) return wrong(unknown_start, unknown);
  if ((from_start || circle) && arm.norm() < 1e-6) return wrong(", from the pole itself");
  const double begin = std::atan2(arm.y(), arm.x());
  const double angle = (from_start ? begin : 0) +
                       (block.polar_angle ? block.polar_angle->value * radians_per_degree : 0);
  end = *reading.klartext_modes.pole + radius * Vector(std::cos(angle), std::sin(angle));
  return true;
}

}  // namespace trc
