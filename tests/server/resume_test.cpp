// Resume tokens and heartbeats as a client of any language sees them.

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "server/in_process.h"
#include "server/rpc/resume_tokens.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::server::resuming {
namespace {

using testing_support::Folder;

v1::PathSetup token_setup() {
  v1::PathSetup setup;
  setup.set_tool_radius(2);
  setup.set_want_resume_tokens(true);
  return setup;
}

std::vector<v1::Block> zigzag(int count) {
  std::vector<v1::Block> blocks{command(v1::COMPENSATION_SIDE_LEFT)};
  for (int i = 1; i <= count; ++i) blocks.push_back(line_to(20.0 * i, i % 2 * 15.0));
  return blocks;
}

// A path stream, one request at a time.
class PathStream {
 public:
  explicit PathStream(const std::shared_ptr<grpc::Channel>& channel)
      : stub_(v1::TrcService::NewStub(channel)) {
    context_.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(60));
    stream_ = stub_->CompensatePath(&context_);
  }
  ~PathStream() { context_.TryCancel(); }
  PathStream(const PathStream&) = delete;
  PathStream& operator=(const PathStream&) = delete;

  // The response to a request, or an empty one when the stream has ended.
  v1::CompensatePathResponse ask(const v1::CompensatePathRequest& request) {
    stream_->Write(request);
    return read();
  }
  v1::CompensatePathResponse read() {
    v1::CompensatePathResponse response;
    stream_->Read(&response);
    return response;
  }
  StreamAnswer end() {
    StreamAnswer answer;
    stream_->WritesDone();
    v1::CompensatePathResponse response;
    while (stream_->Read(&response)) {
    }
    answer.status = stream_->Finish();
    return answer;
  }

 private:
  std::unique_ptr<v1::TrcService::Stub> stub_;
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::CompensatePathRequest, v1::CompensatePathResponse>>
      stream_;
};

std::string token_after(const std::shared_ptr<grpc::Channel>& channel,
                        const v1::PathSetup& setup = token_setup()) {
  PathStream stream(channel);
  stream.ask(setup_request(setup));
  return stream.ask(batch(0, zigzag(10), false)).resume_token();
}

// How a stream ends that goes on with the token.
StreamAnswer outcome(const std::shared_ptr<grpc::Channel>& channel, v1::PathSetup setup,
                     const std::string& token) {
  setup.set_resume_token(token);
  PathStream stream(channel);
  stream.ask(setup_request(setup));
  return stream.end();
}

TEST(ResumeToken, IsGivenWhenAskedForAndNotForTheLastBatch) {
  InProcessServer server;
  PathStream stream(server.channel());
  EXPECT_TRUE(stream.ask(setup_request(token_setup())).has_accepted());
  EXPECT_FALSE(stream.ask(batch(0, zigzag(10), false)).resume_token().empty());
  EXPECT_TRUE(stream.ask(batch(11, {command(v1::COMPENSATION_SIDE_OFF), line_to(0, 0)}, true))
                  .resume_token()
                  .empty());

  v1::PathSetup without = token_setup();
  without.set_want_resume_tokens(false);
  EXPECT_EQ(token_after(server.channel(), without), "");
}

TEST(ResumeToken, IsBoundedHoweverLongTheContour) {
  InProcessServer server;
  PathStream stream(server.channel());
  stream.ask(setup_request(token_setup()));
  std::size_t largest = 0;
  std::uint64_t next = 0;
  for (int i = 0; i < 20; ++i) {
    std::vector<v1::Block> blocks = zigzag(1000);
    if (i > 0) blocks.erase(blocks.begin());
    for (v1::Block& block : blocks)
      if (block.has_linear()) {
        auto& end = *block.mutable_linear()->mutable_end();
        end.set_x(end.x() + 20000.0 * i);
      }
    // The last answer to a batch has it.
    v1::CompensatePathResponse response = stream.ask(batch(next, blocks, false));
    while (response.resume_token().empty() && response.has_batch()) response = stream.read();
    largest = std::max(largest, response.resume_token().size());
    next += blocks.size();
  }
  EXPECT_GT(largest, 100U);
  EXPECT_LT(largest, 4096U);
}

