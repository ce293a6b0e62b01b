#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/nc/state/dialect_name.h"
#include "core/nc/text/words.h"

namespace trc::program {

// What a variable holds. A vacant one, which only Fanuc knows, counts as 0 in arithmetic.
struct Value {
  double number = 0;
  bool vacant = false;
};

enum class Operator : std::uint8_t {
  add,
  subtract,
  multiply,
  divide,
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
};

enum class Function : std::uint8_t {
  sine,
  cosine,
  tangent,
  arc_sine,
  arc_cosine,
  arc_tangent,  // one bracket, or two with a `/` between
  root,
  absolute,
  round,
  down,
  up,
  logarithm,
  exponential,
  power,  // two values, a comma between
  to_binary,
  to_decimal,
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
};

// How a control writes expressions.
struct Grammar {
  DialectName dialect{};
  std::span<const OperatorRow> operators{};
  std::span<const FunctionRow> functions{};
  int highest_level = 0;
};

[[nodiscard]] const Grammar& fanuc_grammar();
[[nodiscard]] const Grammar& linuxcnc_grammar();

class ExpressionReader;

// Where an expression gets the values of its variables.
class Variables {
 public:
  virtual ~Variables() = default;
  // Reads a variable with the sign it begins with; says what is wrong by ExpressionReader::fail.
  virtual Value read(ExpressionReader& expression) = 0;
  // Whether the variable is known, for EXISTS.
  virtual bool exists(ExpressionReader& expression) = 0;
};

// Reads and computes the expressions of a line, in one pass. Behind a fault everything reads as 0,
// and the first fault is what counts.
//
// Angles are degrees. A result that is not finite, a division by zero and an argument outside of
// what a function takes are faults. What Fanuc compares or rounds to whole numbers counts as equal
// within 1e-9: it computes in decimal digits (D-48).
class ExpressionReader {
 public:
  ExpressionReader(const Grammar& grammar, std::string_view line, std::size_t at,
                   Variables& variables)
      : grammar_(grammar), line_(line), at_(at), variables_(variables) {}

  // As far as it goes.
  [[nodiscard]] Value expression() { return of_level(1); }
  // A number, a variable, a function or an expression in brackets, with a sign or without.
  [[nodiscard]] Value operand();
  // The number of a variable or the like: whole, not negative.
  [[nodiscard]] std::int64_t whole_operand();

  // ROUND keeps so many decimals: in a word of the program, not in an assignment (Fanuc).
  void round_to(int decimals) { round_decimals_ = decimals; }

  [[nodiscard]] std::size_t at() const { return at_; }
  void go_to(std::size_t at) { at_ = at; }
  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] char peek() const { return at_ < line_.size() ? line_[at_] : '\0'; }
  void pass_blanks();
  // Passes a word in letters of any case; false, and passes nothing, where another one stands.
  bool pass(std::string_view word);

  [[nodiscard]] bool failed() const { return failed_; }
  [[nodiscard]] const TextFault& fault() const { return fault_; }
  // Of a value that nothing is wrong with but where it stands: 0.
  Value fail(Code code, std::size_t begin, std::string detail);

 private:
  [[nodiscard]] Value of_level(int level);
  [[nodiscard]] const OperatorRow* operator_of(int level) const;
  [[nodiscard]] Value bracket();
  [[nodiscard]] Value function();
  [[nodiscard]] double applied(Function function, double argument, std::size_t begin);
  [[nodiscard]] double arc_tangent_of_two(double opposite, std::size_t begin);
  [[nodiscard]] Value combined(const Value& left, Operator sign, const Value& right,
                               std::size_t begin);
  [[nodiscard]] bool compared(const Value& left, Operator sign, const Value& right) const;
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
