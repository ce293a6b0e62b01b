#include "core/trc/clearance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/box_tree.h"
#include "core/geometry/distance.h"
#include "core/trc/selection_limit.h"

namespace trc {
namespace {

bool is_contour(const PathBlock& block) { return block.role == Role::contour; }

// Approach and retract are not monitored (D-11).
bool is_monitored(const PathBlock& block) {
  return (is_contour(block) && !block.masked) ||
         (block.role == Role::inserted && block.origin == Origin::transition);
}

double tool_radius(const PathBlock& block) {
  return std::min(std::abs(block.at_start.shift), std::abs(block.at_end.shift));
}

struct Violation {
  const PathBlock* contour = nullptr;
  double distance = 0;
  Point place = Point::Zero();
};

}  // namespace

bool Clearance::feed(PathBlock block, std::vector<PathBlock>& out) {
  // The approach waits too: the tool must not enter what it cannot get through.
  const bool begins = block.role == Role::approach || block.perpendicular_entry;
  const bool belongs = begins || is_contour(block) || block.role == Role::inserted;
  const bool wanted = belongs && !block.removes_loops() &&
                      (implicit_ || block.mode().masking == Masking::on || !held_.empty());
  if (wanted && !begins) {
    if (held_.size() >= selection_blocks_)
      return diagnostics_.report(selection_too_long(block, selection_blocks_));
    held_.push_back(std::move(block));
    return true;
  }
  if (!resolve(out)) return false;
  if (wanted) {
    held_.push_back(std::move(block));
  } else {
    out.push_back(std::move(block));
  }
  return true;
}

bool Clearance::resolve(std::vector<PathBlock>& out) {
  std::vector<const PathBlock*> contour;
  std::vector<Box> boxes;
  for (const PathBlock& block : held_) {
    if (!is_contour(block)) continue;
    contour.push_back(&block);
    boxes.push_back(bounding_box(block.programmed.path));
  }
  const BoxTree tree(boxes);
  bool violating = false;  // so was the block before: one report for a stretch
  for (const PathBlock& block : held_) {
    if (!is_monitored(block)) continue;
    const double radius = tool_radius(block);
    const double limit = radius - tolerances_.clearance * std::max(radius, 1.0);
    Box area = bounding_box(block.tool_path);
    area.min().array() -= radius;
    area.max().array() += radius;
    Violation worst{.distance = limit};
    tree.for_each_in(area, [&](std::size_t index) {
      const auto near =
          nearness(block.tool_path, contour[index]->programmed.path, tolerances_.same_point);
      if (near.distance < worst.distance)
        worst = {.contour = contour[index], .distance = near.distance, .place = near.on_first};
    });
    const bool violates = worst.contour != nullptr;
    if (violates && !violating && !report(block, *worst.contour, worst.distance, worst.place))
      return false;
    violating = violates;
  }
  for (PathBlock& block : held_) out.push_back(std::move(block));
  held_.clear();
  return true;
}

bool Clearance::report(const PathBlock& path, const PathBlock& contour, double distance,
                       const Point& place) {
  Diagnostic found = diagnostic(Code::bottleneck, path.programmed.source);
  const bool masking = path.mode().masking == Masking::on;
  if (path.mode().options.ignore_cont_damage || (masking && !implicit_))
    found.severity = Severity::warning;
  found.values = {{"other_index", static_cast<double>(contour.programmed.source.index)},
                  {"clearance", distance},
                  {"tool_radius", tool_radius(path)}};
  const Position position = from_plane(path.mode().plane, place, path.programmed.normal.to);
  found.point = DiagnosticPoint{.x = position[0], .y = position[1], .z = position[2]};
  return diagnostics_.report(std::move(found));
}

}  // namespace trc
