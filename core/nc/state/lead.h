#pragma once

#include <cstdint>
#include <optional>

#include "core/geometry/segment.h"

namespace trc {

// How a program comes to its contour or leaves it by a word of its own: APPR and DEP of Klartext,
// G147 … G348 of Sinumerik. Lengths and radii are those of the path of the tool centre.
struct Lead {
  enum class Form : std::uint8_t {
    tangent,       // LT: along the line on which the contour begins or ends
    normal,        // LN: across it
    arc,           // CT: on an arc that touches the contour
    arc_and_line,  // LCT: on such an arc and the line that touches it
  };
  Form form = Form::tangent;
  double length = 0;           // mm: LT, LN
  double radius = 0;           // mm: CT, LCT; negative, of CT: on the other side than the tool
  double angle = 0;            // rad: CT
  bool from_edge = false;      // of LT: the length counts from the edge of the tool
  bool bends_to_tool = false;  // of CT: to the side where the tool comes from or goes to (G143)

  template <class Archive>
  void serialize(Archive& archive) {
    archive(form, length, radius, angle, from_edge, bends_to_tool);
  }
};

// When the third axis travels as a lead leaves the contour.
enum class Climb : std::uint8_t { behind_the_lead, along_the_lead };

// How the third axis comes to the plane of the contour with a smooth approach of Sinumerik.
struct Infeed {
  double height = 0;            // mm: coordinate up to which the tool comes as it came there
  bool along_the_lead = false;  // from there on with the lead (G340), else before it (G341)
  double feed = 0;              // mm/min, of the way before the lead

  template <class Archive>
  void serialize(Archive& archive) {
    archive(height, along_the_lead, feed);
  }
};

// Where the contour begins or ends.
struct ContourEnd {
  Point point = Point::Zero();
  Vector tangent = Vector::UnitX();  // of unit length, in the direction of travel
  double side = 1;                   // where the tool runs: 1 left, -1 right
  double reach = 0;                  // mm: how far from the contour

  [[nodiscard]] double shift() const { return side * reach; }
};

// What a lead adds to the programmed contour, so that its equidistant becomes the path that the
// lead describes.
struct LeadPath {
  std::optional<Segment> contour{};  // from `away` to the contour or back
  // Where the lead begins or ends, on the path of the tool centre.
  Point away = Point::Zero();
};

// `from`, `to`: where the tool stands before and after the lead; used by LCT and by arcs that bend
// towards it. Nothing where the lead has no room: LCT from inside its circle, CT with an arc
// smaller than the tool, a line from the edge of the tool that would have no length.
[[nodiscard]] std::optional<LeadPath> path_to(const ContourEnd& begin, const Lead& lead,
                                              const Point& from, double same_point);
[[nodiscard]] std::optional<LeadPath> path_from(const ContourEnd& end, const Lead& lead,
                                                const Point& to, double same_point);

}  // namespace trc
