#include <algorithm>
#include <cmath>

#include "core/nc/program/gcode_line.h"
#include "core/nc/program/isg_flow.h"
#include "core/nc/program/isg_line.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/words.h"

// Lines of words of ISG with computed values.

namespace trc::program {
namespace {

constexpr std::size_t npos = std::string_view::npos;

}  // namespace

bool IsgFlow::execute_words(std::string& flat) {
  pieces_.clear();
  jump_.reset();
  called_behind_words_.clear();
  has_computed_ = false;
  for (std::size_t at = head_.behind; at < line_.size(); at = behind_blanks(line_, at))
    if (!scan_word(at)) return false;
  if (head_.to_skip && (has_computed_ || has_changed_words()))
    return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
  bool ends = false;
  bool returns = false;
  if (!end_or_return(ends, returns)) return false;
  if (!called_behind_words_.empty()) write_values(flat);
  if (!write_words(flat)) return false;
  // T5 LM06 changes tools as M06 does (D-76).
  if (!called_behind_words_.empty() && !chooses_tool()) lose_values(called_behind_words_);
  if (jump_) frame().next = *jump_;
  if (returns) return check_behind_return() && return_from(flat);
  return !ends || end_of_program(flat);
}

bool IsgFlow::chooses_tool() const {
  return std::ranges::any_of(pieces_, [&](const Piece& piece) {
    return !piece.is_comment && upper(sign_at(line_, piece.begin)) == 'T' &&
           is_digit(sign_at(line_, piece.begin + 1));
  });
}

// M02 and M30 end the program, M17 and M29 a subprogram.
bool IsgFlow::end_or_return(bool& ends, bool& returns) {
  const bool is_main = frames_.size() == 1;
  for (Piece& piece : pieces_) {
    if (piece.instead || piece.is_comment || upper(line_[piece.begin]) != 'M') continue;
    double number = -1;
    bool whole = false;
    if (read_number(line_.substr(piece.begin + 1), number, whole) == 0) continue;
    const bool ends_program = number == 2 || number == 30;
    const bool ends_subprogram = number == 17 || number == 29;
    const bool is_of_program = frame().text == 0;
    if (!is_of_program && ends_program)
      return refuse(
          Code::nc_unsupported, piece.begin,
          std::string(line_.substr(piece.begin, piece.end - piece.begin)) + " in a subprogram");
    ends |= ends_program;
    if (is_main || !ends_subprogram) continue;
    returns = true;
    piece.instead = std::string();
    const Piece* const last = &pieces_.back();
    if (&piece != last && !last->is_comment &&
        sign_at(line_, behind_blanks(line_, piece.end)) == '[')
      return refuse(Code::nc_unsupported, piece.begin, "M17 with a target");
  }
  return true;
}

bool IsgFlow::scan_word(std::size_t& at) {
  const std::size_t begin = at;
  const char sign = line_[at];
  if (sign == '(' || sign == ';') {
    at = behind_isg_comment(line_, at);
    if (at == 0) at = line_.size();  // the reader reports the missing bracket
    pieces_.push_back({.begin = begin, .end = at, .is_comment = true});
    return true;
  }
  if (sign == '#') {
    const std::string word = word_behind_sign(line_, at);
    if (word == "VAR" && is_isg_line_over(line_, at + 1 + word.size())) {
      in_declaration_ = has_computed_ = true;
      at += 1 + word.size();
      pieces_.push_back({.begin = begin, .end = at});
      if (!writes_variables_) pieces_.back().instead = std::string();
      return true;
    }
    if (word == "DELETE") {
      has_computed_ = true;
      at = end_of_isg_command(line_, begin);
      pieces_.push_back({.begin = begin, .end = at});
      if (!writes_variables_) pieces_.back().instead = std::string();
      return forget_declared(begin + 1 + word.size());
    }
    return scan_command(at);
  }
  if (sign == '$') {
    const std::string word = word_behind_sign(line_, at);
    if (word != "GOTO")
      return refuse(Code::nc_unsupported, at, "$" + word + " after words of a block");
    ExpressionReader expression = expression_at(at + 1 + word.size());
    jump_ = target_of(expression);
    if (!jump_) return false;
    has_computed_ = true;
    at = expression.at();
    pieces_.push_back(
        {.begin = begin, .end = end_without_blanks(line_, begin, at), .instead = std::string()});
    return true;
  }
  if (is_isg_variable_at(line_, at))
    return begins_zero_offset(line_.substr(at)) ? scan_zero_offset(at) : scan_assignment(at);
  if (is_isg_parameter_at(line_, at)) {
    ExpressionReader expression = expression_at(at);
    static_cast<void>(place_at(expression));
    if (expression.failed()) return refuse(expression.fault());
    const std::size_t behind = behind_blanks(line_, expression.at());
    if (sign_at(line_, behind) == '=' || sign_at(line_, behind + 1) == '=')
      return scan_assignment(at);
    at = expression.at();  // P500 alone: the reader refuses it
    pieces_.push_back({.begin = begin, .end = at});
    return true;
  }
  if (is_letter(sign)) return scan_address(at);
  // [P1 + 5] alone is the time of G04.
  if (is_isg_expression_at(line_, at)) return scan_value(begin, begin, at);
  ++at;
  while (at < line_.size() && !is_letter(line_[at]) && line_[at] != ' ' && line_[at] != '(') ++at;
  pieces_.push_back({.begin = begin, .end = at});
  return true;
}

bool IsgFlow::scan_address(std::size_t& at) {
  const std::size_t begin = at;
  if (const std::size_t length = behind_spindle_words(line_.substr(at))) {
    at += length;
    pieces_.push_back({.begin = begin, .end = at});
    return !computes_spindle(line_.substr(begin, length)) ||
           refuse(Code::nc_unsupported, begin,
                  std::string(line_.substr(begin, length)) + ", a computed spindle");
  }
  if (const IsgCall call = isg_call_at(line_, at); call.is_call && head_.behind < at)
    return scan_call(at, call);
  std::size_t value = behind_blanks(line_, at + 1);
  const bool is_assigned = sign_at(line_, value) == '=';
  if (is_assigned) value = behind_blanks(line_, value + 1);
  if (is_isg_expression_at(line_, value)) return scan_value(begin, value, at);
  if (is_letter(sign_at(line_, at + 1))) {  // a name: the reader reports it
    at = line_.size();
    if (const std::size_t comment = line_.find_first_of("(;", begin); comment != npos) at = comment;
    pieces_.push_back({.begin = begin, .end = end_without_blanks(line_, begin, at)});
    return true;
  }
  double number = 0;
  bool whole = false;
  const std::size_t length = read_number(line_.substr(value), number, whole);
  at = length > 0 ? value + length : std::max(value, begin + 1);
  const std::size_t behind = behind_blanks(line_, at);
  const char sign = sign_at(line_, behind);
  // S2=P1
  if (length > 0 && sign == '=') {
    value = behind_blanks(line_, behind + 1);
    if (is_isg_expression_at(line_, value)) return scan_value(begin, value, at);
    at = value + read_number(line_.substr(value), number, whole);
  } else if (length > 0 && (sign == '*' || (behind == at && (sign == '+' || sign == '-')) ||
                            (is_assigned && (sign == '+' || sign == '-' || sign == '/')))) {
    return scan_value(begin, value, at);  // X10+P1, X=100/2
  }
  pieces_.push_back({.begin = begin, .end = at});
  return true;
}

// T5 LM06: only a call of the machine may follow words.
bool IsgFlow::scan_call(std::size_t& at, const IsgCall& call) {
  const bool is_known = given_subprogram(setup_, call.name) != nullptr ||
                        (call.is_local && unit_called(call) != nullptr);
  if (is_known || isg_call_behind_words(line_, head_.behind) != at)
    return refuse(Code::nc_unsupported, at,
                  std::string(line_.substr(at, call.end - at)) + ", a call after words");
  called_behind_words_ = call.name;
  pieces_.push_back({.begin = at, .end = call.end});
  at = call.end;
  return true;
}

// The value at `value` of the word that begins at `begin`.
bool IsgFlow::scan_value(std::size_t begin, std::size_t value, std::size_t& at) {
  ExpressionReader expression = expression_at(value);
  reads_words_ = true;
  const Value computed = expression.expression();
  reads_words_ = false;
  if (expression.failed()) return refuse(expression.fault());
  const std::size_t end = end_without_blanks(line_, value, expression.at());
  constexpr double largest = 1e9;
  if (computed.is_text || std::abs(computed.number) > largest)
    return refuse(Code::value_invalid, begin, std::string(line_.substr(begin, end - begin)));
  at = expression.at();
  if (is_isg_operator(sign_at(line_, at)))
    return refuse(Code::expression_invalid, at, std::string(1, line_[at]));
  std::string text(line_.substr(begin, value - begin));
  append_number(text, computed);
  // XP1M8: no digit follows the value.
  pieces_.push_back({.begin = begin, .end = end, .instead = std::move(text)});
  return true;
}

void IsgFlow::append_number(std::string& text, const Value& value) {
  if (value.is_text)
    text.append("\"").append(value.text).append("\"");
  else
    append_value(text, value.number, PointStyle::as_whole);
}

// Where the variable at the end of the name at `at` begins: P1 of IDP1, V.L.A of XV.L.A. npos:
// none. `end` is after the name.
std::size_t IsgFlow::variable_in_name(std::size_t at, std::size_t& end) const {
  const std::size_t begin = at;
  for (end = at; goes_on_as_name(sign_at(line_, end));) ++end;
  if (is_isg_variable_at(line_, end - 1)) return end - 1;
  std::size_t digits = end;
  while (digits > begin && is_digit(line_[digits - 1])) --digits;
  std::size_t parameter = digits;
  while (parameter > begin && upper(line_[parameter - 1]) == 'P') --parameter;
  return digits < end && is_isg_parameter_at(line_, parameter) ? parameter : npos;
}

// Where a value in a command that depends on a variable begins, at or after `sign`; npos: none.
// `behind`: where to continue in that case.
std::size_t IsgFlow::value_in_command(std::size_t sign, std::size_t& behind) const {
  const char here = line_[sign];
  behind = sign + 1;
  if (here == '[' || here == ',' || here == '=') {
    const std::size_t value = behind_blanks(line_, sign + 1);
    std::size_t variable = value;
    while (sign_at(line_, variable) == '-' || sign_at(line_, variable) == '+') ++variable;
    const bool is_value =
        is_isg_parameter_at(line_, variable) || is_isg_variable_at(line_, variable) ||
        (is_letter(sign_at(line_, variable)) && is_isg_expression_at(line_, variable));
    return is_value ? value : npos;
  }
  if (!is_letter(here)) return npos;
  const std::size_t variable = variable_in_name(sign, behind);
  const std::size_t before = without_blanks_behind(line_.substr(0, sign)).size() - 1;
  // @P1=…: the name of a value of a cycle. TYPE=STEP1: a name.
  const bool is_own_name = line_[before] == '@' || (line_[before] == '=' && variable != sign);
  return is_own_name ? npos : variable;
}

// Replaces each value of a command that depends on a variable.
bool IsgFlow::scan_command(std::size_t& at) {
  const std::size_t begin = at;
  const std::size_t end = line_[at] == '#' ? end_of_isg_command(line_, at)
                                           : std::min(line_.find_last_of(']') + 1, line_.size());
  std::size_t kept = begin;
  std::string text;
  bool quoted = false;
  for (std::size_t next = begin; next < end;) {
    const std::size_t sign = next++;
    if (line_[sign] == '"') quoted = !quoted;
    const std::size_t value = quoted ? npos : value_in_command(sign, next);
    if (value == npos) continue;
    // 2*P1: the value begins before the variable.
    const char before = line_[without_blanks_behind(line_.substr(0, value)).size() - 1];
    if (value == sign && (is_isg_operator(before) || is_digit(line_[value - 1])) && before != ']')
      return refuse(Code::expression_invalid, value, std::string(1, before));
    ExpressionReader expression = expression_at(value);
    const Value computed = expression.expression();
    if (expression.failed()) return refuse(expression.fault());
    text.append(line_.substr(kept, value - kept));
    append_number(text, computed);
    kept = next = end_without_blanks(line_, value, expression.at());
  }
  at = std::max(end, begin + 1);
  pieces_.push_back({.begin = begin, .end = at});
  if (kept > begin) {
    text.append(line_.substr(kept, end - kept));
    pieces_.back().instead = std::move(text);
  }
  return true;
}

bool IsgFlow::has_changed_words() const {
  return std::ranges::any_of(pieces_, [](const Piece& piece) { return piece.instead.has_value(); });
}

bool IsgFlow::write_words(std::string& flat) {
  if (!head_.is_target && head_.label.empty() && !has_changed_words()) return pass_line(flat);
  const bool is_left = std::ranges::any_of(
      pieces_, [](const Piece& piece) { return !piece.instead || !piece.instead->empty(); });
  if (!is_left) return true;
  const std::size_t in_front = head_.number >= 0 ? head_.number_end : behind_blanks(line_, 0);
  flat.append(line_.substr(0, in_front));
  std::size_t behind = npos;
  for (const Piece& piece : pieces_) {
    // A word left out takes the blanks before it along, the first word those after it.
    const bool is_out = piece.instead && piece.instead->empty();
    if (!is_out) {
      if (behind != npos)
        flat.append(line_.substr(behind, piece.begin - behind));
      else if (head_.number >= 0)
        flat.append(" ");
      flat.append(piece.instead ? std::string_view(*piece.instead)
                                : line_.substr(piece.begin, piece.end - piece.begin));
    }
    if (!is_out || behind != npos) behind = piece.end;
  }
  flat.append(line_end());
  return true;
}

}  // namespace trc::program
