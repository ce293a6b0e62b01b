#include "client/trc/connection.h"

#include <grpcpp/grpcpp.h>

#include <fstream>
#include <sstream>
#include <utility>

#include "grpc/health/v1/health.grpc.pb.h"
#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::client {
namespace {

// Empty for no file.
std::optional<Failure> read_file(const std::string& path, std::string& content) {
  if (path.empty()) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file && text << file.rdbuf()) {
    content = text.str();
    return std::nullopt;
  }
  return Failure{
      .status = "INVALID_ARGUMENT", .message = "cannot read " + path, .reason = "FILE_UNREADABLE"};
}

grpc::ChannelArguments channel_arguments() {
  constexpr int keepalive_ms = 30'000;
  constexpr int keepalive_timeout_ms = 10'000;
  grpc::ChannelArguments arguments;
  // A frozen or unplugged server is noticed after the sum of the two.
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, keepalive_ms);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, keepalive_timeout_ms);
  return arguments;
}

std::chrono::system_clock::time_point after(std::chrono::milliseconds timeout) {
  return std::chrono::system_clock::now() + timeout;
}

}  // namespace

std::optional<Failure> Connection::open(const std::string& address, const TlsFiles& tls,
                                        std::optional<Connection>& connection) {
  std::shared_ptr<grpc::ChannelCredentials> credentials = grpc::InsecureChannelCredentials();
  if (!tls.ca.empty() || !tls.cert.empty() || !tls.key.empty()) {
    if (tls.cert.empty() != tls.key.empty())
      return Failure{.status = "INVALID_ARGUMENT",
                     .message = "a client certificate and its key belong together",
                     .reason = "TLS_FILES_INCOMPLETE"};
    grpc::SslCredentialsOptions options;
    if (auto failure = read_file(tls.ca, options.pem_root_certs)) return failure;
    if (auto failure = read_file(tls.cert, options.pem_cert_chain)) return failure;
    if (auto failure = read_file(tls.key, options.pem_private_key)) return failure;
    credentials = grpc::SslCredentials(options);
  }
  connection.emplace(grpc::CreateCustomChannel(address, credentials, channel_arguments()));
  return std::nullopt;
}

std::optional<Failure> Connection::server_info(std::chrono::milliseconds timeout,
                                               v1::GetServerInfoResponse& info) const {
  grpc::ClientContext context;
  context.set_deadline(after(timeout));
  return failure_of(v1::TrcService::NewStub(channel_)->GetServerInfo(&context, {}, &info));
}

std::optional<Failure> Connection::health(std::chrono::milliseconds timeout, bool& serving) const {
  grpc::ClientContext context;
  context.set_deadline(after(timeout));
  grpc::health::v1::HealthCheckRequest request;
  request.set_service(v1::TrcService::service_full_name());
  grpc::health::v1::HealthCheckResponse response;
  const grpc::Status status =
      grpc::health::v1::Health::NewStub(channel_)->Check(&context, request, &response);
  serving = status.ok() && response.status() == grpc::health::v1::HealthCheckResponse::SERVING;
  return failure_of(status);
}

}  // namespace trc::client
