#include "core/trc/walls/left_out.h"

#include <cstddef>

namespace trc {
namespace {

// One by one: an initializer list would copy the values.
void give_values(const LeftOut& stretch, Diagnostic& found) {
  constexpr std::size_t most = 9;  // two places of three each, and three lengths
  found.values.reserve(most);
  append_place(found.values, "first", stretch.first);
  append_place(found.values, "last", stretch.last);
  found.values.push_back({"tool_radius", stretch.tool_radius});
  // Leads and blocks without a length are no walls; rounding may leave this much of the sum.
  constexpr double nothing = 1e-9;  // mm
  if (stretch.length > nothing) found.values.push_back({"left_out_length", stretch.length});
  if (stretch.of_walls > 0) found.values.push_back({"wall_length", stretch.of_walls});
}

// The number of rings without those that link two laps; the last ring may begin with its own lead.
std::size_t laps_of(const Walls& walls) {
  std::size_t laps = walls.rings.size() + 1;
  for (std::size_t ring = 0; ring + 1 < walls.rings.size(); ++ring)
    if (walls.is_lead(walls.rings[ring])) --laps;
  return laps;
}

}  // namespace

bool LeftOut::is_long() const {
  constexpr double tool_radii = 10;
  return length > tool_radii * tool_radius;
}

void LeftOut::add(const LeftOut& other) {
  const double all = in_all + (other.is_long() ? other.length : 0);
  if (other.length > length) *this = other;
  in_all = all;
}

bool holds_a_lap(const Walls& walls, std::size_t first, std::size_t last, const LeftOut& stretch) {
  const double lap = stretch.of_walls / static_cast<double>(laps_of(walls));
  if (!walls.rings.empty() && stretch.length > 0.9 * lap) return true;
  // Of a few blocks nearly all may lie in one notch; laps that are not found are one long contour.
  return walls.goes_round(first, last) && stretch.length > 0.1 * lap;
}

Diagnostic note_of(const LeftOut& stretch) {
  Diagnostic note = diagnostic(Code::blocks_masked, stretch.first);
  if (stretch.is_long() || stretch.is_a_part) note.severity = Severity::warning;
  give_values(stretch, note);
  return note;
}

Diagnostic refusal_of(const LeftOut& stretch, std::optional<double> largest_share) {
  Diagnostic refusal = diagnostic(Code::most_left_out, stretch.first);
  give_values(stretch, refusal);
  if (stretch.in_all > stretch.length)
    refusal.values.push_back({"left_out_in_all", stretch.in_all});
  if (largest_share) refusal.values.push_back({"max_masked_share", *largest_share});
  return refusal;
}

}  // namespace trc
