#include "server/http/connect.h"

#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/message.h>
#include <google/protobuf/struct.pb.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string_view>
#include <utility>

#include "core/base/language.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "proto/wire/json.h"
#include "proto/wire/unknown_fields.h"
#include "server/http/api.h"
#include "server/http/german.h"
#include "server/http/json_size.h"
#include "server/http/problem.h"
#include "server/http/settings.h"
#include "server/rpc/status.h"
#include "server/text.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server::http {
namespace {

using google::protobuf::Message;
using google::protobuf::MethodDescriptor;
using grpc::StatusCode;

constexpr std::string_view services = "/trc.v1.TrcService/";
constexpr std::size_t envelope_bytes = 5;
constexpr char end_of_stream = 0x02;

struct CodeRow {
  StatusCode code;
  std::string_view name;
  unsigned status;
};
// The error codes of the Connect protocol.
constexpr std::array<CodeRow, 16> codes{{
    {StatusCode::CANCELLED, "canceled", 499},
    {StatusCode::UNKNOWN, "unknown", 500},
    {StatusCode::INVALID_ARGUMENT, "invalid_argument", 400},
    {StatusCode::DEADLINE_EXCEEDED, "deadline_exceeded", 504},
    {StatusCode::NOT_FOUND, "not_found", 404},
    {StatusCode::ALREADY_EXISTS, "already_exists", 409},
    {StatusCode::PERMISSION_DENIED, "permission_denied", 403},
    {StatusCode::RESOURCE_EXHAUSTED, "resource_exhausted", 429},
    {StatusCode::FAILED_PRECONDITION, "failed_precondition", 400},
    {StatusCode::ABORTED, "aborted", 409},
    {StatusCode::OUT_OF_RANGE, "out_of_range", 400},
    {StatusCode::UNIMPLEMENTED, "unimplemented", 501},
    {StatusCode::INTERNAL, "internal", 500},
    {StatusCode::UNAVAILABLE, "unavailable", 503},
    {StatusCode::DATA_LOSS, "data_loss", 500},
    {StatusCode::UNAUTHENTICATED, "unauthenticated", 401},
}};

const CodeRow& row_of(StatusCode code) {
  for (const CodeRow& row : codes)
    if (row.code == code) return row;
  return codes[1];
}

// Base64 without padding, as the protocol wants it for details.
std::string base64(std::string_view bytes) {
  constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k <= count; ++k) text += letters[group >> (18 - 6 * k) & 63U];
  }
  return text;
}

// Adds the German text of a status, unless a program's error has brought its own.
void add_german(const grpc::Status& status, google::rpc::Status& rich) {
  for (const auto& any : rich.details())
    if (any.Is<google::rpc::LocalizedMessage>()) return;
  v1::Problem problem = problem_of(status);
  make_german(problem);
  google::rpc::LocalizedMessage localized;
  localized.set_locale("de");
  localized.set_message(problem.title() + ": " + problem.detail());
  rich.add_details()->PackFrom(localized);
}

google::protobuf::Struct error_of(const grpc::Status& status, Language language) {
  google::protobuf::Struct error;
  auto& fields = *error.mutable_fields();
  fields["code"].set_string_value(std::string(row_of(status.error_code()).name));
  fields["message"].set_string_value(presentable(status.error_message(), 4096));
  google::rpc::Status rich;
  if (!rich.ParseFromString(status.error_details()) || rich.details().empty()) {
    // The status is gRPC's own, for example of a deadline.
    google::rpc::ErrorInfo info;
    info.set_reason(std::string(name_of(status.error_code())));
    info.set_domain("trc.v1");
    rich.add_details()->PackFrom(info);
  }
  if (language == Language::german) add_german(status, rich);
  auto& details = *fields["details"].mutable_list_value();
  for (const auto& any : rich.details()) {
    auto& detail = *details.add_values()->mutable_struct_value()->mutable_fields();
    const std::string& url = any.type_url();
    detail["type"].set_string_value(url.substr(url.rfind('/') + 1));
    detail["value"].set_string_value(base64(any.value()));
  }
  return error;
}

void answer_error(Exchange& exchange, const grpc::Status& status) {
  const Language language = accepted_language(exchange.request().header("accept-language"));
  exchange.answer(
      {.status = row_of(status.error_code()).status, .content_type = "application/json"},
      wire::json_of(error_of(status, language)));
}

