// A built server that measures long paths: it says how far it is, others are served, and it stops
// when its client goes.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "tests/faults/questions.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"
#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::faults {
namespace {

using server::eventually;
using std::chrono::milliseconds;
using testing_support::Folder;
using testing_support::ServerProcess;
using testing_support::trc_program;
using Clock = std::chrono::steady_clock;

constexpr double long_enough = 120;  // s, for a slow machine to measure what follows

std::string staircase() {
  std::string text = "G1 G41 V.G.WZ_AKT.R=0.1 X1 Y1 F800\nG91\n";
  for (int step = 0; step < 300'000; ++step) text += "X0.4\nY0.4\n";
  return text + "G40\nG1 X10 Y-10\nM30\n";
}

// A process that gets one millisecond in `slowness` for as long as this object stands.
class Slowed {
 public:
  Slowed(pid_t process, int slowness) {
    if (slowness > 1)
      hand_ = std::jthread([=](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
          ::kill(process, SIGSTOP);
          std::this_thread::sleep_for(milliseconds(slowness - 1));
          ::kill(process, SIGCONT);
          std::this_thread::sleep_for(milliseconds(1));
        }
      });
  }

 private:
  std::jthread hand_;
};

// A client that gives the program and reads what comes, in a thread of its own.
class Measured {
 public:
  struct Beat {
    std::uint64_t measured = 0;
    std::uint64_t all = 0;
    Clock::time_point at{};
  };

  Measured(const std::string& address, const std::string& text,
           std::optional<Clock::duration> deadline = {})
      : stub_(v1::TrcService::NewStub(channel_to(address))) {
    if (deadline) context_.set_deadline(std::chrono::system_clock::now() + *deadline);
    stream_ = stub_->CompensateProgram(&context_);
    reader_ = std::thread([this] { read(); });
    v1::ProgramSetup setup;
    setup.mutable_path()->set_verify(v1::VERIFICATION_REPORT);
    stream_->Write(server::setup_request(setup));
    constexpr std::size_t piece = 256U << 10U;
    for (std::size_t at = 0; at < text.size(); at += piece)
      if (!stream_->Write(
              server::text_request(at, text.substr(at, piece), at + piece >= text.size())))
        break;
    stream_->WritesDone();
  }
  ~Measured() {
    cancel();
    if (reader_.joinable()) reader_.join();
  }
  Measured(const Measured&) = delete;
  Measured& operator=(const Measured&) = delete;

  void cancel() { context_.TryCancel(); }
  [[nodiscard]] bool is_measured() const { return measured_; }
  [[nodiscard]] bool has_ended() const { return ended_; }
  // Whether it is measured so long that something is told of that.
  [[nodiscard]] bool comes_to_be_measured() const {
    return eventually([this] { return measured_ || ended_; }, long_enough) && measured_;
  }
  // Once the stream has ended.
  [[nodiscard]] grpc::Status status() {
    if (reader_.joinable()) reader_.join();
    return status_;
  }
  [[nodiscard]] const std::vector<Beat>& beats() const { return beats_; }
  [[nodiscard]] const v1::Certificate& certificate() const { return summary_.path().certificate(); }

 private:
  void read() {
    v1::CompensateProgramResponse response;
    while (stream_->Read(&response)) {
      if (response.has_summary()) summary_ = response.summary();
      if (!response.has_heartbeat() || !response.heartbeat().has_blocks_to_measure()) continue;
      beats_.push_back({.measured = response.heartbeat().measured_blocks(),
                        .all = response.heartbeat().blocks_to_measure(),
                        .at = Clock::now()});
      measured_ = true;
    }
    status_ = stream_->Finish();
    ended_ = true;
  }

  grpc::ClientContext context_;
  std::unique_ptr<v1::TrcService::Stub> stub_;
  std::unique_ptr<
      grpc::ClientReaderWriter<v1::CompensateProgramRequest, v1::CompensateProgramResponse>>
      stream_;
  std::atomic<bool> measured_ = false;
  std::atomic<bool> ended_ = false;
  std::vector<Beat> beats_;
  v1::ProgramSummary summary_;
  grpc::Status status_;
  std::thread reader_;
};

// The command line at a terminal of its own.
class AtATerminal {
 public:
  explicit AtATerminal(const std::vector<std::string>& command) {
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    id_ = ::forkpty(&terminal_, nullptr, nullptr, nullptr);
    if (id_ != 0) return;
    ::execv(arguments[0], arguments.data());
    ::_exit(127);
  }
  ~AtATerminal() {
    slowed_.reset();
    ::kill(id_, SIGKILL);
    ::close(terminal_);
    ::waitpid(id_, nullptr, 0);
  }
  AtATerminal(const AtATerminal&) = delete;
  AtATerminal& operator=(const AtATerminal&) = delete;

  // Whether it says so before it ends.
  [[nodiscard]] bool comes_to_say(const std::string& words) {
    std::array<char, 4096> part{};
    while (said_.find(words) == std::string::npos) {
      const ssize_t size = ::read(terminal_, part.data(), part.size());
      if (size <= 0) return false;
      said_.append(part.data(), static_cast<std::size_t>(size));
    }
    return true;
  }
  void type(char key) const { EXPECT_EQ(::write(terminal_, &key, 1), 1); }
  void kill() const { ::kill(id_, SIGKILL); }
  void slow(int slowness) { slowed_.emplace(id_, slowness); }
  [[nodiscard]] const std::string& said() const { return said_; }

