// Servers of which nobody knows what they were built from: what one seals, another build of the
// same name does not take for its own.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tests/faults/questions.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {
namespace {

using server::StreamAnswer;
using testing_support::content_of;
using testing_support::Folder;
using testing_support::ServerProcess;

const std::string first_part = "G0 X0 Y0\nG0 X5\n";
const std::string second_part = "G1 G41 V.G.WZ_AKT.R=0.5 X10 Y0 F800\nX20\nG40\nX30 Y9\nM30\n";

// A copy of the server that counts as another build: its build id differs.
std::string another_build(const Folder& folder) {
  std::string program = content_of(NAMELESS_SERVER);
  // The ELF note of the build id: sizes of name and number, its kind, its name.
  constexpr std::string_view note("\4\0\0\0\x14\0\0\0\3\0\0\0GNU", 16);
  const std::size_t at = program.find(note);
  if (at == std::string::npos) return {};
  program[at + note.size()] = static_cast<char>(program[at + note.size()] ^ 1);
  const std::string path = folder.write("another", program);
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

class NamelessServer {
 public:
  NamelessServer(const std::string& program, const std::string& key)
      : server_({"--resume-key-file", key}, "127.0.0.1:0", 0, {},
                {"/bin/sh", "-c", "exec '" + program + "' \"$@\""}) {}

  [[nodiscard]] std::string commit() const {
    grpc::ClientContext context;
    v1::GetServerInfoResponse info;
    v1::TrcService::NewStub(channel())->GetServerInfo(&context, {}, &info);
    return info.commit();
  }
  // The token of a stream that has got as far as `head`.
  [[nodiscard]] std::string token() const {
    grpc::ClientContext context;
    const auto stub = v1::TrcService::NewStub(channel());
    const auto stream = stub->CompensateProgram(&context);
    stream->Write(server::setup_request(setup()));
    stream->Write(server::text_request(0, first_part, false));
    v1::CompensateProgramResponse response;
    while (response.resume_token().empty() && stream->Read(&response)) continue;
    context.TryCancel();
    stream->Finish();
    return response.resume_token();
  }
  // How a stream ends that goes on with it.
  [[nodiscard]] StreamAnswer goes_on(const std::string& token) const {
    v1::ProgramSetup with_token = setup();
    with_token.mutable_path()->set_resume_token(token);
    return server::call_program(channel(),
                                {server::setup_request(with_token),
                                 server::text_request(first_part.size(), second_part, true)});
  }

 private:
  static v1::ProgramSetup setup() {
    v1::ProgramSetup setup;
    setup.mutable_path()->set_want_resume_tokens(true);
    return setup;
  }
  [[nodiscard]] std::shared_ptr<grpc::Channel> channel() const {
    return channel_to(server_.address());
  }

  ServerProcess server_;
};

TEST(Builds, OfUnknownCommitsDoNotShareTheirTokens) {
  const Folder folder;
  const std::string key = folder.path("key");
  const std::string other_program = another_build(folder);
  ASSERT_FALSE(other_program.empty()) << "the linker has given the program no number";
  std::string token;
  {
    const NamelessServer first(NAMELESS_SERVER, key);
    ASSERT_EQ(first.commit(), "unknown");
    token = first.token();
    ASSERT_FALSE(token.empty());
  }
  {
    const NamelessServer other(other_program, key);
    ASSERT_EQ(other.commit(), "unknown");
    const StreamAnswer refused = other.goes_on(token);
    EXPECT_EQ(refused.status.error_code(), grpc::FAILED_PRECONDITION);
    EXPECT_EQ(refused.reason(), "RESUME_TOKEN_OF_OTHER_VERSION") << refused.status.error_message();
    EXPECT_EQ(refused.text, "");
    EXPECT_TRUE(other.goes_on(other.token()).status.ok());
  }
  const NamelessServer again(NAMELESS_SERVER, key);
  const StreamAnswer answer = again.goes_on(token);
  EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_TRUE(answer.text.ends_with("M30\n"));
}

}  // namespace
}  // namespace trc::faults
