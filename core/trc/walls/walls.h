#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace trc {

// What bounds material in the contour of one selection, and for whose path (D-38). Plain data:
// loop removal, the search for bottlenecks and the verification ask the same questions of it.
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
  // A block that is a wall from one place on and up to another one, mm from its start.
  struct Part {
    std::size_t number = 0;
    double from = 0;
    double to = std::numeric_limits<double>::infinity();

    bool operator==(const Part&) const = default;
  };

  // Blocks nothing of which is a wall; in order, none in two of them.
  std::vector<Range> leads{};
  // Blocks that are not walls from end to end; in order.
  std::vector<Part> parts{};
  // Where the contour goes over the same way again: the first block of each ring but the first
  // one, in order. A block parted by the visit belongs to the ring behind it.
  std::vector<std::size_t> rings{};
  // The path of the blocks of one of these may come nearer to the walls of the other one, and where
  // there are rings, of `tail` to those of `tail` and of the begin of the last ring, by `touch`,
  // mm: the end of the contour lies on its begin as exactly as it was programmed.
  Range head{};
  Range tail{};
  double touch = 0;
  // How much nearer, mm, the path of one ring may come to the walls of later ones, which lie on top
  // of it, and the end of each ring to its begin.
  double touch_of_rings = 0;
  // How many blocks more than its first two the lead-out goes along at the begin of the contour.
  std::size_t blocks_beside_lead = 0;
  // How many blocks an overrun goes over before the one it ends on.
  std::size_t blocks_of_overrun = 0;
  // How many blocks behind the begin of the contour its overrun goes along it again; 0: there is
  // none.
  std::size_t blocks_of_round = 0;

  // Where whole turns lead in or out, the blocks of that lead: each turn may touch the walls where
  // the contour closes, as exactly as circles are programmed (D-106).
  Range turns_in{};
  Range turns_out{};
  double touch_of_turns = 0;

  [[nodiscard]] bool are_all() const { return leads.empty() && parts.empty() && rings.empty(); }
  // Nothing is set.
  [[nodiscard]] bool are_plain() const { return are_all() && touch == 0; }
  // Whether nothing of the block is a wall.
  [[nodiscard]] bool is_lead(std::size_t number) const;
  // Nothing: the block is a wall from end to end, or a lead.
  [[nodiscard]] std::optional<Part> part_of(std::size_t number) const;
  // Which ring a block belongs to, counted from 0.
  [[nodiscard]] std::size_t ring_of(std::size_t number) const;
  // Whether the path of the block `path` has to keep clear of the walls of the block `number`:
  // those of an earlier ring are gone when it comes. Each block is one for its own path, which may
  // not exist.
  [[nodiscard]] bool is_wall_for(std::size_t number, std::size_t path) const {
    return number == path ||
           (!is_lead(number) && (rings.empty() || ring_of(number) >= ring_of(path)));
  }
  // Whether all of a lap lies between two blocks: from the begin of the contour to its end, or from
  // one ring into another one.
  [[nodiscard]] bool goes_round(std::size_t from, std::size_t to) const;
  // How much nearer than the tool radius that path may come to it, mm.
  [[nodiscard]] double touch_between(std::size_t number, std::size_t path) const;

  bool operator==(const Walls&) const = default;
};

}  // namespace trc
