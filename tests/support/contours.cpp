#include "tests/support/contours.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <ostream>
#include <sstream>

#include "tests/support/slow_trc.h"

namespace trc::support {
namespace {

constexpr double pi = std::numbers::pi;

Vector direction(double heading) { return {std::cos(heading), std::sin(heading)}; }

Vector turned(const Vector& v, double angle) {
  return {v.x() * std::cos(angle) - v.y() * std::sin(angle),
          v.x() * std::sin(angle) + v.y() * std::cos(angle)};
}

Point end_point(const Segment& segment) {
  return std::visit([](const auto& shape) { return shape.end; }, segment);
}

Vector end_direction(const Segment& segment) {
  if (const auto* line = std::get_if<Line>(&segment)) return (line->end - line->start).normalized();
  const auto& arc = std::get<Arc>(segment);
  const Vector spoke = (arc.end - arc.center).normalized();
  const Vector left{-spoke.y(), spoke.x()};
  return arc.sweep > 0 ? left : Vector(-left);
}

// Size of the turn into a block, rad.
double turn_to(const Vector& heading, const Segment& block) {
  const Vector start = -end_direction(reversed(block));
  return std::acos(std::clamp(heading.dot(start), -1.0, 1.0));
}

double random_turn(Random& random, Flavor flavor, double away) {
  switch (flavor) {
    case Flavor::near_tangent: {
      if (random.chance(0.3)) return 0;
      const double size = std::pow(10.0, random.between(-5, -2));
      return random.chance(0.5) ? size : -size;
    }
    case Flavor::short_blocks:
      return random.between(-0.4, 0.4);
    case Flavor::convex:
      return away * random.between(0.01, 0.9);
    case Flavor::mixed:
    case Flavor::lines:
    case Flavor::grid:
      break;
  }
  if (random.chance(0.2)) return 0;
  if (random.chance(0.06)) return pi;
  if (random.chance(0.2)) return away * random.between(pi / 2, 3.1);
  return random.between(-2.4, 2.4);
}

double random_length(Random& random, Flavor flavor) {
  if (flavor == Flavor::short_blocks) return std::pow(10.0, random.between(-2, 0.3));
  return random.between(0.5, 10);
}

Arc random_arc(Random& random, Flavor flavor, const Point& start, const Vector& heading,
               double away, double unit) {
  const double radius =
      unit * (flavor == Flavor::short_blocks ? random.between(1.2, 20) : random.between(0.7, 9));
  double sweep = random.chance(0.5) ? 1 : -1;
  if (flavor == Flavor::convex) sweep = away;
  const Vector left{-heading.y(), heading.x()};
  const Point center = start + radius * (sweep > 0 ? left : Vector(-left));
  if (flavor == Flavor::mixed && random.chance(0.08))
    return {.start = start, .end = start, .center = center, .sweep = sweep * 2 * pi};
  if (flavor == Flavor::short_blocks)
    sweep *= std::pow(10.0, random.between(-2, -0.5));
  else if (flavor == Flavor::convex)
    sweep *= random.between(0.05, 0.8);
  else
    sweep *= random.between(0.05, 5.5);
  return {.start = start,
          .end = center + turned(start - center, sweep),
          .center = center,
          .sweep = sweep};
}

// On the grid: axis-parallel and 3-4-5 lines, quarter and half circles, all exact.
Segment grid_block(Random& random, const Point& start, const Vector& heading, double unit) {
  static constexpr int rows[][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {3, 4}, {-4, 3}, {4, -3}};
  if (random.chance(0.3)) {
    const double radius = unit * static_cast<double>(1 + random.below(5));
    const Vector axis = std::abs(heading.x()) > std::abs(heading.y())
                            ? Vector(heading.x() > 0 ? 1 : -1, 0)
                            : Vector(0, heading.y() > 0 ? 1 : -1);
    const double sense = random.chance(0.5) ? 1 : -1;
    const Vector left{-axis.y(), axis.x()};
    const Point center = start + radius * sense * left;
    if (random.chance(0.3))
      return Arc{
          .start = start, .end = center + (center - start), .center = center, .sweep = sense * pi};
    return Arc{
        .start = start, .end = center + radius * axis, .center = center, .sweep = sense * pi / 2};
  }
  const auto& row = rows[random.below(std::size(rows))];
  const double factor = unit * static_cast<double>(1 + random.below(6));
  return Line{.start = start, .end = start + factor * Vector(row[0], row[1])};
}

Segment random_block(Random& random, Flavor flavor, const Point& start, const Vector& before,
                     double away, double unit) {
  if (flavor == Flavor::grid) return grid_block(random, start, before, unit);
  const double turn = random_turn(random, flavor, away);
  const Vector heading = turn == pi ? Vector(-before) : turn == 0 ? before : turned(before, turn);
  if (flavor != Flavor::lines && random.chance(0.4))
    return random_arc(random, flavor, start, heading, away, unit);
  return Line{.start = start, .end = start + unit * random_length(random, flavor) * heading};
}

Line random_end(Random& random, Flavor flavor, const Point& start, const Vector& before,
                double unit) {
  if (flavor == Flavor::grid)
    return {.start = start, .end = start + 8 * unit * Vector(before.y(), -before.x())};
  const double turn = random.chance(0.3) ? 0 : random.between(-3, 3);
  const Vector heading = turn == 0 ? before : turned(before, turn);
  return {.start = start, .end = start + unit * random.between(2, 10) * heading};
}

// `accept` decides for each block whether it stays.
template <class Accept>
Contour grown_contour(Random& random, Flavor flavor, const TrcMode& mode, std::size_t longest,
                      const Accept& accept) {
  const double unit = mode.tool_radius > 0 ? mode.tool_radius : 1;
  const double away = mode.side == Side::left ? -1 : 1;
  const bool grid = flavor == Flavor::grid;
  const Point origin =
      grid ? Point::Zero() : Point(random.between(-50, 50), random.between(-50, 50));
  const Vector first = grid ? Vector(1, 0) : direction(random.between(-pi, pi));
  Contour contour;
  contour.approach = {.start = origin - unit * 6 * first, .end = origin};
  const std::size_t blocks = 1 + random.below(longest);
  Point at = origin;
  Vector heading = (contour.approach.end - contour.approach.start).normalized();
  double turned_so_far = 0;
  for (std::size_t tries = 0; contour.blocks.size() < blocks && tries < 6 * blocks; ++tries) {
    const Segment block = random_block(random, flavor, at, heading, away, unit);
    if (flavor == Flavor::convex) {
      const auto* arc = std::get_if<Arc>(&block);
      const double sweep = arc != nullptr ? std::abs(arc->sweep) : 0;
      const double corner = contour.blocks.empty() ? 0 : turn_to(heading, block);
      if (turned_so_far + corner + sweep > pi) break;
      turned_so_far += corner + sweep;
    }
    contour.blocks.push_back(block);
    contour.retract = {.start = end_point(block),
                       .end = end_point(block) + unit * 6 * end_direction(block)};
    if (!accept(contour)) {
      contour.blocks.pop_back();
      continue;
    }
    at = end_point(block);
    heading = end_direction(block);
  }
  if (contour.blocks.empty())
    contour.blocks.emplace_back(Line{.start = origin, .end = origin + unit * 7 * first});
  at = end_point(contour.blocks.back());
  heading = end_direction(contour.blocks.back());
  contour.retract = random_end(random, flavor, at, heading, unit);
  return contour;
}

}  // namespace

std::string name_of(Flavor flavor) {
  switch (flavor) {
    case Flavor::mixed:
      return "Mixed";
    case Flavor::lines:
      return "Lines";
    case Flavor::near_tangent:
      return "NearTangent";
    case Flavor::short_blocks:
      return "ShortBlocks";
    case Flavor::grid:
      return "Grid";
    case Flavor::convex:
      return "Convex";
  }
  return "Unknown";
}

Contour random_contour(Random& random, Flavor flavor, const TrcMode& mode, std::size_t longest) {
  return grown_contour(random, flavor, mode, longest, [](const Contour&) { return true; });
}

Contour random_clean_contour(Random& random, Flavor flavor, const TrcMode& mode,
                             std::size_t longest) {
  for (;;) {
    Contour contour = grown_contour(random, flavor, mode, longest, [&](const Contour& grown) {
      const SlowOutcome outcome = slow_trc(grown, mode);
      return outcome.faults.empty() && !outcome.borderline;
    });
    const SlowOutcome outcome = slow_trc(contour, mode);
    if (outcome.faults.empty() && !outcome.borderline) return contour;
  }
}

TrcMode random_mode(Random& random) {
  static constexpr Selection selections[] = {Selection::direct, Selection::indirect,
                                             Selection::without_block};
  TrcMode mode;
  mode.side = random.chance(0.5) ? Side::left : Side::right;
  mode.tool_radius = random.chance(0.3) ? static_cast<double>(1 + random.below(10))
                                        : std::pow(10.0, random.between(-0.5, 1.5));
  mode.selection = selections[random.below(std::size(selections))];
  mode.transition = random.chance(0.5) ? Transition::linear : Transition::circular;
  if (random.chance(0.5)) mode.options.stretch_factor = static_cast<double>(1 + random.below(9));
  if (random.chance(0.2)) mode.options.stretch_factor = random.between(1, 9);
  return mode;
}

Point Motion::operator()(const Point& point) const {
  const Vector image{mirrored ? -point.x() : point.x(), point.y()};
  return (turn == 0 ? image : turned(image, turn)) + shift;
}

Segment Motion::operator()(const Segment& segment) const {
  if (const auto* line = std::get_if<Line>(&segment))
    return Line{.start = (*this)(line->start), .end = (*this)(line->end)};
  const auto& arc = std::get<Arc>(segment);
  return Arc{.start = (*this)(arc.start),
             .end = (*this)(arc.end),
             .center = (*this)(arc.center),
             .sweep = mirrored ? -arc.sweep : arc.sweep};
}

Contour Motion::operator()(const Contour& contour) const {
  Contour image;
  image.approach = std::get<Line>((*this)(Segment{contour.approach}));
  for (const Segment& block : contour.blocks) image.blocks.push_back((*this)(block));
  image.retract = std::get<Line>((*this)(Segment{contour.retract}));
  return image;
}

Segment reversed(const Segment& segment) {
  if (const auto* line = std::get_if<Line>(&segment))
    return Line{.start = line->end, .end = line->start};
  const auto& arc = std::get<Arc>(segment);
  return Arc{.start = arc.end, .end = arc.start, .center = arc.center, .sweep = -arc.sweep};
}

Contour reversed(const Contour& contour) {
  Contour back;
  back.approach = {.start = contour.retract.end, .end = contour.retract.start};
  for (auto block = contour.blocks.rbegin(); block != contour.blocks.rend(); ++block)
    back.blocks.push_back(reversed(*block));
  back.retract = {.start = contour.approach.end, .end = contour.approach.start};
  return back;
}

Side other(Side side) {
  if (side == Side::off) return side;
  return side == Side::left ? Side::right : Side::left;
}

Point point_at(const Segment& segment, double t) {
  if (const auto* line = std::get_if<Line>(&segment))
    return line->start + t * (line->end - line->start);
  const auto& arc = std::get<Arc>(segment);
  return arc.center + turned(arc.start - arc.center, t * arc.sweep);
}

std::ostream& operator<<(std::ostream& out, const Contour& contour) {
  const auto precision = out.precision(17);
  out << "G00 X" << contour.approach.start.x() << " Y" << contour.approach.start.y() << "\nG01 X"
      << contour.approach.end.x() << " Y" << contour.approach.end.y() << " (approach)";
  for (const Segment& block : contour.blocks) {
    if (const auto* line = std::get_if<Line>(&block)) {
      out << "\nG01 X" << line->end.x() << " Y" << line->end.y();
      continue;
    }
    const auto& arc = std::get<Arc>(block);
    out << (arc.sweep > 0 ? "\nG03 X" : "\nG02 X") << arc.end.x() << " Y" << arc.end.y()
        << " G161 I" << arc.center.x() << " J" << arc.center.y() << " (sweep " << arc.sweep << ")";
  }
  out << "\nG01 X" << contour.retract.end.x() << " Y" << contour.retract.end.y() << " (retract)\n";
  out.precision(precision);
  return out;
}

std::string text_of(const TrcMode& mode) {
  static constexpr const char* selections[] = {"G138", "G139", "G236", "G237", "G238", "G239"};
  std::ostringstream text;
  text << std::setprecision(17) << selections[static_cast<int>(mode.selection)]
       << (mode.transition == Transition::linear ? " G25 " : " G26 ")
       << (mode.side == Side::left ? "G41" : "G42") << " R=" << mode.tool_radius
       << " STRETCH_FACTOR=" << mode.options.stretch_factor;
  return text.str();
}

}  // namespace trc::support
