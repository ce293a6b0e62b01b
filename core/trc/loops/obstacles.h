#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/base/tolerances.h"
#include "core/geometry/along.h"
#include "core/geometry/box_tree.h"
#include "core/trc/loops/certificate.h"
#include "core/trc/loops/held_path.h"
#include "core/trc/path_block.h"
#include "core/trc/walls/walls.h"

namespace trc {

// Finds the contour blocks that a block of the path comes too near to, and where: the contour of a
// selection as LoopRemoval sees it. With a window of N contour blocks a block of the path sees N of
// them ahead and back.
class Obstacles {
 public:
  // How near is too near: to find a loop, or for a violation (D-36). A gouge smaller than slight is
  // none (D-14).
  enum class Nearness { exact, passable, slight };
  // Where a block of the path comes too near to a contour block.
  struct Onset {
    double along = 0;          // mm from the start of the block
    std::size_t obstacle = 0;  // its number
  };

  // `window` in contour blocks; 0: all of them.
  Obstacles(const HeldPath& path, std::size_t window, const Tolerances& tolerances,
            Checkpoint& checkpoint)
      : path_(path),
        window_(window),
        tolerances_(tolerances),
        checkpoint_(checkpoint),
        certificate_(tolerances) {}

  // The contour block that has been appended to the path.
  void append(const Certificate::Block& course, Certificate::Begin begin, const Box& area);
  // About the contour blocks.
  [[nodiscard]] const BoxTree& boxes() const { return boxes_; }
  [[nodiscard]] const Walls& walls() const { return walls_; }
  // Sets which of them are walls, and for whose path (D-38). Without it all are, for all.
  void set_walls(Walls walls) {
    walls_ = std::move(walls);
    all_are_walls_ = walls_.are_plain();
  }
  // Whether nothing of a contour block is a wall.
  [[nodiscard]] bool is_lead(std::size_t number) const {
    return !all_are_walls_ && walls_.is_lead(number);
  }
  // The first of the leads the contour ends with; the end of the contour where there are none.
  [[nodiscard]] std::size_t begin_of_lead_out() const {
    const bool has_some = !walls_.leads.empty() && walls_.leads.back().end == end_of_contour();
    return has_some ? walls_.leads.back().first : end_of_contour();
  }
  // For a block at the end of the contour: the block at its start that it goes over again.
  [[nodiscard]] std::optional<std::size_t> first_visit_of(std::size_t number) const {
    const bool goes_over = walls_.blocks_per_lap > 0 && number >= walls_.blocks_per_lap &&
                           number - walls_.blocks_per_lap < walls_.head.end;
    return goes_over ? std::optional(number - walls_.blocks_per_lap) : std::nullopt;
  }
  // The part of a contour block that is a wall.
  [[nodiscard]] Segment wall(std::size_t number) const;
  // mm
  [[nodiscard]] double wall_length(std::size_t number) const;

  // Forgets contour blocks.
  void drop_before(std::size_t number);
  // Forgets all: a new selection begins.
  void clear();

  // How near is too near for the block, mm.
  [[nodiscard]] double reach(std::size_t block, Nearness nearness) const {
    const double radius = path_.radius_of_tool(block);
    return radius - let_pass(radius, nearness);
  }
  // reach() for one contour block: `limit` is how near is too near for walls.
  [[nodiscard]] double reach_to(std::size_t number, std::size_t block, double limit) const {
    if (all_are_walls_) return limit;
    return limit - walls_.touch_between(number, path_.number_of(block));
  }
  // The first contour block of the certified chain that ends with this one.
  [[nodiscard]] std::size_t chain_before(std::size_t number) const {
    return certificate_.chain_before(number);
  }

  // Whether the certificate rules the contour block out as an obstacle for the block.
  [[nodiscard]] bool certifies(std::size_t block, std::size_t number) const {
    const BoxTree::Range range = certified(block);
    return number >= range.first && number <= range.last;
  }

  // The first place not before `from` and before `to`.
  [[nodiscard]] std::optional<Onset> onset(std::size_t block, double from, double to,
                                           Nearness nearness) const;
  // Whether there is one.
  [[nodiscard]] bool comes_nearer(std::size_t block, double from, double to,
                                  Nearness nearness) const;
  // Whether `way`, in place of the path of the block and certified like it, comes too near.
  [[nodiscard]] bool comes_nearer(std::size_t block, const Segment& way, Nearness nearness) const;
  // The numbers of all contour blocks that are as near to a place on the block as this one, where
  // it comes too near to it: the other block of a corner, blocks on top of each other.
  [[nodiscard]] const std::vector<std::size_t>& at(std::size_t block, const Point& place,
                                                   std::size_t obstacle, Nearness nearness) const;

