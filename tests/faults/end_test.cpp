// The built server that is told to end, whatever it does then: it is gone when its drain timeout
// and two seconds are over, and what it was asked for is answered whole or clearly refused.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/faults/long_stream.h"
#include "tests/faults/questions.h"
#include "tests/faults/raw_connection.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {
namespace {

using server::eventually;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing_support::content_of;
using testing_support::Folder;
using testing_support::Process;
using testing_support::ServerProcess;
using testing_support::times_slower;
using Clock = std::chrono::steady_clock;

constexpr seconds drain_timeout{1};
constexpr seconds grace{2};

// `trc` on its way, which writes a file or nothing.
struct Asked {
  std::unique_ptr<Process> process{};
  std::string output{};  // empty: it writes none
};

// The server, and all that a state needs beside it.
struct Scene {
  Scene()
      : server({"--drain-timeout-s", std::to_string(drain_timeout.count()), "--admin-listen",
                "127.0.0.1:0", "--http-listen", "127.0.0.1:0", "--worker-threads", "2",
                "--max-streams", "4", "--max-streams-per-peer", "4", "--max-selection-cpu-s",
                "0"}) {}

  Asked& ask(const std::vector<std::string>& words, const std::string& text) {
    Asked& one = asked.emplace_back();
    std::vector<std::string> command{testing_support::trc_program()};
    command.insert(command.end(), words.begin(), words.end());
    command.push_back(folder.write("program" + std::to_string(asked.size()) + ".nc", text));
    command.insert(command.end(), {"--server", server.address(), "--wait", "3"});
    if (words.front() == "compensate") {
      one.output = folder.path("out" + std::to_string(asked.size()) + ".nc");
      command.insert(command.end(), {"-o", one.output});
    }
    one.process = std::make_unique<Process>(command);
    return one;
  }
  [[nodiscard]] bool serves_streams(int count) const {
    return eventually([&] { return metric(server.admin(), "trc_streams_active") >= count; });
  }
  [[nodiscard]] std::string http() const {
    const std::string log = server.log();
    const std::string field = "\"http_port\":";
    const std::size_t at = log.find(field);
    return at == std::string::npos
               ? ""
               : "127.0.0.1:" + std::to_string(std::stoi(log.substr(at + field.size())));
  }

