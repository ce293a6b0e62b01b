#include "client/cli/program_options.h"

#include <iostream>

#include "client/cli/settings.h"

namespace trc::cli {

void add_program_options(CLI::App& command, ProgramOptions& options) {
  command.add_option("file", options.file, "NC program; - reads standard input")
      ->type_name("FILE")
      ->required();
  command
      .add_option("--set", options.assignments,
                  "What holds before the first line, as in tool_radius=5; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  add_service_options(command, options.service);
}

bool setup_of(const ProgramOptions& options, v1::ProgramSetup& setup) {
  for (const std::string& assignment : options.assignments) {
    const std::string fault = apply_setting(assignment, setup);
    if (fault.empty()) continue;
    std::cerr << "trc: --set: " << fault << '\n';
    return false;
  }
  // The server shows the name in its log; the end says more than the directory.
  constexpr std::size_t longest_name = 255;
  const std::string& name = options.file;
  setup.set_file_name(name.size() > longest_name ? name.substr(name.size() - longest_name) : name);
  return true;
}

std::string settings_help() {
  std::string text = "Settings (--set KEY=VALUE):\n";
  for (const SettingRow& row : settings()) text += "  " + row.key + ": " + row.values + "\n";
  text += "The last part of a key will do where no other key ends in it: stretch_factor=2.";
  return text;
}

}  // namespace trc::cli
