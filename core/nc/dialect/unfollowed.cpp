#include "core/nc/dialect/unfollowed.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/named_functions.h"
#include "core/nc/dialect/reading.h"

// Functions that change the meaning of coordinates, each up to its own end: a second one does not
// end the first, and the end of one does not end the others (D-112).

namespace trc {
namespace {

using enum GGroup;

// SCALE of Sinumerik; SCALE alone ends it.
constexpr int scale_tenths = by_name::scale.tenths();
// The frame that TRANS, ROT, MIRROR and SCALE replace as a whole.
constexpr const char* programmable_frame = "$P_PFRAME";

// Each end and the function that it ends, in tenths.
constexpr auto ends_of_modes = std::to_array<std::pair<int, int>>(
    {{tenths_of(13, 1), tenths_of(12, 1)},
     {tenths_of(13, 1), tenths_of(112)},
     {tenths_of(15), tenths_of(16)},
     {tenths_of(50), tenths_of(51)},
     {tenths_of(72), tenths_of(72)},  // G72 S1 of Fagor
     {by_name::transformation_end.tenths(), by_name::transformation.tenths()},
     {by_name::compensation_in_space_end.tenths(), by_name::compensation_in_space.tenths()},
     {by_name::coupled_axis_end[0].tenths(), by_name::coupled_axis[0].tenths()},
     {by_name::coupled_axis_end[1].tenths(), by_name::coupled_axis[1].tenths()},
     {by_name::coupled_axis_end[2].tenths(), by_name::coupled_axis[2].tenths()}});

// Threads, tapping in step with the spindle and probing last up to the next motion function.
bool is_modal_motion(DialectName dialect, int tenths) {
  using enum DialectName;
  static constexpr std::array of_isg{tenths_of(33), tenths_of(63), tenths_of(331), tenths_of(332)};
  static constexpr std::array of_sinumerik{tenths_of(33), tenths_of(34), tenths_of(35),
                                           tenths_of(331), tenths_of(332)};
  static constexpr std::array of_linuxcnc{tenths_of(33),    tenths_of(33, 1), tenths_of(38, 2),
                                          tenths_of(38, 3), tenths_of(38, 4), tenths_of(38, 5)};
  if (dialect == isg) return std::ranges::find(of_isg, tenths) != of_isg.end();
  if (dialect == fanuc) return tenths == tenths_of(33);
  if (dialect == sinumerik) return std::ranges::find(of_sinumerik, tenths) != of_sinumerik.end();
  return dialect == linuxcnc && std::ranges::find(of_linuxcnc, tenths) != of_linuxcnc.end();
}

// The kind of turn that a function begins or ends: rotation, mirroring, mirroring by G101.
std::uint8_t turn_of(int tenths) {
  switch (tenths) {
    case tenths_of(53, 1):
    case tenths_of(68):
    case tenths_of(68, 2):
    case tenths_of(69):
      return 1;
    case tenths_of(50, 1):
    case tenths_of(51, 1):
      return 2;
    case tenths_of(100):
    case tenths_of(101):
      return 4;
    default:
      return 0;
  }
}
bool ends_turn(int tenths) {
  return tenths == tenths_of(50, 1) || tenths == tenths_of(69) || tenths == tenths_of(100);
}

bool ends_what_is_unfollowed(const Reading& reading, const BlockWords& block) {
  return std::ranges::any_of(ends_of_modes, [&](const std::pair<int, int>& each) {
    return std::ranges::find(block.coordinates.ends, each.first) != block.coordinates.ends.end() &&
           reading.gcode.coordinates.is_unfollowed(each.second);
  });
}

void end_scaling_frames(Reading& reading, const std::string& frame) {
  std::erase_if(reading.gcode.coordinates.unfollowed, [&](const UnfollowedMode& mode) {
    return mode.function == by_name::scaling_frame.tenths() && mode.frame == frame;
  });
}

void take_modal_motion(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  const bool begins =
      block.has(single_move) &&
      is_modal_motion(reading.dialect.name, block.of(single_move).function->tenths());
  if (begins || block.has(motion) || block.has(cycle) || block.has(cycle_end))
    std::erase_if(reading.gcode.coordinates.unfollowed,
                  [](const UnfollowedMode& mode) { return mode.is_motion; });
  if (!begins) return;
  const GFunction& function = *block.of(single_move).function;
  reading.gcode.coordinates.unfollowed.push_back({.function = function.tenths(),
                                                  .line = line.source.line,
                                                  .meaning = std::string(function.meaning),
                                                  .is_motion = true});
}

}  // namespace

void take_what_is_unfollowed(Reading& reading, const ProgramLine& line, BlockWords& block) {
  const bool scales = block.of(unfollowed).is(by_name::scale);
  if (block.of(frame).is(by_name::absolute_frame) || (scales && !block.coordinates.adds_to_frame)) {
    reading.gcode.coordinates.end_unfollowed(scale_tenths);
    end_scaling_frames(reading, programmable_frame);
  }
  if (!block.coordinates.frame.empty()) end_scaling_frames(reading, block.coordinates.frame);
  if (block.coordinates.frame == programmable_frame)
    reading.gcode.coordinates.end_unfollowed(scale_tenths);
  // SCALE alone ends all frames, as TRANS alone does.
  if (scales && !block.axis && !block.coordinates.adds_to_frame) {
    block.set(by_name::absolute_frame, block.of(unfollowed).begin);
    block.clear(unfollowed);
  }
  if (block.has(motion)) reading.gcode.coordinates.end_unfollowed(by_name::spline.tenths());
  if (block.has(unfollowed)) {
    const GFunction& function = *block.of(unfollowed).function;
    if (!block.of(unfollowed).is(by_name::scaling_frame))
      reading.gcode.coordinates.end_unfollowed(function.tenths());
    reading.gcode.coordinates.unfollowed.push_back({.function = function.tenths(),
                                                    .line = line.source.line,
                                                    .meaning = std::string(function.meaning),
                                                    .frame = block.coordinates.frame});
  }
  take_modal_motion(reading, line, block);
  if (!block.has(unfollowed_end)) return;
  for (const auto& [end, mode] : ends_of_modes)
    if (std::ranges::find(block.coordinates.ends, end) != block.coordinates.ends.end())
      reading.gcode.coordinates.end_unfollowed(mode);
}

void read_plain_lines_again(Reading& reading) {
  reading.reads_plain_lines = reading.faults.empty() && !reading.called_motion &&
                              !reading.called_dimension &&
                              reading.gcode.coordinates.unfollowed.empty();
}

void take_contour_of_cycle(Reading& reading, const ProgramLine& line, BlockWords& block) {
  if (!block.isg.cycle_contour || reading.contour_open()) return;
  constexpr int contour = by_name::cycle_contour.tenths();
  reading.gcode.coordinates.end_unfollowed(contour);
  block.forget = all_axes;
  if (*block.isg.cycle_contour)
    reading.gcode.coordinates.unfollowed.push_back(
        {.function = contour,
         .line = line.source.line,
         .meaning = std::string(by_name::cycle_contour.meaning)});
  read_plain_lines_again(reading);
}

bool copy_thread(Reading& reading, ProgramLine& line, BlockWords& block) {
  const bool was_under_thread = !reading.gcode.coordinates.unfollowed.empty();
  take_modal_motion(reading, line, block);
  const bool under_thread = !reading.gcode.coordinates.unfollowed.empty();
  if (was_under_thread != under_thread) read_plain_lines_again(reading);
  const bool is_position = !block.has(dwell) && !block.of(zero_shift).is(92);
  if (!under_thread || !(block.has(single_move) || (block.axis && is_position))) return true;
  if (reading.contour_open() || block.selects()) {
    const UnfollowedMode& mode = reading.gcode.coordinates.unfollowed.back();
    const bool is_command = mode.function == by_name::cycle_contour.tenths();
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = block.has(single_move) ? block.of(single_move).begin : *block.axis,
                        .detail = is_command ? "TRC in " + mode.meaning
                                             : "G" + std::to_string(mode.function / 10) + ", " +
                                                   mode.meaning + " while TRC is active"});
  }
  block.copied = true;
  block.forget |= block.named_axes();
  take_for_technology(line, WordRole::coordinate);
  take_for_technology(line, WordRole::trc);
  return true;
}

