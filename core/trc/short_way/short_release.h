#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/tolerances.h"
#include "core/trc/loops/held_path_reader.h"
#include "core/trc/loops/loop_removal.h"
#include "core/trc/passes/reporting.h"
#include "core/trc/result/compensated_block.h"
#include "core/trc/setup.h"

namespace trc {

// The short way out of LoopRemoval: what leaves a selection as it came goes from the held path
// straight into the result, without becoming a path block again. What comes out is bit for bit what
// the passes put out; it stops before a block that is left to them, as ShortWay does.
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
  // Puts out blocks from the first of the row on, up to one that the passes have to put out.
  // Returns how many.
  std::size_t put_out_row(const LoopRelease::Row& row, std::vector<CompensatedBlock>& out);
  // The lines in place of the arc it is at, all or none.
  bool put_out_lines(const HeldPath::Reader& held, std::size_t transition,
                     std::vector<CompensatedBlock>& out);
  // What is travelled of one, where that is not all of it.
  bool put_out_part(const PathPiece& part, std::vector<CompensatedBlock>& out);
  [[nodiscard]] bool may_put_out(const HeldPath::Setting& setting) const;
  // Does nothing where the passes have to do it. `cuts`: what removed loops have cut.
  template <class Path>
  bool put_out_path(const HeldPath::Reader& held, const Path& path, const HeldPath::Cuts& cuts,
                    std::vector<CompensatedBlock>& out);
  // mm; nothing where the path of a contour block is a contour violation.
  [[nodiscard]] std::optional<double> programmed_length(const HeldPath::Reader& held,
                                                        const Vector& travelled,
                                                        const HeldPath::Cuts& more) const;

  bool inverse_path_;
  Tolerances tolerances_;
  LoopRemoval& loop_removal_;
  Reporting& reporting_;
};

}  // namespace trc
