#include <algorithm>
#include <array>

#include "core/nc/dialect/dialect.h"

namespace trc {
namespace {

using enum GGroup;

constexpr auto functions = std::to_array<GFunction>({
    {0, motion, "straight, rapid", true},
    {1, motion, "straight, at feed"},
    {2, motion, "circle or helix, clockwise"},
    {3, motion, "circle or helix, counter-clockwise"},
    {4, dwell, "dwell"},
    {9, technology, "exact stop of one block"},
    {17, plane, "plane X Y", true},
    {18, plane, "plane Z X"},
    {19, plane, "plane Y Z"},
    {25, axis_technology, "lower limits"},
    {26, axis_technology, "upper limits"},
    {33, turning, "thread cutting"},
    {34, turning, "thread cutting"},
    {35, turning, "thread cutting"},
    {40, side, "TRC off", true},
    {41, side, "TRC left of the contour"},
    {42, side, "TRC right of the contour"},
    {53, single_move, "motion without zero shifts"},
    {54, zero_shift, "zero shift"},
    {55, zero_shift, "zero shift"},
    {56, zero_shift, "zero shift"},
    {57, zero_shift, "zero shift"},
    {58, frame, "absolute zero shift by axis words"},
    {59, frame, "additive zero shift by axis words"},
    {60, technology, "exact stop"},
    {62, technology, "corner deceleration"},
    {63, single_move, "tapping with compensating chuck"},
    {64, technology, "continuous path", true},
    {70, unit, "inch, not for feeds"},
    {71, unit, "mm", true},
    {74, single_move, "to the reference point"},
    {75, single_move, "to a fixed point"},
    {90, dimension, "absolute dimensions", true},
    {91, dimension, "incremental dimensions"},
    {93, feed_mode, "F is the inverse time of a block"},
    {94, feed_mode, "F is a feed per minute", true},
    {95, feed_mode, "F is a feed per revolution"},
    {96, technology, "constant cutting speed"},
    {97, technology, "constant spindle speed"},
    {110, axis_technology, "pole of polar coordinates"},
    {111, axis_technology, "pole of polar coordinates"},
    {112, axis_technology, "pole of polar coordinates"},
    {147, refused, "smooth approach along a straight line: use a straight G41 block"},
    {148, refused, "smooth retract along a straight line: use a straight G40 block"},
    {153, single_move, "motion without zero shifts and base frames"},
    {247, refused, "smooth approach along a quarter circle: use a straight G41 block"},
    {248, refused, "smooth retract along a quarter circle: use a straight G40 block"},
    {331, single_move, "tapping"},
    {332, single_move, "retract from tapping"},
    {340, technology, "smooth approach in space"},
    {341, technology, "smooth approach in the plane"},
    {347, refused, "smooth approach along a semicircle: use a straight G41 block"},
    {348, refused, "smooth retract along a semicircle: use a straight G40 block"},
    {450, transition, "circular transitions", true},
    {451, transition, "straight transitions"},
    {460, technology, "collision check of approach and retract", true},
    {461, technology, "collision check of approach and retract"},
    {462, technology, "collision check of approach and retract"},
    {500, zero_shift, "no zero shift", true},
    {505, zero_shift, "zero shift"},
    {506, zero_shift, "zero shift"},
    {507, zero_shift, "zero shift"},
    {508, zero_shift, "zero shift"},
    {509, zero_shift, "zero shift"},
    {510, zero_shift, "zero shift"},
    {511, zero_shift, "zero shift"},
    {512, zero_shift, "zero shift"},
    {513, zero_shift, "zero shift"},
    {514, zero_shift, "zero shift"},
    {515, zero_shift, "zero shift"},
    {601, technology, "exact stop fine"},
    {602, technology, "exact stop coarse"},
    {603, technology, "block change at the end of interpolation"},
    {621, technology, "corner deceleration"},
    {641, technology, "continuous path with rounding"},
    {642, technology, "continuous path with rounding"},
    {643, technology, "continuous path with rounding"},
    {644, technology, "continuous path with rounding"},
    {645, technology, "continuous path with rounding"},
    {700, unit, "inch, also for feeds"},
    {710, unit, "mm, also for feeds"},
});

static_assert(std::ranges::is_sorted(functions, {}, &GFunction::tenths));

}  // namespace

std::span<const GFunction> sinumerik_functions() { return functions; }

}  // namespace trc
