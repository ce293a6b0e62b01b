#include "client/cli/program_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "client/cli/computing_options.h"
#include "client/cli/file_name.h"
#include "client/cli/speech.h"
#include "client/cli/tool_file.h"
#include "core/base/utf8.h"
#include "core/nc/dialect/dialect.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/number_format.h"
#include "proto/wire/german_settings.h"
#include "proto/wire/setting_meanings.h"
#include "proto/wire/settings.h"
#include "proto/wire/setup.h"

namespace trc::cli {
namespace {

std::string shortest(double number) {
  std::string text;
  append_units(text, to_units(number, 6), 6);
  return text;
}

// For example " in mm, -5 to 5".
std::string unit_and_range(const wire::SettingMeaning& about, bool german) {
  const std::string_view unit = german ? wire::german_values_of(about.unit) : about.unit;
  std::string text = unit.empty() ? "" : " in " + std::string(unit);
  if (!std::isfinite(about.least)) return text;
  text += ", " + shortest(about.least);
  if (about.most > about.least) return text + (german ? " bis " : " to ") + shortest(about.most);
  return text + (german ? " allein" : " alone");
}

std::string with_place_of_list(const std::string& fault) {
  return fault.starts_with("unknown setting") ? fault + " (all of them: trc compensate --help)"
                                              : fault;
}

std::string_view key_of(std::string_view assignment) {
  return assignment.substr(0, assignment.find('='));
}

// Several tools or variables may be given, each of them once.
bool is_list(std::string_view key) { return key == "tools" || key == "variables"; }

// The settings that have been given by options of their own.
wire::GivenSettings given_by_options(const ProgramOptions& options) {
  wire::GivenSettings given;
  const auto take = [&](bool is_given, std::string_view key) {
    if (is_given) static_cast<void>(given.take(key));
  };
  take(options.radius.has_value(), "tool_radius");
  take(options.wear.has_value(), "wear");
  take(options.max_executed_lines.has_value(), "max_executed_lines");
  return given;
}

bool is_setting(std::string_view key) {
  return std::ranges::any_of(wire::settings(), [&](const wire::SettingRow& row) {
    return row.key == key || row.key.substr(row.key.rfind('.') + 1) == key;
  });
}

// Message for a --set that names an option of the command, not a setting. Empty: it does not.
std::string meant_option(const CLI::App& command, const std::string& assignment) {
  const std::string key(key_of(assignment));
  std::string option = "--" + key;
  std::ranges::replace(option, '_', '-');
  if (is_setting(key) || command.get_option_no_throw(option) == nullptr) return {};
  const std::string value = assignment.substr(std::min(key.size() + 1, assignment.size()));
  return key + " has an option of its own: write " + option + " " + value;
}

bool says_a_radius(const ProgramOptions& options) {
  constexpr std::array<std::string_view, 5> of_tools{"tool_radius", "tools", "wear", "allowance",
                                                     "nominal_radius"};
  return options.radius || options.wear ||
         std::ranges::any_of(options.assignments, [&](const std::string& assignment) {
           return std::ranges::find(of_tools, key_of(assignment)) != of_tools.end();
         });
}

// The options that say how to read the text.
void add_reading_options(CLI::App& command, ProgramOptions& options) {
  std::vector<std::string> dialects;
  for (const Dialect& dialect : all_dialects()) dialects.emplace_back(dialect.spelling);
  command.add_option("--dialect", options.dialect, "Language of the program; isg without it")
      ->transform(CLI::IsMember(dialects, CLI::ignore_case));
  command
      .add_option("--unit", options.unit,
                  "What lengths count in before the program says; mm "
                  "without it")
      ->transform(CLI::IsMember({"mm", "inch"}, CLI::ignore_case));
  command
      .add_option("--unknown-words", options.unknown_words,
                  "copy: lines with unknown G functions come out as they are while TRC is off")
      ->transform(CLI::IsMember({"refuse", "copy"}, CLI::ignore_case));
  command
      .add_option("--variable", options.variables,
                  "What a variable holds that the program does not set itself, as in #500=12.5; "
                  "may be repeated")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--subprograms", options.subprograms,
                  "File of a subprogram that the program calls, or a folder of such files; may be "
                  "repeated. Those of heidenhain are not followed, only looked through for RL, RR")
      ->type_name("PATH")
      ->check(CLI::ExistingPath)
      ->allow_extra_args(false);
  command
      .add_option("--max-executed-lines", options.max_executed_lines,
                  "Lines that a program with loops and calls executes at most; 10000000 without it")
      ->type_name("COUNT")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  command
      .add_option("--whole-numbers", options.whole_numbers,
                  "What coordinates of fanuc without a decimal point count in: units (X10 is 10 "
                  "mm) or increments (X10 is 0.010 mm, 0.0010 in)")
      ->transform(CLI::IsMember({"units", "increments"}, CLI::ignore_case));
}

void add_tool_options(CLI::App& command, ProgramOptions& options) {
  command
      .add_option("--tools", options.tools,
                  "Table of tools: CSV with the header number,radius, as wanted with name and edge "
                  "(mm, whatever the program "
                  "counts in, unless a first line unit,inch or a column unit says otherwise), a "
                  "tool table of LinuxCNC, TOOL.T of Heidenhain, G10 lines of Fanuc, tool data "
                  "of Sinumerik ($TC_DP6 and $TC_DP15 of a TOA file) or of ISG (wz[1].radius)")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);
  command
      .add_option("--radius", options.radius,
                  "Radius of the tool before the program says, mm: --set tool_radius")
      ->type_name("MM");
  command
      .add_option("--wear", options.wear,
                  "What that tool is larger by, mm; negative: worn off: --set wear")
      ->type_name("MM");
}

}  // namespace

