#include <algorithm>
#include <array>
#include <charconv>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>

#include "client/cli/command.h"
#include "client/cli/program_options.h"
#include "client/cli/speech.h"
#include "core/base/diagnostic.h"
#include "core/messages/diagnostic_text.h"
#include "core/messages/explanation.h"
#include "core/messages/german_explanation.h"
#include "core/nc/text/characters.h"

namespace trc::cli {
namespace {

struct Call {
  std::string code;
  bool example = false;
  std::string language;
};

std::string_view word_for(Severity severity, Language language) {
  constexpr std::array<std::string_view, 3> words{"note", "warning", "error"};
  constexpr std::array<std::string_view, 3> german{"Hinweis", "Warnung", "Fehler"};
  return (language == Language::german ? german : words).at(static_cast<std::size_t>(severity));
}

// A row by its number, or by its reason in any case; null: there is no such code.
const CodeRow* row_named(std::string name) {
  name = in_upper_case(name);
  int number = 0;
  const auto [end, fault] = std::from_chars(name.data(), name.data() + name.size(), number);
  const bool is_number = fault == std::errc{} && end == name.data() + name.size();
  const auto rows = code_table();
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const CodeRow& row) {
    return is_number ? static_cast<int>(row.code) == number : row.reason == name;
  });
  return found == rows.end() ? nullptr : &*found;
}

// Folds the text into lines of at most 96 characters, indented except for the first.
std::string folded(std::string_view text, std::size_t indent) {
  constexpr std::size_t widest = 96;
  std::string lines;
  std::size_t column = indent;
  while (!text.empty()) {
    const std::size_t length = std::min(text.find(' '), text.size());
    if (column > indent && column + 1 + length > widest) {
      lines += '\n' + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      lines += ' ';
      ++column;
    }
    lines += text.substr(0, length);
    column += length;
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return lines;
}

void print_list(Language language) {
  for (const CodeRow& row : code_table()) {
    const std::string code = std::to_string(static_cast<int>(row.code));
    const std::string severity(word_for(row.severity, language));
    std::cout << code << std::string(8 - code.size(), ' ') << severity
              << std::string(9 - severity.size(), ' ') << folded(title_of(row.code, language), 17)
              << '\n';
  }
  std::cout << (language == Language::german
                    ? "trc explain CODE sagt mehr: was hilft, und ein Programm, das es auslöst.\n"
                    : "trc explain CODE says more: causes, what helps, and a program that raises "
                      "it.\n");
}

// An explanation in one language.
struct Words {
  std::string_view meaning;
  std::array<std::string_view, 3> causes{};
};
Words words_of(const Explanation& explanation, Language language) {
  const GermanExplanation* german =
      language == Language::german ? german_explanation_of(explanation.code) : nullptr;
  return german == nullptr ? Words{explanation.meaning, explanation.causes}
                           : Words{german->meaning, german->causes};
}

// Whether part of the contour is certain before the example is refused. With these codes none is:
// the first TRC word is the fault, or a limit is exceeded, which has no picture.
bool shows_a_contour(const Explanation& explanation) {
  constexpr std::array refused_at_once{Code::compensation_side_twice, Code::selection_mode_twice,
                                       Code::side_behind_end, Code::selection_too_long,
                                       Code::no_tool_radius};
  const auto selects = [&](std::string_view word) {
    return explanation.example.find(word) != std::string_view::npos;
  };
  return (selects("G41") || selects("G42")) &&
         std::ranges::find(refused_at_once, explanation.code) == refused_at_once.end();
}

void print_example(std::string_view code, const Explanation& explanation, Language language) {
  const bool german = language == Language::german;
  const std::string options =
      (explanation.options.empty() ? "" : " ") + std::string(explanation.options);
  std::cout << (german ? "\nBeispiel" : "\nExample") << ": trc explain " << code
            << " --example | trc compensate -" << options << '\n';
  if (shows_a_contour(explanation))
    std::cout << (german ? "Bild" : "Picture") << ": trc explain " << code
              << " --example | trc plot -" << options << " -o " << code << ".svg\n";
  for (std::string_view text = explanation.example; !text.empty();) {
    const std::size_t end = text.find('\n');
    std::string line(text.substr(0, end));
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < 0x20; }, '?');
    std::cout << "  " << line << '\n';
    text.remove_prefix(end + 1);
  }
  if (explanation.times == 1) return;
  const std::string_view repeated =
      explanation.repeated.substr(0, explanation.repeated.find_last_not_of(" \n") + 1);
  std::cout << (german ? "Darin steht " : "In it ") << repeated << ' ' << (german ? "" : "stands ")
            << explanation.times << (german ? "-mal hintereinander.\n" : " times in a row.\n");
}

void print(const CodeRow& row, const Explanation& explanation, Language language) {
  const bool german = language == Language::german;
  const std::string code = std::to_string(static_cast<int>(row.code));
  const std::string_view own = help_on_command_line(row.code, language);
  const std::string help = own.empty() ? help_of({.code = row.code}, language) : std::string(own);
  const Words words = words_of(explanation, language);
  std::cout << word_for(row.severity, language) << ' ' << code << ' ' << row.reason << '\n'
            << folded(title_of(row.code, language), 0) << "\n\n"
            << folded(words.meaning, 0) << (german ? "\n\nUrsachen:\n" : "\n\nCauses:\n");
  for (const std::string_view cause : words.causes)
    if (!cause.empty()) std::cout << "  - " << folded(cause, 4) << '\n';
  std::cout << (german ? "\nWas hilft:\n  - " : "\nWhat helps:\n  - ") << folded(help, 4) << '\n';
  print_example(code, explanation, language);
}

Exit run(const Call& call) {
  const Language language = language_for(call.language);
  if (call.code.empty()) {
    print_list(language);
    return Exit::done;
  }
  const CodeRow* row = row_named(call.code);
  const Explanation* explanation = row == nullptr ? nullptr : explanation_of(row->code);
  if (explanation == nullptr) {
    complain("there is no code " + call.code + "; trc explain lists all");
    return Exit::wrong_call;
  }
  if (!call.example) {
    print(*row, *explanation, language);
    return Exit::done;
  }
  std::cout << example_of(*explanation);
  return Exit::done;
}

}  // namespace

void add_explain(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "explain",
      "Say what a diagnostic means, what causes it and what helps, with a program that "
      "raises it");
  auto call = std::make_shared<Call>();
  auto* code = command->add_option("code", call->code,
                                   "Code of a message, as in 90019, or its name, as in "
                                   "LINE_REVERSED; without it all are listed");
  code->type_name("CODE");
  command->add_flag("--example", call->example, "Print the program alone")->needs(code);
  add_language_option(*command, call->language);
  command->callback([call, &action] { action = [call] { return run(*call); }; });
}

}  // namespace trc::cli
