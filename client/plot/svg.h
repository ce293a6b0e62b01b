#pragma once

#include <span>
#include <string>

#include "client/plot/picture.h"

namespace trc::plot {

struct SvgOptions {
  bool numbers = false;  // write block numbers beside the contour
  bool points = false;   // mark where the blocks of contour and path end
};

// The picture as an SVG 1.1 document in UTF-8: equal scale on both axes, one
// group per layer with its colour. Coordinates are pixels.
[[nodiscard]] std::string to_svg(const Picture& picture, const SvgOptions& options);
// Views of one program below each other, the first one with all that is said of it.
[[nodiscard]] std::string to_svg(std::span<const Picture> views, const SvgOptions& options);

// `text` for XML: markup escaped, what is no valid UTF-8 text replaced.
[[nodiscard]] std::string escaped(std::string_view text);

// Its words in lines of at most `most` bytes.
[[nodiscard]] std::vector<std::string> wrapped(const std::string& text, std::size_t most);

}  // namespace trc::plot
