#include "core/base/entry_help.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/geometry/segment.h"
#include "core/nc/text/number_format.h"
#include "tests/support/program_run.h"

// What a refusal at the approach or the retract proposes instead.

namespace trc::support {
namespace {

std::string text_of(const DiagnosticPoint& point) {
  std::string text;
  append_fixed(text, point.x, 3);
  text += ' ';
  append_fixed(text, point.y, 3);
  if (point.z != 0) {
    text += ' ';
    append_fixed(text, point.z, 3);
  }
  return text;
}

// "from X Y: to X Y, arc to X Y about X Y"
std::string text_of(const EntryProposal& proposal) {
  std::string text = "from " + text_of(proposal.start) + ":";
  for (const ProposedBlock& block : proposal.blocks) {
    text += block.center ? (block.sweep > 0 ? " ccw to " : " cw to ") : " to ";
    text += text_of(block.end);
    if (block.center) text += " about " + text_of(*block.center);
    text += ';';
  }
  return text;
}

struct Refused {
  int code = 0;
  EntryHelp help{};
};

Refused refused(const std::string& program) {
  const ProgramRun run = to_blocks(program);
  if (run.diagnostics.empty()) return {};
  const Diagnostic& last = run.diagnostics.back();
  return {.code = static_cast<int>(last.code),
          .help = last.entry_help ? *last.entry_help : EntryHelp{}};
}

// 5 mm where R is 10, and alpha 163 degrees: the line has to reach R before the corner.
TEST(EntryHelp, MakesTheSelectionBlockOfG236AsLongAsItMustBe) {  // D-122
  const auto [code, help] =
      refused("G0 X0 Y0 F1000\nV.G.WZ_AKT.R=10\nG236\nG41 G1 X5\nX60 Y10\nG40\nX120 Y30\nM30\n");
  EXPECT_EQ(code, 900201);
  EXPECT_FALSE(help.leaves);
  EXPECT_DOUBLE_EQ(help.given_length, 5);
  EXPECT_DOUBLE_EQ(help.needed_length, 10);
  EXPECT_EQ(help.tried_on, 1U);
  ASSERT_TRUE(help.legal);
  EXPECT_EQ(text_of(*help.legal), "-5.000 0.000");
  ASSERT_EQ(help.proposals.size(), 2U);
  EXPECT_EQ(help.proposals[0].shape, EntryProposal::Shape::line);
  EXPECT_EQ(text_of(help.proposals[0]), "from -5.000 0.000: to 5.000 0.000;");
}

// Along +X at the corner: C = (5, 20) and A = (-15, 20) for a circle of 20.
TEST(EntryHelp, ProposesAQuarterCircleOnTheToolSide) {
  const auto left =
      refused("G0 X0 Y0 F1000\nV.G.WZ_AKT.R=10\nG236\nG41 G1 X5\nX60\nG40\nX120\nM30\n");
  ASSERT_EQ(left.help.proposals.size(), 2U);
  EXPECT_EQ(left.help.proposals[1].shape, EntryProposal::Shape::quarter_circle);
  EXPECT_EQ(text_of(left.help.proposals[1]),
            "from 5.000 20.000: to -15.000 20.000; ccw to 5.000 0.000 about 5.000 20.000;");
  const auto right =
      refused("G0 X0 Y0 F1000\nV.G.WZ_AKT.R=10\nG236\nG42 G1 X5\nX60\nG40\nX120\nM30\n");
  ASSERT_EQ(right.help.proposals.size(), 2U);
  EXPECT_EQ(text_of(right.help.proposals[1]),
            "from 5.000 -20.000: to -15.000 -20.000; cw to 5.000 0.000 about 5.000 -20.000;");
}

// Below 90 degrees up to the equidistant: 10 / sin 45 degrees.
TEST(EntryHelp, KnowsTheLengthToTheEquidistant) {
  const auto [code, help] =
      refused("G0 X0 Y0 F1000\nV.G.WZ_AKT.R=10\nG236\nG41 G1 X5\nX-45 Y50\nG40\nX-120 Y50\nM30\n");
  EXPECT_EQ(code, 900201);
  EXPECT_NEAR(help.needed_length, 14.1421356, 1e-6);
  ASSERT_TRUE(help.legal);
  EXPECT_LE(help.legal->x, 5 - help.needed_length);
  EXPECT_GT(help.legal->x, 5 - help.needed_length - 0.003);
}

TEST(EntryHelp, ProposesTheWayOffTheContourToo) {
  const auto [code, help] =
      refused("G0 X-30 Y0 F1000\nV.G.WZ_AKT.R=10\nG236\nG41 G1 X0\nX60\nG40\nX64\nM30\n");
  EXPECT_EQ(code, 900201);
  EXPECT_TRUE(help.leaves);
  EXPECT_DOUBLE_EQ(help.given_length, 4);
  EXPECT_DOUBLE_EQ(help.needed_length, 10);
  ASSERT_TRUE(help.legal);
  EXPECT_EQ(text_of(*help.legal), "70.000 0.000");
  ASSERT_EQ(help.proposals.size(), 2U);
  EXPECT_EQ(text_of(help.proposals[0]), "from 60.000 0.000: to 70.000 0.000;");
  EXPECT_EQ(text_of(help.proposals[1]),
            "from 60.000 0.000: ccw to 80.000 20.000 about 60.000 20.000; to 60.000 20.000;");
}

TEST(EntryHelp, IsGivenInThePlaneOfTheSelection) {
  const auto [code, help] =
      refused("G18\nG0 X0 Y7 Z0 F1000\nV.G.WZ_AKT.R=10\nG236\nG41 G1 Z5\nZ60\nG40\nZ120\nM30\n");
  EXPECT_EQ(code, 900201);
  ASSERT_TRUE(help.legal);
  EXPECT_EQ(help.legal->x, 0);
  EXPECT_EQ(help.legal->y, 7);
  EXPECT_EQ(help.legal->z, -5);
}

// A square of 20 and R = 6: the only point 6 away from two sides, next to (-7, -7), is (-4, -4).
TEST(EntryHelp, FindsAFreeStartForG238) {
  const auto [code, help] = refused(
      "G0 X-7 Y-7 F1000\nV.G.WZ_AKT.R=6\nG238\nG41 G1 X-10 Y-10\nX10\nY10\nX-10\nY-10\nG40 X0 Y0\n"
      "M30\n");
  EXPECT_EQ(code, 90123);
  EXPECT_EQ(help.needed_length, 0);
  EXPECT_EQ(help.tried_on, 4U);
  ASSERT_TRUE(help.legal);
  EXPECT_NEAR(help.legal->x, -4, 0.05);
  EXPECT_NEAR(help.legal->y, -4, 0.05);
  EXPECT_GE(help.legal->x, -4);
  EXPECT_GE(help.legal->y, -4);
  ASSERT_EQ(help.proposals.size(), 1U);
}

// A tool as large as the square leaves no point free.
TEST(EntryHelp, OffersNothingWhereNothingWouldDo) {
  const auto [code, help] = refused(
      "G0 X-7 Y-7 F1000\nV.G.WZ_AKT.R=11\nG238\nG41 G1 X-10 Y-10\nX10\nY10\nX-10\nY-10\n"
      "G40 X0 Y0\nM30\n");
  EXPECT_EQ(code, 90123);
  EXPECT_FALSE(help.legal);
  EXPECT_TRUE(help.proposals.empty());
}

// Around the outside of the square. On the way to (-10, -16), which is P, the corner has to be 6
// off.
TEST(EntryHelp, FindsAStartOnTheToolSideForG238) {
  const auto [code, help] = refused(
      "G0 X-60 Y20 F1000\nV.G.WZ_AKT.R=6\nG238\nG42 G1 X-10 Y-10\nX10\nY10\nX-10\nY-10\nG40 X0 "
      "Y-40\n"
      "M30\n");
  EXPECT_EQ(code, 90130);
  ASSERT_TRUE(help.legal);
  const Vector way = Vector(-10 - help.legal->x, -16 - help.legal->y).normalized();
  EXPECT_NEAR(cross(way, Vector(0, 6)), 6, 1e-3);
  EXPECT_LT(help.legal->y, -10 - 1e-3);
}

// From the tool side, where G138 needs a line.
TEST(EntryHelp, ProposesALineInPlaceOfACircularApproach) {  // D-122
  const auto [code, help] =
      refused("G0 X0 Y4 F1000\nV.G.WZ_AKT.R=3\nG41 G2 X20 Y0 I10 J-2\nM8\nG1 X40\nG40 X60\nM30\n");
  EXPECT_EQ(code, 90008);
  EXPECT_FALSE(help.leaves);
  EXPECT_EQ(help.needed_length, 0);
  EXPECT_FALSE(help.legal);
  ASSERT_EQ(help.proposals.size(), 2U);
  EXPECT_EQ(text_of(help.proposals[0]), "from 0.000 4.000: to 20.000 0.000;");
  EXPECT_EQ(text_of(help.proposals[1]),
            "from 20.000 6.000: to 14.000 6.000; ccw to 20.000 0.000 about 20.000 6.000;");
}

// From below the line would lead through the wall: two radii off it, one before its start.
TEST(EntryHelp, ProposesALineFromTheToolSide) {
  const auto [code, help] =
      refused("G0 X24 Y-2 F1000\nV.G.WZ_AKT.R=3\nG41 G2 X20 Y0 I-2 J1\nG1 X40\nG40 X60\nM30\n");
  EXPECT_EQ(code, 90008);
  ASSERT_EQ(help.proposals.size(), 2U);
  EXPECT_EQ(text_of(help.proposals[0]), "from 17.000 6.000: to 20.000 0.000;");
}

TEST(EntryHelp, ProposesALineInPlaceOfACircularRetract) {
  const auto [code, help] = refused(
      "G0 X0 Y0 F1000\nV.G.WZ_AKT.R=3\nG41 G1 X20\nX40\nG40 G2 X60 Y4 I10 J2\nG1 X80\nM30\n");
  EXPECT_EQ(code, 900203);
  EXPECT_TRUE(help.leaves);
  ASSERT_EQ(help.proposals.size(), 2U);
  EXPECT_EQ(text_of(help.proposals[0]), "from 40.000 0.000: to 60.000 4.000;");
  EXPECT_EQ(text_of(help.proposals[1]),
            "from 40.000 0.000: ccw to 46.000 6.000 about 40.000 6.000; to 40.000 6.000;");
}

// Under G238 with the whole contour, from the programmed point, which is free.
TEST(EntryHelp, ProposesALineInPlaceOfACircleUnderG238) {
  const auto [code, help] = refused(
      "G0 X0 Y0 F1000\nV.G.WZ_AKT.R=6\nG238\nG41 G2 X-10 Y-10 I-5 J-5\nG1 X10\nY10\nX-10\nY-10\n"
      "G40 X0 Y0\nM30\n");
  EXPECT_EQ(code, 90008);
  EXPECT_EQ(help.tried_on, 4U);
  ASSERT_EQ(help.proposals.size(), 1U);
  EXPECT_EQ(text_of(help.proposals[0]), "from 0.000 0.000: to -10.000 -10.000;");
}

// From a point on the tangent no arc of G05 comes.
TEST(EntryHelp, ProposesAStartThatG05CanComeFrom) {
  const auto in =
      refused("G0 X40 Y25 F1000\nV.G.WZ_AKT.R=5\nG41 G05 G1 X20 Y20\nX60\nG40 X80 Y25\nM30\n");
  EXPECT_EQ(in.code, 900202);
  ASSERT_TRUE(in.help.legal);
  EXPECT_EQ(text_of(*in.help.legal), "15.000 30.000");
  ASSERT_EQ(in.help.proposals.size(), 2U);
  EXPECT_EQ(text_of(in.help.proposals[0]), "from 15.000 30.000: to 20.000 20.000;");
  const auto out =
      refused("G0 X0 Y25 F1000\nV.G.WZ_AKT.R=5\nG41 G1 X20 Y20\nX60\nG40 G05 X30 Y25\nM30\n");
  EXPECT_EQ(out.code, 900202);
  EXPECT_TRUE(out.help.leaves);
  ASSERT_FALSE(out.help.proposals.empty());
  EXPECT_EQ(text_of(out.help.proposals[0]), "from 60.000 20.000: to 65.000 30.000;");
}

TEST(EntryHelp, IsTheSameHoweverTheTextIsCut) {
  const std::string program =
      "G0 X0 Y0 F1000\nV.G.WZ_AKT.R=10\nG236\nG41 G1 X5\nX60 Y10\nX70 Y40\nX20 Y60\nG40\nX120 "
      "Y30\nM30\n";
  for (const std::size_t cut : {0U, 1U, 7U}) {
    const ProgramRun run = to_text(program, {}, cut);
    ASSERT_FALSE(run.diagnostics.empty());
    ASSERT_TRUE(run.diagnostics.back().entry_help) << cut;
    EXPECT_EQ(run.diagnostics.back().entry_help->tried_on, 2U) << cut;
  }
}

// A pocket of 100, entered and left in the middle of a wall.
std::string pocket(const std::string& way_in, const std::string& way_out) {
  return "V.G.WZ_AKT.R=10 F1000\n#TRC[REMOVE_MASKED_BLOCKS=1]\nG141\n" + way_in +
         "\nG1 X50\nY50\nX-50\nY-50\nX0\n" + way_out + "\nM30\n";
}

// The tool of 10 does not fit into a circle of 4: it would begin behind the wall.
TEST(EntryHelp, ReplacesLeadsTheToolDoesNotFitInto) {  // D-122
  const std::string small_in = "G0 X0 Y-46\nG41 G1 X-4\nG3 X0 Y-50 I4";
  const std::string small_out = "G3 X4 Y-46 J4\nG40 G1 X0";
  const std::string large_out = "G3 X20 Y-30 J20\nG40 G1 X0";
  const std::string quarter =
      "from 0.000 -30.000: to -20.000 -30.000; ccw to 0.000 -50.000 about 0.000 -30.000;";
  const auto one = refused(pocket(small_in, large_out));
  EXPECT_EQ(one.code, 90038);
  ASSERT_EQ(one.help.proposals.size(), 1U);
  EXPECT_EQ(text_of(one.help.proposals[0]), quarter);
  EXPECT_EQ(one.help.replaced, 1U);
  EXPECT_EQ(one.help.left_out, 0U);
  // The program takes the way in that is proposed.
  const std::string large_in = "G0 X0 Y-30\nG41 G1 X-20\nG3 X0 Y-50 I20";
  EXPECT_FALSE(to_blocks(pocket(large_in, large_out)).stopped);
  // A way out that is as small has to be replaced as well.
  const auto both = refused(pocket(small_in, small_out));
  ASSERT_EQ(both.help.proposals.size(), 1U);
  EXPECT_EQ(text_of(both.help.proposals[0]), quarter);
  EXPECT_EQ(both.help.left_out, 1U);
  EXPECT_FALSE(to_blocks(pocket(large_in, "G40 G1 X0 Y-30")).stopped);
  // Where the way in is sound, no other one is proposed.
  EXPECT_TRUE(refused(pocket(large_in, small_out)).help.proposals.empty());
}

// Where the lead that is replaced came down, the proposed way comes down as far.
TEST(EntryHelp, KeepsTheHeightAtWhichTheContourBegins) {
  const auto [code, help] = refused(
      pocket("G0 X0 Y-46 Z5\nG41 G1 X-4 Z2\nG3 X0 Y-50 I4 Z-3", "G3 X20 Y-30 J20\nG40 G1 X0 Z5"));
  EXPECT_EQ(code, 90038);
  ASSERT_EQ(help.proposals.size(), 1U);
  EXPECT_EQ(text_of(help.proposals[0]),
            "from 0.000 -30.000 5.000: to -20.000 -30.000 2.000; ccw to 0.000 -50.000 -3.000 about "
            "0.000 -30.000 2.000;");
}

const std::string square_from_corner =
    "G0 X20 Y20 F1000\nV.G.WZ_AKT.R=5\nG138\nG41 G1 X0 Y0\nX50\nY50\nX0\nY0\nG40 X20 Y20\nM30\n";

std::string with_g238(std::string program) {
  return program.replace(program.find("G138"), 4, "G238");
}

// At an inside corner the tool has no room beside the start, however small it is (rule 3.2).
TEST(EntryHelp, ProposesG238WhereTheContourBeginsInAnInsideCorner) {
  for (const Verify verify : {Verify::report, Verify::enforce}) {
    ProgramSessionSetup setup{.session = {.verify = verify}, .nc_text = false};
    const ProgramRun run = to_blocks(square_from_corner, setup);
    ASSERT_FALSE(run.diagnostics.empty());
    const Diagnostic& told = run.diagnostics.back();
    EXPECT_EQ(told.code, Code::clearance_violated);
    EXPECT_EQ(run.stopped, verify != Verify::report);
    ASSERT_TRUE(told.entry_help);
    ASSERT_EQ(told.entry_help->proposals.size(), 1U);
    EXPECT_EQ(told.entry_help->proposals[0].shape, EntryProposal::Shape::inside_corner);
    EXPECT_EQ(text_of(told.entry_help->proposals[0]), "from 20.000 20.000: to 0.000 0.000;");
    // The program takes what is proposed.
    const ProgramRun sound = to_blocks(with_g238(square_from_corner), setup);
    EXPECT_FALSE(sound.stopped);
    EXPECT_TRUE(sound.diagnostics.empty());
  }
}

TEST(EntryHelp, ProposesG238WithAStartThatIsFree) {
  std::string near = square_from_corner;
  near.replace(near.find("X20 Y20"), 7, "X20 Y1");
  const ProgramRun run = to_blocks(near, {.session = {.verify = Verify::enforce}});
  ASSERT_TRUE(run.diagnostics.back().entry_help);
  const EntryProposal& proposal = run.diagnostics.back().entry_help->proposals.at(0);
  EXPECT_EQ(proposal.shape, EntryProposal::Shape::inside_corner);
  EXPECT_NEAR(proposal.start.x, 20, 0.1);
  EXPECT_NEAR(proposal.start.y, 5, 1e-3);
  EXPECT_GE(proposal.start.y, 5);
}

TEST(EntryHelp, ProposesG238WhereLoopsAreRemoved) {
  const std::string removing = "G141\n#TRC[REMOVE_MASKED_BLOCKS=1]\n";
  const auto [code, help] = refused(removing + square_from_corner);
  EXPECT_EQ(code, 90019);
  ASSERT_EQ(help.proposals.size(), 1U);
  EXPECT_EQ(help.proposals[0].shape, EntryProposal::Shape::inside_corner);
  EXPECT_FALSE(to_blocks(removing + with_g238(square_from_corner)).stopped);
}

// Random pockets, begun in a corner: with the proposal the program is accepted and measured clear.
TEST(EntryHelp, ProposesG238ThatIsClearEverywhere) {
  std::mt19937_64 random(48);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto place = [](double x, double y) {
    std::string text = "X";
    append_fixed(text, x, 4);
    text += " Y";
    append_fixed(text, y, 4);
    return text;
  };
  constexpr int rounds = 400;
  int helped = 0;
  for (int round = 0; round < rounds; ++round) {
    const int corners = 3 + round % 6;
    std::vector<std::string> contour;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * (k + between(0, 0.4)) / corners;
      const double away = between(20, 50);
      contour.push_back(place(away * std::cos(angle), away * std::sin(angle)));
    }
    const auto program = [&](const std::string& mode, const std::string& start) {
      std::string text =
          "G0 " + start + "\nV.G.WZ_AKT.R=4\n" + mode + "\nG41 G1 F500 " + contour[0];
      for (int k = 1; k <= corners; ++k)
        text += "\n" + contour[static_cast<std::size_t>(k % corners)];
      return text + "\nG40 X0 Y0\nM30\n";
    };
    const ProgramSessionSetup setup{.session = {.verify = Verify::enforce}, .nc_text = false};
    const std::string given = program("G138", place(between(-9, 9), between(-9, 9)));
    SCOPED_TRACE("round " + std::to_string(round) + "\n" + given);
    const ProgramRun run = to_blocks(given, setup);
    if (!run.stopped || !run.diagnostics.back().entry_help) continue;
    const auto& proposals = run.diagnostics.back().entry_help->proposals;
    ASSERT_EQ(proposals.size(), 1U);
    ASSERT_EQ(proposals[0].shape, EntryProposal::Shape::inside_corner);
    ++helped;
    const DiagnosticPoint& start = proposals[0].start;
    EXPECT_FALSE(to_blocks(program("G238", place(start.x, start.y)), setup).stopped);
  }
  EXPECT_GT(helped, rounds / 2);
}

// A bottleneck far from the entry is no matter of the way in.
TEST(EntryHelp, ProposesG238NowhereElse) {
  const std::string narrow =
      "G0 X20 Y4 F1000\nV.G.WZ_AKT.R=5\nG138\nG41 G1 X20 Y0\nX50\nY8\nX0\nY0\nX20\nG40 X20 Y4\n"
      "M30\n";
  const ProgramRun run = to_blocks(narrow, {.session = {.verify = Verify::report}});
  ASSERT_FALSE(run.diagnostics.empty());
  for (const Diagnostic& told : run.diagnostics) EXPECT_FALSE(told.entry_help);
}

// Programs that are accepted, or refused for another reason, get no help with entries.
TEST(EntryHelp, IsGivenToNothingElse) {
  const ProgramRun run =
      to_blocks("G0 X-30 Y0 F1000\nV.G.WZ_AKT.R=10\nG41 G1 X0\nX50\nX55 Y5\nY50\nG40 Y80\nM30\n");
  ASSERT_FALSE(run.diagnostics.empty());
  for (const Diagnostic& told : run.diagnostics) EXPECT_FALSE(told.entry_help);
}

// Under G238 a circle as approach is refused at the end of the contour: what is refused before has
// another reason.
TEST(EntryHelp, IsNotThatOfACircleUnderG238) {
  const ProgramRun run = to_blocks(
      "G0 X0 Y0 F1000\nV.G.WZ_AKT.R=6\nG238\nG41 G2 X-10 Y-10 I-5 J-5\nG1 X10\nY10\n"
      "G42 X-10\nY-10\nG40 X0 Y0\nM30\n");
  ASSERT_FALSE(run.diagnostics.empty());
  EXPECT_EQ(run.diagnostics.back().code, Code::side_change_under_inside_corner);
  EXPECT_FALSE(run.diagnostics.back().entry_help);
}

}  // namespace
}  // namespace trc::support
