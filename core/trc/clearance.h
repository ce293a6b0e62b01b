#pragma once

#include <cstddef>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/trc/path_block.h"

namespace trc {

// Looks for bottlenecks: path blocks that come closer to any programmed block of
// their selection than the tool radius, however far apart on the contour. Under
// G141 each is a warning (spec 5.1: loops that still violate stay); with
// P-CHAN-00219 the first one stops, also under G140 (D-34).
//
// Holds such a selection as a whole; all else passes through at once.
class Clearance {
 public:
  Clearance(bool implicit_contour_masking, std::size_t selection_blocks,
            const Tolerances& tolerances, Diagnostics& diagnostics)
      : implicit_(implicit_contour_masking),
        selection_blocks_(selection_blocks),
        tolerances_(tolerances),
        diagnostics_(diagnostics) {}

  bool feed(PathBlock block, std::vector<PathBlock>& out);
  bool drain(std::vector<PathBlock>& out) { return resolve(out); }
  // Of the selections it holds as a whole; nothing else.
  [[nodiscard]] std::size_t look_ahead() const { return 0; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(held_);
  }

 private:
  bool resolve(std::vector<PathBlock>& out);
  bool report(const PathBlock& path, const PathBlock& contour, double distance, const Point& place);

  bool implicit_;
  std::size_t selection_blocks_;
  Tolerances tolerances_;
  Diagnostics& diagnostics_;
  std::vector<PathBlock> held_;
};

}  // namespace trc
