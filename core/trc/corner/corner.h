#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/tolerances.h"
#include "core/geometry/intersect.h"
#include "core/geometry/parallel.h"
#include "core/geometry/segment.h"
#include "core/nc/state/trc_mode.h"

namespace trc {

// The equidistant of one block near a corner, unbounded: a straight line or a
// circle through `anchor`, which is Q of the block before, P of the block after.
struct OffsetCurve {
  Point anchor = Point::Zero();
  Vector tangent = Vector::UnitX();  // of travel at the anchor, unit
  bool circular = false;
  bool counter_clockwise = false;
  Circle circle{};

  // Whether the tool radius leaves anything of the circle (90017).
  [[nodiscard]] bool exists() const { return !circular || circle.radius > 0; }
};

// `shift` as in Compensation; `radius` that of the arc.
[[nodiscard]] inline OffsetCurve offset_curve(const Arc& programmed, double radius,
                                              const Vector& tangent, const Point& anchor,
                                              double shift) {
  return {.anchor = anchor,
          .tangent = tangent,
          .circular = true,
          .counter_clockwise = programmed.sweep > 0,
          .circle = {.center = programmed.center,
                     .radius = parallel_radius(programmed, radius, shift)}};
}
[[nodiscard]] inline OffsetCurve offset_curve(const Segment& programmed, const Vector& tangent,
                                              const Point& anchor, double shift) {
  if (const auto* arc = std::get_if<Arc>(&programmed))
    return offset_curve(*arc, radius_of(*arc), tangent, anchor, shift);
  return {.anchor = anchor, .tangent = tangent};
}

// Whether two blocks reverse nearly exactly at a corner, and how: in a tip, with nothing that
// counts between them, which the tool goes round, or with a slit on the side of the tool.
enum class Reversal { none, tip, slit };

// Two blocks meeting in the programmed point E.
struct Corner {
  Point programmed = Point::Zero();
  OffsetCurve before{};
  OffsetCurve after{};
  double shift = 0;  // in force on both sides of the corner
  Reversal reversal = Reversal::none;

  [[nodiscard]] double tool_radius() const { return std::abs(shift); }
  // rad, -pi < turn <= pi, counter-clockwise positive. To find only its sign, or whether the path
  // goes straight on or straight back, use the tangents: an angle takes long to compute.
  [[nodiscard]] double turn() const { return turn_between(before.tangent, after.tangent); }
  [[nodiscard]] double sine_of_turn() const { return cross(before.tangent, after.tangent); }
  [[nodiscard]] double cosine_of_turn() const { return before.tangent.dot(after.tangent); }
};

enum class CornerKind { tangential, inside, outside };

// Judged by the gap between the two blocks, not by the sign of an angle (D-44): by the first gap
// wider than Tolerances::input_resolution, if there is one along both.
[[nodiscard]] Reversal reversal_of(const Corner& corner, const Segment& before,
                                   const Segment& after, const Tolerances& tolerances);

// Whether the angle of the corner allows a reversal.
[[nodiscard]] inline bool may_reverse(const Corner& corner) {
  constexpr double widest = 0.1;  // rad
  return corner.cosine_of_turn() < 0 && std::abs(corner.sine_of_turn()) <= widest;
}

// Whether the path goes straight on or straight back there: an angle as small as the tolerance is
// its own sine.
[[nodiscard]] inline bool is_parallel(const Corner& corner, const Tolerances& tolerances) {
  return std::abs(corner.sine_of_turn()) <= tolerances.tangent * std::abs(corner.cosine_of_turn());
}

// Whether the motion reverses exactly enough for a change of side (D-23).
[[nodiscard]] inline bool turns_back(const Vector& before, const Vector& after,
                                     const Tolerances& tolerances) {
  return before.dot(after) < 0 && std::abs(cross(before, after)) <= std::sin(tolerances.reversal);
}

// A reversal is an outside corner of 360 degrees (D-05) or, where it leaves a slit, an inside
// corner of 0 degrees.
[[nodiscard]] inline CornerKind kind_of(const Corner& corner, const Tolerances& tolerances) {
  if (corner.cosine_of_turn() > 0 && is_parallel(corner, tolerances)) return CornerKind::tangential;
  const double gap = (corner.after.anchor - corner.before.anchor).squaredNorm();
  if (gap <= tolerances.same_point * tolerances.same_point) return CornerKind::tangential;
  if (corner.reversal != Reversal::none)
    return corner.reversal == Reversal::slit ? CornerKind::inside : CornerKind::outside;
  return corner.sine_of_turn() * corner.shift > 0 ? CornerKind::inside : CornerKind::outside;
}

// How far the tool swings around an outside corner: |sweep| = beta - 180 degrees,
// negative clockwise (G41), positive counter-clockwise (G42).
[[nodiscard]] double outside_sweep(const Corner& corner);

// The transition angle beta of rule 1.12, rad, 0 < beta <= 2 pi.
[[nodiscard]] double transition_angle(const Corner& corner, const Tolerances& tolerances);

// The point in which two equidistants meet.
struct MeetingPoint {
  Point point = Point::Zero();
  double cut_before = 0;  // as in PathBlock
  double cut_after = 0;
};

// How a corner is joined.
struct Joint {
  Joint() = default;
  explicit Joint(const MeetingPoint& meeting)
      : end(meeting.point),
        start(meeting.point),
        cut_before(meeting.cut_before),
        cut_after(meeting.cut_after) {}

