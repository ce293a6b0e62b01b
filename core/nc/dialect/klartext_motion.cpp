#include "core/nc/dialect/klartext_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/geometry/turn.h"
#include "core/nc/dialect/apply_block.h"
#include "core/nc/dialect/heidenhain.h"
#include "core/nc/dialect/klartext_arcs.h"
#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/klartext_checks.h"
#include "core/nc/dialect/klartext_polar.h"
#include "core/nc/dialect/klartext_statements.h"
#include "core/nc/dialect/klartext_tools.h"
#include "core/nc/dialect/left_contour.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/words.h"

// Carries out a block of Klartext that may move.

namespace trc {
namespace {

// The end tangent of an arc with a radius: it differs from the chord by half the sweep.
Vector tangent_behind_arc(double radius, const Vector& chord, double turn) {
  const double sine = std::min(chord.norm() / (2 * std::abs(radius)), 1.0);
  const double cosine = std::copysign(std::sqrt(1 - sine * sine), radius);
  return cosine * chord + turn * sine * left_of(chord);
}

// After a lost retract: the other axis of the plane is still beside the contour or at an unknown
// position.
bool leaves_with_one_axis(const Reading& reading, const KlartextBlock& block) {
  if (!block.is(KlartextStatement::straight) || block.unfollowed || reading.trc_active())
    return false;
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  const auto& first = block.end[axes.first];
  const auto& second = block.end[axes.second];
  const bool one_alone = first.has_value() != second.has_value();
  return one_alone && !(first ? first : second)->increment;
}

// Feed and side come before the motion, as in every other dialect.
bool apply_klartext_modes(Reading& reading, ProgramLine& line, KlartextBlock& block) {
  reading.klartext_modes.feed_before = reading.feed;
  const bool says_feed = block.feed && !block.is_corner();
  if (says_feed) reading.feed = block.feed->value * klartext_feed_unit(reading);
  if (block.called_feed) reading.feed = reading.klartext_modes.called_feed;
  if (block.feed_per_turn || block.open_feed) reading.feed = 0;
  if (says_feed || block.called_feed || block.open_feed)
    reading.klartext_modes.feed_of_control = block.open_feed.has_value();
  if (block.side || block.adapts_feed || block.masks)
    reading.place(line, block.side ? block.side_begin : block.begin);
  if (block.adapts_feed && !reading.state.set_feed_adaptation(*block.adapts_feed, line.source))
    return false;
  const bool ends = block.side == Side::off || block.is(KlartextStatement::departure);
  if (block.masks && !(*block.masks ? leave_out_bottlenecks(reading, line.source)
                                    : treat_bottlenecks_by_setup(reading, line.source)))
    return false;
  if (block.is_lead() || !block.side) return true;
  if (*block.side != Side::off)
    return select_in_klartext(reading, line, *block.side, block.side_begin);
  return reading.state.deselect(line.source) &&
         (!ends || block.masks || treat_bottlenecks_by_setup(reading, line.source));
}

// APPR and DEP (D-129).
bool lead_in_klartext(Reading& reading, ProgramLine& line, KlartextBlock& block) {
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  const bool approaches = block.is(KlartextStatement::approach);
  const double unit = reading.length_unit();
  MoveRequest request;
  request.source = line.source;
  request.kind = MotionKind::linear;
  request.feed = reading.feed;
  for (std::size_t axis = 0; axis < block.end.size(); ++axis) {
    const auto& word = block.end[axis];
    if (!word) continue;
    if (word->increment && !reading.state.is_known(axis))
      return refuse_klartext(reading, line, word->begin,
                             "an increment from a place that is not known", Code::position_unknown);
    request.end[axis] = word->value * unit + (word->increment ? reading.state.position()[axis] : 0);
  }
  const bool to_a_point = approaches || block.lead.form == Lead::Form::arc_and_line;
  if (!to_a_point && (request.end[axes.first] || request.end[axes.second]))
    return refuse_klartext(reading, line, block.begin,
                           block.title() + " with a place in the plane");
  if (block.polar_lead) {
    Point end = Point::Zero();
    if (!find_polar_end(reading, line, block,
                        to_plane(reading.state.mode().plane, reading.state.position()), end))
      return false;
    request.end[axes.first] = end.x();
    request.end[axes.second] = end.y();
  }
  Lead lead = block.lead;
  if (block.length) lead.length = block.length->value * unit;
  if (block.radius) lead.radius = block.radius->value * unit;
  if (block.center_angle) lead.angle = block.center_angle->value * radians_per_degree;
  if (lead.angle > full_turn - 1e-12) lead.angle = full_turn;
  line.is_motion = true;
  reading.klartext_modes.tangent.reset();
  reading.motion = MotionKind::linear;
  if (!approaches) {
    if (block.rapid) request.kind = MotionKind::rapid;
    reading.klartext_modes.rapid = block.rapid;
    return reading.state.depart_by(lead, request, Climb::behind_the_lead) &&
           treat_bottlenecks_by_setup(reading, line.source);
  }
  // LCT has its own feed from the start, the other leads only on the lead itself (D-86).
  const bool says_feed = block.feed || block.open_feed || block.called_feed;
  const bool has_own_feed = says_feed && block.lead.form == Lead::Form::arc_and_line;
  MoveRequest way = request;
  if (!has_own_feed) {
    way.kind = reading.klartext_modes.rapid ? MotionKind::rapid : MotionKind::linear;
    way.feed = reading.klartext_modes.feed_before;
  }
  reading.klartext_modes.rapid = false;
  return select_in_klartext(reading, line, *block.side, block.side_begin) &&
         reading.state.approach_by(lead, request, way);
}

bool find_klartext_end(Reading& reading, ProgramLine& line, KlartextBlock& block) {
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  const double unit = reading.length_unit();
  KlartextLine& says = *line.klartext;
  MoveRequest request;
  for (std::size_t axis = 0; axis < block.end.size(); ++axis) {
    const auto& word = block.end[axis];
    if (!word) continue;
    says.axes |= std::uint64_t{1} << axis;
    if (word->increment) says.increments |= std::uint64_t{1} << axis;
    if (word->increment && !reading.state.is_known(axis))
      return refuse_klartext(reading, line, word->begin,
                             "an increment from a place that is not known", Code::position_unknown);
    request.end[axis] = word->value * unit + (word->increment ? reading.state.position()[axis] : 0);
  }
  const bool arc = is_arc_of(block.statement) || block.is(KlartextStatement::tangent_arc) ||
                   block.is(KlartextStatement::polar_tangent_arc);
  if (arc && block.end[axes.third] && !block.is(KlartextStatement::polar_circle))
    return refuse_klartext(reading, line, block.end[axes.third]->begin,
                           block.title() + " with a coordinate across the plane");
  if (block.tracking_increments != 0)
    return refuse_klartext(reading, line, block.begin,
                           block.title() + " with an increment of a turning axis");
  if (!block.tracking.empty()) {
    request.tracking = std::move(block.tracking);
    for (std::size_t axis = 0; axis < request.tracking.size(); ++axis)
      if (request.tracking[axis]) says.axes |= std::uint64_t{1} << (axis + 3);
  }
  const Point start = to_plane(reading.state.mode().plane, reading.state.position());
  if (block.is_polar()) {
    if (block.end[axes.first] || block.end[axes.second])
      return refuse_klartext(reading, line, block.begin,
                             block.title() + " with X, Y or Z of its plane");
    Point end = start;
    if (!find_polar_end(reading, line, block, start, end)) return false;
    request.end[axes.first] = end.x();
    request.end[axes.second] = end.y();
    says.axes |= std::uint64_t{1} << axes.first | std::uint64_t{1} << axes.second;
  }
  if (!arc) {
    reading.motion = block.rapid ? MotionKind::rapid : MotionKind::linear;
    return move_in_klartext(reading, line, request);
  }
  if (block.rapid) return refuse_klartext(reading, line, block.begin, block.title() + " with FMAX");
  return is_arc_of(block.statement) ? move_on_klartext_arc(reading, line, block, request)
                                    : move_on_tangent_arc(reading, line, block, request);
}

bool apply_klartext_motion(Reading& reading, ProgramLine& line, KlartextBlock& block) {
  using enum KlartextStatement;
  const bool open = reading.contour_open();
  reading.place(line, block.begin);
  switch (block.statement) {
    case none:
      return true;
    case center:
      if (open) {
        for (WordRange& word : line.words)
          if (word.role == WordRole::coordinate || word.role == WordRole::motion)
            word.role = WordRole::trc;
        line.sum_up_roles();
      }
      return take_klartext_pole(reading, line, block);
    case rounding:
    case chamfer: {
      reading.klartext_modes.tangent.reset();
      reading.klartext_modes.behind_corner = true;
      if (!open) return true;
      // After the corner the previous feed has to be written again.
      if (block.feed && reading.feed == 0 && !reading.klartext_modes.feed_of_control)
        return refuse_klartext(
            reading, line, block.feed->begin,
            "F beside " + block.title() + ", where the feed before is not known");
      const bool round = block.is(rounding);
      const double size = (round ? block.radius : block.length)->value * reading.length_unit();
      line.is_motion = true;
      if (size == 0) return true;
      return reading.state.cut_corner_behind(
          {.form = round ? CornerCut::Form::round : CornerCut::Form::leg, .size = size},
          block.feed ? block.feed->value * klartext_feed_unit(reading) : 0, line.source);
    }
    case approach:
    case departure:
      return lead_in_klartext(reading, line, block);
    default:
      break;
  }
  if (!block.names_axes() && !is_arc_of(block.statement)) {
    // L RL F200, L R0 FMAX M2
    reading.klartext_modes.rapid = block.rapid;
    reading.motion = block.rapid ? MotionKind::rapid : MotionKind::linear;
    return true;
  }
  return find_klartext_end(reading, line, block);
}

// After an R0 without motion.
bool leave_contour_in_klartext(Reading& reading, const ProgramLine& line,
                               const KlartextBlock& block, bool copied) {
  const bool leaves_here = copied && reading.contour_open() && !reading.trc_active();
  if (!reading.state.retract_is_lost() && !leaves_here) return true;
  const bool goes = block.is_motion() && !block.rapid && !block.machine_place && block.names_axes();
  LineBesideContour says{.copied = copied, .cuts = goes || block.calls_cycle, .begin = block.begin};
  for (std::size_t axis = 0; axis < says.named.size(); ++axis)
    says.named[axis] = !block.to_skip && (block.by_parameter.at(axis) ||
                                          (block.end[axis] && !block.end[axis]->increment));
  return leave_contour(reading, line, says);
}

// Only the control knows the end of the motion. `alone`: only the named axes move.
void forget_what_copied_block_moves(Reading& reading, ProgramLine& line, const KlartextBlock& block,
                                    bool alone) {
  const bool has_own_feed = block.rapid || block.open_feed || block.called_feed;
  if (block.is_motion() && !has_own_feed) line.feed_it_takes = reading.klartext_modes.feed_before;
  std::array<bool, 3> axes{true, true, true};
  const bool named = block.end[0] || block.end[1] || block.end[2];
  const bool by_parameters_alone = block.is(KlartextStatement::straight) && !block.to_skip &&
                                   !block.other_parameter && block.has_variable() &&
                                   reading.klartext_modes.uncompensated() == 0;
  const bool may_be_skipped = block.to_skip && block.is(KlartextStatement::straight) && named &&
                              block.unfollowed &&
                              block.unfollowed->why == KlartextObstacle::Why::may_be_skipped;
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
    axes[axis] = by_parameters_alone || alone || may_be_skipped
                     ? block.end[axis] || block.by_parameter.at(axis)
                 : block.leaves_on != 0 ? (block.leaves_on >> axis & 1U) != 0
                                        : !block.machine_place || !named || block.end[axis];
  forget_klartext_position(reading, line, axes);
  if (block.is(KlartextStatement::center)) lose_klartext_pole(reading, line);
  reading.klartext_modes.polar_radius.reset();
  if (block.feed_per_turn) reading.feed = 0;
}

// A lead may become several blocks. Functions at the end of the block come after the last one.
void stop_behind_lead(ProgramLine& line) {
  for (WordRange& word : line.words) {
    if (word.role != WordRole::technology) continue;
    const std::string text = in_upper_case(line.word(word));
    double number = 0;
    bool whole = false;
    if (text.front() != 'M' ||
        read_number(without_blanks_in_front(text.substr(1)), number, whole) == 0)
      continue;
    if (number == 5 || number == 6 || number == 9) word.role = WordRole::stop;
  }
  line.sum_up_roles();
}

// M109 and M110 change the feed where the path is longer or shorter than the contour, so the feed
// must be known.
bool check_adapted_feed(Reading& reading, ProgramLine& line, const KlartextBlock& block,
                        bool selects) {
  const FeedAdaptation adaptation = reading.state.mode().feed_adaptation;
  const double feed = reading.klartext_modes.feed_per_turn ? 0 : reading.feed;
  const bool in_contour = selects || reading.trc_active();
  const bool moves = block.is_motion() || block.is_lead() || block.adapts_feed;
  if (adaptation == FeedAdaptation::off || feed != 0 || !in_contour || !moves || block.rapid)
    return true;
  return refuse_klartext(reading, line, block.open_feed.value_or(block.begin),
                         std::string(adaptation == FeedAdaptation::on ? "M109" : "M110") +
                             ", no feed per minute, while TRC is active");
}

}  // namespace

bool apply_klartext(Reading& reading, ProgramLine& line, KlartextBlock& block) {
  line.klartext.emplace();
  const bool is_lead = block.is_lead();
  const bool selects = block.selects();
  const bool corner = block.is_corner();
  const bool beside_corner = corner || reading.klartext_modes.open_corner.source.line > 0;
  if (beside_corner && !check_corner_before(reading, line, block)) return false;
  if (!apply_klartext_modes(reading, line, block) ||
      !check_adapted_feed(reading, line, block, selects))
    return false;
  const bool approaches = block.is(KlartextStatement::approach) && selects;
  const bool departs = block.is(KlartextStatement::departure) && reading.trc_active();
  // IZ-3 from an unknown height: outside of contours nothing depends on it (D-127).
  const PlaneAxes plane = axes_of(reading.state.mode().plane);
  const bool plunges = block.is(KlartextStatement::straight) && !selects &&
                       !reading.contour_open() && block.end[plane.third] &&
                       block.end[plane.third]->increment && !block.end[plane.first] &&
                       !block.end[plane.second] && !reading.state.is_known(plane.third);
  const bool is_lost = reading.state.retract_is_lost();
  const bool alone =
      (is_lost && leaves_with_one_axis(reading, block)) || (plunges && !block.unfollowed);
  const bool copied = block.unfollowed.has_value() || alone || (is_lead && !approaches && !departs);
  if (corner && reading.contour_open() && line.has(WordRole::stop))
    return refuse_klartext(reading, line, block.begin, "a stop beside " + block.title());
  if ((copied || is_lost) && !leave_contour_in_klartext(reading, line, block, copied)) return false;
  if (copied || ((corner || block.is(KlartextStatement::center)) && !reading.contour_open())) {
    // The line comes out unchanged; none of it is rewritten.
    for (WordRange& word : line.words)
      if (word.role == WordRole::coordinate || word.role == WordRole::trc ||
          word.role == WordRole::motion)
        word.role = WordRole::technology;
    line.sum_up_roles();
  }
  if (departs) stop_behind_lead(line);
  if (line.has(WordRole::technology) && !pass_words(reading, line, WordRole::technology))
    return false;
  const bool turns_about_pole = block.is_polar() || block.is(KlartextStatement::circle);
  if (copied && turns_about_pole) hand_on_klartext_pole(reading, line);
  if (copied) {
    forget_what_copied_block_moves(reading, line, block, alone);
  } else if (!apply_klartext_motion(reading, line, block)) {
    return false;
  }
  if (reading.klartext_modes.pole) {
    line.klartext->pole_x = reading.klartext_modes.pole->x();
    line.klartext->pole_y = reading.klartext_modes.pole->y();
  }
  if (block.calls_cycle || (reading.klartext_modes.modal_cycle && block.is_motion()))
    forget_klartext_position(reading, line);
  if (line.has(WordRole::stop) && !pass_words(reading, line, WordRole::stop)) return false;
  if (!line.ends_program) return true;
  reading.ended = true;
  reading.state.place(0);
  return reading.state.end(line.source);
}

bool move_in_klartext(Reading& reading, ProgramLine& line, MoveRequest& request) {
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  const Point start = to_plane(reading.state.mode().plane, reading.state.position());
  request.source = line.source;
  request.kind = reading.motion;
  request.feed = reading.klartext_modes.feed_per_turn ? 0 : reading.feed;
  reading.klartext_modes.rapid = reading.motion == MotionKind::rapid;
  reading.klartext_modes.behind_corner = false;
  line.is_motion = true;
  if (!reading.state.move(request)) return false;
  const Point end = to_plane(reading.state.mode().plane, reading.state.position());
  const bool known = reading.state.is_known(axes.first) && reading.state.is_known(axes.second);
  if (!known) reading.klartext_modes.tangent.reset();
  if (!known || ((end - start).norm() <= 1e-6 && !request.center[axes.first])) return true;
  const double turn = reading.motion == MotionKind::clockwise ? -1 : 1;
  if (reading.motion == MotionKind::rapid || reading.motion == MotionKind::linear) {
    reading.klartext_modes.tangent = end - start;
  } else if (request.radius) {
    reading.klartext_modes.tangent = tangent_behind_arc(*request.radius, end - start, turn);
  } else {
    const Point center(*request.center[axes.first], *request.center[axes.second]);
    reading.klartext_modes.tangent = turn * left_of(end - center);
  }
  return true;
}

}  // namespace trc
