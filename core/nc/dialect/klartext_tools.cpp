#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/klartext_block.h"
#include "core/nc/text/characters.h"

// TOOL CALL and TOOL DEF of Klartext, and the radius that RL and RR take from them.

namespace trc {
namespace {

// The words of a statement, one after the other.
class Words {
 public:
  explicit Words(std::string_view statement) : rest_(statement) {}
  // Empty: no more.
  [[nodiscard]] std::string_view next() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find(' '));
    rest_.remove_prefix(word.size());
    return word;
  }

 private:
  std::string_view rest_;
};

bool is_number(std::string_view word, double& value) {
  bool whole = false;
  return !word.empty() && read_number(word, value, whole) == word.size();
}

// Also with the decimal comma that older controls write.
bool is_number_of_any_sign(std::string_view word, double& value) {
  std::string number(word);
  std::ranges::replace(number, ',', '.');
  return is_number(number, value);
}

// DR2 is the radius of a corner of the tool.
bool is_corner_radius(std::string_view word) {
  return word.starts_with("DR2") && (word.size() == 3 || word.find_first_of("+-:") == 3);
}

struct CalledTool {
  bool named = false;
  std::int64_t number = 0;  // as row_of_edge() has it, unless it has a name
  std::string name{};       // in quotes, or a parameter
};

// The tool of TOOL CALL, which begins at `begin` of the line; `word` is its first word and becomes
// the one behind the tool. Nothing where quotes are not closed.
std::optional<CalledTool> read_called_tool(
    const std::string& line, std::size_t begin, std::string_view& word, Words& words,
    const std::map<std::string, double, std::less<>>& parameters) {
  CalledTool called;
  double value = 0;
  if (is_number(word, value)) {
    called.named = true;
    const double index = std::round(10 * value) - 10 * std::floor(value);
    called.number = row_of_edge(static_cast<std::int64_t>(std::floor(value)),
                                static_cast<std::int64_t>(index) + 1);
    word = words.next();
    return called;
  }
  if (const auto known = parameters.find(word); known != parameters.end()) {
    if (!is_number_of_tool(known->second)) return {};
    word = words.next();
    return CalledTool{.named = true, .number = static_cast<std::int64_t>(known->second)};
  }
  const bool quoted = word.starts_with('"');
  if (!quoted && !word.starts_with('Q')) return called;
  const std::size_t open = line.find(word[0], begin + 9);
  const std::size_t close =
      quoted && open != std::string::npos ? line.find('"', open + 1) : open + word.size();
  if (open == std::string::npos || close == std::string::npos) return {};
  const std::size_t first = quoted ? open + 1 : open;
  called = {.named = true, .number = no_tool_number, .name = line.substr(first, close - first)};
  while (word.find('"', 1) == std::string_view::npos && word.starts_with('"')) {
    const std::string_view more = words.next();
    if (more.empty() || more.ends_with('"')) break;
  }
  word = words.next();
  return called;
}

}  // namespace

