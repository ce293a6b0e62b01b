#pragma once

#include <string>

#include "core/session/path_session.h"
#include "core/session/program_session.h"
#include "proto/wire/field_fault.h"
#include "trc/v1/setup.pb.h"

namespace trc::wire {

// How compensated blocks travel; the content is the same.
enum class Layout { blocks, columns };

// Everything a stream of blocks is set up with.
struct PathSettings {
  SessionSetup session{};
  Layout response_layout = Layout::blocks;
  bool want_resume_tokens = false;
  std::string client_tag{};
  std::string resume_token{};
};

// Everything a stream of NC text is set up with.
struct ProgramSettings {
  PathSettings path{};  // its `session.program.tools` is the tool table
  bool nc_text = true;  // output as NC text; false: compensated blocks
  std::string file_name{};
};

// The result means something only while `faults` stays empty. Bounds that belong
// to the server (the longest line, the blocks of one selection) keep their
// defaults.
[[nodiscard]] PathSettings from_proto(const v1::PathSetup& message, const FieldPath& path,
                                      FieldFaults& faults);
[[nodiscard]] ProgramSettings from_proto(const v1::ProgramSetup& message, const FieldPath& path,
                                         FieldFaults& faults);

[[nodiscard]] v1::Dialect to_proto(DialectName dialect);

// Of a subprogram, whatever encoding its text is in (D-80).
void add_subprogram(const std::string& name, const std::string& text, v1::ProgramSetup& message);

// Values at their default are left out, those of circles excepted.
void to_proto(const PathSettings& settings, v1::PathSetup& message);
void to_proto(const ProgramSettings& settings, v1::ProgramSetup& message);

}  // namespace trc::wire
