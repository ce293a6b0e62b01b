#include "core/nc/program/arithmetic.h"

#include <gtest/gtest.h>

namespace trc::program {
namespace {

std::optional<double> fanuc(Function function, double argument) {
  return applied(function, argument, DialectName::fanuc, 0);
}

std::optional<double> sinumerik(Function function, double argument) {
  return applied(function, argument, DialectName::sinumerik, 0);
}

TEST(FunctionOfOneNumber, CountsAnglesInDegrees) {
  EXPECT_DOUBLE_EQ(*fanuc(Function::sine, 30), 0.5);
  EXPECT_DOUBLE_EQ(*fanuc(Function::arc_cosine, 0.5), 60);
  EXPECT_DOUBLE_EQ(*fanuc(Function::arc_tangent, 1), 45);
  EXPECT_DOUBLE_EQ(*fanuc(Function::cotangent, 45), 1);
}

// D-48
TEST(FunctionOfOneNumber, HasArcSinesOfFanucFromNoughtTo360) {
  EXPECT_DOUBLE_EQ(*fanuc(Function::arc_sine, -0.5), 330);
  EXPECT_DOUBLE_EQ(*sinumerik(Function::arc_sine, -0.5), -30);
}

TEST(FunctionOfOneNumber, HasNoValueOutsideOfWhatItTakes) {
  EXPECT_FALSE(fanuc(Function::root, -1));
  EXPECT_FALSE(fanuc(Function::logarithm, 0));
  EXPECT_FALSE(fanuc(Function::arc_sine, 1.5));
  EXPECT_FALSE(fanuc(Function::arc_cosine, -1.5));
  EXPECT_FALSE(fanuc(Function::cotangent, 0));
  EXPECT_FALSE(fanuc(Function::to_decimal, -1));
}

TEST(FunctionOfOneNumber, TakesForWholeWhatFanucComputesNearly) {
  const double nearly = 0.1 * 3 * 10;  // 3.0000000000000004
  ASSERT_NE(nearly, 3);
  EXPECT_EQ(fanuc(Function::up, nearly), 3);
  EXPECT_EQ(sinumerik(Function::up, nearly), 4);
  EXPECT_EQ(fanuc(Function::down, -1.5), -1);
  EXPECT_EQ(sinumerik(Function::down, -1.5), -2);
}

TEST(FunctionOfOneNumber, RoundsToTheDecimalsThatItIsGiven) {
  EXPECT_EQ(applied(Function::round, 1.2346, DialectName::fanuc, 3), 1.235);
  EXPECT_EQ(applied(Function::round, 1.2346, DialectName::fanuc, 0), 1);
}

TEST(FunctionOfOneNumber, TurnsDigitsFromOneBaseToTheOther) {
  EXPECT_EQ(fanuc(Function::to_decimal, 42), 0x42);
  EXPECT_EQ(fanuc(Function::to_binary, 0x42), 42);
  EXPECT_FALSE(fanuc(Function::to_binary, 0x4a));
}

TEST(Nearness, IsAbsoluteAndRelativeForFanucAndRelativeForSinumerik) {
  EXPECT_TRUE(is_near(0, 5e-10));
  EXPECT_FALSE(is_relatively_near(0, 5e-10));
  EXPECT_TRUE(is_near(1e6, 1e6 + 5e-5));
  EXPECT_FALSE(is_relatively_near(1e6, 1e6 + 5e-5));
  EXPECT_TRUE(is_relatively_near(1e6, 1e6 + 5e-7));
}

}  // namespace
}  // namespace trc::program