  Point end = Point::Zero();    // of the block before
  Point start = Point::Zero();  // of the block after
  double cut_before = 0;        // as in PathBlock
  double cut_after = 0;

  // Optional, so that joints without inserted blocks, as most are, are fast to make and to copy.
  // The constructor is written out: a default one would clear all of the memory.
  struct Inserted : std::optional<Segment> {
    Inserted() : std::optional<Segment>(std::nullopt) {}
    using std::optional<Segment>::operator=;
  };
  void insert(const Segment& segment) { inserted_[count_++] = segment; }
  // All of them have a value.
  [[nodiscard]] std::span<const Inserted> inserted() const { return {inserted_.data(), count_}; }

 private:
  std::array<Inserted, 3> inserted_;
  std::size_t count_ = 0;
};

struct TransitionRule {
  Transition transition = Transition::linear;
  double stretch_factor = 1;
};

enum class Loops : std::uint8_t { kept, removed };

// Loops are removed with arcs at the corners: LinearTransitions comes afterwards (D-45).
[[nodiscard]] inline TransitionRule transition_rule(const TrcMode& mode, Loops loops) {
  return {.transition = loops == Loops::removed ? Transition::circular : mode.transition,
          .stretch_factor = mode.options.stretch_factor};
}

// Both blocks reach their full end in one point.
[[nodiscard]] Joint tangential_joint(const Corner& corner);

// A line from the end of one block to the start of the other.
[[nodiscard]] Joint joint_across(const Point& end, const Point& start);

// The table of rule 4.2 with STRETCH_FACTOR (4.3). Lines are extended,
// circles get a tangent line.
[[nodiscard]] Joint outside_joint(const Corner& corner, const TransitionRule& rule,
                                  const Tolerances& tolerances);

// EXT_ANGLE_BLOCK_INTERSECTION (rule 4.4, D-08): both curves extended to their
// meeting; empty when there is none within 2 R tan 1 degree of Q and P.
[[nodiscard]] std::optional<Joint> extended_joint(const Corner& corner,
                                                  const Tolerances& tolerances);

// How much of a curve lies between `point` on it and its anchor: positive when
// the corner takes it off. mm of a line, rad of a circle, -slack <= cut.
[[nodiscard]] double cut_before_anchor(const OffsetCurve& curve, const Point& point, double slack);
[[nodiscard]] double cut_after_anchor(const OffsetCurve& curve, const Point& point, double slack);

// Where two unbounded curves meet, as far as the corner lets them: the meeting
// with the smallest cut of `after`, then of `before` (D-06).
[[nodiscard]] std::optional<MeetingPoint> nearest_meeting(const OffsetCurve& before,
                                                          const OffsetCurve& after,
                                                          const Tolerances& tolerances);

// The tangent of half the turn, never negative; from sine and cosine, one of which is always exact
// enough.
[[nodiscard]] inline double tangent_of_half_turn(const Corner& corner) {
  const double sine = std::abs(corner.sine_of_turn());
  const double cosine = corner.cosine_of_turn();
  return cosine > 0 ? sine / (1 + cosine) : (1 - cosine) / sine;
}

// The crossing of the two tangents; the corner is not a reversal.
[[nodiscard]] inline Point mitre_point(const Corner& corner) {
  const Vector& before = corner.before.tangent;
  const Vector& after = corner.after.tangent;
  const double scale = corner.shift / (1 + before.dot(after));
  return corner.programmed + scale * (left_of(before) + left_of(after));
}

// Both blocks shortened to the meeting of their equidistants, the nearest one
// along the block after, then along the block before (D-06). Empty when the
// equidistants do not meet between the corner and their far ends.
[[nodiscard]] inline std::optional<MeetingPoint> inside_joint(const Corner& corner,
                                                              const Tolerances& tolerances) {
  if (corner.before.circular || corner.after.circular)
    return nearest_meeting(corner.before, corner.after, tolerances);
  const double cut = corner.tool_radius() * tangent_of_half_turn(corner);
  return MeetingPoint{.point = mitre_point(corner), .cut_before = cut, .cut_after = cut};
}

// The tolerances for inside_joint() where loops are removed. Two equidistants that miss each
// other, even by less than Tolerances::same_point, do not meet then: LoopRemoval judges the
// gap.
[[nodiscard]] inline Tolerances to_all_digits(Tolerances tolerances, double tool_radius) {
  tolerances.same_point = tolerances.rounding * std::max(tool_radius, 1.0);
  return tolerances;
}

// The inside joint where loops are removed, asked with to_all_digits(). Also empty where the corner
// takes more than the whole block, mm of a line or rad of an arc, leaving aside its other end.
[[nodiscard]] inline std::optional<MeetingPoint> inside_joint_on_blocks(const Corner& corner,
                                                                        double extent_before,
                                                                        double extent_after,
                                                                        const Tolerances& exact) {
  const auto meeting = inside_joint(corner, exact);
  const bool reaches =
      meeting && extent_before >= meeting->cut_before && extent_after >= meeting->cut_after;
  return reaches ? meeting : std::nullopt;
}

}  // namespace trc
