#include "client/plot/changed_contour.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/geometry/intersect.h"
#include "core/geometry/parallel.h"
#include "core/verify/shape.h"

namespace trc::plot {
namespace {

using verify::is_finite;

constexpr double same_point = 1e-6;  // mm

struct Changed {
  const MotionBlock* programmed = nullptr;
  const CompensatedBlock* path = nullptr;
  bool start_moved = false;
  bool end_moved = false;
};

Vector turned(const Vector& direction, double angle) {
  return std::cos(angle) * direction + std::sin(angle) * left_of(direction);
}

double shift_of(const TrcMode& mode) {
  if (mode.options.suppress_trc) return 0;
  return mode.side == Side::left ? mode.tool_radius : -mode.tool_radius;
}

// The direction of a line of the new contour. A notch is raised until the path beside one of its
// sides has no length. The fixed end then gives the direction, because that side touches the tool
// in the notch.
Vector direction_of(const Changed& block, double shift) {
  const Point& tool = start_of(block.path->path);
  const Vector way = end_of(block.path->path) - tool;
  if (way.norm() > same_point) return way.normalized();
  const Segment& programmed = block.programmed->path;
  const bool from_start = !block.start_moved;
  const Vector to_tool = tool - (from_start ? start_of(programmed) : end_of(programmed));
  const double distance = to_tool.norm();
  if ((block.start_moved && block.end_moved) || distance <= same_point)
    return tangent_at_start(programmed);
  // If the tool touches this end, rounding may put it nearer than its radius.
  const double angle = std::asin(std::clamp(shift / distance, -1.0, 1.0));
  return turned(to_tool / distance, from_start ? -angle : angle - std::numbers::pi);
}

// The unbounded curve of the new block: the path moved back by the tool radius.
struct Curve {
  std::optional<StraightLine> line{};
  std::optional<Circle> circle{};
};

Curve curve_of(const Changed& block) {
  const double shift = shift_of(*block.programmed->mode);
  if (const auto* arc = std::get_if<Arc>(&block.path->path))
    return {.circle = Circle{.center = arc->center, .radius = parallel_radius(*arc, -shift)}};
  const Vector direction = direction_of(block, shift);
  return {.line =
              StraightLine{.point = parallel_point(start_of(block.path->path), direction, -shift),
                           .direction = direction}};
}

Meetings meetings_of(const Curve& a, const Curve& b) {
  if (a.line && b.line) return intersect(*a.line, *b.line);
  if (a.line) return intersect(*a.line, *b.circle, same_point);
  if (b.line) return intersect(*b.line, *a.circle, same_point);
  return intersect(*a.circle, *b.circle, same_point);
}

// Where two new blocks meet, near the programmed corner; otherwise that corner.
Point corner_between(const Changed& before, const Changed& after) {
  const Point& programmed = end_of(before.programmed->path);
  const double reach = 2 * before.programmed->mode->tool_radius +
                       verify::extent_of(before.programmed->path) +
                       verify::extent_of(after.programmed->path);
  Point nearest = programmed;
  double distance = reach;
  for (const Point& point : meetings_of(curve_of(before), curve_of(after))) {
    if ((point - programmed).norm() > distance) continue;
    distance = (point - programmed).norm();
    nearest = point;
  }
  return nearest;
}

Segment between(const Changed& block, const Point& start, const Point& end) {
  const auto* arc = std::get_if<Arc>(&block.path->path);
  if (arc == nullptr) return Line{.start = start, .end = end};
  double sweep = turn_between(start - arc->center, end - arc->center);
  if (sweep * arc->sweep < 0) sweep += std::copysign(2 * std::numbers::pi, arc->sweep);
  return Arc{.start = start, .end = end, .center = arc->center, .sweep = sweep};
}

std::vector<Changed> changed_blocks(std::span<const Block> programmed,
                                    std::span<const CompensatedBlock> path) {
  std::map<std::uint64_t, const MotionBlock*> motions;
  for (const Block& block : programmed)
    if (const auto* motion = std::get_if<MotionBlock>(&block))
      motions.emplace(motion->source.index, motion);
  std::vector<Changed> found;
  for (const CompensatedBlock& block : path) {
    if (block.origin != Origin::kerf && block.origin != Origin::converted_circle) continue;
    const auto motion = motions.find(block.source.index);
    if (motion == motions.end() || !motion->second->mode || !is_finite(block.path)) continue;
    if (!found.empty() && found.back().programmed == motion->second) continue;
    found.push_back({.programmed = motion->second, .path = &block});
  }
  return found;
}

}  // namespace

std::map<std::uint64_t, Segment> changed_contour(std::span<const Block> programmed,
                                                 std::span<const CompensatedBlock> path) {
  std::vector<Changed> blocks = changed_blocks(programmed, path);
  for (std::size_t i = 0; i + 1 < blocks.size(); ++i)
    blocks[i].end_moved = blocks[i + 1].start_moved =
        blocks[i].path->origin == Origin::kerf && blocks[i + 1].path->origin == Origin::kerf &&
        end_of(blocks[i].programmed->path) == start_of(blocks[i + 1].programmed->path);
  std::map<std::uint64_t, Segment> contour;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Changed& block = blocks[i];
    const Segment& programmed_path = block.programmed->path;
    const Point start =
        block.start_moved ? corner_between(blocks[i - 1], block) : start_of(programmed_path);
    const Point end =
        block.end_moved ? corner_between(block, blocks[i + 1]) : end_of(programmed_path);
    contour.emplace(block.programmed->source.index, between(block, start, end));
  }
  return contour;
}

}  // namespace trc::plot
