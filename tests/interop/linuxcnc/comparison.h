#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/trc/result/compensated_block.h"
#include "tests/interop/linuxcnc/judged_contour.h"

namespace trc::linuxcnc {

// LinuxCNC neither trims nor rounds a corner below this: a constant in its source, rad.
inline constexpr double corner_threshold = 0.05;

// Bounds in mm: LinuxCNC prints 4 decimals; the circle centres of the files have
// 6, and the core corrects them.
inline constexpr double same_path = 1e-3;
inline constexpr double equidistant = 2e-6;

// The corner after contour block `index` (0-based), seen from the tool: rad,
// positive at an inside corner, -pi < turn <= pi.
[[nodiscard]] double turn_to_tool(const JudgedContour& judged, std::size_t index);

// One programmed block and what became of it and of the corner after it.
struct Compensated {
  Segment block{};
  std::vector<Segment> corner{};  // inserted after it

  bool operator==(const Compensated&) const = default;
};

// Both paths seated on the programmed blocks. Throws std::runtime_error when a
// path does not fit the contour.
[[nodiscard]] std::vector<Compensated> seated(const JudgedContour& judged,
                                              const std::vector<CompensatedBlock>& path);
[[nodiscard]] std::vector<Compensated> seated_answer(const JudgedContour& judged);

// A sentence about the first point where our path is more than `tolerance` mm
// from LinuxCNC's, or nothing. Joints at corners below the threshold are left out.
[[nodiscard]] std::string difference(const JudgedContour& judged,
                                     const std::vector<Compensated>& ours,
                                     const std::vector<Compensated>& theirs, double tolerance);

// A sentence about the first place where our path breaks the definition of the
// equidistant by more than `tolerance` mm, or nothing: every compensated block
// is one tool radius from its programmed block and every inserted block from its
// corner; at the corners LinuxCNC leaves alone no joint is nearer to either
// neighbour. (At sharper corners the far end of a short neighbour may well be.)
[[nodiscard]] std::string broken_equidistant(const JudgedContour& judged,
                                             const std::vector<Compensated>& ours,
                                             double tolerance);

}  // namespace trc::linuxcnc
