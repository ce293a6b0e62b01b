#include "core/trc/reporting.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

#include "core/base/check.h"
#include "core/trc/inverse_path.h"

namespace trc {
namespace {

// What a planner asks of a segment. The directions of travel at its ends have any length.
struct Travel {
  Vector begins = Vector::Zero();
  Vector ends = Vector::Zero();
  double length = 0;
};

Travel travel_of(const Line& line) {
  const Vector way = line.end - line.start;
  return {.begins = way, .ends = way, .length = way.norm()};
}

Travel travel_of(const Arc& arc) {
  const double sense = arc.sweep > 0 ? 1 : -1;
  const Vector out = arc.start - arc.center;
  return {.begins = sense * left_of(out),
          .ends = sense * left_of(arc.end - arc.center),
          .length = std::abs(arc.sweep) * out.norm()};
}

}  // namespace

bool Reporting::feed(PathBlock& block, std::vector<CompensatedBlock>& out) {
  if (block.role == Role::passive) {
    let_off(block.riders, out);
    return true;
  }
  MotionBlock& programmed = block.programmed;
  const bool adapts = block.mode().feed_adaptation == FeedAdaptation::on;
  const double factor = adapts ? feed_factor(block) : 1;
  CompensatedBlock& result = put_out(programmed, block.mode(), block.origin, block.tool_path, out);
  result.feed = std::min(programmed.feed * factor, tolerances_.largest_feed);
  if (inverse_path_) {
    if (auto recovered = inverse_path(block, tolerances_.same_point))
      result.inverse = std::make_shared<const Segment>(*recovered);
  }
  if (block.role != Role::inserted) summary_.programmed_length += length_of(programmed.path);
  if (!block.riders.empty()) let_off(block.riders, out);
  return !diagnostics_.stopped();
}

template <class Path>
CompensatedBlock& Reporting::put_out_along(const Path& tool_path, MotionBlock& programmed,
                                           const TrcMode& mode, Origin origin,
                                           std::vector<CompensatedBlock>& out) {
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

CompensatedBlock& Reporting::put_out(MotionBlock& programmed, const TrcMode& mode, Origin origin,
                                     const Line& tool_path, std::vector<CompensatedBlock>& out) {
  return put_out_along(tool_path, programmed, mode, origin, out);
}
CompensatedBlock& Reporting::put_out(MotionBlock& programmed, const TrcMode& mode, Origin origin,
                                     const Arc& tool_path, std::vector<CompensatedBlock>& out) {
  return put_out_along(tool_path, programmed, mode, origin, out);
}
CompensatedBlock& Reporting::put_out(MotionBlock& programmed, const TrcMode& mode, Origin origin,
                                     const Segment& tool_path, std::vector<CompensatedBlock>& out) {
  const auto* arc = std::get_if<Arc>(&tool_path);
  return arc != nullptr ? put_out(programmed, mode, origin, *arc, out)
                        : put_out(programmed, mode, origin, std::get<Line>(tool_path), out);
}

void Reporting::let_off(std::vector<PassiveBlock>& riders, std::vector<CompensatedBlock>& out) {
  for (PassiveBlock& rider : riders) {
    CompensatedBlock& result = out.emplace_back();
    result.source = rider.source;
    result.plane = rider.mode->plane;
    result.origin = rider.text.empty() || rider.moves ? Origin::uncompensated : Origin::passthrough;
    result.rapid = rider.rapid;
    const Point place = to_plane(result.plane, position_);
    check(position_[axes_of(result.plane).third] == rider.normal.from,
          "a rider starts where its block ended");
    result.path = Line{.start = place, .end = place};
    result.normal = rider.normal;
    result.feed = rider.feed;
    result.tracking = std::move(rider.tracking);
    result.text = std::move(rider.text);
    position_ = from_plane(result.plane, place, rider.normal.to);
    count(result.origin, 0);
  }
  riders.clear();
}

double Reporting::feed_factor(const PathBlock& block) {
  const TrcMode& mode = block.mode();
  const auto* arc = std::get_if<Arc>(&block.tool_path);
  if (arc == nullptr || block.programmed.rapid) return 1;
  const double at_center = radius_of(*arc);
  double at_contour = 0;
  if (block.path_given) {
    // A G05 arc has no programmed circle: the tool would touch at |rho| + R with
    // the centre on its own side, else at |rho| - R.
    const double radius = (mode.active() ? block.at_end : block.at_start).shift;
    at_contour = at_center + (arc->sweep > 0 ? radius : -radius);
    if (at_contour <= 0) {
      Diagnostic warning =
          diagnostic(Code::no_feed_adaptation_in_tangential_block, block.programmed.source);
      warning.values = {{"tool_radius", std::abs(radius)},
                        {"path_radius", at_center},
                        {"corrected_radius", at_contour}};
      diagnostics_.report(std::move(warning));
      return 1;
    }
  } else if (const auto* circle = std::get_if<Arc>(&block.programmed.path);
             circle != nullptr && block.role == Role::contour) {
    at_contour = radius_of(*circle);
  } else {
    return 1;
  }
  if (at_contour < mode.tangfeed_minimum) return 1;
  return std::max(at_center / at_contour, smallest_feed_factor_);
}

bool Reporting::goes_straight_on(const Vector& direction, const TrcMode& mode) {
  const double along = last_direction_.dot(direction);
  if (along <= 0) return false;
  if (const double limit = mode.options.tangential_limit; limit != tangential_limit_) {
    tangential_limit_ = limit;
    tangent_of_limit_ = std::tan(limit * std::numbers::pi / 180);
  }
  return std::abs(cross(last_direction_, direction)) <= tangent_of_limit_ * along;
}

void Reporting::count(Origin origin, double length) {
  ++summary_.blocks_out;
  ++summary_.blocks_by_origin[static_cast<std::size_t>(origin)];
  summary_.compensated_length += length;
}

}  // namespace trc
