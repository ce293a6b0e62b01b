#include "server/config/config_settings.h"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>
#include <type_traits>
#include <utility>

#include "core/base/likely_meant.h"
#include "core/nc/text/characters.h"

namespace trc::server {
namespace {

template <class Value>
std::string toml_of(const Value& value) {
  std::ostringstream text;
  if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
    toml::array list;
    for (const std::string& one : value) list.push_back(one);
    text << list;
  } else if constexpr (std::is_same_v<Value, std::string> || std::is_same_v<Value, bool>) {
    text << toml::value<Value>(value);
  } else {
    text << value;
  }
  return text.str();
}

// Without this check CLI11 reads 010 as 8 and 0x10 as 16.
std::string fault_of_number(const std::string& text) {
  const bool decimal = !text.empty() && text.find_first_not_of("0123456789") == text.npos;
  if (decimal && (text == "0" || text.front() != '0')) return {};
  return "'" + text + "' is no whole number written in decimal digits";
}

// Without this check CLI11 reads 5 and yes as true.
std::string fault_of_switch(const std::string& text) {
  if (text == "true" || text == "false") return {};
  return "takes true or false, not '" + text + "'";
}

class Settings {
 public:
  Settings(CLI::App& app, Printed& printed) : app_(app), printed_(printed) {}

  template <class Value>
  CLI::Option* add(const std::string& name, Value& value, const std::string& description) {
    CLI::Option* option = app_.add_option("--" + name, value, description);
    option->envname(environment_name(name))->capture_default_str();
    print(name, value);
    return option;
  }

  template <class Number>
  void number(const std::string& name, Number& value, std::uint64_t least, std::uint64_t most,
              const std::string& description) {
    add(name, value, description)
        ->check(CLI::Validator(fault_of_number, ""))
        ->check(CLI::Range(least, most));
  }

  void toggle(const std::string& name, bool& value, const std::string& description) {
    app_.add_flag("--" + name, value, description)
        ->envname(environment_name(name))
        ->default_str(value ? "true" : "false")
        ->check(CLI::Validator(fault_of_switch, ""));
    print(name, value);
  }

 private:
  template <class Value>
  void print(const std::string& name, const Value& value) {
    printed_.push_back({.name = name, .value = [&value] { return toml_of(value); }});
  }

