#pragma once

#include <numbers>

#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/reading.h"

namespace trc {

inline constexpr double radians_per_degree = std::numbers::pi / 180;

// CC: the pole, also where it is told from where the tool stands (D-131).
bool take_klartext_pole(Reading& reading, ProgramLine& line, KlartextBlock& block);

// Where PR and PA lead from `start`, in the plane, mm.
bool find_polar_end(Reading& reading, ProgramLine& line, KlartextBlock& block, const Point& start,
                    Point& end);

}  // namespace trc