std::string enveloped(char flags, std::string_view message) {
  const auto size = static_cast<std::uint32_t>(message.size());
  std::string bytes{flags};
  for (const unsigned shift : {24U, 16U, 8U, 0U})
    bytes += static_cast<char>(static_cast<unsigned char>(size >> shift & 0xFFU));
  return bytes.append(message);
}

std::unique_ptr<Message> made(const google::protobuf::Descriptor& type) {
  return std::unique_ptr<Message>(
      google::protobuf::MessageFactory::generated_factory()->GetPrototype(&type)->New());
}

// Passes the answers of an RPC on as they are, or as JSON.
class ConnectFormat : public Format {
 public:
  ConnectFormat(const MethodDescriptor& method, bool as_json, Language language)
      : json_wanted_(as_json), language_(language), answer_(made(*method.output_type())) {}

 protected:
  bool append(const grpc::ByteBuffer& answer, std::string& out) {
    if (!json_wanted_) {
      out += RpcCall::text_of(answer);
      return true;
    }
    if (!RpcCall::read_message(answer, *answer_)) return false;
    json_.append(*answer_, out);
    return true;
  }
  [[nodiscard]] std::string type(std::string_view before) const {
    return std::string(before) + (json_wanted_ ? "json" : "proto");
  }
  [[nodiscard]] Language language() const { return language_; }

 private:
  bool json_wanted_;
  Language language_;
  std::unique_ptr<Message> answer_;
  wire::Json json_;
};

class UnaryFormat final : public ConnectFormat {
 public:
  using ConnectFormat::ConnectFormat;
  [[nodiscard]] Head head() const override { return {.content_type = type("application/")}; }
  bool take(const grpc::ByteBuffer& answer, std::string& out) override {
    return append(answer, out);
  }
  void close(std::string& /*out*/) override {}
  void refuse(const ExchangePointer& exchange, const grpc::Status& status) override {
    answer_error(*exchange, status);
  }
  bool stop(const grpc::Status& /*status*/, std::string& /*out*/) override { return false; }
  [[nodiscard]] bool streams() const override { return false; }
};

class StreamFormat final : public ConnectFormat {
 public:
  using ConnectFormat::ConnectFormat;
  [[nodiscard]] Head head() const override {
    return {.content_type = type("application/connect+")};
  }
  bool take(const grpc::ByteBuffer& answer, std::string& out) override {
    std::string message;
    if (!append(answer, message)) return false;
    out += enveloped(0, message);
    return true;
  }
  void close(std::string& out) override { out += enveloped(end_of_stream, "{}"); }
  // The HTTP status of a stream is always 200; the last envelope holds the error.
  void refuse(const ExchangePointer& exchange, const grpc::Status& status) override {
    std::string end;
    stop(status, end);
    exchange->answer(head(), std::move(end));
  }
  bool stop(const grpc::Status& status, std::string& out) override {
    google::protobuf::Struct end;
    *(*end.mutable_fields())["error"].mutable_struct_value() = error_of(status, language());
    out += enveloped(end_of_stream, wire::json_of(end));
    return true;
  }
};

// The requested RPC, its body, and the format of its answer.
struct Call {
  const MethodDescriptor& method;
  std::string_view body;
  bool is_json;
  std::string_view accept_language;
  std::shared_ptr<Format> format;
};

// The message in the body as bytes, or its fault.
struct Question {
  std::string bytes{};
  std::string fault{};
};

Question read_question(const Call& call) {
  Question question;
  const auto message = made(*call.method.input_type());
  if (call.is_json) {
    question.fault = wire::Json().read(call.body, *message);
  } else if (!message->ParseFromArray(call.body.data(), static_cast<int>(call.body.size()))) {
    question.fault = "it must be a " + call.method.input_type()->full_name();
  } else if (google::protobuf::io::ArrayInputStream bytes(call.body.data(),
                                                          static_cast<int>(call.body.size()));
             wire::unknown_field_of_maps(bytes, *call.method.input_type())) {
    // Written anew it would be lost, and the RPC could not refuse it.
    question.bytes = call.body;
    return question;
  }
  prefer_language(call.accept_language, *message);
  question.bytes = message->SerializeAsString();
  return question;
}

// The request of a stream is exactly one message.
bool open_envelope(std::string_view& body) {
  if (body.size() < envelope_bytes || body.front() != 0) return false;
  std::uint32_t size = 0;
  for (std::size_t i = 1; i < envelope_bytes; ++i)
    size = size << 8U | static_cast<unsigned char>(body[i]);
  body.remove_prefix(envelope_bytes);
  return body.size() == size;
}

