#include "client/cli/wrong_call.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "client/cli/speech.h"
#include "core/base/ascii.h"
#include "core/base/likely_meant.h"
#include "proto/wire/settings.h"

namespace trc::cli {
namespace {

// For example "--tool-radius", for the setting path.tool_radius.
std::string as_option(const std::string& setting) {
  std::string name = setting.substr(setting.rfind('.') + 1);
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::string list_of_commands(const CLI::App& app) {
  std::string text = "commands are";
  const char* between = " ";
  for (const std::string& name : commands_of(app)) {
    text += between + name;
    between = ", ";
  }
  return text;
}

std::string meant_command(const CLI::App& app, const std::string& word) {
  const std::string text = "there is no command " + word + "; ";
  if (const auto meant = likely_meant(word, commands_of(app)))
    return "trc: " + told(text + "did you mean " + *meant + "?") + "\n";
  return "trc: " + told(text + list_of_commands(app)) + "\n";
}

// "trc" or "trc compensate".
std::string spelled(const CLI::App& command) {
  const std::string& name = command.get_name();
  return name == "trc" ? name : "trc " + name;
}

std::string meant_option(const CLI::App& command, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& one : option->get_lnames()) names.push_back("--" + one);
  std::string text = spelled(command) + ": there is no option " + name;
  if (const auto meant = likely_meant(name, names))
    return told(text + "; did you mean " + *meant + "?") + "\n";
  if (command.get_option_no_throw("--set") != nullptr) {
    for (const wire::SettingRow& row : wire::settings()) {
      if (!likely_meant(name, {as_option(row.key)})) continue;
      const std::string setting = row.key.substr(row.key.rfind('.') + 1);
      return told(text.append("; did you mean --set ").append(setting).append("=…?")) + "\n";
    }
  }
  return told(text + "; " + spelled(command) + " --help lists all") + "\n";
}

// For "Could not convert: --radius = 5,5": suggests a decimal point. Empty: another fault.
std::string meant_number(const std::string& fault) {
  const auto equals = fault.rfind(" = ");
  const auto begin = fault.find("--");
  if (equals == std::string::npos || begin >= equals) return {};
  std::string number = fault.substr(equals + 3);
  const std::string text = fault.substr(begin, equals - begin) + ": " + number + " is no number";
  const auto comma = number.find(',');
  if (comma == std::string::npos || number.find_first_not_of("+-0123456789,") < number.size() ||
      number.find(',', comma + 1) < number.size())
    return told(text) + "\n";
  number[comma] = '.';
  return told(text + "; write " + number + ", with a decimal point") + "\n";
}

// The choice that a control or a workshop knows by another name.
std::optional<std::string> called_otherwise(const std::string& word) {
  constexpr auto names =
      std::to_array<std::pair<std::string_view, std::string_view>>({{"siemens", "sinumerik"},
                                                                    {"840d", "sinumerik"},
                                                                    {"828d", "sinumerik"},
                                                                    {"haas", "fanuc"},
                                                                    {"mazak", "fanuc"},
                                                                    {"fagor", "fanuc"},
                                                                    {"mach3", "fanuc"},
                                                                    {"grbl", "fanuc"},
                                                                    {"iso", "fanuc"},
                                                                    {"emc", "linuxcnc"},
                                                                    {"emc2", "linuxcnc"},
                                                                    {"tnc", "heidenhain"},
                                                                    {"itnc", "heidenhain"},
                                                                    {"klartext", "heidenhain"},
                                                                    {"twincat", "isg"},
                                                                    {"beckhoff", "isg"},
                                                                    {"in", "inch"},
                                                                    {"inches", "inch"},
                                                                    {"metric", "mm"}});
  const auto* const found =
      std::ranges::find(names, word, &std::pair<std::string_view, std::string_view>::first);
  if (found == names.end()) return std::nullopt;
  return std::string(found->second);
}

// "--dialect: siemens not in {isg,fanuc}", with the probable choice if there is one.
std::string with_meant_choice(std::string fault) {
  const auto colon = fault.find(": ");
  const auto between = fault.find(" not in {");
  if (colon == std::string::npos || between == std::string::npos || colon > between) return fault;
  const std::string word =
      in_lower_case(std::string_view(fault).substr(colon + 2, between - colon - 2));
  std::istringstream list(fault.substr(between + 9, fault.find('}', between) - between - 9));
  std::vector<std::string> choices;
  for (std::string one; std::getline(list, one, ',');) choices.push_back(std::move(one));
  auto meant = called_otherwise(word);
  if (!meant || std::ranges::find(choices, *meant) == choices.end())
    meant = likely_meant(word, choices);
  return meant ? fault.append("; did you mean ").append(*meant).append("?") : fault;
}

std::string more_about(const std::string& name) {
  return told("Run " + name + " --help for more information.") + "\n";
}

// Why an option cannot have this value, which the parser accepts; empty: it can.
std::string fault_of_value(const CLI::Option& option, const std::string& value) {
  // An empty --server means this process.
  if (value.empty()) return option.check_lname("server") ? "" : "its value is empty";
  const std::string type = option.get_type_name();
  const bool is_integer = type.find("INT") != std::string::npos;
  const bool is_number = is_integer || type == "MM" || type.find("FLOAT") != std::string::npos;
  const std::size_t digits = std::min(value.find_first_not_of("+-"), value.size());
  if (!is_number || value[digits] != '0') return {};
  const char second = value[std::min(digits + 1, value.size())];
  const bool is_octal = is_integer && second >= '0' && second <= '9';
  return second == 'x' || second == 'X' || is_octal ? value + " is no number" : "";
}

}  // namespace

std::string text_of_wrong_call(const CLI::App& app, const CLI::ParseError& fault) {
  const std::vector<std::string> unknown = app.remaining(true);
  const auto commands = app.get_subcommands();
  if (!unknown.empty()) {
    const std::string& word = unknown.front();
    if (commands.empty() && !word.starts_with('-')) return meant_command(app, word);
    if (word.starts_with("--") && word != "--")
      return meant_option(commands.empty() ? app : *commands.front(), word);
  }
  if (commands.empty() && unknown.empty())
    return "trc: " + told("say what to do: " + list_of_commands(app)) + "\n" + more_about("trc");
  const std::string name = spelled(commands.empty() ? app : *commands.front());
  if (const std::string number = meant_number(fault.what()); !number.empty())
    return name + ": " + number;
  return name + ": " + told(with_meant_choice(fault.what())) + "\n" + more_about(name);
}

std::string text_of_wrong_value(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& value : option->results()) {
      const std::string fault = fault_of_value(*option, value);
      if (fault.empty()) continue;
      const std::string name = spelled(command);
      return name + ": " + told(option->get_name() + ": " + fault) + "\n" + more_about(name);
    }
  }
  return {};
}

std::string note_on_environment(const CLI::App& command) {
  constexpr std::string_view known = "TRC_SERVER";
  const CLI::Option* const server = command.get_option_no_throw("--server");
  if (server == nullptr || !server->empty()) return {};
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view whole = *entry;
    const std::string_view name = whole.substr(0, whole.find('='));
    // Tests, builds and the packages for other languages also have variables that begin with TRC_.
    constexpr std::size_t most_letters = 2;
    if (name != known && name.starts_with("TRC_") && edit_distance(name, known) <= most_letters)
      return "note: the environment variable " + std::string(name) + " is not read; did you mean " +
             std::string(known) + "?";
  }
  return {};
}

}  // namespace trc::cli
