#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trc::server {

// Every setting of the server, with its unit in the name. The flag `--drain-timeout-s`, the
// environment variable `TRCD_DRAIN_TIMEOUT_S` and the key `drain-timeout-s` of the TOML or YAML
// file name the same setting; a flag wins over the environment, the environment over the file.
struct Config {
  // Addresses to serve: HOST:PORT, [IPV6]:PORT or unix:/path. Port 0 takes a free one.
  std::vector<std::string> listen = {"127.0.0.1:50051"};
  // Allows plain text on an address other machines can reach.
  bool insecure = false;
  // Allows plain text there to the health port alone.
  bool insecure_health = false;
  // Allows the admin port there, which speaks no TLS.
  bool insecure_admin = false;

  // PEM files. A certificate switches TLS on for TCP; the client CA makes client certificates
  // mandatory.
  std::string tls_cert_file;
  std::string tls_key_file;
  std::string tls_client_ca_file;
  // Common or alternative names of client certificates that are served; empty, which cannot be
  // written: all.
  std::vector<std::string> tls_allowed_clients;
  // Addresses and networks of proxies that name the client of a call in `x-forwarded-for`.
  std::vector<std::string> trusted_proxies;
  // How often the PEM files are checked for a new certificate.
  std::uint32_t tls_refresh_s = 10;

  // HOST:PORT of /metrics, /healthz and /readyz; empty: none.
  std::string admin_listen;
  // HOST:PORT of the health service alone, in plain text; empty: none.
  std::string health_listen;
  // HOST:PORT of HTTP: JSON, NC text and the page; empty: none.
  std::string http_listen;
  // Allows plain text on a HTTP address other machines can reach.
  bool insecure_http = false;
  // Origins whose pages may use it, "https://mes.example"; empty: none but its own.
  std::vector<std::string> http_cors_origins;
  std::uint32_t http_max_connections = 256;
  std::uint32_t http_max_connections_per_peer = 0;
  std::uint32_t http_max_body_mib = 64;
  std::uint32_t http_max_memory_mib = 0;           // bodies, answers and views together
  std::uint32_t http_max_memory_per_peer_mib = 0;  // bodies and answers of one client
  std::uint32_t http_max_views = 32;
  // For the head of a request, for each 64 KiB of its body, and of its answer.
  std::uint32_t http_timeout_s = 20;
  // Read from flags, environment and file, its default is off where other machines can reach an
  // address.
  bool reflection = true;

  // Threads that compute; 0: one per core.
  std::uint32_t worker_threads = 0;

  // Limits that are announced to clients and end a stream when passed.
  std::uint32_t max_message_bytes = 1024U * 1024U;
  std::uint32_t max_blocks_per_batch = 4096;
  std::uint32_t max_batches_in_flight = 16;
  std::uint64_t max_blocks_per_selection = 20'000'000;
  std::uint32_t max_passive_blocks = 10'000;  // that a setup may ask for (D-24)
  std::uint32_t max_line_bytes = 64U * 1024U;
  // fill_in_limits() replaces 0.
  std::uint32_t memory_limit_mib = 0;  // of the process
  std::uint32_t max_streams = 0;
  std::uint32_t max_streams_per_connection = 64;
  std::uint32_t max_streams_per_peer = 0;
  std::uint32_t max_connections_per_peer = 0;  // 0: three quarters of the descriptors
  std::uint32_t max_session_memory_mib = 0;    // of all streams together
  std::uint32_t max_memory_per_peer_mib = 0;
  std::uint32_t max_grpc_buffer_mib = 0;
  // Computing time of a selection before its first output, and of a stream; 0: no limit.
  std::uint32_t max_selection_cpu_s = 120;
  std::uint32_t max_stream_cpu_s = 7200;
  std::uint32_t idle_timeout_s = 300;
  // How often a silent stream gets a sign of life; 0: never.
  std::uint32_t heartbeat_s = 20;

  // Key of the resume tokens, at least 32 bytes. Made when the file does not exist. Without a file
  // tokens end with the process.
  std::string resume_key_file;
  std::uint32_t max_resume_token_bytes = 64U * 1024U;

  // What a connection may do without getting an answer before it is closed: streams cancelled
  // within ten seconds before their first answer, and bytes that carry no message.
  std::uint32_t max_early_cancels = 200;
  std::uint32_t max_overhead_kib_per_s = 2048;

  std::uint32_t keepalive_time_s = 30;
  std::uint32_t keepalive_timeout_s = 10;
  std::uint32_t min_client_ping_interval_s = 10;
  std::uint32_t drain_timeout_s = 30;

  // Health says NOT_SERVING while a turn has waited longer for a worker.
  std::uint32_t stall_timeout_s = 10;

  std::string log_level = "info";            // debug, info, warning, error, off
  std::uint32_t max_log_lines_per_s = 1000;  // of each kind

  friend bool operator==(const Config&, const Config&) = default;
};

// What the command line asked for: a configuration to serve with, or a text and an exit code.
struct CommandLine {
  struct Exit {
    int code = 0;      // 0: --help, --version, --print-config; 2: wrong configuration
    std::string text;  // one line when the code is not 0
  };
  Config config;
  std::optional<Exit> exit;
};

// Reads flags, environment and file, and checks every value and their combination.
CommandLine read_command_line(int argc, const char* const* argv);

// Names of the settings that have other values in one than in the other, in the order of --help.
std::vector<std::string> differing_settings(Config one, Config other);

// The first rule a configuration breaks, as a sentence; empty when it is good.
std::optional<std::string> first_fault(const Config& config);

}  // namespace trc::server
