#include "server/server.h"

#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/resource_quota.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <string_view>
#include <utility>

#include "grpc/health/v1/health.pb.h"
#include "server/credentials.h"

namespace trc::server {
namespace {

constexpr std::string_view unix_prefix = "unix:";
// gRPC waits for its own end so long; by then no stream is open.
constexpr auto shutdown_grace = std::chrono::milliseconds(100);

// gRPC replaces a socket file even while another server listens at it, and takes over its clients
// without a word. So somebody who answers there is a fault.
bool somebody_listens_at(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof(address.sun_path)) return false;
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  const int probe = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (probe < 0) return false;
  const bool answered =
      connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  close(probe);
  return answered;
}

int milliseconds(std::uint32_t seconds) { return static_cast<int>(seconds) * 1000; }

void set_limits(grpc::ServerBuilder& builder, const Config& config) {
  builder.SetMaxReceiveMessageSize(static_cast<int>(config.max_message_bytes));
  builder.SetMaxSendMessageSize(-1);
  builder.SetResourceQuota(
      grpc::ResourceQuota("trcd").Resize(std::size_t{config.max_grpc_buffer_mib} << 20U));
  const auto set = [&](const char* name, int value) { builder.AddChannelArgument(name, value); };
  // A second server on a taken port would otherwise start and steal half of the connections.
  set(GRPC_ARG_ALLOW_REUSEPORT, 0);
  set(GRPC_ARG_MAX_CONCURRENT_STREAMS, static_cast<int>(config.max_streams_per_connection));
  set(GRPC_ARG_KEEPALIVE_TIME_MS, milliseconds(config.keepalive_time_s));
  set(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, milliseconds(config.keepalive_timeout_s));
  set(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  set(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  set(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS,
      milliseconds(config.min_client_ping_interval_s));
}

}  // namespace

Server::Start Server::start(const Config& config) {
  ResumeKey key = resume_key(config.resume_key_file);
  if (!key.fault.empty()) return {.server = nullptr, .fault = std::move(key.fault)};
  std::unique_ptr<Server> server(new Server(config, std::move(key.key)));
  std::string fault = server->open(true);
  if (!fault.empty()) return {.server = nullptr, .fault = std::move(fault)};
  return {.server = std::move(server), .fault = {}};
}

std::unique_ptr<Server> Server::start_in_process(const Config& config) {
  std::unique_ptr<Server> server(new Server(config, resume_key({}).key));
  return server->open(false).empty() ? std::move(server) : nullptr;
}

Server::Server(const Config& config, std::string resume_key)
    : backend_(config, std::move(resume_key)) {}

Server::~Server() {
  backend_.streams.drain();
  stop_grpc();
}

std::string Server::open(bool with_addresses) {
  const Config& config = backend_.config;
  grpc::EnableDefaultHealthCheckService(true);
  if (config.reflection) {
    grpc::reflection::InitProtoReflectionServerBuilderPlugin();
    // Reflection lists the health service; it can describe it only with its descriptor linked in.
    grpc::health::v1::HealthCheckRequest::descriptor();
  }

  grpc::ServerBuilder builder;
  set_limits(builder, config);
  builder.RegisterService(&service_);
  if (with_addresses) {
    ports_.assign(config.listen.size(), 0);
    for (std::size_t i = 0; i < config.listen.size(); ++i) {
      const std::string& address = config.listen[i];
      if (!address.starts_with(unix_prefix)) {
        builder.AddListeningPort(address, tcp_credentials(config), &ports_[i]);
        continue;
      }
      if (somebody_listens_at(address.substr(unix_prefix.size())))
        return "cannot listen on " + address + ": another server answers there";
      builder.AddListeningPort(address, grpc::InsecureServerCredentials());
    }
  }
  grpc_ = builder.BuildAndStart();
  if (grpc_ == nullptr) {
    std::string addresses;
    for (const std::string& address : config.listen) addresses += " " + address;
    return "cannot listen on" + addresses + ": an address is in use or not of this machine";
  }

  if (with_addresses && !config.admin_listen.empty()) {
    admin_ = Admin::open(config.admin_listen,
                         {.metrics =
                              [this] {
                                backend_.refresh_gauges();
                                return backend_.telemetry.metrics.exposition();
                              },
                          .ready = [this] { return !backend_.streams.draining(); }});
    if (admin_ == nullptr) return "cannot listen on admin-listen " + config.admin_listen;
  }
  grpc_->GetHealthCheckService()->SetServingStatus(v1::TrcService::service_full_name(), true);
  return {};
}

std::shared_ptr<grpc::Channel> Server::in_process_channel() {
  return grpc_->InProcessChannel(grpc::ChannelArguments());
}

std::size_t Server::drain() {
  // The status of all services, which also tells those who watch.
  grpc_->GetHealthCheckService()->SetServingStatus(false);
  backend_.streams.drain();
  const auto timeout = std::chrono::seconds(backend_.config.drain_timeout_s);
  std::size_t cut_off = 0;
  if (!backend_.streams.wait_until_none(Clock::now() + timeout)) cut_off = backend_.streams.count();
  stop_grpc();
  return cut_off;
}

void Server::stop_grpc() {
  admin_.reset();
  if (grpc_ == nullptr) return;
  // Shutdown waits for idle clients as long as it is allowed to, so it is allowed little.
  grpc_->Shutdown(std::chrono::system_clock::now() + shutdown_grace);
  grpc_->Wait();
  grpc_.reset();
}

}  // namespace trc::server
