#pragma once

#include <google/protobuf/struct.pb.h>

#include <string>

namespace trc::wire {

// The canonical form of RFC 8785 (JSON Canonicalization Scheme): members in the order of their
// names as UTF-16, no white space, numbers as ECMAScript prints them. Equal JSON has equal bytes,
// however it was laid out. Numbers must be finite.
[[nodiscard]] std::string canonical_json(const google::protobuf::Struct& object);

}  // namespace trc::wire
