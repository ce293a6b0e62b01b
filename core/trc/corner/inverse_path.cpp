#include "core/trc/corner/inverse_path.h"

#include "core/geometry/parallel.h"

namespace trc {
namespace {

Segment moved_back(const Line& line, double shift, double same_point) {
  const Vector along = line.end - line.start;
  const double length = along.norm();
  if (length <= same_point) return line;
  const Vector tangent = along / length;
  return Line{.start = parallel_point(line.start, tangent, -shift),
              .end = parallel_point(line.end, tangent, -shift)};
}

Segment moved_back(const Arc& arc, double shift, double same_point) {
  const double radius = radius_of(arc);
  const double recovered = parallel_radius(arc, -shift);
  if (recovered <= same_point) return Line{.start = arc.center, .end = arc.center};
  const double scale = recovered / radius;
  return Arc{.start = arc.center + scale * (arc.start - arc.center),
             .end = arc.center + scale * (arc.end - arc.center),
             .center = arc.center,
             .sweep = arc.sweep};
}

}  // namespace

std::optional<Segment> inverse_path(const PathBlock& block, double same_point) {
  const bool transition = block.role == Role::inserted && block.origin == Origin::transition;
  if (block.role != Role::contour && !transition) return std::nullopt;
  // The circle that GEN_CIR_BLOCK_IN_CORNER inserts is a point where two stretches part.
  if (const auto* arc = std::get_if<Arc>(&block.tool_path);
      arc != nullptr && arc->start == arc->center)
    return std::nullopt;
  // While the radius changes, the tool path is not parallel to the contour.
  if (block.at_start != block.at_end) return block.programmed.path;
  return std::visit(
      [&](const auto& path) { return moved_back(path, block.at_end.shift, same_point); },
      block.tool_path);
}

}  // namespace trc
