#pragma once

#include <numbers>
#include <optional>

#include "core/nc/program/expression.h"

// The functions of expressions, and when numbers count as equal.

namespace trc::program {

inline constexpr double degree = std::numbers::pi / 180;
// Beyond it a double cannot hold every whole number.
inline constexpr double largest_exact = 9e15;

// Whether Fanuc takes both for the same number (D-48).
[[nodiscard]] bool is_near(double left, double right);
// Whether Sinumerik takes both for the same number: relative equality.
[[nodiscard]] bool is_relatively_near(double left, double right);

// The value of a function of one number; 0 for functions of several. Empty: the argument is out of
// its range. `decimals`: how many ROUND keeps.
[[nodiscard]] std::optional<double> applied(Function function, double argument, DialectName dialect,
                                            int decimals);

}  // namespace trc::program
