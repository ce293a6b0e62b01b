#include "server/telemetry/metrics.h"

#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

#include <map>

#include "core/base/version.h"
#include "server/net/connections.h"

namespace trc::server {
namespace {

using prometheus::Counter;
using prometheus::Family;
using prometheus::Gauge;
using prometheus::Histogram;
using Labels = std::map<std::string, std::string>;

std::string_view service_of(Method method) {
  return method == Method::reflection ? "grpc.reflection.v1.ServerReflection" : "trc.v1.TrcService";
}

Family<Counter>& counters(prometheus::Registry& registry, const char* name, const char* help) {
  return prometheus::BuildCounter().Name(name).Help(help).Register(registry);
}

Gauge& gauge(prometheus::Registry& registry, const char* name, const char* help) {
  return prometheus::BuildGauge().Name(name).Help(help).Register(registry).Add({});
}

// For totals that are counted elsewhere.
void set_total(Counter& counter, std::uint64_t total) {
  counter.Increment(static_cast<double>(total) - counter.Value());
}

Labels labels_of(Method method) {
  return {{"grpc_type", std::string(kind_of(method))},
          {"grpc_service", std::string(service_of(method))},
          {"grpc_method", std::string(name_of(method))}};
}

}  // namespace

std::string_view name_of(Method method) {
  switch (method) {
    case Method::compensate_path:
      return "CompensatePath";
    case Method::compensate_program:
      return "CompensateProgram";
    case Method::compensate_program_once:
      return "CompensateProgramOnce";
    case Method::preview_path:
      return "PreviewPath";
    case Method::survey_radii:
      return "SurveyRadii";
    case Method::get_server_info:
      return "GetServerInfo";
    case Method::reflection:
      return "ServerReflectionInfo";
  }
  return "";
}

std::string_view kind_of(Method method) {
  switch (method) {
    case Method::compensate_path:
    case Method::compensate_program:
    case Method::survey_radii:
    case Method::reflection:
      return "bidi_stream";
    case Method::preview_path:
      return "server_stream";
    case Method::compensate_program_once:
    case Method::get_server_info:
      return "unary";
  }
  return "";
}

Metrics::Metrics() : registry_(std::make_shared<prometheus::Registry>()) {
  register_rpcs();
  register_resources();
  register_connections();
  register_log();
  register_certificates();
  prometheus::BuildGauge()
      .Name("trc_build_info")
      .Help("Always 1; the labels name the build.")
      .Register(*registry_)
      .Add({{"version", std::string(version())}, {"commit", std::string(commit())}})
      .Set(1);
}

void Metrics::register_rpcs() {
  prometheus::Registry& registry = *registry_;
  auto& started = counters(registry, "grpc_server_started_total", "RPCs started.");
  auto& received =
      counters(registry, "grpc_server_msg_received_total", "Messages received from clients.");
  auto& sent = counters(registry, "grpc_server_msg_sent_total", "Messages sent to clients.");
  auto& blocks = counters(registry, "trc_blocks_total", "Blocks received and sent.");
  auto& handling = prometheus::BuildHistogram()
                       .Name("grpc_server_handling_seconds")
                       .Help("Time from the start of an RPC to its end.")
                       .Register(registry);
  auto& batch = prometheus::BuildHistogram()
                    .Name("trc_batch_seconds")
                    .Help("Time from the receipt of a request to its last answer.")
                    .Register(registry);
  const Histogram::BucketBoundaries handling_bounds{.001, .005, .01, .05, .1, .5,
                                                    1,    5,    10,  60,  300};
  const Histogram::BucketBoundaries batch_bounds{.0001, .00025, .0005, .001, .0025, .005,
                                                 .01,   .025,   .05,   .1,   .5,    1};
  for (std::size_t i = 0; i < method_count; ++i) {
    const Labels labels = labels_of(static_cast<Method>(i));
    const auto blocks_that_go = [&](const char* direction) {
      Labels with_direction = labels;
      with_direction.emplace("direction", direction);
      return &blocks.Add(with_direction);
    };
    methods_[i] = {.started = &started.Add(labels),
                   .received = &received.Add(labels),
                   .sent = &sent.Add(labels),
                   .blocks_in = blocks_that_go("in"),
                   .blocks_out = blocks_that_go("out"),
                   .handling = &handling.Add(labels, handling_bounds),
                   .batch = &batch.Add(labels, batch_bounds)};
  }
  handled_ = &counters(registry, "grpc_server_handled_total", "RPCs ended, by status.");
  errors_ = &counters(registry, "trc_errors_total", "RPCs that ended with an error, by reason.");
}

void Metrics::register_resources() {
  prometheus::Registry& registry = *registry_;
  streams_active_ = &gauge(registry, "trc_streams_active", "Open streams.");
  session_memory_ = &gauge(registry, "trc_session_memory_bytes", "Memory that all streams hold.");
  resident_memory_ = &gauge(registry, "trc_resident_memory_bytes",
                            "Resident memory of the process, without that of files.");
  peers_active_ = &gauge(registry, "trc_peers_active", "Clients with something open, by name.");
  evictions_ = &counters(registry, "trc_evictions_total",
                         "Streams ended because the process came close to its memory.")
                    .Add({});
  queue_depth_ = &gauge(registry, "trc_pool_queue_depth", "Streams that wait for a worker.");
  longest_wait_ = &gauge(registry, "trc_pool_longest_wait_seconds",
                         "How long the stream that waits longest has waited for a worker.");
  threads_missed_ = &counters(registry, "trc_pool_threads_missed_total",
                              "Threads the system refused: a long turn kept its worker.")
                         .Add({});
}

void Metrics::register_connections() {
  prometheus::Registry& registry = *registry_;
  connections_accepted_ =
      &counters(registry, "trc_connections_accepted_total", "Connections accepted.").Add({});
  connections_refused_ = &counters(registry, "trc_connections_refused_total",
                                   "Connections closed for want of file descriptors.")
                              .Add({});
  connections_closed_ =
      &counters(registry, "trc_connections_closed_total", "Connections shut down for misuse.");
  for (std::size_t i = 0; i < Connections::reason_count; ++i)
    connections_closed_->Add(
        {{"reason", std::string(name_of(static_cast<Connections::Reason>(i)))}});
}

void Metrics::register_log() {
  auto& dropped = counters(*registry_, "trc_log_lines_dropped_total",
                           "Log lines dropped: as nobody read them, more than a second may have "
                           "of a kind, or there was no room to write them.");
  log_overwritten_ = &dropped.Add({{"cause", "unread"}});
  log_over_rate_ = &dropped.Add({{"cause", "rate"}});
  log_failed_ = &dropped.Add({{"cause", "failed"}});
  log_blocked_ = &gauge(*registry_, "trc_log_blocked_seconds",
                        "How long whoever reads the log has taken nothing.");
}

void Metrics::register_certificates() {
  certificate_expiry_ = &prometheus::BuildGauge()
                             .Name("trc_tls_certificate_expiry_timestamp_seconds")
                             .Help("When the certificate in use expires.")
                             .Register(*registry_);
  certificate_reloads_ = &counters(*registry_, "trc_tls_certificate_reloads_total",
                                   "Changed PEM files, by whether they were taken into use.");
}

Metrics::~Metrics() = default;

void Metrics::count_eviction() { evictions_->Increment(); }

void Metrics::set_limits(std::uint64_t streams, std::uint64_t session_memory_bytes,
                         std::uint64_t process_memory_bytes) {
  gauge(*registry_, "trc_streams_limit", "Open streams there may be.")
      .Set(static_cast<double>(streams));
  gauge(*registry_, "trc_session_memory_limit_bytes", "Memory that all streams may hold.")
      .Set(static_cast<double>(session_memory_bytes));
  gauge(*registry_, "trc_memory_limit_bytes", "Memory the process may have.")
      .Set(static_cast<double>(process_memory_bytes));
}

void Metrics::count_handled(Method method, std::string_view grpc_code) {
  Labels labels = labels_of(method);
  labels.emplace("grpc_code", grpc_code);
  handled_->Add(labels).Increment();
}

void Metrics::count_error(std::string_view reason) {
  errors_->Add({{"reason", std::string(reason)}}).Increment();
}

void Metrics::set_connections(std::uint64_t accepted, std::uint64_t refused) {
  set_total(*connections_accepted_, accepted);
  set_total(*connections_refused_, refused);
}

void Metrics::set_pool(double longest_wait_s, std::uint64_t threads_missed) {
  longest_wait_->Set(longest_wait_s);
  set_total(*threads_missed_, threads_missed);
}

void Metrics::set_log(const Log::Counts& counts) {
  set_total(*log_overwritten_, counts.overwritten);
  set_total(*log_over_rate_, counts.over_rate);
  set_total(*log_failed_, counts.failed);
  log_blocked_->Set(counts.blocked_s);
}

void Metrics::count_connection_closed(std::string_view reason) {
  connections_closed_->Add({{"reason", std::string(reason)}}).Increment();
}

void Metrics::set_certificate_expiry(std::int64_t expires_s) {
  certificate_expiry_->Add({}).Set(static_cast<double>(expires_s));
}

void Metrics::count_certificate_reload(std::string_view result) {
  certificate_reloads_->Add({{"result", std::string(result)}}).Increment();
}

std::string Metrics::exposition() const {
  return prometheus::TextSerializer().Serialize(registry_->Collect());
}

}  // namespace trc::server
