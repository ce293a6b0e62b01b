#pragma once

#include <cmath>
#include <optional>
#include <variant>

#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/trc/path_block.h"

namespace trc {

// Neither coordinate is larger than the limit, mm.
[[nodiscard]] inline bool is_within(const Point& point, double limit) {
  return std::abs(point.x()) <= limit && std::abs(point.y()) <= limit;
}

// Contour violations, mm and rad as in PathBlock. A line that runs against its tangent:
[[nodiscard]] inline bool runs_back(const Vector& travelled, const Vector& tangent,
                                    const Tolerances& tolerances) {
  return travelled.dot(tangent) < -tolerances.on_contour;
}
// An arc whose corners take more than the whole of its equidistant with this radius:
[[nodiscard]] inline bool is_consumed(double left, double radius, const Tolerances& tolerances) {
  return left * radius < -tolerances.on_contour;
}
// The code for the first coordinate of the path out of range (90133, 90134), or nothing.
[[nodiscard]] inline std::optional<Code> out_of_range(const Line& path,
                                                      const Tolerances& tolerances) {
  if (!is_within(path.end, tolerances.largest_coordinate)) return Code::end_point_out_of_range;
  return std::nullopt;
}
[[nodiscard]] inline std::optional<Code> out_of_range(const Arc& path,
                                                      const Tolerances& tolerances) {
  const double limit = tolerances.largest_coordinate;
  if (!is_within(path.end, limit)) return Code::end_point_out_of_range;
  if (!is_within(path.center, limit)) return Code::center_out_of_range;
  return std::nullopt;
}
[[nodiscard]] inline std::optional<Code> out_of_range(const Segment& path,
                                                      const Tolerances& tolerances) {
  const auto* arc = std::get_if<Arc>(&path);
  return arc != nullptr ? out_of_range(*arc, tolerances)
                        : out_of_range(std::get<Line>(path), tolerances);
}

// Finds contour violations: a compensated line that runs against the programmed
// one (90019), an arc that has been consumed and wraps round (90038). G140 stops
// there; with IGNORE_CONT_DAMAGE the path is put out as computed and the
// violation is a warning (D-12). Lengths up to the tolerance are none (D-13, D-14).
//
// Sees a block with its two neighbours, as the reference control does: a
// bottleneck between blocks further apart is not found.
class ContourViolations {
 public:
  ContourViolations(const Tolerances& tolerances, Diagnostics& diagnostics)
      : tolerances_(tolerances), diagnostics_(diagnostics) {}

  bool apply(PathBlock& block);

 private:
  bool check_line(const PathBlock& block);
  bool check_arc(const PathBlock& block, const Arc& programmed);
  bool check_range(const PathBlock& block);
  bool report_reversed(const PathBlock& block, double along);
  bool report_wrapped(const PathBlock& block, double left, double sweep);
  bool report_out_of_range(const PathBlock& block, Code code);
  // Reports the violation with the width of the place, if that is known.
  bool report(Diagnostic violation, const PathBlock& block);

  Tolerances tolerances_;
  Diagnostics& diagnostics_;
};

}  // namespace trc
