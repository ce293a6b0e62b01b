#include <utility>

#include "core/geometry/parallel.h"
#include "core/nc/state/in_range.h"
#include "core/nc/state/program_state.h"

// The modes that a program selects: side, selection mode, masking, feed, plane, tool and options.

namespace trc {
namespace {

// G237 leaves the contour itself, G239 where the tool is; all other modes need a motion block after
// G40 (rule 10.9).
bool retracts_in_a_block(Selection selection) {
  return selection != Selection::perpendicular && selection != Selection::without_block;
}

// The distance that SPLIT counts is one of an axis of the plane (rule 7.2).
bool splits_across(const SplitOption& split, Plane plane) {
  return split.where != SplitOption::Where::off && !split.along_path &&
         split.axis == axes_of(plane).third;
}
constexpr const char* split_across = "SPLIT counts along an axis of the plane";

}  // namespace

void ProgramState::update_side() {
  terms_in_mode_ = tool_.terms();
  give_radius(terms_in_mode_, programmed_side_, change_mode());
}

bool ProgramState::select(Side side, const Source& source) {
  if (side == Side::off) return deselect(source);
  if (side == programmed_side_) {
    tangential_requested_ = false;
    return true;
  }
  // The control needs a motion with R0 in between (D-162).
  if (mode_.active() && setup_.dialect == DialectName::heidenhain)
    return report(source, Code::nc_unsupported,
                  side == Side::left ? "RL after RR without R0 in between"
                                     : "RR after RL without R0 in between");
  if (!mode_.active()) {
    if (retract_pending_) return report(source, Code::deselection_without_motion);
    if (mode_.options.inverse) return report(source, Code::inverse_without_online);
    if (splits_across(mode_.options.split, mode_.plane))
      return report(source, Code::trc_option_out_of_range, split_across);
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
  if (tangential && !retracts_in_a_block(mode_.selection))
    return report(source, Code::not_available,
                  mode_.selection == Selection::perpendicular ? "G05 with G237" : "G05 with G239");
  if (lead_) return refuse_open_lead();
  // The next motion refuses a corner that is cut.
  if (!corner_.is_asked_for()) corner_.release(blocks_);
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
  if (retract_pending_) {
    const PlaneAxes axes = axes_of(mode_.plane);
    left_at_height_ = position_[axes.third];
    beside_contour_ = {};
    beside_contour_[axes.first] = beside_contour_[axes.second] = true;
    forget_what_stands_beside(source);
  }
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
  // After a bare G40 the next straight motion first leaves the contour, in the plane of the contour
  // (D-128).
  if (setup_.dialect != DialectName::isg && retract_pending_ && !mode_.active()) {
    next_plane_ = plane;
    return true;
  }
  if (contour_open()) return report(source, Code::plane_change_while_active);
  change_mode().plane = plane;
  return true;
}

bool ProgramState::follow_tool(std::optional<Refusal> refusal, const Source& source) {
  if (refusal) return refuse(source, std::move(*refusal));
  const RadiusTerms& terms = tool_.terms();
  if (terms != terms_in_mode_) {
    const bool moves = terms.beside() != terms_in_mode_.beside();
    if (moves && mode_.active() && mode_.selection == Selection::inside_corner)
      return report(source, Code::radius_change_under_inside_corner, {},
                    {{"tool_radius", terms.effective()}});
    update_side();
  }
  if (!mode_.active() || in_plane_blocks_ == 0) return true;
  refusal = tool_.check(selected_);
  return !refusal || refuse(source, std::move(*refusal));
}

bool ProgramState::check_radius(const Source& source) {
  std::optional<Refusal> refusal = tool_.check_at_first_motion(selected_);
  if (tool_.terms() != terms_in_mode_) update_side();
  return !refusal || refuse(source, std::move(*refusal));
}

bool ProgramState::set_tool_radius(double radius, const Source& source) {
  return follow_tool(tool_.set_radius(radius), source);
}

bool ProgramState::change_tool_radius(double more, const Source& source) {
  return follow_tool(tool_.change_radius(more), source);
}

bool ProgramState::set_wear(double wear, const Source& source) {
  return follow_tool(tool_.set_wear(wear), source);
}

bool ProgramState::set_scale(double scale, const Source& source) {
  return follow_tool(tool_.set_scale(scale), source);
}

bool ProgramState::set_allowance(double allowance, const Source& source) {
  return follow_tool(tool_.set_allowance(allowance), source);
}

bool ProgramState::set_tool(std::int64_t number, const Source& source, const WordPlace& place) {
  return follow_tool(tool_.set_tool(number, place), source);
}

bool ProgramState::call_tool(const ToolRow& row, const Source& source) {
  return follow_tool(tool_.call_tool(row), source);
}

bool ProgramState::define_tool(std::int64_t number, double radius, const Source& source) {
  const auto refusal = tool_.define_tool(number, radius);
  return !refusal || refuse(source, *refusal);
}

bool ProgramState::load_tool(const Source& source) {
  return follow_tool(tool_.load_tool(), source);
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
  if (mode_.active() && splits_across(split, mode_.plane))
    return report(source, Code::trc_option_out_of_range, split_across);
  TrcMode& mode = change_mode();
  mode.options = options;
  if (in_range(options.stretch_factor, 1, 9)) return true;
  mode.options.stretch_factor = 1;
  return report(source, Code::stretch_factor_out_of_range, "STRETCH_FACTOR",
                {{"value", options.stretch_factor}});
}

}  // namespace trc
