#include "core/trc/walls/closing.h"

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/tolerances.h"
#include "core/geometry/along.h"
#include "core/geometry/box_tree.h"
#include "core/trc/walls/contact.h"
#include "core/trc/walls/crossing_leads.h"
#include "core/trc/walls/entry_turns.h"
#include "core/trc/walls/long_leads.h"
#include "core/trc/walls/outline.h"
#include "core/trc/walls/repeated_laps.h"
#include "core/trc/walls/rings.h"
#include "core/trc/walls/scratch.h"

namespace trc {
namespace {

constexpr std::size_t first_few = 5;
constexpr double reach_in_radii = 10;
// Up to here two places on a contour are one, mm.
constexpr double same_place = 1e-7;

// A block among the first ones or the last ones.
struct End {
  std::size_t number = 0;
  Segment path{};
  double before = 0;  // mm of contour between it and that end
};

using Ends = std::pmr::vector<End>;

// A point the contour may close in.
using Candidate = EndsMeeting;

Ends first_blocks(const ContourView& contour, double reach, std::pmr::memory_resource* memory) {
  Ends blocks(memory);
  double before = 0;
  for (std::size_t number = 0; number < contour.count; ++number) {
    if (number >= first_few && before >= reach) break;
    contour.pass();
    blocks.push_back({number, contour.segment(number), before});
    before += length_of(blocks.back().path);
  }
  return blocks;
}

Ends last_blocks(const ContourView& contour, double reach, std::pmr::memory_resource* memory) {
  Ends blocks(memory);
  double behind = 0;
  for (std::size_t number = contour.count; number-- > 0;) {
    if (contour.count - number > first_few && behind >= reach) break;
    contour.pass();
    blocks.push_back({number, contour.segment(number), behind});
    behind += length_of(blocks.back().path);
  }
  return blocks;
}

// The first blocks by their places.
class NearEnds {
 public:
  explicit NearEnds(const Ends& ends) : ends_(ends) {
    if (ends.size() <= few) return;
    tree_.emplace();
    for (const End& block : ends) tree_->append(bounding_box(block.path));
  }

  // Calls visit(index) with every one that comes as near to the place as `reach`, mm.
  template <class Visit>
  void for_each_near(const Box& place, double reach, const Visit& visit) const {
    if (tree_) return tree_->for_each_near(place, reach, visit);
    for (std::size_t index = 0; index < ends_.size(); ++index)
      if (squared_distance(bounding_box(ends_[index].path), place) <= reach * reach) visit(index);
  }

 private:
  // Here asking all of them is cheaper than a tree, and takes nothing from the heap.
  static constexpr std::size_t few = 24;

  const Ends& ends_;
  std::optional<BoxTree> tree_{};
};

double length_of_all(const ContourView& contour) {
  if (contour.length > 0) return contour.length;
  double length = 0;
  for (std::size_t number = 0; number < contour.count; ++number) {
    contour.pass();
    length += length_of(contour.segment(number));
  }
  return length;
}

// Where the first blocks and the last ones meet with no more than `outside` mm of contour before
// and behind, or as little more as may belong to an overrun from there, or few blocks. Short blocks
// meet all their neighbours too, which would be many.
std::pmr::vector<Candidate> candidates_of(const ContourView& contour, double reach,
                                          double tolerance, double outside,
                                          std::pmr::memory_resource* memory) {
  const Ends first = first_blocks(contour, reach, memory);
  const Ends last = last_blocks(contour, reach, memory);
  const double most = outside + 2 * tolerance + same_place;
  const NearEnds ends(first);
  std::pmr::vector<Candidate> candidates(memory);
  std::pmr::vector<Contact> contacts(memory);
  for (const End& end : last) {
    const double length = length_of(end.path);
    ends.for_each_near(bounding_box(end.path), tolerance, [&](std::size_t index) {
      const End& begin = first[index];
      contour.pass();
      const bool few = are_few_outside(contour, begin.number, end.number);
      if (begin.number > end.number || (!few && begin.before + end.before > most)) return;
      // Between two lines that follow each other there is nothing.
      if (begin.number + 1 >= end.number && !is_arc(begin.path) && !is_arc(end.path)) return;
      contacts.clear();
      find_contacts(begin.path, end.path, tolerance, contacts);
      for (const Contact& contact : contacts) {
        if (begin.number == end.number && contact.along_second - contact.along_first < 0.5 * length)
          continue;
        const double before = begin.before + contact.along_first;
        const double behind = end.before + length - contact.along_second;
        if (!few && before + behind > most) continue;
        candidates.push_back({.first = {begin.number, contact.along_first},
                              .second = {end.number, contact.along_second},
                              .before = before,
                              .behind = behind,
                              .gap = contact.gap,
                              .point = contact.point});
      }
    });
  }
  std::sort(candidates.begin(), candidates.end(), [&](const Candidate& a, const Candidate& b) {
    contour.pass();
    return a.before != b.before ? a.before < b.before : a.behind < b.behind;
  });
  return candidates;
}

// Where the end of the contour comes onto its begin, if it goes on along it up to `closing`: from
// there on both are as long. That is where a block begins: a lead along the contour crosses it
// beside that by its rounding.
std::optional<Closing::Overrun> overrun_to(const ContourView& contour, const Candidate& closing,
                                           std::span<const Candidate> candidates,
                                           double tolerance) {
  std::optional<Closing::Overrun> overrun;
  double longest = tolerance;
  for (const Candidate& begin : candidates) {
    contour.pass();
    const double length = closing.before - begin.before;
    const auto& [number, along] = begin.first;
    if (along > same_place && along < length_of(contour.segment(number)) - same_place) continue;
    if (length <= longest || std::abs(begin.behind - closing.behind - length) > tolerance) continue;
    longest = length;
    overrun = Closing::Overrun{begin.first, begin.second, begin.point};
  }
  return overrun;
}

// What an overrun goes along: the begin of the contour, or that of the last lap, as laps may differ
// at their corners.
enum class Overruns { along_the_begin, along_the_last_lap };

// Goes from the outermost candidate inward.
class InwardSearch {
 public:
  InwardSearch(const ContourView& contour, double tolerance, Overruns overruns,
               std::pmr::memory_resource* memory)
      : contour_(contour),
        tolerance_(tolerance),
        overruns_(overruns),
        memory_(memory),
        overrun_(memory) {}

