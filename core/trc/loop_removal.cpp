#include "core/trc/loop_removal.h"

#include <algorithm>
#include <cmath>
#include <iterator>
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
void move_to(const Standing& target, const PathBlock& dropped, const Point& place,
             std::vector<PathBlock>& out) {
  const Standing from = standing_after(out.back());
  const MotionBlock& programmed = dropped.programmed;
  TrackingTravel tracking = programmed.tracking;
  for (std::size_t axis = 0; axis < tracking.size(); ++axis)
    tracking[axis] = {axis < from.tracking.size() ? from.tracking[axis] : tracking[axis].from,
                      target.tracking[axis]};
  const auto moves = [](const AxisTravel& axis) { return axis.moves(); };
  if (from.normal == target.normal && std::none_of(tracking.begin(), tracking.end(), moves)) return;
  PathBlock& carrier = out.emplace_back();
  carrier.role = Role::contour;
  carrier.origin = Origin::masked;
  carrier.masked = true;
  carrier.programmed = {.source = programmed.source,
                        .path = Line{.start = place, .end = place},
                        .normal = {.from = from.normal, .to = target.normal},
                        .feed = programmed.feed,
                        .rapid = programmed.rapid,
                        .mode = programmed.mode,
                        .tracking = std::move(tracking)};
  carrier.at_start = carrier.at_end = dropped.at_end;
  carrier.tool_path = carrier.programmed.path;
}

// Its riders keep their order among what the dropped blocks move out of the plane.
void drop(PathBlock& dropped, const Point& place, std::vector<PathBlock>& out) {
  if (dropped.riders.empty()) return;
  move_to(standing_behind(dropped), dropped, place, out);
  std::vector<PassiveBlock>& riders = out.back().riders;
  std::move(dropped.riders.begin(), dropped.riders.end(), std::back_inserter(riders));
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

}  // namespace

bool LoopRemoval::feed(PathBlock block, std::vector<PathBlock>& out) {
  const bool begins = block.role == Role::approach || block.perpendicular_entry;
  const bool belongs =
      block.removes_loops() && (begins || is_contour(block) ||
                                (block.role == Role::inserted && block.origin != Origin::retract));
  if (belongs && !begins) {
    if (held_.size() >= selection_blocks_)
      return diagnostics_.report(selection_too_long(block, selection_blocks_));
    held_.push_back(std::move(block));
    return true;
  }
  if (!resolve(out)) return false;
  if (belongs) {
    held_.push_back(std::move(block));
  } else {
    out.push_back(std::move(block));
  }
  return true;
}

bool LoopRemoval::resolve(std::vector<PathBlock>& out) {
  if (held_.empty()) return true;
  survey();
  if (!walk()) return false;
  emit(out);
  held_.clear();
  return true;
}

// What the walk asks about again and again.
void LoopRemoval::survey() {
  first_ = 0;
  while (first_ < held_.size() && !is_compensated(held_[first_])) ++first_;
  contour_.clear();
  contour_number_.assign(held_.size(), 0);
  radius_.assign(held_.size(), 0);
  certificate_.emplace(tolerances_);
  std::vector<Box> boxes;
  bool apart = false;
  for (std::size_t index = first_; index < held_.size(); ++index) {
    const PathBlock& block = held_[index];
    radius_[index] = std::min(std::abs(block.at_start.shift), std::abs(block.at_end.shift));
    if (is_contour(block)) {
      certificate_->append(block, apart);
      apart = false;
      boxes.push_back(bounding_box(block.programmed.path));
      contour_.push_back(index);
      // What is inserted before a change of radius may be travelled with either.
      for (std::size_t before = index; before-- > first_ && !is_contour(held_[before]);)
        radius_[before] = std::min(radius_[before], std::abs(block.at_start.shift));
    } else {
      apart = apart || block.unreachable;
    }
    contour_number_[index] = contour_.empty() ? 0 : contour_.size() - 1;
  }
  boxes_.emplace(boxes);
}

double LoopRemoval::reach(std::size_t block, Nearness nearness) const {
  const double part = nearness == Nearness::exact ? tolerances_.rounding : tolerances_.passable;
  return radius_[block] - part * std::max(radius_[block], 1.0);
}

BoxTree::Range LoopRemoval::certified(std::size_t block) const {
  const std::size_t number = contour_number_[block];
  if (is_contour(held_[block]))
    return {certificate_->chain_before(number), certificate_->chain_behind(number)};
  // A transition belongs to the blocks on both sides of the corner.
  const std::size_t behind = number + 1;
  if (behind >= contour_.size() || certificate_->chain_before(behind) > number) return {};
  return {certificate_->chain_before(behind), certificate_->chain_behind(number)};
}

