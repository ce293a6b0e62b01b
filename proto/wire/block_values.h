#pragma once

#include <cstdint>
#include <string>

#include "proto/wire/field_fault.h"

namespace trc::wire {

// The ranges that blocks and columns share. Each adds a fault to the named field.

// mm, |value| at most 1e6.
bool check_coordinate(double value, const FieldPath& path, FieldFaults& faults);
// mm/min, above 0 to 1e9.
bool check_feed(double value, const FieldPath& path, FieldFaults& faults);
// At most 65536 bytes without control characters: these would break the lines of
// an NC output.
bool check_text(const std::string& text, const FieldPath& path, FieldFaults& faults);
// An N number that fits a Source.
bool check_number(std::uint64_t number, const FieldPath& path, FieldFaults& faults);

}  // namespace trc::wire
