#include "core/nc/dialect/gcode_block.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/copied_block.h"
#include "core/nc/dialect/gcode_corners.h"
#include "core/nc/dialect/gcode_tools.h"
#include "core/nc/dialect/kept_modes.h"
#include "core/nc/dialect/machine_compensation.h"
#include "core/nc/dialect/passing_calls.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/dialect/sinumerik_arcs.h"
#include "core/nc/dialect/sinumerik_leads.h"
#include "core/nc/dialect/tool_data.h"
#include "core/nc/dialect/unfollowed.h"
#include "core/nc/dialect/whole_numbers.h"
#include "core/nc/text/characters.h"

// The meaning of all words of a block of plain letters and numbers together, before any of them
// takes effect: the dialects of Fanuc, LinuxCNC and Sinumerik.

namespace trc {
namespace {

using enum GGroup;

// NAME(…) of Sinumerik; under G66 of Fanuc the words of the line itself.
std::string_view called_name(std::string_view text, std::uint32_t begin) {
  return text.substr(begin, text.find(';', begin) - begin);
}

// G50 S and G92 S of lathes limit the spindle speed.
void take_spindle_limit(Reading& reading, const ProgramLine& line, BlockWords& block) {
  const bool spindle_limit = block.has(unfollowed_end) && block.of(unfollowed_end).is(50);
  const bool has_spindle = std::ranges::any_of(line.words, [&](const WordRange& word) {
    return line.text[word.begin] == 'S' || line.text[word.begin] == 's';
  });
  const bool sets_spindle_limit = block.of(frame).is(92) && has_spindle && !block.axis;
  reading.gcode.seen.lathe |= (spindle_limit || block.of(frame).is(92)) && has_spindle;
  if (sets_spindle_limit) block.clear(frame);
}

// Ends the modes that a motion function or F ends, before the words of the line take effect.
void end_modes_before(Reading& reading, BlockWords& block) {
  // Under MCALL of Sinumerik the cycle follows each motion.
  const bool motion_ends_cycle =
      block.has(motion) && reading.dialect.name != DialectName::sinumerik;
  // A mode that a skippable line ends may still be in force.
  if ((motion_ends_cycle || block.has(cycle_end)) && !block.to_skip) reading.gcode.cycle = false;
  // In LinuxCNC G80 is in the group of motions: no motion is in force until the next one.
  if (block.has(cycle_end) && reading.dialect.name == DialectName::linuxcnc)
    reading.motion_given = false;
  const bool begins_tangents = block.arc.begins_tangents;
  // Arcs that begin while TRC is active are output with other words.
  const GcodeModes::NamedArcs begun{.in_force = true, .are_written = reading.trc_active()};
  GcodeModes::NamedArcs& tangents = reading.gcode.tangent_arcs;
  GcodeModes::NamedArcs& through = reading.gcode.through_arcs;
  if (block.has(motion)) tangents.in_force = false;
  if (block.has(motion) || begins_tangents) through.in_force = false;
  if (begins_tangents) tangents = begun;
  if (block.arc.is_through) through = begun;
  const auto& between = block.arc.through;
  block.arc.is_through |= reading.gcode.through_arcs.in_force &&
                          std::any_of(between.begin(), between.end(),
                                      [](const auto& word) { return word.has_value(); });
  reading.gcode.tooth_feed = block.tooth_feed.has_value() ||
                             (reading.gcode.tooth_feed && !(block.feed && !block.has(dwell)));
}

// F of a dwell is a time, R of M19 an angle, R of G5.1 a level of smoothing.
void take_words_that_are_no_motion(ProgramLine& line, BlockWords& block) {
  if (block.has(dwell)) {
    block.feed.reset();
    take_for_technology(line, WordRole::feed);
  }
  const bool smooths = block.of(technology).is(5, 1);
  if ((block.spindle.is_oriented || smooths) && !block.axis && block.move.radius) {
    block.move.radius.reset();
    block.center.reset();
    take_for_technology(line, WordRole::coordinate);
  }
}

// G4 X2. of FANUC is a time. LINUXCNC moves to the axis words beside G4, others do not.
bool check_dwell(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  if (!block.has(dwell) || !block.axis) return true;
  const std::size_t first = reading.dialect.name == DialectName::fanuc ? 1 : 0;
  for (std::size_t axis = first; axis < block.move.end.size(); ++axis)
    if (block.move.end[axis])
      return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                            .begin = *block.axis,
                                            .detail = "G4 beside an axis word"});
  return true;
}

