// Settings of the built server that name a file which is none, or not the one that is meant.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

#include "tests/support/process.h"

namespace trc::faults {
namespace {

using testing_support::content_of;
using testing_support::Folder;

TEST(Files, NoSocketIsNotDeleted) {
  const Folder folder;
  const std::string file = folder.write("part.nc", "N5 G1 X0\n");
  const auto ended =
      testing_support::run({testing_support::trcd_program(), "--listen", "unix:" + file});
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.err, "trcd: error: cannot listen on unix:" + file +
                           ": there is a file which is no socket\n");
  EXPECT_EQ(content_of(file), "N5 G1 X0\n");
}

TEST(Files, SocketOfAnotherServerIsNotDeleted) {
  const Folder folder;
  const std::string path = folder.path("socket");
  testing_support::ServerProcess first({}, "unix:" + path);
  ASSERT_EQ(unlink(path.c_str()), 0);
  const testing_support::ServerProcess second({}, "unix:" + path);
  first.signal(SIGTERM);
  EXPECT_EQ(first.wait(), 0);
  EXPECT_EQ(access(path.c_str(), F_OK), 0);
}

TEST(Files, KeyThatIsNoneIsSaidInOneLine) {
  const Folder folder;
  ASSERT_EQ(symlink("nowhere", folder.path("dangling").c_str()), 0);
  ASSERT_EQ(mkdir(folder.path("directory").c_str(), 0700), 0);
  for (const std::string& path : {folder.path("dangling"), folder.path("directory"),
                                  folder.write("zeros", std::string(32, '\0'))}) {
    const auto ended = testing_support::run(
        {testing_support::trcd_program(), "--listen", "127.0.0.1:0", "--resume-key-file", path});
    EXPECT_EQ(ended.code, 2) << path;
    EXPECT_TRUE(ended.err.starts_with("trcd: error: resume-key-file: '" + path + "' "))
        << ended.err;
    EXPECT_EQ(ended.err.find('\n'), ended.err.size() - 1) << ended.err;
  }
}

// Reading a pipe would wait for a writer for ever, and a device never comes to an end.
TEST(Files, SettingThatNamesNoneIsSaidInOneLine) {
  const Folder folder;
  ASSERT_EQ(mkfifo(folder.path("pipe").c_str(), 0600), 0);
  ASSERT_EQ(mkdir(folder.path("directory").c_str(), 0700), 0);
  const std::string file = folder.write("any.pem", "");
  const std::vector<std::vector<std::string>> settings{
      {"--config"},
      {"--resume-key-file"},
      {"--tls-key-file", file, "--tls-cert-file"},
      {"--tls-cert-file", file, "--tls-key-file"},
      {"--tls-cert-file", file, "--tls-key-file", file, "--tls-client-ca-file"}};
  for (const std::vector<std::string>& setting : settings) {
    for (const std::string& path : {folder.path("pipe"), folder.path("directory"),
                                    std::string("/dev/zero"), folder.path("none")}) {
      if (setting.front() == "--resume-key-file" && path == folder.path("none")) continue;
      std::vector<std::string> command{"/usr/bin/timeout", "10", testing_support::trcd_program(),
                                       "--listen", "127.0.0.1:0"};
      command.insert(command.end(), setting.begin(), setting.end());
      command.push_back(path);
      const auto ended = testing_support::run(command);
      EXPECT_EQ(ended.code, 2) << setting.back() << " " << path;
      EXPECT_NE(ended.err.find("'" + path + "'"), std::string::npos) << ended.err;
      EXPECT_EQ(ended.err.find('\n'), ended.err.size() - 1) << ended.err;
    }
  }
  const auto named =
      testing_support::run({"/usr/bin/env", "TRCD_CONFIG=" + folder.path("pipe"),
                            "/usr/bin/timeout", "10", testing_support::trcd_program()});
  EXPECT_EQ(named.code, 2) << named.err;
}

}  // namespace
}  // namespace trc::faults
