#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "core/base/numbered_queue.h"
#include "core/geometry/box_tree.h"
#include "core/trc/loops/held_records.h"
#include "core/trc/path_block.h"

namespace trc {

// The compensated path of a selection as LoopRemoval holds it. Of each block it keeps the data that
// the walk needs, separate from what the block has in common with the one before; the path block is
// made again when it leaves. So a selection of millions of blocks fits into memory, and the data
// used most into the caches.
//
// The blocks of the path are counted from the start of the selection, and so are the
// programmed contour blocks.
class HeldPath {
 public:
  using Number = held::Number;
  using Setting = held::Setting;
  using Cuts = held::Cuts;
  using Reach = held::Reach;
  static constexpr std::size_t most_blocks = std::numeric_limits<Number>::max();

  // A contour block or one inserted between two.
  struct Block {
    Segment path{};     // of the tool
    Number number = 0;  // of the contour block, or of the one before it
    Role role = Role::contour;
    Origin origin = Origin::programmed;
    bool unreachable = false;

    [[nodiscard]] bool is_contour() const { return role == Role::contour; }
  };
  struct ContourBlock {
    Segment programmed{};
    Source source{};
    Number block = 0;  // its path
    ContourRole contour_role = ContourRole::unspecified;
  };
  // Moves the passive blocks out of the block.
  void append(PathBlock& block);
  // To be called before any of the following. They are the short way for blocks with the mode and
  // compensation of the last one, `follows_like`, and no data of their own.
  void go_on_like_last() { limit_radius_of_inserted(settings_.back().radius); }
  // `Programmed` and `Path` are each a Line or an Arc: the programmed path and that of the tool.
  template <class Programmed, class Path>
  void append_contour(const MotionBlock& block, const Programmed& programmed, const Path& path,
                      const Cuts& cuts, Reach reach);
  // After a contour block without data that the inserted block lacks.
  template <class Path>
  void append_transition(const Path& path, Reach reach);
  // With the setting given.
  template <class Path>
  void append_transition(const MotionBlock& inserted, const Path& path, Reach reach);
  // Whether the last block was compensated in the same way as this one.
  [[nodiscard]] bool follows_like(const PathBlock& block) const;

  // Numbers, from start to end.
  [[nodiscard]] std::size_t begin() const { return blocks_.begin(); }
  [[nodiscard]] std::size_t end() const { return blocks_.end(); }
  [[nodiscard]] bool empty() const { return blocks_.empty(); }
  [[nodiscard]] std::size_t size() const { return blocks_.size(); }
  [[nodiscard]] std::size_t begin_of_contour() const { return contour_.begin(); }
  // Whether the role of a contour block has been given.
  [[nodiscard]] bool has_roles() const { return has_roles_; }
  [[nodiscard]] std::size_t end_of_contour() const { return contour_.end(); }