// Checks the modes of a skippable block that all lines after it depend on.
bool check_skipped_modes(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  if (block.has(dimension)) reading.gcode.skipped.dimension = block.to_skip;
  if (reading.gcode.skipped.dimension && block.axis && !block.to_skip)
    return reading.refuse(line,
                          TextFault{.code = Code::block_skip_undecided,
                                    .begin = *block.axis,
                                    .detail = "a motion after G90 or G91 that may be skipped"});
  const auto undecided = [&](std::string detail) {
    return reading.refuse(line, TextFault{.code = Code::block_skip_undecided,
                                          .begin = begin_of_words(line),
                                          .detail = std::move(detail)});
  };
  if (block.to_skip && (block.has(unit) || block.has(plane)))
    return undecided("a unit or a plane that may be skipped");
  if (block.to_skip && (block.has(feed_adaptation) || block.masks || block.corners.modal_rounding ||
                        block.corners.feed || block.corners.modal_feed))
    return undecided("feeds, corners or masking of a contour that may be skipped");
  const bool selects = block.selects();
  const bool in_contour = reading.contour_open() || selects;
  if (block.has(motion)) reading.gcode.skipped.motion = block.to_skip;
  if (reading.gcode.skipped.motion && in_contour && (block.to_skip || block.axis))
    return undecided("a motion after G00 … G03 that may be skipped");
  if (block.feed && !block.has(dwell))
    reading.gcode.skipped.feed = block.to_skip ? line.source.line : 0;
  const bool takes_feed = selects || block.axis || block.center;
  if (reading.gcode.skipped.feed > 0 && in_contour && takes_feed &&
      reading.state.mode().feed_adaptation != FeedAdaptation::off)
    return undecided("the feed at the contour, of an F that may be skipped, in line " +
                     std::to_string(reading.gcode.skipped.feed));
  return true;
}

// Whether a line with only axis words states everything that its motion depends on.
bool may_read_plain_lines(const Reading& reading) {
  const WholeNumbers whole = reading.state.setup().whole_numbers;
  const bool plain_whole_numbers = reading.dialect.name != DialectName::fanuc ||
                                   whole == WholeNumbers::units ||
                                   (whole == WholeNumbers::unsaid && reading.gcode.seen.points);
  // The reader checks the centre words that G90.1 requires one by one.
  const bool plain_centers =
      reading.dialect.name != DialectName::linuxcnc || !reading.state.absolute_center();
  return plain_centers && !reading.gcode.cycle && reading.gcode.coordinates.unfollowed.empty() &&
         !reading.gcode.corners.last_is_round && !reading.gcode.tangent_arcs.in_force &&
         !reading.gcode.skipped.dimension && !reading.gcode.skipped.motion &&
         reading.gcode.skipped.feed == 0 && reading.gcode.seen.y && reading.faults.empty() &&
         plain_whole_numbers && !reading.gcode.enters_parameters &&
         reading.gcode.corners.modal_rounding == 0 && !reading.gcode.soft.approach &&
         !reading.called_motion && !reading.called_dimension && !reading.gcode.tooth_feed &&
         reading.gcode.corners.open.source.line == 0;
}

MotionKind kind_of(const Reading& reading, const BlockWords& block) {
  return block.has(motion) ? motion_of_function(block.of(motion).function->number) : reading.motion;
}

