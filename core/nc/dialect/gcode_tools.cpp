#include "core/nc/dialect/gcode_tools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "core/base/reasons.h"
#include "core/messages/diagnostic_text.h"
#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/dialect/sinumerik_tools.h"
#include "core/nc/dialect/turning.h"
#include "core/nc/text/characters.h"

// The tool of G41 and G42, and the tool words of a program: the dialects of Fanuc, LinuxCNC and
// Sinumerik.

namespace trc {
namespace {

using enum GGroup;

bool has_length_offset(const ProgramLine& line) {
  return std::ranges::any_of(line.words, [&](const WordRange& range) {
    const std::string_view word = line.word(range);
    return word == "G43" || word == "g43" || word == "G44" || word == "g44";
  });
}

// Further work offsets have a P, and M words of machine builders may; M words of spindle and
// coolant do not.
bool has_function_with_p(const ProgramLine& line) {
  return std::ranges::any_of(line.words, [&](const WordRange& range) {
    const std::string_view word = line.word(range);
    if (same_name(word, "G154") || same_name(word, "G54.1")) return true;
    const bool is_m = word.size() > 2 && upper(word[0]) == 'M' && word[1] != '0';
    return is_m && is_digit(word[1]) && is_digit(word[2]);
  });
}

// G38.2 from 382.
std::string name_of_function(std::int32_t tenths) {
  const std::string tenth = tenths % 10 == 0 ? "" : "." + std::to_string(tenths % 10);
  return "G" + std::to_string(tenths / 10) + tenth;
}

bool check_what_may_be_skipped(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  const std::uint32_t skipped = block.to_skip ? line.source.line : 0;
  const bool sinumerik = reading.dialect.name == DialectName::sinumerik;
  const bool names_tool =
      block.tools.t_word || block.tools.named || block.tools.loads || block.tools.q_word_names_tool;
  const bool gives_radius = (block.has(tool_data) && block.move.radius) || block.tools.allowance ||
                            !block.tools.edges.empty();
  const bool leads = block.has(selection) || block.has(transition);
  if (block.tools.t_word || block.tools.named) reading.gcode.skipped.next_tool = skipped;
  // A Sinumerik edge belongs to the tool.
  if (names_tool || (block.tools.d_word && (skipped > 0 || !sinumerik)))
    reading.gcode.skipped.tool =
        skipped == 0 && block.tools.loads ? reading.gcode.skipped.next_tool : skipped;
  if (gives_radius) reading.gcode.skipped.tool_data = skipped;
  if (leads) reading.gcode.skipped.approach = skipped;
  // In other dialects a T word does not change a contour.
  const bool changes_contour =
      block.tools.d_word || gives_radius || leads || (sinumerik && names_tool);
  if (skipped > 0 && changes_contour && reading.trc_active())
    return reading.refuse(line, TextFault{.code = Code::block_skip_undecided,
                                          .begin = begin_of_words(line),
                                          .detail = "a radius or a corner that may be skipped"});
  const bool selects = block.selects();
  for (const std::uint32_t before : {reading.gcode.skipped.tool, reading.gcode.skipped.tool_data,
                                     reading.gcode.skipped.approach})
    if (selects && before > 0)
      return reading.refuse(line, TextFault{.code = Code::block_skip_undecided,
                                            .begin = block.of(side).begin,
                                            .detail = "TRC after what may be skipped, in line " +
                                                      std::to_string(before)});
  return true;
}

bool refuse_selection(Reading& reading, const ProgramLine& line, const BlockWords& block, Code code,
                      std::string detail) {
  return reading.refuse(
      line, TextFault{.code = code, .begin = block.of(side).begin, .detail = std::move(detail)});
}

// G41.1 and G42.1 of LINUXCNC: D is a diameter, and L 0 for a mill.
bool gives_diameter(const BlockWords& block) {
  return block.selects() && block.of(side).function->tenth != 0;
}

// Refuses words that do not apply to a contour or are not followed.
bool check_words_beside_contour(Reading& reading, const ProgramLine& line,
                                const BlockWords& block) {
  const bool selects = block.selects();
  const auto unsupported = [&](std::uint32_t begin, std::string detail) {
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported, .begin = begin, .detail = std::move(detail)});
  };
  if (block.own_feed && (selects || reading.trc_active()))
    return unsupported(*block.own_feed, "FB=, a feed of one block, while TRC is active");
  // The corner before it still has the previous feed.
  if (block.tooth_feed && reading.trc_active())
    return unsupported(*block.tooth_feed, "FZ=, no feed per minute, while TRC is active");
  const bool takes_p = block.spindle.is_oriented || block.has(dwell) || block.has(zero_shift) ||
                       block.has(tool_data) || block.l_word || has_function_with_p(line);
  if (reading.dialect.name == DialectName::fanuc && selects && block.p_word && !takes_p)
    return unsupported(block.p_word->begin, block.tools.d_word || block.h_word
                                                ? "P, which no function of the line takes"
                                                : "P beside G41, G42, a radius or a diameter");
  if (reading.dialect.name != DialectName::linuxcnc) return true;
  // The control refuses it too, so that no tool changes within a contour.
  const bool takes_d =
      selects || block.spindle.constant_cutting_speed || block.has(turning) || block.copied;
  if (block.tools.d_word && !takes_d)
    return unsupported(block.tools.d_word->begin, "D, which no function of the line takes");
  if (selects && block.p_word)
    return unsupported(block.p_word->begin, "P, which no function of the line takes");
  if (gives_diameter(block) && block.l_word) {
    if (block.l_word->value == 0) return true;
    return unsupported(block.l_word->begin, "L, the orientation of a turning tool");
  }
  if ((selects || reading.trc_active()) && block.l_word && !block.has(tool_data) &&
      (block.axis || block.center))
    return unsupported(block.l_word->begin, "L, which no function of the line takes");
  return true;
}

