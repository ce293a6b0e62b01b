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

  // Whether the tool leaves anything of the circle (90017).
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

// Whether two blocks go nearly straight back at a corner, and what they leave between them: nothing
// that counts, they end in a tip the tool goes round, or a slit on the side of the tool.
enum class Reversal { none, tip, slit };

// Two blocks meeting in the programmed point E.
struct Corner {
  Point programmed = Point::Zero();
  OffsetCurve before{};
  OffsetCurve after{};
  double shift = 0;  // in force on both sides of the corner
  Reversal reversal = Reversal::none;

  [[nodiscard]] double tool_radius() const { return std::abs(shift); }
  // rad, -pi < turn <= pi, counter-clockwise positive. What only asks for its sign, or whether the
  // path goes straight on or straight back, asks the tangents: an angle is dear.
  [[nodiscard]] double turn() const { return turn_between(before.tangent, after.tangent); }
  [[nodiscard]] double sine_of_turn() const { return cross(before.tangent, after.tangent); }
  [[nodiscard]] double cosine_of_turn() const { return before.tangent.dot(after.tangent); }
};

enum class CornerKind { tangential, inside, outside };

// What the gap between the two blocks says, not the sign of an angle (D-44): the first one wider
// than Tolerances::input_resolution, where there is one as far as both go.
[[nodiscard]] Reversal reversal_of(const Corner& corner, const Segment& before,
                                   const Segment& after, const Tolerances& tolerances);

// Whether it may be one, by its angle.
[[nodiscard]] inline bool may_reverse(const Corner& corner) {
  constexpr double widest = 0.1;  // rad
  return corner.cosine_of_turn() < 0 && std::abs(corner.sine_of_turn()) <= widest;
}

// Whether the path goes straight on or straight back there: an angle as small as the tolerance is
// its own sine.
[[nodiscard]] inline bool is_parallel(const Corner& corner, const Tolerances& tolerances) {
  return std::abs(corner.sine_of_turn()) <= tolerances.tangent * std::abs(corner.cosine_of_turn());
}

// Whether the motion goes back the way it came, near enough for a change of side (D-23).
[[nodiscard]] inline bool turns_back(const Vector& before, const Vector& after,
                                     const Tolerances& tolerances) {
  return before.dot(after) < 0 && std::abs(cross(before, after)) <= std::sin(tolerances.reversal);
}

// A reversal is an outside corner of 360 degrees (D-05), or, where it leaves a slit, an inside
// corner of none.
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

// What becomes of a corner.
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

  // Optional, so that the joints that insert nothing, most of them, are small to make and to copy.
  // With a constructor of its own, or all memory of them is cleared to make them.
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

// Which loops go is decided with arcs: LinearTransitions comes behind that (D-45).
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

// The tangent of half the turn, whichever its sign; from sine and cosine, of which one is always
// exact enough.
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

// What inside_joint() is asked with where loops are removed. Two equidistants that miss each other,
// be it by less than Tolerances::same_point, do not meet then: what is left of the gap is
// LoopRemoval's to judge.
[[nodiscard]] inline Tolerances to_all_digits(Tolerances tolerances, double tool_radius) {
  tolerances.same_point = tolerances.rounding * std::max(tool_radius, 1.0);
  return tolerances;
}

// The inside joint where loops are removed, asked with to_all_digits(). Empty also where the corner
// takes more than there is of a block: mm of a line, rad of an arc, whatever its other end loses.
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
