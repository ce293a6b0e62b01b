#include "core/trc/walls/closing.h"

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "core/base/tolerances.h"
#include "core/geometry/along.h"
#include "core/geometry/box_tree.h"
#include "core/trc/walls/contact.h"
#include "core/trc/walls/rings.h"
#include "core/trc/walls/scratch.h"

namespace trc {
namespace {

constexpr std::size_t first_few = 5;
constexpr double reach_in_radii = 10;
// Of leads that are longer than the contour: with what an overrun goes over.
constexpr std::size_t most_lead_blocks = 4;
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
  double length = 0;
  for (std::size_t number = 0; number < contour.count; ++number) {
    contour.pass();
    length += length_of(contour.segment(number));
  }
  return length;
}

// Whether they are so near the ends that leads longer than the contour may end there.
bool are_few_outside(const ContourView& contour, std::size_t first, std::size_t second) {
  return first <= most_lead_blocks && contour.count - 1 - second <= most_lead_blocks;
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

// The contour between the two visits of a candidate, as a polygon.
class Ring {
 public:
  Ring(const ContourView& contour, const Candidate& closing) {
    for (std::size_t number = closing.first.number; number <= closing.second.number; ++number) {
      const Segment segment = contour.segment(number);
      const double length = length_of(segment);
      const double from = number == closing.first.number ? closing.first.along : 0;
      const double to = number == closing.second.number ? closing.second.along : length;
      constexpr double chord = 0.25;  // rad
      const auto* arc = std::get_if<Arc>(&segment);
      const double turn = arc != nullptr ? std::abs(arc->sweep) * (to - from) / length : 0;
      const auto chords = static_cast<int>(std::ceil(std::max(1.0, turn / chord)));
      for (int part = 0; part < chords; ++part)
        corners_.push_back(point_along(segment, from + (to - from) * part / chords));
    }
  }

  // Whether the point is on that side of it. Inside, where the ring goes round it.
  [[nodiscard]] bool has_on(Side side, const Point& point) const {
    double area = 0;
    int turns = 0;
    for (std::size_t index = 0; index < corners_.size(); ++index) {
      const Vector from = corners_[index] - point;
      const Vector to = corners_[(index + 1) % corners_.size()] - point;
      area += cross(from, to);
      if (from.y() <= 0 && to.y() > 0 && cross(from, to) > 0) ++turns;
      if (from.y() > 0 && to.y() <= 0 && cross(from, to) < 0) --turns;
    }
    const bool is_inside = turns != 0;
    const bool tool_is_inside = (area > 0) == (side == Side::left);
    return is_inside == tool_is_inside;
  }

 private:
  std::vector<Point> corners_;
};

// Where leads that are longer than the contour part from it.
bool is_between_long_leads(const ContourView& contour, const Candidate& closing, double tolerance) {
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
  const std::size_t last_in = closing.first.number - 1;
  const std::size_t first_out = closing.second.number + 1;
  if (closing.first.number == 0 || first_out == contour.count ||
      !std::holds_alternative<Arc>(contour.segment(last_in)) ||
      !std::holds_alternative<Arc>(contour.segment(first_out)))
    return false;
  double length = closing.second.along - closing.first.along;
  for (std::size_t number = closing.first.number; number < closing.second.number; ++number)
    length += length_of(contour.segment(number));
  if (length <= shortest) return false;
  const Ring ring(contour, closing);
  return ring.has_on(contour.tool_side, start_of(contour.segment(0))) &&
         ring.has_on(contour.tool_side, end_of(contour.segment(contour.count - 1)));
}

// What of the begin an overrun may go over: the same way, or, with laps that differ at their
// corners, any that comes back to it.
enum class Overruns { along_the_begin, any };

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
      if (overruns_ == Overruns::along_the_begin && -earlier > tolerance_ && !runs_along(next))
        return;
      best_ = next;
      overrun_.push_back(next);
      return note(next);
    }
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
    stay_with_all_laps();
    Closing found = closing();
    found.overrun = overrun_to(contour_, *best_, candidates, tolerance_);
    return found;
  }

 private:
  // Half way from the best one to the next, begin and end are in one place: a lead that leaves
  // through the first walls meets them again too.
  [[nodiscard]] bool runs_along(const Candidate& next) const {
    const double later = next.before - best_->before;
    const double share = 0.02;  // of that way, in an acute angle
    const Point begin = behind_by(best_->first, later / 2);
    const Point end = behind_by(best_->second, (best_->behind - next.behind) / 2);
    return (begin - end).norm() <= tolerance_ + share * later;
  }
  [[nodiscard]] Point behind_by(const ContourPlace& place, double way) const {
    std::size_t number = place.number;
    way += place.along;
    for (; number + 1 < contour_.count; ++number) {
      const double length = length_of(contour_.segment(number));
      if (way <= length) break;
      way -= length;
    }
    return point_along(contour_.segment(number), way);
  }
  void take(const Candidate& next) {
    best_ = next;
    overrun_.assign(1, next);
    gap_ = next.gap;
    joins_ = next.second.number;
    longest_ring_.reset();
  }
  // On the same stretch as the one before.
  void note(const Candidate& next) {
    gap_ = std::max(gap_, next.gap);
    joins_ = std::min(joins_, next.second.number);
    longest_ring_.reset();
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
};

}  // namespace

std::pmr::vector<EndsMeeting> meetings_of_ends(const ContourView& contour, double closing_tolerance,
                                               double tool_radius,
                                               std::pmr::memory_resource* memory) {
  const double reach = reach_in_radii * tool_radius;
  const double most = 0.5 * length_of_all(contour);
  return candidates_of(contour, reach, closing_tolerance, most, memory);
}

std::optional<Closing> find_closing(const ContourView& contour, double closing_tolerance,
                                    double tool_radius) {
  Scratch scratch;
  std::pmr::memory_resource* const memory = scratch.memory();
  const auto candidates = meetings_of_ends(contour, closing_tolerance, tool_radius, memory);
  if (candidates.empty()) return std::nullopt;
  const double most = 0.5 * length_of_all(contour);
  const auto search = [&](Overruns overruns, const auto& may_close) {
    InwardSearch inward(contour, closing_tolerance, overruns, memory);
    for (const Candidate& candidate : candidates)
      if (may_close(candidate)) inward.consider(candidate);
    return inward.result(candidates);
  };
  const auto leaves_half = [&](const Candidate& candidate) {
    return candidate.before + candidate.behind <= most;
  };
  auto closing = search(Overruns::along_the_begin, leaves_half);
  if (closing && visits_of(contour, *closing, closing_tolerance, memory).size() > 2)
    closing = search(Overruns::any, leaves_half);
  if (closing) return closing;
  return search(Overruns::along_the_begin, [&](const Candidate& candidate) {
    return is_between_long_leads(contour, candidate, closing_tolerance);
  });
}

}  // namespace trc
