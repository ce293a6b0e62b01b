#include "core/nc/dialect/code_tools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/likely_meant.h"
#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/characters.h"

// Which tool G41 and G42 have, and what a program says of tools: the dialects of Fanuc, LinuxCNC
// and Sinumerik.

namespace trc {
namespace {

using enum GGroup;

// Of Sinumerik: a tool that has no number, in place of one; beyond what T may say.
constexpr std::int64_t unnamed_tool = first_named_tool - 1;

std::string quoted(const std::string& name) { return '"' + name + '"'; }

bool has_length_offset(const ProgramLine& line) {
  return std::ranges::any_of(line.words, [&](const WordRange& range) {
    const std::string_view word = line.word(range);
    return word == "G43" || word == "g43" || word == "G44" || word == "g44";
  });
}

// Further work offsets take a P, and M words of machine builders may; those of spindle and coolant
// do not.
bool has_function_with_p(const ProgramLine& line) {
  return std::ranges::any_of(line.words, [&](const WordRange& range) {
    const std::string_view word = line.word(range);
    if (same_name(word, "G154") || same_name(word, "G54.1")) return true;
    const bool is_m = word.size() > 2 && upper(word[0]) == 'M' && word[1] != '0';
    return is_m && is_digit(word[1]) && is_digit(word[2]);
  });
}

// G38.2 of 382.
std::string name_of_function(std::int32_t tenths) {
  const std::string tenth = tenths % 10 == 0 ? "" : "." + std::to_string(tenths % 10);
  return "G" + std::to_string(tenths / 10) + tenth;
}

// Of $TC_DP6[1,1], as row_of_edge() has it.
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

bool check_what_may_be_skipped(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  const std::uint32_t skipped = block.to_skip ? line.source.line : 0;
  const bool sinumerik = reading.dialect.name == DialectName::sinumerik;
  const bool names_tool =
      block.tool_number || block.named_tool || block.loads_tool || block.names_tool;
  const bool gives_radius =
      (block.has(tool_data) && block.move.radius) || block.allowance || !block.edge_radii.empty();
  const bool leads = block.has(selection) || block.has(transition);
  if (block.tool_number || block.named_tool) reading.code_modes.skipped_next_tool = skipped;
  // An edge of Sinumerik is one of the tool.
  if (names_tool || (block.tool && (skipped > 0 || !sinumerik)))
    reading.code_modes.skipped_tool =
        skipped == 0 && block.loads_tool ? reading.code_modes.skipped_next_tool : skipped;
  if (gives_radius) reading.code_modes.skipped_tool_data = skipped;
  if (leads) reading.code_modes.skipped_approach = skipped;
  // Of other dialects a T word changes nothing in a contour.
  const bool changes_contour = block.tool || gives_radius || leads || (sinumerik && names_tool);
  if (skipped > 0 && changes_contour && reading.trc_active())
    return reading.refuse(line, TextFault{.code = Code::block_skip_undecided,
                                          .begin = line.words.front().begin,
                                          .detail = "a radius or a corner that may be skipped"});
  const bool selects = block.has(side) && !block.of(side).is(40);
  for (const std::uint32_t before :
       {reading.code_modes.skipped_tool, reading.code_modes.skipped_tool_data,
        reading.code_modes.skipped_approach})
    if (selects && before > 0)
      return reading.refuse(line, TextFault{.code = Code::block_skip_undecided,
                                            .begin = block.of(side).begin,
                                            .detail = "TRC behind what may be skipped, in line " +
                                                      std::to_string(before)});
  return true;
}

bool refuse_selection(Reading& reading, const ProgramLine& line, const BlockWords& block, Code code,
                      std::string detail) {
  return reading.refuse(
      line, TextFault{.code = code, .begin = block.of(side).begin, .detail = std::move(detail)});
}

// Only lathes work without Y (D-105).
bool check_turning(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  const bool selects = block.has(side) && !block.of(side).is(40);
  if (selects && reading.code_modes.turning && !reading.code_modes.y_seen)
    return refuse_selection(reading, line, block, Code::turning, "G41, G42 of a lathe");
  const bool in_zx =
      block.has(plane) ? block.of(plane).is(18) : reading.state.programmed_plane() == Plane::zx;
  const bool leads_in_zx = in_zx || (block.move.end[0] && block.move.end[2]);
  if (selects && !reading.code_modes.y_seen && leads_in_zx)
    return refuse_selection(reading, line, block, Code::turning,
                            "G41, G42 of a lathe, as no Y stands in front of it");
  if (reading.trc_active() && !reading.code_modes.y_seen &&
      reading.state.mode().plane == Plane::xy && block.move.end[2])
    return reading.refuse(line, TextFault{.code = Code::turning,
                                          .begin = *block.axis,
                                          .detail = "a contour of X and Z in the plane X Y"});
  return true;
}

// Words that say nothing to a contour, or something that is not followed.
bool check_words_beside_contour(Reading& reading, const ProgramLine& line,
                                const BlockWords& block) {
  const bool selects = block.has(side) && !block.of(side).is(40);
  const auto unsupported = [&](std::uint32_t begin, std::string detail) {
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported, .begin = begin, .detail = std::move(detail)});
  };
  if (block.own_feed && (selects || reading.trc_active()))
    return unsupported(*block.own_feed, "FB=, a feed of one block, while TRC is active");
  // The corner in front of it still has the feed before.
  if (block.tooth_feed && reading.trc_active())
    return unsupported(*block.tooth_feed, "FZ=, no feed per minute, while TRC is active");
  const bool takes_p = block.orients_spindle || block.has(dwell) || block.has(zero_shift) ||
                       block.has(tool_data) || block.tool_data || has_function_with_p(line);
  if (reading.dialect.name == DialectName::fanuc && selects && block.tool_data_number && !takes_p)
    return unsupported(block.tool_data_number->begin,
                       block.tool || block.offset ? "P, which no function of the line takes"
                                                  : "P beside G41, G42, a radius or a diameter");
  if (reading.dialect.name != DialectName::linuxcnc) return true;
  if (selects && block.tool_data_number)
    return unsupported(block.tool_data_number->begin, "P, which no function of the line takes");
  if ((selects || reading.trc_active()) && block.tool_data && !block.has(tool_data) &&
      (block.axis || block.center))
    return unsupported(block.tool_data->begin, "L, which no function of the line takes");
  return true;
}

