#include "core/nc/dialect/sinumerik_arcs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/named_words.h"

// Polar words of Sinumerik, and its forms of arcs besides centres and radii.

namespace trc {
namespace {

using enum GGroup;

// AR=: the angle of the arc, with its end or its centre.
bool take_sweep(Reading& reading, ProgramLine& line, BlockWords& block) {
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  MoveRequest& move = block.move;
  const double sweep = *block.arc.sweep * std::numbers::pi / 180;
  const Point start =
      to_plane(reading.state.mode().plane, reading.state.position()) / reading.length_unit();
  const bool has_center = move.center[axes.first] || move.center[axes.second];
  const bool has_end = move.end[axes.first] || move.end[axes.second];
  if (!(*block.arc.sweep > 0 && *block.arc.sweep < 360))
    return reading.refuse(line, TextFault{.code = Code::nc_number,
                                          .begin = *block.center,
                                          .detail = "AR=, more than 0 and below 360"});
  if (has_center == has_end || move.radius)
    return reading.refuse(line, TextFault{.code = Code::circle_incomplete,
                                          .begin = *block.center,
                                          .detail = "AR= with either its end or its centre"});
  if (has_end) {
    const auto end_on = [&](std::size_t axis, double from) {
      return move.end[axis] ? *move.end[axis] + (reading.incremental ? from : 0) : from;
    };
    const Point end(end_on(axes.first, start.x()), end_on(axes.second, start.y()));
    const double radius = (end - start).norm() / (2 * std::sin(sweep / 2));
    move.radius = sweep > std::numbers::pi ? -radius : radius;
    return true;
  }
  const Vector arm =
      -Vector(move.center[axes.first].value_or(0), move.center[axes.second].value_or(0));
  const double turn = reading.motion == MotionKind::clockwise ? -sweep : sweep;
  const Vector turned = std::cos(turn) * arm + std::sin(turn) * left_of(arm);
  const Point end = start - arm + turned;
  move.end[axes.first] = end.x() - (reading.incremental ? start.x() : 0);
  move.end[axes.second] = end.y() - (reading.incremental ? start.y() : 0);
  return true;
}

// CIP: the circle through start, intermediate point and end.
bool take_point_between(Reading& reading, ProgramLine& line, BlockWords& block) {
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  MoveRequest& move = block.move;
  const auto wrong = [&](const char* why) {
    return reading.refuse(line, TextFault{.code = Code::circle_incomplete,
                                          .begin = block.axis.value_or(0),
                                          .detail = std::string("CIP, ").append(why)});
  };
  const auto& given = block.arc.through;
  if (given[axes.third] || (!given[axes.first] && !given[axes.second]))
    return wrong("whose point between names the two axes of the plane");
  const Point start =
      to_plane(reading.state.mode().plane, reading.state.position()) / reading.length_unit();
  // A coordinate of 0 may be omitted, but under G90 the arc does not start at 0. No manual says
  // whether all controls read it so.
  const auto is_clear = [&](std::size_t axis, double from) {
    return given[axis] || reading.incremental || from == 0;
  };
  if (!is_clear(axes.first, start.x()) || !is_clear(axes.second, start.y()))
    return wrong("whose point between names one axis alone under G90");
  const auto on = [&](const std::optional<double>& value, double from) {
    return value ? *value + (reading.incremental ? from : 0) : from;
  };
  const auto through = [&](std::size_t axis, double from) {
    if (!given[axis]) return from;
    const std::int8_t reference = block.references.through[axis];
    const bool counts_from_start = reference == 0 ? reading.incremental : reference < 0;
    return given[axis]->value + (counts_from_start ? from : 0);
  };
  const Point between(through(axes.first, start.x()), through(axes.second, start.y()));
  const Point end(on(move.end[axes.first], start.x()), on(move.end[axes.second], start.y()));
  const Vector a = between - start;
  const Vector b = end - start;
  const double twice_area = 2 * (a.x() * b.y() - a.y() * b.x());
  if (std::abs(twice_area) < 1e-9) return wrong("whose points lie in one line");
  const Vector center((b.y() * a.squaredNorm() - a.y() * b.squaredNorm()) / twice_area,
                      (a.x() * b.squaredNorm() - b.x() * a.squaredNorm()) / twice_area);
  move.center[axes.first] = center.x();
  move.center[axes.second] = center.y();
  reading.motion = twice_area > 0 ? MotionKind::counter_clockwise : MotionKind::clockwise;
  return true;
}

// AP=IC(…) and RP=IC(…) count from the previous word. Returns whether the value is known.
bool take_polar_word(const std::optional<BlockWords::Value>& word, bool increment,
                     std::optional<double>& value) {
  if (word && (!increment || value)) value = word->value + (increment ? *value : 0);
  return !word || !increment || value;
}

}  // namespace

bool read_polar_word(Reading& reading, const NamedWord& word, ProgramLine& line,
                     BlockWords& block) {
  auto& target = word.name == "AP" ? block.polar.angle : block.polar.radius;
  if (target)
    return reading.refuse(line, TextFault{.code = Code::nc_word_twice,
                                          .begin = word.begin,
                                          .detail = std::string(word.name)});
  target = {.value = word.value, .begin = word.begin};
  if (word.reference == NamedWord::Reference::incremental)
    (word.name == "AP" ? block.polar.increments_angle : block.polar.increments_radius) = true;
  add(line, word, WordRole::coordinate);
  return true;
}

void take_pole(Reading& reading, const BlockWords& block) {
  const bool clears = block.has(plane) || block.has(frame) || block.has(unit) ||
                      block.has(zero_shift) || block.has(unfollowed);
  const BlockWords::Function& pole = block.of(axis_technology);
  const int number = pole.function == nullptr ? 0 : pole.function->number;
  const bool sets = number >= 110 && number <= 112;
  if (!clears && !sets) return;
  reading.gcode.polar.angle.reset();
  reading.gcode.polar.radius.reset();
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  const auto& x = block.move.end[axes.first];
  const auto& y = block.move.end[axes.second];
  // A program without a pole of its own counts from its zero point.
  if (clears && (reading.gcode.polar.pole != Point(0, 0) || sets)) reading.gcode.polar.pole.reset();
  if (clears || !sets) return;
  Point base = Point::Zero();
  bool known = x && y && !block.polar.angle && !block.polar.radius;
  if (number == 110) {
    base = to_plane(reading.state.mode().plane, reading.state.position()) / reading.length_unit();
    known &= reading.state.is_known(axes.first) && reading.state.is_known(axes.second) &&
             !reading.contour_open();
  }
  if (number == 112) {
    known &= reading.gcode.polar.pole.has_value();
    base = reading.gcode.polar.pole.value_or(base);
  }
  reading.gcode.polar.pole.reset();
  if (known) reading.gcode.polar.pole = base + Point(*x, *y);
}

bool resolve_polar_words(Reading& reading, ProgramLine& line, BlockWords& block) {
  GcodeModes::Polar& polar = reading.gcode.polar;
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  auto& x = block.move.end[axes.first];
  auto& y = block.move.end[axes.second];
  const bool is_polar = block.polar.angle || block.polar.radius;
  if (!is_polar && (x || y)) {
    polar.angle.reset();
    polar.radius.reset();
  }
  if (!is_polar) return true;
  const std::uint32_t begin = std::min(block.polar.angle ? block.polar.angle->begin : ~0U,
                                       block.polar.radius ? block.polar.radius->begin : ~0U);
  const bool selects = block.selects();
  const bool both = block.polar.angle && block.polar.radius;
  // A copied line would depend on a word that the written program no longer has.
  const bool counts_on = !both || block.polar.increments_angle || block.polar.increments_radius;
  if (polar.rewritten && counts_on && !reading.contour_open() && !selects)
    return reading.refuse(line,
                          TextFault{.code = Code::nc_unsupported,
                                    .begin = begin,
                                    .detail = "AP= or RP= alone after a contour: write both"});
  if (selects || reading.contour_open()) polar.rewritten = true;
  if (both && !reading.contour_open() && !selects) polar.rewritten = false;
  const bool angle_known =
      take_polar_word(block.polar.angle, block.polar.increments_angle, polar.angle);
  const bool radius_known =
      take_polar_word(block.polar.radius, block.polar.increments_radius, polar.radius);
  const MotionKind kind =
      block.has(motion) ? motion_of_function(block.of(motion).function->number) : reading.motion;
  const bool circle = kind == MotionKind::clockwise || kind == MotionKind::counter_clockwise;
  const bool start_known =
      reading.state.is_known(axes.first) && reading.state.is_known(axes.second);
  const bool followed = polar.pole && polar.angle && polar.radius && !x && !y && !block.center &&
                        !reading.incremental && !block.of(dimension).is(91) && angle_known &&
                        radius_known && !block.to_skip && (!circle || start_known);
  if (circle && block.center && reading.trc_active())
    return reading.refuse(line,
                          TextFault{.code = Code::nc_unsupported,
                                    .begin = *block.center,
                                    .detail = "a centre or a radius of an arc beside AP=, RP="});
  if (!followed) {
    block.unfollowed_word = begin;
    polar.angle.reset();
    polar.radius.reset();
    return true;
  }
  const double angle = *polar.angle * std::numbers::pi / 180;
  const Point end = *polar.pole + *polar.radius * Point(std::cos(angle), std::sin(angle));
  x = end.x();
  y = end.y();
  if (!block.axis || begin < *block.axis) block.axis = begin;
  if (!circle) return true;
  const Point start =
      to_plane(reading.state.mode().plane, reading.state.position()) / reading.length_unit();
  block.move.center[axes.first] = polar.pole->x() - start.x();
  block.move.center[axes.second] = polar.pole->y() - start.y();
  block.center = begin;
  return true;
}

bool resolve_references(Reading& reading, ProgramLine& line, BlockWords& block) {
  MoveRequest& move = block.move;
  const Position& start = reading.state.position();
  const double unit = reading.length_unit();
  const auto refuse_unknown = [&](std::size_t axis) {
    return reading.refuse(line, TextFault{.code = Code::position_unknown,
                                          .begin = block.axis.value_or(block.center.value_or(0)),
                                          .detail = std::string(1, static_cast<char>('X' + axis))});
  };
  for (std::size_t axis = 0; axis < move.end.size(); ++axis) {
    const bool to_increment = block.references.end[axis] > 0 && reading.incremental;
    const bool to_absolute = block.references.end[axis] < 0 && !reading.incremental;
    if (!move.end[axis] || (!to_increment && !to_absolute)) continue;
    if (!reading.state.is_known(axis)) return refuse_unknown(axis);
    *move.end[axis] += (to_increment ? -1 : 1) * start[axis] / unit;
  }
  for (std::size_t axis = 0; axis < move.center.size(); ++axis) {
    if (!move.center[axis] || block.references.center[axis] <= 0) continue;
    if (!reading.state.is_known(axis)) return refuse_unknown(axis);
    *move.center[axis] -= start[axis] / unit;
  }
  return (!block.arc.sweep || take_sweep(reading, line, block)) &&
         (!block.arc.is_through || take_point_between(reading, line, block));
}

// CT continues the direction of the programmed contour (D-103).
bool take_tangent(Reading& reading, ProgramLine& line, BlockWords& block) {
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  MoveRequest& move = block.move;
  const auto wrong = [&](const char* why) {
    return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                          .begin = block.axis.value_or(block.center.value_or(0)),
                                          .detail = std::string("CT").append(why)});
  };
  const auto tangent = reading.state.tangent_of_contour();
  if (!tangent) return wrong(" without a motion in the plane before it");
  if (block.center) return wrong(" beside a centre or a radius");
  const Point start =
      to_plane(reading.state.mode().plane, reading.state.position()) / reading.length_unit();
  const auto on = [&](const std::optional<double>& value, double from) {
    return value ? *value + (reading.incremental ? from : 0) : from;
  };
  const Vector chord =
      Point(on(move.end[axes.first], start.x()), on(move.end[axes.second], start.y())) - start;
  const double across = cross(*tangent, chord);
  constexpr double straight = 1e-6;
  reading.motion = MotionKind::linear;
  if (std::abs(across) <= straight) return chord.dot(*tangent) >= 0 || wrong(" straight back");
  const Vector to_center = chord.squaredNorm() / (2 * across) * left_of(*tangent);
  move.center[axes.first] = to_center.x();
  move.center[axes.second] = to_center.y();
  reading.motion = across > 0 ? MotionKind::counter_clockwise : MotionKind::clockwise;
  return true;
}

bool take_angle(Reading& reading, ProgramLine& line, BlockWords& block) {
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  auto& first = block.move.end[axes.first];
  auto& second = block.move.end[axes.second];
  const bool straight = reading.motion == MotionKind::rapid || reading.motion == MotionKind::linear;
  const double angle = block.angle->value * std::numbers::pi / 180;
  const double along = first ? std::cos(angle) : std::sin(angle);
  constexpr double parallel = 1e-6;
  if (!straight || reading.gcode.tangent_arcs.in_force || first.has_value() == second.has_value() ||
      std::abs(along) < parallel)
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = block.angle->begin,
                        .detail = "the angle of a motion without one of its coordinates "
                                  "alone"});
  const Point start =
      to_plane(reading.state.mode().plane, reading.state.position()) / reading.length_unit();
  const double from = first ? start.x() : start.y();
  const double travel = (first ? *first : *second) - (reading.incremental ? 0 : from);
  const double across = travel / along * (first ? std::sin(angle) : std::cos(angle));
  const double other = first ? start.y() : start.x();
  (first ? second : first) = across + (reading.incremental ? 0 : other);
  return true;
}

}  // namespace trc
