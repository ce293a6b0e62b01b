#pragma once

#include "core/verify/shape.h"

namespace trc::plot {

using verify::Bounds;
using verify::extent_of;
using verify::is_finite;
using verify::Place;
using verify::place_at;

}  // namespace trc::plot