// I, J, K and R of a straight motion of FANUC outside of contours do not affect its end. At feed
// some controls take them as a rounding or chamfer of the corner (D-117).
void pass_over_circle_words(const Reading& reading, ProgramLine& line, BlockWords& block) {
  const MotionKind kind = kind_of(reading, block);
  const bool is_straight = kind == MotionKind::rapid || kind == MotionKind::linear;
  if (reading.dialect.name != DialectName::fanuc || !block.center || !is_straight ||
      reading.contour_open() || block.has(side) || block.has(dwell) || block.has(tool_data) ||
      block.has(single_move) || block.has(cycle) || reading.gcode.cycle || block.has(frame) ||
      block.has(unfollowed))
    return;
  const auto says = [](const std::optional<double>& value) { return value.value_or(0) != 0; };
  const bool cuts_corner =
      kind == MotionKind::linear && (says(block.move.radius) || says(block.move.center[0]) ||
                                     says(block.move.center[1]) || says(block.move.center[2]));
  if (cuts_corner) {
    block.copied = true;
    block.forget |= block.named_axes();
    return;
  }
  block.move.radius.reset();
  block.move.center = {};
  block.center.reset();
  for (WordRange& word : line.words)
    if (word.role == WordRole::coordinate &&
        std::string_view("IJKR").find(upper(line.text[word.begin])) != std::string_view::npos)
      word.role = WordRole::technology;
}

// I, J, K and R in a straight motion of Fanuc: a vector beside G40 and G41, or a corner.
bool check_circle_words(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  const MotionKind kind = kind_of(reading, block);
  const bool is_straight = kind == MotionKind::rapid || kind == MotionKind::linear;
  if (reading.dialect.name != DialectName::fanuc || !block.center || !is_straight || block.copied ||
      block.has(dwell) || block.has(tool_data))
    return true;
  const bool has_center = block.move.center[0] || block.move.center[1] || block.move.center[2];
  const auto refused = [&](std::string detail) {
    return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                          .begin = *block.center,
                                          .detail = std::move(detail)});
  };
  if (block.has(side) && has_center)
    return refused(block.deselects() ? "I, J beside G40, a vector of the wall after it"
                                     : "I, J beside G41, G42, a vector of the contour after it");
  return has_center || !block.axis || refused("R in a straight motion");
}

// C beside a coordinate of the plane: on some controls of Fanuc a chamfer needs no comma. An axis
// that turns the part has been named before the contour.
bool check_chamfer(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  if (reading.dialect.name != DialectName::fanuc) return true;
  const int axis = reading.axis_of_letter['C' - 'A'];
  const auto index = static_cast<std::size_t>(axis - 3);
  if (axis < 3 || block.move.tracking.size() <= index || !block.move.tracking[index]) return true;
  if (!reading.contour_open() && !block.selects()) {
    reading.gcode.seen.c = true;
    return true;
  }
  const PlaneAxes axes = axes_of(reading.state.programmed_plane());
  const bool is_corner = kind_of(reading, block) == MotionKind::linear && !block.has(side) &&
                         (block.move.end[axes.first] || block.move.end[axes.second]);
  if (reading.gcode.seen.c || !is_corner) return true;
  const auto word = std::ranges::find_if(line.words, [&](const WordRange& each) {
    return each.role == WordRole::coordinate && upper(line.text[each.begin]) == 'C';
  });
  return reading.refuse(line,
                        TextFault{.code = Code::nc_unsupported,
                                  .begin = word == line.words.end() ? *block.axis : word->begin,
                                  .detail = "C in a straight motion of a contour"});
}

// LINUXCNC refuses a centre in a straight motion also where it is 0, or that of the third axis.
bool check_center_of_straight(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  const MotionKind kind = kind_of(reading, block);
  const bool is_straight = kind == MotionKind::rapid || kind == MotionKind::linear;
  if (reading.dialect.name != DialectName::linuxcnc || !block.center || !block.axis ||
      !is_straight || block.copied || block.has(dwell) || block.has(tool_data) ||
      block.has(single_move) || block.has(cycle) || reading.gcode.cycle || block.has(turning) ||
      block.has(frame) || block.has(unfollowed))
    return true;
  return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                        .begin = *block.center,
                                        .detail = "a circle word in a straight motion"});
}

