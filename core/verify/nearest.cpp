#include "core/verify/nearest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trc::verify {
namespace {

Point nearest_on(const Line& line, const Point& point) {
  const Vector along = line.end - line.start;
  const double square = along.squaredNorm();
  if (square == 0) return line.start;
  const double share = (point - line.start).dot(along) / square;
  if (share <= 0) return line.start;
  if (share >= 1) return line.end;
  return line.start + share * along;
}

double square_between(const Point& point, const Line& line) {
  return (nearest_on(line, point) - point).squaredNorm();
}

// Whether `out` lies in the sector of at most half a turn from `first` to the left.
[[gnu::always_inline]] inline bool is_between(const Vector& first, const Vector& last,
                                              const Vector& out) {
  // A tiny sector whose ends rounding has swapped does not hold the opposite direction.
  return cross(first, out) >= 0 && cross(out, last) >= 0 &&
         !(out.dot(first) < 0 && first.dot(last) > 0);
}

constexpr double same_radius = 1e-7;  // mm, at the start and at the end of an arc

// An arc with the values that comparisons need again and again.
class Bow {
 public:
  explicit Bow(const Arc& arc)
      : start_(arc.start),
        end_(arc.end),
        center_(arc.center),
        from_(arc.start - arc.center),
        to_(arc.end - arc.center),
        turns_left_(arc.sweep > 0),
        is_minor_(std::abs(arc.sweep) <= std::numbers::pi),
        radius_(magnitude(from_)),
        end_radius_(magnitude(to_)) {}
  explicit Bow(const Piece& piece)
      : Bow(Arc{
            .start = piece.start, .end = piece.end, .center = piece.center, .sweep = piece.sweep}) {
  }

  [[nodiscard]] const Point& start() const { return start_; }
  [[nodiscard]] const Point& end() const { return end_; }
  [[nodiscard]] const Point& center() const { return center_; }
  [[nodiscard]] double radius() const { return radius_; }
  // Start and end may lie on circles that differ a little.
  [[nodiscard]] double inner() const { return std::min(radius_, end_radius_); }
  [[nodiscard]] double outer() const { return std::max(radius_, end_radius_); }

  // Whether all of a line lies beyond an end of the arc, so that an end is nearest to it, and both
  // ends are at least `distance` mm away. False if undecided.
  [[nodiscard]] bool ends_before(const Line& line, double distance) const {
    if (!is_minor_) return false;
    const Vector start = line.start - center_;
    const Vector end = line.end - center_;
    const Vector& first = turns_left_ ? from_ : to_;
    const Vector& last = turns_left_ ? to_ : from_;
    const bool is_beyond = (cross(first, start) <= 0 && cross(first, end) <= 0) ||
                           (cross(last, start) >= 0 && cross(last, end) >= 0);
    const double square = distance * distance;
    return is_beyond && distance >= 0 && square_between(start_, line) >= square &&
           square_between(end_, line) >= square;
  }
  // Whether the bounds of another arc show that all of it lies beyond an end of this one, and at
  // least `distance` mm from both ends. False if undecided.
  [[nodiscard]] bool ends_before(const Bow& other, double distance) const {
    // An arc that does not end on its circle may leave the bounds.
    if (!is_minor_ || !other.is_minor_ || other.outer() - other.inner() > same_radius) return false;
    const Vector& first = turns_left_ ? from_ : to_;
    const Vector& last = turns_left_ ? to_ : from_;
    const Vector rise = other.rise();
    const Vector start = other.start_ - center_;
    const Vector end = other.end_ - center_;
    const double before = std::max(cross(first, start), cross(first, end));
    const double behind = std::min(cross(last, start), cross(last, end));
    const bool is_beyond = before + std::max(0.0, cross(first, rise)) <= 0 ||
                           behind + std::min(0.0, cross(last, rise)) >= 0;
    return is_beyond && other.distance(start_) >= distance && other.distance(end_) >= distance;
  }
  // Whether the arc passes this direction from its centre.
  [[nodiscard]] bool holds(const Vector& out) const {
    const Vector& first = turns_left_ ? from_ : to_;
    const Vector& last = turns_left_ ? to_ : from_;
    return is_minor_ ? is_between(first, last, out) : !is_between(last, first, out);
  }
  [[nodiscard]] Point nearest(const Point& point) const {
    const Vector out = point - center_;
    const double distance = out.norm();
    if (distance == 0) return start_;
    if (holds(out)) return center_ + out * (radius_ / distance);
    return (point - start_).squaredNorm() < (point - end_).squaredNorm() ? start_ : end_;
  }
  [[nodiscard]] double distance(const Point& point) const {
    const Vector out = point - center_;
    if (holds(out)) return std::abs(out.norm() - radius_);
    return std::sqrt(std::min((point - start_).squaredNorm(), (point - end_).squaredNorm()));
  }

