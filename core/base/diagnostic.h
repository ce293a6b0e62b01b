#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/call_places.h"
#include "core/base/control_words.h"
#include "core/base/language.h"
#include "core/base/source.h"

namespace trc {

// note: something worth knowing happened (a block was masked).
// warning: the path goes on, but the operator should look at it.
// error: the stream stops; nothing comes out after it but errors that were found together with it.
enum class Severity { note, warning, error };

// Public, stable numbers. Where the reference control publishes an ID for the
// situation, that ID is used; our own start at 900000 (D-32).
enum class Code : std::int32_t {
  full_circle_with_radius_word = 20034,
  circle_center_misfit = 20035,
  circle_radius_zero = 20036,
  radius_and_tool_word_together = 20083,
  transition_type_twice = 20113,
  compensation_side_twice = 20114,
  selection_mode_twice = 20126,
  plane_change_while_active = 20133,
  axis_link_while_active = 20457,
  preset_while_active = 20608,
  coordinate_system_while_active = 20802,
  negative_tangfeed_minimum = 20963,
  center_and_radius_together = 21024,
  tangential_ignored_with_inside_corner = 21316,
  inside_corner_selected_while_active = 21317,
  mode_change_under_inside_corner = 21318,
  point_to_point_while_active = 21525,
  circle_radii_differ = 21758,
  stretch_factor_out_of_range = 22007,
  spatial_circle_while_active = 22081,
  inverse_without_online = 22125,
  real_time_loop_while_active = 22158,
  circular_selection_block = 90008,
  too_many_passive_blocks = 90011,
  tool_not_smaller_than_arc = 90017,
  arc_radii_differ = 90018,
  line_reversed = 90019,
  arc_wrapped = 90038,
  no_feed_adaptation_in_tangential_block = 90057,
  selection_point_too_near = 90123,
  radius_change_under_inside_corner = 90127,
  inside_corner_angle_too_large = 90130,
  center_out_of_range = 90133,
  end_point_out_of_range = 90134,
  spatial_circle_after_deselection = 90193,

  // NC text
  nc_syntax = 900001,
  nc_unknown_function = 900002,
  nc_unsupported = 900003,
  trc_option_unknown = 900004,
  trc_option_out_of_range = 900005,
  nc_line_too_long = 900006,
  nc_not_text = 900007,
  nc_number = 900008,
  nc_unclosed = 900009,
  nc_word_twice = 900010,
  nc_axis_unknown = 900011,
  nc_group_twice = 900012,
  tool_unknown = 900013,
  program_empty = 900014,
  side_behind_end = 900015,
  other_dialect = 900016,
  block_skip_undecided = 900017,
  turning = 900018,
  motion_unknown = 900019,

  // program rules
  circle_incomplete = 900101,
  not_available = 900102,
  deselection_without_motion = 900103,
  tool_radius_out_of_range = 900104,
  field_invalid = 900105,
  position_unknown = 900106,

  // compensation
  selection_block_too_short = 900201,
  tangential_start_on_tangent = 900202,
  circular_deselection_block = 900203,
  selection_without_contour = 900204,
  ended_while_active = 900205,
  circular_side_change_block = 900206,
  side_change_without_contour = 900207,
  contour_not_closed = 900208,
  last_block_full_circle = 900209,
  approach_crosses_contour = 900210,
  side_change_under_inside_corner = 900211,
  selection_too_long = 900212,
  blocks_masked = 900213,
  bottleneck = 900214,
  beyond_window = 900215,
  clearance_violated = 900216,
  side_changed_at_corner = 900217,
  most_left_out = 900218,
  no_tool_radius = 900219,
  tool_radius_zero = 900220,
  center_corrected = 900221,
  wear_too_large = 900222,
  wear_not_deeper = 900223,
  tool_radius_contradicts = 900224,
  tool_may_have_changed = 900225,
  call_taken_as_harmless = 900226,
  machine_compensates = 900227,
  given_value_kept = 900228,
  way_crosses_contour = 900229,
  line_beyond_control = 900235,
  selection_stands_still = 900236,

