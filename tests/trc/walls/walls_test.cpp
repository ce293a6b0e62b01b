#include "core/trc/walls/walls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/trc/walls/closing.h"

namespace trc {
namespace {

constexpr double pi = std::numbers::pi;

// A contour as it is drawn: from one point to the next one.
class Drawing {
 public:
  Drawing(double x, double y) : at_(x, y) {}

  Drawing& line(double x, double y) {
    const Point end(x, y);
    blocks_.emplace_back(Line{at_, end});
    at_ = end;
    return *this;
  }
  // About a centre, rad, counter-clockwise where positive.
  Drawing& arc(double center_x, double center_y, double sweep) {
    const Point center(center_x, center_y);
    const Vector from = at_ - center;
    const Point end =
        std::abs(sweep) == 2 * pi
            ? at_
            : Point(center + Vector(std::cos(sweep) * from.x() - std::sin(sweep) * from.y(),
                                    std::sin(sweep) * from.x() + std::cos(sweep) * from.y()));
    blocks_.emplace_back(Arc{at_, end, center, sweep});
    at_ = end;
    return *this;
  }
  // 40 by 40 counter-clockwise from (0, -20), in five blocks.
  Drawing& square() { return line(20, -20).line(20, 20).line(-20, 20).line(-20, -20).line(0, -20); }
  Drawing& mark(ContourRole role) {
    roles_.resize(blocks_.size());
    roles_.back() = role;
    return *this;
  }

  // Where the tool cuts; nobody knows, unless it is said.
  Drawing& tool(Side side) {
    tool_side_ = side;
    return *this;
  }

  [[nodiscard]] ContourView view() const {
    ContourView view{.count = blocks_.size(),
                     .segment = [this](std::size_t number) { return blocks_[number]; },
                     .tool_side = tool_side_};
    if (!roles_.empty())
      view.role = [this](std::size_t number) {
        return number < roles_.size() ? roles_[number] : ContourRole::unspecified;
      };
    return view;
  }
  [[nodiscard]] Walls walls(const LeadSettings& settings = {}) const {
    return find_walls(view(), settings, 2.5);
  }

