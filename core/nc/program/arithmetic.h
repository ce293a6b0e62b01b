#pragma once

#include <numbers>
#include <optional>

#include "core/nc/program/expression.h"

// What functions of expressions yield, and when numbers count as equal.

namespace trc::program {

inline constexpr double degree = std::numbers::pi / 180;
// Beyond that a double does not hold every whole number.
inline constexpr double largest_exact = 9e15;

// What Fanuc takes for one number (D-48).
[[nodiscard]] bool is_near(double left, double right);
// What Sinumerik takes for one number: relative equality.
[[nodiscard]] bool is_relatively_near(double left, double right);

// A function of one number; of what has several arguments 0. Empty: outside of what it takes.
// `decimals`: how many ROUND keeps.
[[nodiscard]] std::optional<double> applied(Function function, double argument, DialectName dialect,
                                            int decimals);

}  // namespace trc::program
