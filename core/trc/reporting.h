#pragma once

#include <vector>

#include "core/base/diagnostics.h"
#include "core/geometry/plane.h"
#include "core/trc/compensated_block.h"
#include "core/trc/compensator.h"
#include "core/trc/path_block.h"

namespace trc {

// Turns path blocks into the result: lets the riders off behind their block,
// sets the feed at the tool centre (G10, G11) and counts. Checks the one promise
// everybody relies on: each block starts where the one before ended.
class Reporting {
 public:
  Reporting(const CompensatorSetup& setup, Diagnostics& diagnostics)
      : smallest_feed_factor_(setup.smallest_feed_factor),
        inverse_path_(setup.inverse_path),
        tolerances_(setup.tolerances),
        diagnostics_(diagnostics),
        position_(setup.start) {}

  bool feed(PathBlockPtr&& owner, std::vector<CompensatedBlock>& out) { return feed(*owner, out); }
  bool feed(PathBlock& block, std::vector<CompensatedBlock>& out);
  bool drain(std::vector<CompensatedBlock>& /*out*/) { return true; }
  // One block of the path, programmed under the mode. Takes its tracking axes out of it.
  CompensatedBlock& put_out(MotionBlock& programmed, const TrcMode& mode, Origin origin,
                            const Line& tool_path, std::vector<CompensatedBlock>& out);
  CompensatedBlock& put_out(MotionBlock& programmed, const TrcMode& mode, Origin origin,
                            const Arc& tool_path, std::vector<CompensatedBlock>& out);
  CompensatedBlock& put_out(MotionBlock& programmed, const TrcMode& mode, Origin origin,
                            const Segment& tool_path, std::vector<CompensatedBlock>& out);
  [[nodiscard]] std::size_t look_ahead() const { return 0; }

  [[nodiscard]] Summary& summary() { return summary_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(position_, last_direction_, summary_);
  }

 private:
  template <class Path>
  CompensatedBlock& put_out_along(const Path& tool_path, MotionBlock& programmed,
                                  const TrcMode& mode, Origin origin,
                                  std::vector<CompensatedBlock>& out);
  void let_off(std::vector<PassiveBlock>& riders, std::vector<CompensatedBlock>& out);
  // F' / F: what the feed of the tool centre is multiplied by under G11.
  double feed_factor(const PathBlock& block);
  [[nodiscard]] bool goes_straight_on(const Vector& direction, const TrcMode& mode);
  void count(Origin origin, double length);

  double smallest_feed_factor_;
  bool inverse_path_;
  Tolerances tolerances_;
  Diagnostics& diagnostics_;
  Position position_;  // of the tool, machine axes
  Vector last_direction_ = Vector::Zero();
  // TANGENTIAL_LIMIT of the block before, degrees, and its tangent: it hardly ever changes.
  double tangential_limit_ = 0;
  double tangent_of_limit_ = 0;
  Summary summary_;
};

}  // namespace trc