// What names the tool of a line.
enum class ToolSaid : std::uint8_t { by_d, by_h, by_spindle };

// Which tool G41 or G42 of the line has, where the line or the spindle says. Empty: an error.
std::optional<ToolSaid> take_tool_of_selection(Reading& reading, ProgramLine& line,
                                               BlockWords& block) {
  ToolSaid said = ToolSaid::by_d;
  // Older controls have one table for lengths and radii, with H words for both. Without G41 beside
  // it H would change the length.
  if (reading.dialect.name == DialectName::fanuc && !block.tool && block.offset &&
      !has_length_offset(line)) {
    block.tool = block.offset;
    said = ToolSaid::by_h;
  }
  const bool gives_diameter = block.of(side).function->tenth != 0;
  if (gives_diameter && !block.tool) {
    refuse_selection(reading, line, block, Code::nc_number, "G41.1, G42.1 without D, the diameter");
    return std::nullopt;
  }
  if (gives_diameter) {
    block.tool_radius = {.value = block.tool->value / 2, .begin = block.tool->begin};
    block.tool.reset();
    return said;
  }
  // D0 of LinuxCNC is the tool in the spindle, unless the table has a tool 0.
  const bool is_spindle_by_number = reading.dialect.name == DialectName::linuxcnc && block.tool &&
                                    block.tool->value == 0 &&
                                    !reading.state.setup().tools.contains(0);
  if (is_spindle_by_number) {
    for (WordRange& word : line.words)
      if (upper(line.text[word.begin]) == 'D') word.role = WordRole::trc;
    block.tool.reset();
  }
  if (reading.dialect.tool_of_spindle && !block.tool &&
      (reading.code_modes.spindle_tool != 0 || reading.code_modes.spindle_empty)) {
    block.tool = {.value = static_cast<double>(reading.code_modes.spindle_tool),
                  .begin = block.of(side).begin};
    said = ToolSaid::by_spindle;
  }
  return said;
}

