#include "core/trc/passes/kerf_masking.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "core/geometry/along.h"
#include "core/geometry/parallel.h"
#include "core/trc/passes/joints.h"
#include "core/trc/passes/offset.h"

namespace trc {
namespace {

bool is_contour(const PathBlock& block) { return block.role == Role::contour; }

// The data that a corner needs of a block. SUPPRESS_TRC (D-155) does not change the tool here.
PathBlock outline_of(const PathBlock& block) {
  PathBlock outline;
  outline.programmed.path = block.programmed.path;
  outline.programmed.mode = block.programmed.mode;
  outline.role = block.role;
  outline.at_start = block.at_start;
  outline.at_end = block.at_end;
  const TrcMode& mode = block.mode();
  if (mode.options.suppress_trc) {
    const double shift = shift_of_tool(mode);
    outline.at_start.shift = block.at_start.active ? shift : 0;
    outline.at_end.shift = block.at_end.active ? shift : 0;
  }
  give_offsets(outline);
  return outline;
}

double cut_at_start(const PathBlock& before, const PathBlock& block, const Tolerances& tolerances) {
  const auto result =
      joint_between(before, block, corner_between(before, block, tolerances), tolerances);
  const auto* joined = std::get_if<JoinedBlocks>(&result);
  return joined != nullptr ? std::max(joined->joint.cut_after, 0.0) : 0;
}

double cut_at_end(const PathBlock& block, const PathBlock& after, const Tolerances& tolerances) {
  const auto result =
      joint_between(block, after, corner_between(block, after, tolerances), tolerances);
  const auto* joined = std::get_if<JoinedBlocks>(&result);
  return joined != nullptr ? std::max(joined->joint.cut_before, 0.0) : 0;
}

// mm of the equidistant
double left(const PathBlock& block, double cut_start, double cut_end) {
  const double extent = left_of_block(block, cut_start, cut_end);
  const auto* arc = std::get_if<Arc>(&block.programmed.path);
  return arc != nullptr ? extent * parallel_radius(*arc, block.at_end.shift) : extent;
}

// A block without length has no direction either, and so no equidistant.
bool keeps_shape(const PathBlock& block, const Tolerances& tolerances) {
  if (length_of(block.programmed.path) <= tolerances.same_point) return false;
  const auto* arc = std::get_if<Arc>(&block.programmed.path);
  return arc == nullptr || parallel_radius(*arc, block.at_end.shift) >= tolerances.on_contour;
}

Segment moved(const Segment& segment, const Point& start, const Point& end, double on_contour) {
  if (const auto* arc = std::get_if<Arc>(&segment)) return refitted(*arc, start, end, on_contour);
  return Line{.start = start, .end = end};
}

// Two blocks that meet in a corner, and the blocks before and after them.
struct Notch {
  const PathBlock* before = nullptr;
  PathBlock first{};
  PathBlock second{};
  const PathBlock* behind = nullptr;

  [[nodiscard]] Notch with_bottom(const Point& bottom, double on_contour) const {
    Notch notch = *this;
    const Point start = start_of(first.programmed.path);
    const Point end = end_of(second.programmed.path);
    notch.first.programmed.path = moved(first.programmed.path, start, bottom, on_contour);
    notch.second.programmed.path = moved(second.programmed.path, bottom, end, on_contour);
    give_offsets(notch.first);
    give_offsets(notch.second);
    return notch;
  }

