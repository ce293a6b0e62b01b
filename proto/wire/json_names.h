#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>

namespace trc::wire {

// The field of a message of this type that JSON names twice, as in "setup.tool_radius"; empty
// where there is none, or where the text is no such JSON. Protobuf takes the last of two values,
// and puts two objects or lists together. Both names of a field, tool_radius and toolRadius, are
// one; the names in a map are what they are.
[[nodiscard]] std::string repeated_field(std::string_view json,
                                         const google::protobuf::Descriptor& type);

}  // namespace trc::wire
