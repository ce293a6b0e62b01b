#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>

#include "core/nc/dialect/block_words.h"

// What the words of a block of plain letters and numbers mean together, before any of it takes
// effect: the dialects of Fanuc and of LinuxCNC.

namespace trc {
namespace {

using enum GGroup;

// SCALE of Sinumerik, which ends where it stands alone.
constexpr int scale_tenths = 10060;

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
  if (!watch_tool(line, block)) return false;
  take_tool_words(line, block);
  const bool spindle_limit = block.has(unfollowed_end) && block.of(unfollowed_end).is(50);
  const bool has_spindle = std::ranges::any_of(line.words, [&](const WordRange& word) {
    return line.text[word.begin] == 'S' || line.text[word.begin] == 's';
  });
  const bool sets_spindle_limit = block.of(frame).is(92) && has_spindle && !block.axis;
  code_.turning |= (spindle_limit || block.of(frame).is(92)) && has_spindle;
  if (sets_spindle_limit) block.functions[static_cast<std::size_t>(frame)] = {};
  if (dialect_.name == DialectName::fanuc) take_words_of_few_controls(line, block);
  // Under MCALL of Sinumerik each motion has the cycle behind it.
  const bool motion_ends_cycle = block.has(motion) && dialect_.name != DialectName::sinumerik;
  if (motion_ends_cycle || block.has(cycle_end)) code_.cycle = false;
  if (block.has(motion)) code_.tangent_arcs = false;
  code_.tangent_arcs |= block.begins_tangent_arcs;
  code_.tooth_feed =
      block.tooth_feed.has_value() || (code_.tooth_feed && !(block.feed && !block.has(dwell)));
  if (block.has(dwell)) {  // F is a time
    block.feed.reset();
    for (WordRange& word : line.words)
      if (word.role == WordRole::feed) word.role = WordRole::technology;
  }
  // R of M19 is an angle, that of G5.1 a level of smoothing.
  constexpr int smoothing_tenths = 51;
  const bool smooths =
      block.has(technology) && block.of(technology).function->tenths() == smoothing_tenths;
  if ((block.orients_spindle || smooths) && !block.axis && block.move.radius) {
    block.move.radius.reset();
    block.center.reset();
    for (WordRange& word : line.words)
      if (word.role == WordRole::coordinate) word.role = WordRole::technology;
  }
  if (block.has(dimension)) code_.dimension_uncertain = block.to_skip;
  if (code_.dimension_uncertain && block.axis && !block.to_skip)
    return refuse(line, TextFault{.code = Code::block_skip_undecided,
                                  .begin = *block.axis,
                                  .detail = "a motion behind G90 or G91 that may be skipped"});
  if (block.to_skip && (block.has(unit) || block.has(plane)))
    return refuse(line, TextFault{.code = Code::block_skip_undecided,
                                  .begin = line.words.front().begin,
                                  .detail = "a unit or a plane that may be skipped"});
  take_unit_of_old(line, block);
  forget_what_ends_nothing(block);
  end_what_was_unfollowed(block);
  if (block.of(frame).is(absolute_frame) && code_.unfollowed == scale_tenths) code_.unfollowed = -1;
  if (block.has(unfollowed) && block.of(unfollowed).function->tenths() == scale_tenths &&
      !block.axis) {
    code_.unfollowed = -1;
    block.forget |= all_axes;
    block.functions[static_cast<std::size_t>(unfollowed)] = {};
  }
  if (block.has(motion) && code_.unfollowed == spline_interpolation * 10) code_.unfollowed = -1;
  if (block.has(unfollowed)) {
    code_.unfollowed = block.of(unfollowed).function->tenths();
    code_.unfollowed_line = line.source.line;
    code_.unfollowed_meaning = block.of(unfollowed).function->meaning;
  }
  if (block.has(unfollowed_end)) code_.unfollowed = -1;
  if (dialect_.name == DialectName::sinumerik) {
    take_pole(block);
    if (!resolve_polar_words(line, block) || !take_soft_lead(line, block)) return false;
  }
  if (!take_fagor_words(line, block) || !take_modal_rounding(line, block)) return false;
  if (!check_code_selection(line, block) || !take_corner(line, block)) return false;
  take_turns_of_arc(line, block);
  if (!restate_modes(line, block)) return false;
  if (block.calls_the_machine || machine_follows_)
    forget_what_a_call_may_change(
        line, block,
        block.calls_the_machine ? called_name(line.text, block.of(single_move).begin) : code_.call);
  const bool goes_on = copy_code_block(line, block) && check_circle_words(line, block);
  if (block.has(cycle)) code_.cycle = true;
  const WholeNumbers whole = state_.setup().whole_numbers;
  const bool plain_whole_numbers = dialect_.name != DialectName::fanuc ||
                                   whole == WholeNumbers::units ||
                                   (whole == WholeNumbers::unsaid && code_.points_seen);
  reads_plain_lines_ = !code_.cycle && code_.unfollowed < 0 && !code_.tangent_arcs &&
                       !code_.dimension_uncertain && code_.y_seen && faults_.empty() &&
                       plain_whole_numbers && code_.modal_rounding == 0 && !code_.soft_approach &&
                       !called_motion_ && !called_dimension_ && !code_.tooth_feed &&
                       code_.open_corner.source.line == 0;
  return goes_on && take_tool_data(line, block);
}

// What I, J, K and R mean in a straight motion of Fanuc: a vector beside G40 and G41, a corner.
bool Interpreter::check_circle_words(const ProgramLine& line, const BlockWords& block) {
  const MotionKind kind = block.has(motion)
                              ? motions[static_cast<std::size_t>(block.of(motion).function->number)]
                              : motion_;
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

// G72 S0.5 of Fagor scales, where other controls drill holes on a line, with I J L. G41 and D
// beside G150 of Haas are for its pocket (D-66).
void Interpreter::take_words_of_few_controls(ProgramLine& line, BlockWords& block) const {
  BlockWords::Function& found = block.functions[static_cast<std::size_t>(single_move)];
  static constexpr GFunction scaling{.number = 72, .group = unfollowed, .meaning = "scaling"};
  static constexpr GFunction no_scaling{.number = 72, .group = unfollowed_end};
  const bool drills = block.center || block.tool_data || block.tool_data_number || block.quantity;
  if (found.is(72) && !drills && (block.spindle_speed || block.axis)) {
    const bool ends = !block.axis && block.spindle_speed->value == 1;
    const GFunction& function = ends ? no_scaling : scaling;
    block.functions[static_cast<std::size_t>(function.group)] = {.function = &function,
                                                                 .begin = found.begin};
    found = {};
  }
  if (!found.is(150) || contour_open()) return;
  block.forget = all_axes;
  block.functions[static_cast<std::size_t>(side)] = {};
  block.tool.reset();
  for (WordRange& word : line.words)
    if (word.role == WordRole::trc) word.role = WordRole::technology;
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
  block.functions[static_cast<std::size_t>(unit)] = {
      .function = dialect_.function(found.is(70) ? 20 : 21), .begin = found.begin};
  found = {};
}

// G69, G50 and the like stand in the first line of many programs, where there is nothing to end.
void Interpreter::forget_what_ends_nothing(BlockWords& block) {
  const auto ends = [&](GGroup group, std::initializer_list<int> tenths) {
    return block.has(group) &&
           std::ranges::find(tenths, block.of(group).function->tenths()) != tenths.end();
  };
  if (block.has(unfollowed_end) && code_.unfollowed < 0)
    block.functions[static_cast<std::size_t>(unfollowed_end)] = {};
  if (ends(frame, {501, 690, 1000})) {
    if (!code_.turned) {
      // The axes of G50.1 and G100 are those that are mirrored no longer; with T beside it G100 is
      // a tool change that goes there.
      block.copied |= block.axis && !block.tool_number && !block.of(frame).is(69);
      block.functions[static_cast<std::size_t>(frame)] = {};
    }
    code_.turned = false;
  }
  code_.turned |= ends(frame, {511, 531, 680, 682, 1010});
  if (ends(frame, {2550}) && !code_.dynamic_offset)
    block.functions[static_cast<std::size_t>(frame)] = {};
  if (ends(frame, {2540, 2550})) code_.dynamic_offset = block.of(frame).is(254);
}

// G49 and G43 end the control of the tool tip, G07.1 with 0 its cylinder (D-51), G113 is G13.1 too.
void Interpreter::end_what_was_unfollowed(BlockWords& block) {
  constexpr std::array led{431, 434, 435, 2340};
  const bool ends_tip =
      block.changes_length && std::ranges::find(led, code_.unfollowed) != led.end();
  constexpr int cylinder = 71;
  constexpr int polar = 1120;
  if (code_.unfollowed == polar && block.of(zero_shift).is(113)) code_.unfollowed = -1;
  const bool ends_cylinder =
      code_.unfollowed == cylinder && block.has(unfollowed) &&
      block.of(unfollowed).function->tenths() == cylinder && !block.move.tracking.empty() &&
      std::ranges::all_of(block.move.tracking,
                          [](const auto& radius) { return radius.value_or(0) == 0; });
  if (!ends_tip && !ends_cylinder) return;
  code_.unfollowed = -1;
  block.copied = true;
  block.forget |= all_axes;
  if (ends_cylinder) block.functions[static_cast<std::size_t>(unfollowed)] = {};
}

// P beside G2 and G3 of LinuxCNC: how many turns, the last of which may be a part of one.
void Interpreter::take_turns_of_arc(ProgramLine& line, BlockWords& block) const {
  if (dialect_.name != DialectName::linuxcnc || !block.tool_data_number || !contour_open()) return;
  if (!block.axis && !block.center) return;
  const MotionKind kind = block.has(motion)
                              ? motions[static_cast<std::size_t>(block.of(motion).function->number)]
                              : motion_;
  if (kind != MotionKind::clockwise && kind != MotionKind::counter_clockwise) return;
  block.turns = {.value = block.tool_data_number->value - 1,
                 .begin = block.tool_data_number->begin};
  for (WordRange& word : line.words)
    if (word.begin == block.turns->begin) word.role = WordRole::coordinate;
}

// Decides whether the line is copied as it stands, and which axes it may move. Returns what must
// not stand there while TRC is active.
Interpreter::NotWhileActive Interpreter::find_what_is_copied(BlockWords& block) {
  const auto named_axes = [&] {
    AxisBits named = 0;
    for (std::size_t axis = 0; axis < block.move.end.size(); ++axis)
      if (block.move.end[axis]) named |= static_cast<AxisBits>(1U << axis);
    return named;
  };
  const bool moves = block.axis || block.center;
  const auto third = static_cast<AxisBits>(1U << axes_of(state_.mode().plane).third);
  const AxisBits named = named_axes();
  // G28 Z and G53 Z: the tool stays beside the contour, and the next line may end TRC.
  const bool leaves_across = dialect_.name == DialectName::fanuc && named == third &&
                             !block.center && !block.to_skip &&
                             (block.of(single_move).is(28) || block.of(single_move).is(30) ||
                              block.of(single_move).is(53));
  std::optional<std::uint32_t> begin;
  std::string meaning;
  const auto copy = [&](GGroup group, AxisBits forget) {
    if (!block.has(group)) return;
    block.copied = true;
    block.forget |= forget;
    if (group == single_move && leaves_across) return;
    begin = block.of(group).begin;
    meaning = block.of(group).function->meaning;
  };
  copy(single_move, named == 0 || block.of(single_move).is(1007) ? all_axes : named);
  copy(cycle, static_cast<AxisBits>(named | third));
  // Both controls: the axes named stand where the block says, the others where they stood.
  block.sets_position = block.has(frame) && block.of(frame).function->tenths() == 920 &&
                        block.axis && !incremental_ && !block.to_skip &&
                        !block.of(dimension).is(91);
  copy(frame, block.sets_position ? AxisBits{0} : all_axes);
  copy(tool_data, block.tool_data && (block.tool_data->value == 2 || block.tool_data->value == 20)
                      ? all_axes
                      : AxisBits{0});
  copy(unfollowed, all_axes);
  copy(unfollowed_end, all_axes);
  // A tool offset in the plane moves the coordinates; along the third axis nothing hangs on it
  // (D-71).
  if (dialect_.name == DialectName::linuxcnc && block.of(axis_technology).is(43) &&
      (named & ~third) != 0) {
    block.forget |= static_cast<AxisBits>(named & ~third);
    code_.offset_axes |= static_cast<AxisBits>(named & ~third);
  }
  const bool ends_offset = block.of(technology).is(49) || block.of(technology).is(43);
  if (dialect_.name == DialectName::linuxcnc && ends_offset && code_.offset_axes != 0) {
    block.forget |= code_.offset_axes;
    code_.offset_axes = 0;
    if (!begin) begin = block.of(technology).begin, meaning = "a tool offset in the plane";
  }
  const auto copy_motion = [&](const char* why, AxisBits forget) {
    if (block.copied || !(moves || block.unfollowed_word) || block.has(dwell)) return;
    begin = std::min({block.axis.value_or(~0U), block.center.value_or(~0U),
                      block.unfollowed_word.value_or(~0U)});
    meaning = why;
    block.copied = true;
    block.forget |= forget;
  };
  // What began the cycle, or changed the coordinates, has been told where TRC is active.
  const bool told = !block.copied || block.has(unfollowed_end);
  if (code_.cycle)
    copy_motion("a position of a drilling cycle", static_cast<AxisBits>(named | third));
  if (machine_follows_)
    copy_motion("a motion under G66 of a macro that only the machine has", all_axes);
  if (code_.unfollowed >= 0) copy_motion("a position that is not followed", all_axes);
  const bool hangs_on_it = told && block.copied;
  // A pole moves nothing. That of G110 counts from where the tool stands.
  const bool sets_pole = block.of(axis_technology).is(110) && !trc_active();
  if (sets_pole || block.of(axis_technology).is(111) || block.of(axis_technology).is(112)) {
    block.copied = true;
  } else if (block.axis) {
    copy(axis_technology, AxisBits{0});
  }
  if (block.unfollowed_word) copy_motion("CT, TURN=, AP=, RP=, ANG=, ,A or a variable", all_axes);
  if (code_.tangent_arcs) copy_motion("CT", named);
  if (leaves_from_lost_place(block))
    copy_motion("a motion of one axis behind a deselection without motion", named);
  const bool fanuc = dialect_.name == DialectName::fanuc;
  if (fanuc && block.tool_data) copy_motion("a motion with L, which is repeated", all_axes);
  Code code = Code::nc_unsupported;
  if (block.to_skip && !block.copied) {
    copy_motion("a motion that may be skipped", named);
    if (block.copied) code = Code::block_skip_undecided;
  }
  if (block.has(zero_shift) && !begin)
    begin = block.of(zero_shift).begin, meaning = "work coordinate system";
  // The contour would go on with the radius of the tool before.
  if (block.changes_tool && dialect_.name != DialectName::isg && !begin)
    begin = block.changes_tool, meaning = "a tool change";
  if (block.to_skip && block.has(side)) {
    begin = block.of(side).begin, meaning = "TRC in a block that may be skipped";
    code = Code::block_skip_undecided;
  }
  return {.code = code,
          .begin = begin,
          .meaning = std::move(meaning),
          .hangs_on_what_was_told = hangs_on_it};
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
                                                ? found.meaning.append(" while TRC is active")
                                                : found.meaning});
  if (!block.copied) return true;
  const PlaneAxes axes = axes_of(state_.mode().plane);
  const bool says_place = block.has(axis_technology) || block.has(frame) || block.has(dwell) ||
                          block.has(tool_data) || block.has(zero_shift);
  if ((block.move.end[axes.first] || block.move.end[axes.second]) && !says_place)
    code_.leaves_contour = false;
  for (WordRange& word : line.words)
    if (word.role == WordRole::coordinate || word.role == WordRole::trc)
      word.role = WordRole::technology;
  return true;
}