  CLI::App& app_;
  Printed& printed_;
};

void declare_addresses(Settings& settings, Config& config) {
  settings.add("listen", config.listen, "addresses to serve: HOST:PORT, [IPV6]:PORT or unix:/path")
      ->delimiter(',')
      ->expected(1, 16)
      ->default_str(config.listen.front());
  settings.toggle("insecure", config.insecure,
                  "allow plain text on an address other machines can reach");
  settings.toggle("insecure-health", config.insecure_health,
                  "allow it for health-listen alone, which tells health and nothing else");
  settings.toggle("insecure-admin", config.insecure_admin,
                  "allow it for admin-listen alone, which tells metrics and health");
  settings.add("tls-cert-file", config.tls_cert_file, "PEM certificate chain; switches TLS on");
  settings.add("tls-key-file", config.tls_key_file, "PEM private key of the certificate");
  settings.add("tls-client-ca-file", config.tls_client_ca_file,
               "PEM authorities; clients must then show a certificate of one of them");
  settings
      .add("tls-allowed-clients", config.tls_allowed_clients,
           "names of client certificates that are served (common name or alternative name); not "
           "given: all the authority has signed")
      ->delimiter(',')
      ->expected(0, 1024);
  settings
      .add("trusted-proxies", config.trusted_proxies,
           "proxies, as in 10.0.0.5 or 10.0.0.0/8, whose x-forwarded-for names the client of a "
           "call; nobody else may reach this port from there")
      ->delimiter(',')
      ->expected(0, 64);
  settings.number("tls-refresh-s", config.tls_refresh_s, 1, 86400,
                  "how often the PEM files are read again");
  settings.add("admin-listen", config.admin_listen,
               "HOST:PORT of /metrics, /healthz and /readyz; empty: none");
  settings.add("health-listen", config.health_listen,
               "HOST:PORT of grpc.health.v1 alone in plain text, for probes; empty: none");
}

void declare_http(Settings& settings, Config& config) {
  settings.add("http-listen", config.http_listen,
               "HOST:PORT of HTTP/1.1: JSON, NC text and the page; empty: none");
  settings.toggle("insecure-http", config.insecure_http,
                  "allow plain text on a http-listen other machines can reach");
  settings
      .add("http-cors-origins", config.http_cors_origins,
           "origins whose pages may use HTTP, as in https://mes.example; empty: its own only")
      ->delimiter(',')
      ->expected(0, 64);
  settings.number("http-max-connections", config.http_max_connections, 1, 65536,
                  "open connections of HTTP; beyond them the one that has waited longest goes");
  settings.number(
      "http-max-connections-per-peer", config.http_max_connections_per_peer, 0, 65536,
      "of one address; 0: three quarters of all, or all where only this machine gets in");
  settings.number("http-max-body-mib", config.http_max_body_mib, 1, 1024,
                  "largest NC program over HTTP");
  settings.number("http-max-memory-mib", config.http_max_memory_mib, 0, 1U << 20U,
                  "memory of bodies, answers and views of HTTP together; 0: 512, or a quarter of "
                  "memory-limit-mib");
  settings.number("http-max-memory-per-peer-mib", config.http_max_memory_per_peer_mib, 0, 1U << 20U,
                  "bodies and answers of one address; 0: three quarters of all, or all where only "
                  "this machine gets in");
  settings.number("http-max-views", config.http_max_views, 1, 10000,
                  "programs kept for those who look at them; the oldest gives way to a new one");
  settings.number("http-timeout-s", config.http_timeout_s, 1, 3600,
                  "a request, each 64 KiB of its body and each 64 KiB of its answer may take so "
                  "long");
}

void declare_sizes(Settings& settings, Config& config) {
  settings.toggle(
      "reflection", config.reflection,
      "serve gRPC reflection; if not said, only where all addresses are this machine's");
  settings.number("worker-threads", config.worker_threads, 0, 1024,
                  "threads that compute; 0: one per core");
  settings.number("max-message-bytes", config.max_message_bytes, 4096, 1U << 30U,
                  "largest message in either direction");
  // Clients start with batches of 1024 before they know the limits (D-58).
  settings.number("max-blocks-per-batch", config.max_blocks_per_batch, 1024, 1'000'000,
                  "most blocks in one request");
  settings.number("max-batches-in-flight", config.max_batches_in_flight, 1, 1024,
                  "batches a client may send ahead of the answers");
  settings.number("max-blocks-per-selection", config.max_blocks_per_selection, 1, 1'000'000'000,
                  "most blocks between G41/G42 and G40");
  settings.number("max-passive-blocks", config.max_passive_blocks, 1, 1'000'000,
                  "most blocks without motion in a row that a setup may ask for (90011)");
  settings.number("max-line-bytes", config.max_line_bytes, 80, 64U * 1024U * 1024U,
                  "longest line of NC text");
}

void declare_shares(Settings& settings, Config& config) {
  settings.number("memory-limit-mib", config.memory_limit_mib, 0, 1U << 30U,
                  "memory the process may have; 0: that of its cgroup, else of the machine");
  settings.number("max-streams", config.max_streams, 0, 1'000'000,
                  "open streams in all; 0: 1000, or as many as max-grpc-buffer-mib is enough for");
  settings.number("max-streams-per-connection", config.max_streams_per_connection, 1, 1'000'000,
                  "open streams of one connection");
  settings.number("max-streams-per-peer", config.max_streams_per_peer, 0, 1'000'000,
                  "open streams of one client; 0: three quarters of all");
  settings.number(
      "max-connections-per-peer", config.max_connections_per_peer, 0, 1'000'000,
      "open connections of one address; 0: three quarters of the descriptors, at most 1024");
  settings.number("max-session-memory-mib", config.max_session_memory_mib, 0, 1U << 20U,
                  "memory that all streams may hold; 0: 1024, or half of memory-limit-mib");
  settings.number("max-memory-per-peer-mib", config.max_memory_per_peer_mib, 0, 1U << 20U,
                  "memory that the streams of one client may hold; 0: three quarters of all");
  settings.number("max-grpc-buffer-mib", config.max_grpc_buffer_mib, 0, 1U << 20U,
                  "memory of gRPC's own buffers; 0: what max-streams need, or a quarter of "
                  "memory-limit-mib");
}

void declare_times(Settings& settings, Config& config) {
  settings.number("max-selection-cpu-s", config.max_selection_cpu_s, 0, 86400,
                  "computing time of a selection before anything of it comes out; 0: any");
  settings.number("max-stream-cpu-s", config.max_stream_cpu_s, 0, 1'000'000,
                  "computing time of a stream; 0: any");
  settings.number("idle-timeout-s", config.idle_timeout_s, 1, 86400,
                  "a stream without a request for so long is ended");
  settings.number("heartbeat-s", config.heartbeat_s, 0, 86400,
                  "a silent stream gets a heartbeat that often; 0: never");
  settings.add("resume-key-file", config.resume_key_file,
               "key of the resume tokens, at least 32 bytes, made if missing; the same on all "
               "servers that resume each other's streams; empty: tokens end with the process");
  settings.number(
      "max-resume-token-bytes", config.max_resume_token_bytes, 1024, 1U << 20U,
      "largest resume token, at most half of max-message-bytes; where more would be needed none "
      "is given");
  settings.number("max-early-cancels", config.max_early_cancels, 1, 1'000'000,
                  "a connection that cancels more streams in ten seconds, and before their first "
                  "answer, is closed");
  settings.number("max-overhead-kib-per-s", config.max_overhead_kib_per_s, 16, 1U << 20U,
                  "a connection that goes on sending more bytes that carry no message is closed");
  settings.number("keepalive-time-s", config.keepalive_time_s, 1, 86400,
                  "a silent connection is asked after so long");
  settings.number("keepalive-timeout-s", config.keepalive_timeout_s, 1, 3600,
                  "an unanswered question closes the connection after so long");
  settings.number("min-client-ping-interval-s", config.min_client_ping_interval_s, 1, 3600,
                  "clients that ask more often are disconnected");
  settings.number("drain-timeout-s", config.drain_timeout_s, 0, 86400,
                  "open streams may go on so long after SIGTERM");
  settings.number("stall-timeout-s", config.stall_timeout_s, 1, 3600,
                  "health is NOT_SERVING while a stream has waited longer for a worker");
  settings.number("max-log-lines-per-s", config.max_log_lines_per_s, 1, 1'000'000,
                  "log lines of one kind; what is more is dropped and counted");
  settings.add("log-level", config.log_level, "debug, info, warning, error or off")
      ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}));
}

