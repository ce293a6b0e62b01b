#include "core/trc/passes/reporting.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/check.h"
#include "core/trc/corner/inverse_path.h"

namespace trc {
bool Reporting::feed(PathBlock& block, std::vector<CompensatedBlock>& out) {
  if (block.role == Role::passive) {
    put_out_passive(block.passive, out);
    return true;
  }
  MotionBlock& programmed = block.programmed;
  const FeedAdaptation adaptation = block.mode().feed_adaptation;
  double factor = adaptation == FeedAdaptation::off ? 1 : feed_factor(block);
  if (adaptation == FeedAdaptation::inside) factor = std::min(factor, 1.0);
  CompensatedBlock& result = put_out(programmed, block.mode(), block.origin, block.tool_path, out);
  result.feed = std::min(programmed.feed * factor, tolerances_.largest_feed);
  if (inverse_path_) {
    if (auto recovered = inverse_path(block, tolerances_.same_point))
      result.inverse = std::make_shared<const Segment>(*recovered);
  }
  if (block.role != Role::inserted) summary_.programmed_length += length_of(programmed.path);
  if (!block.passive.empty()) put_out_passive(block.passive, out);
  return !diagnostics_.stopped();
}

void Reporting::stand_at(Plane plane, const Position& position) {
  plane_ = plane;
  place_ = to_plane(plane, position);
  height_ = position[axes_of(plane).third];
}

void Reporting::put_out_passive(std::vector<PassiveBlock>& blocks,
                                std::vector<CompensatedBlock>& out) {
  for (PassiveBlock& passive : blocks) {
    CompensatedBlock& result = out.emplace_back();
    result.source = passive.source;
    result.plane = passive.mode->plane;
    result.origin =
        passive.text.empty() || passive.moves ? Origin::uncompensated : Origin::passthrough;
    result.rapid = passive.rapid;
    if (result.plane != plane_) stand_at(result.plane, position());
    check(height_ == passive.normal.from, "a passive block starts where its block ended");
    result.path = Line{.start = place_, .end = place_};
    result.normal = passive.normal;
    result.feed = passive.feed;
    result.tracking = std::move(passive.tracking);
    result.text = std::move(passive.text);
    height_ = passive.normal.to;
    count(result.origin, 0);
  }
  blocks.clear();
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
    const double shift = (mode.active() ? block.at_end : block.at_start).shift;
    const double cutting = mode.cutting_radius(std::abs(shift));
    const double radius = (shift < 0) != mode.below_nominal ? -cutting : cutting;
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
    // In wear mode the tool touches the part, which lies beside the programmed path.
    const bool left = mode.side == Side::left;
    const bool inside = (circle->sweep > 0) == left;
    at_contour = mode.part_radius(radius_of(*circle), inside != mode.below_nominal);
    if (!(at_contour > 0)) return 1;
  } else {
    return 1;
  }
  if (at_contour < mode.tangfeed_minimum) return 1;
  return std::max(at_center / at_contour, smallest_feed_factor_);
}

void Reporting::limit_turn(double degrees) {
  tangential_limit_ = degrees;
  tangent_of_limit_ = std::tan(degrees * std::numbers::pi / 180);
}

}  // namespace trc
