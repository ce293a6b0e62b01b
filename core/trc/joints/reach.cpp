#include "core/trc/joints/reach.h"

#include <cmath>

#include "core/geometry/parallel.h"
#include "core/trc/corner/offsets.h"
#include "core/trc/joints/joints.h"

namespace trc {
namespace {

// The outline with another radius (D-145).
PathBlock with_radius(const PathBlock& block, double radius) {
  PathBlock changed = outline_of(block);
  for (Compensation* end : {&changed.at_start, &changed.at_end})
    if (end->active) end->shift = std::copysign(radius, end->shift);
  give_offsets(changed);
  return changed;
}

// The corner with its cuts of the two blocks; empty if they do not meet.
std::optional<Joint> cuts_between(const PathBlock& before, const PathBlock& after,
                                  const Tolerances& tolerances) {
  const auto result =
      joint_between(before, after, corner_between(before, after, tolerances), tolerances);
  const auto* joined = std::get_if<JoinedBlocks>(&result);
  if (joined == nullptr || joined->gap) return std::nullopt;
  return joined->joint;
}

}  // namespace

bool is_reached(const PathBlock& before, const PathBlock& block, const PathBlock& after,
                double radius, const Tolerances& tolerances) {
  const PathBlock middle = with_radius(block, radius);
  const auto* arc = std::get_if<Arc>(&middle.programmed.path);
  const double equidistant = arc != nullptr ? parallel_radius(*arc, middle.at_end.shift) : 1;
  if (arc != nullptr && equidistant < tolerances.on_contour) return false;
  const auto at_start = cuts_between(with_radius(before, radius), middle, tolerances);
  const auto at_end = cuts_between(middle, with_radius(after, radius), tolerances);
  if (!at_start || !at_end) return false;
  return left_of_block(middle, at_start->cut_after, at_end->cut_before) * equidistant >=
         -tolerances.on_contour;
}

double largest_radius_for(const PathBlock& before, const PathBlock& block, const PathBlock& after,
                          const Tolerances& tolerances) {
  constexpr double micrometre = 1e-3;  // mm; the resolution of the reported radius
  double high = std::abs(block.at_end.shift);
  if (is_reached(before, block, after, high, tolerances)) return high;
  double low = 0;
  while (high - low > micrometre) {
    const double middle = 0.5 * (low + high);
    (is_reached(before, block, after, middle, tolerances) ? low : high) = middle;
  }
  const double rounded = std::ceil(low / micrometre) * micrometre;
  return is_reached(before, block, after, rounded, tolerances)
             ? rounded
             : std::floor(low / micrometre) * micrometre;
}

double slot_width(const Segment& before, const Segment& after) {
  constexpr double parallel = 1e-6;  // rad, more than rounding turns walls written as parallel
  if (is_arc(before) || is_arc(after)) return 0;
  const Vector along = tangent_at_start(before);
  const Vector back = tangent_at_start(after);
  if (along.dot(back) > 0 || std::abs(cross(along, back)) > parallel) return 0;
  return std::abs(cross(along, start_of(after) - end_of(before)));
}

}  // namespace trc
