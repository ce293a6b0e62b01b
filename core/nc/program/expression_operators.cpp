#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/nc/program/arithmetic.h"
#include "core/nc/program/expression.h"
#include "core/nc/program/gcode_line.h"

// The results of operators and functions.

namespace trc::program {

double ExpressionReader::applied(Function function, double argument, std::size_t begin) {
  if (failed_) return 0;
  const auto result = program::applied(function, argument, grammar_.dialect, round_decimals_);
  if (result) return checked(*result, begin);
  static_cast<void>(
      fail(Code::value_invalid, begin, std::string(line_.substr(begin, at_ - begin))));
  return 0;
}

Value ExpressionReader::combined(const Value& left, Operator sign, const Value& right,
                                 std::size_t begin) {
  if (failed_) return {};
  if (left.is_text || right.is_text || sign == Operator::join)
    return combined_texts(left, sign, right, begin);
  // FANUC rounds both numbers first.
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
    case Operator::divide_whole:
    case Operator::remainder:
      if (right.number == 0 || (fanuc_remainder && std::round(right.number) == 0))
        return fail(Code::division_by_zero, begin,
                    sign == Operator::divide         ? "/"
                    : sign == Operator::divide_whole ? "DIV"
                                                     : "MOD");
      if (sign == Operator::divide) return {.number = checked(left.number / right.number, begin)};
      if (sign == Operator::divide_whole)
        return {.number = applied(Function::truncate, left.number / right.number, begin)};
      return {.number = of_whole_numbers(left.number, sign, right.number)};
    case Operator::bit_conjunction:
    case Operator::bit_disjunction:
    case Operator::bit_exclusion:
      return {.number = of_bits(left.number, sign, right.number, begin)};
    case Operator::power:
      return {.number = checked(std::pow(left.number, right.number), begin)};
    case Operator::conjunction:
    case Operator::disjunction:
    case Operator::exclusion:
      return {.number = of_whole_numbers(left.number, sign, right.number)};
    default:
      break;
  }
  // How the control treats the last digits is unknown (D-54).
  if (grammar_.dialect == DialectName::isg && left.number != right.number &&
      is_near(left.number, right.number))
    return fail(Code::value_invalid, begin, "a comparison of numbers that are nearly equal");
  return {.number = compared(left, sign, right) ? 1.0 : 0.0};
}

Value ExpressionReader::combined_texts(const Value& left, Operator sign, const Value& right,
                                       std::size_t begin) {
  const auto text_of = [](const Value& value) {
    if (value.is_text) return value.text;
    std::string text;
    append_value(text, value.number, PointStyle::as_whole);
    return text;
  };
  if (sign == Operator::join) return {.is_text = true, .text = text_of(left) + text_of(right)};
  const bool is_equality = sign == Operator::equal || sign == Operator::not_equal;
  if (!is_equality || left.is_text != right.is_text)
    return fail(Code::expression_invalid, begin, "a text");
  return {.number = (left.text == right.text) == (sign == Operator::equal) ? 1.0 : 0.0};
}

// Whole numbers of 32 bits.
double ExpressionReader::of_bits(double left, Operator sign, double right, std::size_t begin) {
  constexpr double smallest = -2147483648.0;
  constexpr double largest = 4294967295.0;
  const auto is_whole = [&](double number) {
    return number == std::round(number) && number >= smallest && number <= largest;
  };
  if (failed_) return 0;
  if (!is_whole(left) || !is_whole(right)) {
    static_cast<void>(fail(Code::value_invalid, begin, "bits of what is no whole number"));
    return 0;
  }
  const auto a = static_cast<std::int32_t>(static_cast<std::uint32_t>(std::llround(left)));
  const auto b = static_cast<std::int32_t>(static_cast<std::uint32_t>(std::llround(right)));
  if (sign == Operator::bit_conjunction) return a & b;
  return sign == Operator::bit_disjunction ? a | b : a ^ b;
}

double ExpressionReader::of_whole_numbers(double left, Operator sign, double right) const {
  const bool fanuc = grammar_.dialect == DialectName::fanuc;
  if (sign == Operator::remainder) {
    if (fanuc) return std::fmod(std::round(left), std::round(right));
    if (grammar_.has_names) return std::fmod(left, right);
    const double rest = std::fmod(left, right);
    return rest < 0 ? rest + std::abs(right) : rest;
  }
  if (!fanuc) {
    const bool a = holds({.number = left});
    const bool b = holds({.number = right});
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

// A vacant variable only equals another vacant one; in comparisons by size it is 0.
bool ExpressionReader::compared(const Value& left, Operator sign, const Value& right) const {
  const double a = left.number;
  const double b = right.number;
  const bool fanuc = grammar_.dialect == DialectName::fanuc;
  // LinuxCNC only uses this tolerance for equality (D-48).
  constexpr double equal_for_linuxcnc = 1e-4;
  const bool by_size = fanuc || grammar_.has_names;
  const bool equal = fanuc                ? is_near(a, b)
                     : grammar_.has_names ? is_relatively_near(a, b)
                                          : std::abs(a - b) < equal_for_linuxcnc;
  switch (sign) {
    case Operator::equal:
      return left.vacant == right.vacant && equal;
    case Operator::not_equal:
      return left.vacant != right.vacant || !equal;
    case Operator::greater:
      return a > b && !(by_size && equal);
    case Operator::less:
      return a < b && !(by_size && equal);
    case Operator::at_least:
      return a >= b || (by_size && equal);
    default:
      return a <= b || (by_size && equal);
  }
}

double ExpressionReader::checked(double number, std::size_t begin) {
  if (std::isfinite(number) || failed_) return failed_ ? 0 : number;
  static_cast<void>(fail(Code::value_invalid, begin, "too large"));
  return 0;
}

}  // namespace trc::program
