// A session whose server is gone and comes back, at any moment: what the caller gets is what an
// unbroken session gives, bit for bit.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "client/trc/remote_path_session.h"
#include "client/trc/remote_program_session.h"
#include "proto/wire/compensated_block.h"
#include "server/in_process.h"
#include "server/server.h"
#include "tests/support/process.h"

namespace trc::client::resuming {
namespace {

using std::chrono::milliseconds;
using testing_support::Folder;

// A server at a socket; a new one takes the place of the old one there.
class Replaceable {
 public:
  Replaceable() {
    config_ = server::InProcessServer::quiet();
    config_.listen = {address()};
    config_.resume_key_file = folder_.path("key");
    // Small answers: one request gets several of them.
    config_.max_message_bytes = 16 * 1024;
    replace();
  }

  server::Config& config() { return config_; }
  [[nodiscard]] std::string address() const { return "unix:" + folder_.path("socket"); }
  [[nodiscard]] std::string key_file() const { return folder_.path("key"); }
  // Ends all streams at once, as the end of the process would.
  void replace() {
    server_.reset();
    server_ = server::Server::start(config_).server;
    ++servers_;
  }
  void stop() { server_.reset(); }
  [[nodiscard]] int servers() const { return servers_; }
  [[nodiscard]] bool runs() const { return server_ != nullptr; }

  [[nodiscard]] Connection connection(std::size_t most_kept_bytes = 256U << 20U) const {
    std::optional<Connection> connection;
    ConnectionOptions options;
    options.resume.first_wait = milliseconds(10);
    options.resume.longest_wait = milliseconds(200);
    options.resume.patience = milliseconds(20'000);
    options.resume.most_kept_bytes = most_kept_bytes;
    EXPECT_FALSE(Connection::open(address(), {}, connection, options));
    return *connection;
  }

 private:
  Folder folder_;
  server::Config config_;
  std::unique_ptr<server::Server> server_;
  int servers_ = 0;
};

struct Collected {
  std::string text;
  std::vector<CompensatedBlock> blocks;
  std::string diagnostics;
  std::string summary;
  std::string failure;
  std::uint64_t resumed = 0;