TEST(ResumeToken, GoesOnWhereItWasGiven) {
  InProcessServer server;
  const std::string token = token_after(server.channel());
  v1::PathSetup setup = token_setup();
  setup.set_resume_token(token);
  PathStream resumed(server.channel());
  EXPECT_TRUE(resumed.ask(setup_request(setup)).has_accepted());
  const auto rest = resumed.ask(batch(11, {line_to(300, 0), line_to(320, 15)}, false));
  // Ten lines give eight blocks; the approach and the first ones came from the other stream.
  ASSERT_TRUE(rest.has_batch());
  EXPECT_EQ(rest.batch().first_block() + static_cast<std::uint64_t>(rest.batch().blocks_size()),
            rest.batch().first_block() + 2);
  EXPECT_GT(rest.batch().first_block(), 5U);
  EXPECT_EQ(rest.consumed_through_block(), 12U);
}

TEST(ResumeToken, AnotherPlaceThanItsOwnIsOutOfSequence) {
  InProcessServer server;
  v1::PathSetup setup = token_setup();
  setup.set_resume_token(token_after(server.channel()));
  PathStream stream(server.channel());
  stream.ask(setup_request(setup));
  stream.ask(batch(0, zigzag(10), false));
  const StreamAnswer answer = stream.end();
  EXPECT_EQ(answer.status.error_code(), grpc::OUT_OF_RANGE);
  EXPECT_EQ(answer.metadata("expected"), "11");
}

TEST(ResumeToken, ChangedAnywhereIsRefused) {
  InProcessServer server;
  const std::string token = token_after(server.channel());
  for (std::size_t at = 0; at < token.size(); at += 7) {
    SCOPED_TRACE(at);
    std::string changed = token;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    EXPECT_EQ(outcome(server.channel(), token_setup(), changed).reason(), "RESUME_TOKEN_INVALID");
  }
  for (const std::string& other :
       {std::string("x"), token.substr(0, token.size() - 1), token + "x", std::string(5000, 'T')}) {
    const auto refused = outcome(server.channel(), token_setup(), other);
    EXPECT_EQ(refused.reason(), "RESUME_TOKEN_INVALID");
    EXPECT_EQ(refused.metadata("field"), "setup.resume_token");
    EXPECT_NE(refused.status.error_message().find("begin the path anew"), std::string::npos);
  }
}

TEST(ResumeToken, OtherSettingsAreRefused) {
  InProcessServer server;
  const std::string token = token_after(server.channel());
  v1::PathSetup other = token_setup();
  other.set_tool_radius(3);
  const StreamAnswer answer = outcome(server.channel(), other, token);
  EXPECT_EQ(answer.status.error_code(), grpc::FAILED_PRECONDITION);
  EXPECT_EQ(answer.reason(), "RESUME_SETUP_DIFFERS");
}

TEST(ResumeToken, OfAPathDoesNotFitAProgram) {
  InProcessServer server;
  v1::ProgramSetup setup;
  *setup.mutable_path() = token_setup();
  setup.mutable_path()->set_resume_token(token_after(server.channel()));
  EXPECT_EQ(call_program(server.channel(), {setup_request(setup)}).reason(),
            "RESUME_SETUP_DIFFERS");
}

TEST(ResumeToken, ServersWithOneKeyTakeEachOthersStreams) {
  const Folder folder;
  Config config = InProcessServer::quiet();
  config.resume_key_file = folder.path("key");
  config.listen = {"127.0.0.1:0"};
  const auto first = Server::start(config);
  const auto second = Server::start(config);
  ASSERT_TRUE(first.server) << first.fault;
  ASSERT_TRUE(second.server) << second.fault;
  InProcessServer stranger;
  const std::string token = token_after(first.server->in_process_channel());
  // The stream is accepted and then ends for want of blocks.
  EXPECT_EQ(outcome(second.server->in_process_channel(), token_setup(), token).reason(),
            "CONTOUR_INCOMPLETE");
  EXPECT_EQ(outcome(stranger.channel(), token_setup(), token).reason(), "RESUME_TOKEN_INVALID");
}

