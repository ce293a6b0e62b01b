#include "client/cli/computing_options.h"

#include <filesystem>
#include <system_error>

#include "client/cli/file_name.h"
#include "client/cli/files.h"
#include "proto/wire/settings.h"

namespace trc::cli {
namespace {

namespace fs = std::filesystem;

// Together with the rest of the setup they fit a message.
constexpr std::size_t most_bytes = 900 * 1024;

std::string add_file(const fs::path& path, std::size_t& bytes, v1::ProgramSetup& setup) {
  std::string text;
  if (!read_bounded(path, most_bytes, text))
    return "--subprograms: " + path.string() + " cannot be read";
  bytes += text.size();
  if (bytes > most_bytes)
    return "--subprograms: more than 900 KiB; name the files that the program calls";
  (*setup.mutable_subprograms())[text_of_name(path.filename().string())] = text;
  return {};
}

std::string add_path(const fs::path& path, std::size_t& bytes, v1::ProgramSetup& setup) {
  std::error_code failed;
  if (!fs::is_directory(path, failed)) return add_file(path, bytes, setup);
  for (const auto& entry : fs::directory_iterator(path, failed)) {
    if (!entry.is_regular_file(failed)) continue;
    if (std::string fault = add_file(entry.path(), bytes, setup); !fault.empty()) return fault;
  }
  return failed ? "--subprograms: " + path.string() + ": " + failed.message() : std::string();
}

}  // namespace

std::string add_computing_options(const ProgramOptions& options, v1::ProgramSetup& setup) {
  for (const std::string& variable : options.variables)
    if (std::string fault = wire::apply_variable(variable, setup); !fault.empty())
      return "--variable: " + fault;
  std::size_t bytes = 0;
  for (const std::string& path : options.subprograms)
    if (std::string fault = add_path(path, bytes, setup); !fault.empty()) return fault;
  if (options.max_executed_lines) setup.set_max_executed_lines(*options.max_executed_lines);
  return {};
}

}  // namespace trc::cli
