#include "core/verify/crossed_walls.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/verify/coverage.h"
#include "core/verify/nearest.h"

namespace trc::verify {
namespace {

// The lowest height of the path, mm; infinite if the selection has no path.
double lowest_of(const MeasuredPath& held, std::size_t first, std::size_t behind,
                 Checkpoint& checkpoint) {
  double lowest = std::numeric_limits<double>::infinity();
  auto pieces = held.path().from(first);
  for (std::size_t number = first; number < behind; ++number) {
    checkpoint.pass();
    lowest = std::min(lowest, pieces.next().height);
  }
  return lowest;
}

// The walls with which the contour begins and ends: an open one may reach beyond the part there.
struct Ends {
  std::size_t first = 0;
  std::size_t last = 0;
  bool are_open = false;

  [[nodiscard]] bool may_be_crossed(std::size_t number) const {
    return are_open && (number == first || number == last);
  }
};

// The selection must have walls.
Ends ends_of(const SelectionPieces& selection, double closing_tolerance) {
  const auto& programmed = selection.held.programmed();
  const auto is_wall = [&](std::size_t number) {
    return programmed[number].is_contour &&
           selection.walls.wall_of(programmed[number]).length() > 0;
  };
  std::size_t first = selection.begin;
  while (first + 1 < selection.end && !is_wall(first)) ++first;
  std::size_t last = selection.end - 1;
  while (last > first && !is_wall(last)) --last;
  const auto wall_of = [&](std::size_t number) {
    return part_of(segment_of(programmed[number].piece),
                   selection.walls.wall_of(programmed[number]));
  };
  const Vector gap = end_of(wall_of(last)) - start_of(wall_of(first));
  return {.first = programmed[first].number,
          .last = programmed[last].number,
          .are_open = gap.norm() > closing_tolerance};
}

// The first wall in the program that the way leads through.
std::optional<CrossedWall> crossed_wall(const Way& way, const SelectionPieces& selection,
                                        const ClearanceSettings& settings, Checkpoint& checkpoint) {
  const MeasuredPath& held = selection.held;
  const SelectionWalls& walls = selection.walls;
  const double least = settings.tolerances.same_point;  // mm
  const double at_end = settings.tolerances.on_top;     // mm
  const std::size_t own = held.programmed()[way.programmed].number;
  const Rule& rule = held.rule_of(held.programmed()[way.programmed]);
  const Ends ends = ends_of(selection, settings.leads.closing_tolerance);
  std::optional<CrossedWall> found;
  walls.tree().for_each_near(
      walls.tree().probe(way.piece),
      [&](double /*required*/) {
        checkpoint.pass();
        return least;
      },
      [&](const ProgrammedPiece& block, const Piece& wall, std::size_t /*first*/) {
        const Gap gap = gap_between(way.piece, wall, least);
        if (gap.distance >= least || (gap.on_a - way.piece.start).norm() <= at_end ||
            (gap.on_a - way.piece.end).norm() <= at_end)
          return;
        if (!walls.are_plain() && !walls.sides().is_wall_for(block.number, own)) return;
        if (ends.may_be_crossed(block.number)) return;
        if (found && found->wall.index <= block.source.index) return;
        found = {.way = way.source,
                 .wall = block.source,
                 .place = from_plane(rule.plane, gap.on_a, way.height)};
      });
  return found;
}

}  // namespace

std::vector<CrossedWall> crossed_walls(const SelectionPieces& selection, std::size_t first,
                                       std::size_t behind, const ClearanceSettings& settings,
                                       Checkpoint& checkpoint) {
  std::vector<CrossedWall> crossed;
  if (selection.walls.count() == 0) return crossed;
  const MeasuredPath& held = selection.held;
  std::optional<double> lowest;
  for (const Way& way : held.ways()) {
    if (way.programmed < selection.begin || way.programmed >= selection.end) continue;
    if (!held.rule_of(held.programmed()[way.programmed]).follows) continue;
    const auto wall = crossed_wall(way, selection, settings, checkpoint);
    if (!wall) continue;
    if (!lowest) lowest = lowest_of(held, first, behind, checkpoint);
    if (way.height <= *lowest) crossed.push_back(*wall);
  }
  return crossed;
}

}  // namespace trc::verify
