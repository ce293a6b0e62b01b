#include "core/trc/passes/convert_circles.h"

#include "core/geometry/parallel.h"

namespace trc {

bool ConvertCircles::apply(PathBlock& block) const {
  if (block.role != Role::contour) return true;
  const TrcMode& mode = block.mode();
  if (!mode.options.conv_cir_to_lin || mode.masking == Masking::off) return true;
  const auto* arc = std::get_if<Arc>(&block.programmed.path);
  if (arc == nullptr) return true;
  // An arc as large as the tool stays: masked, it leaves the exact corner (D-18).
  const double remaining = parallel_radius(*arc, shift_of_tool(mode));
  const bool shrinks_away = remaining < -tolerances_.on_contour;
  if (!shrinks_away || (arc->end - arc->start).norm() <= tolerances_.same_point) return true;
  block.programmed.path = Line{.start = arc->start, .end = arc->end};
  block.origin = Origin::converted_circle;
  return true;
}

}  // namespace trc