void add_program_options(CLI::App& command, ProgramOptions& options) {
  command.add_option("file", options.file, "NC program; - reads standard input")
      ->type_name("FILE")
      ->required();
  add_setup_options(command, options);
}

void add_setup_options(CLI::App& command, ProgramOptions& options) {
  add_settings_options(command, options);
  add_service_options(command, options.service);
}

void add_settings_options(CLI::App& command, ProgramOptions& options) {
  command
      .add_option("--set", options.assignments,
                  "What holds before the first line, as in tool_radius=5; may be repeated")
      ->type_name("KEY=VALUE")
      ->check([&command](const std::string& given) { return meant_option(command, given); })
      ->allow_extra_args(false);
  add_reading_options(command, options);
  add_tool_options(command, options);
  add_language_option(command, options.language);
}

void add_loudness_options(CLI::App& command, Loudness& loudness) {
  auto* quiet = command.add_flag("-q,--quiet", loudness.quiet,
                                 "Errors alone: no warnings, no progress, no line of summary");
  command
      .add_flag("-v,--verbose", loudness.verbose,
                "Also what was taken: dialect, unit, setup, tools, service; and times")
      ->excludes(quiet);
}

Language language_for(const std::string& option) {
  return option.empty() ? spoken_language() : language_of_tag(option).value_or(Language::english);
}

Language language_of_environment() {
  for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG"}) {
    const char* value = std::getenv(name);
    if (value != nullptr && *value != '\0')
      return language_of_tag(value).value_or(Language::english);
  }
  return Language::english;
}

Language language_of(const v1::ProgramSetup& setup) {
  return language_of_tag(setup.path().language()).value_or(Language::english);
}

void add_language_option(CLI::App& command, std::string& language) {
  command
      .add_option("--lang", language,
                  "Language of messages: en or de; without it that of LC_ALL, LC_MESSAGES or LANG")
      ->type_name("TAG")
      ->check([](const std::string& tag) {
        return language_of_tag(tag) ? std::string() : "it takes en, de";
      });
}

