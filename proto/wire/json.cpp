#include "proto/wire/json.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/type_resolver.h>
#include <google/protobuf/util/type_resolver_util.h>

#include "core/base/check.h"
#include "proto/wire/json_fault.h"
#include "proto/wire/json_structure.h"

namespace trc::wire {
namespace {

constexpr const char* url_prefix = "type.googleapis.com";

std::string type_url(const google::protobuf::Message& message) {
  return std::string(url_prefix) + "/" + message.GetDescriptor()->full_name();
}

}  // namespace

Json::Json()
    : types_(google::protobuf::util::NewTypeResolverForDescriptorPool(
          url_prefix, google::protobuf::DescriptorPool::generated_pool())) {}

Json::~Json() = default;

void Json::append(const google::protobuf::Message& message, std::string& out) {
  // MessageToJsonString serialises maps in the order of their hash table, which changes from run to
  // run. So its two steps are done here.
  binary_.clear();
  {
    google::protobuf::io::StringOutputStream stream(&binary_);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    message.SerializeToCodedStream(&coded);
  }
  json_.clear();
  const auto status =
      google::protobuf::util::BinaryToJsonString(types_.get(), type_url(message), binary_, &json_);
  check(status.ok(), "a message is printable as JSON");
  out.append(json_);
}

std::string Json::read(std::string_view text, google::protobuf::Message& message) {
  if (std::string fault = fault_of_structure(text, *message.GetDescriptor()); !fault.empty())
    return fault;
  binary_.clear();
  const auto status = google::protobuf::util::JsonToBinaryString(types_.get(), type_url(message),
                                                                 std::string(text), &binary_);
  if (!status.ok())
    return json_fault({status.message().data(), status.message().size()}, text,
                      *message.GetDescriptor());
  return message.ParseFromString(binary_) ? "" : "is no " + message.GetDescriptor()->name();
}

std::string json_of(const google::protobuf::Message& message) {
  std::string text;
  Json().append(message, text);
  return text;
}

}  // namespace trc::wire