  // Every bit of every block.
  [[nodiscard]] std::string bytes() const {
    v1::CompensatedBatch batch;
    wire::to_proto(blocks, 0, batch);
    return batch.SerializeAsString();
  }
  void take(const Answer& answer) {
    text += answer.text;
    blocks.insert(blocks.end(), answer.blocks.begin(), answer.blocks.end());
    for (const Diagnostic& told : answer.diagnostics)
      diagnostics += std::to_string(static_cast<int>(told.code)) + " at block " +
                     std::to_string(told.source.index) + " after " + std::to_string(blocks.size()) +
                     "\n";
  }
};

template <class Summary>
std::string counts_of(const std::optional<Summary>& summary) {
  if (!summary) return "none";
  const trc::Summary* core = nullptr;
  if constexpr (requires { summary->path; })
    core = &summary->path.summary;
  else
    core = &summary->summary;
  return std::to_string(core->blocks_in) + " " + std::to_string(core->blocks_out) + " " +
         std::to_string(core->programmed_length) + " " + std::to_string(core->compensated_length);
}

// Called before each piece is given and after each answer.
using Disturb = std::function<void()>;

template <class Session, class Pieces>
Collected run(Session& session, const Pieces& pieces, const Disturb& disturb) {
  Collected result;
  Answers answers([&](const Answer& answer) {
    result.take(answer);
    disturb();
    return true;
  });
  for (const auto& piece : pieces) {
    disturb();
    if (!session.feed(piece, answers)) break;
  }
  session.finish(answers);
  result.summary = counts_of(session.summary());
  if (session.failure()) result.failure = session.failure()->reason + session.failure()->status;
  result.resumed = session.resumed();
  return result;
}

void expect_same(const Collected& actual, const Collected& expected) {
  EXPECT_EQ(actual.text, expected.text);
  EXPECT_EQ(actual.bytes(), expected.bytes());
  EXPECT_EQ(actual.diagnostics, expected.diagnostics);
  EXPECT_EQ(actual.summary, expected.summary);
  EXPECT_EQ(actual.failure, expected.failure);
}

// Replaces the server now and then, at random.
Disturb at_random(Replaceable& server, unsigned seed, unsigned one_in) {
  return [&server, one_in, random = std::mt19937(seed)]() mutable {
    if (random() % one_in == 0) server.replace();
  };
}

const Disturb never = [] {};

// A meander with corners of both kinds, arcs and text.
std::vector<wire::PathInput> meander(std::size_t turns) {
  std::mt19937 random(5);
  std::vector<wire::PathInput> items;
  const auto source = [&items] { return Source{.index = items.size(), .number = 5}; };
  items.emplace_back(wire::TrcCommand{.source = source(), .side = Side::left});
  for (std::size_t turn = 0; turn < turns; ++turn) {
    const double x = 20.0 * static_cast<double>(turn);
    const double y = 10 + static_cast<double>(random() % 1000) / 100;
    items.emplace_back(MoveRequest{.source = source(), .end = {x, y, {}}, .feed = 800});
    items.emplace_back(MoveRequest{.source = source(), .end = {x + 10, y, 1.5}, .feed = 700});
    items.emplace_back(MoveRequest{.source = source(),
                                   .kind = MotionKind::clockwise,
                                   .end = {x + 16, y, {}},
                                   .center = {3, 0, {}},
                                   .feed = 800});
    if (turn % 7 == 3) items.emplace_back(wire::Passthrough{.source = source(), .text = "M8"});
  }
  items.emplace_back(wire::TrcCommand{.source = source(), .side = Side::off});
  items.emplace_back(MoveRequest{.source = source(), .end = {0, -100, {}}, .feed = 800});
  return items;
}

std::vector<std::span<const wire::PathInput>> in_batches(const std::vector<wire::PathInput>& items,
                                                         std::size_t size) {
  std::vector<std::span<const wire::PathInput>> batches;
  for (std::size_t i = 0; i < items.size(); i += size)
    batches.push_back(std::span(items).subspan(i, std::min(size, items.size() - i)));
  return batches;
}

wire::PathSettings small_tool(wire::Layout layout) {
  wire::PathSettings settings;
  settings.session.program.mode.tool_radius = 0.5;
  settings.session.program.mode.transition = Transition::circular;
  settings.response_layout = layout;
  return settings;
}

// A meander as NC text, with `head` before it.
std::string meander_text(int turns, const std::string& head) {
  std::string text = head + "N5 G1 G41 V.G.WZ_AKT.R=0.5 X0 Y10 F800\n";
  for (int turn = 0; turn < turns; ++turn) {
    const int x = 20 * turn;
    const int y = 10 + turn * 7 % 11;
    text += "N" + std::to_string(10 * turn + 10) + " G1 X" + std::to_string(x + 5) + " Y" +
            std::to_string(y) + "\nX" + std::to_string(x + 10) + " (comment \xC3\xA4)\n";
    text += "G2 X" + std::to_string(x + 16) + " I3 J0\nM8\n";
  }
  return text + "G40\nG1 X0 Y-100\nM30\n";
}

std::vector<std::string_view> in_chunks(std::string_view text, std::size_t size) {
  std::vector<std::string_view> chunks;
  for (; !text.empty(); text.remove_prefix(std::min(size, text.size())))
    chunks.push_back(text.substr(0, size));
  return chunks;
}

Collected run_path(const Replaceable& server, wire::Layout layout, const Disturb& disturb,
                   std::size_t batch = 200) {
  static const std::vector<wire::PathInput> items = meander(400);
  RemotePathSession session(server.connection(), small_tool(layout));
  return run(session, in_batches(items, batch), disturb);
}

Collected run_program(const Replaceable& server, const std::string& text, bool nc_text,
                      const Disturb& disturb, std::size_t most_kept_bytes = 256U << 20U) {
  v1::ProgramSetup setup;
  if (!nc_text) setup.set_output(v1::PROGRAM_OUTPUT_BLOCKS);
  RemoteProgramSession session(server.connection(most_kept_bytes), setup);
  return run(session, in_chunks(text, 777), disturb);
}

TEST(ResumedStream, PathIsTheSameInBothLayouts) {
  Replaceable server;
  for (const wire::Layout layout : {wire::Layout::blocks, wire::Layout::columns}) {
    const Collected expected = run_path(server, layout, never);
    ASSERT_EQ(expected.failure, "");
    EXPECT_EQ(expected.resumed, 0U);
    for (unsigned seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const Collected broken = run_path(server, layout, at_random(server, seed, 3), 50);
      EXPECT_GT(broken.resumed, 2U);
      expect_same(broken, expected);
    }
  }
}

TEST(ResumedStream, ProgramIsTheSameAsTextAndAsBlocks) {
  Replaceable server;
  const std::string text = meander_text(300, "");
  for (const bool nc_text : {true, false}) {
    const Collected expected = run_program(server, text, nc_text, never);
    ASSERT_EQ(expected.failure, "");
    for (unsigned seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const Collected broken = run_program(server, text, nc_text, at_random(server, seed, 9));
      EXPECT_GT(broken.resumed, 0U);
      expect_same(broken, expected);
    }
  }
}

TEST(ResumedStream, RefusedProgramIsRefusedTheSameWay) {
  Replaceable server;
  std::string refused = meander_text(100, "");
  refused.insert(refused.find("G40"), "G2 X5 Y5 R0.1\n");
  const Collected expected = run_program(server, refused, true, never);
  ASSERT_NE(expected.failure, "");
  expect_same(run_program(server, refused, true, at_random(server, 2, 6)), expected);
}

// Under G141 the selection is held back as a whole: no token can carry it, so the client gives its
// input again.
TEST(ResumedStream, SelectionHeldAsAWholeIsGivenAgain) {
  Replaceable server;
  server.config().max_resume_token_bytes = 4096;
  server.replace();
  const std::string text = meander_text(300, "G141\n");
  const Collected expected = run_program(server, text, true, never);
  ASSERT_EQ(expected.failure, "");
  const Collected broken = run_program(server, text, true, at_random(server, 4, 20));
  EXPECT_GT(broken.resumed, 0U);
  expect_same(broken, expected);
}

TEST(ResumedStream, InputNoLongerKeptEndsTheSession) {
  Replaceable server;
  server.config().max_resume_token_bytes = 4096;
  server.replace();
  int pieces = 0;
  const Disturb once = [&] {
    if (++pieces == 20) server.replace();
  };
  const Collected broken = run_program(server, meander_text(300, "G141\n"), true, once, 4 * 1024);
  EXPECT_EQ(broken.failure, "UNAVAILABLE");
  EXPECT_EQ(broken.summary, "none");
}

TEST(ResumedStream, ServerWithAnotherKeyDoesNotTakeTheStream) {
  Replaceable server;
  int pieces = 0;
  const Disturb once = [&] {
    if (++pieces != 20) return;
    server.stop();
    std::filesystem::remove(server.key_file());
    server.replace();
  };
  const Collected broken = run_program(server, meander_text(300, ""), true, once);
  EXPECT_EQ(broken.failure, "RESUME_TOKEN_INVALIDINVALID_ARGUMENT");
}

TEST(ResumedStream, ServerThatStaysAwayIsGivenUp) {
  Replaceable server;
  int pieces = 0;
  const Disturb once = [&] {
    if (++pieces == 5) server.stop();
  };
  std::optional<Connection> connection;
  ConnectionOptions options;
  options.resume.patience = milliseconds(300);
  options.resume.first_wait = milliseconds(20);
  ASSERT_FALSE(Connection::open(server.address(), {}, connection, options));
  RemoteProgramSession session(*connection, {});
  const std::string text = meander_text(300, "");
  const Collected broken = run(session, in_chunks(text, 777), once);
  EXPECT_EQ(broken.failure, "UNAVAILABLE");
  EXPECT_EQ(broken.resumed, 0U);
}

TEST(ResumedStream, WithoutPatienceTheFirstLossIsTheEnd) {
  Replaceable server;
  int pieces = 0;
  const Disturb once = [&] {
    if (++pieces == 5) server.replace();
  };
  std::optional<Connection> connection;
  ConnectionOptions options;
  options.resume.patience = milliseconds(0);
  ASSERT_FALSE(Connection::open(server.address(), {}, connection, options));
  RemoteProgramSession session(*connection, {});
  const std::string text = meander_text(300, "");
  EXPECT_EQ(run(session, in_chunks(text, 777), once).failure, "UNAVAILABLE");
}

}  // namespace
}  // namespace trc::client::resuming
