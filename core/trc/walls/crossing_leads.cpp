#include "core/trc/walls/crossing_leads.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/along.h"

namespace trc {
namespace {

// Whether two blocks go on from each other without a corner.
bool is_smooth(const Segment& before, const Segment& behind) {
  constexpr double slight = 0.02;  // sine of the turn at which a corner begins
  const Vector in = tangent_at_end(before);
  const Vector out = tangent_at_start(behind);
  return in.dot(out) > 0 && std::abs(cross(in, out)) < slight;
}

// Length of the contour from the start of one block to a place behind it, mm.
double length_up_to(const ContourView& contour, std::size_t block, const ContourPlace& place) {
  double length = place.along;
  for (; block < place.number; ++block) length += length_of(contour.segment(block));
  return length;
}

// Whether the contour passes its begin at some distance, on its way to this meeting: there is the
// step, and the overrun then runs beside the first walls until it crosses them.
bool is_behind_a_step(const ContourView& contour, const EndsMeeting& meeting, double tolerance,
                      double tool_radius) {
  constexpr std::size_t most_blocks = 5;
  constexpr double most_steps = 10;  // lengths of the step within which it is an overrun's corner
  const double most_gap = std::min(20 * tolerance, 0.2 * tool_radius);
  const std::size_t last_few = contour.count - std::min(contour.count, most_blocks);
  for (std::size_t in = 0; in <= std::min(meeting.first.number, most_blocks - 1); ++in) {
    const Point begin = start_of(contour.segment(in));
    for (std::size_t out = std::max(last_few, meeting.first.number + 1);
         out <= meeting.second.number; ++out) {
      const double gap = (start_of(contour.segment(out)) - begin).norm();
      if (gap > tolerance && gap <= most_gap &&
          length_up_to(contour, in, meeting.first) > most_steps * gap &&
          length_up_to(contour, out, meeting.second) > most_steps * gap)
        return true;
    }
  }
  return false;
}

}  // namespace

bool is_lead_across_walls(const ContourView& contour, const EndsMeeting& meeting, double tolerance,
                          double tool_radius) {
  constexpr double slight = 0.03;  // sine below which both run along each other, but for rounding
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
