#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/reasons.h"
#include "core/nc/program/gcode_line.h"
#include "core/nc/program/sinumerik_flow.h"
#include "core/nc/text/characters.h"

// The values of R parameters and of variables that DEF and PROC declare.

namespace trc::program {
namespace {

constexpr std::int64_t most_parameters = 100'000;
constexpr std::size_t longest_text = 400;

}  // namespace

// The number of R12; -1: the name is no R parameter.
std::int64_t SinumerikFlow::number_of_parameter(std::string_view name) {
  constexpr std::size_t most_digits = 6;
  if (name.size() < 2 || name.size() > most_digits + 1 || upper(name.front()) != 'R') return -1;
  std::int64_t number = 0;
  for (const char digit : name.substr(1)) {
    if (!is_digit(digit)) return -1;
    number = number * 10 + (digit - '0');
  }
  return number;
}

SinumerikFlow::Variable* SinumerikFlow::declared(std::string_view name) {
  const auto found = scopes_.back().find(name);
  return found == scopes_.back().end() ? nullptr : &found->second;
}

const double* SinumerikFlow::given_by_setup(std::string_view name) const {
  return set_on_machine_.contains(name.substr(0, name.find('['))) ? nullptr : given(name);
}

bool SinumerikFlow::is_variable_name(std::string_view name) {
  return number_of_parameter(name) >= 0;
}

// Whether a variable is assigned a value there.
bool SinumerikFlow::is_variable_at(std::size_t at) const {
  // Longer than any name: words without blanks between them are not searched anew for each.
  constexpr std::size_t longest_name = 256;
  const std::string name = name_at(line_.substr(at, longest_name), 0);
  const std::size_t behind = behind_blanks(line_, at + name.size());
  const char sign = behind < line_.size() ? line_[behind] : '\0';
  if (sign != '=' && sign != '[') return false;
  return name == "R" ? sign == '['
                     : number_of_parameter(name) >= 0 || scopes_.back().contains(name);
}

std::optional<SinumerikFlow::Place> SinumerikFlow::place_at(ExpressionReader& expression) {
  expression.pass_blanks();
  const std::size_t begin = expression.at();
  const std::string name = in_upper_case(expression.name());
  const auto none = [&](Code code) {
    static_cast<void>(expression.fail(code, begin, name.empty() ? "a variable" : name));
    return std::optional<Place>();
  };
  Place place{.scope = scopes_.size() - 1, .name = name};
  if (const Variable* const variable = declared(name)) {
    expression.go_to(begin + name.size());
    place.element = element_at(expression, *variable);
    if (expression.failed()) return {};
    return variable->stands_for ? *variable->stands_for : place;
  }
  place.parameter = number_of_parameter(name);
  if (place.parameter >= 0) {
    expression.go_to(begin + name.size());
    return place;
  }
  if (name != "R") return none(name.empty() ? Code::expression_invalid : Code::variable_unset);
  expression.go_to(begin + 1);
  expression.pass_blanks();
  if (expression.peek() != '[') return none(Code::expression_invalid);
  expression.go_to(expression.at() + 1);
  const double number = expression.expression().number;
  if (expression.failed()) return {};
  if (expression.peek() != ']') return none(Code::expression_invalid);
  place.parameter = std::llround(number);
  if (number < 0 || number > static_cast<double>(most_parameters) ||
      std::abs(number - std::round(number)) > 1e-9)
    return none(Code::value_invalid);
  expression.go_to(expression.at() + 1);
  return place;
}

// The element that [index, index, …] names; the first one without an index.
std::size_t SinumerikFlow::element_at(ExpressionReader& expression, const Variable& variable) {
  const std::size_t begin = expression.at();
  const std::size_t bracket = behind_blanks(expression.line(), begin);
  const bool has_bracket = bracket < expression.line().size() && expression.line()[bracket] == '[';
  const auto failed = [&](Code code, std::string_view what) {
    static_cast<void>(expression.fail(code, begin, std::string(what)));
    return std::size_t{0};
  };
  if (!has_bracket)
    return variable.sizes.empty() ? 0 : failed(Code::expression_invalid, "an array without [ ]");
  if (variable.sizes.empty()) return failed(Code::expression_invalid, "[ ] of no array");
  expression.go_to(bracket);
  std::size_t element = 0;
  for (std::size_t index = 0; index < variable.sizes.size(); ++index) {
    if (expression.peek() != (index == 0 ? '[' : ',')) return failed(Code::expression_invalid, "[");
    expression.go_to(expression.at() + 1);
    const double number = expression.expression().number;
    if (expression.failed()) return 0;
    const std::size_t size = variable.sizes[index];
    if (number != std::round(number) || number < 0 || number >= static_cast<double>(size))
      return failed(Code::value_invalid, "an index beyond its array");
    element = element * size + static_cast<std::size_t>(number);
  }
  if (expression.peek() != ']') return failed(Code::expression_invalid, "[");
  expression.go_to(expression.at() + 1);
  return element;
}

bool SinumerikFlow::assign_at(ExpressionReader& expression) {
  const std::size_t begin = expression.at();
  const auto place = place_at(expression);
  expression.pass_blanks();
  if (!expression.failed() && expression.peek() != '=')
    static_cast<void>(expression.fail(Code::expression_invalid, begin, "a variable without ="));
  if (expression.failed()) return refuse(expression.fault());
  expression.go_to(expression.at() + 1);
  expression.pass_blanks();
  const std::string word = in_upper_case(expression.name());
  if (place->parameter < 0 && (word == "SET" || word == "REP")) {
    Variable& variable = scopes_[place->scope][place->name];
    Place set = *place;
    for (; set.element < variable.elements.size(); ++set.element) note_setting(set);
    return initialise(expression, variable, place->element);
  }
  const std::size_t value_begin = expression.at();
  kept_text_.begin(place->parameter >= 0 ? "R" + std::to_string(place->parameter) : "");
  const Value value = expression.expression();
  kept_text_.end();
  if (expression.failed()) return refuse(expression.fault());
  if (!store(*place, value, begin)) return false;
  if (place->parameter < 0) {
    scopes_[place->scope][place->name].of_machine = kept_text_.hangs_on_machine();
    return true;
  }
  // The control computes the value anew in each run (D-88).
  const std::string name = "R" + std::to_string(place->parameter);
  note_counter(name);
  if (kept_text_.stays()) {
    const std::size_t end = end_without_blanks(line_, value_begin, expression.at());
    settings_.append(name).append("=").append(kept_text_.text(line_, value_begin, end));
    settings_.append(line_end());
    unwritten_.erase(place->parameter);
  } else if (kept_text_.hangs_by_the_way()) {
    warn_of_given(begin, name);
  }
  return true;
}

bool SinumerikFlow::store(const Place& place, const Value& value, std::size_t begin) {
  Value converted = value;
  const bool is_parameter = place.parameter >= 0;
  Variable* const variable = is_parameter ? nullptr : &scopes_[place.scope][place.name];
  if (!convert(converted, is_parameter ? Type::real : variable->type, begin)) return false;
  note_setting(place);
  if (is_parameter) {
    if (!counters_.empty()) counters_.erase("R" + std::to_string(place.parameter));
    parameters_[place.parameter] = converted.number;
  } else {
    variable->elements[place.element] = std::move(converted);
    variable->is_lost = false;
  }
  return true;
}

// As the control does when it assigns a value.
bool SinumerikFlow::convert(Value& value, Type type, std::size_t begin) {
  constexpr double smallest = -2147483648.0;
  constexpr double largest = 2147483647.0;
  constexpr double largest_character = 255;
  if (type == Type::text || value.is_text) {
    if (type != Type::text || !value.is_text)
      return refuse(Code::expression_invalid, begin, "a text and a number");
    return value.text.size() <= longest_text ||
           refuse(Code::value_invalid, begin, "a text that is too long");
  }
  if (type == Type::boolean) value.number = value.number != 0 ? 1 : 0;
  if (type != Type::integer && type != Type::character) return true;
  value.number = std::round(value.number);
  const bool fits = type == Type::integer ? value.number >= smallest && value.number <= largest
                                          : value.number >= 0 && value.number <= largest_character;
  return fits || refuse(Code::value_invalid, begin, "beyond the range of its type");
}

Value SinumerikFlow::content_of(const Place& place, ExpressionReader& expression,
                                std::size_t begin) {
  Value value = value_of(place, expression, begin);
  const std::string text = value.is_text ? value.text : text_of_value(value);
  kept_text_.take(begin, expression.at(), text.starts_with('-') ? "(" + text + ")" : text);
  return value;
}

Value SinumerikFlow::value_of(const Place& place, ExpressionReader& expression, std::size_t begin) {
  const std::string lost = lost_to_.empty() ? "" : ", which may have been set by " + lost_to_;
  if (place.parameter < 0) {
    const Variable& variable = scopes_[place.scope][place.name];
    if (variable.of_machine) kept_text_.hang_by_the_way();
    if (!variable.is_lost) return variable.elements[place.element];
    if (const double* const value = given(place.name)) return {.number = *value};
    return without_value(expression, Code::variable_unset, begin, place.name + lost);
  }
  const std::string name = "R" + std::to_string(place.parameter);
  const bool* const counted = counter(name);
  const auto known = parameters_.find(place.parameter);
  if (known != parameters_.end() && (counted == nullptr || *counted)) {
    if (counted != nullptr) kept_text_.keep(name);
    return {.number = known->second};
  }
  const double* const value = known == parameters_.end() ? given(name) : nullptr;
  if (value != nullptr) {
    kept_text_.keep(name);
    return {.number = *value};
  }
  if (kept_text_.may_be_unknown(name)) {
    kept_text_.keep_unknown(name);
    return {.number = 1};
  }
  return without_value(expression, Code::variable_unset, begin,
                       counted == nullptr ? name + lost : name);
}

Value SinumerikFlow::read(ExpressionReader& expression) {
  suppose();
  if (expression.peek() == '$') return read_system_variable(expression);
  const std::size_t begin = expression.at();
  const std::string name = in_upper_case(expression.name());
  if (declared(name) == nullptr && name != "R" && number_of_parameter(name) < 0) {
    const std::string_view line = expression.line();
    std::size_t end = begin + name.size();
    std::string whole = name;
    if (end < line.size() && line[end] == '[')
      if (const std::size_t behind = behind_bracket(line, end); behind > 0) {
        whole.append(line.substr(end, behind - end));
        end = behind;
      }
    if (name == "TRUE" || name == "FALSE") {
      expression.go_to(begin + name.size());
      return {.number = name == "TRUE" ? 1.0 : 0.0};
    }
    whole = in_upper_case(whole);
    std::erase(whole, ' ');
    const double* const value = given_by_setup(whole);
    if (value != nullptr) kept_text_.hang_by_the_way();
    const bool is_call = end < line.size() && line[end] == '(';
    if (value == nullptr && is_call) return expression.fail(Code::expression_invalid, begin, whole);
    expression.go_to(end);
    if (value != nullptr) kept_text_.take(begin, end, text_of_value({.number = *value}));
    if (value == nullptr && set_on_machine_.contains(name)) whole += reason::machine_variable_set;
    if (value == nullptr) return without_value(expression, Code::variable_unset, begin, whole);
    return {.number = *value};
  }
  const auto place = kept_text_.read_aside([&] { return place_at(expression); });
  return expression.failed() ? Value{} : content_of(*place, expression, begin);
}

// A variable that only the machine knows, unless the setup gives it.
Value SinumerikFlow::read_system_variable(ExpressionReader& expression) {
  const std::string_view line = expression.line();
  const std::size_t begin = expression.at();
  std::string name = "$" + name_at(line, begin + 1);
  std::size_t end = begin + name.size();
  if (end < line.size() && line[end] == '[')
    if (const std::size_t behind = behind_bracket(line, end); behind > 0) {
      name.append(in_upper_case(line.substr(end, behind - end)));
      end = behind;
    }
  std::erase(name, ' ');
  expression.go_to(end);
  if (name == "$PI") return {.number = std::numbers::pi};
  if (const double* const value = given(name)) {
    kept_text_.hang_by_the_way();
    kept_text_.take(begin, end, text_of_value({.number = *value}));
    return {.number = *value};
  }
  // Variables that the control itself counts and measures.
  if (name.starts_with("$A") && kept_text_.may_be_unknown(name)) {
    kept_text_.keep_unknown(name);
    kept_text_.take(begin, end, name);
    return {.number = 1};
  }
  return without_value(expression, Code::machine_state, begin, name);
}

bool SinumerikFlow::exists(ExpressionReader& /*expression*/) { return false; }

}  // namespace trc::program
