#include "core/verify/clearance.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "core/verify/nearest.h"
#include "core/verify/shape.h"

namespace trc::verify {
namespace {

// Contour blocks of one selection in path order, with a tree of rectangles over
// them: neighbours in the program are neighbours in the plane.
class Contour {
 public:
  void add(const MotionBlock& block) { blocks_.push_back(&block); }

  void build() {
    leaves_ = 1;
    while (leaves_ < blocks_.size()) leaves_ *= 2;
    tree_.assign(2 * leaves_, {});
    for (std::size_t i = 0; i < blocks_.size(); ++i) tree_[leaves_ + i].add(blocks_[i]->path);
    for (std::size_t node = leaves_ - 1; node > 0; --node) {
      for (const Bounds& child : {tree_[2 * node], tree_[2 * node + 1]}) {
        if (child.empty) continue;
        tree_[node].add(child.low);
        tree_[node].add(child.high);
      }
    }
  }

  // Calls `visit` for every block whose rectangle comes as near as `reach`.
  template <class Visit>
  void for_each_near(const Bounds& place, double reach, const Visit& visit) const {
    std::vector<std::size_t> open{1};
    while (!open.empty()) {
      const std::size_t node = open.back();
      open.pop_back();
      if (tree_[node].empty || distance(tree_[node], place) > reach) continue;
      if (node >= leaves_) {
        visit(*blocks_[node - leaves_]);
      } else {
        open.push_back(2 * node + 1);
        open.push_back(2 * node);
      }
    }
  }

 private:
  static double distance(const Bounds& a, const Bounds& b) {
    const Vector apart = (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(Vector::Zero());
    return apart.norm();
  }

  std::vector<const MotionBlock*> blocks_;
  std::vector<Bounds> tree_;
  std::size_t leaves_ = 1;
};

struct Programmed {
  const MotionBlock* block = nullptr;
  double required = 0;         // mm, of the path this block gives
  double required_behind = 0;  // mm, of what is inserted behind it
};

struct Plan {
  std::unordered_map<std::uint32_t, Contour> contours;   // by selection
  std::unordered_map<std::uint64_t, Programmed> blocks;  // by source
};

// Whether the second motion goes back on the way the first one came.
bool reverses(const Segment& before, const Segment& after) {
  constexpr double same_way = 1e-4;  // rad
  const Vector in = place_at(before, 1).direction;
  const Vector out = place_at(after, 0).direction;
  return in.dot(out) < 0 && std::abs(cross(in, out)) < same_way;
}

// The approach block is no contour, and neither is the block that carries the
// change to the other side, unless it turns on the spot (REVERSE).
bool is_contour(const MotionBlock& block, const MotionBlock* before) {
  const bool first = !before || before->mode->selection_number != block.mode->selection_number;
  if (first) return block.mode->selection == Selection::perpendicular && !block.mode->tangential;
  if (before->mode->side == block.mode->side) return true;
  return block.mode->options.reverse && reverses(before->path, block.path);
}

Plan plan_of(std::span<const Block> programmed) {
  Plan plan;
  const MotionBlock* before = nullptr;
  for (const Block& block : programmed) {
    const auto* motion = std::get_if<MotionBlock>(&block);
    if (!motion || !motion->mode || !motion->mode->active() || !is_finite(motion->path)) continue;
    const TrcMode& mode = *motion->mode;
    const bool same = before && before->mode->selection_number == mode.selection_number;
    double required = mode.options.suppress_trc ? 0 : mode.tool_radius;
    if (same) {
      required = std::min(required, before->mode->tool_radius);
      plan.blocks[before->source.index].required_behind = required;
    }
    plan.blocks[motion->source.index] = {
        .block = motion, .required = required, .required_behind = required};
    if (is_contour(*motion, before)) plan.contours[mode.selection_number].add(*motion);
    before = motion;
  }
  for (auto& [selection, contour] : plan.contours) contour.build();
  return plan;
}

bool is_checked(Origin origin) {
  switch (origin) {
    case Origin::programmed:
    case Origin::transition:
    case Origin::radius_change:
    case Origin::kerf:
    case Origin::converted_circle:
      return true;
    case Origin::approach:
    case Origin::retract:
    case Origin::masked:
    case Origin::passthrough:
    case Origin::uncompensated:
      break;
  }
  return false;
}

// Whether the middle of the path lies on the side of its own contour block that
// the program asks for.
bool on_programmed_side(const CompensatedBlock& block, const MotionBlock& contour) {
  if (!(contour.mode->tool_radius > 0) || contour.mode->options.suppress_trc) return true;
  const Point middle = place_at(block.path, 0.5).point;
  const Point foot = nearest_point(contour.path, middle);
  const double left = cross(direction_at(contour.path, foot), middle - foot);
  return contour.mode->side == Side::left ? left >= 0 : left <= 0;
}

}  // namespace

ClearanceReport measure_clearance(std::span<const Block> programmed,
                                  std::span<const CompensatedBlock> path, double allowed) {
  const Plan plan = plan_of(programmed);
  ClearanceReport report;
  for (const CompensatedBlock& block : path) {
    if (!is_checked(block.origin) || !is_finite(block.path)) continue;
    const auto own = plan.blocks.find(block.source.index);
    if (own == plan.blocks.end()) continue;
    const auto contour = plan.contours.find(own->second.block->mode->selection_number);
    if (contour == plan.contours.end()) continue;

    ++report.checked;
    const bool inserted =
        block.origin == Origin::transition || block.origin == Origin::radius_change;
    const double own_required = inserted
                                    ? std::min(own->second.required, own->second.required_behind)
                                    : own->second.required;
    std::optional<Clearance> worst;
    const auto note = [&](double distance, double required, const Point& point,
                          const Source& source) {
      if (worst && worst->margin() <= distance - required) return;
      worst = {.distance = distance,
               .required = required,
               .place = from_plane(block.plane, point, block.normal.to),
               .path = block.source,
               .contour = source,
               .accepted = own->second.block->mode->options.ignore_cont_damage};
    };
    Bounds bounds;
    bounds.add(block.path);
    // A little farther than the tool reaches: the blocks it just touches count.
    const double reach = own_required * 1.01 + 1;
    contour->second.for_each_near(bounds, reach, [&](const MotionBlock& near) {
      const Gap gap = gap_between(block.path, near.path);
      const double required =
          std::min(own_required, near.mode->options.suppress_trc ? 0 : near.mode->tool_radius);
      note(gap.distance, required, gap.on_a, near.source);
    });
    if (block.origin == Origin::programmed && !on_programmed_side(block, *own->second.block)) {
      const Point middle = place_at(block.path, 0.5).point;
      const Point foot = nearest_point(own->second.block->path, middle);
      note(-(middle - foot).norm(), own_required, middle, block.source);
    }
    if (!worst) continue;
    if (worst->margin() < -allowed) {
      ++report.gouging;
      if (worst->accepted) ++report.accepted;
    }
    if (!report.worst || worst->margin() < report.worst->margin()) report.worst = worst;
  }
  return report;
}

}  // namespace trc::verify
