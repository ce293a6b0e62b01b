#include <google/protobuf/unknown_field_set.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "server/in_process.h"
#include "tests/server/calls.h"

// Input that no sane client sends: each ends with a clear error, and the server goes on.
namespace trc::server {
namespace {

class Junk : public ::testing::Test {
 protected:
  // The server still computes.
  void TearDown() override {
    EXPECT_TRUE(run_program(server_.channel(), {}, g239_program).status.ok());
  }

  // Refused as a program: a diagnostic with a remedy, and the same in the status.
  void expect_refused(const StreamAnswer& answer, int code) const {
    EXPECT_EQ(answer.status.error_code(), grpc::INVALID_ARGUMENT) << answer.status.error_message();
    EXPECT_EQ(answer.summaries, 0);
    ASSERT_FALSE(answer.diagnostics.empty());
    const v1::Diagnostic& last = answer.diagnostics.back();
    EXPECT_EQ(last.severity(), v1::Diagnostic::ERROR);
    EXPECT_EQ(last.code(), code) << last.ShortDebugString();
    EXPECT_FALSE(last.message().empty());
    EXPECT_FALSE(last.remedy().empty());
    EXPECT_EQ(answer.metadata("code"), std::to_string(last.code()));
  }

  StreamAnswer run(std::string_view program) const { return run_program(channel(), {}, program); }
  [[nodiscard]] const std::shared_ptr<grpc::Channel>& channel() const { return server_.channel(); }

  // Refused as a message: the field is named.
  void expect_field(const StreamAnswer& answer, const std::string& field) const {
    EXPECT_EQ(answer.status.error_code(), grpc::INVALID_ARGUMENT) << answer.status.error_message();
    EXPECT_EQ(answer.reason(), "FIELD_INVALID");
    EXPECT_EQ(answer.metadata("field"), field);
  }

