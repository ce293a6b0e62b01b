#include <google/protobuf/unknown_field_set.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "server/in_process.h"
#include "tests/server/calls.h"
#include "tests/support/slot.h"

// SurveyRadii: one program or path, many radii.
namespace trc::server {
namespace {

using support::slot;

struct Survey {
  grpc::Status status;
  int accepted = 0;
  std::vector<v1::SurveyedRadius> radii;
  std::vector<v1::Diagnostic> diagnostics;
  std::vector<v1::SurveySummary> summaries;
};

Survey call(const std::shared_ptr<grpc::Channel>& channel,
            const std::vector<v1::SurveyRadiiRequest>& requests) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(60));
  const auto stub = v1::TrcService::NewStub(channel);
  const auto stream = stub->SurveyRadii(&context);
  // Answers are read meanwhile: the server takes no more while one waits.
  std::thread writer([&] {
    for (const auto& request : requests)
      if (!stream->Write(request)) break;
    stream->WritesDone();
  });
  Survey survey;
  v1::SurveyRadiiResponse response;
  while (stream->Read(&response)) {
    survey.accepted += response.has_accepted() ? 1 : 0;
    if (response.has_radius()) survey.radii.push_back(response.radius());
    if (response.has_summary()) survey.summaries.push_back(response.summary());
    for (const auto& told : response.diagnostics()) survey.diagnostics.push_back(told);
  }
  writer.join();
  survey.status = stream->Finish();
  return survey;
}

v1::SurveyRadiiRequest setup_with(const std::vector<double>& radii, bool is_path = false) {
  v1::SurveyRadiiRequest request;
  v1::SurveySetup& setup = *request.mutable_setup();
  if (is_path)
    setup.mutable_path()->set_selection_mode(v1::SELECTION_MODE_DIRECT);
  else
    setup.mutable_program();
  for (const double radius : radii) setup.add_radii(radius);
  return request;
}

v1::SurveyRadiiRequest text_of(std::uint64_t first_byte, std::string_view text, bool final) {
  v1::SurveyRadiiRequest request;
  request.mutable_text()->set_first_byte(first_byte);
  request.mutable_text()->set_text(std::string(text));
  request.mutable_text()->set_final(final);
  return request;
}

Survey survey_program(const InProcessServer& server, const v1::SurveyRadiiRequest& setup,
                      std::string_view text) {
  // Cut within a word.
  const std::size_t cut = text.size() / 3;
  return call(server.channel(), {setup, text_of(0, text.substr(0, cut), false),
                                 text_of(cut, text.substr(cut), true)});
}

TEST(SurveyRadiiRpc, TellsOfEachRadiusAndOfTheLargest) {
  const InProcessServer server;
  const Survey survey = survey_program(server, setup_with({5, 3}), slot);
  ASSERT_TRUE(survey.status.ok()) << survey.status.error_message();
  EXPECT_EQ(survey.accepted, 1);
  ASSERT_EQ(survey.radii.size(), 2U);
  const v1::SurveyedRadius& large = survey.radii[0];
  EXPECT_EQ(large.radius(), 5);
  EXPECT_FALSE(large.accepted());
  EXPECT_FALSE(large.reaches_every_wall());
  EXPECT_GT(large.refusal().code(), 0);
  EXPECT_TRUE(large.refusal().has_point());
  EXPECT_FALSE(large.has_compensated_length());
  const v1::SurveyedRadius& small = survey.radii[1];
  EXPECT_TRUE(small.accepted());
  EXPECT_TRUE(small.reaches_every_wall());
  EXPECT_EQ(small.masked_share(), 0);
  EXPECT_NEAR(small.certificate().clearance(), 3, 1e-4);
  EXPECT_NEAR(small.uncut_length(), 12, 1e-6);
  EXPECT_NEAR(small.wall_length(), 88, 1e-6);
  EXPECT_TRUE(small.uncut().empty());
  ASSERT_EQ(survey.summaries.size(), 1U);
  const v1::LargestRadius& largest = survey.summaries.front().largest();
  EXPECT_TRUE(largest.is_limited());
  EXPECT_NEAR(largest.radius(), 4, 1e-3 + 1e-9);
  ASSERT_EQ(largest.limits_size(), 2);
  EXPECT_EQ(largest.limits(0).line(), 3U);
  EXPECT_EQ(largest.limits(1).line(), 5U);
  EXPECT_EQ(largest.limits(1).source_number(), 50U);
}

