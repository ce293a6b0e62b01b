#include "server/config.h"

#include <toml++/toml.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <istream>
#include <memory>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/base/likely_meant.h"
#include "core/base/version.h"
#include "server/address.h"

namespace trc::server {
namespace {

// `drain-timeout-s` is TRCD_DRAIN_TIMEOUT_S in the environment.
std::string environment_name(std::string_view setting) {
  std::string name = "TRCD_";
  for (const char c : setting)
    name += c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

// A setting as a file has it.
struct FileEntry {
  std::string name{};
  std::vector<std::string> values{};  // of a list, else one
  int line = 0;
};

[[noreturn]] void refuse_file(const std::string& file, int line, std::string_view what) {
  std::ostringstream text;
  text << "configuration file " << file << ", line " << line << ": " << what;
  throw CLI::ConfigError(text.str());
}

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

std::string toml_scalar(const std::string& file, const toml::node& node, const std::string& key) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto number = node.value_exact<std::int64_t>()) return std::to_string(*number);
  if (const auto flag = node.value_exact<bool>()) return *flag ? "true" : "false";
  refuse_file(file, line_of(node),
              "'" + key + "' must be a string, an integer, true, false or a list");
}

std::vector<FileEntry> toml_entries(const std::string& file, std::istream& input) {
  std::vector<FileEntry> entries;
  try {
    for (const auto& [key_node, value] : toml::parse(input)) {
      FileEntry entry{.name = std::string(key_node.str()), .line = line_of(value)};
      if (const toml::array* list = value.as_array()) {
        for (const toml::node& one : *list)
          entry.values.push_back(toml_scalar(file, one, entry.name));
      } else {
        entry.values.push_back(toml_scalar(file, value, entry.name));
      }
      entries.push_back(std::move(entry));
    }
  } catch (const toml::parse_error& fault) {
    refuse_file(file, static_cast<int>(fault.source().begin.line), fault.description());
  }
  return entries;
}

std::vector<FileEntry> yaml_entries(const std::string& file, std::istream& input) {
  std::vector<FileEntry> entries;
  try {
    const YAML::Node whole = YAML::Load(input);
    if (!whole.IsMap() && !whole.IsNull())
      refuse_file(file, 1, "must hold settings, `name: value`");
    for (const auto& named : whole) {
      FileEntry entry{.name = named.first.as<std::string>(), .line = named.first.Mark().line + 1};
      const YAML::Node& value = named.second;
      if (value.IsSequence()) {
        for (const YAML::Node& one : value) entry.values.push_back(one.as<std::string>());
      } else {
        entry.values.push_back(value.as<std::string>());
      }
      entries.push_back(std::move(entry));
    }
  } catch (const YAML::Exception& fault) {
    refuse_file(file, fault.mark.line + 1, fault.msg);
  }
  return entries;
}

// Each setting as TOML, with the value that it has at the time of the call.
using Printed = std::vector<std::function<std::string()>>;

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
    add(name, value, description)->check(CLI::Range(least, most));
  }

  void toggle(const std::string& name, bool& value, const std::string& description) {
    app_.add_flag("--" + name, value, description)
        ->envname(environment_name(name))
        ->default_str(value ? "true" : "false");
    print(name, value);
  }

 private:
  template <class Value>
  void print(const std::string& name, const Value& value) {
    printed_.emplace_back([name, &value] { return name + '=' + toml_of(value) + '\n'; });
  }

  CLI::App& app_;
  Printed& printed_;
};

