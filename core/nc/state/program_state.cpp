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
    "a rounding or a chamfer that is not between two motions of one contour, at feed and in the "
    "plane";
constexpr const char* approach_without_contour = "APPR without a contour behind it";
constexpr const char* lead_without_room =
    "an approach or a departure that has no room: LCT from within its circle, CT with an arc that "
    "is smaller than the tool";

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
  if (lead_) return report(lead_->request.source, Code::nc_unsupported, approach_without_contour);
  // A corner that is cut is refused by the next motion.
  if (corner_ && (corner_->form == CornerCut::Form::open || corner_->modal)) release_held();
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
  if (plane == programmed_plane()) return true;
  // Behind a bare G40 the next straight motion leaves the contour first, in the plane of that.
  if (setup_.dialect != DialectName::isg && retract_pending_ && !mode_.active()) {
    next_plane_ = plane;
    return true;
  }
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
  if (const auto row = row_of_tool(number)) return call_tool(*row, source);
  if (number == 0) {
    radius_giver_ = RadiusGiver::nobody;
    missing_tool_ = 0;
    prepared_tool_ = no_tool;
    return !mode_.active() || in_plane_blocks_ == 0 || check_radius(source);
  }
  return report(source, Code::tool_unknown, std::string("D").append(std::to_string(number)));
}

std::optional<ToolRow> ProgramState::row_of_tool(std::int64_t number) const {
  const auto tool = setup_.tools.find(number);
  const bool is_in_table = tool != setup_.tools.end();
  if (const auto defined = defined_tools_.find(number); defined != defined_tools_.end())
    return ToolRow(defined->second, is_in_table ? tool->second.wear : 0);
  if (is_in_table) return tool->second;
  if (setup_.every_radius && number != 0) return ToolRow(*setup_.every_radius, setup_.wear);
  return std::nullopt;
}

bool ProgramState::call_tool(const ToolRow& row, const Source& source) {
  return enter_row(row, RadiusGiver::program, source);
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
  const bool klartext = setup_.dialect == DialectName::heidenhain;
  std::string text = (klartext ? "RL or RR " : "G41 or G42 ") + place_of(selected_);
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
  if (programmed.center_shift > circle_.reported_shift &&
      !report(request.source, Code::center_corrected, {},
              {{"center_shift", programmed.center_shift},
               {"corrected_radius", radius_of(programmed.arc)}}))
    return false;
  if (mode_.active() && in_plane_blocks_ == 0 && !check_radius(request.source)) return false;
  TrackingTravel tracking;
  if (!move_tracking(request, tracking)) return false;
  const bool alone = moves_in_plane_alone(request, end, tracking);
  Segment path = programmed.arc;
  if (!check_corner(request, alone) || !cut_corner_before(request, path, alone)) return false;
  if (lead_ && !approach_contour(path)) return false;
  enter_target(request, end);
  append_motion(request, std::get<Arc>(path), end, std::move(tracking));
  hold_for_corner(request);
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
    const bool alone = moves_in_plane_alone(request, end, tracking);
    Segment path = line;
    if (!check_corner(request, alone) || !cut_corner_before(request, path, alone)) return false;
    if (lead_ && !approach_contour(path)) return false;
    append_motion(request, std::get<Line>(path), end, std::move(tracking));
    hold_for_corner(request);
  } else {
    const bool tracking_moves = std::ranges::any_of(tracking, &AxisTravel::moves);
    append_passive(request, end, std::move(tracking), tracking_moves);
  }
  return true;
}

bool ProgramState::moves_in_plane_alone(const MoveRequest& request, const Position& end,
                                        const TrackingTravel& tracking) const {
  const std::size_t third = axes_of(mode_.plane).third;
  return request.kind != MotionKind::rapid && end[third] == position_[third] &&
         std::ranges::none_of(tracking, &AxisTravel::moves);
}

bool ProgramState::refuse_corner(const Source& source) {
  return report(source, Code::nc_unsupported, corner_without_contour);
}

// Only between motions of the contour itself, along which nothing else moves.
bool ProgramState::check_corner(const MoveRequest& request, bool alone) {
  const bool in_contour = mode_.active() && in_plane_blocks_ > 0;
  return !request.corner || request.corner->modal || (alone && in_contour) ||
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
  if (!alone || !in_contour) return refuse_corner(request.source);
  const auto corner = cut_corner(before.path, path, *corner_, tolerances_);
  if (!corner)
    return report(request.source, Code::nc_unsupported,
                  "a rounding or a chamfer the motions have no room for, or a chamfer beside an "
                  "arc");
  before.path = corner->before;
  path = corner->after;
  MotionBlock between = before;
  between.path = corner->between;
  if (corner_feed_ != 0) between.feed = corner_feed_;
  auto place = held_.begin() + 1;
  if (corner_source_) {
    between.source = *corner_source_;
    while (place != held_.end() && index_of(*place) <= between.source.index) ++place;
  }
  held_.insert(place, std::move(between));
  release_held();
  return true;
}