// With R beside them G36 to G39 are those of Fagor: a rounding, a tangential entry and exit, a
// chamfer. Elsewhere they measure, or have no R.
bool Interpreter::take_fagor_words(ProgramLine& line, BlockWords& block) {
  BlockWords::Function& found = block.functions[static_cast<std::size_t>(single_move)];
  if (dialect_.name != DialectName::fanuc || found.function == nullptr || !block.move.radius)
    return true;
  const int number = found.function->number;
  if (number < 36 || number > 39) return true;
  if (number == 37 || number == 38) {
    const bool selects = block.has(side) && !block.of(side).is(40);
    if (!trc_active() && !selects) return true;
    return refuse(
        line,
        TextFault{.code = Code::nc_unsupported,
                  .begin = found.begin,
                  .detail = number == 37 ? "G37 R, a tangential entry: program its line and arc"
                                         : "G38 R, a tangential exit: program its arc and line"});
  }
  block.corner = found.begin;
  block.move.corner = {.form = number == 36 ? CornerCut::Form::round : CornerCut::Form::leg,
                       .size = *block.move.radius};
  block.move.radius.reset();
  const bool in_contour = trc_active() && !block.has(side);
  block.center.reset();
  for (WordRange& word : line.words) {
    const char letter = line.text[word.begin];
    if (word.role == WordRole::coordinate && (letter == 'R' || letter == 'r'))
      word.role = in_contour ? WordRole::trc : WordRole::technology;
    const bool is_center = letter >= 'I' && letter <= 'K';
    if (word.role == WordRole::coordinate && (is_center || (letter >= 'i' && letter <= 'k')) &&
        !block.center)
      block.center = word.begin;
  }
  found = {};
  return true;
}

