#include "core/base/ascii.h"

#include <gtest/gtest.h>

namespace trc {
namespace {

TEST(LowerCase, IsOfAsciiLettersOnly) {
  EXPECT_EQ(in_lower_case("Text/PLAIN-Az_09"), "text/plain-az_09");
  EXPECT_EQ(in_lower_case("\xC3\x84"
                          "B"),
            "\xC3\x84"
            "b");
  EXPECT_EQ(in_lower_case("@[\xC4"), "@[\xC4");
  EXPECT_EQ(in_lower_case(""), "");
}

TEST(Trimmed, LosesTheSignsAtBothEnds) {
  EXPECT_EQ(trimmed(" \tG1 \t X10\t "), "G1 \t X10");
  EXPECT_EQ(trimmed("X"), "X");
  EXPECT_EQ(trimmed("\rX\r"), "\rX\r");
  EXPECT_EQ(trimmed(" \t "), "");
  EXPECT_EQ(trimmed(""), "");
  EXPECT_EQ(trimmed("\t X ", " "), "\t X");
  EXPECT_EQ(trimmed("\" 12\"\r", " \t\r\""), "12");
}

}  // namespace
}  // namespace trc
