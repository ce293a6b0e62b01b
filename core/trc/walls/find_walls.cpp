#include <algorithm>
#include <array>
#include <cmath>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

#include "core/geometry/along.h"
#include "core/geometry/distance.h"
#include "core/trc/corner/bow_tie.h"
#include "core/trc/walls/closing.h"
#include "core/trc/walls/laps.h"
#include "core/trc/walls/scratch.h"

namespace trc {
namespace {

// Whether a block goes along the first few walls again, within the precision of the program.
bool is_overrun(const ContourView& contour, std::size_t number, std::size_t first_wall) {
  constexpr std::size_t few = 5;
  const Segment block = contour.segment(number);
  const Point middle = point_along(block, length_of(block) / 2);
  for (std::size_t wall = first_wall; wall < std::min(first_wall + few, number); ++wall)
    if (distance(middle, contour.segment(wall)) <= contour.tolerances.on_top) return true;
  return false;
}

// The closing between as many leads as the settings say.
Closing closing_between(const ContourView& contour, const LeadSettings& settings) {
  const std::size_t first = settings.blocks_in;
  const std::size_t last = contour.count - settings.blocks_out - 1;
  const Point begin = start_of(contour.segment(first));
  double gap = (end_of(contour.segment(last)) - begin).norm();
  if (settings.blocks_out > 0 && is_overrun(contour, last + 1, first))
    gap = std::max(gap, contour.tolerances.on_top);
  return {.first = {first, 0},
          .second = {last, length_of(contour.segment(last))},
          .point = begin,
          .gap = gap <= settings.closing_tolerance ? gap : 0,
          .joins = last};
}

std::optional<Closing> closing_of(const ContourView& contour, const LeadSettings& settings,
                                  double tool_radius) {
  switch (settings.find) {
    case LeadSettings::Find::automatic:
      return find_closing(contour, settings.closing_tolerance, tool_radius);
    case LeadSettings::Find::none:
      return std::nullopt;
    case LeadSettings::Find::counted:
      break;
  }
  if (settings.blocks_in >= contour.count ||
      settings.blocks_out >= contour.count - settings.blocks_in)
    return std::nullopt;
  return closing_between(contour, settings);
}

// Collects the leads of one contour.
class Leads {
 public:
  Leads(const ContourView& contour, std::pmr::memory_resource* memory)
      : contour_(contour),
        same_place_(contour.tolerances.same_place),
        ranges_(memory),
        parts_(memory),
        walls_(memory) {}

  void add_before(const ContourPlace& end) { add({0, 0}, end); }
  void add_behind(const ContourPlace& begin) { add(begin, {contour_.count, 0}); }
  // Adds all blocks between two places.
  void add(const ContourPlace& begin, const ContourPlace& end) {
    std::size_t first = begin.number;
    if (begin.along > same_place_) {
      if (begin.along < length_of(contour_.segment(first)) - same_place_)
        limit({.number = first, .from = 0, .to = begin.along});
      ++first;
    }
    std::size_t behind = end.number;
    if (end.along > same_place_ && end.number < contour_.count) {
      if (end.along < length_of(contour_.segment(behind)) - same_place_)
        limit({.number = behind, .from = end.along});
      else
        ++behind;
    }
    if (first < behind) ranges_.push_back({first, behind});
  }
  // A lap ends within a block: the part before its end is no wall for the next lap (D-100).
  void add_end_of_lap(const ContourPlace& end) { limit({.number = end.number, .from = end.along}); }
  void mark(std::size_t number, ContourRole role) {
    if (role == ContourRole::lead) ranges_.push_back({number, number + 1});
    if (role == ContourRole::wall) walls_.push_back(number);
  }