// Of Sinumerik: another tool, or another edge of that tool; `row` as row_of_edge() has it.
bool refuse_second_edge(Reading& reading, std::int64_t row) {
  const WordPlace& tool = reading.code_modes.changes_by_m6 ? reading.code_modes.spindle_tool_place
                                                           : reading.code_modes.next_tool_place;
  const std::int64_t number = tool_of_row(row);
  const std::string called = !reading.code_modes.tool_name.empty()
                                 ? quoted(reading.code_modes.tool_name)
                             : number == unnamed_tool ? ""
                                                      : "T" + std::to_string(number);
  const bool another_tool = number != tool_of_row(*reading.code_modes.only_register);
  if (another_tool && !called.empty()) return reading.refuse_at(tool, Code::tool_unknown, called);
  const std::string edge = "D" + std::to_string(edge_of_row(row));
  return reading.refuse_at(
      reading.code_modes.edge_place.source.line > 0 ? reading.code_modes.edge_place : tool,
      Code::tool_unknown, called.empty() ? edge : edge + " of " + called);
}

// Whether the table has the tool of the line, or the radius of the setup stands for it.
bool check_tool_of_table(Reading& reading, const ProgramLine& line, BlockWords& block,
                         ToolSaid said) {
  const bool matters = reading.trc_active() || (block.has(side) && !block.of(side).is(40));
  const std::int64_t number = whole_number(block.tool->value);
  reading.code_modes.missing_tool = -1;
  if (!is_whole(block.tool->value)) {
    const bool linuxcnc = reading.dialect.name == DialectName::linuxcnc;
    return reading.refuse(
        line, TextFault{.code = Code::nc_number,
                        .begin = block.tool->begin,
                        .detail = linuxcnc ? "D of G41, G42 is the number of a tool: "
                                             "G41.1, G42.1 take a diameter"
                                           : "D of G41, G42 is the number of a register, "
                                             "not a radius"});
  }
  if (reading.state.tool().has_tool(number)) return true;
  if (matters && take_only_register(reading, line, block, number)) return true;
  if (!matters) {
    // H and D stand side by side in many programs: it matters only where G41 has no D of its own.
    reading.code_modes.missing_tool = number;
    reading.code_modes.edge_place = reading.place_of_word(line, block.tool->begin);
    block.tool.reset();
    return true;
  }
  const Code of_missing = reading.gives_radii() ? Code::tool_unknown : Code::no_tool_radius;
  if (said == ToolSaid::by_spindle)
    return reading.refuse_at(reading.code_modes.spindle_tool_place, of_missing,
                             "T" + std::to_string(number));
  if (reading.dialect.name == DialectName::sinumerik && reading.code_modes.only_register)
    return refuse_second_edge(reading, number);
  return reading.refuse(line, TextFault{.code = of_missing,
                                        .begin = block.tool->begin,
                                        .detail = "D" + std::to_string(tool_of_row(number))});
}

// FANUC without D words: the radius of the setup is that of the tool in the spindle.
bool take_only_spindle_tool(Reading& reading) {
  const std::int64_t tool = reading.code_modes.spindle_tool;
  if (reading.dialect.name != DialectName::fanuc || !reading.has_one_radius() || tool == 0 ||
      reading.code_modes.only_register)
    return true;
  const std::int64_t only = reading.code_modes.only_spindle_tool.value_or(tool);
  reading.code_modes.only_spindle_tool = only;
  return only == tool || reading.refuse_at(reading.code_modes.spindle_tool_place,
                                           Code::tool_unknown, "T" + std::to_string(tool));
}

