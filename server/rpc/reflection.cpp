#include "server/rpc/reflection.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include <array>
#include <set>
#include <string>
#include <vector>

#include "grpc/health/v1/health.grpc.pb.h"
#include "grpc/reflection/v1/reflection.grpc.pb.h"
#include "grpc/reflection/v1alpha/reflection.grpc.pb.h"
#include "server/rpc/start_stream.h"
#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::server {
namespace {

namespace v1alpha = grpc::reflection::v1alpha;
using google::protobuf::DescriptorPool;
using google::protobuf::FieldDescriptor;
using google::protobuf::FileDescriptor;

const DescriptorPool& known() { return *DescriptorPool::generated_pool(); }

// The answer to one request; both versions of the protocol have equal messages.
template <class Request, class Response>
class Reply {
 public:
  explicit Reply(Response& response) : response_(response) {}

  void to(const Request& request) {
    response_.set_valid_host(request.host());
    *response_.mutable_original_request() = request;
    switch (request.message_request_case()) {
      case Request::kFileByFilename:
        return file(known().FindFileByName(request.file_by_filename()));
      case Request::kFileContainingSymbol:
        return file(known().FindFileContainingSymbol(request.file_containing_symbol()));
      case Request::kFileContainingExtension:
        return extension(request.file_containing_extension());
      case Request::kAllExtensionNumbersOfType:
        return extensions_of(request.all_extension_numbers_of_type());
      case Request::kListServices:
        return services();
      default:
        return fault(grpc::StatusCode::INVALID_ARGUMENT, "the request asks for nothing known");
    }
  }

 private:
  void fault(grpc::StatusCode code, const char* message) {
    response_.mutable_error_response()->set_error_code(code);
    response_.mutable_error_response()->set_error_message(message);
  }

  // The file and all it depends on, each file once.
  void file(const FileDescriptor* file) {
    if (file == nullptr) return fault(grpc::StatusCode::NOT_FOUND, "there is no such file");
    std::set<const FileDescriptor*> seen{file};
    std::vector<const FileDescriptor*> left{file};
    while (!left.empty()) {
      const FileDescriptor* const next = left.back();
      left.pop_back();
      google::protobuf::FileDescriptorProto text;
      next->CopyTo(&text);
      response_.mutable_file_descriptor_response()->add_file_descriptor_proto(
          text.SerializeAsString());
      for (int i = 0; i < next->dependency_count(); ++i)
        if (seen.insert(next->dependency(i)).second) left.push_back(next->dependency(i));
    }
  }

  template <class Extension>
  void extension(const Extension& asked) {
    const auto* type = known().FindMessageTypeByName(asked.containing_type());
    const FieldDescriptor* const field =
        type == nullptr ? nullptr : known().FindExtensionByNumber(type, asked.extension_number());
    file(field == nullptr ? nullptr : field->file());
  }

  void extensions_of(const std::string& name) {
    const auto* type = known().FindMessageTypeByName(name);
    if (type == nullptr) return fault(grpc::StatusCode::NOT_FOUND, "there is no such type");
    auto& answer = *response_.mutable_all_extension_numbers_response();
    answer.set_base_type_name(name);
    std::vector<const FieldDescriptor*> fields;
    known().FindAllExtensions(type, &fields);
    for (const FieldDescriptor* field : fields) answer.add_extension_number(field->number());
  }

  void services() {
    for (const char* name :
         {v1::TrcService::service_full_name(), grpc::health::v1::Health::service_full_name(),
          grpc::reflection::v1::ServerReflection::service_full_name(),
          v1alpha::ServerReflection::service_full_name()})
      response_.mutable_list_services_response()->add_service()->set_name(name);
  }

  Response& response_;
};

template <class Request, class Response>
class ReflectionStream final : public StreamWork<Request, Response> {
 public:
  explicit ReflectionStream(const StreamContext& /*stream*/) {}

  Turn take(const Request& request, Response& response) override {
    response.Clear();
    Reply<Request, Response>(response).to(request);
    return {.write = true, .next = Turn::Next::read};
  }
  Turn proceed(Response& /*response*/) override { return {.write = false}; }
  Turn ended(Response& /*response*/) override { return end({}); }
};

// The service of one version of the protocol.
template <class Service, class Request, class Response>
class ReflectionService final : public Service::template WithRawCallbackMethod_ServerReflectionInfo<
                                    typename Service::Service> {
 public:
  explicit ReflectionService(Backend& backend) : backend_(backend) {}

  grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>* ServerReflectionInfo(
      grpc::CallbackServerContext* context) override {
    using Work = ReflectionStream<Request, Response>;
    return start_stream<Work, BidiReactor<Request, Response>>(backend_, *context,
                                                              Method::reflection);
  }

 private:
  Backend& backend_;
};

}  // namespace

struct Reflection::Services {
  explicit Services(Backend& backend) : current(backend), alpha(backend) {}

  ReflectionService<grpc::reflection::v1::ServerReflection,
                    grpc::reflection::v1::ServerReflectionRequest,
                    grpc::reflection::v1::ServerReflectionResponse>
      current;
  ReflectionService<v1alpha::ServerReflection, v1alpha::ServerReflectionRequest,
                    v1alpha::ServerReflectionResponse>
      alpha;
};

Reflection::Reflection(Backend& backend) : services_(std::make_unique<Services>(backend)) {
  // The service can only be described if its descriptor is linked into the program.
  grpc::health::v1::HealthCheckRequest::descriptor();
}

Reflection::~Reflection() = default;

void Reflection::add_to(grpc::ServerBuilder& builder) {
  builder.RegisterService(&services_->current);
  builder.RegisterService(&services_->alpha);
}

}  // namespace trc::server
