// The built server in a container that is nearly full of what nobody has counted: above 85 % it
// begins nothing new, above 95 % its largest stream has to go, and it is never killed.

#include <fcntl.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "grpc/health/v1/health.grpc.pb.h"
#include "tests/faults/control_group.h"
#include "tests/faults/questions.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {
namespace {

using server::eventually;
using server::StreamAnswer;
using testing_support::Folder;
using testing_support::http_get;
using testing_support::memory_tells;
using testing_support::Process;
using testing_support::ServerProcess;

constexpr std::uint64_t mib = 1U << 20U;
constexpr std::uint64_t limit_mib = 512;

// A server in a group of so much memory, or told so where no group can be made, in which something
// else takes as much as the test wants.
class CrowdedServer {
 public:
  CrowdedServer()
      : ballast_(empty_file(path())),
        group_(limit_mib * mib),
        server_(flags(), "127.0.0.1:0", 0, {"LD_PRELOAD=" BALLAST_LIBRARY, "BALLAST=" + path()},
                group_.launcher()) {}
  ~CrowdedServer() { close(ballast_); }
  CrowdedServer(const CrowdedServer&) = delete;
  CrowdedServer& operator=(const CrowdedServer&) = delete;

  [[nodiscard]] ServerProcess& process() { return server_; }
  // So much of the limit is in use from here on, by what there is now and the ballast.
  void fill_to(double percent) const {
    hold(0);
    EXPECT_TRUE(eventually([&] { return resident() < 0.75 * limit_mib; }));
    EXPECT_TRUE(eventually([&] { return is_settled(); }));
    hold(static_cast<std::int64_t>(percent / 100 * limit_mib - resident()));
    EXPECT_TRUE(eventually(
        [&] { return resident() > (percent - 1) / 100 * limit_mib || evictions() > 0; }));
  }
  void empty() const { hold(0); }
  [[nodiscard]] double evictions() const { return metric(server_.admin(), "trc_evictions_total"); }
  // As the server counts it, MiB.
  [[nodiscard]] double resident() const {
    return metric(server_.admin(), "trc_resident_memory_bytes") / static_cast<double>(mib);
  }

 private:
  // Nothing is taken, and nothing given back.
  [[nodiscard]] bool is_settled() const {
    const double before = resident();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    return std::abs(resident() - before) < 1;
  }
  static int empty_file(const std::string& path) {
    const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    EXPECT_EQ(ftruncate(file, sizeof(std::int64_t)), 0);
    return file;
  }
  [[nodiscard]] std::string path() const { return folder_.path("ballast"); }
  void hold(std::int64_t wanted_mib) const {
    EXPECT_EQ(pwrite(ballast_, &wanted_mib, sizeof wanted_mib, 0),
              static_cast<ssize_t>(sizeof wanted_mib));
  }
  [[nodiscard]] std::vector<std::string> flags() const {
    std::vector<std::string> flags{"--admin-listen", "127.0.0.1:0", "--http-listen", "127.0.0.1:0"};
    // In a group it has to find the limit by itself.
    if (!group_.exists())
      flags.insert(flags.end(), {"--memory-limit-mib", std::to_string(limit_mib)});
    return flags;
  }

  Folder folder_;
  int ballast_;
  MemoryGroup group_;
  ServerProcess server_;
};

// A selection that is held back as a whole, of which a client gives one part now and one later.
class HeldSelection {
 public:
  HeldSelection(const std::string& address, std::size_t bytes)
      : stub_(v1::TrcService::NewStub(channel_to(address))),
        stream_(stub_->CompensateProgram(&context_)) {
    context_.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(60));
    text_ = "G141\nG1 G41 V.G.WZ_AKT.R=0.01 X1 Y1 F800\nG91\n";
    while (text_.size() < bytes) text_ += "X1\nY1\n";
    stream_->Write(server::setup_request(v1::ProgramSetup()));
    give(text_, 0, false);
  }
  ~HeldSelection() { context_.TryCancel(); }
  HeldSelection(const HeldSelection&) = delete;
  HeldSelection& operator=(const HeldSelection&) = delete;

  // Gives the end, and takes what there is.
  StreamAnswer end() {
    give("G40\nG1 X10 Y-10\nM30\n", text_.size(), true);
    stream_->WritesDone();
    StreamAnswer answer;
    v1::CompensateProgramResponse response;
    while (stream_->Read(&response)) answer.text += response.nc_text();
    answer.status = stream_->Finish();
    return answer;
  }

 private:
  void give(const std::string& text, std::size_t first_byte, bool final) {
    constexpr std::size_t piece = 256U << 10U;
    for (std::size_t at = 0; at < text.size(); at += piece)
      stream_->Write(server::text_request(first_byte + at, text.substr(at, piece),
                                          final && at + piece >= text.size()));
  }

  grpc::ClientContext context_;
  std::string text_;
  std::unique_ptr<v1::TrcService::Stub> stub_;
  std::unique_ptr<
      grpc::ClientReaderWriter<v1::CompensateProgramRequest, v1::CompensateProgramResponse>>
      stream_;
};

bool is_refused_for_memory(const StreamAnswer& answer) {
  return answer.status.error_code() == grpc::RESOURCE_EXHAUSTED &&
         answer.reason() == "MEMORY_LIMIT" &&
         answer.status.error_message().find("memory-limit-mib") != std::string::npos;
}

