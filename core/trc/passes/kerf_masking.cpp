#include "core/trc/passes/kerf_masking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>
#include <vector>

#include "core/geometry/along.h"
#include "core/geometry/distance.h"
#include "core/geometry/parallel.h"
#include "core/trc/corner/offsets.h"
#include "core/trc/corner/tool_path.h"
#include "core/trc/joints/joints.h"

namespace trc {
namespace {

bool is_contour(const PathBlock& block) { return block.role == Role::contour; }

// SUPPRESS_TRC (D-155) does not change the tool here.
PathBlock outline_with_tool(const PathBlock& block) {
  PathBlock outline = outline_of(block);
  const TrcMode& mode = block.mode();
  if (mode.options.suppress_trc) {
    const double shift = shift_of_tool(mode);
    outline.at_start.shift = block.at_start.active ? shift : 0;
    outline.at_end.shift = block.at_end.active ? shift : 0;
  }
  give_offsets(outline);
  return outline;
}

// The joint of two blocks; without one of them the other runs to its end. Empty: there is none.
std::optional<Joint> joined(const PathBlock* before, const PathBlock* block,
                            const Tolerances& tolerances) {
  Joint open;
  if (before == nullptr) open.start = block->offset_start;
  if (block == nullptr) open.end = before->offset_end;
  if (before == nullptr || block == nullptr) return open;
  const auto result =
      joint_between(*before, *block, corner_between(*before, *block, tolerances), tolerances);
  const auto* found = std::get_if<JoinedBlocks>(&result);
  return found != nullptr ? std::optional(found->joint) : std::nullopt;
}

// The compensated path of a block between its joints, which leave a length of it.
Segment path_of(const PathBlock& block, const Joint& at_start, const Joint& at_end,
                const Tolerances& tolerances) {
  const auto* arc = std::get_if<Arc>(&block.programmed.path);
  if (arc == nullptr) return Line{.start = at_start.start, .end = at_end.end};
  return shortened(*arc,
                   {.start = at_start.start,
                    .end = at_end.end,
                    .sweep = left_of_block(block, at_start.cut_after, at_end.cut_before)},
                   Consumed::runs_back, tolerances);
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

// Whether the point is on the side of the segment, extended to its line or circle, that the tool is
// on.
bool is_on_tool_side(const Segment& segment, const Point& point, double shift, double slack) {
  const auto* arc = std::get_if<Arc>(&segment);
  if (arc == nullptr) {
    const Vector along = tangent_at_start(segment);
    return std::copysign(1.0, shift) * cross(along, point - start_of(segment)) >= -slack;
  }
  const double beyond = (point - arc->center).norm() - radius_of(*arc);
  return ((arc->sweep > 0) == (shift > 0) ? beyond : -beyond) <= slack;
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

  [[nodiscard]] bool holds(const Point& bottom, const Tolerances& tolerances) const {
    const double shift = first.at_end.shift;
    return is_on_tool_side(first.programmed.path, bottom, shift, tolerances.on_contour) &&
           is_on_tool_side(second.programmed.path, bottom, shift, tolerances.on_contour);
  }

  // Whether the inside corners before and after the notch are none any more: a raised bottom turns
  // its blocks, and a corner of nearly 180 degrees into one that the tool would run round outside.
  [[nodiscard]] bool opens_a_corner_of(const Notch& programmed,
                                       const Tolerances& tolerances) const {
    const auto opens = [&](const PathBlock& from, const PathBlock& to, const PathBlock& was_from,
                           const PathBlock& was_to) {
      return kind_of(corner_between(was_from, was_to, tolerances), tolerances) ==
                 CornerKind::inside &&
             kind_of(corner_between(from, to, tolerances), tolerances) == CornerKind::outside;
    };
    return (before != nullptr && opens(*before, first, *before, programmed.first)) ||
           (behind != nullptr && opens(second, *behind, programmed.second, *behind));
  }

  // Whether the path from the block before the notch to the one after it keeps the tool radius from
  // these two, which the notch does not change.
  [[nodiscard]] bool keeps_clear(const Tolerances& tolerances) const {
    const auto at_start = joined(before, &first, tolerances);
    const auto at_bottom = joined(&first, &second, tolerances);
    const auto at_end = joined(&second, behind, tolerances);
    if (!at_start || !at_bottom || !at_end) return false;
    std::vector<Segment> path{path_of(first, *at_start, *at_bottom, tolerances),
                              path_of(second, *at_bottom, *at_end, tolerances)};
    for (const Joint* joint : {&*at_start, &*at_end})
      for (const Joint::Inserted& inserted : joint->inserted()) path.push_back(*inserted);
    const double radius = std::abs(first.at_end.shift) - tolerances.on_contour;
    return std::ranges::all_of(std::array{before, behind}, [&](const PathBlock* wall) {
      return wall == nullptr || !is_contour(*wall) ||
             std::ranges::all_of(path, [&](const Segment& piece) {
               return nearness(piece, wall->programmed.path, tolerances.same_point).distance >=
                      radius;
             });
    });
  }

  // Whether both blocks keep a compensated length.
  [[nodiscard]] bool can_be_entered(double slack, const Tolerances& tolerances) const {
    if (!keeps_shape(first, tolerances) || !keeps_shape(second, tolerances)) return false;
    const Corner corner = corner_between(first, second, tolerances);
    const CornerKind kind = kind_of(corner, tolerances);
    if (kind == CornerKind::outside) return false;  // raised too far: it is no notch any more
    double cut_before = 0;
    double cut_after = 0;
    if (kind == CornerKind::inside) {
      const auto joint = inside_joint(corner, tolerances);
      if (!joint) return false;
      cut_before = joint->cut_before;
      cut_after = joint->cut_after;
    }
    const auto at_start = joined(before, &first, tolerances);
    const auto at_end = joined(&second, behind, tolerances);
    const double cut_first = at_start ? std::max(at_start->cut_after, 0.0) : 0;
    const double cut_second = at_end ? std::max(at_end->cut_before, 0.0) : 0;
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
    if (continues) outline = outline_with_tool(*block);
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
  before_ = outline_with_tool(*held_.front());
  out.push_back(std::move(held_.front()));
  held_.erase(held_.begin());
}

void KerfMasking::raise_notch(const PathBlock* next) {
  PathBlock& first = *held_[0];
  PathBlock& second = *held_[1];
  if (!wanted(first) || !wanted(second) || !is_contour(first) || !is_contour(second)) return;
  if (!circular_ && (is_arc(first.programmed.path) || is_arc(second.programmed.path))) return;
  const Notch notch{.before = before_ ? &*before_ : nullptr,
                    .first = outline_with_tool(first),
                    .second = outline_with_tool(second),
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
  const auto raised_by = [&](double height) {
    return notch.with_bottom(bottom + height * up, tolerances_.on_contour);
  };
  const auto lets_in = [&](double height) {
    const Notch raised = raised_by(height);
    return notch.holds(end_of(raised.first.programmed.path), tolerances_) &&
           raised.can_be_entered(0, tolerances_) && !raised.opens_a_corner_of(notch, tolerances_) &&
           raised.keeps_clear(tolerances_);
  };
  constexpr int steps = 64;
  double low = 0;
  double high = 0;
  for (int step = 1; step <= steps && high == 0; ++step) {
    const double height = highest * step / steps;
    (lets_in(height) ? high : low) = height;
  }
  if (high == 0) return;
  while (high - low > slack_of_places(tolerances_)) {
    const double middle = 0.5 * (low + high);
    (lets_in(middle) ? high : low) = middle;
  }
  const Notch raised = raised_by(high);
  first.programmed.path = raised.first.programmed.path;
  second.programmed.path = raised.second.programmed.path;
  first.origin = second.origin = Origin::kerf;
}

}  // namespace trc
