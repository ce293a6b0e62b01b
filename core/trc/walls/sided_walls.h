#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/trc/walls/closing.h"
#include "core/trc/walls/walls.h"

namespace trc {

// The walls of a selection that may change its side (D-42): each side has its own closing and
// leads, and its path also keeps clear of the walls of all other sides, except those at the change
// itself. Blocks are counted over the whole selection.
struct SidedWalls {
  std::vector<std::size_t> changes{};  // the first block after each change of side
  std::vector<Walls> sides{};          // one more than there are changes

  [[nodiscard]] bool is_lead(std::size_t number) const;
  [[nodiscard]] std::optional<Walls::Part> part_of(std::size_t number) const;
  [[nodiscard]] bool is_wall_for(std::size_t number, std::size_t path) const;
  [[nodiscard]] double touch_between(std::size_t number, std::size_t path) const;
  [[nodiscard]] Segment wall(std::size_t number, const Segment& programmed) const;

 private:
  [[nodiscard]] std::size_t side_of(std::size_t number) const;
  [[nodiscard]] std::size_t begin_of(std::size_t side) const {
    return side > 0 ? changes[side - 1] : 0;
  }
};

// `changes`: in order, none at the start or the end of the contour; its shift is that of its start.
[[nodiscard]] SidedWalls find_walls(const ContourView& contour, std::vector<std::size_t> changes,
                                    const LeadSettings& settings, double tool_radius);

// The facts about a contour by which the tool radius affects its walls: where these and the
// settings are equal, the walls are equal.
struct WallsByRadius {
  std::vector<std::vector<EndsMeeting>> meetings{};  // of each side
  double largest_bow_tie = 0;

  bool operator==(const WallsByRadius&) const = default;
};
[[nodiscard]] WallsByRadius walls_by_radius(const ContourView& contour,
                                            const std::vector<std::size_t>& changes,
                                            const LeadSettings& settings, double tool_radius);

// The stretch of a block that `part` leaves.
[[nodiscard]] Segment part_of(const Segment& programmed, const std::optional<Walls::Part>& part);

}  // namespace trc
