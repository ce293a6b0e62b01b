#include "core/trc/loops/loop_removal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/geometry/along.h"
#include "core/trc/loops/refusal.h"
#include "core/trc/loops/removed_loop.h"
#include "core/trc/selection/selection_limit.h"
#include "core/trc/walls/closing.h"

namespace trc {
namespace {

// The line REVERSE puts between the two sides of a corner (D-22): it is near to both by intent.
bool crosses_contour(const PathBlock& block) {
  return block.role == Role::inserted && block.at_start.shift * block.at_end.shift < 0;
}

// Approach and retract have their own rules (D-11).
bool is_compensated(const PathBlock& block) {
  return block.role == Role::contour ||
         (block.role == Role::inserted &&
          (block.origin == Origin::transition || block.origin == Origin::radius_change));
}

}  // namespace

bool LoopRemoval::feed(PathBlockPtr block, PathBlocks& out) {
  if (leaving_) {
    behind_.push_back(std::move(block));
    return true;
  }
  const bool enters = block->role == Role::inserted && block->origin == Origin::approach;
  const bool belongs = block->removes_loops() && !crosses_contour(*block) &&
                       (block->role == Role::approach || enters || is_compensated(*block));
  // A change of side ends the contour, also on the spot (D-42).
  const bool changes_side =
      end_of_contour() > 0 && path_.mode_of(end_of_path() - 1).side != block->mode().side;
  const bool goes_on =
      is_compensated(*block) && !block->perpendicular_entry && !(is_holding() && changes_side);
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
  return hold(*block) && (window_ == 0 || proceed(out));
}

bool LoopRemoval::drain(PathBlocks& /*out*/) {
  ended_ = true;
  return leaving_ || end_selection();
}

bool LoopRemoval::end_selection() {
  leaving_ = is_holding();
  find_walls();
  if (!walk(true)) return false;
  linear_.end_at(at_.start);
  static_cast<void>(settle(walked_.end()));
  if (!check_left_out()) return false;
  // Nothing is near anything any more.
  obstacles_.clear();
  walked_.drop_boxes();
  return true;
}

bool LoopRemoval::let_go_some(PathBlocks& out) {
  let_go_to(end_of_portion(), out);
  if (!walked_.empty()) {
    // What stands in place of an arc begins where the block before it ends, and what is left out
    // behind a block may begin on it.
    path_.forget_path_before(next_ - std::min<std::size_t>(next_ - path_.begin(), 1));
    return true;
  }
  if (next_ < end_of_path()) pass_by({end_of_path(), 0}, at_.start, out);
  begin_selection();
  for (PathBlockPtr& block : std::exchange(behind_, {}))
    if (!feed(std::move(block), out)) return false;
  return !ended_ || leaving_ || end_selection();
}

// Up to what leaves as it came, where that is not what the caller has just passed over.
std::size_t LoopRemoval::end_of_portion() const {
  constexpr std::size_t portion = 32;  // whose storage is the same for each
  const std::size_t end = std::min(walked_.begin() + portion, walked_.end());
  if (next_stands_for_itself()) return end;
  std::size_t number = std::min(walked_.begin() + 1, end);
  const auto came_so = [&](const WalkedPath::Kept& kept) {
    return kept.cut == WalkedPath::Kept::whole && kept.block == walked_.kept(number - 1).block + 1;
  };
  while (number < end && !came_so(walked_.kept(number))) ++number;
  return number;
}

LoopRemoval::Row LoopRemoval::next_as_they_came(std::size_t most) const {
  if (!leaving_ || !entering_.empty()) return {};
  return {next_, walked_.whole_in_a_row(next_, path_.without_riders(next_, most))};
}

bool LoopRemoval::next_stands_for_itself() const {
  return next_as_they_came(1).count == 1 && !path_.is_apart(next_);
}

void LoopRemoval::have_left(std::size_t count) {
  constexpr std::size_t now_and_then = 32;
  const std::size_t left = next_ + count;
  if (left / now_and_then > next_ / now_and_then) path_.forget_path_before(left - 1);
  next_ = left;
  walked_.drop_before(walked_.begin() + count);
}

const PathPiece* LoopRemoval::next_part() const {
  if (!leaving_ || !entering_.empty() || walked_.empty()) return nullptr;
  const auto& [block, cut] = walked_.kept(walked_.begin());
  const bool is_next_part = cut != WalkedPath::Kept::whole && block == next_;
  if (!is_next_part || path_.is_apart(block) || path_.has_riders(block)) return nullptr;
  return &walked_.cut(cut);
}

void LoopRemoval::part_has_left() {
  const HeldPath::Number cut = walked_.kept(walked_.begin()).cut;
  left_to_ = {walked_.cut(cut).block, walked_.cut(cut).to};
  have_left(1);
  walked_.drop_cuts_before(cut + 1);
}

void LoopRemoval::pass_by_without_trace() {
  if (!leaving_ || !entering_.empty() || walked_.empty()) return;
  const auto& [block, cut] = walked_.kept(walked_.begin());
  if (next_ >= block || !leave_no_trace(block)) return;
  if (cut == WalkedPath::Kept::whole)
    report_masked({block, 0}, path_.begins_at(block));
  else
    report_masked({block, walked_.cut(cut).from}, walked_.cut(cut).start);
  next_ = block;
}

void LoopRemoval::begin_selection() {
  entering_.clear();
  path_.clear();
  largest_radius_ = 0;
  obstacles_.clear();
  apart_ = false;
  walked_.clear();
  first_of_chain_ = 0;
  exact_from_ = 0;
  waiting_with_.reset();
  walking_ = false;
  at_ = {};
  tolerated_ = {};
  passes_.clear();
  next_ = 0;
  has_linear_ = false;
  farthest_reach_ = 0;
  left_to_ = none_left;
  longest_left_out_ = {};
  contour_length_ = 0;
  obstacles_.set_walls({});
  leaving_ = false;
}

void LoopRemoval::find_walls() {
  if (path_.empty() || path_.begin_of_contour() > 0) return;
  ContourView view{.count = end_of_contour(),
                   .segment = [this](std::size_t number) { return contour(number).programmed; }};
  if (path_.has_roles()) view.role = [this](std::size_t number) { return contour(number).role; };
  Walls walls = trc::find_walls(view, lead_settings_, largest_radius_);
  if (walls.are_plain()) return;
  obstacles_.set_walls(std::move(walls));
  // What has been walked in a window, with leads for walls, is walked again.
  if (!walking_ || walked_.empty()) return;
  at_ = walked_[walked_.begin()];
  drop_pieces(walked_.begin());
  tolerated_ = {};
  passes_.clear();
}

[[gnu::noinline]] bool LoopRemoval::has_no_room_for(const Source& source) {
  return diagnostics_.report(selection_too_long(source, selection_blocks_));
}

bool LoopRemoval::hold(PathBlock& block) {
  if (!has_room_for(block.programmed.source)) return false;
  largest_radius_ =
      std::max({largest_radius_, std::abs(block.at_start.shift), std::abs(block.at_end.shift)});
  has_linear_ = has_linear_ || LinearTransitions::are_asked_for(block.mode());
  // What stands in place of an arc makes the block behind it longer by that.
  farthest_reach_ = std::max(
      farthest_reach_,
      has_linear_ ? largest_radius_ * (1 + block.mode().options.stretch_factor) : largest_radius_);
  path_.append(block);
  if (block.role == Role::contour) {
    note_contour_block(bounding_box(block.programmed.path), Certificate::block_of(block));
  } else {
    // Round a tip whose blocks overlap it turns by more than half a turn, and they turn the other
    // way: nothing is certified about that.
    const auto* arc = std::get_if<Arc>(&block.tool_path);
    const bool goes_far_round = arc != nullptr && std::abs(arc->sweep) > std::numbers::pi;
    apart_ = apart_ || block.unreachable || goes_far_round;
  }
  return true;
}

void LoopRemoval::note_contour_block(const Box& programmed, const Certificate::Block& course) {
  obstacles_.append(course, programmed, std::exchange(apart_, false));
  if (window_ == 0) return;
  contour_length_ += length_of(contour(end_of_contour() - 1).programmed);
  keep_waiting();
  reconsider(end_of_contour() - 1, programmed);
}

void LoopRemoval::keep_waiting() {
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

bool LoopRemoval::is_waiting() const {
  return waiting_with_ && waiting_with_->obstacle + 1 == end_of_contour() &&
         !is_known(at_.block, window_, false);
}

// A new contour block may come near to what has been walked without it: from there
// the path is walked again.
[[gnu::noinline]] void LoopRemoval::reconsider(std::size_t number, const Box& area) {
  const std::size_t chain = obstacles_.chain_before(number);
  first_of_chain_ = std::clamp(first_of_chain_, walked_.begin(), walked_.end());
  while (first_of_chain_ < walked_.end() && number_of(walked_.kept(first_of_chain_).block) < chain)
    ++first_of_chain_;
  if (first_of_chain_ == walked_.begin()) return;
  const Segment obstacle = contour(number).programmed;
  std::size_t earliest = walked_.end();
  double along = 0;
  // What lies behind the earliest one need not be asked.
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
  walked_.for_each_near(area, farthest_reach_, skipped, compare);
  if (earliest < walked_.end()) walk_again_from(earliest, {along, number});
}

void LoopRemoval::walk_again_from(std::size_t piece, const Onset& onset) {
  at_ = walked_[piece];
  const bool was_exact = piece >= exact_from_;
  drop_pieces(piece);
  tolerated_ = {};
  // Before its end it ran into nothing else. A loop may begin a little behind the onset it is left
  // for.
  waiting_with_.reset();
  if (was_exact && onset.along < at_.to - 2 * slack_of_places(tolerances_)) waiting_with_ = onset;
}

void LoopRemoval::drop_pieces(std::size_t kept) {
  walked_.truncate(kept);
  first_of_chain_ = std::min(first_of_chain_, kept);
  exact_from_ = std::min(exact_from_, kept);
}

[[gnu::noinline]] bool LoopRemoval::proceed(PathBlocks& out) {
  if (!is_waiting() && !walk(false)) return false;
  std::size_t due = walked_.begin();
  while (due < walked_.end() && is_known(walked_.kept(due).block, window_, false)) ++due;
  let_go_to(settle(due), out);
  forget();
  return true;
}

std::size_t LoopRemoval::settle(std::size_t due) {
  if (!has_linear_) return due;
  for (std::size_t piece = walked_.begin(); piece < due; ++piece) {
    if (!linear_.may_replace(piece)) continue;
    const std::size_t next = walked_.kept(piece).block + 1;
    if (!leaving_) {
      if (piece + 1 == walked_.end()) return std::max(piece, walked_.begin() + 1) - 1;
      if (at_.block == next) continue;
    }
    linear_.replace(piece);
    // Places on the next block may have moved.
    passes_.erase(std::remove_if(passes_.begin(), passes_.end(),
                                 [&](const Pass& pass) { return pass.block == next; }),
                  passes_.end());
  }
  return due;
}

// Drops what no window reaches any more.
void LoopRemoval::forget() {
  walked_.drop_boxes_before(walked_.begin());
  if (next_ >= end_of_path()) return;
  const std::size_t number = number_of(next_);
  // Some more than the window, now and then.
  const std::size_t some = std::min<std::size_t>(window_ / 8, 64);
  if (number <= path_.begin_of_contour() + window_ + 1 + some) return;
  const std::size_t keep = number - window_ - 1;
  path_.forget_before(keep);
  obstacles_.drop_before(keep);
}

bool LoopRemoval::is_known(std::size_t block, std::size_t lead, bool ended) const {
  return ended || number_of(block) + lead < end_of_contour();
}

std::optional<Obstacles::Onset> LoopRemoval::next_onset() const {
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

bool LoopRemoval::walk(bool ended) {
  waiting_with_.reset();
  if (!walking_ && !begin_walk(ended)) return false;
  while (walking_ && at_.block < end_of_path() && is_known(at_.block, 1, ended)) {
    checkpoint_.pass();
    // Before the end of the contour new neighbours come with every block.
    const std::size_t clear = ended ? obstacles_.clear_until(at_.block) : at_.block;
    if (at_.block < clear) {
      advance_to(clear);
      continue;
    }
    const auto found = next_onset();
    if (!found) {
      if (!leave_backwards()) advance();
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
  if (path_.empty() || !is_known(0, window_, ended)) return true;
  walking_ = true;
  at_ = {.block = 0, .start = start_of(path(0).path)};
  linear_.begin_at(at_.start);
  // The approach leads to the first point, which therefore has to stay (D-11).
  const auto at_start = obstacles_.onset(0, 0, length_of(path(0).path), Nearness::passable);
  return !at_start || at_start->along > 0 || counts_as_none(*at_start) || refuse(*at_start);
}

// To the end of the block and on to the next one.
void LoopRemoval::advance() {
  const Segment segment = path(at_.block).path;
  // The corner behind a loop gets a circle of its own, for the whole turn.
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

void LoopRemoval::advance_to(std::size_t block) {
  advance();
  if (at_.from == 0 && !at_.behind_loop) {
    const auto [next, end] = path_.way_along(at_.block, block, at_.start);
    walked_.add_whole(at_.block, next);
    at_.block = next;
    at_.start = end;
  }
  while (at_.block < block) advance();
}

void LoopRemoval::keep_cut() {
  walked_.add(at_);
  if (is_tolerated()) exact_from_ = walked_.end();
}

LoopRemoval::Step LoopRemoval::leave(const Onset& onset, bool ended) {
  // The transition behind the obstacle comes with the next block.
  const bool complete = ended || onset.obstacle + 1 < end_of_contour();
  if (!complete && !is_known(at_.block, window_, ended)) {
    if (!is_tolerated()) waiting_with_ = onset;
    return Step::wait;
  }
  const PathPlace here{at_.block, onset.along};
  if (here < tolerated_.until) return leave_at_once(onset, ended);
  auto exit = exits_.find(at_, onset, Nearness::exact);
  if (exit && is_seam(*exit)) exit.reset();
  if (exit && violates_soon(here, exit->continues, onset.obstacle)) {
    // Between the exit and the onset a block that is yet to come may be in the way.
    const bool behind = exit->piece < walked_.end();
    if (behind && !is_known(walked_.kept(exit->piece).block, window_, ended)) return Step::wait;
    jump(*exit);
    return Step::done;
  }
  // A block that is yet to come may lead away before, or be in the way of the loop.
  if (!is_known(at_.block, window_, ended)) return Step::wait;
  pass(onset, exit);
  return Step::done;
}

// It violates.
LoopRemoval::Step LoopRemoval::leave_at_once(const Onset& onset, bool ended) {
  if (!is_known(at_.block, window_, ended)) return Step::wait;
  const auto exit = exits_.find(at_, onset, Nearness::passable);
  if (exit && !is_seam(*exit)) {
    jump(*exit);
    return Step::done;
  }
  if (leave_for_last_pass() || counts_as_none(onset)) return Step::done;
  return refuse(onset) ? Step::done : Step::stop;
}

void LoopRemoval::pass(const Onset& onset, const std::optional<LoopExit>& exit) {
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

void LoopRemoval::tolerate(const Onset& onset, Nearness nearness) {
  const Segment segment = path(at_.block).path;
  const double limit = obstacles_.reach(
      at_.block, nearness == Nearness::passable ? Nearness::exact : Nearness::passable);
  const double end = first_exit(
      segment, onset.along, length_of(segment), obstacles_.wall(onset.obstacle),
      obstacles_.reach_to(onset.obstacle, at_.block, limit), slack_of_places(tolerances_));
  tolerated_ = {.from = onset.along,
                .until = {at_.block, std::max(end, onset.along + tolerances_.same_point)},
                .nearness = nearness};
}

bool LoopRemoval::leave_for_last_pass() {
  while (!passes_.empty()) {
    const auto [block, exit] = passes_.back();
    passes_.pop_back();
    const bool holds_it = at_.block < exit.continues.block ||
                          (at_.block == exit.continues.block && at_.from < exit.continues.along);
    const bool is_there = exit.piece >= walked_.begin() && exit.piece < walked_.end() &&
                          walked_.kept(exit.piece).block == block;
    // What has had its window may have been settled.
    if (!holds_it || !is_there || (window_ > 0 && is_known(block, window_, false))) continue;
    const PathPiece piece = walked_[exit.piece];
    if (exit.leaves < piece.from || exit.leaves > piece.to) continue;
    jump(exit);
    return true;
  }
  return false;
}

bool LoopRemoval::counts_as_none(const Onset& violation) {
  if (!is_closed() || !(is_at_begin(violation) || is_at_end(violation))) return false;
  const Segment segment = path(at_.block).path;
  const Segment obstacle = contour(violation.obstacle).programmed;
  const double end =
      first_exit(segment, violation.along, length_of(segment), obstacle,
                 obstacles_.reach(at_.block, Nearness::passable), slack_of_places(tolerances_));
  const double too_near = obstacles_.reach(at_.block, Nearness::slight);
  if (first_entry(segment, violation.along, end, obstacle, too_near)) return false;
  tolerate(violation, Nearness::slight);
  return true;
}

// A block travelled backwards is part of a loop, however shallow that is.
bool LoopRemoval::leave_backwards() {
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

// Its first and its last point are those of the selection, as far as that is known.
bool LoopRemoval::is_closed() const {
  if (path_.begin() > 0) return false;
  const Point begin = start_of(contour(0).programmed);
  const Point end = end_of(contour(end_of_contour() - 1).programmed);
  return (end - begin).norm() <= tolerances_.input_resolution;
}

bool LoopRemoval::is_at_begin(const Onset& onset) const {
  return onset.along <= near_seam() && at_.block == 0;
}

bool LoopRemoval::is_at_end(const Onset& onset) const {
  const Point place = point_along(path(at_.block).path, onset.along);
  return number_of(at_.block) + most_blocks_of_seam >= end_of_contour() &&
         (place - path_.ends_at(end_of_path() - 1)).norm() <= near_seam();
}

// The corner of the last and the first block, or what is left of short ones there.
bool LoopRemoval::is_seam(const LoopExit& exit) const {
  if (!is_closed()) return false;
  const std::size_t last = end_of_contour() - 1;
  const std::size_t here =
      number_of(exit.piece < walked_.end() ? walked_.kept(exit.piece).block : at_.block);
  return here < most_blocks_of_seam &&
         number_of(exit.continues.block) + most_blocks_of_seam > last &&
         2 * (number_of(exit.continues.block) - here) >= last &&
         (exit.point - path_.begins_at(0)).norm() <= near_seam() &&
         (exit.point - path_.ends_at(end_of_path() - 1)).norm() <= near_seam() &&
         !encloses_room(0, here, exit.leaves) &&
         !encloses_room(number_of(exit.continues.block) + 1, last + 1,
                        length_of(path(exit.continues.block).path) - exit.continues.along);
}

// What goes about the tool is longer than its radius.
bool LoopRemoval::encloses_room(std::size_t first, std::size_t end, double rest) const {
  double length = rest;
  for (std::size_t number = first; number < end; ++number)
    length += length_of(contour(number).programmed);
  return length > path_.radius_of_tool(0);
}

bool LoopRemoval::runs_backwards(std::size_t block) const {
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

// What it does later is judged when the walk comes there, without what goes anyway (D-44).
bool LoopRemoval::violates_soon(const PathPlace& from, const PathPlace& to,
                                std::size_t obstacle) const {
  // The deeper the sooner: where a line runs into another one by a thousandth, it does by then.
  double rest =
      4 * std::sqrt(tolerances_.passable) * std::max(path_.radius_of_tool(from.block), 1.0);
  for (std::size_t block = from.block; block <= to.block && rest > 0; ++block) {
    const Segment segment = path(block).path;
    const double length = length_of(segment);
    const double begin = block == from.block ? from.along : 0;
    const double all = block == to.block ? std::min(to.along, length) : length;
    const double end = std::min(all, begin + rest);
    // Mostly it is what the loop begins at: one of the neighbours there, which need not be found.
    const double limit = obstacles_.reach(block, Nearness::passable);
    if (block == from.block && begin < end && limit > 0 &&
        PathPart(segment, begin, end)
            .comes_nearer(obstacles_.wall(obstacle), obstacles_.reach_to(obstacle, block, limit)))
      return true;
    const bool whole = block != from.block && block != to.block;
    if (whole && (path_.is_unreachable(block) || runs_backwards(block))) return true;
    if (obstacles_.comes_nearer(block, begin, end, Nearness::passable)) return true;
    rest -= end - begin;
  }
  return false;
}

void LoopRemoval::jump(const LoopExit& exit) {
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
  tolerated_ = {};
}

std::size_t LoopRemoval::last_dropped_before(std::size_t end) const {
  std::size_t last = end - 1;
  while (last > next_ && !path_.is_contour(last)) --last;
  return last;
}

bool LoopRemoval::leave_no_trace(std::size_t end) const {
  const std::size_t last = last_dropped_before(end);
  return !path_.has_riders(last) && path_.have_one_setting(next_, last) && path_.stays_put(last);
}

void LoopRemoval::pass_by(const PathPlace& next, const Point& place, PathBlocks& out) {
  const std::size_t end = next.block;
  report_masked(next, place);
  if (leave_no_trace(end)) {
    next_ = end;
    return;
  }
  const std::size_t last = last_dropped_before(end);
  DroppedBlocks dropped(place, out);
  // Nobody asks for those between the first and the last one, but for what rides on them.
  bool is_first = true;
  for (; next_ < end; ++next_) {
    if (!path_.is_contour(next_)) continue;
    if (std::exchange(is_first, false) || next_ == last || path_.has_riders(next_))
      dropped.add(path_.restored(next_));
  }
  dropped.finish();
}

void LoopRemoval::let_go_to(std::size_t end, PathBlocks& out) {
  if (leaving_ || walked_.begin() < end)
    for (PathBlockPtr& block : std::exchange(entering_, {})) out.push_back(std::move(block));
  for (std::size_t number = walked_.begin(); number < end; ++number) let_go(number, out);
  walked_.drop_before(end);
}

void LoopRemoval::let_go(std::size_t number, PathBlocks& out) {
  const auto& [at, cut] = walked_.kept(number);
  if (cut == WalkedPath::Kept::whole) {
    if (next_ < at) pass_by({at, 0}, start_of(path(at).path), out);
    next_ = at + 1;
    if (path_.is_linear(at)) {
      let_go_linear(at, out);
    } else {
      out.push_back(path_.restored(at));
    }
    return;
  }
  const PathPiece& piece = walked_.cut(cut);
  if (next_ < at) pass_by({at, piece.from}, piece.start, out);
  next_ = at + 1;
  left_to_ = {at, piece.to};
  PathBlockPtr block = path_.restored(at);
  if (piece.behind_loop && block->mode().options.gen_cir_block_in_corner)
    out.push_back(circle_behind_loop(piece.start, piece.arrives, *block, piece.from));
  const bool whole = piece.is_all_of(block->tool_path, length_of(block->tool_path));
  if (!whole) shorten(*block, piece.from, piece.to, piece.start, piece.end);
  out.push_back(std::move(block));
  walked_.drop_cuts_before(cut + 1);
}

void LoopRemoval::let_go_linear(std::size_t transition, PathBlocks& out) {
  // An arc is never rapid; lines are where the blocks on both sides are.
  const bool rapid =
      path_.setting_of(transition - 1).rapid && path_.setting_of(transition + 1).rapid;
  const HeldPath::Lines lines = path_.lines_of(transition);
  PathBlockPtr inserted = path_.restored(transition);
  inserted->programmed.rapid = rapid;
  for (const Line& line : lines.all()) {
    auto block = std::make_unique<PathBlock>(*inserted);
    block->tool_path = line;
    out.push_back(std::move(block));
  }
}

void LoopRemoval::report_masked(const PathPlace& next, const Point& place) {
  std::size_t first = next_;
  std::size_t last = next.block - 1;
  while (first <= last && !path_.is_contour(first)) ++first;
  while (last > first && !path_.is_contour(last)) --last;
  if (first > last) return;
  LeftOut stretch = left_out(left_to_.block + 1 == next_ ? left_to_ : PathPlace{next_, 0}, next);
  stretch.first = path_.source_of(number_of(first));
  stretch.last = path_.source_of(number_of(last));
  if (window_ > 0 && stretch.length > longest_left_out_.length) longest_left_out_ = stretch;
  Diagnostic note = note_of(stretch);
  const Position position = from_plane(path_.mode_of(first).plane, place, path_.height_of(first));
  note.point = DiagnosticPoint{.x = position[0], .y = position[1], .z = position[2]};
  diagnostics_.report(std::move(note));
}

LeftOut LoopRemoval::left_out(const PathPlace& from, const PathPlace& to) const {
  LeftOut stretch{.tool_radius =
                      path_.mode_of(from.block).cutting_radius(path_.radius_of_tool(from.block))};
  // The share of a wall that lies along the part of its path.
  const auto add = [&](std::size_t block, double begin, double end) {
    if (!path_.is_contour(block)) return;
    const double length = length_of(path(block).path);
    const double share = length > 0 ? (std::min(end, length) - begin) / length : 1;
    stretch.length += std::max(share, 0.0) * obstacles_.wall_length(number_of(block));
  };
  for (std::size_t block = from.block; block < to.block; ++block)
    add(block, block == from.block ? from.along : 0, std::numeric_limits<double>::infinity());
  if (to.block < end_of_path() && to.along > 0)
    add(to.block, to.block == from.block ? from.along : 0, to.along);
  // Of an arc that is left in the middle, the block before it stays.
  std::size_t first = from.block;
  while (first + 1 < to.block && !path_.is_contour(first)) ++first;
  stretch.first = path_.source_of(number_of(first));
  stretch.last = path_.source_of(number_of(std::min(to.block, end_of_path() - 1)));
  return stretch;
}

bool LoopRemoval::check_left_out() {
  if (largest_masked_share_ >= 1 || path_.empty()) return true;
  LeftOut longest = longest_left_out_;
  PathPlace reached{next_, 0};
  const auto consider = [&](const PathPlace& next) {
    if (next.block <= reached.block) return;
    const LeftOut stretch = left_out(reached, next);
    if (stretch.length > longest.length) longest = stretch;
  };
  for (std::size_t number = walked_.begin(); number < walked_.end(); ++number) {
    const auto& [block, cut] = walked_.kept(number);
    const bool whole = cut == WalkedPath::Kept::whole;
    consider({block, whole ? 0 : walked_.cut(cut).from});
    reached = whole ? PathPlace{block + std::size_t{1}, 0} : PathPlace{block, walked_.cut(cut).to};
  }
  consider({end_of_path(), 0});
  if (longest.length == 0) return true;
  longest.of_walls = path_.begin_of_contour() > 0 ? contour_length_ : 0;
  if (path_.begin_of_contour() == 0)
    for (std::size_t number = 0; number < end_of_contour(); ++number)
      longest.of_walls += obstacles_.wall_length(number);
  if (!longest.is_more_than(largest_masked_share_)) return true;
  return diagnostics_.report(refusal_of(longest, largest_masked_share_));
}

selection::RefusedWay LoopRemoval::refused_way() const {
  if (entering_.empty() || path_.empty() || path_.begin_of_contour() > 0) return {};
  const PathBlock& approach = *entering_.front();
  if (approach.role != Role::approach) return {};
  const Walls& walls = obstacles_.walls();
  selection::RefusedWay refused{
      .shift = approach.at_end.shift, .removes_loops = true, .at_begin = walked_.empty()};
  const std::size_t end = end_of_contour();
  for (const Walls::Range& leads : walls.leads) {
    if (leads.first == 0) refused.leads_in = leads.end;
    if (leads.end == end) refused.leads_out = end - leads.first;
  }
  refused.blocks.push_back(approach.programmed);
  for (std::size_t number = refused.leads_in; number < end; ++number) {
    const HeldPath::ContourBlock block = contour(number);
    const HeldPath::Setting& setting = path_.setting_of(block.block);
    refused.blocks.push_back({.source = block.source,
                              .path = block.programmed,
                              .normal = setting.normal,
                              .feed = setting.feed,
                              .role = block.role,
                              .mode = setting.mode});
  }
  return refused;
}

bool LoopRemoval::refuse(const Onset& onset) {
  Diagnostic refusal =
      refusal_of(path_, obstacles_, at_.block, onset, leaving_ || window_ == 0, tolerances_);
  if (path_.mode_of(at_.block).options.ignore_cont_damage) {
    refusal.severity = Severity::warning;
    advance();
    exact_from_ = walked_.end();
  }
  return diagnostics_.report(std::move(refusal));
}

}  // namespace trc
