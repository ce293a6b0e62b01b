// What a program says of the ends of a contour and of its corners: rounding and chamfer words, APPR
// and DEP. Both make blocks wait until the next motion is known.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "core/nc/state/program_state.h"

namespace trc {
namespace {

constexpr const char* corner_without_contour =
    "a rounding or a chamfer that is not between two motions of one contour, at feed and in the "
    "plane";
constexpr const char* lead_without_room =
    "an approach or a departure that has no room: LCT from within its circle, CT, G247 and G347 "
    "with an arc that is smaller than the tool, G147 with DISR= that leaves no line";

}  // namespace

bool ProgramState::moves_in_plane_alone(const MoveRequest& request, const Position& end,
                                        const TrackingTravel& tracking) const {
  const std::size_t third = axes_of(mode_.plane).third;
  return request.kind != MotionKind::rapid && end[third] == position_[third] &&
         std::ranges::none_of(tracking, &AxisTravel::moves);
}

bool ProgramState::refuse_corner(const Source& source) {
  return report(source, Code::nc_unsupported, corner_without_contour);
}

bool ProgramState::refuse_held_corner() {
  const Source& before = std::get_if<MotionBlock>(&held_.front())->source;
  return diagnostics_.report(
      diagnostic(Code::nc_unsupported, corner_source_.value_or(before), corner_without_contour));
}

bool ProgramState::refuse_open_lead() {
  return report(lead_->request.source, Code::nc_unsupported,
                "APPR or G147, G247, G347 without a contour behind it");
}

// Only between motions of the contour itself, along which nothing else moves (D-124).
bool ProgramState::check_corner(const MoveRequest& request, bool alone) {
  return !request.corner || request.corner->modal || (alone && is_in_contour()) ||
         refuse_corner(request.source);
}

// The block that is held loses its end and `path` its beginning.
bool ProgramState::cut_corner_before(const MoveRequest& request, Segment& path, bool alone) {
  if (!corner_) return true;
  if (corner_->form == CornerCut::Form::open) {
    release_held();
    return true;
  }
  auto& before = *std::get_if<MotionBlock>(&held_.front());
  const bool in_contour = mode_.active() && before.mode->side == mode_.side &&
                          before.mode->selection_number == mode_.selection_number;
  const bool no_corner =
      corner_->modal && std::abs(turn_between(tangent_at_end(before.path),
                                              tangent_at_start(path))) <= tolerances_.tangent;
  if (no_corner || (corner_->modal && (!alone || !in_contour))) {
    release_held();
    return true;
  }
  if (!alone || !in_contour) return refuse_held_corner();
  const auto corner = cut_corner(before.path, path, *corner_, tolerances_);
  const bool beside_arc =
      corner_->form != CornerCut::Form::round && (is_arc(before.path) || is_arc(path));
  const bool takes_all_behind = corner && is_point(corner->after);
  // The corner takes the place of the motion behind it: that has one feed, and no corner of its
  // own.
  const bool has_place = !takes_all_behind || (!is_point(corner->before) && !request.corner &&
                                               !corner_source_ && corner_feed_ == 0);
  if (!corner || !has_place)
    return report(corner_source_.value_or(before.source), Code::nc_unsupported,
                  beside_arc ? "a chamfer beside an arc"
                             : "a rounding or a chamfer the motions have no room for");
  path = takes_all_behind ? corner->between : corner->after;
  put_in_front(*corner, takes_all_behind);
  release_held();
  return true;
}

bool ProgramState::is_point(const Segment& path) const {
  return length_of(path) <= tolerances_.same_point;
}

// Into the block that is held, and behind it the corner itself, unless the motion behind has become
// that.
void ProgramState::put_in_front(const CutCorner& corner, bool takes_all_behind) {
  auto& before = *std::get_if<MotionBlock>(&held_.front());
  if (is_point(corner.before)) {
    before.path = corner.between;
    if (corner_feed_ != 0) before.feed = corner_feed_;
    return;
  }
  before.path = corner.before;
  if (takes_all_behind) return;
  MotionBlock between = before;
  between.path = corner.between;
  ++between.source.part;
  if (corner_feed_ != 0) between.feed = corner_feed_;
  auto place = held_.begin() + 1;
  if (corner_source_) {
    between.source = *corner_source_;
    while (place != held_.end() && index_of(*place) <= between.source.index) ++place;
  }
  held_.insert(place, std::move(between));
}

void ProgramState::hold_for_corner(const MoveRequest& request) {
  if (!request.corner || !request.corner->modal || in_plane_blocks_ > 1) corner_ = request.corner;
  const auto* last = std::get_if<MotionBlock>(&blocks_.back());
  if (corner_ && corner_->modal &&
      (last == nullptr || last->rapid || last->normal.moves() || !mode_.active()))
    corner_.reset();
  if (!corner_) return;
  corner_feed_ = request.corner ? request.corner_feed : 0;
  held_.push_back(std::move(blocks_.back()));
  blocks_.pop_back();
}

bool ProgramState::cut_corner_behind(const CornerCut& cut, double feed, const Source& source) {
  if (!corner_ || corner_->form != CornerCut::Form::open) return refuse_corner(source);
  const auto& before = *std::get_if<MotionBlock>(&held_.front());
  const bool alone = !before.rapid && !before.normal.moves() &&
                     std::ranges::none_of(before.tracking, &AxisTravel::moves);
  if (!alone || !mode_.active()) return refuse_corner(source);
  corner_ = cut;
  corner_source_ = source;
  corner_feed_ = feed;
  return true;
}

void ProgramState::release_held() {
  // Nearly always one.
  for (Block& block : held_) blocks_.push_back(std::move(block));
  held_.clear();
  corner_.reset();
  corner_source_.reset();
  corner_feed_ = 0;
}

ContourEnd ProgramState::contour_end(const Point& point, const Vector& tangent) const {
  return {.point = point,
          .tangent = tangent,
          .side = mode_.side == Side::right ? -1.0 : 1.0,
          .reach = mode_.options.suppress_trc ? 0 : mode_.tool_radius};
}

TrackingTravel ProgramState::standing_tracking() const {
  TrackingTravel standing;
  standing.reserve(tracking_.size());
  for (const double axis : tracking_) standing.push_back({.from = axis, .to = axis});
  return standing;
}

bool ProgramState::approach_by(const Lead& lead, const MoveRequest& request, const MoveRequest& way,
                               const std::optional<Infeed>& infeed) {
  Position end;
  if (!find_end(request, end)) return refuse(request.source, end_out_of_range(request));
  if (auto refusal = unknown_start(request)) return refuse(request.source, std::move(*refusal));
  if (lead_ || in_plane_blocks_ > 0 || !mode_.active())
    return report(request.source, Code::nc_unsupported,
                  "APPR or G147, G247, G347 within a contour");
  if (!check_radius(request.source)) return false;
  lead_ = PendingLead{
      .lead = lead, .request = request, .way = way, .from = position_, .infeed = infeed};
  enter_target(request, end);
  position_ = end;
  return true;
}

// Across the plane where the path in it has ended, as the control does it.
void ProgramState::travel_across(const MoveRequest& request) {
  const std::size_t third = axes_of(mode_.plane).third;
  if (!request.end[third] || *request.end[third] == position_[third]) return;
  Position end = position_;
  end[third] = *request.end[third];
  append_passive(request, end, standing_tracking(), false);
}

// To the height from which the lead goes down, or to its plane.
void ProgramState::come_down(const PendingLead& pending) {
  const std::size_t third = axes_of(mode_.plane).third;
  MoveRequest down = pending.way;
  down.end = {};
  down.end[third] = pending.infeed->height;
  travel_across(down);
  if (pending.infeed->along_the_lead) return;
  down.kind = MotionKind::linear;
  down.feed = pending.infeed->feed;
  down.end[third] = pending.request.end[third];
  travel_across(down);
}

// What leads to the contour comes out before what has been held since.
bool ProgramState::approach_contour(const Segment& contour) {
  const PendingLead pending = *std::exchange(lead_, std::nullopt);
  const Position here = position_;
  std::vector<Block> held = std::exchange(held_, {});
  const ContourEnd begin = contour_end(start_of(contour), tangent_at_start(contour));
  const Point from = to_plane(mode_.plane, pending.from);
  const auto path = path_to(begin, pending.lead, from, tolerances_.same_point);
  if (!path) return report(pending.request.source, Code::nc_unsupported, lead_without_room);
  position_ = pending.from;
  const std::size_t third = axes_of(mode_.plane).third;
  const auto go = [&](const MoveRequest& request, const auto& shape, bool climbs = false) {
    if (length_of(shape) <= tolerances_.same_point) return;
    Position end = position_;
    if (climbs) end[third] = request.end[third].value_or(end[third]);
    append_motion(request, shape, end, standing_tracking(), blocks_);
    std::get<MotionBlock>(blocks_.back()).role = ContourRole::lead;
  };
  if (path->contour) {
    const bool climbs = pending.infeed && pending.infeed->along_the_lead;
    go(pending.way, Line{.start = from, .end = start_of(*path->contour)});
    if (pending.infeed) come_down(pending);
    if (!climbs) travel_across(pending.request);
    std::visit([&](const auto& shape) { go(pending.request, shape, climbs); }, *path->contour);
  } else {
    // Up to the path of the tool without compensation, whatever the line leads across.
    const TrcMode mode = mode_;
    TrcMode& off = change_mode();
    off.side = Side::off;
    off.selection_number = 0;
    go(pending.way, Line{.start = from, .end = path->away});
    travel_across(pending.request);
    change_mode() = mode;
    go(pending.request, Line{.start = path->away, .end = begin.point});
  }
  const double height = here[third];
  position_ = from_plane(mode_.plane, begin.point, height);
  std::ranges::move(held, std::back_inserter(blocks_));
  return true;
}

bool ProgramState::approach_on_arc(MoveRequest request) {
  Position end;
  if (!find_end(request, end)) return refuse(request.source, end_out_of_range(request));
  if (auto refusal = unknown_start(request)) return refuse(request.source, std::move(*refusal));
  ProgrammedCircle programmed;
  if (auto refusal = circle(request, end, programmed))
    return refuse(request.source, std::move(*refusal));
  const Arc& arc = programmed.arc;
  if ((arc.end - arc.start).norm() <= tolerances_.same_point)
    return report(request.source, Code::nc_unsupported, "a full circle to the contour");
  // Which arc leads beside the contour, the contour says.
  request.kind = MotionKind::linear;
  request.center = {};
  request.radius.reset();
  change_mode().tangential = true;
  if (!move(request)) return false;
  arc_to_contour_ = ArcToContour{.source = request.source, .tangent = tangent_at_end(arc)};
  return true;
}

// With rounded coordinates an arc ends beside its tangent, a small one by some degrees.
bool ProgramState::goes_on_from_arc(const Segment& contour) {
  constexpr double largest_kink = 5 * std::numbers::pi / 180;
  const ArcToContour arc = *std::exchange(arc_to_contour_, {});
  const Vector tangent = tangent_at_start(contour);
  const double kink = std::abs(std::atan2(cross(arc.tangent, tangent), arc.tangent.dot(tangent)));
  if (!mode_.active() || kink <= largest_kink) return true;
  return report(arc.source, Code::nc_unsupported,
                "an arc to the contour that does not run on into its first block");
}

bool ProgramState::depart_by(const Lead& lead, const MoveRequest& request, bool climbs) {
  if (corner_ && corner_->form != CornerCut::Form::open) return refuse_held_corner();
  release_held();
  if (!mode_.active() || in_plane_blocks_ <= (has_approach_ ? 1U : 0U))
    return report(request.source, Code::nc_unsupported,
                  "DEP or G148, G248, G348 without a contour before it");
  Position end;
  if (!find_end(request, end)) return refuse(request.source, end_out_of_range(request));
  const ContourEnd last = contour_end(trc::end_of(last_path_), tangent_at_end(last_path_));
  const auto path = path_from(last, lead, to_plane(mode_.plane, end), tolerances_.same_point);
  if (!path) return report(request.source, Code::nc_unsupported, lead_without_room);
  const std::size_t third = axes_of(mode_.plane).third;
  const Arc* arc = path->contour ? std::get_if<Arc>(&*path->contour) : nullptr;
  if (arc != nullptr) {
    Position height = position_;
    if (climbs) height[third] = end[third];
    append_motion(request, *arc, height, standing_tracking(), blocks_);
    std::get<MotionBlock>(blocks_.back()).role = ContourRole::lead;
  }
  if (!deselect(request.source)) return false;
  MoveRequest away = request;
  const PlaneAxes axes = axes_of(mode_.plane);
  if (lead.form != Lead::Form::arc_and_line) {
    away.end[axes.first] = path->away.x();
    away.end[axes.second] = path->away.y();
  }
  if (arc != nullptr || !climbs) away.end[third].reset();
  target_ = position_;
  if (!move(away)) return false;
  travel_across(request);
  target_[third] = position_[third];
  return true;
}

}  // namespace trc
