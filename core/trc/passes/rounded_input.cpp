#include "core/trc/passes/rounded_input.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <variant>

#include "core/base/tolerances.h"

namespace trc {
namespace {

// mm
double resolution_for(const TrcMode& mode, double input_resolution) {
  return std::min(input_resolution, 0.01 * std::abs(mode.tool_radius));
}

// How far a corner may lie beside the line between its neighbours, mm: a coordinate is off by up to
// half of the resolution, two of them by its diagonal.
double most_aside(const TrcMode& mode, double input_resolution) {
  return 1.5 * resolution_for(mode, input_resolution);
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

// mm². A rounded coordinate turns two lines of the length l so far that R·tan(β/2) is more than
// half of l.
double squared_length_of_short(const TrcMode& mode, double input_resolution) {
  // Only loop removal keeps to every digit of a contour.
  if (mode.removes_loops()) {
    const double most = most_aside(mode, input_resolution);
    return most * most;
  }
  return 2.5 * std::abs(mode.tool_radius) * resolution_for(mode, input_resolution);
}

// The share of joined lines that corners may take: each of the joined blocks keeps something.
constexpr double most_of_joined = 0.97;

// mm that corners may take of a line that stays as it is: below 0.1 µm nothing is damaged (D-14).
double room_of_single(double length, const Tolerances& tolerances) {
  return length + 0.9 * tolerances.on_contour;
}

// With G239 the program has gone on from the end of the compensated path, which therefore must not
// be turned any more.
bool begins_in_end_of_path(const PathBlock* next) {
  return next != nullptr && next->role != Role::passive &&
         next->mode().deselection == Selection::without_block;
}

}  // namespace

bool RoundedInput::is_short(const MotionBlock& motion, double input_resolution) {
  const auto* line = std::get_if<Line>(&motion.path);
  if (line == nullptr) return false;
  const TrcMode& mode = *motion.mode;
  if (!mode.active() || mode.options.suppress_trc || !only_moves_in_plane(motion)) return false;
  return vector_of(*line).squaredNorm() <= squared_length_of_short(mode, input_resolution);
}

bool RoundedInput::is_contour_line(const PathBlock& block) {
  return block.role == Role::contour && std::holds_alternative<Line>(block.programmed.path) &&
         block.at_start == block.at_end && block.at_end.shift != 0 && !block.perpendicular_exit &&
         !block.path_given && only_moves_in_plane(block.programmed);
}

bool RoundedInput::continues(const PathBlock& block) const {
  if (held_.empty() || !is_contour_line(block) || block.perpendicular_entry) return false;
  const PathBlock& last = *held_.back();
  return block.programmed.mode == last.programmed.mode && block.at_start == last.at_end &&
         block.programmed.rapid == last.programmed.rapid &&
         block.programmed.feed == last.programmed.feed;
}

bool RoundedInput::feed(PathBlockPtr block, PathBlocks& out) {
  if (!held_.empty() && !continues(*block)) end_before(block.get(), out);
  const bool goes_on = block->before_short || is_short(block->programmed, input_resolution_);
  if (!is_contour_line(*block) || (held_.empty() && !goes_on)) {
    before_.reset();
    behind_contour_ = block->role == Role::contour && block->at_end.active;
    if (behind_contour_) before_ = tangent_at_end(block->programmed.path);
    room_before_ = INFINITY;
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

double RoundedInput::taken_between(const Vector& before, const Vector& after) const {
  const double shift = held_.back()->at_end.shift;
  const double cosine = before.dot(after);
  if (cosine < 0) return cross(before, after) * shift > 0 ? std::abs(shift) : 0;
  return std::max(shift * cross(before, after) / (1 + cosine), 0.0);  // R·tan(β/2)
}

bool RoundedInput::is_in_the_way(const Line& before, const Line& after) const {
  constexpr double cosine_of_slight_turn = 0.995;  // 5.7 degrees
  const double shortest = std::min(length_of(before), length_of(after));
  return shortest <= most_aside(held_.back()->mode(), input_resolution_) &&
         tangent_of(before).dot(tangent_of(after)) < cosine_of_slight_turn;
}

double RoundedInput::taken_at_start(std::size_t chord) const {
  std::optional<Vector> before = before_;
  if (chord > 0) before = tangent_of(line_of(chords_[chord - 1]));
  const Vector direction = tangent_of(line_of(chords_[chord]));
  // A larger turn was intended.
  return before && before->dot(direction) > 0 ? taken_between(*before, direction) : 0;
}

bool RoundedInput::is_used_up(std::size_t chord, const std::optional<Vector>& behind) const {
  // Short lines that have been joined are longer.
  const double longest = 16 * squared_length_of_short(held_.back()->mode(), input_resolution_);
  const auto [direction, length] = directed(vector_of(line_of(chords_[chord])));
  if (length * length > longest) return false;
  double taken = taken_at_start(chord);
  if (chord == 0 && taken > room_before_) return true;
  if (chord + 1 < chords_.size())
    taken += taken_at_start(chord + 1);
  else if (behind && direction.dot(*behind) > 0)
    taken += taken_between(direction, *behind);
  return taken >
         (chords_[chord].count > 1 ? most_of_joined * length : room_of_single(length, tolerances_));
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
    if (join_with_line_before(full)) continue;
    if (move_corner_behind(full) || make_even() || !join(full)) return;
  }
}

void RoundedInput::smooth_last_before(const Vector& behind) {
  while (chords_.size() >= 2 && is_used_up(chords_.size() - 1, behind) &&
         join(chords_.size() - 2)) {
  }
}

void RoundedInput::end_before(const PathBlock* next, PathBlocks& out) {
  if (held_.empty()) return;
  if (next != nullptr && next->role == Role::contour) {
    const Vector behind = tangent_at_start(next->programmed.path);
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

void RoundedInput::release_all(const std::optional<Vector>& behind, PathBlocks& out) {
  while (!chords_.empty()) release_first(behind, out);
  before_.reset();
}

void RoundedInput::release_first(const std::optional<Vector>& behind_all, PathBlocks& out) {
  const Chord chord = chords_.front();
  const Line line = line_of(chord);
  const Vector direction = tangent_of(line);
  std::optional<Vector> behind = behind_all;
  if (chords_.size() > 1) behind = tangent_of(line_of(chords_[1]));
  const double taken = chord.count > 1 ? 0 : taken_at_start(0);
  if (chord.count > 1) lay_onto(line, chord.count, behind);
  const Segment& last = held_[chord.count - 1]->programmed.path;
  room_before_ = room_of_single(length_of(last), tolerances_) - taken;
  before_ = direction;
  const auto end = held_.begin() + static_cast<std::ptrdiff_t>(chord.count);
  std::move(held_.begin(), end, std::back_inserter(out));
  held_.erase(held_.begin(), end);
  chords_.erase(chords_.begin());
  for (Chord& rest : chords_) rest.first -= chord.count;
}

// Each of the first `count` blocks keeps some length, whichever way it went, and the blocks at the
// ends keep the length that their corners take.
void RoundedInput::lay_onto(const Line& line, std::size_t count,
                            const std::optional<Vector>& behind) {
  const auto [direction, length] = directed(vector_of(line));
  double at_start = before_ ? taken_between(*before_, direction) : 0;
  double at_end = behind ? taken_between(direction, *behind) : 0;
  const double room = std::min(1.05, 0.98 * length / (at_start + at_end));
  at_start *= room;
  at_end *= room;
  const double least = std::min(length / static_cast<double>(64 * count),
                                resolution_for(held_.back()->mode(), input_resolution_));
  double along = at_start;
  Point start = line.start;
  for (std::size_t i = 0; i < count; ++i) {
    Line& path = std::get<Line>(held_[i]->programmed.path);
    const double wanted = (path.end - line.start).dot(direction);
    const double left = at_end + least * static_cast<double>(count - 1 - i);
    along = std::min(std::max(wanted, along + least), length - left);
    const Point end = i + 1 < count ? Point(line.start + along * direction) : line.end;
    path = {.start = start, .end = end};
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
