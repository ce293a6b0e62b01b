#pragma once

#include <array>
#include <cstdint>

#include "core/nc/dialect/reading.h"

namespace trc {

// A line after a deselection without motion. In the output, axes that it does not name still stand
// beside the contour, a tool radius away from their programmed position (D-74).
struct LineBesideContour {
  std::array<bool, 3> named{};  // X Y Z that it leads to where the program has them
  bool copied = false;
  bool cuts = false;
  std::uint32_t begin = 0;  // of what it says, in the line
};

// If copied, the axes that it names have left the contour. If it cuts, all axes must have.
bool leave_contour(Reading& reading, const ProgramLine& line, const LineBesideContour& says);

// Before the tool cuts, each axis must stand at its programmed position, or be led there.
bool check_left_contour(Reading& reading, const ProgramLine& line, std::uint32_t begin,
                        const std::array<bool, 3>& named);

}  // namespace trc