 private:
  // A vector from the chord of an arc of at most half a turn to beyond all of the arc.
  [[nodiscard]] Vector rise() const {
    const Vector chord = end_ - start_;
    const double square = chord.squaredNorm();
    const double across = cross(chord, from_);
    const double length = std::sqrt(square);
    if (length == 0) return Vector::Zero();
    // The bow lies on the right of the chord if the arc turns left.
    const double turned = turns_left_ ? -1 : 1;
    return turned * std::max(0.0, outer() - turned * across / length) / length * left_of(chord);
  }

  Point start_;
  Point end_;
  Point center_;
  Vector from_;
  Vector to_;
  bool turns_left_;
  bool is_minor_;
  double radius_;
  double end_radius_;
};

Point nearest_on(const Arc& arc, const Point& point) { return Bow(arc).nearest(point); }

// Each noted distance exists: a wrong candidate can only be too far away.
struct Least : Gap {
  Least() { distance = std::numeric_limits<double>::infinity(); }
  void note(const Point& on, double apart) {
    if (!(apart < distance)) return;
    distance = apart;
    on_a = on;
  }
};

// The smallest distance is taken at an end of one of the two, where they cross, or at the foot of
// the centre. `on_a` is on the line.
Gap gap_of(const Line& line, const Bow& arc, double enough) {
  const Vector along = line.end - line.start;
  const double square = along.squaredNorm();
  const double share = square > 0 ? (arc.center() - line.start).dot(along) / square : 0;
  const Point foot = line.start + std::clamp(share, 0.0, 1.0) * along;
  const double apart = (foot - arc.center()).norm();
  if (apart - arc.outer() >= enough) return {apart - arc.outer(), foot};
  const double farthest = std::sqrt(
      std::max((line.start - arc.center()).squaredNorm(), (line.end - arc.center()).squaredNorm()));
  if (arc.inner() - farthest >= enough) return {arc.inner() - farthest, foot};
  if (arc.ends_before(line, enough)) return {enough, foot};
  Least least;
  least.note(line.start, arc.distance(line.start));
  least.note(line.end, arc.distance(line.end));
  for (const Point& end : {arc.start(), arc.end()}) {
    const Point on = nearest_on(line, end);
    least.note(on, (on - end).norm());
  }
  least.note(foot, arc.distance(foot));
  if (square == 0) return least;
  const double across = cross(along, arc.center() - line.start);
  const double beside = arc.radius() * arc.radius() - across * across / square;
  if (beside < 0) return least;
  const double half = std::sqrt(beside / square);
  for (const double at : {share - half, share + half}) {
    if (at < 0 || at > 1) continue;
    const Point crossing = line.start + at * along;
    least.note(crossing, arc.distance(crossing));
  }
  return least;
}

// Two arcs are nearest at an end of one, where they cross, or where the line through both centres
// meets them.
Gap gap_of(const Bow& a, const Bow& b, double enough) {
  const Vector between = b.center() - a.center();
  const double distance = between.norm();
  const double least_gap =
      std::max({distance - a.outer() - b.outer(), a.inner() - distance - b.outer(),
                b.inner() - distance - a.outer()});
  if (least_gap >= enough) return {least_gap, a.start()};
  if (b.ends_before(a, enough) || a.ends_before(b, enough)) return {enough, a.start()};
  Least least;
  least.note(a.start(), b.distance(a.start()));
  least.note(a.end(), b.distance(a.end()));
  for (const Point& end : {b.start(), b.end()}) {
    const Point on = a.nearest(end);
    least.note(on, (on - end).norm());
  }
  if (distance == 0) return least;
  const Vector toward = between / distance;
  const auto note = [&](const Vector& out) {
    if (!a.holds(out)) return;
    const Point on = a.center() + out;
    least.note(on, b.distance(on));
  };
  note(a.radius() * toward);
  note(-a.radius() * toward);
  const double along =
      (distance * distance + a.radius() * a.radius() - b.radius() * b.radius()) / (2 * distance);
  const double beside = a.radius() * a.radius() - along * along;
  if (beside < 0) return least;
  const Vector aside = std::sqrt(beside) * left_of(toward);
  note(along * toward + aside);
  note(along * toward - aside);
  return least;
}

Line line_of(const Piece& piece) { return {.start = piece.start, .end = piece.end}; }

}  // namespace

