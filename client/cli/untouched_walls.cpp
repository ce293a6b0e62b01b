#include "client/cli/untouched_walls.h"

#include <cmath>
#include <variant>

#include "core/geometry/plane.h"
#include "core/geometry/segment.h"
#include "core/verify/shape.h"

namespace trc::cli {
namespace {

// A stretch that comes this near to the end of a block ends there; mm.
constexpr double at_end = 1e-3;

bool is_on_contour(const CompensatedBlock& block) {
  return (block.origin == Origin::programmed || block.origin == Origin::kerf ||
          block.origin == Origin::converted_circle) &&
         verify::extent_of(block.path) > 0;
}

// Distance of a point from the straight line or the circle of a block; mm.
double distance_to_course(const Segment& block, const Point& point) {
  if (const auto* arc = std::get_if<Arc>(&block))
    return std::abs((point - arc->center).norm() - (arc->start - arc->center).norm());
  const Line& line = std::get<Line>(block);
  const Vector along = line.end - line.start;
  const double length = along.norm();
  return length > 0 ? std::abs(cross(along, point - line.start)) / length
                    : (point - line.start).norm();
}

}  // namespace

UntouchedWalls::UntouchedWalls(const std::vector<Block>& programmed,
                               const std::vector<CompensatedBlock>& path) {
  std::map<Place, Point> middle_of;
  for (const CompensatedBlock& block : path)
    if (is_on_contour(block))
      middle_of.emplace(Place(block.source.index, block.source.part),
                        verify::place_at(block.path, 0.5).point);
  for (const Block& block : programmed) {
    const auto* motion = std::get_if<MotionBlock>(&block);
    if (motion == nullptr || !motion->mode || !motion->mode->active()) continue;
    const Place place(motion->source.index, motion->source.part);
    place_of_.emplace(place, walls_.size());
    Wall& wall = walls_.emplace_back(
        Wall{.path = motion->path, .reach = at_end + 1.5 * motion->mode->nominal_radius});
    const auto middle = middle_of.find(place);
    if (middle == middle_of.end()) continue;
    wall.travelled = true;
    wall.beside = std::abs(distance_to_course(wall.path, middle->second) -
                           std::abs(motion->mode->tool_radius)) <= at_end;
  }
}

UntouchedWalls::Reason UntouchedWalls::reason_of(const verify::UncutWall& wall) const {
  const auto found = place_of_.find({wall.source.index, wall.source.part});
  if (found == place_of_.end()) return Reason::farther_away;
  const std::size_t place = found->second;
  const Wall& block = walls_[place];
  if (!block.travelled) return Reason::left_out;
  if (!block.beside) return Reason::farther_away;
  const auto ends_with_it = [&](double share) {
    const Vector apart =
        verify::place_at(wall.path, share).point - verify::place_at(block.path, share).point;
    return apart.norm() <= block.reach;
  };
  const bool at_start = ends_with_it(0);
  const bool at_close = ends_with_it(1);
  // The path leaves the middle of a wall because something else is in the way.
  if (!at_start && !at_close) return Reason::left_out;
  if ((at_start && is_left_out(place - 1)) || (at_close && is_left_out(place + 1)))
    return Reason::left_out;
  return Reason::inside_corner;
}

void UntouchedWalls::add(const verify::UncutWall& wall) {
  Share& share = shares_[static_cast<std::size_t>(reason_of(wall))];
  const double length = verify::extent_of(wall.path);
  share.length += length;
  ++share.stretches;
  if (length <= share.longest) return;
  share.longest = length;
  share.longest_at = wall.source;
}

}  // namespace trc::cli
