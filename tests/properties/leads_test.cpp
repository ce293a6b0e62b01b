#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/geometry/along.h"
#include "core/geometry/distance.h"
#include "core/messages/diagnostic_text.h"
#include "tests/support/cam_programs.h"
#include "tests/support/long_run.h"
#include "tests/support/program_run.h"
#include "tests/support/random.h"
#include "tests/support/run.h"

// Lead-in, lead-out, overrun and laps (D-38): what bounds no material is in nobody's way. The
// programs are those of CAM systems; the judge is the distance from the ring they go round.

namespace trc::support {
namespace {

constexpr double pi = std::numbers::pi;

std::size_t count_of(const Outcome& outcome, Code code) {
  return static_cast<std::size_t>(
      std::count_if(outcome.diagnostics.begin(), outcome.diagnostics.end(),
                    [&](const Diagnostic& found) { return found.code == code; }));
}

// The path between approach and retract.
std::vector<Segment> path_of(const Outcome& outcome) {
  std::vector<Segment> path;
  for (const CompensatedBlock& block : moving(outcome.blocks))
    if (block.origin == Origin::programmed || block.origin == Origin::transition)
      path.push_back(block.path);
  return path;
}

std::vector<Point> samples_of(const std::vector<Segment>& path) {
  constexpr int steps = 16;
  std::vector<Point> samples;
  for (const Segment& block : path)
    for (int step = 0; step <= steps; ++step)
      samples.push_back(point_along(block, length_of(block) * step / steps));
  return samples;
}

double distance_from(const std::vector<Segment>& segments, const Point& point) {
  double least = INFINITY;
  for (const Segment& segment : segments) least = std::min(least, distance(point, segment));
  return least;
}

// Nothing of the path is nearer to the ring than the tool. But for what is beside the start, where
// leads cut something off and a lap turns a corner more, what touches the ring lies on the path
// round it without leads, and all of that is there.
void expect_same_walls(const std::vector<Segment>& path, const std::vector<Segment>& bare,
                       const std::vector<Segment>& ring, double radius, double beside_start,
                       double tolerance) {
  const Point start = start_of(ring.front());
  for (const Point& point : samples_of(path)) {
    const double apart = distance_from(ring, point);
    ASSERT_GE(apart, radius - tolerance) << point.transpose();
    if (apart > radius + tolerance || (point - start).norm() < beside_start) continue;
    ASSERT_LE(distance_from(bare, point), 2 * tolerance) << point.transpose();
  }
  for (const Point& point : samples_of(bare)) {
    if ((point - start).norm() < beside_start) continue;
    ASSERT_LE(distance_from(path, point), 2 * tolerance) << point.transpose();
  }
}

// Whatever leads, overrun, laps and numbers a CAM system may put together.
std::vector<CamProgram> cam_programs() {
  std::vector<CamProgram> programs;
  const auto add = [&](const CamProgram& program) {
    if (!is_possible(program)) return;
    programs.push_back(program);
    programs.back().decimals = programs.size() % 3 == 0 ? 4 : 3;
    programs.back().inch = programs.size() % 7 == 0;
    if (programs.back().inch) programs.back().decimals = 4;
  };
  constexpr Laps laps[] = {Laps::two, Laps::three, Laps::rough_and_finish, Laps::depths,
                           Laps::depths_and_leads};
  for (const CamContour& contour : cam_contours()) {
    for (const Lead lead : all_leads)
      for (const Overrun overrun : all_overruns)
        for (const double length : {1, 3, 8})
          if (length == 1 || overrun == Overrun::along)
            add({.contour = contour,
                 .in = lead,
                 .out = lead,
                 .overrun = overrun,
                 .overrun_length = length});
    add({.contour = contour, .in = Lead::arc, .out = Lead::line});
    add({.contour = contour, .in = Lead::square, .out = Lead::half_circle});
    add({.contour = contour, .in = Lead::crossing, .out = Lead::none});
    for (const Laps several : laps)
      for (const Lead lead : {Lead::arc, Lead::line, Lead::one_point})
        for (const Overrun overrun : {Overrun::none, Overrun::along, Overrun::over_a_corner})
          for (const double length : {1, 3})
            if (length == 1 || overrun == Overrun::along)
              add({.contour = contour,
                   .in = lead,
                   .out = lead,
                   .overrun = overrun,
                   .overrun_length = length,
                   .laps = several});
  }
  return programs;
}

std::size_t laps_of(const CamProgram& program) {
  switch (program.laps) {
    case Laps::one:
      return 1;
    case Laps::two:
    case Laps::rough_and_finish:
      return 2;
    case Laps::three:
    case Laps::depths:
    case Laps::depths_and_leads:
      return 3;
  }
  return 0;
}

// What is left of a micrometre by so many decimals, where passes lie on top of each other.
constexpr double tolerance = 0.005;

constexpr const char* with_removal = "G141\n#TRC[REMOVE_MASKED_BLOCKS=1]";

// All programs round one contour that begin with the same lead.
class CamPrograms : public ::testing::TestWithParam<std::tuple<std::string, Lead>> {
 protected:
  void for_each(const std::function<void(const CamProgram&)>& claim) const {
    const auto& [contour, lead] = GetParam();
    std::size_t tried = 0;
    for (const CamProgram& program : cam_programs()) {
      if (program.contour.name != contour || program.in != lead) continue;
      SCOPED_TRACE(name_of(program));
      claim(program);
      ++tried;
    }
    EXPECT_GT(tried, 0U);
  }
};

std::vector<std::string> names_of_contours() {
  std::vector<std::string> names;
  for (const CamContour& contour : cam_contours()) names.push_back(contour.name);
  return names;
}

void expect_nothing_lost(const CamProgram& program) {
  const std::string text = text_of(program, with_removal);
  const ProgramRun outcome = to_blocks(text);
  if (!leaves_room(program)) {
    // The finishing lap goes round another ring.
    if (program.laps == Laps::rough_and_finish) return;
    // Whatever becomes of its leads, the tool does not touch what it must not.
    for (const Point& point : samples_of(path_of(outcome)))
      ASSERT_GE(distance_from(program.contour.ring, point), program.contour.tool_radius - tolerance)
          << text << text_of(outcome.blocks);
    return;
  }
  SCOPED_TRACE(text + outcome.report());
  ASSERT_FALSE(outcome.stopped);
  EXPECT_EQ(first_gap(outcome.blocks), "");
  EXPECT_EQ(count_of(outcome, Code::blocks_masked), program.contour.loops * laps_of(program));
  // Of a short arc the rounding of its end moves the centre by more.
  EXPECT_EQ(outcome.diagnostics.size(),
            count_of(outcome, Code::blocks_masked) + count_of(outcome, Code::center_corrected));
  if (program.laps == Laps::rough_and_finish) return;  // the laps are not one

  const CamProgram bare{
      .contour = program.contour, .decimals = program.decimals, .inch = program.inch};
  const ProgramRun reference = to_blocks(text_of(bare, with_removal));
  ASSERT_FALSE(reference.stopped) << reference.report();
  const double beside_start =
      (2 * program.size_of_leads + 4) * program.contour.tool_radius + program.overrun_length;
  expect_same_walls(path_of(outcome), path_of(reference), program.contour.ring,
                    program.contour.tool_radius, beside_start, tolerance);
  if (::testing::Test::HasFailure()) ADD_FAILURE() << text << text_of(outcome.blocks);
}

TEST_P(CamPrograms, LoseNothingButTheirLoops) { for_each(expect_nothing_lost); }

TEST_P(CamPrograms, AreTheSameInAWindowThatHoldsThem) {
  SessionSetup setup;
  setup.compensator.limits.look_ahead_blocks = 5'000;
  for_each([&](const CamProgram& program) {
    const std::string text = text_of(program, with_removal);
    const ProgramRun whole = to_blocks(text);
    const ProgramRun window = to_blocks(text, {.session = setup});
    EXPECT_TRUE(same(whole, window)) << text << window.report();
  });
}

TEST_P(CamPrograms, HaveNoBottleneck) {
  SessionSetup implicit;
  implicit.compensator.implicit_contour_masking = true;
  for_each([&](const CamProgram& program) {
    if (program.contour.loops > 0 || !leaves_room(program)) return;
    const std::string text = text_of(program, "G141");
    const ProgramRun masking = to_blocks(text);
    EXPECT_FALSE(masking.stopped) << text << masking.report();
    EXPECT_TRUE(masking.diagnostics.empty()) << text << masking.report();
    const ProgramRun searched = to_blocks(text_of(program, "G140"), {.session = implicit});
    EXPECT_FALSE(searched.stopped) << text << searched.report();
  });
}

INSTANTIATE_TEST_SUITE_P(Leads, CamPrograms,
                         ::testing::Combine(::testing::ValuesIn(names_of_contours()),
                                            ::testing::ValuesIn(all_leads)),
                         [](const auto& tested) {
                           return std::get<0>(tested.param) + "_" +
                                  name_of(std::get<1>(tested.param));
                         });

// Within 10 nm: the end of a lead along the contour overlaps it by its rounding.
bool are_the_same(const std::vector<Segment>& one, const std::vector<Segment>& other) {
  constexpr double nanometres = 1e-5;
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](const Segment& block, const Segment& beside) {
                      return (end_of(block) - end_of(beside)).norm() <= nanometres &&
                             (start_of(block) - start_of(beside)).norm() <= nanometres &&
                             is_arc(block) == is_arc(beside);
                    });
}