// RNDM= rounds every corner. What the control would round in the output too must not be modal
// there, so that it begins and ends within the contour.
bool Interpreter::take_modal_rounding(ProgramLine& line, BlockWords& block) {
  const bool selects = block.has(side) && !block.of(side).is(40);
  const bool ends = block.of(side).is(40) && trc_active();
  if (block.modal_rounding) {
    code_.modal_rounding = block.modal_rounding->value * length_unit();
    if (trc_active() || selects)
      for (WordRange& word : line.words)
        if (word.begin == block.modal_rounding->begin) word.role = WordRole::trc;
  }
  const bool from_outside = selects && !trc_active() && !block.modal_rounding;
  if (code_.modal_rounding != 0 && (from_outside || ends))
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = block.of(side).begin,
                                  .detail = "RNDM= beyond the contour: set it behind G41, G42, and "
                                            "to 0 in front of G40"});
  if (code_.modal_rounding != 0 && trc_active() && !selects && (block.axis || block.center) &&
      !block.corner && !block.copied)
    block.move.corner = {.form = CornerCut::Form::round,
                         .size = code_.modal_rounding / length_unit(),
                         .modal = true};
  return true;
}

// While TRC is active the corner becomes blocks of its own, and its word is not written. Else the
// control makes it.
bool Interpreter::take_corner(ProgramLine& line, BlockWords& block) {
  const bool moves = block.axis || block.center;
  const bool selects = block.has(side) && !block.of(side).is(40);
  // The approach is another line than the one that the program rounds into.
  if (selects && code_.open_corner.source.line > 0)
    return refuse_at(code_.open_corner, Code::nc_unsupported,
                     "a rounding or a chamfer in front of the motion that selects TRC");
  if (moves) code_.open_corner = {};
  if (!block.corner) return true;
  if (!contour_open() && !block.has(side)) {
    if (moves && block.move.corner->size != 0)
      code_.open_corner = place_of_word(line, *block.corner);
    block.move.corner.reset();
    return true;
  }
  const bool nothing_else = trc_active() && !block.has(side) && block.axis;
  if (!nothing_else || !(block.move.corner->size >= 0))
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = *block.corner,
                                  .detail = "a rounding or a chamfer beside G40 … G42, or behind "
                                            "a motion that is none"});
  if (block.move.corner->size == 0) block.move.corner.reset();
  for (WordRange& word : line.words)
    if (word.begin == *block.corner) word.role = WordRole::trc;
  return true;
}

}  // namespace trc
