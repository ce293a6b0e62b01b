#pragma once

#include <string>

#include "client/cli/service.h"
#include "core/base/language.h"
#include "core/base/length_unit.h"
#include "proto/wire/path_item.h"
#include "trc/v1/setup.pb.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::cli {

// The conditions of a compensation, a line each, with `name` as in "part.nc: " before it, in the
// language of the setup: dialect and unit, the settings that are no default, the tools (mm), and
// the service with its version and the limits a program of that size meets.
[[nodiscard]] std::string text_of_taken(const std::string& name, const v1::ProgramSetup& setup,
                                        const ServiceOptions& service,
                                        const v1::GetServerInfoResponse& info);

// Tells the former on standard error, as -v asks for. The service is asked what it is.
[[nodiscard]] Exit tell_taken(const std::string& name, const v1::ProgramSetup& setup,
                              const ServiceOptions& service);

// How a result is put into words.
struct Telling {
  Language language = Language::english;
  LengthUnit unit = LengthUnit::mm;  // of lengths, as the program counts
};

// The work of the engine: lines, blocks by origin, lengths and the radius, the measurements, and
// the times in s. `seconds`: from the call to the last block.
[[nodiscard]] std::string text_of_done(const std::string& name, const wire::ProgramSummary& summary,
                                       double seconds, const Telling& telling);

}  // namespace trc::cli
