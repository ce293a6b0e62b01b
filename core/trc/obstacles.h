#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/base/tolerances.h"
#include "core/geometry/along.h"
#include "core/geometry/box_tree.h"
#include "core/trc/certificate.h"
#include "core/trc/held_path.h"
#include "core/trc/path_block.h"

namespace trc {

// Which contour blocks a block of the path comes too near to, and where: the contour of a
// selection as LoopRemoval sees it. With a window of N contour blocks a block of the path sees N
// of them ahead and back.
class Obstacles {
 public:
  // How near is too near: to find a loop, or to be a violation (D-36).
  enum class Nearness { exact, passable };
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

  // The contour block that has been appended to the path; `apart`: its equidistant does not meet
  // that of the block before.
  void append(const PathBlock& block, const Box& area, bool apart);
  // Forgets contour blocks.
  void drop_before(std::size_t number);
  // Forgets all: a new selection begins.
  void clear();

  // The part of the radius, or of 1 mm, that is let pass.
  [[nodiscard]] double part_of(Nearness nearness) const {
    return nearness == Nearness::exact ? tolerances_.rounding : tolerances_.passable;
  }
  // How near is too near for the block, mm.
  [[nodiscard]] double reach(std::size_t block, Nearness nearness) const {
    const double radius = path_.radius_of_tool(block);
    return radius - part_of(nearness) * std::max(radius, 1.0);
  }
  // The first contour block of the certified chain that ends with this one.
  [[nodiscard]] std::size_t chain_before(std::size_t number) const {
    return certificate_.chain_before(number);
  }

  // The first place not before `from` and before `to`.
  [[nodiscard]] std::optional<Onset> onset(std::size_t block, double from, double to,
                                           Nearness nearness) const;
  // Whether there is one.
  [[nodiscard]] bool comes_nearer(std::size_t block, double from, double to,
                                  Nearness nearness) const;
  // The numbers of all contour blocks that are as near there as the one of the
  // onset: the other block of a corner, blocks on top of each other.
  [[nodiscard]] std::vector<std::size_t> at(std::size_t block, const Onset& onset,
                                            Nearness nearness) const;

  // Once the contour has ended: whether nothing at all can be in the way of the block. To be asked
  // for before the questions above, which are cheaper then.
  [[nodiscard]] bool is_clear(std::size_t block);

  // Behind the path.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(certificate_);
    if constexpr (Archive::is_loading::value) rebuild_boxes();
  }

 private:
  [[nodiscard]] const HeldPath::Block& path(std::size_t block) const {
    return path_.blocks()[block];
  }
  [[nodiscard]] const Segment& programmed(std::size_t number) const {
    return path_.contour()[number].programmed;
  }
  [[nodiscard]] std::size_t end_of_contour() const { return path_.contour().end(); }

  void rebuild_boxes();
  void survey(std::size_t first);
  // Those the certificate takes out of the question.
  [[nodiscard]] BoxTree::Range certified(std::size_t block) const;
  // All contour blocks it may come nearer to than `limit`: neighbours_.
  void find_neighbours(std::size_t block, double limit) const;
  [[nodiscard]] bool are_many() const { return neighbours_.size() > 4; }
  // Drops those of them that are not within the limit anywhere on it. Returns the nearest one to
  // its middle, where it is nearer than the limit.
  std::optional<std::size_t> drop_those_off(const PathPart& part, double limit) const;

  const HeldPath& path_;
  std::size_t window_;
  Tolerances tolerances_;
  Checkpoint& checkpoint_;

  BoxTree boxes_;
  Certificate certificate_;
  // A stretch of the path, and all contour blocks that may be near one of its blocks.
  std::size_t first_surveyed_ = 0;
  std::size_t end_of_survey_ = 0;
  NumberedBoxes near_;
  mutable std::vector<std::size_t> neighbours_;  // a member for its memory's sake
};

}  // namespace trc
