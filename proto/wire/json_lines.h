#pragma once

#include <memory>
#include <string>

#include "trc/v1/path_item.pb.h"

namespace google::protobuf::util {
class TypeResolver;
}

namespace trc::wire {

// Path items as JSON lines: the protobuf JSON mapping, one object a line. Numbers
// read back to the same double, keys stand in the order of their fields, the
// values of a diagnostic in the order of their names. The same item gives the
// same bytes.
class JsonLines {
 public:
  JsonLines();
  ~JsonLines();
  JsonLines(const JsonLines&) = delete;
  JsonLines& operator=(const JsonLines&) = delete;

  // Appends the item and a line feed.
  void append(const v1::PathItem& item, std::string& out);

 private:
  std::unique_ptr<google::protobuf::util::TypeResolver> types_;
  std::string type_url_;
  std::string binary_;
  std::string json_;
};

}  // namespace trc::wire
