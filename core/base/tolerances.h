#pragma once

namespace trc {

// The tolerances of geometry and the limits of accepted input. A constant that only bounds the
// rounding of one expression stands next to that expression and says so. The verification measures
// with numbers of its own. Lengths in mm, angles in rad.
struct Tolerances {
  // Closer than this is one point. A path that merges two such points is wrong
  // by less than a hundredth of the finest increment a control commands.
  double same_point = 1e-6;
  // Closer than this along a block of a contour is one place when its walls are looked for: a
  // stretch of this length may be taken for a lead, or for a wall, wrongly.
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
  // The loops themselves are looked for with this part of the radius, or of 1 mm: the error of
  // rounding in an equidistant at coordinates of a metre.
  double rounding = 1e-9;
  // The resolution of programs, which the operator may set (D-44). A self-crossing or bow tie
  // smaller than this counts as touching, two reversing blocks this close as the same way back, and
  // walls that diverge by less as parallel.
  double input_resolution = 1e-3;
  // Passes programmed on top of each other differ by the rounding of their coordinates, up to four
  // decimals of an inch. That counts as touching (D-38).
  double on_top = 0.004;
  // A smaller turn is no corner. At R = 1000 mm the joint is off by 5e-12 mm.
  double tangent = 1e-7;
  // A turn with a side change this close to 180 degrees is a reversal: 0.001 degrees (D-23).
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
