#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>

#include "client/plot/picture.h"
#include "core/geometry/along.h"
#include "core/trc/walls/selection_contours.h"

namespace trc::plot {

// The parts of contour blocks that are no walls, by Source::index.
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

}  // namespace trc::plot
