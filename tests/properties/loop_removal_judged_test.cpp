#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <iostream>
#include <numbers>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "tests/support/long_run.h"
#include "tests/support/run.h"
#include "tests/support/slow_masking.h"
#include "tests/support/slow_shapes.h"
#include "tests/support/small_contours.h"

// Loop removal (rule 5.1) on small contours that are as hard as they get, against
// judges that share no code with it. Each contour has a seed of its own, which a
// failure prints; TRC_TEST_LONG=1 takes more than a million.

namespace trc::support {
namespace {

constexpr double same_path = 1e-5;  // mm

// The path from the first to the last compensated point, without what has no length.
std::vector<CompensatedBlock> travelled(const Outcome& outcome) {
  std::vector<CompensatedBlock> path;
  if (outcome.stopped) return path;
  for (const CompensatedBlock& block : moving(outcome.blocks))
    if (block.origin == Origin::programmed || block.origin == Origin::transition)
      path.push_back(block);
  return path;
}

std::vector<Segment> segments_of(const std::vector<CompensatedBlock>& blocks) {
  std::vector<Segment> path;
  for (const CompensatedBlock& block : blocks) path.push_back(block.path);
  return path;
}
std::vector<Segment> segments_of(const SlowMasking& masking) {
  std::vector<Segment> path;
  for (const auto& piece : masking.path) path.push_back(piece.path);
  return path;
}

std::string story_of(const SmallContour& made, std::uint64_t seed) {
  std::ostringstream text;
  text << "seed " << seed << ", " << text_of(made.mode) << '\n' << made.contour;
  return text.str();
}
std::string story_of(const Outcome& outcome) {
  const Diagnostic* error = outcome.error();
  if (error == nullptr) return text_of(outcome.blocks);
  return "block " + std::to_string(error->source.number) + ": " + message_of(*error);
}
std::string story_of(const SlowMasking& masking) {
  std::ostringstream text;
  text.precision(12);
  if (masking.path.empty()) text << "no way\n";
  for (const auto& piece : masking.path) {
    const auto ends =
        std::visit([](const auto& shape) { return std::pair(shape.start, shape.end); }, piece.path);
    text << piece.ordinal << (piece.inserted ? " transition" : " programmed")
         << (is_arc(piece.path) ? " arc " : " line ") << ends.first.transpose() << " -> "
         << ends.second.transpose() << '\n';
  }
  return text.str();
}

// The blocks a path comes from, in its order: the number, and whether inserted
// after it.
using Origins = std::vector<std::pair<std::int64_t, bool>>;

void add(Origins& origins, const Segment& piece, std::int64_t number, bool inserted,
         double shortest) {
  if (static_cast<double>(shape_of(piece).extent) < shortest) return;
  if (origins.empty() || origins.back() != std::pair(number, inserted))
    origins.emplace_back(number, inserted);
}
Origins origins_of(const std::vector<CompensatedBlock>& path, double shortest) {
  Origins origins;
  for (const CompensatedBlock& block : path)
    add(origins, block.path, block.source.number, block.origin == Origin::transition, shortest);
  return origins;
}
Origins origins_of(const SlowMasking& masking, double shortest) {
  Origins origins;
  for (const auto& piece : masking.path)
    add(origins, piece.path, static_cast<std::int64_t>(piece.ordinal), piece.inserted, shortest);
  return origins;
}

bool in_order_within(const Origins& few, const Origins& many) {
  std::size_t k = 0;
  for (const auto& origin : many)
    if (k < few.size() && few[k] == origin) ++k;
  return k == few.size();
}

// Where two pieces part tangentially, the place depends on the last digits: so long
// may a piece be that only one of two equal paths has.
double longest_sliver(const SmallContour& made) {
  double size = made.mode.tool_radius;
  for (const Segment& block : made.contour.blocks)
    if (const auto* arc = std::get_if<Arc>(&block)) size += (arc->start - arc->center).norm();
  return 4 * same_path + 4 * std::sqrt(1e-9 * std::max(made.mode.tool_radius, 1.0) * size);
}

bool agree(const std::vector<CompensatedBlock>& path, const SlowMasking& masking,
           const SmallContour& made, double tolerance = same_path) {
  if (path.empty() || masking.path.empty()) return path.empty() && masking.path.empty();
  const double sliver = longest_sliver(made);
  return hausdorff(segments_of(path), segments_of(masking)) <= tolerance &&
         in_order_within(origins_of(path, sliver), origins_of(masking, 0)) &&
         in_order_within(origins_of(masking, sliver), origins_of(path, 0));
}

// Whether all of it lies on one of the ways.
bool is_part_of(const std::vector<CompensatedBlock>& path,
                std::initializer_list<const SlowMasking*> ways, double tolerance) {
  std::vector<Segment> of_ways;
  for (const SlowMasking* way : ways) {
    if (way->path.empty()) return false;
    const std::vector<Segment> pieces = segments_of(*way);
    of_ways.insert(of_ways.end(), pieces.begin(), pieces.end());
  }
  std::vector<Segment> all = segments_of(path);
  all.insert(all.end(), of_ways.begin(), of_ways.end());
  return hausdorff(all, of_ways) <= tolerance;
}

bool removed_something(const Outcome& outcome) {
  return std::any_of(outcome.diagnostics.begin(), outcome.diagnostics.end(),
                     [](const Diagnostic& d) { return d.code == Code::blocks_masked; });
}

class EveryHardship : public ::testing::TestWithParam<Hardship> {
 protected:
  // `share` of all contours, from a seed that is the same for every claim.
  template <class Claim>
  static void for_each_contour(double share, const Claim& claim) {
    const std::uint64_t first = 1'000'000 * (1 + static_cast<std::uint64_t>(GetParam()));
    const auto count = static_cast<std::uint64_t>(share * (is_long_run() ? 170'000 : 700));
    for (std::uint64_t seed = first; seed < first + count && !HasFailure(); ++seed) {
      Random random(seed);
      const SmallContour made = small_contour(random, GetParam());
      claim(made, seed);
    }
  }
};

// How a contour fares before the slow search.
enum class Verdict { same, undecided, different };

Verdict judged(const SmallContour& made, const Outcome& outcome, std::string& expected) {
  const auto path = travelled(outcome);
  const SlowMasking strict = slow_masking(made.contour, made.mode, {});
  if (agree(path, strict, made)) return Verdict::same;
  // The search may be generous with what joins: a wrong joint gives a path that
  // agrees with no connected one.
  SlowMasking generous;
  for (const MaskingScale& scale :
       {MaskingScale{.lenient = true}, MaskingScale{.joint = 1e-5},
        MaskingScale{.lenient = true, .joint = 1e-5}, MaskingScale{.joint = 1e-3},
        MaskingScale{.lenient = true, .joint = 1e-3}}) {
    generous = slow_masking(made.contour, made.mode, scale);
    if (!path.empty() && agree(path, generous, made)) return Verdict::same;
  }
  // In a cusp the path may go in and out again by a sliver, or not.
  const bool but_for_a_cusp = agree(path, strict, made, longest_sliver(made));
  // A mitre that just keeps clear may be there or not, at each corner anew.
  const bool but_for_mitres = made.mode.transition == Transition::linear && !path.empty() &&
                              is_part_of(path, {&strict, &generous}, longest_sliver(made));
  if (strict.shallow || strict.tied || generous.tied || strict.rounded || but_for_a_cusp ||
      but_for_mitres)
    return Verdict::undecided;
  expected = story_of(strict) + "or\n" + story_of(generous);
  return Verdict::different;
}

struct Tally {
  std::size_t contours = 0;
  std::size_t refused = 0;
  std::size_t removed = 0;
  std::size_t undecided = 0;
};

void judge(const SmallContour& made, std::uint64_t seed, Tally& tally) {
  const Outcome outcome = compensate(made.contour, made.mode);
  ++tally.contours;
  if (outcome.stopped) ++tally.refused;
  if (removed_something(outcome)) ++tally.removed;
  std::string expected;
  const Verdict verdict = judged(made, outcome, expected);
  if (verdict == Verdict::undecided) ++tally.undecided;
  if (verdict == Verdict::different)
    ADD_FAILURE() << story_of(made, seed) << "found\n"
                  << story_of(outcome) << "\nexpected\n"
                  << expected;
}

void expect_decided(const Tally& tally, std::size_t most_undecided) {
  EXPECT_LE(tally.undecided, most_undecided);
  EXPECT_GT(tally.contours, tally.refused);
  std::cout << tally.contours << " contours, " << tally.refused << " refused, " << tally.removed
            << " with blocks removed, " << tally.undecided << " undecided\n";
}

TEST_P(EveryHardship, GivesThePathOfTheSlowSearch) {
  Tally tally;
  for_each_contour(1,
                   [&](const SmallContour& made, std::uint64_t seed) { judge(made, seed, tally); });
  expect_decided(tally, tally.contours / 50);
}

// D-45: the path is the one with arcs, but for the arcs that linear transitions take the place of.
TEST_P(EveryHardship, GivesThePathOfTheSlowSearchWithLinearTransitions) {
  Tally tally;
  for_each_contour(1, [&](SmallContour made, std::uint64_t seed) {
    made.mode.transition = Transition::linear;
    made.mode.options.stretch_factor = static_cast<double>(1 + seed % 9);
    judge(made, seed, tally);
  });
  expect_decided(tally, tally.contours / 50);
}

bool is_closed(const Contour& contour) {
  return (start_of(contour.blocks.front()) - end_of(contour.blocks.back())).norm() <= 1e-3;
}

// What has to hold of whatever comes out.
void expect_sound(const Outcome& outcome, const SmallContour& made) {
  EXPECT_EQ(first_gap(outcome.blocks), "");
  if (const Diagnostic* error = outcome.error()) {
    EXPECT_TRUE(error->code == Code::line_reversed || error->code == Code::arc_wrapped)
        << message_of(*error);
    EXPECT_TRUE(error->point.has_value());
    EXPECT_GE(error->source.number, 1);
    EXPECT_LE(error->source.number, static_cast<std::int64_t>(made.contour.blocks.size()));
    return;
  }
  const auto path = travelled(outcome);
  std::int64_t last = 0;
  for (const CompensatedBlock& block : path) {
    EXPECT_GE(block.source.number, last) << "out of order";
    last = block.source.number;
  }
  if (path.empty()) return;
  const double radius = made.mode.tool_radius;
  const double tolerance = 1e-6 * std::max(radius, 1.0);
  const auto expect_clear = [&](std::span<const Segment> part, double allowed) {
    if (part.empty()) return;
    const LeastDistance least = least_distance(part, made.contour.blocks);
    EXPECT_GE(least.distance, radius - allowed)
        << "short by " << radius - least.distance << ", path block " << least.path_block
        << ", contour block " << least.contour_block << '\n'
        << text_of(outcome.blocks);
  };
  const std::vector<Segment> segments = segments_of(path);
  std::span<const Segment> strict = segments;
  if (is_closed(made.contour)) {
    // The first and the last point cannot move: the kink of the seam counts as nothing (D-44).
    expect_clear(strict, std::max(tolerance, std::min(1e-4, 0.01 * radius)));
    const double near_seam = 0.01 * std::max(radius, 0.1);
    const Point begin = start_of(segments.front());
    const Point end = end_of(segments.back());
    while (!strict.empty() && (start_of(strict.front()) - begin).norm() <= near_seam)
      strict = strict.subspan(1);
    while (!strict.empty() && (end_of(strict.back()) - end).norm() <= near_seam)
      strict = strict.first(strict.size() - 1);
  }
  expect_clear(strict, tolerance);
}

TEST_P(EveryHardship, NeverGougesTearsOrGoesBack) {
  for_each_contour(1, [](const SmallContour& made, std::uint64_t seed) {
    SCOPED_TRACE(story_of(made, seed));
    expect_sound(compensate(made.contour, made.mode), made);
  });
}

TEST_P(EveryHardship, NeverGougesTearsOrGoesBackWithLinearTransitions) {
  for_each_contour(0.3, [](SmallContour made, std::uint64_t seed) {
    made.mode.transition = Transition::linear;
    for (int factor = 1; factor <= 9; ++factor) {
      made.mode.options.stretch_factor = factor;
      SCOPED_TRACE(story_of(made, seed));
      expect_sound(compensate(made.contour, made.mode), made);
    }
  });
}

TEST_P(EveryHardship, IsTheSameInBatches) {
  for_each_contour(0.3, [](const SmallContour& made, std::uint64_t seed) {
    SCOPED_TRACE(story_of(made, seed));
    const Outcome one = compensate(made.contour, made.mode);
    for (const std::size_t batch : {std::size_t{0}, std::size_t{3}}) {
      const Outcome other = compensate(made.contour, made.mode, {.batch = batch});
      EXPECT_EQ(one.stopped, other.stopped);
      ASSERT_EQ(one.blocks.size(), other.blocks.size());
      for (std::size_t k = 0; k < one.blocks.size(); ++k)
        EXPECT_TRUE(one.blocks[k].path == other.blocks[k].path &&
                    one.blocks[k].source == other.blocks[k].source &&
                    one.blocks[k].origin == other.blocks[k].origin);
    }
  });
}

// A tiny arc in line with the block before it, as near as rounding lets it be, is no bow tie:
// neither for the passes, which a block at a time takes, nor for the short way.
TEST(LoopRemoval, IsTheSameInBatchesAfterATinyArcInLine) {  // D-44
  for (const std::uint64_t seed : {1'010'187U, 1'029'936U}) {
    Random random(seed);
    const SmallContour made = small_contour(random, Hardship::sizes);
    SCOPED_TRACE(story_of(made, seed));
    std::vector<Outcome> outcomes;
    for (const Engine engine : {Engine::passes, Engine::short_way}) {
      Feeding feeding{.batch = 0};
      feeding.compensator.engine = engine;
      outcomes.push_back(compensate(made.contour, made.mode, feeding));
    }
    EXPECT_EQ(outcomes[0].stopped, outcomes[1].stopped);
    EXPECT_EQ(text_of(outcomes[0].blocks), text_of(outcomes[1].blocks));
    ASSERT_EQ(outcomes[0].diagnostics.size(), 1U);
    EXPECT_EQ(message_of(outcomes[0].diagnostics[0]), message_of(outcomes[1].diagnostics[0]));
  }
}

// What is left of a block between two joints in one point may have no length, or that of a
// rounding.
bool is_nothing(const std::vector<Segment>& path) {
  return std::all_of(path.begin(), path.end(),
                     [](const Segment& piece) { return length_of(piece) <= same_path; });
}

// The ends of a block are rounded when it is turned; the shorter it is, the more it turns about
// them, and its equidistant with it.
double blur(const SmallContour& made) {
  constexpr double rounding = 1e-12;  // of coordinates of some metres
  double worst = 0;
  for (const Segment& block : made.contour.blocks)
    if (const double chord = (end_of(block) - start_of(block)).norm(); chord > 0)
      worst = std::max(worst, made.mode.tool_radius * rounding / chord);
  return worst;
}

TEST_P(EveryHardship, IsTheSameMirroredAndTurned) {
  std::size_t contours = 0;
  std::size_t undecided = 0;
  for_each_contour(0.5, [&](const SmallContour& made, std::uint64_t seed) {
    ++contours;
    const Motion motion{.mirrored = seed % 2 == 0,
                        .turn = seed % 3 == 0 ? 0 : std::numbers::pi / 7,
                        .shift = {3, -2}};
    SmallContour image = made;
    image.contour = motion(made.contour);
    if (motion.mirrored) image.mode.side = other(made.mode.side);
    const Outcome outcome = compensate(made.contour, made.mode);
    const Outcome mapped = compensate(image.contour, image.mode);
    std::vector<Segment> expected;
    for (const Segment& piece : segments_of(travelled(outcome))) expected.push_back(motion(piece));
    const auto found = segments_of(travelled(mapped));
    const bool same = is_nothing(expected) || is_nothing(found)
                          ? is_nothing(expected) == is_nothing(found)
                          : hausdorff(expected, found) <= longest_sliver(made) + blur(made);
    if (same) return;
    // Turning moves the last digits, which decide in ties.
    const SlowMasking judge = slow_masking(made.contour, made.mode, {});
    if (judge.shallow || judge.tied) {
      ++undecided;
      return;
    }
    ADD_FAILURE() << story_of(made, seed) << "gives\n"
                  << story_of(outcome) << "\nbut mirrored or turned\n"
                  << story_of(mapped);
  });
  EXPECT_LE(undecided, contours / 50);
}

INSTANTIATE_TEST_SUITE_P(LoopRemoval, EveryHardship, ::testing::ValuesIn(all_hardships),
                         [](const auto& param) { return name_of(param.param); });

// D-36. A wall along x with a slot of the given width, 5 R deep; the tool on the left.
SmallContour slot(double radius, double width, double turn) {
  SmallContour made;
  made.mode.side = Side::left;
  made.mode.tool_radius = radius;
  made.mode.selection = made.mode.deselection = Selection::direct;
  made.mode.transition = Transition::circular;
  made.mode.masking = Masking::on;
  made.mode.options.remove_masked_blocks = true;
  const Motion motion{.turn = turn};
  std::vector<Point> corners{{-2 * radius, 3 * radius},
                             {-3 * radius, 0},
                             {0, 0},
                             {0, -5 * radius},
                             {width, -5 * radius},
                             {width, 0},
                             {width + 3 * radius, 0},
                             {width + 5 * radius, 3 * radius}};
  for (Point& corner : corners) corner = motion(corner);
  made.contour.approach = {.start = corners[0], .end = corners[1]};
  for (std::size_t k = 1; k + 2 < corners.size(); ++k)
    made.contour.blocks.emplace_back(Line{.start = corners[k], .end = corners[k + 1]});
  made.contour.retract = {.start = corners[6], .end = corners[7]};
  return made;
}

TEST(LoopRemovalSlot, IsGoneIntoWhereItIsAsWideAsTheTool) {
  for (const double radius : {0.01, 0.5, 1.0, 3.7, 10.0, 250.0})
    for (const double turn : {0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0}) {
      const double tolerance = 1e-6 * std::max(radius, 1.0);
      const auto depth = [&](double extra) {
        const SmallContour made = slot(radius, 2 * radius + extra, turn);
        const Outcome outcome = compensate(made.contour, made.mode);
        EXPECT_FALSE(outcome.stopped) << story_of(made, 0);
        expect_sound(outcome, made);
        const Motion back{.turn = -turn};
        double deepest = 0;
        for (const CompensatedBlock& block : travelled(outcome))
          deepest = std::max(deepest, -back(point_at(block.path, 1)).y());
        return deepest;
      };
      SCOPED_TRACE("R " + std::to_string(radius) + ", turned by " + std::to_string(turn));
      // No block may be travelled backwards by more than D-14 allows either.
      const double least = -std::min(0.8 * tolerance, 0.9e-4);
      for (const double extra : {0.0, 1e-6, 1e-4, 0.5 * least, least})
        EXPECT_NEAR(depth(extra), 4 * radius, 3e-6 * std::max(radius, 1.0)) << extra;
      for (const double extra : {-1.2 * tolerance, -1e-4 * std::max(radius, 1.0)})
        EXPECT_LT(depth(extra), 0.1 * radius) << extra;
    }
}

// Its walls and its round end are off by less than D-36 allows.
TEST(LoopRemovalSlot, IsGoneIntoToItsRoundEnd) {
  for (const double radius : {0.5, 2.5, 10.0, 250.0})
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      Random random(seed);
      // No block may be travelled backwards by more than D-14 allows either.
      const double most = std::min(1.6e-7 * std::max(radius, 1.0), 1e-5);
      const auto off = [&](double x, double y) {
        return Point(x + random.between(-most, most), y);
      };
      const std::vector<Point> corners{
          {-3 * radius, 0},    off(0, 0),
          off(0, -5 * radius), off(2 * radius, -5 * radius + random.between(-most, most)),
          off(2 * radius, 0),  {5 * radius, 0}};
      SmallContour made = slot(radius, 2 * radius, 0);
      for (std::size_t k = 0; k + 1 < corners.size(); ++k)
        made.contour.blocks[k] = Line{.start = corners[k], .end = corners[k + 1]};
      made.contour.blocks[2] = Arc{.start = corners[2],
                                   .end = corners[3],
                                   .center = (corners[2] + corners[3]) / 2,
                                   .sweep = std::numbers::pi};
      const Outcome outcome = compensate(made.contour, made.mode);
      ASSERT_FALSE(outcome.stopped) << story_of(made, seed);
      expect_sound(outcome, made);
      double deepest = 0;
      for (const CompensatedBlock& block : travelled(outcome))
        deepest = std::max(deepest, -point_at(block.path, 1).y());
      EXPECT_NEAR(deepest, 5 * radius, 3e-6 * std::max(radius, 1.0)) << story_of(made, seed);
    }
}

// Technology words, the third main axis and a tracking axis (rule 5.1): words come
// out once and in order, each where the axes stand as programmed; what is not
// travelled is told.
TEST_P(EveryHardship, LosesNoWordAndNoTravelOfOtherAxes) {
  Feeding feeding;
  feeding.texts = [](std::size_t ordinal) {
    std::vector<std::string> texts;
    for (std::size_t k = 0; k < (ordinal * 5 + 1) % 3; ++k)
      texts.push_back("M" + std::to_string(10 * ordinal + k));
    return texts;
  };
  feeding.third = [](std::size_t ordinal) { return -0.5 * static_cast<double>(ordinal / 2); };
  feeding.tracking = [](std::size_t ordinal) { return 1.25 * static_cast<double>(ordinal); };
  for_each_contour(0.5, [&](SmallContour made, std::uint64_t seed) {
    if (seed % 2 == 1) made.mode.transition = Transition::linear;
    feeding.compensator.limits.look_ahead_blocks = seed % 3 == 0 ? 0 : seed % 7;
    SCOPED_TRACE(story_of(made, seed) + "window " + std::to_string(seed % 3 == 0 ? 0 : seed % 7));
    const Outcome outcome = compensate(made.contour, made.mode, feeding);
    if (outcome.stopped) return;
    EXPECT_EQ(first_gap(outcome.blocks), "");
    std::vector<std::string> expected;
    for (std::size_t ordinal = 0; ordinal < made.contour.blocks.size() + 2; ++ordinal)
      for (const std::string& text : feeding.texts(ordinal)) expected.push_back(text);
    std::vector<std::string> found;
    const CompensatedBlock* before = nullptr;
    for (const CompensatedBlock& block : outcome.blocks) {
      if (block.origin != Origin::passthrough) {
        before = &block;
        continue;
      }
      found.push_back(block.text);
      const auto ordinal = static_cast<std::size_t>(block.source.number);
      ASSERT_NE(before, nullptr);
      EXPECT_EQ(before->normal.to, feeding.third(ordinal)) << block.text;
      EXPECT_EQ(before->tracking.at(0).to, feeding.tracking(ordinal)) << block.text;
    }
    EXPECT_EQ(found, expected) << text_of(outcome.blocks);
    const std::size_t last = made.contour.blocks.size() + 1;
    ASSERT_NE(before, nullptr);
    EXPECT_EQ(before->normal.to, feeding.third(last));
    EXPECT_EQ(before->tracking.at(0).to, feeding.tracking(last));
  });
}

double value_of(const Diagnostic& note, std::string_view name) {
  for (const DiagnosticValue& value : note.values)
    if (value.name == name) return value.value;
  ADD_FAILURE() << "no " << name;
  return 0;
}

TEST_P(EveryHardship, NamesTheBlocksItRemoves) {
  for_each_contour(0.5, [](SmallContour made, std::uint64_t seed) {
    if (seed % 2 == 1) made.mode.transition = Transition::linear;
    SCOPED_TRACE(story_of(made, seed));
    const Outcome outcome = compensate(made.contour, made.mode);
    if (outcome.stopped) return;
    std::set<std::int64_t> named;
    for (const Diagnostic& note : outcome.diagnostics) {
      if (note.code != Code::blocks_masked) continue;
      EXPECT_TRUE(note.point.has_value());
      const auto first = static_cast<std::int64_t>(value_of(note, "first_number"));
      const auto last = static_cast<std::int64_t>(value_of(note, "last_number"));
      EXPECT_LE(first, last);
      for (std::int64_t number = first; number <= last; ++number)
        EXPECT_TRUE(named.insert(number).second) << number << " is named twice";
    }
    for (const CompensatedBlock& block : outcome.blocks) {
      if (block.origin != Origin::programmed) continue;
      EXPECT_EQ(named.count(block.source.number), 0U) << block.source.number;
    }
    std::set<std::int64_t> present = named;
    for (const CompensatedBlock& block : outcome.blocks) present.insert(block.source.number);
    for (std::size_t k = 1; k <= made.contour.blocks.size(); ++k)
      EXPECT_EQ(present.count(static_cast<std::int64_t>(k)), 1U)
          << k << " is neither there nor named";
  });
}

}  // namespace
}  // namespace trc::support
