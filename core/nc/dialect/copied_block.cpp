#include <algorithm>
#include <array>
#include <string>

#include "core/nc/dialect/block_words.h"
#include "core/nc/text/characters.h"

// Lines of plain letters and numbers that are copied as they stand, since what they do is not
// followed: which, what is known of the position behind them, and that no contour hangs on them.

namespace trc {
namespace {

using enum GGroup;

// "G16, " in front of what the function does; of axis words nothing.
std::string name_of_function(const ProgramLine& line, std::uint32_t begin) {
  const auto word = std::ranges::find(line.words, begin, &WordRange::begin);
  if (word == line.words.end()) return {};
  const std::string_view text = line.word(*word);
  const bool is_function = text.size() > 1 && (upper(text[0]) == 'G' || is_letter(text[1]));
  if (!is_function) return {};
  return std::string(text.substr(0, text.find_first_of("(=["))) + ", ";
}

}  // namespace

// Decides whether the line is copied as it stands, and which axes it may move. Returns what must
// not stand there while TRC is active.
Interpreter::NotWhileActive Interpreter::find_what_is_copied(BlockWords& block) {
  NotWhileActive found;
  AxisBits named = 0;
  for (std::size_t axis = 0; axis < block.move.end.size(); ++axis)
    if (block.move.end[axis]) named |= static_cast<AxisBits>(1U << axis);
  copy_for_functions(block, named, found);
  if (dialect_.name == DialectName::linuxcnc) follow_tool_offset(block, named, found);
  copy_under_modes(block, named, found);
  copy_for_words_of_line(block, named, found);
  if (block.has(zero_shift) && !found.begin)
    found.begin = block.of(zero_shift).begin, found.meaning = "work coordinate system";
  // The contour would go on with the radius of the tool before.
  if (block.changes_tool && dialect_.name != DialectName::isg && !found.begin)
    found.begin = block.changes_tool, found.meaning = "a tool change";
  if (block.to_skip && block.has(side)) {
    found.begin = block.of(side).begin, found.meaning = "TRC in a block that may be skipped";
    found.code = Code::block_skip_undecided;
  }
  return found;
}

// Copies the line for its function of `group`, if it has one.
void Interpreter::copy_for(GGroup group, AxisBits forget, BlockWords& block,
                           NotWhileActive& found) {
  if (!block.has(group)) return;
  block.copied = true;
  block.forget |= forget;
  found.begin = block.of(group).begin;
  found.meaning = block.of(group).function->meaning;
}

// Copies a line that moves, unless another reason does so already.
void Interpreter::copy_motion(const char* why, AxisBits forget, BlockWords& block,
                              NotWhileActive& found) {
  const bool moves = block.axis || block.center || block.unfollowed_word;
  if (block.copied || !moves || block.has(dwell)) return;
  found.begin = std::min(
      {block.axis.value_or(~0U), block.center.value_or(~0U), block.unfollowed_word.value_or(~0U)});
  found.meaning = why;
  block.copied = true;
  block.forget |= forget;
}

void Interpreter::copy_for_functions(BlockWords& block, AxisBits named, NotWhileActive& found) {
  const auto third = static_cast<AxisBits>(1U << axes_of(state_.mode().plane).third);
  // G28 Z and G53 Z: the tool stays beside the contour, and the next line may end TRC.
  const bool leaves_across = dialect_.name == DialectName::fanuc && named == third &&
                             !block.center && !block.to_skip &&
                             (block.of(single_move).is(28) || block.of(single_move).is(30) ||
                              block.of(single_move).is(53));
  copy_for(single_move, named == 0 || block.of(single_move).is(1007) ? all_axes : named, block,
           found);
  if (leaves_across) found = {};
  copy_for(cycle, static_cast<AxisBits>(named | third), block, found);
  // Both controls: the axes named stand where the block says, the others where they stood.
  block.sets_position = block.has(frame) && block.of(frame).function->tenths() == 920 &&
                        block.axis && !incremental_ && !block.to_skip &&
                        !block.of(dimension).is(91);
  copy_for(frame, block.sets_position ? AxisBits{0} : all_axes, block, found);
  const bool moves_zero_points =
      block.tool_data && (block.tool_data->value == 2 || block.tool_data->value == 20);
  copy_for(tool_data, moves_zero_points ? all_axes : AxisBits{0}, block, found);
  copy_for(unfollowed, all_axes, block, found);
  copy_for(unfollowed_end, all_axes, block, found);
}

// LinuxCNC: a tool offset in the plane moves the coordinates; along the third axis nothing hangs
// on it (D-71).
void Interpreter::follow_tool_offset(BlockWords& block, AxisBits named, NotWhileActive& found) {
  const auto third = static_cast<AxisBits>(1U << axes_of(state_.mode().plane).third);
  if (block.of(axis_technology).is(43) && (named & ~third) != 0) {
    block.forget |= static_cast<AxisBits>(named & ~third);
    code_.offset_axes |= static_cast<AxisBits>(named & ~third);
  }
  const bool ends_offset = block.of(technology).is(49) || block.of(technology).is(43);
  if (!ends_offset || code_.offset_axes == 0) return;
  block.forget |= code_.offset_axes;
  code_.offset_axes = 0;
  if (!found.begin)
    found.begin = block.of(technology).begin, found.meaning = "a tool offset in the plane";
}

// What began the cycle, or changed the coordinates, has been told where TRC is active.
void Interpreter::copy_under_modes(BlockWords& block, AxisBits named, NotWhileActive& found) {
  const bool told = !block.copied || block.has(unfollowed_end);
  const auto third = static_cast<AxisBits>(1U << axes_of(state_.mode().plane).third);
  if (code_.cycle)
    copy_motion("a position of a drilling cycle", static_cast<AxisBits>(named | third), block,
                found);
  if (machine_follows_)
    copy_motion("a motion under G66 of a macro that only the machine has", all_axes, block, found);
  const bool moves_as_named = std::ranges::all_of(code_.unfollowed, &UnfollowedMode::is_motion);
  if (!code_.unfollowed.empty())
    copy_motion("a position that is not followed", moves_as_named ? named : all_axes, block, found);
  found.hangs_on_what_was_told = told && block.copied;
}

void Interpreter::copy_for_words_of_line(BlockWords& block, AxisBits named, NotWhileActive& found) {
  // A pole moves nothing. That of G110 counts from where the tool stands.
  const bool sets_pole = block.of(axis_technology).is(110) && !trc_active();
  if (sets_pole || block.of(axis_technology).is(111) || block.of(axis_technology).is(112)) {
    block.copied = true;
  } else if (block.axis) {
    copy_for(axis_technology, AxisBits{0}, block, found);
  }
  // Where the axes stop only the machine knows.
  if (block.measures) copy_motion("measuring", named, block, found);
  if (block.unfollowed_word)
    copy_motion("CT, TURN=, AP=, RP=, ANG=, ,A or a variable", all_axes, block, found);
  // In a contour they have centres (take_tangent).
  const bool follows_tangent = trc_active() && !block.has(side);
  if (code_.tangent_arcs && !follows_tangent) copy_motion("CT", named, block, found);
  if (leaves_from_lost_place(block))
    copy_motion("a motion of one axis behind a deselection without motion", named, block, found);
  if (dialect_.name == DialectName::fanuc && block.tool_data)
    copy_motion("a motion with L, which is repeated", all_axes, block, found);
  if (block.to_skip && !block.copied) {
    copy_motion("a motion that may be skipped", named, block, found);
    if (block.copied) found.code = Code::block_skip_undecided;
  }
}

// Its other axis still stands beside the contour, or where only the control knows.
bool Interpreter::leaves_from_lost_place(const BlockWords& block) const {
  const bool incremental = block.has(dimension) ? block.of(dimension).is(91) : incremental_;
  const bool stands_beside = contour_open() && (!trc_active() || block.of(side).is(40));
  const PlaneAxes axes = axes_of(state_.mode().plane);
  const bool is_whole = block.move.end[axes.first] && block.move.end[axes.second];
  return stands_beside && (state_.retract_is_lost() || block.has(zero_shift)) && !incremental &&
         !is_whole && dialect_.name != DialectName::isg;
}

// What a copied line does behind a deselection without motion. In its output the axes it does not
// name stand beside the contour, by the tool radius away from where the program has them (D-74).
bool Interpreter::leave_contour_by_copy(ProgramLine& line, const BlockWords& block) {
  const bool drills_here = block.has(cycle) && contour_open() && !trc_active();
  if (!state_.retract_is_lost() && !drills_here) return true;
  const bool sets = block.has(frame) || block.has(dwell) || block.has(tool_data);
  const bool machine_place = block.has(single_move);
  std::array<bool, 3> named{};
  for (std::size_t axis = 0; axis < named.size(); ++axis)
    named[axis] =
        block.move.end[axis] && !sets && !block.to_skip && (!incremental_ || machine_place);
  if (block.copied) state_.have_left_contour(named);
  const bool cuts = code_.cycle || motion_ != MotionKind::rapid;
  const bool goes = block.axis && !sets && !machine_place && !block.calls_the_machine;
  if (!block.has(cycle) && !(goes && cuts)) return true;
  return check_left_contour(line, block.axis.value_or(0), named);
}

// Before the tool cuts, each axis has to stand where the program has it, or be led there.
bool Interpreter::check_left_contour(const ProgramLine& line, std::uint32_t begin,
                                     const std::array<bool, 3>& named) {
  const auto& beside = state_.beside_contour();
  const char* const ended =
      dialect_.name == DialectName::heidenhain ? "R0 without motion" : "G40 without motion";
  for (std::size_t axis = 0; axis < beside.size(); ++axis)
    if (beside[axis] && !named[axis])
      return refuse(line, TextFault{.code = Code::position_unknown,
                                    .begin = begin,
                                    .detail = std::string(1, "XYZ"[axis]) +
                                              ", beside the contour since " + ended});
  return true;
}

// What counts on the motion before it cannot be copied behind one that TRC moves, and what no
// number says cannot be written anew.
bool Interpreter::check_motion_before(const ProgramLine& line, const BlockWords& block) {
  const bool selects = block.has(side) && !block.of(side).is(40);
  if (code_.tangent_arcs && block.axis && code_.leaves_contour && faults_.empty() && !trc_active())
    return refuse(line,
                  TextFault{.code = Code::nc_unsupported,
                            .begin = *block.axis,
                            .detail = "CT behind a motion of the contour: program its centre"});
  if (code_.tangent_arcs && block.axis && trc_active() && block.has(side))
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = *block.axis,
                                  .detail = "CT while TRC is active"});
  if (code_.tangent_arcs && code_.tangents_written && block.axis && !trc_active())
    return refuse(line,
                  TextFault{.code = Code::nc_unsupported,
                            .begin = *block.axis,
                            .detail = "CT of a contour, which holds behind it: write CT anew"});
  if (block.of(axis_technology).is(110) && contour_open() && !trc_active())
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = block.of(axis_technology).begin,
                                  .detail = "G110 behind G40 without motion"});
  if (block.way_round && (selects || contour_open()))
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = *block.way_round,
                                  .detail = "DC, ACP or ACN, a way round, beside a contour"});
  return true;
}

