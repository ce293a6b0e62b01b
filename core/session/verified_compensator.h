#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/trc/compensator.h"
#include "core/verify/verification.h"

namespace trc {

// Called from time to time with the number of blocks of the path measured so far, and of all.
using MeasuringProgress = std::function<void(std::size_t measured, std::size_t all)>;

// Further wishes of a caller who has a path measured.
struct MeasuringNeeds {
  verify::UncutSink uncut{};                  // is told the walls that the path does not touch
  verify::KnownWalls* known_walls = nullptr;  // null: nothing is kept of them
  MeasuringProgress progress{};
};

// A compensator whose path is measured on its way out, where that is asked for.
class VerifiedCompensator {
 public:
  VerifiedCompensator(const CompensatorSetup& setup, Verify verify, Diagnostics& diagnostics,
                      MeasuringNeeds needs = {});
  VerifiedCompensator(const VerifiedCompensator&) = delete;
  VerifiedCompensator& operator=(const VerifiedCompensator&) = delete;

  // As of Compensator.
  std::size_t feed_until_report(std::span<Block> blocks, std::vector<CompensatedBlock>& out);
  bool finish_until_portion(const TrcMode& at_end, std::vector<CompensatedBlock>& out);
  [[nodiscard]] bool is_releasing() const { return compensator_.is_releasing(); }
  bool release(std::vector<CompensatedBlock>& out);

  void save(StateWriter& archive) const;
  void load(StateReader& archive);

  [[nodiscard]] const Summary& summary() const { return compensator_.summary(); }
  // The report on the selections measured so far; null where it was not asked for.
  [[nodiscard]] const verify::ClearanceReport* clearance() const {
    return verification_ ? &verification_->report() : nullptr;
  }
  // Memory the measurement holds, and what it will take in addition, bytes.
  [[nodiscard]] std::size_t verification_bytes() const {
    return verification_ ? verification_->held_bytes() : 0;
  }

 private:
  // Takes blocks that end no selection. Returns how many.
  std::size_t take_held(std::span<Block> blocks, std::vector<CompensatedBlock>& out);
  // Takes one block and measures the path.
  bool take(Block& block, std::vector<CompensatedBlock>& out);
  // Measures what is new in `out`, and at the end reports what follows from the whole path.
  bool measure(const std::vector<CompensatedBlock>& out);

  Compensator compensator_;
  Diagnostics& diagnostics_;
  std::optional<verify::Verification> verification_;
  std::size_t measured_ = 0;    // of `out`
  std::size_t told_ahead_ = 0;  // of the next blocks: the verification knows them
  bool finishing_ = false;      // nothing more is given
};

}  // namespace trc
