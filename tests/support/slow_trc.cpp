#include "tests/support/slow_trc.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace trc::support {
namespace {

using Real = long double;
constexpr Real pi = std::numbers::pi_v<long double>;

// A smaller turn is no corner, one so near to pi is a reversal.
constexpr Real no_turn = 1e-7L;
// Remaining lengths and radius differences below this leave the decision open, mm.
constexpr Real open_length = 2e-4L;

SlowPoint operator+(SlowPoint a, SlowPoint b) { return {a.x + b.x, a.y + b.y}; }
SlowPoint operator-(SlowPoint a, SlowPoint b) { return {a.x - b.x, a.y - b.y}; }
SlowPoint operator*(Real f, SlowPoint v) { return {f * v.x, f * v.y}; }
Real dot(SlowPoint a, SlowPoint b) { return a.x * b.x + a.y * b.y; }
Real cross_of(SlowPoint a, SlowPoint b) { return a.x * b.y - a.y * b.x; }
Real length(SlowPoint v) { return std::sqrt(dot(v, v)); }
SlowPoint unit(SlowPoint v) { return (1 / length(v)) * v; }
SlowPoint left(SlowPoint v) { return {-v.y, v.x}; }
SlowPoint rotated(SlowPoint v, Real angle) {
  return {v.x * std::cos(angle) - v.y * std::sin(angle),
          v.x * std::sin(angle) + v.y * std::cos(angle)};
}
SlowPoint wide(const Point& p) { return {p.x(), p.y()}; }

// `angle` brought into one turn that begins a little below zero: where two
// equidistants touch, rounding may put the joint just behind the corner.
Real positive_angle(Real angle) {
  angle = std::fmod(angle, 2 * pi);
  return angle < -1e-4L ? angle + 2 * pi : angle;
}

// One programmed block with what the rules need of it.
struct Shape {
  bool is_arc = false;
  SlowPoint start{};
  SlowPoint end{};
  SlowPoint center{};
  Real radius = 0;
  Real sweep = 0;
  SlowPoint start_tangent{};
  SlowPoint end_tangent{};
  Real extent = 0;  // length of a line in mm, |sweep| of an arc in rad
};

Shape shape_of(const Segment& segment) {
  Shape shape;
  if (const auto* line = std::get_if<Line>(&segment)) {
    shape.start = wide(line->start);
    shape.end = wide(line->end);
    shape.extent = length(shape.end - shape.start);
    shape.start_tangent = shape.end_tangent = unit(shape.end - shape.start);
    return shape;
  }
  const auto& arc = std::get<Arc>(segment);
  shape.is_arc = true;
  shape.start = wide(arc.start);
  shape.end = wide(arc.end);
  shape.center = wide(arc.center);
  shape.sweep = arc.sweep;
  shape.extent = std::abs(shape.sweep);
  shape.radius = length(shape.start - shape.center);
  const Real sense = arc.sweep > 0 ? 1 : -1;
  shape.start_tangent = sense * left(unit(shape.start - shape.center));
  shape.end_tangent = sense * left(unit(shape.end - shape.center));
  return shape;
}

// How the equidistants of two neighbours are joined.
struct Join {
  SlowPoint before_end{};
  SlowPoint after_start{};
  std::vector<SlowBlock> inserted{};
  // What the neighbours lose at this corner, as `Shape::extent`; negative: gain.
  Real before_trim = 0;
  Real after_trim = 0;
  bool missed = false;  // the equidistants do not meet
};

class SlowCompensation {
 public:
  SlowCompensation(const Contour& contour, const TrcMode& mode)
      : mode_(mode),
        side_(mode.side == Side::left ? 1 : -1),
        radius_(mode.tool_radius),
        stretch_(mode.options.stretch_factor),
        approach_(shape_of(contour.approach)),
        retract_(shape_of(contour.retract)) {
    for (const Segment& block : contour.blocks) blocks_.push_back(shape_of(block));
  }

  SlowOutcome run();