 private:
  InProcessServer server_;
};

TEST_F(Junk, EmptyProgram) {
  expect_refused(run(""), 900014);
  expect_refused(run("\n\r\n  \n"), 900014);
}

TEST_F(Junk, LineOfTenMegabytes) {
  const std::string line = "N10 G1 X1 (" + std::string(10'000'000, 'x') + ")\n";
  std::vector<v1::CompensateProgramRequest> requests{setup_request(v1::ProgramSetup())};
  constexpr std::size_t piece = 500'000;
  for (std::size_t at = 0; at < line.size(); at += piece)
    requests.push_back(
        text_request(at, std::string_view(line).substr(at, piece), at + piece >= line.size()));
  expect_refused(call_program(channel(), requests), 900006);
}

TEST_F(Junk, BytesThatAreNoText) {
  std::string binary =
      "\x7F"
      "ELF";
  for (int i = 0; i < 4096; ++i) binary += static_cast<char>(i * 37 % 256);
  const StreamAnswer answer = run(binary);
  EXPECT_EQ(answer.status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_FALSE(answer.diagnostics.empty());
  expect_refused(run("N10 G1 X1 (\xFF\xFE)\n"), 900007);
}

TEST_F(Junk, HalfOfACharacter) {
  expect_refused(run("N10 G1 X1 (Fr\xC3)\n"), 900007);
  expect_refused(run("N10 G1 X1\xC3"), 900007);
}

TEST_F(Junk, UnclosedCommand) {
  expect_refused(run("N10 G0 X0 Y0\n#TRC["), 900009);
  expect_refused(run("N10 G0 X0 Y0\n#TRC[ KERF_MASKING=1\nN20 X1\n"), 900009);
}

TEST_F(Junk, NumbersThatAreNone) {
  for (const char* word : {"XNAN", "XINF", "X--1", "X1.2.3", "X"})
    EXPECT_EQ(run("N10 G1 " + std::string(word) + "\n").status.error_code(), grpc::INVALID_ARGUMENT)
        << word;
  EXPECT_EQ(run("N10 G1 X1" + std::string(300, '0') + "\n").status.error_code(),
            grpc::INVALID_ARGUMENT);
  expect_refused(run("N10 G0 X0 Y0\nN20 G1 X1000001 F100\n"), 90134);
}

TEST_F(Junk, CoordinatesOfMessagesThatAreNone) {
  for (const double x : {std::numeric_limits<double>::quiet_NaN(),
                         std::numeric_limits<double>::infinity(), 1e300, -1e300, 1e6 + 1}) {
    const StreamAnswer answer =
        call_path(channel(), {setup_request(v1::PathSetup()),
                              batch(0, {line_to(1, 1), line_to(2, 2), line_to(x, 0)}, true)});
    expect_field(answer, "batch.blocks[2].linear.end.x");
    EXPECT_EQ(answer.blocks.size(), 2U) << "what was certain before is delivered";
  }
}

TEST_F(Junk, SetupOutOfRange) {
  v1::PathSetup setup;
  setup.set_tool_radius(std::numeric_limits<double>::quiet_NaN());
  expect_field(call_path(channel(), {setup_request(setup)}), "setup.tool_radius");
  setup.set_tool_radius(5);
  setup.set_selection_mode(static_cast<v1::SelectionMode>(77));
  expect_field(call_path(channel(), {setup_request(setup)}), "setup.selection_mode");
}

// Of a newer client, or garbage: an option that is passed over makes another path than was meant.
void add_unknown(google::protobuf::Message& message) {
  message.GetReflection()->MutableUnknownFields(&message)->AddVarint(4711, 1);
}

TEST_F(Junk, FieldsThatNobodyKnows) {  // D-164
  const auto expect_unknown = [](const StreamAnswer& answer, const std::string& message,
                                 const std::string& place) {
    EXPECT_EQ(answer.status.error_code(), grpc::INVALID_ARGUMENT) << answer.status.error_message();
    EXPECT_EQ(answer.reason(), "FIELD_UNKNOWN");
    EXPECT_EQ(answer.metadata("message"), message);
    EXPECT_EQ(answer.metadata("field"), place);
    EXPECT_EQ(answer.metadata("field_number"), "4711");
    EXPECT_EQ(answer.summaries, 0);
    EXPECT_TRUE(answer.blocks.empty());
  };
  v1::ProgramSetup program;
  add_unknown(*program.mutable_path()->mutable_options());
  const StreamAnswer answer = run_program(channel(), program, g239_program);
  expect_unknown(answer, "trc.v1.TrcOptions", "setup.path.options");
  EXPECT_NE(answer.status.error_message().find(
                "leave the field out: field 4711 of trc.v1.TrcOptions, in setup.path.options"),
            std::string::npos)
      << answer.status.error_message();

  v1::CompensatePathRequest blocks = batch(0, {line_to(1, 1), line_to(2, 2)}, true);
  add_unknown(*blocks.mutable_batch()->mutable_blocks(1)->mutable_linear()->mutable_end());
  expect_unknown(call_path(channel(), {setup_request(v1::PathSetup()), blocks}), "trc.v1.Position",
                 "batch.blocks[1].linear.end");

  v1::PreviewPathRequest preview;
  add_unknown(*preview.mutable_setup());
  expect_unknown(call_preview(channel(), preview), "trc.v1.PathSetup", "setup");

  // A kind of request that there is only later.
  v1::CompensatePathRequest unheard_of;
  add_unknown(unheard_of);
  expect_unknown(call_path(channel(), {setup_request(v1::PathSetup()), unheard_of}),
                 "trc.v1.CompensatePathRequest", "");
}

// Protobuf drops such a field while it parses, and the variable would be 0.
TEST_F(Junk, FieldsOfAMapThatNobodyKnows) {  // D-164
  v1::ProgramSetup program;
  program.GetReflection()
      ->MutableUnknownFields(&program)
      ->AddLengthDelimited(v1::ProgramSetup::kVariablesFieldNumber)
      ->assign("\x0A\x04#500\x15\0\0\xA0@", 11);
  const StreamAnswer answer = run_program(channel(), program, g239_program);
  EXPECT_EQ(answer.reason(), "FIELD_UNKNOWN") << answer.status.error_message();
  EXPECT_EQ(answer.metadata("message"), "trc.v1.ProgramSetup.VariablesEntry");
  EXPECT_EQ(answer.metadata("field"), "setup.variables");
  EXPECT_EQ(answer.metadata("field_number"), "2");
}

TEST_F(Junk, ColumnsOfDifferentLength) {
  v1::CompensatePathRequest request;
  request.mutable_columns()->set_kinds(std::string(3, static_cast<char>(1)));
  request.mutable_columns()->add_x(1);
  request.mutable_columns()->set_final(true);
  const StreamAnswer answer = call_path(channel(), {setup_request(v1::PathSetup()), request});
  EXPECT_EQ(answer.status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(answer.reason(), "FIELD_INVALID");
  EXPECT_EQ(answer.metadata("field"), "columns.x");
}

}  // namespace
}  // namespace trc::server
