#include <google/protobuf/unknown_field_set.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include <string>

#include "server/in_process.h"
#include "tests/server/calls.h"

// CompensateProgramOnce gives what the stream gives, and never half of it.
namespace trc::server {
namespace {

struct Once {
  grpc::Status status;
  v1::CompensateProgramOnceResponse response;
};

Once call_once(const InProcessServer& server, const v1::ProgramSetup& setup,
               std::string_view text) {
  v1::CompensateProgramOnceRequest request;
  *request.mutable_setup() = setup;
  request.set_text(std::string(text));
  grpc::ClientContext context;
  Once once;
  once.status = v1::TrcService::NewStub(server.channel())
                    ->CompensateProgramOnce(&context, request, &once.response);
  return once;
}

TEST(CompensateProgramOnce, GivesTheTextAndTheDiagnosticsOfTheStream) {
  const InProcessServer server;
  v1::ProgramSetup setup;
  setup.mutable_path()->set_tool_radius(10);
  const StreamAnswer stream = run_program(server.channel(), setup, g239_program);
  const Once once = call_once(server, setup, g239_program);
  ASSERT_TRUE(once.status.ok()) << once.status.error_message();
  EXPECT_EQ(once.response.nc_text(), stream.text);
  EXPECT_FALSE(once.response.nc_text().empty());
  EXPECT_EQ(once.response.diagnostics_size(), static_cast<int>(stream.diagnostics.size()));
  EXPECT_EQ(once.response.summary().path().blocks_out(),
            stream.program_summary.path().blocks_out());
}

TEST(CompensateProgramOnce, GivesBlocksInBothLayouts) {
  const InProcessServer server;
  const StreamAnswer stream = run_program(server.channel(), blocks_setup(), g239_program);
  const Once blocks = call_once(server, blocks_setup(), g239_program);
  ASSERT_TRUE(blocks.status.ok());
  ASSERT_EQ(blocks.response.blocks_size(), static_cast<int>(stream.blocks.size()));
  for (int i = 0; i < blocks.response.blocks_size(); ++i)
    EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(
        blocks.response.blocks(i), stream.blocks[static_cast<std::size_t>(i)]));
  const Once columns = call_once(server, blocks_setup(v1::RESPONSE_LAYOUT_COLUMNS), g239_program);
  ASSERT_TRUE(columns.status.ok());
  std::size_t count = 0;
  for (const auto& stretch : columns.response.columns()) count += stretch.kinds().size();
  EXPECT_EQ(count, stream.blocks.size());
}

TEST(CompensateProgramOnce, RefusedProgramHasNoAnswer) {
  const InProcessServer server;
  const Once once = call_once(server, {}, "N10 G1 X10 F100\nN20 G999\n");
  EXPECT_EQ(once.status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_NE(once.status.error_message().find("line 2"), std::string::npos);
  EXPECT_TRUE(once.response.nc_text().empty());
}

TEST(CompensateProgramOnce, AnswerThatPassesTheLimitIsRefused) {
  Config config = InProcessServer::quiet();
  config.max_message_bytes = 4096;
  const InProcessServer server(config);
  std::string text;
  for (int i = 0; i < 200; ++i) text += "G1 X" + std::to_string(i) + "\n";
  v1::ProgramSetup setup = blocks_setup();
  const Once once = call_once(server, setup, text);
  EXPECT_EQ(once.status.error_code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_NE(once.status.error_message().find("max-message-bytes"), std::string::npos);
}

TEST(CompensateProgramOnce, TakesNoResumeTokens) {
  const InProcessServer server;
  v1::ProgramSetup setup;
  setup.mutable_path()->set_want_resume_tokens(true);
  const grpc::Status wanted = call_once(server, setup, "G0 X1\n").status;
  EXPECT_EQ(wanted.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(
      wanted.error_message(),
      "setup.path.want_resume_tokens is set, but CompensateProgramOnce gives no resume tokens");
  setup.mutable_path()->set_want_resume_tokens(false);
  setup.mutable_path()->set_resume_token("a");
  EXPECT_EQ(call_once(server, setup, "G0 X1\n").status.error_message(),
            "the resume token cannot be used; begin the path anew, without it: "
            "CompensateProgramOnce takes none");
}

TEST(CompensateProgramOnce, HasTheDefaultsWithoutASetup) {
  const InProcessServer server;
  const auto stub = v1::TrcService::NewStub(server.channel());
  grpc::ClientContext context;
  v1::CompensateProgramOnceRequest request;
  request.set_text("G0 X1\n");
  v1::CompensateProgramOnceResponse response;
  EXPECT_TRUE(stub->CompensateProgramOnce(&context, request, &response).ok());
}

TEST(CompensateProgramOnce, RefusesAFieldThatNobodyKnows) {
  const InProcessServer server;
  v1::ProgramSetup setup;
  setup.GetReflection()->MutableUnknownFields(&setup)->AddVarint(4711, 1);
  const Once once = call_once(server, setup, g239_program);
  EXPECT_EQ(once.status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_NE(once.status.error_message().find("field 4711 of trc.v1.ProgramSetup"),
            std::string::npos)
      << once.status.error_message();
}

}  // namespace
}  // namespace trc::server