void declare(CLI::App& app, Config& config, Printed& printed) {
  Settings settings(app, printed);
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
           "names of client certificates that are served (common name or alternative name); empty: "
           "all the authority has signed")
      ->delimiter(',')
      ->expected(0, 1024);
  settings.number("tls-refresh-s", config.tls_refresh_s, 1, 86400,
                  "how often the PEM files are read again");
  settings.add("admin-listen", config.admin_listen,
               "HOST:PORT of /metrics, /healthz and /readyz; empty: none");
  settings.add("health-listen", config.health_listen,
               "HOST:PORT of grpc.health.v1 alone in plain text, for probes; empty: none");
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
  settings.number("http-max-body-mib", config.http_max_body_mib, 1, 1024,
                  "largest NC program over HTTP");
  settings.number("http-max-memory-mib", config.http_max_memory_mib, 1, 1U << 20U,
                  "memory of bodies, answers and views of HTTP together");
  settings.number("http-max-views", config.http_max_views, 1, 10000,
                  "programs kept for those who look at them; the oldest gives way to a new one");
  settings.number("http-timeout-s", config.http_timeout_s, 1, 3600,
                  "a request, each 64 KiB of its body and each 64 KiB of its answer may take so "
                  "long");
  settings.toggle(
      "reflection", config.reflection,
      "serve gRPC reflection; if not said, only where all addresses are this machine's");
  settings.number("worker-threads", config.worker_threads, 0, 1024,
                  "threads that compute; 0: one per core");
  settings.number("max-message-bytes", config.max_message_bytes, 4096, 1U << 30U,
                  "largest message in either direction");
  settings.number("max-blocks-per-batch", config.max_blocks_per_batch, 1, 1'000'000,
                  "most blocks in one request");
  settings.number("max-batches-in-flight", config.max_batches_in_flight, 1, 1024,
                  "batches a client may send ahead of the answers");
  settings.number("max-blocks-per-selection", config.max_blocks_per_selection, 1, 1'000'000'000,
                  "most blocks between G41/G42 and G40");
  settings.number("max-passive-blocks", config.max_passive_blocks, 1, 1'000'000,
                  "most passive blocks between two relevant ones (90011)");
  settings.number("max-line-bytes", config.max_line_bytes, 80, 64U * 1024U * 1024U,
                  "longest line of NC text");
  settings.number("memory-limit-mib", config.memory_limit_mib, 0, 1U << 30U,
                  "memory the process may have; 0: that of its cgroup, else of the machine");
  settings.number("max-streams", config.max_streams, 0, 1'000'000,
                  "open streams in all; 0: 1000, or as many as max-grpc-buffer-mib is enough for");
  settings.number("max-streams-per-connection", config.max_streams_per_connection, 1, 1'000'000,
                  "open streams of one connection");
  settings.number("max-streams-per-peer", config.max_streams_per_peer, 0, 1'000'000,
                  "open streams of one client; 0: three quarters of all");
  settings.number("max-connections-per-peer", config.max_connections_per_peer, 0, 1'000'000,
                  "open connections of one address; 0: three quarters of the descriptors");
  settings.number("max-session-memory-mib", config.max_session_memory_mib, 0, 1U << 20U,
                  "memory that all streams may hold; 0: 1024, or half of memory-limit-mib");
  settings.number("max-memory-per-peer-mib", config.max_memory_per_peer_mib, 0, 1U << 20U,
                  "memory that the streams of one client may hold; 0: three quarters of all");
  settings.number("max-grpc-buffer-mib", config.max_grpc_buffer_mib, 0, 1U << 20U,
                  "memory of gRPC's own buffers; 0: what max-streams need, or a quarter of "
                  "memory-limit-mib");
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
  settings.number("max-resume-token-bytes", config.max_resume_token_bytes, 1024, 1U << 20U,
                  "largest resume token; where more would be needed none is given");
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

// What a value alone breaks, on a command line that has nothing else.
class ValueCheck {
 public:
  ValueCheck() : app_("", "trcd") {
    declare(app_, config_, printed_);
    for (CLI::Option* option : app_.get_options()) option->envname("");
  }

  [[nodiscard]] std::optional<std::string> fault_of(const std::string& name,
                                                    const std::string& value) {
    try {
      const std::string option = "--" + name;
      // From the last to the first, as CLI11 takes them.
      app_.parse(value.empty() ? std::vector<std::string>{"", option}
                               : std::vector<std::string>{option + "=" + value});
    } catch (const CLI::Error& fault) {
      return fault.what();
    }
    return std::nullopt;
  }

