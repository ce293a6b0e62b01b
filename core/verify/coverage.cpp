#include "core/verify/coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/verify/nearest.h"
#include "core/verify/shape.h"

namespace trc::verify {
namespace {

// A path touches a wall if its distance differs from the tool radius by no more than this, mm.
constexpr double most_apart = 1e-3;

// The stretch of the programmed block from beside the start of the path to beside its end.
Stretch along_line(const Piece& programmed, const Piece& path) {
  const Vector along = (programmed.end - programmed.start).normalized();
  return {.from = (path.start - programmed.start).dot(along),
          .to = (path.end - programmed.start).dot(along)};
}

// How far an arc has turned from its start to the direction of a point, rad, positive in its own
// sense. Most paths begin beside the start of their block, where the angle equals its tangent.
double turned(const Piece& arc, const Point& point) {
  constexpr double is_its_tangent = 1e-6;  // rad: its cube is negligible
  const Vector from = arc.start - arc.center;
  const Vector to = point - arc.center;
  const double sine = cross(from, to);
  const double cosine = from.dot(to);
  const double angle =
      std::abs(sine) < is_its_tangent * cosine ? sine / cosine : std::atan2(sine, cosine);
  return arc.sweep < 0 ? -angle : angle;
}

Stretch along_arc(const Piece& programmed, const Piece& path) {
  const double from = turned(programmed, path.start);
  const double sense = programmed.sweep < 0 ? -1 : 1;
  const double sweep = path.is_arc() ? sense * path.sweep : turned(programmed, path.end) - from;
  // After half a turn the angle has come round.
  const double begin =
      from < -std::numbers::pi / 2 && -from + std::abs(programmed.sweep) > 1.5 * std::numbers::pi
          ? from + 2 * std::numbers::pi
          : from;
  const double radius = programmed.radius();
  return {.from = begin * radius, .to = (begin + sweep) * radius};
}

// The stretch of the block beside the path; empty if the path is not at that distance.
Stretch beside(const Piece& programmed, const Piece& path, double required) {
  const Point middle = place_at(segment_of(path), 0.5).point;
  const double apart = (nearest_point(segment_of(programmed), middle) - middle).norm();
  if (std::abs(apart - required) > most_apart) return {};
  return programmed.is_arc() ? along_arc(programmed, path) : along_line(programmed, path);
}

// The stretch of a line beside another line, judged at the middle of their common part: at a mitre
// the path reaches far beyond the end of the wall. Empty if the path is not at that distance.
Stretch beside_lines(const Piece& programmed, const Piece& path, double required) {
  const double length = programmed.length();
  const Vector along = (programmed.end - programmed.start) / length;
  const double from = (path.start - programmed.start).dot(along);
  const double to = (path.end - programmed.start).dot(along);
  const double middle = 0.5 * (std::max(from, 0.0) + std::min(to, length));
  if (!(from < to) || middle < from || middle > to) return {};
  const Point on_path = path.start + (middle - from) / (to - from) * (path.end - path.start);
  const double apart = std::abs(cross(along, on_path - programmed.start));
  return std::abs(apart - required) > most_apart ? Stretch{} : Stretch{.from = from, .to = to};
}

// Whether all of the wall lies beside the path: both begin and end beside each other, and the path
// runs at that distance. False if undecided. Decides for most blocks, without a root.
bool is_all_beside(const Piece& programmed, const Piece& path, double required) {
  const Vector along = programmed.end - programmed.start;
  const Vector start = path.start - programmed.start;
  const Vector end = path.end - programmed.start;
  const double reach = required + most_apart;
  if (start.squaredNorm() > reach * reach ||
      (path.end - programmed.end).squaredNorm() > reach * reach)
    return false;
  const double square = along.squaredNorm();
  const double from = start.dot(along);
  const double to = end.dot(along);
  if (!(from < to && from < square && to > 0)) return false;
  const double at_start = cross(along, start);
  const double at_end = cross(along, end);
  const double least = required - most_apart;
  const auto is_that_far = [&](double across) {
    return across * across >= least * least * square && across * across <= reach * reach * square;
  };
  return least > 0 && at_start * at_end > 0 && is_that_far(at_start) && is_that_far(at_end);
}

// Whether the path is beside all of the wall, for arcs about one centre that are not short.
bool is_arc_all_beside(const Piece& programmed, const Piece& path, double required) {
  const double reach = required + most_apart;
  const double square = reach * reach;
  if ((path.start - programmed.start).squaredNorm() > square ||
      (path.end - programmed.end).squaredNorm() > square ||
      (programmed.end - programmed.start).squaredNorm() < 4 * square ||
      std::abs(programmed.sweep) > std::numbers::pi || (path.sweep > 0) != (programmed.sweep > 0))
    return false;
  const double radius = path.radius();
  return radius > 2 * most_apart &&
         std::abs(std::abs(radius - programmed.radius()) - required) <= most_apart;
}

}  // namespace

Stretch touched(const Piece& programmed, const Stretch& within, const Piece& path,
                double required) {
  if (programmed.is_point()) return {};
  const bool are_lines = !programmed.is_arc() && !path.is_arc();
  if (are_lines && is_all_beside(programmed, path, required)) return within;
  const bool are_concentric =
      programmed.is_arc() && path.is_arc() && programmed.center == path.center;
  if (are_concentric && is_arc_all_beside(programmed, path, required)) return within;
  // The tool stays in one place, or turns about the centre of an arc of its own radius.
  if ((path.is_point() || programmed.is_arc()) && is_touched_from(path.start, programmed, required))
    return within;
  if (path.is_point()) return {};
  Stretch stretch;
  if (are_lines)
    stretch = beside_lines(programmed, path, required);
  else if (!are_concentric)
    stretch = beside(programmed, path, required);
  else if (std::abs(std::abs(path.radius() - programmed.radius()) - required) <= most_apart)
    stretch = along_arc(programmed, path);
  stretch = {.from = std::max(stretch.from, within.from), .to = std::min(stretch.to, within.to)};
  if (!(stretch.from < stretch.to)) return {};
  // Adds the rest between an end of the path and the corner there.
  const double reach = required + most_apart;
  if ((path.start - programmed.start).squaredNorm() <= reach * reach) stretch.from = within.from;
  if ((path.end - programmed.end).squaredNorm() <= reach * reach) stretch.to = within.to;
  return stretch;
}

bool is_touched_from(const Point& place, const Piece& programmed, double required) {
  const double reach = required + most_apart;
  const auto reaches = [&](const Point& point) {
    return (point - place).squaredNorm() <= reach * reach;
  };
  if (!programmed.is_arc()) return reaches(programmed.start) && reaches(programmed.end);
  // A tighter arc leaves a rest, however small.
  return std::abs(programmed.radius() - required) <= most_apart &&
         (place - programmed.center).norm() <= most_apart;
}

Segment part_of(const Segment& programmed, const Stretch& within) {
  const double length = extent_of(programmed);
  if (length == 0) return programmed;
  const Point start = place_at(programmed, within.from / length).point;
  const Point end = place_at(programmed, within.to / length).point;
  const auto* arc = std::get_if<Arc>(&programmed);
  if (arc == nullptr) return Line{.start = start, .end = end};
  return Arc{.start = start,
             .end = end,
             .center = arc->center,
             .sweep = arc->sweep * within.length() / length};
}

}  // namespace trc::verify
