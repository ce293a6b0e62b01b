#pragma once

#include <cmath>
#include <numbers>

#include "core/geometry/intersect.h"
#include "core/geometry/segment.h"

namespace trc {

// A segment with the values that every question about places on it needs.
class Track {
 public:
  explicit Track(const Segment& segment) {
    start_ = start_of(segment);
    if (const auto* arc = std::get_if<Arc>(&segment)) {
      circle_ = {.center = arc->center, .radius = radius_of(*arc)};
      // Without radius it stands in one point, as a line without length does.
      circular_ = circle_.radius > 0;
      counter_clockwise_ = arc->sweep > 0;
      length_ = std::abs(arc->sweep) * circle_.radius;
      return;
    }
    const auto& line = std::get<Line>(segment);
    const Vector way = line.end - line.start;
    length_ = way.norm();
    direction_ = length_ > 0 ? Vector(way / length_) : Vector::UnitX();
  }

  [[nodiscard]] double length() const { return length_; }
  // 0 of a line.
  [[nodiscard]] double radius() const { return circular_ ? circle_.radius : 0; }
  [[nodiscard]] double curvature() const { return circular_ ? 1 / circle_.radius : 0; }

  [[nodiscard]] Point at(double way) const {
    if (!circular_) return start_ + way * direction_;
    return circle_.center + turned(start_ - circle_.center, way);
  }

  [[nodiscard]] Vector tangent_at(double way) const { return pose_at(way).tangent; }

  // A place and the direction of travel there, computed from one rotation.
  struct Pose {
    Point point;
    Vector tangent;
  };
  [[nodiscard]] Pose pose_at(double way) const {
    if (!circular_) return {start_ + way * direction_, direction_};
    const Vector radial = turned(start_ - circle_.center, way);
    const Vector aside = left_of(radial) / circle_.radius;
    return {circle_.center + radial, counter_clockwise_ ? aside : Vector(-aside)};
  }

  // The point of the unbounded curve that is nearest to another one: at(way_to(point)), without
  // the way.
  [[nodiscard]] Point foot_of(const Point& point) const {
    if (!circular_) return start_ + (point - start_).dot(direction_) * direction_;
    return circle_.center + circle_.radius * directed(point - circle_.center).unit;
  }

  // Of a point on the unbounded curve; up to `slack` behind the start it is negative.
  [[nodiscard]] double way_to(const Point& point, double slack) const {
    if (!circular_) return (point - start_).dot(direction_);
    double angle = turn_between(start_ - circle_.center, point - circle_.center);
    if (!counter_clockwise_) angle = -angle;
    if (angle * circle_.radius < -slack) angle += 2 * std::numbers::pi;
    return angle * circle_.radius;
  }

  [[nodiscard]] Meetings meetings_with(const StraightLine& line) const {
    return circular_ ? intersect(line, circle_, 0) : intersect(straight(), line);
  }
  [[nodiscard]] Meetings meetings_with(const Circle& circle) const {
    return circular_ ? intersect(circle_, circle, 0) : intersect(straight(), circle, 0);
  }
  [[nodiscard]] Meetings meetings_with(const Track& other) const {
    return other.circular_ ? meetings_with(other.circle_) : meetings_with(other.straight());
  }

 private:
  [[nodiscard]] StraightLine straight() const { return {.point = start_, .direction = direction_}; }

  [[nodiscard]] Vector turned(const Vector& radial, double way) const {
    const double angle = (counter_clockwise_ ? way : -way) / circle_.radius;
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    return {cosine * radial.x() - sine * radial.y(), sine * radial.x() + cosine * radial.y()};
  }

  bool circular_ = false;
  bool counter_clockwise_ = false;
  Point start_ = Point::Zero();
  Vector direction_ = Vector::UnitX();
  Circle circle_{};
  double length_ = 0;
};

}  // namespace trc
