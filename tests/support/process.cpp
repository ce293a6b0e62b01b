#include "tests/support/process.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
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

struct Surroundings {
  unsigned most_descriptors = 0;           // 0: as many as this process
  std::vector<std::string> environment{};  // NAME=VALUE, beside what there is
};

pid_t start(const std::vector<std::string>& command, const Streams& streams,
            const Surroundings& surroundings = {}) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t process = ::fork();
  if (process != 0) return process;
  if (surroundings.most_descriptors > 0) {
    const rlimit limit{surroundings.most_descriptors, surroundings.most_descriptors};
    if (::setrlimit(RLIMIT_NOFILE, &limit) != 0) ::_exit(126);
  }
  for (const std::string& setting : surroundings.environment)
    ::putenv(const_cast<char*>(setting.c_str()));
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

Ended run(const std::vector<std::string>& command, const std::string& input) {
  const Folder folder;
  const Streams streams{
      .in = folder.write("in", input), .out = folder.path("out"), .err = folder.path("err")};
  const int code = wait_for(start(command, streams), std::chrono::seconds(60));
  return {.code = code, .out = content_of(streams.out), .err = content_of(streams.err)};
}

std::string http_answer(const std::string& address, const std::string& request) {
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_port = htons(static_cast<in_port_t>(std::stoi(address.substr(address.rfind(':') + 1))));
  name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int connection = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  std::string answer;
  if (::connect(connection, reinterpret_cast<const sockaddr*>(&name), sizeof(name)) == 0 &&
      ::send(connection, request.data(), request.size(), MSG_NOSIGNAL) > 0) {
    std::array<char, 4096> part{};
    for (ssize_t size = 0; (size = ::recv(connection, part.data(), part.size(), 0)) > 0;)
      answer.append(part.data(), static_cast<std::size_t>(size));
  }
  ::close(connection);
  return answer;
}

std::string http_get(const std::string& address, const std::string& path) {
  const std::string answer =
      http_answer(address, "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const std::size_t head = answer.find("\r\n\r\n");
  return head == std::string::npos ? "" : answer.substr(head + 4);
}

Process::Process(const std::vector<std::string>& command, unsigned most_descriptors,
                 const std::vector<std::string>& environment)
    : id_(start(command, {.out = folder_.path("out"), .err = folder_.path("err")},
                {.most_descriptors = most_descriptors, .environment = environment})) {}

Process::~Process() {
  if (code_) return;
  signal(SIGKILL);
  wait();
}

void Process::signal(int number) const {
  if (!code_ && id_ > 0) ::kill(id_, number);
}

int Process::wait() {
  if (!code_) code_ = wait_for(id_, std::chrono::seconds(60));
  return *code_;
}

std::string Process::out() const { return content_of(folder_.path("out")); }
std::string Process::err() const { return content_of(folder_.path("err")); }

namespace {

std::vector<std::string> server_command(const std::vector<std::string>& flags,
                                        const std::string& listen,
                                        std::vector<std::string> command) {
  command.insert(command.end(), {trcd_program(), "--listen", listen});
  command.insert(command.end(), flags.begin(), flags.end());
  return command;
}

}  // namespace

ServerProcess::ServerProcess(const std::vector<std::string>& flags, const std::string& listen,
                             unsigned most_descriptors, const std::vector<std::string>& environment,
                             const std::vector<std::string>& launcher)
    : process_(server_command(flags, listen, launcher), most_descriptors, environment) {
  const Clock::time_point end = Clock::now() + std::chrono::seconds(30);
  while (address_.empty() && Clock::now() < end) {
    address_ = port_named("ports");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

ServerProcess::~ServerProcess() {
  process_.signal(SIGTERM);
  process_.wait();
}

std::string ServerProcess::port_named(const std::string& field) const {
  const std::regex pattern("\"" + field + "\":\"?(\\d+)");
  const std::string text = log();
  std::smatch found;
  return std::regex_search(text, found, pattern) ? "127.0.0.1:" + found[1].str() : "";
}

double ServerProcess::status(const std::string& name) const {
  std::ifstream status("/proc/" + std::to_string(process_.id()) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return std::stod(line.substr(name.size() + 1));
  return 0;
}

double ServerProcess::resident_mib() const { return status("VmRSS") / 1024; }
double ServerProcess::address_space_mib() const { return status("VmSize") / 1024; }
int ServerProcess::threads() const { return static_cast<int>(status("Threads")); }

}  // namespace trc::testing_support