  // Mostly one member of the result is used; the compiler then drops the others.
  [[nodiscard]] Block block(std::size_t number) const;
  [[nodiscard]] ContourBlock contour_block(std::size_t number) const;
  [[nodiscard]] Source source_of(std::size_t contour_block) const {
    return held::source_of(contour_[contour_block]);
  }
  // Calls visit with the programmed path of a contour block, a Line, or an Arc with its Cuts.
  template <class Visit>
  auto visit_programmed(std::size_t contour_block, Visit visit) const;
  [[nodiscard]] bool is_contour(std::size_t block) const {
    return blocks_[block].role == Role::contour;
  }
  [[nodiscard]] const Point& begins_at(std::size_t block) const { return blocks_[block].start; }
  [[nodiscard]] const Point& ends_at(std::size_t block) const { return blocks_[block].end; }
  // The farthest way from `place` along the blocks from `block` on and before `most`, each of which
  // has to begin where the one before ends.
  struct Way {
    std::size_t end = 0;
    Point place = Point::Zero();
  };
  [[nodiscard]] Way way_along(std::size_t block, std::size_t most, Point place) const;
  [[nodiscard]] bool is_unreachable(std::size_t block) const { return blocks_[block].unreachable; }
  [[nodiscard]] bool have_one_setting(std::size_t block, std::size_t other) const {
    return blocks_[block].setting == blocks_[other].setting;
  }
  // A box about the path of a block, or about its part between two points, not much larger.
  [[nodiscard]] Box box_about(std::size_t block) const {
    return box_about(block, begins_at(block), ends_at(block));
  }
  [[nodiscard]] Box box_about(std::size_t block, const Point& start, const Point& end) const;
  // Common data of the blocks from `first` on and before `end`.
  struct Bounds {
    Box area{};         // as box_about()
    double radius = 0;  // the largest one of the tool, mm
    bool reachable = true;
  };
  [[nodiscard]] Bounds bounds_of(std::size_t first, std::size_t end) const;
  [[nodiscard]] std::size_t number_of(std::size_t block) const { return blocks_[block].number; }
  // Whether passive blocks lie after the next block to be restored, or one before it.
  [[nodiscard]] bool has_passive(std::size_t next) const {
    return !passive_.empty() && passive_[passive_.begin()].block <= next;
  }
  // Whether only the axes of the plane move in a block.
  [[nodiscard]] bool stays_put(std::size_t block) const;
  // Whether the tool leaves the height it is at by a motion of its own, after one of the blocks
  // from `first` to the one before `end`; none of them has been restored.
  [[nodiscard]] bool changes_depth(std::size_t first, std::size_t end) const;
  [[nodiscard]] bool has_own_data(std::size_t block) const { return blocks_[block].has_own; }
  [[nodiscard]] const Setting& setting_of(std::size_t block) const {
    return settings_[blocks_[block].setting];
  }
  // The tool radius in a block, the smaller one where it changes, mm.
  [[nodiscard]] double radius_of_tool(std::size_t block) const { return setting_of(block).radius; }
  // The tool radius in a contour block, the larger one where it changes, mm.
  [[nodiscard]] double largest_radius(const ContourBlock& contour) const {
    const Setting& its = setting_of(contour.block);
    return std::max(std::abs(its.at_start.shift), std::abs(its.at_end.shift));
  }
  [[nodiscard]] const TrcMode& mode_of(std::size_t block) const { return *setting_of(block).mode; }
  // The height across the plane at the start of the block, mm.
  [[nodiscard]] double height_of(std::size_t block) const { return setting_of(block).normal.from; }

  // How many blocks from `next` on, the next one to leave, have no passive blocks; up to `most`.
  [[nodiscard]] std::size_t without_passive(std::size_t next, std::size_t most) const {
    if (passive_.empty()) return most;
    return std::min(most, std::max(passive_[passive_.begin()].block, next) - next);
  }
  // Replaces a transition arc (D-45) by lines from the end of the block before it to `start`, on to
  // `end`, and to the start of the block after it. Lines without length are left out.
  void make_linear(std::size_t transition, const Point& start, const Point& end) {
    KeptBlock& kept = blocks_[transition];
    kept.start = start;
    kept.end = end;
    kept.linear = true;
  }
  [[nodiscard]] bool is_linear(std::size_t block) const { return blocks_[block].linear; }
  struct Lines {
    std::array<Line, 3> lines{};
    std::size_t count = 0;

    [[nodiscard]] std::span<const Line> all() const { return {lines.data(), count}; }
  };
  [[nodiscard]] Lines lines_of(std::size_t transition) const;
  // For make_linear(): a contour block is lengthened to end, or to begin, at `place`, by mm of a
  // line or rad of an arc.
  void lengthen_end(std::size_t block, const Point& place, double by);
  void lengthen_start(std::size_t block, const Point& place, double by);

  // In held_path_reader.h.
  class Reader;
  [[nodiscard]] Reader read_from(std::size_t block) const;

  // The block as it was, except for the cuts of lines, with its passive blocks; each only once, in
  // ascending order. A linear transition comes without its path.
  [[nodiscard]] PathBlockPtr restored(std::size_t number);

  // Forgets contour blocks and their path.
  void forget_before(std::size_t contour_number);
  // Forgets blocks of the path, and the data of the contour that only they needed.
  void forget_path_before(std::size_t block);
  // Forgets all: a new selection begins, whose blocks are counted from 0.
  void clear();

  template <class Archive>
  void serialize(Archive& archive) {
    archive(blocks_, arcs_, contour_, circles_, settings_, passive_, own_data_, has_roles_);
  }

 private:
  using KeptBlock = held::KeptBlock;
  using KeptArc = held::KeptArc;
  using KeptContour = held::KeptContour;
  using KeptCircle = held::KeptCircle;
  using PassiveBehind = held::PassiveBehind;
  using OwnData = held::OwnData;

