#include "core/verify/coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/verify/nearest.h"
#include "core/verify/shape.h"

namespace trc::verify {
namespace {

// So much farther from a wall than the tool radius a path still touches it, mm.
constexpr double most_apart = 1e-3;

// How far along the programmed block the path begins and ends beside it.
Stretch beside(const Line& programmed, const Segment& path) {
  const Vector along = (programmed.end - programmed.start).normalized();
  return {.from = (place_at(path, 0).point - programmed.start).dot(along),
          .to = (place_at(path, 1).point - programmed.start).dot(along)};
}

Stretch beside(const Arc& programmed, const Segment& path) {
  const double radius = (programmed.start - programmed.center).norm();
  const double sense = programmed.sweep < 0 ? -1 : 1;
  const auto turned = [&](const Point& point) {
    const Vector from = programmed.start - programmed.center;
    const Vector to = point - programmed.center;
    return sense * std::atan2(cross(from, to), from.dot(to));
  };
  const double from = turned(place_at(path, 0).point);
  const auto* arc = std::get_if<Arc>(&path);
  const double sweep = arc != nullptr ? sense * arc->sweep : turned(place_at(path, 1).point) - from;
  // Behind half a turn the angle has come round.
  const double begin =
      from < -std::numbers::pi / 2 && -from + std::abs(programmed.sweep) > 1.5 * std::numbers::pi
          ? from + 2 * std::numbers::pi
          : from;
  return {.from = begin * radius, .to = (begin + sweep) * radius};
}

// Of two arcs about one centre.
Stretch beside_arc(const Piece& programmed, const Piece& path, double required) {
  if (std::abs(std::abs(path.radius() - programmed.radius()) - required) > most_apart) return {};
  return beside(std::get<Arc>(segment_of(programmed)), segment_of(path));
}

// Nothing where it is not that far from it.
Stretch beside(const Segment& programmed, const Segment& path, double required) {
  const Point middle = place_at(path, 0.5).point;
  const double apart = (nearest_point(programmed, middle) - middle).norm();
  if (std::abs(apart - required) > most_apart) return {};
  return std::visit([&](const auto& shape) { return beside(shape, path); }, programmed);
}

// The same of two lines, by the middle of what lies beside the wall: at a mitre the path reaches
// far beyond its end.
Stretch beside(const Piece& programmed, const Piece& path, double required) {
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

}  // namespace

Stretch touched(const Piece& programmed, const Stretch& within, const Piece& path,
                double required) {
  if (programmed.is_arc() && std::abs(programmed.radius() - required) <= most_apart &&
      (path.start - programmed.center).norm() <= most_apart)
    return within;
  if (path.is_point() || programmed.is_point()) return {};
  Stretch stretch;
  if (!programmed.is_arc() && !path.is_arc())
    stretch = beside(programmed, path, required);
  else if (programmed.is_arc() && path.is_arc() && programmed.center == path.center)
    stretch = beside_arc(programmed, path, required);
  else
    stretch = beside(segment_of(programmed), segment_of(path), required);
  return {.from = std::max(stretch.from, within.from), .to = std::min(stretch.to, within.to)};
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
