#pragma once

#include <google/protobuf/message.h>

#include <optional>
#include <string>

namespace trc::wire {

// A field of a message that has no such field here: the sender was built from a newer schema, or
// what it sent is something else.
struct UnknownField {
  std::string place{};    // of the message that holds it, "batch.blocks[3].linear.end"
  std::string message{};  // the type of that message, "trc.v1.Position"
  int number = 0;
};

// The first one in a request, at any depth, in the order of the fields (D-164). Takes a few
// nanoseconds for each block of a batch. Maps are not looked into: their entries hold values alone.
[[nodiscard]] std::optional<UnknownField> unknown_field_in(
    const google::protobuf::Message& request);

}  // namespace trc::wire
