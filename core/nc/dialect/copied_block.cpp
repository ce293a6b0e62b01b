#include "core/nc/dialect/copied_block.h"

#include <algorithm>
#include <array>
#include <string>

#include "core/base/reasons.h"
#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/left_contour.h"
#include "core/nc/dialect/named_functions.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/characters.h"

// Lines of plain letters and numbers that are copied unchanged because their effect is not
// followed: which lines these are, which positions remain known after them, and that no contour
// depends on them.

namespace trc {
namespace {

using enum GGroup;

// The prefix of a meaning: "G16, " for a function, "Z=R1, " for a value that is no number, nothing
// for plain axis words.
std::string name_of_function(const ProgramLine& line, std::uint32_t begin) {
  const auto word = std::ranges::find(line.words, begin, &WordRange::begin);
  if (word == line.words.end()) return {};
  const std::string_view text = line.word(*word);
  if (text.size() > 1 && text[1] == '=') return std::string(text) + ", ";
  const bool is_function = text.size() > 1 && (upper(text[0]) == 'G' || is_letter(text[1]));
  if (!is_function) return {};
  return std::string(text.substr(0, text.find_first_of("(=["))) + ", ";
}

// Why a line is not followed. Empty: it is followed.
struct NotWhileActive {
  Code code = Code::nc_unsupported;
  std::optional<std::uint32_t> begin{};  // in the line
  std::string meaning{};
  bool hangs_on_what_was_told = false;
};

// Copies the line if it has a function of `group`.
void copy_for(GGroup group, AxisBits forget, BlockWords& block, NotWhileActive& found) {
  if (!block.has(group)) return;
  block.copied = true;
  block.forget |= forget;
  found.begin = block.of(group).begin;
  found.meaning = block.of(group).function->meaning;
}

void copy_for_functions(Reading& reading, BlockWords& block, AxisBits named,
                        NotWhileActive& found) {
  const AxisBits third = main_axis_bit(axes_of(reading.state.mode().plane).third);
  // G28 Z and G53 Z: the tool stays beside the contour, and the next line may end TRC (D-135).
  const bool leaves_across = reading.dialect.name == DialectName::fanuc && named == third &&
                             !block.center && !block.to_skip &&
                             (block.of(single_move).is(28) || block.of(single_move).is(30) ||
                              block.of(single_move).is(53));
  copy_for(single_move,
           named == 0 || block.of(single_move).is(by_name::only_machine_knows) ? all_axes : named,
           block, found);
  if (leaves_across) found = {};
  copy_for(cycle, static_cast<AxisBits>(named | third), block, found);
  // On both controls the named axes are then where the block says; the others keep their position.
  block.coordinates.sets_position = block.of(frame).is(92, 0) && block.axis &&
                                    !reading.incremental && !block.to_skip &&
                                    !block.of(dimension).is(91);
  copy_for(frame, block.coordinates.sets_position ? AxisBits{0} : all_axes, block, found);
  const bool moves_zero_points =
      block.l_word && (block.l_word->value == 2 || block.l_word->value == 20);
  copy_for(tool_data, moves_zero_points ? all_axes : AxisBits{0}, block, found);
  copy_for(unfollowed, all_axes, block, found);
  copy_for(unfollowed_end, all_axes, block, found);
}

// LinuxCNC: a tool offset in the plane shifts the coordinates; an offset along the third axis does
// not matter (D-71).
void follow_tool_offset(Reading& reading, BlockWords& block, AxisBits named,
                        NotWhileActive& found) {
  const AxisBits third = main_axis_bit(axes_of(reading.state.mode().plane).third);
  if (block.of(axis_technology).is(43) && (named & ~third) != 0) {
    block.forget |= static_cast<AxisBits>(named & ~third);
    reading.gcode.coordinates.offset_axes |= static_cast<AxisBits>(named & ~third);
  }
  const bool ends_offset = block.of(technology).is(49) || block.of(technology).is(43);
  if (!ends_offset || reading.gcode.coordinates.offset_axes == 0) return;
  block.forget |= reading.gcode.coordinates.offset_axes;
  reading.gcode.coordinates.offset_axes = 0;
  if (!found.begin)
    found.begin = block.of(technology).begin, found.meaning = "a tool offset in the plane";
}

// Copies a line that moves, unless it is copied already for another reason.
void copy_motion(const char* why, AxisBits forget, BlockWords& block, NotWhileActive& found) {
  const bool moves = block.axis || block.center || block.moves_unfollowed();
  if (block.copied || !moves || block.has(dwell)) return;
  found.begin = block.unfollowed_word ? *block.unfollowed_word
                : block.without_value.begin
                    ? *block.without_value.begin
                    : std::min(block.axis.value_or(~0U), block.center.value_or(~0U));
  found.meaning = why;
  block.copied = true;
  block.forget |= forget;
}

// While TRC is active, the start of the cycle or the change of coordinates has been reported.
void copy_under_modes(Reading& reading, BlockWords& block, AxisBits named, NotWhileActive& found) {
  const bool told = !block.copied || block.has(unfollowed_end);
  const AxisBits third = main_axis_bit(axes_of(reading.state.mode().plane).third);
  if (reading.gcode.cycle)
    copy_motion("a position of a drilling cycle", static_cast<AxisBits>(named | third), block,
                found);
  if (reading.machine_follows)
    copy_motion("a motion under G66 of a macro that only the machine has", all_axes, block, found);
  const bool moves_as_named =
      std::ranges::all_of(reading.gcode.coordinates.unfollowed, &UnfollowedMode::is_motion);
  if (!reading.gcode.coordinates.unfollowed.empty())
    copy_motion("a position that is not followed", moves_as_named ? named : all_axes, block, found);
  found.hangs_on_what_was_told = told && block.copied;
}

// The other axis of the plane is still beside the contour, or only the control knows its position.
bool leaves_from_lost_place(const Reading& reading, const BlockWords& block) {
  const bool incremental = block.has(dimension) ? block.of(dimension).is(91) : reading.incremental;
  const bool stands_beside = reading.contour_open() && (!reading.trc_active() || block.deselects());
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  const bool is_whole = block.move.end[axes.first] && block.move.end[axes.second];
  return stands_beside && (reading.state.retract_is_lost() || block.has(zero_shift)) &&
         !incremental && !is_whole && reading.dialect.name != DialectName::isg;
}

void copy_for_words_of_line(Reading& reading, BlockWords& block, AxisBits named,
                            NotWhileActive& found) {
  // A pole moves no axis. G110 counts from the tool position.
  const bool sets_pole = block.of(axis_technology).is(110) && !reading.trc_active();
  if (sets_pole || block.of(axis_technology).is(111) || block.of(axis_technology).is(112)) {
    block.copied = true;
  } else if (block.axis) {
    copy_for(axis_technology, AxisBits{0}, block, found);
  }
  // Only the machine knows where the axes stop.
  if (block.measures) copy_motion("measuring", named, block, found);
  if (block.unfollowed_word) copy_motion("which is not followed here", all_axes, block, found);
  if (block.without_value.begin) copy_motion("a variable without a value", named, block, found);
  // In a contour these arcs get centres (take_tangent).
  const bool follows_tangent = reading.trc_active() && !block.has(side);
  if (reading.gcode.tangent_arcs.in_force && !follows_tangent)
    copy_motion("CT", named, block, found);
  if (leaves_from_lost_place(reading, block))
    copy_motion("a motion of one axis after a deselection without motion", named, block, found);
  if (reading.dialect.name == DialectName::fanuc && block.l_word)
    copy_motion("a motion with L, which is repeated", all_axes, block, found);
  if (block.to_skip && !block.copied) {
    copy_motion("a motion that may be skipped", named, block, found);
    if (block.copied) found.code = Code::block_skip_undecided;
  }
}

// Decides whether the line is copied unchanged, and which axes it may move. Returns the reason why
// it is not allowed while TRC is active.
NotWhileActive find_what_is_copied(Reading& reading, BlockWords& block) {
  NotWhileActive found;
  const AxisBits named = block.named_axes();
  copy_for_functions(reading, block, named, found);
  if (reading.dialect.name == DialectName::linuxcnc)
    follow_tool_offset(reading, block, named, found);
  copy_under_modes(reading, block, named, found);
  copy_for_words_of_line(reading, block, named, found);
  if (block.has(zero_shift) && !found.begin)
    found.begin = block.of(zero_shift).begin, found.meaning = "work coordinate system";
  // The contour would continue with the radius of the previous tool.
  if (block.tools.change && reading.dialect.name != DialectName::isg && !found.begin)
    found.begin = block.tools.change, found.meaning = "a tool change";
  if (block.to_skip && block.has(side)) {
    found.begin = block.of(side).begin, found.meaning = "TRC in a block that may be skipped";
    found.code = Code::block_skip_undecided;
  }
  return found;
}

// A line that depends on the motion before it cannot be copied after a motion that TRC changes, and
// a way round (DC, ACP, ACN), which no number expresses, cannot be rewritten. Nor can the increment
// of a further axis whose position is not followed.
bool check_motion_before(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  const bool selects = block.selects();
  if (reading.gcode.tangent_arcs.in_force && block.axis && reading.gcode.leaves_contour &&
      reading.faults.empty() && !reading.trc_active())
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = *block.axis,
                        .detail = "CT after a motion of the contour: program its centre"});
  if (reading.gcode.tangent_arcs.in_force && block.axis && reading.trc_active() && block.has(side))
    return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                          .begin = *block.axis,
                                          .detail = "CT while TRC is active"});
  if (reading.gcode.tangent_arcs.in_force && reading.gcode.tangent_arcs.are_written && block.axis &&
      !reading.trc_active())
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = *block.axis,
                        .detail = "CT of a contour, which holds after it: write CT anew"});
  if (reading.gcode.through_arcs.are_written && block.arc.is_through && !block.has(motion) &&
      !reading.trc_active())
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = block.axis.value_or(0),
                        .detail = "CIP of a contour, which holds after it: write CIP anew"});
  if (block.of(axis_technology).is(110) && reading.contour_open() && !reading.trc_active())
    return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                          .begin = block.of(axis_technology).begin,
                                          .detail = "G110 after G40 without motion"});
  if (block.way_round && (selects || reading.contour_open()))
    return reading.refuse(line,
                          TextFault{.code = Code::nc_unsupported,
                                    .begin = *block.way_round,
                                    .detail = "DC, ACP or ACN, a way round, beside a contour"});
  if (block.further_count && (selects || reading.contour_open()))
    return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                          .begin = *block.further_count,
                                          .detail = "AC or IC of a further axis in a contour"});
  return true;
}

}  // namespace

