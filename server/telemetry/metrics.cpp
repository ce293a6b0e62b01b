#include "server/telemetry/metrics.h"

#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

#include <map>

#include "core/base/version.h"

namespace trc::server {
namespace {

using prometheus::Counter;
using prometheus::Family;
using prometheus::Gauge;
using prometheus::Histogram;
using Labels = std::map<std::string, std::string>;

constexpr std::string_view service_name = "trc.v1.TrcService";

Family<Counter>& counters(prometheus::Registry& registry, const char* name, const char* help) {
  return prometheus::BuildCounter().Name(name).Help(help).Register(registry);
}

Gauge& gauge(prometheus::Registry& registry, const char* name, const char* help) {
  return prometheus::BuildGauge().Name(name).Help(help).Register(registry).Add({});
}

Labels labels_of(Method method) {
  return {{"grpc_type", std::string(kind_of(method))},
          {"grpc_service", std::string(service_name)},
          {"grpc_method", std::string(name_of(method))}};
}

}  // namespace

std::string_view name_of(Method method) {
  switch (method) {
    case Method::compensate_path:
      return "CompensatePath";
    case Method::compensate_program:
      return "CompensateProgram";
    case Method::preview_path:
      return "PreviewPath";
    case Method::get_server_info:
      return "GetServerInfo";
  }
  return "";
}

std::string_view kind_of(Method method) {
  switch (method) {
    case Method::compensate_path:
    case Method::compensate_program:
      return "bidi_stream";
    case Method::preview_path:
      return "server_stream";
    case Method::get_server_info:
      return "unary";
  }
  return "";
}

Metrics::Metrics() : registry_(std::make_shared<prometheus::Registry>()) {
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
  streams_active_ = &gauge(registry, "trc_streams_active", "Open streams.");
  session_memory_ =
      &gauge(registry, "trc_session_memory_bytes", "Memory of the blocks all streams hold back.");
  queue_depth_ = &gauge(registry, "trc_pool_queue_depth", "Streams that wait for a worker.");
  connections_accepted_ =
      &counters(registry, "trc_connections_accepted_total", "Connections accepted.").Add({});
  connections_refused_ = &counters(registry, "trc_connections_refused_total",
                                   "Connections closed for want of file descriptors.")
                              .Add({});
  certificate_expiry_ = &prometheus::BuildGauge()
                             .Name("trc_tls_certificate_expiry_timestamp_seconds")
                             .Help("When the certificate in use expires.")
                             .Register(registry);
  certificate_reloads_ = &counters(registry, "trc_tls_certificate_reloads_total",
                                   "Changed PEM files, by whether they were taken into use.");
  prometheus::BuildGauge()
      .Name("trc_build_info")
      .Help("Always 1; the labels name the build.")
      .Register(registry)
      .Add({{"version", std::string(version())}, {"commit", std::string(commit())}})
      .Set(1);
}

Metrics::~Metrics() = default;

void Metrics::set_limits(std::uint64_t streams, std::uint64_t session_memory_bytes) {
  gauge(*registry_, "trc_streams_limit", "Open streams there may be.")
      .Set(static_cast<double>(streams));
  gauge(*registry_, "trc_session_memory_limit_bytes",
        "Memory the blocks all streams hold back may take.")
      .Set(static_cast<double>(session_memory_bytes));
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
  connections_accepted_->Increment(static_cast<double>(accepted) - connections_accepted_->Value());
  connections_refused_->Increment(static_cast<double>(refused) - connections_refused_->Value());
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