// The pitch of a helix is not followed: while TRC is off the control has it (D-87).
void Interpreter::copy_helix_with_pitch(ProgramLine& line, BlockWords& block) const {
  const Plane plane = block.of(GGroup::plane).is(17)   ? Plane::xy
                      : block.of(GGroup::plane).is(18) ? Plane::zx
                      : block.of(GGroup::plane).is(19) ? Plane::yz
                                                       : state_.programmed_plane();
  const double pitch = block.move.center[axes_of(plane).third].value_or(0);
  const bool goes_on = motion_ == MotionKind::clockwise || motion_ == MotionKind::counter_clockwise;
  const bool is_arc =
      block.has(motion) ? block.of(motion).is(2) || block.of(motion).is(3) : goes_on;
  if (block.copied || pitch == 0 || !is_arc || contour_open() || block.has(side) ||
      block.has(dwell) || block.move.radius || dialect_.name == DialectName::linuxcnc)
    return;
  block.copied = true;
  for (std::size_t axis = 0; axis < block.move.end.size(); ++axis)
    if (block.move.end[axis]) block.forget |= static_cast<AxisBits>(1U << axis);
  take_for_technology(line, WordRole::coordinate);
  take_for_technology(line, WordRole::trc);
}

bool Interpreter::copy_code_block(ProgramLine& line, BlockWords& block) {
  if (block.axis && (block.of(axis_technology).is(5) || block.of(axis_technology).is(8)))
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = block.of(axis_technology).begin,
                                  .detail = "G5 or G8 with axis words"});
  const bool shifts_zero =
      code_.dynamic_offset &&
      std::ranges::any_of(block.move.tracking, [](const auto& value) { return value.has_value(); });
  if (shifts_zero && trc_active())
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = *block.axis,
                                  .detail = "a turning axis under G254 while TRC is active"});
  if (shifts_zero) block.forget |= all_axes;
  if (!check_motion_before(line, block)) return false;
  NotWhileActive found = find_what_is_copied(block);
  // G40 beside G28 and the like ends TRC first.
  const bool active = trc_active() && !block.of(side).is(40);
  const bool selects_here = block.has(side) && !block.of(side).is(40);
  const bool may_be_skipped = block.to_skip && block.has(side) && (selects_here || contour_open());
  if (found.hangs_on_what_was_told && !faults_.empty() && !selects_here && active) return false;
  if (found.begin && (active || (selects_here && block.copied) || may_be_skipped))
    return refuse(line, TextFault{.code = found.code,
                                  .begin = *found.begin,
                                  .detail = found.code == Code::nc_unsupported
                                                ? name_of_function(line, *found.begin) +
                                                      found.meaning + " while TRC is active"
                                                : found.meaning});
  // G41 would come out, and the control compensate once more.
  if (block.copied && selects_here)
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = block.of(side).begin,
                                  .detail = "TRC beside axis words that are no positions"});
  if (!block.copied) return true;
  const PlaneAxes axes = axes_of(state_.mode().plane);
  const bool says_place = block.has(axis_technology) || block.has(frame) || block.has(dwell) ||
                          block.has(tool_data) || block.has(zero_shift);
  if ((block.move.end[axes.first] || block.move.end[axes.second]) && !says_place)
    code_.leaves_contour = false;
  take_for_technology(line, WordRole::coordinate);
  take_for_technology(line, WordRole::trc);
  return true;
}

}  // namespace trc
