#include "core/trc/passes/inside_corner.h"

#include <gtest/gtest.h>

#include <optional>

#include "tests/trc/passes/given_blocks.h"

// G238: where the tool comes to the contour and leaves it.

namespace trc {
namespace {

using support::all_from;
using support::approach_block;
using support::contour_block;
using support::expect_point;
using support::in_a_row;
using support::left_of_contour;

TEST(InsideCornerPass, BringsTheToolToWhereFirstAndLastBlockMeet) {  // rule 3.5
  TrcMode mode = left_of_contour(2);
  mode.selection = Selection::inside_corner;
  Diagnostics diagnostics;
  Checkpoint checkpoint({});
  std::optional<RefusedWay> refused;
  InsideCorner pass(100, Tolerances{}, diagnostics, checkpoint, refused);
  const auto side = [&](const Point& start, const Point& end) {
    return contour_block(Line{.start = start, .end = end}, mode);
  };
  const PathBlocks out = all_from(
      pass, in_a_row(approach_block({.start = {8, 8}, .end = {0, 0}}, mode), side({0, 0}, {20, 0}),
                     side({20, 0}, {20, 20}), side({20, 20}, {0, 20}), side({0, 20}, {0, 0})));
  ASSERT_FALSE(diagnostics.stopped());
  ASSERT_EQ(out.size(), 5U);
  expect_point(out.front()->offset_end, 2, 2);
  expect_point(out.back()->offset_end, 2, 2);
  EXPECT_NEAR(out.back()->cut_at_end, 2, 1e-12);
}

}  // namespace
}  // namespace trc
