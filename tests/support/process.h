#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "tests/support/files.h"

namespace trc::testing_support {

// Whether memory in use says anything: a sanitizer keeps freed memory and needs a multiple itself.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool memory_tells = false;
#else
inline constexpr bool memory_tells = true;
#endif

// How much longer a run under a sanitizer may take: ThreadSanitizer looks at all symbols for each
// race that it is told to ignore, and a long answer has thousands of them.
#if defined(__SANITIZE_THREAD__)
inline constexpr int times_slower = 20;
#elif defined(__SANITIZE_ADDRESS__)
inline constexpr int times_slower = 4;
#else
inline constexpr int times_slower = 1;
#endif

// The built programs, as absolute paths.
std::string trc_program();
std::string trcd_program();

// What a program that has ended leaves.
struct Ended {
  int code = -1;  // exit code; -1: killed after a minute or by a signal
  std::string out;
  std::string err;
};

// Runs a program to its end.
Ended run(const std::vector<std::string>& command, const std::string& input = "");

// A folder of its own, deleted with this object.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] std::string path(const std::string& name) const { return path_ + "/" + name; }
  std::string write(const std::string& name, const std::string& text) const;
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  std::string path_;
};

// All that comes back to `request` before the connection is closed.
[[nodiscard]] std::string http_answer(const std::string& address, const std::string& request);
// The body of the answer to GET; empty when there is none.
[[nodiscard]] std::string http_get(const std::string& address, const std::string& path);

// A running program. It is killed with this object.
class Process {
 public:
  // `most_descriptors`: what it may open; 0: as many as this process.
  explicit Process(const std::vector<std::string>& command, unsigned most_descriptors = 0,
                   const std::vector<std::string>& environment = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const;
  // The exit code; -1 after a minute or by a signal.
  int wait();
  // What it has said so far.
  [[nodiscard]] std::string out() const;
  [[nodiscard]] std::string err() const;
  [[nodiscard]] pid_t id() const { return id_; }

 private:
  Folder folder_;
  pid_t id_ = -1;
  std::optional<int> code_;
};

// trcd at a loopback port, a free one unless another is named, until this object goes: then it is
// asked to end. A launcher is a command that runs the one after it.
class ServerProcess {
 public:
  explicit ServerProcess(const std::vector<std::string>& flags = {},
                         const std::string& listen = "127.0.0.1:0", unsigned most_descriptors = 0,
                         const std::vector<std::string>& environment = {},
                         const std::vector<std::string>& launcher = {});
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  // HOST:PORT; empty when it did not start.
  [[nodiscard]] const std::string& address() const { return address_; }
  // Of --admin-listen and --health-listen.
  [[nodiscard]] std::string admin() const { return port_named("admin_port"); }
  [[nodiscard]] std::string health() const { return port_named("health_port"); }
  [[nodiscard]] std::string log() const { return process_.out(); }
  [[nodiscard]] std::string errors() const { return process_.err(); }
  void signal(int number) const { process_.signal(number); }
  int wait() { return process_.wait(); }
  // Resident memory.
  [[nodiscard]] double resident_mib() const;
  [[nodiscard]] double address_space_mib() const;
  [[nodiscard]] int threads() const;
  [[nodiscard]] pid_t id() const { return process_.id(); }

 private:
  [[nodiscard]] double status(const std::string& name) const;
  [[nodiscard]] std::string port_named(const std::string& field) const;

  Process process_;
  std::string address_;
};

}  // namespace trc::testing_support
