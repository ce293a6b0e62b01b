#pragma once

#include <array>
#include <cstdint>

#include "core/nc/dialect/reading.h"

namespace trc {

// A line behind a deselection without motion. In its output the axes it does not name stand beside
// the contour, by the tool radius away from where the program has them (D-74).
struct LineBesideContour {
  std::array<bool, 3> named{};  // X Y Z that it leads to where the program has them
  bool copied = false;
  bool cuts = false;
  std::uint32_t begin = 0;  // of what it says, in the line
};

// What it names has left the contour if it is copied. Where it cuts, nothing may stand there still.
bool leave_contour(Reading& reading, const ProgramLine& line, const LineBesideContour& says);

// Before the tool cuts, each axis has to stand where the program has it, or be led there.
bool check_left_contour(Reading& reading, const ProgramLine& line, std::uint32_t begin,
                        const std::array<bool, 3>& named);

}  // namespace trc
