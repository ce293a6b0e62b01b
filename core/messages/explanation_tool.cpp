#include <algorithm>
#include <array>

#include "core/messages/explanation_tables.h"

namespace trc {
namespace {

constexpr auto rows = std::to_array<Explanation>({
    {.code = Code::no_tool_radius,
     .meaning = "Which path the tool takes depends on its radius, and neither program nor "
                "setup has said one.",
     .causes = {"The tool table was not given.", "The D or T word stands after G41."},
     .on_command_line =
         "Give the radius: --radius 5, or those of the tools that the program names: "
         "--tools tools.csv, --set tools=1:5, once for each.",
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
     .meaning = "Between two contours the program calls what only the machine has, and after it "
                "nothing says which tool is in the spindle. If the call changes it, the second "
                "contour has the radius of the first tool. In ISG so does the first contour after "
                "a call where V.G.WZ_AKT.R before it has said the radius.",
     .causes = {"A subprogram of the machine's builder changes the tool."},
     .on_command_line = "Program the T or D word of the tool after it, with its radius in the "
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
                "motion function and G90 or G91 have to be programmed anew after it; the rest "
                "subprograms hardly change: it is taken as it was, and that is said once.",
     .causes = {"The subprogram is in the memory of the control, or in a file of its own."},
     .on_command_line = "Give its file (--subprograms FILE, or the folder), or program after the "
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
    {.code = Code::line_beyond_control,
     .meaning = "Older controls of Fanuc take eight digits in a number, LinuxCNC 255 characters in "
                "a line, Sinumerik 512, ISG 4000. A line that is written anew may not become "
                "longer.",
     .causes = {"A line of the contour has a long comment.",
                "A position beyond 10 m has four decimals."},
     .on_command_line = "Divide the words of the line, or shorten its comment; where it is a "
                        "number, write fewer decimals with --decimals.",
     .example = "G21 G90 G17\n"
                "T1 M6\n"
                "G0 X11980. Y-20.\n"
                "G41 D1 G1 X12000. Y0. F300.\n"
                "Y40.\n"
                "G40 X11980.\n"
                "M30\n",
     .options = "--dialect fanuc --radius 5.1234"},
    {.code = Code::selection_stands_still,
     .meaning = "The first block after G41 or G42 that moves in the plane is the approach: at its "
                "start the centre of the tool is still on the programmed path. Where the block of "
                "the selection stands at its end already, that is the next one, which was meant "
                "to be the first wall.",
     .causes = {"The tool has gone to the first point of the contour before the selection.",
                "The program comes from a generator that makes no lead-in."},
     .example = "N10 G00 X10 Y10 F300\n"
                "N20 V.G.WZ_AKT.R = 5\n"
                "N30 G42 G01 X10 Y10\n"
                "N40 X90\n"
                "N50 Y90\n"
                "N60 X10\n"
                "N70 Y10\n"
                "N80 G40 X0 Y0\n"
                "N90 M30\n"},
});

static_assert(std::ranges::is_sorted(rows, {}, &Explanation::code));

}  // namespace

std::span<const Explanation> explanations_of_tool() { return rows; }

}  // namespace trc