void forget_what_ends_nothing(Reading& reading, BlockWords& block) {
  if (block.has(unfollowed_end) && !ends_what_is_unfollowed(reading, block))
    block.clear(unfollowed_end);
  std::uint8_t ended = 0;
  for (const int each : block.coordinates.ends)
    if (ends_turn(each)) ended |= turn_of(each);
  if (block.has(frame) && ends_turn(block.of(frame).function->tenths())) {
    if ((reading.gcode.coordinates.turned & ended) == 0) {
      // The axes of G50.1 and G100 are no longer mirrored. With T beside it, G100 is a tool change
      // that moves to them.
      block.copied |= block.axis && !block.tools.t_word && !block.of(frame).is(69);
      block.clear(frame);
    }
  } else if (block.has(frame)) {
    reading.gcode.coordinates.turned |= turn_of(block.of(frame).function->tenths());
  }
  reading.gcode.coordinates.turned &= static_cast<std::uint8_t>(~ended);
  if (block.of(frame).is(255, 0) && !reading.gcode.coordinates.dynamic_offset) block.clear(frame);
  if (block.of(frame).is(254, 0) || block.of(frame).is(255, 0))
    reading.gcode.coordinates.dynamic_offset = block.of(frame).is(254);
}

void end_what_was_unfollowed(Reading& reading, BlockWords& block) {
  constexpr int cylinder = tenths_of(7, 1);
  constexpr int polar = tenths_of(112);
  constexpr int mapping = tenths_of(107);
  constexpr int setup_error = tenths_of(54, 4);
  if (block.of(zero_shift).is(113)) reading.gcode.coordinates.end_unfollowed(polar);
  bool ends = false;
  if (block.coordinates.changes_length)
    for (const int led :
         {tenths_of(43, 1), tenths_of(43, 4), tenths_of(43, 5), tenths_of(143), tenths_of(234)})
      ends |= reading.gcode.coordinates.end_unfollowed(led);
  if (block.has(unfollowed)) {
    const int begun = block.of(unfollowed).function->tenths();
    const bool by_zero = begun == cylinder && !block.move.tracking.empty() &&
                         std::ranges::all_of(block.move.tracking, [](const auto& radius) {
                           return radius.value_or(0) == 0;
                         });
    const bool alone = begun == mapping && !block.axis && !block.q_word && !block.center;
    const bool by_number = begun == setup_error && block.p_word && block.p_word->value == 0;
    if (by_zero || alone || by_number) {
      ends |= reading.gcode.coordinates.end_unfollowed(begun);
      if (ends || !by_zero) block.clear(unfollowed);
    }
  }
  if (!ends) return;
  block.copied = true;
  block.forget |= all_axes;
}

}  // namespace trc
