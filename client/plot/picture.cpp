#include "client/plot/picture.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "client/plot/changed_contour.h"
#include "core/base/entry_help.h"
#include "core/base/explanation.h"
#include "core/geometry/along.h"
#include "core/trc/result/listing.h"
#include "core/trc/walls/selection_contours.h"

namespace trc::plot {
namespace {

std::string number_of(const Source& source) {
  if (source.number != Source::no_number) return "N" + std::to_string(source.number);
  if (source.line > 0) return "line " + std::to_string(source.line);
  return "block " + std::to_string(source.index + 1);
}

Layer layer_of(Origin origin) {
  switch (origin) {
    case Origin::transition:
    case Origin::radius_change:
      return Layer::transition;
    case Origin::masked:
      return Layer::masked;
    case Origin::approach:
    case Origin::retract:
    case Origin::uncompensated:
      return Layer::approach;
    default:
      return Layer::path;
  }
}

Plane plane_to_show(const Contents& contents) {
  if (contents.plane) return *contents.plane;
  const MotionBlock* first = nullptr;
  for (const Block& block : contents.programmed) {
    const auto* motion = std::get_if<MotionBlock>(&block);
    if (!motion || !motion->mode) continue;
    if (motion->mode->active()) return motion->mode->plane;
    if (!first) first = motion;
  }
  if (first) return first->mode->plane;
  return contents.path.empty() ? Plane::xy : contents.path.front().plane;
}

// What of the contour blocks is no wall, by their Source::index.
class LeadBlocks {
 public:
  // mm from the start of a block; nothing of a lead is a wall.
  struct Wall {
    double from = 0;
    double to = 0;
  };

  explicit LeadBlocks(const Contents& contents) {
    for (const SelectionContour& contour : contours_of(contents.programmed)) {
      const SidedWalls walls = find_walls(contour, contents.leads);
      for (std::size_t number = 0; number < contour.blocks.size(); ++number) {
        const MotionBlock& block = *contour.blocks[number];
        contour_.insert(contour_.end(), block.source.index);
        if (walls.is_lead(number))
          walls_.insert_or_assign(block.source.index, Wall{});
        else if (const auto part = walls.part_of(number))
          walls_.insert_or_assign(block.source.index,
                                  Wall{part->from, std::min(part->to, length_of(block.path))});
      }
    }
  }
  // Not what leads to a contour, from it, or by without compensation.
  [[nodiscard]] bool is_in_contour(std::uint64_t index) const {
    return contour_.find(index) != contour_.end();
  }
  // Nothing: all of the block is a wall.
  [[nodiscard]] std::optional<Wall> wall_of(std::uint64_t index) const {
    const auto found = walls_.find(index);
    return found == walls_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  std::set<std::uint64_t> contour_{};
  std::map<std::uint64_t, Wall> walls_{};
};

class Composer {
 public:
  explicit Composer(const Contents& contents) : contents_(contents) {
    picture_.title = contents.title;
    picture_.plane = plane_to_show(contents);
    single_ = contents.programmed.size() + contents.path.size() <= most_single_strokes;
  }

  Picture compose() {
    add_programmed();
    add_path();
    add_tools();
    add_radius_changes();
    add_warnings();
    add_fault();
    add_proposals();
    std::stable_sort(picture_.strokes.begin(), picture_.strokes.end(),
                     [](const Stroke& a, const Stroke& b) { return a.layer < b.layer; });
    return std::move(picture_);
  }

 private:
  void add(Stroke stroke) {
    std::erase_if(stroke.segments, [](const Segment& segment) { return !is_finite(segment); });
    if (stroke.segments.empty()) return;
    if (!single_) {
      stroke.title.clear();
      Stroke& before = last_of(stroke.layer);
      if (!before.segments.empty() && before.rapid == stroke.rapid) {
        before.segments.insert(before.segments.end(), stroke.segments.begin(),
                               stroke.segments.end());
        return;
      }
      flush(before);
      before = std::move(stroke);
      return;
    }
    picture_.strokes.push_back(std::move(stroke));
  }

  Stroke& last_of(Layer layer) { return joined_[static_cast<std::size_t>(layer)]; }

  void flush(Stroke& stroke) {
    if (!stroke.segments.empty()) picture_.strokes.push_back(std::exchange(stroke, {}));
  }

  void flush_joined() {
    for (Stroke& stroke : joined_) flush(stroke);
  }

