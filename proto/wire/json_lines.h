#pragma once

#include <string>

#include "proto/wire/json.h"
#include "trc/v1/path_item.pb.h"

namespace trc::wire {

// Path items as JSON lines: the protobuf JSON mapping, one object a line. The same item gives the
// same bytes.
class JsonLines {
 public:
  // Appends the item and a line feed.
  void append(const v1::PathItem& item, std::string& out) {
    json_.append(item, out);
    out.push_back('\n');
  }

 private:
  Json json_;
};

}  // namespace trc::wire
