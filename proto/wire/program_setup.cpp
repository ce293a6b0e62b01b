#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "core/base/utf8.h"
#include "core/nc/dialect/dialect.h"
#include "core/nc/dialect/pass_words.h"
#include "core/nc/state/variable_name.h"
#include "core/nc/text/characters.h"
#include "proto/wire/modes.h"
#include "proto/wire/options.h"
#include "proto/wire/setup.h"

// The setup of a program; setup.cpp has the setup of its path.

namespace trc::wire {
namespace {

constexpr int most_tools = 10'000;
constexpr std::size_t longest_tool_name = 64;

constexpr EnumTable<v1::ProgramOutput, bool, 2> outputs{{
    {v1::PROGRAM_OUTPUT_NC, true},
    {v1::PROGRAM_OUTPUT_BLOCKS, false},
}};

constexpr EnumTable<v1::Dialect, DialectName, 5> dialects{{
    {v1::DIALECT_ISG, DialectName::isg},
    {v1::DIALECT_FANUC, DialectName::fanuc},
    {v1::DIALECT_LINUXCNC, DialectName::linuxcnc},
    {v1::DIALECT_SINUMERIK, DialectName::sinumerik},
    {v1::DIALECT_HEIDENHAIN, DialectName::heidenhain},
}};

// Whether lengths are in inch.
constexpr EnumTable<v1::LengthUnit, bool, 2> units{{
    {v1::LENGTH_UNIT_MM, false},
    {v1::LENGTH_UNIT_INCH, true},
}};

// Whether unknown words are copied.
constexpr EnumTable<v1::UnknownWords, bool, 2> unknown_words{{
    {v1::UNKNOWN_WORDS_REFUSE, false},
    {v1::UNKNOWN_WORDS_COPY, true},
}};

constexpr EnumTable<v1::WholeNumbers, WholeNumbers, 2> whole_numbers{{
    {v1::WHOLE_NUMBERS_UNITS, WholeNumbers::units},
    {v1::WHOLE_NUMBERS_INCREMENTS, WholeNumbers::increments},
}};

constexpr EnumTable<v1::BlockSkip, BlockSkip, 3> block_skips{{
    {v1::BLOCK_SKIP_REFUSE, BlockSkip::refuse},
    {v1::BLOCK_SKIP_EXECUTE, BlockSkip::execute},
    {v1::BLOCK_SKIP_LEAVE_OUT, BlockSkip::leave_out},
}};

constexpr EnumTable<v1::Encoding, Encoding, 3> encodings{{
    {v1::ENCODING_UTF8, Encoding::utf8},
    {v1::ENCODING_AUTO, Encoding::any},
    {v1::ENCODING_LATIN1, Encoding::any},
}};

// The number of a named tool; a tool without a number gets one of its own. None if another tool has
// the name.
std::optional<std::int64_t> tool_named(const v1::Tool& tool, ProgramSetup& program) {
  const auto next = first_named_tool + static_cast<std::int64_t>(program.tool_names.size());
  const std::int64_t number = tool.number() > 0 ? tool.number() : next;
  const auto [known, is_new] =
      program.tool_names.try_emplace(in_capitals_as_utf8(tool.name()), number);
  if (!is_new && tool.number() > 0 && known->second != number) return std::nullopt;
  return known->second;
}

void read_tools(const v1::ProgramSetup& message, const FieldPath& path, ProgramSetup& program,
                FieldFaults& faults) {
  if (message.tools_size() > most_tools) {
    add_fault(FieldPath(path, "tools"),
              "has " + std::to_string(message.tools_size()) + " entries, allowed are " +
                  std::to_string(most_tools),
              faults);
    return;
  }
  for (int i = 0; i < message.tools_size(); ++i) {
    const v1::Tool& tool = message.tools(i);
    const FieldPath entry(path, "tools", static_cast<std::size_t>(i));
    check_range(tool.number(), {0, 2147483647}, FieldPath(entry, "number"), faults);
    check_tool_radius(tool.radius(), FieldPath(entry, "radius"), faults);
    check_tool_radius(tool.wear(), FieldPath(entry, "wear"), faults);
    check_range(tool.edge(), {0, 99}, FieldPath(entry, "edge"), faults);
    std::int64_t number = tool.number();
    if (!tool.name().empty()) {
      if (tool.name().size() > longest_tool_name) {
        add_fault(FieldPath(entry, "name"),
                  "is longer than " + std::to_string(longest_tool_name) + " bytes", faults);
        continue;
      }
      const auto named = tool_named(tool, program);
      if (!named) {
        add_fault(FieldPath(entry, "name"), "is the name of another tool", faults);
        continue;
      }
      number = *named;
    }
    const std::int64_t row = row_of_edge(number, std::max<std::int64_t>(tool.edge(), 1));
    if (!program.tools.try_emplace(row, tool.radius(), tool.wear()).second)
      add_fault(FieldPath(entry, "number"),
                "names the tool " +
                    (tool.number() > 0 || tool.name().empty() ? std::to_string(tool.number())
                                                              : tool.name()) +
                    " a second time",
                faults);
  }
}

void read_pass_words(const v1::ProgramSetup& message, const FieldPath& path, ProgramSetup& program,
                     FieldFaults& faults) {
  constexpr int most_words = 1000;
  constexpr std::size_t longest_shown = 32;
  if (message.pass_words_size() > most_words)
    add_fault(FieldPath(path, "pass_words"), "has more than 1000 entries", faults);
  for (int i = 0; i < std::min(message.pass_words_size(), most_words); ++i) {
    std::string word = in_upper_case(message.pass_words(i));
    if (std::string fault = fault_of_pass_word(word, program.dialect); !fault.empty()) {
      if (word.size() <= longest_shown) fault.insert(0, "\"" + word + "\" ");
      add_fault(FieldPath(path, "pass_words", static_cast<std::size_t>(i)), std::move(fault),
                faults);
    }
    program.pass_words.insert(std::move(word));
  }
}

// Reads the initial state of the dialect, unless the setup gives it.
void read_dialect(const v1::ProgramSetup& message, const FieldPath& path, ProgramSetup& program,
                  FieldFaults& faults) {
  program.dialect = dialects.from_proto(message.dialect(), FieldPath(path, "dialect"), faults)
                        .value_or(program.dialect);
  program.inch =
      units.from_proto(message.unit(), FieldPath(path, "unit"), faults).value_or(program.inch);
  program.unit_is_assumed = message.unit() == v1::LENGTH_UNIT_UNSPECIFIED;
  program.copies_unknown_words =
      unknown_words.from_proto(message.unknown_words(), FieldPath(path, "unknown_words"), faults)
          .value_or(program.copies_unknown_words);
  program.whole_numbers =
      whole_numbers.from_proto(message.whole_numbers(), FieldPath(path, "whole_numbers"), faults)
          .value_or(program.whole_numbers);
  program.block_skip =
      block_skips.from_proto(message.block_skip(), FieldPath(path, "block_skip"), faults)
          .value_or(program.block_skip);
  program.encoding = encodings.from_proto(message.encoding(), FieldPath(path, "encoding"), faults)
                         .value_or(program.encoding);
  program.renumbers = message.renumber();
  read_pass_words(message, path, program, faults);
  const Dialect& dialect = dialect_of(program.dialect);
  if (message.path().selection_mode() == v1::SELECTION_MODE_UNSPECIFIED)
    program.mode.selection = dialect.selection;
  if (message.path().transition() == v1::TRANSITION_UNSPECIFIED)
    program.mode.transition = dialect.transition;
  if (message.path().feed_adaptation() == v1::FEED_ADAPTATION_UNSPECIFIED)
    program.mode.feed_adaptation = dialect.feed_adaptation;
}

// Of a variable or a subprogram.
bool is_name(std::string_view name, const FieldPath& path, FieldFaults& faults) {
  constexpr std::size_t longest = 255;
  if (!name.empty() && name.size() <= longest) return true;
  add_fault(path, "has a name that is not 1 to " + std::to_string(longest) + " bytes long", faults);
  return false;
}

// Two spellings of one variable are refused, as a spelling given twice is where it can be seen.
void read_variables(const v1::ProgramSetup& message, const FieldPath& path, ProgramSetup& program,
                    FieldFaults& faults) {
  // Sorted by name, so that the same setup gives the same faults.
  const std::map<std::string_view, double> given(message.variables().begin(),
                                                 message.variables().end());
  std::map<std::string, std::string_view> spellings;
  for (const auto& [name, value] : given) {
    if (!is_name(name, FieldPath(path, "variables"), faults)) continue;
    const std::string entry = "variables[" + std::string(name) + "]";
    const FieldPath place(path, entry);
    if (!check_range(value, {-1e15, 1e15}, place, faults)) continue;
    const auto [known, is_new] =
        spellings.try_emplace(plain_variable_name(name, program.dialect), name);
    if (is_new)
      program.variables.emplace(name, value);
    else
      add_fault(place,
                "names the same variable as " + std::string(known->second) + "; give one of them",
                faults);
  }
}

// Reads the settings of programs that compute.
void read_computing(const v1::ProgramSetup& message, const FieldPath& path, ProgramSetup& program,
                    FieldFaults& faults) {
  constexpr std::size_t most_variables = 10'000;
  constexpr std::size_t most_subprograms = 1'000;
  const auto is_too_many = [&](std::size_t count, std::size_t most, std::string_view field) {
    if (count <= most) return false;
    add_fault(FieldPath(path, field),
              "has " + std::to_string(count) + " entries, allowed are " + std::to_string(most),
              faults);
    return true;
  };
  if (!is_too_many(message.variables().size(), most_variables, "variables"))
    read_variables(message, path, program, faults);
  if (!is_too_many(message.subprograms().size(), most_subprograms, "subprograms"))
    for (const auto& [name, text] : message.subprograms())
      if (is_name(name, FieldPath(path, "subprograms"), faults)) program.subprograms[name] = text;
  if (!is_too_many(message.subprogram_files().size(), most_subprograms, "subprogram_files"))
    for (const auto& [name, text] : message.subprogram_files())
      if (is_name(name, FieldPath(path, "subprogram_files"), faults) &&
          !program.subprograms.try_emplace(name, text).second)
        add_fault(FieldPath(path, "subprogram_files"), "names " + name + ", as subprograms do",
                  faults);
  if (!message.has_max_executed_lines()) return;
  // Not read as a double, whose message would show other digits for a number of twenty digits.
  constexpr std::uint64_t most_lines = 1'000'000'000;
  const std::uint64_t lines = message.max_executed_lines();
  if (lines < 1 || lines > most_lines)
    add_fault(FieldPath(path, "max_executed_lines"),
              "is " + std::to_string(lines) + ", allowed is 1 to " + std::to_string(most_lines),
              faults);
  else
    program.max_executed_lines = lines;
}

void tools_to_proto(const ProgramSetup& program, v1::ProgramSetup& message) {
  std::map<std::int64_t, std::string_view> names;
  for (const auto& [name, number] : program.tool_names) names.emplace(number, name);
  for (const auto& [key, row] : program.tools) {
    v1::Tool& tool = *message.add_tools();
    const std::int64_t edge = edge_of_row(key);
    const std::int64_t number = key - row_of_edge(0, edge);
    if (number < first_named_tool) tool.set_number(static_cast<std::uint32_t>(number));
    if (const auto name = names.find(number); name != names.end())
      tool.set_name(std::string(name->second));
    if (edge > 1) tool.set_edge(static_cast<std::uint32_t>(edge));
    tool.set_radius(row.radius);
    tool.set_wear(row.wear);
  }
}

}  // namespace

ProgramSettings from_proto(const v1::ProgramSetup& message, const FieldPath& path,
                           FieldFaults& faults) {
  ProgramSettings settings;
  settings.path = from_proto(message.path(), FieldPath(path, "path"), faults);
  settings.path.session.program.start_is_assumed = !message.path().has_start_position();
  read_tools(message, path, settings.path.session.program, faults);
  read_dialect(message, path, settings.path.session.program, faults);
  read_computing(message, path, settings.path.session.program, faults);
  // After G40 without a motion, a tool change and whole drilling cycles may follow.
  constexpr std::size_t most_passive_blocks = 10'000;
  if (settings.path.session.program.dialect != DialectName::isg &&
      !message.path().has_max_passive_blocks())
    settings.path.session.compensator.limits.passive_blocks = most_passive_blocks;
  settings.nc_text = outputs.from_proto(message.output(), FieldPath(path, "output"), faults)
                         .value_or(settings.nc_text);
  if (message.has_decimals() &&
      check_range(message.decimals(), {1, 8}, FieldPath(path, "decimals"), faults))
    settings.path.session.program.decimals = static_cast<int>(message.decimals());
  settings.file_name = message.file_name();
  if (settings.file_name.size() > 255)
    add_fault(FieldPath(path, "file_name"), "is longer than 255 bytes", faults);
  return settings;
}

v1::Dialect to_proto(DialectName dialect) { return dialects.to_proto(dialect); }

void add_subprogram(const std::string& name, const std::string& text, v1::ProgramSetup& message) {
  auto& texts =
      is_utf8(text) ? *message.mutable_subprograms() : *message.mutable_subprogram_files();
  message.mutable_subprograms()->erase(name);
  message.mutable_subprogram_files()->erase(name);
  texts[name] = text;
}

void to_proto(const ProgramSettings& settings, v1::ProgramSetup& message) {
  message.Clear();
  to_proto(settings.path, *message.mutable_path());
  tools_to_proto(settings.path.session.program, message);
  if (!settings.nc_text) message.set_output(outputs.to_proto(false));
  message.set_file_name(settings.file_name);
  const ProgramSetup& program = settings.path.session.program;
  if (program.decimals) message.set_decimals(static_cast<std::uint32_t>(*program.decimals));
  if (program.inch) message.set_unit(units.to_proto(true));
  if (program.copies_unknown_words) message.set_unknown_words(unknown_words.to_proto(true));
  message.mutable_variables()->insert(program.variables.begin(), program.variables.end());
  for (const auto& [name, text] : program.subprograms) add_subprogram(name, text, message);
  if (program.max_executed_lines != ProgramSetup{}.max_executed_lines)
    message.set_max_executed_lines(program.max_executed_lines);
  if (program.whole_numbers != WholeNumbers::unsaid)
    message.set_whole_numbers(whole_numbers.to_proto(program.whole_numbers));
  if (program.block_skip != BlockSkip::refuse)
    message.set_block_skip(block_skips.to_proto(program.block_skip));
  message.mutable_pass_words()->Assign(program.pass_words.begin(), program.pass_words.end());
  if (program.encoding != Encoding::of_dialect)
    message.set_encoding(encodings.to_proto(program.encoding));
  message.set_renumber(program.renumbers);
  if (program.dialect == DialectName::isg) return;
  message.set_dialect(dialects.to_proto(program.dialect));
  message.mutable_path()->set_selection_mode(selections.to_proto(program.mode.selection));
  message.mutable_path()->set_transition(transitions.to_proto(program.mode.transition));
}

}  // namespace trc::wire
