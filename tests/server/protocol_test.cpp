#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "proto/wire/block.h"
#include "server/in_process.h"
#include "tests/server/calls.h"

namespace trc::server {
namespace {

v1::CompensatePathRequest columns_of(const v1::CompensatePathRequest& request) {
  std::vector<wire::PathInput> items;
  wire::BlockReader reader(6);
  wire::FieldFaults faults;
  reader.read(
      request.batch(),
      [&items](const wire::PathInput& item) {
        items.push_back(item);
        return true;
      },
      faults);
  EXPECT_TRUE(faults.empty());
  v1::CompensatePathRequest columns;
  wire::BlockWriter().write(items, *columns.mutable_columns());
  columns.mutable_columns()->set_final(request.batch().final());
  columns.mutable_columns()->set_first_block(request.batch().first_block());
  return columns;
}

// A square that is left at its start corner.
std::vector<v1::Block> square(v1::CompensationSide side) {
  return {command(side),
          line_to(20, 0),
          line_to(20, 20),
          line_to(0, 20),
          line_to(0, 0),
          line_to(20, 0),
          command(v1::COMPENSATION_SIDE_OFF),
          line_to(40, -20)};
}

v1::PathSetup tool(double radius) {
  v1::PathSetup setup;
  setup.set_tool_radius(radius);
  setup.mutable_start_position()->set_x(-20);
  return setup;
}

TEST(Protocol, LayoutsMayBeMixedInOneStream) {
  const InProcessServer server;
  const std::vector<v1::Block> blocks = square(v1::COMPENSATION_SIDE_RIGHT);
  const StreamAnswer whole =
      call_path(server.channel(), {setup_request(tool(2)), batch(0, blocks, true)});
  ASSERT_TRUE(whole.status.ok()) << whole.status.error_message();
  ASSERT_FALSE(whole.blocks.empty());

  const std::vector<v1::Block> first(blocks.begin(), blocks.begin() + 3);
  const std::vector<v1::Block> second(blocks.begin() + 3, blocks.begin() + 6);
  const std::vector<v1::Block> third(blocks.begin() + 6, blocks.end());
  const StreamAnswer mixed =
      call_path(server.channel(), {setup_request(tool(2)), columns_of(batch(0, first, false)),
                                   batch(3, second, false), columns_of(batch(6, third, true))});
  ASSERT_TRUE(mixed.status.ok()) << mixed.status.error_message();
  EXPECT_EQ(mixed.bytes(), whole.bytes());
}

// Rule 1.5.
TEST(Protocol, NegativeRadiusInTheSetupSwapsTheSide) {
  const InProcessServer server;
  const StreamAnswer right =
      call_path(server.channel(),
                {setup_request(tool(2)), batch(0, square(v1::COMPENSATION_SIDE_RIGHT), true)});
  const StreamAnswer left =
      call_path(server.channel(),
                {setup_request(tool(-2)), batch(0, square(v1::COMPENSATION_SIDE_LEFT), true)});
  ASSERT_TRUE(right.status.ok()) << right.status.error_message();
  ASSERT_FALSE(right.blocks.empty());
  EXPECT_EQ(left.bytes(), right.bytes());
}

// What was certain before the fault comes out, whichever way the blocks are batched.
TEST(Protocol, WrongBlockEndsThePathAtTheSamePlaceInAnyBatching) {
  const InProcessServer server;
  std::vector<v1::Block> blocks = square(v1::COMPENSATION_SIDE_RIGHT);
  blocks[5].mutable_linear()->mutable_end()->set_x(1e300);
  const StreamAnswer whole =
      call_path(server.channel(), {setup_request(tool(2)), batch(0, blocks, true)});
  EXPECT_EQ(whole.status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(whole.reason(), "FIELD_INVALID");
  EXPECT_EQ(whole.metadata("field"), "batch.blocks[5].linear.end.x");
  EXPECT_FALSE(whole.blocks.empty());
  EXPECT_EQ(whole.summaries, 0);

  std::vector<v1::CompensatePathRequest> single{setup_request(tool(2))};
  for (std::size_t i = 0; i < blocks.size(); ++i)
    single.push_back(batch(i, {blocks[i]}, i + 1 == blocks.size()));
  const StreamAnswer one_by_one = call_path(server.channel(), single);
  EXPECT_EQ(one_by_one.status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(one_by_one.metadata("field"), "batch.blocks[0].linear.end.x");
  EXPECT_EQ(one_by_one.bytes(), whole.bytes());
}

TEST(Protocol, SelectionBeyondTheLimitIsALimitAndNoFaultOfTheProgram) {
  Config config = InProcessServer::quiet();
  config.max_blocks_per_selection = 10;
  const InProcessServer server(config);
  v1::PathSetup setup = tool(1);
  setup.set_contour_masking(v1::CONTOUR_MASKING_ON);
  std::vector<v1::Block> blocks{command(v1::COMPENSATION_SIDE_LEFT)};
  for (int i = 0; i < 30; ++i) blocks.push_back(line_to(10.0 * i, i % 2 == 0 ? 0 : 5));
  const StreamAnswer answer =
      call_path(server.channel(), {setup_request(setup), batch(0, blocks, true)});
  EXPECT_EQ(answer.status.error_code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_EQ(answer.reason(), "SELECTION_TOO_LONG");
  EXPECT_FALSE(answer.metadata("remedy").empty());
  EXPECT_EQ(answer.summaries, 0);
}

// gRPC's own refusal says no reason.
TEST(Protocol, RequestThatIsTooLargeIsToldWithItsLimit) {
  Config config = InProcessServer::quiet();
  config.max_message_bytes = 4096;
  const InProcessServer server(config);
  const std::string large(5000, ' ');
  const StreamAnswer program = call_program(
      server.channel(), {setup_request(v1::ProgramSetup()), text_request(0, large, true)});
  EXPECT_EQ(program.status.error_code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_EQ(program.reason(), "MESSAGE_TOO_LARGE");
  EXPECT_EQ(program.metadata("max_message_bytes"), "4096");
  EXPECT_GT(std::stoul(program.metadata("message_bytes")), 5000U);
  EXPECT_NE(program.status.error_message().find("max-message-bytes"), std::string::npos);
  EXPECT_EQ(program.accepted, 1);
  EXPECT_EQ(program.summaries, 0);

  v1::PathSetup tagged;
  tagged.set_client_tag(large);
  EXPECT_EQ(call_path(server.channel(), {setup_request(tagged)}).reason(), "MESSAGE_TOO_LARGE");
  v1::PreviewPathRequest preview;
  *preview.mutable_setup() = tagged;
  EXPECT_EQ(call_preview(server.channel(), preview).reason(), "MESSAGE_TOO_LARGE");
}

// Of a client of another version, or a slip of the pen: it is told what there is.
TEST(Protocol, CallOfAnRpcThatThereIsNotNamesThoseThereAre) {
  const InProcessServer server;
  for (const char* path : {"/trc.v1.TrcService/NoSuch", "/trc.v2.TrcService/CompensatePath",
                           "/trc.v1.TrcService", "/none"}) {
    SCOPED_TRACE(path);
    grpc::ClientContext context;
    grpc::GenericStub stub(server.channel());
    grpc::CompletionQueue queue;
    const grpc::ByteBuffer request;
    const auto call = stub.PrepareUnaryCall(&context, path, request, &queue);
    grpc::ByteBuffer response;
    StreamAnswer answer;
    call->StartCall();
    call->Finish(&response, &answer.status, nullptr);
    void* tag = nullptr;
    bool ok = false;
    ASSERT_TRUE(queue.Next(&tag, &ok));
    EXPECT_EQ(answer.status.error_code(), grpc::UNIMPLEMENTED);
    EXPECT_EQ(answer.reason(), "RPC_UNKNOWN");
    EXPECT_EQ(answer.metadata("rpc"), path);
    const auto& service = *v1::GetServerInfoRequest::descriptor()->file()->service(0);
    for (int i = 0; i < service.method_count(); ++i)
      EXPECT_NE(answer.status.error_message().find(service.method(i)->name()), std::string::npos)
          << answer.status.error_message();
  }
}

}  // namespace
}  // namespace trc::server