 private:
  Config config_;
  Printed printed_;
  CLI::App app_;
};

std::vector<std::string> setting_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_envname().empty()) names.push_back(option->get_lnames().front());
  return names;
}

// The name that a setting has now, as `word` spells it; empty: it never had another.
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

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
  if (const std::string now = new_name_of(word); !now.empty())
    return "; it is called " + now + " now";
  const auto meant = likely_meant(word, candidates);
  return meant ? "; did you mean " + *meant + "?" : std::string();
}

// Lets a TOML or a YAML library read the file, as its name says, and drops what the environment
// overrides.
class ConfigFile : public CLI::ConfigTOML {
 public:
  explicit ConfigFile(const CLI::App& app) : app_(app) {}

  [[nodiscard]] std::vector<CLI::ConfigItem> from_config(std::istream& input) const override {
    const auto file = app_.get_config_ptr()->as<std::string>();
    const bool yaml = file.ends_with(".yaml") || file.ends_with(".yml");
    std::vector<CLI::ConfigItem> settings;
    ValueCheck check;
    for (const FileEntry& entry : yaml ? yaml_entries(file, input) : toml_entries(file, input)) {
      const std::string value = value_of(file, entry);
      if (std::getenv(environment_name(entry.name).c_str()) != nullptr) continue;
      // An empty list is that of the defaults, where it may be empty.
      if (is_list(entry.name) && value.empty() && !needs_entry(entry.name)) continue;
      if (const auto fault = check.fault_of(entry.name, value))
        refuse_file(file, entry.line, *fault);
      CLI::ConfigItem item;
      item.name = entry.name;
      item.inputs = {value};
      settings.push_back(std::move(item));
    }
    return settings;
  }

 private:
  [[nodiscard]] bool is_list(const std::string& name) const {
    return app_.get_option("--" + name)->get_delimiter() != '\0';
  }
  [[nodiscard]] bool needs_entry(const std::string& name) const {
    return app_.get_option("--" + name)->get_expected_min() > 0;
  }

  // A list in the form that flags and the environment have it.
  [[nodiscard]] std::string value_of(const std::string& file, const FileEntry& entry) const {
    const CLI::Option* option = app_.get_option_no_throw("--" + entry.name);
    if (option == nullptr || !option->get_configurable())
      refuse_file(file, entry.line,
                  "there is no setting '" + entry.name + "'" +
                      did_you_mean(entry.name, setting_names(app_)));
    if (!is_list(entry.name)) {
      if (entry.values.size() == 1) return entry.values.front();
      refuse_file(file, entry.line, "'" + entry.name + "' is one value, not a list");
    }
    if (entry.values.empty() && needs_entry(entry.name))
      refuse_file(file, entry.line, "'" + entry.name + "' needs at least one entry");
    std::string joined;
    for (std::size_t i = 0; i < entry.values.size(); ++i) {
      if (entry.values.size() > 1 && entry.values[i].find(',') != std::string::npos)
        refuse_file(file, entry.line, "'" + entry.values[i] + "' holds a comma");
      joined += (i > 0 ? "," : "") + entry.values[i];
    }
    return joined;
  }

  const CLI::App& app_;
};

// Kubernetes and linked containers tell each other where a service named trcd is.
bool is_service_link(std::string_view variable) {
  const std::size_t port = variable.find("_PORT_");
  return variable.ends_with("_SERVICE_HOST") ||
         variable.find("_SERVICE_PORT") != std::string_view::npos || variable.ends_with("_PORT") ||
         (port != std::string_view::npos && port + 6 < variable.size() &&
          std::isdigit(static_cast<unsigned char>(variable[port + 6])) != 0);
}

