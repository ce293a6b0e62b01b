#include "core/base/likely_meant.h"

#include <gtest/gtest.h>

namespace trc {
namespace {

TEST(EditDistance, CountsLettersPutInLeftOutChangedAndSwapped) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("", "plot"), 4U);
  EXPECT_EQ(edit_distance("plot", "plot"), 0U);
  EXPECT_EQ(edit_distance("compensat", "compensate"), 1U);
  EXPECT_EQ(edit_distance("verrify", "verify"), 1U);
  EXPECT_EQ(edit_distance("plat", "plot"), 1U);
  EXPECT_EQ(edit_distance("raduis", "radius"), 1U);
  EXPECT_EQ(edit_distance("plot", "radii"), 5U);
}

TEST(LikelyMeant, IsTheNearestAndNothingFar) {
  const std::vector<std::string> commands{"compensate", "plot", "radii"};
  EXPECT_EQ(likely_meant("compensat", commands), "compensate");
  EXPECT_EQ(likely_meant("radi", commands), "radii");
  EXPECT_EQ(likely_meant("mill", commands), std::nullopt);
  EXPECT_EQ(likely_meant("", commands), std::nullopt);
  EXPECT_EQ(likely_meant("plot", {}), std::nullopt);
}

}  // namespace
}  // namespace trc
