#include "core/trc/passes/offset.h"

#include <cmath>

#include "core/geometry/parallel.h"
#include "core/trc/corner/offsets.h"

namespace trc {

bool Offset::apply(PathBlock& block) {
  if (block.role == Role::passive) return true;
  give_offsets(block);
  const Compensation& start = block.at_start;
  const Compensation& end = block.at_end;
  if (start.active && !keeps_circle(block, start.shift)) return false;
  return !end.active || end == start || keeps_circle(block, end.shift);
}

bool Offset::keeps_circle(PathBlock& block, double shift) {
  const auto* arc = std::get_if<Arc>(&block.programmed.path);
  if (arc == nullptr || block.role != Role::contour) return true;
  const double radius = parallel_radius(*arc, shift);
  if (block.removes_loops()) {
    block.unreachable = is_unreachable(radius, shift, tolerances_);
    return true;
  }
  if (!vanishes(radius, tolerances_)) return true;
  if (block.mode().masking == Masking::on) {
    block.masked = true;
    return true;
  }
  return report_not_smaller(block, *arc, shift);
}

bool Offset::report_not_smaller(const PathBlock& block, const Arc& arc, double shift) {
  const double radius = parallel_radius(arc, shift);
  Diagnostic violation = diagnostic(Code::tool_not_smaller_than_arc, block.programmed.source);
  // In wear mode the message is about the part, not about the programmed centre path.
  const TrcMode& mode = block.mode();
  const bool inside = (arc.sweep > 0) == (shift > 0);
  violation.values = {
      {"contour_radius", mode.part_radius(radius_of(arc), inside != mode.below_nominal)},
      {"tool_radius", mode.cutting_radius(std::abs(shift))},
      {"difference", radius},
      {"smallest_difference", tolerances_.on_contour}};
  const Position place =
      from_plane(block.mode().plane, block.offset_start, block.programmed.normal.from);
  violation.point = DiagnosticPoint{.x = place[0], .y = place[1], .z = place[2]};
  return diagnostics_.report(std::move(violation));
}

}  // namespace trc
