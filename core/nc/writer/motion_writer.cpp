#include "core/nc/writer/motion_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "core/geometry/turn.h"
#include "core/nc/state/circle.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/number_format.h"

namespace trc {
namespace {

constexpr std::string_view main_axis_letters = "XYZ";
constexpr std::string_view center_letters = "IJK";

// The most that an arc may leave its circle when its numbers are rounded, in units of the last
// decimal. Up to 180 degrees, in its middle: one unit due to its centre and half a unit due to its
// ends. Beyond that the ends turn the arc about each other, the more the nearer they are.
constexpr double short_arc_units = 1.5;
constexpr double long_arc_units = 5;
// A rounded arc turns by at most this much more or less, as a share of its sweep or in rad.
constexpr double sweep_share = 0.01;
constexpr double sweep_change = 1e-3;

// A written feed is wrong by at most a thousandth.
constexpr std::int64_t least_feed_units = 500;

Point middle_of(const Arc& arc) {
  const Vector radial = arc.start - arc.center;
  return arc.center + std::cos(arc.sweep / 2) * radial + std::sin(arc.sweep / 2) * left_of(radial);
}

// " X30.": a blank, the address letter, the number and a decimal point.
constexpr std::size_t room_of_word = 3 + room_of_units;

// " G01"
char* write_function(char* at, char digit) {
  constexpr std::array<char, 3> begin{' ', 'G', '0'};
  at = std::ranges::copy(begin, at).out;
  *at++ = digit;
  return at;
}

char* write_name(char* at, std::string_view name) { return std::ranges::copy(name, at).out; }

bool is_full_circle(const Arc& arc) { return arc.start == arc.end; }

double sagitta_of(const Arc& arc) { return radius_of(arc) * (1 - std::cos(arc.sweep / 2)); }

// A control that counts in thousandths of a millimetre, or ten-thousandths of an inch, takes both
// ends of such a short arc for one point, and runs a full circle (D-97). `squared_chord`: mm².
bool may_become_circle(const Arc& arc, double squared_chord, LengthUnit unit) {
  const double near = 1.5 * (unit == LengthUnit::inch ? mm_per_inch / 10'000 : 0.001);
  return squared_chord < near * near && std::abs(arc.sweep) < std::numbers::pi;
}

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

// The numbers of an arc as a reader reads them.
struct ReadArc {
  Point start = Point::Zero();
  Point end = Point::Zero();
  Point center = Point::Zero();
};

double size_of(const Vector& v) { return std::abs(v.x()) + std::abs(v.y()); }

// Whether the reader certainly runs the same arc. True only if form_of also returns `arc`; form_of
// uses arc_about, is_same_arc and the radii, while this comparison uses no angle. Every limit is a
// tenth below that of form_of, so that rounding in the two computations, and a sweep that differs
// slightly from its points, cannot matter.
bool is_surely_read_alike(const ReadArc& read, const Arc& arc, double unit) {
  constexpr CircleCheck check;
  constexpr Tolerances tolerances;
  const double sweep = std::abs(arc.sweep);
  if (sweep < 2 * sweep_change || sweep > full_turn - 2 * sweep_change) return false;

  // As in arc_about: the centre goes to the perpendicular bisector of start and end.
  const Vector chord = read.end - read.start;
  const double length = chord.norm();
  if (length < 100 * tolerances.same_point) return false;
  const Vector along = chord / length;
  const Point middle = (read.start + read.end) / 2;
  const double height = left_of(along).dot(read.center - middle);
  const double shift = std::abs(along.dot(read.center - middle));
  const double radius = std::sqrt(height * height + length * length / 4);
  if (shift > 0.9 * check.largest_shift) return false;
  // The radii at start and end, whose sum is at least twice the one in between, differ by no more
  // than shift * length / radius, and are no smaller than radius - shift.
  if (shift * length >
      0.9 * radius *
          std::min(check.largest_radius_difference, check.largest_radius_factor * (radius - shift)))
    return false;

  // The directions from the centre to start and end turn by no more than the arc's points move,
  // divided by the radius; the factor covers the difference between arc and chord as well.
  const Point center = middle + height * left_of(along);
  const double true_radius = radius_of(arc);
  const double moved = (center - arc.center).norm();
  if (size_of(read.start - arc.start) + size_of(read.end - arc.end) + 2 * moved >
      0.8 * sweep_change * true_radius)
    return false;

  constexpr double limit = 0.9 * short_arc_units;
  if (moved + std::abs(radius - true_radius) <= limit * unit) return true;
  if (sweep > std::numbers::pi - sweep_change) return false;
  // A counter-clockwise arc bulges to the right of its chord.
  const Point summit = center - std::copysign(radius, arc.sweep) * left_of(along);
  return std::abs((summit - arc.center).norm() - true_radius) <= limit * unit;
}

}  // namespace

std::array<Arc, 2> halves_of(const Arc& arc) {
  const Point middle = middle_of(arc);
  const double half = arc.sweep / 2;
  return {Arc{.start = arc.start, .end = middle, .center = arc.center, .sweep = half},
          Arc{.start = middle, .end = arc.end, .center = arc.center, .sweep = half}};
}

MotionWriter::MotionWriter(int decimals, std::string tracking_letters, Spelling spelling,
                           std::vector<std::string> tracking_names, int most_digits)
    : tracking_letters_(std::move(tracking_letters)),
      tracking_names_(std::move(tracking_names)),
      spelling_(spelling) {
  write_at_least(decimals);
  allow_digits(most_digits);
  tracking_names_.resize(tracking_letters_.size());
  for (const std::string& name : tracking_names_)
    longest_name_ = std::max(longest_name_, name.size());
}

void MotionWriter::write_at_least(int decimals) {
  decimals_ = std::max(decimals_, decimals);
  last_decimal_of_mm_ = from_units(1, decimals_);
  last_decimal_of_inch_ = from_units(1, decimals_ + 1) * mm_per_inch;
}

void MotionWriter::allow_digits(int most) {
  largest_units_ =
      most > most_decimals ? std::numeric_limits<std::int64_t>::max() : units_per_one(most) - 1;
}

std::optional<std::size_t> MotionWriter::axis_named(std::string_view name) const {
  const auto found = std::ranges::find_if(tracking_names_, [&](const std::string& each) {
    return !each.empty() && same_name(each, name);
  });
  if (found == tracking_names_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - tracking_names_.begin());
}

// A B C are rotary: degrees do not scale with inches.
LengthUnit MotionWriter::unit_of_axis(std::size_t axis, LengthUnit of_lengths) const {
  const std::string& name = tracking_names_[axis];
  const char letter = name.empty() ? tracking_letters_[axis] : name.front();
  return letter >= 'U' && letter <= 'Z' ? of_lengths : LengthUnit::mm;
}

// For the words of one motion: a function, three axes and two words for the centre, and the
// tracking axes.
char* MotionWriter::room_of_motion(TextBuffer& out, const TrackingTravel& tracking) const {
  return out.room((6 + tracking.size()) * (room_of_word + longest_name_));
}

// Zeros after the point do not come out.
void MotionWriter::count_digits(std::int64_t units, int decimals) {
  for (; decimals > 0 && units % 10 == 0; --decimals) units /= 10;
  const int digits = static_cast<int>(std::to_string(std::abs(units)).size());
  if (std::abs(units) > largest_units_) digits_written_ = std::max(digits_written_, digits);
}

inline char* MotionWriter::write_word(char* at, char letter, std::int64_t units, int decimals) {
  if (std::abs(units) > largest_units_) count_digits(units, decimals);
  *at++ = ' ';
  *at++ = letter;
  if (spelling_.klartext && units >= 0 && letter != 'F') *at++ = '+';
  at = write_units(at, units, decimals);
  if (spelling_.points && units % units_per_one(decimals) == 0) *at++ = '.';
  return at;
}

// I, J, K: from the start of the arc, or absolute.
MotionWriter::Written MotionWriter::written_center(double center, double start,
                                                   const WrittenState& state) const {
  if (state.absolute_center) return written(center, state.unit);
  const Written step = written(center - start, state.unit);
  return {.units = step.units, .read = step.read + start};
}

bool MotionWriter::reaches_tracking(std::size_t axis, double target, double position,
                                    LengthUnit unit) const {
  return reaches(target, position, unit_of_axis(axis, unit));
}

MotionWriter::ArcNumbers MotionWriter::numbers_of(const Arc& arc, Plane plane,
                                                  const WrittenState& state) const {
  const Point start = to_plane(plane, state.position);
  const auto end = [&](double target, double position) {
    return written_end(target, position, state.unit, state.incremental);
  };
  ArcNumbers numbers{.end = {end(arc.end.x(), start.x()), end(arc.end.y(), start.y())},
                     .center = {written_center(arc.center.x(), start.x(), state),
                                written_center(arc.center.y(), start.y(), state)}};
  const ReadArc read{.start = start,
                     .end = {numbers.end[0].read, numbers.end[1].read},
                     .center = {numbers.center[0].read, numbers.center[1].read}};
  if (may_become_circle(arc, (read.end - read.start).squaredNorm(), state.unit) ||
      !is_surely_read_alike(read, arc, last_decimal(state.unit)))
    numbers.form = form_of(arc, numbers, plane, state);
  return numbers;
}

MotionWriter::ArcForm MotionWriter::form_of(const Arc& arc, const ArcNumbers& numbers, Plane plane,
                                            const WrittenState& state) const {
  const Tolerances tolerances;
  const Point start = to_plane(plane, state.position);
  const Point end(numbers.end[0].read, numbers.end[1].read);
  const Point center(numbers.center[0].read, numbers.center[1].read);

  if (may_become_circle(arc, (end - start).squaredNorm(), state.unit) &&
      sagitta_of(arc) <= last_decimal(state.unit))
    return ArcForm::line;
  // Controls do not allow for rounding.
  const CircleCheck check{.last_digit = 0};
  if ((center - start).norm() <= tolerances.same_point) return ArcForm::line;
  if (is_full_circle(arc)) return ArcForm::arc;
  const CircleEnds ends{.start = start, .end = end, .clockwise = arc.sweep < 0};
  const CircleResult result = arc_about(center, ends, check, ArcUse::as_programmed, tolerances);
  const Arc* read = std::get_if<Arc>(&result);
  if (read != nullptr && is_same_arc(*read, arc, last_decimal(state.unit))) {
    // Controls that do not shift a centre compare the radii (G164).
    const double start_radius = (start - center).norm();
    const double difference = std::abs(start_radius - (end - center).norm());
    if (difference <=
        std::min(check.largest_radius_difference, check.largest_radius_factor * start_radius))
      return ArcForm::arc;
  }
  return sagitta_of(arc) <= last_decimal(state.unit) ? ArcForm::line : ArcForm::halves;
}

bool MotionWriter::moves(const Position& end, const TrackingTravel& tracking,
                         const WrittenState& state) const {
  for (std::size_t axis = 0; axis < end.size(); ++axis)
    if (!reaches(end[axis], state.position[axis], state.unit)) return true;
  for (std::size_t axis = 0; axis < tracking.size(); ++axis)
    if (!reaches_tracking(axis, tracking[axis].to, state.tracking[axis], state.unit)) return true;
  return false;
}

char* MotionWriter::write_axes(char* at, const Axes& axes, const KnownNumbers& known,
                               WrittenState& state) {
  const auto write_axis = [&](char letter, AxisSet bit, double target, LengthUnit unit,
                              const Written* number, double& position, std::string_view name = {}) {
    if ((axes.never & bit) != 0) return;
    if ((axes.always & bit) == 0 && reaches(target, position, unit)) return;
    const Written axis =
        number != nullptr ? *number : written_end(target, position, unit, state.incremental);
    if (!name.empty()) {
      *at++ = ' ';
      at = write_name(at, name);
      letter = '=';
    }
    char* const begin = at;
    at = write_word(at, letter, axis.units, decimals_of(unit));
    if (!name.empty()) at = std::copy(begin + 1, at, begin);
    position = axis.read;
  };
  for (std::size_t axis = 0; axis < axes.end.size(); ++axis)
    write_axis(main_axis_letters[axis], axis_bit(axis), axes.end[axis], state.unit, known[axis],
               state.position[axis]);
  for (std::size_t axis = 0; axis < axes.tracking.size(); ++axis) {
    const char letter = tracking_letters_[axis];
    write_axis(letter, axis_bit(axes.end.size() + axis), axes.tracking[axis].to,
               unit_of_axis(axis, state.unit), nullptr, state.tracking[axis],
               tracking_names_[axis]);
  }
  return at;
}

void MotionWriter::append_line(TextBuffer& out, MotionKind kind, const Axes& axes,
                               WrittenState& state) {
  char* at = room_of_motion(out, axes.tracking);
  at = spelling_.klartext ? write_name(at, " L")
                          : write_function(at, kind == MotionKind::rapid ? '0' : '1');
  at = write_axes(at, axes, {}, state);
  if (spelling_.klartext && kind == MotionKind::rapid) at = write_name(at, " FMAX");
  out.end_at(at);
  state.motion = kind;
}

void MotionWriter::append_arc(TextBuffer& out, const NumberedArc& numbered, const Axes& given,
                              WrittenState& state) {
  if (spelling_.klartext) return append_klartext_arc(out, numbered, given, state);
  const Arc& arc = numbered.arc;
  const ArcNumbers& numbers = numbered.numbers;
  const bool clockwise = arc.sweep < 0;
  const PlaneAxes axes = axes_of(numbered.plane);
  const AxisSet plane_axes = axis_bit(axes.first) | axis_bit(axes.second);
  // An end that rounds to another point than the start would not close the circle.
  const bool only_center =
      is_full_circle(arc) && (numbers.end[0].read != state.position[axes.first] ||
                              numbers.end[1].read != state.position[axes.second]);
  KnownNumbers known{};
  known[axes.first] = &numbers.end[0];
  known[axes.second] = &numbers.end[1];
  char* at = room_of_motion(out, given.tracking);
  at = write_function(at, clockwise ? '2' : '3');
  Axes named = given;
  named.always |= plane_axes;
  if (only_center) named.never |= plane_axes;
  at = write_axes(at, named, known, state);
  const auto write_center = [&](std::size_t axis, std::size_t number) {
    at =
        write_word(at, center_letters[axis], numbers.center[number].units, decimals_of(state.unit));
  };
  // The letters belong to the machine axes: in G18 the first axis of the plane is Z.
  const bool swapped = axes.first > axes.second;
  if (swapped) write_center(axes.second, 1);
  write_center(axes.first, 0);
  if (!swapped) write_center(axes.second, 1);
  out.end_at(at);
  state.motion = clockwise ? MotionKind::clockwise : MotionKind::counter_clockwise;
}

void MotionWriter::append_pole(TextBuffer& out, const Point& pole, Plane plane,
                               WrittenState& state) {
  const PlaneAxes axes = axes_of(plane);
  const Written first = written(pole.x(), state.unit);
  const Written second = written(pole.y(), state.unit);
  char* at = out.room(3 * room_of_word);
  at = write_name(at, " CC");
  const bool swapped = axes.first > axes.second;
  const auto write = [&](std::size_t axis, const Written& number) {
    at = write_word(at, main_axis_letters[axis], number.units, decimals_of(state.unit));
  };
  if (swapped) write(axes.second, second);
  write(axes.first, first);
  if (!swapped) write(axes.second, second);
  out.end_at(at);
  state.pole = {first.read, second.read};
}

// The arc after its CC. A helix is written with its sweep, as C has no third axis.
void MotionWriter::append_klartext_arc(TextBuffer& out, const NumberedArc& numbered,
                                       const Axes& given, WrittenState& state) {
  const Arc& arc = numbered.arc;
  const ArcNumbers& numbers = numbered.numbers;
  const bool clockwise = arc.sweep < 0;
  const PlaneAxes axes = axes_of(numbered.plane);
  const AxisSet in_plane = axis_bit(axes.first) | axis_bit(axes.second);
  const AxisSet third = axis_bit(axes.third);
  const bool helix = (given.always & third) != 0 ||
                     !reaches(given.end[axes.third], state.position[axes.third], state.unit);
  Axes named = given;
  char* at = room_of_motion(out, given.tracking);
  if (helix) {
    constexpr int angle_decimals = 6;
    const std::int64_t angle = to_units(arc.sweep * 180 / std::numbers::pi, angle_decimals);
    at = write_name(at, " CP IPA");
    if (angle >= 0) *at++ = '+';
    at = write_units(at, angle, angle_decimals);
    named.never |= in_plane;
    at = write_axes(at, named, {}, state);
    const Vector arm = to_plane(numbered.plane, state.position) - state.pole;
    const double turn = from_units(angle, angle_decimals) * std::numbers::pi / 180;
    const Point read = state.pole + std::cos(turn) * arm + std::sin(turn) * left_of(arm);
    state.position[axes.first] = read.x();
    state.position[axes.second] = read.y();
  } else {
    KnownNumbers known{};
    known[axes.first] = &numbers.end[0];
    known[axes.second] = &numbers.end[1];
    at = write_name(at, " C");
    named.always |= in_plane;
    at = write_axes(at, named, known, state);
  }
  at = write_name(at, clockwise ? " DR-" : " DR+");
  out.end_at(at);
  state.motion = clockwise ? MotionKind::clockwise : MotionKind::counter_clockwise;
}

// The digits of a feed count, not its decimals: a slow feed gets more decimals, and no feed becomes
// F0.
MotionWriter::WrittenFeed MotionWriter::written_feed(double feed, LengthUnit unit) const {
  const double value = feed / feed_unit(unit);
  int decimals = decimals_of(unit);
  while (decimals < most_decimals && to_units(value, decimals) < least_feed_units) ++decimals;
  while (decimals > 0 && to_units(value, decimals) > largest_units_) --decimals;
  const std::int64_t units = std::max<std::int64_t>(to_units(value, decimals), 1);
  const double number = from_units(units, decimals);
  return {.units = units, .decimals = decimals, .read = number * feed_unit(unit)};
}

bool MotionWriter::same_feed(double a, double b, LengthUnit unit) const {
  return a == b || written_feed(a, unit).read == written_feed(b, unit).read;
}

void MotionWriter::append_feed(TextBuffer& out, double feed, WrittenState& state) {
  const WrittenFeed word = written_feed(feed, state.feed_unit);
  out.end_at(write_word(out.room(room_of_word), 'F', word.units, word.decimals));
  state.feed = word.read;
}

}  // namespace trc
