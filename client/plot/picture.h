#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client/plot/outline.h"
#include "core/base/diagnostic.h"
#include "core/geometry/plane.h"
#include "core/nc/state/block.h"
#include "core/trc/result/compensated_block.h"
#include "core/trc/walls/walls.h"

namespace trc::plot {

// What a stroke stands for; each has its colour, later ones lie on top.
enum class Layer : std::uint8_t {
  lead,        // the contour as written: lead-in and lead-out, no wall
  programmed,  // the contour as written, or what was put in its place
  replaced,    // programmed, but another contour was compensated in its place
  masked,      // programmed, but masked or removed: the tool does not get there
  path,        // the way of the tool centre
  transition,  // inserted on that way
  proposal,    // what is proposed in place of an approach or a retract
};

struct Stroke {
  Layer layer = Layer::programmed;
  bool rapid = false;
  std::vector<Segment> segments{};
  std::string title{};  // which block this is; empty when several are joined
};

struct ToolCircle {
  Point center = Point::Zero();
  double radius = 0;  // mm
};

struct Label {
  Point at = Point::Zero();
  Vector aside = Vector::UnitY();  // the way to step aside from the contour, unit length
  std::string text{};
};

// Why the program was refused, and where.
struct Fault {
  std::optional<Point> place{};
  std::string text{};
  double tool_radius = 0;  // mm, where the tool stands there; else 0
};

struct Warning {
  std::optional<Point> place{};
  std::string text{};
};

// Everything that is drawn, in mm in the plane, before any scale.
struct Picture {
  Plane plane = Plane::xy;
  std::string title{};
  std::vector<Stroke> strokes{};
  std::vector<ToolCircle> tools{};  // where the first selection begins and where it touches
  std::vector<Label> numbers{};     // N words, or lines where there is none
  std::vector<Warning> warnings{};  // the first `most_warnings`
  std::optional<Fault> fault{};
};

struct Contents {
  std::string title{};
  std::span<const Block> programmed{};
  std::span<const CompensatedBlock> path{};
  std::span<const Diagnostic> diagnostics{};
  LeadSettings leads{};  // which blocks are drawn thinner
};

// Beyond this many blocks neighbours are joined to one stroke, so that a browser
// still opens the picture.
inline constexpr std::size_t most_single_strokes = 20'000;
// A picture with more marks than this shows nothing else.
inline constexpr std::size_t most_warnings = 100;

// The plane shown is that of the first compensated contour block; movements in
// other planes are seen from there.
[[nodiscard]] Picture compose(const Contents& contents);

}  // namespace trc::plot
