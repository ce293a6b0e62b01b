#include "core/trc/walls/walls.h"

#include <algorithm>

namespace trc {

bool Walls::is_lead(std::size_t number) const {
  const auto behind = std::partition_point(leads.begin(), leads.end(),
                                           [&](const Range& range) { return range.end <= number; });
  return behind != leads.end() && behind->holds(number);
}

std::optional<Walls::Part> Walls::part_of(std::size_t number) const {
  const auto found = std::partition_point(parts.begin(), parts.end(),
                                          [&](const Part& part) { return part.number < number; });
  if (found == parts.end() || found->number != number) return std::nullopt;
  return *found;
}

std::size_t Walls::ring_of(std::size_t number) const {
  return static_cast<std::size_t>(std::upper_bound(rings.begin(), rings.end(), number) -
                                  rings.begin());
}

bool Walls::goes_round(std::size_t from, std::size_t to) const {
  if (to <= from || tail.first == tail.end) return false;
  const std::size_t begin = head.end - std::min<std::size_t>(head.end, 2);
  if (rings.empty()) {
    const std::size_t lap = blocks_per_lap > 0 ? blocks_per_lap : tail.first + 1 - begin;
    return from < head.end && to >= tail.first && to - from + 1 >= lap;
  }
  // The last lap has as many blocks as the lap before it; rings that link laps do not count.
  std::size_t ring = std::min(ring_of(from), rings.size() - 1);
  while (ring > 0 && is_lead(rings[ring - 1])) --ring;
  return to - from + 1 >= rings[ring] - (ring > 0 ? rings[ring - 1] : begin);
}

void Walls::move_by(std::size_t blocks) {
  for (Range* range : {&head, &tail, &turns_in, &turns_out}) {
    if (range->first == range->end) continue;
    range->first += blocks;
    range->end += blocks;
  }
  for (Range& range : leads) range = {range.first + blocks, range.end + blocks};
  for (Part& part : parts) part.number += blocks;
  for (std::size_t& ring : rings) ring += blocks;
}

double Walls::touch_between(std::size_t number, std::size_t path) const {
  const auto meet = [&](const Range& begin, const Range& end) {
    return (begin.holds(number) && end.holds(path)) || (end.holds(number) && begin.holds(path));
  };
  double most = meet(head, tail) ? touch : 0;
  const bool is_of_turns = turns_in.holds(path) || turns_out.holds(path);
  if (is_of_turns && (head.holds(number) || tail.holds(number)))
    most = std::max(most, touch_of_turns);
  if (rings.empty()) return most;
  // With several laps, the end lies on the beginning of the last one, which may be in the tail.
  const auto begin_of = [&](std::size_t ring) {
    if (ring == 0) return head;
    const std::size_t first = rings[ring - 1];
    return Range{first, first + 2 + overrun_blocks + start_blocks_passed};
  };
  if (meet(begin_of(rings.size()), tail) || meet(tail, tail)) most = std::max(most, touch);
  const std::size_t ring = ring_of(path);
  const std::size_t of_wall = ring_of(number);
  // Each earlier lap ends on its beginning too, by its own overrun.
  const auto end_of = [&](std::size_t lap) {
    return Range{rings[lap] - std::min(rings[lap], 3 + overrun_blocks), rings[lap]};
  };
  if (is_of_turns && (begin_of(of_wall).holds(number) ||
                      (of_wall < rings.size() && end_of(of_wall).holds(number))))
    most = std::max(most, touch_of_turns);
  if (of_wall > ring) return std::max(most, touch_of_rings);
  if (of_wall < ring || ring == rings.size()) return most;
  return meet(begin_of(ring), end_of(ring)) ? std::max(most, touch_of_rings) : most;
}

}  // namespace trc
