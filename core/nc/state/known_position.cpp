#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "core/messages/diagnostic_text.h"
#include "core/nc/state/program_state.h"

// Where the tool stands as far as it is known, and the motions that depend on it.

namespace trc {

void ProgramState::forget_position(const std::array<bool, 3>& axes, const Source& source,
                                   Unknown why) {
  for (std::size_t axis = 0; axis < known_.size(); ++axis)
    if (axes[axis]) forget_axis(axis, source, why);
  forget_what_stands_beside(source);
}

void ProgramState::forget_axis(std::size_t axis, const Source& source, Unknown why) {
  known_[axis] = false;
  position_forgotten_[axis] = source;
  why_unknown_[axis] = why;
}

void ProgramState::forget_lengths(const Source& source) {
  std::array<bool, 3> axes{};
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
    axes[axis] = programmed_[axis] && target_[axis] != 0;
  if (axes != std::array<bool, 3>{}) forget_position(axes, source);
}

void ProgramState::forget_what_stands_beside(const Source& source) {
  if (!retract_is_lost()) return;
  const PlaneAxes axes = axes_of(mode_.plane);
  forget_axis(axes.first, source, Unknown::coordinates_changed);
  forget_axis(axes.second, source, Unknown::coordinates_changed);
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
      programmed_[axis] = true;
      target_[axis] = *place[axis];
    } else {
      unknown[axis] = true;
    }
  }
  if (unknown != std::array<bool, 3>{}) forget_position(unknown, source);
}

std::optional<Refusal> ProgramState::unknown_start(const MoveRequest& request) const {
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
      return Refusal{
          .code = Code::position_unknown,
          .detail = std::string(axis_words[axis]) +
                    (why_unknown_[axis] == Unknown::without_value ? ", unknown since the variable "
                                                                  : ", unknown since the change ") +
                    place_of(position_forgotten_[axis]) +
                    (counts_from_start ? told_increments() : "")};
  }
  return {};
}

std::optional<std::size_t> ProgramState::axis_of_unknown_start() const {
  const PlaneAxes axes = axes_of(mode_.plane);
  for (const std::size_t axis : {axes.first, axes.second})
    if (!known_[axis]) return axis;
  return {};
}

// The tangential approach and that of the other modes depend on where the tool comes from.
bool ProgramState::approaches_from_anywhere(const MoveRequest& request) const {
  const PlaneAxes axes = axes_of(mode_.plane);
  const bool is_direct =
      mode_.selection == Selection::direct || mode_.selection == Selection::without_block;
  return awaits_approach() && !lead_ && is_direct && !mode_.tangential &&
         mode_.options.split.where == SplitOption::Where::off && !is_circle(request.kind) &&
         !request.incremental && request.end[axes.first] && request.end[axes.second];
}

std::optional<std::size_t> ProgramState::axis_of_assumed_start(const MoveRequest& request) const {
  if (!setup_.start_is_assumed || !awaits_approach()) return {};
  const PlaneAxes axes = axes_of(mode_.plane);
  for (const std::size_t axis : {axes.first, axes.second})
    if (request.end[axis] && !programmed_[axis]) return axis;
  return {};
}

std::optional<std::size_t> ProgramState::axis_kept_from_assumed_start(
    const MoveRequest& request) const {
  if (!setup_.start_is_assumed || setup_.dialect == DialectName::isg || !awaits_approach() ||
      request.incremental)
    return {};
  const PlaneAxes axes = axes_of(mode_.plane);
  for (const std::size_t axis : {axes.first, axes.second})
    if (!request.end[axis] && !programmed_[axis]) return axis;
  return {};
}

bool ProgramState::refuse_assumed_start(const Source& source, std::size_t axis) {
  return refuse(source, {.code = Code::position_unknown,
                         .detail = std::string(axis_words[axis]) +
                                   ", where the tool stands before the contour"});
}

// A forgotten G91 is the most common mistake after G28 G91.
std::string ProgramState::told_increments() const {
  if (increments_since_.line == 0) return {};
  constexpr std::size_t in = std::string_view("in ").size();
  return ", counted from there, as G91 holds since " + place_of(increments_since_).substr(in);
}

}  // namespace trc
