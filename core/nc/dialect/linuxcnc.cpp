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
    {5, cycle, "spline"},
    {5, cycle, "spline", false, 1},
    {5, cycle, "spline", false, 2},
    {5, cycle, "end of a spline", false, 3},
    {7, turning, "diameter words"},
    {8, technology, "radius words", true},
    {10, tool_data, "tool data and zero points"},
    {17, plane, "plane X Y", true},
    {17, refused, "plane U V", false, 1},
    {18, plane, "plane Z X"},
    {18, refused, "plane W U", false, 1},
    {19, plane, "plane Y Z"},
    {19, refused, "plane V W", false, 1},
    {20, unit, "inch"},
    {21, unit, "mm"},
    {28, single_move, "to a stored position"},
    {28, technology, "storing of a position", false, 1},
    {30, single_move, "to a stored position"},
    {30, technology, "storing of a position", false, 1},
    {33, single_move, "motion in step with the spindle"},
    {33, single_move, "rigid tapping", false, 1},
    {38, single_move, "probing", false, 2},
    {38, single_move, "probing", false, 3},
    {38, single_move, "probing", false, 4},
    {38, single_move, "probing", false, 5},
    {40, side, "TRC off", true},
    {41, side, "TRC left of the contour"},
    {41, side, "TRC left of the contour, D is the diameter", false, 1},
    {42, side, "TRC right of the contour"},
    {42, side, "TRC right of the contour, D is the diameter", false, 1},
    {43, technology, "tool length offset"},
    {43, axis_technology, "tool offset given by axis words", false, 1},
    {43, axis_technology, "further tool offset", false, 2},
    {49, technology, "no tool length offset", true},
    {52, frame, "local coordinate system"},
    {53, single_move, "motion in machine coordinates"},
    {54, zero_shift, "work coordinate system", true},
    {55, zero_shift, "work coordinate system"},
    {56, zero_shift, "work coordinate system"},
    {57, zero_shift, "work coordinate system"},
    {58, zero_shift, "work coordinate system"},
    {59, zero_shift, "work coordinate system"},
    {59, zero_shift, "work coordinate system", false, 1},
    {59, zero_shift, "work coordinate system", false, 2},
    {59, zero_shift, "work coordinate system", false, 3},
    {61, technology, "exact path"},
    {61, technology, "exact stop", false, 1},
    {64, technology, "path blending"},
    {70, turning, "finishing of a turned profile"},
    {71, turning, "roughing of a turned profile"},
    {72, turning, "roughing of a turned profile"},
    {73, cycle, "drilling with chip breaking"},
    {74, cycle, "left-hand tapping"},
    {76, turning, "thread turning"},
    {80, cycle_end, "end of a drilling cycle", true},
    {81, cycle, "drilling"},
    {82, cycle, "drilling with dwell"},
    {83, cycle, "deep hole drilling"},
    {84, cycle, "tapping"},
    {85, cycle, "boring"},
    {86, cycle, "boring"},
    {87, cycle, "back boring"},
    {88, cycle, "boring"},
    {89, cycle, "boring with dwell"},
    {90, dimension, "absolute dimensions", true},
    {90, circle_center, "circle centre absolute", false, 1},
    {91, dimension, "incremental dimensions"},
    {91, circle_center, "circle centre relative to the start", true, 1},
    {92, frame, "shift of the coordinates"},
    {92, frame, "no shift of the coordinates", false, 1},
    {92, frame, "shift of the coordinates suspended", false, 2},
    {92, frame, "shift of the coordinates restored", false, 3},
    {93, feed_mode, "F is the inverse time of a block"},
    {94, feed_mode, "F is a feed per minute", true},
    {95, feed_mode, "F is a feed per revolution"},
    {96, technology, "constant cutting speed"},
    {97, technology, "constant spindle speed", true},
    {98, technology, "cycles return to the initial height", true},
    {99, technology, "cycles return to the retract height"},
});

static_assert(std::ranges::is_sorted(functions, {}, &GFunction::tenths));

}  // namespace

std::span<const GFunction> linuxcnc_functions() { return functions; }

}  // namespace trc
