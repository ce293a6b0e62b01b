#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/segment.h"

namespace trc {

// Consecutive blocks of a contour that RoundedInput takes as one line, or a single arc.
struct Chord {
  std::size_t first = 0;  // among the blocks
  std::size_t count = 1;
  bool straight = false;  // a line, also in place of an arc

  template <class Archive>
  void serialize(Archive& archive) {
    archive(first, count, straight);
  }
};

// The path beside a chord.
struct ChordCourse {
  Vector at_start = Vector::UnitX();  // tangents
  Vector at_end = Vector::UnitX();
  double room = INFINITY;  // mm that the corners at both ends may take
  // A quarter of the tool radius times the curvature of the path; positive: away from the tool.
  double bend = 0;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(at_start, at_end, room, bend);
  }
};

// The course of an arc, or of a line, for a tool `shift` mm to the left of it. Its room is its
// length.
[[nodiscard]] ChordCourse course_of(const Segment& path, double shift);

// The cut by a corner from the paths before and after it, mm.
struct ChordCut {
  double before = 0;
  double after = 0;
};

// None where the tool is outside the corner.
[[nodiscard]] ChordCut cut_between(const ChordCourse& before, const ChordCourse& after,
                                   double shift);
// None also where the corner turns by a right angle or more, which was intended.
[[nodiscard]] ChordCut cut_by_rounding(const ChordCourse& before, const ChordCourse& after,
                                       double shift);

// The most blocks of a chord that can be chosen.
inline constexpr std::size_t most_joined_blocks = 8;

// A chord that can be chosen, and its cost.
struct ChordChoice {
  Chord chord{};
  ChordCourse course{};
  double cost = 0;
};

// Of all ways to divide `blocks` blocks into some of these chords, the cheapest one whose corners
// leave something of every chord, also of what comes `before` them. Of the last chord the block
// that follows decides, unless its course is given as `behind`. Empty if there is none. The choices
// are in the order of their ends.
[[nodiscard]] std::vector<Chord> cheapest_division(const std::vector<ChordChoice>& choices,
                                                   std::size_t blocks,
                                                   const std::optional<ChordCourse>& before,
                                                   const std::optional<ChordCourse>& behind,
                                                   double shift);

}  // namespace trc
