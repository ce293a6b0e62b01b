#include "server/config/config.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "core/base/version.h"
#include "server/config/config_file.h"
#include "server/config/config_settings.h"
#include "server/config/plain_file.h"
#include "server/net/address.h"

namespace trc::server {
namespace {

// Kubernetes and linked containers set these variables to announce a service named trcd.
bool is_service_link(std::string_view variable) {
  const std::size_t port = variable.find("_PORT_");
  return variable.ends_with("_SERVICE_HOST") ||
         variable.find("_SERVICE_PORT") != std::string_view::npos || variable.ends_with("_PORT") ||
         (port != std::string_view::npos && port + 6 < variable.size() &&
          std::isdigit(static_cast<unsigned char>(variable[port + 6])) != 0);
}

// A misspelt variable would silently have no effect.
std::optional<std::string> fault_of_environment(const CLI::App& app) {
  std::vector<std::string> known{"TRCD_CONFIG"};
  for (const std::string& name : setting_names(app)) known.push_back(environment_name(name));
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view whole = *entry;
    const std::string variable(whole.substr(0, whole.find('=')));
    if (!variable.starts_with("TRCD_") || is_service_link(variable)) continue;
    if (std::find(known.begin(), known.end(), variable) == known.end())
      return "there is no setting for the environment variable " + variable +
             did_you_mean(variable, known);
  }
  return std::nullopt;
}

// The fault for options that do not exist, with the most likely intended name.
std::string fault_of_extras(const CLI::App& app, int argc, const char* const* argv,
                            const std::string& fault) {
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options())
    known.push_back("--" + option->get_lnames().front());
  for (int i = 1; i < argc; ++i) {
    const std::string_view whole = argv[i];
    const std::string word(whole.substr(0, whole.find('=')));
    if (word.starts_with("--") && std::find(known.begin(), known.end(), word) == known.end())
      return "there is no option " + word + did_you_mean(word, known);
  }
  return fault;
}

// An empty guard, for example from a variable that was never set, would silently be switched off.
// The guards in a file are checked when the file is read.
std::optional<std::string> fault_of_empty_guard(const CLI::App& app, int argc,
                                                const char* const* argv) {
  for (const std::string& guard : guard_names()) {
    const std::string variable = environment_name(guard);
    const char* value = std::getenv(variable.c_str());
    if (value != nullptr && is_empty_value(value))
      return variable + " is set but empty; give it a value or unset it";
    for (int i = 1; i < argc; ++i) {
      const std::string_view word = argv[i];
      const bool alone = word == "--" + guard && (i + 1 == argc || is_empty_value(argv[i + 1]));
      const std::string with_value = "--" + guard + "=";
      if (alone || (word.starts_with(with_value) && is_empty_value(word.substr(with_value.size()))))
        return guard + " is given but empty; give it a value or leave it out";
    }
    const CLI::Option* option = app.get_option("--" + guard);
    for (const std::string& entry : option->results())
      if (is_empty_value(entry)) return guard + " has an empty entry";
  }
  return std::nullopt;
}

// TOML that reads back as the same settings. An unset guard becomes a comment, because an empty
// guard is refused.
std::string text_of(const Printed& printed) {
  std::string text;
  for (const PrintedSetting& setting : printed) {
    const std::string value = setting.value();
    if (is_guard(setting.name) && is_empty_value(value)) text += "# ";
    text += setting.name + '=' + value + '\n';
  }
  return text;
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

// A fault that begins with an option; if its value comes from the environment, with the variable.
std::string named_as_given(const std::string& fault, int argc, const char* const* argv) {
  const std::size_t end = fault.find(':');
  if (!fault.starts_with("--") || end == std::string::npos) return fault;
  const std::string option = fault.substr(0, end);
  const std::string variable = environment_name(option.substr(2));
  const bool is_on_command_line = std::any_of(argv, argv + argc, [&](const std::string_view word) {
    return word == option || word.starts_with(option + "=");
  });
  const bool is_given_there = !is_on_command_line && std::getenv(variable.c_str()) != nullptr;
  return is_given_there ? variable + fault.substr(end) : fault;
}

// `names_no_file`: TRCD_CONFIG is set to nothing.
std::string text_of(const CLI::Error& fault, const CLI::App& app, int argc, const char* const* argv,
                    bool names_no_file) {
  if (names_no_file && app.get_config_ptr()->count() == 0)
    return "TRCD_CONFIG is set but empty; name a file or unset it";
  const auto guard = fault_of_empty_guard(app, argc, argv);
  const bool extra = fault.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
  return guard.value_or(one_line(extra ? fault_of_extras(app, argc, argv, fault.what())
                                       : named_as_given(fault.what(), argc, argv)));
}

}  // namespace

CommandLine read_command_line(int argc, const char* const* argv) {
  CommandLine result;
  CLI::App app("trcd: computes CNC tool radius compensation as a gRPC service", "trcd");
  Printed printed;
  declare(app, result.config, printed);
  app.set_version_flag("--version", "trcd " + std::string(version()));
  // The file is read before CLI11 looks at the environment, so its name is looked up here.
  const char* file = std::getenv("TRCD_CONFIG");
  app.set_config(
         "--config", file != nullptr ? file : "",
         "TOML file, or YAML if named .yaml or .yml, with the same settings (Env:TRCD_CONFIG)",
         file != nullptr)
      ->check(CLI::Validator(
          [](const std::string& path) {
            const std::string fault = PlainFile::read(path).fault;
            return fault.empty() ? fault : "cannot read '" + path + "': " + fault;
          },
          ""))
      ->configurable(false);
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.config_formatter(config_file(app));
  bool print = false;
  app.add_flag("--print-config", print, "print the settings in force and exit")
      ->configurable(false);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    std::ostringstream text;
    app.exit(asked, text, text);
    result.exit = CommandLine::Exit{.code = 0, .text = text.str()};
    return result;
  } catch (const CLI::Error& fault) {
    const bool names_no_file = file != nullptr && *file == '\0';
    result.exit =
        CommandLine::Exit{.code = 2, .text = text_of(fault, app, argc, argv, names_no_file)};
    return result;
  }
  if (const auto fault = fault_of_environment(app)) {
    result.exit = CommandLine::Exit{.code = 2, .text = one_line(*fault)};
    return result;
  }
  if (app.get_option("--reflection")->count() == 0) {
    const auto& listen = result.config.listen;
    result.config.reflection = std::all_of(listen.begin(), listen.end(), is_local_address);
  }
  auto fault = fault_of_empty_guard(app, argc, argv);
  if (!fault) fault = first_fault(result.config);
  if (fault) {
    result.exit = CommandLine::Exit{.code = 2, .text = *fault};
  } else if (print) {
    result.exit = CommandLine::Exit{.code = 0, .text = text_of(printed)};
  }
  return result;
}

}  // namespace trc::server
