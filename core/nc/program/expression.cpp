#include "core/nc/program/expression.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/nc/text/characters.h"

namespace trc::program {
namespace {

constexpr int most_brackets = 32;
constexpr double degree = std::numbers::pi / 180;
// Beyond that a double does not hold every whole number.
constexpr double largest_exact = 9e15;

// What Fanuc takes for one number (D-48).
bool is_near(double left, double right) {
  constexpr double digits = 1e-10;
  constexpr double least = 1e-9;
  return std::abs(left - right) <= least + digits * std::max(std::abs(left), std::abs(right));
}

// The decimal digits of a whole number, which is written in the one base, in the other one. Nothing
// where one of them is none.
std::optional<double> in_other_base(double number, std::int64_t from, std::int64_t to) {
  constexpr std::int64_t ten = 10;
  auto left = std::llround(std::abs(number));
  std::int64_t result = 0;
  for (std::int64_t place = 1; left > 0; place *= to, left /= from) {
    if (left % from >= ten) return {};
    result += left % from * place;
  }
  return static_cast<double>(result);
}

bool is_comparison(Operator sign) { return sign >= Operator::equal && sign <= Operator::at_most; }

}  // namespace

void ExpressionReader::pass_blanks() {
  while (peek() == ' ' || peek() == '\t') ++at_;
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

const OperatorRow* ExpressionReader::operator_of(int level) const {
  for (const OperatorRow& row : grammar_.operators)
    if (line_.size() - at_ >= row.spelling.size() &&
        std::ranges::equal(line_.substr(at_, row.spelling.size()), row.spelling, {}, upper))
      return row.level == level ? &row : nullptr;
  return nullptr;
}

// Operators of one level act from left to right.
Value ExpressionReader::of_level(int level) {
  if (level > grammar_.highest_level) return operand();
  Value value = of_level(level + 1);
  bool has_compared = false;
  for (;;) {
    pass_blanks();
    const std::size_t begin = at_;
    const OperatorRow* row = operator_of(level);
    if (row == nullptr) return value;
    // Two comparisons side by side mean something else everywhere than they seem to.
    if (is_comparison(row->meaning) && std::exchange(has_compared, true))
      return fail(Code::expression_invalid, begin, std::string(row->spelling));
    at_ += row->spelling.size();
    value = combined(value, row->meaning, of_level(level + 1), begin);
  }
}

Value ExpressionReader::operand() {
  pass_blanks();
  const std::size_t begin = at_;
  const char sign = peek();
  if (sign == '[') return bracket();
  if (sign == '#') return variables_.read(*this);
  double number = 0;
  bool whole = false;
  if (const std::size_t length = read_number(line_.substr(at_), number, whole)) {
    at_ += length;
    return {.number = checked(number, begin)};
  }
  if (sign == '-' || sign == '+') {
    if (++depth_ > most_brackets)
      return fail(Code::expression_invalid, begin, std::string(1, sign));
    ++at_;
    const Value value = operand();
    --depth_;
    return {.number = sign == '-' ? -value.number : value.number};
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

Value ExpressionReader::bracket() {
  const std::size_t open = at_++;
  if (++depth_ > most_brackets) return fail(Code::expression_invalid, open, "brackets too deep");
  const Value value = expression();
  --depth_;
  pass_blanks();
  if (failed_) return {};
  if (peek() != ']')
    return at_ < line_.size()
               ? fail(Code::expression_invalid, at_, name_of_character(line_.substr(at_)))
               : fail(Code::expression_invalid, open, "[, a bracket without ]");
  ++at_;
  return value;
}

Value ExpressionReader::function() {
  const std::size_t begin = at_;
  std::size_t end = at_;
  while (end < line_.size() && is_letter(line_[end])) ++end;
  const std::string name = in_upper_case(line_.substr(begin, end - begin));
  const auto row = std::ranges::find(grammar_.functions, name, &FunctionRow::spelling);
  if (row == grammar_.functions.end()) return fail(Code::expression_invalid, begin, name);
  at_ = end;
  pass_blanks();
  if (peek() != '[') return fail(Code::expression_invalid, begin, name);
  if (row->meaning == Function::exists) {
    ++at_;
    pass_blanks();
    const bool known = variables_.exists(*this);
    pass_blanks();
    if (!failed_ && peek() != ']') return fail(Code::expression_invalid, begin, name);
    ++at_;
    return {.number = known ? 1.0 : 0.0};
  }
  const std::size_t open = at_;
  if (row->meaning == Function::power || row->meaning == Function::arc_tangent) {
    ++at_;
    if (++depth_ > most_brackets) return fail(Code::expression_invalid, open, "brackets too deep");
    const double first = expression().number;
    pass_blanks();
    if (peek() == ',' && grammar_.dialect == DialectName::fanuc) {
      ++at_;
      const double second = expression().number;
      --depth_;
      pass_blanks();
      if (failed_ || peek() != ']') return fail(Code::expression_invalid, begin, name);
      ++at_;
      if (row->meaning == Function::power)
        return {.number = checked(std::pow(first, second), begin)};
      double angle = std::atan2(first, second) / degree;
      return {.number = angle < 0 ? angle + 360 : angle};
    }
    --depth_;
    if (failed_ || peek() != ']' || row->meaning == Function::power)
      return fail(Code::expression_invalid, begin, name);
    ++at_;
    return {.number = arc_tangent_of_two(first, begin)};
  }
  return {.number = applied(row->meaning, bracket().number, begin)};
}

// ATAN[a]/[b] is one function; behind ATAN[a] alone a `/` with something else divides.
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
  // As Fanuc is set up without a parameter: 0 to 360 (D-48).
  return grammar_.dialect == DialectName::fanuc && angle < 0 ? angle + 360 : angle;
}

double ExpressionReader::applied(Function function, double argument, std::size_t begin) {
  if (failed_) return 0;
  const bool fanuc = grammar_.dialect == DialectName::fanuc;
  const auto refused = [&] {
    static_cast<void>(
        fail(Code::value_invalid, begin, std::string(line_.substr(begin, at_ - begin))));
    return 0.0;
  };
  // What is a whole number but for the last digits of its computation is one to Fanuc.
  const double nearest = std::round(argument);
  const bool is_whole = fanuc && is_near(argument, nearest);
  switch (function) {
    case Function::sine:
      return std::sin(argument * degree);
    case Function::cosine:
      return std::cos(argument * degree);
    case Function::tangent:
      return checked(std::tan(argument * degree), begin);
    case Function::arc_sine: {
      if (std::abs(argument) > 1) return refused();
      const double angle = std::asin(argument) / degree;
      return fanuc && angle < 0 ? angle + 360 : angle;  // D-48
    }
    case Function::arc_cosine:
      if (std::abs(argument) > 1) return refused();
      return std::acos(argument) / degree;
    case Function::root:
      if (argument < 0) return refused();
      return std::sqrt(argument);
    case Function::absolute:
      return std::abs(argument);
    case Function::round: {
      const double scale = std::pow(10.0, round_decimals_);
      return std::round(argument * scale) / scale;
    }
    case Function::down:
      if (is_whole) return nearest;
      return fanuc ? std::trunc(argument) : std::floor(argument);
    case Function::up:
      if (is_whole) return nearest;
      return fanuc && argument < 0 ? std::floor(argument) : std::ceil(argument);
    case Function::logarithm:
      if (argument <= 0) return refused();
      return std::log(argument);
    case Function::exponential:
      return checked(std::exp(argument), begin);
    case Function::to_binary: {
      const auto binary = argument < 0 || nearest > 1e12 ? std::optional<double>()
                                                         : in_other_base(argument, 16, 10);
      return binary ? *binary : refused();
    }
    case Function::to_decimal:
      if (argument < 0 || nearest > 1e12) return refused();
      return *in_other_base(argument, 10, 16);
    case Function::arc_tangent:
    case Function::power:
    case Function::exists:
      break;
  }
  return 0;
}

Value ExpressionReader::combined(const Value& left, Operator sign, const Value& right,
                                 std::size_t begin) {
  if (failed_) return {};
  // Of numbers that are rounded first.
  const bool fanuc_remainder =
      sign == Operator::remainder && grammar_.dialect == DialectName::fanuc;
  switch (sign) {
    case Operator::add:
      return {.number = checked(left.number + right.number, begin)};
    case Operator::subtract:
      return {.number = checked(left.number - right.number, begin)};
    case Operator::multiply:
      return {.number = checked(left.number * right.number, begin)};
    case Operator::divide:
    case Operator::remainder:
      if (right.number == 0 || (fanuc_remainder && std::round(right.number) == 0))
        return fail(Code::division_by_zero, begin, sign == Operator::divide ? "/" : "MOD");
      if (sign == Operator::divide) return {.number = checked(left.number / right.number, begin)};
      return {.number = of_whole_numbers(left.number, sign, right.number)};
    case Operator::power:
      return {.number = checked(std::pow(left.number, right.number), begin)};
    case Operator::conjunction:
    case Operator::disjunction:
    case Operator::exclusion:
      return {.number = of_whole_numbers(left.number, sign, right.number)};
    default:
      return {.number = compared(left, sign, right) ? 1.0 : 0.0};
  }
}

double ExpressionReader::of_whole_numbers(double left, Operator sign, double right) const {
  const bool fanuc = grammar_.dialect == DialectName::fanuc;
  if (sign == Operator::remainder) {
    if (fanuc) return std::fmod(std::round(left), std::round(right));
    const double rest = std::fmod(left, right);
    return rest < 0 ? rest + std::abs(right) : rest;
  }
  if (!fanuc) {
    const bool a = left != 0;
    const bool b = right != 0;
    if (sign == Operator::conjunction) return a && b ? 1 : 0;
    return sign == Operator::disjunction ? (a || b ? 1 : 0) : (a != b ? 1 : 0);
  }
  const auto bits = [](double number) {
    return std::llround(std::clamp(number, -largest_exact, largest_exact));
  };
  const auto a = bits(left);
  const auto b = bits(right);
  if (sign == Operator::conjunction) return static_cast<double>(a & b);
  return static_cast<double>(sign == Operator::disjunction ? a | b : a ^ b);
}

// A vacant variable equals another one and nothing else; where it is compared by size it is 0.
bool ExpressionReader::compared(const Value& left, Operator sign, const Value& right) const {
  const double a = left.number;
  const double b = right.number;
  const bool fanuc = grammar_.dialect == DialectName::fanuc;
  // LinuxCNC compares for equality within that alone.
  constexpr double equal_for_linuxcnc = 1e-6;
  const bool equal = fanuc ? is_near(a, b) : std::abs(a - b) < equal_for_linuxcnc;
  switch (sign) {
    case Operator::equal:
      return left.vacant == right.vacant && equal;
    case Operator::not_equal:
      return left.vacant != right.vacant || !equal;
    case Operator::greater:
      return a > b && !(fanuc && equal);
    case Operator::less:
      return a < b && !(fanuc && equal);
    case Operator::at_least:
      return a >= b || (fanuc && equal);
    default:
      return a <= b || (fanuc && equal);
  }
}

double ExpressionReader::checked(double number, std::size_t begin) {
  if (std::isfinite(number) || failed_) return failed_ ? 0 : number;
  static_cast<void>(fail(Code::value_invalid, begin, "too large"));
  return 0;
}

}  // namespace trc::program
