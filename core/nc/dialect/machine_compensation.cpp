#include <string>

#include "core/nc/dialect/block_words.h"
#include "core/nc/text/characters.h"

// Cycles that the machine compensates by itself, with a D register of its own: G12, G13 and G150 of
// Haas (D-66, D-102).

namespace trc {
namespace {

using enum GGroup;

}  // namespace

// G41 and D beside G150 of Haas are for its pocket. Where neither the line nor what comes out in
// front of it says the register, the machine takes the one that stood in force before.
bool Interpreter::take_cycle_with_register(ProgramLine& line, BlockWords& block) {
  const BlockWords::Function& cycle = block.of(single_move);
  const bool selects = block.has(side) && !block.of(side).is(40);
  const bool compensates = cycle.is(12) || cycle.is(13) || cycle.is(150);
  if (!compensates || contour_open()) {
    if (!block.tool) return true;
    code_.register_comes_out = !selects && !trc_active();
    code_.register_place = place_of_word(line, block.tool->begin);
    code_.last_register = block.tool->value;
    return true;
  }
  const std::string name = "G" + std::to_string(cycle.function->number);
  if (!block.tool && !code_.register_comes_out)
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = cycle.begin,
                                  .detail = name + " without D behind D" +
                                            std::to_string(whole_number(code_.last_register)) +
                                            " " + place_of(code_.register_place.source)});
  const std::uint32_t begin = block.tool ? block.tool->begin : cycle.begin;
  if (block.tool) {
    code_.last_register = block.tool->value;
    code_.register_comes_out = true;
  }
  if (cycle.is(150)) {
    block.side_of_machine = true;
    block.forget = all_axes;
    block.clear(side);
    take_for_technology(line, WordRole::trc);
  }
  if (code_.last_register == 0 || !faults_.empty()) return true;
  const bool is_said = block.tool || code_.last_register > 0;
  Diagnostic warned =
      diagnostic(Code::machine_compensates, line.source,
                 is_said ? name + " D" + std::to_string(whole_number(code_.last_register)) : name);
  warned.column = place_of_word(line, begin).column;
  return diagnostics_.report(std::move(warned));
}

// G10 L50 and L52 of Fanuc: what the lines up to G11 write are parameters of the control, which may
// be anything.
void Interpreter::take_parameters_of_control(ProgramLine& line, BlockWords& block) {
  const bool begins = block.has(tool_data) && block.tool_data &&
                      (block.tool_data->value == 50 || block.tool_data->value == 52);
  code_.enters_parameters |= begins;
  if (!code_.enters_parameters) return;
  if (begins) block.forget = all_axes;
  if (block.axis || block.has(motion) || trc_active()) return;
  block.copied = true;
  block.move.radius.reset();
  block.center.reset();
  take_for_technology(line, WordRole::coordinate);
}

}  // namespace trc
