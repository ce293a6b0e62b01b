#pragma once

#include <vector>

#include "client/plot/frame.h"
#include "client/plot/picture.h"

namespace trc::plot {

// An arrow on the sheet that shows the direction of the path.
struct Arrow {
  Point tip = Point::Zero();
  Vector ahead = Vector::UnitX();  // of unit length
};

// At most eighty, at least a hundred pixels of path apart: each after the middle of a piece that is
// long enough for it, so that those of two opposite passes do not lie on each other, or where short
// pieces have gone straight on for as long. None overlaps another.
[[nodiscard]] std::vector<Arrow> arrows_of(const Picture& picture, const Frame& frame);

// Whether the stroke is part of what the tool centre travels.
[[nodiscard]] bool is_path(const Stroke& stroke);

}  // namespace trc::plot