void answer_unsupported(Exchange& exchange, std::string_view types) {
  answer_problem(exchange, problem(415, "CONTENT_TYPE", "The content type is not taken here",
                                   "this RPC takes " + std::string(types) + ", not compressed"));
}

// The fault of a call apart from its message; empty: none.
std::string fault_of(const Request& request) {
  if (!request.query.empty()) return "the call takes no query parameters, but a message";
  const std::string_view version = request.header("connect-protocol-version");
  if (!version.empty() && version != "1") return "Connect-Protocol-Version must be 1";
  std::optional<std::chrono::milliseconds> timeout;
  if (!read_timeout(request.header("connect-timeout-ms"), timeout))
    return "Connect-Timeout-Ms must be a whole number of at most ten digits";
  return {};
}

// Reading JSON costs computing time, so a worker does it.
void start(Api& api, const ExchangePointer& exchange, const Call& call) {
  api.compute([&api, exchange, call] {
    const auto refused = call.is_json ? refuse_size(call.body, api.backend().config) : std::nullopt;
    if (refused)
      return exchange->post(
          [exchange, call, status = refused->status] { call.format->refuse(exchange, status); });
    const Question question = read_question(call);
    exchange->post([&api, exchange, call, question] {
      if (!question.fault.empty())
        return call.format->refuse(
            exchange, refuse(call.is_json ? Refusal::json_unreadable : Refusal::request_unreadable,
                             question.fault)
                          .status);
      exchange->request().body = {};
      RpcExchange::start(
          api, exchange, "/" + call.method.service()->full_name() + "/" + call.method.name(),
          std::make_unique<PreparedQuestions>(std::vector{RpcCall::bytes_of(question.bytes)}),
          call.format);
    });
  });
}

}  // namespace

const MethodDescriptor* rpc_at(const std::string& path) {
  if (!path.starts_with(services)) return nullptr;
  const auto* service = v1::GetServerInfoResponse::descriptor()->file()->pool()->FindServiceByName(
      "trc.v1.TrcService");
  return service == nullptr ? nullptr : service->FindMethodByName(path.substr(services.size()));
}

bool read_timeout(std::string_view header, std::optional<std::chrono::milliseconds>& timeout) {
  constexpr std::size_t most_digits = 10;
  if (header.empty()) return true;
  std::uint64_t ms = 0;
  const auto [end, fault] = std::from_chars(header.data(), header.data() + header.size(), ms);
  const bool is_whole = fault == std::errc() && end == header.data() + header.size();
  if (!is_whole || header.size() > most_digits) return false;
  timeout = std::chrono::milliseconds(ms);
  return true;
}

void answer_connect(Api& api, const ExchangePointer& exchange) {
  const Request& request = exchange->request();
  const MethodDescriptor& method = *rpc_at(request.path);
  const std::string type = request.content_type();
  const std::string_view accept_language = request.header("accept-language");
  const Language language = accepted_language(accept_language);
  std::string_view body = request.body;
  if (method.client_streaming())
    return answer_error(*exchange, refuse(Refusal::stream_needs_grpc).status);
  if (!method.server_streaming()) {
    const bool takes_json = is_json(type);
    if (!takes_json && type != "application/proto")
      return answer_unsupported(*exchange, "application/json or application/proto");
    auto format = std::make_shared<UnaryFormat>(method, takes_json, language);
    if (const std::string fault = fault_of(request); !fault.empty())
      return format->refuse(exchange, refuse(Refusal::call_invalid, fault).status);
    return start(api, exchange, {method, body, takes_json, accept_language, std::move(format)});
  }
  const bool takes_json = type == "application/connect+json";
  if (!takes_json && type != "application/connect+proto")
    return answer_unsupported(*exchange, "application/connect+json or application/connect+proto");
  auto format = std::make_shared<StreamFormat>(method, takes_json, language);
  std::string fault = fault_of(request);
  if (fault.empty() && !open_envelope(body))
    fault = "the body must be one envelope without compression";
  if (!fault.empty()) return format->refuse(exchange, refuse(Refusal::call_invalid, fault).status);
  start(api, exchange, {method, body, takes_json, accept_language, std::move(format)});
}

}  // namespace trc::server::http
