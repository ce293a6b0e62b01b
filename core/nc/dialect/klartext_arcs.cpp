#include <cmath>

#include "core/nc/dialect/klartext_block.h"

// Arcs of Klartext: C, CR, CP and CT.

namespace trc {

bool Interpreter::move_on_klartext_arc(ProgramLine& line, KlartextBlock& block,
                                       MoveRequest& request) {
  const PlaneAxes axes = axes_of(state_.mode().plane);
  motion_ = *block.clockwise ? MotionKind::clockwise : MotionKind::counter_clockwise;
  if (block.is(KlartextStatement::radius_arc)) {
    request.radius = block.radius->value * length_unit();
    return move_in_klartext(line, request);
  }
  if (!klartext_.pole)
    return refuse_klartext(line, block.begin,
                           block.title() + " without CC, or behind what moves it");
  line.klartext->needs_pole = true;
  request.center[axes.first] = klartext_.pole->x();
  request.center[axes.second] = klartext_.pole->y();
  if (block.is(KlartextStatement::polar_circle)) return move_in_turns(line, block, request);
  return move_in_klartext(line, request);
}

// CP: IPA may be several turns, each a block.
bool Interpreter::move_in_turns(ProgramLine& line, KlartextBlock& block, MoveRequest& request) {
  const PlaneAxes axes = axes_of(state_.mode().plane);
  const auto wrong = [&](const char* why) {
    return refuse_klartext(line, block.begin, block.title() + why, Code::circle_incomplete);
  };
  if (!block.polar_angle) return wrong(" without PA");
  if (block.polar_radius) return wrong(" with PR");
  const double turns = std::abs(block.polar_angle->value) / 360;
  if (!block.polar_angle->increment || turns <= 1) {
    const bool clockwise = block.polar_angle->value < 0;
    if (block.polar_angle->increment &&
        (block.polar_angle->value == 0 || clockwise != *block.clockwise))
      return wrong(" with IPA against DR");
    return move_in_klartext(line, request);
  }
  constexpr double most_turns = 1000;
  if ((block.polar_angle->value < 0) != *block.clockwise) return wrong(" with IPA against DR");
  if (turns > most_turns) return wrong(" with more than 1000 turns");
  const Position start = state_.position();
  const Point end(*request.end[axes.first], *request.end[axes.second]);
  const double height = request.end[axes.third].value_or(start[axes.third]);
  const auto whole = static_cast<int>(std::ceil(turns - 1e-9)) - 1;
  for (int turn = 0; turn <= whole; ++turn) {
    MoveRequest part = request;
    const double share = turn == whole ? 1 : (turn + 1) / turns;
    part.end[axes.third] = start[axes.third] + share * (height - start[axes.third]);
    if (turn < whole) {
      part.end[axes.first] = start[axes.first];
      part.end[axes.second] = start[axes.second];
    } else {
      part.end[axes.first] = end.x();
      part.end[axes.second] = end.y();
    }
    if (!move_in_klartext(line, part)) return false;
  }
  return true;
}

// CT, CTP: the arc goes on where the motion before it has led.
bool Interpreter::move_on_tangent_arc(ProgramLine& line, KlartextBlock& block,
                                      MoveRequest& request) {
  const PlaneAxes axes = axes_of(state_.mode().plane);
  const auto wrong = [&](const char* why) {
    return refuse_klartext(line, block.begin, block.title() + why);
  };
  if (!klartext_.tangent) return wrong(" without a motion in the plane before it");
  const Point start = to_plane(state_.mode().plane, state_.position());
  const Point end(request.end[axes.first].value_or(start.x()),
                  request.end[axes.second].value_or(start.y()));
  const Vector chord = end - start;
  line.klartext->needs_tangent = true;
  line.klartext->counts_from_start = true;
  const Vector tangent = klartext_.tangent->normalized();
  const double across = cross(tangent, chord);
  if (std::abs(across) <= 1e-6) {
    if (chord.dot(tangent) <= 0) return wrong(" straight back");
    motion_ = MotionKind::linear;
    return move_in_klartext(line, request);
  }
  const double radius = chord.squaredNorm() / (2 * across);  // positive: counter-clockwise
  const Point center = start + radius * left_of(tangent);
  request.center[axes.first] = center.x();
  request.center[axes.second] = center.y();
  motion_ = across > 0 ? MotionKind::counter_clockwise : MotionKind::clockwise;
  return move_in_klartext(line, request);
}

}  // namespace trc
