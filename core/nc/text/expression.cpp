#include "core/nc/text/expression.h"

#include <cmath>
#include <string>

#include "core/nc/text/characters.h"
#include "core/nc/text/nesting.h"

namespace trc {
namespace {

bool is_name(char byte) {
  return (byte >= 'A' && byte <= 'Z') || (byte >= 'a' && byte <= 'z') ||
         (byte >= '0' && byte <= '9') || byte == '_' || byte == '.';
}

class ExpressionReader {
 public:
  explicit ExpressionReader(std::string_view text) : text_(text) {}

  std::optional<TextFault> read(double& value, std::size_t& length) {
    if (sum(value) && !std::isfinite(value)) fail(Code::nc_number, 0, "too large");
    // Trailing blanks do not count.
    length = without_blanks_behind(text_.substr(0, at_)).size();
    return fault_;
  }

 private:
  [[nodiscard]] std::string_view rest() const { return text_.substr(at_); }
  [[nodiscard]] char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void pass_blanks() {
    while (const std::size_t blank = blank_at_start(rest())) at_ += blank;
  }
  bool fail(Code code, std::size_t at, std::string detail) {
    if (!fault_)
      fault_ = {.code = code, .begin = static_cast<std::uint32_t>(at), .detail = std::move(detail)};
    return false;
  }

  bool sum(double& value) {
    if (!product(value)) return false;
    for (pass_blanks(); peek() == '+' || peek() == '-'; pass_blanks()) {
      const bool minus = text_[at_++] == '-';
      double term = 0;
      if (!product(term)) return false;
      value += minus ? -term : term;
    }
    return true;
  }

  bool product(double& value) {
    if (!power(value)) return false;
    for (pass_blanks(); peek() == '*' || peek() == '/'; pass_blanks()) {
      const std::size_t place = at_;
      const bool divided = text_[at_++] == '/';
      double factor = 0;
      if (!power(factor)) return false;
      if (divided && factor == 0) return fail(Code::nc_number, place, "a division by zero");
      value = divided ? value / factor : value * factor;
    }
    return true;
  }

  bool power(double& value) {
    if (!operand(value)) return false;
    pass_blanks();
    if (!rest().starts_with("**")) return true;
    const std::size_t place = at_;
    at_ += 2;
    double exponent = 0;
    if (!operand(exponent)) return false;
    value = std::pow(value, exponent);
    return !std::isnan(value) || fail(Code::nc_number, place, "a power without value");
  }

  bool operand(double& value) {
    pass_blanks();
    const Nesting nesting(depth_);
    if (nesting.is_too_deep()) return fail(Code::expression_invalid, at_, Nesting::told);
    if (peek() == '[') return bracket(value);
    bool whole = false;
    if (const std::size_t length = read_number(rest(), value, whole)) {
      at_ += length;
      return true;
    }
    if (peek() == '-' || peek() == '+') {
      const bool minus = text_[at_++] == '-';
      if (!operand(value)) return false;
      value = minus ? -value : value;
      return true;
    }
    if (const std::size_t length = length_of_name())
      return fail_at_name(length, ", a variable or function");
    return fail(Code::nc_number, at_, name_of_character(rest()));
  }

  bool bracket(double& value) {
    const std::size_t open = at_++;
    if (!sum(value)) return false;
    pass_blanks();
    if (peek() == '>' || peek() == '<' || peek() == '=')
      return fail(Code::nc_unsupported, at_, std::string(1, peek()).append(", a comparison"));
    if (const std::size_t length = length_of_name()) return fail_at_name(length, ", an operator");
    if (peek() != ']') return fail(Code::nc_unclosed, open, "[");
    ++at_;
    return true;
  }

  [[nodiscard]] std::size_t length_of_name() const {
    std::size_t length = 0;
    while (length < rest().size() && is_name(rest()[length])) ++length;
    return length;
  }
  bool fail_at_name(std::size_t length, std::string_view what) {
    return fail(Code::nc_unsupported, at_, std::string(rest().substr(0, length)).append(what));
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::optional<TextFault> fault_{};
};

}  // namespace

std::optional<TextFault> read_expression(std::string_view text, double& value,
                                         std::size_t& length) {
  return ExpressionReader(text).read(value, length);
}

}  // namespace trc
