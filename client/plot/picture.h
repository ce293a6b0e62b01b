#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client/plot/outline.h"
#include "core/base/diagnostic.h"
#include "core/base/language.h"
#include "core/geometry/plane.h"
#include "core/nc/state/block.h"
#include "core/trc/lead_settings.h"
#include "core/trc/result/compensated_block.h"

namespace trc::plot {

// The meaning of a stroke; each has its colour, later ones lie on top.
enum class Layer : std::uint8_t {
  beside,      // programmed, but part of no contour: approach, retract, without compensation
  lead,        // the contour as written: lead-in and lead-out, no wall
  programmed,  // the walls as written, or what was put in their place
  replaced,    // programmed, but another contour was compensated in its place
  masked,      // programmed, but masked or removed: the tool does not get there
  approach,    // the way of the tool centre to a contour, from it, and without compensation
  path,        // the way of the tool centre along a contour
  transition,  // inserted on that way
  proposal,    // what is proposed in place of an approach or a retract
};

struct Stroke {
  Layer layer = Layer::programmed;
  bool rapid = false;
  std::vector<Segment> segments{};
  std::string title{};        // which block this is; empty when several are joined
  std::vector<Point> ends{};  // where blocks end
};

inline constexpr std::size_t layer_count = 9;

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
  std::string remedy{};
  double tool_radius = 0;  // mm, where the tool stands there; else 0
};

// A warning, or a note.
struct Remark {
  std::optional<Point> place{};
  std::string text{};
  std::string remedy{};
};

// Everything that is drawn, in mm in the plane, before any scale.
struct Picture {
  Plane plane = Plane::xy;
  std::string title{};
  std::vector<Stroke> strokes{};
  // Where the first selection begins, where it touches, and both tools where the radius changes.
  std::vector<ToolCircle> tools{};
  std::vector<Label> numbers{};    // N words, or lines where there is none
  std::vector<Remark> warnings{};  // the first `most_warnings`
  std::vector<Remark> notes{};     // as many, without marks
  std::optional<Fault> fault{};
  Language language = Language::english;
  bool inch = false;  // what axes and radii are said in
};

struct Contents {
  std::string title{};
  std::span<const Block> programmed{};
  std::span<const CompensatedBlock> path{};
  std::span<const Diagnostic> diagnostics{};
  Language language = Language::english;
  bool inch = false;     // the program counts in inch
  LeadSettings leads{};  // which blocks are drawn thinner
  Position start{};      // of the setup
  // The plane that is shown; none: that of the first compensated contour block.
  std::optional<Plane> plane{};
};

// Beyond this many blocks neighbours are joined to one stroke, so that a browser
// still opens the picture.
inline constexpr std::size_t most_single_strokes = 20'000;
// A picture with more marks than this shows nothing else.
inline constexpr std::size_t most_warnings = 100;
// The number of radius changes shown: the first ones.
inline constexpr std::size_t most_radius_changes = 50;

// Movements in other planes than the one that is shown are seen from there.
[[nodiscard]] Picture compose(const Contents& contents);

// That, and after it a view of each other plane in which something is compensated. Where there is
// none, but the third axis moves: a view from the side, along the first axis.
[[nodiscard]] std::vector<Picture> compose_views(const Contents& contents);

}  // namespace trc::plot
