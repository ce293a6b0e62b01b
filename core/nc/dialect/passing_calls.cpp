#include "core/nc/dialect/passing_calls.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "core/messages/diagnostic_text.h"
#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/pass_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/characters.h"

// Lines that pass while TRC is off. In ISG (D-47): calls of subprograms, which are not followed,
// and assignments to variables that nothing here depends on. In the other dialects: calls that only
// the machine can execute (D-64).

namespace trc {
namespace {

constexpr std::string_view digits = "0123456789";

// An axis word in a line of another dialect: L X+10, L Z100.
bool is_axis_word(std::string_view name) {
  const std::size_t number = name.find_first_of("+-0123456789", 1);
  return number == 1 && name.find_first_not_of("+-.0123456789", 1) == std::string_view::npos;
}

// L NAME and LL NAME, of a file or in the program; L CYCLE [NAME=...]. Only a comment may follow.
bool calls_subprogram(std::string_view text) {
  std::size_t letters = 0;
  while (letters < text.size() && letters < 2 && upper(text[letters]) == 'L') ++letters;
  if (letters == 0 || blank_at_start(text.substr(letters)) == 0) return false;
  const std::string_view rest = without_blanks_in_front(text.substr(letters));
  const bool quoted = rest.starts_with('"');
  const std::size_t close = quoted ? rest.find('"', 1) : 0;
  if (close == std::string_view::npos) return false;
  const std::size_t end = std::min(rest.find_first_of(" \t[(;", close), rest.size());
  const std::string_view name = rest.substr(0, end);
  const std::string_view behind = without_blanks_in_front(rest.substr(end));
  return !name.empty() && !is_axis_word(name) &&
         (behind.empty() || std::string_view("[(;").find(behind.front()) != std::string_view::npos);
}

// G80 … G89, G800 … G819 call the subprograms that the control has for them, with the words of the
// line (D-113). With the words of a drilling cycle they count as ISG only if another word is of
// ISG.
bool calls_by_function(std::string_view text, bool isg_word_seen) {
  if (text.empty() || upper(text.front()) != 'G') return false;
  text = text.substr(0, text.find_first_of("(;"));
  const std::size_t end = std::min(text.find_first_not_of(digits, 1), text.size());
  const std::string_view number = text.substr(1, end - 1);
  const bool is_call = (number.size() == 2 && number[0] == '8') ||
                       (number.size() == 3 && number[0] == '8' && number[1] <= '1');
  const std::string_view behind = without_blanks_behind(text.substr(end));
  if (!is_call || behind.starts_with('.') || behind.starts_with('=')) return false;
  return behind.empty() || isg_word_seen;
}

// L CYCLE [NAME=DRILL.cyc MODAL_MOVE …]: the control executes the cycle after each motion.
bool begins_modal_cycle(std::string_view call) {
  const std::string words = in_upper_case(call);
  const std::size_t name = words.find_first_not_of(" \t", 1);
  return name != std::string::npos && words.compare(name, 5, "CYCLE") == 0 &&
         words.find("MODAL_") != std::string::npos;
}

// Whether words of a block are in or after the value of an assignment, as in V.P.A=5 G01 X9: they
// would pass as text and be lost. P1 is a variable, 1E5 a number, V.L.X1 a name.
bool holds_words(std::string_view value) {
  int brackets = 0;
  for (std::size_t at = 0; at < value.size() && value[at] != '(' && value[at] != ';'; ++at) {
    const char sign = upper(value[at]);
    const char next = at + 1 < value.size() ? upper(value[at + 1]) : ' ';
    if (sign == '[') ++brackets;
    if (sign == ']') --brackets;
    if (sign == '"') at = std::min(value.find('"', at + 1), value.size() - 1);
    const bool begins_name = is_letter(sign) && (is_letter(next) || next == '.' || next == '_');
    if (begins_name) {
      while (at + 1 < value.size() && (is_letter(value[at + 1]) || is_digit(value[at + 1]) ||
                                       value[at + 1] == '.' || value[at + 1] == '_'))
        ++at;
      continue;
    }
    const bool exponent = sign == 'E' && at > 0 && is_digit(value[at - 1]);
    const bool is_word = is_letter(sign) && sign != 'P' && !exponent && next != '[';
    if (brackets == 0 && (is_word || sign == '#' || sign == '$')) return true;
  }
  return false;
}

// What is assigned after a name: 3 of "= 3" and of "+= 3".
std::optional<std::string_view> assigned_value(std::string_view behind_name) {
  std::string_view value = without_blanks_in_front(behind_name);
  const bool changes = value.size() > 1 && value[1] == '=' &&
                       std::string_view("+-*/").find(value[0]) != std::string_view::npos;
  if (changes) value.remove_prefix(1);
  if (!value.starts_with('=')) return std::nullopt;
  return without_blanks_in_front(value.substr(1));
}

// V.P.DEPTH = 3, V.E.SUM += 2, P10 = 5, also declared between #VAR and #ENDVAR: V.P.DEPTH : REAL64.
// False for V.G., the tool in force, which gives the radius.
bool assigns_variable(std::string_view text) {
  const bool is_variable = text.size() >= 5 && upper(text[0]) == 'V' && text[1] == '.' &&
                           text[3] == '.' &&
                           std::string_view("PLSE").find(upper(text[2])) != std::string_view::npos;
  const bool is_parameter = text.size() > 2 && upper(text[0]) == 'P' && is_digit(text[1]);
  if (!is_variable && !is_parameter) return false;
  const std::size_t behind = std::min(text.find_first_of("=+-*/ \t(;:", 1), text.size());
  const bool is_number =
      text.substr(1, text.find('[') - 1).substr(0, behind - 1).find_first_not_of(digits) ==
      std::string_view::npos;
  if (is_parameter && !is_number) return false;  // P1.5
  const std::string_view rest = without_blanks_in_front(text.substr(behind));
  if (rest.empty() || rest.front() == ':') return is_variable || rest.starts_with(':');
  const auto value = assigned_value(rest);
  return value && !holds_words(*value);
}

// V.G.NP[1].V.X = 11, V.G.NP_AKT.ALL += V.G.NP[2].ALL (D-184).
bool writes_zero_offset(std::string_view text) {
  if (!begins_zero_offset(text)) return false;
  int brackets = 0;
  std::size_t at = 0;
  for (; at < text.size(); ++at) {
    const char sign = text[at];
    if (sign == '[') ++brackets;
    if (sign == ']') --brackets;
    const bool of_name = is_letter(sign) || is_digit(sign) || sign == '_' || sign == '.';
    if (brackets == 0 && !of_name && sign != ']') break;
  }
  const auto value = assigned_value(text.substr(at));
  if (!value || value->empty() || value->front() == '(' || value->front() == ';') return false;
  return !holds_words(*value);
}

// V.G.WZ[5].R = 4: a tool of the machine's table and its radius.
std::optional<std::pair<std::int64_t, double>> tool_data_of(std::string_view text) {
  constexpr std::string_view beginning = "V.G.WZ[";
  if (in_upper_case(text.substr(0, beginning.size())) != beginning) return {};
  double tool = 0;
  double radius = 0;
  bool whole = false;
  const std::size_t length = read_number(text.substr(beginning.size()), tool, whole);
  std::string_view behind = text.substr(beginning.size() + length);
  if (length == 0 || !is_number_of_tool(tool) || !in_upper_case(behind).starts_with("].R"))
    return {};
  behind = without_blanks_in_front(behind.substr(3));
  if (!behind.starts_with('=')) return {};
  behind = without_blanks_in_front(behind.substr(1));
  const std::size_t digits_of_radius = read_number(behind, radius, whole);
  behind = without_blanks_in_front(behind.substr(digits_of_radius));
  const bool is_over = behind.empty() || behind.front() == '(' || behind.front() == ';';
  if (digits_of_radius == 0 || !is_over) return {};
  return std::pair(static_cast<std::int64_t>(tool), radius);
}

// Whether pass_words declares that a call, which passes in any case, changes nothing: L NAME and
// LM06 of ISG by the name, with its extension or without, M98 P9020 and G65 P9020 of Fanuc as
// O9020.
bool changes_nothing(const ProgramSetup& setup, std::string_view call) {
  const bool fanuc = setup.dialect == DialectName::fanuc;
  if (!fanuc && setup.dialect != DialectName::isg) return false;
  const std::size_t begin = fanuc ? in_upper_case(call).find('P') : call.find_first_of(" \t");
  std::string_view name = begin == std::string_view::npos ? call : call.substr(begin);
  if (!fanuc) {
    const std::string file = called_file(name);
    return setup.pass_words.contains(file) || setup.pass_words.contains(word_to_pass(file, 0));
  }
  constexpr std::size_t digits_of_machine = 4;  // O8000 to O9999
  name = without_blanks_in_front(name.substr(std::min<std::size_t>(1, name.size())));
  name = name.substr(0, name.find_first_not_of(digits));
  return name.size() == digits_of_machine && name.front() >= '8' &&
         setup.pass_words.contains("O" + std::string(name));
}

}  // namespace

bool read_passing_line(Reading& reading, ProgramLine& line, BlockWords& block) {
  const std::string_view text = line.text;
  std::size_t begin = 0;
  const auto skip_blanks = [&] {
    while (const std::size_t blank = blank_at_start(text.substr(begin))) begin += blank;
  };
  skip_blanks();
  if (begin < text.size() && upper(text[begin]) == 'N') {
    const std::size_t number = begin + 1;
    const std::size_t behind = std::min(text.find_first_not_of(digits, number), text.size());
    constexpr std::size_t most_digits = 9;
    if (behind == number || behind - number > most_digits) return false;
    line.source.number = std::stoll(std::string(text.substr(number, behind - number)));
    begin = behind;
    skip_blanks();
  }
  const std::string_view words = text.substr(begin);
  const bool calls_alone = calls_subprogram(words);
  // In a program that computes, the values that such a subprogram reads are not written before it.
  const bool calls =
      calls_alone || (!reading.reads_flat && calls_by_function(words, reading.isg_word_seen));
  const auto tool = tool_data_of(words);
  if (tool)
    block.tools.edges.push_back({.row = tool->first,
                                 .length = tool->second * reading.length_unit(),
                                 .begin = static_cast<std::uint32_t>(begin)});
  const bool shifts = writes_zero_offset(words);
  const bool passes = (calls || tool || shifts || assigns_variable(words)) &&
                      first_byte_that_is_no_text(text) == std::string_view::npos;
  if (!passes) {
    line.source.number = Source::no_number;
    return false;
  }
  reading.isg_word_seen |= !calls || calls_alone;
  line.words.push_back({.begin = static_cast<std::uint32_t>(begin),
                        .end = static_cast<std::uint32_t>(text.size()),
                        .role = WordRole::technology});
  if (shifts) {
    block.forget = all_axes;
    reading.gcode.coordinates.work_offset = 0;
  }
  if (!calls) return true;
  const std::string_view call = words.substr(0, words.find_first_of("(;"));
  if (begins_modal_cycle(call)) reading.gcode.calls.modal_cycle = line.source;
  forget_what_a_call_may_change(reading, line, block, call);
  return true;
}

bool read_call_behind_words(Reading& reading, std::uint32_t begin, ProgramLine& line,
                            BlockWords& block) {
  const std::string_view text = line.text;
  if (begin + 2 >= text.size()) return false;
  std::size_t end = begin + 1;
  const auto is_part_of_name = [](char sign) {
    return is_letter(sign) || is_digit(sign) || sign == '_' || sign == '.';
  };
  while (end < text.size() && is_part_of_name(text[end])) ++end;
  const bool is_call = reading.dialect.name == DialectName::isg && upper(text[begin]) == 'L' &&
                       end > begin + 2 && is_letter(text[begin + 1]) &&
                       without_blanks_in_front(text.substr(end)).empty();
  if (!is_call || reading.contour_open() || block.axis || block.center) return false;
  line.words.push_back(
      {.begin = begin, .end = static_cast<std::uint32_t>(end), .role = WordRole::technology});
  // T5 LM06 changes tools as M06 does (D-76).
  const bool dimension_was_known = !reading.called_dimension;
  const bool had_unknown_call = reading.gcode.calls.unknown.has_value();
  forget_what_a_call_may_change(reading, line, block, text.substr(begin, end - begin));
  if (block.tools.t_word && dimension_was_known) reading.called_dimension = false;
  if (block.tools.t_word && !had_unknown_call) reading.gcode.calls.unknown.reset();
  return true;
}

bool read_call_of_machine(Reading& reading, ProgramLine& line, BlockWords& block) {
  const std::string_view text = line.text;
  const auto behind_blanks = [&](std::size_t at) {
    return text.size() - without_blanks_in_front(text.substr(at)).size();
  };
  std::size_t begin = behind_blanks(0);
  const std::size_t number = begin;
  if (begin < text.size() && upper(text[begin]) == 'N') {
    begin = behind_blanks(std::min(text.find_first_not_of(digits, begin + 1), text.size()));
    line.words.push_back({.begin = static_cast<std::uint32_t>(number),
                          .end = static_cast<std::uint32_t>(begin),
                          .role = WordRole::number});
  }
  const char comment = reading.dialect.name == DialectName::sinumerik ? ';' : '(';
  const std::string_view call =
      without_blanks_behind(text.substr(begin, text.find(comment, begin) - begin));
  if (reading.contour_open())
    return reading.refuse(line,
                          TextFault{.code = Code::nc_unsupported,
                                    .begin = static_cast<std::uint32_t>(begin),
                                    .detail = std::string(call) +
                                              ", a call of what only the machine has while TRC is "
                                              "active"});
  if (const std::size_t place = place_of_side(text); place != std::string_view::npos)
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = static_cast<std::uint32_t>(place),
                        .detail = "TRC in a line that calls what only the machine has"});
  line.words.push_back({.begin = static_cast<std::uint32_t>(begin),
                        .end = static_cast<std::uint32_t>(begin + call.size()),
                        .role = WordRole::technology});
  if (begin + call.size() < text.size())
    line.words.push_back({.begin = static_cast<std::uint32_t>(begin + call.size()),
                          .end = static_cast<std::uint32_t>(text.size()),
                          .role = WordRole::comment});
  forget_what_a_call_may_change(reading, line, block, call);
  return true;
}

