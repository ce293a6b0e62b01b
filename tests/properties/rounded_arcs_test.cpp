#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "core/nc/state/circle.h"
#include "core/session/program_session.h"
#include "core/verify/nearest.h"
#include "core/verify/shape.h"
#include "tests/support/random.h"

// D-44: arcs as CAM systems write them, with three decimals of a millimetre or four of an inch, are
// accepted however short they are, and give the path of the arc that was meant. Arcs whose centre
// is wrong are refused.

namespace trc::support {
namespace {

using std::numbers::pi;

constexpr std::uint64_t programs = 2'000;

struct Unit {
  double size = 1;  // mm
  double digit = 1e-3;
  int decimals = 3;
  const char* words = "G71";
};
constexpr std::array units{Unit{}, Unit{25.4, 2.54e-3, 4, "G70"}};

// A straight line, an arc it is tangent to, and another line, in a place that no grid knows.
struct Course {
  Point center = Point::Zero();
  double radius = 1;
  double from = 0;   // rad, of the first point of the arc as seen from its centre
  double sweep = 0;  // rad
  double tool_radius = 1;
  bool left = true;

  [[nodiscard]] Vector out(double share) const {
    return {std::cos(from + share * sweep), std::sin(from + share * sweep)};
  }
  [[nodiscard]] Point on_arc(double share) const { return center + radius * out(share); }
  [[nodiscard]] Vector along(double share) const {
    return sweep > 0 ? left_of(out(share)) : Vector(-left_of(out(share)));
  }
  [[nodiscard]] double chord() const { return 2 * radius * std::sin(std::abs(sweep) / 2); }
  [[nodiscard]] Arc arc() const {
    return {.start = on_arc(0), .end = on_arc(1), .center = center, .sweep = sweep};
  }
};

Course course(Random& random, const Unit& unit, double most_sweep) {
  const auto spread = [&](double low, double high) {
    return low * std::pow(high / low, random.between(0, 1));
  };
  Course made;
  made.center = {random.between(-50, 50), random.between(-50, 50)};
  made.radius = spread(0.05, 200);
  made.from = random.between(-pi, pi);
  // From a chord of one or two digits on.
  const double least = std::min(most_sweep, 2 * unit.digit / made.radius);
  made.sweep = (random.chance(0.5) ? 1 : -1) * spread(least, most_sweep);
  made.left = random.chance(0.5);
  const bool is_inside = (made.sweep > 0) == made.left;
  made.tool_radius = is_inside ? made.radius * random.between(0.1, 0.8) : spread(0.1, 10);
  return made;
}

enum class Center { relative, of_rounded_points, absolute, radius_word };
constexpr std::array all_centers{Center::relative, Center::of_rounded_points, Center::absolute,
                                 Center::radius_word};

std::string program_of(const Course& course, const Unit& unit, Center center) {
  const auto rounded = [&](const Point& point) {
    return Point((point / unit.digit).array().round() * unit.digit);
  };
  std::ostringstream text;
  text << std::fixed << std::setprecision(unit.decimals);
  const auto to = [&](const char* words, const Point& point) {
    text << words << " X" << point.x() / unit.size << " Y" << point.y() / unit.size;
  };
  const double length = 3 * course.tool_radius + 5;
  const Point begin = course.on_arc(0) - length * course.along(0);
  const Vector beside = (course.left ? 2.0 : -2.0) * course.tool_radius * left_of(course.along(0));
  text << unit.words << (center == Center::absolute ? " G161" : " G162")
       << " G138 G26 G141\n#TRC[REMOVE_MASKED_BLOCKS=1]\nV.G.WZ_AKT.R=" << std::setprecision(9)
       << course.tool_radius / unit.size << '\n'
       << std::setprecision(unit.decimals);
  to("N10 G0", begin + beside);
  to(course.left ? "\nN20 G41 G1 F500" : "\nN20 G42 G1 F500", begin);
  to("\nN30", course.on_arc(0));
  to(course.sweep > 0 ? "\nN40 G3" : "\nN40 G2", course.on_arc(1));
  Point words = course.center - course.on_arc(0);
  if (center == Center::of_rounded_points)
    words = rounded(course.center) - rounded(course.on_arc(0));
  if (center == Center::absolute) words = course.center;
  if (center == Center::radius_word)
    text << " R" << course.radius / unit.size;
  else
    text << " I" << words.x() / unit.size << " J" << words.y() / unit.size;
  to("\nN50 G1", course.on_arc(1) + length * course.along(1));
  to("\nN60 G40", course.on_arc(1) + 2 * length * course.along(1) + beside);
  text << "\nM30\n";
  return text.str();
}

struct Made {
  std::vector<CompensatedBlock> path{};
  std::vector<Diagnostic> diagnostics{};
  bool stopped = false;
};

Made made_of(const std::string& text) {
  ProgramSessionSetup setup;
  setup.nc_text = false;
  ProgramSession session(setup);
  Answers answers;
  if (session.feed(text, answers)) session.finish(answers);
  Answer output = answers.take();
  return {.path = std::move(output.blocks),
          .diagnostics = std::move(output.diagnostics),
          .stopped = session.diagnostics().stopped()};
}

// How much nearer or farther than the tool radius the path comes to the contour that was meant.
double off_by(const std::vector<CompensatedBlock>& path, const Course& course) {
  const double length = 3 * course.tool_radius + 5;
  const std::array<Segment, 3> walls{
      Line{course.on_arc(0) - length * course.along(0), course.on_arc(0)}, course.arc(),
      Line{course.on_arc(1), course.on_arc(1) + length * course.along(1)}};
  double worst = 0;
  for (const CompensatedBlock& block : path) {
    if (block.origin != Origin::programmed && block.origin != Origin::transition) continue;
    for (int sample = 0; sample <= 16; ++sample) {
      const Point point = verify::place_at(block.path, sample / 16.0).point;
      double nearest = std::numeric_limits<double>::infinity();
      for (const Segment& wall : walls)
        nearest = std::min(nearest, (verify::nearest_point(wall, point) - point).norm());
      worst = std::max(worst, std::abs(nearest - course.tool_radius));
    }
  }
  return worst;
}

// Half of the last digit on both axes moves a point by 0.7 digits; start, end and centre together
// move a piece of a circle by at most four.
constexpr double digits_off = 4;

TEST(RoundedArcs, GiveThePathOfTheArcThatWasMeant) {
  for (const Unit& unit : units)
    for (const Center center : all_centers) {
      double worst = 0;
      for (std::uint64_t seed = 1; seed <= programs; ++seed) {
        Random random(seed);
        // By its radius alone an arc is less exact the nearer it comes to half a circle.
        const double most = center == Center::radius_word ? 2 * pi / 3 : 17 * pi / 18;
        const Course made = course(random, unit, most);
        const std::string text = program_of(made, unit, center);
        const Made found = made_of(text);
        SCOPED_TRACE("seed " + std::to_string(seed) + '\n' + text);
        for (const Diagnostic& told : found.diagnostics)
          ASSERT_NE(told.code, Code::center_corrected) << message_of(told);
        ASSERT_FALSE(found.stopped) << message_of(found.diagnostics.back());
        const double off = off_by(found.path, made);
        ASSERT_LE(off, digits_off * unit.digit);
        worst = std::max(worst, off);
      }
      EXPECT_GT(worst, unit.digit / 2) << "rounding has done nothing";
    }
}

// Written with R, near half a circle.
TEST(RoundedArcs, HalfCirclesOfARadiusAreAccepted) {
  for (const Unit& unit : units)
    for (std::uint64_t seed = 1; seed <= programs; ++seed) {
      Random random(seed);
      Course made = course(random, unit, 1);
      made.sweep = std::copysign(pi, made.sweep);
      const auto rounded = [&](double value) {
        return std::round(value / unit.digit) * unit.digit;
      };
      const auto at = [&](double share) {
        return Point(rounded(made.on_arc(share).x()), rounded(made.on_arc(share).y()));
      };
      CircleCheck check;
      check.last_digit = unit.digit;
      const CircleResult result =
          arc_of_radius(rounded(made.radius),
                        {.start = at(0), .end = at(1), .clockwise = made.sweep < 0}, check, {});
      ASSERT_TRUE(std::holds_alternative<Arc>(result)) << "seed " << seed;
    }
}

// Slips that leave start and end at distances from the centre that no rounding makes.
TEST(WrongCentres, AreRefused) {
  std::size_t judged = 0;
  for (const Unit& unit : units)
    for (std::uint64_t seed = 1; seed <= programs; ++seed) {
      Random random(seed);
      const Course made = course(random, unit, 1.5 * pi);
      const Vector words = made.center - made.on_arc(0);
      const std::array slips{Vector(words.y(), words.x()),
                             Vector(-words.x(), words.y()),
                             Vector(words.x(), -words.y()),
                             Vector(-words),
                             Vector(10 * words),
                             Vector(words / 10),
                             Vector(25.4 * words),
                             Vector(made.center),
                             Vector(words + made.on_arc(0).norm() * Vector::UnitX())};
      for (const Vector& slip : slips) {
        const Point center = made.on_arc(0) + slip;
        const double start = (made.on_arc(0) - center).norm();
        const double end = (made.on_arc(1) - center).norm();
        const double least = std::min(start, end);
        // Mirrored in its own axis a centre is as good as before, and a little of a large radius
        // may be corrected (D-41).
        const double allowed = least < 20 ? 0.12 * least : std::max(5.0, 0.12 * least);
        if (std::abs(start - end) <= std::max(0.03, allowed)) continue;
        ++judged;
        CircleCheck check;
        check.last_digit = unit.digit;
        const CircleResult result = arc_about(
            center, {.start = made.on_arc(0), .end = made.on_arc(1), .clockwise = made.sweep < 0},
            check, ArcUse::with_equidistant, {});
        const auto* fault = std::get_if<CircleFault>(&result);
        ASSERT_NE(fault, nullptr) << "seed " << seed << ", radii " << start << ' ' << end;
        EXPECT_EQ(fault->code, Code::circle_center_misfit);
      }
    }
  EXPECT_GT(judged, 5'000U);
}

}  // namespace
}  // namespace trc::support
