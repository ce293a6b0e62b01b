#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace trc {

// Q parameters whose values are known, by name.
using KlartextParameters = std::map<std::string, double, std::less<>>;

// What stands behind the `=` of an assignment: a number, Q1, +Q1 DIV +2 of FN 4, a formula such as
// Q1 + 3 * SIN Q4. Nothing where a parameter is not known, or where it is something else (D-85).
[[nodiscard]] std::optional<double> value_of_formula(std::string_view formula,
                                                     const KlartextParameters& known);

}  // namespace trc
