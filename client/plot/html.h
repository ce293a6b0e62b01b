#pragma once

#include <string>

#include "client/plot/picture.h"

namespace trc::plot {

// One page that needs nothing else: the picture of `svg.h` to zoom with the wheel
// and to move with the mouse, and a switch for each layer. Block numbers are in
// it and switched off unless asked for.
[[nodiscard]] std::string to_html(const Picture& picture, bool numbers);

}  // namespace trc::plot
