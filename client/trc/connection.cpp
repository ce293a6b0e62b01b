#include "client/trc/connection.h"

#include <grpcpp/grpcpp.h>

#include <fstream>
#include <utility>

#include "client/trc/target.h"
#include "grpc/health/v1/health.grpc.pb.h"
#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::client {
namespace {

constexpr std::chrono::seconds longest_connect{10};

// An empty path means no file.
std::optional<Failure> read_file(const std::string& path, std::string& content) {
  // The limit also ends the reading of a device.
  constexpr std::size_t most_bytes = std::size_t{4} << 20U;
  if (path.empty()) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  content.resize(file ? most_bytes + 1 : 0);
  file.read(content.data(), static_cast<std::streamsize>(content.size()));
  content.resize(static_cast<std::size_t>(file.gcount()));
  if (!content.empty() && content.size() <= most_bytes) return std::nullopt;
  return Failure{
      .status = "INVALID_ARGUMENT", .message = "cannot read " + path, .reason = "FILE_UNREADABLE"};
}

grpc::ChannelArguments channel_arguments(const ConnectionOptions& options,
                                         const std::string& service_config) {
  grpc::ChannelArguments arguments;
  if (!service_config.empty()) arguments.SetServiceConfigJSON(service_config);
  const auto set = [&](const char* name, std::chrono::milliseconds value) {
    arguments.SetInt(name, static_cast<int>(value.count()));
  };
  set(GRPC_ARG_KEEPALIVE_TIME_MS, options.keepalive_time);
  set(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, options.keepalive_timeout);
  // Pings continue while the stream is silent.
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  // With its defaults gRPC may wait two minutes before it tries an address again, and twenty
  // seconds for an address that does not answer.
  set(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, options.resume.first_wait);
  set(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, options.resume.longest_wait);
  set(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, options.resume.longest_wait);
  // Sessions restart by themselves. gRPC 1.51 retries a call that no server has seen; if the retry
  // also fails, gRPC forgets pending operations of the call, and their caller waits for ever.
  arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);
  if (options.separate) arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return arguments;
}

std::chrono::system_clock::time_point after(std::chrono::milliseconds timeout) {
  return std::chrono::system_clock::now() + timeout;
}

}  // namespace

std::optional<Failure> Connection::open(const std::string& address, const TlsFiles& tls,
                                        std::optional<Connection>& connection,
                                        const ConnectionOptions& options) {
  std::shared_ptr<grpc::ChannelCredentials> credentials = grpc::InsecureChannelCredentials();
  if (tls.any()) {
    if (tls.cert.empty() != tls.key.empty())
      return Failure{.status = "INVALID_ARGUMENT",
                     .message = "a client certificate and its key belong together",
                     .reason = "TLS_FILES_INCOMPLETE"};
    grpc::SslCredentialsOptions files;
    if (auto failure = read_file(tls.ca, files.pem_root_certs)) return failure;
    if (auto failure = read_file(tls.cert, files.pem_cert_chain)) return failure;
    if (auto failure = read_file(tls.key, files.pem_private_key)) return failure;
    credentials = grpc::SslCredentials(files);
  }
  Target target;
  if (auto failure = target_of(address, tls.any(), target)) return failure;
  connection.emplace(grpc::CreateCustomChannel(target.uri, credentials,
                                               channel_arguments(options, target.service_config)),
                     options.resume);
  connection->can_be_watched_ = true;
  return std::nullopt;
}

bool Connection::reach() const {
  if (!can_be_watched_) return false;
  const auto deadline = after(longest_connect);
  for (;;) {
    const grpc_connectivity_state state = channel_->GetState(true);
    if (state == GRPC_CHANNEL_READY) return true;
    if (state == GRPC_CHANNEL_TRANSIENT_FAILURE || state == GRPC_CHANNEL_SHUTDOWN) return false;
    if (!channel_->WaitForStateChange(state, deadline)) return false;
  }
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
