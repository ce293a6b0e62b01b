#include "core/nc/state/program_state.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/geometry/parallel.h"

namespace trc {
namespace {

bool is_circle(MotionKind kind) {
  return kind == MotionKind::clockwise || kind == MotionKind::counter_clockwise;
}

bool in_range(double value, double smallest, double largest) {
  return value >= smallest && value <= largest;  // false for NaN
}

// G237 leaves the contour by itself, G239 where it stands; all other modes need
// a motion block after G40 (rule 10.9).
bool retracts_in_a_block(Selection selection) {
  return selection != Selection::perpendicular && selection != Selection::without_block;
}

constexpr const char* corner_without_contour =
    "a rounding or a chamfer that is not between two straight motions of one contour";

constexpr std::array<const char*, 3> axis_words{"X", "Y", "Z"};
constexpr std::array<const char*, 3> center_words{"I", "J", "K"};

}  // namespace

void give_radius(const RadiusTerms& terms, Side side, TrcMode& mode) {
  const double beside = terms.beside();
  mode.tool_radius = std::abs(beside);
  mode.nominal_radius = terms.nominal;
  mode.below_nominal = terms.nominal > 0 && beside < 0;
  mode.side = side;
  if (beside < 0 && side != Side::off) mode.side = side == Side::left ? Side::right : Side::left;
}

ProgramState::ProgramState(const ProgramSetup& setup, const Tolerances& tolerances,
                           Diagnostics& diagnostics, std::vector<Block>& blocks)
    : setup_(setup),
      tolerances_(tolerances),
      diagnostics_(diagnostics),
      blocks_(blocks),
      mode_(setup.mode),
      terms_{.radius = setup.mode.tool_radius,
             .wear = setup.wear,
             .allowance = setup.allowance,
             .nominal = setup.nominal_radius},
      absolute_center_(setup.absolute_center),
      circle_(setup.circle),
      position_(setup.start),
      target_(setup.start) {
  // A centre path asks for no more than the nominal radius: nothing may differ from it.
  if (setup.tool_radius_given || setup.mode.tool_radius != 0 || setup.nominal_radius > 0)
    radius_giver_ = RadiusGiver::setup;
  if (setup.every_radius) {
    terms_.radius = *setup.every_radius;
    radius_giver_ = RadiusGiver::setup;
  }
  if (setup.masking_switches_kerf && mode_.masking == Masking::on)
    mode_.options.kerf_masking = true;
  // Programs in inch with three decimals.
  constexpr double half_of_a_thousandth = 0.0127;
  if (setup.dialect != DialectName::isg) circle_.largest_radius_shortfall = half_of_a_thousandth;
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
  Diagnostic refused = diagnostic(refusal.code, source, std::move(refusal.detail));
  refused.column = column_;
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

void ProgramState::update_side() { give_radius(terms_, programmed_side_, change_mode()); }

bool ProgramState::select(Side side, const Source& source) {
  if (side == Side::off) return deselect(source);
  if (side == programmed_side_) {
    tangential_requested_ = false;
    return true;
  }
  if (!mode_.active()) {
    if (retract_pending_) return report(source, Code::deselection_without_motion);
    if (mode_.options.inverse) return report(source, Code::inverse_without_online);
    in_plane_blocks_ = 0;
    selected_ = source;
    change_mode().selection_number = ++selections_;
  }
  programmed_side_ = side;
  update_side();
  mode_.tangential = std::exchange(tangential_requested_, false);
  return true;
}

bool ProgramState::deselect(const Source& source) {
  const bool tangential = std::exchange(tangential_requested_, false);
  if (!mode_.active()) return true;
  const bool has_contour = in_plane_blocks_ > (has_approach_ ? 1U : 0U);
  if (has_contour && mode_.selection == Selection::without_block) {
    const Point point = last_equidistant_point();
    const double third = position_[axes_of(mode_.plane).third];
    moves_by_radius_ = true;
    displaced_ |= (point - trc::end_of(last_path_)).norm() > tolerances_.same_point;
    position_ = from_plane(mode_.plane, point, third);
    target_ = position_;
  }
  retract_pending_ = has_contour && retracts_in_a_block(mode_.selection);
  just_deselected_ = true;
  TrcMode& mode = change_mode();
  mode.deselection = mode.selection;
  mode.tangential = tangential;
  mode.selection_number = 0;
  programmed_side_ = Side::off;
  update_side();
  return in_plane_blocks_ > 0 || report(source, Code::selection_without_contour);
}

Point ProgramState::last_equidistant_point() const {
  const TrcMode& mode = *last_mode_;
  const Point& end = trc::end_of(last_path_);
  if (mode.options.suppress_trc) return end;
  Segment path = last_path_;
  const double shift = mode.side == Side::left ? mode.tool_radius : -mode.tool_radius;
  if (const Arc* arc = std::get_if<Arc>(&path);
      arc != nullptr && mode.options.conv_cir_to_lin && mode.masking == Masking::on &&
      parallel_radius(*arc, shift) < -tolerances_.on_contour && arc->start != arc->end)
    path = Line{.start = arc->start, .end = arc->end};  // the chord, D-18
  return parallel_point(end, tangent_at_end(path), shift);
}

bool ProgramState::set_selection(Selection selection, const Source& source) {
  if (selection == mode_.selection) return true;
  if (mode_.active() && mode_.selection == Selection::inside_corner)
    return report(source, Code::mode_change_under_inside_corner);
  if (mode_.active() && selection == Selection::inside_corner)
    return report(source, Code::inside_corner_selected_while_active);
  change_mode().selection = selection;
  return true;
}

bool ProgramState::set_tangential(const Source& source) {
  if (mode_.selection == Selection::inside_corner)
    return report(source, Code::tangential_ignored_with_inside_corner);
  tangential_requested_ = true;
  return true;
}

bool ProgramState::set_transition(Transition transition, const Source&) {
  if (transition != mode_.transition) change_mode().transition = transition;
  return true;
}

bool ProgramState::set_masking(Masking masking, const Source&) {
  const bool on = masking == Masking::on;
  if (setup_.masking_switches_kerf && mode_.options.kerf_masking != on)
    change_mode().options.kerf_masking = on;
  if (masking != mode_.masking) change_mode().masking = masking;
  return true;
}

bool ProgramState::set_feed_adaptation(FeedAdaptation adaptation, const Source&) {
  if (adaptation != mode_.feed_adaptation) change_mode().feed_adaptation = adaptation;
  return true;
}

bool ProgramState::set_tangfeed_minimum(double radius, const Source& source) {
  if (radius < 0)
    return report(source, Code::negative_tangfeed_minimum, "RMIN", {{"radius", radius}});
  if (!in_range(radius, 0, tolerances_.largest_coordinate))
    return report(source, Code::field_invalid, "RMIN", {{"radius", radius}});
  change_mode().tangfeed_minimum = radius;
  return true;
}

bool ProgramState::set_plane(Plane plane, const Source& source) {
  if (plane == mode_.plane) return true;
  if (contour_open()) return report(source, Code::plane_change_while_active);
  change_mode().plane = plane;
  return true;
}

bool ProgramState::set_tool_radius(double radius, const Source& source) {
  RadiusTerms terms = terms_;
  terms.radius = radius;
  return enter_terms(terms, RadiusGiver::program, source);
}

// A T word that waits for its first motion has given what is changed here.
bool ProgramState::change_tool_radius(double more, const Source& source) {
  if (prepared_tool_ != no_tool && !loads_tools_ &&
      !take_tool(std::exchange(prepared_tool_, no_tool), source))
    return false;
  if (radius_giver_ == RadiusGiver::nobody)
    return report(source, Code::no_tool_radius, "a radius that is changed has to be there");
  RadiusTerms terms = terms_;
  terms.radius += more;
  return change_terms(terms, source);
}

bool ProgramState::set_wear(double wear, const Source& source) {
  RadiusTerms terms = terms_;
  terms.wear = wear;
  return change_terms(terms, source);
}

bool ProgramState::set_allowance(double allowance, const Source& source) {
  RadiusTerms terms = terms_;
  terms.allowance = allowance;
  return change_terms(terms, source);
}

bool ProgramState::enter_row(const ToolRow& row, RadiusGiver giver, const Source& source) {
  RadiusTerms terms = terms_;
  terms.radius = row.radius;
  terms.wear = setup_.every_radius ? setup_.wear : row.wear;
  return enter_terms(terms, giver, source);
}

bool ProgramState::enter_terms(const RadiusTerms& terms, RadiusGiver giver, const Source& source) {
  radius_giver_ = giver;
  missing_tool_ = no_tool;
  if (!setup_.every_radius) return change_terms(terms, source);
  RadiusTerms surveyed = terms;
  const double radius = *setup_.every_radius;
  surveyed.radius = terms.nominal > 0 ? radius : std::copysign(radius, terms.radius);
  return change_terms(surveyed, source);
}

bool ProgramState::change_terms(const RadiusTerms& terms, const Source& source) {
  const auto fits = [](double value) {
    return in_range(value, -largest_tool_radius, largest_tool_radius);
  };
  if (!fits(terms.radius) || !fits(terms.effective()))
    return report(source, Code::tool_radius_out_of_range, {},
                  {{"tool_radius", fits(terms.radius) ? terms.effective() : terms.radius},
                   {"largest", largest_tool_radius}});
  if (terms == terms_) return true;
  const bool moves = terms.beside() != terms_.beside();
  if (moves && mode_.active() && mode_.selection == Selection::inside_corner)
    return report(source, Code::radius_change_under_inside_corner, {},
                  {{"tool_radius", terms.effective()}});
  terms_ = terms;
  update_side();
  if (terms_.beside() != 0) zero_radius_reported_ = false;
  return !mode_.active() || in_plane_blocks_ == 0 || check_radius(source);
}

bool ProgramState::check_wear(const Source& source) {
  const bool wear_mode = terms_.nominal > 0;
  const double wear = wear_mode ? terms_.radius + terms_.wear : terms_.wear;
  if (std::abs(wear) <= setup_.max_wear) return true;
  std::vector<DiagnosticValue> values{{"wear", wear}, {"max_wear", setup_.max_wear}};
  if (wear_mode) values.push_back({"nominal_radius", terms_.nominal});
  return report(source, Code::wear_too_large, {}, std::move(values));
}

bool ProgramState::set_tool(std::int64_t number, const Source& source) {
  const auto tool = setup_.tools.find(number);
  if (const auto defined = defined_tools_.find(number); defined != defined_tools_.end())
    return enter_row({defined->second, tool != setup_.tools.end() ? tool->second.wear : 0},
                     RadiusGiver::program, source);
  if (tool != setup_.tools.end()) return enter_row(tool->second, RadiusGiver::program, source);
  if (setup_.every_radius && number != 0)
    return enter_row({*setup_.every_radius, setup_.wear}, RadiusGiver::program, source);
  if (number == 0) {
    radius_giver_ = RadiusGiver::nobody;
    missing_tool_ = 0;
    prepared_tool_ = no_tool;
    return !mode_.active() || in_plane_blocks_ == 0 || check_radius(source);
  }
  return report(source, Code::tool_unknown, std::string("D").append(std::to_string(number)));
}

bool ProgramState::load_tool(const Source& source) {
  loads_tools_ = true;
  return prepared_tool_ == no_tool || take_tool(std::exchange(prepared_tool_, no_tool), source);
}

// A radius the setup has given stands for tools that the table does not hold.
bool ProgramState::take_tool(std::int64_t number, const Source& source) {
  if (radius_giver_ == RadiusGiver::program) return true;
  const auto tool = setup_.tools.find(number);
  if (tool != setup_.tools.end())
    return enter_row(tool->second, RadiusGiver::tool_in_spindle, source);
  if (radius_giver_ == RadiusGiver::setup) return true;
  radius_giver_ = RadiusGiver::nobody;
  missing_tool_ = number;
  return !mode_.active() || in_plane_blocks_ == 0 || check_radius(source);
}

bool ProgramState::check_radius(const Source& source) {
  if (prepared_tool_ != no_tool && !loads_tools_ && in_plane_blocks_ == 0 &&
      !take_tool(prepared_tool_, source))
    return false;
  if (radius_giver_ == RadiusGiver::nobody)
    return report(source, Code::no_tool_radius, missing_radius());
  if (!check_wear(source)) return false;
  const bool is_zero = terms_.nominal == 0 && terms_.beside() == 0;
  if (!is_zero || std::exchange(zero_radius_reported_, true)) return true;
  return report(source, Code::tool_radius_zero);
}

std::string ProgramState::missing_radius() const {
  std::string text = "G41 or G42 " + place_of(selected_);
  if (missing_tool_ == 0) return text + ", D0 or T0 is no tool";
  if (missing_tool_ != no_tool)
    return text + ", the tool table has no T" + std::to_string(missing_tool_);
  if (prepared_tool_ != no_tool)
    return text + ", T" + std::to_string(prepared_tool_) + " without M06";
  return text;
}

bool ProgramState::set_options(const TrcOptions& options, const Source& source) {
  if (options.inverse) return report(source, Code::inverse_without_online);
  if (!in_range(options.tangential_limit, 0.1, 3))
    return report(source, Code::trc_option_out_of_range, "TANGENTIAL_LIMIT, 0.1 to 3 degrees",
                  {{"value", options.tangential_limit}});
  const SplitOption& split = options.split;
  if (split.where != SplitOption::Where::off) {
    const double largest = tolerances_.largest_coordinate;
    const bool first = split.distance_1 > 0 && split.distance_1 <= largest && is_feed(split.feed_1);
    const bool second =
        split.distance_2 > 0 && split.distance_2 <= largest && is_feed(split.feed_2);
    const bool no_second = split.distance_2 == 0 && split.feed_2 == 0;
    if (!first || !(second || no_second) || split.axis > 2)
      return report(source, Code::trc_option_out_of_range,
                    "SPLIT needs a main axis (or SPLIT_PATH) and a positive DIST_SEG and FEED_SEG "
                    "for each segment");
  }
  TrcMode& mode = change_mode();
  mode.options = options;
  if (in_range(options.stretch_factor, 1, 9)) return true;
  mode.options.stretch_factor = 1;
  return report(source, Code::stretch_factor_out_of_range, "STRETCH_FACTOR",
                {{"value", options.stretch_factor}});
}

void ProgramState::forget_position(const std::array<bool, 3>& axes, const Source& source) {
  for (std::size_t axis = 0; axis < known_.size(); ++axis)
    if (axes[axis]) known_[axis] = false;
  position_forgotten_ = source;
}

void ProgramState::set_position(const std::array<std::optional<double>, 3>& place,
                                const Source& source) {
  const std::size_t third = axes_of(mode_.plane).third;
  std::array<bool, 3> unknown{};
  for (std::size_t axis = 0; axis < place.size(); ++axis) {
    if (!place[axis]) continue;
    const bool stands_there =
        known_[axis] && std::abs(*place[axis] - position_[axis]) <= tolerances_.same_point;
    if (axis == third || stands_there) {
      known_[axis] = true;
      target_[axis] = *place[axis];
    } else {
      unknown[axis] = true;
    }
  }
  if (unknown != std::array<bool, 3>{}) forget_position(unknown, source);
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

ProgramState::Refusal ProgramState::end_out_of_range(const MoveRequest& request) const {
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

std::optional<ProgramState::Refusal> ProgramState::unknown_start(const MoveRequest& request) const {
  if (all_known()) return {};
  const PlaneAxes axes = axes_of(mode_.plane);
  const bool in_plane =
      request.end[axes.first] || request.end[axes.second] || is_circle(request.kind);
  for (std::size_t axis = 0; axis < known_.size(); ++axis) {
    if (known_[axis]) continue;
    const bool counts_from_start = request.end[axis] && request.incremental;
    const bool needed =
        axis != axes.third && in_plane && (is_circle(request.kind) || mode_.active());
    if (counts_from_start || needed)
      return Refusal{.code = Code::position_unknown,
                     .detail = std::string(axis_words[axis]) + ", unknown since the change " +
                               place_of(position_forgotten_)};
  }
  return {};
}

std::optional<ProgramState::Refusal> ProgramState::circle(const MoveRequest& request,
                                                          const Position& end,
                                                          ProgrammedCircle& programmed) const {
  if (displaced_)
    return Refusal{.code = Code::circle_center_misfit,
                   .detail = "an arc behind G40 under G239, before a straight motion",
                   .point = standing_point()};
  const PlaneAxes axes = axes_of(mode_.plane);
  if (request.center[axes.third])
    return Refusal{.code = Code::nc_unsupported, .detail = center_words[axes.third]};
  const bool has_center = request.center[axes.first] || request.center[axes.second];
  if (has_center && request.radius) return Refusal{.code = Code::center_and_radius_together};
  if (!has_center && !request.radius)
    // With G164 the reference control takes the missing centre for the start point.
    return Refusal{.code =
                       circle_.correct_center ? Code::circle_incomplete : Code::circle_radius_zero};

  const CircleEnds ends{.start = to_plane(mode_.plane, position_),
                        .end = to_plane(mode_.plane, end),
                        .clockwise = request.kind == MotionKind::clockwise};
  const auto too_large = [&](const Point& point) {
    return !(point.cwiseAbs().maxCoeff() <= tolerances_.largest_coordinate);
  };
  CircleResult result;
  Point center = Point::Zero();
  if (has_center) {
    const Point base = absolute_center_ ? Point::Zero() : ends.start;
    const Point missing = absolute_center_ ? ends.start : Point::Zero();
    center = base + Point(request.center[axes.first].value_or(missing.x()),
                          request.center[axes.second].value_or(missing.y()));
    if (too_large(center))
      return Refusal{.code = center.allFinite() ? Code::center_out_of_range : Code::field_invalid,
                     .detail = "I, J, K"};
    result = arc_about(center, ends, circle_, mode_.active(), tolerances_);
  } else {
    if (!std::isfinite(*request.radius)) return Refusal{.code = Code::field_invalid, .detail = "R"};
    result = arc_of_radius(*request.radius, ends, circle_, tolerances_);
  }
  if (CircleFault* fault = std::get_if<CircleFault>(&result))
    return Refusal{
        .code = fault->code, .values = std::move(fault->values), .point = standing_point()};
  programmed.arc = std::get<Arc>(result);
  if (too_large(programmed.arc.center)) return Refusal{.code = Code::center_out_of_range};
  if (has_center && circle_.correct_center)
    programmed.center_shift = (programmed.arc.center - center).norm();
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
  if (!all_known())
    if (auto refusal = unknown_start(request)) return refuse(request.source, std::move(*refusal));
  if (request.feed != 0 && !is_feed(request.feed))
    return report(request.source, Code::field_invalid, "feed", {{"feed", request.feed}});
  return is_circle(request.kind) ? move_on_circle(request, end) : move_straight(request, end);
}

bool ProgramState::move_on_circle(const MoveRequest& request, const Position& end) {
  ProgrammedCircle programmed;
  if (auto refusal = circle(request, end, programmed))
    return refuse(request.source, std::move(*refusal));
  if (programmed.center_shift > circle_.reported_shift &&
      !report(request.source, Code::center_corrected, {},
              {{"center_shift", programmed.center_shift},
               {"corrected_radius", radius_of(programmed.arc)}}))
    return false;
  if (mode_.active() && in_plane_blocks_ == 0 && !check_radius(request.source)) return false;
  Line none;
  if (!check_corner(request, false) || !cut_corner_before(request, none, false)) return false;
  TrackingTravel tracking;
  if (!move_tracking(request, tracking)) return false;
  enter_target(request, end);
  append_motion(request, programmed.arc, end, std::move(tracking));
  return true;
}

bool ProgramState::move_straight(const MoveRequest& request, const Position& end) {
  if (request.radius || request.center[0] || request.center[1] || request.center[2])
    return report(request.source, Code::nc_unsupported, "a circle word in a straight motion");
  TrackingTravel tracking;
  if (!move_tracking(request, tracking)) return false;
  enter_target(request, end);
  Line line{.start = to_plane(mode_.plane, position_), .end = to_plane(mode_.plane, end)};
  if (leads_back(request)) line.start = last_equidistant_point();
  if ((line.end - line.start).norm() > tolerances_.same_point) {
    if (mode_.active() && in_plane_blocks_ == 0 && !check_radius(request.source)) return false;
    displaced_ = false;
    const bool flat = end[axes_of(mode_.plane).third] == position_[axes_of(mode_.plane).third] &&
                      std::ranges::none_of(tracking, &AxisTravel::moves);
    if (!check_corner(request, flat) || !cut_corner_before(request, line, flat)) return false;
    append_motion(request, line, end, std::move(tracking));
    corner_ = request.corner;
    if (corner_) {
      held_.push_back(std::move(blocks_.back()));
      blocks_.pop_back();
    }
  } else {
    const bool tracking_moves = std::ranges::any_of(tracking, &AxisTravel::moves);
    append_passive(request, end, std::move(tracking), tracking_moves);
  }
  return true;
}

// Only between motions of the contour itself, along which nothing else moves.
bool ProgramState::check_corner(const MoveRequest& request, bool straight) {
  const bool in_contour = mode_.active() && in_plane_blocks_ > 0;
  return !request.corner || (straight && in_contour && request.kind == MotionKind::linear) ||
         report(request.source, Code::nc_unsupported, corner_without_contour);
}

// The block that is held loses its end and `line` its beginning.
bool ProgramState::cut_corner_before(const MoveRequest& request, Line& line, bool straight) {
  if (!corner_) return true;
  auto* before = std::get_if<MotionBlock>(&held_.front());
  const bool in_contour = mode_.active() && before->mode->side == mode_.side &&
                          before->mode->selection_number == mode_.selection_number;
  if (!straight || !in_contour || request.kind != MotionKind::linear)
    return report(request.source, Code::nc_unsupported, corner_without_contour);
  Line& path = *std::get_if<Line>(&before->path);
  const auto corner = cut_corner(path, line, *corner_, tolerances_);
  if (!corner)
    return report(request.source, Code::nc_unsupported,
                  "a rounding or a chamfer the motions have no room for");
  path.end = corner->end_before;
  line.start = corner->start_after;
  MotionBlock between = *before;
  between.path = corner->between;
  held_.insert(held_.begin() + 1, std::move(between));
  release_held();
  return true;
}

void ProgramState::release_held() {
  std::ranges::move(held_, std::back_inserter(blocks_));
  held_.clear();
  corner_.reset();
}

// Behind G40 alone the tool stands beside the contour, so that a motion to where it ends in the
// program moves it all the same: programs go back there and begin the next pass.
bool ProgramState::leads_back(const MoveRequest& request) const {
  const PlaneAxes axes = axes_of(mode_.plane);
  return setup_.dialect != DialectName::isg && retract_pending_ &&
         mode_.deselection == Selection::direct && last_mode_ != nullptr &&
         last_mode_->plane == mode_.plane &&
         (request.end[axes.first] || request.end[axes.second]) &&
         (to_plane(mode_.plane, target_) - trc::end_of(last_path_)).norm() <=
             tolerances_.same_point;
}

void ProgramState::enter_target(const MoveRequest& request, const Position& end) {
  for (std::size_t axis = 0; axis < known_.size(); ++axis)
    known_[axis] |= request.end[axis].has_value();
  target_ = end;
}

template <class Shape>
void ProgramState::append_motion(const MoveRequest& request, const Shape& path, const Position& end,
                                 TrackingTravel&& tracking) {
  const std::size_t third = axes_of(mode_.plane).third;
  const std::shared_ptr<const TrcMode>& mode = shared_mode();
  // Filled in where it lies: it is large.
  auto& block = *std::get_if<MotionBlock>(&blocks_.emplace_back(std::in_place_type<MotionBlock>));
  block.source = request.source;
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
}

void ProgramState::append_passive(const MoveRequest& request, const Position& end,
                                  TrackingTravel tracking, bool tracking_moves) {
  const std::size_t third = axes_of(mode_.plane).third;
  const AxisTravel normal{.from = position_[third], .to = end[third]};
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
  TrackingTravel standing;
  standing.reserve(tracking_.size());
  for (const double axis : tracking_) standing.push_back({.from = axis, .to = axis});
  sink().emplace_back(PassiveBlock{.source = source,
                                   .text = std::move(text),
                                   .normal = {.from = height, .to = height},
                                   .mode = shared_mode(),
                                   .tracking = std::move(standing)});
  return true;
}

bool ProgramState::end(const Source& source) {
  if (corner_) return report(source, Code::nc_unsupported, corner_without_contour);
  if (std::exchange(ended_, true) || !contour_open()) return !diagnostics_.stopped();
  return report(source, Code::ended_while_active);
}

}  // namespace trc
