#include "core/trc/walls/entry_turns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <variant>

#include "core/geometry/distance.h"
#include "core/trc/walls/outline.h"
#include "core/trc/walls/scratch.h"

namespace trc {
namespace {

constexpr double turn = 2 * std::numbers::pi;

// The largest turn of a chord of a circle: with fewer than eight chords a turn it is a polygon.
constexpr double longest_chord = turn / 8 + 0.01;

struct Circle {
  Point center = Point::Zero();
  double radius = 0;
};

Segment backwards(const Segment& segment) {
  if (const auto* arc = std::get_if<Arc>(&segment))
    return Arc{.start = arc->end, .end = arc->start, .center = arc->center, .sweep = -arc->sweep};
  return Line{.start = end_of(segment), .end = start_of(segment)};
}

enum class ContourEnd : std::uint8_t { begin, end };

// The blocks of a contour from one of its ends on, each directed away from that end.
class FromEnd {
 public:
  FromEnd(const ContourView& contour, ContourEnd end)
      : contour_(contour),
        is_end_(end == ContourEnd::end),
        left_((contour.tool_side == Side::left) != is_end_) {}

  [[nodiscard]] std::size_t count() const { return contour_.count; }
  [[nodiscard]] Segment block(std::size_t index) const {
    contour_.pass();
    const std::size_t last = contour_.count - 1;
    return is_end_ ? backwards(contour_.segment(last - index)) : contour_.segment(index);
  }
  // rad; positive for a turn to the side of the tool.
  [[nodiscard]] double to_tool(double left_turn) const { return left_ ? left_turn : -left_turn; }
  // The angle by which the block, an arc or a chord, goes round the circle with the tool inside.
  // Empty if the block is not on the circle.
  [[nodiscard]] std::optional<double> turn_on(const Circle& circle, const Segment& block,
                                              double tolerance) const {
    const Vector from = start_of(block) - circle.center;
    const Vector to = end_of(block) - circle.center;
    const auto* arc = std::get_if<Arc>(&block);
    const bool is_on = arc != nullptr ? (arc->center - circle.center).norm() <= tolerance &&
                                            std::abs(radius_of(*arc) - circle.radius) <= tolerance
                                      : std::abs(from.norm() - circle.radius) <= tolerance &&
                                            std::abs(to.norm() - circle.radius) <= tolerance;
    const double angle =
        to_tool(arc != nullptr ? arc->sweep : std::atan2(cross(from, to), from.dot(to)));
    if (!is_on || angle <= 0 || (arc == nullptr && angle > longest_chord)) return std::nullopt;
    return angle;
  }
  // The circle of the first block: of an arc, or of a chord if others go on round the tool.
  [[nodiscard]] std::optional<Circle> first_circle() const {
    const Segment first = block(0);
    if (const auto* arc = std::get_if<Arc>(&first)) return Circle{arc->center, radius_of(*arc)};
    return circle_of_chords();
  }

 private:
  // Through the points where the chords begin, and have turned by one and two thirds of a turn.
  [[nodiscard]] std::optional<Circle> circle_of_chords() const {
    std::array<Point, 3> on{start_of(block(0))};
    std::size_t found = 1;
    double turned = 0;
    Vector before = tangent_at_start(block(0));
    for (std::size_t index = 1; index < count() && found < on.size(); ++index) {
      const Segment next = block(index);
      const Vector along = tangent_at_start(next);
      const double angle = to_tool(std::atan2(cross(before, along), before.dot(along)));
      if (is_arc(next) || angle <= 0 || angle > longest_chord) return std::nullopt;
      turned += angle;
      before = along;
      if (turned >= static_cast<double>(found) * turn / 3) on[found++] = start_of(next);
    }
    if (found < on.size()) return std::nullopt;
    const Vector one = on[1] - on[0];
    const Vector other = on[2] - on[0];
    const double doubled = 2 * cross(one, other);
    if (doubled == 0) return std::nullopt;
    const Vector squared(one.squaredNorm(), other.squaredNorm());
    const Vector to_center((other.y() * squared.x() - one.y() * squared.y()) / doubled,
                           (one.x() * squared.y() - other.x() * squared.x()) / doubled);
    return Circle{on[0] + to_center, to_center.norm()};
  }

