#include "core/nc/dialect/isg_command.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/pass_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/dialect/trc_command.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/number_format.h"

// Commands of ISG: the words that begin with `#`.

namespace trc {
namespace {

// The words after `#`, upper case, joined by one blank: at most two.
std::string command_name(std::string_view command) {
  std::string name;
  std::size_t at = 1;
  for (int part = 0; part < 2; ++part) {
    while (const std::size_t blank = blank_at_start(command.substr(at))) at += blank;
    if (part > 0) name += ' ';
    for (; at < command.size(); ++at) {
      const char letter = upper(command[at]);
      if ((letter < 'A' || letter > 'Z') && letter != '_') break;
      name += letter;
    }
  }
  return name;
}

// What becomes of a command while TRC is off. What stays in effect after the line and is no line,
// as loops, is refused.
enum class WhileOff { passes, unfollowed, refused };

struct ForbiddenCommand {
  std::string_view name;
  Code while_active;
  WhileOff while_off = WhileOff::unfollowed;
};

// Rule 1.11.
constexpr auto forbidden_commands = std::to_array<ForbiddenCommand>({
    {"CS ", Code::coordinate_system_while_active},
    {"ACS ", Code::coordinate_system_while_active},
    {"MCS ", Code::coordinate_system_while_active},
    {"AX LINK", Code::axis_link_while_active},
    {"ENABLE AX", Code::axis_link_while_active},
    {"DISABLE AX", Code::axis_link_while_active},
    {"PSET ", Code::preset_while_active},
    {"PRESET ", Code::preset_while_active},
    {"PTP OFF", Code::point_to_point_while_active, WhileOff::passes},
    {"PTP ", Code::point_to_point_while_active, WhileOff::refused},
    {"CONTOUR BEGIN", Code::nc_unsupported, WhileOff::passes},
    {"CONTOUR END", Code::nc_unsupported, WhileOff::passes},
    {"RT WHILE", Code::real_time_loop_while_active, WhileOff::refused},
});

// Commands that do not affect the path.
constexpr auto passing_commands = std::to_array<std::string_view>(
    {"MSG ",        "FLUSH ",     "SLOPE ",    "CONTOUR MODE", "HSC ",        "TRANSVELLIM ",
     "VECTOR ",     "FILTER ",    "FRICTION ", "OVERRIDE ",    "TIMER ",      "WAIT ",
     "SIGNAL ",     "ERROR ",     "FILE ",     "TOOL LIFE",    "SINGLESTEP ", "SET SLOPE",
     "SET ASPLINE", "SPLINE OFF", "VAR ",      "ENDVAR ",      "DELETE "});

// After these commands only the control knows the position or the zero point of an axis.
constexpr auto unfollowed_commands = std::to_array<std::string_view>(
    {"RTCP ", "TLC ", "KIN ", "WCS ", "ECS ", "BCS ", "CALL AX", "PUT AX", "SET AX", "GANTRY ",
     "CHANNEL ", "HANDWHEEL", "TRAFO OFF", "ROTATION "});

// Where a word of the block begins after a command: its motion would pass as text. Names of the
// command and text in brackets or quotes belong to the command; variables are values.
std::size_t word_behind_command(std::string_view command) {
  std::size_t depth = 0;
  bool is_over = false;
  for (std::size_t at = 1; at < command.size();) {
    const char sign = command[at];
    if (sign == '"') {
      at = std::min(command.find('"', at + 1), command.size() - 1) + 1;
      continue;
    }
    if (sign == '[') ++depth;
    if (sign == ']' && depth > 0) is_over = --depth == 0;
    if (depth > 0 || (!is_letter(sign) && sign != '$' && sign != '#')) {
      ++at;
      continue;
    }
    const std::size_t begin = at;
    while (at < command.size() && (is_letter(command[at]) || command[at] == '_')) ++at;
    const bool has_digit = at < command.size() && is_digit(command[at]);
    if (upper(sign) == 'V' && at == begin + 1 && at < command.size() && command[at] == '.') {
      while (at < command.size() && (is_letter(command[at]) || is_digit(command[at]) ||
                                     command[at] == '_' || command[at] == '.'))
        ++at;
      continue;
    }
    const bool is_parameter = upper(sign) == 'P' && at == begin + 1 && has_digit;
    const bool is_call = at == begin + 2 && upper(sign) == 'L' && upper(command[begin + 1]) == 'L';
    if (is_over || is_call || at < begin + 2 || has_digit) {
      if (!is_parameter || is_over) return begin;
    }
  }
  return std::string_view::npos;
}

// The values of these commands are axis words.
bool holds_axis_words(std::string_view name) {
  return name.starts_with("PSET ") || name.starts_with("PRESET ");
}

bool begins_with_any(std::string_view name, std::span<const std::string_view> beginnings) {
  return std::ranges::any_of(beginnings,
                             [&](std::string_view begin) { return name.starts_with(begin); });
}

// #TIME 1.5
bool is_time(std::string_view command) {
  double time = 0;
  bool whole = false;
  const std::size_t begin = command.find_first_of("0123456789.+-");
  if (begin == std::string_view::npos) return false;
  const std::size_t length = read_number(command.substr(begin), time, whole);
  return length > 0 && begin + length == command.size();
}

// Off the contour a command that changes the coordinates passes, and the position becomes unknown.
bool copy_unfollowed_command(Reading& reading, const Word& word, std::string_view name,
                             ProgramLine& line, BlockWords& block) {
  const auto forbidden = std::ranges::find_if(
      forbidden_commands, [&](const auto& candidate) { return name.starts_with(candidate.name); });
  const bool is_forbidden = forbidden != forbidden_commands.end();
  const WhileOff while_off = is_forbidden                                 ? forbidden->while_off
                             : begins_with_any(name, unfollowed_commands) ? WhileOff::unfollowed
                                                                          : WhileOff::refused;
  if (while_off != WhileOff::refused && !reading.contour_open()) {
    if (while_off == WhileOff::unfollowed) block.forget = all_axes;
    add(line, word, WordRole::technology);
    return true;
  }
  const bool is_published = is_forbidden && reading.contour_open();
  return reading.refuse(line, word, is_published ? forbidden->while_active : Code::nc_unsupported);
}

}  // namespace

bool read_command(Reading& reading, const Word& word, ProgramLine& line, BlockWords& block) {
  const std::string_view command = line.word({.begin = word.begin, .end = word.end});
  const std::string name = command_name(command);
  reading.isg_word_seen |= !name.empty() && name != " ";
  block.isg.command = word.begin;
  block.isg.has_command = true;
  const auto wrong = [&](TextFault fault) {
    fault.begin += word.begin;
    return reading.refuse(line, fault);
  };
  if (name.starts_with("TRC ")) {
    block.isg.options = reading.state.mode().options;
    if (auto fault = read_trc_command(command, *block.isg.options)) return wrong(std::move(*fault));
    add(line, word, WordRole::trc);
    return true;
  }
  if (name.starts_with("TANGFEED ") || name == "SET TANGFEED") {
    block.isg.tangfeed = 0;
    if (auto fault = read_tangfeed_command(command, *block.isg.tangfeed))
      return wrong(std::move(*fault));
    add(line, word, WordRole::trc);
    return true;
  }
  // Before the words of the motion in whose block it stands.
  if (name == "SUPPRESS OFFSETS") {
    block.isg.has_command = false;
    block.isg.suppresses = word.begin;
    add(line, word, WordRole::technology);
    return true;
  }
  // Beside the words of a motion, before the corner that they cut, and the feed there.
  if (name == "CHR " || name == "RND " || name == "FRC ") {
    block.isg.has_command = false;
    block.isg.corner = std::string(command).append(name == "CHR " ? ", chamfer" : ", rounding");
    block.isg.corner_begin = word.begin;
    add(line, word, WordRole::technology);
    return true;
  }
  if (name == "COMMENT BEGIN") {
    reading.comment_block = line.source.line;
    add(line, word, WordRole::comment);
    return true;
  }
  if (const std::size_t behind = word_behind_command(command);
      behind != std::string_view::npos && !holds_axis_words(name))
    return wrong(
        {.begin = static_cast<std::uint32_t>(behind), .detail = "a word after a # command"});
  if (name == "TIME " && !is_time(command)) return reading.refuse(line, word, Code::nc_number);
  if (name == "CONTOUR BEGIN" || name == "CONTOUR END")
    block.isg.cycle_contour = name == "CONTOUR BEGIN";
  if (name == "DISABLE MODAL") reading.gcode.calls.modal_cycle.reset();
  const bool passes = name == "TIME " || name == "DISABLE MODAL" ||
                      begins_with_any(name, passing_commands) ||
                      passes_word(reading.state.setup(), command, 0);
  if (!passes) return copy_unfollowed_command(reading, word, name, line, block);
  add(line, word, WordRole::technology);
  return true;
}

bool read_comment_block(Reading& reading, ProgramLine& line) {
  const std::size_t sign = line.text.find('#');
  if (sign == std::string::npos) return true;
  const std::string name = command_name(std::string_view(line.text).substr(sign));
  const auto begin = static_cast<std::uint32_t>(sign);
  if (name == "COMMENT BEGIN")
    return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                          .begin = begin,
                                          .detail = "#COMMENT BEGIN within a comment"});
  if (name == "COMMENT END") reading.comment_block = 0;
  return true;
}

}  // namespace trc
