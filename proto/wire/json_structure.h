#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>

namespace trc::wire {

// What Protobuf would take another way than it is meant, as a sentence with its field, as in
// "setup.tool_radius: is given more than once"; empty where there is nothing, or where the text is
// no such JSON. Of two values of a field it takes the last, and puts two objects or lists together;
// null in a list it leaves out, and of a list within a list it makes one. Of a number in quotes it
// reads what stands before \u0000 alone, and 0x10 as 16. It also takes names without quotes and a
// comma after the last value, which are no JSON. Both names of a field, tool_radius and
// toolRadius, are one; the names in a map are what they are.
[[nodiscard]] std::string fault_of_structure(std::string_view json,
                                             const google::protobuf::Descriptor& type);

}  // namespace trc::wire
