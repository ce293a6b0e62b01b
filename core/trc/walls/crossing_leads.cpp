#include "core/trc/walls/crossing_leads.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/along.h"

namespace trc {
namespace {

// Whether two blocks go on from each other without a corner.
bool is_smooth(const Segment& before, const Segment& behind) {
  // Sine of the turn at which a corner begins: three decimals turn blocks of 0.15 mm against each
  // other by 2 · 1.41 µm / 0.15 mm, which is less.
  constexpr double slight = 0.02;
  const Vector in = tangent_at_end(before);
  const Vector out = tangent_at_start(behind);
  return in.dot(out) > 0 && std::abs(cross(in, out)) < slight;
}

// Whether the contour misses its start by a step: one of its leads then runs beside the walls, the
// lead-out beside the first ones or the lead-in beside the last ones, and crosses them here.
bool is_behind_a_step(const ContourView& contour, const EndsMeeting& meeting, double tolerance,
                      double tool_radius) {
  constexpr std::size_t most_blocks = 5;
  // A crossing no farther from the step than this many times its width only cuts off a corner.
  constexpr double least_widths = 10;
  const double widest = std::min(20 * tolerance, 0.2 * tool_radius);
  // Both lengths are those of the contour between the step and the crossing.
  const auto is_step = [&](const Point& in, const Point& out, double along_in, double along_out) {
    const double step = (out - in).norm();
    const double shortest = least_widths * step;
    return step > tolerance && step <= widest && along_in > shortest && along_out > shortest;
  };
  const std::size_t last_few = contour.count - std::min(contour.count, most_blocks);
  double before = 0;
  for (std::size_t in = 0; in < std::min(contour.count, most_blocks); ++in) {
    const Segment first = contour.segment(in);
    const double behind_first = before + length_of(first);
    double behind = 0;
    for (std::size_t out = contour.count; out-- > std::max(last_few, in + 1);) {
      const Segment last = contour.segment(out);
      const double before_last = behind + length_of(last);
      if (is_step(start_of(first), start_of(last), meeting.before - before,
                  before_last - meeting.behind) ||
          is_step(end_of(first), end_of(last), behind_first - meeting.before,
                  meeting.behind - behind))
        return true;
      behind = before_last;
    }
    before = behind_first;
  }
  return false;
}

}  // namespace

bool is_lead_across_walls(const ContourView& contour, const EndsMeeting& meeting, double tolerance,
                          double tool_radius) {
  // Sine below which both run along each other, but for rounding: three decimals turn blocks of
  // 0.1 mm against each other by 2 · 1.41 µm / 0.1 mm, which is less.
  constexpr double slight = 0.03;
  constexpr std::size_t most_blocks = 2;
  const auto& [in, along_in] = meeting.first;
  const auto& [out, along_out] = meeting.second;
  const Segment first = contour.segment(in);
  const Segment last = contour.segment(out);
  const double left_in = length_of(first) - along_in;
  const double left_out = length_of(last) - along_out;
  if (std::min({along_in, along_out, left_in, left_out}) <= tolerance) return false;
  if (std::abs(cross(tangent_along(first, along_in), tangent_along(last, along_out))) < slight)
    return false;
  if (is_behind_a_step(contour, meeting, tolerance, tool_radius)) return true;
  const auto is_mostly_lead = [&](double wall, double lead) {
    return wall < lead && wall < 2 * tool_radius;
  };
  const bool leads_out = out + most_blocks >= contour.count && out > 0 &&
                         (is_mostly_lead(along_out, left_out) ||
                          (is_arc(last) && is_smooth(contour.segment(out - 1), last)));
  const bool leads_in =
      in < most_blocks && (is_mostly_lead(left_in, along_in) ||
                           (is_arc(first) && is_smooth(first, contour.segment(in + 1))));
  return leads_out || leads_in;
}

}  // namespace trc
