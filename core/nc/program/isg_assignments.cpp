#include <algorithm>
#include <cmath>
#include <utility>

#include "core/nc/program/gcode_line.h"
#include "core/nc/program/isg_flow.h"
#include "core/nc/program/isg_line.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/words.h"

// Assignments among the words of a line of ISG.

namespace trc::program {

// Reads V.P.A, `+` of `+=` and where the value begins.
bool IsgFlow::read_assigned(Assigned& assigned) {
  ExpressionReader expression = expression_at(assigned.begin);
  assigned.name = place_at(expression);
  if (expression.failed()) return refuse(expression.fault());
  expression.pass_blanks();
  const char sign = expression.peek();
  if (sign != '\0' && std::string_view("+-*/").find(sign) != std::string_view::npos) {
    assigned.changed_by = sign;
    expression.go_to(expression.at() + 1);
  }
  if (expression.peek() != '=')
    return refuse(Code::expression_invalid, assigned.begin, assigned.name + " without =");
  expression.go_to(expression.at() + 1);
  expression.pass_blanks();
  assigned.value_begin = expression.at();
  return true;
}

// Combines `value` of += and the like with the previous value.
bool IsgFlow::change(const Assigned& assigned, Value& value) {
  ExpressionReader old = expression_at(assigned.begin);
  const Value before = old.operand();
  if (old.failed()) return refuse(old.fault());
  const char sign = assigned.changed_by;
  if (sign == '/' && value.number == 0) return refuse(Code::division_by_zero, assigned.begin, "/=");
  value.number = sign == '+'   ? before.number + value.number
                 : sign == '-' ? before.number - value.number
                 : sign == '*' ? before.number * value.number
                               : before.number / value.number;
  return true;
}

bool IsgFlow::scan_assignment(std::size_t& at) {
  Assigned assigned{.begin = at};
  if (!read_assigned(assigned)) return false;
  const std::string& name = assigned.name;
  const bool changes = assigned.changed_by != '\0';
  const bool is_radius = name == "V.G.WZ_AKT.R" || name == "V.G.WZR";
  const bool names_itself =
      in_upper_case(line_.substr(assigned.value_begin, name.size())) == name && !changes;
  if (is_radius && names_itself) {
    const std::size_t behind = behind_blanks(line_, assigned.value_begin + name.size());
    if (sign_at(line_, behind) == '+' || sign_at(line_, behind) == '-')
      return scan_radius(at, behind);
  }
  kept_text_.begin(isg_outlives_program(name) ? name : "");
  ExpressionReader expression = expression_at(assigned.value_begin);
  Value value = expression.expression();
  if (expression.failed()) return refuse(expression.fault());
  if (is_isg_operator(expression.peek()))
    return refuse(Code::expression_invalid, expression.at(), std::string(1, expression.peek()));
  if (changes && !change(assigned, value)) return false;
  kept_text_.end();
  at = expression.at();
  if (!is_radius && !assign(name, value, assigned.begin)) return false;
  write_assigned(assigned, value, at);
  return true;
}

// Writes the assignment up to `at`, unless only the program reads the variable.
void IsgFlow::write_assigned(const Assigned& assigned, const Value& value, std::size_t at) {
  const std::string& name = assigned.name;
  const std::size_t end = end_without_blanks(line_, assigned.begin, at);
  pieces_.push_back({.begin = assigned.begin, .end = end});
  const bool is_own = name.front() == 'P' || name.starts_with("V.L.") || name.starts_with("V.P.") ||
                      name.starts_with("V.CYC.");
  const bool comes_out =
      !is_own || (name.front() != 'P' && writes_variables_ && !modes_.contour_open);
  if (!comes_out) {
    has_computed_ = true;
    pieces_.back().instead = std::string();
    return;
  }
  unwritten_.erase(name);
  const bool changes = assigned.changed_by != '\0';
  std::string text(line_.substr(assigned.begin, assigned.value_begin - assigned.begin));
  if (kept_text_.stays()) {
    text += kept_text_.text(line_, assigned.value_begin, end);
  } else {
    if (changes) text = name + " = ";
    append_number(text, value);
    if (kept_text_.hangs_by_the_way()) warn_of_given(assigned.begin, name);
  }
  double number = 0;
  bool whole = false;
  const bool is_plain = value.is_text || read_number(line_.substr(assigned.value_begin), number,
                                                     whole) == end - assigned.value_begin;
  if (!is_plain || changes) pieces_.back().instead = std::move(text);
}

// V.G.NP[P1].V.X = 2*P2 becomes a number; a value that the machine has stays as it stands.
bool IsgFlow::scan_zero_offset(std::size_t& at) {
  Assigned assigned{.begin = at};
  const std::size_t comment = std::min(line_.find_first_of("(;", at), line_.size());
  at = end_without_blanks(line_, assigned.begin, comment);
  pieces_.push_back({.begin = assigned.begin, .end = at});
  if (!zero_offset_hangs_on_program(line_.substr(assigned.begin))) return true;
  if (!read_assigned(assigned)) return false;
  kept_text_.begin("");
  ExpressionReader expression = expression_at(assigned.value_begin);
  const Value value = expression.expression();
  if (expression.failed()) return refuse(expression.fault());
  kept_text_.end();
  if (behind_blanks(line_, expression.at()) < at)
    return refuse(Code::expression_invalid, expression.at(),
                  name_of_character(line_.substr(expression.at())));
  std::string text = assigned.name + " ";
  if (assigned.changed_by != '\0') text += assigned.changed_by;
  append_number(text.append("= "), value);
  pieces_.back().instead = std::move(text);
  return true;
}

// V.G.WZ_AKT.R = V.G.WZ_AKT.R - P1: tool wear. `value` is the position of the sign.
bool IsgFlow::scan_radius(std::size_t& at, std::size_t value) {
  const std::size_t begin = at;
  ExpressionReader expression = expression_at(value);
  const Value more = expression.expression();
  if (expression.failed()) return refuse(expression.fault());
  at = expression.at();
  std::string text(line_.substr(begin, value - begin));
  text.append(more.number < 0 ? "- " : "+ ");
  append_value(text, std::abs(more.number), PointStyle::as_whole);
  pieces_.push_back(
      {.begin = begin, .end = end_without_blanks(line_, begin, at), .instead = std::move(text)});
  return true;
}

}  // namespace trc::program