  void add_programmed() {
    const NotTravelled masked(contents_.diagnostics);
    changed_ = changed_contour(contents_.programmed, contents_.path);
    const LeadBlocks leads(contents_);
    Position position{};
    for (const Block& block : contents_.programmed)
      std::visit(overloaded{[&](const MotionBlock& motion) {
                              if (!motion.mode) return;
                              const bool lost = masked.contains(motion.source.index);
                              show(motion, lost, leads);
                              const PlaneAxes axes = axes_of(motion.mode->plane);
                              const Place end = place_at(motion.path, 1);
                              position[axes.first] = end.point.x();
                              position[axes.second] = end.point.y();
                              position[axes.third] = motion.normal.to;
                            },
                            [&](const PassiveBlock& passive) {
                              if (!passive.moves || !passive.mode) return;
                              show(passive, position);
                              position[axes_of(passive.mode->plane).third] = passive.normal.to;
                            }},
                 block);
    flush_joined();
  }

  void show(const MotionBlock& motion, bool lost, const LeadBlocks& blocks) {
    const std::optional<LeadBlocks::Wall> wall = blocks.wall_of(motion.source.index);
    const Plane plane = motion.mode->plane;
    const auto changed = changed_.find(motion.source.index);
    if (changed != changed_.end()) {
      add({.layer = Layer::replaced,
           .segments = project(plane, motion.path, motion.normal, picture_.plane),
           .title = number_of(motion.source) + " as programmed"});
      add({.layer = Layer::programmed,
           .segments = project(plane, changed->second, motion.normal, picture_.plane),
           .title = number_of(motion.source) + " contour, changed"});
      return;
    }
    // A block the closing point lies in is a wall on one side of it and a lead on the other one.
    const bool parted = wall && wall->to > wall->from && !lost && is_finite(motion.path);
    if (parted) {
      const double length = length_of(motion.path);
      show_part(motion, 0, wall->from, true);
      show_part(motion, wall->from, wall->to, false);
      show_part(motion, wall->to, length, true);
    } else {
      const bool leads = wall && !(wall->to > wall->from);
      const bool inside = blocks.is_in_contour(motion.source.index);
      show(motion, motion.path,
           lost      ? Layer::masked
           : !inside ? Layer::beside
           : leads   ? Layer::lead
                     : Layer::programmed);
    }
    if (plane != picture_.plane || !single_ || !is_finite(motion.path)) return;
    const Place middle = place_at(motion.path, 0.5);
    const Vector left = left_of(middle.direction);
    // Away from the tool.
    picture_.numbers.push_back({.at = middle.point,
                                .aside = motion.mode->side == Side::left ? Vector(-left) : left,
                                .text = number_of(motion.source)});
  }

  void show_part(const MotionBlock& motion, double from, double to, bool leads) {
    if (!(to > from)) return;
    const Segment part = stretch_of(motion.path, from, to, point_along(motion.path, from),
                                    point_along(motion.path, to));
    show(motion, part, leads ? Layer::lead : Layer::programmed);
  }

  void show(const MotionBlock& motion, const Segment& part, Layer layer) {
    const bool lost = layer == Layer::masked;
    add({.layer = layer,
         .rapid = motion.rapid,
         .segments = project(motion.mode->plane, part, motion.normal, picture_.plane),
         .title = number_of(motion.source) + (layer == Layer::lead ? " lead" : " contour") +
                  (lost ? ", not travelled" : "")});
  }

  void show(const PassiveBlock& passive, const Position& position) {
    const Plane plane = passive.mode->plane;
    const Point here = to_plane(plane, position);
    add({.layer = Layer::beside,
         .rapid = passive.rapid,
         .segments =
             project(plane, Line{.start = here, .end = here}, passive.normal, picture_.plane),
         .title = number_of(passive.source) + " contour"});
  }

  void add_path() {
    for (std::size_t at = 0; at < contents_.path.size(); ++at) {
      const CompensatedBlock& block = contents_.path[at];
      if (block.origin == Origin::passthrough) continue;
      add({.layer = is_inserted(at) ? Layer::transition : layer_of(block.origin),
           .rapid = block.rapid,
           .segments = project(block.plane, block.path, block.normal, picture_.plane),
           .title = number_of(block.source) + " " + std::string(name_of(block.origin))});
    }
    flush_joined();
  }

