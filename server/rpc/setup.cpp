#include "server/rpc/setup.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "core/base/version.h"

namespace trc::server {
namespace {

void apply_limits(const Config& config, SessionSetup& session) {
  Limits& limits = session.compensator.limits;
  limits.selection_blocks = config.max_blocks_per_selection;
  limits.passive_blocks = std::min<std::size_t>(limits.passive_blocks, config.max_passive_blocks);
}

}  // namespace

std::optional<Ending> read_setup(const v1::PathSetup& message, const Config& config,
                                 wire::PathSettings& settings) {
  wire::FieldFaults faults;
  settings = wire::from_proto(message, wire::FieldPath("setup"), faults);
  if (!faults.empty()) return refuse(faults);
  apply_limits(config, settings.session);
  return std::nullopt;
}

std::optional<Ending> read_setup(const v1::ProgramSetup& message, const Config& config,
                                 wire::ProgramSettings& settings) {
  wire::FieldFaults faults;
  settings = wire::from_proto(message, wire::FieldPath("setup"), faults);
  if (!faults.empty()) return refuse(faults);
  apply_limits(config, settings.path.session);
  return std::nullopt;
}

std::optional<Ending> read_setup(const v1::SurveySetup& message, const Config& config,
                                 wire::SurveySettings& settings) {
  wire::FieldFaults faults;
  settings = wire::from_proto(message, wire::FieldPath("setup"), faults);
  if (!faults.empty()) return refuse(faults);
  const wire::FieldPath setup("setup");
  const wire::FieldPath program(setup, "program");
  const v1::PathSetup& path = message.has_path() ? message.path() : message.program().path();
  const wire::FieldPath place(message.has_path() ? setup : program, "path");
  if (auto refused = refuse_tokens(path, place, "SurveyRadii")) return refused;
  apply_limits(config, settings.program.path.session);
  return std::nullopt;
}

std::optional<Ending> refuse_tokens(const v1::PathSetup& setup, const wire::FieldPath& place,
                                    std::string_view rpc) {
  if (!setup.resume_token().empty())
    return refuse(Refusal::resume_token_invalid, std::string(rpc) + " takes none",
                  {{"field", wire::FieldPath(place, "resume_token").text()}});
  if (!setup.want_resume_tokens()) return std::nullopt;
  wire::FieldFaults faults;
  wire::add_fault(wire::FieldPath(place, "want_resume_tokens"),
                  "is set, but " + std::string(rpc) + " gives no resume tokens", faults);
  return refuse(faults);
}

void accept(const Config& config, v1::StreamAccepted& accepted) {
  accepted.set_max_blocks_per_batch(config.max_blocks_per_batch);
  accepted.set_max_batches_in_flight(config.max_batches_in_flight);
  accepted.set_max_message_bytes(config.max_message_bytes);
  accepted.set_server_version(std::string(version()));
  accepted.set_core_version(std::string(version()) + "+" + std::string(commit()));
}

}  // namespace trc::server