  // programs that compute
  too_many_lines_executed = 900301,
  calls_too_deep = 900302,
  variable_unset = 900303,
  division_by_zero = 900304,
  jump_target_unknown = 900305,
  subprogram_unknown = 900306,
  machine_state = 900307,
  expression_invalid = 900308,
  value_invalid = 900309,
  block_structure = 900310,
  computing_text_too_long = 900311,
  program_alarm = 900312,
};

struct DiagnosticValue {
  std::string name;  // snake_case, as documented in the row of the code
  double value = 0;  // mm, degrees or a count, as the name says
};

struct DiagnosticPoint {
  double x = 0;  // machine axes, mm
  double y = 0;
  double z = 0;
};

struct EntryHelp;  // core/base/entry_help.h

// A slip of typing. It has a remedy of its own, which names what was meant.
enum class SlipKind : std::uint8_t {
  none,
  decimal_comma,    // X10,5
  letter_o,         // YO, GO1
  letter_l,         // G0l
  other_keyboard,   // a minus sign, a dash or full-width characters of a word processor
  quotes,           // typographic ones
  unit_of_another,  // G20, G21, which are units elsewhere
};

struct Slip {
  SlipKind kind = SlipKind::none;
  std::string instead{};  // what was probably meant, as it is to be written
};

// The texts of a diagnostic.
struct DiagnosticTexts {
  std::string message{};  // English
  std::string remedy{};   // English
  std::string reason{};   // UPPER_SNAKE
  // In the language that was asked for.
  std::string title{};
  std::string text{};
  std::string help{};
};

struct Diagnostic {
  Code code{};
  Severity severity = Severity::error;
  Source source{};
  std::uint32_t column = 0;  // 1-based byte of the line; 0: unknown
  std::string detail{};      // the word, key or field at fault, as written
  std::vector<DiagnosticValue> values{};
  std::optional<DiagnosticPoint> point{};
  // The subprogram it is in, what calls it, and so on out to the program; empty in the program.
  std::vector<CallPlace> calls{};
  bool found_together = false;  // one of several errors of one run
  // The Source::index of the item that it is told after, where that comes after its own place: an
  // earlier word is at fault, which only that item needs.
  std::optional<std::uint64_t> told_after{};
  // Proposals in place of a selection or deselection block that was refused; only with such an
  // error.
  std::shared_ptr<const EntryHelp> entry_help{};
  Slip slip{};
  // The unit in force where it was found, used in texts; the lengths here are always in mm.
  bool inch = false;
  Language language = Language::english;   // that its receiver has asked for
  ControlWords words = ControlWords::isg;  // of the program it was found in
  // The texts that it was sent with: its sender may know codes that this program does not. Null
  // where it was raised here.
  std::shared_ptr<const DiagnosticTexts> texts{};
};

// One row of the public table: what programs know about a code before it is raised. Its texts are
// in core/messages: english_row_of(), german_row_of().
struct CodeRow {
  Code code{};
  Severity severity = Severity::error;
  std::string_view reason;  // UPPER_SNAKE, the `ErrorInfo.reason` of the RPCs
};

// All codes in ascending order.
[[nodiscard]] std::span<const CodeRow> code_table();
[[nodiscard]] const CodeRow& row_of(Code code);

// The diagnostic with the severity its row gives.
[[nodiscard]] Diagnostic diagnostic(Code code, const Source& source, std::string detail = {});

// Appends another block that a diagnostic refers to as values: NAME_index, and if known NAME_line
// and NAME_number. `message_of` names it by its line.
void append_place(std::vector<DiagnosticValue>& values, const std::string& name,
                  const Source& source);

// Another block that a diagnostic refers to.
struct RelatedPlace {
  std::string name{};  // of its values, as in "other"
  Source source{};
};
[[nodiscard]] std::vector<RelatedPlace> related_places(const Diagnostic& diagnostic);
// Takes the values of one append_place() off the front.
[[nodiscard]] RelatedPlace take_place(std::span<const DiagnosticValue>& values);

}  // namespace trc
