#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "core/base/checkpoint.h"
#include "core/base/tolerances.h"
#include "core/geometry/segment.h"
#include "core/nc/state/block.h"
#include "core/trc/lead_settings.h"
#include "core/trc/walls/walls.h"

namespace trc {

// The blocks of a contour that move in the plane, in order, approach and retract not among them.
struct ContourView {
  std::size_t count = 0;
  std::function<Segment(std::size_t number)> segment{};
  std::function<ContourRole(std::size_t number)> role{};  // empty: no block is marked
  // To which side of the contour its path is, left of it where positive; 0: bow ties are not
  // looked for.
  double shift = 0;
  // Where the tool cuts; off: nobody knows, and leads longer than the contour are not looked for.
  Side tool_side = Side::off;
  double length = 0;  // of all blocks, mm; 0: it has not been measured
  // Start and end of no block are nearer than that to each other along both axes, mm.
  double shortest_step = 0;
  Tolerances tolerances{};
  // Passed by while the contour is looked at; null: it is looked at in one go.
  Checkpoint* checkpoint = nullptr;

  void pass() const {
    if (checkpoint != nullptr) checkpoint->pass();
  }
};

// A place on a contour block.
struct ContourPlace {
  std::size_t number = 0;
  double along = 0;  // mm from the start of the block

  bool operator==(const ContourPlace&) const = default;
};

// A place where one of the last blocks of a contour meets one of the first ones.
struct EndsMeeting {
  ContourPlace first{};
  ContourPlace second{};
  double before = 0;  // mm of contour
  double behind = 0;
  double gap = 0;  // how far apart they are there, mm
  Point point = Point::Zero();

  bool operator==(const EndsMeeting&) const = default;
};

// Where a contour comes back to its begin (D-38).
struct Closing {
  ContourPlace first{};   // behind it the walls begin
  ContourPlace second{};  // here they end
  Point point = Point::Zero();
  // How far the two are apart, mm, at most, from where the end of the contour joins its begin.
  double gap = 0;
  std::size_t joins = 0;  // the first block at the end that lies on the begin
  bool is_alone = false;  // between the two the contour does not come by there
  // How many times the contour goes over one lap with one set of leads: behind each lap comes what
  // leads to the next one (D-107).
  std::size_t repeated_laps = 0;
  // Whole turns lead in, or out (D-106).
  bool has_turns_in = false;
  bool has_turns_out = false;

  // Where an overrun begins, that is where the contour first comes back.
  struct Overrun {
    ContourPlace first{};
    ContourPlace second{};
    Point point = Point::Zero();
  };
  std::optional<Overrun> overrun{};
};

// Of the meetings of the ends the one that is latest on the first blocks, so that half of the
// contour lies between. Leads that cross or begin in one point do not hide the
// start of the contour, and a second lap does not pass for one. n log n.
//
// Where there is none the leads may be longer than the contour, as about a small boss: a ring
// counts whatever its share where few blocks lead to it and from it by arcs, on the side of the
// tool, and a block ends on it. A loop at a corner lies on the other side.
[[nodiscard]] std::optional<Closing> find_closing(const ContourView& contour,
                                                  double closing_tolerance, double tool_radius);

// That of a ring between leads that may be longer than it is.
[[nodiscard]] std::optional<Closing> find_closing_of_long_leads(const ContourView& contour,
                                                                double closing_tolerance,
                                                                double tool_radius);

// What of a contour is a wall. `tool_radius`: the largest one, mm.
[[nodiscard]] Walls find_walls(const ContourView& contour, const LeadSettings& settings,
                               double tool_radius);

}  // namespace trc
