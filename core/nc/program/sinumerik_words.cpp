#include <algorithm>
#include <array>
#include <cmath>

#include "core/nc/dialect/sinumerik_names.h"
#include "core/nc/program/gcode_line.h"
#include "core/nc/program/sinumerik_flow.h"
#include "core/nc/text/characters.h"

// Lines of words with computed values, and calls.

namespace trc::program {
namespace {

constexpr std::size_t npos = std::string_view::npos;

// X=AC(…) and the like, PM(…) of a feed, QU(…) of M and H.
bool is_reference(std::string_view name) {
  constexpr auto references =
      std::to_array<std::string_view>({"AC", "IC", "DC", "ACP", "ACN", "PM", "QU"});
  return std::ranges::find(references, name) != references.end();
}

}  // namespace

void SinumerikFlow::keep(std::size_t begin, std::size_t end) {
  pieces_.push_back({.begin = begin, .end = end});
}

void SinumerikFlow::leave_out(std::size_t begin, std::size_t end) {
  pieces_.push_back({.begin = begin, .end = end, .instead = std::string()});
}

bool SinumerikFlow::execute_words(std::string& flat) {
  pieces_.clear();
  has_computed_ = false;
  calls_of_line_.clear();
  given_to_calls_.clear();
  reads_variables_ = begins_modal_call_ = false;
  addressed_.reset();
  times_in_front_.reset();
  std::vector<Call> calls;
  for (std::size_t at = behind_blanks(line_, head_.behind); at < line_.size();
       at = behind_blanks(line_, at)) {
    if (line_[at] == ';') {
      pieces_.push_back({.begin = at, .end = line_.size(), .is_comment = true});
      break;
    }
    if (!scan_word(at, calls)) return false;
  }
  if (head_.to_skip && (has_computed_ || !calls.empty()))
    return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
  if (!calls.empty() && !complete_call(calls.front())) return false;
  const bool calls_twice = calls.size() > 1 || (!calls.empty() && !calls_of_line_.empty());
  if (calls_twice)
    return refuse(Code::expression_invalid, calls.back().begin, "a second call in one line");
  if (begins_modal_call_) modal_call_reads_ = reads_variables_;
  // I=5 is a variable if DEF has named it, and a centre beside a motion: the reader of the program
  // may take it for either. X=5 always looks like a motion.
  const bool is_left = std::ranges::any_of(
      pieces_, [](const Piece& piece) { return !piece.instead && !piece.is_comment; });
  const bool names_axis = addressed_ && upper(line_[*addressed_]) >= 'X';
  if (addressed_ && (is_left || !calls.empty() || names_axis))
    return refuse_word(Code::expression_invalid, *addressed_, *addressed_ + 1,
                       ", a variable with the name of an address");
  bool ends = false;
  bool returns = false;
  for (Piece& piece : pieces_) {
    if (piece.instead || piece.is_comment || upper(line_[piece.begin]) != 'M') continue;
    double number = -1;
    bool whole = false;
    if (read_number(line_.substr(piece.begin + 1), number, whole) == 0) continue;
    if (number != 2 && number != 17 && number != 30) continue;
    const bool is_main = std::ranges::none_of(frames_.begin() + 1, frames_.end(),
                                              [](const Frame& each) { return each.own_variables; });
    if (!is_main && number != 17)
      return refuse_word(Code::nc_unsupported, piece.begin, piece.end, " in a subprogram");
    (is_main ? ends : returns) = true;
    if (!is_main) piece.instead = std::string();
  }
  if (!calls.empty()) return call(flat, calls.front());
  write_values();
  const std::size_t begin_of_line = flat.size();
  write_words(flat);
  note_named_by_cycles(std::string_view(flat).substr(begin_of_line));
  lose_values();
  if (returns) return return_from(flat);
  return !ends || end_of_program(flat);
}

bool SinumerikFlow::scan_word(std::size_t& at, std::vector<Call>& calls) {
  const std::size_t begin = at;
  if (line_[at] == '$') return scan_setting(at);
  if (!is_letter(line_[at]) && line_[at] != '_') {
    at = line_.size();
    keep(begin, at);
    return true;
  }
  if (is_variable_at(at)) return scan_assignment(at);
  const char second = sign_at(line_, at + 1);
  const bool is_named = is_letter(second) || second == '_' || line_[at] == '_';
  return is_named ? scan_name(at, name_at(line_, at), calls) : scan_address(at, calls);
}

// $AC_TIMER[1]=0, $TC_DP6[R1,1]=R2/2, $P_UIFR[1]=CTRANS(X,R1):CROT(Z,R2): assigns a value to a
// variable of the machine.
bool SinumerikFlow::scan_setting(std::size_t& at) {
  const std::size_t begin = at;
  const std::string name = "$" + name_at(line_, at + 1);
  const std::size_t end_of_name = begin + name.size();
  std::string text(line_.substr(begin, name.size()));
  bool changes = false;
  std::size_t equals = behind_blanks(line_, end_of_name);
  if (sign_at(line_, equals) == '[') {
    const std::size_t open = equals;
    equals = behind_blanks(line_, behind_bracket(line_, open));
    if (equals > open && is_sinumerik_word(name) && !append_arguments(open, equals, text, changes))
      return false;
  }
  if (!is_sinumerik_word(name) || equals < end_of_name || sign_at(line_, equals) != '=')
    return refuse(Code::machine_state, begin, name);
  at = equals + 1;
  text += '=';
  if (is_sinumerik_frame(name)) {
    if (!append_frame(at, text, changes)) return false;
    keep(begin, at);
    if (changes) pieces_.back().instead = std::move(text);
    return true;
  }
  const std::size_t value_begin = behind_blanks(line_, at);
  kept_text_.begin(name.starts_with("$A") ? in_upper_case(text.substr(0, text.size() - 1)) : "");
  const bool goes_on = scan_value(begin, at);
  kept_text_.end();
  if (!goes_on) return false;
  Piece& piece = pieces_.back();
  // The control computes its counter itself (D-88).
  if (kept_text_.stays()) {
    piece.instead = text + kept_text_.text(line_, value_begin, piece.end);
    return true;
  }
  if (!changes) return true;
  const std::string whole =
      piece.instead.value_or(std::string(line_.substr(piece.begin, piece.end - piece.begin)));
  piece.instead = text + whole.substr(equals + 1 - begin);
  return true;
}

// _OFFSET=R1*2, _ZSD[2]=1: assigns a value to a variable that the program does not declare. It
// stays in the output; what the machine makes of the value is not known (D-172).
bool SinumerikFlow::scan_variable_of_machine(const std::string& name, std::size_t& at) {
  const std::size_t begin = at;
  std::string text(line_.substr(begin, name.size()));
  bool changes = false;
  const std::size_t open = behind_blanks(line_, begin + name.size());
  std::size_t equals = open;
  if (sign_at(line_, open) == '[') {
    const std::size_t close = behind_bracket(line_, open);
    equals = behind_blanks(line_, close);
    if (close == 0 || sign_at(line_, equals) != '=')
      return refuse(Code::expression_invalid, begin, name + "[");
    if (!append_arguments(open, close, text, changes)) return false;
  }
  at = equals + 1;
  kept_text_.begin("");
  const bool goes_on = scan_value(begin, at);
  kept_text_.end();
  if (!goes_on) return false;
  if (kept_text_.hangs_by_the_way()) warn_of_given(begin, in_upper_case(text));
  Piece& piece = pieces_.back();
  const std::string written =
      piece.instead.value_or(std::string(line_.substr(piece.begin, piece.end - piece.begin)));
  if (changes) piece.instead = text + written.substr(equals - begin);
  set_on_machine_.insert(name);
  return true;
}

// CTRANS(X,R1):CROT(Z,30), with the values of its arguments.
bool SinumerikFlow::append_frame(std::size_t& at, std::string& text, bool& changes) {
  for (;;) {
    const std::size_t begin = behind_blanks(line_, at);
    const bool is_of_machine = sign_at(line_, begin) == '$';
    const std::string name = name_at(line_, begin + (is_of_machine ? 1 : 0));
    const bool is_frame = is_of_machine && is_sinumerik_frame("$" + name);
    at = begin + name.size() + (is_of_machine ? 1 : 0);
    text.append(line_.substr(begin, at - begin));
    const std::size_t open = behind_blanks(line_, at);
    const bool is_call = !is_of_machine && !name.empty() && sign_at(line_, open) == '(';
    if (!is_frame && !is_call) {
      // One element of a frame, such as $P_UIFR[1,X,TR]=R1.
      text.erase(text.size() - (at - begin));
      at = begin;
      return append_value_of(at, text, changes);
    }
    if (is_call || sign_at(line_, open) == '[') {
      at = behind_bracket(line_, open);
      if (at == 0) return refuse(Code::expression_invalid, begin, name);
      if (!append_arguments(open, at, text, changes)) return false;
    }
    if (sign_at(line_, behind_blanks(line_, at)) != ':') return true;
    at = behind_blanks(line_, at) + 1;
    text += ':';
  }
}

bool SinumerikFlow::append_value_of(std::size_t& at, std::string& text, bool& changes) {
  ExpressionReader expression = expression_at(at);
  const Value value = expression.expression();
  if (expression.failed()) return refuse(expression.fault());
  const std::size_t end = end_without_blanks(line_, at, expression.at());
  double number = 0;
  bool whole = false;
  if (read_named_number(line_.substr(at), number, whole) == end - at) {
    text.append(line_.substr(at, end - at));
  } else {
    text.append(text_of_value(value));
    changes = true;
  }
  at = end;
  return true;
}

bool SinumerikFlow::scan_assignment(std::size_t& at) {
  const std::size_t begin = at;
  const std::string name = name_at(line_, at);
  if (name.size() == 1 && name != "R") addressed_ = at;
  ExpressionReader expression = expression_at(at);
  if (!assign_at(expression)) return false;
  at = expression.at();
  has_computed_ = true;
  const char sign = sign_at(line_, at);
  if (std::string_view(")]<>=").find(sign) != npos && sign != '\0')
    return refuse(Code::expression_invalid, at, std::string(1, sign));
  leave_out(begin, end_without_blanks(line_, begin, at));
  return true;
}

bool SinumerikFlow::scan_address(std::size_t& at, std::vector<Call>& calls) {
  const std::size_t begin = at++;
  const char letter = upper(line_[begin]);
  const std::size_t digits = behind_blanks(line_, at);
  double number = 0;
  bool whole = false;
  const std::size_t length = read_named_number(line_.substr(digits), number, whole);
  const std::size_t behind = behind_blanks(line_, digits + length);
  const bool has_value = sign_at(line_, behind) == '=' && sign_at(line_, behind + 1) != '=';
  if (letter == 'P' && !calls.empty() && (length > 0 || has_value)) {
    at = begin + 1;
    return scan_times(at, calls);
  }
  // P2 L20: the call that it counts may follow.
  if (letter == 'P' && (length > 0 || has_value)) times_in_front_ = pieces_.size();
  if (has_value) {
    at = behind + 1;
    return scan_value(begin, at);
  }
  // S[1]=R5; the index of the spindle must be a literal.
  const bool is_indexed =
      length == 0 && sign_at(line_, digits) == '[' && std::string_view("SMH").find(letter) != npos;
  const std::size_t index_end = is_indexed ? behind_bracket(line_, digits) : 0;
  if (index_end > 0 && sign_at(line_, behind_blanks(line_, index_end)) == '=') {
    std::string text;
    bool changes = false;
    if (!append_arguments(digits, index_end, text, changes)) return false;
    at = behind_blanks(line_, index_end) + 1;
    return changes ? refuse_word(Code::expression_invalid, begin, at, ", a computed spindle")
                   : scan_value(begin, at);
  }
  at = digits + length;
  if (letter == 'L' && length > 0 && is_digit(line_[digits])) {
    const std::string name = "L" + std::string(line_.substr(digits, length));
    const Unit* const unit = unit_named(name);
    if (unit == nullptr && (name == standard_tool_change || setup_.pass_words.contains(name))) {
      calls_of_line_.push_back(name);
      reads_variables_ = true;
      keep(begin, at);
      return true;
    }
    if (unit == nullptr) return refuse(Code::subprogram_unknown, begin, name);
    calls.push_back({.unit = unit, .begin = begin});
    leave_out(begin, at);
    return true;
  }
  if (length == 0) at = line_.size();  // the reader reports the missing value
  keep(begin, at);
  return true;
}

// MCALL would call a subprogram after each motion, not here. A count may come before its call, and
// was then taken for a word.
bool SinumerikFlow::complete_call(Call& call) {
  if (begins_modal_call_) return refuse(Code::nc_unsupported, call.begin, "MCALL of a subprogram");
  if (!times_in_front_) return true;
  const std::size_t place = *times_in_front_;
  std::size_t at = pieces_[place].begin + 1;
  if (!read_times(at, call)) return false;
  pieces_[place].instead = std::string();
  return true;
}

// P3, P=R1: the number of times that the call in the line is executed.
bool SinumerikFlow::scan_times(std::size_t& at, std::vector<Call>& calls) {
  const std::size_t begin = at - 1;
  if (!read_times(at, calls.back())) return false;
  leave_out(begin, end_without_blanks(line_, begin, at));
  return true;
}

bool SinumerikFlow::read_times(std::size_t& at, Call& call) {
  const std::size_t begin = at - 1;
  ExpressionReader expression = expression_at(at);
  expression.pass_blanks();
  if (expression.peek() == '=') expression.go_to(expression.at() + 1);
  const Value value = expression.expression();
  if (expression.failed()) return refuse(expression.fault());
  at = expression.at();
  constexpr double most = 9999;
  if (value.is_text || value.number < 1 || value.number > most ||
      value.number != std::round(value.number))
    return refuse_word(Code::value_invalid, begin, at, "");
  if (call.times)
    return refuse_word(Code::expression_invalid, begin, end_without_blanks(line_, begin, at),
                       ", a second count of a call");
  call.times = static_cast<std::uint64_t>(value.number);
  return true;
}

// The value after the `=` before `at`, of the word that begins at `begin`.
bool SinumerikFlow::scan_value(std::size_t begin, std::size_t& at) {
  std::size_t value_begin = behind_blanks(line_, at);
  const std::string name = name_at(line_, value_begin);
  const std::size_t behind_name = behind_blanks(line_, value_begin + name.size());
  const bool refers = is_reference(name) && sign_at(line_, behind_name) == '(';
  const std::size_t close = refers ? behind_bracket(line_, behind_name) : 0;
  if (refers) value_begin = behind_blanks(line_, behind_name + 1);
  // A variable of the machine: the reader copies the line if it can.
  const char axis = upper(line_[begin]);
  const bool is_main_axis = axis >= 'X' && axis <= 'Z' && !is_digit(sign_at(line_, begin + 1)) &&
                            !is_letter(sign_at(line_, begin + 1));
  const bool stands_alone =
      std::string_view("+-*/([<>=").find(sign_at(line_, behind_name)) == npos ||
      behind_name >= line_.size();
  if (is_main_axis && !name.empty() && stands_alone && declared(name) == nullptr &&
      given_by_setup(name) == nullptr && !is_variable_name(name)) {
    at = value_begin + name.size();
    keep(begin, at);
    return true;
  }
  ExpressionReader expression = expression_at(value_begin);
  const Value value = expression.expression();
  if (expression.failed()) return refuse(expression.fault());
  const std::size_t end = end_without_blanks(line_, value_begin, expression.at());
  constexpr double largest = 1e9;
  if (!value.is_text && std::abs(value.number) > largest)
    return refuse_word(Code::value_invalid, begin, end, "");
  at = refers ? close : end;
  if (refers && (close == 0 || behind_blanks(line_, end) + 1 != close))
    return refuse_word(Code::expression_invalid, begin, std::max(end, close), "");
  double number = 0;
  bool whole = false;
  const bool is_literal =
      read_named_number(line_.substr(value_begin), number, whole) == end - value_begin ||
      (value.is_text && line_.substr(value_begin, end - value_begin) == "\"" + value.text + "\"");
  if (is_literal) {
    keep(begin, at);
    return true;
  }
  pieces_.push_back({.begin = begin,
                     .end = at,
                     .instead = std::string(line_.substr(begin, value_begin - begin)) +
                                text_of_value(value) + (refers ? ")" : "")});
  const char sign = sign_at(line_, at);
  return std::string_view(")]<>=").find(sign) == npos || at >= line_.size() ||
         refuse(Code::expression_invalid, at, std::string(1, sign));
}

bool SinumerikFlow::scan_name(std::size_t& at, const std::string& name, std::vector<Call>& calls) {
  const std::size_t begin = at;
  const std::size_t end = begin + name.size();
  const std::size_t next = behind_blanks(line_, end);
  const char sign = sign_at(line_, next);
  if (name == "CALL" || name == "EXTCALL") return scan_call_of_text(at, calls);
  if (sign == '=' || sign == '[') {
    const std::size_t close = sign == '[' ? line_.find(']', next) : next;
    const std::size_t equals =
        close == npos || sign == '=' ? close : behind_blanks(line_, close + 1);
    const bool assigns =
        equals != npos && sign_at(line_, equals) == '=' && sign_at(line_, equals + 1) != '=';
    if (assigns && (is_sinumerik_word(name) || setup_.pass_words.contains(name) ||
                    is_unread_sinumerik_word(name))) {
      at = equals + 1;
      return scan_value(begin, at);
    }
    if (assigns) return scan_variable_of_machine(name, at);
    if (sign == '=') return refuse(Code::variable_unset, begin, name + ", which DEF does not name");
    at = line_.size();
    keep(begin, at);
    return true;
  }
  const Unit* const unit = is_sinumerik_name(name) ? nullptr : unit_named(name);
  const bool has_arguments = sign == '(';
  at = end;
  if (has_arguments) {
    at = behind_bracket(line_, next);
    if (at == 0) return refuse(Code::expression_invalid, begin, name + "( without )");
  }
  if (unit != nullptr) {
    calls.push_back({.unit = unit, .begin = begin, .arguments = has_arguments ? next : 0});
    leave_out(begin, at);
    return true;
  }
  const bool is_of_control = is_sinumerik_name(name) || is_sinumerik_call(name);
  reads_variables_ |= !is_of_control;
  begins_modal_call_ |= name == "MCALL";
  if (!has_arguments) {
    keep(begin, at);
    return true;
  }
  if (!scan_call_arguments(begin, at)) return false;
  // Which of them the machine changes is unknown (D-64).
  if (!is_of_control && !setup_.pass_words.contains(name)) calls_of_line_.push_back(name);
  return true;
}

std::string SinumerikFlow::text_of_value(const Value& value) const {
  if (value.is_text) return "\"" + value.text + "\"";
  std::string text;
  append_value(text, value.number, PointStyle::as_whole);
  return text;
}

bool SinumerikFlow::write_words(std::string& flat) {
  const bool changes = !head_.label.empty() || std::ranges::any_of(pieces_, [](const Piece& piece) {
    return piece.instead.has_value();
  });
  if (!changes) {
    is_as_written_ = true;
    flat.append(line_).append(line_end());
    return true;
  }
  const bool is_left = std::ranges::any_of(
      pieces_, [](const Piece& piece) { return !piece.instead || !piece.instead->empty(); });
  if (!is_left) return true;
  const std::size_t in_front =
      head_.label.empty() ? behind_blanks(line_, head_.behind) : head_.label_begin;
  flat.append(line_.substr(0, in_front));
  std::size_t behind = npos;
  for (const Piece& piece : pieces_) {
    // A word left out takes the blanks before it along, the first word those after it.
    const bool is_out = piece.instead && piece.instead->empty();
    if (!is_out) {
      if (behind != npos) flat.append(line_.substr(behind, piece.begin - behind));
      flat.append(piece.instead ? std::string_view(*piece.instead)
                                : line_.substr(piece.begin, piece.end - piece.begin));
    }
    if (!is_out || behind != npos) behind = piece.end;
  }
  flat.append(line_end());
  return true;
}

}  // namespace trc::program
