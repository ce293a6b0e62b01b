#include <gtest/gtest.h>

#include <string>

#include "tests/session/run_program.h"

namespace trc::testing {
namespace {

// Selections of one block each, on and off without a motion (G237), up to the very end: each is
// still on its way when the one before leaves.
TEST(SelectionsInARow, NoneIsLostWithTheEndOfTheProgram) {
  const std::string head = "N10 G00 X0 Y0 F1000\nN20 V.G.WZ_AKT.R = 5\nN30 G237\n";
  std::string selections;
  for (int i = 1; i <= 4; ++i)
    selections += "N" + std::to_string(100 * i) + " G41 G01 X" + std::to_string(50 * i) + "\nN" +
                  std::to_string(100 * i + 50) + " G40\n";
  const ProgramRun plain = to_blocks(head + "G140\n" + selections + "M30\n");
  ASSERT_TRUE(plain.completed) << plain.reports();
  for (const char* options :
       {"REMOVE_MASKED_BLOCKS=1", "REMOVE_MASKED_BLOCKS=1 KERF_MASKING=1", "KERF_MASKING=1"}) {
    const ProgramRun masked =
        to_blocks(head + "#TRC [" + options + "]\nG141\n" + selections + "M30\n");
    ASSERT_TRUE(masked.completed) << masked.reports();
    EXPECT_EQ(masked.listing(), plain.listing()) << options;
  }
}

}  // namespace
}  // namespace trc::testing