TEST(SurveyRadiiRpc, GivesTheLengthsThatSingleRunsGive) {
  const InProcessServer server;
  const Survey survey = survey_program(server, setup_with({1, 2.5}), slot);
  ASSERT_EQ(survey.radii.size(), 2U);
  for (const v1::SurveyedRadius& found : survey.radii) {
    v1::ProgramSetup setup = blocks_setup();
    setup.mutable_path()->set_tool_radius(found.radius());
    setup.mutable_path()->set_verify(v1::VERIFICATION_ENFORCE);
    const StreamAnswer single = run_program(server.channel(), setup, slot);
    ASSERT_TRUE(single.status.ok());
    EXPECT_EQ(found.compensated_length(), single.path_summary.compensated_length());
    EXPECT_EQ(found.certificate().SerializeAsString(),
              single.path_summary.certificate().SerializeAsString());
  }
}

TEST(SurveyRadiiRpc, TakesAPathInBatches) {
  const InProcessServer server;
  std::vector<v1::SurveyRadiiRequest> requests{setup_with({3}, true)};
  const auto batch = [&](std::uint64_t first, const std::vector<v1::Block>& blocks, bool final) {
    v1::SurveyRadiiRequest request;
    v1::BlockBatch& message = *request.mutable_batch();
    message.set_first_block(first);
    message.set_final(final);
    for (const v1::Block& block : blocks) *message.add_blocks() = block;
    requests.push_back(request);
  };
  batch(0, {line_to(-20, 4), command(v1::COMPENSATION_SIDE_LEFT), line_to(-10, 0)}, false);
  batch(3, {line_to(30, 0), line_to(30, 8), line_to(-10, 8)}, false);
  batch(6, {command(v1::COMPENSATION_SIDE_OFF), line_to(-20, 4)}, true);
  const Survey survey = call(server.channel(), requests);
  ASSERT_TRUE(survey.status.ok()) << survey.status.error_message();
  ASSERT_EQ(survey.radii.size(), 1U);
  EXPECT_TRUE(survey.radii[0].accepted());
  EXPECT_NEAR(survey.summaries.at(0).largest().radius(), 4, 1e-3 + 1e-9);
  EXPECT_EQ(survey.summaries.at(0).largest().limits(0).source_index(), 3U);
}

TEST(SurveyRadiiRpc, TellsStretchesWhereTheyAreWanted) {
  const InProcessServer server;
  v1::SurveyRadiiRequest setup = setup_with({3});
  setup.mutable_setup()->set_want_uncut(true);
  setup.mutable_setup()->set_without_largest(true);
  const Survey survey = survey_program(server, setup, slot);
  ASSERT_EQ(survey.radii.size(), 1U);
  EXPECT_EQ(survey.radii[0].uncut_size(), 4);
  EXPECT_FALSE(survey.summaries.at(0).has_largest());
}

TEST(SurveyRadiiRpc, RangeIsAListOfRadii) {
  const InProcessServer server;
  v1::SurveyRadiiRequest setup = setup_with({0.05});
  v1::RadiusRange& range = *setup.mutable_setup()->mutable_range();
  range.set_from(0.1);
  range.set_to(0.5);
  range.set_step(0.1);
  const Survey survey = survey_program(server, setup, slot);
  std::vector<double> radii;
  for (const auto& found : survey.radii) radii.push_back(found.radius());
  EXPECT_EQ(radii, (std::vector<double>{0.05, 0.1, 0.2, 0.3, 0.4, 0.5}));
}

