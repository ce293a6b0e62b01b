#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/nc/state/block.h"
#include "core/trc/result/compensated_block.h"
#include "core/verify/clearance.h"

namespace trc::cli {

// The walls that a path does not touch, by why it does not.
class UntouchedWalls {
 public:
  enum class Reason : std::uint8_t {
    inside_corner,  // a round tool does not reach into one without a fillet
    left_out,       // the path does not go there, or passes by what lies beside
    farther_away,   // it runs there, but not at the tool radius
  };
  static constexpr std::size_t reasons = 3;

  // The walls with one reason.
  struct Share {
    double length = 0;  // mm
    std::size_t stretches = 0;
    double longest = 0;  // mm
    Source longest_at{};
  };

  UntouchedWalls(const std::vector<Block>& programmed, const std::vector<CompensatedBlock>& path);
  void add(const verify::UncutWall& wall);
  [[nodiscard]] const Share& of(Reason reason) const {
    return shares_[static_cast<std::size_t>(reason)];
  }

 private:
  struct Wall {
    Segment path{};
    // A stretch that ends this close, mm, to the end of the wall ends with it: in wear mode walls
    // lie beside the program.
    double reach = 0;
    bool travelled = false;
    bool beside = false;  // it is travelled at the tool radius from the line or circle it lies on
  };
  using Place = std::pair<std::uint64_t, std::uint8_t>;  // Source::index and Source::part

  [[nodiscard]] Reason reason_of(const verify::UncutWall& wall) const;
  // Whether the contour goes on there with a block that the path does not have.
  [[nodiscard]] bool is_left_out(std::size_t place) const {
    return place > 0 && place < walls_.size() && !walls_[place].travelled;
  }

  std::vector<Wall> walls_;  // contour blocks in their order
  std::map<Place, std::size_t> place_of_;
  std::array<Share, reasons> shares_{};
};

}  // namespace trc::cli
