#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "core/geometry/along.h"
#include "core/geometry/distance.h"
#include "core/messages/diagnostic_text.h"
#include "tests/support/long_run.h"
#include "tests/support/run.h"
#include "tests/support/slow_clearance.h"
#include "tests/support/slow_shapes.h"

// D-44: of a closed contour the path for rounded coordinates is that for the exact ones, or both
// are refused, however it lies in the plane and wherever it is begun. D-45: G25 is there wherever
// G26 is.

namespace trc::support {
namespace {

constexpr double pi = std::numbers::pi;

std::uint64_t contours_of_a_kind() { return is_long_run() ? 12'500 : 40; }

enum class Part { plate, slots, curve, gear };
constexpr Part all_parts[] = {Part::plate, Part::slots, Part::curve, Part::gear};

// Corners of a closed contour, counter-clockwise, as CAM systems write them. Some 40 mm wide.
std::vector<Point> corners_of(Part part, Random& random) {
  std::vector<Point> corners;
  const auto add = [&](double x, double y) { corners.emplace_back(x, y); };
  switch (part) {
    case Part::plate: {
      const double step = random.between(2, 8);
      add(0, 0);
      add(40, 0);
      add(40, 20 + step);
      add(30 + step, 20 + step);
      add(30 + step, 30);
      add(0, 30);
      break;
    }
    case Part::slots: {  // of any width, also some that the tool does not get into
      add(0, 0);
      add(60, 0);
      add(60, 20);
      double x = 55;
      while (x > 14) {
        const double width = random.between(1, 8);
        add(x, 20);
        add(x, 20 - random.between(2, 12));
        add(x - width, corners.back().y());
        add(x - width, 20);
        x -= width + random.between(3, 6);
      }
      add(0, 20);
      break;
    }
    case Part::curve: {  // short blocks
      const auto waves = static_cast<double>(2 + random.below(4));
      const double depth = random.between(0.02, 0.3);
      const std::size_t count = 60 + random.below(240);
      for (std::size_t k = 0; k < count; ++k) {
        const double angle = 2 * pi * static_cast<double>(k) / static_cast<double>(count);
        const double radius = 20 * (1 + depth * std::sin(waves * angle));
        add(radius * std::cos(angle), radius * std::sin(angle));
      }
      break;
    }
    case Part::gear: {
      const std::size_t teeth = 6 + random.below(20);
      const double depth = random.between(0.5, 5);
      for (std::size_t k = 0; k < teeth; ++k)
        for (const double share : {0.0, 0.2, 0.5, 0.7}) {
          const double angle =
              2 * pi * (static_cast<double>(k) + share) / static_cast<double>(teeth);
          const double radius = share < 0.4 ? 20 : 20 - depth;
          add(radius * std::cos(angle), radius * std::sin(angle));
        }
      break;
    }
  }
  return corners;
}

// A tool to the right of the contour goes round it outside.
struct Job {
  std::vector<Point> corners{};  // from the first point on; it is the last one as well
  Vector out = Vector::UnitX();  // where the tool comes from
  TrcMode mode{};
};

Job made(Part part, Random& random) {
  Job job;
  std::vector<Point> corners = corners_of(part, random);
  const Motion motion{.turn = random.between(0, 2 * pi),
                      .shift = {random.between(-50, 50), random.between(-50, 50)}};
  for (Point& corner : corners) corner = motion(corner);
  // Begun in the middle of an edge.
  const std::size_t first = random.below(corners.size());
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(first), corners.end());
  const Point begin =
      corners.back() + random.between(0.2, 0.8) * (corners.front() - corners.back());
  const Vector along = (corners.front() - corners.back()).normalized();
  corners.insert(corners.begin(), begin);
  job.corners = corners;
  job.out = Vector(along.y(), -along.x());
  job.mode.side = Side::right;
  job.mode.tool_radius = random.between(0.5, 4);
  job.mode.selection = job.mode.deselection = Selection::direct;
  job.mode.transition = random.chance(0.5) ? Transition::circular : Transition::linear;
  job.mode.masking = Masking::on;
  job.mode.options.remove_masked_blocks = true;
  return job;
}

Contour contour_of(const Job& job, double unit) {
  const auto rounded = [&](const Point& point) {
    if (unit == 0) return point;
    return Point(std::round(point.x() / unit) * unit, std::round(point.y() / unit) * unit);
  };
  Contour contour;
  const Point begin = rounded(job.corners.front());
  const Point outside = begin + 3 * job.mode.tool_radius * job.out;
  contour.approach = {.start = outside, .end = begin};
  for (std::size_t k = 0; k < job.corners.size(); ++k) {
    const Point start = rounded(job.corners[k]);
    const Point end = rounded(job.corners[(k + 1) % job.corners.size()]);
    if (start != end) contour.blocks.emplace_back(Line{.start = start, .end = end});
  }
  contour.retract = {.start = begin, .end = outside};
  return contour;
}

// As programs are written.
Outcome compensated(const Contour& contour, const TrcMode& mode) {
  Feeding feeding;
  feeding.compensator.leads.input_resolution = LeadSettings{}.input_resolution;
  return support::compensate(contour, mode, feeding);
}

std::vector<Segment> path_of(const Outcome& outcome) {
  std::vector<Segment> path;
  if (outcome.stopped) return path;
  for (const CompensatedBlock& block : moving(outcome.blocks))
    if (block.origin == Origin::programmed || block.origin == Origin::transition)
      path.push_back(block.path);
  return path;
}

double length_of_all(const std::vector<Segment>& path) {
  double length = 0;
  for (const Segment& piece : path) length += length_of(piece);
  return length;
}

// Whether a tool a little smaller or larger takes another way: a passage is as wide as the tool.
bool is_near_a_change(const Job& job) {
  const Contour contour = contour_of(job, 0);
  double shortest = 0;
  double longest = 0;
  for (const double more : {-0.005, 0.0, 0.005}) {
    TrcMode mode = job.mode;
    mode.tool_radius += more;
    mode.transition = Transition::circular;
    const double length = length_of_all(path_of(compensated(contour, mode)));
    shortest = more < 0 ? length : std::min(shortest, length);
    longest = std::max(longest, length);
  }
  return longest - shortest > 0.5;
}

// How far the path of a tool that is larger by this lies from that of one that is smaller by it:
// so far the path may move where all of the contour moves by as much. In a cusp that is more than
// the contour has moved.
// A closed contour begun on a short edge ends square to it, which turns more than it moves.
double play_of(const Job& job, double by) {
  const Contour contour = contour_of(job, 0);
  const double shortest =
      std::min(length_of(contour.blocks.front()), length_of(contour.blocks.back()));
  const double at_ends = by + 2 * by / shortest * job.mode.tool_radius;
  TrcMode mode = job.mode;
  mode.tool_radius = job.mode.tool_radius - by;
  const auto small = path_of(compensated(contour_of(job, 0), mode));
  mode.tool_radius = job.mode.tool_radius + by;
  const auto large = path_of(compensated(contour_of(job, 0), mode));
  return small.empty() || large.empty() ? 0 : std::max(at_ends, hausdorff(small, large));
}

template <class Claim>
void for_each_job(std::uint64_t first_seed, const Claim& claim) {
  for (const Part part : all_parts)
    for (std::uint64_t k = 0; k < contours_of_a_kind() && !::testing::Test::HasFailure(); ++k) {
      const std::uint64_t seed = first_seed + 100'000 * static_cast<std::uint64_t>(part) + k;
      Random random(seed);
      const Job job = made(part, random);
      std::ostringstream story;
      story << "seed " << seed << ", " << text_of(job.mode) << '\n';
      SCOPED_TRACE(story.str());
      claim(job);
    }
}

constexpr double inch = 25.4;

// Whether the tool at the first point and at the last one is clear of the contour: by 5 um, as a
// passage is, but of the blocks that meet there, which turn by the rounding of their ends, by less
// than a gouge (D-14).
bool has_room_at_the_ends(const Contour& contour, const TrcMode& mode) {
  const auto has_room_beside = [&](const Segment& end_block) {
    const Line& line = std::get<Line>(end_block);
    const Point& seam = start_of(contour.blocks.front());
    const Vector along = (line.end - line.start).normalized();
    const Point tool = seam + mode.tool_radius * Vector(along.y(), -along.x());
    return std::all_of(contour.blocks.begin(), contour.blocks.end(), [&](const Segment& block) {
      const bool meets = start_of(block) == seam || end_of(block) == seam;
      return slow_distance(tool, block) >= mode.tool_radius + (meets ? -1e-4 : 5e-3);
    });
  };
  return has_room_beside(contour.blocks.front()) && has_room_beside(contour.blocks.back());
}

// With circular transitions: at the end of a mitre the rounding of a short edge is longer than at
// its own end.
TEST(Rounding, OfCoordinatesDoesNotChangeThePath) {  // D-44
  std::size_t compared = 0;
  std::size_t left_out = 0;
  for_each_job(50'000'000, [&](Job job) {
    job.mode.transition = Transition::circular;
    const auto exact = path_of(compensated(contour_of(job, 0), job.mode));
    for (const double unit : {1e-3, 1e-4, 1e-4 * inch}) {
      const auto rounded = path_of(compensated(contour_of(job, unit), job.mode));
      ++compared;
      const bool same = exact.empty() || rounded.empty() ? exact.empty() == rounded.empty()
                                                         : hausdorff(exact, rounded) <= 3e-3;
      if (same) continue;
      const bool none = exact.empty() || rounded.empty();
      if (!none && hausdorff(exact, rounded) <= play_of(job, unit * std::numbers::sqrt2 / 2))
        continue;
      const bool starts = has_room_at_the_ends(contour_of(job, 0), job.mode) &&
                          has_room_at_the_ends(contour_of(job, unit), job.mode);
      if (!starts || is_near_a_change(job)) {
        ++left_out;
        continue;
      }
      std::ostringstream programs;
      programs << contour_of(job, unit);
      ADD_FAILURE() << "rounded to " << unit << " the path is "
                    << (exact.empty() || rounded.empty() ? -1 : hausdorff(exact, rounded))
                    << " off; lengths " << length_of_all(exact) << ", " << length_of_all(rounded)
                    << '\n'
                    << programs.str();
    }
  });
  EXPECT_LE(20 * left_out, compared);
  std::cout << compared << " compared, " << left_out << " beside a passage as wide as the tool\n";
}

// A corner in two points, less than the resolution of input apart, whose edges mostly cross.
Job with_a_tied_corner(Job job, Random& random) {
  const std::size_t at = 1 + random.below(job.corners.size() - 1);
  const double apart = std::pow(10.0, random.between(-5, -3.05));
  const double angle = random.between(0, 2 * pi);
  const Point corner = job.corners[at];
  const Point other = corner + apart * Point(std::cos(angle), std::sin(angle));
  const auto place = job.corners.begin() + static_cast<std::ptrdiff_t>(at + random.below(2));
  job.corners.insert(place, other);
  return job;
}

TEST(Rounding, ThatTiesACornerDoesNotChangeThePath) {  // D-44
  std::size_t compared = 0;
  std::size_t left_out = 0;
  std::uint64_t seed = 54'000'000;
  for_each_job(54'000'000, [&](Job job) {
    Random random(++seed);
    job.mode.transition = Transition::circular;
    if (random.chance(0.5)) {
      job.mode.side = Side::left;
      job.out = -job.out;
    }
    const auto exact = path_of(compensated(contour_of(job, 0), job.mode));
    if (exact.empty()) return;
    for (int tie = 0; tie < 5; ++tie) {
      const Contour tied = contour_of(with_a_tied_corner(job, random), 0);
      const Outcome outcome = compensated(tied, job.mode);
      const auto path = path_of(outcome);
      ++compared;
      if (!path.empty() && hausdorff(exact, path) <= 3e-3) continue;
      if (!path.empty() && hausdorff(exact, path) <= play_of(job, 1e-3)) continue;
      if (is_near_a_change(job)) {
        ++left_out;
        continue;
      }
      std::ostringstream program;
      program << tied;
      ADD_FAILURE() << (outcome.stopped ? message_of(*outcome.error()) : "another path") << '\n'
                    << program.str();
    }
  });
  EXPECT_LE(20 * left_out, compared);
  std::cout << compared << " compared, " << left_out << " beside a passage as wide as the tool\n";
}

// A point beside the way, anywhere, or beside the first or the last one.
Job with_a_block_hardly_there(Job job, Random& random) {
  const std::size_t at = random.below(job.corners.size());
  const double apart = std::pow(10.0, random.between(-6, -3.05));
  const double angle = random.between(0, 2 * pi);
  const Point other = job.corners[at] + apart * Point(std::cos(angle), std::sin(angle));
  const std::size_t behind = at == 0 && random.chance(0.5) ? job.corners.size() : at + 1;
  job.corners.insert(job.corners.begin() + static_cast<std::ptrdiff_t>(behind), other);
  return job;
}

TEST(Rounding, BlocksThatAreHardlyThereDecideNothing) {  // D-44, D-14
  std::size_t compared = 0;
  for (std::uint64_t seed = 56'000'000; seed < 56'000'000 + 4 * contours_of_a_kind(); ++seed) {
    Random random(seed);
    Job job = made(Part::plate, random);
    job.mode.transition = Transition::circular;
    if (random.chance(0.5)) {
      job.mode.side = Side::left;
      job.out = -job.out;
    }
    job.mode.options.remove_masked_blocks = random.chance(0.3);
    if (!job.mode.options.remove_masked_blocks && random.chance(0.5))
      job.mode.masking = Masking::off;
    const auto exact = path_of(compensated(contour_of(job, 0), job.mode));
    TrcMode plain = job.mode;
    plain.masking = Masking::off;
    // Beside blocks that G141 masks it masks another one.
    const bool masks = !job.mode.options.remove_masked_blocks &&
                       path_of(compensated(contour_of(job, 0), plain)).empty();
    if (exact.empty() || masks) continue;
    ++compared;
    const Contour contour = contour_of(with_a_block_hardly_there(job, random), 0);
    std::ostringstream story;
    story << "seed " << seed << ", " << text_of(job.mode) << '\n' << contour;
    SCOPED_TRACE(story.str());
    const Outcome outcome = compensated(contour, job.mode);
    ASSERT_FALSE(outcome.stopped) << message_of(*outcome.error());
    EXPECT_LE(hausdorff(exact, path_of(outcome)), 3e-3);
  }
  std::cout << compared << " compared\n";
  EXPECT_GT(compared, contours_of_a_kind());
}

TEST(Rounding, IsRefusedNowhereWhereTheToolHasRoomAtTheEnds) {  // D-44
  std::size_t refused = 0;
  for_each_job(51'000'000, [&](const Job& job) {
    for (const double unit : {0.0, 1e-3, 1e-4 * inch}) {
      const Contour contour = contour_of(job, unit);
      const Outcome outcome = compensated(contour, job.mode);
      if (!outcome.stopped) continue;
      ++refused;
      std::ostringstream programs;
      programs << contour;
      EXPECT_FALSE(has_room_at_the_ends(contour, job.mode)) << message_of(*outcome.error()) << '\n'
                                                            << programs.str();
    }
  });
  std::cout << refused << " refused\n";
}

// Straight edges and half circles of fine steps, begun in the middle of an edge, as a pocket or
// round a boss.
struct FineSteps {
  Job job{};
  Line between{};  // the centres of the half circles
  double radius = 0;