  // What TRC inserts between the approach block and the contour, or between the contour and the
  // retract block: the block itself is the first one of an approach and the last one of a retract.
  [[nodiscard]] bool is_inserted(std::size_t at) const {
    const CompensatedBlock& block = contents_.path[at];
    const bool approach = block.origin == Origin::approach;
    if (!approach && block.origin != Origin::retract) return false;
    const std::size_t own = approach ? at - 1 : at + 1;
    if (own >= contents_.path.size()) return false;
    const CompensatedBlock& other = contents_.path[own];
    if (other.origin != block.origin || (approach && other.source.index != block.source.index))
      return false;
    // Parts of one line, as SPLIT makes them, are the block itself.
    const Vector way = place_at(block.path, 0.5).direction;
    return is_arc(block.path) || is_arc(other.path) ||
           (way - place_at(other.path, 0.5).direction).norm() > 1e-6;
  }

  void add_warnings() {
    for (const Diagnostic& diagnostic : contents_.diagnostics) {
      if (diagnostic.severity != Severity::warning) continue;
      if (picture_.warnings.size() == most_warnings) return;
      picture_.warnings.push_back({.place = place_of(diagnostic),
                                   .text = text_of("warning ", diagnostic),
                                   .remedy = remedy_of(diagnostic)});
    }
  }

  // The tool where the first approach begins and where it first touches.
  void add_tools() {
    const MotionBlock* selected = nullptr;
    for (const Block& block : contents_.programmed) {
      const auto* motion = std::get_if<MotionBlock>(&block);
      if (motion && motion->mode && motion->mode->active() &&
          motion->mode->plane == picture_.plane) {
        selected = motion;
        break;
      }
    }
    if (!selected || !(selected->mode->cutting_radius() > 0)) return;
    const double radius = selected->mode->cutting_radius();
    const auto approach =
        std::find_if(contents_.path.begin(), contents_.path.end(), [&](const auto& block) {
          return block.source.index >= selected->source.index &&
                 block.origin != Origin::passthrough;
        });
    if (approach == contents_.path.end()) {
      picture_.tools.push_back({.center = place_at(selected->path, 0).point, .radius = radius});
      return;
    }
    picture_.tools.push_back({.center = place_at(approach->path, 0).point, .radius = radius});
    auto last = approach;
    for (auto block = approach; block != contents_.path.end(); ++block) {
      if (block->origin != Origin::approach && block->origin != Origin::passthrough) break;
      if (block->origin == Origin::approach) last = block;
    }
    if (last->origin == Origin::approach)
      picture_.tools.push_back({.center = place_at(last->path, 1).point, .radius = radius});
  }

  // Where another radius takes over: the tool before and the tool behind.
  void add_radius_changes() {
    const MotionBlock* before = nullptr;
    std::size_t changes = 0;
    for (const Block& block : contents_.programmed) {
      const auto* motion = std::get_if<MotionBlock>(&block);
      if (!motion || !motion->mode) continue;
      const bool compensates = motion->mode->active() && motion->mode->plane == picture_.plane;
      if (before && compensates &&
          before->mode->cutting_radius() != motion->mode->cutting_radius()) {
        if (++changes > most_radius_changes) return;
        add_tools_of_change(*before, *motion);
      }
      before = compensates ? motion : nullptr;
    }
  }

  // On a block that was inserted for it, or else on the first block with the new radius.
  void add_tools_of_change(const MotionBlock& before, const MotionBlock& behind) {
    const CompensatedBlock* first = nullptr;
    const CompensatedBlock* last = nullptr;
    for (const CompensatedBlock& block : contents_.path) {
      if (block.source.index < before.source.index || block.origin == Origin::passthrough) continue;
      if (block.source.index > behind.source.index) break;
      if (block.origin == Origin::radius_change) {
        first = last = &block;
        break;
      }
      if (block.source.index != behind.source.index) continue;
      if (!first) first = &block;
      last = &block;
    }
    if (!first) return;
    picture_.tools.push_back(
        {.center = place_at(first->path, 0).point, .radius = before.mode->cutting_radius()});
    picture_.tools.push_back(
        {.center = place_at(last->path, 1).point, .radius = behind.mode->cutting_radius()});
  }

  void add_fault() {
    for (const Diagnostic& diagnostic : contents_.diagnostics) {
      if (diagnostic.severity != Severity::error) continue;
      picture_.fault =
          Fault{.place = place_of(diagnostic),
                .text = text_of("error ", diagnostic),
                .remedy = remedy_of(diagnostic),
                .tool_radius = diagnostic.point ? tool_radius_at(diagnostic.source.index) : 0};
      return;
    }
  }

