#include "server/rpc/get_server_info.h"

#include <grpcpp/grpcpp.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/diagnostic.h"
#include "core/base/tolerances.h"
#include "core/base/version.h"
#include "core/messages/english.h"
#include "core/nc/dialect/dialect.h"
#include "core/nc/dialect/g_function.h"
#include "core/nc/dialect/trc_command.h"
#include "core/nc/state/program_state.h"
#include "proto/wire/diagnostic.h"
#include "proto/wire/setting_meanings.h"
#include "proto/wire/settings.h"
#include "proto/wire/setup.h"

namespace trc::server {
namespace {

#ifdef __clang__
constexpr std::string_view compiler = __VERSION__;
#else
constexpr std::string_view compiler = "gcc " __VERSION__;
#endif

void describe_limits(const Config& config, v1::Limits& limits) {
  limits.set_max_message_bytes(config.max_message_bytes);
  limits.set_max_blocks_per_batch(config.max_blocks_per_batch);
  limits.set_max_batches_in_flight(config.max_batches_in_flight);
  limits.set_max_selection_blocks(config.max_blocks_per_selection);
  limits.set_max_memory_bytes(std::uint64_t{config.max_session_memory_mib} << 20U);
  limits.set_max_streams_per_connection(config.max_streams_per_connection);
  limits.set_max_streams(config.max_streams);
  limits.set_max_line_bytes(config.max_line_bytes);
  limits.set_idle_timeout_seconds(config.idle_timeout_s);
  limits.set_max_coordinate(Tolerances{}.largest_coordinate);
}

// The terms of the radius (D-43).
void describe_radius_terms(v1::GetServerInfoResponse& response) {
  constexpr double largest = ToolInForce::largest_tool_radius;
  const ProgramSetup initial;
  const auto add = [&](const char* name, double least, double most, double value) {
    v1::RadiusTerm& term = *response.add_radius_terms();
    term.set_name(name);
    term.set_min(least);
    term.set_max(most);
    term.set_default_value(value);
    term.set_meaning(std::string(wire::meaning_of(name).meaning));
  };
  add("tool_radius", -largest, largest, initial.mode.tool_radius);
  add("wear", -initial.max_wear, initial.max_wear, initial.wear);
  add("allowance", -largest, largest, initial.allowance);
  add("nominal_radius", 0, largest, initial.nominal_radius);
}

void describe_settings(v1::GetServerInfoResponse& response) {
  for (const wire::SettingRow& setting : wire::settings()) {
    const wire::SettingMeaning& about = wire::meaning_of(setting.key);
    v1::Setting& row = *response.add_settings();
    row.set_name(setting.key);
    row.set_values(setting.values);
    if (std::isfinite(about.least)) {
      row.set_min(about.least);
      row.set_max(about.most);
    }
    row.set_unit(std::string(about.unit));
    row.set_default_value(std::string(about.initial));
    row.set_meaning(std::string(about.meaning));
  }
}

// G01, G41, G138
std::string as_written(std::int16_t number) {
  return (number < 10 ? "G0" : "G") + std::to_string(number);
}

}  // namespace

void describe(const Config& config, v1::GetServerInfoResponse& response) {
  response.set_version(std::string(version()));
  response.set_commit(std::string(commit()));
  std::string& build = *response.mutable_build();
  build = compiler;
  build.append(", gRPC ").append(grpc::Version());
  build.append(", protobuf ")
      .append(google::protobuf::internal::VersionString(GOOGLE_PROTOBUF_VERSION));
  describe_limits(config, *response.mutable_limits());
  describe_radius_terms(response);
  describe_settings(response);
  for (const TrcKeyword& keyword : trc_keywords()) {
    v1::TrcKeyword& row = *response.add_trc_keywords();
    row.set_name(std::string(keyword.name));
    row.set_min(keyword.smallest);
    row.set_max(keyword.largest);
    row.set_default_value(keyword.initial);
    row.set_unit(std::string(keyword.unit));
    row.set_available(keyword.available);
    row.set_meaning(std::string(keyword.meaning));
  }
  for (const GFunction& function : g_function_table()) {
    v1::GFunction& row = *response.add_g_functions();
    row.set_name(as_written(function.number));
    row.set_group(std::string(name_of(function.group)));
    row.set_initial(function.initial);
    row.set_meaning(std::string(function.meaning));
  }
  for (const Dialect& dialect : all_dialects()) response.add_dialects(wire::to_proto(dialect.name));
  for (const CodeRow& code : code_table()) {
    v1::DiagnosticRow& row = *response.add_diagnostics();
    row.set_code(static_cast<std::int32_t>(code.code));
    row.set_severity(wire::to_proto(code.severity));
    row.set_reason(std::string(code.reason));
    const EnglishRow& english = english_row_of(code.code);
    row.set_cause(std::string(english.cause));
    row.set_remedy(std::string(english.remedy));
  }
}

}  // namespace trc::server