  // How far the path is from where it would be beside the half circles themselves, mm, at most.
  [[nodiscard]] double off_by(const std::vector<Segment>& path) const {
    const double apart = radius + (job.mode.side == Side::left ? -1 : 1) * job.mode.tool_radius;
    double most = 0;
    for (const Segment& block : path)
      for (const double share : {0.0, 0.5})
        most = std::max(
            most,
            std::abs(distance(point_along(block, share * length_of(block)), between) - apart));
    return most;
  }
};

FineSteps with_fine_steps(Random& random) {
  FineSteps made;
  made.radius = random.between(6, 30);
  const double half = random.between(5, 20);
  const double step = random.between(0.02, 0.15);
  const auto steps = static_cast<std::size_t>(pi * made.radius / step);
  const Motion motion{.turn = random.between(0, 2 * pi),
                      .shift = {random.between(-50, 50), random.between(-50, 50)}};
  made.between = {.start = motion(Point(-half, 0)), .end = motion(Point(half, 0))};
  Job& job = made.job;
  job.corners.push_back(motion(Point(0, -made.radius)));
  for (const double end : {1.0, -1.0})
    for (std::size_t k = 0; k <= steps; ++k) {
      const double angle = pi * (static_cast<double>(k) / static_cast<double>(steps) - end / 2);
      job.corners.push_back(
          motion(Point(end * half + made.radius * std::cos(angle), made.radius * std::sin(angle))));
    }
  const bool inside = random.chance(0.5);
  const Vector along = (job.corners[1] - job.corners[0]).normalized();
  // A start inside of a pocket has to fit into it.
  job.out = (inside ? -0.3 : 1.0) * Vector(along.y(), -along.x());
  job.mode.side = inside ? Side::left : Side::right;
  job.mode.tool_radius = random.between(0.5, 0.7 * made.radius);
  job.mode.selection = job.mode.deselection = Selection::direct;
  job.mode.transition = random.chance(0.5) ? Transition::circular : Transition::linear;
  job.mode.masking = random.chance(0.5) ? Masking::on : Masking::off;
  return made;
}

TEST(Rounding, OfFineStepsMakesNoCorners) {  // D-44
  for (std::uint64_t seed = 55'000'000; seed < 55'000'000 + contours_of_a_kind(); ++seed) {
    Random random(seed);
    const FineSteps made = with_fine_steps(random);
    const Job& job = made.job;
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + text_of(job.mode) + ", " +
                 std::to_string(job.corners.size()) + " corners");
    for (const double unit : {0.0, 1e-3, 1e-4}) {
      const Outcome outcome = compensated(contour_of(job, unit), job.mode);
      ASSERT_FALSE(outcome.stopped)
          << "rounded to " << unit << ": " << message_of(*outcome.error());
      EXPECT_LE(made.off_by(path_of(outcome)), 3e-3);
    }
  }
}

// Those half circles again, in arcs in place of chords.
Contour in_arcs(const FineSteps& steps, const Contour& chords) {
  Contour contour = chords;
  for (Segment& block : contour.blocks) {
    const Line line = std::get<Line>(block);
    if (length_of(line) > 1) continue;  // a straight edge
    const Vector half = 0.5 * (line.end - line.start);
    const double depth = std::sqrt(steps.radius * steps.radius - half.squaredNorm());
    const Point center = line.start + half + depth * left_of(half.normalized());
    block = Arc{.start = line.start,
                .end = line.end,
                .center = center,
                .sweep = 2 * std::asin(half.norm() / steps.radius)};
  }
  return contour;
}

TEST(Rounding, OfFineArcsMakesNoCorners) {  // D-44
  for (std::uint64_t seed = 60'000'000; seed < 60'000'000 + contours_of_a_kind() / 4; ++seed) {
    Random random(seed);
    const FineSteps made = with_fine_steps(random);
    const Job& job = made.job;
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + text_of(job.mode) + ", " +
                 std::to_string(job.corners.size()) + " corners");
    for (const double unit : {0.0, 1e-3, 1e-4}) {
      const Outcome outcome = compensated(in_arcs(made, contour_of(job, unit)), job.mode);
      ASSERT_FALSE(outcome.stopped)
          << "rounded to " << unit << ": " << message_of(*outcome.error());
      EXPECT_LE(made.off_by(path_of(outcome)), 3e-3);
    }
  }
}

