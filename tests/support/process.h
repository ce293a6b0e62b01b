#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace trc::testing_support {

// What a program that has ended leaves.
struct Ended {
  int code = -1;  // exit code; -1: killed after a minute or by a signal
  std::string out;
  std::string err;
};

// Runs a program to its end.
Ended run(const std::vector<std::string>& command, const std::string& input = "");

// A file in a folder of its own that goes with this object.
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

[[nodiscard]] std::string content_of(const std::string& path);

// trcd on a free loopback port until this object goes.
class ServerProcess {
 public:
  explicit ServerProcess(const std::vector<std::string>& flags = {});
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  // HOST:PORT; empty when it did not start.
  [[nodiscard]] const std::string& address() const { return address_; }

 private:
  Folder folder_;
  pid_t process_ = -1;
  std::string address_;
};

}  // namespace trc::testing_support
