#include "tests/support/big_contours.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/contours.h"
#include "tests/support/random.h"

namespace trc::support {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

Point polar(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

std::vector<Segment> polygon(const std::vector<Point>& corners) {
  std::vector<Segment> contour;
  for (std::size_t k = 0; k < corners.size(); ++k)
    contour.emplace_back(Line{.start = corners[k], .end = corners[(k + 1) % corners.size()]});
  return contour;
}

// Waves of 10 mm length and 1 mm height, 100 lines each.
std::vector<Segment> wave(std::size_t blocks) {
  const double waves = std::max(3.0, std::round(static_cast<double>(blocks) / 100));
  const double radius = waves * 10 / full_turn;
  std::vector<Point> corners;
  for (std::size_t k = 0; k < blocks; ++k) {
    const double angle = full_turn * static_cast<double>(k) / static_cast<double>(blocks);
    corners.push_back(polar(radius + std::sin(waves * angle), angle));
  }
  return polygon(corners);
}

// Slots 1 mm wide and 10 mm deep, one every 5 mm; `pieces` lines on every wall.
std::vector<Segment> comb(std::size_t slots, int pieces) {
  const double radius = std::max(15.0, static_cast<double>(slots) * 5 / full_turn);
  std::vector<Point> corners;
  const auto line_from = [&](const Point& from, const Point& to, int parts) {
    for (int k = 0; k < parts; ++k) corners.emplace_back(from + (to - from) * k / parts);
  };
  const auto corner = [&](std::size_t slot, double outward, double along) {
    const double angle = full_turn * static_cast<double>(slot) / static_cast<double>(slots);
    const Vector out = polar(1, angle);
    return Point(outward * out + along * Vector(-out.y(), out.x()));
  };
  const double mouth = std::sqrt(radius * radius - 0.25);
  for (std::size_t k = 0; k < slots; ++k) {
    line_from(corner(k, mouth, -0.5), corner(k, mouth - 10, -0.5), pieces);
    line_from(corner(k, mouth - 10, -0.5), corner(k, mouth - 10, 0.5), (pieces + 9) / 10);
    line_from(corner(k, mouth - 10, 0.5), corner(k, mouth, 0.5), pieces);
    line_from(corner(k, mouth, 0.5), corner(k + 1, mouth, -0.5), (pieces + 2) / 3);
  }
  return polygon(corners);
}

// Corners at 2 mm beyond and within a ring, in turns, 5 mm from each other, rounded
// with 2 mm outside and 1.5 mm inside.
std::vector<Segment> gear(std::size_t teeth) {
  const std::size_t count = 2 * teeth;
  const double radius = static_cast<double>(teeth) * 10 / full_turn;
  const auto corner = [&](std::size_t k) {
    return polar(radius + (k % 2 == 0 ? 2 : -2),
                 full_turn * static_cast<double>(k) / static_cast<double>(count));
  };
  std::vector<Arc> arcs;
  for (std::size_t k = 0; k < count; ++k) {
    const Point at = corner(k);
    const Vector in = (at - corner((k + count - 1) % count)).normalized();
    const Vector out = (corner((k + 1) % count) - at).normalized();
    const double turn = std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
    const double fillet = k % 2 == 0 ? 2 : 1.5;
    const double trim = fillet * std::tan(std::abs(turn) / 2);
    const Vector side = turn > 0 ? Vector(-in.y(), in.x()) : Vector(in.y(), -in.x());
    arcs.push_back({.start = at - trim * in,
                    .end = at + trim * out,
                    .center = at - trim * in + fillet * side,
                    .sweep = turn});
  }
  std::vector<Segment> contour;
  for (std::size_t k = 0; k < count; ++k) {
    contour.emplace_back(arcs[k]);
    contour.emplace_back(Line{.start = arcs[k].end, .end = arcs[(k + 1) % count].start});
  }
  return contour;
}

// An arm 4 mm wide with a gap of 1 mm between its turns, out and back again in steps
// of 0.2 mm.
std::vector<Segment> spiral(std::size_t blocks) {
  const double pitch = 5 / full_turn;
  const auto half = blocks / 2;
  const double first = 20;
  std::vector<double> angles{first};
  while (angles.size() < half) angles.push_back(angles.back() + 0.2 / (pitch * angles.back()));
  std::vector<Point> corners;
  for (const double angle : angles) corners.push_back(polar(pitch * angle + 4, angle));
  std::for_each(angles.rbegin(), angles.rend(),
                [&](double angle) { corners.push_back(polar(pitch * angle, angle)); });
  return polygon(corners);
}

// Steps of 0.01 mm about a ring, off it by a slow wander of 0.05 mm and a noise of
// 0.005 mm.
std::vector<Segment> rough(std::size_t blocks) {
  Random random(20'240'607);
  const double radius = static_cast<double>(blocks) * 0.01 / full_turn;
  std::vector<double> wander(blocks);
  double drift = 0;
  for (double& value : wander) value = drift = 0.99 * drift + random.between(-0.012, 0.012);
  std::vector<Point> corners;
  for (std::size_t k = 0; k < blocks; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(blocks);
    const double off = wander[k] - part * drift + random.between(-0.005, 0.005);
    corners.push_back(polar(radius + off, full_turn * part));
  }
  return polygon(corners);
}

}  // namespace

std::string name_of(BigShape shape) {
  switch (shape) {
    case BigShape::wave:
      return "Wave";
    case BigShape::comb:
      return "Comb";
    case BigShape::divided_comb:
      return "DividedComb";
    case BigShape::gear:
      return "Gear";
    case BigShape::spiral:
      return "Spiral";
    case BigShape::rough:
      return "Rough";
  }
  return "Unknown";
}

std::vector<Segment> big_contour(BigShape shape, std::size_t blocks) {
  switch (shape) {
    case BigShape::wave:
      return wave(blocks);
    case BigShape::comb:
      return comb(blocks / 4, 1);
    case BigShape::divided_comb:
      return comb(blocks / 98, 40);
    case BigShape::gear:
      return gear(blocks / 4);
    case BigShape::spiral:
      return spiral(blocks);
    case BigShape::rough:
      return rough(blocks);
  }
  return {};
}

std::vector<Segment> begun_within(const std::vector<Segment>& contour, std::size_t first) {
  const Segment& cut = contour[first];
  const Point middle = point_at(cut, 0.5);
  std::vector<Segment> result;
  const auto add_half = [&](bool second) {
    if (const auto* line = std::get_if<Line>(&cut)) {
      result.emplace_back(second ? Line{.start = middle, .end = line->end}
                                 : Line{.start = line->start, .end = middle});
      return;
    }
    Arc half = std::get<Arc>(cut);
    (second ? half.start : half.end) = middle;
    half.sweep /= 2;
    result.emplace_back(half);
  };
  add_half(true);
  for (std::size_t k = 1; k < contour.size(); ++k)
    result.push_back(contour[(first + k) % contour.size()]);
  add_half(false);
  return result;
}

}  // namespace trc::support
