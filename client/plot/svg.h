#pragma once

#include <string>

#include "client/plot/picture.h"

namespace trc::plot {

struct SvgOptions {
  bool numbers = false;  // write block numbers beside the contour
};

// The picture as an SVG 1.1 document in UTF-8: equal scale on both axes, one
// group per layer with its colour. Coordinates are pixels.
[[nodiscard]] std::string to_svg(const Picture& picture, const SvgOptions& options);

// `text` for XML: markup escaped, what is no valid UTF-8 text replaced.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace trc::plot
