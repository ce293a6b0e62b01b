#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/survey/survey.h"
#include "tests/support/long_run.h"
#include "tests/support/run.h"

// What a survey says of random contours is what single runs say, bit for bit, and the largest
// radius is the one bisection over single runs finds. TRC_TEST_LONG=1 takes 50 times as many
// contours.
namespace trc::support {
namespace {

std::size_t scaled(std::size_t count) { return is_long_run() ? 50 * count : count; }

MoveRequest request_for(const Segment& segment, std::uint64_t index) {
  MoveRequest request{.source = {.index = index, .number = static_cast<std::int64_t>(index)}};
  request.feed = 1000;
  const Point& end = end_of(segment);
  request.end = {end.x(), end.y(), std::nullopt};
  const auto* arc = std::get_if<Arc>(&segment);
  if (arc == nullptr) return request;
  request.kind = arc->sweep > 0 ? MotionKind::counter_clockwise : MotionKind::clockwise;
  const Vector center = arc->center - arc->start;
  request.center = {center.x(), center.y(), std::nullopt};
  return request;
}

// Gives the contour to a state and ends it.
void give(const Contour& contour, Side side, ProgramState& state) {
  std::uint64_t index = 0;
  const auto move = [&](const Segment& segment) {
    return state.move(request_for(segment, index++));
  };
  bool goes_on = state.select(side, {}) && move(contour.approach);
  for (const Segment& block : contour.blocks) goes_on = goes_on && move(block);
  const Source end{.index = index};
  if (goes_on && state.deselect(end) && move(contour.retract)) state.end({.index = index});
}

SessionSetup session_for(const Contour& contour, const TrcMode& mode) {
  SessionSetup session{.compensator = all_walls(), .verify = Verify::enforce};
  session.program.mode = mode;
  session.program.mode.side = Side::off;
  session.program.start = {contour.approach.start.x(), contour.approach.start.y(), 0};
  return session;
}

struct Single {
  std::optional<Diagnostic> refusal{};
  Summary summary{};
  verify::ClearanceReport clearance{};
  bool leaves_out = false;