// Sinumerik: T is the tool, D its edge (D-138); D0 is none.
bool choose_tool_of_edge(Reading& reading, ProgramLine& line, BlockWords& block) {
  CodeModes& modes = reading.code_modes;
  // A tool change chooses the first one; where M6 changes tools, T alone makes one ready (D-56).
  const bool changes = block.changes_tool || (block.tool_number && !modes.changes_by_m6);
  const bool keeps_edge = block.changes_tool && !block.tool_number && modes.edge_of_next_tool;
  if (block.tool || (changes && !keeps_edge)) {
    modes.edge = block.tool ? block.tool->value : 1;
    modes.edge_place = block.tool ? reading.place_of_word(line, block.tool->begin) : WordPlace{};
  }
  if (block.tool_number) modes.edge_of_next_tool = block.tool.has_value();
  const std::optional<BlockWords::Value> edge_word = std::exchange(block.tool, {});
  const bool selects = block.has(side) && !block.of(side).is(40);
  const bool goes_on = reading.trc_active() && !block.has(side);
  if (!selects && !(goes_on && (edge_word || changes))) return true;
  const std::uint32_t begin = selects     ? block.of(side).begin
                              : edge_word ? edge_word->begin
                                          : line.words.front().begin;
  if (modes.edge == 0) {
    block.tool = {.value = 0, .begin = begin};
    return true;
  }
  const std::int64_t number = modes.changes_by_m6 ? modes.spindle_tool : modes.next_tool;
  const WordPlace& tool = modes.changes_by_m6 ? modes.spindle_tool_place : modes.next_tool_place;
  const auto unknown = [&](std::string detail) {
    return reading.refuse_at(tool, Code::tool_unknown, std::move(detail));
  };
  const bool table = !reading.state.setup().tools.empty();
  const std::int64_t edge = whole_number(modes.edge);
  const std::int64_t row = row_of_edge(number, edge);
  if (table && number == no_tool_number)
    return unknown(name_not_in_table(reading, modes.tool_name));
  const bool is_plain = edge == 1 && modes.tool_name.empty();
  const std::string called =
      modes.tool_name.empty() ? "T" + std::to_string(number) : quoted(modes.tool_name);
  if (table && !is_plain && !reading.state.tool().has_tool(row))
    return reading.refuse_at(edge == 1 ? tool : modes.edge_place, Code::tool_unknown,
                             "D" + std::to_string(edge) + " of " + called);
  if (table && number > 0 && !reading.state.tool().has_tool(row)) return unknown(called);
  if (table && number == 0 && !modes.tool_named &&
      reading.state.tool().row_of_tool(row) == std::nullopt)
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = begin,
                        .detail = "D" + std::to_string(edge) + " without T, which tool it is of"});
  if (number == no_tool_number) {
    // The radius of the setup stands for the one tool that the program selects with.
    if (modes.only_tool_name.empty()) modes.only_tool_name = modes.tool_name;
    if (modes.only_tool_name != modes.tool_name) return unknown(quoted(modes.tool_name));
  }
  const bool numbered = number > 0;
  if (numbered || reading.has_one_radius())
    block.tool = {.value = static_cast<double>(numbered ? row : row_of_edge(unnamed_tool, edge)),
                  .begin = begin};
  return true;
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