// In Klartext the corner stands in the next line.
void ProgramState::hold_for_corner(const MoveRequest& request) {
  if (!request.corner || !request.corner->modal || in_plane_blocks_ > 1) corner_ = request.corner;
  const auto* last = std::get_if<MotionBlock>(&blocks_.back());
  if (corner_ && corner_->modal &&
      (last == nullptr || last->rapid || last->normal.moves() || !mode_.active()))
    corner_.reset();
  if (setup_.dialect == DialectName::heidenhain && mode_.active() && in_plane_blocks_ > 1)
    corner_ = CornerCut{.form = CornerCut::Form::open};
  if (!corner_) return;
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
  std::ranges::move(held_, std::back_inserter(blocks_));
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

bool ProgramState::approach_by(const Lead& lead, const MoveRequest& request,
                               const MoveRequest& way) {
  Position end;
  if (!find_end(request, end)) return refuse(request.source, end_out_of_range(request));
  if (auto refusal = unknown_start(request)) return refuse(request.source, std::move(*refusal));
  if (lead_ || in_plane_blocks_ > 0 || !mode_.active())
    return report(request.source, Code::nc_unsupported, "APPR within a contour");
  if (!check_radius(request.source)) return false;
  lead_ = PendingLead{.lead = lead, .request = request, .way = way, .from = position_};
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
  const auto go = [&](const MoveRequest& request, const auto& shape) {
    if (length_of(shape) <= tolerances_.same_point) return;
    append_motion(request, shape, position_, standing_tracking());
    std::get<MotionBlock>(blocks_.back()).role = ContourRole::lead;
  };
  if (path->contour) {
    go(pending.way, Line{.start = from, .end = start_of(*path->contour)});
    travel_across(pending.request);
    std::visit([&](const auto& shape) { go(pending.request, shape); }, *path->contour);
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

bool ProgramState::depart_by(const Lead& lead, const MoveRequest& request) {
  if (corner_ && corner_->form != CornerCut::Form::open) return refuse_corner(request.source);
  release_held();
  if (!mode_.active() || in_plane_blocks_ <= (has_approach_ ? 1U : 0U))
    return report(request.source, Code::nc_unsupported, "DEP without a contour before it");
  Position end;
  if (!find_end(request, end)) return refuse(request.source, end_out_of_range(request));
  const ContourEnd last = contour_end(trc::end_of(last_path_), tangent_at_end(last_path_));
  const auto path = path_from(last, lead, to_plane(mode_.plane, end), tolerances_.same_point);
  if (!path) return report(request.source, Code::nc_unsupported, lead_without_room);
  if (const Arc* arc = path->contour ? std::get_if<Arc>(&*path->contour) : nullptr) {
    append_motion(request, *arc, position_, standing_tracking());
    std::get<MotionBlock>(blocks_.back()).role = ContourRole::lead;
  }
  if (!deselect(request.source)) return false;
  MoveRequest away = request;
  const PlaneAxes axes = axes_of(mode_.plane);
  if (lead.form != Lead::Form::arc_and_line) {
    away.end[axes.first] = path->away.x();
    away.end[axes.second] = path->away.y();
  }
  away.end[axes.third].reset();
  target_ = position_;
  if (!move(away)) return false;
  travel_across(request);
  target_[axes.third] = position_[axes.third];
  return true;
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
  sink().emplace_back(PassiveBlock{.source = source,
                                   .text = std::move(text),
                                   .normal = {.from = height, .to = height},
                                   .mode = shared_mode(),
                                   .tracking = standing_tracking()});
  return true;
}

bool ProgramState::end(const Source& source) {
  if (lead_) return report(lead_->request.source, Code::nc_unsupported, approach_without_contour);
  if (corner_ && corner_->form != CornerCut::Form::open && !corner_->modal)
    return refuse_corner(source);
  release_held();
  if (std::exchange(ended_, true) || !contour_open()) return !diagnostics_.stopped();
  return report(source, Code::ended_while_active);
}

}  // namespace trc
