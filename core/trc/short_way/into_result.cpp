#include "core/trc/short_way/into_result.h"

#include <variant>

#include "core/trc/corner/tool_path.h"
#include "core/trc/passes/contour_violations.h"

namespace trc {

bool IntoResult::put_out(const AtCorner& at, const Joint& joint,
                         std::vector<CompensatedBlock>& out) {
  for (const auto& inserted : joint.inserted())
    if (out_of_range(*inserted, tolerances_)) return false;
  const ShortStep& before = at.before;
  if (const auto* arc = std::get_if<Arc>(&before.programmed->path)) {
    const double left = before.extent - before.cut_at_start - joint.cut_before;
    if (is_consumed(left, at.corner.before.circle.radius, tolerances_)) return false;
    return put_out(
        shortened(*arc, {before.tool_start, joint.end, left}, Consumed::wraps_round, tolerances_),
        at, joint, out);
  }
  const Line path{.start = before.tool_start, .end = joint.end};
  return !runs_back(path.end - path.start, at.corner.before.tangent, tolerances_) &&
         put_out(path, at, joint, out);
}

template <class Path>
bool IntoResult::put_out(const Path& path, const AtCorner& at, const Joint& joint,
                         std::vector<CompensatedBlock>& out) {
  if (out_of_range(path, tolerances_)) return false;
  MotionBlock& programmed = *at.before.programmed;
  const TrcMode& mode = *programmed.mode;
  reporting_.summary().programmed_length += at.before.length;
  const auto inserted = joint.inserted();
  // Before put_out() moves the tracking axes out of the block.
  if (!inserted.empty()) insert_behind(programmed, *at.after.programmed, inserted_);
  reporting_.put_out(programmed, mode, Origin::programmed, path, out);
  for (const auto& segment : inserted) {
    const TrackingTravel tracking = inserted_.tracking;
    reporting_.put_out(inserted_, mode, Origin::transition, *segment, out);
    inserted_.tracking = tracking;
  }
  return true;
}

}  // namespace trc
