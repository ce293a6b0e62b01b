#include "core/trc/corner/radius_change.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/trc/corner/offsets.h"
#include "core/trc/corner/tool_path.h"

namespace trc {
namespace {

constexpr double pi = std::numbers::pi;

AxisTravel cut(AxisTravel& travel, double share) {
  const double middle = travel.from + share * (travel.to - travel.from);
  return {.from = std::exchange(travel.from, middle), .to = middle};
}

bool changes_radius_in_a_long_arc(const PathBlock& block) {
  const auto* arc = std::get_if<Arc>(&block.programmed.path);
  return arc != nullptr && block.role == Role::contour && block.at_start != block.at_end &&
         std::abs(arc->sweep) - block.cut_at_end > pi;
}

}  // namespace

PathBlockPtr take_first_half(PathBlock& block, const Tolerances& tolerances) {
  if (!changes_radius_in_a_long_arc(block)) return nullptr;
  Arc& arc = std::get<Arc>(block.programmed.path);
  const double half = std::copysign(pi, arc.sweep);
  const double share = half / arc.sweep;
  const Point middle = 2 * arc.center - arc.start;
  auto first = std::make_unique<PathBlock>(block);
  first->origin = Origin::radius_change;
  first->perpendicular_exit = false;
  first->passive.clear();
  first->passive_after_exit.clear();
  first->programmed.path =
      Arc{.start = arc.start, .end = middle, .center = arc.center, .sweep = half};
  first->programmed.normal = cut(block.programmed.normal, share);
  for (std::size_t axis = 0; axis < block.programmed.tracking.size(); ++axis)
    first->programmed.tracking[axis] = cut(block.programmed.tracking[axis], share);
  first->cut_at_end = 0;
  arc = Arc{.start = middle, .end = arc.end, .center = arc.center, .sweep = arc.sweep - half};
  block.at_start = block.at_end;
  block.perpendicular_entry = false;
  block.cut_at_start = 0;
  give_offsets(*first);
  give_offsets(block);
  block.tool_start = block.offset_start;
  first->tool_path = refitted(std::get<Arc>(first->programmed.path), first->tool_start,
                              block.tool_start, tolerances.on_contour);
  block.tool_path = shortened(
      arc, {block.tool_start, end_of(block.tool_path), std::abs(arc.sweep) - block.cut_at_end},
      Consumed::runs_back, tolerances);
  return first;
}

}  // namespace trc