// G72 S0.5 of Fagor scales; on other controls G72 with I J L drills holes on a line (D-66).
void take_words_of_few_controls(BlockWords& block) {
  BlockWords::Function& found = block.functions[static_cast<std::size_t>(single_move)];
  static constexpr GFunction scaling{.number = 72, .group = unfollowed, .meaning = "scaling"};
  static constexpr GFunction no_scaling{.number = 72, .group = unfollowed_end};
  const bool drills = block.center || block.l_word || block.p_word || block.q_word;
  if (found.is(72) && !drills && (block.spindle.speed || block.axis)) {
    const bool ends = !block.axis && block.spindle.speed->value == 1;
    const GFunction& function = ends ? no_scaling : scaling;
    block.set(function, found.begin);
    found = {};
  }
}

// T, M06 and M61.
void take_tool_words(Reading& reading, const ProgramLine& line, BlockWords& block) {
  if (block.tools.t_word) {
    reading.gcode.tools.next =
        block.tools.named.value_or(register_number(block.tools.t_word->value));
    reading.gcode.tools.next_place = reading.place_of_word(line, block.tools.t_word->begin);
  }
  reading.gcode.tools.named |= block.tools.t_word.has_value();
  reading.gcode.tools.changed_by_m6 |= block.tools.change.has_value();
  if (block.tools.change) {
    reading.gcode.tools.in_spindle = reading.gcode.tools.next;
    reading.gcode.tools.spindle_place = reading.gcode.tools.next_place;
    reading.gcode.tools.spindle_is_empty =
        reading.gcode.tools.named && reading.gcode.tools.next == 0;
    block.forget |= main_axis_bit(axes_of(reading.state.mode().plane).third);
  }
  if (block.tools.q_word_names_tool && block.q_word) {
    reading.gcode.tools.in_spindle = register_number(block.q_word->value);
    reading.gcode.tools.spindle_place = reading.place_of_word(line, block.q_word->begin);
    reading.gcode.tools.spindle_is_empty = reading.gcode.tools.in_spindle == 0;
  }
}

// G70 and G71 alone are inch and mm of older controls; with words beside them they are cycles.
void take_unit_of_old(const Reading& reading, ProgramLine& line, BlockWords& block) {
  BlockWords::Function& found = block.functions[static_cast<std::size_t>(single_move)];
  const bool unit_of_old = block.of(single_move).is(70) || block.of(single_move).is(71);
  if (!unit_of_old || block.axis || block.center || block.l_word || block.p_word || block.has(unit))
    return;
  for (WordRange& word : line.words)
    if (word.begin == found.begin) word.role = WordRole::mode;
  block.set(*reading.dialect.function(found.is(70) ? 20 : 21), found.begin);
  found = {};
}

// P beside G2 and G3 of LinuxCNC is the number of turns; the last one may be a partial turn.
void take_turns_of_arc(const Reading& reading, ProgramLine& line, BlockWords& block) {
  if (reading.dialect.name != DialectName::linuxcnc || !block.p_word || !reading.contour_open())
    return;
  if (!block.axis && !block.center) return;
  const MotionKind kind = kind_of(reading, block);
  if (kind != MotionKind::clockwise && kind != MotionKind::counter_clockwise) return;
  block.arc.turns = {.value = block.p_word->value - 1, .begin = block.p_word->begin};
  for (WordRange& word : line.words)
    if (word.begin == block.arc.turns->begin) word.role = WordRole::coordinate;
}

// How the words change the coordinates from here on.
void take_coordinates(Reading& reading, const ProgramLine& line, BlockWords& block) {
  std::vector<UnfollowedMode> before;
  if (block.to_skip) before = reading.gcode.coordinates.unfollowed;
  const std::uint8_t turned = reading.gcode.coordinates.turned;
  forget_what_ends_nothing(reading, block);
  end_what_was_unfollowed(reading, block);
  take_what_is_unfollowed(reading, line, block);
  if (!block.to_skip) return;
  // A mode that a skippable line ends may still be in force.
  reading.gcode.coordinates.turned |= turned;
  for (UnfollowedMode& mode : before)
    if (!reading.gcode.coordinates.is_unfollowed(mode.function))
      reading.gcode.coordinates.unfollowed.push_back(std::move(mode));
}

}  // namespace

