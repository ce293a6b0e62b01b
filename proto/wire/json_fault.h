#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>

namespace trc::wire {

// What protobuf says of JSON that it cannot read, as a sentence about the text: the field or the
// place, what stands there and what it takes. `type`: of the message that was to be read.
[[nodiscard]] std::string json_fault(std::string_view said, std::string_view text,
                                     const google::protobuf::Descriptor& type);

}  // namespace trc::wire
