#include "core/trc/loop_removal.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/along.h"
#include "core/geometry/distance.h"
#include "core/trc/removed_loop.h"
#include "core/trc/selection_limit.h"

namespace trc {
namespace {

// Approach and retract have their own rules (D-11).
bool is_compensated(const PathBlock& block) {
  return block.role == Role::contour ||
         (block.role == Role::inserted &&
          (block.origin == Origin::transition || block.origin == Origin::radius_change));
}

// Where places along a block count as one.
double slack_of(const Tolerances& tolerances) { return 0.01 * tolerances.same_point; }

// It turns on the spot: where it begins, the block before it ends.
bool has_no_radius(const Segment& segment) {
  const auto* arc = std::get_if<Arc>(&segment);
  return arc != nullptr && arc->start == arc->center;
}

}  // namespace

bool LoopRemoval::feed(PathBlockPtr block, PathBlocks& out) {
  if (leaving_) {
    behind_.push_back(std::move(block));
    return true;
  }
  const bool enters = block->role == Role::inserted && block->origin == Origin::approach;
  const bool belongs =
      block->removes_loops() && (block->role == Role::approach || enters || is_compensated(*block));
  const bool goes_on = is_compensated(*block) && !block->perpendicular_entry;
  if (is_holding() && (!belongs || (!goes_on && end_of_contour() > 0))) {
    behind_.push_back(std::move(block));
    return end_selection();
  }
  if (!belongs) {
    out.push_back(std::move(block));
    return true;
  }
  if (!is_compensated(*block)) {
    entering_.push_back(std::move(block));
    return true;
  }
  return take(*block, out);
}

bool LoopRemoval::drain(PathBlocks& /*out*/) {
  ended_ = true;
  return leaving_ || end_selection();
}

bool LoopRemoval::end_selection() {
  leaving_ = is_holding();
  if (!walk(true)) return false;
  // Nothing is near anything any more.
  boxes_ = BoxTree();
  piece_boxes_ = BoxTree();
  certificate_ = Certificate(tolerances_);
  return true;
}

bool LoopRemoval::let_go_some(PathBlocks& out) {
  constexpr std::size_t portion = 32;  // whose storage is the same for each
  let_go_to(std::min(pieces_.begin() + portion, pieces_.end()), out);
  if (!pieces_.empty()) {
    path_.forget_path_before(next_);
    return true;
  }
  if (next_ < end_of_path()) pass_by(end_of_path(), at_.start, out);
  begin_selection();
  for (PathBlockPtr& block : std::exchange(behind_, {}))
    if (!feed(std::move(block), out)) return false;
  return !ended_ || leaving_ || end_selection();
}

bool LoopRemoval::let_go_next(PathBlock& block) {
  if (!entering_.empty() || pieces_.empty()) return false;
  const auto& [at, cut] = pieces_[pieces_.begin()];
  if (cut != Kept::whole || at != next_) return false;
  path_.restore(at, block);
  next_ = at + 1;
  pieces_.drop_before(pieces_.begin() + 1);
  constexpr std::size_t now_and_then = 32;
  if (at % now_and_then == 0) path_.forget_path_before(at);
  return true;
}

void LoopRemoval::begin_selection() {
  entering_.clear();
  path_ = HeldPath();
  largest_radius_ = 0;
  boxes_ = BoxTree();
  apart_ = false;
  certificate_ = Certificate(tolerances_);
  pieces_ = NumberedQueue<Kept>();
  cuts_ = NumberedQueue<Piece>();
  first_of_chain_ = 0;
  piece_boxes_ = BoxTree();
  walking_ = false;
  at_ = {};
  tolerated_ = {};
  next_ = 0;
  leaving_ = false;
  surveyed_ = {};
  near_.clear();
}

bool LoopRemoval::has_room_for(const PathBlock& block) {
  const std::size_t most = path_.blocks().end() < HeldPath::most_blocks / 4 ? selection_blocks_ : 0;
  return path_.blocks().size() < most ||
         diagnostics_.report(selection_too_long(block, selection_blocks_));
}

bool LoopRemoval::hold(PathBlock& block) {
  if (!has_room_for(block)) return false;
  largest_radius_ =
      std::max({largest_radius_, std::abs(block.at_start.shift), std::abs(block.at_end.shift)});
  path_.append(block);
  if (block.role == Role::contour) {
    note_contour_block(block);
  } else {
    apart_ = apart_ || block.unreachable;
  }
  return true;
}

void LoopRemoval::note_contour_block(const PathBlock& block) {
  certificate_.append(block, std::exchange(apart_, false));
  const Box area = bounding_box(block.programmed.path);
  boxes_.append(area);
  if (window_ > 0) reconsider(end_of_contour() - 1, area);
}

// A new contour block may come near to what has been walked without it: from there
// the path is walked again.
void LoopRemoval::reconsider(std::size_t number, const Box& area) {
  const std::size_t chain = certificate_.chain_before(number);
  first_of_chain_ = std::clamp(first_of_chain_, pieces_.begin(), pieces_.end());
  while (first_of_chain_ < pieces_.end() && number_of(pieces_[first_of_chain_].block) < chain)
    ++first_of_chain_;
  if (first_of_chain_ == pieces_.begin()) return;
  const Segment& obstacle = contour(number).programmed;
  std::size_t earliest = pieces_.end();
  const auto compare = [&](std::size_t index) {
    if (index >= earliest) return;
    const Piece walked = piece(index);
    const std::size_t own = number_of(walked.block);
    if (own + window_ < number) return;
    if (first_entry(path(walked.block).path, walked.from, walked.to, obstacle,
                    reach(walked.block, Nearness::exact)))
      earliest = index;
  };
  piece_boxes_.for_each_near(area, largest_radius_, {first_of_chain_, pieces_.end()}, compare);
  if (earliest == pieces_.end()) return;
  at_ = piece(earliest);
  drop_pieces(earliest);
  tolerated_ = {};
}

void LoopRemoval::rebuild_boxes() {
  const auto& contour = path_.contour();
  boxes_ = BoxTree(contour.begin());
  for (std::size_t number = contour.begin(); number < contour.end(); ++number)
    boxes_.append(bounding_box(contour[number].programmed));
  piece_boxes_ = BoxTree(pieces_.begin());
  for (std::size_t number = pieces_.begin(); number < pieces_.end(); ++number)
    piece_boxes_.append(bounding_box(path(pieces_[number].block).path));
}

LoopRemoval::Piece LoopRemoval::piece(std::size_t number) const {
  const auto& [block, cut] = pieces_[number];
  if (cut != Kept::whole) return cuts_[cut];
  const Segment& segment = path(block).path;
  return {
      .block = block, .to = length_of(segment), .start = start_of(segment), .end = end_of(segment)};
}

void LoopRemoval::keep_cut() {
  pieces_.push_back(
      {static_cast<HeldPath::Number>(at_.block), static_cast<HeldPath::Number>(cuts_.end())});
  cuts_.push_back(at_);
  if (window_ > 0) piece_boxes_.append(bounding_box(path(at_.block).path));
}

void LoopRemoval::drop_pieces(std::size_t kept) {
  for (std::size_t number = pieces_.end(); number-- > kept;)
    if (pieces_[number].cut != Kept::whole) cuts_.truncate(pieces_[number].cut);
  pieces_.truncate(kept);
  first_of_chain_ = std::min(first_of_chain_, kept);
  if (window_ > 0) piece_boxes_.truncate(kept);
}

bool LoopRemoval::proceed(PathBlocks& out) {
  if (!walk(false)) return false;
  std::size_t due = pieces_.begin();
  while (due < pieces_.end() && is_known(pieces_[due].block, window_, false)) ++due;
  let_go_to(due, out);
  forget();
  return true;
}

// Drops what no window reaches any more.
void LoopRemoval::forget() {
  piece_boxes_.drop_before(pieces_.begin());
  if (next_ >= end_of_path()) return;
  const std::size_t number = number_of(next_);
  // Some more than the window, now and then.
  const std::size_t some = std::min<std::size_t>(window_ / 8, 64);
  if (number <= path_.contour().begin() + window_ + 1 + some) return;
  const std::size_t keep = number - window_ - 1;
  path_.forget_before(keep);
  boxes_.drop_before(keep);
  certificate_.drop_before(keep);
}

bool LoopRemoval::is_known(std::size_t block, std::size_t lead, bool ended) const {
  return ended || number_of(block) + lead < end_of_contour();
}

double LoopRemoval::part_of(Nearness nearness) const {
  return nearness == Nearness::exact ? tolerances_.rounding : tolerances_.passable;
}

double LoopRemoval::reach(std::size_t block, Nearness nearness) const {
  const double radius = path_.radius_of_tool(block);
  return radius - part_of(nearness) * std::max(radius, 1.0);
}

BoxTree::Range LoopRemoval::certified(std::size_t block) const {
  const std::size_t number = number_of(block);
  if (path(block).unreachable) return {};
  if (path(block).is_contour())
    return {certificate_.chain_before(number), certificate_.chain_behind(number)};
  // A transition belongs to the blocks on both sides of the corner.
  const std::size_t behind = number + 1;
  if (behind >= end_of_contour() || certificate_.chain_before(behind) > number) return {};
  return {certificate_.chain_before(behind), certificate_.chain_behind(number)};
}

void LoopRemoval::find_neighbours(std::size_t block, double limit) const {
  const Box area = bounding_box(path(block).path);
  const BoxTree::Range skipped = certified(block);
  const std::size_t own = number_of(block);
  // Only an arc turned inside out comes too near to its own block.
  const bool sees_own = !path(block).is_contour() || path(block).unreachable;
  neighbours_.clear();
  // All that can be seen is certified.
  if (window_ > 0 && skipped.first + window_ <= std::max(own, path_.contour().begin() + window_) &&
      skipped.last + 1 >= std::min(own + window_ + 1, end_of_contour()))
    return;
  const auto add = [&](std::size_t number) {
    checkpoint_.pass();
    const bool visible = window_ == 0 || (number <= own + window_ && own <= number + window_);
    if (visible && (sees_own || number != own)) neighbours_.push_back(number);
  };
  if (block < surveyed_.first || block >= surveyed_.end) {
    boxes_.for_each_near(area, limit, skipped, add);
    return;
  }
  near_.for_each_near(area, limit, [&](std::size_t number) {
    if (number < skipped.first || number > skipped.last) add(number);
  });
}

std::optional<LoopRemoval::Onset> LoopRemoval::onset(std::size_t block, double from, double to,
                                                     Nearness nearness) const {
  const double limit = reach(block, nearness);
  if (!(from < to) || limit <= 0) return std::nullopt;
  find_neighbours(block, limit);
  if (neighbours_.empty()) return std::nullopt;
  const Segment& segment = path(block).path;
  PathPart part(segment, from, to);
  std::optional<Onset> first;
  const auto compare = [&](std::size_t number) {
    const auto entry = part.first_entry(contour(number).programmed, limit);
    if (!entry) return false;
    first = {*entry, number};
    part = PathPart(segment, from, *entry);
    return true;
  };
  // What is nearest halfway is run into before that: with less and less of the block at stake
  // most of the others are out of question.
  while (are_many() && part.half_length() > 0) {
    const std::optional<std::size_t> nearest = drop_those_off(part, limit);
    if (!nearest || !compare(*nearest)) break;
  }
  for (const std::size_t number : neighbours_) compare(number);
  return first;
}

bool LoopRemoval::comes_nearer(std::size_t block, double from, double to, Nearness nearness) const {
  const double limit = reach(block, nearness);
  if (!(from < to) || limit <= 0) return false;
  find_neighbours(block, limit);
  if (neighbours_.empty()) return false;
  const PathPart part(path(block).path, from, to);
  const auto is_entered = [&](std::size_t number) {
    return part.first_entry(contour(number).programmed, limit).has_value();
  };
  if (are_many()) {
    const std::optional<std::size_t> nearest = drop_those_off(part, limit);
    if (nearest && is_entered(*nearest)) return true;
  }
  return std::any_of(neighbours_.begin(), neighbours_.end(), is_entered);
}

std::optional<std::size_t> LoopRemoval::drop_those_off(const PathPart& part, double limit) const {
  const double half = part.half_length();
  std::optional<std::size_t> nearest;
  double least = limit;
  std::erase_if(neighbours_, [&](std::size_t number) {
    const double apart = distance(part.middle(), contour(number).programmed);
    if (apart < least) {
      nearest = number;
      least = apart;
    }
    return apart >= limit + half;
  });
  return nearest;
}

// Asks for many blocks at once: they have nearly the same neighbours, and mostly none.
void LoopRemoval::survey() {
  constexpr std::size_t group = 32;
  surveyed_ = {at_.block, std::min(at_.block + group, end_of_path())};
  near_.clear();
  Box area;
  double radius = 0;
  BoxTree::Range common{0, end_of_contour()};
  for (std::size_t block = surveyed_.first; block < surveyed_.end; ++block) {
    area.extend(bounding_box(path(block).path));
    radius = std::max(radius, path_.radius_of_tool(block));
    const BoxTree::Range own = certified(block);
    common = {std::max(common.first, own.first), std::min(common.last, own.last)};
  }
  boxes_.for_each_near(area, radius, common,
                       [&](std::size_t number) { near_.add(number, boxes_[number]); });
}

std::optional<LoopRemoval::Onset> LoopRemoval::next_onset(bool ended) {
  // Before the end of the contour new neighbours come with every block.
  if (ended) {
    if (at_.block < surveyed_.first || at_.block >= surveyed_.end) survey();
    if (near_.empty()) return std::nullopt;
  }
  const double length = length_of(path(at_.block).path);
  double from = at_.from;
  if (tolerated_.block >= at_.block) {
    const double to = tolerated_.block > at_.block ? length : std::min(length, tolerated_.along);
    if (const auto found = onset(at_.block, from, to, Nearness::passable)) return found;
    from = std::max(from, to);
  }
  return onset(at_.block, from, length, Nearness::exact);
}

bool LoopRemoval::walk(bool ended) {
  if (!walking_ && !begin_walk(ended)) return false;
  while (walking_ && at_.block < end_of_path() && is_known(at_.block, 1, ended)) {
    checkpoint_.pass();
    const auto found = next_onset(ended);
    if (!found) {
      advance();
      continue;
    }
    switch (leave(*found, ended)) {
      case Step::done:
        break;
      case Step::wait:
        return true;
      case Step::stop:
        return false;
    }
  }
  return true;
}

bool LoopRemoval::begin_walk(bool ended) {
  if (path_.blocks().empty() || !is_known(0, window_, ended)) return true;
  walking_ = true;
  at_ = {.block = 0, .start = start_of(path(0).path)};
  // The approach leads to the first point, which therefore has to stay (D-11).
  const auto at_start = onset(0, 0, length_of(path(0).path), Nearness::passable);
  return !at_start || at_start->along > 0 || refuse(*at_start);
}

// To the end of the block and on to the next one.
void LoopRemoval::advance() {
  const Segment& segment = path(at_.block).path;
  // The corner behind a loop gets a circle of its own, for the whole turn.
  if (at_.behind_loop && has_no_radius(segment)) {
    ++at_.block;
    return;
  }
  if (at_.from == 0 && !at_.behind_loop && at_.start == start_of(segment)) {
    pieces_.push_back({.block = static_cast<HeldPath::Number>(at_.block)});
    if (window_ > 0) piece_boxes_.append(bounding_box(segment));
    ++at_.block;
    at_.start = end_of(segment);
    return;
  }
  at_.to = length_of(segment);
  at_.end = end_of(segment);
  keep_cut();
  at_ = {.block = at_.block + 1, .start = end_of(segment)};
}

LoopRemoval::Step LoopRemoval::leave(const Onset& onset, bool ended) {
  // The transition behind the obstacle comes with the next block.
  const bool complete = ended || onset.obstacle + 1 < end_of_contour();
  if (!complete && !is_known(at_.block, window_, ended)) return Step::wait;
  const Place here{at_.block, onset.along};
  const bool tolerated = here < tolerated_;
  const auto exit = find_exit(onset, tolerated ? Nearness::passable : Nearness::exact);
  if (exit && violates(here, exit->continues, onset.obstacle)) {
    // Between the exit and the onset a block that is yet to come may be in the way.
    const bool behind = exit->piece < pieces_.end();
    if (behind && !is_known(pieces_[exit->piece].block, window_, ended)) return Step::wait;
    jump(*exit);
    return Step::done;
  }
  // A block that is yet to come may lead away before, or be in the way of the loop.
  if (!is_known(at_.block, window_, ended)) return Step::wait;
  if (exit && !tolerated) {
    tolerated_ = exit->continues;
    return Step::done;
  }
  if (tolerated) return refuse(onset) ? Step::done : Step::stop;
  // No way on from here, but it may not be needed.
  const double length = length_of(path(at_.block).path);
  const auto serious = this->onset(at_.block, onset.along, length, Nearness::passable);
  if (!serious) {
    tolerated_ = {at_.block, length};
    return Step::done;
  }
  if (const auto late = find_exit(*serious, Nearness::passable)) {
    jump(*late);
    return Step::done;
  }
  return refuse(*serious) ? Step::done : Step::stop;
}

bool LoopRemoval::runs_backwards(std::size_t block) const {
  const HeldPath::Block& travelled = path(block);
  if (!travelled.is_contour()) return false;
  const Segment& programmed = contour(travelled.number).programmed;
  if (const auto* arc = std::get_if<Arc>(&travelled.path)) {
    const auto* circle = std::get_if<Arc>(&programmed);
    return circle != nullptr && arc->sweep * circle->sweep < 0 &&
           length_of(*arc) > tolerances_.on_contour;
  }
  const Vector way = end_of(travelled.path) - start_of(travelled.path);
  return way.dot(tangent_at_start(programmed)) < -tolerances_.on_contour;
}

bool LoopRemoval::violates(const Place& from, const Place& to, std::size_t obstacle) const {
  for (std::size_t block = from.block; block <= to.block; ++block) {
    const Segment& segment = path(block).path;
    const double length = length_of(segment);
    const double begin = block == from.block ? from.along : 0;
    const double end = block == to.block ? std::min(to.along, length) : length;
    // Mostly it is what the loop begins at: one of the neighbours there, which need not be found.
    const double limit = reach(block, Nearness::passable);
    if (block == from.block && begin < end && limit > 0 &&
        first_entry(segment, begin, end, contour(obstacle).programmed, limit))
      return true;
    const bool whole = block != from.block && block != to.block;
    if (whole && (path(block).unreachable || runs_backwards(block))) return true;
    if (comes_nearer(block, begin, end, Nearness::passable)) return true;
  }
  return false;
}

std::optional<LoopRemoval::Exit> LoopRemoval::find_exit(const Onset& onset,
                                                        Nearness nearness) const {
  const std::vector<std::size_t> obstacles = obstacles_at(onset, nearness);
  // Where the path is in one point again and again, all continuations but the first may leave out
  // what is legal.
  std::optional<Exit> first;
  for (const std::size_t number : obstacles) {
    const auto exit = exit_here({onset.along, number}, nearness);
    if (!exit) continue;
    const bool same = first && (exit->point - first->point).norm() <= slack_of(tolerances_);
    if (!first || (same && exit->continues < first->continues)) first = exit;
  }
  if (first) return first;
  for (const std::size_t number : obstacles)
    if (auto exit = exit_behind({onset.along, number})) return exit;
  return std::nullopt;
}

std::vector<std::size_t> LoopRemoval::obstacles_at(const Onset& onset, Nearness nearness) const {
  std::vector<std::size_t> numbers{onset.obstacle};
  const Point place = point_along(path(at_.block).path, onset.along);
  const double limit = reach(at_.block, nearness) + tolerances_.same_point;
  boxes_.for_each_near(Box(place), limit, [&](std::size_t number) {
    const HeldPath::ContourBlock& other = contour(number);
    if (number == onset.obstacle || other.block == at_.block) return;
    if (distance(place, other.programmed) <= limit) numbers.push_back(number);
  });
  return numbers;
}

LoopRemoval::Stretch LoopRemoval::stretch_about(std::size_t obstacle) const {
  const std::size_t begin =
      obstacle > path_.contour().begin() ? contour(obstacle - 1).block : path_.blocks().begin();
  const std::size_t end =
      obstacle + 1 < end_of_contour() ? contour(obstacle + 1).block + 1 : end_of_path();
  return {std::max(begin, at_.block + 1), end};
}

std::optional<LoopRemoval::Exit> LoopRemoval::exit_here(const Onset& onset,
                                                        Nearness nearness) const {
  const auto [first, end] = stretch_about(onset.obstacle);
  if (first >= end) return std::nullopt;
  Piece piece = at_;
  piece.to = onset.along;
  if (auto exit = crossing_in(piece, pieces_.end(), onset.obstacle, true)) return exit;
  // Side by side there is no crossing to be had, but the distance tells. By as much as
  // the path is moved over it comes nearer to its own block.
  const Point place = point_along(path(at_.block).path, onset.along);
  const double radius = std::max(path_.radius_of_tool(at_.block), 1.0);
  const double part = nearness == Nearness::exact ? 4 * tolerances_.rounding : tolerances_.passable;
  for (std::size_t block = first; block < end; ++block) {
    const Segment& segment = path(block).path;
    if (are_apart(Box(place), bounding_box(segment), part * radius)) continue;
    const double along = nearest_along(segment, place);
    const Point point = point_along(segment, along);
    if (!path(block).unreachable && (point - place).norm() <= part * radius)
      return Exit{pieces_.end(), onset.along, {block, along}, point};
  }
  return std::nullopt;
}

std::optional<LoopRemoval::Exit> LoopRemoval::exit_behind(const Onset& onset) const {
  const HeldPath::ContourBlock& obstacle = contour(onset.obstacle);
  // Only a mitre reaches farther out than the tool.
  const auto reach_in_radii = [&](std::size_t block) {
    const TrcMode& mode = path_.mode_of(block);
    return mode.transition == Transition::linear ? mode.options.stretch_factor : 1;
  };
  const double farthest = 4 * path_.largest_radius(obstacle) *
                          (1 + std::max(reach_in_radii(at_.block), reach_in_radii(obstacle.block)));
  double back = onset.along - at_.from;
  bool beside = true;
  for (std::size_t number = pieces_.end(); number-- > pieces_.begin() && back <= farthest;) {
    const Piece walked = piece(number);
    beside = beside && !reaches_out(obstacle, walked.end);
    if (auto exit = crossing_in(walked, number, onset.obstacle, beside)) return exit;
    back += walked.to - walked.from;
  }
  return std::nullopt;
}

std::optional<LoopRemoval::Exit> LoopRemoval::crossing_in(const Piece& piece, std::size_t number,
                                                          std::size_t obstacle, bool beside) const {
  checkpoint_.pass();
  const double slack = slack_of(tolerances_);
  const Segment& segment = path(piece.block).path;
  if (has_no_radius(segment)) return std::nullopt;
  const auto [first, end] = stretch_about(obstacle);
  const Box area = bounding_box(segment);
  std::optional<Exit> latest;
  for (std::size_t block = first; block < end; ++block) {
    if (path(block).unreachable || has_no_radius(path(block).path)) continue;
    if (are_apart(area, bounding_box(path(block).path), 3 * slack)) continue;
    for (const Crossing& crossing : crossings(segment, path(block).path, slack)) {
      if (crossing.along_first < piece.from - slack || crossing.along_first > piece.to + slack)
        continue;
      if (latest && crossing.along_first < latest->leaves - slack) continue;
      const bool leads_to_it = beside && !reaches_out(contour(obstacle), crossing.point);
      if (!leads_to_it && !reaches_out(contour(number_of(piece.block)), crossing.point) &&
          !reaches_out(contour(number_of(block)), crossing.point))
        continue;
      latest = Exit{number,
                    std::max(crossing.along_first, piece.from),
                    {block, crossing.along_second},
                    crossing.point};
    }
  }
  return latest;
}

// Segments cross in places that are up to `slack` beyond their ends and as far from each other.
// Points of theirs are not computed to the last digits; what is farther apart than one point may be
// wide is so all the same.
bool LoopRemoval::are_apart(const Box& one, const Box& other, double reach) const {
  const double farthest = reach + tolerances_.same_point;
  return squared_distance(one, other) > farthest * farthest;
}

bool LoopRemoval::reaches_out(const HeldPath::ContourBlock& block, const Point& point) const {
  return distance(point, block.programmed) > path_.largest_radius(block) + tolerances_.same_point;
}

void LoopRemoval::jump(const Exit& exit) {
  const double slack = slack_of(tolerances_);
  if (exit.piece < pieces_.end()) {
    at_ = piece(exit.piece);
    drop_pieces(exit.piece);
  }
  Place next = exit.continues;
  Point point = exit.point;
  const Segment& segment = path(next.block).path;
  if (length_of(segment) - next.along <= slack) {
    point = end_of(segment);
    next = {next.block + 1, 0};
  } else if (next.along <= slack) {
    point = start_of(segment);
    next.along = 0;
  }
  // What rounding leaves of a block is not worth one, but the approach and the retract
  // know the first and the last point.
  const bool outermost = at_.block == 0 || next.block >= end_of_path();
  if (exit.leaves - at_.from > slack || outermost) {
    at_.to = exit.leaves;
    at_.end = point;
    keep_cut();
  } else {
    point = at_.start;
  }
  const Vector arrives = tangent_along(path(at_.block).path, exit.leaves);
  at_ = {.block = next.block,
         .from = next.along,
         .start = point,
         .behind_loop = true,
         .arrives = arrives};
}

void LoopRemoval::pass_by(std::size_t end, const Point& place, PathBlocks& out) {
  report_masked(next_, end - 1, place);
  DroppedBlocks dropped(place, out);
  for (; next_ < end; ++next_)
    if (path(next_).is_contour()) dropped.add(path_.restored(next_));
  dropped.finish();
}

void LoopRemoval::let_go_to(std::size_t end, PathBlocks& out) {
  if (leaving_ || pieces_.begin() < end)
    for (PathBlockPtr& block : std::exchange(entering_, {})) out.push_back(std::move(block));
  for (std::size_t number = pieces_.begin(); number < end; ++number) let_go(number, out);
  pieces_.drop_before(end);
}

void LoopRemoval::let_go(std::size_t number, PathBlocks& out) {
  const auto& [at, cut] = pieces_[number];
  if (cut == Kept::whole) {
    if (next_ < at) pass_by(at, start_of(path(at).path), out);
    next_ = at + 1;
    out.push_back(path_.restored(at));
    return;
  }
  const Piece& piece = cuts_[cut];
  if (next_ < at) pass_by(at, piece.start, out);
  next_ = at + 1;
  PathBlockPtr block = path_.restored(at);
  if (piece.behind_loop && block->mode().options.gen_cir_block_in_corner)
    out.push_back(circle_behind_loop(piece.start, piece.arrives, *block, piece.from));
  const bool whole = piece.from == 0 && piece.to == length_of(block->tool_path) &&
                     piece.start == start_of(block->tool_path) &&
                     piece.end == end_of(block->tool_path);
  if (!whole) shorten(*block, piece.from, piece.to, piece.start, piece.end);
  out.push_back(std::move(block));
  cuts_.drop_before(cut + 1);
}

void LoopRemoval::report_masked(std::size_t first, std::size_t last, const Point& place) {
  while (first <= last && !path(first).is_contour()) ++first;
  while (last > first && !path(last).is_contour()) --last;
  if (first > last) return;
  const Source masked = contour(number_of(first)).source();
  Diagnostic note = diagnostic(Code::blocks_masked, masked);
  note.values = {{"first_index", static_cast<double>(masked.index)},
                 {"last_index", static_cast<double>(contour(number_of(last)).index)},
                 {"tool_radius", path_.radius_of_tool(first)}};
  const Position position = from_plane(path_.mode_of(first).plane, place, path_.height_of(first));
  note.point = DiagnosticPoint{.x = position[0], .y = position[1], .z = position[2]};
  diagnostics_.report(std::move(note));
}

bool LoopRemoval::refuse(const Onset& onset) {
  const HeldPath::ContourBlock& own = contour(number_of(at_.block));
  const TrcMode& mode = path_.mode_of(at_.block);
  const Segment& travelled = path(at_.block).path;
  Diagnostic violation =
      diagnostic(is_arc(own.programmed) ? Code::arc_wrapped : Code::line_reversed, own.source());
  const Source other = contour(onset.obstacle).source();
  violation.values = {{"other_index", static_cast<double>(other.index)},
                      {"tool_radius", path_.radius_of_tool(at_.block)}};
  const Position position =
      from_plane(mode.plane, point_along(travelled, onset.along), path_.height_of(at_.block));
  violation.point = DiagnosticPoint{.x = position[0], .y = position[1], .z = position[2]};
  if (mode.options.ignore_cont_damage) {
    violation.severity = Severity::warning;
    advance();
  }
  return diagnostics_.report(std::move(violation));
}

}  // namespace trc
