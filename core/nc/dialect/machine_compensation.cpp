#include "core/nc/dialect/machine_compensation.h"

#include <string>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

// Cycles that the machine compensates by itself, with a D register of its own: G12, G13 and G150 of
// Haas (D-66, D-102).

namespace trc {
namespace {

using enum GGroup;

}  // namespace

bool take_cycle_with_register(Reading& reading, ProgramLine& line, BlockWords& block) {
  const BlockWords::Function& cycle = block.of(single_move);
  const bool selects = block.has(side) && !block.of(side).is(40);
  const bool compensates = cycle.is(12) || cycle.is(13) || cycle.is(150);
  if (!compensates || reading.contour_open()) {
    if (!block.tool) return true;
    reading.code_modes.register_comes_out = !selects && !reading.trc_active();
    reading.code_modes.register_place = reading.place_of_word(line, block.tool->begin);
    reading.code_modes.last_register = block.tool->value;
    return true;
  }
  const std::string name = "G" + std::to_string(cycle.function->number);
  if (!block.tool && !reading.code_modes.register_comes_out)
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = cycle.begin,
                        .detail = name + " without D behind D" +
                                  std::to_string(whole_number(reading.code_modes.last_register)) +
                                  " " + place_of(reading.code_modes.register_place.source)});
  const std::uint32_t begin = block.tool ? block.tool->begin : cycle.begin;
  if (block.tool) {
    reading.code_modes.last_register = block.tool->value;
    reading.code_modes.register_comes_out = true;
  }
  if (cycle.is(150)) {
    block.side_of_machine = true;
    block.forget = all_axes;
    block.clear(side);
    take_for_technology(line, WordRole::trc);
  }
  if (reading.code_modes.last_register == 0 || !reading.faults.empty()) return true;
  const bool is_said = block.tool || reading.code_modes.last_register > 0;
  Diagnostic warned = diagnostic(
      Code::machine_compensates, line.source,
      is_said ? name + " D" + std::to_string(whole_number(reading.code_modes.last_register))
              : name);
  warned.column = reading.place_of_word(line, begin).column;
  return reading.diagnostics.report(std::move(warned));
}

// What they change is not known here (D-104).
void take_parameters_of_control(Reading& reading, ProgramLine& line, BlockWords& block) {
  const bool begins = block.has(tool_data) && block.tool_data &&
                      (block.tool_data->value == 50 || block.tool_data->value == 52);
  reading.code_modes.enters_parameters |= begins;
  if (!reading.code_modes.enters_parameters) return;
  if (begins) block.forget = all_axes;
  if (block.axis || block.has(motion) || reading.trc_active()) return;
  block.copied = true;
  block.move.radius.reset();
  block.center.reset();
  take_for_technology(line, WordRole::coordinate);
}

}  // namespace trc