 private:
  Point at_;
  std::vector<Segment> blocks_;
  std::vector<ContourRole> roles_;
  Side tool_side_ = Side::off;
};

using Ranges = std::vector<Walls::Range>;
using Numbers = std::vector<std::size_t>;

TEST(Walls, OfAnOpenContourAllBlocksAre) {
  EXPECT_TRUE(Drawing(0, 0).line(50, 0).line(50, 20).line(90, 20).walls().are_all());
}

TEST(Walls, OfAClosedContourWithoutLeadsAllBlocksAre) {
  const Walls walls = Drawing(0, -20).square().walls();
  EXPECT_TRUE(walls.are_all());
  EXPECT_EQ(0, walls.touch);
}

TEST(Walls, ACircleHasNoLeads) { EXPECT_TRUE(Drawing(10, 0).arc(0, 0, 2 * pi).walls().are_all()); }

TEST(Walls, WhatLeadsToACircleAndFromIt) {
  const Walls walls = Drawing(10, -5).line(10, 0).arc(0, 0, 2 * pi).line(15, 0).walls();
  EXPECT_EQ((Ranges{{0, 1}, {2, 3}}), walls.leads);
  EXPECT_TRUE(walls.parts.empty());
}

// The example of D-38: R 2.5, quarter circles in and out.
TEST(Walls, QuarterCirclesInAndOutAreLeads) {
  const Walls walls = Drawing(25, -30)
                          .arc(20, -30, pi / 2)
                          .line(-25, -25)
                          .line(-25, 20)
                          .arc(-20, 20, -pi / 2)
                          .line(0, 25)
                          .line(25, 0)
                          .line(25, -20)
                          .arc(20, -20, -pi / 2)
                          .arc(20, -30, pi / 2)
                          .walls();
  EXPECT_EQ((Ranges{{0, 1}, {8, 9}}), walls.leads);
  EXPECT_TRUE(walls.parts.empty());
  EXPECT_TRUE(walls.rings.empty());
}

TEST(Walls, AnOverrunEndsTheContourWhereItEnds) {
  const Walls walls = Drawing(-5, -25).line(0, -20).square().line(3, -20).line(8, -25).walls();
  EXPECT_EQ((Ranges{{0, 1}, {7, 8}}), walls.leads);
  ASSERT_EQ(1U, walls.parts.size());
  EXPECT_EQ(1U, walls.parts[0].number);
  EXPECT_NEAR(3, walls.parts[0].from, 1e-9);
}

TEST(Walls, AnOverrunMayBeInOneBlockWithTheLastWall) {
  const Walls walls = Drawing(-5, -25)
                          .line(0, -20)
                          .line(20, -20)
                          .line(20, 20)
                          .line(-20, 20)
                          .line(-20, -20)
                          .line(1, -20)
                          .line(1, -30)
                          .walls();
  EXPECT_EQ((Ranges{{0, 1}, {6, 7}}), walls.leads);
  ASSERT_EQ(1U, walls.parts.size());
  EXPECT_EQ(1U, walls.parts[0].number);
  EXPECT_NEAR(1, walls.parts[0].from, 1e-9);
}

TEST(Walls, AnOverrunMayGoOverACorner) {
  const Walls walls =
      Drawing(-5, -25).line(0, -20).square().line(20, -20).line(20, -19).line(30, -19).walls();
  EXPECT_EQ((Ranges{{0, 2}, {8, 9}}), walls.leads);
  ASSERT_EQ(1U, walls.parts.size());
  EXPECT_EQ(2U, walls.parts[0].number);
  EXPECT_NEAR(1, walls.parts[0].from, 1e-9);
}

// What coordinates of three decimals leave of it is a touch.
TEST(Walls, ARoundedOverrunLiesOnTheFirstWall) {
  const Walls walls = Drawing(-3, -4)
                          .line(0, 0)
                          .line(30, 10)
                          .line(20, 40)
                          .line(-10, 30)
                          .line(0, 0)
                          .line(2.847, 0.9486)
                          .line(5, -5)
                          .walls();
  EXPECT_EQ((Ranges{{0, 1}, {6, 7}}), walls.leads);
  ASSERT_EQ(1U, walls.parts.size());
  EXPECT_NEAR(3, walls.parts[0].from, 2e-3);
  EXPECT_GE(walls.touch_between(1, 5), 4e-4);
  EXPECT_LE(walls.touch_between(1, 5), 0.01);
  EXPECT_EQ(0, walls.touch_between(1, 2));
}

// (-5, 0) to (50, 0), crossed by (0, -50) to (0, 5).
TEST(Walls, RunInAndRunOutCrossInACorner) {
  const Walls walls = Drawing(-5, 0).line(50, 0).line(50, -50).line(0, -50).line(0, 5).walls();
  EXPECT_TRUE(walls.leads.empty());
  ASSERT_EQ(2U, walls.parts.size());
  EXPECT_EQ(0U, walls.parts[0].number);
  EXPECT_NEAR(5, walls.parts[0].from, 1e-9);
  EXPECT_EQ(3U, walls.parts[1].number);
  EXPECT_NEAR(50, walls.parts[1].to, 1e-9);
}

TEST(Walls, LeadsThatCrossDoNotHideTheStart) {
  const Walls walls =
      Drawing(3, -30).line(-3, -22).line(0, -20).square().line(3, -22).line(-3, -30).walls();
  EXPECT_EQ((Ranges{{0, 2}, {7, 9}}), walls.leads);
  EXPECT_TRUE(walls.parts.empty());
}

TEST(Walls, LeadsFromOnePointDoNotHideTheStart) {
  const Walls walls =
      Drawing(0, -30).line(-3, -22).line(0, -20).square().line(3, -22).line(0, -30).walls();
  EXPECT_EQ((Ranges{{0, 2}, {7, 9}}), walls.leads);
}

TEST(Walls, OneLeadOnTheOtherDoesNotHideTheStart) {
  const Walls walls = Drawing(0, -30).line(0, -20).square().line(0, -30).walls();
  EXPECT_EQ((Ranges{{0, 1}, {6, 7}}), walls.leads);
}

TEST(Walls, TheEndMayMissTheStartByTheTolerance) {
  const auto contour = [](double short_of) {
    return Drawing(5, -25)
        .line(0, -20)
        .line(20, -20)
        .line(20, 20)
        .line(-20, 20)
        .line(-20, -20)
        .line(-short_of, -20)
        .line(-5, -25);
  };
  EXPECT_EQ((Ranges{{0, 1}, {6, 7}}), contour(0.009).walls().leads);
  EXPECT_NEAR(0.009, contour(0.009).walls().touch, 1e-9);
  EXPECT_TRUE(contour(0.2).walls().are_all());
  EXPECT_EQ((Ranges{{0, 1}, {6, 7}}), contour(0.2).walls({.closing_tolerance = 0.25}).leads);
}

TEST(Walls, ChordsOfLeadsAreLeads) {
  constexpr int chords = 40;
  // In along the wall, out along it.
  Drawing leads(-10, -30);
  for (int chord = 1; chord <= chords; ++chord) {
    const double angle = chord * pi / 2 / chords;
    leads.line(-10 * std::cos(angle), -30 + 10 * std::sin(angle));
  }
  leads.square();
  for (int chord = 1; chord <= chords; ++chord) {
    const double angle = chord * pi / 2 / chords;
    leads.line(10 * std::sin(angle), -20 - 10 * (1 - std::cos(angle)));
  }
  const Walls walls = leads.walls();
  EXPECT_EQ(40U, walls.leads.front().end);
}

TEST(Walls, TwoLapsAreTwoRings) {
  const Walls walls = Drawing(-5, -25).line(0, -20).square().square().line(5, -25).walls();
  EXPECT_EQ((Ranges{{0, 1}, {11, 12}}), walls.leads);
  EXPECT_EQ((Numbers{6}), walls.rings);
  EXPECT_FALSE(walls.is_wall_for(2, 7)) << "gone when the second lap comes";
  EXPECT_TRUE(walls.is_wall_for(7, 2));
  EXPECT_TRUE(walls.is_wall_for(7, 11)) << "for the lead-out";
  EXPECT_GT(walls.touch_between(7, 2), 0);
}

TEST(Walls, ThreeLapsOfFewBlocksAreThreeRings) {
  const Walls bare = Drawing(0, -20).square().square().square().walls();
  EXPECT_TRUE(bare.leads.empty());
  EXPECT_TRUE(bare.parts.empty());
  EXPECT_EQ((Numbers{5, 10}), bare.rings);
  const Walls walls =
      Drawing(-5, -25).line(0, -20).square().square().square().line(3, -20).line(5, -25).walls();
  EXPECT_EQ((Ranges{{0, 1}, {17, 18}}), walls.leads);
  EXPECT_EQ((Numbers{6, 11}), walls.rings);
}

TEST(Walls, LeadsBetweenTwoDepthsAreLeads) {
  const Walls walls = Drawing(-5, -25)
                          .line(0, -20)
                          .square()
                          .line(5, -25)
                          .line(-5, -25)
                          .line(0, -20)
                          .square()
                          .line(5, -25)
                          .walls();
  EXPECT_EQ((Ranges{{0, 1}, {6, 9}, {14, 15}}), walls.leads);
  EXPECT_EQ((Numbers{6, 9}), walls.rings);
  EXPECT_FALSE(walls.is_wall_for(3, 10));
}

// The last depth alone goes on along its start, and over a corner: the leads between the two others
// meet where the overrun begins, not where it ends.
TEST(Walls, LeadsBetweenDepthsAreLeadsWhereTheLastOneOverruns) {
  const auto depths = [] {
    return Drawing(-5, -25).line(0, -20).square().line(5, -25).line(-5, -25).line(0, -20).square();
  };
  const Walls short_one = depths().line(3, -20).line(8, -25).walls();
  EXPECT_EQ((Ranges{{0, 1}, {6, 9}, {15, 16}}), short_one.leads);
  EXPECT_EQ((Numbers{6, 9}), short_one.rings);
  const Walls over_a_corner = depths().line(20, -20).line(20, -17).line(25, -12).walls();
  EXPECT_EQ((Ranges{{0, 2}, {6, 9}, {16, 17}}), over_a_corner.leads);
}

// With so few blocks in a lap the whole second lap lies among the last blocks, as an overrun does.
TEST(Walls, TheSecondOfTwoDepthsOfABoreIsNoOverrun) {  // D-107
  for (const std::size_t arcs : {1U, 2U, 3U}) {
    Drawing contour(6, -14);
    for (int depth = 0; depth < 2; ++depth) {
      if (depth > 0) contour.line(6, -14);
      contour.arc(6, 0, pi / 2);
      for (std::size_t arc = 0; arc < arcs; ++arc)
        contour.arc(0, 0, 2 * pi / static_cast<double>(arcs));
      contour.arc(6, 0, pi / 2);
    }
    const Walls walls = contour.tool(Side::left).walls();
    const std::size_t end = arcs + 1;
    EXPECT_EQ((Ranges{{0, 1}, {end, end + 3}, {2 * end + 2, 2 * end + 3}}), walls.leads) << arcs;
    EXPECT_EQ((Numbers{end, end + 3}), walls.rings) << arcs;
  }
}

// The overruns of both laps are repeated as well.
TEST(Walls, TwoDepthsOfABoreMayOverrun) {  // D-107
  Drawing contour(6, -14);
  const auto lap = [&] {
    contour.arc(6, 0, pi / 2).arc(0, 0, 2 * pi).arc(0, 0, pi / 2).arc(0, 6, pi / 2);
  };
  lap();
  contour.line(6, -14);
  lap();
  const Walls walls = contour.tool(Side::left).walls();
  EXPECT_EQ((Ranges{{0, 1}, {2, 6}, {8, 9}}), walls.leads);
  ASSERT_EQ(1U, walls.parts.size());
  EXPECT_EQ(1U, walls.parts[0].number);
  EXPECT_NEAR(walls.parts[0].from, 10 * pi, 0.005);
  EXPECT_EQ((Numbers{2, 6}), walls.rings);
}

// The links are longer than the lap, and each lap overruns.
TEST(Walls, DepthsOfASmallPostMayOverrun) {  // D-107
  constexpr double overrun = 1.0 / 12;       // rad
  Drawing contour(20, 14);
  for (int depth = 0; depth < 3; ++depth) {
    if (depth > 0) contour.line(20, 14);
    contour.arc(20, 0, pi / 2).arc(0, 0, -2 * pi).arc(0, 0, -overrun);
    contour.arc(20 * std::cos(overrun), -20 * std::sin(overrun), pi / 2);
  }
  const Walls walls = contour.tool(Side::left).walls();
  EXPECT_EQ((Ranges{{0, 1}, {2, 6}, {7, 11}, {13, 14}}), walls.leads);
  ASSERT_EQ(1U, walls.parts.size());
  EXPECT_EQ(1U, walls.parts[0].number);
  EXPECT_NEAR(walls.parts[0].from, 6 * overrun, 0.005);
  EXPECT_EQ((Numbers{2, 6, 7, 11}), walls.rings);
}

// A finishing lap with round corners, whose overrun leaves the roughing lap in the first of them.
TEST(Walls, AnOverrunOfTheFinishingLapMayGoRoundItsCorner) {
  const Walls walls = Drawing(-5.5, 25.5)
                          .arc(0, 25.5, pi / 2)
                          .line(30, 20)
                          .line(30, -20)
                          .line(-30, -20)
                          .line(-30, 20)
                          .line(0, 20)
                          .line(27, 20)
                          .arc(27, 17, -pi / 2)
                          .line(30, -17)
                          .arc(27, -17, -pi / 2)
                          .line(-27, -20)
                          .arc(-27, -17, -pi / 2)
                          .line(-30, 17)
                          .arc(-27, 17, -pi / 2)
                          .line(0, 20)
                          .line(27, 20)
                          .arc(27, 17, -pi / 4)
                          .line(35, 25)
                          .walls();
  ASSERT_EQ(1U, walls.rings.size());
  EXPECT_FALSE(walls.is_wall_for(2, 7)) << "the corner of the roughing lap is in no way";
}

// Laps round a boss, a block each.
TEST(Walls, LeadsBetweenDepthsAreLeadsWhereTheLastCircleOverruns) {
  const Walls walls = Drawing(-5.5, 30.5)
                          .arc(0, 30.5, pi / 2)
                          .arc(0, 0, -2 * pi)
                          .arc(0, 30.5, pi / 2)
                          .line(-5.5, 30.5)
                          .arc(0, 30.5, pi / 2)
                          .arc(0, 0, -2 * pi)
                          .arc(0, 0, -0.12)
                          .line(9.1117, 29.6222)
                          .walls();
  EXPECT_EQ((Ranges{{0, 1}, {2, 5}, {7, 8}}), walls.leads);
}

TEST(Walls, LeadsBetweenDepthsThatAllOverrunBeginWithTheOverrun) {
  const Walls walls = Drawing(-5, -25)
                          .line(0, -20)
                          .square()
                          .line(3, -20)
                          .line(8, -25)
                          .line(-5, -25)
                          .line(0, -20)
                          .square()
                          .line(3, -20)
                          .line(8, -25)
                          .walls();
  EXPECT_EQ((Ranges{{0, 1}, {6, 10}, {16, 17}}), walls.leads);
}

// A circle along the contour between two depths comes by beside where the last overrun ends.
TEST(Walls, LeadsBetweenDepthsMayComeNearTheEndOfTheOverrun) {
  const Walls walls = Drawing(-5.5, -25.5)
                          .arc(0, -25.5, -pi / 2)
                          .square()
                          .arc(0, -25.5, -2 * pi)
                          .square()
                          .line(0.3, -20)
                          .line(5, -25)
                          .walls();
  EXPECT_EQ((Ranges{{0, 1}, {6, 7}, {13, 14}}), walls.leads);
}

// Two squares that touch in (0, 0), begun in the middle of the right side of the small one.
TEST(Walls, APartThatTouchesAnotherOneIsNoLead) {  // D-38
  const auto outline = [](double x, double quarter) {
    return Drawing(x, 7)
        .arc(x, 10, quarter)
        .line(20, 20)
        .line(0, 20)
        .line(0, 0)
        .line(-40, 0)
        .line(-40, -40)
        .line(0, -40)
        .line(0, 0)
        .line(20, 0)
        .line(20, 10)
        .arc(x, 10, quarter);
  };
  const Ranges quarters{{0, 1}, {10, 11}};
  EXPECT_EQ(quarters, outline(23, -pi / 2).tool(Side::right).walls().leads) << "bosses";
  EXPECT_EQ(quarters, outline(17, pi / 2).tool(Side::left).walls().leads) << "pockets";
}

TEST(Walls, PartsThatTouchInOnePointAreNoLaps) {  // D-38
  const Walls walls = Drawing(10, -6)
                          .line(0, 0)
                          .line(0, -20)
                          .line(-20, -20)
                          .line(-20, 0)
                          .line(0, 0)
                          .line(0, 20)
                          .line(20, 20)
                          .line(20, 0)
                          .line(0, 0)
                          .line(-10, 10)
                          .tool(Side::left)
                          .walls();
  EXPECT_EQ((Ranges{{0, 1}, {9, 10}}), walls.leads);
  EXPECT_TRUE(walls.is_wall_for(1, 8)) << "the first part stands while the second one is cut";
  EXPECT_TRUE(walls.is_wall_for(5, 4));
}

// Half circles about a slender boss, longer than a quarter of the way round it.
TEST(Walls, LeadsBetweenDepthsMayBeLong) {  // D-38
  const auto depth = [](Drawing& contour) {
    contour.arc(0, -16, pi).arc(0, 0, -pi).line(42, 4).arc(42, 0, -pi).line(0, -4).arc(0, -17, pi);
  };
  Drawing contour(0, -28);
  depth(contour);
  contour.line(0, -28);
  depth(contour);
  contour.line(0, -28);
  depth(contour);
  const Walls walls = contour.tool(Side::left).walls();
  EXPECT_EQ((Ranges{{0, 1}, {5, 8}, {12, 15}, {19, 20}}), walls.leads);
  EXPECT_EQ((Numbers{5, 8, 12, 15}), walls.rings);
}

TEST(Walls, MarksWinOverTheSearch) {
  const Walls walls = Drawing(-5, -25)
                          .line(0, -20)
                          .mark(ContourRole::wall)
                          .square()
                          .mark(ContourRole::lead)
                          .line(5, -25)
                          .walls();
  EXPECT_EQ((Ranges{{5, 7}}), walls.leads);
}

// Of blocks shorter than the tolerance each meets all that are near it.
TEST(Walls, TheSearchPassesByItsCheckpoint) {
  struct Enough {};
  Drawing drawing(0, 0);
  for (int i = 1; i < 4000; ++i) drawing.line(0.001 * i, 0.3 * std::sin(0.001 * i));
  drawing.line(0, 0);
  int times = 0;
  Checkpoint checkpoint([&] {
    constexpr int many = 1000;
    if (++times == many) throw Enough{};
  });
  ContourView view = drawing.view();
  view.checkpoint = &checkpoint;
  EXPECT_THROW(static_cast<void>(find_closing(view, 1, 100)), Enough);
}

TEST(Walls, BlocksMayBeCounted) {
  const Drawing contour = Drawing(-9, -25).line(-5, -25).line(0, -20).square().line(5, -25);
  const Walls walls =
      contour.walls({.find = LeadSettings::Find::counted, .blocks_in = 2, .blocks_out = 1});
  EXPECT_EQ((Ranges{{0, 2}, {7, 8}}), walls.leads);
  EXPECT_TRUE(contour.walls({.find = LeadSettings::Find::none}).are_all());
  EXPECT_TRUE(contour.walls({.find = LeadSettings::Find::counted, .blocks_in = 9}).are_all());
}

// A boss of 5 mm between quarter circles of 20 mm, which are longer than what they lead to.
Drawing boss_between_long_leads(double sweep) {
  return Drawing(25, 20).arc(25, 0, pi / 2).arc(0, 0, sweep).arc(25, 0, pi / 2);
}

Walls walls_of(const Drawing& drawing, Side tool_side) {
  ContourView view = drawing.view();
  view.tool_side = tool_side;
  return find_walls(view, {}, 10);
}

TEST(Walls, LeadsMayBeLongerThanTheContour) {  // D-38
  EXPECT_EQ((Ranges{{0, 1}, {2, 3}}), walls_of(boss_between_long_leads(-2 * pi), Side::left).leads);
  EXPECT_EQ((Ranges{{0, 1}, {2, 3}}), walls_of(boss_between_long_leads(2 * pi), Side::right).leads);
}

// Lines of 8 mm beside a boss of 2 mm: as walls they would have it behind them.
TEST(Walls, LongLeadsMayGoStraightOn) {  // D-38
  const auto boss = [](double sweep) {
    return Drawing(2, -8).line(2, 0).arc(0, 0, sweep).line(2, std::copysign(8, sweep));
  };
  EXPECT_EQ((Ranges{{0, 1}, {2, 3}}), walls_of(boss(2 * pi), Side::right).leads);
  EXPECT_TRUE(walls_of(boss(2 * pi), Side::left).leads.empty());
}

// Half circles that begin and end in one point, or cross, close nothing there.
TEST(Walls, LongLeadsMayMeet) {  // D-38
  const auto boss = [](double apart) {
    return Drawing(21, 0).arc(13, 0, pi).arc(0, 0, -2 * pi).arc(13, 0, pi + apart);
  };
  for (const double apart : {0.0, 0.3})
    EXPECT_EQ((Ranges{{0, 1}, {2, 3}}), walls_of(boss(apart), Side::left).leads) << apart;
}

TEST(Walls, LongLeadsMayHaveAnOverrunOfSeveralBlocks) {  // D-38
  Drawing drawing = Drawing(25, 20).arc(25, 0, pi / 2);
  for (int side = 1; side <= 15; ++side)
    drawing.line(5 * std::cos(side * pi / 6), -5 * std::sin(side * pi / 6));
  const Walls walls = walls_of(drawing.arc(20, -5, pi / 2), Side::left);
  EXPECT_EQ((Ranges{{0, 4}, {16, 17}}), walls.leads) << "all of the twelve sides between";
}

// As it is put on at an outside corner, to keep that sharp: the tool is on its inside.
TEST(Walls, ALoopAtACornerMakesNoLeads) {  // D-38
  const Drawing corner = Drawing(-40, 0).line(0, 0).arc(0, 5, 1.5 * pi).arc(0, 5, 0.5 * pi);
  EXPECT_TRUE(walls_of(Drawing(corner).line(0, -60), Side::left).leads.empty());
  EXPECT_TRUE(walls_of(boss_between_long_leads(-2 * pi), Side::right).leads.empty());
}

// The half circle out swings through the wall at x = 30, which is one all the same.
TEST(Walls, ALeadThatCutsAWallMakesNoLeadOfIt) {  // D-38
  const Walls walls = walls_of(Drawing(18, -12)
                                   .arc(26, -12, pi / 2)
                                   .line(30, -20)
                                   .line(30, 20)
                                   .line(-30, 20)
                                   .line(-30, -20)
                                   .line(26, -20)
                                   .arc(26, -12, pi),
                               Side::left);
  EXPECT_EQ((Ranges{{0, 1}, {6, 7}}), walls.leads);
  EXPECT_TRUE(walls.parts.empty());
}

// The same after the second of two laps.
TEST(Walls, ALeadAfterLapsThatCutsAWallMakesNoLeadOfIt) {  // D-38
  Drawing drawing = Drawing(18, -12).arc(26, -12, pi / 2);
  for (int lap = 0; lap < 2; ++lap)
    drawing.line(30, -20).line(30, 20).line(-30, 20).line(-30, -20).line(26, -20);
  const Walls walls = walls_of(drawing.arc(26, -12, pi), Side::left);
  EXPECT_EQ((Ranges{{0, 1}, {11, 12}}), walls.leads);
  EXPECT_EQ((Numbers{6}), walls.rings);
  EXPECT_TRUE(walls.parts.empty());
}

// In the inside corner the contour begins in, the arc in crosses the last wall beside it.
TEST(Walls, ALeadInThatCutsTheLastWallMakesNoLeadOfIt) {  // D-38
  for (const double rise : {1.8, 4.0, 10.0, 20.0}) {
    const Walls walls = walls_of(Drawing(-5, 5)
                                     .arc(0, 5, pi / 2)
                                     .line(20, 0)
                                     .line(20, 40)
                                     .line(-20, 40)
                                     .line(-20, rise)
                                     .line(0, 0)
                                     .line(0, 5),
                                 Side::left);
    EXPECT_EQ((Ranges{{0, 1}, {6, 7}}), walls.leads) << rise;
    EXPECT_TRUE(walls.parts.empty()) << rise;
  }
}

// A line out that runs into the first wall, an arc, and leaves through it.
TEST(Walls, ALeadOutSlightlyIntoTheFirstWallMakesNoLeadOfIt) {  // D-38
  for (const double angle : {0.03, 0.05, 0.1}) {
    const Walls walls = walls_of(Drawing(-4, -4)
                                     .arc(0, -4, -pi / 2)
                                     .arc(0, 30, pi / 2)
                                     .line(30, 50)
                                     .line(-40, 50)
                                     .line(-40, 0)
                                     .line(0, 0)
                                     .line(17 * std::cos(angle), 17 * std::sin(angle)),
                                 Side::right);
    EXPECT_EQ((Ranges{{0, 1}, {6, 7}}), walls.leads) << angle;
    EXPECT_TRUE(walls.parts.empty()) << angle;
  }
}

// After an overrun that ends before a flat inside corner, the arc out runs through that corner.
TEST(Walls, ALeadOutThroughAFlatCornerMakesNoLeadOfIt) {  // D-38
  for (const double angle : {0.1, 0.2, 0.3})
    for (const double before : {0.5, 1.0, 1.5}) {
      const Walls walls = walls_of(Drawing(0, 41)
                                       .arc(0, 20.5, pi)
                                       .line(11, 0)
                                       .line(11 + 200 * std::cos(angle), 200 * std::sin(angle))
                                       .line(200, 400)
                                       .line(-200, 400)
                                       .line(-200, 0)
                                       .line(0, 0)
                                       .line(11 - before, 0)
                                       .arc(11 - before, 20.5, pi),
                                   Side::left);
      EXPECT_EQ((Ranges{{0, 1}, {8, 9}}), walls.leads) << angle << ' ' << before;
      ASSERT_EQ(1U, walls.parts.size()) << angle << ' ' << before;
      EXPECT_EQ(1U, walls.parts[0].number) << angle << ' ' << before;
      EXPECT_NEAR(11 - before, walls.parts[0].from, 1e-9) << angle << ' ' << before;
    }
}

// After an overrun that ends just before the keyway of a bore the arc out stays within the closing
// tolerance of the wall up to there.
TEST(Walls, AnArcOutOfABoreIsALeadFromItsStart) {  // D-38
  for (const double lead : {5.0, 12.0, 18.0})
    for (const double before : {0.5, 0.2, 0.02}) {
      const double overrun = 4 - before;  // mm; the keyway begins 4 mm after the start
      const Point end(20 * std::sin(overrun / 20), -20 * std::cos(overrun / 20));
      const Point center = (1 - lead / 20) * end;
      const Walls walls = walls_of(Drawing(-lead, -20 + lead)
                                       .arc(0, -20 + lead, pi / 2)
                                       .arc(0, 0, 4.0 / 20)
                                       .line(6, -25)
                                       .line(10, -24)
                                       .line(8, -std::sqrt(336))
                                       .arc(0, 0, 2 * pi - std::asin(0.4))
                                       .arc(0, 0, overrun / 20)
                                       .arc(center.x(), center.y(), pi / 2),
                                   Side::left);
      EXPECT_EQ((Ranges{{0, 1}, {7, 8}}), walls.leads) << lead << ' ' << before;
      ASSERT_EQ(1U, walls.parts.size()) << lead << ' ' << before;
      EXPECT_NEAR(overrun, walls.parts[0].from, 1e-9) << lead << ' ' << before;
    }
}

// A line in comes within the closing tolerance of the last walls before it meets the start.
TEST(Walls, ALineInAlongABossDoesNotHideItsStart) {  // D-38
  Drawing drawing(2, -2);
  drawing.line(2, 0);
  for (int arc = 0; arc < 720; ++arc) drawing.arc(0, 0, 2 * pi / 720);
  const Walls walls = walls_of(drawing.line(2, 2), Side::right);
  EXPECT_EQ((Ranges{{0, 1}, {721, 722}}), walls.leads);
  EXPECT_TRUE(walls.parts.empty());
}

// Of a block without length both ends are the crossing: there is nothing beyond it.
TEST(Walls, APointAfterAFullCircleTiesNothing) {  // D-44
  for (const double shift : {1.0, -1.0}) {
    const Drawing drawing = Drawing(-30, 0).line(0, 0).arc(4, 16, 2 * pi).line(0, 0).line(3, -20);
    ContourView view = drawing.view();
    view.shift = shift;
    EXPECT_TRUE(find_walls(view, {.find = LeadSettings::Find::none}, 2.5).are_all()) << shift;
  }
}

// A circle that is closed crosses at its start and at its end: the tie is where the short block is.
TEST(Walls, OfAFullCircleInABowTieTheWholeIsAWall) {  // D-44
  for (const double shift : {1.0, -1.0}) {
    const Drawing drawing =
        Drawing(-30, 0).line(0, 0).arc(0, 20, 2 * pi).line(0.0006, -0.0003).line(-10, 10);
    ContourView view = drawing.view();
    view.shift = shift;
    const Walls walls = find_walls(view, {.find = LeadSettings::Find::none}, 2.5);
    for (const Walls::Part& part : walls.parts)
      EXPECT_TRUE(part.number != 1 || part.to > 40 * pi - 0.01) << shift;
  }
}

}  // namespace
}  // namespace trc
