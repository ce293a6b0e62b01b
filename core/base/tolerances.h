#pragma once

namespace trc {

// Tolerances of geometry stand here, and the limits of what is accepted. A constant that only
// bounds rounding of one expression stands beside it and says what it bounds. The verification
// measures with numbers of its own. Lengths in mm, angles in rad.
struct Tolerances {
  // Closer than this is one point. A path that merges two such points is wrong
  // by less than a hundredth of the finest increment a control commands.
  double same_point = 1e-6;
  // Closer than this along a block of a contour is one place, where its walls are looked for: as
  // much may be a lead, or a wall, that is not.
  double same_place = 1e-7;
  // A gouge shallower than this is none: 0.1 um, the internal unit of the
  // reference control (D-14).
  double on_contour = 1e-4;
  // How much nearer than the tool radius a path may come before it is a
  // bottleneck: this part of the radius, or of 1 mm if that is more (rule 5.1).
  double clearance = 1e-6;
  // How much nearer a loop may come before it violates and is removed, likewise:
  // the passable side of `clearance`, with room for rounding (D-36).
  double passable = 0.9e-6;
  // The loops themselves are looked for at this part of the radius, or of 1 mm:
  // what rounding leaves of an equidistant in coordinates of a metre.
  double rounding = 1e-9;
  // A self-crossing or bow tie of the contour smaller than this counts as touching, so much of a
  // gap between two blocks that reverse as the same way back, and walls as parallel (D-44): how
  // finely programs are written. The operator may set it.
  double input_resolution = 1e-3;
  // Passes programmed on top of each other are as far apart as their coordinates are rounded: up to
  // four decimals of an inch. That is a touch (D-38).
  double on_top = 0.004;
  // A smaller turn is no corner. At R = 1000 mm the joint is off by 5e-12 mm.
  double tangent = 1e-7;
  // So near to 180 degrees a turn with a side change is a reversal: 0.001 degrees (D-23).
  double reversal = 1.75e-5;
  // Coordinates and radii beyond this are refused (90133, 90134): up to here a
  // double resolves four digits below `same_point`.
  double largest_coordinate = 1e6;
  // mm/min; feeds beyond this are refused, that of a path never is (D-31): up to
  // here a feed can be written with any number of decimals.
  double largest_feed = 1e9;
};

static_assert(Tolerances{}.same_point < Tolerances{}.on_contour);
static_assert(Tolerances{}.rounding < Tolerances{}.passable);
static_assert(Tolerances{}.passable < Tolerances{}.clearance);

}  // namespace trc
