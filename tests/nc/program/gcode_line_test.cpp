#include "core/nc/program/gcode_line.h"

#include <gtest/gtest.h>

#include <string>

#include "core/nc/program/program_text.h"
#include "core/nc/text/number_format.h"

namespace trc::program {
namespace {

TEST(LineHead, IsASlashAndANumber) {
  const LineHead head = head_of(" /2 N40 X1");
  EXPECT_TRUE(head.to_skip);
  EXPECT_EQ(head.number, 40);
  EXPECT_EQ(head.number_begin, 4U);
  EXPECT_EQ(head.number_end, 7U);
  EXPECT_EQ(head.behind, 8U);
}

TEST(LineHead, MayHaveNeither) {
  const LineHead head = head_of("G1 N40");
  EXPECT_FALSE(head.to_skip);
  EXPECT_EQ(head.number, -1);
  EXPECT_EQ(head.behind, 0U);
}

TEST(LineHead, HasNoNumberOfMoreThanFifteenDigits) {
  EXPECT_EQ(head_of("N123456789012345").number, 123456789012345);
  EXPECT_EQ(head_of("N1234567890123456").number, -1);
  EXPECT_EQ(head_of("N#1").number, -1);
}

TEST(CodeLine, IsOverWhereNothingButCommentsStands) {
  EXPECT_TRUE(is_over("GOTO 5", 6));
  EXPECT_TRUE(is_over("GOTO 5 (BACK) ; AGAIN", 6));
  EXPECT_FALSE(is_over("GOTO 5 X1", 6));
  EXPECT_FALSE(is_over("GOTO 5 (BACK", 6)) << "a comment without an end";
}

TEST(CodeLine, GivesItsCommentsWithABlankBetween) {
  EXPECT_EQ(comments_of("#1=2 (ONE)(TWO) ;THREE", 4), "(ONE) (TWO) ;THREE");
  EXPECT_EQ(comments_of("#1=2", 4), "");
}

TEST(CodeLine, HasAWordInAnyCase) {
  EXPECT_TRUE(has_word_at("n1 goto 5", 3, "GOTO"));
  EXPECT_FALSE(has_word_at("GOT", 0, "GOTO"));
}

TEST(CodeLine, HasAFunctionOfItsLetterOutsideOfComments) {
  EXPECT_TRUE(has_function("G1 G41.1 X1", 'G', 41, 42));
  EXPECT_TRUE(has_function("g 42", 'G', 41, 42));
  EXPECT_FALSE(has_function("G141 (G41) ; G42", 'G', 41, 42));
  EXPECT_FALSE(has_function("G4 (G41", 'G', 41, 42)) << "a comment without an end";
}

TEST(ComputedValue, IsWrittenWithAsManyDecimalsAsItNeeds) {
  const auto written = [](double value, PointStyle style, int decimals = decimals_of_values) {
    std::string text;
    append_value(text, value, style, decimals);
    return text;
  };
  EXPECT_EQ(written(30, PointStyle::as_whole), "30");
  EXPECT_EQ(written(30, PointStyle::with_point), "30.");
  EXPECT_EQ(written(-0.5, PointStyle::with_point), "-0.5");
  EXPECT_EQ(written(1.0 / 3, PointStyle::as_whole), "0.33333333");
  EXPECT_EQ(written(1.0 / 3, PointStyle::as_whole, 3), "0.333");
}

TEST(ComputedValue, IsWrittenWithAllDecimalsWhereTheirNumberIsFixed) {
  std::string text = "X";
  append_fixed(text, 1.5, 3);
  EXPECT_EQ(text, "X1.500");
}

TEST(ProgramText, CountsLinesWhateverTheyEndWith) {
  const ProgramText text("", "A\nB\r\nC\rD");
  ASSERT_EQ(text.size(), 4U);
  EXPECT_EQ(text.line(1), "B");
  EXPECT_EQ(text.line_end(0), "\n");
  EXPECT_EQ(text.line_end(1), "\r\n");
  EXPECT_EQ(text.line_end(2), "\r");
  EXPECT_EQ(text.line(3), "D");
  EXPECT_EQ(text.line_end(3), "");
  EXPECT_EQ(text.number(3), 4U);
  EXPECT_FALSE(text.is_cut());
}

TEST(ProgramText, HasNoLineAfterItsLastEnd) { EXPECT_EQ(ProgramText("", "A\nB\n").size(), 2U); }

TEST(ProgramText, CountsFromItsFirstLine) {
  const ProgramText text("", "A\nB\n", 7);
  EXPECT_EQ(text.number(1), 8U);
  EXPECT_TRUE(text.is_cut());
}

}  // namespace
}  // namespace trc::program
