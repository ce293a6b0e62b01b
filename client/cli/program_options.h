#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/cli/loudness.h"
#include "client/cli/service.h"
#include "core/base/language.h"
#include "trc/v1/setup.pb.h"

namespace trc::cli {

// What every subcommand that reads a program takes.
struct ProgramOptions {
  std::string file{};
  std::vector<std::string> assignments{};  // key=value
  std::string dialect{};                   // empty: ISG
  std::string unit{};                      // empty: mm
  std::string tools{};                     // file
  std::optional<double> radius{};          // mm
  std::optional<double> wear{};            // mm
  std::string unknown_words{};             // empty: refuse
  std::string whole_numbers{};             // empty: not said
  std::vector<std::string> variables{};    // name=value
  std::vector<std::string> subprograms{};  // files and folders
  std::optional<std::uint64_t> max_executed_lines{};
  std::string language{};  // empty: that of the environment
  Loudness loudness{};
  ServiceOptions service{};
};
void add_program_options(CLI::App& command, ProgramOptions& options);
// All options of a program but its file.
void add_setup_options(CLI::App& command, ProgramOptions& options);
// Only those that describe the setup, without those of the service.
void add_settings_options(CLI::App& command, ProgramOptions& options);

// Adds -q and -v.
void add_loudness_options(CLI::App& command, Loudness& loudness);

// The setup that the options describe. Reports their faults on standard error, and returns false
// then.
bool setup_of(const ProgramOptions& options, v1::ProgramSetup& setup);

// What an option --lang names, English where that is no language of ours; without one that of
// speak().
[[nodiscard]] Language language_for(const std::string& option);
// What LC_ALL, LC_MESSAGES or LANG names, the first that is set; English where that is no language
// of ours.
[[nodiscard]] Language language_of_environment();
// That of the setup, English where it names none.
[[nodiscard]] Language language_of(const v1::ProgramSetup& setup);
// Adds --lang.
void add_language_option(CLI::App& command, std::string& language);

// Switches measuring on, unless the setup decides it: a person reads the messages.
void report_clearance(v1::ProgramSetup& setup);

// Whether the lengths of the program count in inch: by the setup, or by what the head of the file
// itself says. For messages only, never for reading the program.
[[nodiscard]] bool counts_in_inch(const ProgramOptions& options, const v1::ProgramSetup& setup);

// "Settings (--set): …", for the end of a help text.
[[nodiscard]] std::string settings_help(Language language);

}  // namespace trc::cli
