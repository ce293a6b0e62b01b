#include "client/cli/summary_line.h"

#include <gtest/gtest.h>

namespace trc::cli {
namespace {

wire::PathSummary measured() {
  wire::PathSummary summary;
  summary.summary.blocks_out = 1204;
  summary.summary.blocks_by_origin[static_cast<std::size_t>(Origin::masked)] = 3;
  summary.clearance.worst =
      verify::Clearance{.distance = 6, .required = 6, .path = {.number = 120}};
  return summary;
}

TEST(SummaryLine, SaysBlocksMaskedOnesClearanceAndTime) {
  EXPECT_EQ(summary_line(measured(), LengthUnit::mm, 0.04, Language::english),
            "1,204 blocks, 3 masked, clearance 6.000 mm at N120, 0.04 s");
  EXPECT_EQ(summary_line(measured(), LengthUnit::mm, 0.04, Language::german),
            "1 204 Sätze, 3 ausgeblendet, Abstand 6.000 mm bei N120, 0.04 s");
}

TEST(SummaryLine, SaysTheClearanceInTheUnitOfTheSetup) {
  EXPECT_EQ(summary_line(measured(), LengthUnit::inch, 0.04, Language::english),
            "1,204 blocks, 3 masked, clearance 0.2362 inch at N120, 0.04 s");
}

TEST(SummaryLine, LeavesOutWhatThereIsNot) {
  wire::PathSummary summary;
  EXPECT_EQ(summary_line(summary, LengthUnit::mm, 1.5, Language::english), "0 blocks, 1.50 s");
  summary.summary.blocks_out = 1'234'567;
  EXPECT_EQ(summary_line(summary, LengthUnit::mm, 1.5, Language::english),
            "1,234,567 blocks, 1.50 s");
  summary = measured();
  summary.summary.blocks_out = 1;
  summary.clearance.worst->path.number = Source::no_number;
  EXPECT_EQ(summary_line(summary, LengthUnit::mm, 0, Language::english),
            "1 block, 3 masked, clearance 6.000 mm at block 0, 0.00 s");
}

TEST(SummaryLine, SaysTheLineWhereBlocksHaveNoNumbers) {
  wire::PathSummary summary = measured();
  summary.clearance.worst->path = {.index = 11, .line = 12};
  EXPECT_EQ(summary_line(summary, LengthUnit::mm, 0.04, Language::english),
            "1,204 blocks, 3 masked, clearance 6.000 mm at line 12, 0.04 s");
  EXPECT_EQ(summary_line(summary, LengthUnit::mm, 0.04, Language::german),
            "1 204 Sätze, 3 ausgeblendet, Abstand 6.000 mm bei Zeile 12, 0.04 s");
}

TEST(SummaryLine, GoesWithAWordWhereNothingWasCompensated) {
  wire::PathSummary summary;
  summary.summary.blocks_by_origin[static_cast<std::size_t>(Origin::uncompensated)] = 3;
  summary.summary.blocks_by_origin[static_cast<std::size_t>(Origin::passthrough)] = 1;
  EXPECT_TRUE(compensates_nothing(summary));
  summary.warnings = 1;
  EXPECT_FALSE(compensates_nothing(summary));
  summary.warnings = 0;
  summary.summary.blocks_by_origin[static_cast<std::size_t>(Origin::programmed)] = 1;
  EXPECT_FALSE(compensates_nothing(summary));
}

}  // namespace
}  // namespace trc::cli