// FANUC: at the start of a contour the control reads the register of the last D word, which G10 may
// have changed since (D-163). Empty: no register is known, so the line has to name one.
std::optional<BlockWords::Value> register_in_force(const Reading& reading,
                                                   const BlockWords& block) {
  const std::optional<double>& last = reading.gcode.last_register.number;
  if (reading.dialect.name != DialectName::fanuc || !last || reading.trc_active()) return {};
  const std::int64_t number = register_number(*last);
  if (!reading.state.tool().has_tool(number) && reading.gcode.tools.only_register != number)
    return {};
  return BlockWords::Value{.value = *last, .begin = block.of(side).begin};
}

// The word or state that names the tool of a line.
enum class ToolSaid : std::uint8_t { by_d, by_h, by_spindle };

// The tool of G41 or G42, from the line or from the spindle. Empty: an error.
std::optional<ToolSaid> take_tool_of_selection(Reading& reading, ProgramLine& line,
                                               BlockWords& block) {
  ToolSaid said = ToolSaid::by_d;
  // Older controls have one table for lengths and radii, with H words for both. Without G41 beside
  // it H would change the length.
  if (reading.dialect.name == DialectName::fanuc && !block.tools.d_word && block.h_word &&
      !has_length_offset(line)) {
    block.tools.d_word = block.h_word;
    reading.gcode.last_register = {.number = block.h_word->value,
                                   .comes_out = false,
                                   .place = reading.place_of_word(line, block.h_word->begin)};
    said = ToolSaid::by_h;
  }
  if (gives_diameter(block) && !block.tools.d_word) {
    refuse_selection(reading, line, block, Code::nc_number, "G41.1, G42.1 without D, the diameter");
    return std::nullopt;
  }
  if (gives_diameter(block)) {
    block.tools.radius = {.value = block.tools.d_word->value / 2,
                          .begin = block.tools.d_word->begin};
    block.tools.d_word.reset();
    return said;
  }
  if (!block.tools.d_word) block.tools.d_word = register_in_force(reading, block);
  // D0 of LinuxCNC is the tool in the spindle, unless the table has a tool 0.
  const bool is_spindle_by_number = reading.dialect.name == DialectName::linuxcnc &&
                                    block.tools.d_word && block.tools.d_word->value == 0 &&
                                    !reading.state.setup().tools.contains(0);
  if (is_spindle_by_number) {
    for (WordRange& word : line.words)
      if (upper(line.text[word.begin]) == 'D') word.role = WordRole::trc;
    block.tools.d_word.reset();
  }
  if (reading.dialect.tool_of_spindle && !block.tools.d_word &&
      (reading.gcode.tools.in_spindle != 0 || reading.gcode.tools.spindle_is_empty)) {
    block.tools.d_word = {.value = static_cast<double>(reading.gcode.tools.in_spindle),
                          .begin = block.of(side).begin};
    said = ToolSaid::by_spindle;
  }
  return said;
}