  // Whether both blocks keep a compensated length.
  [[nodiscard]] bool can_be_entered(double slack, const Tolerances& tolerances) const {
    if (!keeps_shape(first, tolerances) || !keeps_shape(second, tolerances)) return false;
    const Corner corner = corner_between(first, second, tolerances);
    double cut_before = 0;
    double cut_after = 0;
    if (kind_of(corner, tolerances) == CornerKind::inside) {
      const auto joint = inside_joint(corner, tolerances);
      if (!joint) return false;
      cut_before = joint->cut_before;
      cut_after = joint->cut_after;
    }
    const double cut_first = before != nullptr ? cut_at_start(*before, first, tolerances) : 0;
    const double cut_second = behind != nullptr ? cut_at_end(second, *behind, tolerances) : 0;
    return left(first, cut_first, cut_before) >= -slack &&
           left(second, cut_after, cut_second) >= -slack;
  }
};

// With G239 the program has gone on from the end of the compensated path, which therefore must not
// be turned any more.
bool begins_in_end_of_path(const PathBlock& next, const PathBlock& last) {
  return next.role != Role::passive && next.mode().deselection == Selection::without_block &&
         !last.mode().options.suppress_trc;
}

}  // namespace

bool KerfMasking::feed(PathBlockPtr block, PathBlocks& out) {
  const bool continues = !held_.empty() && block->role != Role::passive && block->at_start.active &&
                         !block->perpendicular_entry;
  if (held_.size() == 2) {
    std::optional<PathBlock> outline;
    if (continues) outline = outline_of(*block);
    if (continues || !begins_in_end_of_path(*block, *held_.back()))
      raise_notch(outline ? &*outline : nullptr);
    release(out);
  }
  if (!continues) drain(out);
  if (continues || wanted(*block)) {
    held_.push_back(std::move(block));
  } else {
    out.push_back(std::move(block));
  }
  return true;
}

bool KerfMasking::drain(PathBlocks& out) {
  if (held_.size() == 2) raise_notch(nullptr);
  while (!held_.empty()) release(out);
  before_.reset();
  return true;
}

void KerfMasking::release(PathBlocks& out) {
  before_ = outline_of(*held_.front());
  out.push_back(std::move(held_.front()));
  held_.erase(held_.begin());
}

void KerfMasking::raise_notch(const PathBlock* next) {
  PathBlock& first = *held_[0];
  PathBlock& second = *held_[1];
  if (!wanted(first) || !wanted(second) || !is_contour(first) || !is_contour(second)) return;
  if (!circular_ && (is_arc(first.programmed.path) || is_arc(second.programmed.path))) return;
  const Notch notch{.before = before_ ? &*before_ : nullptr,
                    .first = outline_of(first),
                    .second = outline_of(second),
                    .behind = next};
  if (notch.first.at_start != notch.second.at_end || notch.first.at_end.shift == 0) return;
  const Corner corner = corner_between(notch.first, notch.second, tolerances_);
  if (kind_of(corner, tolerances_) != CornerKind::inside) return;
  const double widest = circular_ ? std::numbers::pi : std::numbers::pi / 2;
  if (transition_angle(corner, tolerances_) > widest + tolerances_.tangent) return;
  if (notch.can_be_entered(tolerances_.on_contour, tolerances_)) return;

  // The bottom is raised along the bisector, at most until no notch is left.
  const Point bottom = end_of(first.programmed.path);
  const Vector up = (notch.second.tangent_at_start - notch.first.tangent_at_end).normalized();
  const Vector from_start = bottom - start_of(first.programmed.path);
  const Vector chord = end_of(second.programmed.path) - start_of(first.programmed.path);
  const double highest = -cross(from_start, chord) / cross(up, chord);
  if (!(highest > 0) || highest > tolerances_.largest_coordinate) return;
  constexpr int steps = 64;
  double low = 0;
  double high = 0;
  for (int step = 1; step <= steps && high == 0; ++step) {
    const double height = highest * step / steps;
    if (notch.with_bottom(bottom + height * up, tolerances_.on_contour)
            .can_be_entered(0, tolerances_))
      high = height;
    else
      low = height;
  }
  if (high == 0) return;
  while (high - low > slack_of_places(tolerances_)) {
    const double middle = 0.5 * (low + high);
    const bool entered = notch.with_bottom(bottom + middle * up, tolerances_.on_contour)
                             .can_be_entered(0, tolerances_);
    (entered ? high : low) = middle;
  }
  const Notch raised = notch.with_bottom(bottom + high * up, tolerances_.on_contour);
  first.programmed.path = raised.first.programmed.path;
  second.programmed.path = raised.second.programmed.path;
  first.origin = second.origin = Origin::kerf;
}

}  // namespace trc