TEST(ResumeKey, IsMadeForTheOwnerAndKept) {
  const Folder folder;
  const std::string path = folder.path("key");
  const ResumeKey made = resume_key(path);
  EXPECT_EQ(made.fault, "");
  EXPECT_EQ(made.key.size(), 32U);
  EXPECT_EQ(resume_key(path).key, made.key);
  EXPECT_EQ(std::filesystem::status(path).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  EXPECT_NE(resume_key({}).key, resume_key({}).key);
  EXPECT_EQ(folder.names().size(), 1U);
}

// Servers in containers all have the same process number.
TEST(ResumeKey, IsMadeBesideWhatAnotherServerOfThisNumberBegan) {
  const Folder folder;
  const std::string path = folder.path("key");
  folder.write("key." + std::to_string(::getpid()), "half a k");
  const ResumeKey made = resume_key(path);
  EXPECT_EQ(made.fault, "");
  EXPECT_EQ(testing_support::content_of(path), made.key);
}

TEST(ResumeKey, ThatCannotBeUsedIsAFaultBeforeAPortOpens) {
  const Folder folder;
  Config config = InProcessServer::quiet();
  config.listen = {"127.0.0.1:0"};
  for (const std::string& path : {folder.write("short", "0123"), folder.path("missing/key")}) {
    config.resume_key_file = path;
    const Server::Start start = Server::start(config);
    EXPECT_FALSE(start.server);
    EXPECT_NE(start.fault.find(path), std::string::npos) << start.fault;
  }
}

// One line says what is wrong with it: no recursion, no abort, and no key that is none.
TEST(ResumeKey, OddFilesAreFaultsWithTheirReason) {
  const Folder folder;
  const auto fault = [](const std::string& path) { return resume_key(path).fault; };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  std::filesystem::create_symlink(folder.path("nowhere"), folder.path("dangling"));
  EXPECT_TRUE(has(fault(folder.path("dangling")), "cannot be read"));
  std::filesystem::create_symlink(folder.path("circle"), folder.path("circle"));
  EXPECT_TRUE(has(fault(folder.path("circle")), "cannot be read"));
  std::filesystem::create_directory(folder.path("directory"));
  EXPECT_TRUE(has(fault(folder.path("directory")), "is no file"));
  EXPECT_TRUE(has(fault(folder.write("zeros", std::string(64, '\0'))), "no random bytes"));
  EXPECT_TRUE(has(fault(folder.write("empty", "")), "fewer than 32 bytes"));

  const std::string good = folder.write("good", "0123456789abcdef0123456789abcdef");
  EXPECT_EQ(fault(good), "");
  for (const auto writers :
       {std::filesystem::perms::others_write, std::filesystem::perms::group_write}) {
    std::filesystem::permissions(good, std::filesystem::perms::owner_all | writers);
    EXPECT_TRUE(has(fault(good), "can be written by others"));
  }
  // A link to a good one serves: secrets are mounted so.
  std::filesystem::permissions(good, std::filesystem::perms::owner_read);
  std::filesystem::create_symlink(good, folder.path("link"));
  EXPECT_EQ(fault(folder.path("link")), "");
}

TEST(Heartbeat, KeepsASilentStreamAlive) {
  Config config = InProcessServer::quiet();
  config.heartbeat_s = 1;
  InProcessServer server(config);
  PathStream stream(server.channel());
  ASSERT_TRUE(stream.ask(setup_request(token_setup())).has_accepted());
  EXPECT_TRUE(stream.read().has_heartbeat());
  EXPECT_TRUE(stream.read().has_heartbeat());
  // The path goes on as if nothing had been sent.
  EXPECT_TRUE(stream.ask(batch(0, zigzag(10), false)).has_batch());
  EXPECT_TRUE(stream.read().has_heartbeat());
}

TEST(Heartbeat, IsNoRequest) {
  Config config = InProcessServer::quiet();
  config.heartbeat_s = 1;
  config.idle_timeout_s = 2;
  InProcessServer server(config);
  PathStream stream(server.channel());
  stream.ask(setup_request(token_setup()));
  EXPECT_TRUE(stream.read().has_heartbeat());
  while (stream.read().has_heartbeat()) {
  }
  EXPECT_EQ(stream.end().reason(), "STREAM_IDLE");
}

}  // namespace
}  // namespace trc::server::resuming
