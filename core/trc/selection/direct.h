#pragma once

#include "core/trc/corner/corner.h"

namespace trc::selection {

// G138, and G239 on the way in: straight to the perpendicular point P, whatever
// the corner (rule 3.1).
[[nodiscard]] inline Joint approach_direct(const Corner& corner) {
  Joint joint;
  joint.end = joint.start = corner.after.anchor;
  return joint;
}

// G138: the contour runs to its full end Q, then straight to the target.
[[nodiscard]] inline Joint retract_direct(const Corner& corner) {
  Joint joint;
  joint.end = joint.start = corner.before.anchor;
  return joint;
}

}  // namespace trc::selection
