#include "tests/support/slow_verification.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "core/trc/walls/selection_contours.h"
#include "core/verify/coverage.h"
#include "core/verify/nearest.h"
#include "core/verify/shape.h"

namespace trc::support {
namespace {

using namespace verify;

// Contour blocks of one selection in path order, with a tree of rectangles over
// them: neighbours in the program are neighbours in the plane.
class Contour {
 public:
  void add(const MotionBlock& block) {
    if (!blocks_.empty() && blocks_.back()->mode->side != block.mode->side)
      changes_.push_back(blocks_.size());
    blocks_.push_back(&block);
  }
  [[nodiscard]] std::size_t size() const { return blocks_.size(); }

  void build(const LeadSettings& leads) {
    walls_ = find_walls({.blocks = blocks_, .changes = changes_}, leads);
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

  // What of a block is a wall; nothing where none of it is.
  [[nodiscard]] Stretch wall_of(std::size_t number) const {
    if (walls_.is_lead(number)) return {};
    const double length = extent_of(blocks_[number]->path);
    const auto part = walls_.part_of(number);
    return part ? Stretch{part->from, std::min(part->to, length)} : Stretch{0, length};
  }
  [[nodiscard]] double wall_length() const {
    double length = 0;
    for (std::size_t number = 0; number < blocks_.size(); ++number)
      length += wall_of(number).length();
    return length;
  }
  // Calls visit(block, wall, touch) for every wall for the path of the block `own` whose rectangle
  // comes as near as `reach`; `touch` is how much nearer than the radius that may be, mm.
  template <class Visit>
  void for_each_near(const Bounds& place, std::size_t own, double reach, const Visit& visit) const {
    std::vector<std::size_t> open{1};
    while (!open.empty()) {
      const std::size_t node = open.back();
      open.pop_back();
      if (tree_[node].empty || distance(tree_[node], place) > reach) continue;
      if (node >= leaves_) {
        const std::size_t number = node - leaves_;
        if (walls_.is_lead(number) || !walls_.is_wall_for(number, own)) continue;
        const MotionBlock& block = *blocks_[number];
        const auto part = walls_.part_of(number);
        visit(block, part ? part_of(block.path, wall_of(number)) : block.path,
              walls_.touch_between(number, own));
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
  std::vector<std::size_t> changes_;  // of side
  SidedWalls walls_;
  std::vector<Bounds> tree_;
  std::size_t leaves_ = 1;
};

struct Programmed {
  const MotionBlock* block = nullptr;
  double required = 0;          // mm, of the path this block gives
  double required_behind = 0;   // mm, of what is inserted after it
  bool crosses_behind = false;  // REVERSE: what is inserted after it crosses the corner (D-22)
  std::size_t number = 0;       // in its contour, or of the block after it
  bool is_contour = false;
};

struct Plan {
  std::unordered_map<std::uint32_t, Contour> contours;   // by selection
  std::unordered_map<std::uint64_t, Programmed> blocks;  // by source
};

// The approach block is no contour, and neither is the block that carries the
// change to the other side, unless the side changes at its corner (REVERSE).
bool is_contour(const MotionBlock& block, const MotionBlock* before) {
  const bool first = !before || before->mode->selection_number != block.mode->selection_number;
  if (first) return block.mode->selection == Selection::perpendicular && !block.mode->tangential;
  if (before->mode->side == block.mode->side) return true;
  return block.mode->options.reverse;
}

Plan plan_of(std::span<const Block> programmed, const LeadSettings& leads) {
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
    Contour& contour = plan.contours[mode.selection_number];
    const bool is_on_contour = is_contour(*motion, before);
    plan.blocks[motion->source.index] = {.block = motion,
                                         .required = required,
                                         .required_behind = required,
                                         .number = contour.size(),
                                         .is_contour = is_on_contour};
    if (is_on_contour && same && before->mode->side != mode.side)
      plan.blocks[before->source.index].crosses_behind = true;
    if (is_on_contour) contour.add(*motion);
    before = motion;
  }
  for (auto& [selection, contour] : plan.contours) contour.build(leads);
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

ClearanceReport slow_verification(std::span<const Block> programmed,
                                  std::span<const CompensatedBlock> path, double allowed,
                                  const LeadSettings& leads) {
  const Plan plan = plan_of(programmed, leads);
  ClearanceReport report;
  for (const auto& [selection, contour] : plan.contours)
    report.wall_length += contour.wall_length();
  for (const CompensatedBlock& block : path) {
    if (!is_checked(block.origin) || !is_finite(block.path)) continue;
    const auto own = plan.blocks.find(block.source.index);
    if (own == plan.blocks.end()) continue;
    const auto contour = plan.contours.find(own->second.block->mode->selection_number);
    if (contour == plan.contours.end() || contour->second.size() == 0) continue;

    const bool inserted =
        block.origin == Origin::transition || block.origin == Origin::radius_change;
    if (inserted && own->second.crosses_behind) continue;
    const TrcMode& mode = *own->second.block->mode;
    if (mode.options.suppress_trc && mode.tool_radius > 0) continue;
    ++report.checked;
    const double own_required = inserted
                                    ? std::min(own->second.required, own->second.required_behind)
                                    : own->second.required;
    std::optional<Clearance> worst;
    bool gouges = false;
    const auto note = [&](double distance, double required, double touch, const Point& point,
                          const Source& source) {
      if (distance - required + touch < -allowed) gouges = true;
      if (worst && worst->margin() <= distance - required) return;
      worst = {.distance = distance,
               .required = required,
               .place = from_plane(block.plane, point, block.normal.to),
               .path = block.source,
               .contour = source};
    };
    Bounds bounds;
    bounds.add(block.path);
    // A little farther than the tool reaches: the blocks it just touches count.
    const double reach = own_required * 1.01 + 1;
    contour->second.for_each_near(
        bounds, own->second.number, reach,
        [&](const MotionBlock& near, const Segment& wall, double touch) {
          const Gap gap = gap_between(block.path, wall);
          const double required =
              std::min(own_required, near.mode->options.suppress_trc ? 0 : near.mode->tool_radius);
          note(gap.distance, required, touch, gap.on_a, near.source);
        });
    if (!inserted && own->second.is_contour)
      report.touched_length +=
          touched(piece_of(own->second.block->path), contour->second.wall_of(own->second.number),
                  piece_of(block.path), own_required)
              .length();
    if (block.origin == Origin::programmed && !on_programmed_side(block, *own->second.block)) {
      const Point middle = place_at(block.path, 0.5).point;
      const Point foot = nearest_point(own->second.block->path, middle);
      note(-(middle - foot).norm(), own_required, 0, middle, block.source);
    }
    if (!worst) continue;
    if (gouges) ++report.gouging;
    if (!report.worst || worst->margin() < report.worst->margin()) report.worst = worst;
  }
  return report;
}

}  // namespace trc::support
