// The worked examples through a server on a loopback port: the coordinates of the
// rule book for every program in `good`, the same refusal for every one in `bad`,
// and the bits of a session without network.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "client/trc/remote_program_session.h"
#include "proto/wire/compensated_block.h"
#include "proto/wire/setup.h"
#include "server/server.h"
#include "tests/support/expectation.h"
#include "tests/support/files.h"
#include "tests/support/program_run.h"

namespace trc::support {
namespace {

namespace fs = std::filesystem;

struct Served {
  std::vector<CompensatedBlock> blocks{};
  std::vector<std::pair<Code, std::uint32_t>> diagnostics{};  // with their lines
  bool complete = false;

  // Every bit of every block.
  [[nodiscard]] std::string bytes() const {
    v1::CompensatedBatch batch;
    wire::to_proto(blocks, 0, batch);
    return batch.SerializeAsString();
  }
};

class ServedPrograms : public ::testing::Test {
 protected:
  static server::Config loopback() {
    server::Config config;
    config.listen = {"127.0.0.1:0"};
    config.log_level = "off";
    return config;
  }

  void start(std::size_t selection_blocks) {
    server::Config config = loopback();
    config.max_blocks_per_selection = selection_blocks;
    auto started = server::Server::start(config);
    ASSERT_NE(started.server, nullptr) << started.fault;
    connection_.reset();
    server_ = std::move(started.server);
    selection_blocks_ = selection_blocks;
    const std::string address = "127.0.0.1:" + std::to_string(server_->ports().front());
    const auto failure = client::Connection::open(address, {}, connection_);
    ASSERT_FALSE(failure) << failure->message;
  }

  Served serve(const std::string& text, wire::Layout layout, std::size_t piece) {
    const ProgramSessionSetup session = read_setup(text);
    // The server sets this limit, not the setup.
    const std::size_t limit = session.session.compensator.limits.selection_blocks;
    if (limit != selection_blocks_) start(limit);
    wire::ProgramSettings settings;
    settings.path.session = session.session;
    settings.path.response_layout = layout;
    settings.nc_text = false;
    v1::ProgramSetup setup;
    wire::to_proto(settings, setup);
    client::RemoteProgramSession remote(*connection_, setup);
    Served served;
    Answers answers([&](const Answer& answer) {
      served.blocks.insert(served.blocks.end(), answer.blocks.begin(), answer.blocks.end());
      for (const Diagnostic& told : answer.diagnostics)
        served.diagnostics.emplace_back(told.code, told.source.line);
      return true;
    });
    bool goes_on = true;
    for (std::size_t at = 0; goes_on && at < text.size(); at += piece)
      goes_on = remote.feed(std::string_view(text).substr(at, piece), answers);
    served.complete = goes_on && remote.finish(answers);
    return served;
  }

  std::unique_ptr<server::Server> server_;
  std::optional<client::Connection> connection_;
  std::size_t selection_blocks_ = 0;  // of the server; 0: none has been started
};

Served run_here(const std::string& text) {
  const ProgramRun run = to_blocks(text, read_setup(text));
  Served served{.blocks = run.blocks, .complete = !run.stopped};
  for (const Diagnostic& diagnostic : run.diagnostics)
    served.diagnostics.emplace_back(diagnostic.code, diagnostic.source.line);
  return served;
}

TEST_F(ServedPrograms, GiveTheCoordinatesOfTheRuleBook) {
  for (const fs::path& program : testing_support::nc_programs_in("good")) {
    SCOPED_TRACE(program.filename().string());
    const std::string text = testing_support::content_of(program);
    const Served here = run_here(text);
    const Served blocks = serve(text, wire::Layout::blocks, text.size());
    EXPECT_EQ(blocks.complete, here.complete);
    EXPECT_EQ(blocks.diagnostics, here.diagnostics);
    EXPECT_EQ(blocks.bytes(), here.bytes());
    EXPECT_EQ(serve(text, wire::Layout::columns, 11).bytes(), here.bytes());
    fs::path expected = program;
    expected.replace_extension(".expected");
    EXPECT_EQ(
        difference(blocks.blocks, read_expectation(testing_support::content_of(expected)).blocks,
                   !blocks.complete),
        "");
  }
}

TEST_F(ServedPrograms, AreRefusedWithTheDiagnosticOfTheirFirstLine) {
  for (const fs::path& program : testing_support::nc_programs_in("bad")) {
    SCOPED_TRACE(program.filename().string());
    const std::string text = testing_support::content_of(program);
    const Served here = run_here(text);
    const Served served = serve(text, wire::Layout::blocks, 64);
    EXPECT_EQ(served.complete, here.complete);
    EXPECT_EQ(served.diagnostics, here.diagnostics);
    EXPECT_EQ(served.bytes(), here.bytes());
    const Code expected = read_expected_refusal(text).code;
    EXPECT_TRUE(std::any_of(served.diagnostics.begin(), served.diagnostics.end(),
                            [&](const auto& raised) { return raised.first == expected; }))
        << static_cast<int>(expected);
  }
}

}  // namespace
}  // namespace trc::support
