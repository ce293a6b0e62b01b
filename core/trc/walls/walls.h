#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace trc {

// The parts of the contour of one selection that bound material, and for which path (D-38). Plain
// data: loop removal, the search for bottlenecks and the verification use it in the same way.
//
// Contour blocks are counted from the first one of the selection, approach and retract not among
// them. Nothing set: all of the contour is a wall for all of the path.
struct Walls {
  // Blocks from `first` on and before `end`.
  struct Range {
    std::size_t first = 0;
    std::size_t end = 0;

    [[nodiscard]] bool holds(std::size_t number) const { return number >= first && number < end; }
    bool operator==(const Range&) const = default;
  };
  // A block that is a wall only from one place to another, mm from its start.
  struct Part {
    std::size_t number = 0;
    double from = 0;
    double to = std::numeric_limits<double>::infinity();

    bool operator==(const Part&) const = default;
  };

  // Blocks without any wall; in order, no block in two of them.
  std::vector<Range> leads{};
  // Blocks that are not walls from end to end; in order.
  std::vector<Part> parts{};
  // Where the contour goes over the same way again: the first block of each ring except the first
  // one, in order. A block divided by the visit belongs to the later ring.
  std::vector<std::size_t> rings{};
  // The blocks at the start and at the end of the contour, where it closes. The path of either may
  // come nearer by `touch`, mm, to the walls of the other; where there are rings, that of `tail`
  // also to the walls of `tail` and of the start of the last ring. The end of the contour lies on
  // its start only as exactly as it was programmed.
  Range head{};
  Range tail{};
  double touch = 0;
  // How much nearer, mm, the path of a ring may come to the walls of later rings, which lie on top
  // of it, and the end of each ring to its start.
  double touch_of_rings = 0;
  // Blocks at the start of the contour, after its first two, that the lead-out passes beside.
  std::size_t start_blocks_passed = 0;
  // Blocks that the overrun repeats, the one in which it ends not counted; 0 also without overrun.
  std::size_t overrun_blocks = 0;
  // Blocks from one at the start of the contour to the block of the overrun that repeats it; 0: no
  // overrun.
  std::size_t blocks_per_lap = 0;

  // Where whole turns lead in or out, the blocks of that lead: each turn may touch the walls where
  // the contour closes, within the accuracy of programmed circles (D-106).
  Range turns_in{};
  Range turns_out{};
  double touch_of_turns = 0;

  [[nodiscard]] bool are_all() const { return leads.empty() && parts.empty() && rings.empty(); }
  // Whether nothing is set.
  [[nodiscard]] bool are_plain() const { return are_all() && touch == 0; }
  // Whether nothing of the block is a wall.
  [[nodiscard]] bool is_lead(std::size_t number) const;
  // Nothing: the block is a wall from end to end, or a lead.
  [[nodiscard]] std::optional<Part> part_of(std::size_t number) const;
  // The ring of a block, counted from 0.
  [[nodiscard]] std::size_t ring_of(std::size_t number) const;
  // Whether the path of the block `path` must keep clear of the walls of the block `number`: those
  // of an earlier ring have been cut away by then. Each block is a wall for its own path, which may
  // not exist.
  [[nodiscard]] bool is_wall_for(std::size_t number, std::size_t path) const {
    return number == path ||
           (!is_lead(number) && (rings.empty() || ring_of(number) >= ring_of(path)));
  }
  // Whether a whole lap lies between two blocks: from the start of the contour to its end, or from
  // one ring into another.
  [[nodiscard]] bool goes_round(std::size_t from, std::size_t to) const;
  // How much nearer than the tool radius the path of `path` may come to `number`, mm.
  [[nodiscard]] double touch_between(std::size_t number, std::size_t path) const;

  // Counts the blocks from another one on: each number becomes larger by this many.
  void move_by(std::size_t blocks);

  bool operator==(const Walls&) const = default;
};

}  // namespace trc
