#include "core/trc/walls/laps.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/along.h"
#include "core/trc/walls/extent.h"
#include "core/trc/walls/outline.h"
#include "core/trc/walls/scratch.h"

namespace trc {
namespace {

constexpr std::size_t most_lead_blocks = 8;
// Number of places that decide whether a ring goes over another one.
constexpr int probes = 8;

}  // namespace

Laps::Laps(const ContourView& contour, const Closing& closing, double tolerance,
           std::pmr::memory_resource* memory)
    : contour_(contour),
      near_(2 * (tolerance + closing.gap)),
      visits_(visits_of(contour, closing, tolerance, memory)),
      longest_(longest_ring(visits_)),
      are_leads_(visits_.size(), false, memory) {
  if (closing.repeated_laps > 0 && visits_.size() == 2 * closing.repeated_laps) {
    for (std::size_t ring = 2; ring < visits_.size(); ring += 2) are_leads_[ring] = true;
    return;
  }
  std::size_t lap = 0;
  Neighbours about{};
  for (std::size_t ring = 1; ring < visits_.size() && visits_.size() > 2; ++ring) {
    find_neighbours(ring, about);
    are_leads_[ring] = leads_on(ring, about);
    if (are_leads_[ring]) continue;
    last_one_finishes_ = false;
    if (lap > 0 && !goes_over(ring, lap)) {
      last_one_finishes_ = finishes(ring, lap);
      go_over_one_another_ = go_over_one_another_ && last_one_finishes_;
    }
    lap = ring;
  }
}

bool Laps::is_short(std::size_t ring) const {
  return length_of_ring(ring) < share_of_lead_ring * longest_;
}

// Many short rings may lie between two long ones.
void Laps::find_neighbours(std::size_t ring, Neighbours& about) const {
  const Neighbours known = about;
  if (ring > 1 && !is_short(ring - 1)) about.before = ring - 1;
  about.behind = std::max(about.behind, ring + 1);
  while (about.behind < visits_.size() && is_short(about.behind)) ++about.behind;
  if (about.before == known.before && about.behind == known.behind) return;
  about.are_one_lap =
      about.before > 0 && about.behind < visits_.size() && goes_over(about.behind, about.before);
}

bool Laps::leads_on(std::size_t ring, const Neighbours& about) const {
  const std::size_t blocks = visits_[ring].place.number - visits_[ring - 1].place.number;
  if (blocks > most_lead_blocks) return false;
  const std::size_t before = about.before;
  if (is_short(ring))
    return about.are_one_lap || side_of(ring, before > 0 ? before : about.behind) >= 0;
  return about.are_one_lap && length_of_ring(ring) < length_of_ring(before) &&
         length_of_ring(ring) < length_of_ring(about.behind) && !goes_over(ring, before) &&
         side_of(ring, before) > 0;
}

int Laps::side_of(std::size_t ring, std::size_t lap) const {
  if (contour_.tool_side == Side::off) return 0;
  Scratch scratch;
  Outline around(scratch.memory());
  around.append(contour_, visits_[ring - 1].place, visits_[ring].place);
  if (is_slender({.length = length_of_ring(ring), .area = around.area()})) return 0;
  if ((around.area() > 0) != (contour_.tool_side == Side::left)) return -1;
  Outline of_lap(scratch.memory());
  of_lap.append(contour_, visits_[lap - 1].place, visits_[lap].place);
  const double half = visits_[ring - 1].way + 0.5 * length_of_ring(ring);
  const auto [number, along] = place_at(half, visits_[ring - 1]);
  return of_lap.has_on(contour_.tool_side, point_along(contour_.segment(number), along)) ? 1 : -1;
}

ContourPlace Laps::place_at(double way, const Visit& from) const {
  ContourPlace place = from.place;
  way += place.along - from.way;
  for (; place.number + 1 < contour_.count; ++place.number) {
    contour_.pass();
    const double length = length_of(contour_.segment(place.number));
    if (way <= length) break;
    way -= length;
  }
  place.along = way;
  return place;
}

bool Laps::goes_over(std::size_t ring, std::size_t earlier) const {
  Visit from = visits_[ring - 1];
  int on_it = 0;
  for (int probe = 0; probe < probes; ++probe) {
    const double way = visits_[ring - 1].way + length_of_ring(ring) * (probe + 0.5) / probes;
    from = {.place = place_at(way, from), .way = way};
    const auto& [number, along] = from.place;
    const std::size_t guess =
        visits_[earlier - 1].place.number + number - visits_[ring - 1].place.number;
    if (comes_by(earlier, point_along(contour_.segment(number), along), guess)) ++on_it;
  }
  return 2 * on_it >= probes;
}

bool Laps::finishes(std::size_t ring, std::size_t earlier) const {
  if (contour_.tool_side == Side::off) return false;
  const auto outline_of = [&](std::size_t number, Outline& outline) {
    outline.append(contour_, visits_[number - 1].place, visits_[number].place);
  };
  Scratch scratch;
  Outline finished(scratch.memory());
  Outline roughed(scratch.memory());
  outline_of(ring, finished);
  outline_of(earlier, roughed);
  if ((finished.area() > 0) != (roughed.area() > 0)) return false;
  // Where the laps meet, neither is behind the other one: there they are as near as a visit.
  const auto lies_on = [&](Side side, const Outline& outline, std::size_t probed,
                           std::size_t other) {
    Visit from = visits_[probed - 1];
    for (int probe = 0; probe < probes; ++probe) {
      const double way = visits_[probed - 1].way + length_of_ring(probed) * (probe + 0.5) / probes;
      from = {.place = place_at(way, from), .way = way};
      const auto& [number, along] = from.place;
      const Point point = point_along(contour_.segment(number), along);
      const bool is_on = outline.has_on(contour_.tool_side, point) == (side == contour_.tool_side);
      if (!is_on && !comes_by(other, point, visits_[other - 1].place.number)) return false;
    }
    return true;
  };
  return lies_on(contour_.tool_side, finished, earlier, ring) &&
         lies_on(opposite(contour_.tool_side), roughed, ring, earlier);
}

bool Laps::comes_by(std::size_t ring, const Point& point, std::size_t guess) const {
  const ContourPlace& begin = visits_[ring - 1].place;
  const ContourPlace& end = visits_[ring].place;
  const auto is_near = [&](std::size_t number) {
    if (number < begin.number || number > end.number) return false;
    contour_.pass();
    const Segment segment = contour_.segment(number);
    const double along = nearest_along(segment, point);
    const bool is_of_ring = (number > begin.number || along > begin.along) &&
                            (number < end.number || along < end.along);
    return is_of_ring && (point_along(segment, along) - point).norm() <= near_;
  };
  const std::size_t middle = std::clamp(guess, begin.number, end.number);
  for (std::size_t aside = 0; aside <= end.number - begin.number; ++aside)
    if ((aside <= middle && is_near(middle - aside)) || is_near(middle + aside)) return true;
  return false;
}

}  // namespace trc
