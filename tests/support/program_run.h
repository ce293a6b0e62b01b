#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/session/program_session.h"
#include "tests/support/run.h"

namespace trc::support {

// What a ProgramSession makes of a program, up to the error that stops it.
struct ProgramRun : Outcome {
  std::string text{};

  // The blocks as listing lines.
  [[nodiscard]] std::string listing() const;
  // "20035 at line 8" for each diagnostic, joined by "; ".
  [[nodiscard]] std::string codes() const;
  // "8: 20035 MESSAGE" for each diagnostic, a line each.
  [[nodiscard]] std::string report() const;
};

// Whether the German texts of the diagnostics are checked to hold no English word. Words of a
// program, which they quote, count as English where it writes them in small letters.
enum class German { checked, as_it_is };

// NC text out. The program is fed in pieces of `piece` bytes; 0: as a whole.
[[nodiscard]] ProgramRun to_text(std::string_view program, ProgramSessionSetup setup = {},
                                 std::size_t piece = 0, German german = German::checked);
// Compensated blocks out; else as `to_text`.
[[nodiscard]] ProgramRun to_blocks(std::string_view program, ProgramSessionSetup setup = {},
                                   std::size_t piece = 0, German german = German::checked);

// A setup whose NC text has coordinates of so many decimals.
[[nodiscard]] ProgramSessionSetup with_decimals(int decimals);

// The point at 0 … 1 of the block, the third main axis included.
[[nodiscard]] Eigen::Vector3d point_in_space(const CompensatedBlock& block, double t);

[[nodiscard]] std::string listing_of(const std::vector<CompensatedBlock>& blocks);

}  // namespace trc::support
