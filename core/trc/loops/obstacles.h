#pragma once

#include <algorithm>
#include <cstddef>
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

// Which contour blocks a block of the path comes too near to, and where: the contour of a
// selection as LoopRemoval sees it. With a window of N contour blocks a block of the path sees N
// of them ahead and back.
class Obstacles {
 public:
  // How near is too near: to find a loop, or to be a violation (D-36). Less than slight is a gouge
  // that is none (D-14).
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
  [[nodiscard]] const Walls& walls() const { return walls_; }
  // Which of them are walls, and for whose path; all for all until it is said (D-38).
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
  // Of a block the contour ends with: the one at its begin that it goes over once more.
  [[nodiscard]] std::optional<std::size_t> first_visit_of(std::size_t number) const {
    const bool goes_over = walls_.blocks_of_round > 0 && number >= walls_.blocks_of_round &&
                           number - walls_.blocks_of_round < walls_.head.end;
    return goes_over ? std::optional(number - walls_.blocks_of_round) : std::nullopt;
  }
  // What of a contour block is a wall.
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

  // Whether the certificate takes the contour block out of the question for the block.
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
  // Whether another way than its path does, which takes part in all that is certified for it.
  [[nodiscard]] bool comes_nearer(std::size_t block, const Segment& way, Nearness nearness) const;
  // The numbers of all contour blocks that are as near to a place on the block as this one, where
  // it comes too near to it: the other block of a corner, blocks on top of each other.
  [[nodiscard]] const std::vector<std::size_t>& at(std::size_t block, const Point& place,
                                                   std::size_t obstacle, Nearness nearness) const;

  // Once the contour has ended: up to which block nothing at all can be in the way, from this one
  // on. To be asked for before the questions above, which are cheaper then.
  [[nodiscard]] std::size_t clear_until(std::size_t block) {
    const bool in_group = block >= group_query_.first && block < group_query_.end;
    if (!in_group && !is_in_group(block)) query_group(block);
    ++asked_for_;
    if (group_query_.near.empty()) return group_query_.end;
    // Where the walk leaves blocks out, what is left is not worth it.
    if (block == few_.end && block < group_query_.end) look_closer();
    return block >= few_.first && block < few_.end && few_.near.empty() ? few_.end : block;
  }

  // Behind the path.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(certificate_, walls_, all_are_walls_);
    if constexpr (Archive::is_loading::value) rebuild_boxes();
  }

 private:
  // To numbers_, where the path of the block is before them.
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
  // Leaves those that are walls for the path of the contour block `own`.
  void keep_walls(NearFour& four, std::size_t own) const;
  [[nodiscard]] std::size_t end_of_contour() const { return path_.end_of_contour(); }

  // Whether a part of another way of the contour block does.
  [[nodiscard]] bool own_arc_is_nearer(std::size_t number, const PathPart& part,
                                       double limit) const;

  using Fours = std::vector<NearFour>;

  void rebuild_boxes();
  void query_group(std::size_t first);
  // query_group() for the next few blocks of it.
  void look_closer();
  // Whether what the group query found is all that may be near the block.
  [[nodiscard]] bool is_in_group(std::size_t block) const;
  // Those the certificate takes out of the question.
  [[nodiscard]] BoxTree::Range certified(std::size_t block) const;
  // For all blocks of the path before `end`, which are reachable; those it may leave in question.
  [[nodiscard]] BoxTree::Range certified_for_all(std::size_t first, std::size_t end) const;
  // All contour blocks it may come nearer to than `limit`: neighbours_. With some that are a
  // little farther off. `in_group`: what the group query found is all of them.
  void find_neighbours(std::size_t block, const Box& area, double limit, bool in_group) const;
  [[nodiscard]] bool neighbours_come_nearer(std::size_t block, const PathPart& part,
                                            double limit) const;
  // Whether they are more than is worth asking for the nearest one.
  [[nodiscard]] bool are_many(const Box& area, double limit) const;
  // Whether those still are that are not out of question for a part of the block. Behind
  // nearest_to().
  [[nodiscard]] bool are_many(const Box& area, const PathPart& part, double limit) const;
  // The one nearest to the middle of the part, where it is nearer than the limit.
  [[nodiscard]] std::optional<std::size_t> nearest_to(const PathPart& part, double limit) const;

  const HeldPath& path_;
  std::size_t window_;
  Tolerances tolerances_;
  Checkpoint& checkpoint_;

  BoxTree boxes_;
  Certificate certificate_;
  Walls walls_{};
  bool all_are_walls_ = true;
  // A stretch of the path, and all contour blocks that may be near one of its blocks. Whatever lies
  // in the same area and has no larger radius has no others.
  struct GroupQuery {
    std::size_t first = 0;
    std::size_t end = 0;
    Box area{};
    double radius = 0;
    BoxTree::Range skipped{};  // certified for all of them
    Fours near{};              // without these
  };
  GroupQuery group_query_;
  // A few blocks of that, and all of `near` there that is in question for one of them.
  struct Few {
    std::size_t first = 0;
    std::size_t end = 0;
    Fours near{};
  };
  Few few_;
  std::size_t group_ = 8;      // how many blocks are queried together
  std::size_t asked_for_ = 0;  // how often that was of use
  // Members for their memory's sake.
  mutable Fours neighbours_;
  mutable std::vector<FourBoxes::Squares> squares_;  // of the distances of the neighbours
  mutable std::vector<std::size_t> numbers_;
};

}  // namespace trc
