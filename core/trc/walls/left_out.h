#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "core/base/diagnostic.h"
#include "core/trc/walls/walls.h"

namespace trc {

// A stretch of a contour that the tool does not touch: its blocks are masked or in a removed loop
// (D-39).
struct LeftOut {
  Source first{};       // its first block
  Source last{};        // and its last one
  double length = 0;    // mm of wall
  double of_walls = 0;  // mm, of the whole selection; 0: not known yet
  double tool_radius = 0;
  // mm, of this one or, once they have been added, of all longer than 10 · R together.
  double in_all = 0;
  // The walls go round a part of the workpiece, or most of the walls are left out, however short
  // the stretches are.
  bool is_a_part = false;

  // Adds another stretch of the same selection; the longest one is kept.
  void add(const LeftOut& other);
  // Whether it is longer than 10 · R, which is seldom intended.
  [[nodiscard]] bool is_long() const;
  [[nodiscard]] bool is_more_than(double share) const {
    return std::max(length, in_all) > share * of_walls;
  }
};

// Whether a long stretch, from one block of the contour to another one, is all or nearly all of a
// lap that no other lap repeats; its `of_walls` is known.
[[nodiscard]] bool holds_a_lap(const Walls& walls, std::size_t first, std::size_t last,
                               const LeftOut& stretch);

// Its diagnostic: a note; a warning where it is longer than 10 · R, or no local damage (D-99).
[[nodiscard]] Diagnostic note_of(const LeftOut& stretch);
// 900218. `largest_share`: the share of the walls that may be left out and is exceeded; nothing:
// the stretch may not be left out whatever its share.
[[nodiscard]] Diagnostic refusal_of(const LeftOut& stretch, std::optional<double> largest_share);

}  // namespace trc
