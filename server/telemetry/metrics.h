#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "server/telemetry/log.h"

namespace prometheus {
class Registry;
template <class Metric>
class Family;
class Counter;
class Gauge;
class Histogram;
}  // namespace prometheus

namespace trc::server {

enum class Method {
  compensate_path,
  compensate_program,
  compensate_program_once,
  preview_path,
  survey_radii,
  get_server_info,
  reflection
};
inline constexpr std::size_t method_count = 7;

// "CompensatePath", as in the proto.
std::string_view name_of(Method method);
// "bidi_stream", "server_stream" or "unary".
std::string_view kind_of(Method method);

// What the server counts. The names that start with grpc_server_ are those of the gRPC ecosystem,
// so that existing dashboards work. Handles are looked up once; nothing is counted per block.
class Metrics {
 public:
  Metrics();
  ~Metrics();

  // The handles of one RPC.
  struct OfMethod {
    prometheus::Counter* started = nullptr;
    prometheus::Counter* received = nullptr;  // messages
    prometheus::Counter* sent = nullptr;      // messages
    prometheus::Counter* blocks_in = nullptr;
    prometheus::Counter* blocks_out = nullptr;
    prometheus::Histogram* handling = nullptr;  // s, whole RPC
    prometheus::Histogram* batch = nullptr;     // s, one request from read to its last answer
  };

  [[nodiscard]] const OfMethod& of(Method method) const {
    return methods_[static_cast<std::size_t>(method)];
  }
  void count_handled(Method method, std::string_view grpc_code);
  void count_error(std::string_view reason);
  [[nodiscard]] prometheus::Gauge& streams_active() { return *streams_active_; }
  [[nodiscard]] prometheus::Gauge& session_memory() { return *session_memory_; }
  [[nodiscard]] prometheus::Gauge& queue_depth() { return *queue_depth_; }
  [[nodiscard]] prometheus::Gauge& peers_active() { return *peers_active_; }
  [[nodiscard]] prometheus::Gauge& resident_memory() { return *resident_memory_; }
  // A stream was ended because the process came close to its memory.
  void count_eviction();

  // Once: what the gauges of streams and memory may rise to.
  void set_limits(std::uint64_t streams, std::uint64_t session_memory_bytes,
                  std::uint64_t process_memory_bytes);

  // Totals that are counted elsewhere.
  void set_connections(std::uint64_t accepted, std::uint64_t refused);
  // How long the oldest turn has waited, s, and threads the system has refused.
  void set_pool(double longest_wait_s, std::uint64_t threads_missed);
  void set_log(const Log::Counts& counts);
  // As name_of(Connections::Reason) has it.
  void count_connection_closed(std::string_view reason);
  // Seconds since 1970.
  void set_certificate_expiry(std::int64_t expires_s);
  // "taken" or "refused".
  void count_certificate_reload(std::string_view result);

  // The text format of Prometheus.
  [[nodiscard]] std::string exposition() const;

 private:
  void register_rpcs();
  void register_resources();
  void register_connections();
  void register_log();
  void register_certificates();

  std::shared_ptr<prometheus::Registry> registry_;
  std::array<OfMethod, method_count> methods_{};
  prometheus::Family<prometheus::Counter>* handled_ = nullptr;
  prometheus::Family<prometheus::Counter>* errors_ = nullptr;
  prometheus::Gauge* streams_active_ = nullptr;
  prometheus::Gauge* session_memory_ = nullptr;
  prometheus::Gauge* queue_depth_ = nullptr;
  prometheus::Gauge* peers_active_ = nullptr;
  prometheus::Gauge* resident_memory_ = nullptr;
  prometheus::Counter* evictions_ = nullptr;
  prometheus::Counter* connections_accepted_ = nullptr;
  prometheus::Counter* connections_refused_ = nullptr;
  prometheus::Family<prometheus::Counter>* connections_closed_ = nullptr;
  prometheus::Gauge* longest_wait_ = nullptr;
  prometheus::Counter* threads_missed_ = nullptr;
  prometheus::Counter* log_overwritten_ = nullptr;
  prometheus::Counter* log_over_rate_ = nullptr;
  prometheus::Counter* log_failed_ = nullptr;
  prometheus::Gauge* log_blocked_ = nullptr;
  prometheus::Family<prometheus::Gauge>* certificate_expiry_ = nullptr;
  prometheus::Family<prometheus::Counter>* certificate_reloads_ = nullptr;
};

}  // namespace trc::server
