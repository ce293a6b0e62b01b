#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "core/base/diagnostic.h"
#include "core/trc/walls/walls.h"

namespace trc {

// A stretch of a contour the tool does not touch, as its blocks are masked or in a removed loop
// (D-39).
struct LeftOut {
  Source first{};       // its first block
  Source last{};        // and its last one
  double length = 0;    // mm of wall
  double of_walls = 0;  // mm, of the whole selection; 0: not known yet
  double tool_radius = 0;
  // mm: of this one, or of all that are longer than 10 · R together, once they have been added.
  double in_all = 0;
  // The walls go round a part of the workpiece, or most of them are left out, in stretches as short
  // as they may be.
  bool is_a_part = false;

  // Another stretch of the same selection; the longest one stays.
  void add(const LeftOut& other);
  // Longer than 10 · R, which is seldom what was meant.
  [[nodiscard]] bool is_long() const;
  [[nodiscard]] bool is_more_than(double share) const {
    return std::max(length, in_all) > share * of_walls;
  }
};

// Whether a long stretch, from one block of the contour to another one, is a lap or nearly all of
// one that others do not make up for; `of_walls` of it is known.
[[nodiscard]] bool holds_a_lap(const Walls& walls, std::size_t first, std::size_t last,
                               const LeftOut& stretch);

// What is said of it: a note; a warning where it is longer than 10 · R, or no local damage (D-99).
[[nodiscard]] Diagnostic note_of(const LeftOut& stretch);
// 900218, where that is more than the share of the walls that may be left out; nothing: where it is
// what may not be left out whatever its share.
[[nodiscard]] Diagnostic refusal_of(const LeftOut& stretch, std::optional<double> largest_share);

}  // namespace trc