  const ContourView& contour_;
  bool is_end_;
  bool left_;
};

// Whole turns on one circle from an end of the contour on, and the number of their blocks.
struct Turns {
  Circle circle{};
  std::size_t blocks = 0;
};

Turns whole_turns(const FromEnd& ends, double tolerance) {
  const auto circle = ends.first_circle();
  if (!circle) return {};
  double turned = 0;
  for (std::size_t index = 0; index < ends.count(); ++index) {
    const auto angle = ends.turn_on(*circle, ends.block(index), tolerance);
    if (!angle) break;
    turned += *angle;
  }
  constexpr double rounding = 0.01;  // rad
  double left = turn * std::floor((turned + rounding) / turn);
  Turns turns{.circle = *circle};
  for (; left > rounding; ++turns.blocks)
    left -= ends.turn_on(*circle, ends.block(turns.blocks), tolerance).value_or(left);
  return turns;
}

// Whether the circle comes so near to the closed contour that the tool cannot pass between.
bool is_beside(const ContourView& contour, const Circle& turns, const Closing& closing,
               double tool_radius) {
  for (std::size_t number = closing.first.number; number <= closing.second.number; ++number) {
    contour.pass();
    if (std::abs(distance(turns.center, contour.segment(number)) - turns.radius) < 2 * tool_radius)
      return true;
  }
  return false;
}

// A bore may be roughed in turns that leave less than the tool radius to its finishing lap: then
// most of the closed contour goes round with the turns.
bool are_roughing(const ContourView& contour, const Circle& turns, const Closing& closing,
                  double tolerance, double tool_radius) {
  const FromEnd blocks(contour, ContourEnd::begin);
  double length = 0;
  double of_bore = 0;
  for (std::size_t number = closing.first.number; number <= closing.second.number; ++number) {
    const Segment block = blocks.block(number);
    const double radius = (start_of(block) - turns.center).norm();
    const double begin = number == closing.first.number ? closing.first.along : 0;
    const double end = number == closing.second.number ? closing.second.along : length_of(block);
    length += end - begin;
    if (std::abs(radius - turns.radius) < tool_radius &&
        blocks.turn_on({turns.center, radius}, block, tolerance))
      of_bore += end - begin;
  }
  return 2 * of_bore > length;
}

}  // namespace

std::optional<BetweenTurns> between_turns(const ContourView& contour, double tolerance) {
  if (contour.tool_side == Side::off || contour.count == 0) return std::nullopt;
  const Turns in = whole_turns(FromEnd(contour, ContourEnd::begin), tolerance);
  const Turns out = whole_turns(FromEnd(contour, ContourEnd::end), tolerance);
  const std::size_t blocks = in.blocks + out.blocks;
  if (blocks == 0 || blocks >= contour.count) return std::nullopt;
  return BetweenTurns{.first = in.blocks, .end = contour.count - out.blocks};
}

bool are_leads(const ContourView& contour, const BetweenTurns& between, const Closing& closing,
               double tolerance, double tool_radius) {
  Scratch scratch;
  Outline ring(scratch.memory());
  ring.append(contour, closing.first, closing.second);
  const bool tool_is_inside = (ring.area() > 0) == (contour.tool_side == Side::left);
  const auto is_lead = [&](ContourEnd end) {
    const auto turns = FromEnd(contour, end).first_circle();
    if (are_roughing(contour, *turns, closing, tolerance, tool_radius)) return false;
    const double of_path = std::max(turns->radius - tool_radius, 0.0);
    constexpr int probes = 8;
    for (int probe = 0; probe < probes; ++probe) {
      const double angle = turn * probe / probes;
      const Point point = turns->center + of_path * Vector(std::cos(angle), std::sin(angle));
      if (!ring.has_on(contour.tool_side, point)) return false;
    }
    return tool_is_inside || is_beside(contour, *turns, closing, tool_radius);
  };
  return (between.first == 0 || is_lead(ContourEnd::begin)) &&
         (between.end == contour.count || is_lead(ContourEnd::end));
}

}  // namespace trc
