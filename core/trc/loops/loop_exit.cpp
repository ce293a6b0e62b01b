#include "core/trc/loops/loop_exit.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/along.h"
#include "core/geometry/distance.h"

namespace trc {
namespace {

// How far from the closing, in tool radii, the path may run into walls beyond it.
constexpr double near_closing = 2;

}  // namespace

// If the contour repeats its beginning or a lap, the path also comes back to the same point a lap
// later. That crossing leaves out the lap, so it counts only if nothing else leads on.
std::optional<LoopExit> LoopExits::find(const PathPiece& at, const Onset& onset,
                                        Nearness nearness) const {
  exits_over_laps_ = ExitsOverLaps::none_ignored;
  auto exit = find_any(at, onset, nearness);
  if (exit || exits_over_laps_ == ExitsOverLaps::none_ignored || nearness == Nearness::exact)
    return exit;
  exits_over_laps_ = ExitsOverLaps::allowed;
  return find_any(at, onset, nearness);
}

bool LoopExits::is_ignored(std::size_t from, std::size_t to) const {
  if (exits_over_laps_ == ExitsOverLaps::allowed ||
      !obstacles_.walls().goes_round(path_.number_of(from), path_.number_of(to)))
    return false;
  exits_over_laps_ = ExitsOverLaps::ignored;
  return true;
}

std::optional<LoopExit> LoopExits::find_any(const PathPiece& at, const Onset& onset,
                                            Nearness nearness) const {
  PathPiece piece = at;
  piece.to = onset.along;
  piece.end = point_along(path(at.block).path, onset.along);
  const std::vector<std::size_t>& obstacles =
      obstacles_.at(at.block, piece.end, onset.obstacle, nearness);
  ask_about(piece);
  crossings_of_.reset();
  // A path that has been within reach for long has crossed before the block now beside it.
  const bool beside_last = nearness == Nearness::passable;
  if (auto exit = first_here(piece, obstacles, beside_last ? Kind::crossing : Kind::any, nearness))
    return exit;
  for (const std::size_t number : obstacles)
    if (auto exit = exit_behind(at, {onset.along, number})) return exit;
  if (beside_last) {
    ask_about(piece);
    if (auto exit = first_here(piece, obstacles, Kind::beside, nearness)) return exit;
  }
  for (const std::size_t number : obstacles)
    if (auto exit = exit_behind_into_rest(at, {onset.along, number})) return exit;
  for (const std::size_t number : obstacles)
    if (auto exit = exit_by_lead_out(piece, {onset.along, number})) return exit;
  return std::nullopt;
}

// If the path passes one point several times, all continuations but the first may leave out legal
// stretches.
std::optional<LoopExit> LoopExits::first_here(const PathPiece& piece,
                                              const std::vector<std::size_t>& obstacles, Kind kind,
                                              Nearness nearness) const {
  std::optional<LoopExit> first;
  for (const std::size_t number : obstacles) {
    const auto exit = exit_here(piece, number, kind, nearness);
    if (!exit) continue;
    const bool same = first && (exit->point - first->point).norm() <= slack_of_places(tolerances_);
    if (!first || (same && exit->continues < first->continues)) first = exit;
  }
  return first;
}

LoopExits::BlocksAtObstacle LoopExits::blocks_at(std::size_t obstacle, std::size_t at) const {
  const std::size_t begin =
      obstacle > path_.begin_of_contour() ? contour(obstacle - 1).block : path_.begin();
  // Leads are never in the way: the path may leave the obstacle by any of them (D-38, D-137).
  std::size_t behind = obstacle + 1;
  while (behind < end_of_contour() && obstacles_.is_lead(behind)) ++behind;
  const std::size_t end = behind < end_of_contour() ? contour(behind).block + 1 : path_.end();
  return {std::max(begin, at + 1), end, obstacles_.is_lead(obstacle) || behind > obstacle + 1};
}

std::optional<LoopExit> LoopExits::exit_here(const PathPiece& piece, std::size_t obstacle,
                                             Kind kind, Nearness nearness) const {
  if (!has_near(blocks_at(obstacle, piece.block))) return std::nullopt;
  if (kind != Kind::beside)
    if (auto exit = crossing_in(piece, walked_.end(), obstacle, {})) return exit;
  if (kind == Kind::crossing) return std::nullopt;
  // Blocks side by side have no crossing, so their distance decides. The path comes nearer
  // to its own block by the distance it is moved over.
  const double radius = std::max(path_.radius_of_tool(piece.block), 1.0);
  const double part = nearness == Nearness::exact ? 4 * tolerances_.rounding : tolerances_.passable;
  for (const std::size_t block : near_) {
    if (path_.is_unreachable(block) || is_ignored(piece.block, block)) continue;
    const Segment segment = path(block).path;
    const double along = nearest_along(segment, piece.end);
    const Point point = point_along(segment, along);
    if ((point - piece.end).norm() <= part * radius)
      return LoopExit{walked_.end(), piece.to, {block, along}, point};
  }
  return std::nullopt;
}

std::optional<LoopExit> LoopExits::exit_behind(const PathPiece& at, const Onset& onset) const {
  return last_of_walked(onset, blocks_at(onset.obstacle, at.block), {});
}

std::optional<LoopExit> LoopExits::exit_behind_into_rest(const PathPiece& at,
                                                         const Onset& onset) const {
  const std::size_t next = path_.number_of(at.block) + 1;
  const std::size_t end = next < end_of_contour() ? contour(next).block + 1 : path_.end();
  const bool by_lead =
      onset.obstacle + 1 < end_of_contour() && obstacles_.is_lead(onset.obstacle + 1);
  return last_of_walked(onset, {at.block, end, by_lead},
                        {at.block, onset.along + slack_of_places(tolerances_)});
}

std::optional<LoopExit> LoopExits::exit_by_lead_out(const PathPiece& piece,
                                                    const Onset& onset) const {
  const std::size_t number = path_.number_of(piece.block);
  const std::size_t lead_out = obstacles_.begin_of_lead_out();
  if (lead_out == end_of_contour() || number >= lead_out || onset.obstacle >= number)
    return std::nullopt;
  const double near = near_closing * path_.radius_of_tool(piece.block);
  if (walls_between(obstacles_.walls().head.first, onset.obstacle, near) > near ||
      walls_between(number + 1, lead_out, near) > near)
    return std::nullopt;
  const BlocksAtObstacle blocks{contour(lead_out).block, path_.end(), true};
  ask_about(piece);
  if (has_near(blocks))
    if (auto exit = crossing_in(piece, walked_.end(), onset.obstacle, {})) return exit;
  return last_of_walked(onset, blocks, {});
}

double LoopExits::walls_between(std::size_t first, std::size_t end, double most) const {
  double length = 0;
  for (; first < end && length <= most; ++first) length += obstacles_.wall_length(first);
  return length;
}

std::optional<LoopExit> LoopExits::last_of_walked(const Onset& onset,
                                                  const BlocksAtObstacle& blocks,
                                                  const PathPlace& least) const {
  const HeldPath::ContourBlock obstacle = contour(onset.obstacle);
  // A lead may come back to the path anywhere nearby.
  double rest = blocks.holds_leads ? 8 * path_.largest_radius(obstacle) : 0;
  for (std::size_t number = walked_.end(); number-- > walked_.begin();) {
    const PathPiece walked = walked_[number];
    if (reaches_out(obstacle, walked.end) && rest <= 0) break;
    rest -= walked.to - walked.from;
    ask_about(walked);
    if (has_near(blocks))
      if (auto exit = crossing_in(walked, number, onset.obstacle, least)) return exit;
  }
  return std::nullopt;
}

// A crossing may lie up to the slack beyond the ends of its segments, and its two places as far
// apart; the ends of a piece may be off its block after a loop has been left out. These points are
// not exact to the last digits, but the error is less than the width of one point.
void LoopExits::ask_about(const PathPiece& piece) const {
  checkpoint_.pass();
  asked_ = {.area = path_.box_about(piece.block, piece.start, piece.end),
            .reach = 3 * slack_of_places(tolerances_) + tolerances_.same_point +
                     tolerances_.passable * std::max(path_.radius_of_tool(piece.block), 1.0)};
}

bool LoopExits::has_near(const BlocksAtObstacle& blocks) const {
  near_.clear();
  for (std::size_t block = blocks.first; block < blocks.end; ++block)
    if (squared_distance(asked_.area, path_.box_about(block)) <= asked_.reach * asked_.reach)
      near_.push_back(block);
  return !near_.empty();
}

std::optional<LoopExit> LoopExits::crossing_in(const PathPiece& piece, std::size_t number,
                                               std::size_t obstacle, const PathPlace& least) const {
  const double slack = slack_of_places(tolerances_);
  std::optional<LoopExit> latest;
  for (const std::size_t block : near_) {
    if (is_ignored(piece.block, block)) continue;
    for (const Crossing& crossing : crossings_of(piece.block, block)) {
      if (crossing.along_first < piece.from - slack || crossing.along_first > piece.to + slack)
        continue;
      if (latest && crossing.along_first < latest->leaves - slack) continue;
      const double least_along = block == least.block ? least.along : 0;
      const double along = place_not_before(least_along, crossing.along_second, block);
      if (along < least_along) continue;
      const bool by_lead = obstacles_.is_lead(path_.number_of(piece.block)) ||
                           obstacles_.is_lead(path_.number_of(block));
      if (!by_lead && reaches_out(contour(obstacle), crossing.point)) continue;
      latest = LoopExit{
          number, std::max(crossing.along_first, piece.from), {block, along}, crossing.point};
    }
  }
  return latest;
}

// A circle ends where it begins.
double LoopExits::place_not_before(double least, double along, std::size_t block) const {
  const bool is_begin = along <= slack_of_places(tolerances_);
  if (along >= least || !is_begin || path_.begins_at(block) != path_.ends_at(block)) return along;
  return length_of(path(block).path);
}

std::span<const Crossing> LoopExits::crossings_of(std::size_t block, std::size_t other) const {
  if (!crossings_of_ || crossings_of_->block != block) {
    const Segment segment = path(block).path;
    known_.clear();
    crossings_of_ = {.block = block};
    if (!has_no_radius(segment)) crossings_of_->track.emplace(segment);
  }
  const auto known = std::find_if(known_.begin(), known_.end(),
                                  [&](const Known& its) { return its.other == other; });
  if (known != known_.end()) return known->crossings;
  Crossings& found = known_.emplace_back(Known{.other = other}).crossings;
  const Segment segment = path(other).path;
  const std::optional<Track>& track = crossings_of_->track;
  if (track && !path_.is_unreachable(other) && !has_no_radius(segment))
    found = crossings(*track, Track(segment), slack_of_places(tolerances_));
  return found;
}

bool LoopExits::reaches_out(const HeldPath::ContourBlock& block, const Point& point) const {
  return distance(point, block.programmed) > path_.largest_radius(block) + tolerances_.same_point;
}

}  // namespace trc