std::optional<LoopRemoval::Onset> LoopRemoval::onset(std::size_t block, double from, double to,
                                                     Nearness nearness) const {
  if (!(from < to)) return std::nullopt;
  const PathBlock& path = held_[block];
  const double limit = reach(block, nearness);
  if (limit <= 0) return std::nullopt;
  std::optional<Onset> first;
  const auto compare = [&](std::size_t number) {
    const std::size_t index = contour_[number];
    if (index == block) return;
    const auto entry = first_entry(path.tool_path, from, first ? first->along : to,
                                   held_[index].programmed.path, limit);
    if (entry && (!first || *entry < first->along)) first = {*entry, number};
  };
  boxes_->for_each_in(inflated(bounding_box(path.tool_path), limit), certified(block), compare);
  return first;
}

std::optional<LoopRemoval::Onset> LoopRemoval::next_onset() const {
  const double length = length_of(held_[at_.block].tool_path);
  double from = at_.from;
  if (tolerated_.block >= at_.block) {
    const double to = tolerated_.block > at_.block ? length : std::min(length, tolerated_.along);
    if (const auto found = onset(at_.block, from, to, Nearness::passable)) return found;
    from = std::max(from, to);
  }
  return onset(at_.block, from, length, Nearness::exact);
}

bool LoopRemoval::walk() {
  pieces_.clear();
  tolerated_ = {};
  at_ = {.block = first_, .start = start_of(held_[first_].tool_path)};
  // The approach leads to the first point, which therefore has to stay (D-11).
  const double length = length_of(held_[first_].tool_path);
  const auto at_start = onset(first_, 0, length, Nearness::passable);
  if (at_start && at_start->along <= 0 && !refuse(*at_start)) return false;
  while (at_.block < held_.size()) {
    const auto found = next_onset();
    if (!found) {
      advance();
    } else if (!leave(*found)) {
      return false;
    }
  }
  return true;
}

// To the end of the block and on to the next one.
void LoopRemoval::advance() {
  at_.to = length_of(held_[at_.block].tool_path);
  at_.end = end_of(held_[at_.block].tool_path);
  pieces_.push_back(at_);
  at_ = {.block = at_.block + 1, .start = at_.end};
}

bool LoopRemoval::leave(const Onset& onset) {
  const bool tolerated = Place{at_.block, onset.along} < tolerated_;
  const Nearness nearness = tolerated ? Nearness::passable : Nearness::exact;
  const auto exit = find_exit(onset, nearness);
  const Place here{at_.block, onset.along};
  if (exit && violates(here, exit->continues)) {
    jump(*exit);
    return true;
  }
  if (exit && !tolerated) {
    tolerated_ = exit->continues;
    return true;
  }
  // No way on from here, but it may not be needed.
  const double length = length_of(held_[at_.block].tool_path);
  if (!tolerated) {
    const auto serious = this->onset(at_.block, onset.along, length, Nearness::passable);
    if (!serious) {
      tolerated_ = {at_.block, length};
      return true;
    }
    if (const auto late = find_exit(*serious, Nearness::passable)) {
      jump(*late);
      return true;
    }
    return refuse(*serious);
  }
  return refuse(onset);
}

bool LoopRemoval::violates(const Place& from, const Place& to) const {
  for (std::size_t block = from.block; block <= to.block; ++block) {
    const PathBlock& path = held_[block];
    const double length = length_of(path.tool_path);
    const double begin = block == from.block ? from.along : 0;
    const double end = block == to.block ? std::min(to.along, length) : length;
    const bool whole = block != from.block && block != to.block;
    if (whole && (path.unreachable || runs_backwards(path, tolerances_.on_contour))) return true;
    if (onset(block, begin, end, Nearness::passable)) return true;
  }
  return false;
}

std::optional<LoopRemoval::Exit> LoopRemoval::find_exit(const Onset& onset,
                                                        Nearness nearness) const {
  // What can lie where the obstacle is: its own equidistant or, about one of its ends,
  // the transitions there and the equidistant of its neighbour.
  const std::size_t number = onset.obstacle;
  const std::size_t obstacle = contour_[number];
  const std::size_t begin = number > 0 ? contour_[number - 1] : first_;
  const std::size_t end = number + 1 < contour_.size() ? contour_[number + 1] + 1 : held_.size();
  const std::size_t first = std::max(begin, at_.block + 1);
  Piece piece = at_;
  piece.to = onset.along;
  if (first < end) {
    if (const auto exit = crossing_in(piece, pieces_.size(), first, end - 1)) return exit;
    // Side by side there is no crossing to be had, but the distance tells.
    const Point place = point_along(held_[at_.block].tool_path, onset.along);
    const double radius = std::max(radius_[at_.block], 1.0);
    const double part = nearness == Nearness::exact ? tolerances_.rounding : tolerances_.passable;
    for (std::size_t block = first; block < end; ++block) {
      const Segment& path = held_[block].tool_path;
      const double along = nearest_along(path, place);
      const Point point = point_along(path, along);
      if (!held_[block].unreachable && (point - place).norm() <= 4 * part * radius)
        return Exit{pieces_.size(), onset.along, {block, along}, point};
    }
  }
  // The path has crossed a transition that reaches out of the tool radius already.
  const double radius = std::abs(held_[obstacle].at_start.shift);
  const double farthest = 4 * radius * (1 + held_[obstacle].mode().options.stretch_factor);
  double back = piece.to - piece.from;
  for (std::size_t kept = pieces_.size(); first < end && kept-- > 0 && back <= farthest;) {
    if (const auto exit = crossing_in(pieces_[kept], kept, first, end - 1)) return exit;
    back += pieces_[kept].to - pieces_[kept].from;
  }
  return std::nullopt;
}