// The present name of a setting that was renamed, in the spelling of `word`; empty: not renamed.
std::string new_name_of(const std::string& word) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 1> renamed{
      {{"max-riders", "max-passive-blocks"}}};
  for (const auto& [before, now] : renamed) {
    if (word == environment_name(std::string(before))) return environment_name(std::string(now));
    if (word == before) return std::string(now);
    if (word == "--" + std::string(before)) return "--" + std::string(now);
  }
  return {};
}

}  // namespace

void declare(CLI::App& app, Config& config, Printed& printed) {
  Settings settings(app, printed);
  declare_addresses(settings, config);
  declare_http(settings, config);
  declare_sizes(settings, config);
  declare_shares(settings, config);
  declare_times(settings, config);
}

std::vector<std::string> differing_settings(Config one, Config other) {
  CLI::App app;
  CLI::App other_app;
  Printed printed;
  Printed other_printed;
  declare(app, one, printed);
  declare(other_app, other, other_printed);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < printed.size(); ++i)
    if (printed[i].value() != other_printed[i].value()) names.push_back(printed[i].name);
  return names;
}

std::string environment_name(std::string_view setting) {
  std::string name = "TRCD_";
  for (const char c : setting) name += c == '-' ? '_' : upper(c);
  return name;
}

std::vector<std::string> setting_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_envname().empty()) names.push_back(option->get_lnames().front());
  return names;
}

const std::vector<std::string>& guard_names() {
  static const std::vector<std::string> names{"tls-cert-file", "tls-key-file", "tls-client-ca-file",
                                              "tls-allowed-clients"};
  return names;
}

bool is_guard(std::string_view setting) {
  return std::find(guard_names().begin(), guard_names().end(), setting) != guard_names().end();
}

bool is_empty_value(std::string_view value) {
  return value.find_first_not_of(", \t[]{}\"'") == std::string_view::npos;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
  if (const std::string now = new_name_of(word); !now.empty())
    return "; it is called " + now + " now";
  const auto meant = likely_meant(word, candidates);
  return meant ? "; did you mean " + *meant + "?" : std::string();
}

}  // namespace trc::server