// A round pocket in exact steps, hardly larger than the tool: its corners leave next to nothing of
// the lines, and all of them stay.
TEST(Rounding, ThatIsNoneChangesNothingOfFineSteps) {  // D-44
  for (std::uint64_t seed = 59'000'000; seed < 59'000'000 + contours_of_a_kind(); ++seed) {
    Random random(seed);
    const double radius = random.between(1, 20);
    const double step = std::pow(10, random.between(-4, -1));
    const auto steps =
        std::min<std::size_t>(static_cast<std::size_t>(2 * pi * radius / step), 2000);
    Job job;
    for (std::size_t k = 0; k < steps; ++k)
      job.corners.push_back(radius * Point(std::cos(step / radius * static_cast<double>(k)),
                                           std::sin(step / radius * static_cast<double>(k))));
    job.mode.side = Side::left;
    job.mode.tool_radius = radius - std::pow(10, random.between(-4, -0.5));
    job.mode.selection = job.mode.deselection = Selection::direct;
    job.mode.masking = random.chance(0.5) ? Masking::on : Masking::off;
    Contour contour = contour_of(job, random.chance(0.5) ? 1e-10 : 0);
    contour.blocks.pop_back();  // open
    contour.retract.start = end_of(contour.blocks.back());
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + text_of(job.mode) + ", step " +
                 std::to_string(step));
    const Outcome given = support::compensate(contour, job.mode, {});
    ASSERT_FALSE(given.stopped);
    EXPECT_EQ(
        difference(compensated(contour, job.mode).blocks, given.blocks, trc::support::Motion{}, 0),
        "");
  }
}

TEST(Rounding, LeavesLinearTransitionsWhereCircularOnesAre) {  // D-45
  for_each_job(52'000'000, [&](const Job& job) {
    for (const double unit : {0.0, 1e-3}) {
      const Contour contour = contour_of(job, unit);
      TrcMode mode = job.mode;
      mode.transition = Transition::circular;
      const Outcome arcs = compensated(contour, mode);
      mode.transition = Transition::linear;
      const Outcome lines = compensated(contour, mode);
      ASSERT_EQ(arcs.stopped, lines.stopped);
      EXPECT_EQ(first_gap(lines.blocks), "");
      // What is left of a block may be next to nothing until a mitre lengthens it.
      const auto numbers = [](const Outcome& outcome, double shortest) {
        std::vector<std::int64_t> found;
        for (const CompensatedBlock& block : moving(outcome.blocks, shortest))
          if (block.origin == Origin::programmed) found.push_back(block.source.number);
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
      };
      const auto of_arcs = numbers(arcs, 1e-5);
      const auto of_lines = numbers(lines, 0);
      EXPECT_TRUE(std::includes(of_lines.begin(), of_lines.end(), of_arcs.begin(), of_arcs.end()));
    }
  });
}

}  // namespace
}  // namespace trc::support
