#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "core/verify/clearance.h"
#include "core/verify/measured_path.h"

namespace trc::verify {

// What is told of the worst place, and what is looked for below the least margin that was seen, are
// each exact to half of it.
inline constexpr double half_resolution = margin_resolution / 2;  // mm

// The least margins of a path that were seen, piece by piece.
class Margins {
 public:
  // A wall near to the path.
  struct Near {
    double distance = 0;
    double required = 0;
    double touch = 0;  // so much nearer than that is no gouge, mm
    Point point = Point::Zero();
    Source wall{};
  };

  // `allowed`: how much nearer than required the path may come, mm.
  Margins(const MeasuredPath& held, double allowed) : held_(held), allowed_(allowed) {}

  void begin_piece() { gouges_ = false; }
  // Something of the piece does.
  [[nodiscard]] bool gouges() const { return gouges_; }
  // mm. A margin from here on changes nothing of what is told.
  [[nodiscard]] double of_interest() const {
    const double of_gouge =
        gouges_ ? std::min(least_gouge_ - half_resolution, -allowed_) : -allowed_;
    return std::max(least_ - half_resolution, of_gouge);
  }
  // Of any piece, before something of it has been found.
  [[nodiscard]] double widest_of_interest() const {
    return std::max(least_ - half_resolution, -allowed_);
  }
  void note(const MeasuredPiece& path, const Near& near);

  [[nodiscard]] const std::optional<Clearance>& worst() const { return worst_; }
  [[nodiscard]] const std::optional<Clearance>& gouge() const { return gouge_; }

 private:
  [[nodiscard]] Clearance clearance_of(const MeasuredPiece& path, const Near& near) const;

  const MeasuredPath& held_;
  double allowed_;
  bool gouges_ = false;
  double least_ = std::numeric_limits<double>::infinity();        // margin that was seen, mm
  double least_gouge_ = std::numeric_limits<double>::infinity();  // of a gouge, mm
  std::optional<Clearance> worst_{};
  std::optional<Clearance> gouge_{};
};

}  // namespace trc::verify