  void give_to(Walls& walls) {
    for (const Walls::Part& part : parts_)
      if (part.from >= part.to) ranges_.push_back({part.number, part.number + 1});
    std::sort(ranges_.begin(), ranges_.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const Walls::Range& range : ranges_) append(range, walls.leads);
    for (const std::size_t number : walls_) cut_out(number, walls.leads);
    std::sort(parts_.begin(), parts_.end(),
              [](const auto& a, const auto& b) { return a.number < b.number; });
    for (const Walls::Part& part : parts_)
      if (!walls.is_lead(part.number) &&
          !std::binary_search(walls_.begin(), walls_.end(), part.number))
        walls.parts.push_back(part);
  }

 private:
  void limit(const Walls::Part& part) {
    for (Walls::Part& known : parts_)
      if (known.number == part.number) {
        known.from = std::max(known.from, part.from);
        known.to = std::min(known.to, part.to);
        return;
      }
    parts_.push_back(part);
  }
  static void append(const Walls::Range& range, std::vector<Walls::Range>& leads) {
    if (!leads.empty() && range.first <= leads.back().end)
      leads.back().end = std::max(leads.back().end, range.end);
    else
      leads.push_back(range);
  }
  static void cut_out(std::size_t number, std::vector<Walls::Range>& leads) {
    const auto found = std::find_if(leads.begin(), leads.end(),
                                    [&](const Walls::Range& range) { return range.holds(number); });
    if (found == leads.end()) return;
    const Walls::Range behind{number + 1, found->end};
    found->end = number;
    const bool is_empty = found->first == found->end;
    const auto next = is_empty ? leads.erase(found) : std::next(found);
    if (behind.first < behind.end) leads.insert(next, behind);
  }

