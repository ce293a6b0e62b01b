#include "core/nc/dialect/full_turns.h"

#include <cmath>
#include <string>

#include "core/geometry/segment.h"
#include "core/geometry/turn.h"
#include "core/nc/dialect/apply_block.h"
#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

// A helix of several turns in one line: TURN= of Sinumerik, P of LinuxCNC.

namespace trc {
namespace {

constexpr double most_turns = 1000;

// The sweep between two radius vectors; more than 0, at most a full turn.
double sweep_between(const Vector& from, const Vector& to, bool clockwise) {
  const double turn = std::atan2(cross(from, to), from.dot(to));
  const double sweep = clockwise ? -turn : turn;
  constexpr double none = 1e-9;
  return sweep > none ? sweep : sweep + full_turn;
}

}  // namespace

bool move_in_full_turns(Reading& reading, ProgramLine& line, const BlockWords& block) {
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  const MoveRequest& arc = block.move;
  const auto wrong = [&](Code code, const char* why) {
    return reading.refuse(line,
                          TextFault{.code = code, .begin = block.arc.turns->begin, .detail = why});
  };
  const double turns = block.arc.turns->value;
  if (!is_whole(turns) || turns < 0 || turns > most_turns)
    return wrong(Code::nc_number, "turns, at most 1000");
  MoveRequest rest = arc;
  if (turns == 0) return move(reading, line, rest);
  const bool clockwise = reading.motion == MotionKind::clockwise;
  if (arc.radius) return wrong(Code::nc_unsupported, "turns beside a radius");
  if (!(arc.center[axes.first] || arc.center[axes.second]) || !arc.tracking.empty())
    return wrong(Code::circle_incomplete, "turns without I J K alone");
  const bool known = reading.state.is_known(axes.first) && reading.state.is_known(axes.second) &&
                     (reading.state.is_known(axes.third) || !arc.end[axes.third]);
  if (!known) return wrong(Code::position_unknown, "turns from a place that is not known");

  const auto at = [&](std::size_t axis) {
    return reading.state.position()[axis] / reading.length_unit();
  };
  const auto end_of_axis = [&](std::size_t axis) {
    if (!arc.end[axis]) return at(axis);
    return *arc.end[axis] + (reading.incremental ? at(axis) : 0);
  };
  const Point start(at(axes.first), at(axes.second));
  const bool is_absolute = reading.state.absolute_center();
  const Vector words(arc.center[axes.first].value_or(is_absolute ? start.x() : 0),
                     arc.center[axes.second].value_or(is_absolute ? start.y() : 0));
  const Point center = is_absolute ? Point(words) : Point(start + words);
  const double begin = at(axes.third);
  const double rise = end_of_axis(axes.third) - begin;
  const Point end(end_of_axis(axes.first), end_of_axis(axes.second));
  const double last = sweep_between(start - center, end - center, clockwise);
  const double a_turn = rise * full_turn / (turns * full_turn + last);
  for (int turn = 1; turn <= static_cast<int>(turns); ++turn) {
    MoveRequest part;
    part.center = arc.center;
    if (arc.end[axes.third])
      part.end[axes.third] = reading.incremental ? a_turn : begin + turn * a_turn;
    if (!move(reading, line, part)) return false;
  }
  if (arc.end[axes.third] && reading.incremental) rest.end[axes.third] = rise - turns * a_turn;
  return move(reading, line, rest);
}

}  // namespace trc
