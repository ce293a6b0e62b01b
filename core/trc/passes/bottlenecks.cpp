#include "core/trc/passes/bottlenecks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/geometry/along.h"
#include "core/geometry/box_tree.h"
#include "core/geometry/distance.h"
#include "core/trc/result/selection_limit.h"
#include "core/trc/walls/closing.h"

namespace trc {
namespace {

bool is_contour(const PathBlock& block) { return block.role == Role::contour; }

// Approach and retract are not monitored (D-11), and neither is the line that REVERSE puts between
// the two sides of a corner (D-22).
bool is_monitored(const PathBlock& block) {
  // A smaller tool of wear mode runs towards the part, away from the programmed centre path.
  if (block.mode().below_nominal) return false;
  const bool crosses = block.at_start.shift * block.at_end.shift < 0;
  return (is_contour(block) && !block.masked) ||
         (block.role == Role::inserted && block.origin == Origin::transition && !crosses);
}

double tool_radius(const PathBlock& block) {
  return std::min(std::abs(block.at_start.shift), std::abs(block.at_end.shift));
}

// The slot at that place of the path, mm (D-145): between the contour block of the path and the
// other one, if they face each other across the tool.
std::optional<double> slot_between(const PathBlock& path, const Segment& other,
                                   const Point& place) {
  constexpr double facing = -0.5;  // the cosine of 120 degrees
  const TrcMode& mode = path.mode();
  if (!is_contour(path) || mode.below_nominal) return {};
  const Segment& own = path.programmed.path;
  const Point touched = point_along(own, nearest_along(own, place));
  const Vector to_own = touched - place;
  const Vector to_other = point_along(other, nearest_along(other, place)) - place;
  if (to_own.dot(to_other) > facing * to_own.norm() * to_other.norm()) return {};
  return 2 * mode.cutting_radius(distance(touched, other) / 2);
}

struct Violation {
  const MotionBlock* contour = nullptr;
  double distance = 0;
  Point place = Point::Zero();
};

}  // namespace

bool Bottlenecks::feed(PathBlockPtr block, PathBlocks& out) {
  // The approach waits too: the tool must not enter a passage that it cannot get through.
  const bool begins = block->role == Role::approach || block->perpendicular_entry;
  const bool belongs = begins || is_contour(*block) || block->role == Role::inserted ||
                       block->role == Role::side_change;
  const bool wanted =
      belongs && !block->removes_loops() &&
      (implicit_ || block->mode().masking == Masking::on || !held_.empty() || !contour_.empty());
  if ((begins || !wanted) && !end_selection(out)) return false;
  if (!wanted) {
    out.push_back(std::move(block));
    return true;
  }
  if (held_.size() >= selection_blocks_)
    return diagnostics_.report(selection_too_long(block->programmed.source, selection_blocks_));
  if (passes_at_once()) out.push_back(std::make_unique<PathBlock>(*block));
  hold(std::move(block));
  return window_ == 0 || examine(Input::more, out);
}

void Bottlenecks::hold(PathBlockPtr block) {
  if (is_contour(*block)) {
    const std::size_t number = contour_base_ + contour_.size();
    const bool first = contour_.empty();
    if (!first && contour_.back().mode->side != block->mode().side) {
      changes_.push_back(number);
      // Each side has its own closing, and the start of this one may have been forgotten.
      walls_.reset();
    }
    has_roles_ = has_roles_ || block->programmed.role != ContourRole::unspecified;
    closing_.note(number, block->programmed.path, block->mode().cutting_radius());
    boxes_.append(bounding_box(block->programmed.path));
    contour_.push_back(block->programmed);
  }
  const std::size_t count = contour_base_ + contour_.size();
  numbers_.push_back(count > 0 ? count - 1 : 0);
  held_.push_back(std::move(block));
}

bool Bottlenecks::end_selection(PathBlocks& out) {
  // Every block comes here, even if nothing is searched.
  if (held_.empty() && contour_.empty()) return true;
  find_walls();
  if (!examine(Input::ended, out)) return false;
  contour_.clear();
  contour_base_ = 0;
  changes_.clear();
  has_roles_ = false;
  walls_.reset();
  closing_.begin();
  boxes_ = BoxTree();
  violating_ = false;
  return true;
}

ContourView Bottlenecks::contour_from(std::size_t first) const {
  const std::size_t gone = first - contour_base_;
  ContourView view{
      .count = contour_.size() - gone,
      .segment = [this, gone](std::size_t number) { return contour_[gone + number].path; },
      .tool_side = contour_.front().mode->cutting_side(),
      .tolerances = tolerances_,
      .checkpoint = &checkpoint_};
  if (has_roles_)
    view.role = [this, gone](std::size_t number) { return contour_[gone + number].role; };
  return view;
}

void Bottlenecks::find_walls() {
  if (contour_.empty()) return;
  double radius = 0;
  for (const MotionBlock& block : contour_) radius = std::max(radius, block.mode->cutting_radius());
  if (contour_base_ == 0) {
    walls_ = trc::find_walls(contour_from(0), changes_, lead_settings_, radius);
    return;
  }
  const std::size_t first = closing_.begin_of_last_lap().value_or(0);
  if (first < contour_base_ || !changes_.empty()) return;
  Walls walls = trc::find_walls(contour_from(first), lead_settings_, radius);
  walls.move_by(first);
  walls_ = SidedWalls{.sides = {std::move(walls)}};
}

std::optional<Bottlenecks::Wall> Bottlenecks::wall_for(std::size_t path, std::size_t other,
                                                       double limit) const {
  const Segment& programmed = contour_[other - contour_base_].path;
  if (!walls_) {
    const bool at_change =
        std::binary_search(changes_.begin(), changes_.end(), std::max(path, other)) &&
        std::max(path, other) == std::min(path, other) + 1;
    return at_change ? std::nullopt : std::optional(Wall{programmed, limit});
  }
  if (!walls_->is_wall_for(other, path)) return std::nullopt;
  return Wall{walls_->wall(other, programmed), limit - walls_->touch_between(other, path)};
}

bool Bottlenecks::examine(Input input, PathBlocks& out) {
  if (closing_.needs_begin() && changes_.empty() && !contour_.empty())
    if (auto walls = closing_.find_lead_in(contour_from(0), boxes_))
      walls_ = SidedWalls{.sides = {*std::move(walls)}};
  std::size_t examined = 0;
  const std::size_t end = contour_base_ + contour_.size();
  while (examined < held_.size() && (input == Input::ended || numbers_[examined] + window_ < end)) {
    // Blocks at a distance are examined only by their boxes.
    checkpoint_.pass_many(contour_.size());
    const Verdict verdict = check(*held_[examined], numbers_[examined], input);
    if (verdict == Verdict::stops) return false;
    if (verdict == Verdict::undecided) break;
    ++examined;
  }
  const auto gone = static_cast<std::ptrdiff_t>(examined);
  if (!passes_at_once()) std::move(held_.begin(), held_.begin() + gone, std::back_inserter(out));
  held_.erase(held_.begin(), held_.begin() + gone);
  numbers_.erase(numbers_.begin(), numbers_.begin() + gone);
  if (window_ > 0) forget();
  return true;
}

// Drops blocks that no window reaches any more; not one by one, to keep it cheap.
void Bottlenecks::forget() {
  if (closing_.needs_begin()) return;
  if (numbers_.empty() || numbers_.front() <= contour_base_ + 2 * window_ + 64) return;
  const std::size_t gone = numbers_.front() - window_ - contour_base_;
  contour_.erase(contour_.begin(), contour_.begin() + static_cast<std::ptrdiff_t>(gone));
  contour_base_ += gone;
  boxes_.drop_before(contour_base_);
}

Bottlenecks::Verdict Bottlenecks::check(const PathBlock& block, std::size_t number, Input input) {
  if (!is_monitored(block)) return Verdict::goes_on;
  const double radius = tool_radius(block);
  const double limit = radius - tolerances_.clearance * std::max(radius, 1.0);
  Violation worst{.distance = limit};
  bool is_undecided = false;
  boxes_.for_each_near(bounding_box(block.tool_path), limit, [&](std::size_t other) {
    checkpoint_.pass();
    if (window_ > 0 && (other + window_ < number || other > number + window_)) return;
    const MotionBlock& contour = contour_[other - contour_base_];
    const auto wall = wall_for(number, other, limit);
    if (!wall) return;
    const auto near = nearness(block.tool_path, wall->path, tolerances_.same_point);
    if (near.distance >= std::min(worst.distance, wall->limit)) return;
    worst = {.contour = &contour, .distance = near.distance, .place = near.on_first};
    is_undecided = is_undecided || closing_.is_undecided(number, other);
  });
  if (is_undecided && input == Input::more) return Verdict::undecided;
  const bool violates = worst.contour != nullptr;
  const bool first = violates && !std::exchange(violating_, violates);
  violating_ = violates;
  const bool goes_on = !first || report(block, *worst.contour, worst.distance, worst.place);
  return goes_on ? Verdict::goes_on : Verdict::stops;
}

bool Bottlenecks::report(const PathBlock& path, const MotionBlock& contour, double distance,
                         const Point& place) {
  Diagnostic found = diagnostic(Code::bottleneck, path.programmed.source);
  const bool masking = path.mode().masking == Masking::on;
  if (masking && !implicit_) found.severity = Severity::warning;
  const TrcMode& mode = path.mode();
  found.values = {{"clearance", mode.cutting_radius(distance)},
                  {"tool_radius", mode.cutting_radius(tool_radius(path))}};
  if (const auto width = slot_between(path, contour.path, place))
    found.values.push_back({"slot_width", *width});
  append_place(found.values, "other", contour.source);
  const Position position = from_plane(path.mode().plane, place, path.programmed.normal.to);
  found.point = DiagnosticPoint{.x = position[0], .y = position[1], .z = position[2]};
  return diagnostics_.report(std::move(found));
}

}  // namespace trc
