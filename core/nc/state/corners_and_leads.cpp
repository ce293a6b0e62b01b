// The ends and corners of a contour in a program: rounding and chamfer words, APPR and DEP. Both
// make blocks wait until the next motion is known.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "core/geometry/distance.h"
#include "core/nc/state/program_state.h"

namespace trc {
namespace {

constexpr const char* corner_without_contour =
    "a rounding or a chamfer that is not between two motions of one contour, at feed and in the "
    "plane";
constexpr const char* lead_across_wall =
    "a lead by LCT whose line comes nearer to the contour than the radius of the tool";
constexpr const char* lead_without_room =
    "an approach or a departure that has no room: LCT from within its circle, CT, G247 and G347 "
    "with an arc that is smaller than the tool, G147 with DISR= that leaves no line";

// The line between the arc of LCT and the point is no part of the contour, so no later step checks
// it (D-161).
bool comes_too_near(const Line& line, const Segment& wall, double reach,
                    const Tolerances& tolerances) {
  return nearness(line, wall, tolerances.same_point).distance < reach - tolerances.on_contour;
}

}  // namespace

ProgramState::CutCorners ProgramState::cut_corners_at(const MoveRequest& request,
                                                      const Position& end,
                                                      const TrackingTravel& tracking) const {
  const std::size_t third = axes_of(mode_.plane).third;
  const bool in_plane_alone =
      end[third] == position_[third] && std::ranges::none_of(tracking, &AxisTravel::moves);
  return request.kind != MotionKind::rapid && in_plane_alone ? CutCorners::possible
                                                             : CutCorners::impossible;
}

bool ProgramState::refuse_corner(const Source& source) {
  return report(source, Code::nc_unsupported, corner_without_contour);
}

bool ProgramState::refuse_held_corner() {
  return diagnostics_.report(
      diagnostic(Code::nc_unsupported, corner_.source(), corner_without_contour));
}

bool ProgramState::refuse_open_lead() {
  return report(lead_->request.source, Code::nc_unsupported,
                "APPR or G147, G247, G347 without a contour after it");
}

// A corner needs two motions of the contour itself, without motion of other axes (D-124).
bool ProgramState::check_corner(const MoveRequest& request, CutCorners corners) {
  return !request.corner || request.corner->modal ||
         (corners == CutCorners::possible && is_in_contour()) || refuse_corner(request.source);
}

// Whether blocks between the motions of the corner separate them: a motion across the plane or of a
// further axis, and for Sinumerik more than three blocks, the default number that a machine looks
// past.
bool ProgramState::is_corner_interrupted() const {
  constexpr std::size_t most_between = 3;
  const std::vector<Block>& held = corner_.blocks();
  if (setup_.dialect == DialectName::sinumerik && held.size() > 1 + most_between) return true;
  return std::any_of(held.begin() + 1, held.end(), [](const Block& block) {
    const auto* passive = std::get_if<PassiveBlock>(&block);
    return passive != nullptr && passive->moves;
  });
}

// Shortens the end of the held block and the beginning of `path`.
bool ProgramState::cut_corner_before(const MoveRequest& request, Segment& path,
                                     CutCorners corners) {
  if (!corner_.waits()) return true;
  if (corner_.is_open()) {
    corner_.release(blocks_);
    return true;
  }
  const MotionBlock& before = corner_.before();
  const CornerCut& cut = corner_.cut();
  const bool in_contour = mode_.active() && before.mode->side == mode_.side &&
                          before.mode->selection_number == mode_.selection_number;
  const bool passes_over_none =
      setup_.dialect == DialectName::sinumerik || setup_.dialect == DialectName::fanuc;
  const bool may_be_none = cut.modal || (passes_over_none && cut.form == CornerCut::Form::round);
  const bool no_corner =
      may_be_none && std::abs(turn_between(tangent_at_end(before.path), tangent_at_start(path))) <=
                         tolerances_.tangent;
  const bool between_motions =
      corners == CutCorners::possible && in_contour && !is_corner_interrupted();
  if (no_corner || (cut.modal && !between_motions)) {
    corner_.release(blocks_);
    return true;
  }
  if (!between_motions) return refuse_held_corner();
  const auto corner = cut_corner(before.path, path, cut, tolerances_);
  const bool beside_arc =
      cut.form != CornerCut::Form::round && (is_arc(before.path) || is_arc(path));
  const bool takes_all_behind = corner && is_point(corner->after);
  // The corner replaces the motion after it, which has one feed and no corner of its own.
  const bool has_place = !takes_all_behind || (!is_point(corner->before) && !request.corner &&
                                               !corner_.has_own_line_or_feed());
  if (!corner || !has_place)
    return report(corner_.source(), Code::nc_unsupported,
                  beside_arc ? "a chamfer beside an arc"
                  : turns_back(before.path, path)
                      ? "a rounding or a chamfer where the contour turns back"
                      : "a rounding or a chamfer the motions have no room for");
  path = takes_all_behind ? corner->between : corner->after;
  corner_.put_in(*corner, tolerances_.same_point);
  corner_.release(blocks_);
  return true;
}

bool ProgramState::is_point(const Segment& path) const {
  return length_of(path) <= tolerances_.same_point;
}

void ProgramState::hold_for_corner(const MoveRequest& request) {
  if (!request.corner) return;
  const CornerCut& cut = *request.corner;
  const auto* last = std::get_if<MotionBlock>(&blocks_.back());
  const bool is_between_motions = in_plane_blocks_ > 1 && last != nullptr && !last->rapid &&
                                  !last->normal.moves() && mode_.active();
  if (cut.modal && !is_between_motions) return;
  corner_.hold(std::move(blocks_.back()), cut, request.corner_feed);
  blocks_.pop_back();
}

bool ProgramState::cut_corner_behind(const CornerCut& cut, double feed, const Source& source) {
  if (!corner_.is_open()) return refuse_corner(source);
  const MotionBlock& before = corner_.before();
  const bool alone = !before.rapid && !before.normal.moves() &&
                     std::ranges::none_of(before.tracking, &AxisTravel::moves);
  if (!alone || !mode_.active()) return refuse_corner(source);
  corner_.close(cut, feed, source);
  return true;
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
  if (const auto assumed = axis_of_assumed_start(request))
    return refuse_assumed_start(request.source, *assumed);
  if (!check_radius(request.source)) return false;
  lead_ = PendingLead{
      .lead = lead, .request = request, .way = way, .from = position_, .infeed = infeed};
  enter_target(request, end);
  position_ = end;
  return true;
}

// Travels across the plane at the end of the path in it, as the control does.
void ProgramState::travel_across(const MoveRequest& request) {
  const std::size_t third = axes_of(mode_.plane).third;
  if (!request.end[third] || *request.end[third] == position_[third]) return;
  Position end = position_;
  end[third] = *request.end[third];
  append_passive(request, end, standing_tracking());
}

// Travels to the height from which the lead goes down, or to its plane.
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

// The lead to the contour comes out before the blocks held since.
bool ProgramState::approach_contour(const Segment& contour) {
  const PendingLead pending = *std::exchange(lead_, std::nullopt);
  const Position here = position_;
  std::vector<Block> held = std::exchange(corner_.blocks(), {});
  const ContourEnd begin = contour_end(start_of(contour), tangent_at_start(contour));
  const Point from = to_plane(mode_.plane, pending.from);
  const auto path = path_to(begin, pending.lead, from, tolerances_.same_point);
  if (!path) return report(pending.request.source, Code::nc_unsupported, lead_without_room);
  position_ = pending.from;
  const std::size_t third = axes_of(mode_.plane).third;
  // If the lead goes down, the line to it runs above the contour.
  const bool is_in_depth =
      pending.request.end[third].value_or(position_[third]) == position_[third];
  if (pending.lead.form == Lead::Form::arc_and_line && is_in_depth && !pending.infeed &&
      comes_too_near({.start = from, .end = path->away}, contour, begin.reach, tolerances_))
    return report(pending.request.source, Code::nc_unsupported, lead_across_wall);
  const auto go = [&](const MoveRequest& request, const auto& shape, bool climbs = false) {
    if (length_of(shape) <= tolerances_.same_point) return;
    Position end = position_;
    if (climbs) end[third] = request.end[third].value_or(end[third]);
    append_motion(request, shape, end, standing_tracking(), blocks_);
    std::get<MotionBlock>(blocks_.back()).role = ContourRole::lead;
  };
  // If the arc begins at the tool position, the line to it would have no length, and no line of the
  // contour would lead to its path.
  const bool stands_at_arc = path->contour && !pending.infeed &&
                             (start_of(*path->contour) - from).norm() <= tolerances_.same_point;
  if (path->contour && !stands_at_arc) {
    const bool climbs = pending.infeed && pending.infeed->along_the_lead;
    go(pending.way, Line{.start = from, .end = start_of(*path->contour)});
    if (pending.infeed) come_down(pending);
    if (!climbs) travel_across(pending.request);
    std::visit([&](const auto& shape) { go(pending.request, shape, climbs); }, *path->contour);
  } else {
    // Up to the tool path without compensation, even if the line crosses the contour.
    const TrcMode mode = mode_;
    TrcMode& off = change_mode();
    off.side = Side::off;
    off.selection_number = 0;
    go(pending.way, Line{.start = from, .end = path->away});
    travel_across(pending.request);
    change_mode() = mode;
    go(pending.request,
       Line{.start = path->away, .end = path->contour ? start_of(*path->contour) : begin.point});
    if (path->contour)
      std::visit([&](const auto& shape) { go(pending.request, shape); }, *path->contour);
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
  // The contour decides which arc leads to its path.
  request.kind = MotionKind::linear;
  request.center = {};
  request.radius.reset();
  change_mode().tangential = true;
  if (!move(request)) return false;
  arc_to_contour_ = ArcToContour{.source = request.source, .tangent = tangent_at_end(arc)};
  return true;
}

// With rounded coordinates an arc may end off its tangent, a small arc by some degrees.
bool ProgramState::goes_on_from_arc(const Segment& contour) {
  constexpr double largest_kink = 5 * std::numbers::pi / 180;
  const ArcToContour arc = *std::exchange(arc_to_contour_, {});
  const Vector tangent = tangent_at_start(contour);
  const double kink = std::abs(std::atan2(cross(arc.tangent, tangent), arc.tangent.dot(tangent)));
  if (!mode_.active() || kink <= largest_kink) return true;
  return report(arc.source, Code::nc_unsupported,
                "an arc to the contour that does not run on into its first block");
}

bool ProgramState::depart_by(const Lead& lead, const MoveRequest& request, Climb climb) {
  const bool climbs = climb == Climb::along_the_lead;
  if (corner_.waits() && !corner_.is_open()) return refuse_held_corner();
  corner_.release(blocks_);
  if (!mode_.active() || in_plane_blocks_ <= (has_approach_ ? 1U : 0U))
    return report(request.source, Code::nc_unsupported,
                  "DEP or G148, G248, G348 without a contour before it");
  Position end;
  if (!find_end(request, end)) return refuse(request.source, end_out_of_range(request));
  const ContourEnd last = contour_end(trc::end_of(last_path_), tangent_at_end(last_path_));
  const auto path = path_from(last, lead, to_plane(mode_.plane, end), tolerances_.same_point);
  if (!path) return report(request.source, Code::nc_unsupported, lead_without_room);
  const bool to_a_point = lead.form == Lead::Form::arc_and_line;
  const Point place = to_a_point ? to_plane(mode_.plane, end) : path->away;
  if (to_a_point && !climbs &&
      comes_too_near({.start = path->away, .end = place}, last_path_, last.reach, tolerances_))
    return report(request.source, Code::nc_unsupported, lead_across_wall);
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
  away.end[axes.first] = place.x();
  away.end[axes.second] = place.y();
  if (arc != nullptr || !climbs) away.end[third].reset();
  target_ = position_;
  if (!move(away)) return false;
  travel_across(request);
  target_[third] = position_[third];
  return true;
}

}  // namespace trc
