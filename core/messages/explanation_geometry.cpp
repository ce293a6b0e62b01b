#include <algorithm>
#include <array>

#include "core/messages/explanation_tables.h"

namespace trc {
namespace {

constexpr auto rows = std::to_array<Explanation>({
    {.code = Code::circular_selection_block,
     .meaning = "Under G138, G139, G238 and G239 the tool runs to the contour in a straight "
                "line: a circle would end beside its end point and be none any more.",
     .causes = {"The first motion after G41 is already the first arc of the contour.",
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
                "G40 was forgotten, and the drilling after the contour counts as part of "
                "it."},
     .on_command_line = "Move them before G41 or after G40, or raise the limit: --set "
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
     .meaning = "With the first motion after G40 the tool leaves the contour. That motion "
                "has to lie in the plane.",
     .causes = {"G40 stands directly before G303."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G42 G139\n"
                "N30 G01 X10 Y10 F500\n"
                "N40 X20\n"
                "N50 G40\n"
                "N60 G303 X30 Y30 I25 J15\n"
                "N70 M30\n"},
});

static_assert(std::ranges::is_sorted(rows, {}, &Explanation::code));

}  // namespace

std::span<const Explanation> explanations_of_geometry() { return rows; }

}  // namespace trc
