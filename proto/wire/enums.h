#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "proto/wire/field_fault.h"

namespace trc::wire {

// The pairs of a protobuf enum and ours. The zero value of the message means
// "not given".
template <class Message, class Native, std::size_t size>
struct EnumTable {
  struct Row {
    Message message;
    Native native;
  };
  Row rows[size];

  // Nothing for the zero value; a number outside the enum is a fault.
  [[nodiscard]] std::optional<Native> from_proto(Message value, const FieldPath& path,
                                                 FieldFaults& faults) const {
    for (const Row& row : rows)
      if (row.message == value) return row.native;
    if (static_cast<int>(value) != 0)
      add_fault(path, "is " + std::to_string(static_cast<int>(value)) + ", which the enum has not",
                faults);
    return std::nullopt;
  }

  [[nodiscard]] constexpr Message to_proto(Native value) const {
    // Most tables have their rows in the order of the native values.
    const auto place = static_cast<std::size_t>(value);
    if (place < size && rows[place].native == value) return rows[place].message;
    for (const Row& row : rows)
      if (row.native == value) return row.message;
    return {};
  }
};

}  // namespace trc::wire
