#include "core/nc/state/corner_cut.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trc {

std::optional<CutCorner> cut_corner(const Line& before, const Line& after, const CornerCut& cut,
                                    const Tolerances& tolerances) {
  const Vector first = before.end - before.start;
  const Vector second = after.end - after.start;
  const double shorter = std::min(first.norm(), second.norm());
  if (shorter <= tolerances.same_point) return {};
  const Vector in = first.normalized();
  const Vector out = second.normalized();
  const double turn = turn_between(in, out);
  constexpr double nearly_back = std::numbers::pi - 1e-3;
  if (std::abs(turn) > nearly_back) return {};
  double leg = cut.size;
  if (cut.form == CornerCut::Form::round) leg = cut.size * std::tan(std::abs(turn) / 2);
  if (cut.form == CornerCut::Form::width) leg = cut.size / (2 * std::cos(turn / 2));
  if (!(leg > tolerances.same_point && leg + tolerances.same_point < shorter)) return {};
  CutCorner corner{.end_before = before.end - leg * in, .start_after = after.start + leg * out};
  if (cut.form == CornerCut::Form::round) {
    const Vector to_center = turn > 0 ? left_of(in) : Vector(-left_of(in));
    corner.between = Arc{.start = corner.end_before,
                         .end = corner.start_after,
                         .center = corner.end_before + cut.size * to_center,
                         .sweep = turn};
  } else {
    corner.between = Line{.start = corner.end_before, .end = corner.start_after};
  }
  return corner;
}

}  // namespace trc
