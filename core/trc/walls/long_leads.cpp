#include "core/trc/walls/long_leads.h"

#include <variant>

#include "core/geometry/along.h"
#include "core/trc/walls/outline.h"
#include "core/trc/walls/scratch.h"

namespace trc {
namespace {

// With what an overrun goes over.
constexpr std::size_t most_lead_blocks = 4;
// Up to here two places on a contour are one, mm.
constexpr double same_place = 1e-7;

// Whether an arc leads away from where the contour closes, at once or behind an overrun of blocks
// that end where the first ones do.
bool leaves_by_arc(const ContourView& contour, const EndsMeeting& closing, double tolerance) {
  std::size_t wall = closing.first.number;
  if (closing.first.along > same_place) ++wall;
  for (std::size_t number = closing.second.number + 1; number < contour.count; ++number, ++wall) {
    const Segment out = contour.segment(number);
    if ((end_of(out) - end_of(contour.segment(wall))).norm() > tolerance) return is_arc(out);
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
  // Straight on, the first and the last block may be walls that a circle stands beside.
  if (closing.first.number == 0 ||
      !std::holds_alternative<Arc>(contour.segment(closing.first.number - 1)) ||
      !leaves_by_arc(contour, closing, tolerance))
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
