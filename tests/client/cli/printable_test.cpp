// What servers and names of files hold never acts on the terminal.

#include "client/cli/printable.h"

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>

#include "client/cli/info_text.h"
#include "client/cli/service.h"
#include "client/cli/speech.h"
#include "client/cli/verbose_text.h"
#include "server/in_process.h"
#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::cli {
namespace {

// A title for the window, a cleared screen, a colour by a control character of 8 bits, and a line
// that looks like one of trc.
constexpr std::string_view hostile =
    "\x1B]0;title\a\x1B[2J\xC2\x9B"
    "31m\ntrc: all is well\r";
constexpr std::string_view harmless = "?]0;title??[2J?31m?trc: all is well?";

bool acts_on_the_display(std::string_view text) {
  return text.find_first_of("\x1B\a\r") != std::string_view::npos ||
         text.find("\xC2\x9B") != std::string_view::npos ||
         text.find("\ntrc: all is well") != std::string_view::npos;
}

// A server that answers with such texts.
class HostileServer final : public v1::TrcService::Service {
 public:
  explicit HostileServer(grpc::Status status = {}) : status_(std::move(status)) {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
  }

  grpc::Status GetServerInfo(grpc::ServerContext* /*context*/,
                             const v1::GetServerInfoRequest* /*request*/,
                             v1::GetServerInfoResponse* response) override {
    response->set_version(std::string(hostile) + std::string(3'000'000, 'A'));
    response->set_commit(std::string(hostile));
    response->set_build(std::string(hostile));
    v1::Setting& setting = *response->add_settings();
    setting.set_name(std::string(hostile));
    setting.set_meaning(std::string(hostile));
    return status_;
  }

  [[nodiscard]] ServiceOptions options() const {
    ServiceOptions options;
    options.server = "127.0.0.1:" + std::to_string(port_);
    return options;
  }

 private:
  const grpc::Status status_;
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

TEST(Printable, HasNothingThatActsOnTheDisplay) {
  EXPECT_EQ(printable(hostile), harmless);
  EXPECT_EQ(printable("Fräsen\t½ 寸"), "Fräsen ½ 寸");
  EXPECT_EQ(printable("a\u202Eb"), "a?b");
  EXPECT_EQ(printable("a\xE4"), "aä");
}

TEST(Printable, IsCutBetweenTwoCharacters) {
  EXPECT_EQ(printable("abcd", 4), "abcd");
  EXPECT_EQ(printable("abcde", 4), "abcd...");
  EXPECT_EQ(printable("abcä", 4), "abc...");
}

TEST(ServerInfo, OfAHostileServerIsPrintable) {
  const HostileServer server;
  v1::GetServerInfoResponse info;
  ASSERT_EQ(server_info(server.options(), info), Exit::done);
  const std::string text = text_of(info, Language::english);
  EXPECT_FALSE(acts_on_the_display(text)) << text;
  EXPECT_NE(text.find(harmless), std::string::npos) << text;
  EXPECT_LT(text.size(), 10'000U);
  EXPECT_FALSE(acts_on_the_display(markdown_options(info)));
  const std::string taken = text_of_taken("part.nc", {}, server.options(), info);
  EXPECT_FALSE(acts_on_the_display(taken)) << taken;
  EXPECT_LT(taken.size(), 10'000U);
}

TEST(ServerInfo, OfThisProcessIsTakenAsItIs) {
  server::InProcessServer server(server::InProcessServer::quiet());
  v1::GetServerInfoResponse info;
  grpc::ClientContext context;
  ASSERT_TRUE(v1::TrcService::NewStub(server.channel())->GetServerInfo(&context, {}, &info).ok());
  v1::GetServerInfoResponse printable = info;
  make_printable(printable);
  EXPECT_EQ(text_of(printable, Language::english), text_of(info, Language::english));
}

TEST(Complaint, AboutTheStatusOfAHostileServerIsPrintable) {
  const HostileServer server(
      grpc::Status(grpc::StatusCode::INVALID_ARGUMENT, std::string(hostile)));
  v1::GetServerInfoResponse info;
  testing::internal::CaptureStderr();
  EXPECT_EQ(server_info(server.options(), info), Exit::wrong_call);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_FALSE(acts_on_the_display(said)) << said;
  EXPECT_NE(said.find(harmless), std::string::npos) << said;
}

TEST(Complaint, IsOneLine) {
  testing::internal::CaptureStderr();
  complain("a\nb" + std::string(10'000, 'c'));
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(said.find('\n'), said.size() - 1);
  EXPECT_LT(said.size(), 5000U);
}

}  // namespace
}  // namespace trc::cli
