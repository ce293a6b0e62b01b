#include "tests/support/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <thread>

namespace trc::testing_support {
namespace {

using Clock = std::chrono::steady_clock;

struct Streams {
  std::string in = "/dev/null";
  std::string out = "/dev/null";
  std::string err = "/dev/null";
};

void replace_by_file(int descriptor, const std::string& path, int flags) {
  const int file = ::open(path.c_str(), flags, 0600);
  if (file < 0 || ::dup2(file, descriptor) < 0) ::_exit(126);
}

pid_t start(const std::vector<std::string>& command, const Streams& streams) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t process = ::fork();
  if (process != 0) return process;
  replace_by_file(STDIN_FILENO, streams.in, O_RDONLY);
  replace_by_file(STDOUT_FILENO, streams.out, O_WRONLY | O_CREAT | O_TRUNC);
  replace_by_file(STDERR_FILENO, streams.err, O_WRONLY | O_CREAT | O_TRUNC);
  ::execv(arguments[0], arguments.data());
  ::_exit(127);
}

// The exit code, or -1 after the time or by a signal.
int wait_for(pid_t process, Clock::duration longest) {
  const Clock::time_point end = Clock::now() + longest;
  int status = 0;
  while (::waitpid(process, &status, WNOHANG) == 0) {
    if (Clock::now() > end) {
      ::kill(process, SIGKILL);
      ::waitpid(process, &status, 0);
      return -1;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

Folder::Folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "trc_test_XXXXXX").string();
  if (::mkdtemp(pattern.data()) != nullptr) path_ = pattern;
}

Folder::~Folder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

std::string Folder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
  return path(name);
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_))
    names.push_back(entry.path().filename().string());
  return names;
}

std::string content_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

Ended run(const std::vector<std::string>& command, const std::string& input) {
  const Folder folder;
  const Streams streams{
      .in = folder.write("in", input), .out = folder.path("out"), .err = folder.path("err")};
  const int code = wait_for(start(command, streams), std::chrono::seconds(60));
  return {.code = code, .out = content_of(streams.out), .err = content_of(streams.err)};
}

ServerProcess::ServerProcess(const std::vector<std::string>& flags) {
  std::vector<std::string> command{TRCD_PROGRAM, "--listen", "127.0.0.1:0"};
  command.insert(command.end(), flags.begin(), flags.end());
  const std::string log = folder_.path("log");
  process_ = start(command, {.out = log, .err = folder_.path("err")});
  const std::regex started("\"ports\":\"(\\d+)\"");
  const Clock::time_point end = Clock::now() + std::chrono::seconds(30);
  while (address_.empty() && Clock::now() < end) {
    const std::string text = content_of(log);
    std::smatch found;
    if (std::regex_search(text, found, started)) address_ = "127.0.0.1:" + found[1].str();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

ServerProcess::~ServerProcess() {
  if (process_ <= 0) return;
  ::kill(process_, SIGTERM);
  wait_for(process_, std::chrono::seconds(30));
}

}  // namespace trc::testing_support
