#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/geometry/segment.h"

namespace trc::support {

// Programs of closed contours as CAM systems write them: one selection with G41, leads, overrun,
// laps. The tool is left of the contour.

// A closed contour from the point it begins in, mm.
struct CamContour {
  std::string name{};
  std::vector<Segment> ring{};
  double tool_radius = 2.5;
  std::size_t loops = 0;  // that are taken out of one lap
};
[[nodiscard]] std::vector<CamContour> cam_contours();
// About the origin, rad.
[[nodiscard]] CamContour turned(CamContour contour, double angle);

enum class Lead {
  none,
  line,          // oblique
  arc,           // a quarter circle along the contour
  line_and_arc,  // the same with a line square before it
  half_circle,
  square,     // a line square to the contour, in and out on the same way
  one_point,  // two lines each, from one point and back to it
  crossing,   // the same, but in and out cross
};
inline constexpr Lead all_leads[] = {Lead::none,         Lead::line,        Lead::arc,
                                     Lead::line_and_arc, Lead::half_circle, Lead::square,
                                     Lead::one_point,    Lead::crossing};
[[nodiscard]] std::string name_of(Lead lead);

enum class Overrun {
  none,
  along,  // of `overrun_length`
  over_a_corner,
  in_the_last_block,
};
inline constexpr Overrun all_overruns[] = {Overrun::none, Overrun::along, Overrun::over_a_corner,
                                           Overrun::in_the_last_block};
[[nodiscard]] std::string name_of(Overrun overrun);

enum class Laps {
  one,
  two,
  three,
  rough_and_finish,  // the second with its outside corners rounded
  depths,            // three, each deeper, without leads between
  depths_and_leads,  // three, with lead-out and lead-in between
};
[[nodiscard]] std::string name_of(Laps laps);

struct CamProgram {
  CamContour contour{};
  Lead in = Lead::none;
  Lead out = Lead::none;
  Overrun overrun = Overrun::none;
  double overrun_length = 1;  // mm, after the corner for one over a corner
  Laps laps = Laps::one;
  double size_of_leads = 2.2;  // tool radii
  double rounded_corners = 3;  // mm, of the finishing lap
  int decimals = 3;
  bool inch = false;
};

[[nodiscard]] std::string name_of(const CamProgram& program);
// `modes`: the lines before the selection, as "G141\n#TRC[REMOVE_MASKED_BLOCKS=1]".
[[nodiscard]] std::string text_of(const CamProgram& program, const std::string& modes);
// What the last lap goes round.
[[nodiscard]] std::vector<Segment> finished_ring(const CamProgram& program);
// Whether the overrun exists: one in the last block needs two lines in a row there.
[[nodiscard]] bool is_possible(const CamProgram& program);
// Whether the tool gets round each inside corner of its leads, no block there being shorter than
// what the corners take from it, and leads between two depths are short enough to be some (D-38).
[[nodiscard]] bool leaves_room(const CamProgram& program);
// The latter alone: a longer way is a ring of walls like the others.
[[nodiscard]] bool leads_between_are_short(const CamProgram& program);

}  // namespace trc::support
