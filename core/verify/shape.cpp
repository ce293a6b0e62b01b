#include "core/verify/shape.h"

#include <array>
#include <cmath>
#include <numbers>

namespace trc::verify {
namespace {

using std::numbers::pi;

Point on_arc(const Arc& arc, double share) {
  if (share >= 1) return arc.end;
  if (share <= 0) return arc.start;
  const double angle = arc.sweep * share;
  const Vector from = arc.start - arc.center;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return arc.center + Vector(c * from.x() - s * from.y(), s * from.x() + c * from.y());
}

// Whether the arc passes `angle` (rad, as atan2 gives it) on its way.
bool passes(const Arc& arc, double angle) {
  const Vector from = arc.start - arc.center;
  double turned = angle - std::atan2(from.y(), from.x());
  if (arc.sweep < 0) turned = -turned;
  turned = std::fmod(turned, 2 * pi);
  if (turned < 0) turned += 2 * pi;
  return turned <= std::abs(arc.sweep);
}

}  // namespace

void Bounds::add(const Point& point) {
  low = empty ? point : Point(low.cwiseMin(point));
  high = empty ? point : Point(high.cwiseMax(point));
  empty = false;
}

void Bounds::add(const Segment& segment) {
  std::visit(
      [this](const auto& shape) {
        add(shape.start);
        add(shape.end);
      },
      segment);
  const auto* arc = std::get_if<Arc>(&segment);
  if (!arc) return;
  const double radius = (arc->start - arc->center).norm();
  const std::array<Vector, 4> quadrants{Vector::UnitX(), Vector::UnitY(), -Vector::UnitX(),
                                        -Vector::UnitY()};
  for (const Vector& quadrant : quadrants)
    if (passes(*arc, std::atan2(quadrant.y(), quadrant.x())))
      add(Point(arc->center + radius * quadrant));
}

double extent_of(const Segment& segment) {
  return std::visit(overloaded{[](const Line& line) { return (line.end - line.start).norm(); },
                               [](const Arc& arc) {
                                 return (arc.start - arc.center).norm() * std::abs(arc.sweep);
                               }},
                    segment);
}

Place place_at(const Segment& segment, double share) {
  return std::visit(
      overloaded{[share](const Line& line) {
                   return Place{.point = line.start + share * (line.end - line.start),
                                .direction = (line.end - line.start).normalized()};
                 },
                 [share](const Arc& arc) {
                   const Point point = on_arc(arc, share);
                   const Vector out = (point - arc.center).normalized();
                   return Place{.point = point,
                                .direction = arc.sweep < 0 ? Vector(-left_of(out)) : left_of(out)};
                 }},
      segment);
}

bool is_finite(const Segment& segment) {
  // 0 times a finite number is 0; 0 times anything else is not.
  const auto nothing = [](const Point& point) { return 0 * point.x() + 0 * point.y(); };
  return std::visit(
      overloaded{
          [&](const Line& line) { return nothing(line.start) + nothing(line.end) == 0; },
          [&](const Arc& arc) {
            return nothing(arc.start) + nothing(arc.end) + nothing(arc.center) + 0 * arc.sweep == 0;
          }},
      segment);
}

}  // namespace trc::verify
