#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/geometry/segment.h"
#include "core/nc/state/trc_mode.h"
#include "tests/support/contours.h"

namespace trc::linuxcnc {

// A contour of ours and what LinuxCNC made of it, read from a file that
// make_vectors.py has written (its head describes the format). mm in the plane.
struct JudgedContour {
  std::string name{};
  TrcMode mode{};  // plane, side and radius; G138 and G26, as LinuxCNC does it
  support::Contour contour{};
  // The compensated blocks from the end of the approach to the end of the
  // contour, rounded to 4 decimals; empty when LinuxCNC refused.
  std::vector<Segment> path{};
  Point exit = Point::Zero();  // where LinuxCNC went after G40
  std::string refusal{};       // LinuxCNC's message
  // Where LinuxCNC is known to be wrong: `reversed_line` or `false_gouge`, and
  // the contour block (1-based); empty and 0 elsewhere.
  std::string fault{};
  std::size_t fault_block = 0;
};

// All contours of a file beside this one. Throws std::runtime_error with the
// line when the file cannot be read.
[[nodiscard]] std::vector<JudgedContour> read_judged_contours(const std::string& file_name);

}  // namespace trc::linuxcnc
