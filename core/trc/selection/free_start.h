#pragma once

#include <optional>
#include <span>
#include <utility>

#include "core/base/checkpoint.h"
#include "core/geometry/segment.h"
#include "core/nc/state/block.h"
#include "core/trc/setup.h"

namespace trc::selection {

// Looks for a start point of a G238 selection that is far enough from the contour, from which the
// tool reaches the contour without touching it, and which is near the programmed point: first in
// wider and wider rings about that point, then around the first free place for a nearer one.
class FreeStart {
 public:
  struct Question {
    std::span<const MotionBlock> contour{};
    Line way{};                    // as programmed, to the corner of the contour
    Point target = Point::Zero();  // where the tool is to come to
    double shift = 0;              // mm to the left of the contour; negative: right
    bool on_tool_side = false;     // of the first block
    double step = 1e-3;            // coordinates of the point are multiples of it
  };

  FreeStart(const Question& question, const CompensatorSetup& setup)
      : asked_(question), tolerances_(setup.tolerances), checkpoint_(setup.interrupt) {}

  [[nodiscard]] std::optional<Point> find() const;

 private:
  struct Place {
    double angle = 0;     // about the programmed point
    double distance = 0;  // from it, mm
  };

  [[nodiscard]] bool is_free(const Point& start) const;
  [[nodiscard]] bool is_free(const Place& place) const { return is_free(point_at(place)); }
  [[nodiscard]] Point point_at(const Place& place) const;
  [[nodiscard]] std::optional<Place> first_ring() const;
  // Goes on in steps of this angle as long as that leads nearer.
  [[nodiscard]] Place turned(Place place, double step) const;
  // Moves the place nearer as long as its way stays free.
  [[nodiscard]] Place drawn_near(Place place) const;

  Question asked_;
  Tolerances tolerances_;
  mutable Checkpoint checkpoint_;
};

}  // namespace trc::selection
