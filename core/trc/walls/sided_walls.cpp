#include "core/trc/walls/sided_walls.h"

#include <algorithm>
#include <utility>

#include "core/geometry/along.h"
#include "core/trc/corner/bow_tie.h"
#include "core/trc/walls/end_meetings.h"
#include "core/trc/walls/extent.h"
#include "core/trc/walls/scratch.h"

namespace trc {

std::size_t SidedWalls::side_of(std::size_t number) const {
  return static_cast<std::size_t>(std::upper_bound(changes.begin(), changes.end(), number) -
                                  changes.begin());
}

bool SidedWalls::is_lead(std::size_t number) const {
  const std::size_t side = side_of(number);
  return sides[side].is_lead(number - begin_of(side));
}

std::optional<Walls::Part> SidedWalls::part_of(std::size_t number) const {
  const std::size_t side = side_of(number);
  return sides[side].part_of(number - begin_of(side));
}

bool SidedWalls::is_wall_for(std::size_t number, std::size_t path) const {
  const std::size_t side = side_of(number);
  const std::size_t begin = begin_of(side);
  if (side == side_of(path)) return sides[side].is_wall_for(number - begin, path - begin);
  const std::size_t later = std::max(number, path);
  const bool at_change = later == begin_of(side_of(later)) && later == std::min(number, path) + 1;
  return !at_change && !is_lead(number);
}

double SidedWalls::touch_between(std::size_t number, std::size_t path) const {
  const std::size_t side = side_of(number);
  const std::size_t begin = begin_of(side);
  return side == side_of(path) ? sides[side].touch_between(number - begin, path - begin) : 0;
}

Segment SidedWalls::wall(std::size_t number, const Segment& programmed) const {
  return trc::part_of(programmed, part_of(number));
}

namespace {

// The contour must outlive the view.
ContourView side_of(const ContourView& contour, const std::vector<std::size_t>& changes,
                    std::size_t side) {
  const std::size_t begin = side > 0 ? changes[side - 1] : 0;
  const std::size_t end = side < changes.size() ? changes[side] : contour.count;
  ContourView part{.count = end - begin, .segment = [&contour, begin](std::size_t number) {
                     return contour.segment(begin + number);
                   }};
  if (contour.role)
    part.role = [&contour, begin](std::size_t number) { return contour.role(begin + number); };
  part.shift = side % 2 == 0 ? contour.shift : -contour.shift;
  part.shortest_step = contour.shortest_step;
  part.tolerances = contour.tolerances;
  part.checkpoint = contour.checkpoint;
  part.tool_side = side % 2 == 0 ? contour.tool_side : opposite(contour.tool_side);
  return part;
}

}  // namespace

SidedWalls find_walls(const ContourView& contour, std::vector<std::size_t> changes,
                      const LeadSettings& settings, double tool_radius) {
  SidedWalls walls{.changes = std::move(changes)};
  for (std::size_t side = 0; side <= walls.changes.size(); ++side)
    walls.sides.push_back(find_walls(side_of(contour, walls.changes, side), settings, tool_radius));
  return walls;
}

WallsByRadius walls_by_radius(const ContourView& contour, const std::vector<std::size_t>& changes,
                              const LeadSettings& settings, double tool_radius) {
  WallsByRadius result{.largest_bow_tie = largest_bow_tie(settings.input_resolution, tool_radius)};
  if (settings.find != LeadSettings::Find::automatic) return result;
  Scratch scratch;
  for (std::size_t side = 0; side <= changes.size(); ++side) {
    const ContourView of_side = side_of(contour, changes, side);
    const auto meetings = meetings_of_ends(of_side, settings.closing_tolerance, tool_radius,
                                           extent_of(of_side).length, scratch.memory());
    result.meetings.emplace_back(meetings.begin(), meetings.end());
  }
  return result;
}

Segment part_of(const Segment& programmed, const std::optional<Walls::Part>& part) {
  if (!part) return programmed;
  const double to = std::min(part->to, length_of(programmed));
  return stretch_of(programmed, part->from, to, point_along(programmed, part->from),
                    point_along(programmed, to));
}

}  // namespace trc
