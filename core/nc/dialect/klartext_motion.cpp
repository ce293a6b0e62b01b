#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "core/geometry/turn.h"
#include "core/nc/dialect/klartext_block.h"

// What a block of Klartext that may move does.

namespace trc {
namespace {

constexpr double radians = std::numbers::pi / 180;

// Of an arc by its radius: half its sweep beside the chord.
Vector tangent_behind_arc(double radius, const Vector& chord, double turn) {
  const double sine = std::min(chord.norm() / (2 * std::abs(radius)), 1.0);
  const double cosine = std::copysign(std::sqrt(1 - sine * sine), radius);
  return cosine * chord + turn * sine * left_of(chord);
}

}  // namespace

bool Interpreter::apply_klartext(ProgramLine& line, KlartextBlock& block) {
  line.klartext.emplace();
  const bool is_lead = block.is_lead();
  const bool selects = block.side && *block.side != Side::off;
  const bool corner = block.is_corner();
  const bool beside_corner = corner || klartext_.open_corner.source.line > 0;
  if (beside_corner && !check_corner_before(line, block, selects)) return false;
  if (!apply_klartext_modes(line, block)) return false;
  const bool approaches = block.is(KlartextStatement::approach) && selects;
  const bool departs = block.is(KlartextStatement::departure) && trc_active();
  // IZ-3 from a height that is not known: outside of contours nothing hangs on it.
  const PlaneAxes plane = axes_of(state_.mode().plane);
  const bool plunges = block.is(KlartextStatement::straight) && !selects && !contour_open() &&
                       block.end[plane.third] && block.end[plane.third]->increment &&
                       !block.end[plane.first] && !block.end[plane.second] &&
                       !state_.is_known(plane.third);
  const bool is_lost = state_.retract_is_lost();
  const bool alone = (is_lost && leaves_from_lost_place(block)) || (plunges && !block.unfollowed);
  const bool copied = block.unfollowed.has_value() || alone || (is_lead && !approaches && !departs);
  if (corner && contour_open() && line.has(WordRole::stop))
    return refuse_klartext(line, block.begin, "a stop beside " + block.title());
  if ((copied || is_lost) && !leave_contour_by_copy(line, block, copied)) return false;
  if (copied || ((corner || block.is(KlartextStatement::center)) && !contour_open())) {
    // As it stands: nothing of it is written anew.
    for (WordRange& word : line.words)
      if (word.role == WordRole::coordinate || word.role == WordRole::trc ||
          word.role == WordRole::motion)
        word.role = WordRole::technology;
    line.sum_up_roles();
  }
  if (line.has(WordRole::technology) && !pass_words(line, WordRole::technology)) return false;
  if (copied) {
    const bool has_own_feed = block.rapid || block.open_feed || block.called_feed;
    if (block.is_motion() && !has_own_feed) line.feed_it_takes = klartext_.feed_before;
    std::array<bool, 3> axes{true, true, true};
    const bool named = block.end[0] || block.end[1] || block.end[2];
    const bool by_parameters_alone =
        block.is(KlartextStatement::straight) && !block.to_skip && !block.other_parameter &&
        block.unfollowed_why.ends_with("variable") && klartext_.unfollowed == 0;
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
      axes[axis] = by_parameters_alone || alone ? block.end[axis] || block.by_parameter.at(axis)
                   : block.leaves_on != 0       ? (block.leaves_on >> axis & 1U) != 0
                                                : !block.machine_place || !named || block.end[axis];
    forget_klartext_position(line, axes);
    if (block.is(KlartextStatement::center)) klartext_.pole.reset();
    klartext_.polar_radius.reset();
    if (block.feed_per_turn || block.unfollowed_why.ends_with("variable")) feed_ = 0;
  } else if (!apply_klartext_motion(line, block)) {
    return false;
  }
  if (klartext_.pole) {
    line.klartext->pole_x = klartext_.pole->x();
    line.klartext->pole_y = klartext_.pole->y();
  }
  if (block.calls_cycle || (klartext_.modal_cycle && block.is_motion()))
    forget_klartext_position(line);
  if (line.has(WordRole::stop) && !pass_words(line, WordRole::stop)) return false;
  if (!line.ends_program) return true;
  ended_ = true;
  state_.place(0);
  return state_.end(line.source);
}

// Behind a retract that is lost, as for the dialects of G code: its other axis stands beside the
// contour, or nobody knows where.
bool Interpreter::leaves_from_lost_place(const KlartextBlock& block) const {
  if (!block.is(KlartextStatement::straight) || block.unfollowed || trc_active()) return false;
  const PlaneAxes axes = axes_of(state_.mode().plane);
  const auto& first = block.end[axes.first];
  const auto& second = block.end[axes.second];
  const bool one_alone = first.has_value() != second.has_value();
  return one_alone && !(first ? first : second)->increment;
}

// What a block of Klartext does behind R0 without motion, as copied lines of G code do.
bool Interpreter::leave_contour_by_copy(ProgramLine& line, const KlartextBlock& block,
                                        bool copied) {
  const bool leaves_here = copied && contour_open() && !trc_active();
  if (!state_.retract_is_lost() && !leaves_here) return true;
  std::array<bool, 3> named{};
  for (std::size_t axis = 0; axis < named.size(); ++axis)
    named[axis] = !block.to_skip &&
                  (block.by_parameter.at(axis) || (block.end[axis] && !block.end[axis]->increment));
  if (copied) state_.have_left_contour(named);
  const bool cuts = block.is_motion() && !block.rapid && !block.machine_place && block.names_axes();
  if (!cuts && !block.calls_cycle) return true;
  return check_left_contour(line, block.begin, named);
}

// Feed and side before the motion, as in every other dialect.
bool Interpreter::apply_klartext_modes(ProgramLine& line, KlartextBlock& block) {
  klartext_.feed_before = feed_;
  if (block.feed && !block.is_corner()) feed_ = block.feed->value * (inch_ ? mm_per_inch / 10 : 1);
  if (block.called_feed) feed_ = klartext_.called_feed;
  if (block.feed_per_turn || block.open_feed) feed_ = 0;
  if (block.side || block.adapts_feed || block.masks)
    place(line, block.side ? block.side_begin : block.begin);
  if (block.adapts_feed && !state_.set_feed_adaptation(*block.adapts_feed, line.source))
    return false;
  const bool ends = block.side == Side::off || block.is(KlartextStatement::departure);
  const auto mask = [&](bool on) { return leave_out_bottlenecks(on, line.source); };
  if (block.masks && !mask(*block.masks)) return false;
  if (block.is_lead() || !block.side) return true;
  if (*block.side != Side::off) return select_in_klartext(line, *block.side, block.side_begin);
  return state_.deselect(line.source) && (!ends || block.masks || mask(false));
}

bool Interpreter::apply_klartext_motion(ProgramLine& line, KlartextBlock& block) {
  using enum KlartextStatement;
  const bool open = contour_open();
  place(line, block.begin);
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
      return take_klartext_pole(line, block);
    case rounding:
    case chamfer: {
      klartext_.tangent.reset();
      if (!open) return true;
      const bool round = block.is(rounding);
      const double size = (round ? block.radius : block.length)->value * length_unit();
      line.is_motion = true;
      if (size == 0) return true;
      return state_.cut_corner_behind(
          {.form = round ? CornerCut::Form::round : CornerCut::Form::leg, .size = size},
          block.feed ? block.feed->value * (inch_ ? mm_per_inch / 10 : 1) : 0, line.source);
    }
    case approach:
    case departure:
      return lead_in_klartext(line, block);
    default:
      break;
  }
  if (!block.names_axes() && !is_arc_of(block.statement)) {
    // L RL F200, L R0 FMAX M2
    klartext_.rapid = block.rapid;
    motion_ = block.rapid ? MotionKind::rapid : MotionKind::linear;
    return true;
  }
  return find_klartext_end(line, block);
}