 private:
  [[nodiscard]] SlowPoint to_tool(SlowPoint tangent) const {
    return radius_ * side_ * left(tangent);
  }
  [[nodiscard]] bool tool_inside(const Shape& arc) const { return arc.sweep * side_ > 0; }
  [[nodiscard]] Real tool_radius_of(const Shape& arc) const {
    return tool_inside(arc) ? arc.radius - radius_ : arc.radius + radius_;
  }
  // The point `s` past the start of the equidistant, as `Shape::extent`.
  [[nodiscard]] SlowPoint along(const Shape& shape, Real s) const {
    if (!shape.is_arc) return shape.start + to_tool(shape.start_tangent) + s * shape.start_tangent;
    const Real sense = shape.sweep > 0 ? 1 : -1;
    const SlowPoint spoke = unit(shape.start - shape.center);
    return shape.center + tool_radius_of(shape) * rotated(spoke, sense * s);
  }
  // How far a point lies outside the strip between the block's line or circle
  // and its equidistant; negative: inside, that is, nearer than the radius.
  [[nodiscard]] Real beyond(const Shape& shape, SlowPoint point) const {
    if (!shape.is_arc) return side_ * cross_of(shape.end_tangent, point - shape.end) - radius_;
    const Real distance = length(point - shape.center);
    return tool_inside(shape) ? tool_radius_of(shape) - distance : distance - tool_radius_of(shape);
  }

  [[nodiscard]] std::optional<Real> leave(const Shape& before, const Shape& after);
  Join join(const Shape& before, const Shape& after);
  Join inside_join(const Shape& before, const Shape& after);
  void add_line(SlowPoint start, SlowPoint end, Origin origin, std::size_t ordinal) {
    outcome_.path.push_back({.start = start, .end = end, .origin = origin, .ordinal = ordinal});
  }
  void add_inserted(const Join& join, Origin origin, std::size_t ordinal) {
    for (SlowBlock block : join.inserted) {
      block.origin = origin;
      block.ordinal = ordinal;
      outcome_.path.push_back(block);
    }
  }
  void find_swallowed_arcs();
  void judge(std::size_t index, Real start_trim, Real end_trim);
  [[nodiscard]] Code code_of(const Shape& shape) const {
    return shape.is_arc ? Code::arc_wrapped : Code::line_reversed;
  }
  // Of two blocks that reverse: whether the way back lies on the tool side of the
  // way there, judged by two points a little before and after the corner.
  [[nodiscard]] bool encloses_tool(const Shape& before, const Shape& after) const;
  // The transition angle in rad; 2 pi at a reversal (D-05) that does not enclose
  // the tool, pi where nothing turns.
  [[nodiscard]] Real angle_between(const Shape& before, const Shape& after) const;
  // Whether the two go back on each other and part, or cross once more, by less than twice the
  // input resolution: whether that is a slit or a tip, rounding decides (D-44).
  [[nodiscard]] bool ties_back(const Shape& before, const Shape& after) const;

