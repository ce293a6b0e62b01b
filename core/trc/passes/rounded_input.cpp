#include "core/trc/passes/rounded_input.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <variant>

#include "core/base/tolerances.h"
#include "core/geometry/flat_arc.h"

namespace trc {
namespace {

// mm
double resolution_for(const TrcMode& mode, double input_resolution) {
  return std::min(input_resolution, 0.01 * std::abs(mode.tool_radius));
}

// How far a corner may lie beside the line between its neighbours, mm: a coordinate is off by up to
// half of the resolution, two of them by its diagonal, and so are those of the neighbours.
double most_aside(const TrcMode& mode, double input_resolution) {
  constexpr double resolutions = 1.5;  // 2 · 0.5 · 1.41, rounded up
  return resolutions * resolution_for(mode, input_resolution);
}

Vector vector_of(const Line& line) { return line.end - line.start; }

double distance_to(const Point& point, const Line& line) {
  const Vector way = vector_of(line);
  const double square = way.squaredNorm();
  const double along =
      square > 0 ? std::clamp((point - line.start).dot(way) / square, 0.0, 1.0) : 0.0;
  return (point - line.start - along * way).norm();
}

// Other motion of a block belongs to its own place: in a joined line it would happen elsewhere.
bool only_moves_in_plane(const MotionBlock& motion) {
  return !motion.normal.moves() && motion.tracking.empty();
}

// mm². Rounded coordinates turn lines of the length l so that the corners at both ends take up to
// 1.41·R·resolution/l of them. In a curve of 1.4·R a line has 0.28·l left for that.
double squared_length_of_short(const TrcMode& mode, double input_resolution) {
  // Only loop removal keeps to every digit of a contour.
  if (mode.removes_loops()) {
    const double most = most_aside(mode, input_resolution);
    return most * most;
  }
  constexpr double factor = 5;  // 1.41 / 0.28
  return factor * std::abs(mode.tool_radius) * resolution_for(mode, input_resolution);
}

// The share of joined lines that corners may take: each of the joined blocks keeps something.
constexpr double most_of_joined = 0.97;

// mm that corners may take of a block that stays as it is: below 0.1 µm nothing is damaged (D-14).
double room_of_single(double room, const Tolerances& tolerances) {
  return room + 0.9 * tolerances.on_contour;
}

// With G239 the program has gone on from the end of the compensated path, which therefore must not
// be turned any more.
bool begins_in_end_of_path(const PathBlock* next) {
  return next != nullptr && next->role != Role::passive &&
         next->mode().deselection == Selection::without_block;
}

}  // namespace

bool RoundedInput::is_short(const MotionBlock& motion, double input_resolution) {
  const TrcMode& mode = *motion.mode;
  if (!mode.active() || mode.options.suppress_trc || !only_moves_in_plane(motion)) return false;
  const double longest = squared_length_of_short(mode, input_resolution);
  const auto* arc = std::get_if<Arc>(&motion.path);
  const double square = (end_of(motion.path) - start_of(motion.path)).squaredNorm();
  if (square > longest) return false;
  return arc == nullptr ||
         (!mode.removes_loops() && is_flat_arc(std::sqrt(square), arc->sweep, input_resolution));
}

bool RoundedInput::can_hold(const PathBlock& block) const {
  return block.role == Role::contour &&
         (!is_arc(block.programmed.path) || is_short(block.programmed, input_resolution_)) &&
         block.at_start == block.at_end && block.at_end.shift != 0 && !block.perpendicular_exit &&
         !block.path_given && only_moves_in_plane(block.programmed);
}

bool RoundedInput::continues(const PathBlock& block) const {
  if (held_.empty() || !can_hold(block) || block.perpendicular_entry) return false;
  const PathBlock& last = *held_.back();
  return block.programmed.mode == last.programmed.mode && block.at_start == last.at_end &&
         block.programmed.rapid == last.programmed.rapid &&
         block.programmed.feed == last.programmed.feed;
}

bool RoundedInput::feed(PathBlockPtr block, PathBlocks& out) {
  if (!held_.empty() && !continues(*block)) end_before(block.get(), out);
  const bool goes_on = block->before_short || is_short(block->programmed, input_resolution_);
  if (!can_hold(*block) || (held_.empty() && !goes_on)) {
    before_.reset();
    behind_contour_ = block->role == Role::contour && block->at_end.active;
    if (behind_contour_) {
      before_ = trc::course_of(block->programmed.path, block->at_end.shift);
      before_->room = INFINITY;
    }
    out.push_back(std::move(block));
    return true;
  }
  if (block->perpendicular_entry) before_.reset();
  if (held_.empty()) begins_ = !behind_contour_ && is_short(block->programmed, input_resolution_);
  behind_contour_ = true;
  chords_.push_back({.first = held_.size()});
  held_.push_back(std::move(block));
  if (begins_ || !is_exact()) smooth();
  begins_ = begins_ && chords_.size() == 1;
  if (goes_on)
    release_some(out);
  else
    release_all(std::nullopt, out);
  return true;
}

bool RoundedInput::drain(PathBlocks& out) {
  end_before(nullptr, out);
  return true;
}

Line RoundedInput::line_of(const Chord& chord) const {
  return {.start = start_of(held_[chord.first]->programmed.path),
          .end = end_of(held_[chord.first + chord.count - 1]->programmed.path)};
}

ChordCourse RoundedInput::course_of(const Chord& chord) const {
  const double shift = held_.back()->at_end.shift;
  if (chord.count > 1 || chord.straight) return trc::course_of(line_of(chord), shift);
  return trc::course_of(held_[chord.first]->programmed.path, shift);
}

bool RoundedInput::is_in_the_way(const Line& before, const Line& after) const {
  // cos(0.1 rad). A line that turns less goes on as its neighbour does: its end lies beside that by
  // a tenth of its length, less than rounding moves a point by.
  constexpr double cosine_of_slight_turn = 0.995;
  const double shortest = std::min(length_of(before), length_of(after));
  return shortest <= most_aside(held_.back()->mode(), input_resolution_) &&
         tangent_of(before).dot(tangent_of(after)) < cosine_of_slight_turn;
}

ChordCut RoundedInput::cut_at_start(std::size_t chord) const {
  std::optional<ChordCourse> before = before_;
  if (chord > 0) before = course_of(chords_[chord - 1]);
  if (!before) return {};
  return cut_by_rounding(*before, course_of(chords_[chord]), held_.back()->at_end.shift);
}

double RoundedInput::room_of(const Chord& chord, const ChordCourse& course) const {
  // Short lines that have been joined are longer. Of a line with 8 times the square, rounding takes
  // an eighth of what a curve leaves.
  constexpr double times_square = 8;
  const double longest =
      times_square * squared_length_of_short(held_.back()->mode(), input_resolution_);
  if (vector_of(line_of(chord)).squaredNorm() > longest) return INFINITY;
  return chord.count > 1 ? most_of_joined * course.room : room_of_single(course.room, tolerances_);
}

bool RoundedInput::is_used_up(std::size_t chord, const std::optional<ChordCourse>& behind) const {
  const ChordCourse course = course_of(chords_[chord]);
  const ChordCut start = cut_at_start(chord);
  if (chord == 0 && before_ && start.before > before_->room) return true;
  const double room = room_of(chords_[chord], course);
  if (room == INFINITY) return false;
  double cut = start.after;
  if (chord + 1 < chords_.size())
    cut += cut_at_start(chord + 1).before;
  else if (behind)
    cut += cut_by_rounding(course, *behind, held_.back()->at_end.shift).before;
  return cut > room;
}

// Loop removal keeps the contour exact between its ends. At an end that points elsewhere a tool
// that goes only to that point has no room.
bool RoundedInput::is_exact() const { return held_.back()->mode().removes_loops(); }

// Whether the corners within the chord stay near enough to the line that replaces its blocks.
bool RoundedInput::may_be_one(const Chord& chord) const {
  if (chord.count > most_held) return false;
  const Line line = line_of(chord);
  const double most = most_aside(held_.back()->mode(), input_resolution_);
  if (length_of(line) <= most) return false;
  for (std::size_t i = 0; i + 1 < chord.count; ++i)
    if (distance_to(end_of(held_[chord.first + i]->programmed.path), line) > most) return false;
  return true;
}

bool RoundedInput::join(std::size_t first) {
  const Chord joined{.first = chords_[first].first,
                     .count = chords_[first].count + chords_[first + 1].count};
  if (!may_be_one(joined)) return false;
  chords_[first] = joined;
  chords_.erase(chords_.begin() + static_cast<std::ptrdiff_t>(first) + 1);
  return true;
}

bool RoundedInput::join_with_line_before(std::size_t chord) {
  if (chord == 0) return false;
  const Chord first = chords_[chord - 1];
  const Chord second = chords_[chord];
  if (!join(chord - 1)) return false;
  const bool helps = !is_used_up(chord - 1, {}) && (chord < 2 || !is_used_up(chord - 2, {}));
  if (helps) return true;
  chords_[chord - 1] = first;
  chords_.insert(chords_.begin() + static_cast<std::ptrdiff_t>(chord), second);
  return false;
}

bool RoundedInput::move_corner_behind(std::size_t chord) {
  const Chord before = chords_[chord];
  const Chord behind = chords_[chord + 1];
  const std::size_t count = before.count + behind.count;
  for (std::size_t of_first = 1; of_first < count; ++of_first) {
    chords_[chord] = {.first = before.first, .count = of_first};
    chords_[chord + 1] = {.first = before.first + of_first, .count = count - of_first};
    if (may_be_one(chords_[chord]) && may_be_one(chords_[chord + 1]) && !is_used_up(chord, {}) &&
        !is_used_up(chord + 1, {}) && (chord == 0 || !is_used_up(chord - 1, {})))
      return true;
  }
  chords_[chord] = before;
  chords_[chord + 1] = behind;
  return false;
}

bool RoundedInput::make_even() {
  before_even_.assign(chords_.begin(), chords_.end());
  for (std::size_t count = 2; 2 * count <= held_.size(); count *= 2) {
    chords_.clear();
    for (std::size_t first = 0; first + count <= held_.size(); first += count)
      chords_.push_back({.first = first, .count = count});
    chords_.back().count = held_.size() - chords_.back().first;
    if (are_all_free()) return true;
  }
  chords_.assign(before_even_.begin(), before_even_.end());
  return false;
}

bool RoundedInput::has_arcs() const {
  return std::ranges::any_of(chords_, [this](const Chord& chord) {
    return chord.count == 1 && !chord.straight && is_arc(held_[chord.first]->programmed.path);
  });
}

// Joins as little as possible. `behind`: what the last chord has to leave something beside.
bool RoundedInput::divide_anew(const std::optional<ChordCourse>& behind) {
  // An arc rather stays than it becomes a line, and rather does than two are joined, which costs 4.
  constexpr double cost_of_block = 1;
  constexpr double cost_of_straight_arc = 1.5;
  std::vector<ChordChoice> choices;
  const auto offer = [&](const Chord& chord, double cost) {
    ChordCourse course = course_of(chord);
    course.room = room_of(chord, course);
    choices.push_back({.chord = chord, .course = course, .cost = cost});
  };
  for (std::size_t end = 1; end <= held_.size(); ++end) {
    const bool is_an_arc = is_arc(held_[end - 1]->programmed.path);
    offer({.first = end - 1}, cost_of_block);
    if (is_an_arc) offer({.first = end - 1, .straight = true}, cost_of_straight_arc);
    for (std::size_t count = 2; count <= std::min(most_joined_blocks, end); ++count) {
      const Chord chord{.first = end - count, .count = count};
      if (may_be_one(chord)) offer(chord, static_cast<double>(count * count));
    }
  }
  std::vector<Chord> chords =
      cheapest_division(choices, held_.size(), before_, behind, held_.back()->at_end.shift);
  if (chords.empty()) return false;
  chords_ = std::move(chords);
  return true;
}

bool RoundedInput::are_all_free() const {
  for (std::size_t chord = 0; chord < chords_.size(); ++chord)
    if (!may_be_one(chords_[chord]) || (chord + 1 < chords_.size() && is_used_up(chord, {})))
      return false;
  return true;
}

// If nothing helps, the corner stays as it is.
void RoundedInput::smooth() {
  while (chords_.size() >= 2 &&
         is_in_the_way(line_of(chords_[chords_.size() - 2]), line_of(chords_.back())) &&
         join(chords_.size() - 2)) {
  }
  if (is_exact()) return;
  while (chords_.size() >= 2 && is_used_up(chords_.size() - 2, {})) {
    const std::size_t full = chords_.size() - 2;
    if (has_arcs()) {
      if (divide_anew({})) return;
      for (Chord& chord : chords_) chord.straight = true;
      continue;
    }
    if (join_with_line_before(full)) continue;
    if (move_corner_behind(full) || make_even() || divide_anew({}) || !join(full)) return;
  }
}

void RoundedInput::smooth_last_before(const ChordCourse& behind) {
  if (has_arcs() && is_used_up(chords_.size() - 1, behind)) divide_anew(behind);
  while (chords_.size() >= 2 && is_used_up(chords_.size() - 1, behind) &&
         join(chords_.size() - 2)) {
  }
}

void RoundedInput::end_before(const PathBlock* next, PathBlocks& out) {
  if (held_.empty()) return;
  if (next != nullptr && next->role == Role::contour) {
    const ChordCourse behind = trc::course_of(next->programmed.path, next->at_start.shift);
    if (!is_exact() && next->at_start == held_.back()->at_end) smooth_last_before(behind);
    return release_all(behind, out);
  }
  if (is_exact()) smooth();
  Chord& last = chords_.back();
  if (begins_in_end_of_path(next) && last.count > 1) {
    --last.count;
    chords_.push_back({.first = last.first + last.count});
  }
  release_all(std::nullopt, out);
}

void RoundedInput::release_all(const std::optional<ChordCourse>& behind, PathBlocks& out) {
  while (!chords_.empty()) release_first(behind, out);
  before_.reset();
}

void RoundedInput::release_first(const std::optional<ChordCourse>& behind_all, PathBlocks& out) {
  const Chord chord = chords_.front();
  ChordCourse course = course_of(chord);
  std::optional<ChordCourse> behind = behind_all;
  if (chords_.size() > 1) behind = course_of(chords_[1]);
  if (chord.count > 1) {
    lay_onto(line_of(chord), chord.count, behind);
    const Segment& last = held_[chord.count - 1]->programmed.path;
    course.room = room_of_single(length_of(last), tolerances_);
  } else {
    course.room = room_of_single(course.room, tolerances_) - cut_at_start(0).after;
    if (chord.straight) held_.front()->programmed.path = line_of(chord);
  }
  before_ = course;
  const auto end = held_.begin() + static_cast<std::ptrdiff_t>(chord.count);
  std::move(held_.begin(), end, std::back_inserter(out));
  held_.erase(held_.begin(), end);
  chords_.erase(chords_.begin());
  for (Chord& rest : chords_) rest.first -= chord.count;
}

// Each of the first `count` blocks keeps some length, whichever way it went, and the blocks at the
// ends keep the length that their corners take.
void RoundedInput::lay_onto(const Line& line, std::size_t count,
                            const std::optional<ChordCourse>& behind) {
  const auto [direction, length] = directed(vector_of(line));
  const double shift = held_.back()->at_end.shift;
  const ChordCourse course = trc::course_of(line, shift);
  double at_start = before_ ? cut_between(*before_, course, shift).after : 0;
  double at_end = behind ? cut_between(course, *behind, shift).before : 0;
  const double room = std::min(1.05, 0.98 * length / (at_start + at_end));
  at_start *= room;
  at_end *= room;
  const double least = std::min(length / static_cast<double>(64 * count),
                                resolution_for(held_.back()->mode(), input_resolution_));
  double along = at_start;
  Point start = line.start;
  for (std::size_t i = 0; i < count; ++i) {
    Segment& path = held_[i]->programmed.path;
    const double wanted = (end_of(path) - line.start).dot(direction);
    const double left = at_end + least * static_cast<double>(count - 1 - i);
    along = std::min(std::max(wanted, along + least), length - left);
    const Point end = i + 1 < count ? Point(line.start + along * direction) : line.end;
    path = Line{.start = start, .end = end};
    start = end;
  }
}

// A line leaves when the lines after it are long enough for all effects of rounding. Under
// REMOVE_MASKED_BLOCKS only the line before the last one may still be joined with it.
void RoundedInput::release_some(PathBlocks& out) {
  const TrcMode& mode = held_.back()->mode();
  const double enough = 150 * std::abs(mode.tool_radius) * resolution_for(mode, input_resolution_);
  while (chords_.size() > (is_exact() ? 2 : 1)) {
    const Point behind = end_of(held_[chords_.front().count - 1]->programmed.path);
    const Vector way = end_of(held_.back()->programmed.path) - behind;
    if (!is_exact() && held_.size() <= most_held && way.squaredNorm() < enough) return;
    release_first(std::nullopt, out);
  }
  while (chords_.size() > 1 && held_.size() > most_held) release_first(std::nullopt, out);
}

}  // namespace trc