bool Compared::is_beyond_ends(const Piece& other, const Circles& circles, double distance) const {
  // Rounding may put the start of an arc this much before the end of the arc it continues.
  constexpr double next_to_nothing = 1e-9;  // mm
  const bool are_minor =
      std::abs(piece_.sweep) <= std::numbers::pi && std::abs(other.sweep) <= std::numbers::pi;
  if (!are_minor || circles.outer - circles.inner > same_radius || distance < 0) return false;
  const bool turns_left = piece_.sweep > 0;
  const Vector first = (turns_left ? piece_.start : piece_.end) - piece_.center;
  const Vector last = (turns_left ? piece_.end : piece_.start) - piece_.center;
  const Vector start = other.start - piece_.center;
  const Vector end = other.end - piece_.center;
  const double before = std::max(cross(first, start), cross(first, end));
  const double behind = std::min(cross(last, start), cross(last, end));
  const double nothing = next_to_nothing * circles_.inner;
  if (before > nothing && behind < -nothing) return false;
  const bool other_turns_left = other.sweep > 0;
  const Vector other_first = (other_turns_left ? other.start : other.end) - other.center;
  const Vector other_last = (other_turns_left ? other.end : other.start) - other.center;
  // The other arc must not hold the direction in which its circle reaches farthest back.
  const bool is_beyond =
      (before <= nothing && !is_between(other_first, other_last, left_of(first))) ||
      (behind >= -nothing && !is_between(other_first, other_last, -left_of(last)));
  const double apart = distance + next_to_nothing;
  const double within = circles.inner - apart;
  const double beyond = circles.outer + apart;
  const auto is_far_from = [&](const Point& point) {
    const Vector out = point - other.center;
    const double square = out.squaredNorm();
    // The point is far from the whole circle of the other arc.
    if (square >= beyond * beyond || (within >= 0 && square <= within * within)) return true;
    return !is_between(other_first, other_last, out) &&
           std::min((point - other.start).squaredNorm(), (point - other.end).squaredNorm()) >=
               apart * apart;
  };
  return is_beyond && is_far_from(piece_.start) && is_far_from(piece_.end);
}

bool is_within(const Piece& arc, const Piece& other) {
  const bool turns_left = other.sweep > 0;
  const Vector first = (turns_left ? other.start : other.end) - other.center;
  const Vector last = (turns_left ? other.end : other.start) - other.center;
  // A longer sweep may lead out of it and back.
  return std::abs(arc.sweep) <= std::numbers::pi &&
         is_between(first, last, arc.start - arc.center) &&
         is_between(first, last, arc.end - arc.center);
}

Point nearest_point(const Segment& segment, const Point& point) {
  return std::visit([&](const auto& shape) { return nearest_on(shape, point); }, segment);
}

// If the lines do not cross, an end of one of them is nearest. If both lie on one line, rounding
// puts a crossing anywhere: it counts with the distance measured there.
Gap gap_between(const Line& a, const Line& b) {
  const Vector u = a.end - a.start;
  const Vector v = b.end - b.start;
  const Vector apart = b.start - a.start;
  const double area = cross(u, v);
  const double on_a = cross(apart, v) / area;
  const double on_b = cross(apart, u) / area;
  Gap gap;
  double least = std::numeric_limits<double>::infinity();
  const auto note = [&](const Point& at, const Point& other) {
    const double square = (at - other).squaredNorm();
    if (!(square < least)) return;
    least = square;
    gap.on_a = at;
  };
  if (on_a >= 0 && on_a <= 1 && on_b >= 0 && on_b <= 1) {
    const Point crossing = a.start + on_a * u;
    note(crossing, nearest_on(b, crossing));
  }
  note(a.start, nearest_on(b, a.start));
  note(a.end, nearest_on(b, a.end));
  note(nearest_on(a, b.start), b.start);
  note(nearest_on(a, b.end), b.end);
  gap.distance = std::sqrt(least);
  return gap;
}

Gap gap_between(const Segment& a, const Segment& b) {
  return gap_between(piece_of(a), piece_of(b), std::numeric_limits<double>::infinity());
}

Gap gap_between(const Piece& a, const Piece& b, double enough) {
  if (a.is_arc() && b.is_arc()) return gap_of(Bow(a), Bow(b), enough);
  if (b.is_arc()) return gap_of(line_of(a), Bow(b), enough);
  if (a.is_arc()) {
    const Bow bow(a);
    Gap gap = gap_of(line_of(b), bow, enough);
    gap.on_a = bow.nearest(gap.on_a);
    return gap;
  }
  if (is_beside(a, b, enough) || is_beside(b, a, enough)) return {enough, a.start};
  return gap_between(line_of(a), line_of(b));
}

Vector direction_at(const Segment& segment, const Point& point) {
  return std::visit(
      overloaded{[](const Line& line) { return Vector((line.end - line.start).normalized()); },
                 [&](const Arc& arc) {
                   const Vector left = left_of((point - arc.center).normalized());
                   return arc.sweep < 0 ? Vector(-left) : left;
                 }},
      segment);
}

}  // namespace trc::verify