std::optional<LoopRemoval::Exit> LoopRemoval::crossing_in(const Piece& piece, std::size_t number,
                                                          std::size_t first,
                                                          std::size_t last) const {
  const double slack = 0.01 * tolerances_.same_point;
  const Segment& path = held_[piece.block].tool_path;
  std::optional<Exit> latest;
  for (std::size_t block = first; block <= last; ++block) {
    if (held_[block].unreachable) continue;
    for (const Crossing& crossing : crossings(path, held_[block].tool_path, slack)) {
      if (crossing.along_first < piece.from - slack || crossing.along_first > piece.to + slack)
        continue;
      if (latest && crossing.along_first < latest->leaves - slack) continue;
      latest = {number,
                std::max(crossing.along_first, piece.from),
                {block, crossing.along_second},
                crossing.point};
    }
  }
  return latest;
}

void LoopRemoval::jump(const Exit& exit) {
  const double slack = 0.01 * tolerances_.same_point;
  if (exit.piece < pieces_.size()) {
    at_ = pieces_[exit.piece];
    pieces_.resize(exit.piece);
  }
  Place next = exit.continues;
  Point point = exit.point;
  const Segment& path = held_[next.block].tool_path;
  if (length_of(path) - next.along <= slack) {
    point = end_of(path);
    next = {next.block + 1, 0};
  } else if (next.along <= slack) {
    point = start_of(path);
    next.along = 0;
  }
  // What rounding leaves of a block is not worth one, but the approach and the retract
  // know the first and the last point.
  const bool outermost = pieces_.empty() || next.block >= held_.size();
  if (exit.leaves - at_.from > slack || outermost) {
    at_.to = exit.leaves;
    at_.end = point;
    pieces_.push_back(at_);
  } else {
    point = at_.start;
  }
  at_ = {.block = next.block, .from = next.along, .start = point, .behind_loop = true};
}

void LoopRemoval::emit(std::vector<PathBlock>& out) {
  for (std::size_t index = 0; index < first_; ++index) out.push_back(std::move(held_[index]));
  std::size_t next = first_;
  for (const Piece& piece : pieces_) {
    PathBlock& block = held_[piece.block];
    if (next < piece.block) {
      report_masked(next, piece.block - 1, piece.start);
      const PathBlock* last = nullptr;
      for (; next < piece.block; ++next) {
        if (!is_contour(held_[next])) continue;
        drop(held_[next], piece.start, out);
        last = &held_[next];
      }
      if (last != nullptr) move_to(standing_before(block), *last, piece.start, out);
    }
    next = piece.block + 1;
    const bool whole = piece.from == 0 && piece.to == length_of(block.tool_path) &&
                       piece.start == start_of(block.tool_path) &&
                       piece.end == end_of(block.tool_path);
    if (!whole) shorten(block, piece.from, piece.to, piece.start, piece.end);
    out.push_back(std::move(block));
  }
}

void LoopRemoval::report_masked(std::size_t first, std::size_t last, const Point& place) {
  while (first <= last && !is_contour(held_[first])) ++first;
  while (last > first && !is_contour(held_[last])) --last;
  if (first > last) return;
  const MotionBlock& masked = held_[first].programmed;
  Diagnostic note = diagnostic(Code::blocks_masked, masked.source);
  note.values = {{"first_index", static_cast<double>(masked.source.index)},
                 {"last_index", static_cast<double>(held_[last].programmed.source.index)},
                 {"tool_radius", radius_[first]}};
  const Position position = from_plane(held_[first].mode().plane, place, masked.normal.from);
  note.point = DiagnosticPoint{.x = position[0], .y = position[1], .z = position[2]};
  diagnostics_.report(std::move(note));
}

bool LoopRemoval::refuse(const Onset& onset) {
  const PathBlock& path = held_[contour_[contour_number_[at_.block]]];
  const MotionBlock& obstacle = held_[contour_[onset.obstacle]].programmed;
  Diagnostic violation =
      diagnostic(is_arc(path.programmed.path) ? Code::arc_wrapped : Code::line_reversed,
                 path.programmed.source);
  violation.values = {{"other_index", static_cast<double>(obstacle.source.index)},
                      {"tool_radius", radius_[at_.block]}};
  const Position position =
      from_plane(path.mode().plane, point_along(held_[at_.block].tool_path, onset.along),
                 path.programmed.normal.from);
  violation.point = DiagnosticPoint{.x = position[0], .y = position[1], .z = position[2]};
  if (path.mode().options.ignore_cont_damage) {
    violation.severity = Severity::warning;
    tolerated_ = {at_.block, length_of(held_[at_.block].tool_path)};
  }
  return diagnostics_.report(std::move(violation));
}

}  // namespace trc
