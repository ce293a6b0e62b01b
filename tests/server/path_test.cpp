#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "proto/wire/block.h"
#include "server/in_process.h"
#include "tests/server/calls.h"

namespace trc::server {
namespace {

class CompensatePathRpc : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { server_ = new InProcessServer(); }
  static void TearDownTestSuite() {
    delete server_;
    server_ = nullptr;
  }
  [[nodiscard]] const std::shared_ptr<grpc::Channel>& channel() const { return server_->channel(); }

  static InProcessServer* server_;
};
InProcessServer* CompensatePathRpc::server_ = nullptr;

v1::PathSetup g239_setup() {
  v1::PathSetup setup;
  setup.set_tool_radius(10);
  setup.set_selection_mode(v1::SELECTION_MODE_WITHOUT_BLOCK);
  return setup;
}

std::vector<v1::Block> g239_blocks() {
  return {command(v1::COMPENSATION_SIDE_LEFT),
          line_to(30, 20),
          line_to(60, 20),
          line_to(90, 20),
          line_to(120, 20),
          command(v1::COMPENSATION_SIDE_OFF),
          line_to(150, 0)};
}

constexpr const char* g239_listing =
    "APPROACH 0 0 -> 30 30\n"
    "PROGRAMMED 30 30 -> 60 30\n"
    "PROGRAMMED 60 30 -> 90 30\n"
    "PROGRAMMED 90 30 -> 120 30\n"
    "UNCOMPENSATED 120 30 -> 150 0";

// A zigzag with corners of every kind, some text, and a change of radius.
std::vector<v1::Block> long_path(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<v1::Block> blocks{command(v1::COMPENSATION_SIDE_LEFT)};
  for (int i = 0; i < count; ++i) {
    const double across = static_cast<double>(random() % 2000) / 100;
    blocks.push_back(line_to(25.0 * i, across));
    blocks.back().set_source_number(static_cast<std::uint64_t>(10 * i));
    if (i % 17 == 3) {
      v1::Block text;
      text.mutable_passthrough()->set_text("M8");
      blocks.push_back(text);
    }
  }
  blocks.push_back(command(v1::COMPENSATION_SIDE_OFF));
  blocks.push_back(line_to(25.0 * count, -50));
  return blocks;
}

v1::PathSetup small_tool() {
  v1::PathSetup setup;
  setup.set_tool_radius(0.5);
  setup.set_transition(v1::TRANSITION_CIRCULAR);
  return setup;
}

TEST_F(CompensatePathRpc, DirectSelectionWithoutBlockAsInExampleT01) {
  const StreamAnswer answer =
      call_path(channel(), {setup_request(g239_setup()), batch(0, g239_blocks(), true)});
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(answer.listing(), g239_listing);
  EXPECT_EQ(answer.accepted, 1);
  EXPECT_EQ(answer.summaries, 1);
  EXPECT_EQ(answer.consumed, 6U);
  EXPECT_EQ(answer.path_summary.blocks_in(), 5U);
  EXPECT_EQ(answer.path_summary.blocks_out(), 5U);
}

TEST_F(CompensatePathRpc, PreviewGivesTheSamePath) {
  v1::PreviewPathRequest request;
  *request.mutable_setup() = g239_setup();
  *request.mutable_batch() = batch(0, g239_blocks(), false).batch();
  const StreamAnswer answer = call_preview(channel(), request);
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(answer.listing(), g239_listing);
  EXPECT_EQ(answer.summaries, 1);
}

TEST_F(CompensatePathRpc, PreviewRefusesAsTheStreamDoes) {
  EXPECT_EQ(call_preview(channel(), {}).reason(), "SETUP_MISSING");
  v1::PreviewPathRequest request;
  *request.mutable_setup() = g239_setup();
  *request.mutable_batch() = batch(1, g239_blocks(), false).batch();
  EXPECT_EQ(call_preview(channel(), request).status.error_code(), grpc::OUT_OF_RANGE);
  request.mutable_setup()->set_want_resume_tokens(true);
  EXPECT_EQ(call_preview(channel(), request).metadata("field"), "setup.want_resume_tokens");
  request.mutable_setup()->set_resume_token("a");
  EXPECT_EQ(call_preview(channel(), request).metadata("field"), "setup.resume_token");
}

TEST_F(CompensatePathRpc, AnyBatchingGivesTheSamePath) {
  constexpr unsigned seed = 7;
  SCOPED_TRACE("seed " + std::to_string(seed));
  const std::vector<v1::Block> blocks = long_path(300, seed);
  const StreamAnswer whole =
      call_path(channel(), {setup_request(small_tool()), batch(0, blocks, true)});
  ASSERT_TRUE(whole.status.ok()) << whole.status.error_message();
  ASSERT_GT(whole.blocks.size(), 300U);

  std::mt19937 random(seed);
  for (int round = 0; round < 10; ++round) {
    std::vector<v1::CompensatePathRequest> requests{setup_request(small_tool())};
    std::size_t from = 0;
    while (from < blocks.size()) {
      const std::size_t size = std::min<std::size_t>(random() % 40, blocks.size() - from);
      const auto begin = blocks.begin() + static_cast<std::ptrdiff_t>(from);
      const std::vector<v1::Block> part(begin, begin + static_cast<std::ptrdiff_t>(size));
      requests.push_back(batch(from, part, from + size == blocks.size()));
      from += size;
    }
    const StreamAnswer parts = call_path(channel(), requests);
    ASSERT_TRUE(parts.status.ok()) << parts.status.error_message();
    EXPECT_EQ(parts.bytes(), whole.bytes());
    EXPECT_GE(parts.responses, static_cast<int>(requests.size()));
  }
}

TEST_F(CompensatePathRpc, BothLayoutsInBothDirectionsGiveTheSamePath) {
  const std::vector<v1::Block> blocks = long_path(100, 3);
  const StreamAnswer messages =
      call_path(channel(), {setup_request(small_tool()), batch(0, blocks, true)});
  ASSERT_TRUE(messages.status.ok()) << messages.status.error_message();

  std::vector<wire::PathInput> items;
  wire::BlockReader reader(6);
  wire::FieldFaults faults;
  reader.read(
      batch(0, blocks, true).batch(),
      [&](const wire::PathInput& item) {
        items.push_back(item);
        return true;
      },
      faults);
  ASSERT_TRUE(faults.empty());
  v1::CompensatePathRequest request;
  wire::BlockWriter().write(items, *request.mutable_columns());
  request.mutable_columns()->set_final(true);
  v1::PathSetup setup = small_tool();
  setup.set_response_layout(v1::RESPONSE_LAYOUT_COLUMNS);
  const StreamAnswer columns = call_path(channel(), {setup_request(setup), request});
  ASSERT_TRUE(columns.status.ok()) << columns.status.error_message();
  EXPECT_EQ(columns.bytes(), messages.bytes());
}

TEST_F(CompensatePathRpc, EndsAsTheProtocolSays) {
  const auto setup = setup_request(g239_setup());
  const auto part = batch(0, {line_to(1, 1)}, false);
  const auto last = batch(0, {line_to(1, 1)}, true);
  v1::CompensatePathRequest nothing;
  struct Case {
    const char* name;
    std::vector<v1::CompensatePathRequest> requests;
    grpc::StatusCode code;
    const char* reason;
  };
  const std::vector<Case> cases{
      {"nothing sent", {}, grpc::FAILED_PRECONDITION, "SETUP_MISSING"},
      {"no setup", {part}, grpc::FAILED_PRECONDITION, "SETUP_MISSING"},
      {"empty request", {nothing}, grpc::INVALID_ARGUMENT, "REQUEST_EMPTY"},
      {"setup twice", {setup, setup}, grpc::FAILED_PRECONDITION, "SETUP_REPEATED"},
      {"setup after blocks", {setup, part, setup}, grpc::FAILED_PRECONDITION, "SETUP_REPEATED"},
      {"first block wrong",
       {setup, batch(5, {line_to(1, 1)}, false)},
       grpc::OUT_OF_RANGE,
       "BATCH_OUT_OF_SEQUENCE"},
      {"batch repeated", {setup, part, part}, grpc::OUT_OF_RANGE, "BATCH_OUT_OF_SEQUENCE"},
      {"no final", {setup, part}, grpc::ABORTED, "CONTOUR_INCOMPLETE"},
      {"setup only", {setup}, grpc::ABORTED, "CONTOUR_INCOMPLETE"},
      {"after final",
       {setup, last, batch(1, {line_to(2, 2)}, true)},
       grpc::FAILED_PRECONDITION,
       "INPUT_AFTER_FINAL"},
  };
  for (const Case& tested : cases) {
    SCOPED_TRACE(tested.name);
    const StreamAnswer answer = call_path(channel(), tested.requests);
    EXPECT_EQ(answer.status.error_code(), tested.code) << answer.status.error_message();
    EXPECT_EQ(answer.reason(), tested.reason);
  }
}

TEST_F(CompensatePathRpc, EmptyRequestSaysWhereAndWhatIsTaken) {
  const StreamAnswer answer = call_path(channel(), {v1::CompensatePathRequest()});
  EXPECT_EQ(answer.status.error_message(),
            "the request carries nothing this server knows; update the server if the client is "
            "newer, or send what it takes: setup, batch or columns");
  EXPECT_EQ(answer.metadata("field"), "request");
}

TEST_F(CompensatePathRpc, OutOfSequenceSaysWhatWasExpected) {
  const StreamAnswer answer =
      call_path(channel(), {setup_request(g239_setup()), batch(0, {line_to(1, 1)}, false),
                            batch(3, {line_to(2, 2)}, false)});
  EXPECT_EQ(answer.metadata("expected"), "1");
  EXPECT_EQ(answer.metadata("got"), "3");
}

TEST_F(CompensatePathRpc, EmptyBatchesAreAnsweredToo) {
  const StreamAnswer answer =
      call_path(channel(), {setup_request(g239_setup()), batch(0, {}, false), batch(0, {}, false),
                            batch(0, g239_blocks(), false), batch(7, {}, true)});
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(answer.listing(), g239_listing);
  EXPECT_GE(answer.responses, 5);
}

TEST_F(CompensatePathRpc, ServerInfoNamesLimitsAndTables) {
  grpc::ClientContext context;
  v1::GetServerInfoResponse info;
  ASSERT_TRUE(v1::TrcService::NewStub(channel())->GetServerInfo(&context, {}, &info).ok());
  EXPECT_FALSE(info.version().empty());
  EXPECT_EQ(info.limits().max_message_bytes(), 1048576U);
  EXPECT_EQ(info.limits().max_streams(), 1000U);
  EXPECT_GE(info.trc_keywords_size(), 18);
  EXPECT_GE(info.g_functions_size(), 30);
  int previous = 0;
  for (const auto& row : info.diagnostics()) {
    EXPECT_GT(row.code(), previous);
    EXPECT_FALSE(row.remedy().empty());
    previous = row.code();
  }
  EXPECT_GT(info.diagnostics_size(), 40);
}

}  // namespace
}  // namespace trc::server
