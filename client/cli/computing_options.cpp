#include "client/cli/computing_options.h"

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "client/cli/file_name.h"
#include "client/cli/files.h"
#include "core/base/utf8.h"
#include "proto/wire/settings.h"
#include "proto/wire/setup.h"

namespace trc::cli {
namespace {

namespace fs = std::filesystem;

// Leaves room in the message for the rest of the setup.
constexpr std::size_t most_bytes = 900 * 1024;

// Folders of subprograms may also hold pictures or archives, which are no text. Zeros at the start
// and the end, as serial lines leave them, are allowed in a text.
bool is_text(std::string_view bytes) {
  constexpr std::string_view zero("\0", 1);
  const std::size_t begin = bytes.find_first_not_of(zero);
  if (begin == std::string_view::npos) return bytes.empty();
  return bytes.substr(0, bytes.find_last_not_of(zero) + 1).find('\0', begin) ==
         std::string_view::npos;
}

enum class NoText : std::uint8_t { is_ignored, is_refused };

std::string add_file(const fs::path& path, NoText no_text, std::size_t& bytes,
                     v1::ProgramSetup& setup) {
  std::string text;
  if (!read_bounded(path, most_bytes, text))
    return "--subprograms: " + text_of_name(path.string()) + " cannot be read";
  if (!is_text(text))
    return no_text == NoText::is_ignored
               ? std::string()
               : "--subprograms: " + text_of_name(path.string()) + " is no NC text";
  bytes += text.size();
  if (bytes > most_bytes)
    return "--subprograms: more than 900 KiB; name the files that the program calls";
  wire::add_subprogram(as_utf8(path.filename().string()), text, setup);
  return {};
}

std::string add_path(const fs::path& path, std::size_t& bytes, v1::ProgramSetup& setup) {
  std::error_code failed;
  if (!fs::is_directory(path, failed)) return add_file(path, NoText::is_refused, bytes, setup);
  for (const auto& entry : fs::directory_iterator(path, failed)) {
    if (!entry.is_regular_file(failed)) continue;
    if (std::string fault = add_file(entry.path(), NoText::is_ignored, bytes, setup);
        !fault.empty())
      return fault;
  }
  return failed ? "--subprograms: " + text_of_name(path.string()) + ": " + failed.message()
                : std::string();
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
