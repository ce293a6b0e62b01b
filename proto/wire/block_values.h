#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "core/base/tolerances.h"
#include "proto/wire/field_fault.h"

namespace trc::wire {

// The ranges that blocks and columns share. Each check adds a fault to the named field.

inline bool is_coordinate(double value) {
  constexpr double largest = Tolerances{}.largest_coordinate;
  return value >= -largest && value <= largest;
}
// mm, |value| at most 1e6.
inline bool check_coordinate(double value, const FieldPath& path, FieldFaults& faults) {
  constexpr double largest = Tolerances{}.largest_coordinate;
  return check_range(value, {-largest, largest, "mm"}, path, faults);
}
// mm/min, above 0 to 1e9.
inline bool check_feed(double value, const FieldPath& path, FieldFaults& faults) {
  return check_above(value, {0, 1e9, "mm/min"}, path, faults);
}
// At most 65536 bytes without control characters: these would break the lines of
// an NC output.
bool check_text(const std::string& text, const FieldPath& path, FieldFaults& faults);
inline bool is_number(std::uint64_t number) {
  return number <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
}
// An N number that fits a Source.
bool check_number(std::uint64_t number, const FieldPath& path, FieldFaults& faults);

}  // namespace trc::wire
