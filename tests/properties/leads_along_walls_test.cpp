#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/along.h"
#include "core/geometry/distance.h"
#include "core/messages/diagnostic_text.h"
#include "tests/support/program_run.h"
#include "tests/support/random.h"
#include "tests/support/run.h"

// Leads that leave the walls so slowly that for some way both are one, as far as coordinates tell
// (D-38, D-44). The judge is the distance from the ring as it was programmed.

namespace trc::support {
namespace {

constexpr double pi = std::numbers::pi;
constexpr const char* removing = "G26\nG141\n#TRC[REMOVE_MASKED_BLOCKS=1]";

double rounded(double value, int decimals) {
  const double unit = std::pow(10, decimals);
  return std::round(value * unit) / unit;
}

// Writes a program with as many decimals, and remembers the walls of it.
class Program {
 public:
  Program(const std::string& modes, double radius, int decimals) : decimals_(decimals) {
    text_ << std::fixed;
    text_.precision(9);
    text_ << "V.G.WZ_AKT.R=" << radius << '\n' << modes << '\n';
    text_.precision(decimals);
  }

  void go_to(const std::string& words, const Point& point) {
    at_ = rounded_point(point);
    text_ << words << " X" << at_.x() << " Y" << at_.y() << '\n';
  }
  void line(const Point& end, bool is_wall = true) {
    const Point start = at_;
    go_to("G1", end);
    if (is_wall) walls_.emplace_back(Line{.start = start, .end = at_});
  }
  void arc(const Point& end, const Point& center, double sweep, bool is_wall = true) {
    const Point start = at_;
    const Point offset = rounded_point(center - start);
    at_ = rounded_point(end);
    text_ << (sweep > 0 ? "G3" : "G2") << " X" << at_.x() << " Y" << at_.y() << " I" << offset.x()
          << " J" << offset.y() << '\n';
    // A centre is put onto the bisector of start and end.
    const Vector chord = at_ - start;
    const Point middle = 0.5 * (start + at_);
    const Vector given = start + offset - middle;
    const Point between = middle + given - given.dot(chord) / chord.squaredNorm() * chord;
    if (is_wall)
      walls_.emplace_back(Arc{.start = start, .end = at_, .center = between, .sweep = sweep});
  }

  [[nodiscard]] std::string text() const { return text_.str() + "M30\n"; }
  [[nodiscard]] const std::vector<Segment>& walls() const { return walls_; }

 private:
  [[nodiscard]] Point rounded_point(const Point& point) const {
    return {rounded(point.x(), decimals_), rounded(point.y(), decimals_)};
  }

  int decimals_;
  std::ostringstream text_;
  Point at_ = Point::Zero();
  std::vector<Segment> walls_;
};

// Of the path between approach and retract.
std::vector<Point> samples_of(const Outcome& outcome) {
  constexpr double apart = 0.4;  // mm; between two of them arcs are off by up to 5 um
  std::vector<Point> samples;
  for (const CompensatedBlock& block : moving(outcome.blocks)) {
    if (block.origin != Origin::programmed && block.origin != Origin::transition) continue;
    const double length = length_of(block.path);
    const int steps = 4 + static_cast<int>(length / apart);
    for (int step = 0; step <= steps; ++step)
      samples.push_back(point_along(block.path, length * step / steps));
  }
  return samples;
}

double distance_from(const std::vector<Segment>& segments, const Point& point) {
  double least = INFINITY;
  for (const Segment& segment : segments) least = std::min(least, distance(point, segment));
  return least;
}

// How near rounding lets the tool come where leads and walls meet, mm.
double play_of(int decimals) { return 4 * std::pow(10, -decimals) + 2e-4; }

void expect_clear(const Outcome& outcome, const Program& program, double radius, int decimals) {
  ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error()) << '\n' << program.text();
  for (const Point& point : samples_of(outcome))
    ASSERT_GE(distance_from(program.walls(), point), radius - play_of(decimals))
        << point.transpose() << '\n'
        << program.text() << text_of(outcome.blocks);
}

// A bore with a keyway soon after where it is entered, and left again before that.
struct Bore {
  double turn = 0;     // where it is entered
  double before = 0;   // from there to the keyway, radians
  double keyway = 0;   // its width, radians
  double overrun = 0;  // radians
  double lead = 0;     // radius of the arcs in and out, mm
  double radius = 0;   // of the tool, mm
  int decimals = 3;

