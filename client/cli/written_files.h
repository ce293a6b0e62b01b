#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "client/cli/program_options.h"

namespace trc::cli {

// The files that a call reads, whatever names they have: by links, from another folder.
class FilesRead {
 public:
  // Of the options, but the program itself. A folder of subprograms holds what this program became
  // before, too: its files are not among them.
  explicit FilesRead(const ProgramOptions& options);

  // `as`: what it is, for messages. A device or a pipe is no file that is lost.
  void add(const std::string& path, const std::string& as);
  // What the file of that name is; empty: it is none of them.
  [[nodiscard]] std::string named(const std::string& path) const;

 private:
  std::map<std::pair<dev_t, ino_t>, std::string> files_;
};

// A file to write, and the option that names it.
struct WrittenFile {
  std::string option{};
  std::string path{};  // empty or "-": none
};

// Whether nothing that is written is read, or written twice. Says on standard error what is.
[[nodiscard]] bool may_be_written(const std::vector<WrittenFile>& written, const FilesRead& read);

}  // namespace trc::cli