TEST(SurveyRadiiRpc, RefusesAProgramThatCannotBeRead) {
  const InProcessServer server;
  const Survey survey = survey_program(server, setup_with({3}), "N10 G1 X10 F100\nN20 G999\n");
  EXPECT_EQ(survey.status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_NE(survey.status.error_message().find("line 2"), std::string::npos);
  ASSERT_EQ(survey.diagnostics.size(), 1U);
  EXPECT_EQ(survey.diagnostics[0].code(), 900002);
  EXPECT_TRUE(survey.radii.empty());
}

TEST(SurveyRadiiRpc, RefusesRadiiItCannotAskAbout) {
  const InProcessServer server;
  v1::SurveyRadiiRequest many = setup_with({});
  for (int i = 0; i < 65; ++i) many.mutable_setup()->add_radii(1 + i);
  v1::SurveyRadiiRequest steps = setup_with({});
  steps.mutable_setup()->mutable_range()->set_from(1);
  steps.mutable_setup()->mutable_range()->set_to(100);
  steps.mutable_setup()->mutable_range()->set_step(0.1);
  v1::SurveyRadiiRequest none = setup_with({});
  none.mutable_setup()->set_without_largest(true);
  v1::SurveyRadiiRequest neither;
  neither.mutable_setup()->add_radii(1);
  for (const auto& setup :
       {many, steps, none, neither, setup_with({0}), setup_with({-1}), setup_with({2, 2})}) {
    const Survey survey = survey_program(server, setup, slot);
    EXPECT_EQ(survey.status.error_code(), grpc::INVALID_ARGUMENT) << setup.ShortDebugString();
    EXPECT_NE(survey.status.error_message().find("setup."), std::string::npos)
        << survey.status.error_message();
  }
}

TEST(SurveyRadiiRpc, GivesNoResumeTokens) {
  const InProcessServer server;
  v1::SurveyRadiiRequest program;
  program.mutable_setup()->mutable_program()->mutable_path()->set_want_resume_tokens(true);
  EXPECT_EQ(survey_program(server, program, slot).status.error_message(),
            "setup.program.path.want_resume_tokens is set, but SurveyRadii gives no resume tokens");
  v1::SurveyRadiiRequest path;
  path.mutable_setup()->mutable_path()->set_want_resume_tokens(true);
  EXPECT_EQ(survey_program(server, path, slot).status.error_message(),
            "setup.path.want_resume_tokens is set, but SurveyRadii gives no resume tokens");
}

TEST(SurveyRadiiRpc, KeepsTheOrderOfMessages) {
  const InProcessServer server;
  const auto channel = server.channel();
  EXPECT_EQ(call(channel, {text_of(0, slot, true)}).status.error_code(), grpc::FAILED_PRECONDITION);
  EXPECT_EQ(call(channel, {setup_with({3}), setup_with({3})}).status.error_code(),
            grpc::FAILED_PRECONDITION);
  EXPECT_EQ(call(channel, {setup_with({3}), text_of(1, slot, true)}).status.error_code(),
            grpc::OUT_OF_RANGE);
  EXPECT_EQ(call(channel, {setup_with({3}), text_of(0, slot, false)}).status.error_code(),
            grpc::ABORTED);
  EXPECT_EQ(call(channel, {setup_with({3}, true), text_of(0, slot, true)}).status.error_code(),
            grpc::INVALID_ARGUMENT);
  EXPECT_EQ(call(channel, {v1::SurveyRadiiRequest()}).status.error_code(), grpc::INVALID_ARGUMENT);
}

TEST(SurveyRadiiRpc, IsCancelledWhileItComputes) {
  const InProcessServer server;
  std::string text = "N10 G90 G17 G00 X-20 Y4\nG138 G41 G01 X-10 Y0 F500\n";
  for (int i = 0; i < 100'000; ++i)
    text += "X" + std::to_string(i % 2 == 0 ? i : i + 1) + " Y" + std::to_string(i % 2) + "\n";
  text += "G40 X100000 Y50\n";
  v1::SurveyRadiiRequest setup = setup_with({});
  for (int i = 1; i <= 60; ++i) setup.mutable_setup()->add_radii(0.001 * i);
  grpc::ClientContext context;
  const auto stub = v1::TrcService::NewStub(server.channel());
  const auto stream = stub->SurveyRadii(&context);
  std::thread writer([&] {
    stream->Write(setup);
    constexpr std::size_t piece = 64 * 1024;
    for (std::size_t at = 0; at < text.size(); at += piece)
      stream->Write(
          text_of(at, std::string_view(text).substr(at, piece), at + piece >= text.size()));
  });
  v1::SurveyRadiiResponse response;
  while (stream->Read(&response) && !response.has_radius()) {
  }
  writer.join();
  EXPECT_TRUE(response.has_radius());
  const auto before = std::chrono::steady_clock::now();
  context.TryCancel();
  while (stream->Read(&response)) {
  }
  EXPECT_EQ(stream->Finish().error_code(), grpc::CANCELLED);
  // The next one has its turn soon.
  EXPECT_TRUE(survey_program(server, setup_with({3}), slot).status.ok());
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(5));
}

TEST(SurveyRadii, RefusesAFieldThatNobodyKnows) {
  const InProcessServer server;
  v1::SurveyRadiiRequest request;
  v1::SurveySetup& setup = *request.mutable_setup();
  setup.mutable_program();
  setup.GetReflection()->MutableUnknownFields(&setup)->AddVarint(4711, 1);
  const Survey survey = call(server.channel(), {request});
  EXPECT_EQ(survey.status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_NE(survey.status.error_message().find("field 4711 of trc.v1.SurveySetup, in setup"),
            std::string::npos)
      << survey.status.error_message();
}

}  // namespace
}  // namespace trc::server
