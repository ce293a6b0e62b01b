#pragma once

#include <string>
#include <vector>

#include "core/geometry/segment.h"

namespace trc::support {

// The coasts of the world, bays and capes of every size in one contour: closed polygons out of the
// data of GSHHG, without the first point again. A degree is a centimetre, the world 3.6 m wide.
// `resolution` as GMT has it: c, l, i, h or f. Throws where GMT or its data are not installed.
[[nodiscard]] std::vector<std::vector<Point>> coasts(const std::string& resolution);

}  // namespace trc::support
