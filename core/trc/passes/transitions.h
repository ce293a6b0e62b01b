#pragma once

#include <optional>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/trc/corner/bow_tie.h"
#include "core/trc/corner/corner.h"
#include "core/trc/joints/joints.h"
#include "core/trc/path_block.h"
#include "core/trc/result/refused_way.h"

namespace trc {

// Joins each equidistant to the next one.
//
//     outside: insert            inside: trim
//
//      .---o                         |   |
//     /    |                         |   o---- kept
//    o     P=====                    |
//    |     |                         P=======
//
// P is the programmed corner. What is inserted: table of rule 4.2, G25 and G26; where the contour
// begins and ends: the rules of the selection modes in selection/. Does not see further than the
// next relevant block or, where that may be the short one of a bow tie, the one after it: holds at
// most two that are not masked.
class Transitions {
 public:
  Transitions(const Tolerances& tolerances, Diagnostics& diagnostics,
              std::optional<RefusedWay>& refused_way)
      : tolerances_(tolerances), diagnostics_(diagnostics), refused_way_(refused_way) {}

  bool feed(PathBlockPtr&& block, PathBlocks& out);
  bool drain(PathBlocks& out);
  // The block whose end is still open, if nothing waits behind it. ShortWay goes on from it.
  [[nodiscard]] PathBlock* open_block() {
    return masked_.empty() && !short_ ? held_.get() : nullptr;
  }
  // The contour block before the open block, when ShortWay has gone on to that.
  void goes_on_behind(const Segment& wall) { wall_before_ = wall; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(held_, short_, masked_, wall_before_, deepest_told_);
  }

 private:
  // Takes blocks in order, once it is known what the corners about a short block are.
  bool take(PathBlockPtr&& block, PathBlocks& out);
  // Whether the corner between the held block and this one is inside, and this may be the short one
  // of a bow tie.
  [[nodiscard]] bool may_be_tied(const PathBlock& block) const;
  [[nodiscard]] double largest_bow_tie_for(const PathBlock& block) const {
    return largest_bow_tie(tolerances_.input_resolution, std::abs(block.at_start.shift));
  }
  // Takes the short block, and marks where the tool goes round a tip with the block after it.
  bool take_short(PathBlock* after, PathBlocks& out);
  [[nodiscard]] bool continues(const PathBlock& block) const {
    return block.at_start.active && !block.perpendicular_entry;
  }
  // A contour begins, or TRC is off: the block does not continue the held one.
  void enter(PathBlock& block, PathBlocks& out) const;
  // The contour ends with the held block. With G239 the next block starts in
  // `next_start`; both must be one point.
  void leave(const Point* next_start, PathBlocks& out);
  bool join(PathBlock& after, PathBlocks& out);
  void put_out_held(PathBlocks& out);

  // Makes a joint over masked blocks: they come out without length at the joint.
  void join_anew(PathBlock& after, PathBlocks& out);
  void change_radius_at_once(const Corner& corner, PathBlock& after, Joint& joint) const;

  // Measures the room at the held block, where its corners take more than the whole of it.
  void measure_room(const PathBlock& after);
  bool tell_depth(const PathBlock& before, const PathBlock& after, const Joint& joint);
  bool refuse(const JointRefusal& refusal, const Corner& corner, const PathBlock& after);
  // Of the selection or deselection block at this corner.
  [[nodiscard]] NeededLength needed_length(const Corner& corner, const PathBlock& after) const;
  // Keeps what is known of a selection or deselection block that is too short.
  void keep_refused_way(const Corner& corner, const PathBlock& after);

  Tolerances tolerances_;
  Diagnostics& diagnostics_;
  std::optional<RefusedWay>& refused_way_;
  PathBlockPtr held_;
  PathBlockPtr short_;  // after the held block: that of a bow tie if the next crosses the held one
  PathBlocks masked_;   // after the held block
  // The contour block before the held one, if both are of the contour and meet in a corner.
  std::optional<Segment> wall_before_;
  double deepest_told_ = 0;  // mm, of corners that wear mode does not reach
};

}  // namespace trc
