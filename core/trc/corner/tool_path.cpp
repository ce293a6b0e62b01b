#include "core/trc/corner/tool_path.h"

#include <numbers>

namespace trc {

// The sweep is adjusted, not recomputed: for an almost full circle the angle between the
// new ends cannot tell 2 pi from 0.
Segment shortened(const Arc& programmed, const LeftOfArc& left, Consumed consumed,
                  const Tolerances& tolerances) {
  const double radius = (left.start - programmed.center).norm();
  if (left.sweep * radius <= tolerances.same_point && left.sweep * radius >= -tolerances.on_contour)
    return Line{.start = left.start, .end = left.end};
  const bool wraps_round = left.sweep < 0 && consumed == Consumed::wraps_round;
  const double sweep = wraps_round ? left.sweep + 2 * std::numbers::pi : left.sweep;
  return Arc{.start = left.start,
             .end = left.end,
             .center = programmed.center,
             .sweep = programmed.sweep > 0 ? sweep : -sweep};
}

void insert_behind(const MotionBlock& before, const MotionBlock& after, MotionBlock& inserted) {
  inserted.source = before.source;
  inserted.normal = standing(before.normal.to);
  inserted.feed = before.feed > 0 ? before.feed : after.feed;
  inserted.rapid = before.rapid && after.rapid;
  inserted.tracking.clear();
  for (const AxisTravel& axis : before.tracking) inserted.tracking.push_back(standing(axis.to));
}

}  // namespace trc
