// Settings of the built server that would open it by mistake, and what a client's words become in
// its log.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "grpc/reflection/v1alpha/reflection.grpc.pb.h"
#include "tests/faults/questions.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {
namespace {

using server::StreamAnswer;
using testing_support::ServerProcess;

TEST(Settings, ThatWouldOpenTheServerByMistakeAreSaidBeforeAPortOpens) {
  struct Case {
    std::vector<std::string> flags;
    std::string says;
  };
  const std::vector<Case> cases{
      {{"--listen", "0.0.0.0:0"}, "plain text with insecure"},
      {{"--listen", "127.0.0.1:0", "--admin-listen", "0.0.0.0:0"}, "insecure-admin"},
      {{"--listen", "127.0.0.1:0", "--health-listen", "0.0.0.0:0"}, "insecure-health"},
      {{"--listen", "127.0.0.1:0", "--http-listen", "0.0.0.0:0"}, "insecure-http"},
      {{"--listen", "127.0.0.1:0", "--tls-allowed-clients", ""}, "tls-allowed-clients"}};
  for (const auto& [flags, says] : cases) {
    std::vector<std::string> command{"/usr/bin/timeout", "10", testing_support::trcd_program()};
    command.insert(command.end(), flags.begin(), flags.end());
    const auto ended = testing_support::run(command);
    EXPECT_EQ(ended.code, 2) << says;
    EXPECT_NE(ended.err.find(says), std::string::npos) << ended.err;
  }
  const auto empty =
      testing_support::run({"/usr/bin/env", "TRCD_TLS_ALLOWED_CLIENTS=", "/usr/bin/timeout", "10",
                            testing_support::trcd_program(), "--listen", "127.0.0.1:0"});
  EXPECT_EQ(empty.code, 2);
  EXPECT_NE(empty.err.find("TRCD_TLS_ALLOWED_CLIENTS"), std::string::npos) << empty.err;
}

grpc::StatusCode reflects(const std::string& address) {
  grpc::ClientContext context;
  const auto stream = grpc::reflection::v1alpha::ServerReflection::NewStub(channel_to(address))
                          ->ServerReflectionInfo(&context);
  grpc::reflection::v1alpha::ServerReflectionRequest request;
  request.set_list_services("");
  stream->Write(request);
  stream->WritesDone();
  grpc::reflection::v1alpha::ServerReflectionResponse response;
  while (stream->Read(&response)) continue;
  return stream->Finish().error_code();
}

TEST(Settings, ReflectionIsForThisMachineUnlessAskedFor) {
  const auto port_of = [](const ServerProcess& server) {
    return "127.0.0.1" + server.address().substr(server.address().rfind(':'));
  };
  const ServerProcess here;
  EXPECT_EQ(reflects(here.address()), grpc::OK);
  const ServerProcess open({"--insecure"}, "0.0.0.0:0");
  EXPECT_EQ(reflects(port_of(open)), grpc::UNIMPLEMENTED);
  const ServerProcess asked({"--insecure", "--reflection=true"}, "0.0.0.0:0");
  EXPECT_EQ(reflects(port_of(asked)), grpc::OK);
}

// U+009B begins a sequence that a terminal obeys, as ESC [ does.
TEST(Settings, NoWordOfAClientReachesTheLogAsItIs) {
  const ServerProcess server({"--log-level", "debug"});
  const std::string control =
      "\xC2\x9B"
      "31m\x1B[31m\x7F\n{\"forged\":1}";
  v1::ProgramSetup setup;
  setup.mutable_path()->set_client_tag("tag " + control);
  EXPECT_FALSE(
      server::run_program(channel_to(server.address()), setup, server::g239_program).status.ok());
  setup.mutable_path()->clear_client_tag();
  setup.set_file_name("name " + control);
  server::run_program(channel_to(server.address()), setup, "G999 (" + control + ")\n");
  EXPECT_TRUE(serves(server.address()));
  EXPECT_TRUE(server::eventually(
      [&] { return server.log().find("CompensateProgram") != std::string::npos; }));
  const std::string log = server.log();
  EXPECT_EQ(log.find("\n{\"forged"), std::string::npos) << log;
  EXPECT_EQ(std::count_if(log.begin(), log.end(),
                          [](char c) {
                            const auto byte = static_cast<unsigned char>(c);
                            return (byte < 0x20 && c != '\n') || byte == 0x7F || byte == 0x9B;
                          }),
            0)
      << log;
}

}  // namespace
}  // namespace trc::faults