bool Interpreter::read_tool_call(ProgramLine& line, std::size_t begin, std::string_view statement) {
  Words words(statement);
  (void)words.next();
  (void)words.next();
  std::string_view word = words.next();
  const auto wrong = [&](std::string_view which) {
    return refuse_klartext(line, begin, std::string(which).append(" of TOOL CALL"),
                           Code::nc_number);
  };
  KlartextModes& modes = klartext_;
  const std::optional<CalledTool> called =
      read_called_tool(line.text, begin, word, words, modes.parameters);
  if (!called) return wrong(word);
  Plane plane = state_.mode().plane;
  double delta = 0;
  std::string open_delta;
  std::optional<double> feed;
  bool changes_delta = false;
  double value = 0;
  for (; !word.empty(); word = words.next()) {
    if (word == "Z") plane = Plane::xy;
    if (word == "Y") plane = Plane::zx;
    if (word == "X") plane = Plane::yz;
    if (word.starts_with("DR") && !is_corner_radius(word)) {
      if (!read_radius_delta(word, delta, open_delta)) return wrong(word);
      changes_delta = true;
    } else if (word.starts_with('F') && is_number(word.substr(1), value)) {
      feed = value;
    }
  }
  if (trc_active() && (called->named || changes_delta))
    return refuse_klartext(line, begin, "TOOL CALL while TRC is active");
  const bool changes_radius = called->named || changes_delta;
  if (changes_radius && !take_tool_of_label(line, begin)) return false;
  if (!faults_.empty()) return false;
  if (called->named) {
    modes.calls_behind_tool.clear();
    modes.tool_of_label = 0;
  }
  // It holds from here on, not only for F AUTO.
  if (feed) feed_ = modes.called_feed = *feed * (inch_ ? mm_per_inch / 10 : 1);
  if (called->named) {
    modes.tool_name = called->name;
    modes.tool_place = place_of_word(line, static_cast<std::uint32_t>(begin));
    modes.tool = called->name.empty() ? called->number : state_.tool().tool_named(called->name);
    modes.modal_cycle = false;
    modes.radius_delta = 0;
    modes.open_delta.clear();
    code_.tool_said = true;
    std::array<bool, 3> third{};
    third[axes_of(plane).third] = true;
    state_.forget_position(third, line.source);
  }
  if (changes_delta) {
    modes.radius_delta = delta * length_unit();
    modes.open_delta = std::move(open_delta);
  }
  if (plane != state_.mode().plane) {
    modes.pole.reset();
    modes.tangent.reset();
    line.klartext.emplace().loses_pole = true;
    if (!state_.set_plane(plane, line.source)) return false;
  }
  const bool goes_on = copy_klartext(line, begin, WordRole::technology);
  if (feed) line.roles |= bit(WordRole::feed);
  return goes_on;
}

// DR-0.05, DR+Q5.
bool Interpreter::read_radius_delta(std::string_view word, double& delta,
                                    std::string& open_delta) const {
  const std::string_view value = word.substr(2);
  if (is_number_of_any_sign(value, delta)) return true;
  const bool negative = value.starts_with('-');
  const std::string_view name = value.substr(negative || value.starts_with('+') ? 1 : 0);
  if (!name.starts_with('Q')) return false;
  const auto known = klartext_.parameters.find(name);
  if (known == klartext_.parameters.end())
    open_delta = word;
  else
    delta = negative ? -known->second : known->second;
  return true;
}

// Q5 = +0.05, FN 0: Q5 = +0.05 (D-79). What is computed, read from the machine or may be skipped is
// not followed.
void Interpreter::take_assignment(const ProgramLine& line, std::string_view statement) {
  const std::size_t equals = statement.find('=');
  if (equals == std::string_view::npos) return;
  std::string_view name = without_blanks_behind(statement.substr(0, equals));
  name.remove_prefix(name.find_last_of(" :") + 1);
  if (const auto known = klartext_.parameters.find(name); known != klartext_.parameters.end())
    klartext_.parameters.erase(known);
  const bool may_be_skipped = std::ranges::any_of(
      line.words, [&](const WordRange& word) { return line.word(word) == "/"; });
  double number = 0;
  if (!may_be_skipped && name.starts_with('Q') &&
      is_number_of_any_sign(without_blanks_in_front(statement.substr(equals + 1)), number))
    klartext_.parameters.emplace(name, number);
}

// Cycles set the parameters they are given and others that they measure; programs set any.
void Interpreter::forget_parameters(std::string_view statement) {
  const bool defines = begins_with_word(statement, "CYCL DEF");
  if (!defines && (begins_with_word(statement, "CALL") || begins_with_word(statement, "CYCL") ||
                   begins_with_word(statement, "TCH") || begins_with_word(statement, "PGM")))
    klartext_.parameters.clear();
  if (defines)
    std::erase_if(klartext_.parameters, [&](const auto& known) {
      return statement.find(known.first + "=") != std::string_view::npos ||
             statement.find(known.first + " =") != std::string_view::npos;
    });
}

