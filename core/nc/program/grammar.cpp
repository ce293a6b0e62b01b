#include <array>

#include "core/nc/program/expression.h"

namespace trc::program {
namespace {

constexpr auto fanuc_operators = std::to_array<OperatorRow>({
    {"EQ", 1, Operator::equal},
    {"NE", 1, Operator::not_equal},
    {"GT", 1, Operator::greater},
    {"LT", 1, Operator::less},
    {"GE", 1, Operator::at_least},
    {"LE", 1, Operator::at_most},
    {"+", 2, Operator::add},
    {"-", 2, Operator::subtract},
    {"OR", 2, Operator::disjunction},
    {"XOR", 2, Operator::exclusion},
    {"*", 3, Operator::multiply},
    {"/", 3, Operator::divide},
    {"MOD", 3, Operator::remainder},
    {"AND", 3, Operator::conjunction},
});

constexpr auto linuxcnc_operators = std::to_array<OperatorRow>({
    {"AND", 1, Operator::conjunction},
    {"OR", 1, Operator::disjunction},
    {"XOR", 1, Operator::exclusion},
    {"EQ", 2, Operator::equal},
    {"NE", 2, Operator::not_equal},
    {"GT", 2, Operator::greater},
    {"LT", 2, Operator::less},
    {"GE", 2, Operator::at_least},
    {"LE", 2, Operator::at_most},
    {"+", 3, Operator::add},
    {"-", 3, Operator::subtract},
    // Before `*`, which it begins with.
    {"**", 5, Operator::power},
    {"*", 4, Operator::multiply},
    {"/", 4, Operator::divide},
    {"MOD", 4, Operator::remainder},
});

constexpr auto fanuc_functions = std::to_array<FunctionRow>({
    {"SIN", Function::sine},
    {"COS", Function::cosine},
    {"TAN", Function::tangent},
    {"ASIN", Function::arc_sine},
    {"ACOS", Function::arc_cosine},
    {"ATAN", Function::arc_tangent},
    {"SQRT", Function::root},
    {"SQR", Function::root},
    {"ABS", Function::absolute},
    {"ROUND", Function::round},
    {"RND", Function::round},
    {"FIX", Function::down},
    {"FUP", Function::up},
    {"LN", Function::logarithm},
    {"EXP", Function::exponential},
    {"POW", Function::power},
    {"BIN", Function::to_binary},
    {"BCD", Function::to_decimal},
});

constexpr auto linuxcnc_functions = std::to_array<FunctionRow>({
    {"SIN", Function::sine},
    {"COS", Function::cosine},
    {"TAN", Function::tangent},
    {"ASIN", Function::arc_sine},
    {"ACOS", Function::arc_cosine},
    {"ATAN", Function::arc_tangent},
    {"SQRT", Function::root},
    {"ABS", Function::absolute},
    {"ROUND", Function::round},
    {"FIX", Function::down},
    {"FUP", Function::up},
    {"LN", Function::logarithm},
    {"EXP", Function::exponential},
    {"EXISTS", Function::exists},
});

// Comparisons come last: several comparisons each need their own brackets.
constexpr auto sinumerik_operators = std::to_array<OperatorRow>({
    {"==", 1, Operator::equal},
    {"<>", 1, Operator::not_equal},
    {">=", 1, Operator::at_least},
    {"<=", 1, Operator::at_most},
    // Before `<`, which it begins with.
    {"<<", 2, Operator::join},
    {">", 1, Operator::greater},
    {"<", 1, Operator::less},
    {"OR", 3, Operator::disjunction},
    {"XOR", 4, Operator::exclusion},
    {"AND", 5, Operator::conjunction},
    {"B_OR", 6, Operator::bit_disjunction},
    {"B_XOR", 7, Operator::bit_exclusion},
    {"B_AND", 8, Operator::bit_conjunction},
    {"+", 9, Operator::add},
    {"-", 9, Operator::subtract},
    {"*", 10, Operator::multiply},
    {"/", 10, Operator::divide},
    {"DIV", 10, Operator::divide_whole},
    {"MOD", 10, Operator::remainder},
});

constexpr auto sinumerik_functions = std::to_array<FunctionRow>({
    {"NOT", Function::negation},    {"B_NOT", Function::bit_negation},
    {"SIN", Function::sine},        {"COS", Function::cosine},
    {"TAN", Function::tangent},     {"ASIN", Function::arc_sine},
    {"ACOS", Function::arc_cosine}, {"ATAN2", Function::arc_tangent_of, 2},
    {"SQRT", Function::root},       {"POT", Function::square},
    {"ABS", Function::absolute},    {"TRUNC", Function::truncate},
    {"ROUND", Function::round},     {"ROUNDUP", Function::up},
    {"LN", Function::logarithm},    {"EXP", Function::exponential},
    {"MINVAL", Function::least, 2}, {"MAXVAL", Function::greatest, 2},
    {"BOUND", Function::bound, 3},  {"STRLEN", Function::length_of_text},
});

// Operators of one level need brackets: no manual defines their order.
constexpr auto isg_operators = std::to_array<OperatorRow>({
    // Before `&`, `|`, `<`, `>` and `*`, which they begin with.
    {"&&", 1, Operator::conjunction},
    {"||", 1, Operator::disjunction},
    {"XOR", 1, Operator::exclusion},
    {"AND", 1, Operator::conjunction},
    {"OR", 1, Operator::disjunction},
    {"==", 2, Operator::equal},
    {"!=", 2, Operator::not_equal},
    {">=", 2, Operator::at_least},
    {"<=", 2, Operator::at_most},
    {">", 2, Operator::greater},
    {"<", 2, Operator::less},
    {"&", 2, Operator::bit_conjunction},
    {"|", 2, Operator::bit_disjunction},
    {"^", 2, Operator::bit_exclusion},
    {"+", 3, Operator::add},
    {"-", 3, Operator::subtract},
    {"**", 5, Operator::power},
    {"*", 4, Operator::multiply},
    {"/", 4, Operator::divide},
    {"MOD", 4, Operator::remainder},
});

constexpr auto isg_functions = std::to_array<FunctionRow>({
    {"ABS", Function::absolute},
    {"SQR", Function::square},
    {"SQRT", Function::root},
    {"EXP", Function::exponential},
    {"LN", Function::logarithm},
    {"DEXP", Function::decimal_exponential},
    {"LOG", Function::decimal_logarithm},
    {"SIN", Function::sine},
    {"COS", Function::cosine},
    {"TAN", Function::tangent},
    {"COT", Function::cotangent},
    {"ASIN", Function::arc_sine},
    {"ACOS", Function::arc_cosine},
    {"ATAN", Function::arc_tangent},
    {"ACOT", Function::arc_cotangent},
    {"INT", Function::truncate},
    {"FRACT", Function::fraction},
    {"ROUND", Function::round},
    {"SIGN", Function::sign},
    {"MIN", Function::least, 2},
    {"MAX", Function::greatest, 2},
    {"NOT", Function::negation},
    {"INV", Function::bit_negation},
});

}  // namespace

const Grammar& isg_grammar() {
  static constexpr Grammar grammar{.dialect = DialectName::isg,
                                   .operators = isg_operators,
                                   .functions = isg_functions,
                                   .highest_level = 5,
                                   .has_names = true};
  return grammar;
}

const Grammar& sinumerik_grammar() {
  static constexpr Grammar grammar{.dialect = DialectName::sinumerik,
                                   .operators = sinumerik_operators,
                                   .functions = sinumerik_functions,
                                   .highest_level = 10,
                                   .open = '(',
                                   .close = ')',
                                   .has_names = true};
  return grammar;
}

const Grammar& fanuc_grammar() {
  static constexpr Grammar grammar{.dialect = DialectName::fanuc,
                                   .operators = fanuc_operators,
                                   .functions = fanuc_functions,
                                   .highest_level = 3};
  return grammar;
}

const Grammar& linuxcnc_grammar() {
  static constexpr Grammar grammar{.dialect = DialectName::linuxcnc,
                                   .operators = linuxcnc_operators,
                                   .functions = linuxcnc_functions,
                                   .highest_level = 5};
  return grammar;
}

}  // namespace trc::program
