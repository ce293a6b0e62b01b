#include "core/base/diagnostic.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/utf8.h"

namespace trc {
namespace {

using enum Severity;

// The published IDs keep the severity the reference control gives them.
constexpr auto rows = std::to_array<CodeRow>({
    {Code::full_circle_with_radius_word, error, "FULL_CIRCLE_WITH_RADIUS_WORD",
     "a full circle cannot be given by its radius alone",
     "Program the centre with I, J, K instead of R."},
    {Code::circle_center_misfit, error, "CIRCLE_CENTER_MISFIT",
     "the circle centre does not fit the start and end point of the arc",
     "Correct I, J, K or the end point."},
    {Code::circle_radius_zero, error, "CIRCLE_RADIUS_ZERO", "the radius of the circle is zero",
     "Program a centre (I, J, K) away from the start point, or a radius other than 0."},
    {Code::radius_and_tool_word_together, error, "RADIUS_AND_TOOL_WORD_TOGETHER",
     "a D word and a value for the tool radius stand in one block",
     "Write the tool radius in a block of its own after the D word."},
    {Code::transition_type_twice, error, "TRANSITION_TYPE_TWICE",
     "one block programs more than one transition type (G25, G26)", "Keep one of them."},
    {Code::compensation_side_twice, error, "COMPENSATION_SIDE_TWICE",
     "one block programs more than one of G40, G41, G42", "Keep one of them."},
    {Code::selection_mode_twice, error, "SELECTION_MODE_TWICE",
     "one block programs more than one selection mode (G138, G139, G236 to G239)",
     "Keep one of them. Only G05 may stand beside another mode."},
    {Code::plane_change_while_active, error, "PLANE_CHANGE_WHILE_ACTIVE",
     "the plane changes while TRC is active",
     "Deselect TRC with G40 and a motion in the plane before G17, G18 or G19."},
    {Code::axis_link_while_active, error, "AXIS_LINK_WHILE_ACTIVE",
     "an axis link changes while TRC is active", "Deselect TRC with G40 before the command."},
    {Code::preset_while_active, error, "PRESET_WHILE_ACTIVE",
     "#PSET or #PRESET is programmed while TRC is active",
     "Deselect TRC with G40 before the command."},
    {Code::coordinate_system_while_active, error, "COORDINATE_SYSTEM_WHILE_ACTIVE",
     "the coordinate system changes while TRC is active",
     "Deselect TRC with G40 before the command."},
    {Code::negative_tangfeed_minimum, error, "NEGATIVE_TANGFEED_MINIMUM",
     "the smallest contour radius of #TANGFEED is negative", "Program RMIN as 0 or positive."},
    {Code::center_and_radius_together, error, "CENTER_AND_RADIUS_TOGETHER",
     "one block gives a circle both a centre and a radius", "Keep either I, J, K or R."},
    {Code::tangential_ignored_with_inside_corner, warning, "TANGENTIAL_IGNORED_WITH_INSIDE_CORNER",
     "G05 has no effect under G238 and is ignored", "Remove G05, or choose another mode."},
    {Code::inside_corner_selected_while_active, error, "INSIDE_CORNER_SELECTED_WHILE_ACTIVE",
     "G238 is programmed while TRC is active in another mode",
     "Deselect TRC with G40 before G238."},
    {Code::mode_change_under_inside_corner, error, "MODE_CHANGE_UNDER_INSIDE_CORNER",
     "the selection mode changes although TRC was selected with G238",
     "Deselect TRC with G40 before the change."},
    {Code::point_to_point_while_active, error, "POINT_TO_POINT_WHILE_ACTIVE",
     "#PTP is programmed while TRC is active", "Deselect TRC with G40 before the command."},
    {Code::circle_radii_differ, error, "CIRCLE_RADII_DIFFER",
     "start and end of the arc are not equally far from its centre (G164)",
     "Correct I, J, K or the end point, or let G165 correct the centre."},
    {Code::stretch_factor_out_of_range, warning, "STRETCH_FACTOR_OUT_OF_RANGE",
     "STRETCH_FACTOR is outside 1 to 9 and is set to 1", "Program a value from 1 to 9."},
    {Code::spatial_circle_while_active, error, "SPATIAL_CIRCLE_WHILE_ACTIVE",
     "G303 is programmed while TRC is active",
     "Deselect TRC with G40 and a straight motion in the plane before G303."},
    {Code::inverse_without_online, error, "INVERSE_WITHOUT_ONLINE", "INVERSE is set without ONLINE",
     "Remove INVERSE; ask for the inverse path in the setup."},
    {Code::real_time_loop_while_active, error, "REAL_TIME_LOOP_WHILE_ACTIVE",
     "#RT WHILE is programmed while TRC is active", "Deselect TRC with G40 before the command."},
    {Code::circular_selection_block, error, "CIRCULAR_SELECTION_BLOCK",
     "TRC is selected in a circular block",
     "Let the first motion after G41 or G42 be a straight line, or select with G236 or G237."},
    {Code::too_many_passive_blocks, error, "TOO_MANY_PASSIVE_BLOCKS",
     "too many blocks without motion in the plane follow one another while TRC is active",
     "Move them before G41 or after G40, or raise the limit."},
    {Code::tool_not_smaller_than_arc, error, "TOOL_NOT_SMALLER_THAN_ARC",
     "the tool does not fit into the arc: its radius is not smaller than that of the arc",
     "Use a smaller tool or a larger arc, or G141 with #TRC [CONV_CIR_TO_LIN=1]."},
    {Code::arc_radii_differ, error, "ARC_RADII_DIFFER",
     "start and end radius of the arc differ, so that it has no equidistant (G164)",
     "Correct I, J, K or the end point, or let G165 correct the centre."},
    {Code::line_reversed, error, "LINE_REVERSED",
     "the tool does not fit: its path beside this line runs backwards and would damage the contour",
     "Use a smaller tool: SurveyRadii (trc radii) says which one fits. G141 masks such blocks "
     "where it is not on yet, and with it #TRC [REMOVE_MASKED_BLOCKS=1] leaves out whole loops."},
    {Code::arc_wrapped, error, "ARC_WRAPPED",
     "the tool does not fit: its path beside this arc goes the wrong way round and would damage "
     "the "
     "contour",
     "Use a smaller tool: SurveyRadii (trc radii) says which one fits. G141 masks such blocks "
     "where it is not on yet, and with it #TRC [REMOVE_MASKED_BLOCKS=1] leaves out whole loops."},
    {Code::no_feed_adaptation_in_tangential_block, warning,
     "NO_FEED_ADAPTATION_IN_TANGENTIAL_BLOCK",
     "the feed of the G05 block cannot be adapted (G11): the tool radius is too large",
     "Use a smaller tool, a wider approach, or G10."},
    {Code::selection_point_too_near, error, "SELECTION_POINT_TOO_NEAR",
     "the start point of the G238 selection is nearer to the contour than the tool radius",
     "Start farther away from the contour."},
    {Code::radius_change_under_inside_corner, error, "RADIUS_CHANGE_UNDER_INSIDE_CORNER",
     "the tool radius changes although TRC was selected with G238",
     "Deselect TRC with G40 before the change."},
    {Code::inside_corner_angle_too_large, error, "INSIDE_CORNER_ANGLE_TOO_LARGE",
     "the angle between the G238 approach block and the first contour block is too large",
     "Start on the other side, or select with G138 or G139."},
    {Code::center_out_of_range, error, "CENTER_OUT_OF_RANGE",
     "the centre of a circle lies outside the coordinate range",
     "Look for a wrong unit or a missing decimal point."},
    {Code::end_point_out_of_range, error, "END_POINT_OUT_OF_RANGE",
     "an end point lies outside the coordinate range",
     "Look for a wrong unit, a missing decimal point or two lines under a very small angle."},
    {Code::spatial_circle_after_deselection, error, "SPATIAL_CIRCLE_AFTER_DESELECTION",
     "G303 follows G40 without a motion in the plane",
     "Program a straight motion in the plane between G40 and G303."},

    {Code::nc_syntax, error, "NC_SYNTAX", "the text is no NC word",
     "Correct the word at the place given."},
    {Code::nc_unknown_function, error, "NC_UNKNOWN_FUNCTION", "the G function is not known",
     "Remove it; GetServerInfo lists the functions that are."},
    {Code::nc_unsupported, error, "NC_UNSUPPORTED",
     "the word changes the path in a way that is not followed here",
     "Resolve it before compensation: expand variables, loops, subprograms and coordinate "
     "changes into plain motion blocks."},
    {Code::trc_option_unknown, error, "TRC_OPTION_UNKNOWN", "the #TRC keyword is not known",
     "Correct its spelling; GetServerInfo lists all keywords."},
    {Code::trc_option_out_of_range, error, "TRC_OPTION_OUT_OF_RANGE",
     "the value of a #TRC keyword is missing or out of range",
     "Program a value of the range given; GetServerInfo lists all ranges."},
    {Code::nc_line_too_long, error, "NC_LINE_TOO_LONG", "a line is longer than the limit",
     "Check that this is an NC program with line ends, or raise the limit."},
    {Code::nc_not_text, error, "NC_NOT_TEXT",
     "a character belongs in no NC program: a control character, no UTF-8, or no ASCII outside of "
     "comments",
     "Take it out, and save the program as plain text in UTF-8; ASCII is UTF-8 too."},
    {Code::nc_number, error, "NC_NUMBER", "a number is missing, malformed or out of range",
     "Write a decimal number after the address letter; where a range is named, one within it."},
    {Code::nc_unclosed, error, "NC_UNCLOSED", "something is opened but not closed",
     "Close the bracket or the comment, or complete the continued line."},
    {Code::nc_word_twice, error, "NC_WORD_TWICE", "one block programs an address twice",
     "Keep one of the two words."},
    {Code::nc_axis_unknown, error, "NC_AXIS_UNKNOWN", "the axis is not among those of the setup",
     "Correct the name, or add the axis to the tracking axes of the setup."},
    {Code::nc_group_twice, error, "NC_GROUP_TWICE",
     "one block programs two functions that exclude each other", "Keep one of them."},
    {Code::tool_unknown, error, "TOOL_UNKNOWN", "the tool table has no such tool",
     "Add the tool to the table of the setup: its number, its name and edge where the program "
     "says them, and its radius."},
    {Code::program_empty, error, "PROGRAM_EMPTY", "the program has no block",
     "Check that the file is the one meant and is complete."},
    {Code::side_behind_end, error, "SIDE_BEHIND_END",
     "G41 or G42 after the end of the program (M02, M30)",
     "Remove what follows the end, or compensate it as a program of its own."},
    {Code::other_dialect, error, "OTHER_DIALECT",
     "the word means something else in the dialect the program looks like",
     "Declare the dialect of the program (--dialect, `dialect` in the setup). If it is ISG, remove "
     "the word."},
    {Code::block_skip_undecided, error, "BLOCK_SKIP_UNDECIDED",
     "the path hangs on the switch for block skip",
     "Say how it stands: `block_skip` EXECUTE in the setup where lines with `/` are executed, "
     "LEAVE_OUT where they are not."},
    {Code::turning, error, "TURNING",
     "this is a program of a lathe: turning is not compensated here",
     "Let the lathe compensate the nose of its tool."},
    {Code::motion_unknown, error, "MOTION_UNKNOWN",
     "a contour moves though the program has not said whether at the feed or at rapid",
     "Program G01 (or G00) before the contour, or in its first block."},

    {Code::circle_incomplete, error, "CIRCLE_INCOMPLETE",
     "a circular block has neither centre nor radius",
     "Program I, J, K or R in the block itself, or G01 if it is meant to be straight."},
    {Code::not_available, error, "NOT_AVAILABLE", "the function is not available here",
     "Remove it, or use another one."},
    {Code::deselection_without_motion, error, "DESELECTION_WITHOUT_MOTION",
     "G41 or G42 follows G40 although no motion in the plane has left the contour",
     "Program a retract motion after G40, or use G237 or G239."},
    {Code::tool_radius_out_of_range, error, "TOOL_RADIUS_OUT_OF_RANGE",
     "the tool radius is out of range", "Check the unit: the radius is in mm, under G70 in inch."},
    {Code::field_invalid, error, "FIELD_INVALID", "a value is not a number or out of range",
     "Correct the word or the field named."},
    {Code::position_unknown, error, "POSITION_UNKNOWN",
     "the motion starts from a position that is not known",
     "Program all axes of the plane absolutely (G90, G00 or G01) after the change, before G91, "
     "circles or G41."},

    {Code::selection_block_too_short, error, "SELECTION_BLOCK_TOO_SHORT",
     "the selection or deselection block is shorter than its mode needs",
     "Lengthen the block or use a smaller tool."},
    {Code::tangential_start_on_tangent, error, "TANGENTIAL_START_ON_TANGENT",
     "no circle leads from the start point tangentially to the contour (G05)",
     "Start off the tangent of the first contour block."},
    {Code::circular_deselection_block, error, "CIRCULAR_DESELECTION_BLOCK",
     "TRC is deselected in a circular block",
     "Let the first motion after G40 be a straight line, or use G236 or G237."},
    {Code::selection_without_contour, warning, "SELECTION_WITHOUT_CONTOUR",
     "TRC is selected and deselected without a contour in between; nothing is compensated",
     "Remove the selection, or program the contour before G40."},
    {Code::ended_while_active, warning, "ENDED_WHILE_ACTIVE",
     "the program ends before the tool has left the contour; the path ends at the last "
     "compensated point",
     "Program G40 and a motion in the plane before the end."},
    {Code::circular_side_change_block, error, "CIRCULAR_SIDE_CHANGE_BLOCK",
     "the side of TRC changes in a circular block",
     "Let the block that changes between G41 and G42 be a straight line."},
    {Code::side_change_without_contour, error, "SIDE_CHANGE_WITHOUT_CONTOUR",
     "the side of TRC changes where no contour block lies on one of the two sides",
     "Program at least one contour block between G41, G42 and G40."},
    {Code::contour_not_closed, error, "CONTOUR_NOT_CLOSED",
     "a contour selected with G238 does not end where it began",
     "Close the contour, or select with G138 or G139."},
    {Code::last_block_full_circle, error, "LAST_BLOCK_FULL_CIRCLE",
     "the last block of a contour selected with G238 is a full circle",
     "Divide the circle, or select with another mode."},
    {Code::approach_crosses_contour, error, "APPROACH_CROSSES_CONTOUR",
     "the selection block of G238 crosses a contour block",
     "Start from the side of the contour the tool runs on."},
    {Code::side_change_under_inside_corner, error, "SIDE_CHANGE_UNDER_INSIDE_CORNER",
     "the side of TRC changes inside a contour selected with G238",
     "Deselect with G40 before the other side is selected."},
    {Code::selection_too_long, error, "SELECTION_TOO_LONG",
     "one selection holds more blocks than may be kept back",
     "Divide the contour, or raise the limit of blocks in one selection."},
    {Code::blocks_masked, note, "BLOCKS_MASKED", "contour blocks the tool cannot reach are masked",
     "Use a smaller tool to machine them."},
    {Code::bottleneck, error, "BOTTLENECK",
     "the tool comes closer to another block of the contour than its radius",
     "Use a smaller tool, or correct the contour."},
    {Code::beyond_window, warning, "BEYOND_WINDOW",
     "the contour is longer than the window of contour masking, which sees no loop longer than "
     "itself",
     "Raise look_ahead_blocks, or set it to 0 for the whole contour."},
    {Code::clearance_violated, error, "CLEARANCE_VIOLATED",
     "measured anew, the compensated path comes nearer to the contour than the tool radius",
     "Do not machine it. Use a smaller tool or correct the contour, or let G141 with "
     "REMOVE_MASKED_BLOCKS take the loops out. Several contours need G40 between them."},
    {Code::side_changed_at_corner, warning, "SIDE_CHANGED_AT_CORNER",
     "the side changes where the motion does not reverse (REVERSE): the tool crosses the corner "
     "nearer than its radius",
     "Let the motion reverse exactly there, or deselect with G40 before the other side."},
    {Code::most_left_out, error, "MOST_LEFT_OUT",
     "more of the contour than allowed would be left out",
     "Use a smaller tool: SurveyRadii (trc radii) says which one fits. If a block that bounds no "
     "material is in the way, mark it as a lead, or make leads larger than the tool. Where the "
     "stretch may be left out, raise max_masked_share."},
    {Code::no_tool_radius, error, "NO_TOOL_RADIUS",
     "TRC is selected although no tool radius has been given",
     "Program a D word or T word whose radius the tool table of the setup holds, or give "
     "tool_radius in the setup."},
    {Code::tool_radius_zero, warning, "TOOL_RADIUS_ZERO",
     "the tool radius is given as 0: nothing is compensated",
     "Check that the radius is meant to be 0."},
    {Code::center_corrected, warning, "CENTER_CORRECTED",
     "the circle centre does not fit start and end point and is shifted (G165)",
     "Correct I, J, K or the end point; the arc runs about the shifted centre."},
    {Code::wear_too_large, error, "WEAR_TOO_LARGE",
     "the wear of the tool is larger than max_wear allows",
     "Is this the whole radius? With nominal_radius the tool radius is only the difference from "
     "that one: give that, or raise max_wear."},
    {Code::wear_not_deeper, note, "WEAR_NOT_DEEPER",
     "the tool is smaller than the nominal one, but the shifted centre path does not take it "
     "deeper "
     "into this inside corner",
     "Where the corner has to be sharper, compensate the contour itself by the whole radius."},
    {Code::tool_radius_contradicts, warning, "TOOL_RADIUS_CONTRADICTS",
     "the program gives a tool another radius than the setup does, and that of the program counts",
     "Check which tool is in the machine, and correct the table of tools or the "
     "program."},
    {Code::tool_may_have_changed, warning, "TOOL_MAY_HAVE_CHANGED",
     "the tool may have been changed since its radius was said, which stays in force",
     "Program the T or D word of the tool after it, with its radius in the tool table, or "
     "compensate the parts of the program one by one. What changes no tool is declared in "
     "pass_words."},
    {Code::call_taken_as_harmless, note, "CALL_TAKEN_AS_HARMLESS",
     "the text of a called subprogram is not given: plane, unit, G25 or G26, G140 or G141 and #TRC "
     "are taken to be the same after it as before it",
     "Give its text in `subprograms`, or program after the call what has to hold. A name that "
     "changes nothing is declared in pass_words."},
    {Code::machine_compensates, warning, "MACHINE_COMPENSATES",
     "the machine compensates this cycle itself, with its own D register",
     "Leave the radius in that register, as the cycle would be cut too large without it, or "
     "program its centre path with D0."},
    {Code::given_value_kept, warning, "GIVEN_VALUE_KEPT",
     "a variable that the control keeps is set to a number that was computed from values given "
     "for the machine",
     "The result holds for these values only. Raise a counter in one assignment from itself, which "
     "then stays as it is, or compensate anew for each value."},
    {Code::way_crosses_contour, error, "WAY_CROSSES_CONTOUR",
     "the approach or the retract leads through the contour",
     "Start from the side of the contour the tool runs on, leave to that side, or lift the tool "
     "before it crosses."},
    {Code::line_beyond_control, error, "LINE_BEYOND_CONTROL",
     "the control does not take a line as long as this one would be in the result, or a number of "
     "so many digits",
     "Divide the words of the line, or shorten its comment; where it is a number, write fewer "
     "decimals (decimals)."},
    {Code::selection_stands_still, warning, "SELECTION_STANDS_STILL",
     "the motion that selects TRC does not move, so that the next one is the approach",
     "Start beside the contour and lead in with a motion of its own, else the tool cuts into the "
     "first wall; or take the words that do not move out."},
    {Code::too_many_lines_executed, error, "TOO_MANY_LINES_EXECUTED",
     "more lines are executed than allowed",
     "Look for a loop that never ends. A program that is meant to be so long needs a larger "
     "max_executed_lines."},
    {Code::calls_too_deep, error, "CALLS_TOO_DEEP", "subprograms call one another too deeply",
     "Look for a subprogram that calls itself. No control allows more than a few levels."},
    {Code::variable_unset, error, "VARIABLE_UNSET", "a variable is read that has no value",
     "Set it in the program, or give its value in `variables` of the setup."},
    {Code::division_by_zero, error, "DIVISION_BY_ZERO", "a number is divided by zero",
     "Check the values of the variables in the divisor."},
    {Code::jump_target_unknown, error, "JUMP_TARGET_UNKNOWN",
     "the target of a jump is not there, or not the only one that may be meant",
     "Correct the number or the label. It must stand in the same program; of a program longer "
     "than 64 KiB, jumps reach back only to the first line that computes."},
    {Code::subprogram_unknown, error, "SUBPROGRAM_UNKNOWN",
     "a subprogram is called that is not there",
     "Put it into the same text, where the dialect has it (ISG: before the program, after "
     "%L NAME), or give its text in `subprograms` of the setup."},
    {Code::machine_state, error, "MACHINE_STATE",
     "the program asks for, or changes, a state that only the machine knows",
     "Where its value is known, give it in `variables` of the setup; else take the line out."},
    {Code::expression_invalid, error, "EXPRESSION_INVALID",
     "an expression or a statement is not written as the control reads it",
     "Compare it with the manual of the control: brackets [ ] in pairs, one comparison in each "
     "pair."},
    {Code::value_invalid, error, "VALUE_INVALID", "a computed value is not possible there",
     "Check the values of the variables: a function takes only so much, and a number or an index "
     "is whole and not negative."},
    {Code::block_structure, error, "BLOCK_STRUCTURE",
     "the beginning or the end of a loop, a branch or a subprogram is missing",
     "Write both, with the same number or name; end a subprogram with its return."},
    {Code::computing_text_too_long, error, "COMPUTING_TEXT_TOO_LONG",
     "the text of a program that computes is too long to be held",
     "Divide the program, or let the part that does not compute be a program of its own."},
    {Code::program_alarm, error, "PROGRAM_ALARM", "the program itself raises an alarm",
     "Its text says what the program asks for; look at the lines before it."},
});

static_assert(std::ranges::is_sorted(rows, {}, &CodeRow::code));

}  // namespace

std::span<const CodeRow> code_table() { return rows; }

const CodeRow& row_of(Code code) {
  const auto found = std::ranges::lower_bound(rows, code, {}, &CodeRow::code);
  if (found != rows.end() && found->code == code) return *found;
  // A code from a newer peer is shown as unknown, never as another fault.
  static constexpr CodeRow unknown{.code = Code{},
                                   .severity = error,
                                   .reason = "UNKNOWN",
                                   .cause = "a fault with a code that is not in the table",
                                   .remedy = "Update this program."};
  return unknown;
}

Diagnostic diagnostic(Code code, const Source& source, std::string detail) {
  return {.code = code,
          .severity = row_of(code).severity,
          .source = source,
          .detail = is_utf8(detail) ? std::move(detail) : as_utf8(detail)};
}

void append_place(std::vector<DiagnosticValue>& values, const std::string& name,
                  const Source& source) {
  values.push_back({name + "_index", static_cast<double>(source.index)});
  if (source.line > 0) values.push_back({name + "_line", static_cast<double>(source.line)});
  if (source.number != Source::no_number)
    values.push_back({name + "_number", static_cast<double>(source.number)});
}

RelatedPlace take_place(std::span<const DiagnosticValue>& values) {
  const std::string_view index = values.front().name;
  const std::string name(index.substr(0, index.rfind('_')));
  RelatedPlace place{.name = name,
                     .source = {.index = static_cast<std::uint64_t>(values.front().value)}};
  values = values.subspan(1);
  if (!values.empty() && values.front().name == name + "_line") {
    place.source.line = static_cast<std::uint32_t>(values.front().value);
    values = values.subspan(1);
  }
  if (!values.empty() && values.front().name == name + "_number") {
    place.source.number = static_cast<std::int64_t>(values.front().value);
    values = values.subspan(1);
  }
  return place;
}

std::vector<RelatedPlace> related_places(const Diagnostic& diagnostic) {
  std::vector<RelatedPlace> places;
  std::span<const DiagnosticValue> values(diagnostic.values);
  while (!values.empty()) {
    if (values.front().name.ends_with("_index"))
      places.push_back(take_place(values));
    else
      values = values.subspan(1);
  }
  return places;
}

}  // namespace trc
