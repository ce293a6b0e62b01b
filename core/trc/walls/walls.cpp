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

double Walls::touch_between(std::size_t number, std::size_t path) const {
  const auto meet = [&](const Range& begin) {
    return (begin.holds(number) && tail.holds(path)) || (tail.holds(number) && begin.holds(path));
  };
  // Of several laps the end lies on the begin of the last one, which may be within the tail.
  const bool at_last_ring = !rings.empty() && (meet({rings.back(), rings.back() + 2}) ||
                                               (tail.holds(number) && tail.holds(path)));
  const bool at_closing = meet(head) || at_last_ring;
  const bool on_top = !rings.empty() && ring_of(number) > ring_of(path);
  return std::max(at_closing ? touch : 0, on_top ? touch_of_rings : 0);
}

}  // namespace trc