  // The first circle of the contour block of `block`, or of a later one.
  [[nodiscard]] std::size_t first_circle_of(std::size_t block) const {
    return contour_.empty() ? 0 : contour_[number_of(block)].circle;
  }
  // The number of the setting of the block: that of the last block if it is equal.
  [[nodiscard]] Number note_setting(const PathBlock& block);
  [[nodiscard]] Number note_setting_like_last(const MotionBlock& motion);
  [[nodiscard]] Number note_changed_setting(const MotionBlock& motion);
  [[nodiscard]] Number last_setting() const { return static_cast<Number>(settings_.end() - 1); }
  void limit_radius_of_inserted(double radius);
  template <class Programmed>
  void keep_contour(const MotionBlock& block, const Programmed& programmed, const Cuts& cuts);
  template <class Path>
  KeptBlock& keep_path(const Path& path, Number setting, Role role, Origin origin, Reach reach);
  // As box_about(), for an arc between the corners of `ends`.
  static Box about_arc(const Box& ends, const KeptBlock& kept, const KeptArc& arc);
  [[nodiscard]] bool needs_own_data(const PathBlock& inserted) const;
  void restore_own_data(std::size_t number, PathBlock& block);

  NumberedQueue<KeptBlock> blocks_;
  NumberedQueue<KeptArc> arcs_;  // of blocks_
  NumberedQueue<KeptContour> contour_;
  NumberedQueue<KeptCircle> circles_;  // of contour_
  NumberedQueue<Setting, 16> settings_;
  NumberedQueue<PassiveBehind, 16> passive_;
  NumberedQueue<OwnData, 64> own_data_;
  bool has_roles_ = false;
};

inline HeldPath::Way HeldPath::way_along(std::size_t block, std::size_t most, Point place) const {
  auto blocks = blocks_.from(block);
  for (; block < most; ++block) {
    const KeptBlock& kept = blocks.next();
    if (place != kept.start) break;
    place = kept.end;
  }
  return {block, place};
}

[[gnu::always_inline]] inline HeldPath::Block HeldPath::block(std::size_t number) const {
  const KeptBlock& kept = blocks_[number];
  return {.path = kept.is_arc ? Segment(arc_of(kept, arcs_[kept.arc])) : line_of(kept),
          .number = kept.number,
          .role = kept.role,
          .origin = kept.origin,
          .unreachable = kept.unreachable};
}

[[gnu::always_inline]] inline HeldPath::ContourBlock HeldPath::contour_block(
    std::size_t number) const {
  const KeptContour& kept = contour_[number];
  return {
      .programmed = kept.is_arc ? Segment(arc_of(kept, circles_[kept.circle].arc)) : line_of(kept),
      .source = source_of(number),
      .block = kept.block,
      .contour_role = kept.contour_role};
}

inline Box HeldPath::box_about(std::size_t block, const Point& start, const Point& end) const {
  const KeptBlock& kept = blocks_[block];
  const Box box = bounding_box(start, end);
  return kept.is_arc ? about_arc(box, kept, arcs_[kept.arc]) : box;
}

inline Box HeldPath::about_arc(const Box& ends, const KeptBlock& kept, const KeptArc& arc) {
  const double sweep = std::abs(arc.sweep);
  if (sweep > std::numbers::pi) return bounding_box(arc_of(kept, arc));
  // An arc rises over its chord by half of that times tan(sweep / 4), which up to there is less
  // than 0.319 of the sweep.
  const double rise = 0.16 * sweep * ends.sizes().sum();
  return {ends.min() - Vector(rise, rise), ends.max() + Vector(rise, rise)};
}

inline HeldPath::Bounds HeldPath::bounds_of(std::size_t first, std::size_t end) const {
  const KeptBlock& first_kept = blocks_[first];
  Number setting = first_kept.setting;
  Box area;
  double radius = settings_[setting].radius;
  unsigned unreachable = 0;
  auto blocks = blocks_.from(first);
  auto arcs = arcs_.from(first_kept.arc);
  for (std::size_t left = end - first; left > 0; --left) {
    const KeptBlock& kept = blocks.next();
    unreachable |= kept.unreachable;
    if (kept.is_arc) {
      area.extend(about_arc(bounding_box(kept.start, kept.end), kept, arcs.next()));
    } else {
      area.extend(kept.start).extend(kept.end);
    }
    if (kept.setting == setting) continue;
    setting = kept.setting;
    radius = std::max(radius, settings_[setting].radius);
  }
  return {area, radius, unreachable == 0};
}

template <class Visit>
[[gnu::always_inline]] inline auto HeldPath::visit_programmed(std::size_t contour_block,
                                                              Visit visit) const {
  const KeptContour& kept = contour_[contour_block];
  if (!kept.is_arc) return visit(line_of(kept));
  const KeptCircle& circle = circles_[kept.circle];
  return visit(arc_of(kept, circle.arc), circle.cuts);
}

}  // namespace trc
