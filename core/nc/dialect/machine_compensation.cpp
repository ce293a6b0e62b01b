#include "core/nc/dialect/machine_compensation.h"

#include <string>

#include "core/messages/diagnostic_text.h"
#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

// Cycles that the machine compensates itself, with their own D register: G12, G13 and G150 of Haas
// (D-66, D-102).

namespace trc {
namespace {

using enum GGroup;

}  // namespace

bool take_cycle_with_register(Reading& reading, ProgramLine& line, BlockWords& block) {
  const BlockWords::Function& cycle = block.of(single_move);
  const bool selects = block.selects();
  const bool compensates = cycle.is(12) || cycle.is(13) || cycle.is(150);
  if (!compensates || reading.contour_open()) {
    if (!block.tools.d_word) return true;
    reading.gcode.last_register.comes_out = !selects && !reading.trc_active();
    reading.gcode.last_register.place = reading.place_of_word(line, block.tools.d_word->begin);
    reading.gcode.last_register.number = block.tools.d_word->value;
    return true;
  }
  const std::string name = "G" + std::to_string(cycle.function->number);
  if (!block.tools.d_word && !reading.gcode.last_register.comes_out)
    return reading.refuse(
        line,
        TextFault{.code = Code::nc_unsupported,
                  .begin = cycle.begin,
                  .detail = name + " without D after D" +
                            std::to_string(register_number(*reading.gcode.last_register.number)) +
                            " " + place_of(reading.gcode.last_register.place.source)});
  const std::uint32_t begin = block.tools.d_word ? block.tools.d_word->begin : cycle.begin;
  if (block.tools.d_word) {
    reading.gcode.last_register.number = block.tools.d_word->value;
    reading.gcode.last_register.comes_out = true;
  }
  if (cycle.is(150)) {
    block.side_of_machine = true;
    block.forget = all_axes;
    block.clear(side);
    take_for_technology(line, WordRole::trc);
  }
  if (reading.gcode.last_register.number == 0 || !reading.faults.empty()) return true;
  const bool is_said = block.tools.d_word || reading.gcode.last_register.number.value_or(0) > 0;
  Diagnostic warned = diagnostic(
      Code::machine_compensates, line.source,
      is_said ? name + " D" + std::to_string(register_number(*reading.gcode.last_register.number))
              : name);
  warned.column = reading.place_of_word(line, begin).column;
  return reading.diagnostics.report(std::move(warned));
}

// The effect of these parameters is unknown (D-104).
void take_parameters_of_control(Reading& reading, ProgramLine& line, BlockWords& block) {
  const bool begins = block.has(tool_data) && block.l_word &&
                      (block.l_word->value == 50 || block.l_word->value == 52);
  reading.gcode.enters_parameters |= begins;
  if (!reading.gcode.enters_parameters) return;
  if (begins) block.forget = all_axes;
  if (block.axis || block.has(motion) || reading.trc_active()) return;
  block.copied = true;
  block.move.radius.reset();
  block.center.reset();
  take_for_technology(line, WordRole::coordinate);
}

}  // namespace trc
