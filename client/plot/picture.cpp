#include "client/plot/picture.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "client/plot/changed_contour.h"
#include "client/plot/findings.h"
#include "client/plot/lead_blocks.h"
#include "client/plot/words.h"
#include "core/geometry/along.h"
#include "core/session/not_travelled.h"
#include "core/session/projection.h"
#include "core/session/unknown_starts.h"
#include "core/trc/result/listing.h"

namespace trc::plot {
namespace {

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

class Composer {
 public:
  explicit Composer(const Contents& contents)
      : contents_(contents), words_(words_in(contents.language)) {
    picture_.title = contents.title;
    picture_.plane = plane_to_show(contents);
    picture_.language = contents.language;
    picture_.inch = contents.inch;
    single_ = contents.programmed.size() + contents.path.size() <= most_single_strokes;
  }

  Picture compose() {
    add_programmed();
    add_path();
    if (picture_.strokes.empty()) {
      draws_first_ = true;
      add_programmed();
      add_path();
    }
    add_tools();
    add_radius_changes();
    add_findings(contents_, picture_);
    std::stable_sort(picture_.strokes.begin(), picture_.strokes.end(),
                     [](const Stroke& a, const Stroke& b) { return a.layer < b.layer; });
    return std::move(picture_);
  }

 private:
  void add(Stroke stroke) {
    std::erase_if(stroke.segments, [](const Segment& segment) { return !is_finite(segment); });
    if (stroke.segments.empty()) return;
    stroke.ends.push_back(place_at(stroke.segments.back(), 1).point);
    if (!single_) {
      stroke.title.clear();
      Stroke& before = last_of(stroke.layer);
      if (!before.segments.empty() && before.rapid == stroke.rapid) {
        before.segments.insert(before.segments.end(), stroke.segments.begin(),
                               stroke.segments.end());
        before.ends.push_back(stroke.ends.back());
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
    UnknownStarts first(contents_.start);
    for (const Block& block : contents_.programmed)
      std::visit(overloaded{[&](const MotionBlock& motion) {
                              if (!motion.mode) return;
                              const bool from_unknown = first.begins_at_unknown_place(
                                  motion.mode->plane, motion.path, motion.normal, motion.rapid);
                              const bool lost = masked.contains(motion.source.index);
                              if (!from_unknown || draws_first_) show(motion, lost, leads);
                              const PlaneAxes axes = axes_of(motion.mode->plane);
                              const Place end = place_at(motion.path, 1);
                              position[axes.first] = end.point.x();
                              position[axes.second] = end.point.y();
                              position[axes.third] = motion.normal.to;
                            },
                            [&](const PassiveBlock& passive) {
                              if (!passive.moves || !passive.mode) return;
                              const PlaneAxes axes = axes_of(passive.mode->plane);
                              const Point here = to_plane(passive.mode->plane, position);
                              const bool from_unknown = first.begins_at_unknown_place(
                                  passive.mode->plane, Line{.start = here, .end = here},
                                  passive.normal, passive.rapid);
                              if (!from_unknown || draws_first_) show(passive, here);
                              position[axes.third] = passive.normal.to;
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
           .title = number_of(motion.source, words_) + words_.as_programmed});
      add({.layer = Layer::programmed,
           .segments = project(plane, changed->second, motion.normal, picture_.plane),
           .title = number_of(motion.source, words_) + words_.changed});
      return;
    }
    // A block that contains the closing point is a wall on one side of it and a lead on the other.
    const bool parted = wall && wall->to > wall->from && !lost && is_finite(motion.path);
    if (parted) {
      const double length = length_of(motion.path);
      show_part(motion, 0, wall->from, Layer::lead);
      show_part(motion, wall->from, wall->to, Layer::programmed);
      show_part(motion, wall->to, length, Layer::lead);
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
    // The number lies on the side away from the tool.
    picture_.numbers.push_back({.at = middle.point,
                                .aside = motion.mode->side == Side::left ? Vector(-left) : left,
                                .text = number_of(motion.source, words_)});
  }

  void show_part(const MotionBlock& motion, double from, double to, Layer layer) {
    if (!(to > from)) return;
    const Segment part = stretch_of(motion.path, from, to, point_along(motion.path, from),
                                    point_along(motion.path, to));
    show(motion, part, layer);
  }

  void show(const MotionBlock& motion, const Segment& part, Layer layer) {
    const bool lost = layer == Layer::masked;
    add({.layer = layer,
         .rapid = motion.rapid,
         .segments = project(motion.mode->plane, part, motion.normal, picture_.plane),
         .title = number_of(motion.source, words_) +
                  (layer == Layer::lead ? words_.lead : words_.contour) +
                  (lost ? words_.not_travelled : "")});
  }

  void show(const PassiveBlock& passive, const Point& here) {
    const Plane plane = passive.mode->plane;
    add({.layer = Layer::beside,
         .rapid = passive.rapid,
         .segments =
             project(plane, Line{.start = here, .end = here}, passive.normal, picture_.plane),
         .title = number_of(passive.source, words_) + words_.contour});
  }

  void add_path() {
    UnknownStarts first(contents_.start);
    for (std::size_t at = 0; at < contents_.path.size(); ++at) {
      const CompensatedBlock& block = contents_.path[at];
      if (block.origin == Origin::passthrough) continue;
      const bool from_unknown =
          first.begins_at_unknown_place(block.plane, block.path, block.normal, block.rapid);
      if (from_unknown && !draws_first_) continue;
      add({.layer = is_inserted(at) ? Layer::transition : layer_of(block.origin),
           .rapid = block.rapid,
           .segments = project(block.plane, block.path, block.normal, picture_.plane),
           .title = number_of(block.source, words_) + " " +
                    words_.origins[static_cast<std::size_t>(block.origin)]});
    }
    flush_joined();
  }

  // A block that TRC inserts between the approach block and the contour, or between the contour and
  // the retract block. The own block is the first of an approach and the last of a retract.
  [[nodiscard]] bool is_inserted(std::size_t at) const {
    const CompensatedBlock& block = contents_.path[at];
    const bool approach = block.origin == Origin::approach;
    if (!approach && block.origin != Origin::retract) return false;
    const std::size_t own = approach ? at - 1 : at + 1;
    if (own >= contents_.path.size()) return false;
    const CompensatedBlock& other = contents_.path[own];
    if (other.origin != block.origin || (approach && other.source.index != block.source.index))
      return false;
    // Parts of one line, as SPLIT makes them, belong to the own block.
    const Vector way = place_at(block.path, 0.5).direction;
    return is_arc(block.path) || is_arc(other.path) ||
           (way - place_at(other.path, 0.5).direction).norm() > 1e-6;
  }

  // The tool at the start of the first approach, and where it first touches the contour.
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

  // At each change of radius: the tool before it and the tool after it.
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

  // On a block inserted for the change; otherwise on the first block with the new radius.
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

  const Contents& contents_;
  const Words& words_;
  Picture picture_;
  bool single_ = true;
  bool draws_first_ = false;  // UnknownStarts: true if there is nothing else to draw
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
  // In this plane the third axis points up.
  if (others.empty() && goes_across)
    others.insert(shown == Plane::xy ? Plane::yz : shown == Plane::zx ? Plane::xy : Plane::zx);
  for (const Plane plane : others) {
    Contents seen = contents;
    seen.plane = plane;
    // Diagnostics are only shown in the first view.
    seen.diagnostics = {};
    views.push_back(compose(seen));
  }
  return views;
}

}  // namespace trc::plot