bool leave_contour_by_copy(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  const bool drills_here = block.has(cycle) && reading.contour_open() && !reading.trc_active();
  if (!reading.state.retract_is_lost() && !drills_here) return true;
  // The axes beside G69 are an end point, those beside G68 are not.
  const bool sets_frame = block.has(frame) && !block.of(frame).function->initial;
  const bool sets = sets_frame || block.has(dwell) || block.has(tool_data);
  const bool machine_place = block.has(single_move);
  const bool goes = block.axis && !sets && !machine_place && !block.calls_the_machine;
  LineBesideContour says{
      .copied = block.copied,
      .cuts = block.has(cycle) ||
              (goes && (reading.gcode.cycle || reading.motion != MotionKind::rapid)),
      .begin = block.axis.value_or(0)};
  for (std::size_t axis = 0; axis < says.named.size(); ++axis)
    says.named[axis] =
        block.move.end[axis] && !sets && !block.to_skip && (!reading.incremental || machine_place);
  return leave_contour(reading, line, says);
}

void copy_helix_with_pitch(const Reading& reading, ProgramLine& line, BlockWords& block) {
  const Plane plane = block.of(GGroup::plane).is(17)   ? Plane::xy
                      : block.of(GGroup::plane).is(18) ? Plane::zx
                      : block.of(GGroup::plane).is(19) ? Plane::yz
                                                       : reading.state.programmed_plane();
  const double pitch = block.move.center[axes_of(plane).third].value_or(0);
  const bool goes_on =
      reading.motion == MotionKind::clockwise || reading.motion == MotionKind::counter_clockwise;
  const bool is_arc =
      block.has(motion) ? block.of(motion).is(2) || block.of(motion).is(3) : goes_on;
  if (block.copied || pitch == 0 || !is_arc || reading.contour_open() || block.has(side) ||
      block.has(dwell) || block.move.radius || reading.dialect.name == DialectName::linuxcnc)
    return;
  block.copied = true;
  block.forget |= block.named_axes();
  take_for_technology(line, WordRole::coordinate);
  take_for_technology(line, WordRole::trc);
}

