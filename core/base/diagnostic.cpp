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
    {Code::full_circle_with_radius_word, error, "FULL_CIRCLE_WITH_RADIUS_WORD"},
    {Code::circle_center_misfit, error, "CIRCLE_CENTER_MISFIT"},
    {Code::circle_radius_zero, error, "CIRCLE_RADIUS_ZERO"},
    {Code::radius_and_tool_word_together, error, "RADIUS_AND_TOOL_WORD_TOGETHER"},
    {Code::transition_type_twice, error, "TRANSITION_TYPE_TWICE"},
    {Code::compensation_side_twice, error, "COMPENSATION_SIDE_TWICE"},
    {Code::selection_mode_twice, error, "SELECTION_MODE_TWICE"},
    {Code::plane_change_while_active, error, "PLANE_CHANGE_WHILE_ACTIVE"},
    {Code::axis_link_while_active, error, "AXIS_LINK_WHILE_ACTIVE"},
    {Code::preset_while_active, error, "PRESET_WHILE_ACTIVE"},
    {Code::coordinate_system_while_active, error, "COORDINATE_SYSTEM_WHILE_ACTIVE"},
    {Code::negative_tangfeed_minimum, error, "NEGATIVE_TANGFEED_MINIMUM"},
    {Code::center_and_radius_together, error, "CENTER_AND_RADIUS_TOGETHER"},
    {Code::tangential_ignored_with_inside_corner, warning, "TANGENTIAL_IGNORED_WITH_INSIDE_CORNER"},
    {Code::inside_corner_selected_while_active, error, "INSIDE_CORNER_SELECTED_WHILE_ACTIVE"},
    {Code::mode_change_under_inside_corner, error, "MODE_CHANGE_UNDER_INSIDE_CORNER"},
    {Code::point_to_point_while_active, error, "POINT_TO_POINT_WHILE_ACTIVE"},
    {Code::circle_radii_differ, error, "CIRCLE_RADII_DIFFER"},
    {Code::stretch_factor_out_of_range, warning, "STRETCH_FACTOR_OUT_OF_RANGE"},
    {Code::spatial_circle_while_active, error, "SPATIAL_CIRCLE_WHILE_ACTIVE"},
    {Code::inverse_without_online, error, "INVERSE_WITHOUT_ONLINE"},
    {Code::real_time_loop_while_active, error, "REAL_TIME_LOOP_WHILE_ACTIVE"},
    {Code::circular_selection_block, error, "CIRCULAR_SELECTION_BLOCK"},
    {Code::too_many_passive_blocks, error, "TOO_MANY_PASSIVE_BLOCKS"},
    {Code::tool_not_smaller_than_arc, error, "TOOL_NOT_SMALLER_THAN_ARC"},
    {Code::arc_radii_differ, error, "ARC_RADII_DIFFER"},
    {Code::line_reversed, error, "LINE_REVERSED"},
    {Code::arc_wrapped, error, "ARC_WRAPPED"},
    {Code::no_feed_adaptation_in_tangential_block, warning,
     "NO_FEED_ADAPTATION_IN_TANGENTIAL_BLOCK"},
    {Code::selection_point_too_near, error, "SELECTION_POINT_TOO_NEAR"},
    {Code::radius_change_under_inside_corner, error, "RADIUS_CHANGE_UNDER_INSIDE_CORNER"},
    {Code::inside_corner_angle_too_large, error, "INSIDE_CORNER_ANGLE_TOO_LARGE"},
    {Code::center_out_of_range, error, "CENTER_OUT_OF_RANGE"},
    {Code::end_point_out_of_range, error, "END_POINT_OUT_OF_RANGE"},
    {Code::spatial_circle_after_deselection, error, "SPATIAL_CIRCLE_AFTER_DESELECTION"},

    {Code::nc_syntax, error, "NC_SYNTAX"},
    {Code::nc_unknown_function, error, "NC_UNKNOWN_FUNCTION"},
    {Code::nc_unsupported, error, "NC_UNSUPPORTED"},
    {Code::trc_option_unknown, error, "TRC_OPTION_UNKNOWN"},
    {Code::trc_option_out_of_range, error, "TRC_OPTION_OUT_OF_RANGE"},
    {Code::nc_line_too_long, error, "NC_LINE_TOO_LONG"},
    {Code::nc_not_text, error, "NC_NOT_TEXT"},
    {Code::nc_number, error, "NC_NUMBER"},
    {Code::nc_unclosed, error, "NC_UNCLOSED"},
    {Code::nc_word_twice, error, "NC_WORD_TWICE"},
    {Code::nc_axis_unknown, error, "NC_AXIS_UNKNOWN"},
    {Code::nc_group_twice, error, "NC_GROUP_TWICE"},
    {Code::tool_unknown, error, "TOOL_UNKNOWN"},
    {Code::program_empty, error, "PROGRAM_EMPTY"},
    {Code::side_behind_end, error, "SIDE_BEHIND_END"},
    {Code::other_dialect, error, "OTHER_DIALECT"},
    {Code::block_skip_undecided, error, "BLOCK_SKIP_UNDECIDED"},
    {Code::turning, error, "TURNING"},
    {Code::motion_unknown, error, "MOTION_UNKNOWN"},

    {Code::circle_incomplete, error, "CIRCLE_INCOMPLETE"},
    {Code::not_available, error, "NOT_AVAILABLE"},
    {Code::deselection_without_motion, error, "DESELECTION_WITHOUT_MOTION"},
    {Code::tool_radius_out_of_range, error, "TOOL_RADIUS_OUT_OF_RANGE"},
    {Code::field_invalid, error, "FIELD_INVALID"},
    {Code::position_unknown, error, "POSITION_UNKNOWN"},

    {Code::selection_block_too_short, error, "SELECTION_BLOCK_TOO_SHORT"},
    {Code::tangential_start_on_tangent, error, "TANGENTIAL_START_ON_TANGENT"},
    {Code::circular_deselection_block, error, "CIRCULAR_DESELECTION_BLOCK"},
    {Code::selection_without_contour, warning, "SELECTION_WITHOUT_CONTOUR"},
    {Code::ended_while_active, warning, "ENDED_WHILE_ACTIVE"},
    {Code::circular_side_change_block, error, "CIRCULAR_SIDE_CHANGE_BLOCK"},
    {Code::side_change_without_contour, error, "SIDE_CHANGE_WITHOUT_CONTOUR"},
    {Code::contour_not_closed, error, "CONTOUR_NOT_CLOSED"},
    {Code::last_block_full_circle, error, "LAST_BLOCK_FULL_CIRCLE"},
    {Code::approach_crosses_contour, error, "APPROACH_CROSSES_CONTOUR"},
    {Code::side_change_under_inside_corner, error, "SIDE_CHANGE_UNDER_INSIDE_CORNER"},
    {Code::selection_too_long, error, "SELECTION_TOO_LONG"},
    {Code::blocks_masked, note, "BLOCKS_MASKED"},
    {Code::bottleneck, error, "BOTTLENECK"},
    {Code::beyond_window, warning, "BEYOND_WINDOW"},
    {Code::clearance_violated, error, "CLEARANCE_VIOLATED"},
    {Code::side_changed_at_corner, warning, "SIDE_CHANGED_AT_CORNER"},
    {Code::most_left_out, error, "MOST_LEFT_OUT"},
    {Code::no_tool_radius, error, "NO_TOOL_RADIUS"},
    {Code::tool_radius_zero, warning, "TOOL_RADIUS_ZERO"},
    {Code::center_corrected, warning, "CENTER_CORRECTED"},
    {Code::wear_too_large, error, "WEAR_TOO_LARGE"},
    {Code::wear_not_deeper, note, "WEAR_NOT_DEEPER"},
    {Code::tool_radius_contradicts, warning, "TOOL_RADIUS_CONTRADICTS"},
    {Code::tool_may_have_changed, warning, "TOOL_MAY_HAVE_CHANGED"},
    {Code::call_taken_as_harmless, note, "CALL_TAKEN_AS_HARMLESS"},
    {Code::machine_compensates, warning, "MACHINE_COMPENSATES"},
    {Code::given_value_kept, warning, "GIVEN_VALUE_KEPT"},
    {Code::way_crosses_contour, error, "WAY_CROSSES_CONTOUR"},
    {Code::line_beyond_control, error, "LINE_BEYOND_CONTROL"},
    {Code::selection_stands_still, warning, "SELECTION_STANDS_STILL"},
    {Code::too_many_lines_executed, error, "TOO_MANY_LINES_EXECUTED"},
    {Code::calls_too_deep, error, "CALLS_TOO_DEEP"},
    {Code::variable_unset, error, "VARIABLE_UNSET"},
    {Code::division_by_zero, error, "DIVISION_BY_ZERO"},
    {Code::jump_target_unknown, error, "JUMP_TARGET_UNKNOWN"},
    {Code::subprogram_unknown, error, "SUBPROGRAM_UNKNOWN"},
    {Code::machine_state, error, "MACHINE_STATE"},
    {Code::expression_invalid, error, "EXPRESSION_INVALID"},
    {Code::value_invalid, error, "VALUE_INVALID"},
    {Code::block_structure, error, "BLOCK_STRUCTURE"},
    {Code::computing_text_too_long, error, "COMPUTING_TEXT_TOO_LONG"},
    {Code::program_alarm, error, "PROGRAM_ALARM"},
});

static_assert(std::ranges::is_sorted(rows, {}, &CodeRow::code));

}  // namespace

std::span<const CodeRow> code_table() { return rows; }

const CodeRow& row_of(Code code) {
  const auto found = std::ranges::lower_bound(rows, code, {}, &CodeRow::code);
  if (found != rows.end() && found->code == code) return *found;
  // A code from a newer peer is shown as unknown, never as another fault.
  static constexpr CodeRow unknown{.code = Code{}, .severity = error, .reason = "UNKNOWN"};
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