  Folder folder;
  ServerProcess server;
  std::vector<Asked> asked{};
  std::vector<std::unique_ptr<LongStream>> streams{};
  std::vector<std::unique_ptr<RawConnection>> connections{};
};

struct State {
  const char* name;
  std::function<void(Scene&)> enter;
  bool ends_well = false;  // nothing is cut off
};

// Blocks that are answered as they come.
std::string long_way() {
  std::string text = "G1 G41 V.G.WZ_AKT.R=0.01 X1 Y1 F800\nG91\n";
  while (text.size() < 8'000'000) text += "X.1\nY.1\n";
  return text + "G40\nG1 X10 Y-10\nM30\n";
}

void stream(Scene& scene) {
  for (int i = 0; i < 3; ++i) scene.ask({"compensate"}, long_way());
  ASSERT_TRUE(scene.serves_streams(1));
}

// What a verification measures once the selection has ended is held until then.
void verify(Scene& scene) {
  constexpr double much_bytes = 100e6;
  for (int i = 0; i < 3; ++i) scene.ask({"compensate", "--set", "verify=report"}, long_way());
  ASSERT_TRUE(eventually(
      [&] { return metric(scene.server.admin(), "trc_session_memory_bytes") > much_bytes; }));
}

void survey(Scene& scene) {
  for (int i = 0; i < 3; ++i) scene.ask({"radii", "--radii", "0.3,0.5,1"}, laps(1000));
  ASSERT_TRUE(scene.serves_streams(3));
  std::this_thread::sleep_for(seconds(1));
}

// At work, half asked, asked and not read, and waiting for the next request.
void ask_by_http(Scene& scene) {
  const std::string http = scene.http();
  ASSERT_FALSE(http.empty()) << scene.server.log();
  const auto post = [](std::size_t bytes) {
    return "POST /v1/programs:compensate HTTP/1.1\r\nHost: localhost\r\nContent-Type: "
           "text/plain\r\n"
           "Content-Length: " +
           std::to_string(bytes) + "\r\n\r\n";
  };
  const std::string much = laps(1000);
  const std::string large = long_way();
  for (const std::string& bytes :
       {post(much.size()) + much, post(1'000'000) + "G1 X1\n", post(large.size()) + large,
        std::string("GET /v1/info HTTP/1.1\r\nHost: localhost\r\n\r\n"),
        std::string("POST /v1/pro")}) {
    scene.connections.push_back(std::make_unique<RawConnection>(http));
    scene.connections.back()->send_bytes(bytes);
  }
  ASSERT_TRUE(scene.serves_streams(1));
  std::this_thread::sleep_for(seconds(1));
}

// A stream that has begun with a token, and computes what is after it.
void resume(Scene& scene) {
  const std::string head = "G0 X0 Y0\nG0 X5\n";
  v1::ProgramSetup setup;
  setup.mutable_path()->set_want_resume_tokens(true);
  std::string token;
  {
    grpc::ClientContext context;
    const auto stub = v1::TrcService::NewStub(channel_to(scene.server.address()));
    const auto first = stub->CompensateProgram(&context);
    first->Write(server::setup_request(setup));
    first->Write(server::text_request(0, head, false));
    v1::CompensateProgramResponse response;
    while (token.empty() && first->Read(&response)) token = response.resume_token();
    context.TryCancel();
    first->Finish();
  }
  ASSERT_FALSE(token.empty());
  setup.mutable_path()->set_resume_token(token);
  for (int i = 0; i < 2; ++i)
    scene.streams.push_back(std::make_unique<LongStream>(channel_to(scene.server.address()),
                                                         head + laps(1000), setup, head.size()));
  ASSERT_TRUE(scene.serves_streams(2));
  std::this_thread::sleep_for(seconds(1));
}

void read_nothing(Scene& scene) {
  for (int i = 0; i < 3; ++i) scene.ask({"compensate"}, long_way());
  ASSERT_TRUE(scene.serves_streams(1));
  for (const Asked& one : scene.asked) one.process->signal(SIGSTOP);
  std::this_thread::sleep_for(seconds(1));
}

void wait_for_a_place(Scene& scene) {
  for (int i = 0; i < 4; ++i)
    scene.streams.push_back(
        std::make_unique<LongStream>(channel_to(scene.server.address()), laps(1000)));
  ASSERT_TRUE(scene.serves_streams(4));
  const Asked& waiting = scene.ask({"compensate"}, std::string(server::g239_program));
  ASSERT_TRUE(eventually(
      [&] { return waiting.process->err().find("waiting for up to") != std::string::npos; }));
}

// All of it, or a refusal in words and no file.
void expect_whole_or_refused(Scene& scene) {
  for (Asked& one : scene.asked) {
    one.process->signal(SIGCONT);
    const int code = one.process->wait();
    const bool is_written = !one.output.empty() && std::filesystem::exists(one.output);
    EXPECT_EQ(is_written, code == 0 && !one.output.empty());
    EXPECT_TRUE(!is_written || content_of(one.output).ends_with("M30\n"));
    EXPECT_TRUE(code == 0 || !one.process->err().empty()) << code;
  }
  for (const auto& stream : scene.streams) {
    const server::StreamAnswer answer = stream->end();
    EXPECT_TRUE(answer.status.ok() ? answer.text.ends_with("M30\n")
                                   : !answer.status.error_message().empty());
  }
}

class End : public testing::TestWithParam<State> {};

TEST_P(End, ComesInTimeWhateverRuns) {
  Scene scene;
  ASSERT_FALSE(scene.server.address().empty());
  GetParam().enter(scene);
  if (HasFatalFailure()) return;
  const auto told = Clock::now();
  scene.server.signal(SIGTERM);
  const int code = scene.server.wait();
  EXPECT_LT(Clock::now() - told, drain_timeout + grace + times_slower * milliseconds(500));
  // With 1 it says that something was still at work then.
  EXPECT_TRUE(code == 0 || (code == 1 && !GetParam().ends_well)) << code;
  expect_whole_or_refused(scene);
}

INSTANTIATE_TEST_SUITE_P(States, End,
                         testing::Values(State{"Idle", [](Scene& /*scene*/) {}, true},
                                         State{"Streaming", stream}, State{"Verifying", verify},
                                         State{"Surveying", survey}, State{"Http", ask_by_http},
                                         State{"Resumed", resume},
                                         State{"OutputThatNobodyReads", read_nothing},
                                         State{"WaitingForAPlace", wait_for_a_place}),
                         [](const auto& state) { return state.param.name; });

// What draining cuts off is told so, whatever the stream was at.
class CutOff : public testing::Test {
 protected:
  void end() {
    scene_.server.signal(SIGTERM);
    EXPECT_EQ(scene_.server.wait(), 0);
  }
  static void expect_told(const server::StreamAnswer& answer) {
    EXPECT_EQ(answer.status.error_code(), grpc::UNAVAILABLE) << answer.status.error_message();
    EXPECT_EQ(answer.reason(), "DRAIN_TIMEOUT") << answer.status.error_message();
  }
  [[nodiscard]] std::shared_ptr<grpc::Channel> channel() const {
    return channel_to(scene_.server.address());
  }

