#include "core/verify/touched_walls.h"

#include <algorithm>

namespace trc::verify {

void TouchedWalls::tell_uncut(const UncutSink& uncut, Checkpoint& checkpoint) {
  for (std::size_t place = pieces_.begin; place < pieces_.end; ++place) {
    checkpoint.pass();
    const ProgrammedPiece& block = held_.programmed()[place];
    if (!block.is_contour) continue;
    std::vector<Stretch>& touched = touched_[place - pieces_.begin];
    std::sort(touched.begin(), touched.end(),
              [](const Stretch& a, const Stretch& b) { return a.from < b.from; });
    Stretch left = walls_.wall_of(block);
    for (const Stretch& stretch : touched) {
      tell_uncut(block, {left.from, stretch.from}, uncut);
      left.from = std::max(left.from, stretch.to);
    }
    tell_uncut(block, left, uncut);
  }
}

void TouchedWalls::tell_uncut(const ProgrammedPiece& block, const Stretch& stretch,
                              const UncutSink& uncut) const {
  constexpr double shortest = 1e-3;  // mm
  if (stretch.length() < shortest) return;
  uncut({.source = block.source,
         .plane = held_.rule_of(block).plane,
         .path = part_of(segment_of(block.piece), stretch)});
}

}  // namespace trc::verify