  static constexpr double size = 20;  // radius of the bore, mm

  [[nodiscard]] static Point on_wall(double angle, double from_center = size) {
    return from_center * Point(std::cos(angle), std::sin(angle));
  }
  [[nodiscard]] Program program() const {
    Program text(removing, radius, decimals);
    const Point out = on_wall(turn + before + keyway / 2, 5);
    const double end = turn + overrun;
    text.go_to("G0", Point(0, 0));
    text.go_to("G41 G1 F500", on_wall(turn, size - lead) + lead * on_wall(turn - pi / 2, 1));
    text.arc(on_wall(turn), on_wall(turn, size - lead), pi / 2, false);
    text.arc(on_wall(turn + before), Point(0, 0), before);
    text.line(on_wall(turn + before) + out);
    text.line(on_wall(turn + before + keyway) + out);
    text.line(on_wall(turn + before + keyway));
    text.arc(on_wall(turn), Point(0, 0), 2 * pi - before - keyway);
    if (overrun > 0) text.arc(on_wall(end), Point(0, 0), overrun);
    text.arc(on_wall(end, size - lead) + lead * on_wall(end + pi / 2, 1), on_wall(end, size - lead),
             pi / 2, false);
    text.go_to("G40 G1", Point(0, 0));
    return text;
  }
};

TEST(LeadsAlongWalls, MayLeaveABoreJustBeforeACorner) {
  constexpr double degree = pi / 180;
  for (std::uint64_t seed = 57'000'000; seed < 57'000'400 && !HasFailure(); ++seed) {
    Random random(seed);
    Bore bore{.turn = random.between(-pi, pi),
              .before = random.between(0.5, 10) * degree,
              .keyway = random.between(5, 60) * degree,
              .radius = random.between(1, 6),
              .decimals = random.chance(0.5) ? 3 : 6};
    bore.overrun = random.chance(0.3) ? 0 : bore.before * random.between(0.1, 0.98);
    bore.lead = random.between(1.05 * bore.radius + 0.1, 18);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Program program = bore.program();
    const ProgramRun outcome = to_blocks(program.text());
    expect_clear(outcome, program, bore.radius, bore.decimals);
    // It goes all round.
    double farthest = 0;
    for (const Point& point : samples_of(outcome))
      farthest = std::max(farthest, point.dot(Bore::on_wall(bore.turn + pi, 1)));
    EXPECT_NEAR(farthest, Bore::size - bore.radius, play_of(bore.decimals) + 5e-3);
  }
}

// A round boss in many arcs, with lines along its tangent in and out.
TEST(LeadsAlongWalls, MayGoStraightOnFromABossOfShortArcs) {
  for (std::uint64_t seed = 58'000'000; seed < 58'000'300 && !HasFailure(); ++seed) {
    Random random(seed);
    const double size = random.between(1, 30);
    const double arc = random.between(0.1, 3);  // mm
    const double turn = random.between(-pi, pi);
    const double lead = random.between(1, 10);
    const double radius = random.between(0.5, 6);
    const int decimals = random.chance(0.5) ? 3 : 6;
    const auto arcs = static_cast<int>(std::max(2 * pi * size / arc, 3.0));
    const Point out(std::cos(turn), std::sin(turn));
    const Vector along(-out.y(), out.x());
    Program program(removing, radius, decimals);
    program.go_to("G0", (size + radius + 2) * out - lead * along);
    program.go_to("G42 G1 F500", size * out - lead * along);
    program.line(size * out, false);
    for (int number = 1; number <= arcs; ++number) {
      const double angle = turn + 2 * pi * (number % arcs) / arcs;
      program.arc(size * Point(std::cos(angle), std::sin(angle)), Point(0, 0), 2 * pi / arcs);
    }
    program.line(size * out + lead * along, false);
    program.go_to("G40 G1", (size + radius + 2) * out + lead * along);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ProgramRun outcome = to_blocks(program.text());
    expect_clear(outcome, program, radius, decimals);
    double farthest = 0;
    for (const Point& point : samples_of(outcome)) farthest = std::max(farthest, -point.dot(out));
    EXPECT_NEAR(farthest, size + radius, play_of(decimals) + 5e-3);
  }
}

}  // namespace
}  // namespace trc::support