bool complete_gcode_block(Reading& reading, ProgramLine& line, BlockWords& block) {
  if (reading.dialect.name == DialectName::fanuc && block.whole != 0 && !block.has(dwell) &&
      !count_whole_numbers(reading, line, block))
    return false;
  // T01T02M06 of Mazak changes the first tool and fetches the second one meanwhile. Radii come from
  // D, so it does not matter which of them a control loads.
  if (block.tools.later_t_word && !block.tools.change)
    return reading.refuse(line, TextFault{.code = Code::nc_word_twice,
                                          .begin = block.tools.later_t_word->begin,
                                          .detail = "T without M06"});
  if (!watch_tool(reading, line, block) || !check_kept_modes(reading, line, block)) return false;
  take_tool_words(reading, line, block);
  take_spindle_limit(reading, line, block);
  if (reading.dialect.name == DialectName::fanuc) {
    take_words_of_few_controls(block);
    take_parameters_of_control(reading, line, block);
    if (!take_cycle_with_register(reading, line, block)) return false;
  }
  end_modes_before(reading, block);
  take_words_that_are_no_motion(line, block);
  if (!check_dwell(reading, line, block) || !check_skipped_modes(reading, line, block))
    return false;
  take_unit_of_old(reading, line, block);
  take_coordinates(reading, line, block);
  take_work_offset(reading, block);
  if (reading.dialect.name == DialectName::sinumerik) {
    take_pole(reading, block);
    if (!resolve_polar_words(reading, line, block) || !take_soft_lead(reading, line, block))
      return false;
  }
  if (!take_fagor_words(reading, line, block) || !take_modal_rounding(reading, line, block))
    return false;
  if (!check_gcode_selection(reading, line, block) || !take_corner(reading, line, block) ||
      !take_corner_feed(reading, line, block))
    return false;
  take_turns_of_arc(reading, line, block);
  if (!restate_modes(reading, line, block)) return false;
  if (block.calls_the_machine || reading.machine_follows)
    forget_what_a_call_may_change(reading, line, block,
                                  block.calls_the_machine
                                      ? called_name(line.text, block.of(single_move).begin)
                                      : reading.gcode.calls.last);
  pass_over_circle_words(reading, line, block);
  const bool goes_on =
      copy_gcode_block(reading, line, block) && check_circle_words(reading, line, block) &&
      check_chamfer(reading, line, block) && check_center_of_straight(reading, line, block);
  if (block.has(cycle)) reading.gcode.cycle = true;
  reading.reads_plain_lines = may_read_plain_lines(reading);
  return goes_on && take_tool_data(reading, line, block);
}

void take_work_offset(Reading& reading, BlockWords& block) {
  constexpr std::array beside_offsets{12, 13, 27, 28, 29, 30, 31, 38, 53, 60, 70, 71, 72, 153};
  const BlockWords::Function& move = block.of(single_move);
  const bool moves_alone =
      !block.has(single_move) ||
      (std::ranges::find(beside_offsets, move.function->number) != beside_offsets.end() &&
       (move.function->tenth == 0 || move.is(38)));
  const bool may_change = block.has(frame) || block.has(tool_data) || block.has(unfollowed) ||
                          block.has(unfollowed_end) || block.calls_the_machine ||
                          reading.machine_follows || !moves_alone;
  if (may_change) reading.gcode.coordinates.work_offset = 0;
  if (!block.has(zero_shift)) return;
  const GFunction& function = *block.of(zero_shift).function;
  constexpr std::array shifts_by_words{53, 74, 92, 159};
  constexpr std::int64_t for_its_number = 1'000'000;
  const std::optional<std::int64_t> number = block.p_word ? whole_number(block.p_word->value) : 0;
  const bool is_selection =
      std::ranges::find(shifts_by_words, function.number) == shifts_by_words.end() && number &&
      !block.has(dwell) && !may_change && !block.to_skip;
  const std::int64_t selected =
      is_selection ? *number * for_its_number + function.tenths() : std::int64_t{0};
  if (selected != 0 && selected == reading.gcode.coordinates.work_offset) block.clear(zero_shift);
  reading.gcode.coordinates.work_offset = selected;
}

}  // namespace trc
