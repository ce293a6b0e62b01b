#include "core/nc/dialect/klartext_arcs.h"

#include <cmath>

#include "core/nc/dialect/heidenhain.h"
#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/klartext_motion.h"
#include "core/nc/dialect/klartext_polar.h"
#include "core/nc/dialect/reading.h"

// Arcs of Klartext: C, CR, CP and CT.

namespace trc {
namespace {

// CP: IPA may be several turns, each one a block.
bool move_in_turns(Reading& reading, ProgramLine& line, KlartextBlock& block,
                   MoveRequest& request) {
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  const auto wrong = [&](const char* why) {
    return refuse_klartext(reading, line, block.begin, block.title() + why,
                           Code::circle_incomplete);
  };
  if (!block.polar_angle) return wrong(" without PA");
  if (block.polar_radius) return wrong(" with PR");
  const double turns = std::abs(block.polar_angle->value) / 360;
  if (!block.polar_angle->increment || turns <= 1) {
    const bool clockwise = block.polar_angle->value < 0;
    if (block.polar_angle->increment &&
        (block.polar_angle->value == 0 || clockwise != *block.clockwise))
      return wrong(" with IPA against DR");
    return move_in_klartext(reading, line, request);
  }
  constexpr double most_turns = 1000;
  if ((block.polar_angle->value < 0) != *block.clockwise) return wrong(" with IPA against DR");
  if (turns > most_turns) return wrong(" with more than 1000 turns");
  const Position start = reading.state.position();
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
    if (!move_in_klartext(reading, line, part)) return false;
  }
  return true;
}

}  // namespace

bool move_on_klartext_arc(Reading& reading, ProgramLine& line, KlartextBlock& block,
                          MoveRequest& request) {
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  reading.motion = *block.clockwise ? MotionKind::clockwise : MotionKind::counter_clockwise;
  if (block.is(KlartextStatement::radius_arc)) {
    request.radius = block.radius->value * reading.length_unit();
    return move_in_klartext(reading, line, request);
  }
  if (!reading.klartext_modes.pole) return refuse_without_pole(reading, line, block);
  line.klartext->needs_pole = true;
  request.center[axes.first] = reading.klartext_modes.pole->x();
  request.center[axes.second] = reading.klartext_modes.pole->y();
  if (block.is(KlartextStatement::polar_circle))
    return move_in_turns(reading, line, block, request);
  return move_in_klartext(reading, line, request);
}

bool move_on_tangent_arc(Reading& reading, ProgramLine& line, KlartextBlock& block,
                         MoveRequest& request) {
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  const auto wrong = [&](const char* why) {
    return refuse_klartext(reading, line, block.begin, block.title() + why);
  };
  if (reading.klartext_modes.behind_corner) return wrong(" directly after RND or CHF");
  if (!reading.klartext_modes.tangent) return wrong(" without a motion in the plane before it");
  const Point start = to_plane(reading.state.mode().plane, reading.state.position());
  const Point end(request.end[axes.first].value_or(start.x()),
                  request.end[axes.second].value_or(start.y()));
  const Vector chord = end - start;
  line.klartext->needs_tangent = true;
  line.klartext->counts_from_start = true;
  const Vector tangent = reading.klartext_modes.tangent->normalized();
  const double across = cross(tangent, chord);
  if (std::abs(across) <= 1e-6) {
    if (chord.dot(tangent) <= 0) return wrong(" straight back");
    reading.motion = MotionKind::linear;
    return move_in_klartext(reading, line, request);
  }
  const double radius = chord.squaredNorm() / (2 * across);  // positive: counter-clockwise
  const Point center = start + radius * left_of(tangent);
  request.center[axes.first] = center.x();
  request.center[axes.second] = center.y();
  reading.motion = across > 0 ? MotionKind::counter_clockwise : MotionKind::clockwise;
  return move_in_klartext(reading, line, request);
}

}  // namespace trc
