#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/trc/result/compensated_block.h"
#include "core/verify/clearance.h"

namespace trc::verify {

// Measures a path as it comes out: what is programmed is given first, then the path it has
// become. A selection is held until all of its path is there, and measured then.
//
// Where the path comes nearer to the contour than the tool radius the stream stops with
// 900216; under IGNORE_CONT_DAMAGE that is a warning.
class Verification {
 public:
  // `allowed`: how much nearer it may come, mm.
  Verification(double allowed, const LeadSettings& leads, Diagnostics& diagnostics)
      : allowed_(allowed), leads_(leads), diagnostics_(diagnostics) {}

  void programmed(const Block& block);
  bool compensated(std::span<const CompensatedBlock> path);
  // No more of either.
  bool finish();

  // Of all selections that have been measured.
  [[nodiscard]] const ClearanceReport& report() const { return report_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(programmed_, path_, ends_, report_.worst, report_.checked, report_.gouging,
            report_.accepted, report_.wall_length, report_.touched_length);
  }

 private:
  // What was programmed before `end` has all come out.
  bool measure_before(std::uint64_t end);

  double allowed_;
  LeadSettings leads_;
  Diagnostics& diagnostics_;
  std::vector<Block> programmed_;  // the motions of selections
  std::vector<CompensatedBlock> path_;
  std::deque<std::uint64_t> ends_;  // the first motion behind each selection that has ended
  ClearanceReport report_;
};

}  // namespace trc::verify
