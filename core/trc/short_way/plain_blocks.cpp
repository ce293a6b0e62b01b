#include "core/trc/short_way/plain_blocks.h"

namespace trc {
namespace {

// Whether the short way knows all the options that are on. Each one is named: a new one does not
// compile until its meaning here is decided. Options with a remark change nothing between two
// blocks in the middle of a contour, or are asked for where they do.
bool knows(const TrcOptions& options, Loops loops) {
  [[maybe_unused]] const auto& [conv_cir_to_lin, kerf_masking, reverse /* at a change of side */,
                                ignore_cont_damage, remove_masked_blocks /* loops */,
                                ext_angle_block_intersection, g236_lin /* at the ends */,
                                stretch_factor /* asked for */, tangential_limit /* Reporting */,
                                perpendicular_radius_change /* at a change of radius */,
                                gen_cir_block_in_corner, suppress_trc /* the shift */, inverse,
                                split /* at the ends */] = options;
  return !conv_cir_to_lin && !kerf_masking && !ext_angle_block_intersection &&
         !gen_cir_block_in_corner && !inverse && (loops == Loops::removed || !ignore_cont_damage);
}

}  // namespace

bool is_plain(const TrcMode& mode, Loops loops) {
  [[maybe_unused]] const auto& [plane, side /* the shift */, tool_radius /* the shift */,
                                nominal_radius, below_nominal, selection_number,
                                selection /* at the ends */, deselection /* at the ends */,
                                tangential /* at the ends */, from_anywhere /* for verification */,
                                touches_corner_circle /* at the ends */, transition /* asked for */,
                                masking, feed_adaptation, tangfeed_minimum /* of feed_adaptation */,
                                options] = mode;
  const bool adapts = masking == Masking::on || feed_adaptation != FeedAdaptation::off;
  // Transitions reports how deep a smaller tool of wear mode reaches.
  return knows(options, loops) && (loops == Loops::removed || !adapts) && !below_nominal;
}

bool is_plain(const PathBlock& block) {
  return block.role == Role::contour && block.origin == Origin::programmed &&
         block.at_start == block.at_end && !block.perpendicular_entry &&
         !block.perpendicular_exit && !block.path_given && !block.masked && !block.rejoin &&
         !block.unreachable && !block.behind_tip && block.passive.empty() &&
         block.passive_after_exit.empty();
}

}  // namespace trc