  void consider(const Candidate& next) {
    if (!best_) return take(next);
    const double later = next.before - best_->before;
    const double earlier = next.behind - best_->behind;
    if (std::abs(later) <= same_place && std::abs(earlier) <= same_place) return note(next);
    // What is before the one and behind the other is a loop of the leads, or a whole lap.
    const double between = later + earlier;
    if (between > tolerance_ && between >= 0.5 * longest_ring()) return;
    if (earlier < 0) {
      // The end goes on along the begin: an overrun, or both part in an acute angle.
      if (next.gap > std::max(best_->gap, Tolerances{}.on_top)) return;
      // Where leads between laps begin in one point, the laps close inside of that.
      const bool is_lap =
          overruns_ == Overruns::along_the_last_lap && -earlier >= 0.5 * longest_ring();
      if (is_lap) return take(next);
      if (-earlier > tolerance_ && !runs_along(next)) {
        // A lead-in that crosses the last walls, or comes near them, does not hide the start of the
        // contour.
        const bool is_beside = !is_junction(*best_) && best_->gap > next.gap + same_place;
        if ((is_crossing(*best_) || is_beside) && is_junction(next)) take(next);
        return;
      }
      best_ = next;
      overrun_.push_back(next);
      return note(next);
    }
    if (goes_round_a_part(next)) return;
    // The same end of an overrun, met by the lead-out too.
    const bool is_same_end = later <= tolerance_ && earlier <= tolerance_;
    if (overrun_.size() > 1 && is_same_end) {
      best_ = overrun_.back() = next;
      return note(next);
    }
    take(next);
  }

  [[nodiscard]] std::optional<Closing> result(std::span<const Candidate> candidates) {
    if (!best_) return std::nullopt;
    end_before_lead_out();
    stay_with_all_laps();
    Closing found = closing();
    found.overrun = overrun_to(contour_, *best_, candidates, tolerance_);
    return found;
  }