// Whether the table has the tool of the line, or the setup gives the radius instead.
bool check_tool_of_table(Reading& reading, const ProgramLine& line, BlockWords& block,
                         ToolSaid said) {
  const bool matters = reading.trc_active() || block.selects();
  const std::int64_t number = register_number(block.tools.d_word->value);
  reading.gcode.tools.missing.reset();
  if (!is_whole(block.tools.d_word->value)) {
    const bool linuxcnc = reading.dialect.name == DialectName::linuxcnc;
    return reading.refuse(
        line, TextFault{.code = Code::nc_number,
                        .begin = block.tools.d_word->begin,
                        .detail = linuxcnc ? "D of G41, G42 is the number of a tool: "
                                             "G41.1, G42.1 take a diameter"
                                           : "D of G41, G42 is the number of a register, "
                                             "not a radius"});
  }
  if (reading.state.tool().has_tool(number)) return true;
  if (matters && take_only_register(reading, line, block, number)) return true;
  if (!matters) {
    // Many programs have H and D side by side: the tool only matters if G41 has no D of its own.
    reading.gcode.tools.missing = number;
    reading.gcode.tools.edge_place = reading.place_of_word(line, block.tools.d_word->begin);
    block.tools.d_word.reset();
    return true;
  }
  const Code of_missing = reading.gives_radii() ? Code::tool_unknown : Code::no_tool_radius;
  if (said == ToolSaid::by_spindle)
    return reading.refuse_at(reading.gcode.tools.spindle_place, of_missing,
                             "T" + std::to_string(number));
  if (reading.dialect.name == DialectName::sinumerik && reading.gcode.tools.only_register)
    return refuse_second_edge(reading, number);
  const std::string tool = std::to_string(tool_of_row(number));
  return reading.refuse(
      line, TextFault{.code = of_missing,
                      .begin = block.tools.d_word->begin,
                      .detail = reading.dialect.name == DialectName::sinumerik
                                    ? "T" + tool + " D" + std::to_string(edge_of_row(number))
                                    : "D" + tool});
}

// FANUC without D words: the radius of the setup belongs to the tool in the spindle, 0 where the
// program has named none.
bool take_only_spindle_tool(Reading& reading) {
  GcodeModes::Tools& tools = reading.gcode.tools;
  const std::int64_t tool = tools.in_spindle;
  if (!reading.has_one_radius() || tools.spindle_is_empty || tools.only_register ||
      reading.state.tool().row_of_tool(tool))
    return true;
  const std::int64_t only = tools.only_in_spindle.value_or(tool);
  tools.only_in_spindle = only;
  return only == tool ||
         reading.refuse_at(tools.spindle_place, Code::tool_unknown, "T" + std::to_string(tool));
}

