#include "core/nc/dialect/sinumerik_tools.h"

#include <string>
#include <utility>

#include "core/nc/dialect/tool_data.h"

// Tools of Sinumerik and their edges: T is the tool, D its edge (D-138); D0 selects none.

namespace trc {
namespace {

using enum GGroup;

// The number of a tool without one; beyond the range of T.
constexpr std::int64_t unnamed_tool = first_named_tool - 1;

// A tool change selects the first edge; if M6 changes tools, T alone only prepares one (D-56).
bool changes_tool(const GcodeModes::Tools& tools, const BlockWords& block) {
  return block.tools.change || (block.tools.t_word && !tools.changed_by_m6);
}

}  // namespace

bool refuse_second_edge(Reading& reading, std::int64_t row) {
  const WordPlace& tool = reading.gcode.tools.changed_by_m6 ? reading.gcode.tools.spindle_place
                                                            : reading.gcode.tools.next_place;
  const std::int64_t number = tool_of_row(row);
  const std::string called = !reading.gcode.tools.name.empty() ? quoted(reading.gcode.tools.name)
                             : number == unnamed_tool          ? ""
                                                               : "T" + std::to_string(number);
  const bool another_tool = number != tool_of_row(*reading.gcode.tools.only_register);
  if (another_tool && !called.empty()) return reading.refuse_at(tool, Code::tool_unknown, called);
  const std::string edge = "D" + std::to_string(edge_of_row(row));
  return reading.refuse_at(
      reading.gcode.tools.edge_place.source.line > 0 ? reading.gcode.tools.edge_place : tool,
      Code::tool_unknown, called.empty() ? edge : edge + " of " + called);
}

bool choose_tool_of_edge(Reading& reading, ProgramLine& line, BlockWords& block) {
  GcodeModes::Tools& tools = reading.gcode.tools;
  const bool changes = changes_tool(tools, block);
  const bool keeps_edge = block.tools.change && !block.tools.t_word && tools.edge_is_of_next;
  if (block.tools.d_word || (changes && !keeps_edge)) {
    tools.edge = block.tools.d_word ? block.tools.d_word->value : 1;
    tools.edge_place =
        block.tools.d_word ? reading.place_of_word(line, block.tools.d_word->begin) : WordPlace{};
  }
  if (block.tools.d_word || changes) tools.changed_row = 0;
  if (block.tools.t_word) tools.edge_is_of_next = block.tools.d_word.has_value();
  const std::optional<BlockWords::Value> edge_word = std::exchange(block.tools.d_word, {});
  const bool selects = block.selects();
  const bool goes_on = reading.trc_active() && !block.has(side);
  if (!selects && !(goes_on && (edge_word || changes))) return true;
  const std::uint32_t begin = selects     ? block.of(side).begin
                              : edge_word ? edge_word->begin
                                          : begin_of_words(line);
  const std::int64_t number = tools.changed_by_m6 ? tools.in_spindle : tools.next;
  const bool is_unloaded = number == 0 && tools.named;
  if (tools.edge == 0 || is_unloaded) {
    block.tools.d_word = {.value = 0, .begin = begin};
    return true;
  }
  const WordPlace& tool = tools.changed_by_m6 ? tools.spindle_place : tools.next_place;
  if (tools.changed_row != 0)
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = begin,
                        .detail = "$TC_DP6 after the call of its tool: it counts from the next D"});
  const auto unknown = [&](std::string detail) {
    return reading.refuse_at(tool, Code::tool_unknown, std::move(detail));
  };
  const bool table = !reading.state.setup().tools.empty();
  const std::int64_t edge = register_number(tools.edge);
  const std::int64_t row = row_of_edge(number, edge);
  if (table && number == no_tool_number) return unknown(name_not_in_table(reading, tools.name));
  const bool is_plain = edge == 1 && tools.name.empty();
  const std::string called = tools.name.empty() ? "T" + std::to_string(number) : quoted(tools.name);
  if (table && !is_plain && !reading.state.tool().has_tool(row))
    return reading.refuse_at(edge == 1 ? tool : tools.edge_place, Code::tool_unknown,
                             "D" + std::to_string(edge) + " of " + called);
  if (table && number > 0 && !reading.state.tool().has_tool(row)) return unknown(called);
  if (table && number == 0 && !tools.named && reading.state.tool().row_of_tool(row) == std::nullopt)
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = begin,
                        .detail = "D" + std::to_string(edge) + " without T, which tool it is of"});
  if (number == no_tool_number) {
    // The radius of the setup applies to the only tool with which the program selects TRC.
    if (tools.only_name.empty()) tools.only_name = tools.name;
    if (tools.only_name != tools.name) return unknown(quoted(tools.name));
  }
  const bool numbered = number > 0;
  if (numbered || reading.has_one_radius())
    block.tools.d_word = {
        .value = static_cast<double>(numbered ? row : row_of_edge(unnamed_tool, edge)),
        .begin = begin};
  return true;
}

}  // namespace trc