  // Once the contour has ended: the block up to which, from this one on, nothing can be in the way.
  // Ask for it before the questions above, which are cheaper then.
  [[nodiscard]] std::size_t clear_until(std::size_t block) {
    const bool in_group = block >= group_query_.first && block < group_query_.end;
    if (!in_group && !is_in_group(block)) query_group(block);
    ++asked_for_;
    if (group_query_.near.empty()) return group_query_.end;
    // Not where the walk leaves blocks out: too few are left for a closer look.
    if (block == few_.end && block < group_query_.end) look_closer();
    return block >= few_.first && block < few_.end && few_.near.empty() ? few_.end : block;
  }

  // To be called after the path has been loaded: the boxes are made anew from it.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(certificate_, walls_, all_are_walls_);
    if constexpr (Archive::is_loading::value) rebuild_boxes();
  }

 private:
  // Puts first visits at the front of numbers_, where the path of the block comes before them.
  void put_first_visits_in_front(std::size_t block, const Point& place, double limit) const;
  // mm.
  [[nodiscard]] double let_pass(double radius, Nearness nearness) const {
    const double size = std::max(radius, 1.0);
    if (nearness == Nearness::exact) return tolerances_.rounding * size;
    const double passable = tolerances_.passable * size;
    if (nearness == Nearness::passable) return passable;
    return std::max(passable, std::min(tolerances_.on_contour, 0.01 * radius));
  }
  [[nodiscard, gnu::always_inline]] HeldPath::Block path(std::size_t block) const {
    return path_.block(block);
  }
  [[nodiscard, gnu::always_inline]] Segment programmed(std::size_t number) const {
    return all_are_walls_ ? path_.contour_block(number).programmed : wall(number);
  }
  // Keeps only those that are walls for the path of the contour block `own`.
  void keep_walls(NearFour& four, std::size_t own) const;
  [[nodiscard]] std::size_t end_of_contour() const { return path_.end_of_contour(); }

  // Whether a part of another way of the contour block comes too near.
  [[nodiscard]] bool own_arc_is_nearer(std::size_t number, const PathPart& part,
                                       double limit) const;

  using Fours = std::vector<NearFour>;

  void rebuild_boxes();
  void query_group(std::size_t first);
  // query_group() for the next few blocks of it.
  void look_closer();
  // Whether the group query has found everything that may be near the block.
  [[nodiscard]] bool is_in_group(std::size_t block) const;
  // The contour blocks that the certificate rules out.
  [[nodiscard]] BoxTree::Range certified(std::size_t block) const;
  // As certified(), for all blocks before `end`, which are reachable; may rule out fewer.
  [[nodiscard]] BoxTree::Range certified_for_all(std::size_t first, std::size_t end) const;
  // Puts into neighbours_ all contour blocks that may come nearer than `limit`, and some a little
  // farther off. The group is enough where is_in_group().
  enum class Among : std::uint8_t { group, all };
  void find_neighbours(std::size_t block, const Box& area, double limit, Among among) const;
  [[nodiscard]] Among near_blocks(std::size_t block) const {
    return is_in_group(block) ? Among::group : Among::all;
  }
  [[nodiscard]] bool neighbours_come_nearer(std::size_t block, const PathPart& part,
                                            double limit) const;
  // Whether they are too many to look for the nearest one directly.
  [[nodiscard]] bool are_many(const Box& area, double limit) const;
  // Whether those that remain for a part of the block still are. To be called after
  // nearest_to().
  [[nodiscard]] bool are_many(const Box& area, const PathPart& part, double limit) const;
  // The neighbour nearest to the middle of the part, if it is nearer than the limit.
  [[nodiscard]] std::optional<std::size_t> nearest_to(const PathPart& part, double limit) const;

  const HeldPath& path_;
  std::size_t window_;
  Tolerances tolerances_;
  Checkpoint& checkpoint_;

  BoxTree boxes_;
  Certificate certificate_;
  Walls walls_{};
  bool all_are_walls_ = true;
  // A stretch of the path, and all contour blocks that may be near one of its blocks. Any block in
  // the same area with no larger radius has no others near it.
  struct GroupQuery {
    std::size_t first = 0;
    std::size_t end = 0;
    Box area{};
    double radius = 0;
    BoxTree::Range skipped{};  // certified for all of them
    Fours near{};              // without these
  };
  GroupQuery group_query_;
  // A few blocks of the stretch, and all of `near` that may concern one of them.
  struct Few {
    std::size_t first = 0;
    std::size_t end = 0;
    Fours near{};
  };
  Few few_;
  std::size_t group_ = 8;      // how many blocks are queried together
  std::size_t asked_for_ = 0;  // how often a group query was of use
  // Members, so that their memory is used again.
  mutable Fours neighbours_;
  mutable std::vector<FourBoxes::Squares> squares_;  // of the distances of the neighbours
  mutable std::vector<std::size_t> numbers_;
};

}  // namespace trc
