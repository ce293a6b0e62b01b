#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "core/base/checkpoint.h"
#include "core/base/diagnostics.h"
#include "core/trc/result/compensated_block.h"
#include "core/trc/result/refused_way.h"
#include "core/verify/clearance.h"
#include "core/verify/measured_path.h"

namespace trc {

// What a path is measured for.
enum class Verify : std::uint8_t {
  off,
  report,   // a path that comes too near is a warning
  enforce,  // it stops the stream
};

namespace verify {

struct VerificationSetup {
  Verify verify = Verify::enforce;
  ClearanceSettings clearance{};
  // Programmed blocks of one selection that are held until it is measured.
  std::size_t selection_blocks = 0;
  Checkpoint::Interrupt interrupt{};  // of long work
  // Looks for another way in where the path comes too near to where its contour begins and closes;
  // none: nobody does.
  std::function<std::shared_ptr<const EntryHelp>(const RefusedWay&)> help{};
};

// Measures a path as it comes out: what is programmed is given first, then the path it has
// become. A selection is held until all of its path is there, and measured then.
//
// Where the path comes nearer to the walls than the tool radius, that is 900216. A selection of
// more blocks than may be held is not measured: 900212, as severe, and so is 900229, an approach or
// a retract through a wall. As a warning it is told with the
// path of that block. If the selection is refused, it is not told.
class Verification {
 public:
  Verification(VerificationSetup setup, Diagnostics& diagnostics)
      : setup_(std::move(setup)), diagnostics_(diagnostics), checkpoint_(setup_.interrupt) {}

  // So many of the next blocks are only held: none ends a selection, none is too many, and no path
  // of them is measured.
  [[nodiscard]] std::size_t held_only(std::span<const Block> blocks) const;

  // All return whether the stream goes on.
  bool programmed(const Block& block);
  bool compensated(std::span<const CompensatedBlock> path);
  // No more of either.
  bool finish();

  // Of all selections that have been measured.
  [[nodiscard]] const ClearanceReport& report() const { return report_; }
  // Memory it holds, and what measuring that will take in addition, bytes.
  [[nodiscard]] std::size_t held_bytes() const { return held_.bytes(); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(held_, approaches_, ends_, too_long_, unmeasured_, is_untold_, report_.worst,
            report_.gouge, report_.checked, report_.walls, report_.gouging, report_.wall_length,
            report_.touched_length);
  }

 private:
  // What was programmed before `end` has all come out.
  bool measure_before(const Source& end);
  // The way in and the contour, where that begins and closes at the worst place.
  [[nodiscard]] std::optional<RefusedWay> way_that_closes_at(const Clearance& worst) const;
  bool tell_unmeasured();
  // A diagnostic that tells of what was measured, or not.
  bool tell(Diagnostic problem);

  VerificationSetup setup_;
  Diagnostics& diagnostics_;
  Checkpoint checkpoint_;
  MeasuredPath held_;                   // the motions of selections, and their path
  std::deque<MotionBlock> approaches_;  // the first motion of each of these selections
  std::deque<Source> ends_;             // the first motion after each selection that has ended
  std::uint32_t too_long_ = 0;          // the selection that is not held; 0: none
  Source unmeasured_{};                 // the first block of it that was too many
  bool is_untold_ = false;              // a warning of that waits for the path of this block
  ClearanceReport report_;
};

}  // namespace verify
}  // namespace trc
