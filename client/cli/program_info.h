#pragma once

#include <string>

#include "core/session/program_session.h"

namespace trc::cli {

// A description of a program for `trc info FILE`: how it reads in the declared dialect and what it
// looks like, its selections with their lengths, and what would be refused.
struct ProgramInfo {
  std::string text{};  // lines for the screen
  bool refused = false;
};

// `setup`: what the program is to be compensated with.
[[nodiscard]] ProgramInfo describe_program(const std::string& program, ProgramSessionSetup setup);

}  // namespace trc::cli
