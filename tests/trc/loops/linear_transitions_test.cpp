#include "core/trc/loops/linear_transitions.h"

#include <gtest/gtest.h>

#include "tests/trc/loops/loop_room.h"

// The arc round an outside corner of 90 degrees at (10, 0), and the mitre (11, 1) in its place.

namespace trc {
namespace {

class LinearTransitionsTest : public LoopRoom {
 protected:
  void hold_corner(Transition transition) {
    TrcMode mode;
    mode.transition = transition;
    mode_ = std::make_shared<const TrcMode>(mode);
    hold(Line{.start = {0, 0}, .end = {10, 0}}, Line{.start = {0, 1}, .end = {10, 1}});
    hold_quarter_round({10, 0}, {10, 1}, {11, 0});
    hold(Line{.start = {10, 0}, .end = {10, -10}}, Line{.start = {11, 0}, .end = {11, -10}});
    linear_.begin_at({0, 1});
    linear_.end_at({11, -10});
  }
  void expect_arc_stays() {
    linear_.replace(1);
    EXPECT_FALSE(path_.is_linear(1));
    EXPECT_EQ(path_.ends_at(0), Point(10, 1));
    EXPECT_EQ(path_.begins_at(2), Point(11, 0));
  }

  LinearTransitions linear_{path_, walked_, obstacles_, tolerances_, checkpoint_};
};

TEST_F(LinearTransitionsTest, TheBlocksGoOnToTheMitre) {  // rule 4.2
  hold_corner(Transition::linear);
  walked_.add_whole(0, 3);
  ASSERT_TRUE(linear_.may_replace(1));
  linear_.replace(1);
  EXPECT_TRUE(path_.is_linear(1));
  EXPECT_EQ(path_.lines_of(1).count, 0U);
  EXPECT_NEAR((path_.ends_at(0) - Point(11, 1)).norm(), 0, 1e-12);
  EXPECT_EQ(path_.ends_at(0), path_.begins_at(2));
  EXPECT_NEAR(walked_[0].to, 11, 1e-12);
  EXPECT_NEAR(walked_[2].to, 11, 1e-12);
}

TEST_F(LinearTransitionsTest, ArcsStayWhereTheyAreAskedFor) {
  hold_corner(Transition::circular);
  walked_.add_whole(0, 3);
  EXPECT_FALSE(linear_.may_replace(1));
  expect_arc_stays();
}

TEST_F(LinearTransitionsTest, TheArcStaysWhereAWallBarsTheMitre) {  // D-45
  hold_corner(Transition::linear);
  // Comes back, up to 0.85 from the mitre and 1.26 from the arc.
  hold({{10, -10}, {20, -10}, {20, 10}, {11.6, 1.6}});
  walked_.add_whole(0, 3);
  EXPECT_TRUE(linear_.may_replace(1));
  expect_arc_stays();
}

TEST_F(LinearTransitionsTest, TheArcStaysWhereThePathEndsBetweenItAndTheMitre) {
  hold_corner(Transition::linear);
  linear_.end_at({10.9, 0.9});
  walked_.add_whole(0, 3);
  expect_arc_stays();
}

TEST_F(LinearTransitionsTest, AnArcThatIsNotTravelledWholeStays) {
  hold_corner(Transition::linear);
  walked_.add_whole(0);
  walked_.add({.block = 1, .from = 0.5, .to = std::numbers::pi / 2, .end = {11, 0}});
  walked_.add_whole(2);
  EXPECT_FALSE(linear_.may_replace(1));
}

TEST_F(LinearTransitionsTest, TheArcStaysWhereTheBlockBeforeItIsLeftEarly) {
  hold_corner(Transition::linear);
  walked_.add({.block = 0, .to = 9, .start = {0, 1}, .end = {9, 1}});
  walked_.add_whole(1, 3);
  EXPECT_TRUE(linear_.may_replace(1));
  expect_arc_stays();
}

}  // namespace
}  // namespace trc
