#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/nc/state/dialect_name.h"
#include "core/nc/text/words.h"

namespace trc::program {

// The content of a variable. A vacant one, which only Fanuc knows, counts as 0 in arithmetic. Only
// Sinumerik and ISG have texts.
struct Value {
  double number = 0;
  bool vacant = false;
  bool is_text = false;
  std::string text{};
};

enum class Operator : std::uint8_t {
  add,
  subtract,
  multiply,
  divide,
  divide_whole,  // the remainder is dropped
  remainder,
  power,
  equal,
  not_equal,
  greater,
  less,
  at_least,
  at_most,
  conjunction,
  disjunction,
  exclusion,
  bit_conjunction,
  bit_disjunction,
  bit_exclusion,
  join,  // texts
};

enum class Function : std::uint8_t {
  sine,
  cosine,
  tangent,
  arc_sine,
  arc_cosine,
  cotangent,
  arc_cotangent,
  arc_tangent,     // one bracket, or two with a `/` between
  arc_tangent_of,  // two values, -180 to 180
  root,
  square,
  absolute,
  sign,
  round,
  down,
  up,
  truncate,  // towards 0
  fraction,
  logarithm,
  decimal_logarithm,
  exponential,
  decimal_exponential,
  power,  // two values, a comma between
  least,
  greatest,
  bound,  // least, greatest, value
  to_binary,
  to_decimal,
  negation,  // before its operand
  bit_negation,
  length_of_text,
  exists,
};

struct OperatorRow {
  std::string_view spelling;
  int level = 0;  // the higher, the earlier it is applied
  Operator meaning{};
};

struct FunctionRow {
  std::string_view spelling;
  Function meaning{};
  std::size_t arguments = 1;
};

// How a control writes expressions.
struct Grammar {
  DialectName dialect{};
  std::span<const OperatorRow> operators{};
  std::span<const FunctionRow> functions{};
  int highest_level = 0;
  char open = '[';
  char close = ']';
  // Variables have names, texts stand in quotes, and a word ends where no letter or digit follows.
  bool has_names = false;
};

[[nodiscard]] const Grammar& fanuc_grammar();
[[nodiscard]] const Grammar& linuxcnc_grammar();
[[nodiscard]] const Grammar& sinumerik_grammar();
[[nodiscard]] const Grammar& isg_grammar();

class ExpressionReader;

// The source of the values of variables in expressions.
class Variables {
 public:
  virtual ~Variables() = default;
  // Reads a variable, from the sign or the name that it begins with. Reports faults through
  // ExpressionReader::fail.
  virtual Value read(ExpressionReader& expression) = 0;
  // Whether the variable is known, for EXISTS.
  virtual bool exists(ExpressionReader& expression) = 0;
};

// Reads and computes the expressions of a line, in one pass. After a fault everything reads as 0,
// and only the first fault counts.
//
// Angles are degrees. A result that is not finite, a division by zero and an argument outside of
// what a function takes are faults. Numbers that Fanuc compares or rounds to whole ones count as
// equal within 1e-9: it computes in decimal digits (D-48). Sinumerik compares within 1e-12 of the
// size; a comparison of ISG that depends on the last digits is a fault (D-54).
class ExpressionReader {
 public:
  ExpressionReader(const Grammar& grammar, std::string_view line, std::size_t at,
                   Variables& variables)
      : grammar_(grammar), line_(line), at_(at), variables_(variables) {}

  // Reads an expression as far as it goes.
  [[nodiscard]] Value expression() { return of_level(1); }
  // A number, a variable, a function or an expression in brackets, with a sign or without.
  [[nodiscard]] Value operand();
  // The number of a variable or the like: whole, not negative.
  [[nodiscard]] std::int64_t whole_operand();

  // The decimals that ROUND keeps in a word of the program; in an assignment it keeps none (Fanuc).
  void round_to(int decimals) { round_decimals_ = decimals; }

  [[nodiscard]] std::size_t at() const { return at_; }
  void go_to(std::size_t at) { at_ = at; }
  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] char peek() const { return at_ < line_.size() ? line_[at_] : '\0'; }
  void pass_blanks();
  // Passes the word, whatever its case. False, without passing anything, where another word stands.
  bool pass(std::string_view word);
  // The name that stands here, of letters, digits and `_`; empty: none. Passes nothing.
  [[nodiscard]] std::string_view name() const;
  // Whether the value is true, as the control decides it.
  [[nodiscard]] bool holds(const Value& value) const;

  [[nodiscard]] bool failed() const { return failed_; }
  [[nodiscard]] const TextFault& fault() const { return fault_; }
  // Records the fault, unless there is one already, ends the line and returns 0.
  Value fail(Code code, std::size_t begin, std::string detail);

 private:
  [[nodiscard]] Value of_level(int level);
  [[nodiscard]] const OperatorRow* operator_of(int level) const;
  [[nodiscard]] bool wants_brackets(const OperatorRow& row, const OperatorRow* before,
                                    std::size_t operand) const;
  [[nodiscard]] Value bracket();
  [[nodiscard]] Value text_in_quotes();
  [[nodiscard]] Value number_of_digits(int base);
  [[nodiscard]] Value named_operand();
  [[nodiscard]] Value function();
  [[nodiscard]] std::span<const FunctionRow>::iterator row_of_function(std::string_view name) const;
  [[nodiscard]] Value function_of_list(const FunctionRow& row, std::size_t begin);
  [[nodiscard]] double applied(Function function, double argument, std::size_t begin);
  [[nodiscard]] double arc_tangent_of_two(double opposite, std::size_t begin);
  [[nodiscard]] Value combined(const Value& left, Operator sign, const Value& right,
                               std::size_t begin);
  [[nodiscard]] Value combined_texts(const Value& left, Operator sign, const Value& right,
                                     std::size_t begin);
  [[nodiscard]] bool compared(const Value& left, Operator sign, const Value& right) const;
  [[nodiscard]] double of_bits(double left, Operator sign, double right, std::size_t begin);
  [[nodiscard]] double of_whole_numbers(double left, Operator sign, double right) const;
  [[nodiscard]] double checked(double number, std::size_t begin);

  const Grammar& grammar_;
  std::string_view line_;
  std::size_t at_;
  Variables& variables_;
  int round_decimals_ = 0;
  int depth_ = 0;
  bool failed_ = false;
  TextFault fault_{};
};

}  // namespace trc::program
