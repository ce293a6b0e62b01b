#include "core/nc/dialect/g_function.h"

#include <algorithm>
#include <array>

namespace trc {
namespace {

using enum GGroup;

constexpr auto functions = std::to_array<GFunction>({
    {0, motion, "straight, rapid", true},
    {1, motion, "straight, at feed"},
    {2, motion, "circle or helix, clockwise"},
    {3, motion, "circle or helix, counter-clockwise"},
    {4, dwell, "dwell"},
    {5, tangential, "tangential selection or deselection of TRC"},
    {8, technology, "acceleration at block start"},
    {9, technology, "deceleration at block end"},
    {10, feed_adaptation, "feed at the tool centre", true},
    {11, feed_adaptation, "feed at the contact point"},
    {12, technology, "no corner deceleration"},
    {13, technology, "corner deceleration"},
    {17, plane, "plane X Y", true},
    {18, plane, "plane Z X"},
    {19, plane, "plane Y Z"},
    {20, technology, "no mirroring", true},
    {21, refused, "mirroring"},
    {22, refused, "mirroring"},
    {23, refused, "mirroring"},
    {25, transition, "straight transitions", true},
    {26, transition, "circular transitions"},
    {33, single_move, "thread cutting"},
    {40, side, "TRC off", true},
    {41, side, "TRC left of the contour"},
    {42, side, "TRC right of the contour"},
    {51, refused, "diameter programming"},
    {52, technology, "no diameter programming", true},
    {53, zero_shift, "no zero shift"},
    {54, zero_shift, "zero shift"},
    {55, zero_shift, "zero shift"},
    {56, zero_shift, "zero shift"},
    {57, zero_shift, "zero shift"},
    {58, zero_shift, "zero shift"},
    {59, zero_shift, "zero shift"},
    {60, technology, "exact stop"},
    {61, technology, "polynomial contouring"},
    {63, single_move, "tapping"},
    {66, technology, "synchronisation at block end"},
    {68, refused, "contour rotation"},
    {69, technology, "no contour rotation", true},
    {70, unit, "inch"},
    {71, unit, "mm", true},
    {74, zero_shift, "homing"},
    {80, single_move, "implicit subprogram call"},
    {81, single_move, "implicit subprogram call"},
    {82, single_move, "implicit subprogram call"},
    {83, single_move, "implicit subprogram call"},
    {84, single_move, "implicit subprogram call"},
    {85, single_move, "implicit subprogram call"},
    {86, single_move, "implicit subprogram call"},
    {87, single_move, "implicit subprogram call"},
    {88, single_move, "implicit subprogram call"},
    {89, single_move, "implicit subprogram call"},
    {90, dimension, "absolute dimensions", true},
    {91, dimension, "incremental dimensions"},
    {92, zero_shift, "shift of the reference point"},
    {93, feed_mode, "F is the time of a block"},
    {94, feed_mode, "F is a feed per minute", true},
    {95, feed_mode, "F is a feed per revolution"},
    {96, technology, "constant cutting speed"},
    {97, technology, "constant spindle speed"},
    {98, refused, "software limit"},
    {99, refused, "software limit"},
    {100, refused, "measuring"},
    {101, refused, "measuring shift on"},
    {102, refused, "measuring shift off"},
    {106, refused, "measuring"},
    {107, refused, "measuring"},
    {108, refused, "measuring"},
    {112, axis_technology, "control loop setting"},
    {115, technology, "look-ahead setting"},
    {116, technology, "look-ahead setting"},
    {117, technology, "look-ahead setting"},
    {129, technology, "weighting of rapid feed"},
    {130, axis_technology, "weighting of acceleration"},
    {131, axis_technology, "weighting of acceleration"},
    {132, axis_technology, "weighting of ramp times"},
    {133, axis_technology, "weighting of ramp times"},
    {134, axis_technology, "weighting of ramp times"},
    {135, axis_technology, "feedforward control"},
    {136, axis_technology, "weighting of feedforward control"},
    {137, axis_technology, "no feedforward control"},
    {138, selection, "direct selection"},
    {139, selection, "indirect selection", true},
    {140, masking, "no contour masking", true},
    {141, masking, "contour masking"},
    {150, technology, "no spline", true},
    {151, refused, "spline"},
    {159, zero_shift, "zero shift"},
    {160, refused, "measuring"},
    {161, circle_center, "circle centre absolute"},
    {162, circle_center, "circle centre relative to the start", true},
    {163, refused, "radius programming"},
    {164, circle_check, "no correction of circle centres"},
    {165, circle_check, "correction of circle centres", true},
    {166, refused, "corner angle setting"},
    {193, technology, "feed changes along the path"},
    {194, feed_mode, "F weights the axis feeds"},
    {196, technology, "limit of the spindle speed"},
    {200, refused, "manual mode"},
    {201, refused, "manual mode"},
    {202, refused, "manual mode"},
    {230, axis_technology, "weighting of acceleration at rapid"},
    {231, axis_technology, "weighting of acceleration at rapid"},
    {233, axis_technology, "weighting of ramp times at rapid"},
    {236, selection, "selection on the path"},
    {237, selection, "perpendicular selection"},
    {238, selection, "selection in an inside corner"},
    {239, selection, "direct selection without block"},
    {260, technology, "no polynomial contouring"},
    {261, technology, "polynomial contouring"},
    {293, technology, "feed changes over time"},
    {301, technology, "chamfer, outside of contours"},
    {302, technology, "rounding, outside of contours"},
    {303, spatial_circle, "circle in space"},
    {331, single_move, "tapping"},
    {332, single_move, "retract from tapping"},
    {333, axis_technology, "weighting of acceleration at feed hold"},
    {334, axis_technology, "weighting of acceleration at feed hold"},
    {338, axis_technology, "weighting of ramp times at feed hold"},
    {339, axis_technology, "weighting of ramp times at feed hold"},
    {351, refused, "mirroring"},
    {359, technology, "no exact stop"},
    {360, technology, "no exact stop"},
    {900, technology, "cycle synchronisation"},
    {901, technology, "cycle synchronisation"},
});

static_assert(std::ranges::is_sorted(functions, {}, &GFunction::number));

// The index of each number in `functions`, plus 1.
constexpr auto places = [] {
  std::array<std::uint8_t, 1000> result{};
  for (std::size_t place = 0; place < functions.size(); ++place)
    result[static_cast<std::size_t>(functions[place].number)] =
        static_cast<std::uint8_t>(place + 1);
  return result;
}();
static_assert(functions.size() < 255);

}  // namespace

std::span<const GFunction> g_function_table() { return functions; }

std::string_view name_of(GGroup group) {
  switch (group) {
    case motion:
      return "motion";
    case dwell:
      return "dwell";
    case tangential:
      return "tangential selection";
    case feed_adaptation:
      return "feed adaptation";
    case plane:
      return "plane";
    case transition:
      return "transition";
    case side:
      return "compensation";
    case unit:
      return "unit";
    case dimension:
      return "coordinates";
    case selection:
      return "selection mode";
    case masking:
      return "contour masking";
    case circle_center:
      return "circle centre";
    case circle_check:
      return "centre correction";
    case soft_lead:
      return "smooth approach or retraction";
    case soft_direction:
    case soft_steps:
      return "way of smooth approach and retraction";
    case zero_shift:
      return "zero shift";
    case feed_mode:
      return "meaning of F";
    case technology:
    case axis_technology:
      return "technology, passed on";
    case cycle:
    case cycle_end:
    case single_move:
    case frame:
    case tool_data:
    case unfollowed:
    case unfollowed_end:
      return "copied while TRC is off";
    case spatial_circle:
    case turning:
    case call:
    case refused:
      return "refused with 900003";
  }
  return {};
}

const GFunction* find_g_function(double number) {
  if (!(number >= 0 && number < static_cast<double>(places.size()))) return nullptr;
  const auto index = static_cast<std::size_t>(number);
  if (static_cast<double>(index) != number || places[index] == 0) return nullptr;
  return &functions[places[index] - 1U];
}

}  // namespace trc
