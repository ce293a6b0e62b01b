#pragma once

#include "core/geometry/plane.h"
#include "core/geometry/segment.h"
#include "trc/v1/http.pb.h"

namespace trc::server::http {

[[nodiscard]] inline Plane plane_of(v1::Plane plane) {
  if (plane == v1::PLANE_ZX) return Plane::zx;
  return plane == v1::PLANE_YZ ? Plane::yz : Plane::xy;
}

[[nodiscard]] inline v1::Plane message_of(Plane plane) {
  if (plane == Plane::zx) return v1::PLANE_ZX;
  return plane == Plane::yz ? v1::PLANE_YZ : v1::PLANE_XY;
}

// `third`: across the plane, mm.
[[nodiscard]] inline v1::Position message_of(Plane plane, const Point& point, double third) {
  const Position position = from_plane(plane, point, third);
  v1::Position message;
  message.set_x(position[0]);
  message.set_y(position[1]);
  message.set_z(position[2]);
  return message;
}

inline void set(v1::PlanePoint& message, const Point& point) {
  message.set_x(point.x());
  message.set_y(point.y());
}

}  // namespace trc::server::http
