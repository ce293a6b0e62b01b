#include "core/verify/margins.h"

namespace trc::verify {

void Margins::note(const MeasuredPiece& path, const Near& near) {
  const double margin = near.distance - near.required;
  if (margin + near.touch < -allowed_) {
    gouges_ = true;
    if (margin < least_gouge_) {
      least_gouge_ = margin;
      if (!gouge_ || margin <= gouge_->margin() - half_resolution)
        gouge_ = clearance_of(path, near);
    }
  }
  if (margin >= least_) return;
  // Every comparison counts, also one that is not reported: otherwise walls a little nearer than
  // the reported one, as around a tool that goes round in a hole, would be near for ever.
  least_ = margin;
  if (worst_ && margin > worst_->margin() - half_resolution) return;
  worst_ = clearance_of(path, near);
}

Clearance Margins::clearance_of(const MeasuredPiece& path, const Near& near) const {
  const ProgrammedPiece& own = held_.programmed()[path.programmed];
  const Rule& rule = held_.rule_of(own);
  return {.distance = near.distance,
          .required = near.required,
          .place = from_plane(rule.plane, near.point, path.height),
          .path = own.source,
          .contour = near.wall};
}

}  // namespace trc::verify
