#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/base/checkpoint.h"
#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/trc/loops/held_path_append.h"
#include "core/trc/loops/held_selection.h"
#include "core/trc/loops/linear_transitions.h"
#include "core/trc/loops/loop_release.h"
#include "core/trc/loops/loop_walk.h"
#include "core/trc/loops/obstacles.h"
#include "core/trc/loops/walked_path.h"
#include "core/trc/pass.h"
#include "core/trc/path_block.h"
#include "core/trc/result/refused_way.h"
#include "core/trc/setup.h"
#include "core/trc/walls/closing_watch.h"

namespace trc {

// G141 with REMOVE_MASKED_BLOCKS: takes every violating loop out of the path of a selection (rule
// 5.1), however many blocks it has. It holds the path, LoopWalk goes along it, LinearTransitions
// inserts the transitions of G25, and LoopRelease puts out the rest.
//
// Holds such a selection as a whole, or, with a window of N contour blocks (D-10), looks N blocks
// ahead and back: the path of a block leaves when the N-th block after it has come. All else
// passes through at once.
class LoopRemoval {
 public:
  LoopRemoval(const CompensatorSetup& setup, Diagnostics& diagnostics, Checkpoint& checkpoint)
      : window_(setup.limits.look_ahead_blocks),
        selection_blocks_(setup.limits.selection_blocks),
        lead_settings_(setup.leads),
        tolerances_(setup.tolerances),
        diagnostics_(diagnostics),
        checkpoint_(checkpoint),
        closing_(lead_settings_, window_),
        obstacles_(held_.path, window_, tolerances_, checkpoint),
        walked_(held_.path, window_ > 0),
        walk_(setup, {held_.path, obstacles_, walked_, closing_}, diagnostics, checkpoint),
        linear_(held_.path, walked_, obstacles_, tolerances_, checkpoint),
        release_(setup, held_.path, walked_, obstacles_, diagnostics) {}

  bool feed(PathBlockPtr block, PathBlocks& out);
  bool end();
  [[nodiscard]] bool ignores(const PathBlock& block) const {
    return phase_ == Phase::idle && !block.removes_loops();
  }
  [[nodiscard]] bool is_leaving() const { return phase_ == Phase::leaving; }
  bool release_some(PathBlocks& out);

  // The short way in, in plain_entry.h.
  class PlainEntry;
  // The short way out, while a selection is leaving and all of it has entered; else null.
  [[nodiscard]] LoopRelease* releases_path() {
    return is_leaving() && held_.entering.empty() ? &release_ : nullptr;
  }
  [[nodiscard]] const HeldPath& path() const { return held_.path; }
  // The selection that it has stopped at, approach first and without the leads at the start; none
  // where part of it has left.
  [[nodiscard]] std::optional<RefusedWay> refused_way() const;

  // Not allowed while a selection is leaving.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(held_, closing_, obstacles_, walked_, walk_, linear_, release_);
    if constexpr (Archive::is_loading::value)
      phase_ = held_.is_empty() ? Phase::idle : Phase::holding;
  }

 private:
  enum class Phase : std::uint8_t {
    idle,     // no selection is held
    holding,  // one is, and may get more blocks
    leaving,  // it has ended
  };
  // Blocks fed while a selection is leaving.
  struct Behind {
    PathBlocks blocks{};
    PathBlocks taken{};         // of these, while they are fed again; empty else
    Input input = Input::more;  // after the last one
  };

  bool end_selection();
  void forget_selection();
  bool hold(PathBlock& block);
  [[nodiscard]] bool has_room_for(const Source& source) {
    const bool is_countable = end_of_path() < HeldPath::most_blocks / 4;
    return (is_countable && held_.path.size() < selection_blocks_) || has_no_room_for(source);
  }
  // Returns false.
  bool has_no_room_for(const Source& source);
  void note_contour_block(const Box& programmed, const Certificate::Block& course);
  // The contour from a block on.
  [[nodiscard]] ContourView contour_from(std::size_t first) const;
  // Finds the walls (D-38), once the contour has ended and if its start is still known, or that of
  // its last lap.
  void find_walls();
  // Walks as far as the contour is known. Returns false once the stream must stop.
  bool walk();
  bool proceed(PathBlocks& out);
  // The piece up to which the path may leave when its window has come: the replacement of an arc
  // takes part of the block before it.
  [[nodiscard]] std::size_t settle(std::size_t due);
  void forget();
  void release_entry(PathBlocks& out);

  [[nodiscard]] HeldPath::ContourBlock contour(std::size_t number) const {
    return held_.path.contour_block(number);
  }
  [[nodiscard]] std::size_t end_of_path() const { return held_.path.end(); }
  [[nodiscard]] std::size_t end_of_contour() const { return held_.path.end_of_contour(); }

  std::size_t window_;
  std::size_t selection_blocks_;
  LeadSettings lead_settings_;
  Tolerances tolerances_;
  Diagnostics& diagnostics_;
  Checkpoint& checkpoint_;

  Phase phase_ = Phase::idle;
  HeldSelection held_;
  ClosingWatch closing_;
  Obstacles obstacles_;
  WalkedPath walked_;
  LoopWalk walk_;
  LinearTransitions linear_;
  LoopRelease release_;
  Behind behind_;
};

}  // namespace trc
