#include "tests/support/small_contours.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trc::support {
namespace {

constexpr double pi = std::numbers::pi;

Vector polar(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}
Vector turned(const Vector& v, double angle) {
  return {v.x() * std::cos(angle) - v.y() * std::sin(angle),
          v.x() * std::sin(angle) + v.y() * std::cos(angle)};
}
Vector left_normal(const Vector& v) { return {-v.y(), v.x()}; }

double power_of_ten(Random& random, double low, double high) {
  return std::pow(10.0, random.between(low, high));
}

// Puts blocks one after the other and remembers where it is heading.
class Pen {
 public:
  Pen(const Point& at, const Vector& heading) : at_(at), heading_(heading) {}

  [[nodiscard]] const Point& at() const { return at_; }
  [[nodiscard]] const Vector& heading() const { return heading_; }
  [[nodiscard]] std::vector<Segment>& blocks() { return blocks_; }

  void turn(double angle) { heading_ = angle == pi ? Vector(-heading_) : turned(heading_, angle); }
  void forward(double way) { line_to(at_ + way * heading_); }
  void line_to(const Point& end) {
    blocks_.emplace_back(Line{.start = at_, .end = end});
    if (end != at_) heading_ = (end - at_).normalized();
    at_ = end;
  }
  // Tangentially on from here, to the left for a positive sweep.
  void round(double radius, double sweep) {
    const Point center = at_ + (sweep > 0 ? radius : -radius) * left_normal(heading_);
    const bool full = std::abs(sweep) >= 2 * pi;
    round_to(full ? at_ : Point(center + turned(at_ - center, sweep)), center, sweep);
  }
  void round_to(const Point& end, const Point& center, double sweep) {
    blocks_.emplace_back(Arc{.start = at_, .end = end, .center = center, .sweep = sweep});
    const Vector spoke = (end - center).normalized();
    heading_ = sweep > 0 ? left_normal(spoke) : Vector(-left_normal(spoke));
    at_ = end;
  }

 private:
  Point at_;
  Vector heading_;
  std::vector<Segment> blocks_{};
};

double any_turn(Random& random) {
  const double dice = random.between(0, 1);
  if (dice < 0.2) return 0;
  if (dice < 0.25) return pi;
  const double sign = random.chance(0.5) ? 1 : -1;
  if (dice < 0.35) return sign * power_of_ten(random, -8, -2);
  return sign * random.between(0, 3.1);
}

void any_block(Random& random, Pen& pen, double size) {
  pen.turn(any_turn(random));
  if (random.chance(0.6)) {
    pen.forward(size);
    return;
  }
  const double sign = random.chance(0.5) ? 1 : -1;
  if (random.chance(0.06)) {
    pen.round(size, sign * 2 * pi);
    return;
  }
  const double sweep = random.chance(0.3) ? power_of_ten(random, -3, 0) : random.between(0.1, 5.5);
  pen.round(std::max(size, 1e-5 / sweep) / std::max(1.0, sweep), sign * sweep);
}

void sizes(Random& random, Pen& pen, double radius) {
  const std::size_t count = 1 + random.below(8);
  for (std::size_t k = 0; k < count; ++k)
    any_block(random, pen,
              random.chance(0.5) ? power_of_ten(random, -5, 4)
                                 : std::clamp(radius * power_of_ten(random, -2, 1), 1e-5, 1e4));
}

void bends(Random& random, Pen& pen, double radius) {
  const std::size_t count = 2 + random.below(9);
  const bool gentle = random.chance(0.5);
  for (std::size_t k = 0; k < count; ++k) {
    const double size = std::clamp(radius * random.between(0.1, 4), 1e-5, 1e4);
    if (!gentle) {
      any_block(random, pen, size);
      continue;
    }
    pen.turn(random.between(-1.3, 1.3));
    if (random.chance(0.7))
      pen.forward(size);
    else
      pen.round(size, random.between(0.1, 2) * (random.chance(0.5) ? 1 : -1));
  }
}

// Corners about a centre, joined by lines and arcs, from the middle of the first line.
void rounds(Random& random, Pen& pen, double radius) {
  const std::size_t corners = 3 + random.below(8);
  const double sense = random.chance(0.5) ? 1 : -1;
  const double size = radius * power_of_ten(random, 0, 1);
  std::vector<Point> points;
  for (std::size_t k = 0; k < corners; ++k) {
    const double angle = (static_cast<double>(k) + random.between(-0.4, 0.4)) * 2 * pi /
                         static_cast<double>(corners);
    points.push_back(pen.at() + polar(size * random.between(0.3, 1), sense * angle));
  }
  const Point middle = (points[0] + points[1]) / 2;
  pen = Pen(middle, (points[1] - points[0]).normalized());
  pen.line_to(points[1]);
  for (std::size_t k = 2; k <= corners; ++k) {
    const Point& end = points[k % corners];
    const Vector chord = end - pen.at();
    const double sweep = random.between(-1.5, 1.5);
    if (random.chance(0.6) || std::abs(sweep) < 0.05) {
      pen.line_to(end);
    } else {
      const Point center = pen.at() + chord / 2 + left_normal(chord) / (2 * std::tan(sweep / 2));
      pen.round_to(end, center, sweep);
    }
  }
  pen.line_to(middle);
}

void grid(Random& random, Pen& pen, double unit) {
  static constexpr int steps[][2] = {{1, 0},  {0, 1},  {-1, 0}, {0, -1}, {1, 1},
                                     {1, -1}, {-1, 1}, {3, 4},  {4, -3}, {-3, 4}};
  const std::size_t count = 2 + random.below(8);
  const Point origin = pen.at();
  for (std::size_t k = 0; k < count; ++k) {
    const auto& step = steps[random.below(std::size(steps))];
    const Vector way = unit * static_cast<double>(1 + random.below(5)) * Vector(step[0], step[1]);
    const double dice = random.between(0, 1);
    if (dice < 0.7) {
      pen.line_to(pen.at() + way);
    } else if (dice < 0.8) {  // half a circle
      const Point center = pen.at() + way;
      pen.round_to(center + way, center, random.chance(0.5) ? pi : -pi);
    } else if (dice < 0.97) {  // a quarter
      const double sense = random.chance(0.5) ? 1 : -1;
      const Point center = pen.at() + way;
      pen.round_to(center - sense * left_normal(way), center, sense * pi / 2);
    } else {
      pen.round_to(pen.at(), pen.at() + way, random.chance(0.5) ? 2 * pi : -2 * pi);
    }
  }
  if (random.chance(0.4) && pen.at() != origin) pen.line_to(origin);
}

// A wall with slots in it, seen from the tool side.
void slots(Random& random, Pen& pen, double radius, double inward) {
  static constexpr double more[] = {0, 0, 1e-6, -1e-6, 1e-3, -1e-3, 0.3, -0.3};
  const std::size_t count = 1 + random.below(2);
  pen.forward(radius * random.between(1.5, 4));
  for (std::size_t k = 0; k < count; ++k) {
    const double extra = more[random.below(std::size(more))];
    const double width = 2 * radius + (std::abs(extra) > 1e-5 ? extra * radius : extra);
    const double depth = radius * static_cast<double>(1 + random.below(4));
    pen.turn(-inward * pi / 2);
    pen.forward(depth);
    if (random.chance(0.4)) {
      pen.round(width / 2, inward * pi);
    } else {
      pen.turn(inward * pi / 2);
      pen.forward(width);
      pen.turn(inward * pi / 2);
    }
    pen.forward(depth);
    pen.turn(-inward * pi / 2);
    pen.forward(radius * random.between(0.2, 4));
  }
}

void repeats(Random& random, Pen& pen, double radius) {
  const std::size_t count = 2 + random.below(5);
  for (std::size_t k = 0; k < count; ++k) {
    const double size = std::clamp(radius * random.between(0.2, 5), 1e-5, 1e4);
    any_block(random, pen, size);
    const Segment block = pen.blocks().back();
    const double dice = random.between(0, 1);
    if (dice < 0.25) {  // back over it
      if (const auto* arc = std::get_if<Arc>(&block))
        pen.round_to(arc->start, arc->center, -arc->sweep);
      else
        pen.line_to(std::get<Line>(block).start);
    } else if (dice < 0.4) {  // in two
      pen.forward(size / 2);
    } else if (dice < 0.55) {  // the point twice
      pen.line_to(pen.at());
    } else if (dice < 0.65) {  // round it again
      const auto* arc = std::get_if<Arc>(&block);
      if (arc != nullptr && arc->start != arc->end)
        pen.round_to(arc->start, arc->center,
                     arc->sweep > 0 ? 2 * pi - arc->sweep : -2 * pi - arc->sweep);
    }
  }
}

}  // namespace

