#include "core/base/utf8.h"

#include <gtest/gtest.h>

#include "core/base/diagnostic.h"
#include "core/nc/text/characters.h"

namespace trc {
namespace {

TEST(TextOfEitherEncoding, IsUtf8WhateverItWas) {
  EXPECT_EQ(as_utf8("FRÄSER"), "FRÄSER");
  EXPECT_EQ(as_utf8("FR\xC4SER \xD8"
                    "10"),
            "FRÄSER Ø10");
  EXPECT_EQ(as_utf8(""), "");
  EXPECT_TRUE(is_utf8("Ø10"));
  EXPECT_FALSE(
      is_utf8("\xD8"
              "10"));
}

TEST(TextOfEitherEncoding, IsOneNameWhateverTheCaseOfItsLetters) {
  EXPECT_EQ(in_capitals_as_utf8("fr\xE4ser"), "FRÄSER");
  EXPECT_EQ(in_capitals_as_utf8("fräser øþ÷ß"), "FRÄSER ØÞ÷ß");
}

TEST(TextOfEitherEncoding, IsTheDetailOfADiagnostic) {
  EXPECT_EQ(diagnostic(Code::tool_unknown, {}, "FR\xC4SER").detail, "FRÄSER");
}

}  // namespace
}  // namespace trc
