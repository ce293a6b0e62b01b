#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/interop/linuxcnc/comparison.h"
#include "tests/support/run.h"
#include "tests/support/slow_clearance.h"

// Small contours that show what LinuxCNC does not see or refuses for no reason;
// README.md has the table of both answers.

namespace trc::linuxcnc {
namespace {

using support::compensate;
using support::Outcome;

JudgedContour known(const std::string& name) {
  for (const JudgedContour& judged : read_judged_contours("known_faults.txt"))
    if (judged.name == name) return judged;
  throw std::runtime_error("known_faults.txt has no " + name);
}

// The tool path along the contour, approach and retract left out.
std::vector<Segment> along_contour(const std::vector<CompensatedBlock>& blocks) {
  std::vector<Segment> path;
  for (const CompensatedBlock& block : blocks)
    if (block.origin == Origin::programmed || block.origin == Origin::transition)
      path.push_back(block.path);
  return path;
}

// The smallest distance of a path to the programmed contour, mm.
double clearance(const std::vector<Segment>& path, const JudgedContour& judged) {
  return support::slow_clearance(path, judged.contour.blocks, 0.01).distance;
}

std::string path_difference(const JudgedContour& judged, const Outcome& outcome) {
  return difference(judged, seated(judged, outcome.blocks), seated_answer(judged), same_path);
}

void expect_refused(const JudgedContour& judged, Code code, std::int64_t block) {
  const Outcome outcome = compensate(judged.contour, judged.mode);
  ASSERT_NE(outcome.error(), nullptr);
  EXPECT_EQ(outcome.error()->code, code) << row_of(outcome.error()->code).reason;
  EXPECT_EQ(outcome.error()->source.number, block);
}

// The first diagnostic with this code, or nothing.
const Diagnostic* find(const Outcome& outcome, Code code) {
  const auto found = std::find_if(outcome.diagnostics.begin(), outcome.diagnostics.end(),
                                  [&](const Diagnostic& d) { return d.code == code; });
  return found == outcome.diagnostics.end() ? nullptr : &*found;
}

double value_of(const Diagnostic& diagnostic, const std::string& name) {
  for (const DiagnosticValue& value : diagnostic.values)
    if (value.name == name) return value.value;
  throw std::runtime_error("the diagnostic has no " + name);
}

// Both see neighbours only (rule 6, G140) and cut 2 mm into each side of
// the neck. Neither is right for the workpiece; G140 promises no more.
TEST(KnownFaults, KeyholeIsTravelledByBothWithoutMasking) {
  const JudgedContour judged = known("keyhole");
  const Outcome outcome = compensate(judged.contour, judged.mode);
  ASSERT_EQ(outcome.error(), nullptr);
  EXPECT_EQ(path_difference(judged, outcome), "");
  EXPECT_NEAR(clearance(along_contour(outcome.blocks), judged), 1.0, 1e-6);
  EXPECT_NEAR(clearance(judged.path, judged), 1.0, same_path);
}

// With G141 the whole selection is looked at: the neck is named with its clearance.
TEST(KnownFaults, KeyholeIsReportedWithMasking) {
  JudgedContour judged = known("keyhole");
  judged.mode.masking = Masking::on;
  const Outcome outcome = compensate(judged.contour, judged.mode);
  const Diagnostic* neck = find(outcome, Code::bottleneck);
  ASSERT_NE(neck, nullptr);
  EXPECT_NEAR(value_of(*neck, "clearance"), 1.0, 1e-6);
}

// The chamfer is 1.414 mm long and loses 2.071 mm at each end.
TEST(KnownFaults, ChamferSmallerThanItsTrimIsRefusedByBoth) {
  const JudgedContour judged = known("chamfer");
  EXPECT_NE(judged.refusal.find("Straight feed in concave corner"), std::string::npos);
  expect_refused(judged, Code::line_reversed, 2);
}

// G141 leaves the chamfer out and joins its neighbours.
TEST(KnownFaults, ChamferSmallerThanItsTrimIsMaskedByUs) {
  JudgedContour judged = known("chamfer");
  judged.mode.masking = Masking::on;
  const Outcome outcome = compensate(judged.contour, judged.mode);
  ASSERT_EQ(outcome.error(), nullptr);
  EXPECT_NE(find(outcome, Code::blocks_masked), nullptr);
  const std::vector<Segment> path = along_contour(outcome.blocks);
  ASSERT_EQ(path.size(), 2U);
  EXPECT_LE((end_of(path[0]) - Point(26, 5)).norm(), equidistant);
  EXPECT_LE((end_of(path[1]) - Point(26, 30)).norm(), equidistant);
  EXPECT_GE(clearance(path, judged), judged.mode.tool_radius - equidistant);
}

// A tool of 5 mm does not fit into a fillet of 0.5 mm.
TEST(KnownFaults, FilletSmallerThanTheToolIsRefusedByBoth) {
  const JudgedContour judged = known("fillet");
  EXPECT_NE(judged.refusal.find("Tool radius not less than arc radius"), std::string::npos);
  expect_refused(judged, Code::tool_not_smaller_than_arc, 2);
}

// The offset of the bead is longer than what its two corners leave of it.
TEST(KnownFaults, BeadInAnInsideCornerIsRefusedByBoth) {
  const JudgedContour judged = known("bead");
  EXPECT_NE(judged.refusal.find("Arc move in concave corner"), std::string::npos);
  expect_refused(judged, Code::arc_wrapped, 2);
}

// LinuxCNC does not trim below 0.05 rad: every vertex is cut R (1 - cos 0.049)
// = 12 um too deep. Ours ends at the intersection of the equidistants.
TEST(KnownFaults, InsidePolylineIsCutTooDeepByLinuxCncAlone) {
  const JudgedContour judged = known("inside_polyline");
  const Outcome outcome = compensate(judged.contour, judged.mode);
  ASSERT_EQ(outcome.error(), nullptr);
  const double radius = judged.mode.tool_radius;
  EXPECT_NEAR(radius - clearance(judged.path, judged), radius * (1 - std::cos(0.049)), 2e-4);
  EXPECT_GE(clearance(along_contour(outcome.blocks), judged), radius - equidistant);
  EXPECT_EQ(broken_equidistant(judged, seated(judged, outcome.blocks), equidistant), "");
}

// LinuxCNC goes straight from the end of one equidistant to the end of the next:
// its path is not parallel to the contour and comes too near to it. Ours runs
// round each vertex on an arc.
TEST(KnownFaults, OutsidePolylineIsCutTooDeepByLinuxCncAlone) {
  const JudgedContour judged = known("outside_polyline");
  const Outcome outcome = compensate(judged.contour, judged.mode);
  ASSERT_EQ(outcome.error(), nullptr);
  const double radius = judged.mode.tool_radius;
  EXPECT_LT(clearance(judged.path, judged), radius - 1e-3);
  EXPECT_GE(clearance(along_contour(outcome.blocks), judged), radius - equidistant);
  const auto ours = seated(judged, outcome.blocks);
  EXPECT_EQ(broken_equidistant(judged, ours, equidistant), "");
  for (std::size_t k = 0; k + 1 < ours.size(); ++k) EXPECT_EQ(ours[k].corner.size(), 1U) << k;
}

// A false error: the arc has 1 mm left of its radius, and its whole sweep. The
// same contour without the kink LinuxCNC accepts.
TEST(KnownFaults, KinkBeforeAnArcIsRefusedByLinuxCncAlone) {
  const JudgedContour judged = known("kink_before_arc");
  EXPECT_NE(judged.refusal.find("without gouging"), std::string::npos);
  const Outcome outcome = compensate(judged.contour, judged.mode);
  ASSERT_EQ(outcome.error(), nullptr);
  EXPECT_GE(clearance(along_contour(outcome.blocks), judged),
            judged.mode.tool_radius - equidistant);
  EXPECT_EQ(broken_equidistant(judged, seated(judged, outcome.blocks), equidistant), "");

  const JudgedContour smooth = known("no_kink_before_arc");
  EXPECT_EQ(path_difference(smooth, compensate(smooth.contour, smooth.mode)), "");
}

// Half a turn round the tip (D-05), by both.
TEST(KnownFaults, TipsAreRoundedByBoth) {
  for (const char* name : {"cusp_of_lines", "cusp_outside"}) {
    SCOPED_TRACE(name);
    const JudgedContour judged = known(name);
    const Outcome outcome = compensate(judged.contour, judged.mode);
    ASSERT_EQ(outcome.error(), nullptr);
    const auto path = along_contour(outcome.blocks);
    ASSERT_EQ(path.size(), judged.path.size());
    for (std::size_t k = 0; k < path.size(); ++k)
      EXPECT_LE((end_of(path[k]) - end_of(judged.path[k])).norm(), same_path) << k;
    EXPECT_GE(clearance(path, judged), judged.mode.tool_radius - equidistant);
  }
}

// The arc bends back over the line before it: a slit, an inside corner to both.
TEST(KnownFaults, SlitIsLeftOutByBoth) {
  const JudgedContour judged = known("cusp_inside");
  EXPECT_NEAR(clearance(judged.path, judged), judged.mode.tool_radius, same_path);
  const Outcome outcome = compensate(judged.contour, judged.mode);
  ASSERT_EQ(outcome.error(), nullptr);
  EXPECT_EQ(path_difference(judged, outcome), "");
  EXPECT_NEAR(clearance(along_contour(outcome.blocks), judged), judged.mode.tool_radius,
              equidistant);
}

// LinuxCNC goes on in the direction of its start corner: to (-5, 2), 2 mm from
// the wall y = 0. The block is used up, and 90019 says so.
TEST(KnownFaults, BlockUsedUpByItsStartCornerIsRefusedByUsAlone) {
  const JudgedContour judged = known("short_block");
  EXPECT_NEAR(clearance(judged.path, judged), 2.0, same_path);
  expect_refused(judged, Code::line_reversed, 2);
}

// Deselection goes straight to its target, whatever stands in the way: by both.
TEST(KnownFaults, RetractThroughTheContourIsTravelledByBoth) {
  const JudgedContour judged = known("exit_through_contour");
  const Outcome outcome = compensate(judged.contour, judged.mode);
  ASSERT_EQ(outcome.error(), nullptr);
  EXPECT_EQ(path_difference(judged, outcome), "");
  const CompensatedBlock& retract = outcome.blocks.back();
  ASSERT_EQ(retract.origin, Origin::retract);
  EXPECT_LE((end_of(retract.path) - judged.exit).norm(), same_path);
  EXPECT_NEAR(clearance({retract.path}, judged), 0.0, 1e-6);
}

// The target is 0.1 mm from the contour, nearer than R, and the way there passes a
// hair nearer still: by both.
TEST(KnownFaults, RetractToATargetAtTheContourIsTravelledByBoth) {
  const JudgedContour judged = known("exit_at_contour");
  const Outcome outcome = compensate(judged.contour, judged.mode);
  ASSERT_EQ(outcome.error(), nullptr);
  EXPECT_EQ(path_difference(judged, outcome), "");
  EXPECT_LE((end_of(outcome.blocks.back().path) - judged.exit).norm(), same_path);
  EXPECT_NEAR(clearance({outcome.blocks.back().path}, judged), 0.1, 1e-4);
}

}  // namespace
}  // namespace trc::linuxcnc
