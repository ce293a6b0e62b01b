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
#include "core/trc/path_block.h"
#include "core/trc/result/compensated_block.h"
#include "core/trc/result/path_ends.h"
#include "core/trc/result/summary.h"
#include "core/trc/setup.h"

namespace trc {

// Turns path blocks into the result: puts passive blocks after their block (D-25), sets the feed
// at the tool centre (G10, G11) and counts. Checks the promise that all callers rely on: each block
// starts where the one before ended.
class Reporting {
 public:
  Reporting(const CompensatorSetup& setup, Diagnostics& diagnostics)
      : smallest_feed_factor_(setup.smallest_feed_factor),
        inverse_path_(setup.inverse_path),
        tolerances_(setup.tolerances),
        diagnostics_(diagnostics) {
    stand_at(Plane::xy, setup.start);
  }

  bool feed(PathBlockPtr&& owner, std::vector<CompensatedBlock>& out) { return feed(*owner, out); }
  bool feed(PathBlock& block, std::vector<CompensatedBlock>& out);
  bool drain(std::vector<CompensatedBlock>& /*out*/) { return true; }
  // Data that many consecutive blocks have in common: their mode, and more.
  struct Motion {
    const TrcMode& mode;
    AxisTravel normal{};
    double feed = 0;
    bool rapid = false;
  };
  // Puts out one block without its tracking axes. `Path` is a Line or an Arc. In the header for
  // ShortWay, which puts out nearly all blocks.
  template <class Path>
  CompensatedBlock& put_out(const Source& source, const Motion& motion, Origin origin,
                            const Path& tool_path, std::vector<CompensatedBlock>& out);
  // Puts out one block with its tracking axes, which it moves out of the programmed block.
  template <class Path>
  CompensatedBlock& put_out(MotionBlock& programmed, const TrcMode& mode, Origin origin,
                            const Path& tool_path, std::vector<CompensatedBlock>& out);
  CompensatedBlock& put_out(MotionBlock& programmed, const TrcMode& mode, Origin origin,
                            const Segment& tool_path, std::vector<CompensatedBlock>& out) {
    const auto* arc = std::get_if<Arc>(&tool_path);
    return arc != nullptr ? put_out(programmed, mode, origin, *arc, out)
                          : put_out(programmed, mode, origin, std::get<Line>(tool_path), out);
  }

  [[nodiscard]] Summary& summary() { return summary_; }

  template <class Archive>
  void serialize(Archive& archive) {
    Position position = this->position();
    archive(position, last_direction_, summary_);
    if constexpr (Archive::is_loading::value) stand_at(Plane::xy, position);
  }

 private:
  // The position of the tool in machine axes.
  [[nodiscard]] Position position() const { return from_plane(plane_, place_, height_); }
  void stand_at(Plane plane, const Position& position);
  void put_out_passive(std::vector<PassiveBlock>& blocks, std::vector<CompensatedBlock>& out);
  // F' / F: the factor for the feed of the tool centre under G11; 1 on inserted blocks
  // (D-30).
  double feed_factor(const PathBlock& block);
  [[nodiscard]] bool goes_straight_on(const Vector& direction, const TrcMode& mode);
  void limit_turn(double degrees);
  void count(Origin origin, double length);

  double smallest_feed_factor_;
  bool inverse_path_;
  Tolerances tolerances_;
  Diagnostics& diagnostics_;
  // Where the tool is: in the plane of the last block, and across it.
  Plane plane_ = Plane::xy;
  Point place_ = Point::Zero();
  double height_ = 0;
  Vector last_direction_ = Vector::Zero();
  // TANGENTIAL_LIMIT of the block before, degrees, and its tangent: it hardly ever changes.
  double tangential_limit_ = 0;
  double tangent_of_limit_ = 0;
  Summary summary_;
};

// Constructs the block in place, so that no member is set twice.
template <class Make>
class InPlace {
 public:
  explicit InPlace(const Make& make) : make_(make) {}
  operator CompensatedBlock() const { return make_(); }

 private:
  const Make& make_;
};

template <class Path>
[[gnu::always_inline]] inline CompensatedBlock& Reporting::put_out(
    const Source& source, const Motion& motion, Origin origin, const Path& tool_path,
    std::vector<CompensatedBlock>& out) {
  const TrcMode& mode = motion.mode;
  if (mode.plane != plane_) stand_at(mode.plane, position());
  check(place_ == tool_path.start && height_ == motion.normal.from,
        "a block starts where the one before ended");
  place_ = tool_path.end;
  height_ = motion.normal.to;
  const Travel travel = travel_of(tool_path);
  const bool tangential = goes_straight_on(travel.begins, mode);
  last_direction_ = travel.ends;
  count(origin, travel.length);
  const auto make = [&] {
    return CompensatedBlock{.source = source,
                            .origin = origin,
                            .plane = mode.plane,
                            .rapid = motion.rapid && std::is_same_v<Path, Line>,
                            .tangential = tangential,
                            .path = tool_path,
                            .normal = motion.normal,
                            .feed = std::min(motion.feed, tolerances_.largest_feed)};
  };
  return out.emplace_back(InPlace(make));
}

template <class Path>
CompensatedBlock& Reporting::put_out(MotionBlock& programmed, const TrcMode& mode, Origin origin,
                                     const Path& tool_path, std::vector<CompensatedBlock>& out) {
  const Motion motion{mode, programmed.normal, programmed.feed, programmed.rapid};
  CompensatedBlock& result = put_out(programmed.source, motion, origin, tool_path, out);
  if (!programmed.tracking.empty()) result.tracking = std::move(programmed.tracking);
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