// TOOL DEF 5 L+0 R+4 gives a tool its radius; TOOL DEF 5 prepares it.
bool Interpreter::read_tool_definition(ProgramLine& line, std::size_t begin,
                                       std::string_view statement) {
  Words words(statement);
  (void)words.next();
  (void)words.next();
  double number = 0;
  double radius = 0;
  const bool has_number = is_number(words.next(), number);
  for (std::string_view word = words.next(); !word.empty(); word = words.next())
    if (has_number && is_whole(number) && word.starts_with('R') &&
        is_number(word.substr(1), radius) && faults_.empty() &&
        !state_.define_tool(static_cast<std::int64_t>(number), radius * length_unit(), line.source))
      return false;
  return copy_klartext(line, begin, WordRole::technology);
}

// R + DR + DR: radius and wear of the tool in the table, or the radius of TOOL DEF, and the
// allowance of TOOL CALL.
bool Interpreter::choose_called_tool(const ProgramLine& line, std::size_t begin) {
  KlartextModes& modes = klartext_;
  if (!modes.tool) return true;
  const ProgramSetup& setup = state_.setup();
  const auto unknown = [&](const std::string& tool) {
    return refuse_at(modes.tool_place, Code::tool_unknown, tool);
  };
  const auto number_text = [&](std::int64_t tool) {
    if (tool <= no_tool_number) return name_not_in_table(modes.tool_name);
    const std::int64_t index = edge_of_row(tool) - 1;
    const std::string number = std::to_string(tool - row_of_edge(0, index + 1));
    return index > 0 ? number + "." + std::to_string(index) : number;
  };
  place(line, static_cast<std::uint32_t>(begin));
  if (!modes.open_delta.empty())
    return refuse_at(modes.tool_place, Code::nc_unsupported,
                     modes.open_delta + " of TOOL CALL, a variable");
  if (*modes.tool == 0) return state_.set_tool(0, line.source);
  std::optional<ToolRow> row = state_.tool().row_of_tool(*modes.tool);
  // The radius of the setup stands for the one tool that the program selects with.
  if (!row && setup.tools.empty() && setup.mode.tool_radius != 0) {
    const std::int64_t number = *modes.tool;
    if (modes.only_tool_name.empty()) modes.only_tool_name = modes.tool_name;
    if (code_.only_register.value_or(number) != number || modes.only_tool_name != modes.tool_name)
      return unknown(number_text(number));
    code_.only_register = number;
    row = ToolRow(setup.mode.tool_radius, setup.wear);
  }
  if (!row && !setup.tools.empty()) return unknown(number_text(*modes.tool));
  if (!row) return true;  // nobody has given one, or it is 0
  if (row->radius + row->wear + modes.radius_delta < 0)
    return refuse_klartext(line, begin, "R + DR of TOOL CALL is less than 0",
                           Code::tool_radius_out_of_range);
  return state_.call_tool(*row, line.source) &&
         state_.set_allowance_of_program(modes.radius_delta, line.source);
}

bool Interpreter::select_in_klartext(const ProgramLine& line, Side side, std::size_t begin) {
  if (side != Side::off && code_.skipped_tool > 0)
    return refuse_klartext(
        line, begin,
        "TRC behind what may be skipped, in line " + std::to_string(code_.skipped_tool),
        Code::block_skip_undecided);
  if (klartext_.unfollowed != 0)
    return refuse_klartext(line, begin,
                           "RL, RR while coordinates are scaled or the tool tip is led");
  if (klartext_.called_section != 0)
    return refuse_klartext(
        line, begin,
        "RL, RR in a section that line " + std::to_string(klartext_.called_section) + " calls");
  if (klartext_.cycle_section != 0)
    return refuse_klartext(line, begin,
                           "RL, RR in the contour of the cycles of line " +
                               std::to_string(klartext_.cycle_section) +
                               ", in front of the end of the program");
  if (klartext_.tool_of_label != 0)
    return refuse_klartext(line, begin,
                           "RL, RR with the tool of the section that line " +
                               std::to_string(klartext_.tool_of_label) + " calls");
  klartext_.calls_of_contours.merge(klartext_.calls_behind_tool);
  if (!trc_active()) {
    ++klartext_.contours;
    const auto place_of_side = static_cast<std::uint32_t>(begin);
    if (!choose_called_tool(line, begin) || !warn_of_other_tool(line, place_of_side)) return false;
  }
  place(line, static_cast<std::uint32_t>(begin));
  return state_.select(side, line.source);
}

}  // namespace trc
