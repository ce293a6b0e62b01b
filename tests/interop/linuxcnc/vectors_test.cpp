#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/interop/linuxcnc/comparison.h"
#include "tests/support/run.h"

// Random contours and LinuxCNC's answers, see README.md.

namespace trc::linuxcnc {
namespace {

const std::vector<JudgedContour>& vectors() {
  static const std::vector<JudgedContour> all = read_judged_contours("vectors.txt");
  return all;
}

class Vectors : public ::testing::TestWithParam<Side> {
 protected:
  // The contours on the tool's side of this run for which `wanted` holds.
  template <class Wanted>
  static std::vector<JudgedContour> those(Wanted wanted) {
    std::vector<JudgedContour> result;
    std::copy_if(vectors().begin(), vectors().end(), std::back_inserter(result),
                 [&](const JudgedContour& judged) {
                   return judged.mode.side == GetParam() && wanted(judged);
                 });
    return result;
  }
};

bool is_accepted(const JudgedContour& judged) {
  return judged.refusal.empty() && judged.fault.empty();
}
bool is_refused(const JudgedContour& judged) {
  return !judged.refusal.empty() && judged.fault.empty();
}

TEST_P(Vectors, ContourBlocksAreThoseOfLinuxCnc) {
  const auto accepted = those(is_accepted);
  EXPECT_GE(accepted.size(), 100U);
  for (const JudgedContour& judged : accepted) {
    SCOPED_TRACE("contour " + judged.name);
    const auto outcome = support::compensate(judged.contour, judged.mode);
    ASSERT_EQ(outcome.error(), nullptr) << row_of(outcome.error()->code).reason;
    EXPECT_EQ(difference(judged, seated(judged, outcome.blocks), seated_answer(judged), same_path),
              "");
  }
}

TEST_P(Vectors, EveryBlockIsOneRadiusAwayAlsoAtCornersLinuxCncLeavesAlone) {
  for (const JudgedContour& judged : those(is_accepted)) {
    SCOPED_TRACE("contour " + judged.name);
    const auto outcome = support::compensate(judged.contour, judged.mode);
    ASSERT_EQ(outcome.error(), nullptr);
    EXPECT_EQ(broken_equidistant(judged, seated(judged, outcome.blocks), equidistant), "");
    EXPECT_EQ(support::first_gap(outcome.blocks), "");
  }
}

TEST_P(Vectors, BothGoStraightToTheTargetAfterTheContour) {
  for (const JudgedContour& judged : those(is_accepted)) {
    SCOPED_TRACE("contour " + judged.name);
    const auto outcome = support::compensate(judged.contour, judged.mode);
    ASSERT_FALSE(outcome.blocks.empty());
    EXPECT_EQ(outcome.blocks.back().origin, Origin::retract);
    EXPECT_LE((end_of(outcome.blocks.back().path) - judged.exit).norm(), same_path);
  }
}

TEST_P(Vectors, WhatLinuxCncRefusesRightlyWeRefuse) {
  const auto refused = those(is_refused);
  EXPECT_GE(refused.size(), 20U);
  for (const JudgedContour& judged : refused) {
    SCOPED_TRACE("contour " + judged.name + ": " + judged.refusal);
    const auto outcome = support::compensate(judged.contour, judged.mode);
    ASSERT_TRUE(outcome.stopped);
    const std::set<Code> violations = {Code::line_reversed, Code::arc_wrapped,
                                       Code::tool_not_smaller_than_arc};
    EXPECT_TRUE(violations.contains(outcome.error()->code)) << row_of(outcome.error()->code).reason;
  }
}

// LinuxCNC does not look at a line that its first corner has used up when its
// other corner trims nothing. It runs backwards there, nearer than R to the block
// before.
TEST_P(Vectors, ReversedLinesThatLinuxCncAcceptsWeRefuse) {
  const auto faulty =
      those([](const JudgedContour& judged) { return judged.fault == "reversed_line"; });
  EXPECT_GE(faulty.size(), 2U);
  for (const JudgedContour& judged : faulty) {
    SCOPED_TRACE("contour " + judged.name);
    const std::size_t index = judged.fault_block - 1;
    const Segment theirs = seated_answer(judged)[index].block;
    const Vector programmed = tangent_at_start(judged.contour.blocks[index]);
    EXPECT_LT((end_of(theirs) - start_of(theirs)).dot(programmed), 0);

    const auto outcome = support::compensate(judged.contour, judged.mode);
    ASSERT_TRUE(outcome.stopped);
    EXPECT_EQ(outcome.error()->code, Code::line_reversed);
    EXPECT_EQ(outcome.error()->source.number, static_cast<std::int64_t>(judged.fault_block));
  }
}

// LinuxCNC leaves an outside corner below its threshold alone and then takes the
// angle it has skipped for growth of the arc after it.
TEST_P(Vectors, FalseGougeErrorsOfLinuxCncComeOutAsExactEquidistants) {
  const auto faulty =
      those([](const JudgedContour& judged) { return judged.fault == "false_gouge"; });
  EXPECT_GE(faulty.size(), 1U);
  for (const JudgedContour& judged : faulty) {
    SCOPED_TRACE("contour " + judged.name);
    const auto outcome = support::compensate(judged.contour, judged.mode);
    ASSERT_EQ(outcome.error(), nullptr) << row_of(outcome.error()->code).reason;
    EXPECT_EQ(broken_equidistant(judged, seated(judged, outcome.blocks), equidistant), "");
  }
}

INSTANTIATE_TEST_SUITE_P(LinuxCnc, Vectors, ::testing::Values(Side::left, Side::right),
                         [](const auto& tested) {
                           return tested.param == Side::left ? "Left" : "Right";
                         });

// The comparison itself: what moves one point by twice the bound is seen.
TEST(LinuxCncComparison, SeesAPointMovedByTwiceTheBound) {
  std::size_t moved = 0;
  for (JudgedContour judged : vectors()) {
    if (!is_accepted(judged)) continue;
    const auto ours = seated(judged, support::compensate(judged.contour, judged.mode).blocks);
    auto theirs = seated_answer(judged);
    Segment& last = theirs.back().block;
    std::visit([](auto& shape) { shape.end.x() += 2 * same_path; }, last);
    EXPECT_NE(difference(judged, ours, theirs, same_path), "") << judged.name;
    auto bent = ours;
    const Vector across = left_of(tangent_at_end(judged.contour.blocks.front()));
    std::visit([&](auto& shape) { shape.end += 2 * equidistant * across; }, bent.front().block);
    EXPECT_NE(broken_equidistant(judged, bent, equidistant), "") << judged.name;
    ++moved;
  }
  EXPECT_GE(moved, 300U);
}

// A smaller or poorer file must not pass unnoticed.
TEST(LinuxCncVectors, ContainEveryKindOfCorner) {
  std::map<std::string, std::size_t> corners;
  std::set<double> radii;
  std::map<Plane, std::size_t> planes;
  std::size_t blocks = 0;
  std::size_t arcs = 0;
  for (const JudgedContour& judged : vectors()) {
    if (!is_accepted(judged)) continue;
    const auto& contour = judged.contour.blocks;
    radii.insert(judged.mode.tool_radius);
    ++planes[judged.mode.plane];
    blocks += contour.size();
    arcs += static_cast<std::size_t>(std::count_if(contour.begin(), contour.end(), is_arc));
    for (std::size_t k = 0; k + 1 < contour.size(); ++k) {
      const double turn = turn_to_tool(judged, k);
      const std::string kind = std::abs(turn) < corner_threshold ? "left alone"
                               : turn > 0                        ? "inside"
                                                                 : "outside";
      ++corners[kind + (is_arc(contour[k]) ? " arc" : " line") +
                (is_arc(contour[k + 1]) ? " arc" : " line")];
    }
  }
  EXPECT_EQ(corners.size(), 12U);
  for (const auto& [kind, count] : corners) EXPECT_GE(count, 50U) << kind;
  EXPECT_EQ(radii.size(), 8U);
  EXPECT_GE(planes[Plane::xy], 100U);
  EXPECT_GE(planes[Plane::zx], 100U);
  const double share = static_cast<double>(arcs) / static_cast<double>(blocks);
  EXPECT_GT(share, 0.30);
  EXPECT_LT(share, 0.38);
}

}  // namespace
}  // namespace trc::linuxcnc
