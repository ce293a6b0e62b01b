#pragma once

#include <numbers>

#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/reading.h"

namespace trc {

inline constexpr double radians_per_degree = std::numbers::pi / 180;

// CC: takes the pole, also where it is relative to the position of the tool (D-131).
bool take_klartext_pole(Reading& reading, ProgramLine& line, KlartextBlock& block);

// Refuses a block that needs a pole, where none is known: names what has made it so.
bool refuse_without_pole(Reading& reading, const ProgramLine& line, const KlartextBlock& block);

// Finds the end point of PR and PA from `start`, in the plane, mm.
bool find_polar_end(Reading& reading, ProgramLine& line, KlartextBlock& block, const Point& start,
                    Point& end);

}  // namespace trc
