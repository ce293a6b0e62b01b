#include "core/trc/loops/loop_walk.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/along.h"
#include "core/trc/loops/refusal.h"

namespace trc {

void LoopWalk::begin() {
  walking_ = false;
  ended_ = false;
  waits_for_closing_ = false;
  at_ = {};
  tolerated_ = {};
  passes_.clear();
  first_of_chain_ = 0;
  exact_from_ = 0;
  waiting_with_.reset();
}

void LoopWalk::note_contour_block(const Box& area, double farthest_reach) {
  keep_waiting();
  reconsider(end_of_contour() - 1, area, farthest_reach);
}

void LoopWalk::start_over() {
  if (!walking_ || walked_.empty()) return;
  at_ = walked_[walked_.begin()];
  drop_pieces(walked_.begin());
  tolerated_ = {};
  passes_.clear();
}

void LoopWalk::forget_passes_on(std::size_t block) {
  passes_.erase(std::remove_if(passes_.begin(), passes_.end(),
                               [&](const Pass& pass) { return pass.block == block; }),
                passes_.end());
}

void LoopWalk::keep_waiting() {
  if (!waiting_with_) return;
  const std::size_t number = end_of_contour() - 1;
  const std::size_t block = at_.block;
  const bool sees_it = number <= number_of(block) + window_ && !obstacles_.certifies(block, number);
  std::optional<double> entry;
  if (sees_it)
    entry = first_entry(path(block).path, at_.from, waiting_with_->along,
                        contour(number).programmed, obstacles_.reach(block, Nearness::exact));
  if (!entry || *entry >= waiting_with_->along - slack_of_places(tolerances_))
    return waiting_with_.reset();
  waiting_with_ = {*entry, number};
}

bool LoopWalk::is_waiting() const {
  return waiting_with_ && waiting_with_->obstacle + 1 == end_of_contour() &&
         !has_had_its_window(at_.block);
}

// A new contour block may come near to pieces that have been walked without it: from the
// first of these the path is walked again.
[[gnu::noinline]] void LoopWalk::reconsider(std::size_t number, const Box& area,
                                            double farthest_reach) {
  const std::size_t chain = obstacles_.chain_before(number);
  first_of_chain_ = std::clamp(first_of_chain_, walked_.begin(), walked_.end());
  while (first_of_chain_ < walked_.end() && number_of(walked_.kept(first_of_chain_).block) < chain)
    ++first_of_chain_;
  if (first_of_chain_ == walked_.begin()) return;
  const Segment obstacle = contour(number).programmed;
  std::size_t earliest = walked_.end();
  double along = 0;
  // Pieces after the earliest one need not be asked.
  BoxTree::Range skipped{first_of_chain_, walked_.end()};
  const auto compare = [&](std::size_t index) {
    if (index >= earliest) return;
    const PathPiece walked = walked_[index];
    const std::size_t own = number_of(walked.block);
    if (own + window_ < number) return;
    const auto entry = first_entry(path(walked.block).path, walked.from, walked.to, obstacle,
                                   obstacles_.reach(walked.block, Nearness::exact));
    if (!entry) return;
    along = *entry;
    earliest = index;
    skipped.first = index;
  };
  walked_.for_each_near(area, farthest_reach, skipped, compare);
  if (earliest < walked_.end()) walk_again_from(earliest, {along, number});
}

void LoopWalk::walk_again_from(std::size_t piece, const Onset& onset) {
  at_ = walked_[piece];
  const bool was_exact = piece >= exact_from_;
  drop_pieces(piece);
  tolerated_ = {};
  // Before its end the piece ran into nothing else. A loop may begin slightly after the onset that
  // it is left out for.
  waiting_with_.reset();
  if (was_exact && onset.along < at_.to - 2 * slack_of_places(tolerances_)) waiting_with_ = onset;
}

void LoopWalk::drop_pieces(std::size_t kept) {
  walked_.truncate(kept);
  first_of_chain_ = std::min(first_of_chain_, kept);
  exact_from_ = std::min(exact_from_, kept);
}

std::optional<Obstacles::Onset> LoopWalk::next_onset() const {
  const double length = length_of(path(at_.block).path);
  double from = at_.from;
  if (is_tolerated()) {
    from = std::max(from, tolerated_.from);
    const double to = std::min(length, tolerated_.until.along);
    if (const auto found = obstacles_.onset(at_.block, from, to, tolerated_.nearness)) return found;
    from = std::max(from, to);
  }
  return obstacles_.onset(at_.block, from, length, Nearness::exact);
}

bool LoopWalk::go_on() {
  waiting_with_.reset();
  waits_for_closing_ = false;
  if (!walking_ && !set_out()) return false;
  while (walking_ && at_.block < end_of_path() && is_known(at_.block, 1)) {
    checkpoint_.pass();
    // Until the contour ends, every block brings new neighbours.
    const std::size_t clear = ended_ ? obstacles_.clear_until(at_.block) : at_.block;
    if (at_.block < clear) {
      advance_to(clear);
      continue;
    }
    const auto found = next_onset();
    if (!found) {
      if (!leave_backwards()) advance();
      continue;
    }
    switch (leave(*found)) {
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

bool LoopWalk::go_undisturbed() {
  constexpr std::size_t most = 32;
  const std::size_t end = end_of_path();
  if (walking_ || end == 0 || end > most || path_.begin() > 0) return false;
  // From the end: leads that are walls for now stand in the way there.
  for (std::size_t block = end; block-- > 0;)
    if (path_.is_unreachable(block) || runs_backwards(block) ||
        obstacles_.comes_nearer(block, 0, length_of(path(block).path), Nearness::exact))
      return false;
  walking_ = true;
  walked_.add_whole(0, end);
  at_ = {.block = end, .start = end_of(path(end - 1).path)};
  return true;
}

bool LoopWalk::set_out() {
  if (path_.empty() || !is_known(0, window_)) return true;
  at_ = {.block = 0, .start = start_of(path(0).path)};
  // The approach leads to the first point, which therefore has to stay (D-11).
  const auto at_start = obstacles_.onset(0, 0, length_of(path(0).path), Nearness::passable);
  if (at_start && is_undecided(*at_start)) return true;
  walking_ = true;
  return !at_start || at_start->along > 0 || counts_as_none(*at_start) || refuse(*at_start);
}

// Walks to the end of the block and on to the next one.
void LoopWalk::advance() {
  const Segment segment = path(at_.block).path;
  // The corner after a loop gets its own circle, for the whole turn.
  if (at_.behind_loop && has_no_radius(segment)) {
    ++at_.block;
    return;
  }
  if (at_.from == 0 && !at_.behind_loop && at_.start == start_of(segment)) {
    walked_.add_whole(at_.block);
    if (is_tolerated()) exact_from_ = walked_.end();
    ++at_.block;
    at_.start = end_of(segment);
    return;
  }
  at_.to = length_of(segment);
  at_.end = end_of(segment);
  keep_cut();
  at_ = {.block = at_.block + 1, .start = end_of(segment)};
}

void LoopWalk::advance_to(std::size_t block) {
  advance();
  if (at_.from == 0 && !at_.behind_loop) {
    const auto [next, end] = path_.way_along(at_.block, block, at_.start);
    walked_.add_whole(at_.block, next);
    at_.block = next;
    at_.start = end;
  }
  while (at_.block < block) advance();
}

void LoopWalk::keep_cut() {
  walked_.add(at_);
  if (is_tolerated()) exact_from_ = walked_.end();
}

bool LoopWalk::is_undecided(const Onset& onset) {
  waits_for_closing_ = !ended_ && closing_.is_undecided(number_of(at_.block), onset.obstacle);
  return waits_for_closing_;
}

LoopWalk::Step LoopWalk::leave(const Onset& onset) {
  if (is_undecided(onset)) return Step::wait;
  // The transition after the obstacle comes with the next block.
  const bool complete = ended_ || onset.obstacle + 1 < end_of_contour();
  if (!complete && !is_known(at_.block, window_)) {
    if (!is_tolerated()) waiting_with_ = onset;
    return Step::wait;
  }
  const PathPlace here{at_.block, onset.along};
  if (here < tolerated_.until) return leave_at_once(onset);
  auto exit = exits_.find(at_, onset, Nearness::exact);
  if (exit && is_seam(*exit)) exit.reset();
  if (exit && violates_soon(here, exit->continues, onset.obstacle)) {
    // Between the exit and the onset a block that has not come yet may be in the way.
    const bool behind = exit->piece < walked_.end();
    if (behind && !is_known(walked_.kept(exit->piece).block, window_)) return Step::wait;
    jump(*exit);
    return Step::done;
  }
  // A block that has not come yet may lead away earlier, or be in the way of the loop.
  if (!is_known(at_.block, window_)) return Step::wait;
  pass(onset, exit);
  return Step::done;
}

// The path violates here.
LoopWalk::Step LoopWalk::leave_at_once(const Onset& onset) {
  if (!is_known(at_.block, window_)) return Step::wait;
  const auto exit = exits_.find(at_, onset, Nearness::passable);
  if (exit && !is_seam(*exit)) {
    jump(*exit);
    return Step::done;
  }
  if (leave_for_last_pass() || counts_as_none(onset)) return Step::done;
  return refuse(onset) ? Step::done : Step::stop;
}

void LoopWalk::pass(const Onset& onset, const std::optional<LoopExit>& exit) {
  constexpr std::size_t most = 64;
  const auto is_behind = [&](const Pass& pass) {
    return pass.exit.continues < PathPlace{at_.block, onset.along};
  };
  passes_.erase(std::remove_if(passes_.begin(), passes_.end(), is_behind), passes_.end());
  if (exit && exit->piece == walked_.end()) {
    if (passes_.size() == most) passes_.erase(passes_.begin());
    passes_.push_back({at_.block, *exit});
  }
  tolerate(onset, Nearness::passable);
}

void LoopWalk::tolerate(const Onset& onset, Nearness nearness) {
  const Segment segment = path(at_.block).path;
  const double limit = obstacles_.reach(
      at_.block, nearness == Nearness::passable ? Nearness::exact : Nearness::passable);
  const PathPart rest(segment, onset.along, length_of(segment));
  const double end = rest.first_exit(obstacles_.wall(onset.obstacle),
                                     obstacles_.reach_to(onset.obstacle, at_.block, limit),
                                     slack_of_places(tolerances_));
  tolerated_ = {.from = onset.along,
                .until = {at_.block, std::max(end, onset.along + tolerances_.same_point)},
                .nearness = nearness};
}

bool LoopWalk::leave_for_last_pass() {
  while (!passes_.empty()) {
    const auto [block, exit] = passes_.back();
    passes_.pop_back();
    const bool holds_it = at_.block < exit.continues.block ||
                          (at_.block == exit.continues.block && at_.from < exit.continues.along);
    const bool is_there = exit.piece >= walked_.begin() && exit.piece < walked_.end() &&
                          walked_.kept(exit.piece).block == block;
    // A block that has had its window may have been settled.
    if (!holds_it || !is_there || (window_ > 0 && has_had_its_window(block))) continue;
    const PathPiece piece = walked_[exit.piece];
    if (exit.leaves < piece.from || exit.leaves > piece.to) continue;
    jump(exit);
    return true;
  }
  return false;
}

bool LoopWalk::counts_as_none(const Onset& violation) {
  if (!seam_.is_near({at_.block, violation.along})) return false;
  const Segment segment = path(at_.block).path;
  const Segment obstacle = contour(violation.obstacle).programmed;
  const PathPart rest(segment, violation.along, length_of(segment));
  const double end = rest.first_exit(obstacle, obstacles_.reach(at_.block, Nearness::passable),
                                     slack_of_places(tolerances_));
  const double too_near = obstacles_.reach(at_.block, Nearness::slight);
  if (first_entry(segment, violation.along, end, obstacle, too_near)) return false;
  tolerate(violation, Nearness::slight);
  return true;
}

// A block travelled backwards is part of a loop, however shallow the loop is.
bool LoopWalk::leave_backwards() {
  const bool is_whole = at_.from == 0 && !at_.behind_loop && at_.block > 0;
  if (!is_whole || !runs_backwards(at_.block)) return false;
  const std::size_t obstacle = std::min(number_of(at_.block) + 1, end_of_contour() - 1);
  const auto exit = exits_.find(at_, {0, obstacle}, Nearness::passable);
  if (exit && !is_seam(*exit) && exit->continues.block != at_.block) {
    jump(*exit);
    return true;
  }
  return leave_for_last_pass();
}

bool LoopWalk::is_seam(const LoopExit& exit) const {
  const std::size_t leaves =
      exit.piece < walked_.end() ? walked_.kept(exit.piece).block : at_.block;
  return seam_.is_between({leaves, exit.leaves}, exit.continues, exit.point);
}

bool LoopWalk::runs_backwards(std::size_t block) const {
  const HeldPath::Block travelled = path(block);
  if (!travelled.is_contour()) return false;
  const Segment programmed = contour(travelled.number).programmed;
  if (const auto* arc = std::get_if<Arc>(&travelled.path)) {
    const auto* circle = std::get_if<Arc>(&programmed);
    return circle != nullptr && arc->sweep * circle->sweep < 0 &&
           length_of(*arc) > tolerances_.on_contour;
  }
  const Vector way = end_of(travelled.path) - start_of(travelled.path);
  return way.dot(tangent_at_start(programmed)) < -tolerances_.on_contour;
}

// Later violations are judged when the walk reaches them, without loops that go anyway (D-44).
bool LoopWalk::violates_soon(const PathPlace& from, const PathPlace& to,
                             std::size_t obstacle) const {
  // The deeper a violation, the sooner it comes: a line that runs into another one by a thousandth
  // violates within this length.
  double rest =
      4 * std::sqrt(tolerances_.passable) * std::max(path_.radius_of_tool(from.block), 1.0);
  for (std::size_t block = from.block; block <= to.block && rest > 0; ++block) {
    const Segment segment = path(block).path;
    const double length = length_of(segment);
    const double begin = block == from.block ? from.along : 0;
    const double all = block == to.block ? std::min(to.along, length) : length;
    const double end = std::min(all, begin + rest);
    // Usually the obstacle at the onset is the cause: its neighbours need not be found then.
    const double limit = obstacles_.reach(block, Nearness::passable);
    if (block == from.block && begin < end && limit > 0 &&
        PathPart(segment, begin, end)
            .comes_nearer(obstacles_.wall(obstacle), obstacles_.reach_to(obstacle, block, limit)))
      return true;
    const bool whole = block != from.block && block != to.block;
    const bool has_no_path = path_.is_unreachable(block) && length > tolerances_.on_contour;
    if (whole && (has_no_path || runs_backwards(block))) return true;
    if (obstacles_.comes_nearer(block, begin, end, Nearness::passable)) return true;
    // Rounding may leave something of the rest on the block that it ends on.
    if (end < all) return false;
    rest -= end - begin;
  }
  return false;
}

void LoopWalk::jump(const LoopExit& exit) {
  const double slack = slack_of_places(tolerances_);
  if (exit.piece < walked_.end()) {
    at_ = walked_[exit.piece];
    drop_pieces(exit.piece);
  }
  PathPlace next = exit.continues;
  Point point = exit.point;
  const Segment segment = path(next.block).path;
  if (length_of(segment) - next.along <= slack) {
    point = end_of(segment);
    next = {next.block + 1, 0};
  } else if (next.along <= slack) {
    point = start_of(segment);
    next.along = 0;
  }
  // A rest within rounding is not worth a block, but the approach and the retract use the
  // first and the last point.
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
  tolerated_ = {};
}

bool LoopWalk::refuse(const Onset& onset) {
  Diagnostic refusal = refusal_of(path_, obstacles_, {at_.block, onset, ended_}, tolerances_);
  if (path_.mode_of(at_.block).options.ignore_cont_damage) {
    refusal.severity = Severity::warning;
    advance();
    exact_from_ = walked_.end();
  }
  return diagnostics_.report(std::move(refusal));
}

}  // namespace trc