  TrcMode mode_;
  Real side_;
  Real radius_;
  Real stretch_;
  Shape approach_;
  Shape retract_;
  std::vector<Shape> blocks_{};
  SlowOutcome outcome_{};
};

bool SlowCompensation::encloses_tool(const Shape& before, const Shape& after) const {
  const auto length_of = [](const Shape& shape) {
    return shape.is_arc ? shape.extent * shape.radius : shape.extent;
  };
  Real step = std::min(length_of(before), length_of(after));
  if (before.is_arc) step = std::min(step, before.radius);
  if (after.is_arc) step = std::min(step, after.radius);
  // A point of the block itself, `step` from its start (forwards) or end.
  const auto programmed = [&](const Shape& shape, bool from_start) {
    const SlowPoint corner = from_start ? shape.start : shape.end;
    const Real along = from_start ? step : -step;
    if (!shape.is_arc) return corner + along * shape.start_tangent;
    const Real angle = (shape.sweep > 0 ? along : -along) / shape.radius;
    return shape.center + rotated(corner - shape.center, angle);
  };
  const SlowPoint apart = programmed(after, true) - programmed(before, false);
  return dot(apart, to_tool(before.end_tangent)) > radius_ * 1e-3L;
}

Real SlowCompensation::angle_between(const Shape& before, const Shape& after) const {
  const Real turn = std::atan2(cross_of(before.end_tangent, after.start_tangent),
                               dot(before.end_tangent, after.start_tangent));
  if (std::abs(turn) < no_turn) return pi;
  if (pi - std::abs(turn) < no_turn) return encloses_tool(before, after) ? 0 : 2 * pi;
  return pi - side_ * turn;
}

bool SlowCompensation::ties_back(const Shape& before, const Shape& after) const {
  constexpr Real doubtful = 2e-3L;
  const Real turn = std::atan2(cross_of(before.end_tangent, after.start_tangent),
                               dot(before.end_tangent, after.start_tangent));
  const Real opening = std::copysign(pi - std::abs(turn), turn);
  if (std::abs(opening) > 0.1L) return false;
  Real bend = 0;
  Real reach = std::numeric_limits<Real>::infinity();
  for (const Shape* shape : {&before, &after}) {
    const Real size = shape->is_arc ? shape->radius * std::min(shape->extent, 1.0L) : shape->extent;
    reach = std::min(reach, size);
    if (shape->is_arc) bend -= (shape->sweep > 0 ? 1 : -1) / shape->radius;
  }
  if (bend == 0 && std::abs(opening) < no_turn) return false;  // a tip (D-05)
  const auto gap_at = [&](Real way) { return way * (opening + bend * way / 2); };
  const bool crosses_again = opening * bend < 0 && std::abs(opening) < std::abs(bend) * reach;
  return std::abs(gap_at(reach)) < doubtful ||
         (crosses_again && std::abs(gap_at(-opening / bend)) < doubtful);
}

// The first place where `value` is no longer negative, between `inside`, where it
// is, and `outside`, where it is not.
template <class Function>
Real bisect(const Function& value, Real inside, Real outside) {
  for (int k = 0; k < 80; ++k) {
    const Real middle = (inside + outside) / 2;
    (value(middle) < 0 ? inside : outside) = middle;
  }
  return outside;
}

// Where `value`, which has one summit between `low` and `high`, is largest.
template <class Function>
Real summit(const Function& value, Real low, Real high) {
  for (int k = 0; k < 120; ++k) {
    const Real third = (high - low) / 3;
    if (value(low + third) < value(high - third))
      low += third;
    else
      high -= third;
  }
  return (low + high) / 2;
}

// Walks along the equidistant of `after`, also past its end, until it leaves the
// strip of `before`; the walk stops after one turn of an arc, and where no
// stretched transition could bring a line back.
std::optional<Real> SlowCompensation::leave(const Shape& before, const Shape& after) {
  const Real last = after.is_arc ? 2 * pi : 2 * (after.extent + 10 * radius_) + 1;
  const auto value = [&](Real s) { return beyond(before, along(after, s)); };
  std::vector<Real> stations{0};
  if (before.is_arc || after.is_arc) {
    constexpr int steps = 1500;
    for (int k = 1; k < steps; ++k) stations.push_back(last * k / steps);
    // Next to the corner the strip can be left and entered again in an instant.
    for (Real s = last; s > 1e-11L * last; s *= 0.97L) stations.push_back(s);
    std::sort(stations.begin(), stations.end());
  }
  stations.push_back(last);
  std::vector<Real> values;
  for (const Real station : stations) values.push_back(value(station));
  Real nearest = values.back();
  for (std::size_t k = 1; k < stations.size(); ++k) {
    if (values[k] >= 0) return bisect(value, stations[k - 1], stations[k]);
    // Between two stations the strip may be left and entered again.
    if (k + 1 == stations.size() || values[k] < values[k - 1] || values[k] < values[k + 1])
      continue;
    const Real top = summit(value, stations[k - 1], stations[k + 1]);
    nearest = std::max(nearest, value(top));
    if (value(top) >= 0) return bisect(value, stations[k - 1], top);
  }
  if (nearest > -open_length) outcome_.borderline = true;
  return std::nullopt;
}

Join SlowCompensation::inside_join(const Shape& before, const Shape& after) {
  Join result;
  const std::optional<Real> station = leave(before, after);
  if (!station) {
    result.missed = true;
    return result;
  }
  const SlowPoint joint = along(after, *station);
  result.before_end = result.after_start = joint;
  result.after_trim = *station;
  if (before.is_arc) {
    const SlowPoint from = joint - before.center;
    const SlowPoint to = before.end - before.center;
    const Real sense = before.sweep > 0 ? 1 : -1;
    result.before_trim = positive_angle(sense * std::atan2(cross_of(from, to), dot(from, to)));
  } else {
    result.before_trim = dot(before.end - joint, before.end_tangent);
  }
  return result;
}

Join SlowCompensation::join(const Shape& before, const Shape& after) {
  const Real beta = angle_between(before, after);
  if (ties_back(before, after)) outcome_.borderline = true;
  const SlowPoint corner = before.end;
  const SlowPoint q = corner + to_tool(before.end_tangent);
  const SlowPoint p = corner + to_tool(after.start_tangent);
  if (beta == pi) return {.before_end = q, .after_start = q};
  if (beta < pi) return inside_join(before, after);

  Join result{.before_end = q, .after_start = p};
  if (mode_.transition == Transition::circular) {
    result.inserted.push_back(
        {.is_arc = true, .start = q, .end = p, .center = corner, .sweep = -side_ * (beta - pi)});
    return result;
  }
  const Real longest = stretch_ * radius_;
  const Real extension = beta < 2 * pi ? radius_ * std::tan((beta - pi) / 2) : 2 * longest + 1;
  const bool pointed = extension <= longest;
  const Real gain = pointed ? extension : longest;
  const SlowPoint a = q + gain * before.end_tangent;
  const SlowPoint b = pointed ? a : p - gain * after.start_tangent;
  if (before.is_arc) {
    result.inserted.push_back({.start = q, .end = a});
  } else {
    result.before_end = a;
    result.before_trim = -gain;
  }
  if (!pointed) result.inserted.push_back({.start = a, .end = b});
  if (after.is_arc) {
    result.inserted.push_back({.start = b, .end = p});
  } else {
    result.after_start = b;
    result.after_trim = -gain;
  }
  return result;
}

void SlowCompensation::find_swallowed_arcs() {
  for (std::size_t index = 0; index < blocks_.size(); ++index) {
    const Shape& block = blocks_[index];
    if (!block.is_arc || !tool_inside(block)) continue;
    if (std::abs(block.radius - radius_) < open_length) outcome_.borderline = true;
    if (block.radius <= radius_)
      outcome_.faults.push_back({Code::tool_not_smaller_than_arc, index + 1});
  }
}

void SlowCompensation::judge(std::size_t index, Real start_trim, Real end_trim) {
  const Shape& block = blocks_[index];
  const Real rest = block.extent - start_trim - end_trim;
  const Real rest_length = block.is_arc ? rest * tool_radius_of(block) : rest;
  if (std::abs(rest_length) < open_length && (start_trim != 0 || end_trim != 0))
    outcome_.borderline = true;
  if (rest < 0) outcome_.faults.push_back({code_of(block), index + 1});
}

SlowOutcome SlowCompensation::run() {
  if (radius_ > 0) find_swallowed_arcs();
  // Geometry up to the first arc that cannot hold the tool.
  const std::size_t count =
      outcome_.faults.empty() ? blocks_.size() : outcome_.faults.front().ordinal - 1;
  if (count == 0) return outcome_;

  const Shape& first = blocks_.front();
  SlowPoint start = first.start + to_tool(first.start_tangent);
  Real start_trim = 0;
  if (mode_.selection == Selection::indirect && angle_between(approach_, first) > pi) {
    const Join entry = join(approach_, first);
    add_line(approach_.start, entry.before_end, Origin::approach, 0);
    add_inserted(entry, Origin::approach, 0);
    start = entry.after_start;
    start_trim = entry.after_trim;
  } else {
    add_line(approach_.start, start, Origin::approach, 0);
  }

  for (std::size_t index = 0; index < count; ++index) {
    const Shape& block = blocks_[index];
    const bool last = index + 1 == blocks_.size();
    Join exit{.before_end = block.end + to_tool(block.end_tangent)};
    Origin origin = Origin::transition;
    if (!last) {
      if (index + 1 == count) return outcome_;
      exit = join(block, blocks_[index + 1]);
    } else if (mode_.selection == Selection::indirect && angle_between(block, retract_) > pi) {
      exit = join(block, retract_);
      origin = Origin::retract;
    } else {
      exit.after_start = exit.before_end;
    }
    if (exit.missed) {
      outcome_.faults.push_back({code_of(block), index + 1});
      outcome_.faults.push_back({code_of(blocks_[index + 1]), index + 2});
      return outcome_;
    }
    judge(index, start_trim, exit.before_trim);
    if (!outcome_.faults.empty() && outcome_.faults.back().ordinal == index + 1) return outcome_;
    outcome_.path.push_back(
        {.is_arc = block.is_arc,
         .start = start,
         .end = exit.before_end,
         .center = block.center,
         .sweep = (block.sweep > 0 ? 1 : -1) * (block.extent - start_trim - exit.before_trim),
         .origin = Origin::programmed,
         .ordinal = index + 1});
    add_inserted(exit, origin, index + 1);
    start = exit.after_start;
    start_trim = exit.after_trim;
  }
  const bool without_block = mode_.selection == Selection::without_block;
  add_line(start, retract_.end, without_block ? Origin::uncompensated : Origin::retract,
           blocks_.size() + 1);
  return outcome_;
}

}  // namespace

SlowOutcome slow_trc(const Contour& contour, const TrcMode& mode) {
  return SlowCompensation(contour, mode).run();
}

}  // namespace trc::support