// LINUXCNC without D: the tool in the spindle. If the program has not named that tool, a radius
// that another word gave does not belong to it.
bool take_unnamed_tool(Reading& reading, const ProgramLine& line, BlockWords& block) {
  // No D word names it: D0 does not either.
  constexpr std::int64_t unnamed = 0;
  if (reading.gcode.tools.in_spindle != 0 || reading.state.setup().every_radius) return true;
  if (reading.has_one_radius())
    return take_only_register(reading, line, block, unnamed) ||
           refuse_selection(reading, line, block, Code::tool_unknown,
                            std::string(reason::tool_in_spindle));
  const bool is_of_another = !reading.gcode.tools.named && reading.state.tool().radius() &&
                             !reading.state.tool().is_of_setup(no_tool_number);
  return !is_of_another || refuse_selection(reading, line, block, Code::no_tool_radius,
                                            "G41 or G42 " + place_of(line.source));
}

// The tool of G41 and G42 without a word that names it.
bool take_tool_without_word(Reading& reading, const ProgramLine& line, BlockWords& block) {
  if (reading.dialect.name == DialectName::linuxcnc) return take_unnamed_tool(reading, line, block);
  return reading.dialect.name != DialectName::fanuc || take_only_spindle_tool(reading);
}

}  // namespace

bool check_gcode_selection(Reading& reading, ProgramLine& line, BlockWords& block) {
  const bool selects = block.selects();
  if (!check_what_may_be_skipped(reading, line, block)) return false;
  if (selects && !reading.gcode.coordinates.unfollowed.empty()) {
    const UnfollowedMode& mode = reading.gcode.coordinates.unfollowed.back();
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
  if (block.spindle.constant_cutting_speed) block.tools.d_word.reset();
  const std::optional<ToolSaid> said =
      selects ? take_tool_of_selection(reading, line, block) : ToolSaid::by_d;
  if (!said) return false;
  const Code of_missing = reading.gives_radii() ? Code::tool_unknown : Code::no_tool_radius;
  if (selects && !block.tools.d_word && !block.tools.radius && reading.gcode.tools.missing)
    return take_only_register(reading, line, block, *reading.gcode.tools.missing) ||
           reading.refuse_at(reading.gcode.tools.edge_place, of_missing,
                             "D" + std::to_string(*reading.gcode.tools.missing));
  if (!block.tools.d_word && !block.tools.radius)
    return !selects || take_tool_without_word(reading, line, block);
  if ((selects || reading.trc_active()) && reading.dialect.name != DialectName::sinumerik)
    for (WordRange& word : line.words)
      if (upper(line.text[word.begin]) == (said == ToolSaid::by_h ? 'H' : 'D') ||
          (gives_diameter(block) && upper(line.text[word.begin]) == 'L'))
        word.role = WordRole::trc;
  return !block.tools.d_word || check_tool_of_table(reading, line, block, *said);
}

std::optional<double> spindle_diameter(const Reading& reading) {
  if (reading.gcode.tools.in_spindle == 0 || reading.state.setup().every_radius)
    return std::nullopt;
  if (const auto row = reading.state.tool().row_of_tool(reading.gcode.tools.in_spindle))
    return 2 * (row->radius + row->wear);
  if (!reading.has_one_radius() || reading.state.setup().nominal_radius > 0) return std::nullopt;
  return 2 * (reading.state.setup().mode.tool_radius + reading.state.setup().wear);
}

bool take_only_register(Reading& reading, const ProgramLine& line, BlockWords& block,
                        std::int64_t number) {
  const bool is_of_spindle = reading.dialect.name == DialectName::fanuc &&
                             reading.gcode.tools.only_in_spindle.value_or(number) != number;
  if (!reading.has_one_radius() || is_of_spindle ||
      reading.gcode.tools.only_register.value_or(number) != number)
    return false;
  reading.gcode.tools.only_register = number;
  block.tools.only = block.tools.d_word ? block.tools.d_word->begin : begin_of_words(line);
  block.tools.d_word.reset();
  return true;
}

}  // namespace trc
