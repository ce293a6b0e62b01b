#include "core/trc/loops/loop_release.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>

#include "core/trc/loops/removed_loop.h"

namespace trc {
namespace {

constexpr double most_of_a_turn = 1.25 * std::numbers::pi;
// What a tool of any size can go round, and no corner that the contour overshoots.
constexpr double turn_of_a_post = 1.5 * std::numbers::pi;

// Sums up the turn of consecutive walls.
class WallTurn {
 public:
  // `share`: the part of the wall whose turn counts, 1 for all of it.
  void add(const Segment& wall, double share) {
    if (direction_) {
      const Vector next = tangent_at_start(wall);
      turn_ += std::atan2(cross(*direction_, next), direction_->dot(next));
    }
    if (const Arc* arc = std::get_if<Arc>(&wall)) turn_ += share * arc->sweep;
    direction_ = tangent_at_end(wall);
  }
  // To the left, rad.
  [[nodiscard]] double turn() const { return turn_; }

 private:
  std::optional<Vector> direction_{};
  double turn_ = 0;
};

}  // namespace

void LoopRelease::begin() {
  next_ = 0;
  left_to_ = none_left;
  longest_left_out_ = {};
  contour_length_ = 0;
  is_most_left_out_ = false;
}

void LoopRelease::leave_out_rest(const Point& place, PathBlocks& out) {
  if (next_ < end_of_path()) pass_by({end_of_path(), 0}, place, out);
}

// Ends before the next block that leaves as it came, unless the caller has just passed that over.
std::size_t LoopRelease::end_of_portion() const {
  constexpr std::size_t blocks_per_step = 32;  // each one reuses the storage of the last
  const std::size_t end = std::min(walked_.begin() + blocks_per_step, walked_.end());
  if (next_stands_for_itself()) return end;
  std::size_t number = std::min(walked_.begin() + 1, end);
  const auto came_so = [&](const WalkedPath::Kept& kept) {
    return kept.cut == WalkedPath::Kept::whole && kept.block == walked_.kept(number - 1).block + 1;
  };
  while (number < end && !came_so(walked_.kept(number))) ++number;
  return number;
}

LoopRelease::Row LoopRelease::next_as_they_came(std::size_t most) const {
  return {next_, walked_.whole_in_a_row(next_, path_.without_passive(next_, most))};
}

bool LoopRelease::next_stands_for_itself() const {
  return next_as_they_came(1).count == 1 && !path_.has_own_data(next_);
}

void LoopRelease::have_left(std::size_t count) {
  constexpr std::size_t now_and_then = 32;
  const std::size_t left = next_ + count;
  if (left / now_and_then > next_ / now_and_then) path_.forget_path_before(left - 1);
  next_ = left;
  walked_.drop_before(walked_.begin() + count);
}

const PathPiece* LoopRelease::next_part() const {
  if (walked_.empty()) return nullptr;
  const auto& [block, cut] = walked_.kept(walked_.begin());
  const bool is_next_part = cut != WalkedPath::Kept::whole && block == next_;
  if (!is_next_part || path_.has_own_data(block) || path_.has_passive(block)) return nullptr;
  return &walked_.cut(cut);
}

void LoopRelease::part_has_left() {
  const HeldPath::Number cut = walked_.kept(walked_.begin()).cut;
  left_to_ = {walked_.cut(cut).block, walked_.cut(cut).to};
  have_left(1);
  walked_.drop_cuts_before(cut + 1);
}

void LoopRelease::pass_by_without_trace() {
  if (walked_.empty()) return;
  const auto& [block, cut] = walked_.kept(walked_.begin());
  if (next_ >= block || !leave_no_trace(block)) return;
  if (cut == WalkedPath::Kept::whole)
    report_masked({block, 0}, path_.begins_at(block));
  else
    report_masked({block, walked_.cut(cut).from}, walked_.cut(cut).start);
  next_ = block;
}

std::size_t LoopRelease::last_dropped_before(std::size_t end) const {
  std::size_t last = end - 1;
  while (last > next_ && !path_.is_contour(last)) --last;
  return last;
}

bool LoopRelease::leave_no_trace(std::size_t end) const {
  const std::size_t last = last_dropped_before(end);
  return !path_.has_passive(last) && path_.have_one_setting(next_, last) && path_.stays_put(last);
}

void LoopRelease::pass_by(const PathPlace& next, const Point& place, PathBlocks& out) {
  const std::size_t end = next.block;
  report_masked(next, place);
  if (leave_no_trace(end)) {
    next_ = end;
    return;
  }
  const std::size_t last = last_dropped_before(end);
  DroppedBlocks dropped(place, out);
  // Between the first and the last block, only blocks with passive blocks matter.
  bool is_first = true;
  for (; next_ < end; ++next_) {
    if (!path_.is_contour(next_)) continue;
    if (std::exchange(is_first, false) || next_ == last || path_.has_passive(next_))
      dropped.add(path_.restored(next_));
  }
  dropped.finish();
}

void LoopRelease::release_to(std::size_t end, PathBlocks& out) {
  for (std::size_t number = walked_.begin(); number < end; ++number) release(number, out);
  walked_.drop_before(end);
}

void LoopRelease::release(std::size_t number, PathBlocks& out) {
  const auto& [at, cut] = walked_.kept(number);
  if (cut == WalkedPath::Kept::whole) {
    if (next_ < at) pass_by({at, 0}, start_of(path(at).path), out);
    next_ = at + 1;
    if (path_.is_linear(at)) {
      release_linear(at, out);
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

void LoopRelease::release_linear(std::size_t transition, PathBlocks& out) {
  // An arc is never rapid; lines are rapid if the blocks on both sides are.
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

void LoopRelease::report_masked(const PathPlace& next, const Point& place) {
  std::size_t first = next_;
  std::size_t last = next.block - 1;
  while (first <= last && !path_.is_contour(first)) ++first;
  while (last > first && !path_.is_contour(last)) --last;
  if (first > last) return;
  LeftOut stretch = left_out(left_up_to(), next);
  stretch.first = path_.source_of(number_of(first));
  stretch.last = path_.source_of(number_of(last));
  stretch.is_a_part = is_most_left_out_ || (stretch.length > stretch.tool_radius / 2 &&
                                            go_round_a_part(number_of(first), number_of(last)));
  if (window_ > 0) longest_left_out_.add(stretch);
  if (!stretch.is_long() && leaves_nothing_of(number_of(first), number_of(last), place)) return;
  Diagnostic note = note_of(stretch);
  const Position position = from_plane(path_.mode_of(first).plane, place, path_.height_of(first));
  note.point = DiagnosticPoint{.x = position[0], .y = position[1], .z = position[2]};
  diagnostics_.report(std::move(note));
}

bool LoopRelease::leaves_nothing_of(std::size_t first, std::size_t last, const Point& place) const {
  for (std::size_t number = first; number <= last; ++number) {
    const HeldPath::ContourBlock contour = path_.contour_block(number);
    const Line* line = std::get_if<Line>(&contour.programmed);
    if (line == nullptr) return false;
    const double reach = path_.radius_of_tool(contour.block) + input_resolution_;
    if (std::max((line->start - place).squaredNorm(), (line->end - place).squaredNorm()) >
        reach * reach)
      return false;
  }
  return true;
}

LeftOut LoopRelease::left_out(const PathPlace& from, const PathPlace& to) const {
  LeftOut stretch{.tool_radius =
                      path_.mode_of(from.block).cutting_radius(path_.radius_of_tool(from.block))};
  // Adds the share of a wall that lies along the given part of its path.
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
  // If a transition arc is left in its middle, the block before it stays.
  std::size_t first = from.block;
  while (first + 1 < to.block && !path_.is_contour(first)) ++first;
  stretch.first = path_.source_of(number_of(first));
  stretch.last = path_.source_of(number_of(std::min(to.block, end_of_path() - 1)));
  return stretch;
}

bool LoopRelease::holds_a_whole(const PathPlace& from, const PathPlace& to,
                                const LeftOut& stretch) const {
  const std::size_t end = std::min(to.block, end_of_path());
  const std::size_t first = number_of(from.block);
  const std::size_t last = number_of(end - 1);
  if (is_parted_by_rapid(first, last + 1)) return true;
  if (!stretch.is_long()) return false;
  if (path_.changes_depth(from.block, end)) return true;
  // A notch between two long arcs may hold nearly all blocks, but its walls turn little (D-39).
  return holds_a_lap(obstacles_.walls(), first, last, stretch) &&
         (!obstacles_.walls().rings.empty() || std::abs(turn_of(from, to)) >= most_of_a_turn);
}

bool LoopRelease::goes_round(const PathPlace& from, const PathPlace& to,
                             const LeftOut& stretch) const {
  const std::size_t end = std::min(to.block, end_of_path());
  const std::size_t first = number_of(from.block);
  const std::size_t last = number_of(end - 1);
  if (is_parted_by_rapid(first, last + 1)) return true;
  if (stretch.is_long() && path_.changes_depth(from.block, end)) return true;
  // Of the blocks at both ends of a lap, parts may be travelled.
  const Walls& walls = obstacles_.walls();
  if (!walls.rings.empty() && !walls.goes_round(first - std::min<std::size_t>(first, 1), last + 1))
    return false;
  const double turn = turn_of(from, to);
  // The lap of a small post is shorter than a stretch that counts as long.
  const Side side = path_.mode_of(from.block).cutting_side();
  const double away = side == Side::left ? -turn : turn;
  if (away >= turn_of_a_post && stretch.length > stretch.tool_radius) return true;
  return stretch.is_long() && std::abs(turn) >= most_of_a_turn;
}

double LoopRelease::turn_of(const PathPlace& from, const PathPlace& to) const {
  WallTurn walls;
  for (std::size_t block = from.block; block <= std::min(to.block, end_of_path() - 1); ++block) {
    if (!path_.is_contour(block)) continue;
    const double length = length_of(path(block).path);
    const double begin = block == from.block ? from.along : 0;
    const double end = block == to.block ? to.along : length;
    if (end > begin)
      walls.add(path_.contour_block(number_of(block)).programmed, (end - begin) / length);
  }
  return walls.turn();
}

bool LoopRelease::go_round_a_part(std::size_t first, std::size_t last) const {
  WallTurn walls;
  for (std::size_t number = first; number <= last; ++number)
    if (!obstacles_.is_lead(number)) walls.add(path_.contour_block(number).programmed, 1);
  const double turn = walls.turn();
  const Side side = path_.mode_of(path_.contour_block(first).block).cutting_side();
  return (side == Side::left ? -turn : turn) >= most_of_a_turn;
}

bool LoopRelease::is_parted_by_rapid(std::size_t first, std::size_t end) const {
  end = std::min(end, path_.end_of_contour() - 1);
  for (std::size_t number = std::max(first, path_.begin_of_contour() + 1); number < end; ++number)
    if (path_.setting_of(path_.contour_block(number).block).rapid) return true;
  return false;
}

double LoopRelease::length_of_walls() const {
  if (path_.begin_of_contour() > 0) return contour_length_;
  double length = 0;
  for (std::size_t number = 0; number < path_.end_of_contour(); ++number)
    length += obstacles_.wall_length(number);
  return length;
}

template <class Visit>
PathPlace LoopRelease::visit_left_out(std::size_t end, const Visit& visit) const {
  PathPlace reached = left_up_to();
  for (std::size_t number = walked_.begin(); number < end; ++number) {
    const auto& [block, cut] = walked_.kept(number);
    const bool whole = cut == WalkedPath::Kept::whole;
    visit(reached, PathPlace{block, whole ? 0 : walked_.cut(cut).from});
    reached = whole ? PathPlace{block + std::size_t{1}, 0} : PathPlace{block, walked_.cut(cut).to};
  }
  return reached;
}

bool LoopRelease::check_leaving(std::size_t end) {
  if (largest_masked_share_ >= 1) return true;
  std::optional<LeftOut> lap;
  visit_left_out(end, [&](const PathPlace& from, const PathPlace& to) {
    if (lap || to.block <= from.block) return;
    const LeftOut stretch = left_out(from, to);
    if (goes_round(from, to, stretch)) lap = stretch;
  });
  return !lap || diagnostics_.report(refusal_of(*lap, std::nullopt));
}

bool LoopRelease::check_left_out() {
  if (largest_masked_share_ >= 1 || path_.empty()) return true;
  LeftOut longest = longest_left_out_;
  // Computed only on demand: usually nothing is left out.
  std::optional<double> known_length;
  const auto of_walls = [&] {
    if (!known_length) known_length = length_of_walls();
    return *known_length;
  };
  std::optional<LeftOut> whole_part;
  double left_out_in_all = 0;
  const auto consider = [&](const PathPlace& reached, const PathPlace& next) {
    if (next.block <= reached.block) return;
    LeftOut stretch = left_out(reached, next);
    if (stretch.length > 0) stretch.of_walls = of_walls();
    longest.add(stretch);
    left_out_in_all += stretch.length;
    // Where a window has left the start of the contour behind, laps may be unknown.
    const bool is_whole = path_.begin_of_contour() > 0 ? goes_round(reached, next, stretch)
                                                       : holds_a_whole(reached, next, stretch);
    if (!whole_part && is_whole) whole_part = stretch;
  };
  consider(visit_left_out(walked_.end(), consider), {end_of_path(), 0});
  if (longest.length == 0) return true;
  longest.of_walls = of_walls();
  // Each note is a warning then, whatever share the caller permits (D-99).
  constexpr double half_of_walls = 0.5;
  is_most_left_out_ = left_out_in_all > half_of_walls * longest.of_walls;
  // The walls of several contours linked by rapid motion are unknown, and so is the share of a
  // stretch in them.
  const bool is_parted =
      longest.in_all > 0 && is_parted_by_rapid(path_.begin_of_contour(), path_.end_of_contour());
  if (is_parted || whole_part)
    return diagnostics_.report(refusal_of(is_parted ? longest : *whole_part, std::nullopt));
  if (!longest.is_more_than(largest_masked_share_)) return true;
  return diagnostics_.report(refusal_of(longest, largest_masked_share_));
}

}  // namespace trc
