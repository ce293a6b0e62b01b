#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>

#include "core/nc/dialect/block_words.h"
#include "core/nc/text/characters.h"

// What the words of a block of plain letters and numbers mean together, before any of it takes
// effect: the dialects of Fanuc and of LinuxCNC.

namespace trc {
namespace {

using enum GGroup;

// NAME(…) of Sinumerik; under G66 of Fanuc what its own line says.
std::string_view called_name(std::string_view text, std::uint32_t begin) {
  return text.substr(begin, text.find(';', begin) - begin);
}

constexpr std::array<MotionKind, 4> motions{MotionKind::rapid, MotionKind::linear,
                                            MotionKind::clockwise, MotionKind::counter_clockwise};

}  // namespace

// What the words mean together, before any of it takes effect.
bool Interpreter::complete_code_block(ProgramLine& line, BlockWords& block) {
  if (dialect_.name == DialectName::fanuc && block.whole != 0 && !block.has(dwell) &&
      !count_whole_numbers(line, block))
    return false;
  // T01T02M06 of Mazak: the first tool is changed, the second one fetched meanwhile. Radii come
  // from D, so nothing hangs on which of them a control loads.
  if (block.later_tool && !block.changes_tool)
    return refuse(line, TextFault{.code = Code::nc_word_twice,
                                  .begin = block.later_tool->begin,
                                  .detail = "T without M06"});
  if (!watch_tool(line, block) || !check_kept_modes(line, block)) return false;
  take_tool_words(line, block);
  take_spindle_limit(line, block);
  if (dialect_.name == DialectName::fanuc) {
    take_words_of_few_controls(block);
    take_parameters_of_control(line, block);
    if (!take_cycle_with_register(line, block)) return false;
  }
  end_modes_before(block);
  take_words_that_are_no_motion(line, block);
  if (!check_dwell(line, block) || !check_skipped_modes(line, block)) return false;
  take_unit_of_old(line, block);
  forget_what_ends_nothing(block);
  end_what_was_unfollowed(block);
  take_what_is_unfollowed(line, block);
  take_work_offset(block);
  if (dialect_.name == DialectName::sinumerik) {
    take_pole(block);
    if (!resolve_polar_words(line, block) || !take_soft_lead(line, block)) return false;
  }
  if (!take_fagor_words(line, block) || !take_modal_rounding(line, block)) return false;
  if (!check_code_selection(line, block) || !take_corner(line, block) ||
      !take_corner_feed(line, block))
    return false;
  take_turns_of_arc(line, block);
  if (!restate_modes(line, block)) return false;
  if (block.calls_the_machine || machine_follows_)
    forget_what_a_call_may_change(
        line, block,
        block.calls_the_machine ? called_name(line.text, block.of(single_move).begin) : code_.call);
  pass_over_circle_words(line, block);
  const bool goes_on = copy_code_block(line, block) && check_circle_words(line, block);
  if (block.has(cycle)) code_.cycle = true;
  reads_plain_lines_ = may_read_plain_lines();
  return goes_on && take_tool_data(line, block);
}

// G50 S and G92 S: how fast the spindle may turn, of lathes.
void Interpreter::take_spindle_limit(const ProgramLine& line, BlockWords& block) {
  const bool spindle_limit = block.has(unfollowed_end) && block.of(unfollowed_end).is(50);
  const bool has_spindle = std::ranges::any_of(line.words, [&](const WordRange& word) {
    return line.text[word.begin] == 'S' || line.text[word.begin] == 's';
  });
  const bool sets_spindle_limit = block.of(frame).is(92) && has_spindle && !block.axis;
  code_.turning |= (spindle_limit || block.of(frame).is(92)) && has_spindle;
  if (sets_spindle_limit) block.clear(frame);
}

// What a motion function or F ends, before the words of the line take effect.
void Interpreter::end_modes_before(const BlockWords& block) {
  // Under MCALL of Sinumerik each motion has the cycle behind it.
  const bool motion_ends_cycle = block.has(motion) && dialect_.name != DialectName::sinumerik;
  if (motion_ends_cycle || block.has(cycle_end)) code_.cycle = false;
  if (block.has(motion)) code_.tangent_arcs = false;
  code_.tangent_arcs |= block.begins_tangent_arcs;
  if (block.begins_tangent_arcs) code_.tangents_written = trc_active();
  code_.tooth_feed =
      block.tooth_feed.has_value() || (code_.tooth_feed && !(block.feed && !block.has(dwell)));
}

// F of a dwell is a time, R of M19 an angle, that of G5.1 a level of smoothing.
void Interpreter::take_words_that_are_no_motion(ProgramLine& line, BlockWords& block) {
  if (block.has(dwell)) {
    block.feed.reset();
    take_for_technology(line, WordRole::feed);
  }
  constexpr int smoothing_tenths = 51;
  const bool smooths =
      block.has(technology) && block.of(technology).function->tenths() == smoothing_tenths;
  if ((block.orients_spindle || smooths) && !block.axis && block.move.radius) {
    block.move.radius.reset();
    block.center.reset();
    take_for_technology(line, WordRole::coordinate);
  }
}

// G4 X2. of FANUC is a time. LINUXCNC moves to what stands beside it, others do not.
bool Interpreter::check_dwell(const ProgramLine& line, const BlockWords& block) {
  if (!block.has(dwell) || !block.axis) return true;
  const std::size_t first = dialect_.name == DialectName::fanuc ? 1 : 0;
  for (std::size_t axis = first; axis < block.move.end.size(); ++axis)
    if (block.move.end[axis])
      return refuse(line, TextFault{.code = Code::nc_unsupported,
                                    .begin = *block.axis,
                                    .detail = "G4 beside an axis word"});
  return true;
}

// Of a block that may be skipped: what all lines behind it hang on.
bool Interpreter::check_skipped_modes(const ProgramLine& line, const BlockWords& block) {
  if (block.has(dimension)) code_.dimension_uncertain = block.to_skip;
  if (code_.dimension_uncertain && block.axis && !block.to_skip)
    return refuse(line, TextFault{.code = Code::block_skip_undecided,
                                  .begin = *block.axis,
                                  .detail = "a motion behind G90 or G91 that may be skipped"});
  if (block.to_skip && (block.has(unit) || block.has(plane)))
    return refuse(line, TextFault{.code = Code::block_skip_undecided,
                                  .begin = line.words.front().begin,
                                  .detail = "a unit or a plane that may be skipped"});
  return true;
}

// The work offset in force, selected once more, changes nothing (D-111). What else moves
// coordinates, or may do so unseen, leaves open which one a selection behind it goes back to.
void Interpreter::take_work_offset(BlockWords& block) {
  constexpr std::array beside_offsets{12, 13, 27, 28, 29, 30, 31, 38, 53, 60, 70, 71, 72, 153};
  const BlockWords::Function& move = block.of(single_move);
  const bool moves_alone =
      !block.has(single_move) ||
      (std::ranges::find(beside_offsets, move.function->number) != beside_offsets.end() &&
       (move.function->tenth == 0 || move.is(38)));
  const bool may_change = block.has(frame) || block.has(tool_data) || block.has(unfollowed) ||
                          block.has(unfollowed_end) || block.calls_the_machine ||
                          machine_follows_ || !moves_alone;
  if (may_change) code_.work_offset = 0;
  if (!block.has(zero_shift)) return;
  const GFunction& function = *block.of(zero_shift).function;
  constexpr std::array shifts_by_words{53, 74, 92, 159};
  constexpr std::int64_t for_its_number = 1'000'000;
  const std::int64_t number =
      block.tool_data_number ? whole_number(block.tool_data_number->value) : 0;
  const bool is_selection =
      std::ranges::find(shifts_by_words, function.number) == shifts_by_words.end() && number >= 0 &&
      !block.has(dwell) && !may_change && !block.to_skip;
  const std::int64_t selected =
      is_selection ? number * for_its_number + function.tenths() : std::int64_t{0};
  if (selected != 0 && selected == code_.work_offset) block.clear(zero_shift);
  code_.work_offset = selected;
}

// Whether a line of axis words alone says all that its motion hangs on.
bool Interpreter::may_read_plain_lines() const {
  const WholeNumbers whole = state_.setup().whole_numbers;
  const bool plain_whole_numbers = dialect_.name != DialectName::fanuc ||
                                   whole == WholeNumbers::units ||
                                   (whole == WholeNumbers::unsaid && code_.points_seen);
  return !code_.cycle && code_.unfollowed.empty() && !code_.tangent_arcs &&
         !code_.dimension_uncertain && code_.y_seen && faults_.empty() && plain_whole_numbers &&
         !code_.enters_parameters && code_.modal_rounding == 0 && !code_.soft_approach &&
         !called_motion_ && !called_dimension_ && !code_.tooth_feed &&
         code_.open_corner.source.line == 0;
}

MotionKind Interpreter::kind_of(const BlockWords& block) const {
  return block.has(motion) ? motions[static_cast<std::size_t>(block.of(motion).function->number)]
                           : motion_;
}

// I, J, K and R of a straight motion of FANUC outside of contours: where it ends hangs on none of
// them. At feed some controls round or bevel the corner for them (D-117).
void Interpreter::pass_over_circle_words(ProgramLine& line, BlockWords& block) const {
  const MotionKind kind = kind_of(block);
  const bool is_straight = kind == MotionKind::rapid || kind == MotionKind::linear;
  if (dialect_.name != DialectName::fanuc || !block.center || !is_straight || contour_open() ||
      block.has(side) || block.has(dwell) || block.has(tool_data) || block.has(single_move) ||
      block.has(cycle) || code_.cycle || block.has(frame) || block.has(unfollowed))
    return;
  const auto says = [](const std::optional<double>& value) { return value.value_or(0) != 0; };
  const bool cuts_corner =
      kind == MotionKind::linear && (says(block.move.radius) || says(block.move.center[0]) ||
                                     says(block.move.center[1]) || says(block.move.center[2]));
  if (cuts_corner) {
    block.copied = true;
    for (std::size_t axis = 0; axis < block.move.end.size(); ++axis)
      if (block.move.end[axis]) block.forget |= static_cast<AxisBits>(1U << axis);
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

// What I, J, K and R mean in a straight motion of Fanuc: a vector beside G40 and G41, a corner.
bool Interpreter::check_circle_words(const ProgramLine& line, const BlockWords& block) {
  const MotionKind kind = kind_of(block);
  const bool is_straight = kind == MotionKind::rapid || kind == MotionKind::linear;
  if (dialect_.name != DialectName::fanuc || !block.center || !is_straight || block.copied ||
      block.has(dwell) || block.has(tool_data))
    return true;
  const bool has_center = block.move.center[0] || block.move.center[1] || block.move.center[2];
  const auto refused = [&](std::string detail) {
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = *block.center,
                                  .detail = std::move(detail)});
  };
  if (block.has(side) && has_center)
    return refused(block.of(side).is(40)
                       ? "I, J beside G40, a vector of the wall behind it"
                       : "I, J beside G41, G42, a vector of the contour behind it");
  return has_center || !block.axis || refused("R in a straight motion");
}

// G72 S0.5 of Fagor scales, where other controls drill holes on a line, with I J L (D-66).
void Interpreter::take_words_of_few_controls(BlockWords& block) {
  BlockWords::Function& found = block.functions[static_cast<std::size_t>(single_move)];
  static constexpr GFunction scaling{.number = 72, .group = unfollowed, .meaning = "scaling"};
  static constexpr GFunction no_scaling{.number = 72, .group = unfollowed_end};
  const bool drills = block.center || block.tool_data || block.tool_data_number || block.quantity;
  if (found.is(72) && !drills && (block.spindle_speed || block.axis)) {
    const bool ends = !block.axis && block.spindle_speed->value == 1;
    const GFunction& function = ends ? no_scaling : scaling;
    block.set(function, found.begin);
    found = {};
  }
}

// T, M06 and M61.
void Interpreter::take_tool_words(const ProgramLine& line, BlockWords& block) {
  if (block.tool_number) {
    code_.next_tool = block.named_tool.value_or(whole_number(block.tool_number->value));
    code_.next_tool_place = place_of_word(line, block.tool_number->begin);
  }
  code_.tool_named |= block.tool_number.has_value();
  code_.changes_by_m6 |= block.changes_tool.has_value();
  if (block.changes_tool) {
    code_.spindle_tool = code_.next_tool;
    code_.spindle_tool_place = code_.next_tool_place;
    code_.spindle_empty = code_.tool_named && code_.next_tool == 0;
    block.forget |= static_cast<AxisBits>(1U << axes_of(state_.mode().plane).third);
  }
  if (block.names_tool && block.quantity) {
    code_.spindle_tool = whole_number(block.quantity->value);
    code_.spindle_tool_place = place_of_word(line, block.quantity->begin);
    code_.spindle_empty = code_.spindle_tool == 0;
  }
}

// G70 and G71 alone are inch and mm of older controls; with words beside them they are cycles.
void Interpreter::take_unit_of_old(ProgramLine& line, BlockWords& block) const {
  BlockWords::Function& found = block.functions[static_cast<std::size_t>(single_move)];
  const bool unit_of_old = block.of(single_move).is(70) || block.of(single_move).is(71);
  if (!unit_of_old || block.axis || block.center || block.tool_data || block.tool_data_number ||
      block.has(unit))
    return;
  for (WordRange& word : line.words)
    if (word.begin == found.begin) word.role = WordRole::mode;
  block.set(*dialect_.function(found.is(70) ? 20 : 21), found.begin);
  found = {};
}

// P beside G2 and G3 of LinuxCNC: how many turns, the last of which may be a part of one.
void Interpreter::take_turns_of_arc(ProgramLine& line, BlockWords& block) const {
  if (dialect_.name != DialectName::linuxcnc || !block.tool_data_number || !contour_open()) return;
  if (!block.axis && !block.center) return;
  const MotionKind kind = kind_of(block);
  if (kind != MotionKind::clockwise && kind != MotionKind::counter_clockwise) return;
  block.turns = {.value = block.tool_data_number->value - 1,
                 .begin = block.tool_data_number->begin};
  for (WordRange& word : line.words)
    if (word.begin == block.turns->begin) word.role = WordRole::coordinate;
}

}  // namespace trc
