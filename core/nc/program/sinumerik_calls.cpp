#include <algorithm>

#include "core/nc/program/gcode_line.h"
#include "core/nc/program/sinumerik_flow.h"
#include "core/nc/text/characters.h"

// Calls of Sinumerik, with their arguments: of subprograms in the text or the setup, and of
// subprograms that only the machine has.

namespace trc::program {

// CALL "NAME", EXTCALL "NAME": same as NAME if that subprogram is present.
bool SinumerikFlow::scan_call_of_text(std::size_t& at, std::vector<Call>& calls) {
  const std::size_t begin = at;
  const std::string word = name_at(line_, at);
  const std::size_t behind = behind_blanks(line_, at + word.size());
  std::string name;
  if (sign_at(line_, behind) == '"' || sign_at(line_, behind) == '(') {
    ExpressionReader expression = expression_at(behind);
    const Value value = expression.expression();
    if (expression.failed()) return refuse(expression.fault());
    at = end_without_blanks(line_, begin, expression.at());
    name = value.text;
  }
  name.erase(0, name.find_last_of("/\\") + 1);
  const Unit* const unit = unit_named(in_upper_case(name.substr(0, name.find('.'))));
  if (unit == nullptr) {
    at = line_.size();
    keep(begin, at);
    calls_of_line_.push_back(word);
    reads_variables_ = true;
    return true;
  }
  calls.push_back({.unit = unit, .begin = begin});
  leave_out(begin, at);
  return true;
}

// Writes the arguments of a call that is passed on: `at` is after it.
bool SinumerikFlow::scan_call_arguments(std::size_t begin, std::size_t& at) {
  const std::size_t open = line_.find('(', begin);
  std::string text(line_.substr(begin, open - begin));
  bool changes = false;
  if (!append_arguments(open, at, text, changes, name_at(line_, begin))) return false;
  pieces_.push_back({.begin = begin, .end = at});
  if (changes) pieces_.back().instead = std::move(text);
  return true;
}

// Appends the text from the bracket at `open` to its end before `end`, with values.
bool SinumerikFlow::append_arguments(std::size_t open, std::size_t end, std::string& text,
                                     bool& changes, std::string_view call) {
  text += line_[open];
  called_ = call;
  std::size_t argument = open + 1;
  for (std::size_t place = 0; argument < end; ++place) {
    std::size_t next = argument;
    bool quoted = false;
    for (int depth = 0; next < end; ++next) {
      const char sign = line_[next];
      if (sign == '"') quoted = !quoted;
      if (quoted) continue;
      if (depth == 0 && (sign == ',' || sign == ')' || sign == ']')) break;
      if (sign == '(' || sign == '[') ++depth;
      if (sign == ')' || sign == ']') --depth;
    }
    if (next == end) break;  // blanks after the bracket
    if (!append_argument(argument, next, passing_to(call, place), text, changes)) return false;
    text += line_[next];
    argument = next + 1;
  }
  return true;
}

// A variable that the call may set stays a variable if its DEF stays.
bool SinumerikFlow::append_argument(std::size_t begin, std::size_t end, Passing passing,
                                    std::string& text, bool& changes) {
  const std::size_t first = behind_blanks(line_, begin);
  const std::string_view words = without_blanks_behind(line_.substr(first, end - first));
  const std::string name = name_at(line_, first);
  const bool is_name = !name.empty() && name.size() == words.size();
  const bool is_variable = is_name && (declared(name) != nullptr || is_variable_name(name));
  const bool is_known =
      is_variable || given_by_setup(name) != nullptr || name == "TRUE" || name == "FALSE";
  double number = 0;
  bool whole = false;
  const bool is_text =
      words.size() > 1 && words.front() == '"' && words.find('"', 1) == words.size() - 1;
  const bool stays = is_variable && passing != Passing::by_value && is_kept(name);
  if (is_variable && passing != Passing::by_value) given_to_calls_.push_back(name);
  if (words.empty() || is_text || (is_name && !is_known) || stays ||
      read_named_number(words, number, whole) == words.size()) {
    text.append(line_.substr(begin, end - begin));
    return true;
  }
  if (passing == Passing::by_reference)
    return refuse(Code::nc_unsupported, first,
                  called_ + "(" + std::string(words) +
                      "), which sets a variable that DEF of the main program does not name");
  ExpressionReader expression = expression_at(first);
  const Value value = expression.expression();
  if (expression.failed()) return refuse(expression.fault());
  if (expression.at() != end) return refuse(Code::expression_invalid, first, std::string(words));
  text.append(line_.substr(begin, first - begin)).append(text_of_value(value));
  changes = true;
  return true;
}

bool SinumerikFlow::call(std::string& flat, const Call& call) {
  const Unit& unit = *call.unit;
  const auto others = std::ranges::count_if(units_, [&](const Unit& each) {
    return each.name == unit.name && (each.text == 0) == (unit.text == 0);
  });
  if (others > 1)
    return refuse(Code::subprogram_unknown, call.begin, unit.name + ", which is there twice");
  std::string comment = "; " + unit.name;
  const bool is_alone = std::ranges::all_of(
      pieces_, [](const Piece& piece) { return piece.is_comment || piece.instead == ""; });
  if (is_alone && !pieces_.empty() && pieces_.back().is_comment)
    comment.append(" ").append(line_.substr(pieces_.back().begin));
  Scope scope;
  if (!pass_arguments(call, scope)) return false;
  if (looks_ahead()) {  // the values of its parameters are unknown
    forget_values();
    return write_words(flat);
  }
  if (is_alone) {
    write_behind_number(flat, comment);
  } else {
    write_words(flat);
    is_as_written_ = false;
    flat.append(comment).append(line_end());
  }
  if (!enter({.text = unit.text,
              .begin = unit.begin,
              .end = unit.end,
              .next = unit.begin,
              .current = unit.begin,
              .restart = unit.begin,
              .repetitions_left = call.times.value_or(1) - 1,
              .name = unit.name,
              .own_variables = true}))
    return false;
  scopes_.push_back(std::move(scope));
  return true;
}

// A missing argument has its value from PROC, else 0.
bool SinumerikFlow::pass_arguments(const Call& call, Scope& scope) {
  std::vector<Parameter> parameters;
  if (!read_head(*call.unit, parameters)) return false;
  const std::string_view head = texts_[call.unit->text].line(call.unit->head);
  std::size_t at = call.arguments;
  bool is_over = at == 0;
  for (const Parameter& parameter : parameters) {
    const bool is_text = parameter.type == Type::text;
    Variable variable{.type = parameter.type, .elements = {Value{.is_text = is_text}}};
    if (!is_over) at = behind_blanks(line_, at + 1);
    const char sign = is_over ? ')' : sign_at(line_, at);
    Value value{.is_text = is_text};
    if (sign != ',' && sign != ')') {
      ExpressionReader expression = expression_at(at);
      if (parameter.by_reference) {
        variable.stands_for = place_at(expression);
        expression.pass_blanks();
      } else {
        value = expression.expression();
      }
      if (expression.failed()) return refuse(expression.fault());
      at = expression.at();
    } else if (parameter.default_begin > 0) {
      ExpressionReader expression(sinumerik_grammar(), head, parameter.default_begin, *this);
      value = expression.expression();
    }
    if (!convert(value, parameter.type, call.begin)) return false;
    variable.elements.front() = std::move(value);
    if (!is_over && sign_at(line_, at) != ',' && sign_at(line_, at) != ')')
      return refuse(Code::expression_invalid, at, name_of_character(line_.substr(at)));
    is_over |= sign_at(line_, at) == ')';
    scope.insert_or_assign(parameter.name, std::move(variable));
  }
  if (is_over) return true;
  // NAME() of a program without parameters.
  if (parameters.empty() && sign_at(line_, behind_blanks(line_, at + 1)) == ')') return true;
  return refuse(Code::value_invalid, call.begin,
                call.unit->name + " with more values than it takes");
}

// Returns from the executed subprogram and from all repetitions within it.
bool SinumerikFlow::return_from(std::string& flat) {
  if (looks_ahead()) return true;
  while (frames_.size() > 1 && !frame().own_variables) frames_.pop_back();
  if (frames_.size() == 1) {
    if (!ended_ && name_at(line_, head_.behind) == "RET") write_behind_number(flat, "M17");
    return end_of_program(flat);
  }
  if (frame().repetitions_left > 0) {
    --frame().repetitions_left;
    frame().next = frame().restart;
    flat.append("; ").append(frame().name).append(line_end());
    return true;
  }
  scopes_.pop_back();
  frames_.pop_back();
  return true;
}

}  // namespace trc::program
