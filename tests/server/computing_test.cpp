#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "core/session/program_session.h"
#include "server/in_process.h"
#include "server/resources/memory_account.h"
#include "tests/server/calls.h"

// Programs that compute, through the service.

namespace trc::server::computing {
namespace {

v1::ProgramSetup fanuc() {
  v1::ProgramSetup setup;
  setup.set_dialect(v1::DIALECT_FANUC);
  return setup;
}

TEST(ComputingPrograms, ComeOutFlatHoweverTheyAreCut) {
  InProcessServer server;
  v1::ProgramSetup setup = fanuc();
  (*setup.mutable_variables())["#500"] = 3;
  (*setup.mutable_subprograms())["O7.nc"] = "O7\nG0 X#500\nM99\n";
  const std::string text = "%\nG0 X1.\nM98 P7 L2\nM30\n%\n";
  for (std::size_t cut = 0; cut < text.size(); cut += 5) {
    const StreamAnswer answer = run_program(server.channel(), setup, text, {cut});
    ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
    EXPECT_EQ(answer.text, "%\nG0 X1.\n(O0007)\nG0 X3.\n(O0007)\nG0 X3.\nM30\n%\n");
    EXPECT_EQ(answer.consumed, text.size());
    EXPECT_EQ(answer.program_summary.lines_in(), 5U);
  }
}

TEST(ComputingPrograms, ComeOutInMessagesOfABoundedSize) {
  InProcessServer server;
  const StreamAnswer answer =
      run_program(server.channel(), fanuc(),
                  "#1=0\nWHILE [#1 LT 100000] DO1\nG0 X[#1/10] Y2.\n#1=#1+1\nEND1\nM30\n");
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 100'001);
  EXPECT_TRUE(answer.text.ends_with("G0 X9999.9 Y2.\nM30\n"));
}

TEST(ComputingPrograms, SayWhatCalledALineThatIsRefused) {
  InProcessServer server;
  const StreamAnswer answer =
      run_program(server.channel(), fanuc(), "G0 X1.\nM98 P7\nM30\nO7\nG0 X#500\nM99\n");
  EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  ASSERT_EQ(answer.diagnostics.size(), 1U);
  EXPECT_EQ(answer.diagnostics[0].code(), 900303);
  EXPECT_EQ(answer.diagnostics[0].line(), 5U);
  ASSERT_EQ(answer.diagnostics[0].calls_size(), 1);
  EXPECT_EQ(answer.diagnostics[0].calls(0).subprogram(), "O0007");
  EXPECT_EQ(answer.diagnostics[0].calls(0).called_from(), 2U);
  EXPECT_FALSE(answer.diagnostics[0].calls(0).has_line_within());
}

TEST(ComputingPrograms, WithoutEndAreEndedByTheDeadline) {
  InProcessServer server;
  v1::ProgramSetup setup = fanuc();
  setup.set_max_executed_lines(1'000'000'000);
  const auto stub = v1::TrcService::NewStub(server.channel());
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(200));
  const auto stream = stub->CompensateProgram(&context);
  v1::CompensateProgramRequest request;
  *request.mutable_setup() = setup;
  stream->Write(request);
  request.mutable_text()->set_text("N10 GOTO 10\n");
  request.mutable_text()->set_final(true);
  stream->Write(request);
  v1::CompensateProgramResponse response;
  while (stream->Read(&response)) {
  }
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  // The worker is free again.
  const StreamAnswer next = run_program(server.channel(), fanuc(), "G0 X1.\nM30\n");
  EXPECT_TRUE(next.status.ok()) << next.status.error_message();
}

// What is collected is sent again with the text since the last token.
TEST(ComputingPrograms, GiveNoTokenFromTheFirstLineThatComputesOn) {
  InProcessServer server;
  v1::ProgramSetup setup = fanuc();
  setup.mutable_path()->set_want_resume_tokens(true);
  const auto stub = v1::TrcService::NewStub(server.channel());
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(60));
  const auto stream = stub->CompensateProgram(&context);
  std::uint64_t sent = 0;
  const auto ask = [&](const std::string& text) {
    v1::CompensateProgramRequest request;
    request.mutable_text()->set_text(text);
    request.mutable_text()->set_first_byte(sent);
    sent += text.size();
    stream->Write(request);
    v1::CompensateProgramResponse response;
    stream->Read(&response);
    return response;
  };
  v1::CompensateProgramRequest request;
  *request.mutable_setup() = setup;
  stream->Write(request);
  v1::CompensateProgramResponse response;
  stream->Read(&response);
  ASSERT_TRUE(response.has_accepted());
  EXPECT_FALSE(ask("G0 X1.\nG0 X2.\n").resume_token().empty());
  response = ask("#1=3\n");
  EXPECT_TRUE(response.resume_token().empty());
  EXPECT_EQ(response.consumed_bytes(), sent);
  context.TryCancel();
}

// Loops that do nothing, of each dialect that has them.
TEST(ComputingPrograms, DoNotGrowWithTheRoundsOfALoop) {
  if (!counts_heap) GTEST_SKIP() << "the heap is not counted";
  struct Loop {
    DialectName dialect;
    const char* text;
  };
  for (const Loop& loop :
       {Loop{DialectName::isg, "$FOR P1=0,1000000000,1\n$ENDFOR\nM30\n"},
        Loop{DialectName::isg, "P1=0\n$WHILE P1<1000000000\nP1=P1+1\n$ENDWHILE\nM30\n"},
        Loop{DialectName::isg, "P1=0\n$DO\n$IF P1==1\n$ENDIF\n$ENDDO\nM30\n"},
        Loop{DialectName::fanuc, "O1\n#1=0\nWHILE[#1LT1000000000]DO1\n#1=#1+1\nEND1\nM30\n"},
        Loop{DialectName::sinumerik, "FOR R1=0 TO 1000000000\nENDFOR\nM30\n"},
        Loop{DialectName::sinumerik, "LOOP\nR1=1\nENDLOOP\nM30\n"},
        Loop{DialectName::linuxcnc, "o1 while [1]\n#1=1\no1 endwhile\nM2\n"}}) {
    SessionSetup setup;
    setup.program.dialect = loop.dialect;
    setup.program.max_executed_lines = 1'000'000'000;
    ProgramSession session({.session = setup});
    Answers out;
    ASSERT_TRUE(session.feed(loop.text, out)) << loop.text;
    std::int64_t before = 0;
    for (int call = 0; call < 60; ++call) {
      if (call == 10) before = bytes_taken_by_thread();
      ASSERT_TRUE(session.resolve(out)) << loop.text << out.take().text;
    }
    EXPECT_LT(bytes_taken_by_thread() - before, 4096) << loop.text;
  }
}

TEST(ComputingPrograms, HaveASetupThatIsChecked) {
  InProcessServer server;
  v1::ProgramSetup setup = fanuc();
  setup.set_max_executed_lines(0);
  (*setup.mutable_variables())[std::string(300, 'x')] = 1;
  const StreamAnswer answer = run_program(server.channel(), setup, "M30\n");
  EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
}

}  // namespace
}  // namespace trc::server::computing