  [[nodiscard]] bool reaches_all() const {
    return !refusal && clearance.gouging == 0 && !leaves_out;
  }
};

Single single_run(const Contour& contour, const TrcMode& mode, double radius) {
  SessionSetup session = session_for(contour, mode);
  session.program.mode.tool_radius = radius;
  PathSession run(session);
  give(contour, mode.side, run.program());
  Answers out;
  if (run.advance(out)) run.finish({.index = contour.blocks.size() + 2}, out);
  Single result{.summary = run.summary(), .clearance = *run.clearance()};
  const Answer answer = out.take();
  for (const CompensatedBlock& block : answer.blocks)
    result.leaves_out |= block.origin == Origin::kerf;
  for (const Diagnostic& told : answer.diagnostics) {
    if (told.severity == Severity::error && !result.refusal) result.refusal = told;
    for (const DiagnosticValue& value : told.values)
      if (told.code == Code::blocks_masked && value.name == "left_out_length")
        result.leaves_out |= value.value > Tolerances{}.on_contour;
  }
  return result;
}

// Between a micrometre that reaches and one that does not.
double bisected(const Contour& contour, const TrcMode& mode, std::int64_t high) {
  std::int64_t low = 0;
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    const bool reaches =
        single_run(contour, mode, static_cast<double>(middle) / 1000).reaches_all();
    (reaches ? low : high) = middle;
  }
  return static_cast<double>(low) / 1000;
}

struct Asked {
  Contour contour{};
  TrcMode mode{};
};

Asked random_part(std::uint64_t seed) {
  Random random(seed);
  Asked asked;
  asked.mode.side = random.chance(0.5) ? Side::left : Side::right;
  asked.mode.tool_radius = random.between(1, 10);
  asked.mode.selection = Selection::direct;
  asked.mode.transition = random.chance(0.5) ? Transition::circular : Transition::linear;
  if (random.chance(0.4)) asked.mode.masking = Masking::on;
  asked.mode.options.remove_masked_blocks = random.chance(0.3);
  const Flavor flavor = all_flavors[random.below(std::size(all_flavors))];
  asked.contour = random.chance(0.5) ? random_clean_contour(random, flavor, asked.mode, 10)
                                     : random_contour(random, flavor, asked.mode, 10);
  return asked;
}

std::string story_of(std::uint64_t seed, const Asked& asked) {
  std::ostringstream story;
  story << "seed " << seed << ", " << text_of(asked.mode) << '\n' << asked.contour;
  return story.str();
}

survey::Survey survey_of(const Asked& asked) {
  return {survey::SurveySetup{.session = session_for(asked.contour, asked.mode)},
          [&asked](ProgramState& state, Diagnostics& /*log*/) {
            give(asked.contour, asked.mode.side, state);
          }};
}

TEST(SurveyOfRandomContours, GivesWhatSingleRunsGive) {
  std::size_t accepted = 0;
  std::size_t refused = 0;
  const std::size_t count = scaled(1500);
  for (std::uint64_t seed = 201'000'000; seed < 201'000'000 + count && !HasFailure(); ++seed) {
    const Asked asked = random_part(seed);
    SCOPED_TRACE(story_of(seed, asked));
    survey::Survey survey = survey_of(asked);
    if (!survey.read()) continue;
    for (const double share : {0.2, 0.7, 1.0, 1.6}) {
      const double radius = share * asked.mode.tool_radius;
      const survey::Surveyed found = survey.run(radius);
      const Single single = single_run(asked.contour, asked.mode, radius);
      SCOPED_TRACE("radius " + std::to_string(radius));
      ASSERT_EQ(found.accepted(), single.reaches_all() || !single.refusal);
      EXPECT_EQ(found.reaches_all, single.reaches_all());
      if (single.refusal) {
        ++refused;
        EXPECT_EQ(found.refusal->code, single.refusal->code);
        EXPECT_EQ(found.refusal->source, single.refusal->source);
        continue;
      }
      ++accepted;
      EXPECT_EQ(found.summary.compensated_length, single.summary.compensated_length);
      EXPECT_EQ(found.clearance.touched_length, single.clearance.touched_length);
      ASSERT_EQ(found.clearance.worst.has_value(), single.clearance.worst.has_value());
      if (single.clearance.worst) {
        EXPECT_EQ(found.clearance.worst->distance, single.clearance.worst->distance);
      }
    }
  }
  EXPECT_GT(accepted, count / 2);
  EXPECT_GT(refused, count / 4);
}

// Where a contour runs into itself, a larger tool may pass where a smaller one does not: there are
// several such radii then, and which of them is found is a matter of where the search begins.
TEST(SurveyOfRandomContours, FindsTheLargestRadiusThatBisectionFinds) {
  std::size_t limited = 0;
  std::size_t same = 0;
  const std::size_t count = scaled(150);
  for (std::uint64_t seed = 202'000'000; seed < 202'000'000 + count && !HasFailure(); ++seed) {
    const Asked asked = random_part(seed);
    SCOPED_TRACE(story_of(seed, asked));
    survey::Survey survey = survey_of(asked);
    if (!survey.read()) continue;
    // The list is not in whole micrometres.
    if (seed % 2 == 0) {
      static_cast<void>(survey.run(asked.mode.tool_radius));
      static_cast<void>(survey.run(0.4 * asked.mode.tool_radius));
    }
    const survey::Largest largest = survey.largest();
    if (!largest.is_limited) continue;
    ++limited;
    if (largest.radius > 0) {
      EXPECT_TRUE(single_run(asked.contour, asked.mode, largest.radius).reaches_all());
    }
    // The next whole micrometre, to the last bit: it may be the limit itself.
    const double next = (std::round(1000 * largest.radius) + 1) / 1000;
    EXPECT_FALSE(single_run(asked.contour, asked.mode, next).reaches_all());
    const auto high = static_cast<std::int64_t>(2000 * largest.radius) + 1000;
    if (single_run(asked.contour, asked.mode, static_cast<double>(high) / 1000).reaches_all())
      continue;
    const double found = bisected(asked.contour, asked.mode, high);
    same += std::abs(found - largest.radius) < 1e-6 ? 1 : 0;
  }
  EXPECT_GT(limited, count / 2);
  EXPECT_GT(same, limited * 9 / 10) << "of " << limited;
}

}  // namespace
}  // namespace trc::support
