#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace prometheus {
class Registry;
template <class Metric>
class Family;
class Counter;
class Gauge;
class Histogram;
}  // namespace prometheus

namespace trc::server {

enum class Method { compensate_path, compensate_program, preview_path, get_server_info };
inline constexpr std::size_t method_count = 4;

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

  // Once: what the gauges of streams and memory may rise to.
  void set_limits(std::uint64_t streams, std::uint64_t session_memory_bytes);

  // Totals that are counted elsewhere.
  void set_connections(std::uint64_t accepted, std::uint64_t refused);
  // Seconds since 1970.
  void set_certificate_expiry(std::int64_t expires_s);
  // "taken" or "refused".
  void count_certificate_reload(std::string_view result);

  // The text format of Prometheus.
  [[nodiscard]] std::string exposition() const;

 private:
  std::shared_ptr<prometheus::Registry> registry_;
  std::array<OfMethod, method_count> methods_{};
  prometheus::Family<prometheus::Counter>* handled_ = nullptr;
  prometheus::Family<prometheus::Counter>* errors_ = nullptr;
  prometheus::Gauge* streams_active_ = nullptr;
  prometheus::Gauge* session_memory_ = nullptr;
  prometheus::Gauge* queue_depth_ = nullptr;
  prometheus::Counter* connections_accepted_ = nullptr;
  prometheus::Counter* connections_refused_ = nullptr;
  prometheus::Family<prometheus::Gauge>* certificate_expiry_ = nullptr;
  prometheus::Family<prometheus::Counter>* certificate_reloads_ = nullptr;
};

}  // namespace trc::server
