#include "core/base/explanation.h"

#include <algorithm>

#include "core/base/german.h"

namespace trc {
namespace {

constexpr auto rows = std::to_array<Explanation>({
    {.code = Code::full_circle_with_radius_word,
     .meaning = "A circle whose end point is its start point needs a centre: a radius alone "
                "fits endlessly many circles.",
     .causes = {"The end point is the same as the start point by a slip.",
                "A full circle was meant and written with R."},
     .example = "N10 G00 X0 Y0\n"
                "N20 G02 X0 Y0 R10 F1000\n"
                "N30 M30\n"},
    {.code = Code::circle_center_misfit,
     .meaning = "Start point and end point must be equally far from the centre. Here they "
                "differ by more than the control may correct by shifting the centre (G165).",
     .causes = {"I, J, K are written absolute where they count from the start point, or the "
                "other way round (G161, G162).",
                "A wrong end point, or one that was carried over from an edited block.",
                "The block before is compensated with G239, which leaves the tool beside the "
                "programmed point."},
     .example = "N10 G00 X0 Y0\n"
                "N20 G02 X40 Y0 I12 J30 F1000\n"
                "N30 M30\n"},
    {.code = Code::circle_radius_zero,
     .meaning = "The centre lies in the start point, or R is 0: such an arc has no "
                "direction.",
     .causes = {"I, J, K were left at 0.",
                "The program counts in a unit so coarse that the radius is rounded to 0."},
     .example = "N10 G00 X0 Y0\n"
                "N20 G02 X10 I0 J0 F1000\n"
                "N30 M30\n"},
    {.code = Code::radius_and_tool_word_together,
     .meaning = "Both words set the tool radius, and nothing says which one is meant to "
                "hold.",
     .causes = {"A D word was put into a line that already sets V.G.WZ_AKT.R."},
     .example = "N10 G00 X0 Y0\n"
                "N20 D1 V.G.WZ_AKT.R=3\n"
                "N30 M30\n"},
    {.code = Code::transition_type_twice,
     .meaning = "G25 closes outside corners with lines, G26 with arcs. One block cannot have "
                "both.",
     .causes = {"Two lines were joined to one."},
     .example = "N10 G00 X0 Y0\n"
                "N20 G25 G26\n"
                "N30 M30\n"},
    {.code = Code::compensation_side_twice,
     .meaning = "G40, G41 and G42 exclude one another: left of the contour, right of it, or "
                "not compensated.",
     .causes = {"Two lines were joined to one.", "G41 was replaced by G42 without removing it."},
     .example = "N10 G00 X0 Y0\n"
                "N20 G41 X10 Y20 G42\n"
                "N30 M30\n"},
    {.code = Code::selection_mode_twice,
     .meaning = "The selection mode says how the tool runs to the contour. One block selects "
                "one.",
     .causes = {"Two lines were joined to one."},
     .example = "N10 G00 X0 Y0\n"
                "N20 G138 G41 G139 X10\n"
                "N30 M30\n"},
    {.code = Code::plane_change_while_active,
     .meaning = "The compensation works in one plane. Its path cannot go over into another "
                "one in the middle of the contour.",
     .causes = {"G40 is missing in front of the change.",
                "A G17 that a CAM system writes at the head of each operation, though the "
                "contour before is still open."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G41 G01 X10 Y0 F500\n"
                "N30 X20\n"
                "N40 G19\n"
                "N50 G40 X30 Y10\n"
                "N60 M30\n"},
    {.code = Code::axis_link_while_active,
     .meaning = "An axis link gives the motions of one axis to another. While the "
                "compensation is active the next blocks are already computed from what holds "
                "now, so that it cannot change in between.",
     .causes = {"G40 is missing in front of it.",
                "A cycle or a subprogram that was expanded into the contour brings it along."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G41 G01 X10 Y0 F500\n"
                "N30 #ENABLE AX LINK[1]\n"
                "N40 G40 X30 Y10\n"
                "N50 M30\n"},
    {.code = Code::preset_while_active,
     .meaning = "A preset gives the place where the tool stands another coordinate. While "
                "the compensation is active the next blocks are already computed from what "
                "holds now, so that it cannot change in between.",
     .causes = {"G40 is missing in front of it.",
                "A cycle or a subprogram that was expanded into the contour brings it along."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G41 G01 X10 Y0 F500\n"
                "N30 #PSET[X0]\n"
                "N40 G40 X30 Y10\n"
                "N50 M30\n"},
    {.code = Code::coordinate_system_while_active,
     .meaning = "A new coordinate system moves or turns everything that follows. While the "
                "compensation is active the next blocks are already computed from what holds "
                "now, so that it cannot change in between.",
     .causes = {"G40 is missing in front of it.",
                "A cycle or a subprogram that was expanded into the contour brings it along."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G41 G01 X10 Y0 F500\n"
                "N30 #CS ON[0,0,0,0,0,45]\n"
                "N40 G40 X30 Y10\n"
                "N50 M30\n"},
    {.code = Code::negative_tangfeed_minimum,
     .meaning = "RMIN is the contour radius below which the feed is no longer reduced. No "
                "radius is negative.",
     .causes = {"A sign by a slip."},
     .example = "N10 G00 X0 Y0\n"
                "N20 #TANGFEED [RMIN=-3]\n"
                "N30 M30\n"},
    {.code = Code::center_and_radius_together,
     .meaning = "A centre and a radius each say where the circle lies; together they may "
                "contradict one another.",
     .causes = {"R was added to a line that has a centre already."},
     .example = "N10 G00 X0 Y0\n"
                "N20 G01 X10 Y100 F10000\n"
                "N30 G02 X200 I50 J50 R50\n"
                "N40 M30\n"},
    {.code = Code::tangential_ignored_with_inside_corner,
     .meaning = "G238 begins and ends in an inside corner; there is no tangential arc that "
                "G05 could insert. The program goes on without it.",
     .causes = {"G05 stands in a header that serves all modes."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G238\n"
                "N30 G05 G41 G01 X0 Y-20 F500\n"
                "N40 X20\n"
                "N50 Y20\n"
                "N60 X-20\n"
                "N70 Y-20\n"
                "N80 X0\n"
                "N90 G40 X0 Y-40\n"
                "N100 M30\n"},
    {.code = Code::inside_corner_selected_while_active,
     .meaning = "G238 decides at the first contour block where a closed contour begins. It "
                "cannot take over one that has begun.",
     .causes = {"G40 is missing behind the contour before."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G41 G01 X10 Y0 F500\n"
                "N30 G238\n"
                "N40 G40 X30 Y10\n"
                "N50 M30\n"},
    {.code = Code::mode_change_under_inside_corner,
     .meaning = "A contour under G238 ends in the corner where it began; another mode would "
                "leave it elsewhere.",
     .causes = {"G40 is missing behind the contour before."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G238\n"
                "N30 G41 G01 X10 Y0 F500\n"
                "N40 G139\n"
                "N50 G40 X30 Y10\n"
                "N60 M30\n"},
    {.code = Code::point_to_point_while_active,
     .meaning = "With #PTP the axes run each for itself: the path between two points is not "
                "known. While the compensation is active the next blocks are already "
                "computed from what holds now, so that it cannot change in between.",
     .causes = {"G40 is missing in front of it.",
                "A cycle or a subprogram that was expanded into the contour brings it along."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G41 G01 X10 Y0 F500\n"
                "N30 #PTP ON\n"
                "N40 G40 X30 Y10\n"
                "N50 M30\n"},
    {.code = Code::circle_radii_differ,
     .meaning = "Under G164 the centre holds as it is written, and start and end point are "
                "not equally far from it.",
     .causes = {"I, J, K or the end point are rounded too coarsely.",
                "I, J, K are written absolute where they count from the start point, or the "
                "other way round (G161, G162)."},
     .example = "N10 G164\n"
                "N20 G00 X0 Y0\n"
                "N30 G02 X40 Y0 I18 F1000\n"
                "N40 M30\n"},
    {.code = Code::stretch_factor_out_of_range,
     .meaning = "STRETCH_FACTOR says how many tool radii a block may be stretched at an "
                "outside corner. With a value out of range 1 holds.",
     .causes = {"A percentage was written in place of a factor."},
     .example = "N10 G00 X0 Y0\n"
                "N20 #TRC [STRETCH_FACTOR=10]\n"
                "N30 G01 X10 F500\n"
                "N40 M30\n"},
    {.code = Code::spatial_circle_while_active,
     .meaning = "G303 is a circle in space. The compensation knows circles in its plane "
                "only.",
     .causes = {"G40 is missing in front of it."},
     .example = "N10 G00 X0 Y0\n"
                "N20 V.G.WZ_AKT.R = 5\n"
                "N30 G42 G01 X10 Y10 F500\n"
                "N40 G303 I50 J50 K50 X100 Y0 Z100\n"
                "N50 G40 X200\n"
                "N60 M30\n"},
    {.code = Code::inverse_without_online,
     .meaning = "INVERSE belongs to the compensation while machining (ONLINE), which is not "
                "part of this program.",
     .causes = {"A program written for a control with online compensation."},
     .on_command_line = "Remove INVERSE; the inverse path is written with --set "
                        "include_inverse_path=true --format jsonl.",
     .example = "N10 G00 X0 Y0\n"
                "N20 #TRC [INVERSE=1]\n"
                "N30 M30\n"},
    {.code = Code::real_time_loop_while_active,
     .meaning = "#RT WHILE repeats lines while the machine moves. While the compensation is "
                "active the next blocks are already computed from what holds now, so that it "
                "cannot change in between.",
     .causes = {"G40 is missing in front of it.",
                "A cycle or a subprogram that was expanded into the contour brings it along."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G41 G01 X10 Y0 F500\n"
                "N30 #RT WHILE TRUE\n"
                "N40 G40 X30 Y10\n"
                "N50 M30\n"},
    {.code = Code::circular_selection_block,
     .meaning = "Under G138, G139, G238 and G239 the tool runs to the contour in a straight "
                "line: a circle would end beside its end point and be none any more.",
     .causes = {"The first motion behind G41 is already the first arc of the contour.",
                "A CAM system that leads in by an arc puts G41 into the arc, not into the "
                "line before it."},
     .example = "N10 G00 X0 Y0 F1000\n"
                "N20 V.G.WZ_AKT.R = 3\n"
                "N30 G41 G02 X20 Y0 I10\n"
                "N40 G01 X40\n"
                "N50 G40 X60\n"
                "N60 M30\n"},
    {.code = Code::too_many_passive_blocks,
     .meaning = "To know a corner the compensation has to see the next motion in the plane. "
                "Blocks in between (M functions, moves of the third axis, dwells) are kept "
                "until it comes, and only so many.",
     .causes = {"A long list of technology words in the middle of the contour.",
                "G40 was forgotten, and the drilling behind the contour counts as part of "
                "it."},
     .on_command_line = "Move them before G41 or behind G40, or raise the limit: --set "
                        "max_passive_blocks=200.",
     .example = "N10 V.G.WZ_AKT.R = 2\n"
                "N20 G41 G01 X10 F1000\n"
                "N30 X40\n"
                "N40 M8\n"
                "N50 M9\n"
                "N60 M8\n"
                "N70 X80\n"
                "N80 G40 X90\n"
                "N90 M30\n",
     .options = "--set max_passive_blocks=2"},
    {.code = Code::tool_not_smaller_than_arc,
     .meaning = "An arc that the tool cuts from inside shrinks by the tool radius. Nothing "
                "of this one is left.",
     .causes = {"The tool is too large for a fillet or a pocket corner.",
                "The side is wrong: outside of the arc the tool fits."},
     .on_command_line =
         "Use a smaller tool (trc radii says which one fits) or a larger arc, or G141 "
         "with #TRC [CONV_CIR_TO_LIN=1].",
     .example = "N10 G00 X0 Y0 F1000\n"
                "N20 V.G.WZ_AKT.R = 3\n"
                "N30 G41 G01 X20\n"
                "N40 X40\n"
                "N50 G03 X46 I3\n"
                "N60 G01 Y40\n"
                "N70 G40 X60\n"
                "N80 M30\n"},
    {.code = Code::arc_radii_differ,
     .meaning = "Under G164 the centre holds as it is written. An arc that begins and ends "
                "at different distances from it is a spiral, and a spiral has no "
                "equidistant.",
     .causes = {"I, J, K or the end point are rounded too coarsely."},
     .example = "N10 V.G.WZ_AKT.R=1\n"
                "N20 G164\n"
                "N30 G41 G01 X10 Y0 F500\n"
                "N40 G03 X0 Y10.05 I-10\n"
                "N50 G40 X0 Y30\n"
                "N60 M30\n"},
    {.code = Code::line_reversed,
     .meaning = "Between its two corners so little is left of the line that the tool would "
                "have to run backwards on it, and cut into the part.",
     .causes = {"The tool is too large for a step, a slot or a chamfer between two inside "
                "corners.",
                "The contour is compensated on the wrong side, or a lead crosses a wall: then no "
                "radius fits, whatever one place has room for.",
                "Two corners lie a few micrometres apart, as CAM systems write them."},
     .on_command_line =
         "Use a smaller tool: trc radii says which one fits. G141 masks such blocks "
         "where it is not on yet, and with it #TRC [REMOVE_MASKED_BLOCKS=1] leaves out "
         "whole loops.",
     .example = "N10 G00 X-30 Y0 F1000\n"
                "N20 V.G.WZ_AKT.R = 10\n"
                "N30 G41 G01 X0\n"
                "N40 X50\n"
                "N50 X55 Y5\n"
                "N60 X55 Y50\n"
                "N70 G40 Y80\n"
                "N80 M30\n"},
    {.code = Code::arc_wrapped,
     .meaning = "Between its two corners nothing is left of the arc: the tool would have to "
                "run round the rest of the circle, and cut into the part.",
     .causes = {"The tool is too large for the fillet and the lines beside it.",
                "The contour is compensated on the wrong side, or a lead crosses a wall: then no "
                "radius fits, whatever one place has room for."},
     .on_command_line =
         "Use a smaller tool: trc radii says which one fits. G141 masks such blocks "
         "where it is not on yet, and with it #TRC [REMOVE_MASKED_BLOCKS=1] leaves out "
         "whole loops.",
     .example = "N10 G00 X-30 Y0 F1000\n"
                "N20 V.G.WZ_AKT.R = 10\n"
                "N30 G41 G01 X0\n"
                "N40 X50\n"
                "N50 G161 G03 X54.392305 Y4.392305 I44 J10.392305\n"
                "N60 G01 X54.392305 Y50\n"
                "N70 G40 Y80\n"
                "N80 M30\n"},
    {.code = Code::no_feed_adaptation_in_tangential_block,
     .meaning = "G11 keeps the feed at the contour. In this G05 arc the contour would not "
                "move at all: the block runs with the programmed feed of the centre.",
     .causes = {"The start point lies too near to the contour for the tool."},
     .example = "N10 G00 X18 Y22\n"
                "N20 G11 V.G.WZ_AKT.R = 5\n"
                "N30 G05 G41 G01 X20 Y20 F1000\n"
                "N40 X60\n"
                "N50 G40 X90 Y0\n"
                "N60 M30\n"},
    {.code = Code::selection_point_too_near,
     .meaning = "G238 starts in the open: where the tool stands before the contour it must "
                "touch none of it.",
     .causes = {"The start point of a pocket lies nearer to a wall than the tool radius.",
                "The tool is larger than the one the program was made for."},
     .example = "N5 V.G.WZ_AKT.R = 29\n"
                "N10 G238\n"
                "N20 G00 X0 Y0\n"
                "N30 G41\n"
                "N40 G01 X0 Y100 F500\n"
                "N50 X-20 Y20\n"
                "N60 X-100 Y0\n"
                "N70 X-20 Y-20\n"
                "N80 X0 Y-100\n"
                "N90 X20 Y-20\n"
                "N100 X100 Y0\n"
                "N110 X20 Y20\n"
                "N120 X0 Y100\n"
                "N130 G40\n"
                "N140 G00 X0 Y0\n"
                "N150 M30\n"},
    {.code = Code::radius_change_under_inside_corner,
     .meaning = "A contour under G238 ends in the corner where it began, which another "
                "radius would put elsewhere.",
     .causes = {"A D word or V.G.WZ_AKT.R stands between G41 and G40."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G238\n"
                "N30 G41 G01 X10 Y0 F500\n"
                "N40 V.G.WZ_AKT.R=3\n"
                "N50 G40 X30 Y10\n"
                "N60 M30\n"},
    {.code = Code::inside_corner_angle_too_large,
     .meaning = "The tool would have to go round the first corner of the contour to come to "
                "its side.",
     .causes = {"The start point lies on the other side of the contour."},
     .example = "N10 G00 X60 Y-40\n"
                "N20 G238 V.G.WZ_AKT.R = 5\n"
                "N30 G41 G01 X0 Y0 F1000\n"
                "N40 Y100\n"
                "N50 X100\n"
                "N60 Y0\n"
                "N70 X0\n"
                "N80 G40 X60 Y-40\n"
                "N90 M30\n"},
    {.code = Code::center_out_of_range,
     .meaning = "Coordinates reach to one million mm. Beyond them doubles are too coarse for "
                "a thousandth.",
     .causes = {"A decimal point is missing.", "The program is in another unit."},
     .example = "N10 G00 X0 Y0\n"
                "N20 G02 X1 Y0 I1000001 F500\n"
                "N30 M30\n"},
    {.code = Code::end_point_out_of_range,
     .meaning = "Coordinates reach to one million mm. A compensated corner may also lie "
                "there although the programmed one does not, where two lines meet under a "
                "very small angle.",
     .causes = {"A decimal point is missing.", "The program is in another unit."},
     .example = "N10 G00 X0 Y0\n"
                "N20 G01 X1000000.1 F500\n"
                "N30 M30\n"},
    {.code = Code::spatial_circle_after_deselection,
     .meaning = "With the first motion behind G40 the tool leaves the contour. That motion "
                "has to lie in the plane.",
     .causes = {"G40 stands directly in front of G303."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G42 G139\n"
                "N30 G01 X10 Y10 F500\n"
                "N40 X20\n"
                "N50 G40\n"
                "N60 G303 X30 Y30 I25 J15\n"
                "N70 M30\n"},
    {.code = Code::nc_syntax,
     .meaning = "At the place given nothing begins that could be a word: an address letter "
                "with a number, a function, a comment or a command.",
     .causes = {"A letter is missing in front of a number.",
                "The program is written for another control (trc info FILE says what it "
                "looks like)."},
     .example = "N10 G00 X0 Y0\n"
                "N20 G01 10\n"
                "N30 M30\n"},
    {.code = Code::nc_unknown_function,
     .meaning = "A G function that is not known might change the path, so that it cannot be "
                "passed over.",
     .causes = {"A typing error.", "A function of the machine builder.",
                "The program is written for another control."},
     .on_command_line = "Remove it; trc info lists the functions that are known. Where it does not "
                        "change the path: --set pass_words=NAME.",
     .example = "N10 G00 X0 Y0\n"
                "N20 G777 X10\n"
                "N30 M30\n"},
    {.code = Code::nc_unsupported,
     .meaning = "The word computes, jumps, calls or shifts: what the tool does then is known "
                "to the control only.",
     .causes = {"A subprogram called within a contour whose lines are not in the program.",
                "A shift or rotation of coordinates within a contour.",
                "The program is written for another control."},
     .example = "N10 G00 X0 Y0\n"
                "N20 V.G.WZ_AKT.R = 5\n"
                "N30 G41 G01 X10 Y10 F500\n"
                "N40 X30\n"
                "N50 L SIDE.NC\n"
                "N60 X50\n"
                "N70 M30\n"},
    {.code = Code::trc_option_unknown,
     .meaning = "#TRC [ ] takes the keywords of the table of options, each with a value.",
     .causes = {"A typing error."},
     .on_command_line = "Correct its spelling; trc info lists all keywords.",
     .example = "N10 G00 X0 Y0\n"
                "N20 #TRC [REVERS=1]\n"
                "N30 M30\n"},
    {.code = Code::trc_option_out_of_range,
     .meaning = "Each keyword of #TRC has its range. Outside of it the program stops, rather "
                "than to cut with another value.",
     .causes = {"A switch takes 0 or 1.", "A length or an angle is written in another unit."},
     .on_command_line = "Program a value of the range given; trc info lists all ranges.",
     .example = "N10 G00 X0 Y0\n"
                "N20 #TRC [KERF_MASKING=2]\n"
                "N30 M30\n"},
    {.code = Code::nc_line_too_long,
     .meaning = "Lines are kept whole, so that their length is limited.",
     .causes = {"The file is no NC program.", "The line ends were lost when the file was copied."},
     .on_command_line = "Check that this is an NC program with line ends.",
     .example = "N10 G00 X0 Y0\n"
                "N20 (- )\n"
                "N30 M30\n",
     .repeated = "- ",
     .times = 33'000},
    {.code = Code::nc_not_text,
     .meaning = "NC programs are plain text. A control character, or a byte that is no "
                "UTF-8, says that this one is not, or was damaged.",
     .causes = {"Comments in an older encoding, as with umlauts from an editor of Windows.",
                "A file transfer left bytes of its own at the beginning or the end.",
                "A sign of degrees, of diameters or of a tolerance outside of a comment."},
     .on_command_line = "Take it out, and save the program as plain text in UTF-8; ASCII is UTF-8 "
                        "too. Comments in Latin-1 stay as they are with --set encoding=auto.",
     .example = "N10 G00 X0 Y0\n"
                "N20 G01 X10 (bell \x07)\n"
                "N30 M30\n"},
    {.code = Code::nc_number,
     .meaning = "Behind an address letter stands a decimal number in the range of that word.",
     .causes = {"A comma in place of the decimal point.", "The letter O in place of the digit 0.",
                "A feed of 0."},
     .example = "N10 G01 X0 Y0 F500\n"
                "N20 X10 F0\n"
                "N30 M30\n"},
    {.code = Code::nc_unclosed,
     .meaning = "A bracket, a comment or a continued line goes on to the end of the line or "
                "of the program.",
     .causes = {"A closing bracket is missing.", "The file ends early."},
     .example = "N10 G00 X0 Y0\n"
                "N20 #TRC [REVERSE=1\n"
                "N30 M30\n"},
    {.code = Code::nc_word_twice,
     .meaning = "One address says one thing in a block. Controls differ in which of two they "
                "take.",
     .causes = {"Two lines were joined to one.", "A coordinate was edited and the older one left."},
     .example = "N10 G00 X0 Y0\n"
                "N20 X10 Y20 X10\n"
                "N30 M30\n"},
    {.code = Code::nc_axis_unknown,
     .meaning = "The word moves an axis that the setup does not name: it might be part of "
                "the path.",
     .causes = {"A rotary or an additional axis that the setup does not name.", "A typing error."},
     .on_command_line = "Correct the name, or name the axes that follow along: --set "
                        "axis_names=A,B,Q.",
     .example = "N10 G00 X0 Y0\n"
                "N20 G01 X10 Q5 F500\n"
                "N30 M30\n"},
    {.code = Code::nc_group_twice,
     .meaning = "Functions of one group exclude one another, as G00 and G01 do, and nothing "
                "says which one is meant.",
     .causes = {"Two lines were joined to one."},
     .example = "N10 G00 X0 Y0\n"
                "N20 G01 X10 G00 Y20\n"
                "N30 M30\n"},
    {.code = Code::tool_unknown,
     .meaning = "The D or T word names a tool of which the radius is not known.",
     .causes = {"The tool table was not given.", "The number is one of another machine.",
                "The table has the tool, but not its name, or not this edge."},
     .on_command_line =
         "Give the table with that tool: --tools tools.csv, with number,name,edge,radius as far "
         "as the program says them; or that tool alone: --set tools=NUMBER:RADIUS.",
     .example = "N10 G00 X0 Y0\n"
                "N20 D77\n"
                "N30 M30\n"},
    {.code = Code::program_empty,
     .meaning = "There is nothing to compensate: no line of the program has a word.",
     .causes = {"The wrong file, or one that was not written to its end."},
     .example = "(nothing but comments)\n"},
    {.code = Code::side_behind_end,
     .meaning = "What stands behind M02 or M30 is not executed. A compensation that is "
                "selected there would be lost.",
     .causes = {"Two programs were put into one file."},
     .example = "N10 G00 X0 Y0\n"
                "N20 M30\n"
                "N30 X5 G41 Y7\n"},
    {.code = Code::other_dialect,
     .meaning = "Words mean different things to different controls: G20 is inches to one and "
                "something else to another. What is written here looks like another dialect "
                "than the one declared.",
     .causes = {"The dialect was not declared; it is ISG then."},
     .on_command_line =
         "Declare the dialect of the program: --dialect fanuc, linuxcnc, sinumerik or "
         "heidenhain. If it is ISG, remove the word.",
     .example = "G90 G17\n"
                "G20 G40\n"
                "G00 X1 Y2\n"},
    {.code = Code::block_skip_undecided,
     .meaning = "A switch of the machine decides whether lines behind `/` are executed. The "
                "contour has one path with them and another without, and only one of them can be "
                "written.",
     .causes = {"A leading `/` in front of G41, G40 or a motion of the contour.",
                "A line behind `/` that computes, or says what the coordinates behind it mean."},
     .on_command_line = "Say how it stands: --set block_skip=execute where lines behind `/` are "
                        "executed, leave_out where they are not.",
     .example = "N10 G00 X0 Y0\n"
                "/ N20 G01 X10 F500\n"
                "N30 M30\n"},
    {.code = Code::turning,
     .meaning = "A lathe compensates the nose of its tool in the plane of the spindle, by "
                "quadrants of the tool. This program mills.",
     .causes = {"A program of a lathe was given."},
     .example = "G21 G97 T0101\n"
                "G0 X50. Z2.\n"
                "G42 X20. Z0.\n"
                "G1 Z-20. F0.2\n",
     .options = "--dialect fanuc"},
    {.code = Code::motion_unknown,
     .meaning = "Without a word before it a control moves with G00 or with G01, as it is set. "
                "The path is written with the word, and no contour may be cut at rapid.",
     .causes = {"The program is a part of another one, which has the G01.",
                "G01 has been forgotten."},
     .example = "G21 G17 G90\n"
                "T1 D1 M6 F300\n"
                "X-20. Y-20.\n"
                "G41 D1 X0 Y0\n"
                "Y40.\n",
     .options = "--dialect fanuc --radius 5"},
    {.code = Code::circle_incomplete,
     .meaning = "An arc needs a centre or a radius in its own block: those of the block "
                "before do not hold on.",
     .causes = {"G02 or G03 still holds from the block before, and a straight line was "
                "meant.",
                "I, J or R was forgotten."},
     .example = "N10 G00 X0 Y0\n"
                "N20 G02 X10 F500\n"
                "N30 M30\n"},
    {.code = Code::not_available,
     .meaning = "The function exists, but only a control can do it while it machines.",
     .causes = {"ONLINE, INVERSE and ONLINE_BY_VECTOR."},
     .on_command_line = "Remove it; trc info says which options are available.",
     .example = "N10 G00 X0 Y0\n"
                "N20 #TRC [ONLINE=1]\n"
                "N30 M30\n"},
    {.code = Code::deselection_without_motion,
     .meaning = "Behind G40 the tool leaves the contour with the next motion in the plane. "
                "Before that it cannot be led to another one.",
     .causes = {"The retract motion was removed.",
                "The retract is a move of the third axis alone."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G41 G01 X10 Y0 F500\n"
                "N30 X20\n"
                "N40 G40\n"
                "N50 G41\n"
                "N60 X30 Y10\n"
                "N70 M30\n"},
    {.code = Code::tool_radius_out_of_range,
     .meaning = "A tool radius of that size is a slip.",
     .causes = {"A decimal point is missing.",
                "The radius is in another unit than the program counts in."},
     .example = "N10 G00 X0 Y0\n"
                "N20 V.G.WZ_AKT.R=214749\n"
                "N30 M30\n"},
    {.code = Code::field_invalid,
     .meaning = "A value of the setup or of a command is not a number, or lies outside of "
                "its range.",
     .causes = {"Another unit.", "A field that was computed and became infinite."},
     .example = "N10 G00 X0 Y0\n"
                "N20 #TANGFEED [RMIN=10000000]\n"
                "N30 M30\n"},
    {.code = Code::position_unknown,
     .meaning = "A shift or another coordinate system moves the origin by what only the "
                "control knows. Where the tool stands in the new coordinates is open until "
                "it is said.",
     .causes = {"G54 to G59, G92 or a shift, and behind it an incremental motion, a circle "
                "or G41."},
     .example = "N10 G00 X0 Y0\n"
                "N20 G54\n"
                "N30 G91 X10\n"
                "N40 M30\n"},
    {.code = Code::selection_block_too_short,
     .meaning = "G236 leads the tool onto the contour on the block itself, which has to be "
                "as long as that takes.",
     .causes = {"The lead is shorter than the tool radius.",
                "The tool is larger than the one the program was made for."},
     .example = "N10 G00 X0 Y0 F1000\n"
                "N20 V.G.WZ_AKT.R = 10\n"
                "N30 G236\n"
                "N40 G41 G01 X5\n"
                "N50 X60 Y10\n"
                "N60 G40\n"
                "N70 X120 Y30\n"
                "N80 M30\n"},
    {.code = Code::tangential_start_on_tangent,
     .meaning = "G05 leads in by an arc that touches the contour. From a point on the line "
                "that the contour begins with no such arc comes.",
     .causes = {"The start point lies in the elongation of the first contour block, before "
                "its beginning."},
     .example = "N10 G00 X40 Y25 F1000\n"
                "N20 V.G.WZ_AKT.R = 5\n"
                "N30 G41 G05 G01 X20 Y20\n"
                "N40 X60\n"
                "N50 G40 G05 X80 Y25\n"
                "N60 M30\n"},
    {.code = Code::circular_deselection_block,
     .meaning = "Under G138, G139 and G238 the tool leaves the contour in a straight line.",
     .causes = {"A CAM system that leads out by an arc puts G40 into the arc, not into the "
                "line behind it."},
     .example = "N10 G00 X0 Y0 F1000\n"
                "N20 V.G.WZ_AKT.R = 3\n"
                "N30 G41 G01 X20\n"
                "N40 X40\n"
                "N50 G40 G02 X60 I10\n"
                "N60 G01 X80\n"
                "N70 M30\n"},
    {.code = Code::selection_without_contour,
     .meaning = "There is no motion in the plane between G41 or G42 and G40: the path is the "
                "programmed one.",
     .causes = {"The contour was removed, or stands behind G40."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G41\n"
                "N30 M8\n"
                "N40 G40\n"
                "N50 G00 X10 Y10\n"
                "N60 M30\n"},
    {.code = Code::ended_while_active,
     .meaning = "The tool stands at the compensated end of the contour when the program "
                "ends; nothing has led it away.",
     .causes = {"G40 was forgotten.", "The file ends early."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G41 G01 X10 Y0 F500\n"
                "N30 X20\n"
                "N40 M30\n"},
    {.code = Code::circular_side_change_block,
     .meaning = "From one side of the contour to the other the tool crosses it in a straight "
                "line.",
     .causes = {"G42 stands in an arc of the contour."},
     .example = "N10 G00 X-20 Y-20\n"
                "N20 V.G.WZ_AKT.R = 5\n"
                "N30 G41 G01 X0 Y0 F1000\n"
                "N40 X50\n"
                "N50 G42 G02 X70 Y-20 R20\n"
                "N60 G01 Y-60\n"
                "N70 G40 X90 Y-80\n"
                "N80 M30\n"},
    {.code = Code::side_change_without_contour,
     .meaning = "A side is taken at a contour block. Between selection and change, or "
                "between two changes, there is none.",
     .causes = {"G42 stands in the block that G41 leads to."},
     .example = "N10 G00 X-20 Y-20\n"
                "N20 V.G.WZ_AKT.R = 5\n"
                "N30 G41 G01 X0 Y0 F1000\n"
                "N40 G42 X50\n"
                "N50 Y50\n"
                "N60 G40 X90 Y80\n"
                "N70 M30\n"},
    {.code = Code::contour_not_closed,
     .meaning = "Under G238 a contour ends in the corner where it begins. This one ends "
                "elsewhere, or has no block.",
     .causes = {"The last block was forgotten.",
                "An end point is rounded differently than the beginning."},
     .example = "N10 G00 X50 Y50\n"
                "N20 G238 V.G.WZ_AKT.R = 5\n"
                "N30 G41 G01 X0 Y0 F1000\n"
                "N40 M30\n"},
    {.code = Code::last_block_full_circle,
     .meaning = "Under G238 the closing corner is the joint of the last block with the "
                "first. A full circle has no end of its own.",
     .causes = {"A bore was put at the end of the contour."},
     .example = "N10 G00 X50 Y50\n"
                "N20 G238 V.G.WZ_AKT.R = 5\n"
                "N30 G41 G01 X0 Y0 F1000\n"
                "N40 X100\n"
                "N50 Y100\n"
                "N60 X0\n"
                "N70 Y0\n"
                "N80 G03 X0 Y0 I20 J20\n"
                "N90 G40 G01 X50 Y50\n"
                "N100 M30\n"},
    {.code = Code::approach_crosses_contour,
     .meaning = "On its way to the first corner the tool would cut through a wall.",
     .causes = {"The start point lies outside of a pocket, or inside of a stud."},
     .example = "N10 G00 X150 Y120\n"
                "N20 G238 V.G.WZ_AKT.R = 5\n"
                "N30 G41 G01 X0 Y0 F1000\n"
                "N35 X100\n"
                "N40 Y100\n"
                "N50 X0\n"
                "N60 Y0\n"
                "N70 G40 X50 Y50\n"
                "N80 M30\n"},
    {.code = Code::side_change_under_inside_corner,
     .meaning = "A contour under G238 ends in the corner where it began, on the side it "
                "began on.",
     .causes = {"G40 is missing behind the contour before."},
     .example = "N10 G00 X50 Y50\n"
                "N20 G238 V.G.WZ_AKT.R = 5\n"
                "N30 G41 G01 X0 Y0 F1000\n"
                "N40 X100\n"
                "N50 Y100\n"
                "N60 G42 X0\n"
                "N70 Y0\n"
                "N80 G40 X50 Y50\n"
                "N90 M30\n"},
    {.code = Code::selection_too_long,
     .meaning = "What cannot be known before the end of the contour keeps its blocks back, "
                "and only so many. Where the path is measured, so does that: with verify=report it "
                "is a warning, and the path beside that contour is not measured.",
     .causes = {"One selection over a whole surface.", "G40 was forgotten."},
     .on_command_line = "Divide the contour, or raise the limit: --max-blocks-per-selection, where "
                        "a server is asked its setting of that name.",
     .example = "N10 G00 X0 Y-20\n"
                "N20 G141 V.G.WZ_AKT.R = 5\n"
                "N30 G41 G01 X0 Y0 F1000\n"
                "N40 X40\n"
                "N50 Y40\n"
                "N60 X80\n"
                "N70 Y80\n"
                "N80 G40 X100\n"
                "N90 M30\n",
     .options = "--max-blocks-per-selection 3"},
    {.code = Code::blocks_masked,
     .meaning = "Under G141 blocks that the tool cannot reach are passed by: the contour "
                "there stays uncut. Nothing is cut too deep.",
     .causes = {"The tool is too large for a slot, a step or a kerf."},
     .on_command_line =
         "Use a smaller tool to machine them: trc radii says which one reaches every "
         "wall.",
     .example = "N10 G00 X-20 Y-60 F1000\n"
                "N20 V.G.WZ_AKT.R = 5\n"
                "N30 G138 G26 G141\n"
                "N40 G41 G01 X0 Y-40\n"
                "N50 Y0\n"
                "N60 X20\n"
                "N70 Y-10 M8\n"
                "N80 X24\n"
                "N90 Y0\n"
                "N100 X60\n"
                "N110 G40 X80 Y40\n"
                "N120 M30\n"},
    {.code = Code::bottleneck,
     .meaning = "At this place the tool keeps its distance to the block it follows, but "
                "comes too near to another one.",
     .causes = {"A neck that is narrower than the tool.", "A contour that meets itself."},
     .on_command_line =
         "Use a smaller tool (trc radii says which one fits), or correct the contour.",
     .example = "N10 G00 X-60 Y-80 F1000\n"
                "N20 V.G.WZ_AKT.R = 10\n"
                "N30 G41 G01 X-60 Y-40\n"
                "N40 X0\n"
                "N50 Y0\n"
                "N60 X50\n"
                "N70 Y-10\n"
                "N80 X90\n"
                "N90 Y29.999\n"
                "N100 X50\n"
                "N110 Y19.999\n"
                "N120 X5\n"
                "N130 Y75\n"
                "N140 X-60\n"
                "N150 G40 Y95\n"
                "N160 M30\n",
     .options = "--set implicit_contour_masking=true"},
    {.code = Code::beyond_window,
     .meaning = "Masking looks for loops in a window of so many blocks. A loop that is "
                "longer than the window stays in the path.",
     .causes = {"look_ahead_blocks is smaller than the contour."},
     .on_command_line = "See the whole contour: --set look_ahead_blocks=0.",
     .example = "N10 G00 X0 Y-20\n"
                "N20 G141 V.G.WZ_AKT.R = 10\n"
                "N30 G41 G01 X0 Y0 F1000\n"
                "N40 X50\n"
                "N50 Y50\n"
                "N60 X0\n"
                "N70 Y20\n"
                "N80 G40 X20\n"
                "N90 M30\n",
     .options = "--set look_ahead_blocks=2"},
    {.code = Code::clearance_violated,
     .meaning = "The finished path is measured against the contour by a method of its own. "
                "Here it comes too near: the part would be damaged.",
     .causes = {"A neck that is narrower than the tool, under G140, which looks at "
                "neighbouring blocks only.",
                "The contour begins and ends in an inside corner, or the side is the wrong one.",
                "Contour violations are ignored (IGNORE_CONT_DAMAGE)."},
     .on_command_line = "Do not machine it. Use a smaller tool (trc radii says which one fits) or "
                        "correct the contour, or let G141 with REMOVE_MASKED_BLOCKS take the loops "
                        "out.",
     .example = "N10 G00 X-60 Y-80 F1000\n"
                "N20 V.G.WZ_AKT.R = 10\n"
                "N30 G41 G01 X-60 Y-40\n"
                "N40 X0\n"
                "N50 Y0\n"
                "N60 X50\n"
                "N70 Y-10\n"
                "N80 X90\n"
                "N90 Y25\n"
                "N100 X50\n"
                "N110 Y15\n"
                "N120 X5\n"
                "N130 Y75\n"
                "N140 X-60\n"
                "N150 G40 Y95\n"
                "N160 M30\n"},
    {.code = Code::side_changed_at_corner,
     .meaning = "With REVERSE the side changes where the motion turns back on itself. Here "
                "it does not: the tool crosses the corner.",
     .causes = {"A point is missing at which the motion turns back.",
                "The end point of a block is rounded, so that the way back is another one."},
     .example = "N10 G90 F800\n"
                "N20 #TRC[REVERSE=1]\n"
                "N30 V.G.WZ_AKT.R = 10\n"
                "N40 G00 X0 Y0\n"
                "N50 G01 X100 Y100\n"
                "N60 G41 G01 X150\n"
                "N70 G01 X250\n"
                "N80 G01 Y200\n"
                "N90 G42\n"
                "N100 G01 X100\n"
                "N110 G01 X100 Y150\n"
                "N120 G40 G01 X0\n"
                "N130 G01 Y0\n"
                "N140 M30\n"},
    {.code = Code::most_left_out,
     .meaning = "Loop removal would pass by so large a part of the contour that it can hardly be "
                "meant.",
     .causes = {"The tool does not get through a neck, and behind it lies most of the "
                "contour.",
                "The leads cross the contour, or rapid motion links several contours in one "
                "selection: put G40 between them.",
                "The contour is compensated on the wrong side."},
     .on_command_line =
         "Use a smaller tool: trc radii says which one fits. If a block that bounds "
         "no material is in the way, make leads larger than the tool, or say how many "
         "blocks lead: --set leads=blocks:1,1. Where the stretch may be left out: "
         "--set max_masked_share=1.",
     .example = "N10 G00 X-80 Y30 F1000\n"
                "N20 V.G.WZ_AKT.R = 10\n"
                "N30 #TRC[REMOVE_MASKED_BLOCKS=1]\n"
                "N40 G41 G141 G01 X-60 Y0\n"
                "N50 X-5\n"
                "N60 Y-20\n"
                "N70 X-80\n"
                "N80 Y-100\n"
                "N90 X80\n"
                "N100 Y-20\n"
                "N110 X5\n"
                "N120 Y0\n"
                "N130 X60\n"
                "N140 G40 X80 Y30\n"
                "N150 M30\n"},
    {.code = Code::no_tool_radius,
     .meaning = "Which path the tool takes depends on its radius, and neither program nor "
                "setup has said one.",
     .causes = {"The tool table was not given.", "The D or T word stands behind G41."},
     .on_command_line =
         "Give the radius: --radius 5, or those of the tools that the program names: "
         "--tools tools.csv, --set tools=1:5.",
     .example = "N10 G00 X0 Y0\n"
                "N20 G41\n"
                "N30 G01 X10 Y10 F500\n"
                "N40 X50\n"
                "N50 G40 X60 Y-10\n"
                "N60 M30\n"},
    {.code = Code::tool_radius_zero,
     .meaning = "With a radius of 0 the path is the contour itself.",
     .causes = {"The tool table has no radius for this tool.",
                "A program of centre paths, which is what a radius of 0 is for."},
     .example = "N10 G00 X0 Y0\n"
                "N20 V.G.WZ_AKT.R = 0\n"
                "N30 G41 G01 X10 Y10 F500\n"
                "N40 X50\n"
                "N50 G40 X60 Y-10\n"
                "N60 M30\n"},
    {.code = Code::center_corrected,
     .meaning = "Under G165 the centre is shifted until start and end point are equally far "
                "from it. By so much that it should be looked at.",
     .causes = {"I, J, K or the end point are rounded too coarsely.", "A wrong end point."},
     .example = "N10 G00 X0 Y0\n"
                "N20 G02 X60.05 Y0 I30 F500\n"
                "N30 M30\n"},
    {.code = Code::wear_too_large,
     .meaning = "Wear is a few tenths. Beyond max_wear it is taken for the whole radius, or "
                "for a slip.",
     .causes = {"The whole radius was given as wear.", "A diameter, or another unit."},
     .on_command_line = "Is this the whole radius? With nominal_radius the tool radius is only the "
                        "difference from that one: give that, or allow more: --set max_wear=2.",
     .example = "N10 G00 X0 Y-30 F1000\n"
                "N20 V.G.WZ_AKT.R = 5 G41 G01 X0 Y0\n"
                "N30 X50\n"
                "N40 G40 Y-30\n",
     .options = "--wear -1.5"},
    {.code = Code::wear_not_deeper,
     .meaning = "A centre path is a contour already rounded by its nominal tool. A smaller "
                "tool follows that rounding: the inside corner stays as wide as before.",
     .causes = {"A worn or reground tool, with nominal_radius."},
     .example = "N10 G00 X-20 Y0 F1000\n"
                "N20 V.G.WZ_AKT.R = -0.1\n"
                "N30 G26 G138 G41 G01 X0 Y0\n"
                "N40 X50\n"
                "N50 Y50\n"
                "N60 G40 X30 Y60\n",
     .options = "--set nominal_radius=5"},
    {.code = Code::tool_radius_contradicts,
     .meaning = "A program may write the radius of a tool into the table of the machine: TOOL DEF, "
                "G10, $TC_DP6. That is what the machine would use, and so it is used here.",
     .causes = {"The tool was reground, and only one of the two was corrected.",
                "The setup has a tool of another machine, or a diameter."},
     .example = "G17 G90 G71\n"
                "$TC_DP6[1,1]=6\n"
                "T1 D1\n"
                "G0 X-20 Y0\n"
                "G41 G1 X0 Y0 F500\n"
                "Y40\n"
                "G40 X-20\n"
                "M30\n",
     .options = "--dialect sinumerik --set tools=1:5"},
    {.code = Code::tool_may_have_changed,
     .meaning = "Between two contours the program calls what only the machine has, and behind it "
                "nothing says which tool is in the spindle. If the call changes it, the second "
                "contour has the radius of the first tool. In ISG so does the first contour behind "
                "a call where V.G.WZ_AKT.R in front of it has said the radius.",
     .causes = {"A subprogram of the machine's builder changes the tool."},
     .on_command_line = "Program the T or D word of the tool behind it, with its radius in the "
                        "table of tools, or compensate the parts of the program one by one. What "
                        "changes no tool: --set pass_words=NAME.",
     .example = "G17 G90 G71\n"
                "T1 D1\n"
                "G0 X-20 Y0\n"
                "G41 G1 X0 Y0 F500\n"
                "Y40\n"
                "G40 X-20\n"
                "TC(\"MILL\")\n"
                "G90 G0 X-20 Y0\n"
                "G41 G1 X0 Y0 F500\n"
                "Y40\n"
                "G40 X-20\n"
                "M30\n",
     .options = "--dialect sinumerik --radius 5"},
    {.code = Code::call_taken_as_harmless,
     .meaning = "A subprogram whose text is not given may change all that is modal. Position, "
                "motion function and G90 or G91 have to be programmed anew behind it; the rest "
                "subprograms hardly change: it is taken as it was, and that is said once.",
     .causes = {"The subprogram is in the memory of the control, or in a file of its own."},
     .on_command_line = "Give its file (--subprograms FILE, or the folder), or program behind the "
                        "call what has to hold. A name that changes nothing: --set "
                        "pass_words=NAME.",
     .example = "G17 G90 G71\n"
                "L HEAD.NC\n"
                "G90 G00 X-20 Y0\n"
                "G01 G41 X0 Y0 F500\n"
                "Y40\n"
                "G40 X-20\n"
                "M30\n",
     .options = "--radius 5"},
    {.code = Code::machine_compensates,
     .meaning = "G12, G13 and G150 of Haas stay as they are: the machine takes their radius from "
                "the register that D names. Contours of G41 and G42 are compensated in the result "
                "already, and their D words are gone.",
     .causes = {"The program mills circular or general pockets with cycles of the machine."},
     .example = "G21 G90 G17\n"
                "T1 M6\n"
                "G0 X0. Y0. Z-2.\n"
                "G13 I12. D1 F200.\n"
                "M30\n",
     .options = "--dialect fanuc --radius 5"},
    {.code = Code::given_value_kept,
     .meaning =
         "A counter in #500, R1 and the like outlives the program, and the control raises it "
         "anew in each run where one assignment sets it from itself. What is set by way of "
         "another variable, or from a given value, does not change from run to run.",
     .causes = {"A counter is raised by way of a local variable.",
                "A value that the machine has measured, and that is given, is stored."},
     .example = "G21 G90 G17\n"
                "#1=#500+1\n"
                "G0 X0. Y0.\n"
                "#500=#1\n"
                "M30\n",
     .options = "--dialect fanuc --variable '#500=7'"},
    {.code = Code::way_crosses_contour,
     .meaning =
         "Approach and retract run as programmed, and are measured beside the path: here the "
         "centre of the tool goes through a wall of its contour, at the depth of that.",
     .causes = {"G40 leads straight to the next place, across the part.",
                "The tool starts on the other side of the contour, or the side is the wrong one."},
     .example = "N10 G00 X-40 Y-40\n"
                "N20 V.G.WZ_AKT.R = 5\n"
                "N30 G41 G01 X0 Y30 F300\n"
                "N40 Y60\n"
                "N50 X100\n"
                "N60 Y0\n"
                "N70 X0\n"
                "N80 Y30\n"
                "N90 G40 X120 Y42\n"
                "N100 M30\n"},
    {.code = Code::too_many_lines_executed,
     .meaning = "Loops, jumps and calls are followed, and every line that is executed becomes a "
                "line of the flat program. A bound keeps a loop without end from running forever.",
     .causes = {"The count of a loop is not raised, or is compared the wrong way round.",
                "A jump back without a condition, as for a bar feeder or a warm-up."},
     .on_command_line = "Look for a loop that never ends. A program that is meant to be so long: "
                        "--max-executed-lines.",
     .example = "N10 G0 X0 Y0\n"
                "GOTO 10\n",
     .options = "--dialect fanuc --max-executed-lines 1000"},
    {.code = Code::calls_too_deep,
     .meaning = "Each call is executed within the one before. Controls allow 4 to 10 levels, and "
                "32 are followed here.",
     .causes = {"A subprogram calls itself, by itself or by way of another one."},
     .example = "G0 X0 Y0\n"
                "M98 P100\n"
                "M30\n"
                "O100\n"
                "M98 P100\n"
                "M99\n",
     .options = "--dialect fanuc"},
    {.code = Code::variable_unset,
     .meaning = "What the variable holds is known to the machine alone, or to nobody. Nothing is "
                "put in its place.",
     .causes = {"A variable that keeps its value at the machine (#500 and above of Fanuc) is set "
                "by hand there.",
                "A slip in its number or name.",
                "A subprogram is called without an argument that it needs."},
     .on_command_line = "Set it in the program, or give its value: --variable NAME=VALUE.",
     .example = "G0 X#500 Y0\n"
                "M30\n",
     .options = "--dialect fanuc"},
    {.code = Code::division_by_zero,
     .meaning = "The divisor of a division or of MOD is 0 when the line is executed.",
     .causes = {"A variable in the divisor is vacant, which counts as 0.",
                "A count of 0 was given, as of holes or of passes."},
     .example = "#1=0\n"
                "G0 X[10/#1]\n"
                "M30\n",
     .options = "--dialect fanuc"},
    {.code = Code::jump_target_unknown,
     .meaning = "A jump needs one place to go on. A subprogram has numbers of its own, which "
                "jumps from outside do not reach.",
     .causes = {"The number was lost when the program was numbered anew.",
                "The target stands in another program of the file.",
                "Behind M99 P both the subprogram and its caller have the number: Fanuc means "
                "the caller, Haas the subprogram."},
     .example = "G0 X0 Y0\n"
                "GOTO 500\n"
                "M30\n",
     .options = "--dialect fanuc"},
    {.code = Code::subprogram_unknown,
     .meaning = "What the subprogram moves is part of the path. Files are not looked for unless "
                "they are given.",
     .causes = {"The subprogram is in the memory of the control, or in a file of its own.",
                "A slip in its number or name."},
     .on_command_line = "Put it into the same file, where the dialect has it (ISG: in front of "
                        "the program, behind %L NAME), or give its file: --subprograms FILE, or "
                        "the folder.",
     .example = "G0 X0 Y0\n"
                "M98 P1001\n"
                "M30\n",
     .options = "--dialect fanuc"},
    {.code = Code::machine_state,
     .meaning = "Positions, offsets, times, signals and the result of a probe are known when the "
                "program runs, not before.",
     .causes = {"A system variable, as #5041 or #5021.",
                "A line that writes an offset of the machine.", "A program that measures."},
     .on_command_line = "Where its value is known, give it: --variable NAME=VALUE; else take the "
                        "line out.",
     .example = "#100=#5041\n"
                "G0 X#100\n"
                "M30\n",
     .options = "--dialect fanuc"},
    {.code = Code::expression_invalid,
     .meaning = "Something stands where a number, a variable, an operator or the end of the line "
                "belongs.",
     .causes = {"A bracket is missing.",
                "Arithmetic behind an address without brackets, X#1+5 for X[#1+5].",
                "Parentheses, which are comments here, in place of brackets."},
     .example = "#1=5\n"
                "G0 X#1+5\n"
                "M30\n",
     .options = "--dialect fanuc"},
    {.code = Code::value_invalid,
     .meaning = "The root of a negative number, the arc sine of more than 1, a variable or a "
                "program whose number is no whole one: no control can go on with that.",
     .causes = {"The data of a macro do not fit one another, as a chord longer than the diameter.",
                "A variable was mistaken for another one."},
     .example = "#1=2\n"
                "G0 X[ASIN[#1]]\n"
                "M30\n",
     .options = "--dialect fanuc"},
    {.code = Code::block_structure,
     .meaning = "Loops and branches are pairs of lines, and a subprogram ends where it returns.",
     .causes = {"The numbers behind DO and END differ.",
                "Loops overlap in place of lying within one another.",
                "M99 is missing at the end of a subprogram."},
     .example = "#1=0\n"
                "WHILE [#1 LT 3] DO1\n"
                "#1=#1+1\n"
                "END2\n"
                "M30\n",
     .options = "--dialect fanuc"},
    {.code = Code::computing_text_too_long,
     .meaning = "From its first line with a variable, a jump or a call on a program is held as a "
                "whole, as any line may be jumped to.",
     .causes = {"One line that computes in front of the output of a CAM system."},
     .example = "#1=0\n"
                "G01 X1 F500\n"
                "M30\n",
     .options = "--dialect fanuc",
     .repeated = "G01 X1 F500\n",
     .times = 1'500'000},
    {.code = Code::program_alarm,
     .meaning = "#3000 stops a machine with a text. A program uses it where its data are not as "
                "it needs them.",
     .causes = {"An argument of a macro is missing or not allowed."},
     .example = "#3000=1 (NO DEPTH)\n"
                "M30\n",
     .options = "--dialect fanuc"},
});

static_assert(std::ranges::is_sorted(rows, {}, &Explanation::code));

}  // namespace

std::span<const Explanation> explanations() { return rows; }

const Explanation* explanation_of(Code code) {
  const auto found = std::ranges::lower_bound(rows, code, {}, &Explanation::code);
  return found != rows.end() && found->code == code ? &*found : nullptr;
}

std::string example_of(const Explanation& explanation) {
  const std::size_t at =
      explanation.repeated.empty() ? 0 : explanation.example.find(explanation.repeated);
  std::string program(explanation.example.substr(0, at));
  program.reserve(explanation.example.size() + explanation.repeated.size() * explanation.times);
  for (std::uint32_t i = 1; i < explanation.times; ++i) program += explanation.repeated;
  return program.append(explanation.example.substr(at));
}

std::string_view help_on_command_line(Code code, Language language) {
  const Explanation* explanation = explanation_of(code);
  if (explanation == nullptr) return {};
  return language == Language::german ? german_row_of(code).on_command_line
                                      : explanation->on_command_line;
}

}  // namespace trc
