#pragma once

#include <cstddef>
#include <string>

namespace trc::server {

// A file that a setting names, as a whole. Pipes, devices and folders are refused: reading them may
// never end, and files are read again while the server runs.
struct PlainFile {
  static constexpr std::size_t most_bytes = std::size_t{4} << 20U;

  std::string content{};
  std::string fault{};  // empty, or what keeps it from being read

  // Never blocks.
  static PlainFile read(const std::string& path);
  // What is wrong with the file of a setting, for whoever gave it; empty: nothing.
  [[nodiscard]] std::string fault_of(const std::string& setting, const std::string& path) const;
};

}  // namespace trc::server
