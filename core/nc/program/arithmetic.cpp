#include "core/nc/program/arithmetic.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace trc::program {
namespace {

// Reads the digits of a whole number, written in one base, as a number of the other base. Empty if
// one of them is no decimal digit.
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

// Trigonometric functions and their inverses.
std::optional<double> of_angles(Function function, double argument, DialectName dialect) {
  switch (function) {
    case Function::sine:
      return std::sin(argument * degree);
    case Function::cosine:
      return std::cos(argument * degree);
    case Function::tangent:
      return std::tan(argument * degree);
    case Function::cotangent:
      if (argument == 0) return std::nullopt;
      return 1 / std::tan(argument * degree);
    case Function::arc_sine: {
      if (std::abs(argument) > 1) return std::nullopt;
      const double angle = std::asin(argument) / degree;
      return dialect == DialectName::fanuc && angle < 0 ? angle + 360 : angle;  // D-48
    }
    case Function::arc_cosine:
      if (std::abs(argument) > 1) return std::nullopt;
      return std::acos(argument) / degree;
    case Function::arc_tangent:
      return std::atan(argument) / degree;
    case Function::arc_cotangent:
      return 90 - std::atan(argument) / degree;
    default:  // functions with several arguments, or none
      return 0;
  }
}

std::optional<double> of_powers(Function function, double argument) {
  switch (function) {
    case Function::root:
      if (argument < 0) return std::nullopt;
      return std::sqrt(argument);
    case Function::square:
      return argument * argument;
    case Function::logarithm:
      if (argument <= 0) return std::nullopt;
      return std::log(argument);
    case Function::decimal_logarithm:
      if (argument <= 0) return std::nullopt;
      return std::log10(argument);
    case Function::exponential:
      return std::exp(argument);
    default:  // Function::decimal_exponential
      return std::pow(10.0, argument);
  }
}

std::optional<double> of_whole_part(Function function, double argument, DialectName dialect) {
  const bool fanuc = dialect == DialectName::fanuc;
  // FANUC takes a number as whole if only the last digits of its computation differ.
  const double nearest = std::round(argument);
  const bool is_whole = fanuc && is_near(argument, nearest);
  const bool has_digits = argument >= 0 && nearest <= 1e12;
  switch (function) {
    case Function::truncate:
      return is_relatively_near(argument, nearest) ? nearest : std::trunc(argument);
    case Function::fraction:
      return is_relatively_near(argument, nearest) ? 0 : argument - std::trunc(argument);
    case Function::down:
      if (is_whole) return nearest;
      return fanuc ? std::trunc(argument) : std::floor(argument);
    case Function::up:
      if (is_whole) return nearest;
      return fanuc && argument < 0 ? std::floor(argument) : std::ceil(argument);
    case Function::to_binary:
      return has_digits ? in_other_base(argument, 16, 10) : std::nullopt;
    default:  // Function::to_decimal
      return has_digits ? in_other_base(argument, 10, 16) : std::nullopt;
  }
}

}  // namespace

bool is_near(double left, double right) {
  constexpr double digits = 1e-10;
  constexpr double least = 1e-9;
  return std::abs(left - right) <= least + digits * std::max(std::abs(left), std::abs(right));
}

bool is_relatively_near(double left, double right) {
  constexpr double digits = 1e-12;
  return std::abs(left - right) <= digits * std::max(std::abs(left), std::abs(right));
}

std::optional<double> applied(Function function, double argument, DialectName dialect,
                              int decimals) {
  switch (function) {
    case Function::absolute:
      return std::abs(argument);
    case Function::sign:
      return argument > 0 ? 1 : argument < 0 ? -1 : 0;
    case Function::round: {
      const double scale = std::pow(10.0, decimals);
      return std::round(argument * scale) / scale;
    }
    case Function::root:
    case Function::square:
    case Function::logarithm:
    case Function::decimal_logarithm:
    case Function::exponential:
    case Function::decimal_exponential:
      return of_powers(function, argument);
    case Function::truncate:
    case Function::fraction:
    case Function::down:
    case Function::up:
    case Function::to_binary:
    case Function::to_decimal:
      return of_whole_part(function, argument, dialect);
    default:
      return of_angles(function, argument, dialect);
  }
}

}  // namespace trc::program
