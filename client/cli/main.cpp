#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <span>
#include <string>
#include <string_view>

#include "client/cli/command.h"
#include "client/cli/completion.h"
#include "client/cli/german_help.h"
#include "client/cli/program_options.h"
#include "client/cli/speech.h"
#include "client/cli/wrong_call.h"
#include "core/base/version.h"

namespace {

// The exit code, after all output has been written.
int ended(int code) {
  errno = 0;
  if (std::cout.flush()) return code;
  // A pipe whose reader has gone needs no message.
  if (errno != EPIPE)
    trc::cli::complain(std::string("cannot write standard output") +
                       (errno != 0 ? std::string(": ") + std::strerror(errno) : ""));
  return code != 0 ? code : static_cast<int>(trc::cli::Exit::wrong_call);
}

// The language of --lang or of the environment. Read before all other options, so that the fault of
// an unreadable call is also in this language.
trc::Language language_of(std::span<char* const> words) {
  constexpr std::string_view option = "--lang";
  for (std::size_t i = words.size(); i-- > 0;) {
    const std::string_view word(words[i]);
    if (word == option && i + 1 < words.size()) return trc::cli::language_for(words[i + 1]);
    if (word.starts_with(option) && word.substr(option.size()).starts_with('='))
      return trc::cli::language_for(std::string(word.substr(option.size() + 1)));
  }
  return trc::cli::language_of_environment();
}

bool is_given(const CLI::App& command, const std::string& name) {
  const CLI::Option* const option = command.get_option_no_throw(name);
  return option != nullptr && !option->empty();
}

int run(int argc, char** argv) {
  const trc::Language language = language_of({argv, static_cast<std::size_t>(argc)});
  trc::cli::speak(language);
  CLI::App app("Tool radius compensation: computes the path of the tool centre beside a contour.",
               "trc");
  app.set_version_flag(
      "--version", "trc " + std::string(trc::version()) + " (" + std::string(trc::commit()) + ")");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 the program was refused or gouges, 2 wrong call, "
      "3 server not reachable, 4 a limit was met, 5 internal fault.");

  // The option may also come before the command.
  std::string language_tag;
  trc::cli::add_language_option(app, language_tag);

  trc::cli::Action action;
  trc::cli::add_compensate(app, action);
  trc::cli::add_plot(app, action);
  trc::cli::add_radii(app, action);
  trc::cli::add_verify(app, action);
  trc::cli::add_view(app, action);
  trc::cli::add_generate(app, action);
  trc::cli::add_load(app, action);
  trc::cli::add_info(app, action);
  trc::cli::add_explain(app, action);
  trc::cli::add_health(app, action);
  trc::cli::add_completion(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      if (language == trc::Language::german) trc::cli::speak_german(app);
      return ended(app.exit(error));
    }
    std::cerr << trc::cli::text_of_wrong_call(app, error);
    return static_cast<int>(trc::cli::Exit::wrong_call);
  }
  const CLI::App& command = *app.get_subcommands().front();
  if (const std::string fault = trc::cli::text_of_wrong_value(command); !fault.empty()) {
    std::cerr << fault;
    return static_cast<int>(trc::cli::Exit::wrong_call);
  }
  if (!is_given(command, "--quiet") && !is_given(command, "--worker"))
    if (const std::string note = trc::cli::note_on_environment(command); !note.empty())
      trc::cli::complain(note);
  return ended(static_cast<int>(action()));
}

// If a standard stream is closed, the next file or connection would take its number and receive
// text for the screen. The substitute refuses the direction that the stream is used for.
void keep_standard_streams_apart() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) == -1 && errno == EBADF)
      static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

}  // namespace

int main(int argc, char** argv) {
  keep_standard_streams_apart();
  // The program words the faults of gRPC itself, so gRPC is silent unless the user sets this
  // variable.
  static_cast<void>(setenv("GRPC_VERBOSITY", "NONE", 0));
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    trc::cli::complain("there is not enough memory for this program");
    return static_cast<int>(trc::cli::Exit::limit);
  } catch (const std::exception& error) {
    trc::cli::complain(std::string("internal error: ") + error.what());
    return static_cast<int>(trc::cli::Exit::internal);
  }
}
