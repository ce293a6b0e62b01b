#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/pass_words.h"
#include "core/nc/text/characters.h"

// Statements of Klartext that are no motion: what passes, what moves the machine, labels and calls.

namespace trc {
namespace {

using Kind = KlartextWord::Kind;

// Statements that neither move an axis nor change what coordinates mean.
constexpr auto passing = std::to_array<std::string_view>(
    {"BLK", "STOP", "TCH", "OPEN", "SEL", "POLARKIN", "STRETCH", "WRITE", "CYCL DEF", "GLOBAL DEF",
     "PATTERN DEF", "CONTOUR DEF", "FUNCTION MODE MILL", "FUNCTION FEED", "FUNCTION S-PULSE",
     "FUNCTION DWELL", "FUNCTION COUNT"});

// Statements behind which the axes stand where only the control knows.
constexpr auto moving = std::to_array<std::string_view>(
    {"CYCL CALL", "CALL", "PGM", "PLANE", "TRANS",   "FUNCTION", "LN",    "FL",
     "FLT",       "FC",   "FCT", "FPOL",  "FSELECT", "SPL",      "SPC",   "PATTERN",
     "CONTOUR",   "X",    "Y",   "Z",     "A",       "B",        "U",     "V",
     "W",         "IX",   "IY",  "IZ",    "G",       "TCHPROBE", "PRESET"});

// Cycles that change what coordinates mean as soon as they are defined.
constexpr auto frame_cycles = std::to_array<std::string_view>(
    {"7", "8", "10", "11", "12", "19", "26", "247", "7.", "8.", "10.", "11.", "12.", "19.", "26."});

bool defines_frame(std::string_view statement) {
  constexpr std::string_view head = "CYCL DEF ";
  if (!statement.starts_with(head)) return false;
  std::string_view number = statement.substr(head.size());
  number = number.substr(0, std::min(number.find_first_not_of("0123456789"), number.size()));
  return std::ranges::find(frame_cycles, number) != frame_cycles.end();
}

bool is_any(std::string_view statement, std::span<const std::string_view> words) {
  return std::ranges::any_of(words,
                             [&](std::string_view w) { return begins_with_word(statement, w); });
}

// FN 9 … FN 12, IF: the program goes on elsewhere.
bool jumps(std::string_view statement) {
  return statement.find("GOTO") != std::string_view::npos || begins_with_word(statement, "IF");
}

bool assigns(std::string_view statement) {
  return begins_with_word(statement, "FN") || begins_with_word(statement, "Q") ||
         begins_with_word(statement, "QL") || begins_with_word(statement, "QR") ||
         begins_with_word(statement, "QS") || begins_with_word(statement, "DECLARE");
}

// Of LBL 1, LBL "A", CALL LBL 1 REP 3.
std::string label_of(std::string_view text, std::size_t begin, std::string_view statement) {
  const std::string_view name =
      without_blanks_in_front(statement.substr(statement.starts_with("CALL") ? 8 : 3));
  std::string label(name.substr(0, name.find(' ')));
  if (label.starts_with('"')) {  // its letters are hidden there
    const std::size_t open = text.find('"', begin);
    label = text.substr(open, text.find('"', open + 1) - open);
  }
  return label;
}

}  // namespace

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

// The statement as it stands, with the place where it begins.
bool Interpreter::copy_klartext(ProgramLine& line, std::size_t begin, WordRole role) {
  line.words.push_back({.begin = static_cast<std::uint32_t>(begin),
                        .end = static_cast<std::uint32_t>(without_blanks_behind(line.text).size()),
                        .role = role});
  line.roles = 0;
  for (const WordRange& word : line.words) line.roles |= bit(word.role);
  if (!faults_.empty()) return false;
  line.has_words = true;
  ++blocks_read_;
  place(line, static_cast<std::uint32_t>(begin));
  if (!pass_words(line, role)) return false;
  if (!line.ends_program) return true;
  ended_ = true;
  state_.place(0);
  return state_.end(line.source);
}

void Interpreter::forget_klartext_position(const ProgramLine& line,
                                           const std::array<bool, 3>& axes) {
  if (!faults_.empty()) return;
  state_.forget_position(axes, line.source);
  klartext_.tangent.reset();
}

// Everything that is no contour.
bool Interpreter::read_klartext_statement(ProgramLine& line, std::size_t begin) {
  const std::string statement = statement_of(std::string_view(line.text).substr(begin));
  const std::string first = statement.substr(0, std::min(statement.find(' '), statement.size()));
  const auto while_active = [&](std::string_view what) {
    return refuse_klartext(line, begin, std::string(what).append(" while TRC is active"));
  };
  if (begins_with_word(statement, "BEGIN")) {
    if (faults_.empty()) count_in(line, statement.ends_with(" INCH"));
    return copy_klartext(line, begin, WordRole::mode);
  }
  if (begins_with_word(statement, "END")) {
    line.ends_program = true;
    return copy_klartext(line, begin, WordRole::stop);
  }
  if (begins_with_word(statement, "TOOL")) {
    return begins_with_word(statement, "TOOL CALL") ? read_tool_call(line, begin, statement)
                                                    : read_tool_definition(line, begin, statement);
  }
  if (begins_with_word(statement, "LBL") || begins_with_word(statement, "CALL LBL"))
    return read_label(line, begin, statement);
  if (jumps(statement)) return refuse_klartext(line, begin, first + ", a jump");
  // A coordinate that needs it is refused at its own word.
  if (assigns(statement)) return copy_klartext(line, begin, WordRole::technology);
  const bool scales = statement.find(" SCL") != std::string::npos ||
                      begins_with_word(statement, "TRANS SCALE") ||
                      begins_with_word(statement, "FUNCTION TCPM");
  if (scales)
    klartext_.unfollowed = !statement.ends_with(" SCL 1") && !statement.ends_with(" SCL1") &&
                           !statement.ends_with("RESET") && !statement.ends_with("SCL1.0");
  if (begins_with_word(statement, "FUNCTION RESET TCPM")) klartext_.unfollowed = false;
  if (statement.find("MODE TURN") != std::string::npos)
    return refuse_klartext(line, begin, "FUNCTION MODE TURN", Code::turning);
  // Of the programs in DIN/ISO that these controls read as well, and of single axes.
  if (statement.find("G41") != std::string::npos || statement.find("G42") != std::string::npos)
    return refuse_klartext(line, begin, first + ", TRC of DIN/ISO");
  if (statement.size() == 1 || !is_letter(statement[1]) || statement[0] == 'I')
    for (const char* side : {" R+", " R-", " RL", " RR"})
      if (statement.find(side) != std::string::npos)
        return refuse_klartext(line, begin,
                               std::string(side).substr(1) + ", a compensation along one axis");
  const bool moves =
      defines_frame(statement) || (is_any(statement, moving) && !is_any(statement, passing));
  if (moves && trc_active()) return while_active(first);
  if (moves) {
    forget_klartext_position(line);
    klartext_.pole.reset();
    return copy_klartext(line, begin, WordRole::technology);
  }
  if (is_any(statement, passing) || state_.setup().copies_unknown_words ||
      passes_word(state_.setup(), line.text, begin))
    return copy_klartext(line, begin, WordRole::technology);
  return refuse_klartext(line, begin, first, Code::nc_unsupported);
}

// Behind the end subprograms stand: one that is called is no leftover.
void Interpreter::enter_label_behind_end(const ProgramLine& line) {
  const std::size_t begin = line.text.find_first_not_of("0123456789 \tNn/");
  if (begin == std::string::npos) return;
  const std::string statement = statement_of(std::string_view(line.text).substr(begin));
  if (!begins_with_word(statement, "LBL")) return;
  const std::string label = label_of(line.text, begin, statement);
  const auto call = klartext_.calls.find(label);
  if (label == "0" || call != klartext_.calls.end())
    klartext_.called_section = label == "0" ? 0 : call->second;
}

// LBL 1 … LBL 0, CALL LBL 1 REP 3. What a call repeats is not written anew, so that no contour may
// be within it.
bool Interpreter::read_label(ProgramLine& line, std::size_t begin, std::string_view statement) {
  const bool calls = statement.starts_with("CALL");
  const std::string label = label_of(line.text, begin, statement);
  const std::uint64_t contours = klartext_.contours;
  if (!calls) {
    if (label == "0") klartext_.called_section = 0;
    if (const auto call = klartext_.calls.find(label); call != klartext_.calls.end())
      klartext_.called_section = call->second;
    // A contour that is open goes on behind the label.
    if (label != "0") klartext_.labels[label] = trc_active() ? contours - 1 : contours;
    if (klartext_.called_section != 0 && trc_active())
      return refuse_klartext(line, begin, "LBL, which is called, while TRC is active");
    return copy_klartext(line, begin, WordRole::technology);
  }
  if (trc_active()) return refuse_klartext(line, begin, "CALL LBL while TRC is active");
  const auto known = klartext_.labels.find(label);
  if (known != klartext_.labels.end() && known->second != contours)
    return refuse_klartext(line, begin, "CALL LBL, which repeats a compensated contour");
  if (known == klartext_.labels.end()) klartext_.calls.try_emplace(label, line.source.line);
  forget_klartext_position(line);
  klartext_.pole.reset();
  klartext_.polar_radius.reset();
  feed_ = 0;
  return copy_klartext(line, begin, WordRole::technology);
}

}  // namespace trc
