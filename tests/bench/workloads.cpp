#include "tests/bench/workloads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "tests/support/coasts.h"
#include "tests/support/font.h"
#include "tests/support/random.h"

namespace trc::bench {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

Point on_ring(double angle, double radius) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

// From the outermost point, where the tool can stand whatever the contour does, and back;
// a little along the circle through it on both sides, so that it stands square to the
// first and to the last block.
std::vector<Segment> closed(const std::vector<Point>& points) {
  const auto outermost = std::max_element(
      points.begin(), points.end(),
      [](const Point& a, const Point& b) { return a.squaredNorm() < b.squaredNorm(); });
  const std::size_t count = points.size();
  const auto first = static_cast<std::size_t>(outermost - points.begin());
  const auto at = [&](std::size_t index) -> const Point& {
    return points[(first + index) % count];
  };
  const Point& start = at(0);
  const Vector along = 1e-2 * left_of(start.normalized());
  std::vector<Segment> contour{Line{.start = start, .end = start + along}};
  const auto add = [&](const Point& end) {
    contour.emplace_back(Line{.start = end_of(contour.back()), .end = end});
  };
  for (std::size_t index = 1; index < count; ++index) add(at(index));
  add(start - along);
  add(start);
  return contour;
}

std::vector<Segment> wave(std::size_t blocks) {
  const double waves = std::max(3.0, std::floor(static_cast<double>(blocks) / 100));
  const double radius = waves * 10 / full_turn;
  std::vector<Point> points;
  for (std::size_t i = 0; i < blocks; ++i) {
    const double angle = full_turn * static_cast<double>(i) / static_cast<double>(blocks);
    points.push_back(on_ring(angle, radius + std::sin(waves * angle)));
  }
  return closed(points);
}

void divide(const Point& from, const Point& to, int parts, std::vector<Point>& points) {
  for (int part = 0; part < parts; ++part)
    points.push_back(from + (to - from) * (static_cast<double>(part) / parts));
}

std::vector<Segment> slots(std::size_t blocks, int wall, int floor, int tooth) {
  const std::size_t per_slot = static_cast<std::size_t>(2 * wall + floor + tooth);
  const std::size_t count = std::max<std::size_t>(20, blocks / per_slot);
  const double radius = static_cast<double>(count) * 5 / full_turn;
  const double outer = std::sqrt(radius * radius - 0.25);
  std::vector<Point> points;
  for (std::size_t slot = 0; slot < count; ++slot) {
    const auto at = [&](std::size_t number, double along, double across) -> Point {
      const Vector radial =
          on_ring(full_turn * static_cast<double>(number) / static_cast<double>(count), 1);
      return along * radial + across * left_of(radial);
    };
    const Point mouth = at(slot, outer, -0.5);
    const Point bottom = at(slot, outer - 10, -0.5);
    const Point other_bottom = at(slot, outer - 10, 0.5);
    const Point other_mouth = at(slot, outer, 0.5);
    divide(mouth, bottom, wall, points);
    divide(bottom, other_bottom, floor, points);
    divide(other_bottom, other_mouth, wall, points);
    divide(other_mouth, at(slot + 1, outer, -0.5), tooth, points);
  }
  return closed(points);
}

std::vector<Segment> comb(std::size_t blocks) { return slots(blocks, 1, 1, 1); }
std::vector<Segment> combfine(std::size_t blocks) { return slots(blocks, 40, 4, 16); }

// A random walk that comes back within 1 mm, with noise on every point.
std::vector<Segment> rough(std::size_t blocks) {
  support::Random random(20'240'607);
  constexpr double length = 0.01;
  const auto count = static_cast<double>(blocks);
  const double back = std::exp(-length);
  const double step = 0.05 * std::sqrt(3 * (1 - back * back));
  std::vector<double> walk;
  double place = 0;
  for (std::size_t i = 0; i < blocks; ++i)
    walk.push_back(place = back * place + random.between(-step, step));
  std::vector<Point> points;
  for (std::size_t i = 0; i < blocks; ++i) {
    const double share = static_cast<double>(i) / count;
    const double level = walk[i] - share * (walk.back() - walk.front());
    points.push_back(on_ring(full_turn * share,
                             count * length / full_turn + level + random.between(-0.005, 0.005)));
  }
  return closed(points);
}

std::vector<Segment> gear(std::size_t blocks) {
  const std::size_t corners = std::max<std::size_t>(8, blocks / 2) / 2 * 2;
  const double radius = static_cast<double>(corners) * 5 / full_turn;
  const auto corner = [&](std::size_t index) {
    return on_ring(full_turn * static_cast<double>(index % corners) / static_cast<double>(corners),
                   radius + (index % 2 == 0 ? 2.0 : -2.0));
  };
  // From the middle of the line after an outer corner.
  const Point start = 0.5 * (corner(0) + corner(1));
  std::vector<Segment> contour;
  Point last = start;
  for (std::size_t index = 1; index <= corners; ++index) {
    const Point at = corner(index);
    const Vector in = (at - corner(index - 1)).normalized();
    const Vector out = (corner(index + 1) - at).normalized();
    const double turn = turn_between(in, out);
    const double fillet = index % 2 == 0 ? 2.0 : 1.5;
    const double cut = fillet * std::tan(std::abs(turn) / 2);
    const Arc arc{.start = at - cut * in,
                  .end = at + cut * out,
                  .center = at - cut * in + std::copysign(fillet, turn) * left_of(in),
                  .sweep = turn};
    contour.emplace_back(Line{.start = last, .end = arc.start});
    contour.emplace_back(arc);
    last = arc.end;
  }
  contour.emplace_back(Line{.start = last, .end = start});
  return contour;
}

std::vector<Segment> spiral(std::size_t blocks) {
  constexpr double pitch = 5 / full_turn;
  constexpr double land = 4;
  const std::size_t half = blocks / 2;
  const double longest = 400 + 2 * static_cast<double>(half) * 0.2 / pitch;
  std::vector<Point> points;
  for (const bool outer : {true, false})
    for (std::size_t i = 0; i < half; ++i) {
      const std::size_t along = outer ? i : half - 1 - i;
      const double share = static_cast<double>(along) / static_cast<double>(half - 1);
      const double angle = std::sqrt(400 + share * (longest - 400));
      points.push_back(on_ring(angle, pitch * angle + (outer ? land : 0)));
    }
  return closed(points);
}

const std::array kinds{
    Workload{"wave", 1, wave}, Workload{"wave", 5, wave},         Workload{"wave", 50, wave},
    Workload{"comb", 1, comb}, Workload{"combfine", 1, combfine}, Workload{"rough", 1, rough},
    Workload{"gear", 1, gear}, Workload{"gear", 3, gear},         Workload{"spiral", 0.6, spiral}};

double area_of(const std::vector<Point>& ring) {
  double twice = 0;
  for (std::size_t k = 0; k < ring.size(); ++k)
    twice += cross(ring[k], ring[(k + 1) % ring.size()]);
  return twice / 2;
}

std::vector<Segment> counter_clockwise(std::vector<Point> ring) {
  if (area_of(ring) < 0) std::reverse(ring.begin(), ring.end());
  return closed(ring);
}

std::vector<std::vector<Segment>> letters() {
  constexpr std::string_view engraved =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";
  std::vector<std::vector<Segment>> contours;
  for (const char* name : {"DejaVuSans", "DejaVuSerif", "DejaVuSansMono"}) {
    const support::Font font("/usr/share/fonts/truetype/dejavu/" + std::string(name) + ".ttf");
    for (const char letter : engraved)
      for (const auto& ring : font.rings_of(static_cast<char32_t>(letter), {}))
        if (ring.size() > 2) contours.push_back(counter_clockwise(ring));
  }
  return contours;
}

// Not one that goes round the world: it runs across all others from one rim of the map to the
// other.
bool is_in_one_piece(const std::vector<Point>& ring) {
  return std::adjacent_find(ring.begin(), ring.end(), [](const Point& a, const Point& b) {
           return std::abs(a.x() - b.x()) > 1000;
         }) == ring.end();
}

std::vector<std::vector<Segment>> coast() {
  std::vector<Point> longest;
  for (auto& ring : support::coasts("h"))
    if (ring.size() > longest.size() && is_in_one_piece(ring)) longest = std::move(ring);
  return {counter_clockwise(std::move(longest))};
}

const std::array shapes{RealShapes{"letters", 0.3, letters}, RealShapes{"letters", 3, letters},
                        RealShapes{"coast", 0.02, coast}, RealShapes{"coast", 0.3, coast}};

}  // namespace

std::span<const Workload> workloads() { return kinds; }
std::span<const RealShapes> real_shapes() { return shapes; }

}  // namespace trc::bench
