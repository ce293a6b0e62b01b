#pragma once

#include <optional>
#include <span>
#include <utility>

#include "core/base/checkpoint.h"
#include "core/geometry/segment.h"
#include "core/nc/state/block.h"
#include "core/trc/setup.h"

namespace trc::selection {

// Looks for a start point of a G238 selection that is far enough from the contour, from where the
// tool comes to it without touching it, and which is near to the point programmed: in rings about
// that, wider and wider, and then along the first free place for one that is nearer.
class FreeStart {
 public:
  struct Question {
    std::span<const MotionBlock> contour{};
    Line way{};                    // as programmed, to the corner of the contour
    Point target = Point::Zero();  // where the tool is to come to
    double shift = 0;              // mm to the left of the contour; negative: right
    bool on_tool_side = false;     // of the first block
    double step = 1e-3;            // the point has whole ones of it as coordinates
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
  // On in steps of this angle as long as that leads nearer.
  [[nodiscard]] Place turned(Place place, double step) const;
  // As near as the way there stays free.
  [[nodiscard]] Place drawn_near(Place place) const;

  Question asked_;
  Tolerances tolerances_;
  mutable Checkpoint checkpoint_;
};

}  // namespace trc::selection
