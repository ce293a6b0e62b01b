#include "core/trc/loop_removal.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/along.h"
#include "core/geometry/distance.h"
#include "core/trc/selection_limit.h"

namespace trc {
namespace {

bool is_contour(const PathBlock& block) { return block.role == Role::contour; }

// Approach and retract have their own rules (D-11).
bool is_compensated(const PathBlock& block) {
  return is_contour(block) ||
         (block.role == Role::inserted &&
          (block.origin == Origin::transition || block.origin == Origin::radius_change));
}

// Where places along a block count as one.
double slack_of(const Tolerances& tolerances) { return 0.01 * tolerances.same_point; }

Box inflated(Box box, double by) {
  box.min().array() -= by;
  box.max().array() += by;
  return box;
}

// Where the axes out of the plane stand.
struct Standing {
  double normal = 0;
  std::vector<double> tracking{};
};

Standing standing(const AxisTravel& normal, const TrackingTravel& tracking,
                  double AxisTravel::*end) {
  Standing place{.normal = normal.*end};
  for (const AxisTravel& axis : tracking) place.tracking.push_back(axis.*end);
  return place;
}

// Where the block itself leaves the axes, and where its riders do.
Standing standing_behind(const PathBlock& block) {
  return standing(block.programmed.normal, block.programmed.tracking, &AxisTravel::to);
}
Standing standing_after(const PathBlock& block) {
  if (block.riders.empty()) return standing_behind(block);
  const PassiveBlock& last = block.riders.back();
  return standing(last.normal, last.tracking, &AxisTravel::to);
}
Standing standing_before(const PathBlock& block) {
  return standing(block.programmed.normal, block.programmed.tracking, &AxisTravel::from);
}

// One motion out of the plane, where the axes are not yet where they have to be.
void move_to(const Standing& target, const PathBlock& dropped, const Point& place, Standing& stands,
             std::vector<PathBlock>& out) {
  const MotionBlock& programmed = dropped.programmed;
  TrackingTravel tracking = programmed.tracking;
  for (std::size_t axis = 0; axis < tracking.size(); ++axis)
    tracking[axis] = {stands.tracking[axis], target.tracking[axis]};
  const AxisTravel normal{.from = stands.normal, .to = target.normal};
  const auto moves = [](const AxisTravel& axis) { return axis.moves(); };
  if (!normal.moves() && std::none_of(tracking.begin(), tracking.end(), moves)) return;
  stands = target;
  PathBlock& carrier = out.emplace_back();
  carrier.role = Role::contour;
  carrier.origin = Origin::masked;
  carrier.masked = true;
  carrier.programmed = {.source = programmed.source,
                        .path = Line{.start = place, .end = place},
                        .normal = normal,
                        .feed = programmed.feed,
                        .rapid = programmed.rapid,
                        .mode = programmed.mode,
                        .tracking = std::move(tracking)};
  carrier.at_start = carrier.at_end = dropped.at_end;
  carrier.tool_path = carrier.programmed.path;
}

// Its riders keep their order among what the dropped blocks move out of the plane.
// Without riders the travel of the block is left to the next one.
bool drop(PathBlock& dropped, const Point& place, Standing& stands, std::vector<PathBlock>& out) {
  if (dropped.riders.empty()) return false;
  move_to(standing_behind(dropped), dropped, place, stands, out);
  stands = standing_after(dropped);
  PathBlock& carrier = out.emplace_back();
  carrier.role = Role::passive;
  carrier.programmed.source = dropped.programmed.source;
  carrier.programmed.mode = dropped.programmed.mode;
  carrier.riders = std::move(dropped.riders);
  return true;
}

// Cuts the block to what is travelled of it.
void shorten(PathBlock& block, double from, double to, const Point& start, const Point& end) {
  const double length = length_of(block.tool_path);
  const auto* arc = std::get_if<Arc>(&block.tool_path);
  const double scale = arc != nullptr && is_arc(block.programmed.path) ? radius_of(*arc) : 1;
  block.cut_at_start += from / scale;
  block.cut_at_end += (length - to) / scale;
  block.tool_path = stretch_of(block.tool_path, from, to, start, end);
}

// Nothing is left between the corners of the block: it is travelled backwards.
bool runs_backwards(const PathBlock& block, double on_contour) {
  if (const auto* arc = std::get_if<Arc>(&block.tool_path)) {
    const auto* programmed = std::get_if<Arc>(&block.programmed.path);
    return programmed != nullptr && arc->sweep * programmed->sweep < 0 &&
           length_of(*arc) > on_contour;
  }
  const Vector way = end_of(block.tool_path) - start_of(block.tool_path);
  return way.dot(block.tangent_at_start) < -on_contour;
}

// A joint behind a loop is an inside corner like any other: GEN_CIR_BLOCK_IN_CORNER.
PathBlock circle_without_radius(const Point& place, const Vector& arrives, const PathBlock& after,
                                double along) {
  const Standing stands = standing_before(after);
  PathBlock circle{.role = Role::inserted, .origin = Origin::transition};
  circle.at_start = circle.at_end = after.at_start;
  circle.programmed.source = after.programmed.source;
  circle.programmed.mode = after.programmed.mode;
  circle.programmed.feed = after.programmed.feed;
  circle.programmed.normal = {.from = stands.normal, .to = stands.normal};
  for (const double axis : stands.tracking)
    circle.programmed.tracking.push_back({.from = axis, .to = axis});
  circle.tool_path = Arc{.start = place,
                         .end = place,
                         .center = place,
                         .sweep = turn_between(arrives, tangent_along(after.tool_path, along))};
  return circle;
}

}  // namespace

bool LoopRemoval::feed(PathBlock block, std::vector<PathBlock>& out) {
  if (leaving_) {
    behind_.push_back(std::move(block));
    return true;
  }
  const bool enters = block.role == Role::inserted && block.origin == Origin::approach;
  const bool belongs =
      block.removes_loops() && (block.role == Role::approach || enters || is_compensated(block));
  const bool goes_on = is_compensated(block) && !block.perpendicular_entry;
  if (!held_.empty() && (!belongs || (!goes_on && !contour_.empty()))) {
    behind_.push_back(std::move(block));
    return end_selection();
  }
  if (!belongs) {
    out.push_back(std::move(block));
    return true;
  }
  return hold(std::move(block)) && (window_ == 0 || proceed(out));
}

bool LoopRemoval::end_selection() {
  leaving_ = !held_.empty();
  return walk(true);
}

bool LoopRemoval::let_go_some(std::vector<PathBlock>& out) {
  constexpr std::size_t portion = 1024;
  const std::size_t end = std::min(left_ + portion, pieces_.size());
  while (left_ < end) let_go(pieces_[left_++], out);
  if (left_ < pieces_.size()) return true;
  if (next_ < end_of_path()) pass_by(end_of_path(), at_.start, out);
  begin_selection();
  for (PathBlock& block : std::exchange(behind_, {}))
    if (!feed(std::move(block), out)) return false;
  return true;
}

void LoopRemoval::begin_selection() {
  held_.clear();
  numbers_.clear();
  radii_.clear();
  contour_.clear();
  pieces_.clear();
  base_ = contour_base_ = next_ = 0;
  clear_before_ = asked_before_ = 0;
  first_.reset();
  boxes_ = BoxTree();
  certificate_ = Certificate(tolerances_);
  piece_boxes_ = BoxTree();
  gone_ = 0;
  largest_radius_ = 0;
  apart_ = false;
  tolerated_ = {};
  leaving_ = false;
  left_ = 0;
}

bool LoopRemoval::hold(PathBlock block) {
  if (held_.size() >= selection_blocks_)
    return diagnostics_.report(selection_too_long(block, selection_blocks_));
  radii_.push_back(std::min(std::abs(block.at_start.shift), std::abs(block.at_end.shift)));
  largest_radius_ = std::max(largest_radius_, radii_.back());
  if (is_contour(block)) {
    note_contour_block(block);
  } else {
    apart_ = apart_ || block.unreachable;
  }
  numbers_.push_back(contour_.empty() ? 0 : end_of_contour() - 1);
  held_.push_back(std::move(block));
  return true;
}

// What the walk asks about again and again.
void LoopRemoval::note_contour_block(const PathBlock& block) {
  // What is inserted before a change of radius may be travelled with either.
  for (std::size_t index = held_.size(); index-- > 0 && !is_contour(held_[index]);)
    radii_[index] = std::min(radii_[index], std::abs(block.at_start.shift));
  certificate_.append(block, std::exchange(apart_, false));
  boxes_.append(bounding_box(block.programmed.path));
  contour_.push_back(
      {.block = end_of_path(),
       .programmed = block.programmed.path,
       .source = block.programmed.source,
       .radius = std::max(std::abs(block.at_start.shift), std::abs(block.at_end.shift))});
  if (window_ > 0) reconsider(end_of_contour() - 1);
}

// A new contour block may come near to what has been walked without it: from there
// the path is walked again.
void LoopRemoval::reconsider(std::size_t number) {
  const Segment& obstacle = contour(number).programmed;
  const std::size_t chain = certificate_.chain_before(number);
  std::size_t earliest = pieces_.size();
  piece_boxes_.for_each_in(inflated(bounding_box(obstacle), largest_radius_),
                           [&](std::size_t index) {
                             if (index < gone_ || index - gone_ >= earliest) return;
                             const Piece& piece = pieces_[index - gone_];
                             const std::size_t own = number_of(piece.block);
                             if (own >= chain || own + window_ < number) return;
                             if (first_entry(path(piece.block).tool_path, piece.from, piece.to,
                                             obstacle, reach(piece.block, Nearness::exact)))
                               earliest = index - gone_;
                           });
  if (earliest == pieces_.size()) return;
  at_ = pieces_[earliest];
  drop_pieces(earliest);
  tolerated_ = {};
}

void LoopRemoval::rebuild_boxes() {
  boxes_ = BoxTree();
  for (const ContourBlock& block : contour_) boxes_.append(bounding_box(block.programmed));
  piece_boxes_ = BoxTree();
  gone_ = 0;
  for (const Piece& piece : pieces_) piece_boxes_.append(bounding_box(path(piece.block).tool_path));
}

void LoopRemoval::keep_piece() {
  pieces_.push_back(at_);
  if (window_ > 0) piece_boxes_.append(bounding_box(path(at_.block).tool_path));
}

void LoopRemoval::drop_pieces(std::size_t kept) {
  pieces_.resize(kept);
  if (window_ > 0) piece_boxes_.truncate(gone_ + kept);
}

bool LoopRemoval::proceed(std::vector<PathBlock>& out) {
  if (!walk(false)) return false;
  std::size_t due = 0;
  while (due < pieces_.size() && is_known(pieces_[due].block, window_, false))
    let_go(pieces_[due++], out);
  pieces_.erase(pieces_.begin(), pieces_.begin() + static_cast<std::ptrdiff_t>(due));
  gone_ += due;
  forget();
  return true;
}

// Drops what no window reaches any more; not one by one, to keep it cheap.
void LoopRemoval::forget() {
  const std::size_t lazy = window_ + 64;
  if (next_ - base_ > lazy) {
    const auto gone = static_cast<std::ptrdiff_t>(next_ - base_);
    held_.erase(held_.begin(), held_.begin() + gone);
    numbers_.erase(numbers_.begin(), numbers_.begin() + gone);
    radii_.erase(radii_.begin(), radii_.begin() + gone);
    base_ = next_;
  }
  if (gone_ > lazy) {
    piece_boxes_.drop_before(gone_);
    gone_ = 0;
  }
  if (next_ >= end_of_path() || contour_.empty()) return;
  const std::size_t number = number_of(next_);
  if (number > contour_base_ + window_ + lazy) {
    const std::size_t keep = number - window_ - 1;
    contour_.erase(contour_.begin(),
                   contour_.begin() + static_cast<std::ptrdiff_t>(keep - contour_base_));
    boxes_.drop_before(keep - contour_base_);
    certificate_.drop_before(keep);
    contour_base_ = keep;
  }
}

bool LoopRemoval::is_known(std::size_t block, std::size_t lead, bool ended) const {
  return ended || number_of(block) + lead < end_of_contour();
}

double LoopRemoval::part_of(Nearness nearness) const {
  return nearness == Nearness::exact ? tolerances_.rounding : tolerances_.passable;
}

double LoopRemoval::reach(std::size_t block, Nearness nearness) const {
  const double radius = radius_of_tool(block);
  return radius - part_of(nearness) * std::max(radius, 1.0);
}

BoxTree::Range LoopRemoval::certified(std::size_t block) const {
  const std::size_t number = number_of(block);
  if (path(block).unreachable) return {};
  if (is_contour(path(block)))
    return {certificate_.chain_before(number), certificate_.chain_behind(number)};
  // A transition belongs to the blocks on both sides of the corner.
  const std::size_t behind = number + 1;
  if (behind >= end_of_contour() || certificate_.chain_before(behind) > number) return {};
  return {certificate_.chain_before(behind), certificate_.chain_behind(number)};
}

template <class Visit>
void LoopRemoval::for_each_near(const Box& area, const BoxTree::Range& certified,
                                const Visit& visit) const {
  BoxTree::Range skipped;
  if (certified.last >= certified.first && certified.last >= contour_base_)
    skipped = {std::max(certified.first, contour_base_) - contour_base_,
               certified.last - contour_base_};
  boxes_.for_each_in(area, skipped, [&](std::size_t index) { visit(contour_base_ + index); });
}

std::optional<LoopRemoval::Onset> LoopRemoval::onset(std::size_t block, double from, double to,
                                                     Nearness nearness) const {
  const double limit = reach(block, nearness);
  if (!(from < to) || limit <= 0) return std::nullopt;
  const Segment& segment = path(block).tool_path;
  const std::size_t own = number_of(block);
  std::optional<Onset> first;
  const auto compare = [&](std::size_t number) {
    const ContourBlock& obstacle = contour(number);
    const bool visible = window_ == 0 || (number <= own + window_ && own <= number + window_);
    // Only an arc turned inside out comes too near to its own block.
    const bool own_block = obstacle.block == block && !path(block).unreachable;
    if (own_block || !visible) return;
    const auto entry =
        first_entry(segment, from, first ? first->along : to, obstacle.programmed, limit);
    if (entry && (!first || *entry < first->along)) first = {*entry, number};
  };
  for_each_near(inflated(bounding_box(segment), limit), certified(block), compare);
  return first;
}

// Asks for many blocks at once: mostly nothing is near.
bool LoopRemoval::clear_ahead(bool ended) {
  constexpr std::size_t group = 32;
  if (!ended) return false;
  if (at_.block < asked_before_) return at_.block < clear_before_;
  asked_before_ = std::min(at_.block + group, end_of_path());
  Box area;
  double radius = 0;
  BoxTree::Range common{0, end_of_contour()};
  for (std::size_t block = at_.block; block < asked_before_; ++block) {
    area.extend(bounding_box(path(block).tool_path));
    radius = std::max(radius, radius_of_tool(block));
    const BoxTree::Range own = certified(block);
    common = {std::max(common.first, own.first), std::min(common.last, own.last)};
  }
  bool clear = true;
  for_each_near(inflated(area, radius), common, [&](std::size_t) { clear = false; });
  if (clear) clear_before_ = asked_before_;
  return clear;
}

std::optional<LoopRemoval::Onset> LoopRemoval::next_onset(bool ended) {
  if (clear_ahead(ended)) return std::nullopt;
  const double length = length_of(path(at_.block).tool_path);
  double from = at_.from;
  if (tolerated_.block >= at_.block) {
    const double to = tolerated_.block > at_.block ? length : std::min(length, tolerated_.along);
    if (const auto found = onset(at_.block, from, to, Nearness::passable)) return found;
    from = std::max(from, to);
  }
  return onset(at_.block, from, length, Nearness::exact);
}

bool LoopRemoval::walk(bool ended) {
  if (!first_ && !begin_walk(ended)) return false;
  while (first_ && at_.block < end_of_path() && is_known(at_.block, 1, ended)) {
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
  std::size_t first = base_;
  while (first < end_of_path() && !is_compensated(path(first))) ++first;
  if (first == end_of_path() || !is_known(first, window_, ended)) return true;
  first_ = first;
  at_ = {.block = first, .start = start_of(path(first).tool_path)};
  // The approach leads to the first point, which therefore has to stay (D-11).
  const double length = length_of(path(first).tool_path);
  const auto at_start = onset(first, 0, length, Nearness::passable);
  return !at_start || at_start->along > 0 || refuse(*at_start);
}

// To the end of the block and on to the next one.
void LoopRemoval::advance() {
  const Segment& segment = path(at_.block).tool_path;
  at_.to = length_of(segment);
  at_.end = end_of(segment);
  keep_piece();
  at_ = {.block = at_.block + 1, .start = at_.end};
}

LoopRemoval::Step LoopRemoval::leave(const Onset& onset, bool ended) {
  // The transition behind the obstacle comes with the next block.
  const bool complete = ended || onset.obstacle + 1 < end_of_contour();
  if (!complete && !is_known(at_.block, window_, ended)) return Step::wait;
  const Place here{at_.block, onset.along};
  const bool tolerated = here < tolerated_;
  const auto exit = find_exit(onset, tolerated ? Nearness::passable : Nearness::exact);
  if (exit && violates(here, exit->continues)) {
    // Between the exit and the onset a block that is yet to come may be in the way.
    const bool behind = exit->piece < pieces_.size();
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
  const double length = length_of(path(at_.block).tool_path);
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

bool LoopRemoval::violates(const Place& from, const Place& to) const {
  for (std::size_t block = from.block; block <= to.block; ++block) {
    const PathBlock& travelled = path(block);
    const double length = length_of(travelled.tool_path);
    const double begin = block == from.block ? from.along : 0;
    const double end = block == to.block ? std::min(to.along, length) : length;
    const bool whole = block != from.block && block != to.block;
    if (whole && (travelled.unreachable || runs_backwards(travelled, tolerances_.on_contour)))
      return true;
    if (onset(block, begin, end, Nearness::passable)) return true;
  }
  return false;
}

std::optional<LoopRemoval::Exit> LoopRemoval::find_exit(const Onset& onset,
                                                        Nearness nearness) const {
  const std::vector<std::size_t> obstacles = obstacles_at(onset, nearness);
  for (const std::size_t number : obstacles)
    if (auto exit = exit_here({onset.along, number}, nearness)) return exit;
  for (const std::size_t number : obstacles)
    if (auto exit = exit_behind({onset.along, number})) return exit;
  return std::nullopt;
}

std::vector<std::size_t> LoopRemoval::obstacles_at(const Onset& onset, Nearness nearness) const {
  std::vector<std::size_t> numbers{onset.obstacle};
  const Point place = point_along(path(at_.block).tool_path, onset.along);
  const double limit = reach(at_.block, nearness) + tolerances_.same_point;
  for_each_near(inflated(Box(place), limit), {}, [&](std::size_t number) {
    const ContourBlock& other = contour(number);
    if (number == onset.obstacle || other.block == at_.block) return;
    if (distance(place, other.programmed) <= limit) numbers.push_back(number);
  });
  return numbers;
}

LoopRemoval::Stretch LoopRemoval::stretch_about(std::size_t obstacle) const {
  const std::size_t begin = obstacle > contour_base_ ? contour(obstacle - 1).block : 0;
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
  if (auto exit = crossing_in(piece, pieces_.size(), onset.obstacle, true)) return exit;
  // Side by side there is no crossing to be had, but the distance tells. By as much as
  // the path is moved over it comes nearer to its own block.
  const Point place = point_along(path(at_.block).tool_path, onset.along);
  const double radius = std::max(radius_of_tool(at_.block), 1.0);
  const double part = nearness == Nearness::exact ? 4 * tolerances_.rounding : tolerances_.passable;
  for (std::size_t block = first; block < end; ++block) {
    const Segment& segment = path(block).tool_path;
    const double along = nearest_along(segment, place);
    const Point point = point_along(segment, along);
    if (!path(block).unreachable && (point - place).norm() <= part * radius)
      return Exit{pieces_.size(), onset.along, {block, along}, point};
  }
  return std::nullopt;
}

std::optional<LoopRemoval::Exit> LoopRemoval::exit_behind(const Onset& onset) const {
  const ContourBlock& obstacle = contour(onset.obstacle);
  const double farthest = 4 * obstacle.radius * (1 + path(at_.block).mode().options.stretch_factor);
  double back = onset.along - at_.from;
  bool beside = true;
  for (std::size_t kept = pieces_.size(); kept-- > 0 && back <= farthest;) {
    beside = beside && !reaches_out(obstacle, pieces_[kept].end);
    if (auto exit = crossing_in(pieces_[kept], kept, onset.obstacle, beside)) return exit;
    back += pieces_[kept].to - pieces_[kept].from;
  }
  return std::nullopt;
}

std::optional<LoopRemoval::Exit> LoopRemoval::crossing_in(const Piece& piece, std::size_t number,
                                                          std::size_t obstacle, bool beside) const {
  const double slack = slack_of(tolerances_);
  const Segment& segment = path(piece.block).tool_path;
  const auto [first, end] = stretch_about(obstacle);
  std::optional<Exit> latest;
  for (std::size_t block = first; block < end; ++block) {
    if (path(block).unreachable) continue;
    for (const Crossing& crossing : crossings(segment, path(block).tool_path, slack)) {
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

bool LoopRemoval::reaches_out(const ContourBlock& block, const Point& point) const {
  return distance(point, block.programmed) > block.radius + tolerances_.same_point;
}

void LoopRemoval::jump(const Exit& exit) {
  const double slack = slack_of(tolerances_);
  if (exit.piece < pieces_.size()) {
    at_ = pieces_[exit.piece];
    drop_pieces(exit.piece);
  }
  Place next = exit.continues;
  Point point = exit.point;
  const Segment& segment = path(next.block).tool_path;
  if (length_of(segment) - next.along <= slack) {
    point = end_of(segment);
    next = {next.block + 1, 0};
  } else if (next.along <= slack) {
    point = start_of(segment);
    next.along = 0;
  }
  // What rounding leaves of a block is not worth one, but the approach and the retract
  // know the first and the last point.
  const bool outermost = at_.block == first_ || next.block >= end_of_path();
  if (exit.leaves - at_.from > slack || outermost) {
    at_.to = exit.leaves;
    at_.end = point;
    keep_piece();
  } else {
    point = at_.start;
  }
  const Vector arrives = tangent_along(path(at_.block).tool_path, exit.leaves);
  at_ = {.block = next.block,
         .from = next.along,
         .start = point,
         .behind_loop = true,
         .arrives = arrives};
}

// The blocks before `end` that are not travelled. Before the contour that is the
// approach, which goes its way; else a loop, left out at `place`.
void LoopRemoval::pass_by(std::size_t end, const Point& place, std::vector<PathBlock>& out) {
  if (!first_ || next_ <= *first_) {
    const std::size_t first = first_ ? *first_ : end;
    for (; next_ < first; ++next_) out.push_back(std::move(held_[next_ - base_]));
    return;
  }
  report_masked(next_, end - 1, place);
  std::optional<Standing> stands;
  const PathBlock* waiting = nullptr;  // its travel out of the plane is still to be made
  for (; next_ < end; ++next_) {
    PathBlock& dropped = held_[next_ - base_];
    if (!is_contour(dropped)) continue;
    if (!stands) stands = standing_before(dropped);
    waiting = drop(dropped, place, *stands, out) ? nullptr : &dropped;
  }
  if (waiting != nullptr) move_to(standing_behind(*waiting), *waiting, place, *stands, out);
}

void LoopRemoval::let_go(const Piece& piece, std::vector<PathBlock>& out) {
  if (next_ < piece.block) pass_by(piece.block, piece.start, out);
  PathBlock& block = held_[piece.block - base_];
  next_ = piece.block + 1;
  if (piece.behind_loop && block.mode().options.gen_cir_block_in_corner)
    out.push_back(circle_without_radius(piece.start, piece.arrives, block, piece.from));
  const bool whole = piece.from == 0 && piece.to == length_of(block.tool_path) &&
                     piece.start == start_of(block.tool_path) &&
                     piece.end == end_of(block.tool_path);
  if (!whole) shorten(block, piece.from, piece.to, piece.start, piece.end);
  out.push_back(std::move(block));
}

void LoopRemoval::report_masked(std::size_t first, std::size_t last, const Point& place) {
  while (first <= last && !is_contour(path(first))) ++first;
  while (last > first && !is_contour(path(last))) --last;
  if (first > last) return;
  const MotionBlock& masked = path(first).programmed;
  Diagnostic note = diagnostic(Code::blocks_masked, masked.source);
  note.values = {{"first_index", static_cast<double>(masked.source.index)},
                 {"last_index", static_cast<double>(path(last).programmed.source.index)},
                 {"tool_radius", radius_of_tool(first)}};
  const Position position = from_plane(path(first).mode().plane, place, masked.normal.from);
  note.point = DiagnosticPoint{.x = position[0], .y = position[1], .z = position[2]};
  diagnostics_.report(std::move(note));
}

bool LoopRemoval::refuse(const Onset& onset) {
  const ContourBlock& own = contour(number_of(at_.block));
  const PathBlock& travelled = path(at_.block);
  Diagnostic violation =
      diagnostic(is_arc(own.programmed) ? Code::arc_wrapped : Code::line_reversed, own.source);
  violation.values = {{"other_index", static_cast<double>(contour(onset.obstacle).source.index)},
                      {"tool_radius", radius_of_tool(at_.block)}};
  const Position position =
      from_plane(travelled.mode().plane, point_along(travelled.tool_path, onset.along),
                 travelled.programmed.normal.from);
  violation.point = DiagnosticPoint{.x = position[0], .y = position[1], .z = position[2]};
  if (travelled.mode().options.ignore_cont_damage) {
    violation.severity = Severity::warning;
    tolerated_ = {at_.block, length_of(travelled.tool_path)};
  }
  return diagnostics_.report(std::move(violation));
}

}  // namespace trc
