#include "core/nc/program/expression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/nc/program/arithmetic.h"
#include "core/nc/program/gcode_line.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/nesting.h"

namespace trc::program {
namespace {

bool is_comparison(Operator sign) { return sign >= Operator::equal && sign <= Operator::at_most; }

}  // namespace

void ExpressionReader::pass_blanks() {
  while (at_ < line_.size()) {
    const std::size_t blank = blank_at_start(line_.substr(at_));
    if (blank == 0) return;
    at_ += blank;
  }
}

bool ExpressionReader::pass(std::string_view word) {
  if (line_.size() - at_ < word.size() ||
      !std::ranges::equal(line_.substr(at_, word.size()), word, {}, upper))
    return false;
  at_ += word.size();
  return true;
}

Value ExpressionReader::fail(Code code, std::size_t begin, std::string detail) {
  if (!failed_)
    fault_ = {
        .code = code, .begin = static_cast<std::uint32_t>(begin), .detail = std::move(detail)};
  failed_ = true;
  at_ = line_.size();
  return {};
}

std::string_view ExpressionReader::name() const {
  std::size_t end = at_;
  if (is_letter(peek()) || peek() == '_')
    while (end < line_.size() && goes_on_as_name(line_[end])) ++end;
  return line_.substr(at_, end - at_);
}

bool ExpressionReader::holds(const Value& value) const {
  // As the manual of ISG defines it.
  constexpr double half = 0.5;
  if (grammar_.dialect == DialectName::isg) return std::abs(value.number) >= half;
  return value.is_text ? !value.text.empty() : value.number != 0;
}

const OperatorRow* ExpressionReader::operator_of(int level) const {
  for (const OperatorRow& row : grammar_.operators) {
    if (line_.size() - at_ < row.spelling.size() ||
        !std::ranges::equal(line_.substr(at_, row.spelling.size()), row.spelling, {}, upper))
      continue;
    const std::size_t behind = at_ + row.spelling.size();
    if (grammar_.has_names && is_letter(row.spelling.front()) && behind < line_.size() &&
        goes_on_as_name(line_[behind]))
      continue;
    return row.level == level ? &row : nullptr;
  }
  return nullptr;
}

// Operators of one level act from left to right.
Value ExpressionReader::of_level(int level) {
  if (level > grammar_.highest_level) return operand();
  pass_blanks();
  const std::size_t first = at_;
  Value value = of_level(level + 1);
  bool has_compared = false;
  const OperatorRow* before = nullptr;
  for (;;) {
    pass_blanks();
    const std::size_t begin = at_;
    const OperatorRow* row = operator_of(level);
    if (row == nullptr) return value;
    // A chain of two comparisons never means what it seems to mean.
    if (is_comparison(row->meaning) && std::exchange(has_compared, true))
      return fail(Code::expression_invalid, begin, std::string(row->spelling));
    if (wants_brackets(*row, std::exchange(before, row), first))
      return fail(Code::expression_invalid, begin,
                  std::string(row->spelling).append(", whose order needs brackets"));
    at_ += row->spelling.size();
    value = combined(value, row->meaning, of_level(level + 1), begin);
  }
}

// ISG: no manual defines the order of several logical operators, comparisons or powers, or of a
// power of a signed operand. `operand` is where the first operand begins.
bool ExpressionReader::wants_brackets(const OperatorRow& row, const OperatorRow* before,
                                      std::size_t operand) const {
  constexpr int lowest_of_arithmetic = 3;
  if (grammar_.dialect != DialectName::isg) return false;
  if (row.meaning == Operator::power)
    return before != nullptr || line_[operand] == '-' || line_[operand] == '+';
  return before != nullptr && row.level < lowest_of_arithmetic && row.meaning != before->meaning;
}

Value ExpressionReader::operand() {
  pass_blanks();
  const std::size_t begin = at_;
  const Nesting nesting(depth_);
  if (nesting.is_too_deep()) return fail(Code::expression_invalid, begin, Nesting::told);
  const char sign = peek();
  if (sign == grammar_.open) return bracket();
  if (sign == '#' && !grammar_.has_names) return variables_.read(*this);
  double number = 0;
  bool whole = false;
  const auto read = grammar_.dialect == DialectName::sinumerik ? read_named_number : read_number;
  if (const std::size_t length = read(line_.substr(at_), number, whole)) {
    at_ += length;
    return {.number = checked(number, begin)};
  }
  if (sign == '-' || sign == '+') {
    ++at_;
    const Value value = operand();
    if (value.is_text) return fail(Code::expression_invalid, begin, "a text");
    return {.number = sign == '-' ? -value.number : value.number};
  }
  if (grammar_.has_names && sign == '"') return text_in_quotes();
  if (grammar_.has_names && (is_letter(sign) || sign == '_' || sign == '$')) return named_operand();
  if (grammar_.dialect == DialectName::sinumerik && sign == '\'') {
    const char base = at_ + 1 < line_.size() ? upper(line_[at_ + 1]) : '\0';
    if (base == 'H' || base == 'B') return number_of_digits(base == 'H' ? 16 : 2);
  }
  if (is_letter(sign)) return function();
  return fail(Code::expression_invalid, begin,
              at_ < line_.size() ? name_of_character(line_.substr(at_)) : "the end of the line");
}

std::int64_t ExpressionReader::whole_operand() {
  pass_blanks();
  const std::size_t begin = at_;
  const Value value = operand();
  if (failed_) return 0;
  const double nearest = std::round(value.number);
  if (value.vacant || nearest < 0 || nearest > largest_exact ||
      std::abs(value.number - nearest) > 1e-4) {
    static_cast<void>(
        fail(Code::value_invalid, begin, std::string(line_.substr(begin, at_ - begin))));
    return 0;
  }
  return std::llround(nearest);
}

Value ExpressionReader::text_in_quotes() {
  const std::size_t begin = at_;
  const std::size_t close = line_.find('"', at_ + 1);
  if (close == std::string_view::npos)
    return fail(Code::expression_invalid, begin, "\", a text without end");
  at_ = close + 1;
  return {.is_text = true, .text = std::string(line_.substr(begin + 1, close - begin - 1))};
}

// 'H2F', 'B101'
Value ExpressionReader::number_of_digits(int base) {
  constexpr std::int64_t largest = 0xffffffff;
  constexpr int ten = 10;
  const std::size_t begin = at_;
  std::int64_t number = 0;
  for (at_ += 2; at_ < line_.size() && line_[at_] != '\''; ++at_) {
    const char sign = upper(line_[at_]);
    const int digit = is_digit(sign) ? sign - '0' : is_letter(sign) ? sign - 'A' + ten : base;
    number = number * base + digit;
    if (digit >= base || number > largest) break;
  }
  if (peek() != '\'' || at_ == begin + 2)
    return fail(Code::expression_invalid, begin, std::string(line_.substr(begin, 2)));
  ++at_;
  return {.number = static_cast<double>(number)};
}

// NOT and the like, a function, or a variable.
Value ExpressionReader::named_operand() {
  const std::string spelling = in_upper_case(name());
  const auto row = std::ranges::find(grammar_.functions, spelling, &FunctionRow::spelling);
  if (row == grammar_.functions.end()) return variables_.read(*this);
  const std::size_t begin = at_;
  if (row->meaning == Function::negation || row->meaning == Function::bit_negation) {
    at_ += spelling.size();
    const Value value = operand();
    if (row->meaning == Function::negation) return {.number = holds(value) ? 0.0 : 1.0};
    return {.number = of_bits(value.number, Operator::bit_exclusion, -1, begin)};
  }
  const std::size_t behind = behind_blanks(line_, at_ + spelling.size());
  if (behind >= line_.size() || line_[behind] != grammar_.open) return variables_.read(*this);
  at_ = behind;
  return function_of_list(*row, begin);
}

// One or several arguments in brackets.
Value ExpressionReader::function_of_list(const FunctionRow& row, std::size_t begin) {
  constexpr std::size_t most_arguments = 3;
  std::array<Value, most_arguments> arguments{};
  for (std::size_t number = 0; number < row.arguments; ++number) {
    pass_blanks();
    if (peek() != (number == 0 ? grammar_.open : ','))
      return fail(Code::expression_invalid, at_, std::string(row.spelling));
    ++at_;
    arguments.at(number) = expression();
    if (failed_) return {};
    if (arguments.at(number).is_text != (row.meaning == Function::length_of_text))
      return fail(Code::expression_invalid, begin, std::string(row.spelling).append(", a text"));
  }
  pass_blanks();
  if (peek() != grammar_.close)
    return fail(Code::expression_invalid, at_, std::string(row.spelling));
  ++at_;
  const double first = arguments[0].number;
  const double second = arguments[1].number;
  switch (row.meaning) {
    case Function::arc_tangent_of:
      if (first == 0 && second == 0)
        return fail(Code::value_invalid, begin, std::string(row.spelling).append(" of 0 and 0"));
      return {.number = std::atan2(first, second) / degree};
    case Function::power:
      return {.number = checked(std::pow(first, second), begin)};
    case Function::least:
      return {.number = std::min(first, second)};
    case Function::greatest:
      return {.number = std::max(first, second)};
    case Function::bound:
      if (second < first) return fail(Code::value_invalid, begin, std::string(row.spelling));
      return {.number = std::clamp(arguments[2].number, first, second)};
    case Function::length_of_text:
      return {.number = static_cast<double>(arguments[0].text.size())};
    default:
      return {.number = applied(row.meaning, first, begin)};
  }
}

Value ExpressionReader::bracket() {
  const std::size_t open = at_++;
  Value value = expression();
  pass_blanks();
  if (failed_) return {};
  if (peek() != grammar_.close)
    return at_ < line_.size()
               ? fail(Code::expression_invalid, at_, name_of_character(line_.substr(at_)))
               : fail(Code::expression_invalid, open,
                      std::string(1, grammar_.open)
                          .append(", a bracket without ")
                          .append(1, grammar_.close));
  ++at_;
  return value;
}

// FANUC: the first two letters of a function are enough, or more: RO[ ], ROU[ ].
std::span<const FunctionRow>::iterator ExpressionReader::row_of_function(
    std::string_view name) const {
  const auto row = std::ranges::find(grammar_.functions, name, &FunctionRow::spelling);
  constexpr std::size_t shortest = 2;
  if (row != grammar_.functions.end() || grammar_.dialect != DialectName::fanuc ||
      name.size() < shortest)
    return row;
  return std::ranges::find_if(
      grammar_.functions, [&](const FunctionRow& each) { return each.spelling.starts_with(name); });
}

Value ExpressionReader::function() {
  const std::size_t begin = at_;
  std::size_t end = at_;
  while (end < line_.size() && is_letter(line_[end])) ++end;
  const std::string name = in_upper_case(line_.substr(begin, end - begin));
  const auto row = row_of_function(name);
  if (row == grammar_.functions.end()) return fail(Code::expression_invalid, begin, name);
  at_ = end;
  pass_blanks();
  if (peek() != '[') return fail(Code::expression_invalid, begin, name);
  if (row->meaning == Function::exists) {
    ++at_;
    pass_blanks();
    const bool known = variables_.exists(*this);
    pass_blanks();
    if (failed_ || peek() != ']') return fail(Code::expression_invalid, begin, name);
    ++at_;
    return {.number = known ? 1.0 : 0.0};
  }
  if (row->meaning == Function::power || row->meaning == Function::arc_tangent) {
    ++at_;
    const double first = expression().number;
    pass_blanks();
    if (peek() == ',' && grammar_.dialect == DialectName::fanuc) {
      ++at_;
      const double second = expression().number;
      pass_blanks();
      if (failed_ || peek() != ']') return fail(Code::expression_invalid, begin, name);
      ++at_;
      if (row->meaning == Function::power)
        return {.number = checked(std::pow(first, second), begin)};
      double angle = std::atan2(first, second) / degree;
      return {.number = angle < 0 ? angle + 360 : angle};
    }
    if (failed_ || peek() != ']' || row->meaning == Function::power)
      return fail(Code::expression_invalid, begin, name);
    ++at_;
    return {.number = arc_tangent_of_two(first, begin)};
  }
  return {.number = applied(row->meaning, bracket().number, begin)};
}

// ATAN[a]/[b] is one function; after ATAN[a] alone a `/` with anything else divides.
double ExpressionReader::arc_tangent_of_two(double opposite, std::size_t begin) {
  const std::size_t behind = at_;
  pass_blanks();
  const bool divided = peek() == '/';
  if (divided) {
    ++at_;
    pass_blanks();
  }
  if (!divided || peek() != '[') {
    at_ = behind;
    if (grammar_.dialect == DialectName::linuxcnc) {
      static_cast<void>(fail(Code::expression_invalid, begin, "ATAN without / [ ]"));
      return 0;
    }
    return std::atan(opposite) / degree;
  }
  const double adjacent = bracket().number;
  if (failed_) return 0;
  if (opposite == 0 && adjacent == 0) {
    static_cast<void>(fail(Code::value_invalid, begin, "ATAN of 0 and 0"));
    return 0;
  }
  const double angle = std::atan2(opposite, adjacent) / degree;
  // FANUC without the parameter set: 0 to 360 (D-48).
  return grammar_.dialect == DialectName::fanuc && angle < 0 ? angle + 360 : angle;
}

}  // namespace trc::program
