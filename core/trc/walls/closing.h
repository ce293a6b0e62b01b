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
  // The side of the contour that its path is on, left where positive; 0: bow ties are not looked
  // for.
  double shift = 0;
  // The tool side; off: unknown, and leads longer than the contour are not looked for.
  Side tool_side = Side::off;
  // Start and end of every block differ by at least this on one of the axes, mm.
  double shortest_step = 0;
  Tolerances tolerances{};
  // Passed while the contour is examined; null: the work cannot be interrupted.
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

// Where a contour comes back to its start (D-38).
struct Closing {
  ContourPlace first{};   // after it the walls begin
  ContourPlace second{};  // here they end
  Point point = Point::Zero();
  // Largest distance between the two, mm, from where the end of the contour joins its start.
  double gap = 0;
  std::size_t joins = 0;  // the first block at the end that lies on the start
  bool is_alone = false;  // between the two the contour does not return to this place
  // The number of times that the contour repeats one lap with its leads: each lap is followed by
  // the leads to the next one (D-107).
  std::size_t repeated_laps = 0;
  // Whole turns lead in, or out (D-106).
  bool has_turns_in = false;
  bool has_turns_out = false;

  // The start of an overrun: where the contour first comes back.
  struct Overrun {
    ContourPlace first{};
    ContourPlace second{};
    Point point = Point::Zero();
  };
  std::optional<Overrun> overrun{};
};

// The meeting of the ends that is latest on the first blocks, such that half of the contour lies
// between. Leads that cross or begin in one point do not hide the start of the contour, and a
// second lap is not taken for a lead. O(n log n).
//
// Without such a meeting the leads may be longer than the contour, as about a small boss: a ring
// counts whatever its share if few blocks lead to it and from it by arcs, on the side of the tool,
// and a block ends on it. A loop at a corner lies on the other side.
[[nodiscard]] std::optional<Closing> find_closing(const ContourView& contour,
                                                  double closing_tolerance, double tool_radius);

// The closing of a ring whose leads may be longer than the ring.
[[nodiscard]] std::optional<Closing> find_closing_of_long_leads(const ContourView& contour,
                                                                double closing_tolerance,
                                                                double tool_radius);

// The walls of a contour. `tool_radius`: the largest one, mm.
[[nodiscard]] Walls find_walls(const ContourView& contour, const LeadSettings& settings,
                               double tool_radius);

}  // namespace trc
