#include <algorithm>
#include <array>

#include "core/messages/explanation_tables.h"

namespace trc {
namespace {

constexpr auto rows = std::to_array<Explanation>({
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
                "line after it."},
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
     .causes = {"The contour was removed, or stands after G40."},
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
     .causes = {"G40 is missing after the previous contour."},
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
                        "out. Several contours need G40 between them.",
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
});

static_assert(std::ranges::is_sorted(rows, {}, &Explanation::code));

}  // namespace

std::span<const Explanation> explanations_of_contour() { return rows; }

}  // namespace trc