// Leads and overruns of any size, laps, and contours turned by any angle: where the path that G140
// makes is clear of the walls, loop removal changes nothing of it.
TEST(Leads, AreNoWallsWhateverTheirSize) {
  const std::uint64_t programs = is_long_run() ? 50'000 : 2'000;
  constexpr Laps laps[] = {Laps::one,    Laps::two,
                           Laps::three,  Laps::rough_and_finish,
                           Laps::depths, Laps::depths_and_leads};
  const std::vector<CamContour> contours = cam_contours();
  std::size_t compared = 0;
  for (std::uint64_t seed = 1; seed <= programs && !::testing::Test::HasFailure(); ++seed) {
    Random random(seed);
    CamProgram program{
        .contour = turned(contours[random.below(contours.size())], random.between(-pi, pi)),
        .in = all_leads[random.below(std::size(all_leads))],
        .out = all_leads[random.below(std::size(all_leads))],
        .overrun = all_overruns[random.below(std::size(all_overruns))],
        .laps = laps[random.below(std::size(laps))],
        .size_of_leads = random.between(1.2, 2.3),
        .rounded_corners = random.between(0.5, 3.5),
        .decimals = random.chance(0.5) ? 3 : 4,
        .inch = random.chance(0.2)};
    if (program.inch) program.decimals = 4;
    // All of the lead-out and the overrun lies within ten tool radii of the end.
    program.overrun_length =
        random.between(0.05, (9.5 - 3.9 * program.size_of_leads) * program.contour.tool_radius);
    if (!is_possible(program) || !leads_between_are_short(program) || program.contour.loops > 0)
      continue;
    const ProgramRun plain = to_blocks(text_of(program, "G26\nG140"));
    const auto is_near = [&, ring = finished_ring(program)](const Point& point) {
      return distance_from(ring, point) < program.contour.tool_radius - tolerance;
    };
    const std::vector<Point> path = samples_of(path_of(plain));
    if (plain.stopped || std::any_of(path.begin(), path.end(), is_near)) continue;
    // What is left of an overrun may be so short that only the one of the two joins it (D-44).
    const std::vector<Segment> blocks = path_of(plain);
    const auto is_fine = [](const Segment& block) {
      return !is_arc(block) && length_of(block) < 0.1;
    };
    if (std::any_of(blocks.begin(), blocks.end(), is_fine)) continue;
    ++compared;
    const std::string removing = text_of(program, "G26\nG141\n#TRC[REMOVE_MASKED_BLOCKS=1]");
    const ProgramRun outcome = to_blocks(removing);
    EXPECT_FALSE(outcome.stopped);
    EXPECT_EQ(count_of(outcome, Code::blocks_masked), 0U);
    EXPECT_TRUE(are_the_same(path_of(outcome), path_of(plain)));
    if (::testing::Test::HasFailure())
      ADD_FAILURE() << "seed " << seed << '\n'
                    << removing << outcome.report() << text_of(outcome.blocks) << "G140\n"
                    << text_of(plain.blocks);
  }
  EXPECT_GT(compared, programs / 4);
}