std::string name_of(Hardship hardship) {
  switch (hardship) {
    case Hardship::sizes:
      return "Sizes";
    case Hardship::bends:
      return "Bends";
    case Hardship::rounds:
      return "Rounds";
    case Hardship::grid:
      return "Grid";
    case Hardship::slots:
      return "Slots";
    case Hardship::repeats:
      return "Repeats";
  }
  return "Unknown";
}

SmallContour small_contour(Random& random, Hardship hardship) {
  SmallContour made;
  TrcMode& mode = made.mode;
  mode.side = random.chance(0.5) ? Side::left : Side::right;
  mode.selection = mode.deselection = Selection::direct;
  mode.transition = Transition::circular;
  mode.masking = Masking::on;
  mode.options.remove_masked_blocks = true;
  mode.tool_radius = power_of_ten(random, -3, 3);
  const bool whole = hardship == Hardship::grid || random.chance(0.3);
  if (whole) mode.tool_radius = 0.5 * static_cast<double>(1 + random.below(8));

  const double radius = mode.tool_radius;
  const bool straight = whole || random.chance(0.2);
  Point origin = Point::Zero();
  if (!straight) {
    // One after the other: compilers differ in which argument comes first.
    origin.y() = random.between(-50, 50);
    origin.x() = random.between(-50, 50);
  }
  Pen pen(origin, straight ? Vector(1, 0) : polar(1, random.between(-pi, pi)));
  switch (hardship) {
    case Hardship::sizes:
      sizes(random, pen, radius);
      break;
    case Hardship::bends:
      bends(random, pen, radius);
      break;
    case Hardship::rounds:
      rounds(random, pen, radius);
      break;
    case Hardship::grid:
      grid(random, pen, 1);
      break;
    case Hardship::slots:
      slots(random, pen, radius, mode.side == Side::left ? 1 : -1);
      break;
    case Hardship::repeats:
      repeats(random, pen, radius);
      break;
  }
  made.contour.blocks = std::move(pen.blocks());
  const Point first =
      std::visit([](const auto& shape) { return shape.start; }, made.contour.blocks.front());
  made.contour.approach = {.start = first + 3 * radius * Vector(0.6, -0.8), .end = first};
  made.contour.retract = {.start = pen.at(), .end = pen.at() + 3 * radius * Vector(0.8, 0.6)};
  return made;
}

}  // namespace trc::support
