#include <vector>

#include "core/base/tolerances.h"
#include "core/geometry/intersect.h"
#include "core/geometry/parallel.h"
#include "tests/bench/timed.h"
#include "tests/support/random.h"

// The questions every corner asks. Time a question.

namespace trc::bench {
namespace {

constexpr std::size_t count = 1000;

struct Shapes {
  std::vector<StraightLine> lines;
  std::vector<Circle> circles;
  std::vector<Segment> segments;
};

const Shapes& shapes() {
  static const Shapes made = [] {
    support::Random random(1);
    const auto point = [&] { return Point(random.between(-50, 50), random.between(-50, 50)); };
    Shapes shapes;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector direction = (point() + Vector(0.1, 0.2)).normalized();
      shapes.lines.push_back({.point = point(), .direction = direction});
      shapes.circles.push_back({.center = point(), .radius = random.between(20, 80)});
      const Point center = point();
      const Vector out = random.between(5, 20) * direction;
      if (i % 3 == 0)
        shapes.segments.emplace_back(Arc{.start = center + out,
                                         .end = center + left_of(out),
                                         .center = center,
                                         .sweep = 1.5707963267948966});
      else
        shapes.segments.emplace_back(Line{.start = center, .end = center + out});
    }
    return shapes;
  }();
  return made;
}

template <class Ask>
void ask_all(benchmark::State& state, Ask ask) {
  const Shapes& given = shapes();
  run_timed(
      state, count, [] {},
      [&] {
        for (std::size_t i = 0; i < count; ++i)
          benchmark::DoNotOptimize(ask(given, i, i + 1 == count ? 0 : i + 1));
      });
}

const double same_point = Tolerances{}.same_point;

const bool registered = [] {
  add("geometry: line meets line", [](benchmark::State& state) {
    ask_all(state, [](const Shapes& given, std::size_t a, std::size_t b) {
      return intersect(given.lines[a], given.lines[b]);
    });
  });
  add("geometry: line meets circle", [](benchmark::State& state) {
    ask_all(state, [](const Shapes& given, std::size_t a, std::size_t b) {
      return intersect(given.lines[a], given.circles[b], same_point);
    });
  });
  add("geometry: circle meets circle", [](benchmark::State& state) {
    ask_all(state, [](const Shapes& given, std::size_t a, std::size_t b) {
      return intersect(given.circles[a], given.circles[b], same_point);
    });
  });
  add("geometry: tangent and parallel", [](benchmark::State& state) {
    ask_all(state, [](const Shapes& given, std::size_t a, std::size_t /*b*/) {
      const Segment& segment = given.segments[a];
      return parallel_point(end_of(segment), tangent_at_end(segment), 5);
    });
  });
  add("geometry: length", [](benchmark::State& state) {
    ask_all(state, [](const Shapes& given, std::size_t a, std::size_t /*b*/) {
      return length_of(given.segments[a]);
    });
  });
  return add("geometry: turn", [](benchmark::State& state) {
    ask_all(state, [](const Shapes& given, std::size_t a, std::size_t b) {
      return turn_between(given.lines[a].direction, given.lines[b].direction);
    });
  });
}();

}  // namespace
}  // namespace trc::bench
