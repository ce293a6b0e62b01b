#include "core/nc/dialect/klartext_checks.h"

#include <array>
#include <cmath>
#include <string>

#include "core/nc/dialect/heidenhain.h"
#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/reading.h"

// Checks that the words of a block of Klartext fit together, and whether the block is followed.

namespace trc {
namespace {

std::string word_at(const ProgramLine& line, std::size_t begin) {
  return std::string(line.text.substr(begin, line.text.find_first_of(" \t\r\n;", begin) - begin));
}

// ", a variable" and the like, appended to the word or the block that it refers to.
std::string_view told(KlartextObstacle::Why why) {
  using enum KlartextObstacle::Why;
  switch (why) {
    case variable:
      return ", a variable";
    case machine_coordinates:
      return ", machine coordinates";
    case untilted_coordinates:
      return ", coordinates without the tilt of the plane";
    case retract_along_tool:
      return ", a retract along the tool";
    case cycle_call:
      return ", a cycle call";
    case corners_of_small_steps:
      return ", corners of small steps";
    case open_corners:
      return ", open corners";
    case tip_is_led:
      return ", the tool tip is led";
    case feed_per_turn:
      return ", feed per turn";
    case across_the_plane:
      return ", an arc or a pole across the plane";
    case may_be_skipped:
      return ", a motion that may be skipped";
    case changed_radius:
      return ", with a radius that the program has changed";
    case unknown_place:
      return ", from a place or a pole that is not known";
    case changed_coordinates:
      return ", in coordinates that are scaled or led by the tool tip";
  }
  return {};
}

bool refuse_unfollowed(Reading& reading, const ProgramLine& line, const KlartextBlock& block) {
  const KlartextObstacle& obstacle = *block.unfollowed;
  const bool is_of_block = obstacle.begin == obstacle.end;
  std::string detail(is_of_block ? block.title()
                                 : line.word({.begin = obstacle.begin, .end = obstacle.end}));
  detail += told(obstacle.why);
  if (reading.trc_active()) detail += ", while TRC is active";
  return refuse_klartext(reading, line, obstacle.begin, std::move(detail), obstacle.code());
}

// Arcs across the plane, such as vertical leads: only the control follows them (D-91).
void leave_plane_by_arc(const Reading& reading, KlartextBlock& block) {
  using enum KlartextStatement;
  if (block.unfollowed) return;
  const std::size_t third = axes_of(reading.state.mode().plane).third;
  const bool by_pole = block.is(circle) || (block.is_polar() && !block.is_lead());  // C CP LP CTP
  const bool pole_across = by_pole && reading.klartext_modes.pole_across != 0;
  const bool end_across =
      (block.is(radius_arc) || block.is(tangent_arc)) && block.end[third].has_value();
  if (!(pole_across || end_across)) return;
  block.leave_unfollowed(KlartextObstacle::Why::across_the_plane);
  if (pole_across) block.leaves_on = reading.klartext_modes.pole_across;
  for (std::size_t axis = 0; axis < block.end.size(); ++axis)
    if (block.end[axis]) block.leaves_on |= main_axis_bit(axis);
}

// Checks that the words fit together.
bool check_klartext_form(Reading& reading, const ProgramLine& line, const KlartextBlock& block) {
  const auto wrong = [&](std::string detail, Code code) {
    return refuse_klartext(reading, line, block.begin, block.title() + std::move(detail), code);
  };
  if ((is_arc_of(block.statement)) && !block.clockwise)
    return wrong(" without DR", Code::circle_incomplete);
  if (block.is(KlartextStatement::radius_arc) && !block.radius)
    return wrong(" without R", Code::circle_incomplete);
  const bool corner = block.is_corner();
  const auto& size = block.is(KlartextStatement::rounding) ? block.radius : block.length;
  if (corner && !size) return wrong(" without its size", Code::nc_number);
  if (corner && size->value < 0)
    return refuse_klartext(reading, line, size->begin, word_at(line, size->begin) + ", below 0",
                           Code::nc_number);
  if (!block.is_lead()) return true;
  if (block.form.empty()) return wrong(" without LT, LN, CT or LCT", Code::nc_syntax);
  const bool straight =
      block.lead.form == Lead::Form::tangent || block.lead.form == Lead::Form::normal;
  if (straight && !block.length) return wrong(" without LEN", Code::nc_number);
  if (straight && !(block.length->value > 0))
    return refuse_klartext(reading, line, block.length->begin,
                           word_at(line, block.length->begin) + ", not above 0", Code::nc_number);
  if (!straight && !(block.radius && block.radius->value != 0))
    return wrong(" without R", Code::nc_number);
  const bool arc = block.lead.form == Lead::Form::arc;
  if (!straight && !arc && block.radius->value < 0)
    return wrong(" with R below 0", Code::nc_number);
  if (arc &&
      !(block.center_angle && block.center_angle->value > 0 && block.center_angle->value <= 360))
    return wrong(" without CCA, more than 0 and at most 360", Code::nc_number);
  return true;
}

// Refuses words that do not belong to the statement; otherwise they would be ignored.
bool check_words_of_form(Reading& reading, const ProgramLine& line, const KlartextBlock& block) {
  using enum KlartextStatement;
  const bool lead = block.is_lead();
  const bool by_arc = lead && block.lead.form == Lead::Form::arc;
  const bool by_line =
      lead && (block.lead.form == Lead::Form::tangent || block.lead.form == Lead::Form::normal);
  const bool to_a_point =
      block.is(approach) || (lead && block.lead.form == Lead::Form::arc_and_line);
  const bool polar = lead ? block.polar_lead && to_a_point : block.is_polar();
  const bool corner = block.is_corner();
  const bool has_place = !corner && !block.is(none);
  const bool has_radius = block.is(radius_arc) || block.is(rounding) || (lead && !by_line);
  const auto counts = [&](const std::optional<KlartextBlock::Value>& word, const char* name,
                          bool is_asked_for) {
    return !word || is_asked_for ||
           refuse_klartext(reading, line, word->begin,
                           std::string(name) + " beside " + block.title());
  };
  if (!counts(block.polar_radius, "PR", polar) || !counts(block.polar_angle, "PA", polar) ||
      !counts(block.length, "LEN", block.is(chamfer) || by_line) ||
      !counts(block.center_angle, "CCA", by_arc) || !counts(block.radius, "R", has_radius) ||
      !counts(block.end[0], "X", has_place) || !counts(block.end[1], "Y", has_place) ||
      !counts(block.end[2], "Z", has_place))
    return false;
  for (std::size_t axis = 0; axis < block.tracking.size(); ++axis)
    if (block.tracking[axis] && !block.is_motion() && !block.is(center))
      return refuse_klartext(
          reading, line, block.begin,
          reading.state.setup().tracking_axes[axis] + " beside " + block.title());
  const bool selects = block.selects();
  if (selects && (block.is(center) || corner))
    return refuse_klartext(reading, line, block.side_begin,
                           word_at(line, block.side_begin) + " beside " + block.title());
  if (block.clockwise && !is_arc_of(block.statement))
    return refuse_klartext(reading, line, block.begin, "DR beside " + block.title());
  return true;
}

bool check_feed_of_klartext(Reading& reading, const ProgramLine& line, const KlartextBlock& block) {
  if (block.feed && !reading.state.is_feed(block.feed->value * klartext_feed_unit(reading)))
    return refuse_klartext(
        reading, line, block.feed->begin,
        word_at(line, block.feed->begin) + ", more than 0 and at most 1000000000 mm/min",
        Code::nc_number);
  // FT is the time of one block, which becomes several.
  if (block.selects() && block.feed_per_turn && !block.not_in_contour)
    return refuse_klartext(reading, line, block.begin,
                           "FT or FMAXT, no feed per minute, while TRC is active");
  return true;
}

// LP about a pole or from a place that only the control knows, such as holes of a circle after a
// cycle call. The output has the programmed CC only if no contour has come since.
bool is_beyond_what_is_known(const Reading& reading, const KlartextBlock& block) {
  const KlartextModes& modes = reading.klartext_modes;
  if (!block.is(KlartextStatement::polar_line) || block.selects() || reading.contour_open() ||
      modes.pole_said != modes.contours || modes.pole_across != 0)
    return false;
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  const bool stands_where =
      reading.state.is_known(axes.first) && reading.state.is_known(axes.second);
  const bool has_radius =
      modes.polar_radius || (block.polar_radius && !block.polar_radius->increment);
  const bool has_angle = block.polar_angle && !block.polar_angle->increment;
  return !modes.pole || (!stands_where && !(has_radius && has_angle));
}

// Finds why the block is not followed, unless its words have given the reason.
void find_obstacle(const Reading& reading, KlartextBlock& block) {
  using Why = KlartextObstacle::Why;
  const KlartextModes& modes = reading.klartext_modes;
  // Whether the sizes of a lead are scaled no manual says.
  const std::uint32_t led = block.is_lead() ? modes.unfollowed : modes.uncompensated();
  const bool moves = block.is_motion() || block.is_lead() || block.is_corner();
  // `/ L M8` moves nothing.
  const auto moves_nothing = [&] {
    return block.is(KlartextStatement::straight) && !block.names_axes() && !block.side &&
           !block.feed && !block.open_feed;
  };
  if (block.to_skip && (moves || block.is(KlartextStatement::center)) && !block.unfollowed &&
      !moves_nothing())
    block.leave_unfollowed(Why::may_be_skipped);
  if (led != 0 && moves && !block.unfollowed) {
    const bool other_radius = (led & (KlartextLead::correction | KlartextLead::tool_data)) != 0;
    block.leave_unfollowed(other_radius ? Why::changed_radius : Why::changed_coordinates);
  }
  if (!block.unfollowed && is_beyond_what_is_known(reading, block))
    block.leave_unfollowed(Why::unknown_place);
  if (block.selects() && !block.unfollowed) block.unfollowed = block.not_in_contour;
  if (!block.is(KlartextStatement::straight)) leave_plane_by_arc(reading, block);
}

}  // namespace

bool check_klartext(Reading& reading, ProgramLine& line, KlartextBlock& block) {
  if (!check_feed_of_klartext(reading, line, block)) return false;
  if (block.to_skip && (block.masks || block.adapts_feed))
    return refuse_klartext(reading, line, block.begin,
                           "feeds or masking of a contour that may be skipped",
                           Code::block_skip_undecided);
  find_obstacle(reading, block);
  if (!block.unfollowed) return true;
  const bool selects = block.selects();
  // R0 beside M91 ends TRC first.
  if (!selects && (!reading.trc_active() || block.side == Side::off)) return true;
  // RL under scaling or M128 has been reported: this block fails for the same reason.
  const bool led =
      reading.klartext_modes.uncompensated() != 0 && block.unfollowed->begin == block.begin;
  if (led && !selects && !reading.faults.empty()) return false;
  return refuse_unfollowed(reading, line, block);
}

bool check_words_together(Reading& reading, const ProgramLine& line, const KlartextBlock& block) {
  return check_klartext_form(reading, line, block) && check_words_of_form(reading, line, block);
}

bool check_corners_at_ends(Reading& reading, const ProgramLine& line, const KlartextBlock& block) {
  using Start = KlartextModes::ContourStart;
  KlartextModes& modes = reading.klartext_modes;
  const bool rounds = block.is(KlartextStatement::rounding);
  if (block.is_corner()) {
    const auto& size = rounds ? block.radius : block.length;
    if (!reading.trc_active() || block.unfollowed || !size || !(size->value > 0)) return true;
    if (modes.start == Start::by_motion && rounds)
      return refuse_klartext(reading, line, block.begin, "RND as a smooth approach");
    if (modes.start == Start::by_motion || modes.start == Start::by_lead)
      return refuse_klartext(reading, line, block.begin, block.title() + " where a contour begins");
    modes.corner_in_contour = reading.place_of_word(line, block.begin);
    modes.corner_name = block.title();
    return true;
  }
  if (!block.side && !block.is_motion() && !block.is_lead()) return true;
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  const bool moves = (block.is_motion() && (block.end[axes.first] || block.end[axes.second])) ||
                     block.is_polar() || is_arc_of(block.statement);
  const bool departs = block.is(KlartextStatement::departure);
  const WordPlace corner = modes.corner_in_contour;
  if (departs || block.side == Side::off) {
    modes.start = Start::none;
    modes.corner_in_contour = {};
    if (corner.source.line == 0 || !reading.trc_active()) return true;
    return reading.refuse_at(corner, Code::nc_unsupported,
                             modes.corner_name == "RND" && !departs
                                 ? "RND as a smooth departure"
                                 : modes.corner_name + " where a contour ends");
  }
  if (block.selects() && !reading.trc_active())
    modes.start = block.is_lead() ? Start::by_lead : moves ? Start::by_motion : Start::to_come;
  else if (moves)
    modes.start = modes.start == Start::to_come ? Start::by_motion : Start::none;
  else
    return true;
  modes.corner_in_contour = {};
  return true;
}

bool check_corner_before(Reading& reading, const ProgramLine& line, const KlartextBlock& block) {
  WordPlace& open = reading.klartext_modes.open_corner;
  if (block.selects() && open.source.line > 0)
    return reading.refuse_at(open, Code::nc_unsupported,
                             "RND or CHF before the motion that selects TRC");
  const bool corner = block.is_corner();
  if (corner && !reading.contour_open())
    open = reading.place_of_word(line, block.begin);
  else if (block.is_motion() && block.names_axes())
    open = {};
  return true;
}

}  // namespace trc
