#pragma once

#include <array>
#include <optional>

#include "core/geometry/plane.h"
#include "proto/wire/field_fault.h"
#include "trc/v1/geometry.pb.h"

namespace trc::wire {

using OptionalPosition = std::array<std::optional<double>, 3>;

// Refuses coordinates that are not finite or beyond 1e6 mm.
bool from_proto(const v1::Position& message, const FieldPath& path, OptionalPosition& position,
                FieldFaults& faults);
void to_proto(const OptionalPosition& position, v1::Position& message);
void to_proto(const Position& position, v1::Position& message);

// Nothing for PLANE_UNSPECIFIED; a value outside the enum is a fault.
[[nodiscard]] std::optional<Plane> from_proto(v1::Plane plane, const FieldPath& path,
                                              FieldFaults& faults);
[[nodiscard]] v1::Plane to_proto(Plane plane);

}  // namespace trc::wire
