#pragma once

#include "core/geometry/plane.h"
#include "core/geometry/segment.h"
#include "core/nc/state/block.h"
#include "server/http/view/elements.h"

namespace trc::server::http {

struct Movement {
  Plane plane = Plane::xy;
  Segment shape{};
  AxisTravel normal{};  // across the plane
};

// A movement as the plane that is shown sees it, one element for each piece.
void add_seen(Elements& elements, Element element, const Movement& movement, Plane shown);

}  // namespace trc::server::http
