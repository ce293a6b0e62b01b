#include "core/nc/dialect/klartext_statements.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "core/base/length_unit.h"
#include "core/nc/dialect/apply_block.h"
#include "core/nc/dialect/heidenhain.h"
#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/klartext_effects.h"
#include "core/nc/dialect/klartext_labels.h"
#include "core/nc/dialect/klartext_programs.h"
#include "core/nc/dialect/klartext_tools.h"
#include "core/nc/dialect/left_contour.h"
#include "core/nc/dialect/pass_words.h"
#include "core/nc/dialect/passing_calls.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/klartext_words.h"

// Statements of Klartext without motion: statements that pass, statements that move the machine,
// labels and calls.

namespace trc {
namespace {

using Kind = KlartextWord::Kind;

// Statements that neither move an axis nor change the meaning of coordinates.
constexpr auto passing = std::to_array<std::string_view>({"BLK",
                                                          "STOP",
                                                          "OPEN",
                                                          "SEL",
                                                          "POLARKIN",
                                                          "STRETCH",
                                                          "WRITE",
                                                          "CYCL DEF",
                                                          "GLOBAL DEF",
                                                          "PATTERN DEF",
                                                          "CONTOUR DEF",
                                                          "FILE",
                                                          "FUNCTION FILE",
                                                          "MONITORING",
                                                          "SECTION MONITORING",
                                                          "FUNCTION MODE MILL",
                                                          "FUNCTION FEED",
                                                          "FUNCTION S-PULSE",
                                                          "FUNCTION DWELL",
                                                          "FUNCTION COUNT"});

// Statements after which only the control knows the position of the axes.
constexpr auto moving = std::to_array<std::string_view>(
    {"CYCL CALL", "CALL", "PGM",  "PLANE",    "TRANS",  "FUNCTION", "LN",      "FL",      "FLT",
     "FC",        "FCT",  "FPOL", "FSELECT",  "SPL",    "SPC",      "PATTERN", "CONTOUR", "X",
     "Y",         "Z",    "A",    "B",        "C",      "U",        "V",       "W",       "IX",
     "IY",        "IZ",   "G",    "TCHPROBE", "PRESET", "TCH"});

// Blocks of contours that are not followed: lines in space, free contours, splines.
constexpr auto contour_blocks =
    std::to_array<std::string_view>({"LN", "FL", "FLT", "FC", "FCT", "FPOL", "SPL", "SPC"});

// Cycles that change the meaning of coordinates, or move, as soon as they are defined. A pattern
// runs the cycle defined last (D-115).
constexpr auto cycles_at_once = std::to_array<std::string_view>(
    {"7", "8", "10", "11", "12", "19", "26", "220", "221", "224", "239", "247"});

bool acts_at_once(std::string_view statement) {
  constexpr std::string_view head = "CYCL DEF ";
  if (!statement.starts_with(head)) return false;
  std::string_view number = statement.substr(head.size());
  number = number.substr(0, std::min(number.find_first_not_of("0123456789"), number.size()));
  return std::ranges::find(cycles_at_once, number) != cycles_at_once.end();
}

bool is_any(std::string_view statement, std::span<const std::string_view> words) {
  return std::ranges::any_of(words,
                             [&](std::string_view w) { return begins_with_word(statement, w); });
}

bool ends_word(std::string_view statement, std::size_t at) {
  return at == statement.size() || statement[at] == ' ';
}

bool assigns(std::string_view statement) {
  return begins_with_word(statement, "FN") || begins_with_word(statement, "Q") ||
         begins_with_word(statement, "QL") || begins_with_word(statement, "QR") ||
         begins_with_word(statement, "QS") || begins_with_word(statement, "DECLARE");
}

// A line of PATTERN DEF: POS1( X+25 Y+33.5 Z+0 ).
bool is_of_pattern(std::string_view statement) {
  constexpr auto names =
      std::to_array<std::string_view>({"POS", "ROW", "PAT", "FRAME", "CIRC", "PITCHCIRC"});
  return std::ranges::any_of(names, [&](std::string_view name) {
    if (!statement.starts_with(name)) return false;
    const std::size_t end = statement.find_first_not_of("0123456789", name.size());
    return end > name.size() && end != std::string_view::npos &&
           without_blanks_in_front(statement.substr(end)).starts_with('(');
  });
}

std::string first_word(std::string_view statement) {
  return std::string(statement.substr(0, statement.find(' ')));
}

// CYCL CALL works at the tool position, POS at the position of its words, and a pattern has its own
// positions (D-74).
bool leave_contour_by_cycle(Reading& reading, const ProgramLine& line, std::size_t begin,
                            std::string_view statement) {
  if (!statement.starts_with("CYCL CALL") || !reading.contour_open()) return true;
  const bool pattern = statement.starts_with("CYCL CALL PAT");
  std::array<bool, 3> named{};
  for (std::size_t axis = 0; axis < named.size(); ++axis)
    named[axis] = pattern || statement.find(std::string{' ', "XYZ"[axis]}) != std::string::npos;
  if (!check_left_contour(reading, line, static_cast<std::uint32_t>(begin), named)) return false;
  reading.state.have_left_contour(named);
  return true;
}

// Refuses compensation in DIN/ISO programs, which these controls read too, along single axes and of
// contours with a name.
bool check_other_compensations(Reading& reading, const ProgramLine& line, std::size_t begin,
                               std::string_view statement) {
  const std::string first = first_word(statement);
  if (statement.find("MODE TURN") != std::string::npos)
    return refuse_klartext(reading, line, begin, "FUNCTION MODE TURN", Code::turning);
  const bool is_function = first.size() > 1 && first[0] == 'G' && is_digit(first[1]);
  if (is_function && reading.trc_active())
    return refuse_klartext(reading, line, begin, first + ", a function of DIN/ISO");
  if (statement.find("G41") != std::string::npos || statement.find("G42") != std::string::npos)
    return refuse_klartext(reading, line, begin, first + ", TRC of DIN/ISO");
  if (statement.size() == 1 || !is_letter(statement[1]) || statement[0] == 'I')
    for (const char* side : {" R+", " R-", " RL", " RR"})
      if (statement.find(side) != std::string::npos)
        return refuse_klartext(reading, line, begin,
                               std::string(side).substr(1) + ", a compensation along one axis");
  return true;
}

// The control runs the called program as it stands, with its RL and RR (D-121).
bool check_called_program(Reading& reading, const ProgramLine& line, std::size_t begin,
                          std::string_view statement) {
  const std::string called =
      program_called_by(statement, std::string_view(line.text).substr(begin));
  return called.empty() || !gives_contour_of(reading.state.setup(), called) ||
         refuse_klartext(reading, line, begin,
                         "a call of " + called + ", whose RL and RR are not followed");
}

// The scale of the plane as far as it is known, in the radius of the tool (D-175).
void enter_scale(Reading& reading) {
  const KlartextModes& modes = reading.klartext_modes;
  const double scale = modes.scaling == 0 ? 1 : modes.scale;
  if (!reading.faults.empty() || reading.state.tool().terms().scale == scale) return;
  const Source at{.index = reading.blocks_read,
                  .line = static_cast<std::uint32_t>(reading.lines_read)};
  (void)reading.state.set_scale(scale, at);
}

// Programs that a later CYCL CALL, M89 or M99 calls: those of cycle 12, and cycles of the machine
// builder, 300 to 399. Such a call may end a scale.
bool makes_cycle_of_program(std::string_view statement) {
  constexpr std::string_view own = "CYCL DEF 3";
  return begins_with_word(statement, "CYCL DEF 12") || begins_with_word(statement, "SEL CYCLE") ||
         (statement.starts_with(own) && statement.size() > own.size() + 1 &&
          is_digit(statement[own.size()]) && is_digit(statement[own.size() + 1]));
}

// Beyond the largest scale the last decimal of the output would be coarser than a micrometre.
void take_scale(Reading& reading, std::string_view statement) {
  constexpr std::uint32_t scales = KlartextLead::axes | KlartextLead::cycle | KlartextLead::trans;
  constexpr double smallest = 0.01;
  constexpr double largest = 2;
  KlartextModes& modes = reading.klartext_modes;
  modes.program_is_cycle |= makes_cycle_of_program(statement);
  const KlartextScale scale = scale_of_statement(statement);
  const bool is_alone = (modes.unfollowed & scales) == scale.mode;
  const bool of_axes = (scale.mode & KlartextLead::axes) != 0;
  const bool in_plane = !of_axes || reading.state.mode().plane == Plane::xy;
  if (scale.mode == 0 || !is_alone || !in_plane || reading.contour_open()) return;
  if (modes.program_is_cycle) return;
  if (scale.factor < smallest || scale.factor > largest) return;
  modes.scaling = scale.mode;
  modes.scale = scale.factor;
  enter_scale(reading);
}

// A program, a cycle of the touch probe or a preset may end it.
void lose_scale(Reading& reading, std::string_view statement) {
  constexpr auto that_keep_it = std::to_array<std::string_view>(
      {"CYCL DEF 7", "CYCL DEF 8", "CYCL DEF 10", "CYCL DEF 11", "CYCL DEF 19", "CYCL DEF 26",
       "CYCL DEF 220", "CYCL DEF 221", "CYCL CALL", "TRANS DATUM", "TRANS SCALE", "PLANE"});
  const bool along_an_axis = statement.size() > 1 && !is_letter(statement[1]);
  if (along_an_axis || is_any(statement, that_keep_it)) return;
  reading.klartext_modes.scaling = 0;
  enter_scale(reading);
}

// A statement whose end position only the control knows: a cycle, a program call, a datum shift.
bool copy_motion_of_machine(Reading& reading, ProgramLine& line, std::size_t begin,
                            std::string_view statement) {
  const std::string first = first_word(statement);
  if (reading.trc_active())
    return refuse_klartext(reading, line, begin, first + " while TRC is active");
  if (!leave_contour_by_cycle(reading, line, begin, statement)) return false;
  lose_scale(reading, statement);
  line.calls_the_machine = first == "CALL" || first == "PGM";
  if (line.calls_the_machine || is_any(statement, contour_blocks) || first.size() == 1 ||
      !is_letter(first[1]))
    line.feed_it_takes = reading.feed;
  if (line.calls_the_machine) {
    // The called program may set another feed.
    reading.feed = 0;
    reading.klartext_modes.feed_of_control = false;
    hand_on_klartext_pole(reading, line);
    const std::string_view call = std::string_view(line.text).substr(begin);
    take_call(reading, line, call.substr(0, call.find(';')));
  }
  forget_klartext_position(reading, line);
  lose_klartext_pole(reading, line);
  return copy_klartext(reading, line, begin, WordRole::technology);
}

}  // namespace

bool has_side(std::string_view statement) {
  for (std::size_t at = statement.find('R', 1); at != std::string_view::npos;
       at = statement.find('R', at + 1)) {
    const std::string_view side = statement.substr(at, 2);
    if ((side != "RL" && side != "RR") || !ends_word(statement, at + 2)) continue;
    // PATHCTRL AXIS of FUNCTION TCPM.
    if (statement.substr(0, at).ends_with(" PATHCT")) continue;
    // A program may have this name.
    const std::string_view in_front = statement.substr(0, statement.rfind(' ', at) + 1);
    if (!in_front.ends_with(" PGM ") && in_front != "PGM CALL ") return true;
  }
  return false;
}

bool has_glued_r0(std::string_view statement) {
  // PR0 and DR0 are words, QR0 is a parameter.
  constexpr std::string_view no_side = "PDQ";
  for (std::size_t at = statement.find("R0", 1); at != std::string_view::npos;
       at = statement.find("R0", at + 1)) {
    const char before = statement[at - 1];
    if (ends_word(statement, at + 2) && is_letter(before) &&
        no_side.find(before) == std::string_view::npos)
      return true;
  }
  return false;
}

std::string statement_of(std::string_view text) {
  std::string statement;
  bool quoted = false;
  bool comment = false;
  for (const char sign : text) {
    if (sign == '\n' || sign == '\r') comment = false;
    if (sign == '"' && !comment) quoted = !quoted;
    if (sign == ';' && !quoted) comment = true;
    if (comment) continue;
    const bool blank = sign == ' ' || sign == '\t' || sign == '\n' || sign == '\r' || sign == '~';
    if (blank && (statement.empty() || statement.back() == ' ')) continue;
    statement += blank ? ' ' : quoted && sign != '"' ? '?' : upper(sign);
  }
  while (statement.ends_with(' ')) statement.pop_back();
  return statement;
}

bool begins_with_word(std::string_view statement, std::string_view word) {
  return statement.starts_with(word) &&
         (statement.size() == word.size() || !is_letter(statement[word.size()]));
}

bool copy_klartext(Reading& reading, ProgramLine& line, std::size_t begin, WordRole role) {
  line.words.push_back({.begin = static_cast<std::uint32_t>(begin),
                        .end = static_cast<std::uint32_t>(without_blanks_behind(line.text).size()),
                        .role = role});
  line.sum_up_roles();
  if (!reading.faults.empty()) return false;
  line.has_words = true;
  ++reading.blocks_read;
  reading.place(line, static_cast<std::uint32_t>(begin));
  if (!pass_words(reading, line, role)) return false;
  if (!line.ends_program) return true;
  reading.ended = true;
  reading.state.place(0);
  return reading.state.end(line.source);
}

void take_klartext_effects(Reading& reading, const KlartextEffects& effects) {
  KlartextModes& modes = reading.klartext_modes;
  const std::uint32_t on = effects.sets | effects.unsure;
  modes.unfollowed = (modes.unfollowed & ~effects.clears) | (on & KlartextLead::all);
  const auto take = [&](std::uint32_t mode, bool& holds) {
    if ((effects.touched() & mode) != 0) holds = (on & mode) != 0;
  };
  take(KlartextMode::modal_cycle, modes.modal_cycle);
  take(KlartextMode::feed_per_turn, modes.feed_per_turn);
  modes.section.note(effects);
  modes.scaling &= ~effects.touched();
  enter_scale(reading);
}

void hand_on_klartext_pole(const Reading& reading, ProgramLine& line) {
  if (!reading.klartext_modes.pole || reading.contour_open()) return;
  line.klartext.emplace();
  line.klartext->hands_pole_on = true;
  line.klartext->pole_x = reading.klartext_modes.pole->x();
  line.klartext->pole_y = reading.klartext_modes.pole->y();
}

void forget_klartext_position(Reading& reading, ProgramLine& line,
                              const std::array<bool, 3>& axes) {
  if (!reading.faults.empty()) return;
  if (!line.klartext) line.klartext.emplace();
  line.klartext->loses_pole = true;
  reading.state.forget_position(axes, line.source);
  reading.klartext_modes.tangent.reset();
}

void lose_klartext_pole(Reading& reading, const ProgramLine& line) {
  reading.klartext_modes.pole.reset();
  reading.klartext_modes.pole_lost = line.source;
}

bool read_klartext_statement(Reading& reading, ProgramLine& line, std::size_t begin) {
  const std::string statement = statement_of(std::string_view(line.text).substr(begin));
  if (statement.empty())  // only a comment is continued on the next line
    return refuse_klartext(reading, line, begin, "~", Code::nc_syntax);
  const std::string first = first_word(statement);
  if (has_side(statement)) {  // D-121
    const bool is_coordinate =
        first.find_first_of("+-0123456789") <= 2 && first.find_first_of("ABCUVWXYZ") <= 1;
    return refuse_klartext(
        reading, line, begin,
        first + (is_coordinate ? " without L, with RL or RR" : " with RL or RR"));
  }
  if (begins_with_word(statement, "BEGIN")) {
    if (reading.blocks_read > 0)
      return refuse_klartext(reading, line, begin, "BEGIN PGM, a second program in one text");
    const bool inch = statement.ends_with(" INCH");
    if (reading.faults.empty()) reading.count_in(line, inch ? LengthUnit::inch : LengthUnit::mm);
    return copy_klartext(reading, line, begin, WordRole::mode);
  }
  if (begins_with_word(statement, "END")) {
    line.ends_program = true;
    return copy_klartext(reading, line, begin, WordRole::stop);
  }
  if (begins_with_word(statement, "TOOL")) {
    take_klartext_effects(reading, effects_of_statement(statement));
    if (begins_with_word(statement, "TOOL CALL"))
      return read_tool_call(reading, line, begin, statement);
    if (begins_with_word(statement, "TOOL DEF"))
      return read_tool_definition(reading, line, begin, statement);
    return refuse_klartext(reading, line, begin, statement, Code::nc_syntax);
  }
  if (begins_with_word(statement, "LBL") || begins_with_word(statement, "CALL LBL"))
    return read_label(reading, line, begin, statement);
  if (jumps(statement)) return copy_jump(reading, line, begin, statement);
  if (writes_radius(statement)) {
    if (reading.trc_active())
      return refuse_klartext(reading, line, begin, "FN 17, which writes the radius of a tool");
    take_klartext_effects(reading, {.sets = KlartextLead::tool_data});
  }
  // A coordinate with an unknown parameter is refused at its own word.
  if (assigns(statement)) {
    take_assignment(reading, line, statement);
    return copy_klartext(reading, line, begin, WordRole::technology);
  }
  forget_parameters(reading, statement);
  take_klartext_effects(reading, effects_of_statement(statement));
  take_scale(reading, statement);
  if (!take_labels_of_cycle(reading, line, begin, statement)) return false;
  if (!check_other_compensations(reading, line, begin, statement) ||
      !check_called_program(reading, line, begin, statement))
    return false;
  if (acts_at_once(statement) || (is_any(statement, moving) && !is_any(statement, passing)))
    return copy_motion_of_machine(reading, line, begin, statement);
  if (is_any(statement, passing) || is_of_pattern(statement) ||
      reading.state.setup().copies_unknown_words ||
      passes_word(reading.state.setup(), line.text, begin))
    return copy_klartext(reading, line, begin, WordRole::technology);
  return refuse_klartext(reading, line, begin, first, Code::nc_unsupported);
}

}  // namespace trc
