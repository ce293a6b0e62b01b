#include "client/cli/written_files.h"

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <system_error>

#include "client/cli/speech.h"

namespace trc::cli {
namespace {

namespace fs = std::filesystem;

std::optional<std::pair<dev_t, ino_t>> identity_of(const std::string& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return std::nullopt;
  return std::pair(found.st_dev, found.st_ino);
}

bool is_file(const std::string& path) {
  std::error_code none;
  return !path.empty() && path != "-" && (!fs::exists(path, none) || identity_of(path));
}

}  // namespace

FilesRead::FilesRead(const ProgramOptions& options) {
  add(options.tools, "the table of --tools");
  for (const std::string& path : options.subprograms) add(path, "a file of --subprograms");
}

void FilesRead::add(const std::string& path, const std::string& as) {
  if (const auto identity = identity_of(path)) files_.insert({*identity, as});
}

std::string FilesRead::named(const std::string& path) const {
  const auto identity = identity_of(path);
  const auto found = identity ? files_.find(*identity) : files_.end();
  return found == files_.end() ? std::string() : found->second;
}

bool may_be_written(const std::vector<WrittenFile>& written, const FilesRead& read) {
  std::map<fs::path, std::string> before;
  for (const auto& [option, path] : written) {
    if (!is_file(path)) continue;
    std::string other = read.named(path);
    std::error_code none;
    if (other.empty()) {
      const auto [first, is_new] = before.insert({fs::weakly_canonical(path, none), option});
      if (!is_new) other = "the file of " + first->second;
    }
    if (other.empty()) continue;
    std::string text = option;
    text.append(" ").append(path).append(" is ").append(other).append("; write another file");
    complain(text);
    return false;
  }
  return true;
}

}  // namespace trc::cli
