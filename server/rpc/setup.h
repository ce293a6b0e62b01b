#pragma once

#include <optional>
#include <string_view>

#include "proto/wire/setup.h"
#include "proto/wire/survey.h"
#include "server/config/config.h"
#include "server/rpc/status.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server {

// Reads a setup and adds the limits of the server. The ending when it is refused.
std::optional<Ending> read_setup(const v1::PathSetup& message, const Config& config,
                                 wire::PathSettings& settings);
std::optional<Ending> read_setup(const v1::ProgramSetup& message, const Config& config,
                                 wire::ProgramSettings& settings);
std::optional<Ending> read_setup(const v1::SurveySetup& message, const Config& config,
                                 wire::SurveySettings& settings);

// Refuses the resume tokens of a setup whose RPC, `rpc`, begins anew with each request. `place`: of
// the setup of the path.
std::optional<Ending> refuse_tokens(const v1::PathSetup& setup, const wire::FieldPath& place,
                                    std::string_view rpc);

// The first response of a stream.
void accept(const Config& config, v1::StreamAccepted& accepted);

}  // namespace trc::server
