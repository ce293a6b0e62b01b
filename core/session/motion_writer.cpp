#include "core/session/motion_writer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/nc/circle.h"
#include "core/nc/number_format.h"

namespace trc {
namespace {

constexpr std::string_view main_axis_letters = "XYZ";
constexpr std::string_view center_letters = "IJK";

// A B C turn: degrees have no inch.
bool is_linear(char axis_letter) { return axis_letter >= 'U' && axis_letter <= 'Z'; }

// How far an arc may leave its circle when its numbers are rounded, in units of the last decimal:
// of up to 180 degrees in its middle, one unit from its centre and half of one from its ends.
// Beyond that the ends turn it about each other, the more the nearer they are.
constexpr double short_arc_units = 1.5;
constexpr double long_arc_units = 5;
// A rounded arc turns by no more than this further or less, as a share of its sweep or in rad.
constexpr double sweep_share = 0.01;
constexpr double sweep_change = 1e-3;

// A written feed is wrong by no more than a thousandth.
constexpr std::int64_t least_feed_units = 500;

Point middle_of(const Arc& arc) {
  const Vector radial = arc.start - arc.center;
  return arc.center + std::cos(arc.sweep / 2) * radial + std::sin(arc.sweep / 2) * left_of(radial);
}

bool is_full_circle(const Arc& arc) { return arc.start == arc.end; }

bool is_same_arc(const Arc& read, const Arc& arc, double unit) {
  if (std::abs(read.sweep - arc.sweep) > std::max(sweep_change, sweep_share * std::abs(arc.sweep)))
    return false;
  const double radius = radius_of(arc);
  const double shift = (read.center - arc.center).norm();
  if (shift + std::abs(radius_of(read) - radius) <= short_arc_units * unit) return true;
  if (std::abs(arc.sweep) > std::numbers::pi)
    return shift + std::abs(radius_of(read) - radius) <= long_arc_units * unit;
  return std::abs((middle_of(read) - arc.center).norm() - radius) <= short_arc_units * unit;
}

}  // namespace

std::array<Arc, 2> halves_of(const Arc& arc) {
  const Point middle = middle_of(arc);
  const double half = arc.sweep / 2;
  return {Arc{.start = arc.start, .end = middle, .center = arc.center, .sweep = half},
          Arc{.start = middle, .end = arc.end, .center = arc.center, .sweep = half}};
}

MotionWriter::MotionWriter(int decimals, std::string tracking_letters)
    : decimals_(decimals),
      unit_of_mm_(from_units(1, decimals)),
      unit_of_inch_(from_units(1, decimals + 1) * mm_per_inch),
      tracking_letters_(std::move(tracking_letters)) {}

MotionWriter::Written MotionWriter::written(double value, bool inch) const {
  const std::int64_t units = to_units(inch ? value / mm_per_inch : value, decimals_of(inch));
  const double number = from_units(units, decimals_of(inch));
  return {.units = units, .read = inch ? number * mm_per_inch : number};
}

MotionWriter::Written MotionWriter::written_end(double target, double position, bool inch,
                                                bool incremental) const {
  if (!incremental) return written(target, inch);
  const Written step = written(target - position, inch);
  return {.units = step.units, .read = position + step.read};
}

// I, J, K: from the start of the arc, or absolute.
MotionWriter::Written MotionWriter::written_center(double center, double start,
                                                   const WrittenState& state) const {
  if (state.absolute_center) return written(center, state.inch);
  const Written step = written(center - start, state.inch);
  return {.units = step.units, .read = step.read + start};
}

bool MotionWriter::reaches_tracking(std::size_t axis, double target, double position,
                                    bool inch) const {
  return reaches(target, position, inch && is_linear(tracking_letters_[axis]));
}

MotionWriter::ArcNumbers MotionWriter::numbers_of(const Arc& arc, Plane plane,
                                                  const WrittenState& state) const {
  const Point start = to_plane(plane, state.position);
  const auto end = [&](double target, double position) {
    return written_end(target, position, state.inch, state.incremental);
  };
  ArcNumbers numbers{.end = {end(arc.end.x(), start.x()), end(arc.end.y(), start.y())},
                     .center = {written_center(arc.center.x(), start.x(), state),
                                written_center(arc.center.y(), start.y(), state)}};
  numbers.form = form_of(arc, numbers, plane, state);
  return numbers;
}

MotionWriter::ArcForm MotionWriter::form_of(const Arc& arc, const ArcNumbers& numbers, Plane plane,
                                            const WrittenState& state) const {
  const Tolerances tolerances;
  const Point start = to_plane(plane, state.position);
  const Point end(numbers.end[0].read, numbers.end[1].read);
  const Point center(numbers.center[0].read, numbers.center[1].read);

  const CircleCheck check;
  if ((center - start).norm() <= tolerances.same_point) return ArcForm::line;
  if (is_full_circle(arc)) return ArcForm::arc;
  const CircleEnds ends{.start = start, .end = end, .clockwise = arc.sweep < 0};
  const CircleResult result = arc_about(center, ends, check, false, tolerances);
  const Arc* read = std::get_if<Arc>(&result);
  if (read != nullptr && is_same_arc(*read, arc, unit(state.inch))) {
    // Controls that do not shift a centre compare the radii (G164).
    const double start_radius = (start - center).norm();
    const double difference = std::abs(start_radius - (end - center).norm());
    if (difference <=
        std::min(check.largest_radius_difference, check.largest_radius_factor * start_radius))
      return ArcForm::arc;
  }
  const double sagitta = radius_of(arc) * (1 - std::cos(arc.sweep / 2));
  return sagitta <= unit(state.inch) ? ArcForm::line : ArcForm::halves;
}

bool MotionWriter::moves(const Position& end, const TrackingTravel& tracking,
                         const WrittenState& state) const {
  for (std::size_t axis = 0; axis < end.size(); ++axis)
    if (!reaches(end[axis], state.position[axis], state.inch)) return true;
  for (std::size_t axis = 0; axis < tracking.size(); ++axis)
    if (!reaches_tracking(axis, tracking[axis].to, state.tracking[axis], state.inch)) return true;
  return false;
}

void MotionWriter::append_axes(std::string& out, AxisSet always, AxisSet never, const Position& end,
                               const TrackingTravel& tracking, const KnownNumbers& known,
                               WrittenState& state) const {
  const auto append_axis = [&](char letter, AxisSet bit, double target, const Written* number,
                               double& position) {
    if ((never & bit) != 0) return;
    const bool inch = state.inch && is_linear(letter);
    if ((always & bit) == 0 && reaches(target, position, inch)) return;
    const Written axis =
        number != nullptr ? *number : written_end(target, position, inch, state.incremental);
    append_word(out, letter, axis.units, decimals_of(inch));
    position = axis.read;
  };
  for (std::size_t axis = 0; axis < end.size(); ++axis)
    append_axis(main_axis_letters[axis], axis_bit(axis), end[axis], known[axis],
                state.position[axis]);
  for (std::size_t axis = 0; axis < tracking.size(); ++axis)
    append_axis(tracking_letters_[axis], axis_bit(end.size() + axis), tracking[axis].to, nullptr,
                state.tracking[axis]);
}

void MotionWriter::append_line(std::string& out, MotionKind kind, const Position& end,
                               const TrackingTravel& tracking, AxisSet always,
                               WrittenState& state) const {
  out += kind == MotionKind::rapid ? " G00" : " G01";
  append_axes(out, always, 0, end, tracking, {}, state);
  state.motion = kind;
}

void MotionWriter::append_arc(std::string& out, const Arc& arc, const ArcNumbers& numbers,
                              Plane plane, const Position& end, const TrackingTravel& tracking,
                              AxisSet always, WrittenState& state) const {
  const bool clockwise = arc.sweep < 0;
  const PlaneAxes axes = axes_of(plane);
  const AxisSet plane_axes = axis_bit(axes.first) | axis_bit(axes.second);
  // An end that rounds to another place than the start would not close the circle.
  const bool only_center =
      is_full_circle(arc) && (numbers.end[0].read != state.position[axes.first] ||
                              numbers.end[1].read != state.position[axes.second]);
  KnownNumbers known{};
  known[axes.first] = &numbers.end[0];
  known[axes.second] = &numbers.end[1];
  out += clockwise ? " G02" : " G03";
  append_axes(out, always | plane_axes, only_center ? plane_axes : 0, end, tracking, known, state);
  // The letters belong to the machine axes: in G18 the first axis of the plane is Z.
  const bool swapped = axes.first > axes.second;
  const std::array<std::size_t, 2> order =
      swapped ? std::array<std::size_t, 2>{1, 0} : std::array<std::size_t, 2>{0, 1};
  for (const std::size_t i : order)
    append_word(out, center_letters[i == 0 ? axes.first : axes.second], numbers.center[i].units,
                decimals_of(state.inch));
  state.motion = clockwise ? MotionKind::clockwise : MotionKind::counter_clockwise;
}

// A feed counts by its digits, not by its decimals: a slow one gets more of them,
// and none becomes F0.
MotionWriter::WrittenFeed MotionWriter::written_feed(double feed, bool inch) const {
  const double value = inch ? feed / mm_per_inch : feed;
  int decimals = decimals_of(inch);
  while (decimals < most_decimals && to_units(value, decimals) < least_feed_units) ++decimals;
  const std::int64_t units = std::max<std::int64_t>(to_units(value, decimals), 1);
  const double number = from_units(units, decimals);
  return {.units = units, .decimals = decimals, .read = inch ? number * mm_per_inch : number};
}

bool MotionWriter::same_feed(double a, double b, bool inch) const {
  return a == b || written_feed(a, inch).read == written_feed(b, inch).read;
}

void MotionWriter::append_feed(std::string& out, double feed, WrittenState& state) const {
  const WrittenFeed word = written_feed(feed, state.inch);
  append_word(out, 'F', word.units, word.decimals);
  state.feed = word.read;
}

}  // namespace trc
