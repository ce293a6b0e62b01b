#include "core/trc/walls/long_leads.h"

#include "core/geometry/along.h"
#include "core/geometry/segment.h"
#include "core/trc/walls/outline.h"
#include "core/trc/walls/scratch.h"

namespace trc {
namespace {

// With what an overrun goes over.
constexpr std::size_t most_lead_blocks = 4;
// Up to here two places on a contour are one, mm.
constexpr double same_place = 1e-7;
// Cosine of the turn between a line and what it goes straight on into, 1 degree.
constexpr double straight_on = 0.99984;

// A lead beside the contour is an arc, or a line that goes straight on into it or out of it: as a
// wall that would have the contour behind it.
bool leads_into(const Segment& lead, const Segment& contour) {
  return is_arc(lead) || tangent_at_end(lead).dot(tangent_at_start(contour)) > straight_on;
}
bool leads_out_of(const Segment& contour, const Segment& lead) {
  return is_arc(lead) || tangent_at_end(contour).dot(tangent_at_start(lead)) > straight_on;
}

// Whether a lead begins where the contour closes, at once or behind an overrun of blocks that end
// where the first ones do.
bool is_left_by_lead(const ContourView& contour, const EndsMeeting& closing, double tolerance) {
  std::size_t wall = closing.first.number;
  if (closing.first.along > same_place) ++wall;
  for (std::size_t number = closing.second.number + 1; number < contour.count; ++number, ++wall) {
    const Segment out = contour.segment(number);
    if ((end_of(out) - end_of(contour.segment(wall))).norm() > tolerance)
      return leads_out_of(contour.segment(number - 1), out);
  }
  return false;
}

}  // namespace

bool are_few_outside(const ContourView& contour, std::size_t first, std::size_t second) {
  return first <= most_lead_blocks && contour.count - 1 - second <= most_lead_blocks;
}

bool is_between_long_leads(const ContourView& contour, const EndsMeeting& closing,
                           double tolerance) {
  const auto is_end = [&](const ContourPlace& place) {
    return place.along <= same_place ||
           place.along >= length_of(contour.segment(place.number)) - same_place;
  };
  const double shortest = 10 * tolerance;
  if (contour.tool_side == Side::off ||
      !are_few_outside(contour, closing.first.number, closing.second.number) ||
      !(is_end(closing.first) || is_end(closing.second)))
    return false;
  const std::size_t first = closing.first.number;
  if (first == 0 || !leads_into(contour.segment(first - 1), contour.segment(first)) ||
      !is_left_by_lead(contour, closing, tolerance))
    return false;
  double length = closing.second.along - closing.first.along;
  for (std::size_t number = closing.first.number; number < closing.second.number; ++number)
    length += length_of(contour.segment(number));
  if (length <= shortest) return false;
  Scratch scratch;
  Outline ring(scratch.memory());
  ring.append(contour, closing.first, closing.second);
  return ring.has_on(contour.tool_side, start_of(contour.segment(0))) &&
         ring.has_on(contour.tool_side, end_of(contour.segment(contour.count - 1)));
}

}  // namespace trc
