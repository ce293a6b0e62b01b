#pragma once

#include <google/protobuf/message.h>

#include <memory>
#include <string>
#include <string_view>

namespace google::protobuf::util {
class TypeResolver;
}

namespace trc::wire {

// The protobuf JSON mapping of the messages of this program. Numbers read back to the same double,
// keys stand in the order of their fields, those of maps in the order of their names: the same
// message gives the same bytes. An object may be used again and again, by one thread at a time.
class Json {
 public:
  Json();
  ~Json();
  Json(const Json&) = delete;
  Json& operator=(const Json&) = delete;

  // Appends one object without a line feed.
  void append(const google::protobuf::Message& message, std::string& out);
  // Replaces the message. Returns what is wrong with the text; empty when nothing is. Fields the
  // message does not have are wrong, and so are those that are given twice.
  [[nodiscard]] std::string read(std::string_view text, google::protobuf::Message& message);

 private:
  std::unique_ptr<google::protobuf::util::TypeResolver> types_;
  std::string binary_;
  std::string json_;
};

[[nodiscard]] std::string json_of(const google::protobuf::Message& message);

}  // namespace trc::wire
