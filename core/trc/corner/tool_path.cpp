#include "core/trc/corner/tool_path.h"

#include <numbers>

namespace trc {

// The sweep is adjusted, not recomputed: for an almost full circle the angle between the
// new ends cannot tell 2 pi from 0.
Segment shortened(const Arc& programmed, const Point& start, const Point& end, double left,
                  bool may_run_back, const Tolerances& tolerances) {
  const double radius = (start - programmed.center).norm();
  if (left * radius <= tolerances.same_point && left * radius >= -tolerances.on_contour)
    return Line{.start = start, .end = end};
  if (left < 0 && !may_run_back) left += 2 * std::numbers::pi;
  return Arc{.start = start,
             .end = end,
             .center = programmed.center,
             .sweep = programmed.sweep > 0 ? left : -left};
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
