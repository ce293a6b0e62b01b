#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/language.h"
#include "core/geometry/plane.h"
#include "core/geometry/segment.h"

namespace trc::plot {

// A programmed contour and what tools of several radii cannot reach of it, in mm in the plane.
struct SurveyPicture {
  struct Radius {
    double radius = 0;
    std::string text{};  // for the legend
    std::vector<Segment> uncut{};
    std::optional<Point> refused_at{};
  };

  Language language = Language::english;
  bool inch = false;  // the program counts in inch
  Plane plane = Plane::xy;
  std::string title{};
  std::vector<Segment> contour{};
  std::vector<Radius> radii{};
  std::vector<Segment> limits{};  // the blocks that limit the largest radius
  std::string largest{};          // about that, for the legend; may be empty
};

// An SVG 1.1 document in UTF-8: the contour black, over it the stretches of each radius in a colour
// of its own, the larger radii wider, so that all of them are seen.
[[nodiscard]] std::string to_svg(const SurveyPicture& picture);

}  // namespace trc::plot
