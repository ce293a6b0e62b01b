#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/session/program_session.h"

namespace trc::testing {

// A setup whose NC text has coordinates of so many decimals.
[[nodiscard]] inline ProgramSessionSetup with_decimals(int decimals) {
  ProgramSessionSetup setup;
  setup.session.program.decimals = decimals;
  return setup;
}

// What a program session made of a whole program.
struct ProgramRun {
  std::string text{};
  std::vector<CompensatedBlock> blocks{};
  std::vector<Diagnostic> diagnostics{};
  bool completed = false;

  // The blocks as listing lines.
  [[nodiscard]] std::string listing() const;
  // "20035 at line 8" for each diagnostic, joined by "; ".
  [[nodiscard]] std::string reports() const;
};

// NC text out. `cut`: bytes given at once; 0: all.
[[nodiscard]] ProgramRun to_text(std::string_view program, const ProgramSessionSetup& setup = {},
                                 std::size_t cut = 0);
// Compensated blocks out.
[[nodiscard]] ProgramRun to_blocks(std::string_view program, ProgramSessionSetup setup = {});

}  // namespace trc::testing