  // Never travelled: the operator may put them in.
  void add_proposals() {
    for (const Diagnostic& diagnostic : contents_.diagnostics) {
      if (!diagnostic.entry_help) continue;
      const EntryHelp& help = *diagnostic.entry_help;
      if (axes_of(picture_.plane).third != help.third_axis) continue;
      for (const EntryProposal& proposal : help.proposals) add(proposal, help.leaves);
    }
    flush_joined();
  }

  void add(const EntryProposal& proposal, bool leaves) {
    const bool is_line = proposal.shape == EntryProposal::Shape::line;
    Stroke stroke{.layer = Layer::proposal,
                  .title = std::string(leaves ? "proposed exit" : "proposed entry") +
                           (is_line ? ", line" : ", quarter circle")};
    Point at = in_plane(proposal.start);
    for (const ProposedBlock& block : proposal.blocks) {
      const Point end = in_plane(block.end);
      if (block.center) {
        stroke.segments.emplace_back(
            Arc{.start = at, .end = end, .center = in_plane(*block.center), .sweep = block.sweep});
      } else {
        stroke.segments.emplace_back(Line{.start = at, .end = end});
      }
      at = end;
    }
    add(std::move(stroke));
  }

  [[nodiscard]] Point in_plane(const DiagnosticPoint& point) const {
    return to_plane(picture_.plane, Position{point.x, point.y, point.z});
  }

  [[nodiscard]] std::optional<Point> place_of(const Diagnostic& diagnostic) const {
    if (diagnostic.point) return in_plane(*diagnostic.point);
    std::optional<Point> reached;
    for (const Block& block : contents_.programmed) {
      const auto* motion = std::get_if<MotionBlock>(&block);
      if (!motion || !motion->mode || motion->mode->plane != picture_.plane) continue;
      if (motion->source.index == diagnostic.source.index) return place_at(motion->path, 0.5).point;
      if (motion->source.index > diagnostic.source.index) break;
      reached = place_at(motion->path, 1).point;
    }
    return reached;
  }

  // Of the last motion up to there under TRC; behind its end the tool is still the same.
  [[nodiscard]] double tool_radius_at(std::uint64_t index) const {
    double radius = 0;
    for (const Block& block : contents_.programmed) {
      const auto* motion = std::get_if<MotionBlock>(&block);
      if (!motion || !motion->mode) continue;
      if (motion->source.index > index) break;
      if (motion->mode->active()) radius = motion->mode->cutting_radius();
    }
    return radius;
  }

  static std::string text_of(const std::string& severity, const Diagnostic& diagnostic) {
    std::string text = severity + std::to_string(static_cast<std::int32_t>(diagnostic.code));
    if (diagnostic.source.line > 0) text += " in line " + std::to_string(diagnostic.source.line);
    if (diagnostic.source.number != Source::no_number)
      text += " (N" + std::to_string(diagnostic.source.number) + ")";
    return text + ": " + message_of(diagnostic);
  }

  static std::string remedy_of(const Diagnostic& diagnostic) {
    const Explanation* explanation = explanation_of(diagnostic.code);
    return std::string(explanation && !explanation->on_command_line.empty()
                           ? explanation->on_command_line
                           : row_of(diagnostic.code).remedy);
  }

  const Contents& contents_;
  Picture picture_;
  bool single_ = true;
  std::map<std::uint64_t, Segment> changed_{};
  std::array<Stroke, layer_count> joined_{};
};

}  // namespace

Picture compose(const Contents& contents) { return Composer(contents).compose(); }

std::vector<Picture> compose_views(const Contents& contents) {
  std::vector<Picture> views{compose(contents)};
  const Plane shown = views.front().plane;
  std::set<Plane> others;
  bool goes_across = false;
  for (const Block& block : contents.programmed)
    std::visit(overloaded{[&](const MotionBlock& motion) {
                            if (!motion.mode) return;
                            if (motion.mode->plane == shown)
                              goes_across = goes_across || motion.normal.moves();
                            else if (motion.mode->active())
                              others.insert(motion.mode->plane);
                          },
                          [&](const PassiveBlock& passive) {
                            if (passive.mode && passive.mode->plane == shown)
                              goes_across = goes_across || passive.normal.moves();
                          }},
               block);
  // There the third axis points up.
  if (others.empty() && goes_across)
    others.insert(shown == Plane::xy ? Plane::yz : shown == Plane::zx ? Plane::xy : Plane::zx);
  for (const Plane plane : others) {
    Contents seen = contents;
    seen.plane = plane;
    // What was found is told once.
    seen.diagnostics = {};
    views.push_back(compose(seen));
  }
  return views;
}

}  // namespace trc::plot
