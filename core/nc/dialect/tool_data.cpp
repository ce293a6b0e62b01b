#include "core/nc/dialect/tool_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/base/likely_meant.h"
#include "core/nc/text/characters.h"

// Tool radii in a program: G10 of Fanuc and LinuxCNC, $TC_DP6 of Sinumerik.

namespace trc {
namespace {

using enum GGroup;

// The row of $TC_DP6[1,1], as in row_of_edge().
std::optional<std::int64_t> row_of_index(std::string_view name) {
  std::array<double, 2> index{};
  std::size_t at = name.find('[');
  for (double& number : index) {
    bool whole = false;
    if (at >= name.size()) return {};
    const std::string_view text = without_blanks_in_front(name.substr(at + 1));
    const std::size_t length = read_number(text, number, whole);
    if (length == 0 || !is_number_of_tool(number) || number < 1) return {};
    at = name.find_first_not_of(" \t", name.size() - text.size() + length);
    if (at == std::string_view::npos || name[at] != (&number == index.data() ? ',' : ']'))
      return {};
  }
  return row_of_edge(static_cast<std::int64_t>(index[0]), static_cast<std::int64_t>(index[1]));
}

}  // namespace

// D-116
std::int64_t number_of_tool_named(std::string_view name, const ToolInForce& tools) {
  constexpr std::size_t most_digits = 9;
  const bool is_number = !name.empty() && name.size() <= most_digits && name.front() != '0' &&
                         std::ranges::all_of(name, is_digit);
  if (!is_number || tools.tool_named(name) != no_tool_number) return 0;
  return std::stoll(std::string(name));
}

std::string quoted(const std::string& name) { return '"' + name + '"'; }

std::string name_not_in_table(const Reading& reading, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& [known, tool] : reading.state.setup().tool_names) names.push_back(known);
  const auto meant = likely_meant(in_upper_case(name), names);
  return quoted(name) + (meant ? ", the table has " + quoted(*meant) : "");
}

bool read_edge_data(Reading& reading, const NamedWord& word, ProgramLine& line, BlockWords& block) {
  const std::string_view text = line.word({.begin = word.begin, .end = word.end});
  add(line, word, WordRole::technology);
  const std::string_view name = text.substr(0, text.find(']') + 1);
  const auto refused = [&](std::string_view why) {
    return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                          .begin = word.begin,
                                          .detail = std::string(name).append(", ").append(why)});
  };
  const auto row = row_of_index(name);
  if (!row) return refused("whose tool and edge are no numbers");
  if (reading.trc_active()) return refused("data of a tool while TRC is active");
  // Under G70 and G71 such data are in the unit of the machine.
  const LengthUnit lengths =
      reading.feed_in_mm ? reading.state.setup().length_unit() : reading.unit;
  const double value = word.value * mm_of(lengths);
  const bool is_guessed = reading.feed_in_mm && reading.unit == LengthUnit::inch &&
                          reading.state.setup().unit_is_assumed;
  if (is_guessed && value != 0) return refused("in the unit of the machine, which nobody has said");
  using enum BlockWords::Tools::EdgeLength;
  const ToolInForce& tools = reading.state.tool();
  const bool is_wear = word.name == "$TC_DP15";
  const bool is_of_setup = reading.has_one_radius() || reading.state.setup().tools.contains(*row);
  const auto before = tools.row_of_tool(*row);
  constexpr double alike = 1e-9;
  if (is_wear && is_of_setup)
    return std::abs(value - (before ? before->wear : tools.wear_of(*row))) <= alike ||
           refused("another wear than the setup gives that tool");
  GcodeModes::Tools& named = reading.gcode.tools;
  const std::int64_t called = named.changed_by_m6 ? named.in_spindle : named.next;
  const bool is_called = called > 0 && *row == row_of_edge(called, register_number(named.edge));
  const std::optional<double> old =
      !before ? std::nullopt : std::optional(is_wear ? before->wear : before->radius);
  if (is_called && old != value) named.changed_row = *row;
  block.tools.edges.push_back(
      {.row = *row, .kind = is_wear ? wear : radius, .length = value, .begin = word.begin});
  return true;
}

bool take_tool_data(Reading& reading, ProgramLine& line, BlockWords& block) {
  using enum BlockWords::Tools::EdgeLength;
  for (const auto& edge : block.tools.edges) {
    if (edge.length != 0) reading.keep_length(line, edge.kind == wear ? "a wear" : "a tool radius");
    if (!reading.faults.empty()) continue;
    reading.place(line, edge.begin);
    if (edge.kind == wear)
      reading.state.define_wear(edge.row, edge.length);
    else if (!reading.state.define_tool(edge.row, edge.length, line.source))
      return false;
  }
  // Controls with one table for lengths and radii have no L word.
  if (!block.has(tool_data) || (!block.l_word && !block.p_word)) return true;
  const std::optional<std::int64_t> data = block.l_word ? whole_number(block.l_word->value) : 12;
  const bool linuxcnc = reading.dialect.name == DialectName::linuxcnc;
  const bool radius_data =
      linuxcnc ? data == 1 || data == 10 || data == 11 : data == 12 || data == 13;
  if (!radius_data || !block.move.radius) return true;
  const bool adds = block.has(dimension) ? block.of(dimension).is(91) : reading.incremental;
  const bool is_wear = !linuxcnc && data == 13;
  const auto refused = [&](std::string_view why) {
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = block.of(tool_data).begin,
                        .detail = "G10 L" + std::to_string(*data).append(", ").append(why)});
  };
  if (adds && is_wear && *block.move.radius == 0) return true;
  if (!block.p_word || adds) return refused("a sum of a tool radius");
  if (!reading.faults.empty()) return true;
  const LengthUnit lengths =
      block.has(unit) ? reading.unit_of(*block.of(unit).function) : reading.unit;
  if (!block.has(unit) && *block.move.radius != 0)
    reading.keep_length(line, is_wear ? "a wear" : "a tool radius");
  const std::int64_t number = register_number(block.p_word->value);
  const double value = *block.move.radius * mm_of(lengths);
  if (is_wear) {
    // The setup knows the actual wear; a program that resets the wear to 0 does not contradict it.
    const double wear = reading.state.tool().wear_of(number);
    constexpr double alike = 1e-9;
    if (wear != 0 && value == 0 && !reading.state.tool().gives_wear(number)) return true;
    if (wear != 0 && std::abs(wear - value) > alike && !reading.state.tool().gives_wear(number))
      return refused("another wear than the setup gives that tool");
    reading.state.define_wear(number, value);
    return true;
  }
  reading.place(line, block.of(tool_data).begin);
  return reading.state.define_tool(number, value, line.source);
}

}  // namespace trc
