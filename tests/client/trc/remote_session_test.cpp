#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <future>
#include <random>
#include <string>
#include <vector>

#include "client/trc/message_size.h"
#include "client/trc/remote_path_session.h"
#include "client/trc/remote_program_session.h"
#include "client/trc/survey.h"
#include "core/messages/diagnostic_text.h"
#include "core/session/program_session.h"
#include "proto/wire/compensated_block.h"
#include "server/in_process.h"
#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::client {
namespace {

using std::chrono::seconds;

// Examples T-01 and T-04 of the rule book.
constexpr std::string_view g239_program =
    "%G239\nN010 G0 X0 Y0 Z0 F1000\nN020 G239\nN030 V.G.WZ_AKT.R = 10\nN040 G41 G01 X30 Y20\n"
    "N050 G01 X60\nN060 G01 X90\nN070 G01 X120\nN080 G40\nN100 G00 X150 Y0\nN110 M30\n";
constexpr std::string_view refused_program =
    "N005 G162\nN010 G0 X0 Y0 Z0 F1000\nN020 G239\nN030 V.G.WZ_AKT.R = 30\n"
    "N040 G41 G01 X30 Y20\nN050 G01 X60\nN060 G01 X90\nN070 G40\nN080 G02 X140 Y-30 J-50\n"
    "N120 M30\n";

std::string bytes_of(const std::vector<CompensatedBlock>& blocks) {
  v1::CompensatedBatch batch;
  wire::to_proto(blocks, 0, batch);
  return batch.SerializeAsString();
}

// A meander with outside and inside corners, arcs, text and changes of radius.
std::vector<wire::PathInput> meander(std::size_t turns, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<wire::PathInput> items;
  const auto source = [&items] { return Source{.index = items.size(), .number = 5}; };
  items.emplace_back(wire::TrcCommand{.source = source(), .side = Side::left});
  for (std::size_t turn = 0; turn < turns; ++turn) {
    const double x = 20.0 * static_cast<double>(turn);
    const double y = 10 + static_cast<double>(random() % 1000) / 100;
    items.emplace_back(MoveRequest{.source = source(), .end = {x, y, {}}, .feed = 800});
    items.emplace_back(MoveRequest{.source = source(), .end = {x + 10, y, {}}, .feed = 800});
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

wire::PathSettings small_tool(wire::Layout layout) {
  wire::PathSettings settings;
  settings.session.program.mode.tool_radius = 0.5;
  settings.session.program.mode.transition = Transition::circular;
  settings.response_layout = layout;
  return settings;
}

// Takes a stream only when its first input is there.
class InputFirst final : public v1::TrcService::Service {
  grpc::Status CompensateProgram(
      grpc::ServerContext* /*context*/,
      grpc::ServerReaderWriter<v1::CompensateProgramResponse, v1::CompensateProgramRequest>* stream)
      override {
    v1::CompensateProgramResponse last;
    last.set_nc_text("M30\n");
    return serve<v1::CompensateProgramRequest>(*stream, last);
  }
  grpc::Status CompensatePath(
      grpc::ServerContext* /*context*/,
      grpc::ServerReaderWriter<v1::CompensatePathResponse, v1::CompensatePathRequest>* stream)
      override {
    return serve<v1::CompensatePathRequest>(*stream, v1::CompensatePathResponse());
  }

  template <class Request, class Response>
  static grpc::Status serve(grpc::ServerReaderWriter<Response, Request>& stream, Response last) {
    Request request;
    if (!stream.Read(&request) || !request.has_setup() || !stream.Read(&request))
      return {grpc::StatusCode::CANCELLED, "no input"};
    Response response;
    response.mutable_accepted()->set_max_batches_in_flight(4);
    stream.Write(response);
    while (stream.Read(&request)) {
    }
    last.mutable_summary();
    stream.Write(last);
    return grpc::Status::OK;
  }
};

// Whether `session`, which is given a connection, comes to its end there.
template <class Session>
bool ends_with_input_first(Session session) {
  InputFirst service;
  grpc::ServerBuilder builder;
  builder.RegisterService(&service);
  const auto server = builder.BuildAndStart();
  const Connection connection(server->InProcessChannel({}));
  auto done = std::async(std::launch::async, [&] { return session(connection); });
  const auto ended = done.wait_for(seconds(30));
  // If either side waited for the other, both would wait for ever.
  if (ended != std::future_status::ready) server->Shutdown(std::chrono::system_clock::now());
  return done.get();
}

TEST(RemoteProgramSession, SendsItsFirstTextWithTheSetup) {
  Answers out;
  EXPECT_TRUE(ends_with_input_first([&out](const Connection& connection) {
    RemoteProgramSession session(connection, v1::ProgramSetup());
    return session.feed("M30\n", out) && session.finish(out);
  }));
  EXPECT_EQ(out.take().text, "M30\n");
}

TEST(RemotePathSession, SendsItsFirstBatchWithTheSetup) {
  for (const wire::Layout layout : {wire::Layout::blocks, wire::Layout::columns}) {
    EXPECT_TRUE(ends_with_input_first([layout](const Connection& connection) {
      RemotePathSession session(connection, small_tool(layout));
      Answers out;
      return session.feed(meander(2, 1), out) && session.finish(out);
    }));
  }
}

class RemoteSession : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { server_ = new server::InProcessServer(); }
  static void TearDownTestSuite() {
    delete server_;
    server_ = nullptr;
  }
  [[nodiscard]] static Connection connection() { return Connection(server_->channel()); }

  static server::InProcessServer* server_;
};
server::InProcessServer* RemoteSession::server_ = nullptr;

TEST_F(RemoteSession, ProgramTextIsThatOfALocalSession) {
  ProgramSession local({});
  Answers answers;
  ASSERT_TRUE(local.feed(g239_program, answers) && local.finish(answers));
  const Answer expected = answers.take();
  for (const std::size_t cut : {std::size_t{1}, std::size_t{7}, g239_program.size()}) {
    RemoteProgramSession remote(connection(), {});
    Answers out;
    for (std::size_t from = 0; from < g239_program.size(); from += cut)
      ASSERT_TRUE(remote.feed(g239_program.substr(from, cut), out));
    ASSERT_TRUE(remote.finish(out)) << remote.failure()->message;
    const Answer collected = out.take();
    EXPECT_EQ(collected.text, expected.text);
    EXPECT_TRUE(collected.blocks.empty());
    ASSERT_TRUE(remote.summary());
    EXPECT_EQ(remote.summary()->bytes_in, g239_program.size());
    EXPECT_EQ(remote.summary()->bytes_out, expected.text.size());
    EXPECT_EQ(remote.summary()->path.summary.blocks_out, local.summary().blocks_out);
  }
}

TEST_F(RemoteSession, ProgramBlocksAreThoseOfALocalSessionInBothLayouts) {
  ProgramSession local({.nc_text = false});
  Answers answers;
  ASSERT_TRUE(local.feed(g239_program, answers) && local.finish(answers));
  const Answer expected = answers.take();
  ASSERT_FALSE(expected.blocks.empty());
  for (const v1::ResponseLayout layout :
       {v1::RESPONSE_LAYOUT_BLOCKS, v1::RESPONSE_LAYOUT_COLUMNS}) {
    v1::ProgramSetup setup;
    setup.set_output(v1::PROGRAM_OUTPUT_BLOCKS);
    setup.mutable_path()->set_response_layout(layout);
    RemoteProgramSession remote(connection(), setup);
    Answers out;
    ASSERT_TRUE(remote.feed(g239_program, out));
    ASSERT_TRUE(remote.finish(out)) << remote.failure()->message;
    const Answer collected = out.take();
    EXPECT_EQ(bytes_of(collected.blocks), bytes_of(expected.blocks));
    EXPECT_TRUE(collected.text.empty());
  }
}

TEST_F(RemoteSession, PathIsThatOfALocalSessionInBothLayouts) {
  constexpr unsigned seed = 11;
  SCOPED_TRACE("seed " + std::to_string(seed));
  const std::vector<wire::PathInput> items = meander(2000, seed);
  PathSession local(small_tool(wire::Layout::blocks).session);
  Answers answers;
  for (const wire::PathInput& item : items)
    ASSERT_TRUE(wire::apply(item, local.program()) && local.advance(answers));
  ASSERT_TRUE(local.finish({.index = items.size()}, answers));
  const Answer expected = answers.take();
  ASSERT_GT(expected.blocks.size(), items.size());

  for (const wire::Layout layout : {wire::Layout::blocks, wire::Layout::columns}) {
    RemotePathSession remote(connection(), small_tool(layout));
    Answers out;
    ASSERT_TRUE(remote.feed(items, out)) << remote.failure()->message;
    ASSERT_TRUE(remote.finish(out)) << remote.failure()->message;
    const Answer collected = out.take();
    EXPECT_TRUE(bytes_of(collected.blocks) == bytes_of(expected.blocks));
    ASSERT_TRUE(remote.summary());
    EXPECT_EQ(remote.summary()->summary.blocks_out, expected.blocks.size());
    EXPECT_EQ(remote.summary()->summary.compensated_length, local.summary().compensated_length);
  }
}

// A selection that is held as a whole comes out in many portions.
TEST_F(RemoteSession, MaskedPathIsThatOfALocalSessionInBothLayouts) {
  constexpr unsigned seed = 12;
  SCOPED_TRACE("seed " + std::to_string(seed));
  const std::vector<wire::PathInput> items = meander(2000, seed);
  wire::PathSettings settings = small_tool(wire::Layout::blocks);
  settings.session.program.mode.tool_radius = 8;
  settings.session.program.mode.masking = Masking::on;
  settings.session.program.mode.options.remove_masked_blocks = true;
  PathSession local(settings.session);
  Answers answers;
  for (const wire::PathInput& item : items) ASSERT_TRUE(wire::apply(item, local.program()));
  ASSERT_TRUE(local.advance(answers) && local.finish({.index = items.size()}, answers));
  const Answer expected = answers.take();
  ASSERT_GT(expected.blocks.size(), 4000U);

  for (const wire::Layout layout : {wire::Layout::blocks, wire::Layout::columns}) {
    settings.response_layout = layout;
    RemotePathSession remote(connection(), settings);
    Answers out;
    ASSERT_TRUE(remote.feed(items, out)) << remote.failure()->message;
    ASSERT_TRUE(remote.finish(out)) << remote.failure()->message;
    const Answer collected = out.take();
    EXPECT_TRUE(bytes_of(collected.blocks) == bytes_of(expected.blocks));
    EXPECT_EQ(collected.diagnostics.size(), expected.diagnostics.size());
  }
}

// A server that announces less than any takes would get pieces of nothing, for ever.
TEST(MessageSize, IsNeverLessThanEveryServerTakes) {
  MessageSize size;
  const std::size_t text = size.text_bytes();
  const std::size_t blocks = size.blocks();
  for (const std::uint64_t announced : {0U, 1U, 64U, 4095U}) {
    v1::StreamAccepted accepted;
    accepted.set_max_message_bytes(announced);
    size.take(accepted);
    EXPECT_EQ(size.text_bytes(), text) << announced;
    EXPECT_EQ(size.blocks(), blocks) << announced;
  }
}

TEST(RemoteSessions, SendPiecesThatTheServerTakes) {
  server::Config config = server::InProcessServer::quiet();
  config.max_message_bytes = 4096;
  const server::InProcessServer server(config);
  const Connection connection(server.channel());
  std::string text = "G162\nG0 X0 Y0 F1000\n";
  for (int line = 1; line <= 9000; ++line) text += "G1 X" + std::to_string(line) + "\n";
  text += "M30\n";
  ASSERT_GT(text.size(), 64U * 1024U);
  Answers out;

  RemoteProgramSession program(connection, {});
  ASSERT_TRUE(program.feed(text, out) && program.finish(out)) << program.failure()->message;
  EXPECT_EQ(program.summary()->bytes_in, text.size());
  EXPECT_EQ(out.take().text.size(), text.size());

  const std::vector<wire::PathInput> items = meander(1000, 13);
  for (const wire::Layout layout : {wire::Layout::blocks, wire::Layout::columns}) {
    RemotePathSession path(connection, small_tool(layout));
    ASSERT_TRUE(path.feed(items, out) && path.finish(out)) << path.failure()->message;
    EXPECT_GT(out.take().blocks.size(), items.size());
  }

  v1::SurveySetup setup;
  setup.mutable_program();
  setup.add_radii(3);
  const auto failure =
      survey_program(connection, setup, text, [](const v1::SurveyRadiiResponse&) { return true; });
  EXPECT_FALSE(failure) << failure->message;
}

TEST_F(RemoteSession, RefusedProgramGivesItsDiagnosticAndNoSummary) {
  RemoteProgramSession remote(connection(), {});
  Answers out;
  remote.feed(refused_program, out);
  EXPECT_FALSE(remote.finish(out));
  const Answer collected = out.take();
  ASSERT_FALSE(collected.diagnostics.empty());
  const Diagnostic& last = collected.diagnostics.back();
  EXPECT_EQ(last.code, Code::circle_center_misfit);
  EXPECT_EQ(last.severity, Severity::error);
  EXPECT_EQ(last.source.line, 9U);
  EXPECT_EQ(last.source.number, 80);
  EXPECT_FALSE(texts_of(last).remedy.empty());
  ASSERT_TRUE(remote.failure());
  EXPECT_EQ(remote.failure()->status, "INVALID_ARGUMENT");
  EXPECT_EQ(remote.failure()->reason, row_of(Code::circle_center_misfit).reason);
  EXPECT_FALSE(remote.failure()->unreachable());
  EXPECT_FALSE(remote.summary());
}

TEST_F(RemoteSession, HasTheRecordThatItsSetupAsksFor) {
  v1::ProgramSetup setup;
  setup.set_record(true);
  RemoteProgramSession done(connection(), setup);
  Answers out;
  ASSERT_TRUE(done.feed(g239_program, out) && done.finish(out));
  EXPECT_NE(done.record().find("\"outcome\":\"DONE\""), std::string::npos) << done.record();
  RemoteProgramSession refused(connection(), setup);
  refused.feed(refused_program, out);
  EXPECT_FALSE(refused.finish(out));
  EXPECT_NE(refused.record().find("\"outcome\":\"REFUSED\""), std::string::npos);
  EXPECT_NE(refused.record().find("\"code\":20035"), std::string::npos) << refused.record();
  RemoteProgramSession unasked(connection(), {});
  ASSERT_TRUE(unasked.feed(g239_program, out) && unasked.finish(out));
  EXPECT_EQ(unasked.record(), "");
}

TEST_F(RemoteSession, WrongSetupNamesItsFields) {
  v1::ProgramSetup setup;
  setup.mutable_path()->set_tool_radius(std::nan(""));
  setup.set_decimals(17);
  RemoteProgramSession remote(connection(), setup);
  Answers out;
  EXPECT_FALSE(remote.feed(g239_program, out));
  EXPECT_FALSE(remote.finish(out));
  ASSERT_TRUE(remote.failure());
  EXPECT_EQ(remote.failure()->status, "INVALID_ARGUMENT");
  ASSERT_EQ(remote.failure()->fields.size(), 2U);
  EXPECT_EQ(remote.failure()->fields[0].field, "setup.path.tool_radius");
  EXPECT_EQ(remote.failure()->fields[1].field, "setup.decimals");
}

TEST_F(RemoteSession, WrongBlockNamesItsFieldAndLetsTheEarlierOnesThrough) {
  for (const wire::Layout layout : {wire::Layout::blocks, wire::Layout::columns}) {
    RemotePathSession remote(connection(), small_tool(layout));
    const std::vector<wire::PathInput> items{
        MoveRequest{.end = {1, 2, {}}, .feed = 5},
        MoveRequest{.end = {std::numeric_limits<double>::infinity(), {}, {}}, .feed = 5}};
    Answers out;
    remote.feed(items, out);
    EXPECT_FALSE(remote.finish(out));
    const Answer collected = out.take();
    EXPECT_EQ(collected.blocks.size(), 1U);
    ASSERT_TRUE(remote.failure());
    ASSERT_EQ(remote.failure()->fields.size(), 1U);
    EXPECT_EQ(remote.failure()->fields[0].field,
              layout == wire::Layout::blocks ? "batch.blocks[1].linear.end.x" : "columns.x[1]");
  }
}

TEST_F(RemoteSession, EmptyPathIsComplete) {
  RemotePathSession remote(connection(), wire::PathSettings{});
  Answers out;
  EXPECT_TRUE(remote.finish(out));
  const Answer collected = out.take();
  EXPECT_TRUE(collected.blocks.empty());
  ASSERT_TRUE(remote.summary());
  EXPECT_EQ(remote.summary()->summary.blocks_out, 0U);
}

TEST_F(RemoteSession, SinkThatWantsNoMoreStopsTheStream) {
  const std::vector<wire::PathInput> items = meander(5000, 3);
  RemotePathSession remote(connection(), small_tool(wire::Layout::columns));
  int answers = 0;
  Answers stop([&answers](const Answer&) { return ++answers < 2; });
  remote.feed(items, stop);
  EXPECT_FALSE(remote.finish(stop));
  EXPECT_EQ(answers, 2);
  ASSERT_TRUE(remote.failure());
  EXPECT_EQ(remote.failure()->reason, "CALLER_STOPPED");
  EXPECT_FALSE(remote.summary());
}

TEST_F(RemoteSession, UnfinishedSessionEndsWhenDropped) {
  const std::vector<wire::PathInput> items = meander(50, 3);
  Answers out;
  { const RemotePathSession untouched(connection(), small_tool(wire::Layout::blocks)); }
  {
    RemotePathSession remote(connection(), small_tool(wire::Layout::blocks));
    EXPECT_TRUE(remote.feed(items, out));
  }
  // The server is well and takes the next one.
  RemotePathSession next(connection(), small_tool(wire::Layout::blocks));
  EXPECT_TRUE(next.feed(items, out));
  EXPECT_TRUE(next.finish(out));
}

TEST_F(RemoteSession, FinishedSessionTakesNothingMore) {
  RemotePathSession remote(connection(), small_tool(wire::Layout::blocks));
  Answers out;
  ASSERT_TRUE(remote.finish(out));
  const std::vector<wire::PathInput> items{MoveRequest{.end = {1, 2, {}}, .feed = 5}};
  EXPECT_FALSE(remote.feed(items, out));
  const Answer collected = out.take();
  EXPECT_TRUE(collected.blocks.empty());
}

TEST_F(RemoteSession, InfoAndHealthAnswer) {
  v1::GetServerInfoResponse info;
  ASSERT_FALSE(connection().server_info(seconds(10), info));
  EXPECT_FALSE(info.version().empty());
  EXPECT_EQ(static_cast<std::size_t>(info.diagnostics_size()), code_table().size());
  bool serving = false;
  ASSERT_FALSE(connection().health(seconds(10), serving));
  EXPECT_TRUE(serving);
}

TEST(Connection, ServesOverTcpAndUnixSocket) {
  const std::string socket =
      (std::filesystem::temp_directory_path() / ("trc_client_" + std::to_string(getpid())))
          .string();
  server::Config config = server::InProcessServer::quiet();
  config.listen = {"127.0.0.1:0", "unix:" + socket};
  const server::Server::Start started = server::Server::start(config);
  ASSERT_TRUE(started.server) << started.fault;
  const std::string port = std::to_string(started.server->ports().front());
  ProgramSession local({});
  Answers answers;
  ASSERT_TRUE(local.feed(g239_program, answers) && local.finish(answers));
  const Answer expected = answers.take();
  for (const std::string& address : {"127.0.0.1:" + port, "unix:" + socket}) {
    SCOPED_TRACE(address);
    std::optional<Connection> connection;
    ASSERT_FALSE(Connection::open(address, {}, connection));
    RemoteProgramSession remote(*connection, {});
    Answers out;
    EXPECT_TRUE(remote.feed(g239_program, out));
    EXPECT_TRUE(remote.finish(out));
    const Answer collected = out.take();
    EXPECT_EQ(collected.text, expected.text);
  }
}

TEST(Connection, NobodyListeningIsUnreachable) {
  std::optional<Connection> connection;
  ASSERT_FALSE(Connection::open("unix:/nonexistent/trc.sock", {}, connection));
  RemoteProgramSession remote(*connection, {});
  Answers out;
  EXPECT_FALSE(remote.feed("G0 X0\n", out));
  ASSERT_TRUE(remote.failure());
  EXPECT_EQ(remote.failure()->status, "UNAVAILABLE");
  EXPECT_TRUE(remote.failure()->unreachable());
}

TEST(Connection, MissingOrHalfTlsFilesAreNamed) {
  std::optional<Connection> connection;
  const auto unreadable =
      Connection::open("localhost:1", {.ca = "/nonexistent/ca.pem"}, connection);
  ASSERT_TRUE(unreadable);
  EXPECT_EQ(unreadable->message, "cannot read /nonexistent/ca.pem");
  const auto half = Connection::open("localhost:1", {.cert = "cert.pem"}, connection);
  ASSERT_TRUE(half);
  EXPECT_EQ(half->reason, "TLS_FILES_INCOMPLETE");
  EXPECT_FALSE(connection);
}

// Inconsistent answers, which no server of this project sends.
class BrokenServer : public v1::TrcService::Service {
 public:
  enum class Fault { no_summary, gap };
  explicit BrokenServer(Fault fault) : fault_(fault) {
    grpc::ServerBuilder builder;
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
  }
  ~BrokenServer() override { server_->Shutdown(); }
  BrokenServer(const BrokenServer&) = delete;
  BrokenServer& operator=(const BrokenServer&) = delete;

  [[nodiscard]] Connection connection() {
    return Connection(server_->InProcessChannel(grpc::ChannelArguments()));
  }

  grpc::Status CompensatePath(
      grpc::ServerContext* /*context*/,
      grpc::ServerReaderWriter<v1::CompensatePathResponse, v1::CompensatePathRequest>* stream)
      override {
    v1::CompensatePathRequest request;
    v1::CompensatePathResponse response;
    stream->Read(&request);
    response.mutable_accepted()->set_max_batches_in_flight(4);
    stream->Write(response);
    if (fault_ == Fault::gap) {
      response.mutable_batch()->set_first_block(1);
      stream->Write(response);
    }
    while (stream->Read(&request)) {
    }
    return grpc::Status::OK;
  }

 private:
  Fault fault_;
  std::unique_ptr<grpc::Server> server_;
};

TEST(BrokenServer, OkWithoutSummaryIsNoSuccess) {
  BrokenServer server(BrokenServer::Fault::no_summary);
  RemotePathSession remote(server.connection(), wire::PathSettings{});
  Answers out;
  EXPECT_FALSE(remote.finish(out));
  ASSERT_TRUE(remote.failure());
  EXPECT_EQ(remote.failure()->reason, "SUMMARY_MISSING");
}

TEST(BrokenServer, GapInThePathIsNoSuccess) {
  BrokenServer server(BrokenServer::Fault::gap);
  RemotePathSession remote(server.connection(), wire::PathSettings{});
  Answers out;
  EXPECT_FALSE(remote.finish(out));
  ASSERT_TRUE(remote.failure());
  EXPECT_EQ(remote.failure()->reason, "RESPONSE_INVALID");
}

// Gives each line back as it is, and a token after it where the call was told so. Its first call
// is lost after two lines.
class LineServer : public v1::TrcService::Service {
 public:
  explicit LineServer(std::vector<bool> gives_tokens) : gives_tokens_(std::move(gives_tokens)) {
    grpc::ServerBuilder builder;
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
  }
  ~LineServer() override { server_->Shutdown(); }
  LineServer(const LineServer&) = delete;
  LineServer& operator=(const LineServer&) = delete;

  [[nodiscard]] Connection connection() {
    return Connection(server_->InProcessChannel(grpc::ChannelArguments()),
                      {.patience = std::chrono::seconds(10)});
  }

  grpc::Status CompensateProgram(
      grpc::ServerContext* /*context*/,
      grpc::ServerReaderWriter<v1::CompensateProgramResponse, v1::CompensateProgramRequest>* stream)
      override {
    const std::size_t call = calls_++;
    v1::CompensateProgramRequest request;
    stream->Read(&request);
    v1::CompensateProgramResponse accepted;
    accepted.mutable_accepted()->set_max_batches_in_flight(1);
    stream->Write(accepted);
    for (int lines = 1; stream->Read(&request); ++lines) {
      const v1::ProgramText& text = request.text();
      v1::CompensateProgramResponse response;
      response.set_nc_text(text.text());
      response.set_consumed_bytes(text.first_byte() + text.text().size());
      if (gives_tokens_.at(call)) response.set_resume_token("token");
      if (text.final()) response.mutable_summary();
      stream->Write(response);
      if (call == 0 && lines == 2) return {grpc::StatusCode::UNAVAILABLE, "gone"};
    }
    return grpc::Status::OK;
  }

 private:
  std::vector<bool> gives_tokens_;
  std::size_t calls_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

// What a token may have grows with the state that it holds: near the limit one stream gives one
// where the other gave none.
TEST(LineServer, ThatGivesTokensOnlyTheSecondTimeIsGoneOnWith) {
  LineServer server({false, true});
  RemoteProgramSession remote(server.connection(), {});
  Answers out;
  for (const char* line : {"X1\n", "X2\n", "X3\n", "X4\n"}) EXPECT_TRUE(remote.feed(line, out));
  EXPECT_TRUE(remote.finish(out));
  EXPECT_FALSE(remote.failure()) << remote.failure()->message;
  EXPECT_EQ(out.take().text, "X1\nX2\nX3\nX4\n");
}

}  // namespace
}  // namespace trc::client
