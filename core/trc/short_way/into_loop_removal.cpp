#include "core/trc/short_way/into_loop_removal.h"

#include <algorithm>
#include <type_traits>
#include <variant>

#include "core/base/flatten.h"
#include "core/trc/corner/tool_path.h"

namespace trc {

TRC_FLATTEN [[gnu::noinline]] void IntoLoopRemoval::hold(const AtCorner& at, const Joint& joint,
                                                         HeldPath::Reach inserted) {
  const ShortStep& before = at.before;
  const HeldPath::Cuts cuts{before.cut_at_start, joint.cut_before};
  if (const auto* arc = std::get_if<Arc>(&before.programmed->path)) {
    const double left = before.extent - cuts.at_start - cuts.at_end;
    std::visit(
        [&](const auto& path) { hold(*arc, path, cuts, at); },
        shortened(*arc, {before.tool_start, joint.end, left}, Consumed::runs_back, tolerances_));
  } else {
    const Line path{.start = before.tool_start, .end = joint.end};
    hold(std::get<Line>(before.programmed->path), path, cuts, at);
  }
  if (!joint.inserted().empty()) hold_inserted(joint, inserted, at);
}

template <class Programmed, class Path>
void IntoLoopRemoval::hold(const Programmed& programmed, const Path& path,
                           const HeldPath::Cuts& cuts, const AtCorner& at) {
  const ShortStep& before = at.before;
  const double left_inside =
      before.extent - std::max(cuts.at_start, 0.0) - std::max(cuts.at_end, 0.0);
  Certificate::Block course{.tangent_at_start = before.tangent_at_start,
                            .tangent_at_end = at.corner.before.tangent,
                            .left = before.unreachable ? 0 : left_inside * before.radius,
                            .shift_at_start = at.corner.shift,
                            .shift_at_end = at.corner.shift};
  if constexpr (std::is_same_v<Programmed, Arc>) course.sweep = programmed.sweep;
  const auto reach = before.unreachable ? HeldPath::Reach::unreachable : HeldPath::Reach::reachable;
  const LoopRemoval::PlainEntry::ContourBlock<Programmed, Path> given{
      *before.programmed, programmed, path, cuts, course, reach};
  goes_on_ = entry_.take(given, leaving_);
}

void IntoLoopRemoval::hold_inserted(const Joint& joint, HeldPath::Reach reach, const AtCorner& at) {
  const MotionBlock& programmed = *at.before.programmed;
  const bool has_more = programmed.rapid || programmed.feed <= 0 || programmed.normal.moves() ||
                        !programmed.tracking.empty();
  if (has_more) insert_behind(programmed, *at.after.programmed, inserted_);
  const bool rapid = inserted_.rapid;
  const auto take = [&]<class Path>(const Path& path) {
    const LoopRemoval::PlainEntry::Transition<Path> given{path, reach};
    if (!has_more) return entry_.take(given, programmed.source, leaving_);
    inserted_.rapid = rapid && std::is_same_v<Path, Line>;
    return entry_.take(given, inserted_, leaving_);
  };
  for (const auto& segment : joint.inserted()) {
    if (!goes_on_) return;
    goes_on_ = std::visit(take, *segment);
  }
}

// A report belongs to the block that was taken last: the run ends with that block.
void IntoLoopRemoval::put_out_leaving(std::vector<CompensatedBlock>& out) {
  if (goes_on_ && !leaving_.empty()) goes_on_ = leave_selection_(leaving_, out);
  leaving_.clear();
  // The diagnostics of a line follow that line.
  goes_on_ = goes_on_ && diagnostics_.pending().empty();
}

}  // namespace trc