// A misspelt variable is a setting that somebody believes to be in force.
std::optional<std::string> fault_of_environment(const CLI::App& app) {
  std::vector<std::string> known{"TRCD_CONFIG"};
  for (const std::string& name : setting_names(app)) known.push_back(environment_name(name));
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view whole = *entry;
    const std::string variable(whole.substr(0, whole.find('=')));
    if (!variable.starts_with("TRCD_") || is_service_link(variable)) continue;
    if (std::find(known.begin(), known.end(), variable) == known.end())
      return "there is no setting for the environment variable " + variable +
             did_you_mean(variable, known);
  }
  return std::nullopt;
}

std::optional<std::string> fault_of_address(const std::string& address) {
  if (address.starts_with(unix_prefix)) {
    const std::size_t length = address.size() - unix_prefix.size();
    if (length == 0) return "listen: '" + address + "' names no path";
    if (length > longest_unix_path)
      return "listen: the path of '" + address + "' is longer than 107 bytes";
    return std::nullopt;
  }
  if (!split_host_port(address))
    return "listen: '" + address + "' is not HOST:PORT, [IPV6]:PORT or unix:/path";
  return std::nullopt;
}

// A port without TLS: HOST:PORT of this machine, unless more is allowed; empty: none.
std::optional<std::string> fault_of_plain_port(const std::string& name, const std::string& address,
                                               const std::string& permission, bool allowed) {
  if (address.empty()) return std::nullopt;
  if (!split_host_port(address)) return name + ": '" + address + "' is not HOST:PORT";
  if (allowed || is_local_address(address)) return std::nullopt;
  return name + ": '" + address +
         "' can be reached by other machines in plain text; allow that with " + permission;
}

// Options that do not exist, said with what was likely meant.
std::string fault_of_extras(const CLI::App& app, int argc, const char* const* argv,
                            const std::string& fault) {
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options())
    known.push_back("--" + option->get_lnames().front());
  for (int i = 1; i < argc; ++i) {
    const std::string_view whole = argv[i];
    const std::string word(whole.substr(0, whole.find('=')));
    if (word.starts_with("--") && std::find(known.begin(), known.end(), word) == known.end())
      return "there is no option " + word + did_you_mean(word, known);
  }
  return fault;
}

// A guard that stands empty, as one does that a variable was to be put into, would be switched off
// without a word. In a file it may be: there it is written down as such.
std::optional<std::string> fault_of_empty_guard(int argc, const char* const* argv) {
  for (const std::string guard :
       {"tls-cert-file", "tls-key-file", "tls-client-ca-file", "tls-allowed-clients"}) {
    const std::string variable = environment_name(guard);
    const char* value = std::getenv(variable.c_str());
    if (value != nullptr && *value == '\0')
      return variable + " is set but empty; give it a value or unset it";
    for (int i = 1; i < argc; ++i) {
      const std::string_view word = argv[i];
      const bool alone = word == "--" + guard && (i + 1 == argc || *argv[i + 1] == '\0');
      if (alone || word == "--" + guard + "=") return guard + " is given but empty";
    }
  }
  return std::nullopt;
}

std::optional<std::string> fault_of_file(const std::string& name, const std::string& path) {
  if (path.empty() || std::ifstream(path).good()) return std::nullopt;
  return name + ": cannot read '" + path + "'";
}

