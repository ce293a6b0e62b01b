#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/base/source.h"
#include "core/geometry/plane.h"
#include "core/geometry/segment.h"
#include "core/nc/state/block.h"

namespace trc {

// Why a block is on the compensated path.
enum class Origin : std::uint8_t {
  programmed,        // a contour block, shortened or extended
  approach,          // selection motion, with the blocks its mode inserts
  retract,           // deselection motion, likewise
  transition,        // inserted at an outside corner or a joint
  masked,            // programmed, not travelled; carries what must not be lost
  radius_change,     // inserted by PERPENDICULAR_RADIUS_CHANGE or a split circle
  kerf,              // a programmed block whose end KERF_MASKING has moved
  converted_circle,  // the chord CONV_CIR_TO_LIN put in place of a circle
  passthrough,       // technology text, no motion
  uncompensated,     // motion while TRC is off or does not concern the plane
};
inline constexpr std::size_t origin_count = 10;

// One block of the result. Joints are shared: the end of a block is the start of
// the next one that moves, bit for bit, in the plane, across it and in every
// tracking axis.
struct CompensatedBlock {
  Source source{};
  Origin origin = Origin::uncompensated;
  Plane plane = Plane::xy;
  bool rapid = false;
  // The joint with the block before counts as tangential for the planner: the
  // path turns there by at most TANGENTIAL_LIMIT (rule 4.5).
  bool tangential = false;
  // In the plane, at the tool centre. A line without length when only the third
  // axis or tracking axes move, and for passthrough.
  Segment path{};
  AxisTravel normal{};
  double feed = 0;  // mm/min at the tool centre; 0: none programmed
  TrackingTravel tracking{};
  std::string text{};  // passthrough only
  // The contour recovered from `path`, where the setup asks for it and there is
  // one (inverse_path.h).
  std::shared_ptr<const Segment> inverse{};
};

}  // namespace trc
