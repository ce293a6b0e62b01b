#include "proto/wire/trc_command.h"

#include "core/base/tolerances.h"
#include "proto/wire/geometry.h"
#include "proto/wire/modes.h"

namespace trc::wire {

bool apply(const TrcCommand& command, ProgramState& program) {
  const Source& source = command.source;
  if (command.absolute_center) program.set_absolute_center(*command.absolute_center);
  if (command.correct_center) program.set_circle_correction(*command.correct_center);
  if (command.plane && !program.set_plane(*command.plane, source)) return false;
  if (command.options &&
      !program.set_options(changed(program.mode().options, *command.options), source))
    return false;
  if (command.tool_radius && !program.set_tool_radius(*command.tool_radius, source)) return false;
  if (command.wear && !program.set_wear(*command.wear, source)) return false;
  if (command.allowance && !program.set_allowance(*command.allowance, source)) return false;
  if (command.tangfeed_minimum && !program.set_tangfeed_minimum(*command.tangfeed_minimum, source))
    return false;
  if (command.feed_adaptation && !program.set_feed_adaptation(*command.feed_adaptation, source))
    return false;
  if (command.masking && !program.set_masking(*command.masking, source)) return false;
  if (command.transition && !program.set_transition(*command.transition, source)) return false;
  if (command.selection && !program.set_selection(*command.selection, source)) return false;
  if (command.tangential && !program.set_tangential(source)) return false;
  if (!command.side) return true;
  return *command.side == Side::off ? program.deselect(source)
                                    : program.select(*command.side, source);
}

bool from_proto(const v1::TrcCommand& message, const FieldPath& path, TrcCommand& command,
                FieldFaults& faults) {
  const std::size_t before = faults.count();
  command = {};
  command.side = sides.from_proto(message.side(), FieldPath(path, "side"), faults);
  command.tangential = message.tangential();
  command.selection =
      selections.from_proto(message.selection_mode(), FieldPath(path, "selection_mode"), faults);
  command.transition =
      transitions.from_proto(message.transition(), FieldPath(path, "transition"), faults);
  command.masking =
      maskings.from_proto(message.contour_masking(), FieldPath(path, "contour_masking"), faults);
  command.feed_adaptation = feed_adaptations.from_proto(message.feed_adaptation(),
                                                        FieldPath(path, "feed_adaptation"), faults);
  if (message.has_tangfeed_min_radius()) {
    // The core answers a negative value with 20963.
    constexpr double largest = Tolerances{}.largest_coordinate;
    check_range(message.tangfeed_min_radius(), {-largest, largest, "mm"},
                FieldPath(path, "tangfeed_min_radius"), faults);
    command.tangfeed_minimum = message.tangfeed_min_radius();
  }
  if (message.has_tool_radius()) {
    check_tool_radius(message.tool_radius(), FieldPath(path, "tool_radius"), faults);
    command.tool_radius = message.tool_radius();
  }
  if (message.has_wear()) {
    check_tool_radius(message.wear(), FieldPath(path, "wear"), faults);
    command.wear = message.wear();
  }
  if (message.has_allowance()) {
    check_tool_radius(message.allowance(), FieldPath(path, "allowance"), faults);
    command.allowance = message.allowance();
  }
  if (message.has_options())
    command.options = from_proto(message.options(), FieldPath(path, "options"), faults);
  command.plane = from_proto(message.plane(), FieldPath(path, "plane"), faults);
  command.absolute_center = center_references.from_proto(
      message.center_reference(), FieldPath(path, "center_reference"), faults);
  command.correct_center = center_corrections.from_proto(
      message.center_correction(), FieldPath(path, "center_correction"), faults);
  return faults.count() == before;
}

void to_proto(const TrcCommand& command, v1::TrcCommand& message) {
  message.Clear();
  if (command.side) message.set_side(sides.to_proto(*command.side));
  message.set_tangential(command.tangential);
  if (command.selection) message.set_selection_mode(selections.to_proto(*command.selection));
  if (command.transition) message.set_transition(transitions.to_proto(*command.transition));
  if (command.masking) message.set_contour_masking(maskings.to_proto(*command.masking));
  if (command.feed_adaptation)
    message.set_feed_adaptation(feed_adaptations.to_proto(*command.feed_adaptation));
  if (command.tangfeed_minimum) message.set_tangfeed_min_radius(*command.tangfeed_minimum);
  if (command.tool_radius) message.set_tool_radius(*command.tool_radius);
  if (command.wear) message.set_wear(*command.wear);
  if (command.allowance) message.set_allowance(*command.allowance);
  if (command.options) to_proto(*command.options, *message.mutable_options());
  if (command.plane) message.set_plane(to_proto(*command.plane));
  if (command.absolute_center)
    message.set_center_reference(center_references.to_proto(*command.absolute_center));
  if (command.correct_center)
    message.set_center_correction(center_corrections.to_proto(*command.correct_center));
}

}  // namespace trc::wire