bool setup_of(const ProgramOptions& options, v1::ProgramSetup& setup) {
  wire::GivenSettings given = given_by_options(options);
  for (const std::string& assignment : options.assignments) {
    std::string fault = is_list(key_of(assignment)) ? "" : given.take(key_of(assignment));
    if (fault.empty()) fault = wire::apply_setting(assignment, setup);
    if (fault.empty()) continue;
    complain("--set: " + with_place_of_list(fault));
    return false;
  }
  if (const auto dialect = dialect_spelled(options.dialect))
    setup.set_dialect(wire::to_proto(*dialect));
  if (const std::string fault = add_computing_options(options, setup); !fault.empty()) {
    complain(fault);
    return false;
  }
  if (options.unknown_words == "copy") setup.set_unknown_words(v1::UNKNOWN_WORDS_COPY);
  if (!options.whole_numbers.empty())
    setup.set_whole_numbers(options.whole_numbers == "units" ? v1::WHOLE_NUMBERS_UNITS
                                                             : v1::WHOLE_NUMBERS_INCREMENTS);
  if (!options.unit.empty())
    setup.set_unit(options.unit == "inch" ? v1::LENGTH_UNIT_INCH : v1::LENGTH_UNIT_MM);
  if (setup.path().language().empty() && language_for(options.language) == Language::german)
    setup.mutable_path()->set_language("de");
  if (options.radius) setup.mutable_path()->set_tool_radius(*options.radius);
  if (options.wear) setup.mutable_path()->set_wear(*options.wear);
  if (!options.tools.empty()) {
    bool unit_unsaid = false;
    const std::string fault = read_tool_file(options.tools, setup, unit_unsaid);
    if (!fault.empty()) {
      std::istringstream faults(fault);
      for (std::string one; std::getline(faults, one);) complain("--tools: " + one);
      return false;
    }
    if (unit_unsaid && !options.loudness.quiet && counts_in_inch(options, setup))
      complain("note: the radii of " + options.tools +
               " are read in mm, as the file names no unit, though the program counts in inch; a "
               "first line unit,inch or a column unit of a CSV says otherwise, --unit inch of "
               "other tables");
  }
  if (options.wear && setup.tools_size() > 0) {
    complain("--wear is of the tool of --radius: tools of a table have a wear of their own");
    return false;
  }
  if (!options.loudness.quiet && says_a_radius(options) && counts_in_inch(options, setup))
    complain(
        "note: radii and wear of --radius, --wear and --set are in mm, though the program counts "
        "in inch: 0.25 inch are 6.35");
  // The server shows the name in its log; the end of a path says more than its directory.
  constexpr std::size_t longest_name = 255;
  std::string name = text_of_name(options.file);
  if (name.size() > longest_name) name.erase(0, name.size() - longest_name);
  // Does not begin within a character.
  while (!name.empty() && utf8_character(name) == 0) name.erase(0, 1);
  setup.set_file_name(name);
  return true;
}

bool counts_in_inch(const ProgramOptions& options, const v1::ProgramSetup& setup) {
  if (!std::filesystem::is_regular_file(options.file)) return setup.unit() == v1::LENGTH_UNIT_INCH;
  constexpr std::size_t head = 64 * 1024;
  std::ifstream stream(options.file, std::ios::binary);
  std::string text(head, '\0');
  stream.read(text.data(), head);
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return says_inch(text, setup.dialect(), setup.unit());
}

void report_clearance(v1::ProgramSetup& setup) {
  if (setup.path().verify() == v1::VERIFICATION_UNSPECIFIED)
    setup.mutable_path()->set_verify(v1::VERIFICATION_REPORT);
}

std::string settings_help(Language language) {
  const bool german = language == Language::german;
  std::string text = german ? "Einstellungen (--set NAME=WERT), mit dem, was ohne sie gilt:\n"
                            : "Settings (--set KEY=VALUE), with what they are without it:\n";
  for (const wire::SettingRow& row : wire::settings()) {
    const wire::SettingMeaning& about = wire::meaning_of(row.key);
    const std::string none = german ? "nichts" : "none";
    text += "  " + row.key + ": " +
            std::string(german ? wire::german_values_of(row.values) : row.values) +
            unit_and_range(about, german) + "; " +
            (about.initial.empty() ? none : std::string(about.initial)) + "\n      " +
            std::string(german ? wire::german_meaning_of(row.key) : about.meaning) + "\n";
  }
  return text + (german ? "Der letzte Teil eines Namens genügt, wo kein anderer so endet: "
                          "stretch_factor=2."
                        : "The last part of a key will do where no other key ends in it: "
                          "stretch_factor=2.");
}

}  // namespace trc::cli