// CC X Z of a tool along Z: what turns about it is copied.
bool Interpreter::take_pole_across(ProgramLine& line, const KlartextBlock& block) {
  if (contour_open()) return refuse_klartext(line, block.begin, "CC across the plane");
  AxisBits named = 0;
  for (std::size_t axis = 0; axis < block.end.size(); ++axis)
    if (block.end[axis]) named |= static_cast<AxisBits>(1U << axis);
  klartext_.pole_across = (named & (named - 1)) != 0 ? named : all_axes;
  klartext_.pole.reset();
  line.klartext->loses_pole = true;
  return true;
}

// CC: the pole, also where it is told from where the tool stands.
bool Interpreter::take_klartext_pole(ProgramLine& line, KlartextBlock& block) {
  const PlaneAxes axes = axes_of(state_.mode().plane);
  if (!block.tracking.empty())
    return refuse_klartext(line, block.begin, "CC with an axis that turns");
  klartext_.pole_across = 0;
  if (block.end[axes.third]) return take_pole_across(line, block);
  const bool alone = !block.end[axes.first] && !block.end[axes.second];
  const std::optional<Point> old = klartext_.pole;
  Point pole = old.value_or(Point::Zero());
  bool known = true;
  for (const auto& [axis, coordinate] :
       {std::pair{axes.first, &pole.x()}, std::pair{axes.second, &pole.y()}}) {
    const auto& word = block.end[axis];
    const bool from_tool = alone || (word && word->increment);
    known = known && (from_tool ? state_.is_known(axis) : word.has_value() || old.has_value());
    const double base = from_tool ? state_.position()[axis] : 0;
    if (word || alone) *coordinate = base + (word ? word->value * length_unit() : 0);
  }
  klartext_.pole = known ? std::optional(pole) : std::nullopt;
  line.klartext->sets_pole = known;
  line.klartext->loses_pole = !known;
  return true;
}

