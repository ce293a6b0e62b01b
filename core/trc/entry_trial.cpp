#include "core/trc/entry_trial.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "core/geometry/box_tree.h"
#include "core/geometry/distance.h"
#include "core/trc/compensator.h"

namespace trc::selection {
namespace {

// The rest of a block after a corner has cut its start; empty if nothing is left.
std::optional<Segment> behind_cut(const Segment& block, double cut) {
  if (cut <= 0) return block;
  if (const auto* line = std::get_if<Line>(&block)) {
    if (cut >= length_of(*line)) return std::nullopt;
    return Line{.start = line->start + cut * tangent_of(*line), .end = line->end};
  }
  Arc arc = std::get<Arc>(block);
  if (cut >= std::abs(arc.sweep)) return std::nullopt;
  const double turn = std::copysign(cut, arc.sweep);
  const Vector radial = arc.start - arc.center;
  arc.start = arc.center + std::cos(turn) * radial + std::sin(turn) * left_of(radial);
  arc.sweep -= turn;
  return arc;
}

// Accepted, but not worth proposing.
bool leaves_much_out(const Diagnostics& found) {
  const auto& told = found.pending();
  return std::any_of(told.begin(), told.end(), [](const Diagnostic& diagnostic) {
    return diagnostic.code == Code::blocks_masked && diagnostic.severity == Severity::warning;
  });
}

}  // namespace

bool EntryTrial::does(const EntryWay& way) const {
  Diagnostics diagnostics;
  const auto [accepted, path] = compensated(way, setup_, diagnostics);
  const bool removes_loops = std::holds_alternative<WayPastLeads>(refused_.kind);
  if (!accepted || (removes_loops && leaves_much_out(diagnostics))) return false;
  const bool is_all_at_stake = std::holds_alternative<WayBesideCorner>(refused_.kind);
  return std::all_of(path.begin(), path.end(), [&](const CompensatedBlock& block) {
    // Under G238 the contour begins and ends elsewhere too. Loop removal keeps the rest clear.
    const bool is_at_stake = is_all_at_stake || is_of_way(block, way.motions.size());
    return !is_at_stake || block.origin == Origin::masked || is_clear(block.path);
  });
}

bool EntryTrial::is_accepted_with_help(const EntryWay& way, Diagnostics& diagnostics) const {
  CompensatorSetup setup = setup_;
  setup.helps_with_entries = true;
  return compensated(way, setup, diagnostics).accepted;
}

EntryTrial::Tried EntryTrial::compensated(const EntryWay& way, CompensatorSetup setup,
                                          Diagnostics& diagnostics) const {
  std::vector<Block> blocks = program(way);
  if (blocks.empty()) return {};
  const auto& first = std::get<MotionBlock>(blocks.front());
  setup.start = from_plane(plane_, start_of(first.path), first.normal.from);
  const TrcMode at_end = *std::get<MotionBlock>(blocks.back()).mode;
  Compensator compensator(setup, diagnostics);
  Tried tried;
  tried.accepted = compensator.feed(blocks, tried.path) && compensator.finish(at_end, tried.path);
  return tried;
}

// The way and the contour, numbered from 0 by Source::index; empty if no contour is left.
std::vector<Block> EntryTrial::program(const EntryWay& way) const {
  std::vector<MotionBlock> motions;
  const auto add_lead = [&](const Segment& path, const MotionBlock& like) {
    MotionBlock lead = like;
    lead.path = path;
    motions.push_back(std::move(lead));
  };
  if (const auto* out = std::get_if<WayOut>(&refused_.kind)) {
    // The blocks before the last one are not known any more: the rest of it is entered across.
    MotionBlock last = nearest_contour_block_;
    const auto left = behind_cut(last.path, out->cut_at_start);
    if (!left) return {};
    last.path = *left;
    TrcMode mode = *last.mode;
    mode.selection = Selection::perpendicular;
    mode.tangential = false;
    last.mode = std::make_shared<const TrcMode>(mode);
    motions.push_back(last);
    for (std::size_t i = 0; i + 1 < way.motions.size(); ++i) add_lead(way.motions[i], last);
    motions.push_back(refused_block_);
    motions.back().path = way.motions.back();
  } else {
    motions.push_back(refused_block_);
    motions.back().path = way.motions.front();
    for (std::size_t i = 1; i < way.motions.size(); ++i)
      add_lead(way.motions[i], nearest_contour_block_);
    motions.insert(motions.end(), contour_.begin(), contour_.end());
  }
  std::vector<Block> blocks;
  for (MotionBlock& motion : motions) {
    if (way.shape == EntryProposal::Shape::inside_corner) {
      TrcMode mode = *motion.mode;
      mode.selection = Selection::inside_corner;
      motion.mode = std::make_shared<const TrcMode>(mode);
    }
    motion.source.index = blocks.size();
    // Only the plane matters; the height of leads that are left out is not known.
    motion.normal = {.from = refused_block_.normal.from, .to = refused_block_.normal.from};
    motion.tracking.clear();
    blocks.emplace_back(std::move(motion));
  }
  return blocks;
}

bool EntryTrial::is_of_way(const CompensatedBlock& block, std::size_t motions) const {
  if (refused_.leaves()) return block.source.index > 0 || block.origin == Origin::retract;
  return block.source.index < motions;
}

bool EntryTrial::is_clear(const Segment& path) const {
  if (length_of(path) <= setup_.tolerances.same_point) return true;
  const double required = std::abs(refused_.shift) - setup_.tolerances.on_contour;
  const Box around = bounding_box(path);
  return std::all_of(walls_.begin(), walls_.end(), [&](const MotionBlock& block) {
    if (squared_distance(around, bounding_box(block.path)) > required * required) return true;
    return nearness(path, block.path, setup_.tolerances.same_point).distance >= required;
  });
}

}  // namespace trc::selection
