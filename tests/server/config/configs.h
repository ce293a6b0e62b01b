#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "server/config/config.h"

// Command lines, variables and files from which the tests have a configuration read.
namespace trc::server::configs {

inline CommandLine read(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "trcd");
  return read_command_line(static_cast<int>(arguments.size()), arguments.data());
}

// Sets a variable of the environment as long as it lives.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
  ~Environment() { unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
};

// A file with the text, deleted at the end.
class TextFile {
 public:
  explicit TextFile(const std::string& text, const std::string& ending = ".toml")
      : path_(std::filesystem::temp_directory_path() /
              ("trcd_config_" + std::to_string(getpid()) + ending)) {
    std::ofstream(path_) << text;
  }
  ~TextFile() { std::filesystem::remove(path_); }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

// Refused with exit code 2 and one line that holds all of `words`.
inline void expect_fault(const CommandLine& result, const std::vector<std::string>& words) {
  ASSERT_TRUE(result.exit.has_value());
  EXPECT_EQ(result.exit->code, 2);
  EXPECT_EQ(result.exit->text.find('\n'), std::string::npos) << result.exit->text;
  for (const std::string& word : words)
    EXPECT_NE(result.exit->text.find(word), std::string::npos)
        << "'" << word << "' is not in: " << result.exit->text;
}

}  // namespace trc::server::configs
