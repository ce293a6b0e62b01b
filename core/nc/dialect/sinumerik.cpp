#include <algorithm>
#include <array>
#include <cstdint>

#include "core/nc/dialect/dialect.h"

namespace trc {
namespace {

using enum GGroup;

constexpr auto single_functions = std::to_array<GFunction>({
    {0, motion, "straight, rapid", true},
    {1, motion, "straight, at feed"},
    {2, motion, "circle or helix, clockwise"},
    {3, motion, "circle or helix, counter-clockwise"},
    {4, dwell, "dwell"},
    {9, technology, "exact stop of one block"},
    {17, plane, "plane X Y", true},
    {18, plane, "plane Z X"},
    {19, plane, "plane Y Z"},
    {20, refused, "inch of the ISO mode: write G70, or declare the dialect FANUC"},
    {21, refused, "mm of the ISO mode: write G71, or declare the dialect FANUC"},
    {25, axis_technology, "lower limits"},
    {26, axis_technology, "upper limits"},
    {33, single_move, "thread cutting"},
    {34, single_move, "thread cutting"},
    {35, single_move, "thread cutting"},
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
    {140, soft_direction, "smooth approach from the side of the tool", true},
    {141, soft_direction, "smooth approach from the left"},
    {142, soft_direction, "smooth approach from the right"},
    {143, soft_direction, "smooth approach from where the tool stands"},
    {147, soft_lead, "smooth approach along a straight line"},
    {148, soft_lead, "smooth retraction along a straight line"},
    {153, single_move, "motion without zero shifts and base frames"},
    {247, soft_lead, "smooth approach along a quarter circle"},
    {248, soft_lead, "smooth retraction along a quarter circle"},
    {290, technology, "Siemens mode", true},
    {291, refused, "ISO mode: the program is one of --dialect fanuc"},
    {331, single_move, "tapping"},
    {332, single_move, "retract from tapping"},
    {340, soft_steps, "smooth approach in space", true},
    {341, soft_steps, "smooth approach in the plane"},
    {347, soft_lead, "smooth approach along a semicircle"},
    {348, soft_lead, "smooth retraction along a semicircle"},
    {450, transition, "circular transitions", true},
    {451, transition, "straight transitions"},
    {460, technology, "collision check of approach and retract", true},
    {461, technology, "collision check of approach and retract"},
    {462, technology, "collision check of approach and retract"},
    {500, zero_shift, "no zero shift", true},
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
    {961, technology, "constant cutting speed, feed per minute"},
    {971, technology, "constant spindle speed, feed per minute"},
    {973, technology, "constant spindle speed without limit"},
});

// Adds G505 to G599, the settable frames after G54 to G57.
constexpr auto functions = [] {
  constexpr int first = 505;
  constexpr int last = 599;
  std::array<GFunction, single_functions.size() + (last - first + 1)> all{};
  const auto rest = std::ranges::copy(single_functions, all.begin()).out;
  std::generate(rest, all.end(), [number = std::int16_t{first}]() mutable {
    return GFunction{number++, GGroup::zero_shift, "zero shift"};
  });
  std::ranges::sort(all, {}, &GFunction::tenths);
  return all;
}();

}  // namespace

std::span<const GFunction> sinumerik_functions() { return functions; }

}  // namespace trc