  const ContourView& contour_;
  double same_place_;
  std::pmr::vector<Walls::Range> ranges_;
  std::pmr::vector<Walls::Part> parts_;
  std::pmr::vector<std::size_t> walls_;  // marked
};

// The block that goes on from the place.
std::size_t block_from(const ContourView& contour, const ContourPlace& place) {
  const bool is_at_end =
      place.along >= length_of(contour.segment(place.number)) - contour.tolerances.same_place;
  return place.number + (is_at_end ? 1 : 0);
}

// `near`: up to this length, mm, a part of a block is the end of a lap or the start of the next.
void add_rings(const ContourView& contour, const Laps& laps, double near, Leads& leads,
               Walls& walls) {
  const std::span<const Visit> visits = laps.visits();
  if (!laps.go_over_one_another()) return;
  for (std::size_t ring = 1; ring < visits.size(); ++ring) {
    const ContourPlace& end = visits[ring].place;
    if (laps.is_lead(ring)) leads.add(visits[ring - 1].place, end);
    if (ring + 1 == visits.size()) break;
    walls.rings.push_back(block_from(contour, end));
    const double left = length_of(contour.segment(end.number)) - end.along;
    const bool is_within_block = end.along > near && left > near;
    if (is_within_block && !laps.is_lead(ring + 1)) leads.add_end_of_lap(end);
  }
}

// The direction of a block where the contour closes, and its length.
struct Direction {
  Vector tangent = Vector::Zero();
  double length = 0;
};

// For the walls that meet there and the leads in and out, six at most. A stretch shorter than the
// resolution of the input does not tell where the contour closes.
std::pmr::vector<Direction> directions_at(const ContourView& contour, const Closing& closing,
                                          double input_resolution,
                                          std::pmr::memory_resource* memory) {
  std::pmr::vector<Direction> directions(memory);
  for (const auto& [number, along] : {closing.first, closing.second}) {
    const Segment block = contour.segment(number);
    const double length = length_of(block);
    directions.push_back({tangent_along(block, along), length});
    if (along <= input_resolution && number > 0) {
      const Segment before = contour.segment(number - 1);
      directions.push_back({tangent_at_end(before), length_of(before)});
    }
    if (along >= length - input_resolution && number + 1 < contour.count) {
      const Segment behind = contour.segment(number + 1);
      directions.push_back({tangent_at_start(behind), length_of(behind)});
    }
  }
  return directions;
}

// The lap that finishes what others have roughed may have its own leads: then it does not close
// where they do.
void add_leads_of_last_lap(const ContourView& contour, const Laps& laps, double closing_tolerance,
                           double tool_radius, Leads& leads) {
  const std::span<const Visit> visits = laps.visits();
  if (!laps.go_over_one_another() || !laps.last_one_finishes()) return;
  const ContourPlace& begin = visits[visits.size() - 2].place;
  const ContourPlace& end = visits.back().place;
  const std::size_t first = block_from(contour, begin);
  if (end.number < first) return;
  ContourView lap = contour;
  lap.count = end.number + 1 - first;
  lap.segment = [&contour, first](std::size_t number) { return contour.segment(first + number); };
  const auto closing = find_closing_of_long_leads(lap, closing_tolerance, tool_radius);
  if (!closing) return;
  leads.add(begin, {first + closing->first.number, closing->first.along});
  leads.add({first + closing->second.number, closing->second.along}, end);
}

// How much nearer than the tool radius one end of the contour leads to the other, mm, because both,
// or their leads, meet in a slight kink. A kink too large for rounding does not count (D-44).
double kink_in(const ContourView& contour, const Closing& closing, double tool_radius,
               double input_resolution, std::pmr::memory_resource* memory) {
  const auto kink_between = [&](const Direction& one, const Direction& other) {
    const double cosine = one.tangent.dot(other.tangent);
    if (cosine <= 0) return 0.0;
    const double sine = cross(one.tangent, other.tangent);
    const double nearer = tool_radius * sine * sine / (1 + cosine);
    // Rounding of their ends turns blocks of these lengths by up to this sine.
    const double by_rounding = 2 * input_resolution * (1 / one.length + 1 / other.length);
    const double most =
        std::abs(sine) <= by_rounding ? contour.tolerances.on_top : input_resolution;
    return nearer <= most ? nearer : 0;
  };
  double kink = 0;
  const auto directions = directions_at(contour, closing, input_resolution, memory);
  for (std::size_t one = 0; one < directions.size(); ++one)
    for (std::size_t other = one + 1; other < directions.size(); ++other)
      kink = std::max(kink, kink_between(directions[one], directions[other]));
  return kink;
}

// Walls that end beside a lead along them are as near to it as the wall it meets, within the
// precision of the program.
void reach_along_leads(const ContourView& contour, const Closing& closing, double input_resolution,
                       Walls& walls) {
  // Whether an end of a wall is beside a lead; notes how far it is from it.
  const auto note_wall_beside = [&](const Point& end, const Segment& lead) {
    contour.pass();
    const double apart = distance(end, lead);
    // A coordinate is off by up to half of the resolution, two of them by its diagonal.
    if (apart <= 1.5 * input_resolution) walls.touch = std::max(walls.touch, apart);
    return apart <= contour.tolerances.on_top;
  };
  const std::size_t out = block_from(contour, closing.second);
  if (out < contour.count)
    while (walls.head.end < walls.tail.first &&
           note_wall_beside(end_of(contour.segment(walls.head.end - 2)), contour.segment(out)))
      ++walls.head.end;
  walls.start_blocks_passed = walls.head.end - (closing.first.number + 2);
  const std::size_t in =
      closing.first.number + (closing.first.along > contour.tolerances.same_place ? 1 : 0);
  if (in > 0)
    while (
        walls.head.end < walls.tail.first &&
        note_wall_beside(start_of(contour.segment(walls.tail.first + 1)), contour.segment(in - 1)))
      --walls.tail.first;
}

// The beginning of an overrun, if there is one: a link from one lap to the next need not pass the
// end of the overrun.
Closing where_laps_meet(Closing closing) {
  if (!closing.overrun) return closing;
  closing.first = closing.overrun->first;
  closing.second = closing.overrun->second;
  closing.point = closing.overrun->point;
  return closing;
}

// The only wall of a bow tie is the tip that the tool goes round: the parts beyond the crossing go.
// If both corners are outside, the path keeps clear of all of it.
void untie(const ContourView& contour, std::size_t number, const BowTie& tie, Walls& walls) {
  for (const std::size_t one : {number - 1, number, number + 1})
    if (walls.is_lead(one) || walls.part_of(one)) return;
  // The shortest part of the short block that has a direction.
  const double length = length_of(contour.segment(number));
  const double tip = std::min(contour.tolerances.same_place, length);
  std::array<Walls::Part, 2> parts{
      {{.number = number - 1, .to = tie.along_before}, {.number = number, .from = length - tip}}};
  if (!tie.tip_at_end)
    parts = {{{.number = number, .to = tip}, {.number = number + 1, .from = tie.along_after}}};
  const auto behind =
      std::partition_point(walls.parts.begin(), walls.parts.end(),
                           [&](const Walls::Part& part) { return part.number < number; });
  walls.parts.insert(behind, parts.begin(), parts.end());
}

void untie(const ContourView& contour, double largest, Walls& walls) {
  const double longest = longest_in_bow_tie(largest);
  if (contour.shortest_step > longest) return;
  const bool is_left = contour.shift > 0;
  for (std::size_t number = 1; number + 1 < contour.count; ++number) {
    contour.pass();
    const Segment between = contour.segment(number);
    if ((end_of(between) - start_of(between)).cwiseAbs().maxCoeff() > longest) continue;
    const auto tie = bow_tie_of(contour.segment(number - 1), between, contour.segment(number + 1),
                                largest, contour.tolerances);
    if (tie && tie->turns_left == is_left) untie(contour, number, *tie, walls);
  }
}

}  // namespace

Walls find_walls(const ContourView& contour, const LeadSettings& settings, double tool_radius) {
  Walls walls;
  Scratch scratch;
  Leads leads(contour, scratch.memory());
  if (const auto closing = closing_of(contour, settings, tool_radius)) {
    leads.add_before(closing->first);
    leads.add_behind(closing->second);
    walls.head = {0, closing->first.number + 2};
    walls.tail = {closing->joins - std::min<std::size_t>(closing->joins, 1), contour.count};
    walls.touch = std::max(closing->gap, kink_in(contour, *closing, tool_radius,
                                                 settings.input_resolution, scratch.memory()));
    reach_along_leads(contour, *closing, settings.input_resolution, walls);
    if (closing->has_turns_in) walls.turns_in = {0, closing->first.number + 1};
    if (closing->has_turns_out) walls.turns_out = {closing->second.number, contour.count};
    walls.touch_of_turns = std::min(contour.tolerances.on_top, settings.closing_tolerance);
    // A single lap goes over no other one.
    if (!closing->is_alone || closing->overrun) {
      const double tolerance = settings.closing_tolerance;
      const Laps laps(contour, where_laps_meet(*closing), tolerance, scratch.memory());
      add_rings(contour, laps, 2 * tolerance, leads, walls);
      add_leads_of_last_lap(contour, laps, tolerance, tool_radius, leads);
    }
    if (closing->overrun) {
      walls.overrun_blocks = closing->first.number - closing->overrun->first.number;
      walls.blocks_per_lap = block_from(contour, closing->overrun->second) -
                             block_from(contour, closing->overrun->first);
    }
    if (!walls.rings.empty())
      walls.touch_of_rings = std::min(contour.tolerances.on_top, settings.closing_tolerance);
  }
  if (contour.role)
    for (std::size_t number = 0; number < contour.count; ++number) {
      contour.pass();
      leads.mark(number, contour.role(number));
    }
  leads.give_to(walls);
  // Where a lead meets the contour, rounding lets it cut in by next to nothing (D-44).
  if (walls.touch > 0 || !walls.leads.empty())
    walls.touch = std::max({walls.touch, contour.tolerances.on_contour, settings.input_resolution});
  if (contour.shift != 0)
    untie(contour, largest_bow_tie(settings.input_resolution, tool_radius), walls);
  return walls;
}

}  // namespace trc
