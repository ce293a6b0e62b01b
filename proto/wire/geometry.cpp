#include "proto/wire/geometry.h"

#include "core/base/tolerances.h"
#include "proto/wire/enums.h"

namespace trc::wire {
namespace {

constexpr EnumTable<v1::Plane, Plane, 3> planes{{
    {v1::PLANE_XY, Plane::xy},
    {v1::PLANE_ZX, Plane::zx},
    {v1::PLANE_YZ, Plane::yz},
}};

bool check_coordinate(bool present, double value, std::string_view name, const FieldPath& path,
                      FieldFaults& faults) {
  constexpr double largest = Tolerances{}.largest_coordinate;
  return !present || check_range(value, {-largest, largest, "mm"}, FieldPath(path, name), faults);
}

}  // namespace

bool from_proto(const v1::Position& message, const FieldPath& path, OptionalPosition& position,
                FieldFaults& faults) {
  const bool x = check_coordinate(message.has_x(), message.x(), "x", path, faults);
  const bool y = check_coordinate(message.has_y(), message.y(), "y", path, faults);
  const bool z = check_coordinate(message.has_z(), message.z(), "z", path, faults);
  // A zero with a sign becomes one without: the answer would carry the sign on.
  constexpr double unsigned_zero = 0.0;
  position = {};
  if (message.has_x()) position[0] = message.x() + unsigned_zero;
  if (message.has_y()) position[1] = message.y() + unsigned_zero;
  if (message.has_z()) position[2] = message.z() + unsigned_zero;
  return x && y && z;
}

void to_proto(const OptionalPosition& position, v1::Position& message) {
  message.Clear();
  if (position[0]) message.set_x(*position[0]);
  if (position[1]) message.set_y(*position[1]);
  if (position[2]) message.set_z(*position[2]);
}

void to_proto(const Position& position, v1::Position& message) {
  message.set_x(position[0]);
  message.set_y(position[1]);
  message.set_z(position[2]);
}

std::optional<Plane> from_proto(v1::Plane plane, const FieldPath& path, FieldFaults& faults) {
  return planes.from_proto(plane, path, faults);
}

v1::Plane to_proto(Plane plane) { return planes.to_proto(plane); }

}  // namespace trc::wire
