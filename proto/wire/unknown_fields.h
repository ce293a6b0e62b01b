#pragma once

#include <google/protobuf/io/zero_copy_stream.h>
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
// nanoseconds for each block of a batch. Maps are not looked into, see below.
[[nodiscard]] std::optional<UnknownField> unknown_field_in(
    const google::protobuf::Message& request);

// Whether messages of this type have maps, at any depth.
[[nodiscard]] bool holds_maps(const google::protobuf::Descriptor& type);

// The first unknown field in the entries of the maps of a request of this type, which Protobuf
// drops while it parses: such a field is only seen in the bytes. Also a key or a value that has the
// wire type of another kind of field, so that Protobuf would take 0 for it.
[[nodiscard]] std::optional<UnknownField> unknown_field_of_maps(
    google::protobuf::io::ZeroCopyInputStream& bytes, const google::protobuf::Descriptor& type);

}  // namespace trc::wire
