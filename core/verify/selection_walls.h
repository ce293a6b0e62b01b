#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/base/tolerances.h"
#include "core/trc/walls/sided_walls.h"
#include "core/verify/clearance.h"
#include "core/verify/coverage.h"
#include "core/verify/measured_path.h"
#include "core/verify/wall_tree.h"

namespace trc::verify {

// What of the programmed pieces of one selection is a wall, and the tree over that.
class SelectionWalls {
 public:
  // The pieces are those from `begin` to `end`. `held` must outlive it, or what it moves to.
  SelectionWalls(const MeasuredPath& held, std::size_t begin, std::size_t end,
                 const ClearanceSettings& settings, Checkpoint& checkpoint);
  SelectionWalls(const SelectionWalls&) = delete;
  SelectionWalls& operator=(const SelectionWalls&) = delete;

  [[nodiscard]] const SidedWalls& sides() const { return sides_; }
  [[nodiscard]] const WallTree& tree() const { return *tree_; }
  // All of the contour is a wall for all of the path.
  [[nodiscard]] bool are_plain() const { return are_plain_; }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double length() const { return length_; }  // mm, of all of them

  // What of a contour block is a wall; nothing where none of it is.
  [[nodiscard]] Stretch wall_of(const ProgrammedPiece& block) const {
    return tree_->is_whole(block.number) ? Stretch{0, block.piece.length()} : part_of(block);
  }

  // Goes over to the pieces of another path, from `begin` on, whose tool radius may be another one.
  // The contour has to be the same, and by_radius().
  void move_to(const MeasuredPath& held, std::size_t begin, Checkpoint& checkpoint);
  [[nodiscard]] WallsByRadius by_radius(const LeadSettings& settings,
                                        Checkpoint& checkpoint) const {
    return walls_by_radius(contour(checkpoint), changes_, settings, largest_radius());
  }

 private:
  // Of a contour block that is not a wall from end to end.
  [[nodiscard]] Stretch part_of(const ProgrammedPiece& block) const;
  // With the length of all of it.
  void find_contour(Checkpoint& checkpoint);
  // What of it are walls.
  void count_walls(Checkpoint& checkpoint);
  [[nodiscard]] ContourView contour(Checkpoint& checkpoint) const;
  [[nodiscard]] double largest_radius() const;
  [[nodiscard]] const ProgrammedPiece& piece(std::size_t number) const {
    return held_->programmed()[begin_ + contour_[number]];
  }

  const MeasuredPath* held_;
  std::size_t begin_;
  std::size_t end_;
  Tolerances tolerances_;
  std::vector<std::uint32_t> contour_;  // which pieces are contour blocks, counted from `begin_`
  std::vector<std::size_t> changes_;    // of side, among these
  bool has_roles_ = false;
  SidedWalls sides_;
  bool are_plain_ = false;
  double contour_length_ = 0;                                       // mm
  double shortest_step_ = std::numeric_limits<double>::infinity();  // as ContourView has it, mm
  std::size_t count_ = 0;
  double length_ = 0;
  std::optional<WallTree> tree_;
};

// The walls of selections, kept for further paths beside the same contours, as those of tools of
// other radii: finding them and making the tree is a good part of what measuring takes. Whether the
// contour is the same is looked at each time.
class KnownWalls {
 public:
  // Those of these pieces, known or new. Of use until it is asked for that selection again.
  [[nodiscard]] const SelectionWalls& of(const MeasuredPath& held, std::size_t begin,
                                         std::size_t end, const ClearanceSettings& settings,
                                         Checkpoint& checkpoint);

 private:
  // What a piece is to the walls.
  struct WallPiece {
    Piece piece{};
    std::uint32_t rule = 0;
    std::uint32_t number = 0;
    bool is_contour = false;
    Side side = Side::off;
    ContourRole role = ContourRole::unspecified;
  };
  struct Known {
    std::vector<WallPiece> pieces{};
    WallsByRadius by_radius{};
    std::unique_ptr<SelectionWalls> walls{};
  };

  // The pieces of the same number from `begin` on are to the walls what these are.
  [[nodiscard]] static bool are_same(const std::vector<WallPiece>& pieces, const MeasuredPath& held,
                                     std::size_t begin, Checkpoint& checkpoint);

  std::map<std::uint64_t, Known> known_;  // by Source::index of the first piece
};

}  // namespace trc::verify