std::optional<std::string> fault_of_http(const Config& config, bool tls) {
  if (config.http_listen.empty()) return std::nullopt;
  if (!split_host_port(config.http_listen))
    return "http-listen: '" + config.http_listen + "' is not HOST:PORT";
  if (!tls && !is_local_address(config.http_listen) && !config.insecure_http)
    return "http-listen: '" + config.http_listen +
           "' can be reached by other machines; give tls-cert-file and tls-key-file, or allow "
           "plain text with insecure-http";
  for (const std::string& origin : config.http_cors_origins)
    if (!origin.starts_with("https://") && !origin.starts_with("http://"))
      return "http-cors-origins: '" + origin + "' is no origin, as in https://mes.example";
  return std::nullopt;
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

std::optional<std::string> first_fault(const Config& config) {
  if (config.listen.empty()) return "listen: at least one address is needed";
  for (const std::string& address : config.listen)
    if (auto fault = fault_of_address(address)) return fault;
  if (auto fault = fault_of_plain_port("admin-listen", config.admin_listen, "insecure-admin",
                                       config.insecure_admin || config.insecure))
    return fault;
  if (auto fault = fault_of_plain_port("health-listen", config.health_listen, "insecure-health",
                                       config.insecure_health || config.insecure))
    return fault;

  const bool tls = !config.tls_cert_file.empty();
  if (auto fault = fault_of_http(config, tls)) return fault;
  if (tls != !config.tls_key_file.empty())
    return "tls-cert-file and tls-key-file must be given together";
  if (!tls && !config.tls_client_ca_file.empty())
    return "tls-client-ca-file needs tls-cert-file and tls-key-file";
  if (!config.tls_allowed_clients.empty() && config.tls_client_ca_file.empty())
    return "tls-allowed-clients needs tls-client-ca-file";
  for (const auto& [name, path] :
       {std::pair<const char*, const std::string&>{"tls-cert-file", config.tls_cert_file},
        {"tls-key-file", config.tls_key_file},
        {"tls-client-ca-file", config.tls_client_ca_file}})
    if (auto fault = fault_of_file(name, path)) return fault;

  if (!tls && !config.insecure) {
    for (const std::string& address : config.listen)
      if (!is_local_address(address))
        return "listen: '" + address +
               "' can be reached by other machines; give tls-cert-file and tls-key-file, or allow "
               "plain text with insecure";
  }
  return std::nullopt;
}

CommandLine read_command_line(int argc, const char* const* argv) {
  CommandLine result;
  CLI::App app("trcd: computes CNC tool radius compensation as a gRPC service", "trcd");
  Printed printed;
  declare(app, result.config, printed);
  app.set_version_flag("--version", "trcd " + std::string(version()));
  // The file is read before CLI11 looks at the environment, so its name is looked up here.
  const char* file = std::getenv("TRCD_CONFIG");
  app.set_config(
         "--config", file != nullptr ? file : "",
         "TOML file, or YAML if named .yaml or .yml, with the same settings (Env:TRCD_CONFIG)",
         file != nullptr)
      ->configurable(false);
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.config_formatter(std::make_shared<ConfigFile>(app));
  bool print = false;
  app.add_flag("--print-config", print, "print the settings in force and exit")
      ->configurable(false);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    std::ostringstream text;
    app.exit(asked, text, text);
    result.exit = CommandLine::Exit{.code = 0, .text = text.str()};
    return result;
  } catch (const CLI::Error& fault) {
    const auto guard = fault_of_empty_guard(argc, argv);
    const bool extra = fault.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
    const std::string text =
        extra ? fault_of_extras(app, argc, argv, fault.what()) : std::string(fault.what());
    result.exit = CommandLine::Exit{.code = 2, .text = guard.value_or(one_line(text))};
    return result;
  }
  if (const auto fault = fault_of_environment(app)) {
    result.exit = CommandLine::Exit{.code = 2, .text = one_line(*fault)};
    return result;
  }
  if (app.get_option("--reflection")->count() == 0) {
    const auto& listen = result.config.listen;
    result.config.reflection = std::all_of(listen.begin(), listen.end(), is_local_address);
  }
  auto fault = fault_of_empty_guard(argc, argv);
  if (!fault) fault = first_fault(result.config);
  if (fault) {
    result.exit = CommandLine::Exit{.code = 2, .text = *fault};
  } else if (print) {
    result.exit = CommandLine::Exit{.code = 0, .text = {}};
    for (const auto& setting : printed) result.exit->text += setting();
  }
  return result;
}

}  // namespace trc::server
