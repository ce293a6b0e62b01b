#include <algorithm>
#include <array>
#include <cmath>

#include "core/nc/program/gcode_line.h"
#include "core/nc/program/sinumerik_flow.h"
#include "core/nc/text/characters.h"

// DEF and PROC of Sinumerik: the types, sizes and initial values of variables.

namespace trc::program {
namespace {

constexpr std::size_t most_elements = 10'000;  // of all arrays together
constexpr std::size_t most_sizes = 3;

}  // namespace

std::optional<SinumerikFlow::Type> SinumerikFlow::type_at(ExpressionReader& expression) {
  constexpr auto types =
      std::to_array<std::pair<std::string_view, Type>>({{"BOOL", Type::boolean},
                                                        {"CHAR", Type::character},
                                                        {"INT", Type::integer},
                                                        {"REAL", Type::real},
                                                        {"STRING", Type::text}});
  expression.pass_blanks();
  const std::size_t begin = expression.at();
  const std::string word = in_upper_case(expression.name());
  const auto found = std::ranges::find(types, word, &std::pair<std::string_view, Type>::first);
  if (found == types.end()) {
    const bool is_other = word == "AXIS" || word == "FRAME";
    static_cast<void>(expression.fail(is_other ? Code::nc_unsupported : Code::expression_invalid,
                                      begin, word + ", a type"));
    return {};
  }
  expression.go_to(begin + word.size());
  expression.pass_blanks();
  if (found->second == Type::text && expression.peek() == '[') {
    const std::size_t behind = behind_bracket(expression.line(), expression.at());
    expression.go_to(behind == 0 ? expression.line().size() : behind);
  }
  return found->second;
}

bool SinumerikFlow::define(std::string& flat) {
  ExpressionReader expression = expression_at(head_.behind + 3);
  expression.pass_blanks();
  for (const std::string_view kind : {"NCK", "CHAN"})
    if (in_upper_case(expression.name()) == kind) expression.go_to(expression.at() + kind.size());
  const auto type = type_at(expression);
  if (!type) return refuse(expression.fault());
  bool stays = false;
  do {
    expression.pass_blanks();
    stays |= scopes_.size() == 1 && kept_.contains(in_upper_case(expression.name()));
    if (!define_one(expression, *type)) return false;
    expression.pass_blanks();
    if (expression.peek() != ',') break;
    expression.go_to(expression.at() + 1);
  } while (true);
  if (stays) settings_.append(line_).append(line_end());
  std::string comment;
  return finish_statement(stays ? comment : flat, expression.at());
}

bool SinumerikFlow::define_one(ExpressionReader& expression, Type type) {
  expression.pass_blanks();
  const std::size_t begin = expression.at();
  const std::string name = in_upper_case(expression.name());
  if (name.empty() || is_variable_name(name))
    return refuse(Code::expression_invalid, begin, "DEF without a name");
  expression.go_to(begin + name.size());
  expression.pass_blanks();
  Variable variable{.type = type};
  std::size_t count = 1;
  if (expression.peek() == '[') {
    do {
      expression.go_to(expression.at() + 1);
      const double size = expression.expression().number;
      if (expression.failed()) return refuse(expression.fault());
      const bool is_size = size >= 1 && size <= static_cast<double>(most_elements) &&
                           size == std::round(size) && variable.sizes.size() < most_sizes;
      if (!is_size) return refuse(Code::value_invalid, begin, name + "[");
      variable.sizes.push_back(static_cast<std::size_t>(size));
      count *= variable.sizes.back();
      std::size_t held = count;
      for (const Scope& scope : scopes_)
        for (const auto& [other, known] : scope)
          if (known.elements.size() > 1) held += known.elements.size();
      if (held > most_elements) return refuse(Code::value_invalid, begin, name + "[");
    } while (expression.peek() == ',');
    if (expression.peek() != ']') return refuse(Code::expression_invalid, begin, name + "[");
    expression.go_to(expression.at() + 1);
  }
  variable.elements.resize(count, Value{.is_text = type == Type::text});
  expression.pass_blanks();
  if (expression.peek() == '=') {
    expression.go_to(expression.at() + 1);
    if (!initialise(expression, variable, 0)) return false;
  }
  scopes_.back().insert_or_assign(name, std::move(variable));
  return true;
}

// A value; for an array SET(…), (…) or REP(…), from its first element on. REP sets the rest of the
// array too.
bool SinumerikFlow::initialise(ExpressionReader& expression, Variable& variable,
                               std::size_t element) {
  expression.pass_blanks();
  const std::size_t begin = expression.at();
  const std::string word = in_upper_case(expression.name());
  const bool repeats = word == "REP";
  if (word == "SET" || repeats) expression.go_to(begin + word.size());
  expression.pass_blanks();
  const bool is_list =
      !variable.sizes.empty() && expression.peek() == '(' && (element == 0 || !word.empty());
  if (!is_list) {
    expression.go_to(begin);
    Value value = expression.expression();
    if (expression.failed()) return refuse(expression.fault());
    if (!convert(value, variable.type, begin)) return false;
    // A single value sets all elements.
    const std::size_t end = variable.sizes.empty() ? 1 : variable.elements.size();
    std::fill(variable.elements.begin() + static_cast<std::ptrdiff_t>(element),
              variable.elements.begin() + static_cast<std::ptrdiff_t>(end), value);
    return true;
  }
  std::vector<Value> values;
  do {
    expression.go_to(expression.at() + 1);
    values.push_back(expression.expression());
    if (expression.failed()) return refuse(expression.fault());
    if (!repeats && !convert(values.back(), variable.type, begin)) return false;
  } while (expression.peek() == ',');
  if (expression.peek() != ')') return refuse(Code::expression_invalid, begin, word + "(");
  expression.go_to(expression.at() + 1);
  const std::size_t room = variable.elements.size() - element;
  std::size_t count = repeats ? room : values.size();
  if (repeats && values.size() == 2 && values[1].number >= 1 &&
      values[1].number <= static_cast<double>(room))
    count = static_cast<std::size_t>(std::llround(values[1].number));
  const bool is_right =
      repeats ? values.size() == 1 || (values.size() == 2 && count <= room) : count <= room;
  if (!is_right) return refuse(Code::value_invalid, begin, "more values than elements");
  if (repeats && !convert(values.front(), variable.type, begin)) return false;
  for (std::size_t index = 0; index < count; ++index)
    variable.elements[element + index] = repeats ? values.front() : values[index];
  return true;
}

// PROC NAME(REAL X, VAR INT N, REAL DEPTH=5)
bool SinumerikFlow::read_head(const Unit& unit, std::vector<Parameter>& parameters) {
  if (!unit.has_head) return true;
  const std::string_view line = texts_[unit.text].line(unit.head);
  const std::size_t proc = named_head_of(line).behind + 4;
  ExpressionReader expression(sinumerik_grammar(), line, proc, *this);
  const auto refused = [&](std::string_view why) {
    return refuse(Code::expression_invalid, 0, "PROC " + unit.name + std::string(why));
  };
  expression.pass_blanks();
  expression.go_to(expression.at() + expression.name().size());
  expression.pass_blanks();
  if (expression.peek() == '(') {
    const std::size_t end = behind_bracket(line, expression.at());
    if (end == 0) return refused(", ( without )");
    do {
      expression.go_to(expression.at() + 1);
      expression.pass_blanks();
      if (expression.peek() == ')') break;
      Parameter parameter;
      if (in_upper_case(expression.name()) == "VAR") {
        parameter.by_reference = true;
        expression.go_to(expression.at() + 3);
      }
      const auto type = type_at(expression);
      if (!type) return refuse(expression.fault().code, 0, expression.fault().detail);
      parameter.type = *type;
      expression.pass_blanks();
      parameter.name = in_upper_case(expression.name());
      if (parameter.name.empty()) return refused(", a parameter without name");
      expression.go_to(expression.at() + parameter.name.size());
      expression.pass_blanks();
      if (expression.peek() == '[') return refused(", an array as parameter");
      if (expression.peek() == '=') {
        parameter.default_begin = expression.at() + 1;
        expression.go_to(parameter.default_begin);
        static_cast<void>(expression.expression());
        if (expression.failed()) return refuse(expression.fault().code, 0, unit.name);
      }
      parameters.push_back(std::move(parameter));
    } while (expression.peek() == ',');
    if (expression.peek() != ')') return refused(", what stands between ( and )");
    expression.go_to(end);
  }
  // SAVE restores modes after the return; which modes the subprogram changes is not followed.
  if (place_of_word(line, expression.at(), "SAVE", WordEnd::whole) != std::string_view::npos)
    return refuse(Code::nc_unsupported, 0, "SAVE of PROC " + unit.name);
  return true;
}

}  // namespace trc::program
