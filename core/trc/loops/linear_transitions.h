#pragma once

#include <cstddef>

#include "core/base/checkpoint.h"
#include "core/base/tolerances.h"
#include "core/trc/corner/corner.h"
#include "core/trc/loops/held_path.h"
#include "core/trc/loops/obstacles.h"
#include "core/trc/loops/walked_path.h"

namespace trc {

// Loops are removed with an arc at every outside corner (D-45). Afterwards an arc that is travelled
// whole is replaced by the transition of G25 (rules 4.2 and 4.3) or of EXT_ANGLE_BLOCK_INTERSECTION
// (rule 4.4):
//
//      -----.            -----X      X reaches out of the arc, but not to any contour
//            `.               |      block, nor over an end of the path. Elsewhere the
//              |              |      arc stays.
class LinearTransitions {
 public:
  LinearTransitions(HeldPath& path, WalkedPath& walked, const Obstacles& obstacles,
                    const Tolerances& tolerances, Checkpoint& checkpoint)
      : path_(path),
        walked_(walked),
        obstacles_(obstacles),
        tolerances_(tolerances),
        checkpoint_(checkpoint) {}

  // Whether the mode asks for linear transitions.
  [[nodiscard]] static bool are_asked_for(const TrcMode& mode) {
    return mode.transition == Transition::linear || mode.options.ext_angle_block_intersection;
  }
  // The first point of the path, and the last one as soon as that is known.
  void begin_at(const Point& first) { ends_ = {first, first}; }
  void end_at(const Point& last) { ends_.last = last; }

  // Whether the piece is a whole arc in place of which the mode asks for another transition.
  [[nodiscard]] bool may_replace(std::size_t piece) const;
  // Replaces it, if the result keeps clear. The piece before it, if any, will not be walked again.
  void replace(std::size_t piece);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(ends_.first, ends_.last);
  }

 private:
  struct Ends {
    Point first = Point::Zero();
    Point last = Point::Zero();
  };
  // The replacement of an arc, as HeldPath::lines_of().
  struct Replacement {
    Segment leg_before{};
    Line across{};
    Segment leg_after{};
  };

  // Between a contour block and the next one.
  [[nodiscard]] Corner corner_behind(std::size_t number) const;
  [[nodiscard]] Replacement replacement(const Corner& corner, const Joint& joint) const;
  [[nodiscard]] bool keeps_clear(std::size_t transition, const Replacement& replacement) const;
  // Whether the point lies between the arc and its replacement.
  [[nodiscard]] bool reaches_over(const Corner& corner, const Replacement& replacement,
                                  const Point& point) const;
  // Whether the pieces next to the arc belong to the blocks next to it and reach it.
  [[nodiscard]] bool are_neighbours(std::size_t piece) const;
  // Whether the neighbour may be lengthened along itself: its equidistant is that of the
  // corner.
  [[nodiscard]] bool goes_on(std::size_t block) const;
  void lengthen_before(std::size_t piece, const Joint& joint);
  void lengthen_after(std::size_t piece, const Joint& joint);

  HeldPath& path_;
  WalkedPath& walked_;
  const Obstacles& obstacles_;
  Tolerances tolerances_;
  Checkpoint& checkpoint_;
  Ends ends_{};
};

}  // namespace trc
