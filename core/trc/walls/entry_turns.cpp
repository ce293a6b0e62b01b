#include "core/trc/walls/entry_turns.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "core/geometry/distance.h"
#include "core/trc/walls/outline.h"
#include "core/trc/walls/scratch.h"

namespace trc {
namespace {

constexpr double turn = 2 * std::numbers::pi;

// An arc with the tool inside; else nothing.
std::optional<Arc> around_tool(const ContourView& contour, std::size_t number) {
  contour.pass();
  const Segment block = contour.segment(number);
  const auto* arc = std::get_if<Arc>(&block);
  if (arc == nullptr || (arc->sweep > 0) != (contour.tool_side == Side::left)) return std::nullopt;
  return *arc;
}

// How many blocks from an end of the contour on make whole turns on one circle: those that may go
// so that less than a turn is left. `at(index)`: the block so far from that end.
template <class At>
std::size_t whole_turns(const ContourView& contour, double tolerance, const At& at) {
  const auto first = around_tool(contour, at(0));
  if (!first) return 0;
  double turned = 0;
  std::size_t blocks = 0;
  for (; blocks < contour.count; ++blocks) {
    const auto arc = around_tool(contour, at(blocks));
    if (!arc || (arc->center - first->center).norm() > tolerance ||
        std::abs(radius_of(*arc) - radius_of(*first)) > tolerance)
      break;
    turned += std::abs(arc->sweep);
  }
  constexpr double rounding = 0.01;  // rad
  double left = turned;
  std::size_t whole = 0;
  while (whole < blocks && left > turn - rounding)
    left -= std::abs(around_tool(contour, at(whole++))->sweep);
  return whole;
}

// The circle of such turns comes so near to what closes there that the tool cannot pass between.
bool is_beside(const ContourView& contour, const Arc& turns, const Closing& closing,
               double tool_radius) {
  for (std::size_t number = closing.first.number; number <= closing.second.number; ++number) {
    contour.pass();
    if (std::abs(distance(turns.center, contour.segment(number)) - radius_of(turns)) <
        2 * tool_radius)
      return true;
  }
  return false;
}

// A bore may be roughed in turns that leave less than the tool takes to its finishing lap.
bool are_roughing(const ContourView& contour, const Arc& turns, const Closing& closing,
                  double tolerance, double tool_radius) {
  const auto finished = around_tool(contour, (closing.first.number + closing.second.number) / 2);
  return finished && (finished->center - turns.center).norm() <= tolerance &&
         std::abs(radius_of(*finished) - radius_of(turns)) < tool_radius;
}

}  // namespace

std::optional<BetweenTurns> between_turns(const ContourView& contour, double tolerance) {
  if (contour.tool_side == Side::off || contour.count == 0) return std::nullopt;
  const std::size_t in = whole_turns(contour, tolerance, [](std::size_t index) { return index; });
  const std::size_t out =
      whole_turns(contour, tolerance, [&](std::size_t index) { return contour.count - 1 - index; });
  if (in + out == 0 || in + out >= contour.count) return std::nullopt;
  return BetweenTurns{.first = in, .end = contour.count - out};
}

bool are_leads(const ContourView& contour, const BetweenTurns& between, const Closing& closing,
               double tolerance, double tool_radius) {
  Scratch scratch;
  Outline ring(scratch.memory());
  ring.append(contour, closing.first, closing.second);
  const bool tool_is_inside = (ring.area() > 0) == (contour.tool_side == Side::left);
  const auto lead = [&](std::size_t number) {
    const auto turns = around_tool(contour, number);
    if (are_roughing(contour, *turns, closing, tolerance, tool_radius)) return false;
    const double of_path = std::max(radius_of(*turns) - tool_radius, 0.0);
    constexpr int probes = 8;
    for (int probe = 0; probe < probes; ++probe) {
      const double angle = turn * probe / probes;
      const Point point = turns->center + of_path * Vector(std::cos(angle), std::sin(angle));
      if (!ring.has_on(contour.tool_side, point)) return false;
    }
    return tool_is_inside || is_beside(contour, *turns, closing, tool_radius);
  };
  return (between.first == 0 || lead(0)) &&
         (between.end == contour.count || lead(contour.count - 1));
}

}  // namespace trc