  Scene scene_;
};

TEST_F(CutOff, StreamThatComputesSaysWhy) {
  LongStream stream(channel(), laps(1000));
  ASSERT_TRUE(scene_.serves_streams(1));
  end();
  expect_told(stream.end());
}

TEST_F(CutOff, StreamThatWaitsForItsClientSaysWhy) {
  const auto stub = v1::TrcService::NewStub(channel());
  grpc::ClientContext context;
  const auto stream = stub->CompensateProgram(&context);
  ASSERT_TRUE(stream->Write(server::setup_request(v1::ProgramSetup())));
  ASSERT_TRUE(stream->Write(server::text_request(0, "G0 X0 Y0\nG1 G41 V.G.WZ_AKT.R=1 X5", false)));
  ASSERT_TRUE(scene_.serves_streams(1));
  end();
  server::StreamAnswer answer;
  v1::CompensateProgramResponse response;
  while (stream->Read(&response)) continue;
  answer.status = stream->Finish();
  expect_told(answer);
}

// Its answers wait for it; the reason comes after the one on its way.
TEST_F(CutOff, StreamThatIsReadSlowlySaysWhy) {
  const std::string text = long_way();
  const auto stub = v1::TrcService::NewStub(channel());
  grpc::ClientContext context;
  const auto stream = stub->CompensateProgram(&context);
  std::thread writer([&] {
    stream->Write(server::setup_request(v1::ProgramSetup()));
    constexpr std::size_t piece = 64U << 10U;
    for (std::size_t at = 0; at < text.size(); at += piece)
      if (!stream->Write(server::text_request(at, text.substr(at, piece), false))) break;
  });
  server::StreamAnswer answer;
  std::thread reader([&] {
    v1::CompensateProgramResponse response;
    while (stream->Read(&response)) std::this_thread::sleep_for(milliseconds(50));
    answer.status = stream->Finish();
  });
  EXPECT_TRUE(scene_.serves_streams(1));
  end();
  writer.join();
  reader.join();
  expect_told(answer);
}

TEST_F(CutOff, LastLineOfJsonSaysWhy) {
  std::string text;
  while (text.size() < 200'000) text += "G1 X1 Y1 F800\nX0\n";
  text += laps(1000);
  std::string answer;
  std::thread client([&] {
    answer = testing_support::http_answer(
        scene_.http(),
        "POST /v1/programs:compensate HTTP/1.1\r\nHost: localhost\r\nContent-Type: text/plain\r\n"
        "Accept: application/x-ndjson\r\nConnection: close\r\nContent-Length: " +
            std::to_string(text.size()) + "\r\n\r\n" + text);
  });
  EXPECT_TRUE(scene_.serves_streams(1));
  std::this_thread::sleep_for(seconds(1));
  end();
  client.join();
  ASSERT_TRUE(answer.starts_with("HTTP/1.1 200 ")) << answer.substr(0, 400);
  const std::size_t last_line = answer.rfind("\n{", answer.rfind('}'));
  EXPECT_NE(answer.substr(last_line).find("DRAIN_TIMEOUT"), std::string::npos)
      << answer.substr(answer.size() - 500);
}

TEST_F(CutOff, ClientSaysThatTheServerShutsDown) {
  const Asked& asked = scene_.ask({"compensate"}, laps(1000));
  ASSERT_TRUE(scene_.serves_streams(1));
  end();
  EXPECT_NE(asked.process->wait(), 0);
  EXPECT_NE(asked.process->err().find(" shuts down; waiting for up to 3 s"), std::string::npos)
      << asked.process->err();
  EXPECT_FALSE(std::filesystem::exists(asked.output));
}

// The port that is asked for readiness must not hold it up, whenever the signal comes.
TEST(EndOfAnIdleStream, ComesInTimeAndIsLogged) {
  for (const int before : {300, 900, 1500, 2100}) {
    SCOPED_TRACE(before);
    ServerProcess server({"--drain-timeout-s", "1", "--admin-listen", "127.0.0.1:0"});
    const auto stub = v1::TrcService::NewStub(channel_to(server.address()));
    grpc::ClientContext context;
    const auto stream = stub->CompensateProgram(&context);
    v1::CompensateProgramRequest setup;
    setup.mutable_setup();
    ASSERT_TRUE(stream->Write(setup));
    ASSERT_TRUE(eventually([&] { return metric(server.admin(), "trc_streams_active") == 1; }));
    std::this_thread::sleep_for(milliseconds(before));
    const auto told = Clock::now();
    server.signal(SIGTERM);
    EXPECT_EQ(server.wait(), 0);
    EXPECT_LT(Clock::now() - told, drain_timeout + grace + times_slower * milliseconds(500));
    EXPECT_NE(server.log().find("\"stopped\""), std::string::npos) << server.log();
    v1::CompensateProgramResponse answer;
    while (stream->Read(&answer)) continue;
    EXPECT_EQ(stream->Finish().error_code(), grpc::UNAVAILABLE);
  }
}

}  // namespace
}  // namespace trc::faults
