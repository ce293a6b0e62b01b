#include "core/trc/walls/inward_search.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/geometry/along.h"
#include "core/trc/walls/extent.h"
#include "core/trc/walls/outline.h"
#include "core/trc/walls/rings.h"
#include "core/trc/walls/scratch.h"

namespace trc {
namespace {

// Where the end of the contour comes onto its beginning and goes on along it up to `closing`: from
// there on both have the same length. Only ends of blocks count: rounding makes a lead along the
// contour cross it beside them.
std::optional<Closing::Overrun> overrun_to(const ContourView& contour, const EndsMeeting& closing,
                                           std::span<const EndsMeeting> candidates,
                                           double tolerance) {
  std::optional<Closing::Overrun> overrun;
  const double same_place = contour.tolerances.same_place;
  double longest = tolerance;
  for (const EndsMeeting& begin : candidates) {
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

// Goes from the outermost meeting inward.
class InwardSearch {
 public:
  InwardSearch(const ContourView& contour, double tolerance, Overruns overruns,
               std::pmr::memory_resource* memory)
      : contour_(contour),
        same_place_(contour.tolerances.same_place),
        tolerance_(tolerance),
        overruns_(overruns),
        memory_(memory),
        overrun_(memory) {}

  void consider(const EndsMeeting& next) {
    if (!best_) return take(next);
    const double later = next.before - best_->before;
    const double earlier = next.behind - best_->behind;
    if (std::abs(later) <= same_place_ && std::abs(earlier) <= same_place_) return note(next);
    // The stretch before one meeting and after the other is a loop of the leads, or a whole lap.
    const double between = later + earlier;
    if (between > tolerance_ && between >= 0.5 * longest_ring()) return;
    if (earlier < 0) {
      // The end goes on along the beginning: an overrun, or both part in an acute angle.
      if (next.gap > std::max(best_->gap, contour_.tolerances.on_top)) return;
      // If leads between laps begin in one point, the laps close inside of it.
      const bool is_lap =
          overruns_ == Overruns::along_the_last_lap && -earlier >= 0.5 * longest_ring();
      if (is_lap) return take(next);
      switch (lead_along_wall(next)) {
        case LeadAlongWall::none:
          break;
        case LeadAlongWall::in:
          if (is_junction(next)) take(next);
          return;
        case LeadAlongWall::out:
          return;
      }
      if (-earlier > tolerance_ && !runs_along(next)) {
        // A lead-in that crosses the last walls, or comes near them, does not hide the start of the
        // contour.
        const bool is_beside = !is_junction(*best_) && best_->gap > next.gap + same_place_;
        if ((is_crossing(*best_) || is_beside) && is_junction(next)) take(next);
        return;
      }
      best_ = next;
      overrun_.push_back(next);
      return note(next);
    }
    if (goes_round_a_part(next)) return;
    // The lead-out meets the end of the overrun once more.
    const bool is_same_end = later <= tolerance_ && earlier <= tolerance_;
    if (overrun_.size() > 1 && is_same_end) {
      best_ = overrun_.back() = next;
      return note(next);
    }
    take(next);
  }

  [[nodiscard]] std::optional<Closing> result(std::span<const EndsMeeting> candidates) {
    if (!best_) return std::nullopt;
    end_before_lead_out();
    stay_with_all_laps();
    Closing found = closing();
    found.overrun = overrun_to(contour_, *best_, candidates, tolerance_);
    return found;
  }

 private:
  // The largest distance of passes on top of each other, mm.
  [[nodiscard]] double most_on_top() const {
    return std::min(contour_.tolerances.on_top, tolerance_);
  }
  [[nodiscard]] bool is_block_end(const ContourPlace& place) const {
    return place.along <= same_place_ ||
           place.along >= length_of(contour_.segment(place.number)) - same_place_;
  }
  // Whether it lies in the middle of a last block, and in that of a first one or at the beginning.
  [[nodiscard]] bool is_crossing(const EndsMeeting& candidate) const {
    const ContourPlace& first = candidate.first;
    const bool is_begin = first.number == 0 && first.along <= same_place_;
    return (is_begin || !is_block_end(first)) && !is_block_end(candidate.second);
  }
  [[nodiscard]] bool is_junction(const EndsMeeting& candidate) const {
    return is_block_end(candidate.first) && is_block_end(candidate.second);
  }
  // Whether the contour goes round a part of its own between the best meeting and the next, where
  // it only touches itself. Leads go round nothing, or round the side of the tool (D-57).
  [[nodiscard]] bool goes_round_a_part(const EndsMeeting& next) const {
    if (contour_.tool_side == Side::off || !is_junction(*best_)) return false;
    Scratch scratch;
    Outline between(scratch.memory());
    between.append(contour_, best_->first, next.first);
    between.append(contour_, next.second, best_->second);
    const double length = next.before - best_->before + next.behind - best_->behind;
    if (is_slender({.length = length, .area = between.area()})) return false;
    if ((between.area() > 0) != (contour_.tool_side == Side::left)) return true;
    const Closing inner{.first = next.first, .second = next.second, .point = next.point};
    const Visits visits = visits_of(contour_, inner, tolerance_, scratch.memory());
    Outline lap(scratch.memory());
    lap.append(contour_, visits[0].place, visits[1].place);
    return !lap.has_on(contour_.tool_side, start_of(contour_.segment(0)));
  }
  // Whether beginning and end stay together all the way from the best meeting to the next: a lead
  // that leaves through the first walls meets them again, too. The end is on the last of all laps.
  [[nodiscard]] bool runs_along(const EndsMeeting& next) {
    const double on = best_->behind - next.behind;
    if (overruns_ == Overruns::along_the_last_lap) {
      const double way = overrun_.front().behind - best_->behind;
      return stay_together(behind_by(begin_of_last_lap(), way), on,
                           behind_by(overrun_.front().second, way), on, 2 * tolerance_);
    }
    const double later = next.before - best_->before;
    // If both part in an acute angle and an overrun ends on the beginning. Ways that part by 2.3
    // degrees and meet again are this share of the way apart half-way.
    constexpr double share_of_way = 0.02;
    const double share = is_crossing(*best_) || !is_block_end(next.second) ? 0 : share_of_way;
    const double most = most_on_top() + share * later;
    return stay_together(best_->first, later, best_->second, on, most);
  }
  // All of a short tangential lead stays near the curve that it touches. If it moves off to the
  // tool side beyond rounding, it is no overrun, which would be a wall; nothing comes nearer for
  // that.
  enum class LeadAlongWall { none, in, out };
  [[nodiscard]] LeadAlongWall lead_along_wall(const EndsMeeting& next) const {
    if (contour_.tool_side == Side::off || overruns_ == Overruns::along_the_last_lap)
      return LeadAlongWall::none;
    const double rounding = contour_.tolerances.input_resolution;
    const EndsMeeting& from = overrun_.front();
    // The outer end of the lead lies beside the curve, the inner one on it.
    const bool is_all_in = from.before <= same_place_ && next.gap <= rounding;
    const bool is_all_out = next.behind <= same_place_ && from.gap <= rounding;
    if (!is_all_in && !is_all_out) return LeadAlongWall::none;
    const double tool_side = contour_.tool_side == Side::left ? 1 : -1;
    double farthest_begin = 0;  // on the tool side of the end, mm
    double farthest_end = 0;    // on that of the beginning
    const bool is_near =
        go_together(from.first, next.before - from.before, from.second, from.behind - next.behind,
                    [&](const ContourPlace& begin, const ContourPlace& end) {
                      const Vector apart = point_at(end) - point_at(begin);
                      const Vector along = tangent_along(contour_.segment(end.number), end.along);
                      const double beside = tool_side * cross(along, apart);
                      farthest_end = std::max(farthest_end, beside);
                      farthest_begin = std::max(farthest_begin, -beside);
                      return apart.norm() <= tolerance_;
                    });
    if (!is_near) return LeadAlongWall::none;
    if (is_all_out && farthest_end > rounding && farthest_begin <= rounding)
      return LeadAlongWall::out;
    if (is_all_in && farthest_begin > rounding && farthest_end <= rounding)
      return LeadAlongWall::in;
    return LeadAlongWall::none;
  }
  // Whether two ways along the contour are nowhere farther apart than `most`, mm.
  [[nodiscard]] bool stay_together(const ContourPlace& begin, double later, const ContourPlace& end,
                                   double on, double most) const {
    return go_together(begin, later, end, on,
                       [&](const ContourPlace& one, const ContourPlace& other) {
                         return (point_at(one) - point_at(other)).norm() <= most;
                       });
  }
  // Calls visit(place, place) along two ways, at the ends of their blocks and between these, as
  // long as it returns true. Returns whether it always has.
  template <class Visit>
  [[nodiscard]] bool go_together(ContourPlace begin, double later, ContourPlace end, double on,
                                 const Visit& visit) const {
    const auto go_on_together = [&](double share) {
      go_on(begin, later, share);
      go_on(end, on, share);
      return visit(begin, end);
    };
    // From one end of a block to the next one on either way, as shares of the way.
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
  // The share of a way from the place on that lies within its block.
  [[nodiscard]] double share_to_block_end(const ContourPlace& place, double way) const {
    const bool ends_there = way <= same_place_ || place.number + 1 == contour_.count;
    return ends_there ? 1 : left_of(place) / way;
  }
  void go_on(ContourPlace& place, double way, double share) const {
    const bool ends = share * way >= left_of(place) - same_place_;
    if (ends && place.number + 1 < contour_.count)
      place = {place.number + 1, 0};
    else
      place.along += share * way;
  }
  // Where the last lap passes the beginning of the overrun.
  [[nodiscard]] const ContourPlace& begin_of_last_lap() {
    if (last_lap_) return *last_lap_;
    const EndsMeeting best = std::exchange(*best_, overrun_.front());
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
  void take(const EndsMeeting& next) {
    best_ = next;
    overrun_.assign(1, next);
    gap_ = next.gap;
    joins_ = next.second.number;
    longest_ring_.reset();
    last_lap_.reset();
  }
  // Adds a meeting to the stretch of the one before.
  void note(const EndsMeeting& next) {
    gap_ = std::max(gap_, next.gap);
    joins_ = std::min(joins_, next.second.number);
    longest_ring_.reset();
  }
  // A lead-out in a slight curve is still near the first walls where one of them ends: the contour
  // closes where the lead-out begins.
  void end_before_lead_out() {
    const ContourPlace out = overrun_.back().second;
    if (is_block_end(out)) return;
    const auto begins_there = [&](const EndsMeeting& candidate) {
      const auto& [number, along] = candidate.second;
      if (number == out.number) return along <= same_place_;
      return number + 1 == out.number && is_block_end(candidate.second) && along > same_place_;
    };
    const auto begin = std::find_if(overrun_.rbegin(), overrun_.rend(), begins_there);
    if (begin != overrun_.rend()) overrun_.erase(begin.base(), overrun_.end());
  }
  // The end may cross the first lap where the last one, with round corners, does not pass any more:
  // the contour closes where as many laps pass as at the beginning of the overrun.
  void stay_with_all_laps() {
    const auto laps_at = [&](const EndsMeeting& candidate) {
      best_ = candidate;
      return laps_of(visits_of(contour_, closing(), most_on_top(), memory_));
    };
    const std::size_t laps = overrun_.size() > 1 ? laps_at(overrun_.front()) : 1;
    if (laps <= 1) {
      best_ = overrun_.back();
      return;
    }
    const auto behind = std::partition_point(
        overrun_.begin() + 1, overrun_.end(),
        [&](const EndsMeeting& candidate) { return laps_at(candidate) >= laps; });
    best_ = *std::prev(behind);
    // The end lies on the last lap within the tolerance of this test.
    gap_ = std::max(gap_, contour_.tolerances.on_top) + most_on_top();
  }
  // A lap may touch its own beginning (D-136).
  [[nodiscard]] Closing closing() const {
    const bool overruns = best_->before > overrun_.front().before + tolerance_;
    return {.first = best_->first,
            .second = best_->second,
            .point = best_->point,
            .gap = overruns ? std::max(gap_, most_on_top()) : gap_,
            .joins = joins_};
  }
  [[nodiscard]] double longest_ring() {
    if (!longest_ring_)
      longest_ring_ = trc::longest_ring(visits_of(contour_, closing(), tolerance_, memory_));
    return *longest_ring_;
  }

  const ContourView& contour_;
  double same_place_;
  double tolerance_;
  Overruns overruns_;
  std::pmr::memory_resource* memory_;
  std::optional<EndsMeeting> best_{};
  std::pmr::vector<EndsMeeting> overrun_;  // meetings of the stretch up to the best one
  double gap_ = 0;
  std::size_t joins_ = 0;
  std::optional<double> longest_ring_{};
  std::optional<ContourPlace> last_lap_{};
};

}  // namespace

std::optional<Closing> search_inward(const ContourView& contour, const MeetingsOfEnds& meetings,
                                     double tolerance, Overruns overruns,
                                     std::pmr::memory_resource* memory) {
  InwardSearch inward(contour, tolerance, overruns, memory);
  for (const EndsMeeting& meeting : meetings.may_close) inward.consider(meeting);
  return inward.result(meetings.all);
}

}  // namespace trc
