#include "core/trc/loops/removed_loop.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/geometry/along.h"
#include "core/trc/corner/tool_path.h"

namespace trc {

DroppedBlocks::OtherAxes DroppedBlocks::other_axes_at(const AxisTravel& normal,
                                                      const TrackingTravel& tracking,
                                                      double AxisTravel::*end) {
  OtherAxes place{.normal = normal.*end};
  for (const AxisTravel& axis : tracking) place.tracking.push_back(axis.*end);
  return place;
}

DroppedBlocks::OtherAxes DroppedBlocks::other_axes_behind(const PathBlock& block) {
  return other_axes_at(block.programmed.normal, block.programmed.tracking, &AxisTravel::to);
}

// The other axes after the passive blocks of the block.
DroppedBlocks::OtherAxes DroppedBlocks::other_axes_after(const PathBlock& block) {
  const PassiveBlock& last = block.passive.back();
  return other_axes_at(last.normal, last.tracking, &AxisTravel::to);
}

void DroppedBlocks::add(PathBlockPtr block) {
  if (!std::exchange(begun_, true))
    other_axes_ =
        other_axes_at(block->programmed.normal, block->programmed.tracking, &AxisTravel::from);
  if (block->passive.empty()) {
    waiting_ = std::move(block);
    return;
  }
  waiting_.reset();
  move_behind(*block);
  other_axes_ = other_axes_after(*block);
  PathBlock& carrier = *out_.emplace_back(std::make_unique<PathBlock>());
  carrier.role = Role::passive;
  carrier.programmed.source = block->programmed.source;
  carrier.programmed.mode = block->programmed.mode;
  carrier.passive = std::move(block->passive);
}

void DroppedBlocks::finish() {
  if (waiting_) move_behind(*waiting_);
}

void DroppedBlocks::move_behind(const PathBlock& block) {
  const MotionBlock& programmed = block.programmed;
  const OtherAxes target = other_axes_behind(block);
  TrackingTravel tracking = programmed.tracking;
  // Until a tracking axis is programmed for the first time, all are at 0 and are not listed.
  other_axes_.tracking.resize(tracking.size());
  for (std::size_t axis = 0; axis < tracking.size(); ++axis)
    tracking[axis] = {other_axes_.tracking[axis], target.tracking[axis]};
  const AxisTravel normal{.from = other_axes_.normal, .to = target.normal};
  const auto moves = [](const AxisTravel& axis) { return axis.moves(); };
  if (!normal.moves() && std::none_of(tracking.begin(), tracking.end(), moves)) return;
  other_axes_ = target;
  PathBlock& carrier = *out_.emplace_back(std::make_unique<PathBlock>());
  carrier.role = Role::contour;
  carrier.origin = Origin::masked;
  carrier.masked = true;
  carrier.programmed = {.source = programmed.source,
                        .path = Line{.start = place_, .end = place_},
                        .normal = normal,
                        .feed = programmed.feed,
                        .rapid = programmed.rapid,
                        .mode = programmed.mode,
                        .tracking = std::move(tracking)};
  carrier.at_start = carrier.at_end = block.at_end;
  carrier.tool_path = carrier.programmed.path;
}

void shorten(PathBlock& block, double from, double to, const Point& start, const Point& end) {
  const double length = length_of(block.tool_path);
  const auto* arc = std::get_if<Arc>(&block.tool_path);
  const double scale = arc != nullptr && is_arc(block.programmed.path) ? radius_of(*arc) : 1;
  block.cut_at_start += from / scale;
  block.cut_at_end += (length - to) / scale;
  block.tool_path = stretch_of(block.tool_path, from, to, start, end);
}

PathBlockPtr circle_behind_loop(const Point& place, const Vector& arrives, const PathBlock& after,
                                double along) {
  auto owner = std::make_unique<PathBlock>();
  PathBlock& circle = *owner;
  circle.role = Role::inserted;
  circle.origin = Origin::transition;
  circle.at_start = circle.at_end = after.at_start;
  const MotionBlock& programmed = after.programmed;
  circle.programmed = {.source = programmed.source,
                       .normal = standing(programmed.normal.from),
                       .feed = programmed.feed,
                       .mode = programmed.mode};
  for (const AxisTravel& axis : programmed.tracking)
    circle.programmed.tracking.push_back(standing(axis.from));
  circle.tool_path = Arc{.start = place,
                         .end = place,
                         .center = place,
                         .sweep = turn_between(arrives, tangent_along(after.tool_path, along))};
  return owner;
}

}  // namespace trc
