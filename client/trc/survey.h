#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "client/trc/connection.h"
#include "client/trc/failure.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::client {

// Takes a response as it comes: diagnostics of reading, a radius, the summary. False: no more is
// wanted.
using SurveySink = std::function<bool(const v1::SurveyRadiiResponse& response)>;

// Asks what tools of many radii make of an NC program. Nothing when all of it was answered. A
// server that has no room, or is lost, is waited for as the connection's ResumePolicy has it: the
// survey is asked for anew, and what comes again is not handed on a second time.
[[nodiscard]] std::optional<Failure> survey_program(const Connection& connection,
                                                    const v1::SurveySetup& setup,
                                                    std::string_view text, const SurveySink& sink);

}  // namespace trc::client
