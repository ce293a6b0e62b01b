#include "server/http/formats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "server/rpc/status.h"

namespace trc::server::http {
namespace {

v1::Diagnostic diagnostic(v1::Diagnostic::Severity severity, int code, unsigned line) {
  v1::Diagnostic made;
  made.set_severity(severity);
  made.set_code(code);
  made.set_line(line);
  return made;
}

TEST(NcTextFormat, PassesTheTextAndCountsItsWarnings) {
  v1::CompensateProgramResponse answer;
  answer.set_nc_text("G1 X1\n");
  *answer.add_diagnostics() = diagnostic(v1::Diagnostic::NOTE, 1, 1);
  *answer.add_diagnostics() = diagnostic(v1::Diagnostic::WARNING, 22007, 3);
  *answer.add_diagnostics() = diagnostic(v1::Diagnostic::WARNING, 22008, 4);
  NcTextFormat format;
  std::string out;
  ASSERT_TRUE(format.take(RpcCall::bytes_of(answer), out));
  EXPECT_EQ(out, "G1 X1\n");
  EXPECT_EQ(format.headers_at_end(),
            (Pairs{{"Trc-Warnings", "2"}, {"Trc-First-Warning", "22007; line=3"}}));
}

TEST(NcTextFormat, EndsAProgramThatStopsWithALineThatNoControlTakes) {
  NcTextFormat format;
  std::string out = "G1 X";
  EXPECT_FALSE(format.stop({grpc::StatusCode::INVALID_ARGUMENT, "a gouge"}, out));
  EXPECT_EQ(out, "G1 X\n!!! TRC STOPPED, THIS PROGRAM IS NOT COMPLETE: a gouge !!!\n");
}

// Of an error in the program the diagnostic before has said it.
TEST(JsonLinesFormat, EndsWithTheProblemWhereItIsNotTheProgram) {
  JsonLinesFormat<v1::CompensateProgramResponse> format;
  std::string out;
  EXPECT_FALSE(format.stop(refuse(Refusal::drain_timeout).status, out));
  EXPECT_TRUE(out.starts_with("{\"problem\":{")) << out;
  EXPECT_TRUE(out.ends_with("}}\n")) << out;
  EXPECT_NE(out.find("\"reason\":\"DRAIN_TIMEOUT\""), std::string::npos) << out;
  out.clear();
  Diagnostic gouge;
  gouge.code = Code::line_reversed;
  EXPECT_FALSE(format.stop(refuse(gouge).status, out));
  EXPECT_EQ(out, "");
}

TEST(Format, TakesNothingThatIsNoAnswer) {
  const grpc::ByteBuffer bytes = RpcCall::bytes_of(std::string("\xff\xff\xff"));
  std::string out;
  EXPECT_FALSE(NcTextFormat().take(bytes, out));
  EXPECT_FALSE(JsonLinesFormat<v1::CompensateProgramResponse>().take(bytes, out));
  EXPECT_FALSE(RecordFormat().take(bytes, out));
}

TEST(JsonLinesFormat, WritesALineForEachBlockDiagnosticAndSummary) {
  v1::CompensateProgramResponse answer;
  answer.mutable_batch()->add_blocks();
  answer.mutable_batch()->add_blocks();
  *answer.add_diagnostics() = diagnostic(v1::Diagnostic::NOTE, 1, 1);
  JsonLinesFormat<v1::CompensateProgramResponse> format;
  std::string out;
  ASSERT_TRUE(format.take(RpcCall::bytes_of(answer), out));
  answer.Clear();
  answer.mutable_summary();
  ASSERT_TRUE(format.take(RpcCall::bytes_of(answer), out));
  EXPECT_EQ(std::count(out.begin(), out.end(), '\n'), 4);
}

TEST(PathAnswerFormat, RefusesMoreBytesOfBlocksThanItMayHold) {
  v1::CompensateProgramResponse answer;
  for (int block = 0; block < 10; ++block) answer.mutable_batch()->add_blocks();
  const std::size_t size = answer.ByteSizeLong();
  using Program = PathAnswerFormat<v1::CompensateProgramResponse>;
  Program held(Program::Blocks::given, 2 * size);
  std::string out;
  EXPECT_TRUE(held.take(RpcCall::bytes_of(answer), out));
  EXPECT_TRUE(held.take(RpcCall::bytes_of(answer), out));
  EXPECT_FALSE(held.take(RpcCall::bytes_of(answer), out));
  Program without_blocks(Program::Blocks::left_out, 0);
  EXPECT_TRUE(without_blocks.take(RpcCall::bytes_of(answer), out));
  without_blocks.close(out);
  EXPECT_EQ(out.find("blocks"), std::string::npos) << out;
}

}  // namespace
}  // namespace trc::server::http
