#include <algorithm>
#include <array>
#include <cmath>

#include "core/nc/program/gcode_line.h"
#include "core/nc/program/isg_flow.h"
#include "core/nc/text/characters.h"

// Parameters and variables of ISG.

namespace trc::program {
namespace {

// The variable that an element belongs to: V.P.A of V.P.A[2].
std::string_view base_of(std::string_view name) { return name.substr(0, name.find('[')); }

bool has_base(const std::map<std::string, Value, std::less<>>& values, std::string_view base) {
  const auto found = values.lower_bound(base);
  return found != values.end() && base_of(found->first) == base;
}

bool is_local(std::string_view name) { return name.starts_with("V.L."); }

// Positions of axes: no single value holds for the whole program.
bool is_place_of_axis(std::string_view name) {
  constexpr auto groups =
      std::to_array<std::string_view>({"V.A.ABS.", "V.A.ACS.", "V.A.PCS.", "V.A.WCS.", "V.A.MCS.",
                                       "V.A.PROG.", "V.A.CMD.", "V.A.ACT.", "V.A.POS."});
  return std::ranges::any_of(groups,
                             [&](std::string_view group) { return name.starts_with(group); });
}

// The program knows the values of P, V.P., V.L., V.S. and V.CYC.
bool belongs_to_program(std::string_view name) {
  return name.front() == 'P' || name.starts_with("V.P.") || is_local(name) ||
         name.starts_with("V.S.") || name.starts_with("V.CYC.");
}

}  // namespace

bool isg_outlives_program(std::string_view name) {
  return name.starts_with("V.S.") || name.starts_with("V.E.");
}

std::string IsgFlow::place_at(ExpressionReader& expression) {
  expression.pass_blanks();
  const std::size_t begin = expression.at();
  const std::string_view line = expression.line();
  if (is_isg_parameter_at(line, begin)) return parameter_at(expression);
  if (!is_isg_variable_at(line, begin)) {
    static_cast<void>(expression.fail(Code::expression_invalid, begin, "a variable"));
    return {};
  }
  std::string name;
  std::size_t at = begin;
  while (at < line.size() && (goes_on_as_name(line[at]) || line[at] == '.')) ++at;
  const std::string_view spelling = line.substr(begin, at - begin);
  spellings_.try_emplace(in_upper_case(spelling), spelling);
  for (at = begin;;) {
    while (at < line.size() && (goes_on_as_name(line[at]) || line[at] == '.'))
      name += upper(line[at++]);
    if (at >= line.size() || line[at] != '[') break;
    expression.go_to(at);
    name += indices_at(expression);
    if (expression.failed()) return {};
    at = expression.at();
  }
  expression.go_to(at);
  return name;
}

// P12, P[P1+1], P1[2] and PP1, the parameter whose number P1 holds.
std::string IsgFlow::parameter_at(ExpressionReader& expression) {
  const std::size_t begin = expression.at();
  const std::string_view line = expression.line();
  std::size_t at = begin + 1;
  while (at < line.size() && upper(line[at]) == 'P') ++at;
  const std::size_t holders = at - begin - 1;
  expression.go_to(at);
  std::int64_t number = 0;
  const bool is_computed = expression.peek() == '[';
  if (is_computed) {
    number = expression.whole_operand();
  } else {
    constexpr std::size_t most_digits = 9;
    std::size_t end = at;
    for (; end < line.size() && is_digit(line[end]) && end - at < most_digits; ++end)
      number = number * 10 + (line[end] - '0');
    expression.go_to(end);
  }
  std::string name = numbered_parameter(expression, number, begin);
  if (!is_computed && !expression.failed()) name += indices_at(expression);
  for (std::size_t holder = 0; holder < holders && !expression.failed(); ++holder)
    name = numbered_parameter(expression, number_held(expression, name, begin), begin);
  return expression.failed() ? std::string() : name;
}

std::string IsgFlow::numbered_parameter(ExpressionReader& expression, std::int64_t number,
                                        std::size_t begin) {
  if (number < 1 && !expression.failed())
    static_cast<void>(expression.fail(Code::value_invalid, begin, "the number of a parameter"));
  return "P" + std::to_string(number);
}

// The number of another parameter that a parameter holds; 0: it holds none.
std::int64_t IsgFlow::number_held(ExpressionReader& expression, const std::string& name,
                                  std::size_t begin) {
  const Value* const value = held(name);
  if (value == nullptr) {
    static_cast<void>(without_value(expression, Code::variable_unset, begin, name));
    return 0;
  }
  constexpr double largest = 1e9;
  const bool is_number = value->number == std::round(value->number) && value->number < largest;
  return is_number ? std::llround(value->number) : 0;
}

// [2][P1] and [2, P1]
std::string IsgFlow::indices_at(ExpressionReader& expression) {
  std::string indices;
  while (expression.peek() == '[' && !expression.failed()) {
    const std::size_t begin = expression.at();
    do {
      expression.go_to(expression.at() + 1);
      const Value index = expression.expression();
      if (!expression.failed() && (index.number < 0 || index.number != std::round(index.number)))
        static_cast<void>(expression.fail(Code::value_invalid, begin, "an index"));
      if (expression.failed()) return {};
      indices += '[';
      append_value(indices, index.number, PointStyle::as_whole);
      indices += ']';
      expression.pass_blanks();
    } while (expression.peek() == ',');
    if (expression.peek() != ']')
      static_cast<void>(expression.fail(Code::expression_invalid, begin, "[ without ]"));
    else
      expression.go_to(expression.at() + 1);
  }
  return indices;
}

// V.L. variables are known where they are declared and in subprograms called from there. A called
// subprogram may declare its own.
std::size_t IsgFlow::level_of(std::string_view name) const {
  const std::size_t own = locals_.size() - 1;
  const std::string_view base = base_of(name);
  const bool is_of_caller = own > 0 && !in_declaration_ && !has_base(locals_[own], base) &&
                            has_base(locals_[own - 1], base);
  return is_of_caller ? own - 1 : own;
}

IsgFlow::Values& IsgFlow::values_of(std::string_view name) {
  return is_local(name) ? locals_[level_of(name)] : values_;
}

const Value* IsgFlow::held(const std::string& name) const {
  const Values& values = is_local(name) ? locals_[level_of(name)] : values_;
  const auto found = values.find(name);
  return found == values.end() ? nullptr : &found->second;
}

bool IsgFlow::assign(const std::string& name, Value value, std::size_t begin) {
  constexpr std::size_t most_values = 100'000;
  if (name.starts_with("V.G.WZ[")) values_[name] = value;
  if (!belongs_to_program(name)) return true;  // a variable of the machine: its value is unknown
  if (whole_.contains(base_of(name)) && value.number != std::round(value.number))
    return refuse(Code::value_invalid, begin, name + ", which is declared whole");
  Values& values = values_of(name);
  const bool is_known = in_declaration_ || looks_ahead() || has_base(values, base_of(name));
  if (is_local(name) && !is_known)
    return refuse(Code::value_invalid, begin, name + ", which is declared nowhere");
  if (!in_declaration_ && fields_.contains(base_of(name)) && !values.contains(name))
    return refuse(Code::value_invalid, begin, name + ", outside of what is declared");
  if (values.size() >= most_values && !values.contains(name))
    return refuse(Code::value_invalid, begin, "so many variables");
  note_counter(name);
  if (!isg_outlives_program(name) && kept_text_.hangs_on_machine())
    of_machine_.insert(name);
  else if (!of_machine_.empty())
    of_machine_.erase(name);
  values[name] = std::move(value);
  assigned_.push_back(name);
  if (!is_local(name) && !name.starts_with("V.S.")) unwritten_.insert(name);
  return true;
}

Value IsgFlow::read(ExpressionReader& expression) {
  suppose();
  const std::size_t begin = expression.at();
  const std::string_view line = expression.line();
  if (!is_isg_parameter_at(line, begin) && !is_isg_variable_at(line, begin)) {
    const std::string name = in_upper_case(expression.name());
    if (name == "TRUE" || name == "FALSE") {
      expression.go_to(begin + name.size());
      return {.number = name == "TRUE" ? 1.0 : 0.0};
    }
    return expression.fail(Code::expression_invalid, begin, name);
  }
  const std::string name = kept_text_.read_aside([&] { return place_at(expression); });
  if (expression.failed()) return {};
  const std::size_t equals = behind_blanks(line, expression.at());
  const bool assigns = equals + 1 < line.size() && line[equals] == '=' && line[equals + 1] != '=';
  if (assigns && !assigns_in_choice_)
    return expression.fail(Code::expression_invalid, equals, "=, where == compares");
  if (assigns) {
    expression.go_to(equals + 1);
    Value value = expression.expression();
    if (expression.failed()) return {};
    if (!belongs_to_program(name)) return expression.fail(Code::machine_state, begin, name);
    values_of(name)[name] = value;
    return value;
  }
  // No manual defines which of the two comes first.
  if (reads_words_ && std::ranges::find(assigned_, name) != assigned_.end())
    return expression.fail(Code::value_invalid, begin, name + ", which its own line sets");
  const std::size_t end = expression.at();
  Value value = value_of(expression, name, begin);
  std::string text;
  append_number(text, value);
  kept_text_.take(begin, end, text.front() == '-' ? "[" + text + "]" : text);
  return value;
}

Value IsgFlow::value_of(ExpressionReader& expression, const std::string& name, std::size_t begin) {
  const bool* const counted = counter(name);
  const Value* const value = held(name);
  if (value != nullptr && (counted == nullptr || *counted)) {
    if (counted != nullptr) kept_text_.keep(name);
    if (of_machine_.contains(name)) kept_text_.hang_by_the_way();
    return *value;
  }
  if (const double* const number = given(name)) {
    if (isg_outlives_program(name))
      kept_text_.keep(name);
    else
      kept_text_.hang_by_the_way();
    if (!is_place_of_axis(name)) return {.number = *number};
    return without_value(expression, Code::machine_state, begin,
                         name + ", which the motion of the program changes");
  }
  if (isg_outlives_program(name) && kept_text_.may_be_unknown(name)) {
    kept_text_.keep_unknown(name);
    return {.number = 1};
  }
  if (name.starts_with("V.G.WZ")) return read_radius(expression, name, begin);
  if (counted != nullptr) return without_value(expression, Code::variable_unset, begin, name);
  if (!belongs_to_program(name)) return without_value(expression, Code::machine_state, begin, name);
  return without_value(expression, Code::variable_unset, begin,
                       lost_to_.empty() ? name : name + ", which may have been set by " + lost_to_);
}

// V.G.WZ_AKT.R, V.G.WZR: of the tool in force. V.G.WZ[5].R: of the table.
Value IsgFlow::read_radius(ExpressionReader& expression, const std::string& name,
                           std::size_t begin) {
  const double unit = mm_of(modes_.unit);
  if ((name == "V.G.WZ_AKT.R" || name == "V.G.WZR") && modes_.tool_radius)
    return {.number = *modes_.tool_radius / unit};
  constexpr std::string_view beginning = "V.G.WZ[";
  if (name.starts_with(beginning) && name.ends_with("].R")) {
    double number = 0;
    bool whole = false;
    const std::size_t length =
        read_number(std::string_view(name).substr(beginning.size()), number, whole);
    const auto row = setup_.tools.find(static_cast<std::int64_t>(number));
    if (length > 0 && row != setup_.tools.end()) return {.number = row->second.radius / unit};
  }
  return without_value(expression, Code::machine_state, begin, name);
}

bool IsgFlow::exists(ExpressionReader& /*expression*/) { return false; }

// A line between #VAR and #ENDVAR: V.P.NAME : REAL64 = 5, P10[3] = [1, 2, 3]. A variable without a
// value begins with 0.
bool IsgFlow::declare(std::string& flat) {
  const std::size_t begin = head_.behind;
  if (line_[begin] == '#') {
    const std::string word = word_behind_sign(line_, begin);
    if (word != "ENDVAR") return refuse(Code::block_structure, begin, "#VAR without #ENDVAR");
    in_declaration_ = false;
    return writes_variables_ ? pass_line(flat) : finish_statement(flat, begin + 1 + word.size());
  }
  // The sizes of an array are written like indices.
  ExpressionReader expression = expression_at(begin);
  const std::string declared = place_at(expression);
  expression.pass_blanks();
  const std::string name(base_of(declared));
  if (!expression.failed() && !belongs_to_program(name))
    return refuse(Code::expression_invalid, begin, name + ", which is not the program's");
  std::vector<std::size_t> sizes;
  for (std::size_t at = declared.find('['); at != std::string::npos;
       at = declared.find('[', at + 1))
    sizes.push_back(std::stoull(declared.substr(at + 1)));
  if (expression.peek() == ':') {
    expression.go_to(expression.at() + 1);
    expression.pass_blanks();
    const std::string type = in_upper_case(expression.name());
    expression.go_to(expression.at() + type.size());
    if (type.starts_with("SGN") || type.starts_with("UNS")) whole_.insert(name);
    if (type == "STRING" && expression.peek() == '[') static_cast<void>(indices_at(expression));
    expression.pass_blanks();
  }
  if (expression.failed()) return refuse(expression.fault());
  if (!sizes.empty()) fields_.insert(name);
  const std::size_t value = expression.at();
  if (!declare_elements(expression, name, sizes)) return false;
  if (!writes_variables_) return finish_statement(flat, expression.at());
  for (std::size_t at = value; at < expression.at(); ++at)
    if (is_isg_parameter_at(line_, at) || is_isg_variable_at(line_, at))
      return refuse(Code::nc_unsupported, at, "a computed value between #VAR and #ENDVAR");
  if (!refuse_words_behind(line_, expression.at())) return false;
  std::erase_if(unwritten_, [&](const std::string& each) { return base_of(each) == name; });
  return pass_line(flat);
}

bool IsgFlow::declare_elements(ExpressionReader& expression, const std::string& name,
                               const std::vector<std::size_t>& sizes) {
  constexpr std::size_t most_elements = 10'000;
  const std::size_t begin = expression.at();
  std::size_t count = 1;
  for (const std::size_t size : sizes)
    if (count > 0 && size <= most_elements)
      count *= size;
    else
      count = most_elements + 1;
  if (count == 0 || count > most_elements) return refuse(Code::value_invalid, begin, name + "[");
  std::vector<Value> values;
  if (expression.peek() == '=') {
    expression.go_to(expression.at() + 1);
    expression.pass_blanks();
    const bool is_list = !sizes.empty() && expression.peek() == '[';
    do {
      if (is_list) expression.go_to(expression.at() + 1);
      values.push_back(expression.expression());
      expression.pass_blanks();
    } while (is_list && expression.peek() == ',' && !expression.failed());
    if (expression.failed()) return refuse(expression.fault());
    if (is_list && expression.peek() != ']')
      return refuse(Code::expression_invalid, begin, name + " = [");
    if (is_list) expression.go_to(expression.at() + 1);
    if (values.size() > count)
      return refuse(Code::value_invalid, begin, "more values than elements");
  }
  for (std::size_t element = 0; element < count; ++element) {
    std::string indices;
    std::size_t rest = element;
    for (std::size_t size = sizes.size(); size-- > 0; rest /= sizes[size])
      indices.insert(0, "[" + std::to_string(rest % sizes[size]) + "]");
    Value value = element < values.size() ? values[element] : Value{};
    if (!assign(name + indices, std::move(value), begin)) return false;
  }
  return true;
}

// #DELETE V.P.A, V.P.B
bool IsgFlow::forget_declared(std::size_t at) {
  for (ExpressionReader expression = expression_at(at);;) {
    const std::string name = place_at(expression);
    if (expression.failed()) return refuse(expression.fault());
    fields_.erase(name);
    Values& values = values_of(name);
    std::erase_if(values, [&](const auto& each) { return base_of(each.first) == name; });
    std::erase_if(unwritten_, [&](const std::string& each) { return base_of(each) == name; });
    expression.pass_blanks();
    if (expression.peek() != ',') return refuse_words_behind(line_, expression.at());
    expression.go_to(expression.at() + 1);
  }
}

// Writes the values that the program has set, for a call of a missing subprogram.
void IsgFlow::write_values(std::string& flat) {
  for (const std::string& name : unwritten_) {
    const Value& value = values_.at(name);
    const std::string_view base = base_of(name);
    const auto spelled = spellings_.find(base);
    flat.append(spelled == spellings_.end() ? base : std::string_view(spelled->second));
    flat.append(name, base.size()).append(" = ");
    append_number(flat, value);
    flat.append(line_end());
  }
  unwritten_.clear();
}

void IsgFlow::lose_values(const std::string& to) {
  lost_to_ = to;
  counters_.clear();
  of_machine_.clear();
  values_.clear();
  fields_.clear();
}

}  // namespace trc::program
