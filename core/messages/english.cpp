#include "core/messages/english.h"

#include <algorithm>
#include <array>

namespace trc {
namespace {

constexpr auto rows = std::to_array<EnglishRow>({
    {Code::full_circle_with_radius_word, "a full circle cannot be given by its radius alone",
     "Program the centre with I, J, K instead of R."},
    {Code::circle_center_misfit,
     "the circle centre does not fit the start and end point of the arc",
     "Correct I, J, K or the end point."},
    {Code::circle_radius_zero, "the radius of the circle is zero",
     "Program a centre (I, J, K) away from the start point, or a radius other than 0."},
    {Code::radius_and_tool_word_together,
     "a D word and a value for the tool radius stand in one block",
     "Write the tool radius in a block of its own after the D word."},
    {Code::transition_type_twice, "one block programs more than one transition type (G25, G26)",
     "Keep one of them."},
    {Code::compensation_side_twice, "one block programs more than one of G40, G41, G42",
     "Keep one of them."},
    {Code::selection_mode_twice,
     "one block programs more than one selection mode (G138, G139, G236 to G239)",
     "Keep one of them. Only G05 may stand beside another mode."},
    {Code::plane_change_while_active, "the plane changes while TRC is active",
     "Deselect TRC with G40 and a motion in the plane before G17, G18 or G19."},
    {Code::axis_link_while_active, "an axis link changes while TRC is active",
     "Deselect TRC with G40 before the command."},
    {Code::preset_while_active, "#PSET or #PRESET is programmed while TRC is active",
     "Deselect TRC with G40 before the command."},
    {Code::coordinate_system_while_active, "the coordinate system changes while TRC is active",
     "Deselect TRC with G40 before the command."},
    {Code::negative_tangfeed_minimum, "the smallest contour radius of #TANGFEED is negative",
     "Program RMIN as 0 or positive."},
    {Code::center_and_radius_together, "one block gives a circle both a centre and a radius",
     "Keep either I, J, K or R."},
    {Code::tangential_ignored_with_inside_corner, "G05 has no effect under G238 and is ignored",
     "Remove G05, or choose another mode."},
    {Code::inside_corner_selected_while_active,
     "G238 is programmed while TRC is active in another mode",
     "Deselect TRC with G40 before G238."},
    {Code::mode_change_under_inside_corner,
     "the selection mode changes although TRC was selected with G238",
     "Deselect TRC with G40 before the change."},
    {Code::point_to_point_while_active, "#PTP is programmed while TRC is active",
     "Deselect TRC with G40 before the command."},
    {Code::circle_radii_differ,
     "start and end of the arc are not equally far from its centre (G164)",
     "Correct I, J, K or the end point, or let G165 correct the centre."},
    {Code::stretch_factor_out_of_range, "STRETCH_FACTOR is outside 1 to 9 and is set to 1",
     "Program a value from 1 to 9."},
    {Code::spatial_circle_while_active, "G303 is programmed while TRC is active",
     "Deselect TRC with G40 and a straight motion in the plane before G303."},
    {Code::inverse_without_online, "INVERSE is set without ONLINE",
     "Remove INVERSE; ask for the inverse path in the setup."},
    {Code::real_time_loop_while_active, "#RT WHILE is programmed while TRC is active",
     "Deselect TRC with G40 before the command."},
    {Code::circular_selection_block, "TRC is selected in a circular block",
     "Let the first motion after G41 or G42 be a straight line, or select with G236 or G237."},
    {Code::too_many_passive_blocks,
     "too many blocks without motion in the plane follow one another while TRC is active",
     "Move them before G41 or after G40, or raise the limit."},
    {Code::tool_not_smaller_than_arc,
     "the tool does not fit into the arc: its radius is not smaller than that of the arc",
     "Use a smaller tool or a larger arc, or G141 with #TRC [CONV_CIR_TO_LIN=1]."},
    {Code::arc_radii_differ,
     "start and end radius of the arc differ, so that it has no equidistant (G164)",
     "Correct I, J, K or the end point, or let G165 correct the centre."},
    {Code::line_reversed,
     "the tool does not fit: its path beside this line runs backwards and would damage the "
     "contour",
     "Use a smaller tool: SurveyRadii (trc radii) says which one fits. G141 masks such blocks "
     "where it is not on yet, and with it #TRC [REMOVE_MASKED_BLOCKS=1] leaves out whole loops."},
    {Code::arc_wrapped,
     "the tool does not fit: its path beside this arc goes the wrong way round and would damage "
     "the contour",
     "Use a smaller tool: SurveyRadii (trc radii) says which one fits. G141 masks such blocks "
     "where it is not on yet, and with it #TRC [REMOVE_MASKED_BLOCKS=1] leaves out whole loops."},
    {Code::no_feed_adaptation_in_tangential_block,
     "the feed of the G05 block cannot be adapted (G11): the tool radius is too large",
     "Use a smaller tool, a wider approach, or G10."},
    {Code::selection_point_too_near,
     "the start point of the G238 selection is nearer to the contour than the tool radius",
     "Start farther away from the contour."},
    {Code::radius_change_under_inside_corner,
     "the tool radius changes although TRC was selected with G238",
     "Deselect TRC with G40 before the change."},
    {Code::inside_corner_angle_too_large,
     "the angle between the G238 approach block and the first contour block is too large",
     "Start on the other side, or select with G138 or G139."},
    {Code::center_out_of_range, "the centre of a circle lies outside the coordinate range",
     "Look for a wrong unit or a missing decimal point."},
    {Code::end_point_out_of_range, "an end point lies outside the coordinate range",
     "Look for a wrong unit, a missing decimal point or two lines under a very small angle."},
    {Code::spatial_circle_after_deselection, "G303 follows G40 without a motion in the plane",
     "Program a straight motion in the plane between G40 and G303."},
    {Code::nc_syntax, "the text is no NC word", "Correct the word at the place given."},
    {Code::nc_unknown_function, "the G function is not known",
     "Remove it; GetServerInfo lists the functions that are."},
    {Code::nc_unsupported, "the word changes the path in a way that is not followed here",
     "Resolve it before compensation: expand variables, loops, subprograms and coordinate "
     "changes into plain motion blocks."},
    {Code::trc_option_unknown, "the #TRC keyword is not known",
     "Correct its spelling; GetServerInfo lists all keywords."},
    {Code::trc_option_out_of_range, "the value of a #TRC keyword is missing or out of range",
     "Program a value of the range given; GetServerInfo lists all ranges."},
    {Code::nc_line_too_long, "a line is longer than the limit",
     "Check that this is an NC program with line ends, or raise the limit."},
    {Code::nc_not_text,
     "a character belongs in no NC program: a control character, no UTF-8, or no ASCII outside "
     "of comments",
     "Take it out, and save the program as plain text in UTF-8; ASCII is UTF-8 too."},
    {Code::nc_number, "a number is missing, malformed or out of range",
     "Write a decimal number after the address letter; where a range is named, one within it."},
    {Code::nc_unclosed, "something is opened but not closed",
     "Close the bracket or the comment, or complete the continued line."},
    {Code::nc_word_twice, "one block programs an address twice", "Keep one of the two words."},
    {Code::nc_axis_unknown, "the axis is not among those of the setup",
     "Correct the name, or add the axis to the tracking axes of the setup."},
    {Code::nc_group_twice, "one block programs two functions that exclude each other",
     "Keep one of them."},
    {Code::tool_unknown, "the tool table has no such tool",
     "Add the tool to the table of the setup: its number, its name and edge where the program "
     "says them, and its radius."},
    {Code::program_empty, "the program has no block",
     "Check that the file is the one meant and is complete."},
    {Code::side_behind_end, "G41 or G42 after the end of the program (M02, M30, a second %)",
     "Remove what follows the end, or compensate it as a program of its own."},
    {Code::other_dialect, "the word means something else in the dialect the program looks like",
     "Declare the dialect of the program (--dialect, `dialect` in the setup). If it is ISG, "
     "remove the word."},
    {Code::block_skip_undecided, "the path hangs on the switch for block skip",
     "Say how it stands: `block_skip` EXECUTE in the setup where lines with `/` are executed, "
     "LEAVE_OUT where they are not."},
    {Code::turning, "this is a program of a lathe: turning is not compensated here",
     "Let the lathe compensate the nose of its tool."},
    {Code::motion_unknown,
     "a contour moves though the program has not said whether at the feed or at rapid",
     "Program G01 (or G00) before the contour, or in its first block."},
    {Code::circle_incomplete, "a circular block has neither centre nor radius",
     "Program I, J, K or R in the block itself, or G01 if it is meant to be straight."},
    {Code::not_available, "the function is not available here", "Remove it, or use another one."},
    {Code::deselection_without_motion,
     "G41 or G42 follows G40 although no motion in the plane has left the contour",
     "Program a retract motion after G40, or use G237 or G239."},
    {Code::tool_radius_out_of_range, "the tool radius is out of range",
     "Check the unit: the radius is in mm, under G70 in inch."},
    {Code::field_invalid, "a value is not a number or out of range",
     "Correct the word or the field named."},
    {Code::position_unknown, "the motion starts from a position that is not known",
     "Program all axes of the plane absolutely (G90, G00 or G01) after the change, before G91, "
     "circles or G41."},
    {Code::selection_block_too_short,
     "the selection or deselection block is shorter than its mode needs",
     "Lengthen the block or use a smaller tool."},
    {Code::tangential_start_on_tangent,
     "no circle leads from the start point tangentially to the contour (G05)",
     "Start off the tangent of the first contour block."},
    {Code::circular_deselection_block, "TRC is deselected in a circular block",
     "Let the first motion after G40 be a straight line, or use G236 or G237."},
    {Code::selection_without_contour,
     "TRC is selected and deselected without a contour in between; nothing is compensated",
     "Remove the selection, or program the contour before G40."},
    {Code::ended_while_active,
     "the program ends before the tool has left the contour; the path ends at the last "
     "compensated point",
     "Program G40 and a motion in the plane before the end."},
    {Code::circular_side_change_block, "the side of TRC changes in a circular block",
     "Let the block that changes between G41 and G42 be a straight line."},
    {Code::side_change_without_contour,
     "the side of TRC changes where no contour block lies on one of the two sides",
     "Program at least one contour block between G41, G42 and G40."},
    {Code::contour_not_closed, "a contour selected with G238 does not end where it began",
     "Close the contour, or select with G138 or G139."},
    {Code::last_block_full_circle,
     "the last block of a contour selected with G238 is a full circle",
     "Divide the circle, or select with another mode."},
    {Code::approach_crosses_contour, "the selection block of G238 crosses a contour block",
     "Start from the side of the contour the tool runs on."},
    {Code::side_change_under_inside_corner,
     "the side of TRC changes inside a contour selected with G238",
     "Deselect with G40 before the other side is selected."},
    {Code::selection_too_long, "one selection holds more blocks than may be kept back",
     "Divide the contour, or raise the limit of blocks in one selection."},
    {Code::blocks_masked, "contour blocks the tool cannot reach are masked",
     "Use a smaller tool to machine them."},
    {Code::bottleneck, "the tool comes closer to another block of the contour than its radius",
     "Use a smaller tool, or correct the contour."},
    {Code::beyond_window,
     "the contour is longer than the window of contour masking, which sees no loop longer than "
     "itself",
     "Raise look_ahead_blocks, or set it to 0 for the whole contour."},
    {Code::clearance_violated,
     "measured anew, the compensated path comes nearer to the contour than the tool radius",
     "Do not machine it. Use a smaller tool or correct the contour, or let G141 with "
     "REMOVE_MASKED_BLOCKS take the loops out. Several contours need G40 between them."},
    {Code::side_changed_at_corner,
     "the side changes where the motion does not reverse (REVERSE): the tool crosses the corner "
     "nearer than its radius",
     "Let the motion reverse exactly there, or deselect with G40 before the other side."},
    {Code::most_left_out, "more of the contour than allowed would be left out",
     "Use a smaller tool: SurveyRadii (trc radii) says which one fits. If a block that bounds no "
     "material is in the way, mark it as a lead, or make leads larger than the tool. Where the "
     "stretch may be left out, raise max_masked_share."},
    {Code::no_tool_radius, "TRC is selected although no tool radius has been given",
     "Program a D word or T word whose radius the tool table of the setup holds, or give "
     "tool_radius in the setup."},
    {Code::tool_radius_zero, "the tool radius is given as 0: nothing is compensated",
     "Check that the radius is meant to be 0."},
    {Code::center_corrected,
     "the circle centre does not fit start and end point and is shifted (G165)",
     "Correct I, J, K or the end point; the arc runs about the shifted centre."},
    {Code::wear_too_large, "the wear of the tool is larger than max_wear allows",
     "Is this the whole radius? With nominal_radius the tool radius is only the difference from "
     "that one: give that, or raise max_wear."},
    {Code::wear_not_deeper,
     "the tool is smaller than the nominal one, but the shifted centre path does not take it "
     "deeper into this inside corner",
     "Where the corner has to be sharper, compensate the contour itself by the whole radius."},
    {Code::tool_radius_contradicts,
     "the program gives a tool another radius than the setup does, and that of the program counts",
     "Check which tool is in the machine, and correct the table of tools or the program."},
    {Code::tool_may_have_changed,
     "the tool may have been changed since its radius was said, which stays in force",
     "Program the T or D word of the tool after it, with its radius in the tool table, or "
     "compensate the parts of the program one by one. What changes no tool is declared in "
     "pass_words."},
    {Code::call_taken_as_harmless,
     "the text of a called subprogram is not given: plane, unit, G25 or G26, G140 or G141 and "
     "#TRC are taken to be the same after it as before it",
     "Give its text in `subprograms`, or program after the call what has to hold. A name that "
     "changes nothing is declared in pass_words."},
    {Code::machine_compensates,
     "the machine compensates this cycle itself, with its own D register",
     "Leave the radius in that register, as the cycle would be cut too large without it, or "
     "program its centre path with D0."},
    {Code::given_value_kept,
     "a variable that the control keeps is set to a number that was computed from values given "
     "for the machine",
     "The result holds for these values only. Raise a counter in one assignment from itself, "
     "which then stays as it is, or compensate anew for each value."},
    {Code::way_crosses_contour, "the approach or the retract leads through the contour",
     "Start from the side of the contour the tool runs on, leave to that side, or lift the tool "
     "before it crosses."},
    {Code::line_beyond_control,
     "the control does not take a line as long as this one would be in the result, or a number "
     "of so many digits",
     "Divide the words of the line, or shorten its comment; where it is a number, write fewer "
     "decimals (decimals)."},
    {Code::selection_stands_still,
     "the motion that selects TRC does not move, so that the next one is the approach",
     "Start beside the contour and lead in with a motion of its own, else the tool cuts into the "
     "first wall; or take the words that do not move out."},
    {Code::too_many_lines_executed, "more lines are executed than allowed",
     "Look for a loop that never ends. A program that is meant to be so long needs a larger "
     "max_executed_lines."},
    {Code::calls_too_deep, "subprograms call one another too deeply",
     "Look for a subprogram that calls itself. No control allows more than a few levels."},
    {Code::variable_unset, "a variable is read that has no value",
     "Set it in the program, or give its value in `variables` of the setup."},
    {Code::division_by_zero, "a number is divided by zero",
     "Check the values of the variables in the divisor."},
    {Code::jump_target_unknown,
     "the target of a jump is not there, or not the only one that may be meant",
     "Correct the number or the label. It must stand in the same program; of a program longer "
     "than 64 KiB, jumps reach back only to the first line that computes."},
    {Code::subprogram_unknown, "a subprogram is called that is not there",
     "Put it into the same text, where the dialect has it (ISG: before the program, after %L "
     "NAME), or give its text in `subprograms` of the setup."},
    {Code::machine_state, "the program asks for, or changes, a state that only the machine knows",
     "Where its value is known, give it in `variables` of the setup; else take the line out."},
    {Code::expression_invalid,
     "an expression or a statement is not written as the control reads it",
     "Compare it with the manual of the control: brackets [ ] in pairs, one comparison in each "
     "pair."},
    {Code::value_invalid, "a computed value is not possible there",
     "Check the values of the variables: a function takes only so much, and a number or an index "
     "is whole and not negative."},
    {Code::block_structure,
     "the beginning or the end of a loop, a branch or a subprogram is missing",
     "Write both, with the same number or name; end a subprogram with its return."},
    {Code::computing_text_too_long, "the text of a program that computes is too long to be held",
     "Divide the program, or let the part that does not compute be a program of its own."},
    {Code::program_alarm, "the program itself raises an alarm",
     "Its text says what the program asks for; look at the lines before it."},
});

static_assert(std::ranges::is_sorted(rows, {}, &EnglishRow::code));

}  // namespace

std::span<const EnglishRow> english_rows() { return rows; }

const EnglishRow& english_row_of(Code code) {
  const auto* const found = std::ranges::lower_bound(rows, code, {}, &EnglishRow::code);
  if (found != rows.end() && found->code == code) return *found;
  // An unknown code, as in row_of().
  static constexpr EnglishRow unknown{.code = Code{},
                                      .cause = "a fault with a code that is not in the table",
                                      .remedy = "Update this program."};
  return unknown;
}

}  // namespace trc
