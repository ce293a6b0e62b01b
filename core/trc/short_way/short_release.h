#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/tolerances.h"
#include "core/trc/loops/held_path_reader.h"
#include "core/trc/passes/loop_removal.h"
#include "core/trc/passes/reporting.h"
#include "core/trc/result/compensated_block.h"
#include "core/trc/setup.h"

namespace trc {

// The short way out of LoopRemoval: blocks that leave a selection as they came go from the held
// path straight into the result, without becoming path blocks again. The output is bit for bit that
// of the passes; it stops before a block that is left to them, as ShortWay does.
class ShortRelease {
 public:
  ShortRelease(const CompensatorSetup& setup, LoopRemoval& loop_removal, Reporting& reporting)
      : inverse_path_(setup.inverse_path),
        tolerances_(setup.tolerances),
        loop_removal_(loop_removal),
        reporting_(reporting) {}

  // Puts out blocks until there are `most` in `out`. Returns whether there was one.
  bool put_out(std::vector<CompensatedBlock>& out, std::size_t most);

 private:
  // Puts out blocks from the first of the row on, up to a block that is left to the passes. Returns
  // how many.
  std::size_t put_out_row(const LoopRelease::Row& row, std::vector<CompensatedBlock>& out);
  // Puts out the lines that replace the present arc, all or none.
  bool put_out_lines(const HeldPath::Reader& held, std::size_t transition,
                     std::vector<CompensatedBlock>& out);
  // Puts out the travelled part of a block.
  bool put_out_part(const PathPiece& part, std::vector<CompensatedBlock>& out);
  [[nodiscard]] bool may_put_out(const HeldPath::Setting& setting) const;
  // Does nothing for blocks left to the passes. `cuts`: the parts cut off by removed loops.
  template <class Path>
  bool put_out_path(const HeldPath::Reader& held, const Path& path, const HeldPath::Cuts& cuts,
                    std::vector<CompensatedBlock>& out);
  // Length, mm; nothing where the path of a contour block is a contour violation.
  [[nodiscard]] std::optional<double> programmed_length(const HeldPath::Reader& held,
                                                        const Vector& travelled,
                                                        const HeldPath::Cuts& more) const;

  bool inverse_path_;
  Tolerances tolerances_;
  LoopRemoval& loop_removal_;
  Reporting& reporting_;
};

}  // namespace trc