void forget_what_a_call_may_change(Reading& reading, ProgramLine& line, BlockWords& block,
                                   std::string_view call) {
  line.calls_the_machine = true;
  line.feed_it_takes = reading.feed_mode == 94 ? reading.feed : 0;
  take_call(reading, line, call);
  const bool isg = reading.dialect.name == DialectName::isg;
  if (isg && changes_nothing(reading.state.setup(), call)) return;
  // The call after a T word changes the tool.
  if (isg && !reading.gcode.calls.unknown &&
      !std::exchange(reading.gcode.calls.awaited_by_tool, false))
    reading.gcode.calls.unknown = reading.gcode.calls.last;
  block.forget = all_axes;
  reading.gcode.coordinates.work_offset = 0;
  reading.called_motion = reading.called_dimension = true;
  reading.reads_plain_lines = false;
}

void take_call(Reading& reading, const ProgramLine& line, std::string_view call) {
  reading.gcode.calls.last = without_blanks_behind(call);
  reading.gcode.calls.place = {.source = line.source};
  if (changes_nothing(reading.state.setup(), call)) return;
  reading.gcode.calls.behind_contour = true;
  // A radius that the program has set belongs to the tool before a change.
  if (reading.gcode.calls.only_radius_said) reading.gcode.calls.tool_said = false;
  reading.gcode.calls.radius_doubtful |= std::exchange(reading.gcode.calls.only_radius_said, false);
}

