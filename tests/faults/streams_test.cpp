// The built server under streams that go the wrong way: that let nothing out, give up while they
// are measured, come with another one's token, ask much at once or bring very much to begin with.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/session/program_session.h"
#include "tests/faults/long_stream.h"
#include "tests/faults/questions.h"
#include "tests/faults/raw_connection.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {
namespace {

using server::eventually;
using server::StreamAnswer;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing_support::Folder;
using testing_support::Process;
using testing_support::ServerProcess;
using testing_support::times_slower;
using Clock = std::chrono::steady_clock;

// A zigzag of so many bytes, compensated; without an end it goes on and on.
std::string zigzag(std::size_t bytes, bool ends = true) {
  std::string text = "G1 G41 V.G.WZ_AKT.R=0.01 X1 Y1 F800\nG91\n";
  while (text.size() < bytes) text += "X1\nY1\n";
  return ends ? text + "G40\nG1 X10 Y-10\nM30\n" : text;
}

void expect_nothing_is_left(const ServerProcess& server) {
  for (const char* what :
       {"trc_streams_active", "trc_session_memory_bytes", "trc_pool_queue_depth"})
    EXPECT_TRUE(eventually([&] { return metric(server.admin(), what) == 0; })) << what;
  EXPECT_TRUE(serves(server.address()));
}

// HTTP/2 lets a client keep its window shut: what is computed for it never leaves, and neither do
// the heartbeats that go beside.
TEST(Streams, ThatLetNothingOutAreEnded) {
  const ServerProcess server(
      {"--admin-listen", "127.0.0.1:0", "--idle-timeout-s", "3", "--heartbeat-s", "1"});
  const std::string initial_window = http2::number(4, 2) + http2::number(0, 4);
  std::vector<std::unique_ptr<RawConnection>> shut;
  for (const auto verification : {v1::VERIFICATION_OFF, v1::VERIFICATION_REPORT}) {
    v1::ProgramSetup setup;
    setup.mutable_path()->set_verify(verification);
    const std::string first = server::setup_request(setup).SerializeAsString();
    for (const bool final : {true, false}) {
      shut.push_back(std::make_unique<RawConnection>(server.address(), "127.0.0.2"));
      const std::string text = server::text_request(0, zigzag(40'000), final).SerializeAsString();
      ASSERT_TRUE(
          shut.back()->send_bytes(http2::greeting(initial_window) +
                                  http2::headers(1, "/trc.v1.TrcService/CompensateProgram") +
                                  http2::message(1, first) + http2::message(1, text)));
    }
  }
  ASSERT_TRUE(eventually([&] { return metric(server.admin(), "trc_streams_active") == 4; }));
  EXPECT_TRUE(eventually([&] { return metric(server.admin(), "trc_streams_active") == 0; }, 30));
  expect_nothing_is_left(server);
}

// A client may go at any time, also while its path is measured.
TEST(Streams, ThatAreCancelledWhileTheyAreMeasuredLeaveNothing) {
  const ServerProcess server({"--admin-listen", "127.0.0.1:0", "--max-early-cancels", "10000",
                              "--max-selection-cpu-s", "0"});
  const std::string text = laps(200, "");
  v1::ProgramSetup setup;
  setup.mutable_path()->set_verify(v1::VERIFICATION_REPORT);
  std::mt19937 random(1);
  std::vector<std::future<void>> clients;
  for (int client = 0; client < 6; ++client)
    clients.push_back(std::async(std::launch::async, [&, seed = random()] {
      std::mt19937 own(static_cast<unsigned>(seed));
      for (int i = 0; i < 10; ++i) {
        const LongStream stream(channel_to(server.address()), text, setup);
        std::this_thread::sleep_for(milliseconds(own() % 300));
      }
    }));
  for (auto& client : clients) client.get();
  expect_nothing_is_left(server);
  EXPECT_EQ(server.log().find("\"incident\""), std::string::npos) << server.log();
}

// --- tokens -----------------------------------------------------------------------------------

const std::string first_part = "G0 X0 Y0\nG0 X5\n";
const std::string second_part = "G1 G41 X10 Y0 F800\nX20\nG40\nX30 Y9\nM30\n";

v1::ProgramSetup token_setup() {
  v1::ProgramSetup setup;
  setup.mutable_path()->set_tool_radius(0.5);
  setup.mutable_path()->set_want_resume_tokens(true);
  return setup;
}

std::string token_after_head(const std::string& address) {
  grpc::ClientContext context;
  const auto stub = v1::TrcService::NewStub(channel_to(address));
  const auto stream = stub->CompensateProgram(&context);
  stream->Write(server::setup_request(token_setup()));
  stream->Write(server::text_request(0, first_part, false));
  v1::CompensateProgramResponse response;
  while (response.resume_token().empty() && stream->Read(&response)) continue;
  context.TryCancel();
  stream->Finish();
  return response.resume_token();
}

// Whatever of the setup is another one, the token does not pass for it.
TEST(Streams, WithATokenOfAnotherSetupAreRefused) {
  const ServerProcess server;
  const std::string token = token_after_head(server.address());
  ASSERT_FALSE(token.empty());
  const auto goes_on = [&](v1::ProgramSetup setup) {
    setup.mutable_path()->set_resume_token(token);
    return server::call_program(
        channel_to(server.address()),
        {server::setup_request(setup), server::text_request(first_part.size(), second_part, true)});
  };
  using Change = void (*)(v1::ProgramSetup&);
  const std::vector<Change> changes{
      [](auto& setup) { setup.mutable_path()->set_tool_radius(0.6); },
      [](auto& setup) { setup.mutable_path()->set_tool_radius(-0.5); },
      [](auto& setup) { setup.mutable_path()->set_verify(v1::VERIFICATION_REPORT); },
      [](auto& setup) { setup.mutable_path()->set_contour_masking(v1::CONTOUR_MASKING_ON); },
      [](auto& setup) { setup.mutable_path()->set_allowance(0.1); },
      [](auto& setup) { setup.mutable_path()->set_want_resume_tokens(false); },
      [](auto& setup) { setup.mutable_path()->set_look_ahead_blocks(9); },
      [](auto& setup) { setup.set_dialect(v1::DIALECT_FANUC); },
      [](auto& setup) { setup.set_unit(v1::LENGTH_UNIT_INCH); },
      [](auto& setup) { setup.set_decimals(3); },
      [](auto& setup) { setup.set_output(v1::PROGRAM_OUTPUT_BLOCKS); },
      [](auto& setup) { setup.add_tools()->set_number(1); }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    v1::ProgramSetup setup = token_setup();
    changes[i](setup);
    const StreamAnswer refused = goes_on(setup);
    EXPECT_EQ(refused.reason(), "RESUME_SETUP_DIFFERS") << i << refused.status.error_message();
    EXPECT_EQ(refused.text, "") << i;
  }
  // Another RPC has another setup.
  v1::PathSetup path = token_setup().path();
  path.set_resume_token(token);
  EXPECT_EQ(server::call_path(channel_to(server.address()), {server::setup_request(path)}).reason(),
            "RESUME_SETUP_DIFFERS");
  // With its own it goes on, however often it comes, and gives the same.
  const StreamAnswer first = goes_on(token_setup());
  EXPECT_TRUE(first.status.ok()) << first.status.error_message();
  EXPECT_EQ(goes_on(token_setup()).text, first.text);
}

// --- large messages ----------------------------------------------------------------------------

// Sends that text again and again, each time as one message, and reads no answer, until it is over.
void send_and_never_read(const std::string& address, const std::string& text,
                         const std::atomic<bool>& over) {
  grpc::ClientContext context;
  const auto stub = v1::TrcService::NewStub(channel_to(address));
  const auto stream = stub->CompensateProgram(&context);
  std::thread end([&] {
    while (!over) std::this_thread::sleep_for(milliseconds(50));
    context.TryCancel();
  });
  bool sends = stream->Write(server::setup_request(v1::ProgramSetup()));
  for (std::uint64_t at = 0; sends; at += text.size())
    sends = stream->Write(server::text_request(at, text, false));
  end.join();
  stream->Finish();
}

class LargeMessages : public testing::TestWithParam<std::size_t> {};

// gRPC ends whatever stream it comes upon when its buffers are full: they are large enough, and who
// fills them with messages that nobody takes is shut out.
TEST_P(LargeMessages, OfAClientAreOutlivedByOthers) {
  constexpr int hostile_streams = 40;
  const std::string large = zigzag(GetParam(), false);
  const Folder folder;
  const std::string socket = "unix:" + folder.path("socket");
  const ServerProcess server({"--admin-listen", "127.0.0.1:0", "--memory-limit-mib", "512"},
                             "127.0.0.1:0," + socket);
  const std::string text = zigzag(300'000);
  const std::string file = folder.write("program.nc", text);
  ProgramSession session({});
  Answers alone;
  ASSERT_TRUE(session.feed(text, alone) && session.finish(alone));
  const std::string expected = alone.take().text;
  std::atomic<bool> over = false;
  std::vector<std::thread> hostile;
  for (int i = 0; i < hostile_streams; ++i)
    hostile.emplace_back([&] { send_and_never_read(server.address(), large, over); });
  std::vector<std::unique_ptr<Process>> honest;
  for (int i = 0; i < 3; ++i)
    honest.push_back(std::make_unique<Process>(std::vector<std::string>{
        FAULT_CLIENT, socket, file, folder.path(std::to_string(i)), "50"}));
  for (std::size_t i = 0; i < honest.size(); ++i) {
    EXPECT_EQ(honest[i]->wait(), 0) << honest[i]->err();
    EXPECT_NE(honest[i]->out().find("resumed 0"), std::string::npos) << honest[i]->out();
    EXPECT_EQ(testing_support::content_of(folder.path(std::to_string(i))) == expected, true);
  }
  over = true;
  for (std::thread& one : hostile) one.join();
  expect_nothing_is_left(server);
}

// As large as a message may be, and larger.
INSTANTIATE_TEST_SUITE_P(Streams, LargeMessages, testing::Values(1'000'000U, 16'000'000U));

// --- surveys ----------------------------------------------------------------------------------

grpc::Status survey(const std::string& address, const std::string& text, std::string& told) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + seconds(120 * times_slower));
  const auto stub = v1::TrcService::NewStub(channel_to(address));
  const auto stream = stub->SurveyRadii(&context);
  v1::SurveyRadiiRequest request;
  request.mutable_setup()->mutable_program();
  for (int i = 1; i <= 64; ++i) request.mutable_setup()->add_radii(0.05 * i);
  stream->Write(request);
  request.mutable_text()->set_text(text);
  request.mutable_text()->set_final(true);
  stream->Write(request);
  stream->WritesDone();
  v1::SurveyRadiiResponse response;
  while (stream->Read(&response))
    if (response.has_radius()) told += response.radius().SerializeAsString();
  return stream->Finish();
}

// As many as there are radii in each, and somebody else beside them.
TEST(Streams, ManySurveysOfOneClientKeepNobodyElseWaiting) {
  constexpr int surveys = 64;
  const Folder folder;
  const std::string socket = "unix:" + folder.path("socket");
  const ServerProcess server({"--admin-listen", "127.0.0.1:0", "--worker-threads", "2"},
                             "127.0.0.1:0," + socket);
  std::string text = "G138 G1 G41 X20 Y0 F800\n";
  for (int i = 0; i < 40; ++i)
    text += "X" + std::to_string(20 + 10 * i) + " Y" + std::to_string(10 * (i % 2)) + "\n";
  text += "G40 X450 Y50\nM30\n";
  std::vector<std::string> told(surveys);
  std::vector<std::future<grpc::Status>> asked;
  for (std::string& answer : told)
    asked.push_back(std::async(std::launch::async, [&server, &text, &answer] {
      return survey(server.address(), text, answer);
    }));
  const auto begin = Clock::now();
  while (asked.back().wait_for(milliseconds(1)) != std::future_status::ready &&
         Clock::now() - begin < seconds(10)) {
    const auto since = Clock::now();
    EXPECT_TRUE(serves(socket));
    EXPECT_LT(Clock::now() - since, times_slower * seconds(5));
  }
  for (auto& one : asked) {
    const grpc::Status status = one.get();
    EXPECT_TRUE(status.ok()) << status.error_message();
  }
  for (const std::string& answer : told) EXPECT_EQ(answer == told.front(), true);
  EXPECT_FALSE(told.front().empty());
  expect_nothing_is_left(server);
}

// --- much to begin with -----------------------------------------------------------------------

// All that the table of tools may hold, twice each, and more than it may hold.
TEST(Streams, WithAllTheToolsThereMayBeBeginAtOnce) {
  constexpr int most = 10'000;
  const ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  const auto run_with = [&](int count, int numbers) {
    v1::ProgramSetup setup;
    for (int i = 0; i < count; ++i) {
      v1::Tool& tool = *setup.add_tools();
      tool.set_number(static_cast<unsigned>(1 + i % numbers));
      tool.set_radius(0.001 * (1 + i % numbers));
    }
    const auto begin = Clock::now();
    const StreamAnswer answer = server::run_program(
        channel_to(server.address()), setup, "G1 G41 D10000 X20 Y0 F800\nX50\nY50\nG40 X0\nM30\n");
    EXPECT_LT(Clock::now() - begin, times_slower * seconds(2)) << count;
    return answer;
  };
  const StreamAnswer all = run_with(most, most);
  EXPECT_TRUE(all.status.ok()) << all.status.error_message();
  EXPECT_TRUE(all.text.ends_with("M30\n"));
  for (const StreamAnswer& refused : {run_with(most, most / 2), run_with(most + 1, most + 1),
                                      run_with(50'000, 1), run_with(60'000, 60'000)}) {
    EXPECT_EQ(refused.status.error_code(), grpc::INVALID_ARGUMENT)
        << refused.status.error_message();
    EXPECT_EQ(refused.text, "");
  }
  expect_nothing_is_left(server);
}

}  // namespace
}  // namespace trc::faults
