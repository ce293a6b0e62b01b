#include "client/load/process_meter.h"

#include <unistd.h>

#include <charconv>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

namespace trc::load {
namespace {

constexpr std::string_view unix_prefix = "unix:";

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// The inode of the socket that listens at a port; "": none. In /proc/net/tcp and tcp6 words 1, 3
// and 9 are the local address, the state and the inode.
std::string inode_of_port(const std::string& table, unsigned port) {
  std::ifstream file(table);
  std::string line;
  while (std::getline(file, line)) {
    const std::vector<std::string> words = words_of(line);
    constexpr std::string_view listening = "0A";
    if (words.size() < 10 || words[3] != listening) continue;
    const std::string_view local = words[1];
    const std::string_view digits = local.substr(local.rfind(':') + 1);
    unsigned found = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), found, 16);
    if (found == port) return words[9];
  }
  return {};
}

// In /proc/net/unix the path is the last word and the inode the one before it.
std::string inode_of_path(std::string_view path) {
  std::ifstream file("/proc/net/unix");
  std::string line;
  while (std::getline(file, line)) {
    const std::vector<std::string> words = words_of(line);
    if (words.size() == 8 && words[7] == path) return words[6];
  }
  return {};
}

std::string inode_of(const std::string& address) {
  if (address.starts_with(unix_prefix)) return inode_of_path(address.substr(unix_prefix.size()));
  const std::string host = address.substr(0, address.rfind(':'));
  // On another host this port may belong to another program.
  if (host != "localhost" && !host.starts_with("127.") && host != "[::1]") return {};
  unsigned port = 0;
  const std::string digits = address.substr(address.rfind(':') + 1);
  std::from_chars(digits.data(), digits.data() + digits.size(), port);
  const std::string inode = inode_of_port("/proc/net/tcp", port);
  return inode.empty() ? inode_of_port("/proc/net/tcp6", port) : inode;
}

bool has_open(const std::filesystem::path& process, const std::string& target) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(process / "fd", error)) {
    std::error_code unreadable;
    if (std::filesystem::read_symlink(entry.path(), unreadable) == target) return true;
  }
  return false;
}

// stime is word 15 of the line. The words are counted from after the name, which may contain
// blanks.
double system_seconds(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text);
  const std::vector<std::string> words = words_of(text.substr(text.rfind(')') + 1));
  if (words.size() < 13) return 0;
  return std::stod(words[12]) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double resident_mib(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/statm");
  double all = 0;
  double resident = 0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

}  // namespace

std::optional<ProcessUse> use_of(pid_t process) {
  clockid_t clock = 0;
  timespec cpu{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &cpu) != 0)
    return std::nullopt;
  return ProcessUse{
      .cpu_s = static_cast<double>(cpu.tv_sec) + 1e-9 * static_cast<double>(cpu.tv_nsec),
      .system_s = system_seconds(process),
      .resident_mib = resident_mib(process)};
}

std::optional<pid_t> listening_process(const std::string& address) {
  const std::string inode = inode_of(address);
  if (inode.empty()) return std::nullopt;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", error)) {
    const std::string name = entry.path().filename();
    pid_t process = 0;
    const auto read = std::from_chars(name.data(), name.data() + name.size(), process);
    if (read.ec == std::errc() && has_open(entry.path(), "socket:[" + inode + "]")) return process;
  }
  return std::nullopt;
}

}  // namespace trc::load