bool Interpreter::find_polar_end(ProgramLine& line, KlartextBlock& block, const Point& start,
                                 Point& end) {
  KlartextLine& says = *line.klartext;
  const auto wrong = [&](const char* why, Code code = Code::nc_unsupported) {
    return refuse_klartext(line, block.begin, block.title() + why, code);
  };
  if (!klartext_.pole) return wrong(" without CC, or behind what moves it");
  const PlaneAxes axes = axes_of(state_.mode().plane);
  const auto stands_at_known_place = [&] {
    return state_.is_known(axes.first) && state_.is_known(axes.second);
  };
  constexpr const char* unknown_start = ", from a place that is not known";
  constexpr Code unknown = Code::position_unknown;
  const Vector arm = start - *klartext_.pole;
  const bool circle = block.is(KlartextStatement::polar_circle);
  says.needs_pole = true;
  double radius = arm.norm();
  if (!circle) {
    says.sets_polar_radius = block.polar_radius.has_value();
    const bool counts_on = !block.polar_radius || block.polar_radius->increment;
    says.needs_polar_radius = counts_on && klartext_.polar_radius;
    // IPR without a PR before it counts from where the tool stands.
    const bool from_tool = counts_on && block.polar_radius && !klartext_.polar_radius;
    says.counts_from_start |= from_tool;
    if (counts_on && !says.needs_polar_radius && !from_tool) return wrong(" without PR");
    if (from_tool && !stands_at_known_place()) return wrong(unknown_start, unknown);
    radius = (says.needs_polar_radius ? *klartext_.polar_radius
              : from_tool             ? arm.norm()
                                      : 0) +
             (block.polar_radius ? block.polar_radius->value * length_unit() : 0);
    klartext_.polar_radius = radius;
  }
  const bool from_start = !block.polar_angle || block.polar_angle->increment;
  says.counts_from_start |= from_start || circle;
  if ((from_start || circle) && !stands_at_known_place()) return wrong(unknown_start, unknown);
  if ((from_start || circle) && arm.norm() < 1e-6) return wrong(", from the pole itself");
  const double begin = std::atan2(arm.y(), arm.x());
  const double angle =
      (from_start ? begin : 0) + (block.polar_angle ? block.polar_angle->value * radians : 0);
  end = *klartext_.pole + radius * Vector(std::cos(angle), std::sin(angle));
  return true;
}

bool Interpreter::find_klartext_end(ProgramLine& line, KlartextBlock& block) {
  const PlaneAxes axes = axes_of(state_.mode().plane);
  const double unit = length_unit();
  KlartextLine& says = *line.klartext;
  MoveRequest request;
  for (std::size_t axis = 0; axis < block.end.size(); ++axis) {
    const auto& word = block.end[axis];
    if (!word) continue;
    says.axes |= std::uint64_t{1} << axis;
    if (word->increment) says.increments |= std::uint64_t{1} << axis;
    if (word->increment && !state_.is_known(axis))
      return refuse_klartext(line, word->begin, "an increment from a place that is not known",
                             Code::position_unknown);
    request.end[axis] = word->value * unit + (word->increment ? state_.position()[axis] : 0);
  }
  const bool arc = is_arc_of(block.statement) || block.is(KlartextStatement::tangent_arc) ||
                   block.is(KlartextStatement::polar_tangent_arc);
  if (arc && block.end[axes.third] && !block.is(KlartextStatement::polar_circle))
    return refuse_klartext(line, block.end[axes.third]->begin,
                           block.title() + " with a coordinate across the plane");
  if (block.tracking_increments != 0)
    return refuse_klartext(line, block.begin,
                           block.title() + " with an increment of a turning axis");
  if (!block.tracking.empty()) {
    request.tracking = std::move(block.tracking);
    for (std::size_t axis = 0; axis < request.tracking.size(); ++axis)
      if (request.tracking[axis]) says.axes |= std::uint64_t{1} << (axis + 3);
  }
  const Point start = to_plane(state_.mode().plane, state_.position());
  if (block.is_polar()) {
    if (block.end[axes.first] || block.end[axes.second])
      return refuse_klartext(line, block.begin, block.title() + " with X, Y or Z of its plane");
    Point end = start;
    if (!find_polar_end(line, block, start, end)) return false;
    request.end[axes.first] = end.x();
    request.end[axes.second] = end.y();
    says.axes |= std::uint64_t{1} << axes.first | std::uint64_t{1} << axes.second;
  }
  if (!arc) {
    motion_ = block.rapid ? MotionKind::rapid : MotionKind::linear;
    return move_in_klartext(line, request);
  }
  if (block.rapid) return refuse_klartext(line, block.begin, block.title() + " with FMAX");
  return is_arc_of(block.statement) ? move_on_klartext_arc(line, block, request)
                                    : move_on_tangent_arc(line, block, request);
}

