#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/tolerances.h"
#include "core/trc/corner/chords.h"
#include "core/trc/path_block.h"

namespace trc {

// Keeps artefacts of rounding from deciding anything (rule 5.4, D-44). First, very short lines that
// only rounding has made: the last micrometre to the point where a contour began, a step back, a
// corner in two points. Where such a line turns, it is laid onto the line that joins the ends of
// itself and the line before it, or else the one after it. Second, the corners of fine steps: with
// a tool that is large beside them they take more than a whole line, and are removed where that
// moves the contour by next to nothing. Each line stays a block, as long as the corners at the ends
// need it. Lines that also move other axes, or have another feed, stay as they are: their effect
// belongs to its place. Flat arcs are taken for lines where corners would leave nothing of them.
//
//   A ------------ B       B–C is 1 µm long, and turns: both blocks lie on A–C then.
//                  C
//
// Under REMOVE_MASKED_BLOCKS a contour keeps every digit except between its ends: loop removal
// takes such corners out anyway.
//
// Holds such lines, at most `most_held` and one more, and the line before the first.
class RoundedInput {
 public:
  // `input_resolution` in mm; 0: every line is meant.
  RoundedInput(double input_resolution, const Tolerances& tolerances)
      : input_resolution_(input_resolution), tolerances_(tolerances) {}

  bool feed(PathBlockPtr block, PathBlocks& out);
  bool drain(PathBlocks& out);
  [[nodiscard]] bool ignores(const PathBlock& block) const {
    return held_.empty() && !block.before_short &&
           !(is_short(block.programmed, input_resolution_) && can_hold(block));
  }

  // Whether rounding may decide about a corner of the line.
  [[nodiscard]] static bool is_short(const MotionBlock& motion, double input_resolution);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(held_, chords_, before_, behind_contour_, begins_);
  }

 private:
  static constexpr std::size_t most_held = 64;

  [[nodiscard]] bool can_hold(const PathBlock& block) const;
  [[nodiscard]] bool continues(const PathBlock& block) const;
  [[nodiscard]] Line line_of(const Chord& chord) const;
  [[nodiscard]] ChordCourse course_of(const Chord& chord) const;
  [[nodiscard]] bool has_arcs() const;
  [[nodiscard]] bool is_in_the_way(const Line& before, const Line& after) const;
  // mm that corners may take of a chord; without end if rounding does not matter there.
  [[nodiscard]] double room_of(const Chord& chord, const ChordCourse& course) const;
  // By the corner at the start of a chord.
  [[nodiscard]] ChordCut cut_at_start(std::size_t chord) const;
  // Whether the corners at both ends leave nothing of a chord. `behind`: what follows the last one.
  [[nodiscard]] bool is_used_up(std::size_t chord, const std::optional<ChordCourse>& behind) const;
  [[nodiscard]] bool is_exact() const;
  [[nodiscard]] bool may_be_one(const Chord& chord) const;
  // Joins a chord and the one after it, where that is allowed.
  bool join(std::size_t first);
  bool join_with_line_before(std::size_t chord);
  bool move_corner_behind(std::size_t chord);
  // Joins chords so that all have the same number of lines.
  bool make_even();
  bool divide_anew(const std::optional<ChordCourse>& behind);
  [[nodiscard]] bool are_all_free() const;
  void smooth();
  void smooth_last_before(const ChordCourse& behind);
  // `next`: the block that follows, if any.
  void end_before(const PathBlock* next, PathBlocks& out);
  // `behind`: the contour block that follows.
  void release_all(const std::optional<ChordCourse>& behind, PathBlocks& out);
  void release_first(const std::optional<ChordCourse>& behind_all, PathBlocks& out);
  void lay_onto(const Line& line, std::size_t count, const std::optional<ChordCourse>& behind);
  void release_some(PathBlocks& out);

  double input_resolution_;
  Tolerances tolerances_;
  PathBlocks held_;
  std::vector<Chord> chords_;
  std::vector<Chord> before_even_;
  std::optional<ChordCourse>
      before_;                   // of the contour block before the held ones; its room is left
  bool behind_contour_ = false;  // what was fed last
  bool begins_ = false;          // the held line is short, and the first of its contour
};

}  // namespace trc