bool copy_gcode_block(Reading& reading, ProgramLine& line, BlockWords& block) {
  if (block.axis && (block.of(axis_technology).is(5) || block.of(axis_technology).is(8)))
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = block.of(axis_technology).begin,
                        .detail = std::string("G5 or G8").append(reason::with_axis_words)});
  const bool shifts_zero =
      reading.gcode.coordinates.dynamic_offset &&
      std::ranges::any_of(block.move.tracking, [](const auto& value) { return value.has_value(); });
  if (shifts_zero && reading.trc_active())
    return reading.refuse(line,
                          TextFault{.code = Code::nc_unsupported,
                                    .begin = *block.axis,
                                    .detail = "a turning axis under G254 while TRC is active"});
  if (shifts_zero) block.forget |= all_axes;
  if (!check_motion_before(reading, line, block)) return false;
  NotWhileActive found = find_what_is_copied(reading, block);
  // G40 beside G28 and the like ends TRC first.
  const bool active = reading.trc_active() && !block.deselects();
  const bool selects_here = block.selects();
  const bool may_be_skipped =
      block.to_skip && block.has(side) && (selects_here || reading.contour_open());
  if (found.hangs_on_what_was_told && !reading.faults.empty() && !selects_here && active)
    return false;
  if (found.begin && (active || (selects_here && block.copied) || may_be_skipped))
    return reading.refuse(line, TextFault{.code = found.code,
                                          .begin = *found.begin,
                                          .detail = found.code == Code::nc_unsupported
                                                        ? name_of_function(line, *found.begin) +
                                                              found.meaning + " while TRC is active"
                                                        : found.meaning});
  // The output would contain G41, and the control would compensate a second time.
  if (block.copied && selects_here)
    return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                          .begin = block.of(side).begin,
                                          .detail = "TRC beside axis words that are no positions"});
  if (!block.copied) return true;
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  const bool says_place = block.has(axis_technology) || block.has(frame) || block.has(dwell) ||
                          block.has(tool_data) || block.has(zero_shift);
  if ((block.move.end[axes.first] || block.move.end[axes.second]) && !says_place)
    reading.gcode.leaves_contour = false;
  take_for_technology(line, WordRole::coordinate);
  take_for_technology(line, WordRole::trc);
  return true;
}

}  // namespace trc
