#include "core/nc/dialect/klartext_tools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/messages/diagnostic_text.h"
#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/heidenhain.h"
#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/klartext_formula.h"
#include "core/nc/dialect/klartext_statements.h"
#include "core/nc/dialect/passing_calls.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/dialect/tool_data.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/klartext_tool_words.h"

// TOOL CALL and TOOL DEF of Klartext, in which every word counts (D-90), and the radius that they
// give to RL and RR.

namespace trc {
namespace {

using Kind = KlartextToolWord::Kind;
using Value = KlartextToolWord::Value;

constexpr std::string_view tool_call = "TOOL CALL";
constexpr std::string_view tool_definition = "TOOL DEF";

// Functions of spindle and coolant, which some programs write in TOOL CALL.
bool is_function_beside_the_path(const KlartextToolWord& word) {
  constexpr double last = 14;
  return word.name == "M" && word.has == Value::number && is_whole(word.value) &&
         word.value <= last && word.value != 2;
}

// The words of TOOL CALL, before any of them takes effect.
struct ToolCall {
  bool named = false;
  std::int64_t number = 0;  // as in row_of_edge(), unless the tool has a name
  std::string name{};       // in quotes, or a parameter
  std::optional<Plane> plane{};
  bool changes_delta = false;
  double delta = 0;
  std::string open_delta{};      // DR by a parameter with an unknown value
  std::optional<double> feed{};  // in the unit of the program; 0: a feed that is not per minute
};

// The tool is the first word. `at`: where to look in the line for a quoted name or a parameter.
bool take_called_tool(const Reading& reading, const std::string& line, std::size_t at,
                      const KlartextToolWord& word, ToolCall& call) {
  call.named = true;
  if (word.kind == Kind::number) {
    const double tenths = std::round(10 * word.value);
    if (tenths / 10 != word.value || !is_number_of_tool(std::floor(word.value))) return false;
    const double tool = std::floor(word.value);
    call.number = row_of_edge(static_cast<std::int64_t>(tool),
                              static_cast<std::int64_t>(tenths - 10 * tool) + 1);
    return true;
  }
  if (const auto known = reading.klartext_modes.parameters.find(word.text);
      known != reading.klartext_modes.parameters.end()) {
    call.number = static_cast<std::int64_t>(known->second);
    return is_number_of_tool(known->second);
  }
  const bool quoted = word.kind == Kind::text;
  const std::size_t open = line.find_first_of(quoted ? "\"" : "Qq", at);
  if (open == std::string::npos) return false;
  call.number = no_tool_number;
  call.name =
      quoted ? line.substr(open + 1, word.text.size() - 2) : line.substr(open, word.text.size());
  return true;
}

// DR-0.05, DR+Q5.
void take_radius_delta(const Reading& reading, const KlartextToolWord& word, ToolCall& call) {
  call.changes_delta = true;
  call.open_delta.clear();
  call.delta = word.value;
  if (word.has != Value::parameter) return;
  const auto known = reading.klartext_modes.parameters.find(word.parameter);
  if (known == reading.klartext_modes.parameters.end())
    call.open_delta = word.text;
  else
    call.delta = word.negative ? -known->second : known->second;
}

// A word of TOOL CALL after the tool; false: it is no such word.
bool take_word_of_call(const Reading& reading, const KlartextToolWord& word, ToolCall& call) {
  if (word.kind != Kind::name) return false;
  if (word.name == "X" || word.name == "Y" || word.name == "Z") {
    if (call.plane) return false;
    call.plane = word.name == "Z" ? Plane::xy : word.name == "Y" ? Plane::zx : Plane::yz;
    return true;
  }
  if (word.has == Value::none) return false;
  if (word.name == "DR") {
    if (call.changes_delta) return false;
    take_radius_delta(reading, word, call);
    return true;
  }
  if (word.name.starts_with('F')) {
    if (call.feed) return false;
    const bool known = word.name == "F" && word.has == Value::number;
    call.feed = known ? word.value : 0;
    return true;
  }
  return word.name == "S" || word.name == "DL" || word.name == "DR2" ||
         is_function_beside_the_path(word);
}

// Every word counts: an unknown one might be the tool, or its radius.
bool read_words_of_call(Reading& reading, const ProgramLine& line, std::size_t begin,
                        std::string_view statement, ToolCall& call) {
  KlartextToolReader reader(statement.substr(tool_call.size()));
  bool first = true;
  for (KlartextToolWord word = reader.next(); word.kind != Kind::end; word = reader.next()) {
    const bool is_tool =
        std::exchange(first, false) &&
        (word.kind == Kind::number || word.kind == Kind::text || word.kind == Kind::parameter);
    const bool taken =
        is_tool ? take_called_tool(reading, line.text, begin + tool_call.size(), word, call)
                : take_word_of_call(reading, word, call);
    if (!taken)
      return refuse_klartext(
          reading, line, begin, std::string(word.text).append(" of TOOL CALL"),
          is_tool || word.kind == Kind::name ? Code::nc_number : Code::nc_syntax);
  }
  return true;
}

// R + DR + DR: radius and wear of the tool in the table, or the radius of TOOL DEF, and the
// allowance of TOOL CALL.
bool choose_called_tool(Reading& reading, const ProgramLine& line, std::size_t begin) {
  KlartextModes& modes = reading.klartext_modes;
  if (!modes.tool) return true;
  const ProgramSetup& setup = reading.state.setup();
  const auto unknown = [&](const std::string& tool) {
    return reading.refuse_at(modes.tool_place, Code::tool_unknown, tool);
  };
  const auto number_text = [&](std::int64_t tool) {
    if (tool <= no_tool_number) return name_not_in_table(reading, modes.tool_name);
    const std::int64_t index = edge_of_row(tool) - 1;
    const std::string number = std::to_string(tool - row_of_edge(0, index + 1));
    return index > 0 ? number + "." + std::to_string(index) : number;
  };
  reading.place(line, static_cast<std::uint32_t>(begin));
  if (!modes.open_delta.empty())
    return reading.refuse_at(modes.tool_place, Code::nc_unsupported,
                             modes.open_delta + " of TOOL CALL, a variable");
  if (*modes.tool == 0) return reading.state.set_tool(0, line.source);
  std::optional<ToolRow> row = reading.state.tool().row_of_tool(*modes.tool);
  // The radius of the setup applies to the only tool with which the program selects TRC.
  if (!row && setup.tools.empty() && setup.mode.tool_radius != 0) {
    const std::int64_t number = *modes.tool;
    if (modes.only_tool_name.empty()) modes.only_tool_name = modes.tool_name;
    if (reading.gcode.tools.only_register.value_or(number) != number ||
        modes.only_tool_name != modes.tool_name)
      return unknown(number_text(number));
    reading.gcode.tools.only_register = number;
    row = ToolRow(setup.mode.tool_radius, setup.wear);
  }
  if (!row && !setup.tools.empty()) return unknown(number_text(*modes.tool));
  if (!row) return true;  // no radius is given, or it is 0
  if (row->radius + row->wear + modes.radius_delta < 0)
    return refuse_klartext(reading, line, begin, "R + DR of TOOL CALL is less than 0",
                           Code::tool_radius_out_of_range);
  return reading.state.call_tool(*row, line.source) &&
         reading.state.set_allowance_of_program(modes.radius_delta, line.source);
}

// A fault of reading, as an unknown tool is, so that all further ones are told with it.
bool check_radius_is_given(Reading& reading, const ProgramLine& line, std::size_t begin) {
  if (reading.state.setup().every_radius || reading.state.tool().radius()) return true;
  const bool no_tool = reading.klartext_modes.tool == 0;
  reading.refuse_at(reading.place_of_word(line, static_cast<std::uint32_t>(begin)),
                    Code::no_tool_radius,
                    "RL or RR " + place_of(line.source) + (no_tool ? ", D0 or T0 is no tool" : ""));
  reading.scanned_trc = true;
  return false;
}

}  // namespace

bool read_tool_call(Reading& reading, ProgramLine& line, std::size_t begin,
                    std::string_view statement) {
  ToolCall call;
  if (!read_words_of_call(reading, line, begin, statement, call)) return false;
  if (reading.trc_active() && (call.named || call.changes_delta))
    return refuse_klartext(reading, line, begin, "TOOL CALL while TRC is active");
  KlartextModes& modes = reading.klartext_modes;
  if (!reading.faults.empty()) return false;
  const Plane plane = call.plane.value_or(reading.state.mode().plane);
  // The feed is in force from here on, not only for F AUTO.
  if (call.feed) reading.feed = modes.called_feed = *call.feed * klartext_feed_unit(reading);
  if (call.named) {
    modes.tool_of_label = 0;
    if (const std::int64_t number = number_of_tool_named(call.name, reading.state.tool());
        number > 0) {
      call.number = number;
      call.name.clear();
    }
    modes.tool_name = call.name;
    modes.tool_place = reading.place_of_word(line, static_cast<std::uint32_t>(begin));
    modes.tool = call.name.empty() ? call.number : reading.state.tool().tool_named(call.name);
    take_klartext_effects(reading, {.clears = KlartextMode::modal_cycle});
    modes.radius_delta = 0;
    modes.open_delta.clear();
    reading.gcode.calls.tool_said = true;
    std::array<bool, 3> third{};
    third[axes_of(plane).third] = true;
    reading.state.forget_position(third, line.source);
  }
  if (call.named || call.changes_delta)
    take_klartext_effects(reading, {.sets = KlartextMode::tool});
  if (call.changes_delta) {
    modes.radius_delta = call.delta * reading.length_unit();
    modes.open_delta = std::move(call.open_delta);
  }
  if (plane != reading.state.mode().plane) {
    lose_klartext_pole(reading, line);
    modes.tangent.reset();
    line.klartext.emplace().loses_pole = true;
    if (!reading.state.set_plane(plane, line.source)) return false;
  }
  const bool goes_on = copy_klartext(reading, line, begin, WordRole::technology);
  if (call.feed) line.roles |= bit(WordRole::feed);
  return goes_on;
}

void take_assignment(Reading& reading, const ProgramLine& line, std::string_view statement) {
  const std::size_t equals = statement.find('=');
  if (equals == std::string_view::npos) return;
  std::string_view name = without_blanks_behind(statement.substr(0, equals));
  name.remove_prefix(name.find_last_of(" :") + 1);
  const auto result =
      value_of_formula(statement.substr(equals + 1), reading.klartext_modes.parameters);
  if (const auto known = reading.klartext_modes.parameters.find(name);
      known != reading.klartext_modes.parameters.end())
    reading.klartext_modes.parameters.erase(known);
  const bool may_be_skipped = std::ranges::any_of(
      line.words, [&](const WordRange& word) { return line.word(word) == "/"; });
  if (!may_be_skipped && name.starts_with('Q') && result)
    reading.klartext_modes.parameters.emplace(name, *result);
}

void forget_parameters(Reading& reading, std::string_view statement) {
  const bool defines = begins_with_word(statement, "CYCL DEF");
  if (!defines && (begins_with_word(statement, "CALL") || begins_with_word(statement, "CYCL") ||
                   begins_with_word(statement, "TCH") || begins_with_word(statement, "PGM")))
    reading.klartext_modes.parameters.clear();
  if (defines)
    std::erase_if(reading.klartext_modes.parameters, [&](const auto& known) {
      return statement.find(known.first + "=") != std::string_view::npos ||
             statement.find(known.first + " =") != std::string_view::npos;
    });
}

bool read_tool_definition(Reading& reading, ProgramLine& line, std::size_t begin,
                          std::string_view statement) {
  KlartextToolReader reader(statement.substr(tool_definition.size()));
  const KlartextToolWord tool = reader.next();
  const auto wrong = [&](const KlartextToolWord& word, std::string_view why, Code code) {
    return refuse_klartext(reading, line, begin,
                           std::string(word.text).append(" of TOOL DEF").append(why), code);
  };
  const bool prepares =
      tool.kind == Kind::number || tool.kind == Kind::text || tool.kind == Kind::parameter;
  if (tool.kind == Kind::end)
    return refuse_klartext(reading, line, begin, "TOOL DEF without a tool", Code::nc_number);
  if (!prepares) return wrong(tool, "", Code::nc_syntax);
  std::optional<double> radius;
  for (KlartextToolWord word = reader.next(); word.kind != Kind::end; word = reader.next()) {
    const bool is_length = word.kind == Kind::name && word.name == "L";
    const bool is_radius = word.kind == Kind::name && word.name == "R" && !radius;
    if (!is_length && !is_radius) return wrong(word, "", Code::nc_syntax);
    if (word.has == Value::none) return wrong(word, "", Code::nc_number);
    if (is_length) continue;
    const auto known = reading.klartext_modes.parameters.find(word.parameter);
    if (word.has == Value::parameter && known == reading.klartext_modes.parameters.end())
      return wrong(word, ", a variable", Code::nc_unsupported);
    const double value = word.has == Value::parameter ? known->second : word.value;
    radius = word.has == Value::parameter && word.negative ? -value : value;
  }
  if (radius) {
    if (tool.kind != Kind::number || !is_number_of_tool(tool.value))
      return wrong(tool, " with a radius", Code::nc_number);
    if (reading.faults.empty() &&
        !reading.state.define_tool(static_cast<std::int64_t>(tool.value),
                                   *radius * reading.length_unit(), line.source))
      return false;
  }
  return copy_klartext(reading, line, begin, WordRole::technology);
}

bool select_in_klartext(Reading& reading, const ProgramLine& line, Side side, std::size_t begin) {
  const std::uint32_t skipped =
      std::max(reading.gcode.skipped.tool, reading.gcode.skipped.tool_data);
  if (side != Side::off && skipped > 0)
    return refuse_klartext(reading, line, begin,
                           "TRC after what may be skipped, in line " + std::to_string(skipped),
                           Code::block_skip_undecided);
  if (reading.klartext_modes.uncompensated() != 0)
    return refuse_klartext(reading, line, begin,
                           "RL, RR while coordinates are scaled or the tool tip is led");
  if (reading.klartext_modes.called_section != 0)
    return refuse_klartext(reading, line, begin,
                           "RL, RR in a section that line " +
                               std::to_string(reading.klartext_modes.called_section) + " calls");
  if (reading.klartext_modes.cycle_section != 0)
    return refuse_klartext(reading, line, begin,
                           "RL, RR in the contour of the cycles of line " +
                               std::to_string(reading.klartext_modes.cycle_section) +
                               ", before the end of the program");
  if (reading.klartext_modes.tool_of_label != 0)
    return refuse_klartext(reading, line, begin,
                           "RL, RR with the tool of the section that line " +
                               std::to_string(reading.klartext_modes.tool_of_label) + " calls");
  if (reading.klartext_modes.unfollowed_call != 0)
    return refuse_klartext(reading, line, begin,
                           "RL, RR after line " +
                               std::to_string(reading.klartext_modes.unfollowed_call) +
                               ", a call of lines that are not followed");
  if (reading.klartext_modes.jump != 0)
    return refuse_klartext(
        reading, line, begin,
        "RL, RR after line " + std::to_string(reading.klartext_modes.jump) + ", a jump to a label");
  if (!reading.trc_active()) {
    ++reading.klartext_modes.contours;
    const auto place_of_side = static_cast<std::uint32_t>(begin);
    if (!choose_called_tool(reading, line, begin) ||
        !warn_of_other_tool(reading, line, place_of_side) ||
        !check_radius_is_given(reading, line, begin))
      return false;
  }
  reading.place(line, static_cast<std::uint32_t>(begin));
  return reading.state.select(side, line.source);
}

}  // namespace trc
