#include "core/trc/walls/closing_watch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "core/geometry/along.h"
#include "core/geometry/distance.h"
#include "core/trc/walls/end_meetings.h"

namespace trc {
namespace {

// Prefixes of the contour that seem to close, but do not, are examined this often at most.
constexpr int most_tries = 64;

// The contour up to and with the block.
ContourView up_to(const ContourView& contour, std::size_t number) {
  ContourView part = contour;
  part.count = number + 1;
  return part;
}

}  // namespace

void ClosingWatch::BlockRun::add(const Segment& block) {
  ++blocks;
  length += length_of(block);
}

bool ClosingWatch::BlockRun::is_beyond_leads(double tool_radius) const {
  return blocks >= blocks_at_ends && length >= reach_of_ends * tool_radius;
}

void ClosingWatch::begin() {
  const bool finds_leads = settings_.find == LeadSettings::Find::automatic;
  phase_ = window_ > 0 && finds_leads ? Phase::open : Phase::over;
  tool_radius_ = 0;
  head_ = behind_head_ = behind_closing_ = {};
  head_is_complete_ = false;
  candidate_ = {};
  scanned_ = 0;
  tries_ = 0;
  lap_before_ = last_lap_ = 0;
}

void ClosingWatch::note(std::size_t number, const Segment& programmed, double tool_radius) {
  if (phase_ == Phase::over) return;
  tool_radius_ = std::max(tool_radius_, tool_radius);
  if (phase_ == Phase::laps) return note_lap(number, programmed);
  if (!head_is_complete_) {
    head_is_complete_ = head_.is_beyond_leads(tool_radius_);
    if (!head_is_complete_) return head_.add(programmed);
  }
  // A block is seen with the head up to a window after it, and may wait for a window of its own.
  if (number < head_end() + 2 * window_) return;
  behind_head_.add(programmed);
  if (behind_head_.is_beyond_leads(tool_radius_) && !candidate_.is_found) phase_ = Phase::over;
}

void ClosingWatch::note_lap(std::size_t number, const Segment& programmed) {
  if ((start_of(programmed) - where_laps_begin_).norm() <= settings_.closing_tolerance) {
    lap_before_ = std::exchange(last_lap_, number);
    behind_closing_ = {};
  }
  behind_closing_.add(programmed);
}

bool ClosingWatch::is_undecided(std::size_t one, std::size_t other) const {
  switch (phase_) {
    case Phase::open:
      return std::min(one, other) < head_end() ||
             (candidate_.is_found && std::max(one, other) >= candidate_.closes_with);
    case Phase::laps:
      return std::max(one, other) >= last_lap_ && !behind_closing_.is_beyond_leads(tool_radius_);
    case Phase::over:
      break;
  }
  return false;
}

std::optional<Walls> ClosingWatch::find_lead_in(const ContourView& contour, const BoxTree& boxes) {
  if (phase_ != Phase::open) return std::nullopt;
  while (true) {
    find_candidate(contour, boxes);
    if (!candidate_.is_found || !goes_on_behind_candidate(contour)) return std::nullopt;
    if (candidate_.goes_along) return begin_laps(contour);
    candidate_ = {};
  }
}

void ClosingWatch::find_candidate(const ContourView& contour, const BoxTree& boxes) {
  for (; !candidate_.is_found && scanned_ < contour.count && tries_ < most_tries; ++scanned_) {
    contour.pass();
    if (!touches_head(contour, boxes, scanned_)) continue;
    ++tries_;
    const auto closing =
        find_closing(up_to(contour, scanned_), settings_.closing_tolerance, tool_radius_);
    if (!closing) continue;
    where_laps_begin_ = closing->point;
    behind_closing_ = {};
    candidate_ = {.is_found = true,
                  .closes_with = scanned_,
                  .next_wall = closing->first.number,
                  .seen = scanned_ + 1};
  }
}

// At least half of what has come lies between the two, roughly; one arc may be a whole lap.
bool ClosingWatch::touches_head(const ContourView& contour, const BoxTree& boxes,
                                std::size_t number) const {
  const Segment block = contour.segment(number);
  const auto* arc = std::get_if<Arc>(&block);
  if (arc != nullptr && std::abs(arc->sweep) >= std::numbers::pi) return true;
  if (number < 2) return false;
  const double near = settings_.closing_tolerance;
  const std::size_t end = std::min({head_end(), number - 1, number / 2 + 1});
  bool touches = false;
  boxes.for_each_near(bounding_box(block), near, {end, contour.count}, [&](std::size_t first) {
    touches =
        touches ||
        nearness(contour.segment(first), block, contour.tolerances.same_point).distance <= near;
  });
  return touches;
}

bool ClosingWatch::goes_on_behind_candidate(const ContourView& contour) {
  for (; candidate_.seen < contour.count; ++candidate_.seen) {
    if (behind_closing_.is_beyond_leads(tool_radius_)) return true;
    contour.pass();
    const Segment block = contour.segment(candidate_.seen);
    behind_closing_.add(block);
    if (!candidate_.goes_along) continue;
    const Point middle = point_along(block, length_of(block) / 2);
    const std::size_t last = std::min(candidate_.next_wall + blocks_at_ends, candidate_.seen);
    candidate_.goes_along = false;
    for (std::size_t wall = candidate_.next_wall; wall < last && !candidate_.goes_along; ++wall) {
      if (distance(middle, contour.segment(wall)) > contour.tolerances.on_top) continue;
      candidate_.next_wall = wall;
      candidate_.goes_along = true;
    }
  }
  return behind_closing_.is_beyond_leads(tool_radius_);
}

Walls ClosingWatch::begin_laps(const ContourView& contour) {
  const std::size_t end = candidate_.closes_with + 1;
  Walls walls = find_walls(up_to(contour, candidate_.closes_with), settings_, tool_radius_);
  // What follows is no lead-out.
  std::erase_if(walls.leads, [](const Walls::Range& leads) { return leads.first > 0; });
  std::erase_if(walls.parts,
                [&](const Walls::Part& part) { return part.number >= walls.head.end; });
  walls.tail.end = end + walls.head.end;
  walls.rings = {end};
  walls.touch_of_rings = std::min(contour.tolerances.on_top, settings_.closing_tolerance);
  phase_ = Phase::laps;
  lap_before_ = last_lap_ = end;
  for (std::size_t number = end; number < contour.count; ++number)
    note_lap(number, contour.segment(number));
  return walls;
}

}  // namespace trc
