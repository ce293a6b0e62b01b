#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/session/program_session.h"

namespace trc::support {

// What comes out of a program.
struct Written {
  std::string text{};
  std::vector<CompensatedBlock> blocks{};
  std::vector<Diagnostic> diagnostics{};
  bool stopped = false;

  // The diagnostics, a line each.
  [[nodiscard]] std::string report() const;
};

// The text in pieces of so many bytes; 0: as a whole. Its diagnostics are checked to be German in
// German.
Written run(const std::string& text, ProgramSessionSetup setup, bool nc_text,
            std::size_t piece = 0);

// In space, at 0 … 1 of the block.
[[nodiscard]] Eigen::Vector3d place_at(const CompensatedBlock& block, double t);

}  // namespace trc::support
