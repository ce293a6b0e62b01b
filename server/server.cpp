#include "server/server.h"

#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/resource_quota.h>

#include <chrono>
#include <ctime>
#include <system_error>
#include <utility>

#include "server/net/address.h"
#include "server/net/credentials.h"
#include "server/resources/limits.h"

namespace trc::server {
namespace {

// gRPC waits this long for its own end; no stream is open by then.
constexpr auto shutdown_grace = std::chrono::milliseconds(100);
// Time to report the end to streams that are cut off; more would only help clients that do not
// read.
constexpr auto cut_off_grace = std::chrono::milliseconds(500);

int milliseconds(std::uint32_t seconds) { return static_cast<int>(seconds) * 1000; }

// Probes need very little memory, which is kept apart from that of streams: a full server still
// reports its health.
constexpr std::uint32_t health_buffer_mib = 8;
// Enough for the name of a service.
constexpr std::uint32_t health_message_bytes = 4096;
// gRPC itself refuses without details. If a message exceeds the limit by less than this, its stream
// refuses it with a reason. gRPC reads a whole message before it checks the size, so this takes no
// further memory.
constexpr std::uint32_t refused_message_bytes = 16U << 20U;
// gRPC serves all it has read of a connection, even if the connection is shut down meanwhile.
// Without this limit it reads megabytes at a time, with thousands of streams in them.
constexpr int most_read_bytes = 64 << 10;
// A gigabit link carries a megabyte in 8 ms.
constexpr int stream_window_bytes = 1 << 20;

void set_limits(grpc::ServerBuilder& builder, const Config& config, std::uint32_t message_bytes,
                std::uint32_t buffer_mib) {
  // gRPC inflates a message before it checks its size: a megabyte could become a gigabyte.
  for (const auto algorithm : {GRPC_COMPRESS_GZIP, GRPC_COMPRESS_DEFLATE})
    builder.SetCompressionAlgorithmSupportStatus(algorithm, false);
  builder.SetMaxReceiveMessageSize(static_cast<int>(message_bytes));
  builder.SetMaxSendMessageSize(-1);
  builder.SetResourceQuota(grpc::ResourceQuota().Resize(std::size_t{buffer_mib} << 20U));
  const auto set = [&](const char* name, int value) { builder.AddChannelArgument(name, value); };
  set(GRPC_ARG_MAX_CONCURRENT_STREAMS, static_cast<int>(config.max_streams_per_connection));
  set(GRPC_ARG_KEEPALIVE_TIME_MS, milliseconds(config.keepalive_time_s));
  set(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, milliseconds(config.keepalive_timeout_s));
  // Keepalive starts after the TLS handshake, so the handshake may take as long as a keepalive.
  set(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS,
      milliseconds(config.keepalive_time_s + config.keepalive_timeout_s));
  set(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  set(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  // The stream window limits the bytes that wait in gRPC for the turn of a stream. With its probe
  // of the network, gRPC would widen the window to more than a whole program.
  set(GRPC_ARG_HTTP2_BDP_PROBE, 0);
  set(GRPC_ARG_HTTP2_STREAM_LOOKAHEAD_BYTES, stream_window_bytes);
  set(GRPC_ARG_TCP_MAX_READ_CHUNK_SIZE, most_read_bytes);
  set(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS,
      milliseconds(config.min_client_ping_interval_s));
}

}  // namespace

Server::Start Server::start(const Config& settings) {
  Config config = settings;
  if (auto fault = fill_in_limits(config, memory_limit_bytes()))
    return {.server = nullptr, .fault = std::move(*fault), .misconfigured = true};
  ResumeKey key = resume_key(config.resume_key_file);
  if (!key.fault.empty())
    return {.server = nullptr, .fault = std::move(key.fault), .misconfigured = true};
  std::unique_ptr<Server> server;
  try {
    server.reset(new Server(config, std::move(key.key)));
  } catch (const std::system_error& why) {
    return {.server = nullptr, .fault = std::string("cannot start its threads: ") + why.what()};
  }
  std::string fault = server->read_certificates();
  if (!fault.empty()) return {.server = nullptr, .fault = std::move(fault), .misconfigured = true};
  fault = server->open(Callers::of_addresses);
  if (!fault.empty()) return {.server = nullptr, .fault = std::move(fault)};
  return {.server = std::move(server), .fault = {}};
}

std::unique_ptr<Server> Server::start_in_process(const Config& settings) {
  Config config = settings;
  if (fill_in_own_limits(config, memory_limit_bytes())) return nullptr;
  std::unique_ptr<Server> server(new Server(config, resume_key({}).key));
  return server->open(Callers::in_process).empty() ? std::move(server) : nullptr;
}

Server::Start Server::start_http(const Config& config, http::Offer offer) {
  std::unique_ptr<Server> server = start_in_process(config);
  if (server == nullptr) return {.server = nullptr, .fault = "gRPC did not start"};
  std::string fault = server->listen_for_http(std::move(offer));
  if (!fault.empty()) return {.server = nullptr, .fault = std::move(fault)};
  server->acceptor_.start();
  return {.server = std::move(server), .fault = {}};
}

Server::Server(const Config& config, std::string resume_key)
    : backend_(config, std::move(resume_key)) {}

Server::~Server() {
  backend_.streams.drain();
  stop_grpc();
}

std::string Server::read_certificates() {
  const Config& config = backend_.config;
  if (config.tls_cert_file.empty()) return {};
  certificates_ = std::make_shared<Certificates>(
      Certificates::Files{.chain = config.tls_cert_file,
                          .key = config.tls_key_file,
                          .client_authorities = config.tls_client_ca_file});
  std::string fault;
  if (certificates_->reload(fault) == Certificates::Reload::refused) return fault;
  const auto current = certificates_->current();
  backend_.telemetry.metrics.set_certificate_expiry(current->expires_s);
  if (current->begins_s > std::time(nullptr))
    backend_.telemetry.log.warning(
        LogLine("certificate_not_good_yet")
            .number("begins_s", static_cast<std::uint64_t>(current->begins_s)));
  return {};
}

std::string Server::open(Callers callers) {
  const Config& config = backend_.config;
  const bool has_addresses = callers == Callers::of_addresses;
  grpc::EnableDefaultHealthCheckService(true);
  grpc::ServerBuilder builder;
  set_limits(builder, config, config.max_message_bytes + refused_message_bytes,
             config.max_grpc_buffer_mib);
  builder.RegisterService(&service_);
  builder.RegisterCallbackGenericService(&unknown_rpc_);
  if (config.reflection) {
    reflection_ = std::make_unique<Reflection>(backend_);
    reflection_->add_to(builder);
  }
  grpc::ServerBuilder health_builder;
  set_limits(health_builder, config, health_message_bytes, health_buffer_mib);
  if (has_addresses) {
    for (const std::string& address : config.listen) {
      int port = 0;
      std::string fault =
          listen(builder, address, address.starts_with(unix_prefix) ? nullptr : certificates_,
                 Acceptor::Use::work, port);
      if (!fault.empty()) return fault;
      ports_.push_back(port);
    }
    if (!config.health_listen.empty()) {
      std::string fault = listen(health_builder, config.health_listen, nullptr,
                                 Acceptor::Use::health, health_port_);
      if (!fault.empty()) return fault;
    }
    if (!config.admin_listen.empty()) {
      admin_ = Admin::open(config.admin_listen, {.metrics = [this] { return exposition(); },
                                                 .unready = [this] { return readiness(); }});
      if (admin_ == nullptr) return "cannot listen on admin-listen " + config.admin_listen;
    }
  }
  // gRPC does not start a server that only has the built-in health service.
  health_builder.RegisterCallbackGenericService(&no_service_);
  grpc_ = builder.BuildAndStart();
  if (health_port_ > 0) health_ = health_builder.BuildAndStart();
  if (grpc_ == nullptr || (health_port_ > 0 && health_ == nullptr))
    return "gRPC did not start; its messages say why";
  if (has_addresses) {
    std::string fault = listen_for_http(std::nullopt);
    if (!fault.empty()) return fault;
  }
  set_serving(true);
  if (has_addresses) acceptor_.start();
  started_ = true;
  return {};
}

// gRPC receives connections, not addresses: see Acceptor.
std::string Server::listen(grpc::ServerBuilder& builder, const std::string& address,
                           const std::shared_ptr<const Certificates>& certificates,
                           Acceptor::Use use, int& port) {
  Listener::Opened opened = Listener::open(address);
  for (Listener& listener : opened.listeners) {
    port = listener.port();
    const std::shared_ptr<grpc::experimental::ExternalConnectionAcceptor> entrance =
        builder.experimental().AddExternalConnectionAcceptor(
            grpc::ServerBuilder::experimental_type::ExternalConnectionType::FROM_FD,
            credentials_of(certificates));
    acceptor_.add(std::move(listener), use, [entrance](Descriptor connection) {
      grpc::experimental::ExternalConnectionAcceptor::NewConnectionParameters parameters;
      parameters.fd = connection.release();
      entrance->HandleNewConnection(&parameters);
    });
  }
  return opened.fault;
}

std::string Server::listen_for_http(std::optional<http::Offer> offer) {
  const Config& config = backend_.config;
  if (config.http_listen.empty()) return {};
  Listener::Opened opened = Listener::open(config.http_listen);
  http_ = std::make_unique<http::HttpServer>(
      backend_, http::HttpServer::Options{.channel = in_process_channel(),
                                          .certificates = certificates_,
                                          .local = is_local_address(config.http_listen),
                                          .offer = std::move(offer)});
  for (Listener& listener : opened.listeners) {
    http_port_ = listener.port();
    acceptor_.add(std::move(listener), Acceptor::Use::http,
                  [this](Descriptor connection) { http_->take(std::move(connection)); });
  }
  return opened.fault;
}

void Server::set_serving(bool serving) {
  for (grpc::Server* server : {grpc_.get(), health_.get()}) {
    if (server == nullptr) continue;
    server->GetHealthCheckService()->SetServingStatus(v1::TrcService::service_full_name(), serving);
    // The empty name means all services; this also notifies watchers.
    server->GetHealthCheckService()->SetServingStatus(serving);
  }
}

std::string Server::exposition() {
  backend_.refresh_gauges();
  const Acceptor::Counts connections = acceptor_.counts();
  backend_.telemetry.metrics.set_connections(connections.accepted, connections.refused);
  return backend_.telemetry.metrics.exposition();
}

std::string Server::readiness() const {
  if (!started_ || backend_.streams.draining()) return "draining";
  return backend_.pulse.stalled() ? "stalled: streams wait for a worker" : "";
}

void Server::look_after_health() {
  backend_.pulse.beat();
  const bool stalled = backend_.pulse.stalled();
  if (stalled == stalled_ || backend_.streams.draining()) return;
  stalled_ = stalled;
  set_serving(!stalled);
  const auto& log = backend_.telemetry.log;
  if (stalled)
    log.error(LogLine("stalled")
                  .number("longest_wait_s", backend_.pulse.longest_wait_s())
                  .number("queue_depth", std::uint64_t{backend_.pool.queue_depth()}));
  else
    log.info(LogLine("serving_again"));
}

void Server::look_after_log() {
  const Log::Counts counts = Log::counts();
  if (counts.overwritten == dropped_lines_.overwritten &&
      counts.over_rate == dropped_lines_.over_rate && counts.failed == dropped_lines_.failed)
    return;
  dropped_lines_ = counts;
  backend_.telemetry.log.warning(LogLine("log_lines_dropped")
                                     .number("unread", counts.overwritten)
                                     .number("over_rate", counts.over_rate)
                                     .number("failed", counts.failed));
}

void Server::reload_certificates() {
  if (certificates_ == nullptr) return;
  std::string fault;
  const auto& log = backend_.telemetry.log;
  Metrics& metrics = backend_.telemetry.metrics;
  switch (certificates_->reload(fault)) {
    case Certificates::Reload::unchanged:
      refused_certificates_.clear();
      return;
    case Certificates::Reload::taken:
      refused_certificates_.clear();
      metrics.count_certificate_reload("taken");
      metrics.set_certificate_expiry(certificates_->current()->expires_s);
      log.info(LogLine("certificate_taken")
                   .number("expires_s",
                           static_cast<std::uint64_t>(certificates_->current()->expires_s)));
      return;
    case Certificates::Reload::refused:
      // Reports each fault once, not at every look.
      if (fault == refused_certificates_) return;
      refused_certificates_ = fault;
      metrics.count_certificate_reload("refused");
      log.warning(LogLine("certificate_refused").text("fault", fault));
      return;
  }
}

void Server::look_after() {
  look_after_health();
  look_after_log();
  const std::uint64_t refused = acceptor_.counts().refused;
  if (refused > refused_connections_) {
    backend_.telemetry.log.warning(
        LogLine("connections_refused").number("for_want_of_descriptors", refused));
    refused_connections_ = refused;
  }
  const auto now = Clock::now();
  if (now < next_certificate_look_) return;
  next_certificate_look_ = now + std::chrono::seconds(backend_.config.tls_refresh_s);
  reload_certificates();
}

bool Server::is_well() const {
  constexpr double longest_round_s = 10;
  return acceptor_.seconds_since_last_round() < longest_round_s && !backend_.pulse.dead();
}

std::shared_ptr<grpc::Channel> Server::in_process_channel() {
  return grpc_->InProcessChannel(grpc::ChannelArguments());
}

std::size_t Server::drain() {
  set_serving(false);
  backend_.streams.drain();
  const auto timeout = std::chrono::seconds(backend_.config.drain_timeout_s);
  std::size_t cut_off = 0;
  if (!backend_.streams.wait_until_none(Clock::now() + timeout)) {
    cut_off = backend_.streams.count();
    backend_.streams.cut_off(Clock::now() + cut_off_grace);
  }
  // When a stream has ended, the last bytes of its answer are still on their way, and so is the log
  // line that says why it was cut off.
  if (http_) http_->wait_until_idle(Clock::now() + cut_off_grace);
  stop_grpc();
  return cut_off;
}

void Server::stop_grpc() {
  acceptor_.stop();
  http_.reset();
  for (std::unique_ptr<grpc::Server>* server : {&grpc_, &health_}) {
    if (*server == nullptr) continue;
    // Shutdown waits for idle clients until its deadline, so the deadline is short.
    (*server)->Shutdown(std::chrono::system_clock::now() + shutdown_grace);
    (*server)->Wait();
    server->reset();
  }
  // Last, because until then it reports that the server drains.
  admin_.reset();
}

}  // namespace trc::server
