#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/check.h"
#include "core/base/diagnostics.h"
#include "core/geometry/plane.h"
#include "core/trc/compensated_block.h"
#include "core/trc/compensator.h"
#include "core/trc/path_block.h"
#include "core/trc/travel.h"

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
  // One block of the path, programmed under the mode. Takes its tracking axes out of it. `Path` is
  // a Line or an Arc. Here for ContourRun, which puts out nearly all blocks.
  template <class Path>
  CompensatedBlock& put_out(MotionBlock& programmed, const TrcMode& mode, Origin origin,
                            const Path& tool_path, std::vector<CompensatedBlock>& out);
  CompensatedBlock& put_out(MotionBlock& programmed, const TrcMode& mode, Origin origin,
                            const Segment& tool_path, std::vector<CompensatedBlock>& out) {
    const auto* arc = std::get_if<Arc>(&tool_path);
    return arc != nullptr ? put_out(programmed, mode, origin, *arc, out)
                          : put_out(programmed, mode, origin, std::get<Line>(tool_path), out);
  }
  [[nodiscard]] std::size_t look_ahead() const { return 0; }

  [[nodiscard]] Summary& summary() { return summary_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(position_, last_direction_, summary_);
  }

 private:
  void let_off(std::vector<PassiveBlock>& riders, std::vector<CompensatedBlock>& out);
  // F' / F: what the feed of the tool centre is multiplied by under G11.
  double feed_factor(const PathBlock& block);
  [[nodiscard]] bool goes_straight_on(const Vector& direction, const TrcMode& mode);
  void limit_turn(double degrees);
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

template <class Path>
CompensatedBlock& Reporting::put_out(MotionBlock& programmed, const TrcMode& mode, Origin origin,
                                     const Path& tool_path, std::vector<CompensatedBlock>& out) {
  const PlaneAxes axes = axes_of(mode.plane);
  check(position_[axes.first] == tool_path.start.x() &&
            position_[axes.second] == tool_path.start.y() &&
            position_[axes.third] == programmed.normal.from,
        "a block starts where the one before ended");
  position_[axes.first] = tool_path.end.x();
  position_[axes.second] = tool_path.end.y();
  position_[axes.third] = programmed.normal.to;
  const Travel travel = travel_of(tool_path);
  CompensatedBlock& result = out.emplace_back();
  result.source = programmed.source;
  result.origin = origin;
  result.plane = mode.plane;
  result.rapid = programmed.rapid && std::is_same_v<Path, Line>;
  result.tangential = goes_straight_on(travel.begins, mode);
  result.path.emplace<Path>(tool_path);
  result.normal = programmed.normal;
  result.feed = std::min(programmed.feed, tolerances_.largest_feed);
  if (!programmed.tracking.empty()) result.tracking = std::move(programmed.tracking);
  last_direction_ = travel.ends;
  count(origin, travel.length);
  return result;
}

inline bool Reporting::goes_straight_on(const Vector& direction, const TrcMode& mode) {
  const double along = last_direction_.dot(direction);
  if (along <= 0) return false;
  if (mode.options.tangential_limit != tangential_limit_) limit_turn(mode.options.tangential_limit);
  return std::abs(cross(last_direction_, direction)) <= tangent_of_limit_ * along;
}

inline void Reporting::count(Origin origin, double length) {
  ++summary_.blocks_out;
  ++summary_.blocks_by_origin[static_cast<std::size_t>(origin)];
  summary_.compensated_length += length;
}

}  // namespace trc
