#include <algorithm>
#include <array>

#include "core/messages/explanation_tables.h"

namespace trc {
namespace {

constexpr auto rows = std::to_array<Explanation>({
    {.code = Code::nc_syntax,
     .meaning = "At the place given nothing begins that could be a word: an address letter "
                "with a number, a function, a comment or a command.",
     .causes = {"A letter is missing before a number.",
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
     .meaning = "An address letter is followed by a decimal number in the range of that word.",
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
         "as the program says them; or each tool of the program, that of --radius too: --set "
         "tools=NUMBER:RADIUS, once for each.",
     .example = "N10 G00 X0 Y0\n"
                "N20 D77\n"
                "N30 M30\n"},
    {.code = Code::program_empty,
     .meaning = "There is nothing to compensate: no line of the program has a word.",
     .causes = {"The wrong file, or one that was not written to its end."},
     .example = "(nothing but comments)\n"},
    {.code = Code::side_behind_end,
     .meaning = "What stands after M02 or M30, or after the % that follows the first block, is not "
                "executed. A compensation that is selected there would be lost.",
     .causes = {"Two programs were put into one file.",
                "A line with % stands in the midst of the program."},
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
     .meaning = "A switch of the machine decides whether lines with `/` are executed. The "
                "contour has one path with them and another without, and only one of them can be "
                "written.",
     .causes = {"A leading `/` before G41, G40 or a motion of the contour.",
                "A line with `/` that computes, or says what the coordinates after it mean."},
     .on_command_line = "Say how it stands: --set block_skip=execute where lines with `/` are "
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
     .meaning = "After G40 the tool leaves the contour with the next motion in the plane. "
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
     .causes = {"G54 to G59, G92 or a shift, and after it an incremental motion, a circle "
                "or G41."},
     .example = "N10 G00 X0 Y0\n"
                "N20 G54\n"
                "N30 G91 X10\n"
                "N40 M30\n"},
});

static_assert(std::ranges::is_sorted(rows, {}, &Explanation::code));

}  // namespace

std::span<const Explanation> explanations_of_programs() { return rows; }

}  // namespace trc