bool restate_modes(Reading& reading, ProgramLine& line, BlockWords& block) {
  if (!reading.called_motion && !reading.called_dimension) return true;
  reading.called_motion = reading.called_motion && !block.has(GGroup::motion);
  reading.called_dimension = reading.called_dimension && !block.has(GGroup::dimension);
  if (!reading.called_motion && !reading.called_dimension) {
    reading.reads_plain_lines = reading.faults.empty();
    return true;
  }
  if (reading.contour_open() || !(block.axis || block.center)) return true;
  const bool selects = block.selects();
  if (selects && reading.machine_follows) {  // refused for that reason elsewhere
    block.forget = all_axes;
    return true;
  }
  if (selects)
    return reading.refuse(
        line,
        TextFault{.code = Code::position_unknown,
                  .begin = block.of(GGroup::side).begin,
                  .detail = std::string(reading.called_dimension ? "G90 or G91" : "G00 or G01") +
                            ", which was not programmed anew after " + reading.gcode.calls.last +
                            " " + place_of(reading.gcode.calls.place.source)});
  block.copied = true;
  block.forget = all_axes;
  for (WordRange& word : line.words)
    if (word.role == WordRole::coordinate) word.role = WordRole::technology;
  return true;
}

bool watch_tool(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  // D of Sinumerik is an edge of the current tool.
  const bool names_radius = block.tools.d_word && reading.dialect.name != DialectName::sinumerik;
  reading.gcode.calls.tool_said |= block.tools.t_word || block.tools.loads ||
                                   block.tools.q_word_names_tool || names_radius ||
                                   block.tools.radius;
  if (block.tools.t_word || block.tools.d_word || block.tools.loads ||
      block.tools.q_word_names_tool) {
    reading.gcode.calls.only_radius_said = reading.gcode.calls.radius_doubtful = false;
  } else if (block.tools.radius && reading.dialect.name == DialectName::isg) {
    reading.gcode.calls.only_radius_said = true;
    reading.gcode.calls.radius_doubtful = false;
  }
  if (reading.dialect.name == DialectName::isg && block.tools.t_word) {
    reading.gcode.tools.next = register_number(block.tools.t_word->value);
    reading.gcode.tools.next_place = reading.place_of_word(line, block.tools.t_word->begin);
    reading.gcode.calls.awaited_by_tool = !block.tools.change;
  }
  const bool selects = block.selects();
  if (!selects || reading.trc_active()) return true;
  const std::uint32_t begin = block.of(GGroup::side).begin;
  if (reading.gcode.calls.modal_cycle)
    return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                          .begin = begin,
                                          .detail = "TRC under a modal cycle of the machine, " +
                                                    place_of(*reading.gcode.calls.modal_cycle)});
  return warn_of_other_tool(reading, line, begin);
}

