#pragma once

#include <functional>
#include <string>
#include <vector>

#include "client/cli/command.h"
#include "trc/v1/setup.pb.h"

namespace trc::cli {

// Many programs with the same settings, in separate processes: a failure with one program does not
// affect the others.
struct FolderRun {
  std::vector<std::string> files{};
  std::string directory{};               // for the results, and a record beside each: NAME.json
  std::vector<std::string> arguments{};  // of `trc compensate` for all of them
  v1::ProgramSetup setup{};              // what they mean, but for the name of the file
  std::string format{};                  // as --format
  std::string server_version{};          // of the compensating server: release and commit
  std::string server_commit{};
  unsigned jobs = 1;  // at a time
  bool quiet = false;
};

// Skips a program whose record shows the same job done before, and whose result still exists.
// Passes the messages of each program to standard error, and prints a table of results. Returns the
// worst ending of all. A program that failed or was not begun keeps result and record of an earlier
// run; a refused one has no result.
//
// SIGINT, SIGTERM and SIGHUP end the running programs, print the table and end this process as
// usual. After waiting for a server in vain nothing more is begun.
[[nodiscard]] Exit compensate_folder(const FolderRun& run);

// Where result and record of a program go.
[[nodiscard]] std::string result_in(const std::string& directory, const std::string& file);
[[nodiscard]] std::string record_in(const std::string& directory, const std::string& file);

// In a separate process: runs one program after another and reports how `compensate` ended.
[[nodiscard]] Exit work_for_folder(const std::function<Exit(const std::string& file)>& compensate);

}  // namespace trc::cli