 private:
  [[nodiscard]] bool is_block_end(const ContourPlace& place) const {
    return place.along <= same_place ||
           place.along >= length_of(contour_.segment(place.number)) - same_place;
  }
  // In the middle of a last block, and of a first one or where the contour begins.
  [[nodiscard]] bool is_crossing(const Candidate& candidate) const {
    const ContourPlace& first = candidate.first;
    const bool is_begin = first.number == 0 && first.along <= same_place;
    return (is_begin || !is_block_end(first)) && !is_block_end(candidate.second);
  }
  [[nodiscard]] bool is_junction(const Candidate& candidate) const {
    return is_block_end(candidate.first) && is_block_end(candidate.second);
  }
  // Whether the contour goes round a part of its own between the best one and the next, in which it
  // only touches itself. Leads go round nothing, or round what lies on the side of the tool (D-57).
  [[nodiscard]] bool goes_round_a_part(const Candidate& next) const {
    if (contour_.tool_side == Side::off || !is_junction(*best_)) return false;
    Scratch scratch;
    Outline between(scratch.memory());
    between.append(contour_, best_->first, next.first);
    between.append(contour_, next.second, best_->second);
    const double length = next.before - best_->before + next.behind - best_->behind;
    if (between.is_slender(length)) return false;
    if ((between.area() > 0) != (contour_.tool_side == Side::left)) return true;
    const Closing inner{.first = next.first, .second = next.second, .point = next.point};
    const Visits visits = visits_of(contour_, inner, tolerance_, scratch.memory());
    Outline lap(scratch.memory());
    lap.append(contour_, visits[0].place, visits[1].place);
    return !lap.has_on(contour_.tool_side, start_of(contour_.segment(0)));
  }
  // From the best one to the next, begin and end are in one place all the way: a lead that leaves
  // through the first walls meets them again too. Of several laps the end lies on the last one.
  [[nodiscard]] bool runs_along(const Candidate& next) {
    const double on = best_->behind - next.behind;
    if (overruns_ == Overruns::along_the_last_lap) {
      const double way = overrun_.front().behind - best_->behind;
      return stay_together(behind_by(begin_of_last_lap(), way), on,
                           behind_by(overrun_.front().second, way), on, 2 * tolerance_);
    }
    const double later = next.before - best_->before;
    // Of that way, where begin and end part in an acute angle and an overrun ends on the begin.
    const double share = is_crossing(*best_) || !is_block_end(next.second) ? 0 : 0.02;
    const double most = std::min(tolerance_, Tolerances{}.on_top) + share * later;
    return stay_together(best_->first, later, best_->second, on, most);
  }
  // Whether two ways along the contour are nowhere farther apart than `most`, mm.
  [[nodiscard]] bool stay_together(ContourPlace begin, double later, ContourPlace end, double on,
                                   double most) const {
    const auto go_on_together = [&](double share) {
      go_on(begin, later, share);
      go_on(end, on, share);
      return (point_at(begin) - point_at(end)).norm() <= most;
    };
    // From one end of a block to the next one, on whichever way it is, as shares of the way.
    double left = 1;
    while (left > 0) {
      contour_.pass();
      const double step =
          std::min({share_to_block_end(begin, later), share_to_block_end(end, on), left});
      left -= step;
      if (!go_on_together(step / 2) || !go_on_together(step / 2)) return false;
    }
    return true;
  }
  [[nodiscard]] double left_of(const ContourPlace& place) const {
    return std::max(length_of(contour_.segment(place.number)) - place.along, 0.0);
  }
  // Of a way that goes on from there.
  [[nodiscard]] double share_to_block_end(const ContourPlace& place, double way) const {
    const bool ends_there = way <= same_place || place.number + 1 == contour_.count;
    return ends_there ? 1 : left_of(place) / way;
  }
  void go_on(ContourPlace& place, double way, double share) const {
    const bool ends = share * way >= left_of(place) - same_place;
    if (ends && place.number + 1 < contour_.count)
      place = {place.number + 1, 0};
    else
      place.along += share * way;
  }
  // Where the last lap comes by where the overrun begins.
  [[nodiscard]] const ContourPlace& begin_of_last_lap() {
    if (last_lap_) return *last_lap_;
    const Candidate best = std::exchange(*best_, overrun_.front());
    const Visits visits = visits_of(contour_, closing(), tolerance_, memory_);
    best_ = best;
    const double least = share_of_lead_ring * trc::longest_ring(visits);
    std::size_t end = visits.size() - 1;
    while (end > 1 && visits[end].way - visits[end - 1].way < least) --end;
    return last_lap_.emplace(visits[end - 1].place);
  }
  [[nodiscard]] ContourPlace behind_by(const ContourPlace& place, double way) const {
    std::size_t number = place.number;
    way += place.along;
    for (; number + 1 < contour_.count; ++number) {
      const double length = length_of(contour_.segment(number));
      if (way <= length) break;
      way -= length;
    }
    return {number, way};
  }
  [[nodiscard]] Point point_at(const ContourPlace& place) const {
    return point_along(contour_.segment(place.number), place.along);
  }
  void take(const Candidate& next) {
    best_ = next;
    overrun_.assign(1, next);
    gap_ = next.gap;
    joins_ = next.second.number;
    longest_ring_.reset();
    last_lap_.reset();
  }
  // On the same stretch as the one before.
  void note(const Candidate& next) {
    gap_ = std::max(gap_, next.gap);
    joins_ = std::min(joins_, next.second.number);
    longest_ring_.reset();
  }
  // A lead-out in a slight curve is still near the first walls where one of them ends: the contour
  // closes where the lead-out begins.
  void end_before_lead_out() {
    const ContourPlace out = overrun_.back().second;
    if (is_block_end(out)) return;
    const auto begins_there = [&](const Candidate& candidate) {
      const auto& [number, along] = candidate.second;
      if (number == out.number) return along <= same_place;
      return number + 1 == out.number && is_block_end(candidate.second) && along > same_place;
    };
    const auto begin = std::find_if(overrun_.rbegin(), overrun_.rend(), begins_there);
    if (begin != overrun_.rend()) overrun_.erase(begin.base(), overrun_.end());
  }
  // The end may cross the first lap where the last one, with round corners, does not come any more:
  // the contour closes where it still goes round as often as where the overrun begins.
  void stay_with_all_laps() {
    const auto laps_at = [&](const Candidate& candidate) {
      best_ = candidate;
      return laps_of(
          visits_of(contour_, closing(), std::min(Tolerances{}.on_top, tolerance_), memory_));
    };
    const std::size_t laps = overrun_.size() > 1 ? laps_at(overrun_.front()) : 1;
    if (laps <= 1) {
      best_ = overrun_.back();
      return;
    }
    const auto behind = std::partition_point(
        overrun_.begin() + 1, overrun_.end(),
        [&](const Candidate& candidate) { return laps_at(candidate) >= laps; });
    best_ = *std::prev(behind);
    // The end lies on the last lap as exactly as that was told.
    gap_ = std::max(gap_, Tolerances{}.on_top) + std::min(Tolerances{}.on_top, tolerance_);
  }
  [[nodiscard]] Closing closing() const {
    const bool overruns = best_->before > overrun_.front().before + tolerance_;
    return {.first = best_->first,
            .second = best_->second,
            .point = best_->point,
            .gap = overruns ? std::max(gap_, std::min(Tolerances{}.on_top, tolerance_)) : gap_,
            .joins = joins_};
  }
  [[nodiscard]] double longest_ring() {
    if (!longest_ring_)
      longest_ring_ = trc::longest_ring(visits_of(contour_, closing(), tolerance_, memory_));
    return *longest_ring_;
  }