bool warn_of_other_tool(Reading& reading, const ProgramLine& line, std::uint32_t begin) {
  const bool may_be_another =
      (reading.gcode.calls.contour_seen || reading.gcode.calls.radius_doubtful) &&
      reading.gcode.calls.behind_contour && !reading.gcode.calls.tool_said;
  reading.gcode.calls.contour_seen = true;
  reading.gcode.calls.behind_contour = reading.gcode.calls.tool_said =
      reading.gcode.calls.radius_doubtful = false;
  std::string change = reading.gcode.calls.last + " " + place_of(reading.gcode.calls.place.source);
  bool is_another = false;
  // Other dialects refuse a second tool without its own radius.
  if (reading.dialect.name == DialectName::isg &&
      reading.state.tool().is_of_setup(reading.gcode.tools.next)) {
    const std::int64_t before =
        reading.gcode.tools.only_in_spindle.value_or(reading.gcode.tools.next);
    is_another = before != reading.gcode.tools.next;
    reading.gcode.tools.only_in_spindle = reading.gcode.tools.next;
    if (is_another)
      change = "T" + std::to_string(reading.gcode.tools.next) + " " +
               place_of(reading.gcode.tools.next_place.source);
  }
  if ((!may_be_another && !is_another) || !reading.faults.empty()) return true;
  Diagnostic warned = diagnostic(Code::tool_may_have_changed, line.source, std::move(change));
  warned.column = reading.place_of_word(line, begin).column;
  return reading.diagnostics.report(std::move(warned));
}

bool note_unknown_call(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  const bool selects = block.selects() && !reading.trc_active();
  if (!selects || !reading.gcode.calls.unknown || reading.gcode.calls.unknown->empty() ||
      !reading.faults.empty())
    return true;
  Diagnostic noted = diagnostic(Code::call_taken_as_harmless, line.source,
                                std::exchange(*reading.gcode.calls.unknown, std::string()));
  noted.column = reading.place_of_word(line, block.of(GGroup::side).begin).column;
  return reading.diagnostics.report(std::move(noted));
}

}  // namespace trc
