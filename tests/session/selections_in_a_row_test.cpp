#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/messages/diagnostic_text.h"
#include "tests/support/program_run.h"

namespace trc::support {
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
  ASSERT_FALSE(plain.stopped) << plain.codes();
  for (const char* options :
       {"REMOVE_MASKED_BLOCKS=1", "REMOVE_MASKED_BLOCKS=1 KERF_MASKING=1", "KERF_MASKING=1"}) {
    const ProgramRun masked =
        to_blocks(head + "#TRC [" + options + "]\nG141\n" + selections + "M30\n");
    ASSERT_FALSE(masked.stopped) << masked.codes();
    EXPECT_EQ(masked.listing(), plain.listing()) << options;
  }
}

// A selection after it may be long and leave in portions: none may follow what says that the path
// before it is wrong.
TEST(SelectionsInARow, NothingFollowsOneWhoseVerificationFails) {
  std::string program =
      "N10 G00 X-60 Y-80 F1000\nN20 V.G.WZ_AKT.R = 10\nN30 G41 G01 X-60 Y-40\nN40 X0\nN50 Y0\n"
      "N60 X50\nN70 Y-10\nN80 X90\nN90 Y25\nN100 X50\nN110 Y15\nN120 X5\nN130 Y75\nN140 X-60\n"
      "N150 G40 Y95\n"
      "#TRC [REMOVE_MASKED_BLOCKS=1]\nG141\nN160 G41 X-100 Y200\n";
  constexpr int blocks = 5000;
  for (int i = 1; i <= blocks; ++i)
    program += "N" + std::to_string(1000 + i) + " X" + std::to_string(100 * i) + " Y" +
               std::to_string(200 + 30 * (i % 2)) + "\n";
  program += "N170 G40 X" + std::to_string(100 * blocks) + " Y400\nM30\n";
  const ProgramRun unmeasured = to_blocks(program);
  ASSERT_FALSE(unmeasured.stopped) << unmeasured.codes();
  ASSERT_GT(unmeasured.blocks.size(), static_cast<std::size_t>(blocks));

  ProgramSessionSetup setup;
  setup.session.verify = Verify::enforce;
  const ProgramRun measured = to_blocks(program, setup);
  EXPECT_TRUE(measured.stopped);
  EXPECT_NE(measured.codes().find("900216"), std::string::npos) << measured.codes();
  constexpr std::size_t one_portion = 1024;
  EXPECT_LT(measured.blocks.size(), one_portion);
}

// Which blocks of one contour are leads must not carry over to the next one, which a window
// releases before all of it is known.
TEST(SelectionsInARow, LeadsOfOneAreNotThoseOfTheNext) {
  ProgramSessionSetup setup;
  setup.session.compensator.limits.look_ahead_blocks = 8;
  setup.session.compensator.leads = {.find = LeadSettings::Find::counted, .blocks_in = 4};
  const std::string head = "G00 X-20 Y-20 F1000\nG141\nV.G.WZ_AKT.R = 5\n";
  const std::string one = "G41 G01 X0 Y0\nX10\nX20\nX30\nX40\nX50\nG40 X60 Y20\nG00 X-20 Y-20\n";
  // A notch of 3 mm, 2 mm wide.
  std::string next = "G41 G01 X0 Y0\nX20\nY-3\nX22\nY0\n";
  for (int x = 30; x < 200; x += 10) next += "X" + std::to_string(x) + "\n";
  next += "G40 X200 Y20\nM30\n";
  for (const std::string& before : {std::string(), one}) {
    const ProgramRun run = to_blocks(head + before + next, setup);
    ASSERT_FALSE(run.stopped) << run.codes();
    const auto told = std::ranges::find(run.diagnostics, Code::blocks_masked, &Diagnostic::code);
    ASSERT_NE(told, run.diagnostics.end()) << run.codes();
    const auto length = std::ranges::find(told->values, "left_out_length", &DiagnosticValue::name);
    ASSERT_NE(length, told->values.end());
    EXPECT_NEAR(length->value, 5, 1e-9);
  }
}

// Leads that are masked bound no material, so that no wall is left out.
TEST(MaskedLeads, LeaveOutNoLength) {
  const std::string program =
      "G00 X-20 Y-20 F1000\nG141\nV.G.WZ_AKT.R = 5\nG41 G01 X0 Y0\nX20\nY-3\nX22\nY0\nX60\nY60\n"
      "G40 X80 Y80\nM30\n";
  ProgramSessionSetup setup;
  for (const std::uint64_t leads : {0U, 4U}) {
    setup.session.compensator.leads = {.find = LeadSettings::Find::counted, .blocks_in = leads};
    const ProgramRun run = to_blocks(program, setup);
    ASSERT_FALSE(run.stopped) << run.codes();
    const auto told = std::ranges::find(run.diagnostics, Code::blocks_masked, &Diagnostic::code);
    ASSERT_NE(told, run.diagnostics.end()) << run.codes();
    const bool says_length = std::ranges::find(told->values, "left_out_length",
                                               &DiagnosticValue::name) != told->values.end();
    EXPECT_EQ(says_length, leads == 0) << message_of(*told);
  }
}

}  // namespace
}  // namespace trc::support
