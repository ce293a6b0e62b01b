#include "client/cli/completion.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "client/cli/german_help.h"
#include "client/cli/program_options.h"
#include "core/base/diagnostic.h"
#include "proto/wire/settings.h"

namespace trc::cli {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

// For example "--server", "-o".
std::vector<std::string> spellings_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

bool takes_a_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

// The values in the help, "TEXT:{mm,inch}", or the beginnings of settings. Empty: any value.
std::vector<std::string> values_of(const CLI::Option& option) {
  if (option.check_lname("set")) {
    std::vector<std::string> keys;
    for (const wire::SettingRow& row : wire::settings()) keys.push_back(row.key + "=");
    return keys;
  }
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}');
  std::vector<std::string> values;
  if (begin == std::string::npos || end == std::string::npos) return values;
  for (std::size_t at = begin + 1; at < end;) {
    const std::size_t comma = std::min(end, type.find(',', at));
    values.push_back(type.substr(at, comma - at));
    at = comma + 1;
  }
  return values;
}

// Whether the value follows without a blank, as for tool_radius=.
bool are_followed_at_once(const std::vector<std::string>& words) {
  return !words.empty() && words.front().ends_with('=');
}

std::string joined(const std::vector<std::string>& words, std::string_view between) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i > 0 ? std::string(between) : std::string()) + words[i];
  return text;
}

// The words that may follow the command; empty: file names.
std::vector<std::string> words_of(const CLI::App& command) {
  if (command.get_name() == "explain") {
    std::vector<std::string> codes;
    for (const CodeRow& row : code_table())
      codes.push_back(std::to_string(static_cast<int>(row.code)));
    return codes;
  }
  for (const CLI::Option* option : command.get_options())
    if (spellings_of(*option).empty()) return values_of(*option);
  return {};
}

std::string names_of(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  names.reserve(commands.size());
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  return joined(names, " ");
}

// In single quotes only the quote itself is special, in all three shells.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string for_bash(const CLI::App& app) {
  std::string options;
  std::string values;
  std::string positionals;
  for (const CLI::App* command : commands_of(app)) {
    std::vector<std::string> names;
    if (const auto words = words_of(*command); !words.empty())
      positionals +=
          "      " + command->get_name() + ") words=" + quoted(joined(words, " ")) + " ;;\n";
    for (const CLI::Option* option : command->get_options()) {
      const std::vector<std::string> spellings = spellings_of(*option);
      names.insert(names.end(), spellings.begin(), spellings.end());
      if (spellings.empty() || !takes_a_value(*option)) continue;
      std::vector<std::string> places;
      places.reserve(spellings.size());
      for (const std::string& name : spellings) places.push_back(command->get_name() + ":" + name);
      const std::vector<std::string> words = values_of(*option);
      values += "    " + joined(places, "|") + ") " +
                (words.empty() ? "compopt -o default" : "words=" + quoted(joined(words, " "))) +
                (are_followed_at_once(words) ? "; compopt -o nospace" : "") + " ;;\n";
    }
    options += "    " + command->get_name() + ") words=" + quoted(joined(names, " ")) + " ;;\n";
  }
  return "# Completion of trc for bash, made by trc completion bash.\n"
         "_trc() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} words=\n"
         "  COMPREPLY=()\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W " +
         quoted(names_of(commands_of(app)) + " --help --version") +
         " -- \"$word\")\n"
         "    return\n"
         "  fi\n"
         "  case $command:${COMP_WORDS[COMP_CWORD - 1]} in\n" +
         values +
         "    *) case $word in\n"
         "    -*) case $command in\n" +
         options +
         "    esac ;;\n"
         "    *) case $command in\n" +
         positionals +
         "      *) compopt -o default ;;\n"
         "    esac ;;\n"
         "    esac ;;\n"
         "  esac\n"
         "  [ -z \"$words\" ] || mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
         "}\n"
         "complete -F _trc trc\n";
}

// Brackets and colons have a meaning in specifications of _arguments.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text)
    result += std::string_view("[]:\\").find(c) != std::string_view::npos ? std::string("\\") + c
                                                                          : std::string(1, c);
  return result;
}

// The part of an _arguments specification that offers values for an option.
std::string zsh_values(const std::vector<std::string>& words) {
  if (words.empty()) return ":value:_files";
  if (are_followed_at_once(words)) return ":value:{compadd -S \"\" - " + joined(words, " ") + "}";
  return ":value:(" + joined(words, " ") + ")";
}

std::string for_zsh(const CLI::App& app) {
  std::string commands;
  std::string options;
  for (const CLI::App* command : commands_of(app)) {
    commands +=
        "    " + quoted(zsh_text(command->get_name()) + ":" + command->get_description()) + "\n";
    options += "  " + command->get_name() + ") _arguments";
    for (const CLI::Option* option : command->get_options()) {
      const std::vector<std::string> words = values_of(*option);
      for (const std::string& name : spellings_of(*option))
        options +=
            " \\\n    " + quoted("*" + name + "[" + zsh_text(option->get_description()) + "]" +
                                 (takes_a_value(*option) ? zsh_values(words) : std::string()));
    }
    const std::vector<std::string> words = words_of(*command);
    options += " \\\n    " +
               quoted(words.empty() ? "*:file:_files" : "*:word:(" + joined(words, " ") + ")") +
               " ;;\n";
  }
  return "#compdef trc\n"
         "# Completion of trc for zsh, made by trc completion zsh.\n"
         "local -a commands\n"
         "commands=(\n" +
         commands +
         ")\n"
         "if (( CURRENT == 2 )); then\n"
         "  _describe command commands\n"
         "  return\n"
         "fi\n"
         "local command=$words[2]\n"
         "shift words\n"
         "(( CURRENT-- ))\n"
         "case $command in\n" +
         options + "esac\n";
}

std::string for_fish(const CLI::App& app) {
  std::string text = "# Completion of trc for fish, made by trc completion fish.\n";
  for (const CLI::App* command : commands_of(app)) {
    text += "complete -c trc -n __fish_use_subcommand -f -a " + command->get_name() + " -d " +
            quoted(command->get_description()) + "\n";
    if (const auto words = words_of(*command); !words.empty())
      text += "complete -c trc -n " + quoted("__fish_seen_subcommand_from " + command->get_name()) +
              " -f -a " + quoted(joined(words, " ")) + "\n";
    for (const CLI::Option* option : command->get_options()) {
      if (spellings_of(*option).empty()) continue;
      text += "complete -c trc -n " + quoted("__fish_seen_subcommand_from " + command->get_name());
      for (const std::string& name : option->get_snames()) text += " -s " + name;
      for (const std::string& name : option->get_lnames()) text += " -l " + name;
      const std::vector<std::string> words = values_of(*option);
      if (takes_a_value(*option)) text += " -r";
      if (!words.empty()) text += " -f -a " + quoted(joined(words, " "));
      text += " -d " + quoted(option->get_description()) + "\n";
    }
  }
  return text;
}

}  // namespace

std::string completion_for(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") return for_bash(app);
  return shell == "zsh" ? for_zsh(app) : for_fish(app);
}

void add_completion(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "completion", "Print the script that completes words of this command line in a shell");
  auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "bash, zsh or fish")
      ->type_name("SHELL")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  auto language = std::make_shared<std::string>();
  add_language_option(*command, *language);
  command->footer("For this shell alone: source <(trc completion bash)");
  command->callback([&app, shell, language, &action] {
    action = [&app, shell, language] {
      if (language_for(*language) == Language::german) speak_german(app);
      std::cout << completion_for(app, *shell);
      return Exit::done;
    };
  });
}

}  // namespace trc::cli
