#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

#include "client/cli/files.h"

namespace trc::cli {

// The lines of a program that is read once, for messages that show one. A file is read again for
// them; of what cannot be read twice (standard input, a pipe) the first 16 MiB are kept.
class SourceLines {
 public:
  // Before anything of `input` is read, and as long as it is.
  explicit SourceLines(Input& input);
  SourceLines(const SourceLines&) = delete;
  SourceLines& operator=(const SourceLines&) = delete;

  // Without its end, and no more of it than 64 KiB. `number` counts from 1; nothing: not kept, or
  // there is no such line. Numbers that rise cost one pass over the program together.
  [[nodiscard]] std::optional<std::string> line(std::uint32_t number);

 private:
  void rewind();
  // -1 at the end.
  int peek_byte();
  // Each of the three line ends, CR LF, LF and CR, as one LF.
  int next_byte();

  std::string path_;  // empty: kept
  std::ifstream file_;
  std::string kept_;
  std::size_t position_ = 0;
  std::uint32_t next_line_ = 1;
};

}  // namespace trc::cli
