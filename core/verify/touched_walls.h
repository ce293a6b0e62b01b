#pragma once

#include <cstddef>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/verify/clearance.h"
#include "core/verify/coverage.h"
#include "core/verify/selection_walls.h"

namespace trc::verify {

// What of the walls of one selection the path touches.
class TouchedWalls {
 public:
  struct Range {
    std::size_t begin = 0;  // of the programmed pieces
    std::size_t end = 0;
  };
  // `keep_places`: else only how much it is can be told.
  TouchedWalls(const MeasuredPath& held, const SelectionWalls& walls, const Range& pieces,
               bool keep_places)
      : held_(held), walls_(walls), pieces_(pieces) {
    if (keep_places) touched_.resize(pieces.end - pieces.begin);
  }

  void add(std::size_t number, const Stretch& stretch) {
    if (!(stretch.from < stretch.to)) return;
    length_ += stretch.length();
    if (!touched_.empty()) touched_[number - pieces_.begin].push_back(stretch);
  }
  [[nodiscard]] double length() const { return length_; }  // mm
  // What was kept as touched leaves over.
  void tell_uncut(const UncutSink& uncut, Checkpoint& checkpoint);

 private:
  void tell_uncut(const ProgrammedPiece& block, const Stretch& stretch,
                  const UncutSink& uncut) const;

  const MeasuredPath& held_;
  const SelectionWalls& walls_;
  Range pieces_;
  double length_ = 0;
  std::vector<std::vector<Stretch>> touched_;  // of each programmed piece, where that is asked for
};

}  // namespace trc::verify
