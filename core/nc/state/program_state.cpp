#include "core/nc/state/program_state.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/nc/state/in_range.h"

namespace trc {

ProgramState::ProgramState(const ProgramSetup& setup, const Tolerances& tolerances,
                           Diagnostics& diagnostics, std::vector<Block>& blocks)
    : setup_(setup),
      tolerances_(tolerances),
      diagnostics_(diagnostics),
      blocks_(blocks),
      tool_(setup_),
      mode_(setup.mode),
      absolute_center_(setup.absolute_center),
      circle_(setup.circle),
      position_(setup.start),
      target_(setup.start) {
  if (setup.masking_switches_kerf && mode_.masking == Masking::on)
    mode_.options.kerf_masking = true;
  // Programs in inch with three decimals.
  constexpr double half_of_a_thousandth = 0.0127;
  if (setup.dialect != DialectName::isg) circle_.largest_radius_shortfall = half_of_a_thousandth;
  mode_.touches_corner_circle = setup.dialect == DialectName::sinumerik;
  update_side();
}

bool ProgramState::report(const Source& source, Code code, std::string detail,
                          std::vector<DiagnosticValue> values) {
  Diagnostic reported = diagnostic(code, source, std::move(detail));
  reported.column = column_;
  reported.values = std::move(values);
  return diagnostics_.report(std::move(reported));
}

bool ProgramState::refuse(const Source& source, Refusal refusal) {
  Diagnostic refused = diagnostic(refusal.code, refusal.place ? refusal.place->source : source,
                                  std::move(refusal.detail));
  if (refusal.place) refused.told_after = source.index;
  constexpr std::array of_center{Code::center_and_radius_together, Code::circle_radius_zero,
                                 Code::center_out_of_range};
  const bool is_of_center =
      center_column_ > 0 && std::ranges::find(of_center, refusal.code) != of_center.end();
  refused.column = refusal.place ? refusal.place->column : is_of_center ? center_column_ : column_;
  refused.values = std::move(refusal.values);
  refused.point = refusal.point;
  return diagnostics_.report(std::move(refused));
}

TrcMode& ProgramState::change_mode() {
  shared_mode_.reset();
  return mode_;
}

void ProgramState::share_mode() {
  shared_mode_ = std::make_shared<const TrcMode>(mode_);
  if (setup_.every_radius) radius_uses_.push_back(radius_use());
}

bool ProgramState::find_end(const MoveRequest& request, Position& end) const {
  end = target_;
  bool all_in_range = true;
  for (std::size_t axis = 0; axis < end.size(); ++axis) {
    if (!request.end[axis]) continue;
    end[axis] = end_on(axis, request);
    all_in_range &=
        in_range(end[axis], -tolerances_.largest_coordinate, tolerances_.largest_coordinate);
  }
  return all_in_range;
}

Refusal ProgramState::end_out_of_range(const MoveRequest& request) const {
  for (std::size_t axis = 0; axis < request.end.size(); ++axis) {
    if (!request.end[axis]) continue;
    const double value = end_on(axis, request);
    if (!in_range(value, -tolerances_.largest_coordinate, tolerances_.largest_coordinate))
      return {.code = std::isfinite(value) ? Code::end_point_out_of_range : Code::field_invalid,
              .detail = axis_words[axis],
              .values = {{"coordinate", value}, {"largest", tolerances_.largest_coordinate}}};
  }
  return {};
}

bool ProgramState::move_tracking(const MoveRequest& request, TrackingTravel& travel) {
  if (tracking_.empty() && request.tracking.empty()) return true;
  return travel_on_tracking_axes(request, travel);
}

bool ProgramState::travel_on_tracking_axes(const MoveRequest& request, TrackingTravel& travel) {
  const bool programmed =
      std::ranges::any_of(request.tracking, [](const auto& value) { return value.has_value(); });
  if (tracking_.empty() && !programmed) return true;
  tracking_.resize(setup_.tracking_axes.size());
  travel.reserve(tracking_.size());
  for (std::size_t axis = 0; axis < tracking_.size(); ++axis) {
    const double from = tracking_[axis];
    double to = from;
    if (axis < request.tracking.size() && request.tracking[axis])
      to = *request.tracking[axis] + (request.incremental ? from : 0);
    if (!in_range(to, -tolerances_.largest_coordinate, tolerances_.largest_coordinate))
      return report(request.source,
                    std::isfinite(to) ? Code::end_point_out_of_range : Code::field_invalid,
                    setup_.tracking_axes[axis], {{"coordinate", to}});
    travel.push_back({.from = from, .to = to});
    tracking_[axis] = to;
  }
  return true;
}

bool ProgramState::move(const MoveRequest& request) {
  Position end;
  if (!find_end(request, end)) return refuse(request.source, end_out_of_range(request));
  if (!all_known() && !approaches_from_anywhere(request))
    if (auto refusal = unknown_start(request)) return refuse(request.source, std::move(*refusal));
  // 0: no feed is given; the reader of the words finds F0 (D-139).
  if (request.feed != 0 && !is_feed(request.feed))
    return report(request.source, Code::field_invalid, "feed", {{"feed", request.feed}});
  if (next_plane_ && is_circle(request.kind))
    return report(request.source, Code::plane_change_while_active);
  const bool goes_on =
      is_circle(request.kind) ? move_on_circle(request, end) : move_straight(request, end);
  if (next_plane_ && !retract_pending_) change_mode().plane = *std::exchange(next_plane_, {});
  return goes_on;
}

bool ProgramState::move_on_circle(const MoveRequest& request, const Position& end) {
  ProgrammedCircle programmed;
  if (auto refusal = circle(request, end, programmed))
    return refuse(request.source, std::move(*refusal));
  const double untold = std::min(circle_.reported_shift, rounded_width(circle_.last_digit));
  if (programmed.center_shift > circle_.reported_shift && programmed.width > untold &&
      !report(request.source, Code::center_corrected, {},
              {{"center_shift", programmed.center_shift},
               {"corrected_radius", radius_of(programmed.arc)}}))
    return false;
  if (awaits_approach()) {
    const std::optional<std::size_t> named = axis_of_assumed_start(request);
    const std::optional<std::size_t> assumed =
        named ? named : axis_kept_from_assumed_start(request);
    if (assumed) return refuse_assumed_start(request.source, *assumed);
    if (!check_radius(request.source)) return false;
  }
  TrackingTravel tracking;
  if (!move_tracking(request, tracking)) return false;
  enter_target(request, end);
  return append_between_corners(request, programmed.arc, end, std::move(tracking));
}

bool ProgramState::move_straight(const MoveRequest& request, const Position& end) {
  if (request.radius || request.center[0] || request.center[1] || request.center[2])
    return report(request.source, Code::nc_unsupported, "a circle word in a straight motion");
  TrackingTravel tracking;
  if (!move_tracking(request, tracking)) return false;
  const std::optional<std::size_t> unknown =
      approaches_from_anywhere(request) ? axis_of_unknown_start() : std::nullopt;
  const std::optional<std::size_t> assumed = unknown ? unknown : axis_of_assumed_start(request);
  const std::optional<std::size_t> kept = axis_kept_from_assumed_start(request);
  const bool is_way_back = retract_pending_ && leads_back(request, end);
  enter_target(request, end);
  Line line{.start = to_plane(mode_.plane, position_), .end = to_plane(mode_.plane, end)};
  if (is_way_back) line.start = last_equidistant_point();
  if ((line.end - line.start).norm() > tolerances_.same_point) {
    if (kept) return refuse_assumed_start(request.source, *kept);
    if (awaits_approach() && !check_radius(request.source)) return false;
    displaced_ = false;
    if (unknown) change_mode().from_anywhere = true;
    return append_between_corners(request, line, end, std::move(tracking));
  }
  // The tool would go along the contour itself (D-156, D-170).
  if (assumed) return refuse_assumed_start(request.source, *assumed);
  if (stands_still_at_selection(request) && !report(request.source, Code::selection_stands_still))
    return false;
  append_passive(request, end, std::move(tracking));
  return true;
}

// The motion after it then is the approach, also where it is meant to be the first wall (D-181).
bool ProgramState::stands_still_at_selection(const MoveRequest& request) const {
  const PlaneAxes axes = axes_of(mode_.plane);
  return awaits_approach() && !lead_ && mode_.selection != Selection::perpendicular &&
         (request.end[axes.first] || request.end[axes.second]);
}

// Nearly all motions have no word for a corner, before or after them.
template <class Shape>
bool ProgramState::append_between_corners(const MoveRequest& request, const Shape& shape,
                                          const Position& end, TrackingTravel&& tracking) {
  if (arc_to_contour_ && !goes_on_from_arc(shape)) return false;
  const bool is_plain =
      !request.corner && !corner_.waits() && !lead_ && setup_.dialect != DialectName::heidenhain;
  if (is_plain) {
    append_motion(request, shape, end, std::move(tracking), blocks_);
    return true;
  }
  const CutCorners corners = cut_corners_at(request, end, tracking);
  Segment path = shape;
  if (!check_corner(request, corners) || !cut_corner_before(request, path, corners)) return false;
  if (lead_ && !approach_contour(path)) return false;
  // An arc that rounds a corner may have replaced the motion. In Klartext the next line has the
  // corner after the motion.
  const bool may_be_followed = setup_.dialect == DialectName::heidenhain && is_in_contour();
  std::visit(
      [&](const auto& way) {
        append_motion(request, way, end, std::move(tracking),
                      may_be_followed ? corner_.blocks() : blocks_);
      },
      path);
  if (may_be_followed)
    corner_.open();
  else
    hold_for_corner(request);
  return true;
}

// After G40 alone the tool is beside the contour, so a motion to the programmed end of the contour
// does move the tool: programs go back there and begin the next pass (D-123).
bool ProgramState::leads_back(const MoveRequest& request, const Position& end) const {
  if (setup_.dialect == DialectName::isg) return false;
  const bool may_keep_offset = setup_.dialect == DialectName::fanuc && !retract_is_lost() &&
                               (request.kind != MotionKind::rapid || !is_above_left_contour(end));
  const PlaneAxes axes = axes_of(mode_.plane);
  return !may_keep_offset && mode_.deselection == Selection::direct && last_mode_ != nullptr &&
         last_mode_->plane == mode_.plane &&
         (request.end[axes.first] || request.end[axes.second]) &&
         (to_plane(mode_.plane, end) - trc::end_of(last_path_)).norm() <= tolerances_.same_point;
}

bool ProgramState::is_above_left_contour(const Position& end) const {
  const std::size_t third = axes_of(mode_.plane).third;
  return !known_[third] || std::max(position_[third], end[third]) > left_at_height_;
}

void ProgramState::enter_target(const MoveRequest& request, const Position& end) {
  for (std::size_t axis = 0; axis < known_.size(); ++axis) {
    known_[axis] |= request.end[axis].has_value();
    programmed_[axis] |= request.end[axis].has_value();
  }
  target_ = end;
}

template <class Shape>
void ProgramState::append_motion(const MoveRequest& request, const Shape& path, const Position& end,
                                 TrackingTravel&& tracking, std::vector<Block>& to) {
  const std::size_t third = axes_of(mode_.plane).third;
  const std::shared_ptr<const TrcMode>& mode = shared_mode();
  // Filled in place, because the block is large.
  auto& block = *std::get_if<MotionBlock>(&to.emplace_back(std::in_place_type<MotionBlock>));
  block.source = request.source;
  block.source.part = part_of(request.source.index);
  block.path.template emplace<Shape>(path);
  block.normal = {.from = position_[third], .to = end[third]};
  block.feed = request.feed;
  block.rapid = request.kind == MotionKind::rapid;
  block.role = request.role;
  block.mode = mode;
  block.tracking = std::move(tracking);
  position_ = from_plane(mode_.plane, path.end, end[third]);
  if (mode_.active()) {
    // Only G237 begins with the contour itself.
    if (in_plane_blocks_++ == 0) has_approach_ = mode_.selection != Selection::perpendicular;
    last_path_ = path;
    if (last_mode_ != mode) last_mode_ = mode;
  } else {
    retract_pending_ = false;
    just_deselected_ = false;
  }
  if (mode_.tangential) change_mode().tangential = false;
  if (mode_.from_anywhere) change_mode().from_anywhere = false;
}

template void ProgramState::append_motion<Line>(const MoveRequest&, const Line&, const Position&,
                                                TrackingTravel&&, std::vector<Block>&);
template void ProgramState::append_motion<Arc>(const MoveRequest&, const Arc&, const Position&,
                                               TrackingTravel&&, std::vector<Block>&);

void ProgramState::append_passive(const MoveRequest& request, const Position& end,
                                  TrackingTravel tracking) {
  const std::size_t third = axes_of(mode_.plane).third;
  const AxisTravel normal{.from = position_[third], .to = end[third]};
  const bool tracking_moves = std::ranges::any_of(tracking, &AxisTravel::moves);
  sink().emplace_back(PassiveBlock{.source = request.source,
                                   .normal = normal,
                                   .feed = request.feed,
                                   .rapid = request.kind == MotionKind::rapid,
                                   .moves = normal.moves() || tracking_moves,
                                   .mode = shared_mode(),
                                   .tracking = std::move(tracking)});
  position_[third] = end[third];
}

bool ProgramState::pass(const Source& source, std::string text) {
  const double height = position_[axes_of(mode_.plane).third];
  sink().emplace_back(PassiveBlock{.source = source,
                                   .text = std::move(text),
                                   .normal = {.from = height, .to = height},
                                   .mode = shared_mode(),
                                   .tracking = standing_tracking()});
  return true;
}

bool ProgramState::end(const Source& source) {
  if (lead_) return refuse_open_lead();
  if (corner_.is_asked_for()) return refuse_held_corner();
  corner_.release(blocks_);
  // Copied motions may have led both axes away, such as G53 X0 Y0 (D-142).
  const bool has_left = retract_is_lost() && std::ranges::none_of(beside_contour_, std::identity{});
  if (std::exchange(ended_, true) || !contour_open() || has_left) return !diagnostics_.stopped();
  const char* const ended = setup_.dialect == DialectName::heidenhain
                                ? "R0 without a motion after it"
                                : "G40 without a motion after it";
  return report(source, Code::ended_while_active, mode_.active() ? "" : ended);
}

}  // namespace trc