grpc::health::v1::HealthCheckResponse::ServingStatus health_of(const std::string& address) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(10));
  grpc::health::v1::HealthCheckResponse response;
  grpc::health::v1::Health::NewStub(channel_to(address))->Check(&context, {}, &response);
  return response.status();
}

class ScarceMemory : public testing::Test {
 protected:
  void SetUp() override {
    if (!memory_tells) GTEST_SKIP() << "a sanitizer must be the first library there is";
  }
};

TEST_F(ScarceMemory, Above85PercentNothingNewIsBegunAndWhatIsOpenGoesOn) {
  CrowdedServer crowded;
  const std::string address = crowded.process().address();
  ASSERT_TRUE(serves(address));
  // One that hardly holds anything, and one that would grow.
  HeldSelection open(address, 200);
  HeldSelection growing(address, 40'000);
  ASSERT_TRUE(eventually(
      [&] { return metric(crowded.process().admin(), "trc_session_memory_bytes") > 3.0 * mib; }));
  crowded.fill_to(90);
  ASSERT_TRUE(eventually([&] {
    return is_refused_for_memory(
        server::run_program(channel_to(address), {}, server::g239_program));
  }));
  const Folder folder;
  const std::string program = folder.write("part.nc", std::string(server::g239_program));
  // Every kind of call that computes is refused, and says so at once.
  v1::PreviewPathRequest preview;
  preview.mutable_setup()->set_tool_radius(1);
  EXPECT_TRUE(is_refused_for_memory(server::call_preview(channel_to(address), preview)));
  EXPECT_TRUE(is_refused_for_memory(
      server::call_path(channel_to(address), {server::setup_request(preview.setup())})));
  for (const char* command : {"compensate", "verify"}) {
    const auto said = testing_support::run(
        {testing_support::trc_program(), command, program, "--server", address, "--wait", "0"});
    EXPECT_EQ(said.code, 4) << said.err;
    EXPECT_NE(said.err.find("memory-limit-mib"), std::string::npos) << said.err;
    EXPECT_EQ(said.out, "");
  }
  // Who is told to come again waits, and gets his answer when there is room.
  Process patient({testing_support::trc_program(), "compensate", program, "--server", address,
                   "--wait", "60", "-o", folder.path("out.nc")});
  EXPECT_TRUE(
      eventually([&] { return patient.err().find("waiting for up to") != std::string::npos; }));
  EXPECT_EQ(health_of(address), grpc::health::v1::HealthCheckResponse::SERVING);
  const StreamAnswer goes_on = open.end();
  EXPECT_TRUE(goes_on.status.ok()) << goes_on.status.error_message();
  EXPECT_TRUE(goes_on.text.ends_with("M30\n"));
  EXPECT_TRUE(is_refused_for_memory(growing.end()));
  EXPECT_EQ(crowded.evictions(), 0);
  crowded.empty();
  EXPECT_EQ(patient.wait(), 0) << patient.err();
  EXPECT_TRUE(testing_support::content_of(folder.path("out.nc")).ends_with("M30\n"));
  EXPECT_TRUE(serves(address));
}

TEST_F(ScarceMemory, Above95PercentTheLargestStreamGoesAndNoOther) {
  CrowdedServer crowded;
  const std::string address = crowded.process().address();
  ASSERT_TRUE(serves(address));
  const auto held = [&] {
    return metric(crowded.process().admin(), "trc_session_memory_bytes") / static_cast<double>(mib);
  };
  HeldSelection small(address, 40'000);
  ASSERT_TRUE(eventually([&] { return held() > 5; }));
  HeldSelection large(address, 400'000);
  ASSERT_TRUE(eventually([&] { return held() > 60; })) << held();
  crowded.fill_to(97);
  ASSERT_TRUE(eventually([&] { return crowded.evictions() > 0; }));
  const StreamAnswer gone = large.end();
  EXPECT_TRUE(is_refused_for_memory(gone)) << gone.status.error_message();
  // Above 85 % nothing may grow, and what the small one holds it keeps.
  crowded.empty();
  ASSERT_TRUE(eventually([&] { return serves(address); }));
  const StreamAnswer stays = small.end();
  EXPECT_TRUE(stays.status.ok()) << stays.status.error_message();
  EXPECT_TRUE(stays.text.ends_with("M30\n"));
  // What it held is back, without which everybody would have had to go.
  EXPECT_EQ(crowded.evictions(), 1);
  EXPECT_TRUE(eventually([&] { return held() == 0; }));
  EXPECT_TRUE(eventually([&] { return serves(address); }));
}

// With nothing to end it lives on, and serves as soon as there is room.
TEST_F(ScarceMemory, WithoutAStreamToEndTheServerLivesOn) {
  CrowdedServer crowded;
  const std::string address = crowded.process().address();
  ASSERT_TRUE(serves(address));
  crowded.fill_to(97);
  for (int i = 0; i < 20; ++i)
    EXPECT_TRUE(
        is_refused_for_memory(server::run_program(channel_to(address), {}, server::g239_program)));
  EXPECT_EQ(http_get(crowded.process().admin(), "/healthz"), "ok\n");
  crowded.empty();
  EXPECT_TRUE(eventually([&] { return serves(address); }));
  crowded.process().signal(SIGTERM);
  EXPECT_EQ(crowded.process().wait(), 0) << crowded.process().log();
}

}  // namespace
}  // namespace trc::faults
