#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace trc {

// Q parameters whose values are known, by name.
using KlartextParameters = std::map<std::string, double, std::less<>>;

// The value of the text after `=` in an assignment: a number, Q1, +Q1 DIV +2 of FN 4, or a formula
// such as Q1 + 3 * SIN Q4. Nothing for unknown parameters and any other text (D-85).
[[nodiscard]] std::optional<double> value_of_formula(std::string_view formula,
                                                     const KlartextParameters& known);

}  // namespace trc
