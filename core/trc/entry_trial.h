#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/base/entry_help.h"
#include "core/geometry/segment.h"
#include "core/nc/state/block.h"
#include "core/trc/result/compensated_block.h"
#include "core/trc/result/refused_way.h"
#include "core/trc/setup.h"

namespace trc::selection {

// Motions in the plane that lead to the contour, or off it.
struct EntryWay {
  EntryProposal::Shape shape = EntryProposal::Shape::line;
  std::vector<Segment> motions{};
};

// Tries ways in place of a refused one: each is compensated with the known contour, in a
// Compensator of its own, and its path measured against that contour.
class EntryTrial {
 public:
  // `refused` must outlive it.
  EntryTrial(const RefusedWay& refused, const CompensatorSetup& setup)
      : refused_(refused),
        setup_(setup),
        refused_block_(refused.leaves() ? refused.blocks.back() : refused.blocks.front()),
        contour_(refused.leaves() ? std::span(refused.blocks).first(1)
                                  : std::span(refused.blocks).subspan(1)),
        nearest_contour_block_(contour_.front()),
        walls_(contour_.first(contour_.size() - refused.leads().leads_out)),
        plane_(refused_block_.mode->plane) {
    setup_.helps_with_entries = false;
  }

  // The contour that ways are tried with.
  [[nodiscard]] std::span<const MotionBlock> contour() const { return contour_; }
  // From now on the contour is used without the leads at its end.
  void leave_out_leads() { contour_ = walls_; }

  // Whether the way is accepted and clear.
  [[nodiscard]] bool does(const EntryWay& way) const;
  // Whether it is accepted; if not, `diagnostics` also get proposals in its place.
  [[nodiscard]] bool is_accepted_with_help(const EntryWay& way, Diagnostics& diagnostics) const;

 private:
  struct Tried {
    bool accepted = false;
    std::vector<CompensatedBlock> path{};
  };
  [[nodiscard]] Tried compensated(const EntryWay& way, CompensatorSetup setup,
                                  Diagnostics& diagnostics) const;
  [[nodiscard]] std::vector<Block> program(const EntryWay& way) const;
  [[nodiscard]] bool is_of_way(const CompensatedBlock& block, std::size_t motions) const;
  [[nodiscard]] bool is_clear(const Segment& path) const;

  const RefusedWay& refused_;
  CompensatorSetup setup_;
  const MotionBlock& refused_block_;
  std::span<const MotionBlock> contour_;
  const MotionBlock& nearest_contour_block_;
  std::span<const MotionBlock> walls_;
  Plane plane_;
};

}  // namespace trc::selection
