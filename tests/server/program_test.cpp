#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "server/in_process.h"
#include "tests/server/calls.h"

namespace trc::server {
namespace {

// One server for all tests of a suite, as clients have it.
class CompensateProgramRpc : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { server_ = new InProcessServer(); }
  static void TearDownTestSuite() {
    delete server_;
    server_ = nullptr;
  }
  [[nodiscard]] const std::shared_ptr<grpc::Channel>& channel() const { return server_->channel(); }

  static InProcessServer* server_;
};
InProcessServer* CompensateProgramRpc::server_ = nullptr;

TEST_F(CompensateProgramRpc, DirectSelectionWithoutBlockAsInExampleT01) {
  const StreamAnswer answer = run_program(channel(), blocks_setup(), g239_program);
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(answer.listing(),
            "UNCOMPENSATED 0 0 -> 0 0\n"
            "APPROACH 0 0 -> 30 30\n"
            "PROGRAMMED 30 30 -> 60 30\n"
            "PROGRAMMED 60 30 -> 90 30\n"
            "PROGRAMMED 90 30 -> 120 30\n"
            "UNCOMPENSATED 120 30 -> 150 0\n"
            "PASSTHROUGH M30");
  EXPECT_EQ(answer.accepted, 1);
  EXPECT_EQ(answer.summaries, 1);
  EXPECT_EQ(answer.consumed, g239_program.size());
  EXPECT_EQ(answer.program_summary.lines_in(), 10U);
  EXPECT_EQ(answer.program_summary.bytes_in(), g239_program.size());
  EXPECT_EQ(answer.path_summary.blocks_out(), answer.blocks.size());
  EXPECT_GE(answer.path_summary.wall_time_seconds(), answer.path_summary.cpu_time_seconds());
  EXPECT_GT(answer.path_summary.cpu_time_seconds(), 0);
}

TEST_F(CompensateProgramRpc, AnswersWithNcTextThatRunsUncompensated) {
  const StreamAnswer answer = run_program(channel(), {}, g239_program);
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_TRUE(answer.blocks.empty());
  EXPECT_EQ(answer.text.find("G41"), std::string::npos) << answer.text;
  EXPECT_EQ(answer.program_summary.bytes_out(), answer.text.size());

  const StreamAnswer again = run_program(channel(), blocks_setup(), answer.text);
  ASSERT_TRUE(again.status.ok()) << again.status.error_message() << "\n" << answer.text;
  const StreamAnswer first = run_program(channel(), blocks_setup(), g239_program);
  ASSERT_EQ(again.blocks.size(), first.blocks.size()) << answer.text;
  for (std::size_t i = 0; i < first.blocks.size(); ++i) {
    EXPECT_NEAR(again.blocks[i].line().end().x(), first.blocks[i].line().end().x(), 1e-4);
    EXPECT_NEAR(again.blocks[i].line().end().y(), first.blocks[i].line().end().y(), 1e-4);
  }
}

TEST_F(CompensateProgramRpc, MisfitCircleAfterDeselectionIsRefusedAsInExampleT04) {
  const std::string program =
      "G162\nG0 X0 Y0\nG239\nV.G.WZ_AKT.R = 30\nG41 G01 X30 Y20 F1000\nX60\nX90\nG40\n"
      "G02 X140 Y-30 J-50\nG01 X200\nM30\n";
  const StreamAnswer answer = run_program(channel(), blocks_setup(), program);
  EXPECT_EQ(answer.status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(answer.metadata("code"), "20035");
  EXPECT_EQ(answer.metadata("line"), "9");
  EXPECT_FALSE(answer.metadata("remedy").empty());
  EXPECT_EQ(answer.summaries, 0);

  // The diagnostic is in the stream too, after everything that was certain.
  ASSERT_EQ(answer.diagnostics.size(), 1U);
  EXPECT_EQ(answer.diagnostics[0].code(), 20035);
  EXPECT_EQ(answer.diagnostics[0].severity(), v1::Diagnostic::ERROR);
  EXPECT_EQ(answer.diagnostics[0].line(), 9U);
  EXPECT_FALSE(answer.diagnostics[0].remedy().empty());
  EXPECT_EQ(answer.diagnostics[0].reason(), answer.reason());
  // Up to where the path would leave the contour nothing depends on the circle.
  EXPECT_EQ(answer.listing(),
            "UNCOMPENSATED 0 0 -> 0 0\nAPPROACH 0 0 -> 30 50\n"
            "PROGRAMMED 30 50 -> 60 50\nPROGRAMMED 60 50 -> 90 50");
}

TEST_F(CompensateProgramRpc, CutAtAnyByteGivesTheSameAnswer) {
  const std::string program =
      "%cut\r\nN10 G0 X0 Y0 (Fr\xC3\xA4ser \xE2\x82\xAC)\r\n#TRC [STRETCH_FACTOR = 12]\r\n"
      "N20 G139 G25 V.G.WZ_AKT.R = 5\r\nN30 G41 G01 X10 Y20 F10000\r\nN40 X35 Y30\r\nM8\r\n"
      "N50 X30 Y20\r\nN60 Y10\r\nN70 G40 X20 Y0\r\nN80 G0 X0 Y0\r\nM30\r\n";
  for (const v1::ProgramSetup& setup : {v1::ProgramSetup(), blocks_setup()}) {
    const StreamAnswer whole = run_program(channel(), setup, program);
    ASSERT_TRUE(whole.status.ok()) << whole.status.error_message();
    ASSERT_FALSE(whole.diagnostics.empty());
    for (std::size_t cut = 1; cut < program.size(); ++cut)
      EXPECT_EQ(run_program(channel(), setup, program, {cut}).bytes(), whole.bytes())
          << "cut at " << cut;
  }
}

TEST_F(CompensateProgramRpc, CutIntoManyPiecesGivesTheSameAnswer) {
  const StreamAnswer whole = run_program(channel(), blocks_setup(), g239_program);
  std::mt19937 random(20261121);
  for (int round = 0; round < 20; ++round) {
    std::vector<std::size_t> cuts;
    for (std::size_t at = 0; at < g239_program.size(); at += 1 + random() % 7) cuts.push_back(at);
    const StreamAnswer pieces = run_program(channel(), blocks_setup(), g239_program, cuts);
    EXPECT_EQ(pieces.bytes(), whole.bytes()) << "round " << round;
    EXPECT_GE(pieces.responses, static_cast<int>(cuts.size()));
  }
}

TEST_F(CompensateProgramRpc, BothLayoutsHoldTheSameBlocks) {
  const StreamAnswer blocks = run_program(channel(), blocks_setup(), g239_program);
  const StreamAnswer columns =
      run_program(channel(), blocks_setup(v1::RESPONSE_LAYOUT_COLUMNS), g239_program);
  ASSERT_FALSE(blocks.blocks.empty());
  EXPECT_EQ(columns.bytes(), blocks.bytes());
}

}  // namespace
}  // namespace trc::server
