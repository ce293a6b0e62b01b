#include "client/cli/wrong_call.h"

#include <algorithm>
#include <vector>

#include "client/cli/told.h"
#include "core/base/likely_meant.h"
#include "proto/wire/settings.h"

namespace trc::cli {
namespace {

// "--tool-radius" of the setting path.tool_radius.
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

// "trc", "trc compensate"
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

// "Could not convert: --radius = 5,5": what is meant is written with a point. Empty: it is not
// that.
std::string meant_number(const std::string& fault) {
  const auto equals = fault.rfind(" = ");
  const auto begin = fault.find("--");
  if (equals == std::string::npos || begin >= equals) return {};
  std::string number = fault.substr(equals + 3);
  const auto comma = number.find(',');
  if (comma == std::string::npos || number.find_first_not_of("+-0123456789,") < number.size() ||
      number.find(',', comma + 1) < number.size())
    return {};
  std::string text = fault.substr(begin, equals - begin) + ": " + number + " is no number; write ";
  number[comma] = '.';
  return told(text + number + ", with a decimal point") + "\n";
}

std::string more_about(const std::string& name) {
  return told("Run " + name + " --help for more information.") + "\n";
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
  return name + ": " + told(fault.what()) + "\n" + more_about(name);
}

}  // namespace trc::cli
