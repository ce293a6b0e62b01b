#include "core/nc/dialect/klartext_formula.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/nc/text/characters.h"
#include "core/nc/text/klartext_words.h"

namespace trc {
namespace {

constexpr double degree = std::numbers::pi / 180;

using Function = double (*)(double);
constexpr auto functions = std::to_array<std::pair<std::string_view, Function>>({
    {"SQRT", [](double value) { return std::sqrt(value); }},
    {"ASIN", [](double value) { return std::asin(value) / degree; }},
    {"ACOS", [](double value) { return std::acos(value) / degree; }},
    {"ATAN", [](double value) { return std::atan(value) / degree; }},
    {"FRAC", [](double value) { return value - std::trunc(value); }},
    {"SIN", [](double value) { return std::sin(value * degree); }},
    {"COS", [](double value) { return std::cos(value * degree); }},
    {"TAN", [](double value) { return std::tan(value * degree); }},
    {"ABS", [](double value) { return std::abs(value); }},
    {"INT", [](double value) { return std::trunc(value); }},
    {"NEG", [](double value) { return -value; }},
    {"SQ", [](double value) { return value * value; }},
});

// Products come before sums, powers before products, functions and brackets before all others.
class Formula {
 public:
  Formula(std::string_view text, const KlartextParameters& known)
      : text_(without_blanks_in_front(text)), known_(known) {}

  std::optional<double> value() {
    const std::optional<double> result = sum();
    const bool is_whole = text_.empty() && result && std::isfinite(*result);
    return is_whole ? result : std::nullopt;
  }

 private:
  bool pass(std::string_view sign) {
    if (!text_.starts_with(sign)) return false;
    text_ = without_blanks_in_front(text_.substr(sign.size()));
    return true;
  }

  std::optional<double> sum() {
    std::optional<double> result = product();
    while (result) {
      const bool adds = pass("+");
      if (!adds && !pass("-")) break;
      const std::optional<double> other = product();
      result = other ? std::optional(*result + (adds ? *other : -*other)) : std::nullopt;
    }
    return result;
  }

  std::optional<double> product() {
    std::optional<double> result = power();
    while (result) {
      const bool multiplies = pass("*");
      if (!multiplies && !pass("/") && !pass("DIV")) break;
      const std::optional<double> other = power();
      result =
          other ? std::optional(multiplies ? *result * *other : *result / *other) : std::nullopt;
    }
    return result;
  }

  std::optional<double> power() {
    const std::optional<double> base = operand();
    if (!base || !pass("^")) return base;
    const std::optional<double> exponent = operand();
    // No manual defines the order of several powers, or what a sign before a power applies to.
    if (!exponent || *base < 0 || text_.starts_with('^')) return {};
    return std::pow(*base, *exponent);
  }

  std::optional<double> operand() {
    constexpr int deepest = 50;
    if (++depth_ > deepest) return {};
    const bool negative = pass("-");
    if (!negative) pass("+");
    std::optional<double> result;
    if (pass("(")) {
      result = sum();
      if (!pass(")")) return {};
    } else {
      result = plain_operand();
    }
    --depth_;
    return result && negative ? -*result : result;
  }

  std::optional<double> plain_operand() {
    for (const auto& [name, function] : functions)
      if (pass(name)) {
        const std::optional<double> argument = operand();
        return argument ? std::optional(function(*argument)) : std::nullopt;
      }
    if (pass("PI")) return std::numbers::pi;
    const bool is_parameter = text_.starts_with('Q');
    const std::size_t length = std::min(
        text_.find_first_not_of(is_parameter ? "QLR0123456789" : "0123456789.,"), text_.size());
    const std::string_view word = text_.substr(0, length);
    text_ = without_blanks_in_front(text_.substr(length));
    if (is_parameter) {
      const auto found = known_.find(word);
      return found == known_.end() ? std::nullopt : std::optional(found->second);
    }
    double value = 0;
    const bool is_number = !word.empty() && read_klartext_number(word, value) == word.size();
    return is_number ? std::optional(value) : std::nullopt;
  }

  std::string_view text_;
  const KlartextParameters& known_;
  int depth_ = 0;
};

}  // namespace

std::optional<double> value_of_formula(std::string_view formula, const KlartextParameters& known) {
  return Formula(formula, known).value();
}

}  // namespace trc
