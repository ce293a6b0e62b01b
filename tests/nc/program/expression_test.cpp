#include "core/nc/program/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trc::program {
namespace {

// #1 = 5, A = 7; #2 and #3 are vacant, every other variable has no value.
class KnownVariables final : public Variables {
 public:
  Value read(ExpressionReader& expression) override {
    const std::size_t begin = expression.at();
    const std::string spelling = spelled(expression);
    if (const auto known = values_.find(spelling); known != values_.end()) return known->second;
    return expression.fail(Code::variable_unset, begin, spelling);
  }
  bool exists(ExpressionReader& expression) override {
    return values_.contains(spelled(expression));
  }

 private:
  static std::string spelled(ExpressionReader& expression) {
    if (expression.pass("#")) return "#" + std::to_string(expression.whole_operand());
    const std::string name(expression.name());
    expression.go_to(expression.at() + name.size());
    return name;
  }

  std::map<std::string, Value> values_{{"#1", {.number = 5}},
                                       {"#2", {.vacant = true}},
                                       {"#3", {.vacant = true}},
                                       {"A", {.number = 7}}};
};

// The value of a line that is one expression.
Value value_in(const Grammar& grammar, std::string_view line) {
  KnownVariables variables;
  ExpressionReader reader(grammar, line, 0, variables);
  Value value = reader.expression();
  EXPECT_FALSE(reader.failed()) << line << ": " << reader.fault().detail;
  EXPECT_EQ(reader.at(), line.size()) << line;
  return value;
}

double fanuc(std::string_view line) { return value_in(fanuc_grammar(), line).number; }
double linuxcnc(std::string_view line) { return value_in(linuxcnc_grammar(), line).number; }
double sinumerik(std::string_view line) { return value_in(sinumerik_grammar(), line).number; }
double isg(std::string_view line) { return value_in(isg_grammar(), line).number; }

// "CODE BYTE DETAIL" of what is wrong with a line; empty: nothing.
std::string fault_in(const Grammar& grammar, std::string_view line) {
  KnownVariables variables;
  ExpressionReader reader(grammar, line, 0, variables);
  static_cast<void>(reader.expression());
  if (!reader.failed()) return {};
  const TextFault& fault = reader.fault();
  return std::to_string(static_cast<int>(fault.code)) + ' ' + std::to_string(fault.begin) + ' ' +
         fault.detail;
}

std::string code(Code code) { return std::to_string(static_cast<int>(code)); }

TEST(Expression, AppliesOperatorsOfHigherLevelsFirst) {
  EXPECT_EQ(fanuc("1+2*3"), 7);
  EXPECT_EQ(fanuc("[1+2]*3"), 9);
  EXPECT_EQ(linuxcnc("2*3**2"), 18);
  EXPECT_EQ(sinumerik("1+7 DIV 2"), 4);
  EXPECT_EQ(isg("1+2*3"), 7);
}

TEST(Expression, AppliesOperatorsOfOneLevelFromLeftToRight) {
  EXPECT_EQ(fanuc("8-3-2"), 3);
  EXPECT_EQ(linuxcnc("8/4/2"), 1);
  EXPECT_EQ(sinumerik("8-3+2"), 7);
}

TEST(Expression, ReadsWordsInAnyCaseAndBlanksAnywhereBetween) {
  EXPECT_EQ(fanuc("7 mod 4"), 3);
  EXPECT_DOUBLE_EQ(fanuc(" sin [ 30 ]"), 0.5);
  EXPECT_EQ(sinumerik("Minval ( 3 , 2 )"), 2);
}

TEST(Expression, EndsWhereItGoesNoFarther) {
  KnownVariables variables;
  ExpressionReader reader(fanuc_grammar(), "X1+2Y3", 1, variables);
  EXPECT_EQ(reader.expression().number, 3);
  EXPECT_EQ(reader.at(), 4U);
}

TEST(Expression, RefusesTwoComparisonsSideBySide) {
  EXPECT_EQ(fault_in(fanuc_grammar(), "1 LT 2 LT 3"), code(Code::expression_invalid) + " 7 LT");
  EXPECT_EQ(fault_in(sinumerik_grammar(), "1 < 2 < 3"), code(Code::expression_invalid) + " 6 <");
  EXPECT_EQ(fanuc("[1 LT 2] EQ 1"), 1);
}

// No manual says in which order they act.
TEST(Expression, OfIsgWantsBracketsAmongLogicalOperatorsAndAroundPowers) {
  EXPECT_EQ(fault_in(isg_grammar(), "1 && 0 || 1"),
            code(Code::expression_invalid) + " 7 ||, whose order needs brackets");
  EXPECT_EQ(fault_in(isg_grammar(), "2**3**2"),
            code(Code::expression_invalid) + " 4 **, whose order needs brackets");
  EXPECT_EQ(fault_in(isg_grammar(), "-2**2"),
            code(Code::expression_invalid) + " 2 **, whose order needs brackets");
  EXPECT_EQ(isg("[1 && 0] || 1"), 1);
  EXPECT_EQ(isg("[2**3]**2"), 64);
  EXPECT_EQ(isg("1 && 1 && 1"), 1);
}

TEST(Expression, HasLogicOfBitsForFanucAndOfTruthForTheOthers) {
  EXPECT_EQ(fanuc("6 AND 3"), 2);
  EXPECT_EQ(fanuc("6 XOR 3"), 5);
  EXPECT_EQ(linuxcnc("6 AND 3"), 1);
  EXPECT_EQ(linuxcnc("6 XOR 3"), 0);
  EXPECT_EQ(sinumerik("6 AND 3"), 1);
  EXPECT_EQ(sinumerik("6 B_AND 3"), 2);
  EXPECT_EQ(sinumerik("NOT 6"), 0);
}

TEST(Expression, HasNoBitsOfWhatIsNoWholeNumber) {
  EXPECT_EQ(fault_in(sinumerik_grammar(), "1.5 B_OR 1"),
            code(Code::value_invalid) + " 4 bits of what is no whole number");
}

TEST(Expression, ComparesAsItsControlDoes) {
  EXPECT_EQ(fanuc("0.1+0.2 EQ 0.3"), 1);
  EXPECT_EQ(sinumerik("0.1+0.2 == 0.3"), 1);
  EXPECT_EQ(linuxcnc("1 EQ 1.00009"), 1);
  EXPECT_EQ(fanuc("1 EQ 1.00009"), 0);
  EXPECT_EQ(fault_in(isg_grammar(), "0.1+0.2 == 0.3"),
            code(Code::value_invalid) + " 8 a comparison of numbers that are nearly equal");
}

TEST(Expression, TakesAVacantVariableForNoughtButWhereItIsComparedForEquality) {
  EXPECT_EQ(fanuc("#2+1"), 1);
  EXPECT_EQ(fanuc("#2 GE 0"), 1);
  EXPECT_EQ(fanuc("#2 EQ 0"), 0);
  EXPECT_EQ(fanuc("#2 NE 0"), 1);
  EXPECT_EQ(fanuc("#2 EQ #3"), 1);
}

TEST(Expression, ReadsVariablesByNumberOrByName) {
  EXPECT_EQ(fanuc("-#1*2"), -10);
  EXPECT_EQ(fanuc("#[#1-4]"), 5);
  EXPECT_EQ(sinumerik("A+1"), 8);
  EXPECT_EQ(linuxcnc("EXISTS[#1]"), 1);
  EXPECT_EQ(linuxcnc("EXISTS[#9]"), 0);
}

TEST(Expression, HasArcTangentsOfTwoValuesAsItsControlWritesThem) {
  EXPECT_DOUBLE_EQ(fanuc("ATAN[-1]/[1]"), 315);
  EXPECT_DOUBLE_EQ(fanuc("ATAN[-1,1]"), 315);
  EXPECT_DOUBLE_EQ(linuxcnc("ATAN[-1]/[1]"), -45);
  EXPECT_DOUBLE_EQ(sinumerik("ATAN2(1,-1)"), 135);
}

TEST(Expression, DividesAfterAnArcTangentOfOneValue) {
  EXPECT_DOUBLE_EQ(fanuc("ATAN[1]/2"), 22.5);
  EXPECT_EQ(fault_in(linuxcnc_grammar(), "ATAN[1]/2"),
            code(Code::expression_invalid) + " 0 ATAN without / [ ]");
}

TEST(Expression, RefusesAnArcTangentOfNoDirection) {
  EXPECT_EQ(fault_in(fanuc_grammar(), "ATAN[0]/[0]"),
            code(Code::value_invalid) + " 0 ATAN of 0 and 0");
  EXPECT_EQ(fault_in(sinumerik_grammar(), "ATAN2(0,0)"),
            code(Code::value_invalid) + " 0 ATAN2 of 0 and 0");
}

TEST(Expression, BoundsAValueBetweenTwoInOrder) {
  EXPECT_EQ(sinumerik("BOUND(1,5,7)"), 5);
  EXPECT_EQ(sinumerik("BOUND(1,5,0)"), 1);
  EXPECT_EQ(fault_in(sinumerik_grammar(), "BOUND(5,1,3)"), code(Code::value_invalid) + " 0 BOUND");
}

TEST(Expression, RoundsToTheDecimalsOfItsPlaceForFanuc) {
  KnownVariables variables;
  ExpressionReader word(fanuc_grammar(), "ROUND[1.23456]", 0, variables);
  word.round_to(3);
  EXPECT_EQ(word.expression().number, 1.235);
  EXPECT_EQ(fanuc("ROUND[1.23456]"), 1);
}

TEST(Expression, ReadsNumbersOfOtherBasesOfSinumerik) {
  EXPECT_EQ(sinumerik("'H2F'"), 47);
  EXPECT_EQ(sinumerik("'b101'+1"), 6);
  EXPECT_EQ(fault_in(sinumerik_grammar(), "'B12'"), code(Code::expression_invalid) + " 0 'B");
  EXPECT_EQ(fault_in(sinumerik_grammar(), "'H'"), code(Code::expression_invalid) + " 0 'H");
}

TEST(Expression, JoinsAndComparesTextsOfSinumerik) {
  EXPECT_EQ(value_in(sinumerik_grammar(), "\"AB\"<<3<<\"C\"").text, "AB3C");
  EXPECT_EQ(sinumerik("STRLEN(\"ABC\")"), 3);
  EXPECT_EQ(sinumerik("\"A\" == \"A\""), 1);
  EXPECT_EQ(sinumerik("\"A\" <> \"A\""), 0);
  EXPECT_EQ(fault_in(sinumerik_grammar(), "\"A\" < \"B\""),
            code(Code::expression_invalid) + " 4 a text");
}

TEST(Expression, RefusesADivisionByNought) {
  EXPECT_EQ(fault_in(fanuc_grammar(), "1/0"), code(Code::division_by_zero) + " 1 /");
  EXPECT_EQ(fault_in(sinumerik_grammar(), "1 DIV 0"), code(Code::division_by_zero) + " 2 DIV");
}

// Fanuc rounds both operands of MOD.
TEST(Expression, HasNoRemainderOfFanucByWhatRoundsToNought) {
  EXPECT_EQ(fault_in(fanuc_grammar(), "5 MOD 0.4"), code(Code::division_by_zero) + " 2 MOD");
  EXPECT_NEAR(linuxcnc("5 MOD 0.4"), 0.2, 1e-12);
  EXPECT_EQ(linuxcnc("[0-1] MOD 4"), 3);
  EXPECT_EQ(sinumerik("-1 MOD 4"), -1);
}

TEST(Expression, TellsTheFirstFaultAlone) {
  EXPECT_EQ(fault_in(fanuc_grammar(), "#9+1/0"), code(Code::variable_unset) + " 0 #9");
  EXPECT_EQ(fault_in(fanuc_grammar(), "1/0+["), code(Code::division_by_zero) + " 1 /");
}

TEST(Expression, NamesWhatStandsInPlaceOfAnOperand) {
  EXPECT_EQ(fault_in(fanuc_grammar(), "1+"),
            code(Code::expression_invalid) + " 2 the end of the line");
  EXPECT_EQ(fault_in(fanuc_grammar(), "[1+2"),
            code(Code::expression_invalid) + " 0 [, a bracket without ]");
  EXPECT_EQ(fault_in(sinumerik_grammar(), "(1"),
            code(Code::expression_invalid) + " 0 (, a bracket without )");
  EXPECT_EQ(fault_in(fanuc_grammar(), "SINE[1]"), code(Code::expression_invalid) + " 0 SINE");
}

// Whatever stands around a value, each takes of the stack of who reads it.
TEST(Expression, MayHaveSixtyFourOperandsWithinEachOther) {
  const auto nested = [](std::size_t deep) {
    return std::string(deep, '[') + "1" + std::string(deep, ']');
  };
  EXPECT_EQ(fault_in(fanuc_grammar(), nested(63)), "");
  EXPECT_EQ(fault_in(fanuc_grammar(), nested(64)),
            code(Code::expression_invalid) + " 64 nested too deeply");
  const std::vector<std::pair<const Grammar&, std::string>> openings{
      {fanuc_grammar(), "-"},          {fanuc_grammar(), "#"},
      {fanuc_grammar(), "#["},         {fanuc_grammar(), "SIN["},
      {fanuc_grammar(), "ATAN[1]/["},  {fanuc_grammar(), "POW[1,"},
      {linuxcnc_grammar(), "#"},       {linuxcnc_grammar(), "+"},
      {linuxcnc_grammar(), "1**["},    {sinumerik_grammar(), "NOT "},
      {sinumerik_grammar(), "("},      {sinumerik_grammar(), "ATAN2(1,"},
      {sinumerik_grammar(), "B_NOT "}, {isg_grammar(), "NOT["},
      {isg_grammar(), "MAX[1,"},       {isg_grammar(), "-"}};
  for (const auto& [grammar, opening] : openings) {
    std::string line;
    for (int deep = 0; deep < 100'000; ++deep) line += opening;
    const std::string fault = fault_in(grammar, line);
    EXPECT_EQ(fault.substr(fault.find(' ', 7) + 1), "nested too deeply") << opening;
  }
}

TEST(Expression, RefusesWhatIsTooLargeForANumber) {
  EXPECT_EQ(fault_in(fanuc_grammar(), "EXP[999]"), code(Code::value_invalid) + " 0 too large");
}

TEST(WholeOperand, IsAWholeNumberThatIsNotNegative) {
  const auto read = [](std::string_view line) {
    KnownVariables variables;
    ExpressionReader reader(fanuc_grammar(), line, 0, variables);
    const std::int64_t number = reader.whole_operand();
    return std::pair(number, reader.failed());
  };
  EXPECT_EQ(read("12"), std::pair(std::int64_t{12}, false));
  EXPECT_EQ(read("[#1-2]"), std::pair(std::int64_t{3}, false));
  EXPECT_TRUE(read("1.5").second);
  EXPECT_TRUE(read("-1").second);
  EXPECT_TRUE(read("#2").second) << "a vacant variable";
}

TEST(Truth, IsANumberThatIsNotNoughtAndOfIsgOneHalfOrMore) {
  KnownVariables variables;
  const ExpressionReader of_sinumerik(sinumerik_grammar(), "", 0, variables);
  const ExpressionReader of_isg(isg_grammar(), "", 0, variables);
  EXPECT_TRUE(of_sinumerik.holds({.number = 0.1}));
  EXPECT_FALSE(of_isg.holds({.number = 0.1}));
  EXPECT_TRUE(of_isg.holds({.number = -0.5}));
  EXPECT_TRUE(of_sinumerik.holds({.is_text = true, .text = "A"}));
  EXPECT_FALSE(of_sinumerik.holds({.is_text = true}));
}

}  // namespace
}  // namespace trc::program