  const ContourView& contour_;
  double tolerance_;
  Overruns overruns_;
  std::pmr::memory_resource* memory_;
  std::optional<Candidate> best_{};
  std::pmr::vector<Candidate> overrun_;  // the stretch up to the best one
  double gap_ = 0;
  std::size_t joins_ = 0;
  std::optional<double> longest_ring_{};
  std::optional<ContourPlace> last_lap_{};
};

// Whether what closes the contour in the other point are leads that begin and end there, or cross.
bool lies_within(const Closing& inner, const Closing& outer) {
  const auto is_before = [](const ContourPlace& a, const ContourPlace& b) {
    return a.number != b.number ? a.number < b.number : a.along < b.along - same_place;
  };
  return is_before(outer.first, inner.first) && is_before(inner.second, outer.second);
}

}  // namespace

std::pmr::vector<EndsMeeting> meetings_of_ends(const ContourView& contour, double closing_tolerance,
                                               double tool_radius,
                                               std::pmr::memory_resource* memory) {
  return candidates_of(contour, reach_in_radii * tool_radius, closing_tolerance,
                       0.5 * length_of_all(contour), memory);
}

namespace {

using Candidates = std::pmr::vector<Candidate>;

template <class MayClose>
std::optional<Closing> search_inward(const ContourView& contour, const Candidates& candidates,
                                     double tolerance, double tool_radius, Overruns overruns,
                                     const MayClose& may_close) {
  InwardSearch inward(contour, tolerance, overruns, candidates.get_allocator().resource());
  for (const Candidate& candidate : candidates)
    if (may_close(candidate) && !is_lead_across_walls(contour, candidate, tolerance, tool_radius))
      inward.consider(candidate);
  return inward.result(candidates);
}

std::optional<Closing> between_long_leads(const ContourView& contour, const Candidates& candidates,
                                          double tolerance, double tool_radius) {
  return search_inward(contour, candidates, tolerance, tool_radius, Overruns::along_the_begin,
                       [&](const Candidate& candidate) {
                         return is_between_long_leads(contour, candidate, tolerance, tool_radius);
                       });
}

std::optional<Closing> closing_of_some(const ContourView& contour, std::size_t first,
                                       std::size_t end, double closing_tolerance,
                                       double tool_radius);

// Of the same lap at several depths, where what leads from one to the next is longer than a lap:
// which of the two is the lap, the last one tells, which has nothing behind it.
std::optional<Closing> closing_of_repeated(const ContourView& contour, double closing_tolerance,
                                           double tool_radius) {
  const auto repeated = repeated_laps(contour);
  if (!repeated) return std::nullopt;
  auto closing =
      closing_of_some(contour, repeated->last, contour.count, closing_tolerance, tool_radius);
  if (!closing || closing->overrun) return std::nullopt;
  const auto length_between = [&](ContourPlace from, const ContourPlace& to) {
    double length = to.along - from.along;
    for (; from.number < to.number; ++from.number) {
      contour.pass();
      length += length_of(contour.segment(from.number));
    }
    return length;
  };
  const ContourPlace before{closing->first.number - repeated->blocks, closing->first.along};
  const double lap = length_between(closing->first, closing->second);
  if (2 * lap > length_between(before, closing->first)) return std::nullopt;
  closing->first.number -= repeated->last;
  closing->is_alone = false;
  closing->repeated_laps = repeated->last / repeated->blocks + 1;
  return closing;
}

std::optional<Closing> closing_of_all(const ContourView& contour, double closing_tolerance,
                                      double tool_radius) {
  Scratch scratch;
  std::pmr::memory_resource* const memory = scratch.memory();
  const double most = 0.5 * length_of_all(contour);
  const auto candidates =
      candidates_of(contour, reach_in_radii * tool_radius, closing_tolerance, most, memory);
  if (candidates.empty()) return std::nullopt;
  const auto search = [&](Overruns overruns) {
    return search_inward(
        contour, candidates, closing_tolerance, tool_radius, overruns,
        [&](const Candidate& candidate) { return candidate.before + candidate.behind <= most; });
  };
  auto closing = search(Overruns::along_the_begin);
  if (closing) {
    closing->is_alone = visits_of(contour, *closing, closing_tolerance, memory).size() == 2;
    if (!closing->is_alone) closing = search(Overruns::along_the_last_lap);
  }
  // Leads of few blocks may cross in one point, which then hides the laps.
  constexpr std::size_t few = 1000;
  if (!closing || !closing->is_alone || contour.count <= few)
    if (auto repeated = closing_of_repeated(contour, closing_tolerance, tool_radius))
      return repeated;
  const auto long_leads = between_long_leads(contour, candidates, closing_tolerance, tool_radius);
  if (!closing || (long_leads && lies_within(*long_leads, *closing) &&
                   visits_of(contour, *closing, closing_tolerance, memory).size() == 2))
    return long_leads;
  return closing;
}

// That of some blocks of a contour, from `first` on and before `end`.
std::optional<Closing> closing_of_some(const ContourView& contour, std::size_t first,
                                       std::size_t end, double closing_tolerance,
                                       double tool_radius) {
  ContourView some = contour;
  some.count = end - first;
  some.length = 0;
  some.segment = [&contour, first](std::size_t number) { return contour.segment(first + number); };
  some.role = nullptr;
  auto closing = closing_of_all(some, closing_tolerance, tool_radius);
  if (!closing) return std::nullopt;
  closing->first.number += first;
  closing->second.number += first;
  closing->joins += first;
  if (closing->overrun) {
    closing->overrun->first.number += first;
    closing->overrun->second.number += first;
  }
  return closing;
}

}  // namespace

std::optional<Closing> find_closing(const ContourView& contour, double closing_tolerance,
                                    double tool_radius) {
  if (const auto between = between_turns(contour, closing_tolerance)) {
    auto closing =
        closing_of_some(contour, between->first, between->end, closing_tolerance, tool_radius);
    if (closing && are_leads(contour, *between, *closing, closing_tolerance, tool_radius)) {
      closing->has_turns_in = between->first > 0;
      closing->has_turns_out = between->end < contour.count;
      return closing;
    }
  }
  return closing_of_all(contour, closing_tolerance, tool_radius);
}

std::optional<Closing> find_closing_of_long_leads(const ContourView& contour,
                                                  double closing_tolerance, double tool_radius) {
  Scratch scratch;
  const auto candidates = candidates_of(contour, reach_in_radii * tool_radius, closing_tolerance,
                                        0.5 * length_of_all(contour), scratch.memory());
  return between_long_leads(contour, candidates, closing_tolerance, tool_radius);
}

}  // namespace trc
