#pragma once

#include <vector>

#include "client/plot/frame.h"
#include "client/plot/picture.h"

namespace trc::plot {

// Where it is said which way the path is travelled, on the sheet.
struct Arrow {
  Point tip = Point::Zero();
  Vector ahead = Vector::UnitX();  // of unit length
};

// At most eighty, at least a hundred pixels of path apart: each behind the middle of a piece that
// is long enough to carry it, so that two that go there and back do not lie on each other, or where
// short pieces have gone straight on for as long. None lies on another one.
[[nodiscard]] std::vector<Arrow> arrows_of(const Picture& picture, const Frame& frame);

// Whether the stroke is part of what the tool centre travels.
[[nodiscard]] bool is_path(const Stroke& stroke);

}  // namespace trc::plot
