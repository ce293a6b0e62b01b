#include <algorithm>
#include <array>

#include "core/messages/explanation_tables.h"

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
     .causes = {"G40 is missing before the change.",
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
     .causes = {"G40 is missing before it.",
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
     .causes = {"G40 is missing before it.",
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
     .causes = {"G40 is missing before it.",
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
     .causes = {"G40 is missing after the previous contour."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G41 G01 X10 Y0 F500\n"
                "N30 G238\n"
                "N40 G40 X30 Y10\n"
                "N50 M30\n"},
    {.code = Code::mode_change_under_inside_corner,
     .meaning = "A contour under G238 ends in the corner where it began; another mode would "
                "leave it elsewhere.",
     .causes = {"G40 is missing after the previous contour."},
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
     .causes = {"G40 is missing before it.",
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
     .causes = {"G40 is missing before it."},
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
     .causes = {"G40 is missing before it.",
                "A cycle or a subprogram that was expanded into the contour brings it along."},
     .example = "N10 V.G.WZ_AKT.R=2\n"
                "N20 G41 G01 X10 Y0 F500\n"
                "N30 #RT WHILE TRUE\n"
                "N40 G40 X30 Y10\n"
                "N50 M30\n"},
});

static_assert(std::ranges::is_sorted(rows, {}, &Explanation::code));

}  // namespace

std::span<const Explanation> explanations_of_words() { return rows; }

}  // namespace trc
