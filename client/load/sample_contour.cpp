#include "client/load/sample_contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "core/base/tolerances.h"

namespace trc::load {
namespace {

using std::numbers::pi;

// A coordinate as the program shows it, because the next block starts there.
double as_written(double mm) {
  constexpr double units = 1e6;
  return std::round(mm * units) / units;
}

Point polar(double radius, double angle) {
  return {as_written(radius * std::cos(angle)), as_written(radius * std::sin(angle))};
}

using Element = ContourElement;
using Kind = ContourElement::Kind;

// A contour around the origin, counter-clockwise, with the tool outside. It begins on the positive
// X axis, where two successive laps form no inside corner: approach and retract would gouge there.
struct Outline {
  Point start = Point::Zero();
  std::vector<Element> elements{};  // one lap, or the whole contour
};

Outline polygon(const ShapeRequest& request) {
  constexpr int corners = 60;
  const double radius = 60 * request.tool_radius;
  Outline outline{.start = polar(radius, 0)};
  for (int i = 1; i <= corners; ++i)
    outline.elements.push_back({.end = polar(radius, 2 * pi * (i % corners) / corners)});
  return outline;
}

Outline rounded_square(const ShapeRequest& request) {
  const double half = as_written(20 * request.tool_radius);
  const double corner = as_written(4 * request.tool_radius);
  const double flat = half - corner;
  Outline outline{.start = {half, 0}};
  const std::array<Vector, 4> turns{Vector(1, 0), Vector(0, 1), Vector(-1, 0), Vector(0, -1)};
  for (const Vector& out : turns) {
    const Vector along = left_of(out);
    const Point center = out * flat + along * flat;
    outline.elements.push_back({.end = out * half + along * flat});
    outline.elements.push_back(
        {.end = center + along * corner, .center = center, .kind = Kind::counter_clockwise});
    // The middle of the side, where the next quarter begins.
    outline.elements.push_back({.end = along * half});
  }
  return outline;
}

Outline star(const ShapeRequest& request) {
  constexpr int tips = 8;
  const double outside = 60 * request.tool_radius;
  const double inside = 40 * request.tool_radius;
  Outline outline{.start = polar(outside, 0)};
  for (int i = 1; i <= 2 * tips; ++i)
    outline.elements.push_back(
        {.end = polar(i % 2 == 0 ? outside : inside, pi * (i % (2 * tips)) / tips)});
  return outline;
}

// Teeth with straight flanks. The tool fits into their round roots; their tips are round as well.
Outline gear(const ShapeRequest& request) {
  constexpr int teeth = 24;
  const double outside = 80 * request.tool_radius;
  const double inside = 74 * request.tool_radius;
  constexpr double pitch = 2 * pi / teeth;
  const double half = pitch / 4;
  Outline outline{.start = polar(outside, 0)};
  const Point origin = Point::Zero();
  const auto arc = [&](double radius, double angle) {
    outline.elements.push_back(
        {.end = polar(radius, angle), .center = origin, .kind = Kind::counter_clockwise});
  };
  for (int i = 0; i < teeth; ++i) {
    const double middle = i * pitch;
    const bool last = i == teeth - 1;
    arc(outside, middle + half * 0.8);
    outline.elements.push_back({.end = polar(inside, middle + half * 1.2)});
    arc(inside, middle + half * 2.8);
    outline.elements.push_back({.end = polar(outside, middle + half * 3.2)});
    arc(outside, last ? 0 : middle + pitch);
  }
  return outline;
}

// Outward bows with lines between them.
Outline wave(const ShapeRequest& request) {
  constexpr int bows = 24;
  constexpr double pitch = 2 * pi / bows;
  const double radius = 80 * request.tool_radius;
  const double half_line = 0.2 * pitch;
  Outline outline;
  // The first line and the last line are the halves of one.
  outline.start = {polar(radius, half_line).x(), 0};
  for (int i = 0; i < bows; ++i) {
    const Point from = polar(radius, i * pitch + half_line);
    const Point to = polar(radius, (i + 1) * pitch - half_line);
    outline.elements.push_back({.end = from});
    const Vector chord = to - from;
    // The centre lies inside, half a chord from the middle of the chord: a quarter circle.
    const Point center = from + chord / 2 + left_of(chord) / 2;
    outline.elements.push_back({.end = to,
                                .center = {as_written(center.x()), as_written(center.y())},
                                .kind = Kind::counter_clockwise});
  }
  outline.elements.push_back({.end = outline.start});
  return outline;
}

// Quarter circles whose radius grows by a quarter of the pitch each.
Outline spiral(const ShapeRequest& request) {
  const double step = as_written(request.tool_radius);
  double radius = 4 * step;
  Outline outline{.start = {radius, 0}};
  Point center = Point::Zero();
  Vector out = Vector::UnitX();
  for (std::uint64_t i = 0; i < request.blocks; ++i) {
    out = left_of(out);
    outline.elements.push_back(
        {.end = center + radius * out, .center = center, .kind = Kind::counter_clockwise});
    center -= step * out;
    radius += step;
  }
  return outline;
}

// The lines of a wave of the meander, and its length in tool radii.
constexpr double lines_per_wave = 100;
constexpr double wave_length = 10;

// Waves of two radii in height around a ring; the tool fits into their round troughs.
Outline meander(const ShapeRequest& request) {
  constexpr std::uint64_t shortest_lap = 300;
  const std::uint64_t lines = std::max(request.blocks, shortest_lap);
  const double waves = std::floor(static_cast<double>(lines) / lines_per_wave);
  const double middle = waves * wave_length * request.tool_radius / (2 * pi);
  const auto corner = [&](std::uint64_t number) {
    const double angle = 2 * pi * static_cast<double>(number) / static_cast<double>(lines);
    return polar(middle + request.tool_radius * std::cos(waves * angle), angle);
  };
  Outline outline{.start = corner(0)};
  outline.elements.reserve(lines);
  for (std::uint64_t i = 1; i <= lines; ++i) outline.elements.push_back({.end = corner(i % lines)});
  return outline;
}

// A lap of lines and bows; the seed chooses their distances from the origin.
Outline random_lap(const ShapeRequest& request) {
  constexpr std::uint64_t longest_lap = 1000;
  std::mt19937_64 generator(request.seed);
  const auto share = [&] { return static_cast<double>(generator() >> 11U) * 0x1.0p-53; };
  const auto corners = static_cast<int>(std::clamp<std::uint64_t>(request.blocks, 24, longest_lap));
  const double edge = 20 * request.tool_radius;
  const double radius = edge * corners / (2 * pi);
  // The first corner is the outermost one and lies between two lines.
  Outline outline{.start = polar(radius + 3 * request.tool_radius, 0)};
  Point from = outline.start;
  for (int i = 1; i <= corners; ++i) {
    const double out = 3 * request.tool_radius * (2 * share() - 1);
    const Point to = i == corners ? outline.start : polar(radius + out, 2 * pi * i / corners);
    const bool bow = share() < 1.0 / 3 && i > 1 && i < corners;
    // A bow of about 40 degrees, outwards.
    const Vector chord = to - from;
    const Point center = from + chord / 2 + left_of(chord) * (1.2 + share());
    outline.elements.push_back({.end = to,
                                .center = {as_written(center.x()), as_written(center.y())},
                                .kind = bow ? Kind::counter_clockwise : Kind::line});
    from = to;
  }
  return outline;
}

struct ShapeMaker {
  ShapeRow row;
  Outline (*make)(const ShapeRequest&);
};

constexpr std::array<ShapeMaker, 8> makers{{
    {{"polygon", "60 equal lines"}, polygon},
    {{"square", "lines and quarter circles, tangential"}, rounded_square},
    {{"star", "8 tips, sharp outside and inside corners"}, star},
    {{"gear", "24 teeth of lines and arcs"}, gear},
    {{"wave", "24 quarter circles and lines, inside corners between them"}, wave},
    {{"spiral", "quarter circles that grow"}, spiral},
    {{"meander", "a ring of waves of 100 lines each, travelled once"}, meander},
    {{"random", "lines and arcs chosen by the seed, one in three an arc"}, random_lap},
}};

// The first lap of a contour that is longer than a lap. It ends where it began: the blocks beyond
// full laps become pieces of its first line, away from both ends.
std::vector<Element> first_lap(const ShapeRequest& request, const Outline& outline) {
  std::vector<Element> elements = outline.elements;
  const std::uint64_t pieces = request.blocks % outline.elements.size();
  Point from = outline.start;
  for (std::size_t i = 0; i < outline.elements.size(); ++i) {
    const Element& element = outline.elements[i];
    if (element.kind != Kind::line) {
      from = element.end;
      continue;
    }
    std::vector<Element> inner;
    for (std::uint64_t piece = 0; piece < pieces; ++piece) {
      const double share = (1 + static_cast<double>(piece) / static_cast<double>(pieces)) / 3;
      const Point end = from + share * (element.end - from);
      inner.push_back({.end = {as_written(end.x()), as_written(end.y())}});
    }
    elements.insert(elements.begin() + static_cast<std::ptrdiff_t>(i), inner.begin(), inner.end());
    break;
  }
  return elements;
}

const ShapeMaker* maker_of(const std::string& shape) {
  const auto* maker = std::find_if(makers.begin(), makers.end(), [&](const ShapeMaker& candidate) {
    return candidate.row.name == shape;
  });
  return maker == makers.end() ? nullptr : maker;
}

}  // namespace

const std::vector<ShapeRow>& shapes() {
  static const std::vector<ShapeRow> rows = [] {
    std::vector<ShapeRow> all;
    all.reserve(makers.size());
    for (const ShapeMaker& maker : makers) all.push_back(maker.row);
    return all;
  }();
  return rows;
}

std::string fault_of(const ShapeRequest& request) {
  if (maker_of(request.shape) == nullptr) return "unknown shape " + request.shape;
  // Growth of the shape in radii per block.
  double growth = 0;
  if (request.shape == "spiral") growth = 1;
  if (request.shape == "meander") growth = wave_length / lines_per_wave / (2 * pi);
  if (growth == 0) return {};
  const double most = (Tolerances{}.largest_coordinate / request.tool_radius - 10) / growth;
  if (static_cast<double>(request.blocks) <= most) return {};
  return "a " + request.shape + " of this tool radius has at most " +
         std::to_string(static_cast<std::uint64_t>(std::max(most, 0.0))) + " blocks";
}

SampleContour::SampleContour(const ShapeRequest& request)
    : blocks_(request.blocks), away_(4 * request.tool_radius) {
  Outline outline = maker_of(request.shape)->make(request);
  start_ = outline.start;
  // A contour shorter than a lap ends part of the way round.
  if (blocks_ <= outline.elements.size()) {
    outline.elements.resize(blocks_);
    first_lap_ = std::move(outline.elements);
    return;
  }
  first_lap_ = first_lap(request, outline);
  lap_ = std::move(outline.elements);
}

Point SampleContour::approach_from() const { return start_ + Vector(away_, 0); }

Point SampleContour::retract_to() const {
  const Point& end = blocks_ == 0 ? start_ : (*this)[blocks_ - 1].end;
  // Straight away from the centre, clear of the contour.
  const Vector outward = end.norm() > 0 ? Vector(end.normalized()) : Vector(Vector::UnitX());
  return end + away_ * outward;
}

}  // namespace trc::load