// A ring round the origin, seen from there in order, with lines and round bumps, begun in the
// middle of a line. Clockwise: the tool, on the left, is outside.
std::vector<Segment> random_ring(Random& random, bool clockwise) {
  const std::size_t corners = 5 + random.below(30);
  std::vector<Point> points;
  for (std::size_t corner = 0; corner < corners; ++corner) {
    const double share =
        (static_cast<double>(corner) + random.between(0.1, 0.9)) / static_cast<double>(corners);
    const double angle = (clockwise ? -2 : 2) * pi * share;
    points.push_back(random.between(20, 50) * Point(std::cos(angle), std::sin(angle)));
  }
  std::vector<Segment> ring;
  const Point start = 0.5 * (points.back() + points.front());
  Point at = start;
  for (const Point& point : points) {
    ring.emplace_back(Line{at, point});
    at = point;
  }
  ring.emplace_back(Line{at, start});
  return ring;
}

// A quarter circle in and out, and so much more of the first line.
struct WithLeads {
  std::vector<Segment> blocks{};
  bool legal = false;
};
WithLeads with_leads(const std::vector<Segment>& ring, double radius, double size, double overrun) {
  const Point start = start_of(ring.front());
  const Vector tangent = tangent_at_start(ring.front());
  const Vector left = left_of(tangent);
  const Point end = start + overrun * tangent;
  const Arc in{.start = start + size * (left - tangent),
               .end = start,
               .center = start + size * left,
               .sweep = pi / 2};
  const Arc out{.start = end,
                .end = end + size * (left + tangent),
                .center = end + size * left,
                .sweep = pi / 2};
  WithLeads result;
  result.blocks.emplace_back(in);
  result.blocks.insert(result.blocks.end(), ring.begin(), ring.end());
  if (overrun > 0) result.blocks.emplace_back(Line{start, end});
  result.blocks.emplace_back(out);
  result.legal = overrun < 0.5 * length_of(ring.front());
  // The path of the leads lies inside them.
  for (const Arc& lead : {in, out})
    for (int step = 0; step <= 32; ++step) {
      const Vector from = point_along(lead, length_of(lead) * step / 32) - lead.center;
      const Point path = lead.center + (1 - radius / size) * from;
      result.legal = result.legal && distance_from(ring, path) >= radius - 1e-9;
    }
  return result;
}

