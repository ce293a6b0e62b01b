#pragma once

#include <string_view>

// Reasons that a diagnostic gives in `detail` and that decide its remedy: who raises it and who
// explains it name the same constant. What begins with a comma or a blank follows a word of the
// program.

namespace trc::reason {

// The path of loop removal or masking cannot go on (90019, 90038).
inline constexpr std::string_view no_way_past_block =
    "REMOVE_MASKED_BLOCKS finds no way past this block";
inline constexpr std::string_view no_way_past_lead =
    "REMOVE_MASKED_BLOCKS finds no way past this lead";
inline constexpr std::string_view no_room_at_first_point =
    "the tool has no room at the first point of the contour";
inline constexpr std::string_view no_room_at_last_point =
    "the tool has no room at the last point of the contour";
inline constexpr std::string_view no_room_at_lead_in =
    "the tool has no room where the lead-in begins";
inline constexpr std::string_view no_room_at_lead_out =
    "the tool has no room where the lead-out ends";

// A path that was measured comes too near to a wall (900216).
inline constexpr std::string_view closes_in_inside_corner =
    "the contour closes in an inside corner, where no tool has room";
inline constexpr std::string_view comes_from_other_side =
    "the tool comes from the one side of the contour and cuts on the other";

// Text that is read.
inline constexpr std::string_view text_in_utf16 = "text in UTF-16";
inline constexpr std::string_view no_colon_after_number =
    ", a block without a colon after its number";
inline constexpr std::string_view words_after_statement = ", words after a statement";
inline constexpr std::string_view number_after_words = "a block number after other words";
inline constexpr std::string_view argument_without_point = ", an argument without a decimal point";
inline constexpr std::string_view beside_m98 = " beside M98";
inline constexpr std::string_view beside_m98_with_calls = " beside M98, where L counts the calls";
inline constexpr std::string_view beside_g65 = " beside G65";
inline constexpr std::string_view beside_g66 = " beside G66";
inline constexpr std::string_view percentages_beside_a_motion =
    ", percentages of axes, beside a motion or another function of axes";
inline constexpr std::string_view after_percent = ", after the % in line ";  // and its number
inline constexpr std::string_view with_axis_words = " with axis words";
inline constexpr std::string_view as_in_dialect = ", as in ";  // and the name of the dialect

// Variables, and tools whose radius is asked for.
inline constexpr std::string_view set_by_program = ", set by the program";
inline constexpr std::string_view changed_by_program = ", which the program itself changes";
inline constexpr std::string_view machine_variable_set =
    ", a variable of the machine that the program sets";
inline constexpr std::string_view variable_of_haas =
    ", a variable of Haas or a tool offset of Fanuc";
inline constexpr std::string_view tool_in_spindle = "the tool in the spindle, without T and M6";

}  // namespace trc::reason
