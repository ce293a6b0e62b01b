#include "core/trc/walls/long_leads.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/geometry/along.h"
#include "core/geometry/segment.h"
#include "core/trc/walls/outline.h"
#include "core/trc/walls/scratch.h"

namespace trc {
namespace {

// Including the blocks of an overrun.
constexpr std::size_t most_lead_blocks = 4;
// In a contour with no more blocks than this, any number may be leads: chords of arcs.
constexpr std::size_t few_blocks = 400;
// Cosine of the largest turn of a line that goes straight on, 1 degree.
constexpr double straight_on = 0.99984;
// Directions within this angle are the same, rad: 1 degree.
constexpr double same_direction = std::numbers::pi / 180;

// A lead beside the contour is an arc, or a line that goes straight on into it or out of it: as a
// wall such a line would have the contour behind it.
bool leads_into(const Segment& lead, const Segment& contour) {
  return is_arc(lead) || tangent_at_end(lead).dot(tangent_at_start(contour)) > straight_on;
}
bool leads_out_of(const Segment& contour, const Segment& lead) {
  return is_arc(lead) || tangent_at_end(contour).dot(tangent_at_start(lead)) > straight_on;
}

// Whether a lead begins where the contour closes, at once or after an overrun of blocks that end
// where the first ones do.
bool is_left_by_lead(const ContourView& contour, const EndsMeeting& closing, double tolerance) {
  std::size_t wall = closing.first.number;
  if (closing.first.along > contour.tolerances.same_place) ++wall;
  for (std::size_t number = closing.second.number + 1; number < contour.count; ++number, ++wall) {
    const Segment out = contour.segment(number);
    if ((end_of(out) - end_of(contour.segment(wall))).norm() > tolerance)
      return leads_out_of(contour.segment(number - 1), out);
  }
  return false;
}

// The directions into the closing and out of it; empty if the contour begins or ends there.
std::optional<Vector> into(const ContourView& contour, const ContourPlace& place) {
  if (place.along > contour.tolerances.same_place)
    return tangent_along(contour.segment(place.number), place.along);
  if (place.number == 0) return std::nullopt;
  return tangent_at_end(contour.segment(place.number - 1));
}
std::optional<Vector> out_of(const ContourView& contour, const ContourPlace& place) {
  const Segment block = contour.segment(place.number);
  if (place.along < length_of(block) - contour.tolerances.same_place)
    return tangent_along(block, place.along);
  if (place.number + 1 == contour.count) return std::nullopt;
  return tangent_at_start(contour.segment(place.number + 1));
}

// Whether the way in and the way out cross where the contour closes, as leads in the space of the
// tool do: as walls, each would bar the tool from the other end of the ring. If one is missing, the
// other one bars the tool within the half turn that the tool needs there.
bool cross_as_leads(const ContourView& contour, const EndsMeeting& closing) {
  constexpr double turn = 2 * std::numbers::pi;
  const auto along = out_of(contour, closing.first);
  const auto back = into(contour, closing.second);
  const auto in = into(contour, closing.first);
  const auto out = out_of(contour, closing.second);
  if (!along || !back || (!in && !out)) return false;
  // Angles through the space of the tool, from the beginning of the ring on.
  const double sign = contour.tool_side == Side::left ? 1 : -1;
  const auto angle_to = [&](const Vector& other) {
    const double angle = sign * std::atan2(cross(*along, other), along->dot(other));
    return angle < -same_direction ? angle + turn : std::max(angle, 0.0);
  };
  const double to_end = angle_to(-*back);
  const double half_turn = turn / 2 - same_direction;
  const double to_out = out ? angle_to(*out) : 0;
  const double to_in = in ? angle_to(-*in) : to_end;
  if (std::max(to_in, to_out) > to_end + same_direction) return false;
  if (!in) return to_out < half_turn;
  if (!out) return to_end - to_in < half_turn;
  return to_out < to_in;
}

bool go_straight_or_round(const ContourView& contour, const EndsMeeting& closing,
                          double tolerance) {
  const std::size_t first = closing.first.number;
  return first > 0 && first <= most_lead_blocks &&
         contour.count - 1 - closing.second.number <= most_lead_blocks &&
         leads_into(contour.segment(first - 1), contour.segment(first)) &&
         is_left_by_lead(contour, closing, tolerance);
}

}  // namespace

bool are_few_outside(const ContourView& contour, std::size_t first, std::size_t second) {
  return contour.count <= few_blocks ||
         (first <= most_lead_blocks && contour.count - 1 - second <= most_lead_blocks);
}

bool is_between_long_leads(const ContourView& contour, const EndsMeeting& closing,
                           const Extent& all, double tolerance, double tool_radius) {
  const auto is_end = [&](const ContourPlace& place) {
    return place.along <= contour.tolerances.same_place ||
           place.along >= length_of(contour.segment(place.number)) - contour.tolerances.same_place;
  };
  if (contour.tool_side == Side::off ||
      !are_few_outside(contour, closing.first.number, closing.second.number) ||
      !(is_end(closing.first) || is_end(closing.second)))
    return false;
  const bool is_plain = go_straight_or_round(contour, closing, tolerance);
  if (!is_plain && !cross_as_leads(contour, closing)) return false;
  const double shortest = std::max(10 * tolerance, is_plain ? 0 : tool_radius / 2);
  const Extent of_ring = extent_of_ring(contour, all, closing.first, closing.second);
  if (of_ring.length <= shortest) return false;
  const bool tool_is_outside = (of_ring.area > 0) != (contour.tool_side == Side::left);
  if (!is_plain && (!tool_is_outside || is_slender(of_ring))) return false;
  // If a lead is missing, the contour begins or ends on the ring itself.
  const bool has_in = into(contour, closing.first).has_value();
  const bool has_out = out_of(contour, closing.second).has_value();
  if (!has_in && !has_out) return true;
  Scratch scratch;
  Outline ring(scratch.memory());
  ring.append(contour, closing.first, closing.second);
  const Point begin = start_of(contour.segment(0));
  const Point end = end_of(contour.segment(contour.count - 1));
  return (!has_in || ring.has_on(contour.tool_side, begin)) &&
         (!has_out || ring.has_on(contour.tool_side, end));
}

}  // namespace trc