Contour contour_of(std::vector<Segment> blocks) {
  const Point first = start_of(blocks.front());
  const Point last = end_of(blocks.back());
  const Vector in = tangent_at_start(blocks.front());
  const Vector out = tangent_at_end(blocks.back());
  return {.approach = {first + 5 * (left_of(in) - in), first},
          .blocks = std::move(blocks),
          .retract = {last, last + 5 * (left_of(out) + out)}};
}

// A pocket with an inside corner of few degrees, and an overrun along its first side that ends so
// far before that corner that the arc out may run through it. Every programmed side is a wall.
struct FlatCorner {
  double angle = 0;
  double side = 0;     // length of the first side
  double overrun = 0;  // how far the overrun goes along it
  double radius = 0;   // of the tool

  [[nodiscard]] std::vector<Segment> ring() const {
    const double far = 40 * radius;
    const std::vector<Point> corners{
        {0, 0},     {side, 0},   {side + far * std::cos(angle), far * std::sin(angle)},
        {far, far}, {-far, far}, {-far, 0},
        {0, 0}};
    std::vector<Segment> ring;
    for (std::size_t i = 1; i < corners.size(); ++i)
      ring.emplace_back(Line{.start = corners[i - 1], .end = corners[i]});
    return ring;
  }
  [[nodiscard]] std::string text(const std::string& mode) const {
    const double out = 1.02 * radius;  // of the arcs
    const auto at = [](double x, double y) {
      return " X" + std::to_string(x) + " Y" + std::to_string(y);
    };
    const auto arc = [&](const char* centre) { return std::string(centre) + std::to_string(out); };
    std::string text = mode + "\nV.G.WZ_AKT.R = " + std::to_string(radius) + "\nG0" +
                       at(3 * radius, 2 * out) + "\nG41 G1 F500" + at(0, 2 * out) + "\nG3" +
                       at(0, 0) + arc(" I0 J-") + "\nG1\n";
    for (const Segment& wall : ring()) text += at(end_of(wall).x(), end_of(wall).y()) + "\n";
    return text + at(overrun, 0) + "\nG3" + at(overrun, 2 * out) + arc(" I0 J") + "\nG40 G1" +
           at(-3 * radius, 2 * out) + "\nM30\n";
  }
};