 private:
  int terminal_ = -1;
  pid_t id_ = -1;
  std::optional<Slowed> slowed_;
  std::string said_;
};

// How long it takes to measure depends on the machine: a fast one is slowed until it takes long
// enough to be told of.
class Measuring : public ::testing::Test {
 protected:
  [[nodiscard]] bool becomes_idle() const {
    return eventually([&] { return metric(server_.admin(), "trc_streams_active") == 0; });
  }
  // A stream whose path is being measured; null: the machine is too fast.
  [[nodiscard]] std::unique_ptr<Measured> measured() {
    for (; slowness_ <= most_slowness; slowness_ *= 16) {
      slowed_.emplace(server_.id(), slowness_);
      auto stream = std::make_unique<Measured>(server_.address(), staircase());
      if (stream->comes_to_be_measured()) return stream;
    }
    return nullptr;
  }
  enum class By : std::uint8_t { itself, server };
  // `trc` with the staircase, once it says how much of it has been measured; null: the machine is
  // too fast. `by`: who measures, and is slowed for it.
  [[nodiscard]] std::unique_ptr<AtATerminal> shown(const std::vector<std::string>& flags, By by) {
    for (; slowness_ <= most_slowness; slowness_ *= 16) {
      std::filesystem::remove(out_);  // of a run that was done too soon
      std::vector<std::string> command{trc_program(), flags[0],
                                       folder_.write("stairs.nc", staircase())};
      command.insert(command.end(), flags.begin() + 1, flags.end());
      if (by == By::server) {
        command.insert(command.end(), {"--server", server_.address()});
        slowed_.emplace(server_.id(), slowness_);
      }
      auto run = std::make_unique<AtATerminal>(command);
      if (by == By::itself) run->slow(slowness_);
      if (run->comes_to_say(" % measured, ")) return run;
      EXPECT_EQ(run->said().find("rror"), std::string::npos) << run->said();
    }
    return nullptr;
  }

  static constexpr int most_slowness = 256;
  int slowness_ = 1;
  Folder folder_;
  const std::string out_ = folder_.path("out.nc");
  ServerProcess server_{
      {"--heartbeat-s", "1", "--worker-threads", "2", "--admin-listen", "127.0.0.1:0"}};
  std::optional<Slowed> slowed_;  // after what it slows
};

constexpr const char* too_fast = "nothing takes long enough here to be told of";

TEST_F(Measuring, TellsHowFarItIs) {
  const auto stream = measured();
  ASSERT_TRUE(stream) << too_fast;
  const grpc::Status status = stream->status();
  ASSERT_TRUE(status.ok()) << status.error_message();
  Measured::Beat before = stream->beats().front();
  for (const Measured::Beat& beat : stream->beats()) {
    EXPECT_GE(beat.measured, before.measured);
    EXPECT_LT(beat.measured, beat.all);
    EXPECT_EQ(beat.all, before.all);
    EXPECT_GE(beat.all, stream->certificate().blocks_checked());
    EXPECT_LE(beat.at - before.at, std::chrono::seconds(2));
    before = beat;
  }
  EXPECT_NEAR(stream->certificate().clearance(), 0.1, 1e-4);
}

// Others are served while both workers measure, not after that.
TEST_F(Measuring, LeavesTurnsToOthers) {
  const auto first = measured();
  const auto second = measured();
  ASSERT_TRUE(first && second) << too_fast;
  EXPECT_TRUE(serves(server_.address()));
  EXPECT_FALSE(second->has_ended());
}

TEST_F(Measuring, EndsWhenItIsCancelled) {
  const auto stream = measured();
  ASSERT_TRUE(stream) << too_fast;
  const auto begin = Clock::now();
  stream->cancel();
  EXPECT_TRUE(becomes_idle());
  RecordProperty(
      "ended_ms",
      static_cast<int>(std::chrono::duration_cast<milliseconds>(Clock::now() - begin).count()));
  EXPECT_EQ(stream->status().error_code(), grpc::CANCELLED);
}

TEST_F(Measuring, EndsAtTheDeadline) {
  const std::string text = staircase();
  for (; slowness_ <= most_slowness; slowness_ *= 16) {
    slowed_.emplace(server_.id(), slowness_);
    const auto begin = Clock::now();
    Measured one(server_.address(), text);
    if (!one.comes_to_be_measured()) continue;
    const auto until_measured = Clock::now() - begin;
    one.cancel();
    EXPECT_TRUE(becomes_idle());
    // Another one is about to be measured then, or a little earlier where the machine is faster.
    Clock::duration deadline = until_measured;
    for (int attempt = 0; attempt < 5; ++attempt, deadline = deadline * 3 / 4) {
      Measured other(server_.address(), text, deadline);
      const grpc::StatusCode code = other.status().error_code();
      if (code == grpc::OK) continue;
      EXPECT_EQ(code, grpc::DEADLINE_EXCEEDED);
      EXPECT_TRUE(becomes_idle());
      return;
    }
    FAIL() << "it was done before each deadline";
  }
  FAIL() << too_fast;
}

TEST_F(Measuring, ShowsOnATerminalAndEndsWithControlC) {
  const auto run = shown({"compensate", "-o", out_}, By::server);
  ASSERT_TRUE(run) << too_fast;
  constexpr char control_c = 3;
  run->type(control_c);
  EXPECT_TRUE(becomes_idle());
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(Measuring, EndsWhenItsClientIsKilled) {
  const auto run = shown({"compensate", "-o", out_}, By::server);
  ASSERT_TRUE(run) << too_fast;
  run->kill();
  EXPECT_TRUE(becomes_idle());
}

TEST_F(Measuring, ShowsOnATerminalWithoutAServer) {
  EXPECT_TRUE(shown({"compensate", "-o", out_}, By::itself)) << too_fast;
}

TEST_F(Measuring, OfVerifyShowsOnATerminal) {
  EXPECT_TRUE(shown({"verify"}, By::itself)) << too_fast;
}

}  // namespace
}  // namespace trc::faults
