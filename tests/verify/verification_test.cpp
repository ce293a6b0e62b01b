#include "core/verify/verification.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/session/program_session.h"

namespace trc::verify {
namespace {

// A bottleneck of 15 mm, which G140 does not see (rule 5): two selections, the second one sound.
constexpr const char* neck =
    "N10 G00 X-60 Y-80 F1000\n"
    "N20 V.G.WZ_AKT.R = 10\n"
    "N30 G41 G01 X-60 Y-40\n"
    "N40 X0\nN50 Y0\nN60 X50\nN70 Y-10\nN80 X90\nN90 Y25\nN100 X0\nN110 Y15\nN120 X-60\n"
    "N130 G40 X-90 Y50\n";
constexpr const char* step =
    "N10 G00 X0 Y-30 F1000\n"
    "N20 V.G.WZ_AKT.R = 10\n"
    "N30 G42 G01 X0 Y0\nN40 X50\nN50 Y50\nN60 G40 X100\n"
    "N70 G41 X100 Y100\nN80 X200\nN90 Y200\nN100 G40 X0 Y300\nM30\n";

struct Outcome {
  bool goes_on = true;
  std::vector<CompensatedBlock> path{};
  std::vector<Diagnostic> diagnostics{};
  ClearanceReport clearance{};
};

Outcome verified(const std::string& text, std::size_t piece, Verify verify = Verify::enforce) {
  ProgramSessionSetup setup{.nc_text = false};
  setup.session.verify = verify;
  ProgramSession session(setup);
  Outcome outcome;
  Answers answers;
  for (std::size_t at = 0; at < text.size() && outcome.goes_on; at += piece)
    outcome.goes_on = session.feed(std::string_view(text).substr(at, piece), answers);
  outcome.goes_on = outcome.goes_on && session.finish(answers);
  Answer out = answers.take();
  outcome.path = std::move(out.blocks);
  outcome.diagnostics = std::move(out.diagnostics);
  if (const auto* clearance = session.clearance()) outcome.clearance = *clearance;
  return outcome;
}

TEST(Verification, SaysHowNearThePathComes) {
  const Outcome outcome = verified(step, 1000);
  ASSERT_TRUE(outcome.goes_on);
  ASSERT_TRUE(outcome.clearance.worst);
  EXPECT_NEAR(outcome.clearance.worst->distance, 10, 1e-9);
  EXPECT_EQ(outcome.clearance.worst->required, 10);
  EXPECT_EQ(outcome.clearance.gouging, 0U);
  EXPECT_GE(outcome.clearance.checked, 4U);
}

TEST(Verification, NotAskedForMeasuresNothing) {
  ProgramSession session(ProgramSessionSetup{});
  EXPECT_EQ(session.clearance(), nullptr);
}

TEST(Verification, StopsAtAPathThatComesTooNear) {
  const Outcome outcome = verified(neck, 1000);
  EXPECT_FALSE(outcome.goes_on);
  ASSERT_EQ(outcome.diagnostics.size(), 1U);
  const Diagnostic& gouge = outcome.diagnostics[0];
  EXPECT_EQ(gouge.code, Code::clearance_violated);
  EXPECT_EQ(gouge.severity, Severity::error);
  ASSERT_TRUE(gouge.point);
  ASSERT_TRUE(outcome.clearance.worst);
  EXPECT_LT(outcome.clearance.worst->distance, 10);
  EXPECT_EQ(gouge.values[0].value, outcome.clearance.worst->distance);
  EXPECT_TRUE(verified(neck, 1000, Verify::off).goes_on);
}

// Half of the programs that are told of a gouge have the wrong side, or begin in such a corner.
TEST(Verification, SaysWhyAContourDamagesItselfWhereItCloses) {
  const std::string counter_clockwise = "N40 X80\nN50 Y50\nN60 X0\nN70 Y0\n";
  const std::string clockwise = "N40 Y50\nN50 X80\nN60 Y0\nN70 X0\n";
  const auto reason = [](const std::string& start, const std::string& side,
                         const std::string& contour, const std::string& radius = "6") {
    const Outcome outcome =
        verified("N10 G00 " + start + "\nN20 G138 V.G.WZ_AKT.R = " + radius + "\nN30 " + side +
                     " G01 X0 Y0 F450\n" + contour + "N80 G40 " + start + "\nN90 M30\n",
                 1000);
    return outcome.diagnostics.empty() ? std::string() : outcome.diagnostics.back().detail;
  };
  const std::string wrong_side =
      "the tool comes from the one side of the contour and cuts on the other";
  const std::string corner = "the contour closes in an inside corner, where no tool has room";
  for (const auto& [inside, contour] :
       {std::pair("G41", counter_clockwise), std::pair("G42", clockwise)}) {
    const std::string outside = inside == std::string("G41") ? "G42" : "G41";
    EXPECT_EQ(reason("X-18 Y-18", inside, contour), wrong_side);
    EXPECT_EQ(reason("X-18 Y-18", outside, contour, "-6"), wrong_side);
    EXPECT_EQ(reason("X40 Y25", inside, contour), corner);
    EXPECT_EQ(reason("X-18 Y-18", outside, contour), "");
  }
}

// What the caller asks for is not undone by a line of the program.
TEST(Verification, IsNotSwitchedOffByIgnoredContourDamage) {
  const std::string program = std::string("#TRC [IGNORE_CONT_DAMAGE=1]\n") + neck;
  const Outcome enforced = verified(program, 1000);
  EXPECT_FALSE(enforced.goes_on);
  ASSERT_FALSE(enforced.diagnostics.empty());
  EXPECT_EQ(enforced.diagnostics.back().code, Code::clearance_violated);
  EXPECT_EQ(enforced.diagnostics.back().severity, Severity::error);
  const Outcome reported = verified(program, 1000, Verify::report);
  EXPECT_TRUE(reported.goes_on);
  ASSERT_FALSE(reported.diagnostics.empty());
  EXPECT_EQ(reported.diagnostics.back().severity, Severity::warning);
}

// Nothing is compensated, so no measurement vouches for the tool.
TEST(Verification, VouchesForNothingUnderSuppressedCompensation) {
  const Outcome outcome = verified(std::string("#TRC [SUPPRESS_TRC=1]\n") + neck, 1000);
  EXPECT_TRUE(outcome.goes_on);
  EXPECT_EQ(outcome.clearance.checked, 0U);
  EXPECT_FALSE(outcome.clearance.worst);
  EXPECT_EQ(outcome.clearance.touched_length, 0);
}

TEST(Verification, DoesNotDependOnHowTheTextIsCut) {
  for (const char* program : {neck, step}) {
    const Outcome whole = verified(program, 10'000);
    for (const std::size_t piece : {1U, 7U, 40U}) {
      const Outcome cut = verified(program, piece);
      ASSERT_EQ(cut.path.size(), whole.path.size()) << "pieces of " << piece;
      EXPECT_EQ(cut.diagnostics.size(), whole.diagnostics.size());
      EXPECT_EQ(cut.clearance.checked, whole.clearance.checked);
      EXPECT_EQ(cut.clearance.gouging, whole.clearance.gouging);
    }
  }
}

TEST(Verification, ChangesNothingOfThePath) {
  const Outcome plain = verified(step, 1000, Verify::off);
  const Outcome checked = verified(step, 1000);
  ASSERT_EQ(plain.path.size(), checked.path.size());
  for (std::size_t i = 0; i < plain.path.size(); ++i)
    EXPECT_EQ(plain.path[i].path, checked.path[i].path);
}

// A path handed over that is not the one of the contour: what a fault of the compensation would
// look like.
TEST(Verification, FindsAPathThatWasMovedByAMicrometreOrTwo) {
  TrcMode mode;
  mode.side = Side::left;
  mode.tool_radius = 10;
  mode.selection_number = 1;
  const auto on = std::make_shared<const TrcMode>(mode);
  const Line approach{.start = {-10, 0}, .end = {0, 0}};
  const Line contour{.start = {0, 0}, .end = {100, 0}};
  for (const double moved : {0.0, 2e-3}) {
    Diagnostics diagnostics;
    Verification verification({.clearance = {.allowed = 1e-3}, .selection_blocks = 100},
                              diagnostics);
    verification.programmed(MotionBlock{.source = {.index = 0}, .path = approach, .mode = on});
    verification.programmed(MotionBlock{.source = {.index = 1}, .path = contour, .mode = on});
    const std::vector<CompensatedBlock> path{
        {.source = {.index = 1},
         .origin = Origin::programmed,
         .path = Line{.start = {0, 10 - moved}, .end = {100, 10 - moved}}}};
    EXPECT_TRUE(verification.compensated(path));
    EXPECT_EQ(verification.finish(), moved == 0);
    ASSERT_TRUE(verification.report().worst);
    EXPECT_NEAR(verification.report().worst->margin(), -moved, 1e-12);
  }
}

}  // namespace
}  // namespace trc::verify