TEST(Leads, OutThroughAFlatCornerAreToldWhereTheyCut) {
  std::size_t told = 0;
  std::size_t clear = 0;
  for (const double radius : {0.5, 2.0, 20.0})
    for (const double angle : {0.03, 0.1, 0.2, 0.3})
      for (const double before : {0.02, 0.05, 0.1, 0.5, 1.5, 4.0})
        for (const char* mode :
             {"G26\nG140", "G25\nG140", "G26\nG141\n#TRC[REMOVE_MASKED_BLOCKS=1]"}) {
          const FlatCorner pocket{.angle = angle,
                                  .side = 0.5 * radius + before,
                                  .overrun = 0.5 * radius,
                                  .radius = radius};
          SessionSetup session;
          session.verify = Verify::report;
          const ProgramRun outcome = to_blocks(pocket.text(mode), {.session = session});
          if (!outcome.diagnostics.empty()) {
            ++told;
            continue;
          }
          ++clear;
          const std::vector<Segment> ring = pocket.ring();
          for (const Point& point : samples_of(path_of(outcome)))
            ASSERT_GE(distance_from(ring, point), radius - 0.005) << pocket.text(mode);
        }
  EXPECT_GT(told, 20U);
  EXPECT_GT(clear, 20U);
}

TEST(Leads, ChangeNothingBetweenTheTwoVisitsOfTheClosingPoint) {
  std::size_t compared = 0;
  std::size_t with_loops = 0;
  for (std::uint64_t seed = 51'000'000; seed < 51'000'600 && !::testing::Test::HasFailure();
       ++seed) {
    Random random(seed);
    TrcMode mode;
    mode.side = Side::left;
    mode.tool_radius = random.between(0.5, 5);
    mode.transition = Transition::circular;
    mode.masking = Masking::on;
    mode.options.remove_masked_blocks = true;
    const std::vector<Segment> ring = random_ring(random, random.chance(0.5));
    const double overrun = random.chance(0.5) ? random.between(0.1, 3) : 0;
    const WithLeads leads =
        with_leads(ring, mode.tool_radius, random.between(1.2, 2) * mode.tool_radius, overrun);
    if (!leads.legal) continue;
    Feeding feeding;
    feeding.compensator = {.largest_masked_share = 1};
    const Outcome bare = compensate(contour_of(ring), mode, feeding);
    if (bare.stopped) continue;
    const Outcome outcome = compensate(contour_of(leads.blocks), mode, feeding);
    ASSERT_FALSE(outcome.stopped) << "seed " << seed << ": " << message_of(*outcome.error());
    expect_same_walls(path_of(outcome), path_of(bare), ring, mode.tool_radius, 1e-6, 1e-6);
    if (::testing::Test::HasFailure())
      ADD_FAILURE() << "seed " << seed << '\n'
                    << text_of(outcome.blocks) << "without leads\n"
                    << text_of(bare.blocks);
    ++compared;
    with_loops += count_of(bare, Code::blocks_masked) > 0 ? 1 : 0;
  }
  EXPECT_GT(compared, 100U);
  EXPECT_GT(with_loops, 20U);
}

}  // namespace
}  // namespace trc::support
