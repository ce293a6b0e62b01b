#include "proto/wire/json_lines.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/type_resolver.h>
#include <google/protobuf/util/type_resolver_util.h>

#include "core/base/check.h"

namespace trc::wire {
namespace {

constexpr const char* url_prefix = "type.googleapis.com";

}  // namespace

JsonLines::JsonLines()
    : types_(google::protobuf::util::NewTypeResolverForDescriptorPool(
          url_prefix, v1::PathItem::descriptor()->file()->pool())),
      type_url_(std::string(url_prefix) + "/" + v1::PathItem::descriptor()->full_name()) {}

JsonLines::~JsonLines() = default;

void JsonLines::append(const v1::PathItem& item, std::string& out) {
  // MessageToJsonString serialises maps in the order of their hash table, which
  // changes from run to run; therefore the two steps it takes are taken here.
  binary_.clear();
  {
    google::protobuf::io::StringOutputStream stream(&binary_);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    item.SerializeToCodedStream(&coded);
  }
  json_.clear();
  const auto status =
      google::protobuf::util::BinaryToJsonString(types_.get(), type_url_, binary_, &json_);
  check(status.ok(), "a path item is printable as JSON");
  out.append(json_).push_back('\n');
}

}  // namespace trc::wire