// Moves, and keeps where the motion has led.
bool Interpreter::move_in_klartext(ProgramLine& line, MoveRequest& request) {
  const PlaneAxes axes = axes_of(state_.mode().plane);
  const Point start = to_plane(state_.mode().plane, state_.position());
  request.source = line.source;
  request.kind = motion_;
  request.feed = klartext_.feed_per_turn ? 0 : feed_;
  klartext_.rapid = motion_ == MotionKind::rapid;
  line.is_motion = true;
  if (!state_.move(request)) return false;
  const Point end = to_plane(state_.mode().plane, state_.position());
  const bool known = state_.is_known(axes.first) && state_.is_known(axes.second);
  if (!known) klartext_.tangent.reset();
  if (!known || ((end - start).norm() <= 1e-6 && !request.center[axes.first])) return true;
  const double turn = motion_ == MotionKind::clockwise ? -1 : 1;
  if (motion_ == MotionKind::rapid || motion_ == MotionKind::linear) {
    klartext_.tangent = end - start;
  } else if (request.radius) {
    klartext_.tangent = tangent_behind_arc(*request.radius, end - start, turn);
  } else {
    const Point center(*request.center[axes.first], *request.center[axes.second]);
    klartext_.tangent = turn * left_of(end - center);
  }
  return true;
}

// APPR and DEP.
bool Interpreter::lead_in_klartext(ProgramLine& line, KlartextBlock& block) {
  const PlaneAxes axes = axes_of(state_.mode().plane);
  const bool approaches = block.is(KlartextStatement::approach);
  const double unit = length_unit();
  MoveRequest request;
  request.source = line.source;
  request.kind = MotionKind::linear;
  request.feed = feed_;
  for (std::size_t axis = 0; axis < block.end.size(); ++axis) {
    const auto& word = block.end[axis];
    if (!word) continue;
    if (word->increment && !state_.is_known(axis))
      return refuse_klartext(line, word->begin, "an increment from a place that is not known",
                             Code::position_unknown);
    request.end[axis] = word->value * unit + (word->increment ? state_.position()[axis] : 0);
  }
  const bool to_a_point = approaches || block.lead.form == Lead::Form::arc_and_line;
  if (!to_a_point && (request.end[axes.first] || request.end[axes.second]))
    return refuse_klartext(line, block.begin, block.title() + " with a place in the plane");
  if (block.polar_lead) {
    Point end = Point::Zero();
    if (!find_polar_end(line, block, to_plane(state_.mode().plane, state_.position()), end))
      return false;
    request.end[axes.first] = end.x();
    request.end[axes.second] = end.y();
  }
  Lead lead = block.lead;
  if (block.length) lead.length = block.length->value * unit;
  if (block.radius) lead.radius = block.radius->value * unit;
  if (block.center_angle) lead.angle = block.center_angle->value * radians;
  if (lead.angle > full_turn - 1e-12) lead.angle = full_turn;
  line.is_motion = true;
  klartext_.tangent.reset();
  motion_ = MotionKind::linear;
  if (!approaches) {
    if (block.rapid) request.kind = MotionKind::rapid;
    klartext_.rapid = block.rapid;
    return state_.depart_by(lead, request) && leave_out_bottlenecks(false, line.source);
  }
  // LCT has its feed all the way, the others from where the lead begins on (D-86).
  const bool has_own_feed = block.feed && block.lead.form == Lead::Form::arc_and_line;
  MoveRequest way = request;
  if (!has_own_feed) {
    way.kind = klartext_.rapid ? MotionKind::rapid : MotionKind::linear;
    way.feed = klartext_.feed_before;
  }
  klartext_.rapid = false;
  return select_in_klartext(line, *block.side, block.side_begin) &&
         state_.approach_by(lead, request, way);
}

}  // namespace trc
