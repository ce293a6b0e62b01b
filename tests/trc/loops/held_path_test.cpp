#include "core/trc/loops/held_path.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>

// The path of a selection whose loops are removed, as it is held.

namespace trc {
namespace {

class HeldPathTest : public ::testing::Test {
 protected:
  // Of a tool with this radius.
  PathBlock block(Role role, double radius) {
    PathBlock block;
    block.role = role;
    block.origin = role == Role::contour ? Origin::programmed : Origin::transition;
    const Point start = at_;
    at_ += Vector(1, 0);
    block.programmed.path = Line{.start = start, .end = at_};
    block.programmed.mode = mode_;
    block.tool_path = block.programmed.path;
    block.at_start.shift = block.at_end.shift = radius;
    return block;
  }

  void hold(Role role, double radius) {
    PathBlock held = block(role, radius);
    path_.append(held);
  }

  std::shared_ptr<const TrcMode> mode_ = std::make_shared<const TrcMode>();
  Point at_ = Point::Zero();
  HeldPath path_;
};

TEST_F(HeldPathTest, WhatIsInsertedBeforeASmallerRadiusHasTheSmallerOne) {
  hold(Role::contour, 5);
  hold(Role::inserted, 5);
  hold(Role::inserted, 2);
  hold(Role::inserted, 4);
  hold(Role::contour, 3);
  const double expected[] = {5, 3, 2, 3, 3};
  for (std::size_t number = path_.begin(); number < path_.end(); ++number)
    EXPECT_EQ(path_.radius_of_tool(number), expected[number]) << number;
}

TEST_F(HeldPathTest, WhatIsForgottenTakesNothingFromTheBlocksAfterIt) {
  hold(Role::contour, 5);
  hold(Role::inserted, 5);
  hold(Role::inserted, 2);
  hold(Role::inserted, 5);
  hold(Role::contour, 3);
  hold(Role::contour, 3);
  const double expected[] = {5, 3, 2, 3, 3, 3};
  for (std::size_t first = path_.begin() + 1; first < path_.end(); ++first) {
    path_.forget_path_before(first);
    for (std::size_t number = first; number < path_.end(); ++number) {
      ASSERT_EQ(path_.setting_of(number).mode, mode_) << number << " of those from " << first;
      EXPECT_EQ(path_.radius_of_tool(number), expected[number]) << number;
    }
  }
}

}  // namespace
}  // namespace trc