bool check_code_selection(Reading& reading, ProgramLine& line, BlockWords& block) {
  const bool selects = block.has(side) && !block.of(side).is(40);
  if (!check_what_may_be_skipped(reading, line, block)) return false;
  if (selects && !reading.code_modes.unfollowed.empty()) {
    const UnfollowedMode& mode = reading.code_modes.unfollowed.back();
    const std::string what =
        mode.is_motion ? name_of_function(mode.function) + ", a motion function of its own"
                       : mode.meaning;
    return refuse_selection(reading, line, block, Code::nc_unsupported,
                            "TRC under " + what + ", in line " + std::to_string(mode.line));
  }
  if (reading.dialect.name == DialectName::sinumerik && !choose_tool_of_edge(reading, line, block))
    return false;
  if (!check_turning(reading, line, block) || !check_words_beside_contour(reading, line, block))
    return false;
  if (block.constant_speed) block.tool.reset();
  const std::optional<ToolSaid> said =
      selects ? take_tool_of_selection(reading, line, block) : ToolSaid::by_d;
  if (!said) return false;
  const Code of_missing = reading.gives_radii() ? Code::tool_unknown : Code::no_tool_radius;
  if (selects && !block.tool && !block.tool_radius && reading.code_modes.missing_tool >= 0)
    return take_only_register(reading, line, block, reading.code_modes.missing_tool) ||
           reading.refuse_at(reading.code_modes.edge_place, of_missing,
                             "D" + std::to_string(reading.code_modes.missing_tool));
  if (!block.tool && !block.tool_radius) return !selects || take_only_spindle_tool(reading);
  if ((selects || reading.trc_active()) && reading.dialect.name != DialectName::sinumerik)
    for (WordRange& word : line.words)
      if (upper(line.text[word.begin]) == (said == ToolSaid::by_h ? 'H' : 'D'))
        word.role = WordRole::trc;
  return !block.tool || check_tool_of_table(reading, line, block, *said);
}

std::optional<double> spindle_diameter(const Reading& reading) {
  if (reading.code_modes.spindle_tool == 0 || reading.state.setup().every_radius)
    return std::nullopt;
  if (const auto row = reading.state.tool().row_of_tool(reading.code_modes.spindle_tool))
    return 2 * (row->radius + row->wear);
  if (!reading.has_one_radius()) return std::nullopt;
  return 2 * (reading.state.setup().mode.tool_radius + reading.state.setup().wear);
}

bool take_only_register(Reading& reading, const ProgramLine& line, BlockWords& block,
                        std::int64_t number) {
  if (!reading.has_one_radius() || reading.code_modes.only_register.value_or(number) != number)
    return false;
  reading.code_modes.only_register = number;
  block.only_tool = block.tool ? block.tool->begin : line.words.front().begin;
  block.tool.reset();
  return true;
}

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
  const bool inch = reading.feed_in_mm ? reading.state.setup().inch : reading.inch;
  const double value = word.value * (inch ? mm_per_inch : 1);
  if (word.name == "$TC_DP6") {
    block.edge_radii.push_back({.row = *row, .radius = value, .begin = word.begin});
    return true;
  }
  const auto known = reading.state.tool().row_of_tool(*row);
  constexpr double alike = 1e-9;
  const double wear = known                                 ? known->wear
                      : reading.state.setup().tools.empty() ? reading.state.setup().wear
                                                            : 0;
  return std::abs(value - wear) <= alike || refused("another wear than the setup gives that tool");
}

bool take_tool_data(Reading& reading, ProgramLine& line, BlockWords& block) {
  for (const auto& edge : block.edge_radii) {
    reading.place(line, edge.begin);
    if (reading.faults.empty() && !reading.state.define_tool(edge.row, edge.radius, line.source))
      return false;
  }
  // Controls with one table for lengths and radii have no L word.
  if (!block.has(tool_data) || (!block.tool_data && !block.tool_data_number)) return true;
  const std::int64_t data = block.tool_data ? whole_number(block.tool_data->value) : 12;
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
                        .detail = "G10 L" + std::to_string(data).append(", ").append(why)});
  };
  if (adds && is_wear && *block.move.radius == 0) return true;
  if ((linuxcnc && data != 1) || !block.tool_data_number || adds)
    return refused("a sum of a tool radius");
  if (!reading.faults.empty()) return true;
  const bool inch =
      block.has(unit) ? reading.counts_in_inch(*block.of(unit).function) : reading.inch;
  const std::int64_t number = whole_number(block.tool_data_number->value);
  const double value = *block.move.radius * (inch ? mm_per_inch : 1);
  if (is_wear) {
    // What the setup says of the wear it has been told; a program that sets it back to 0 does not.
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
