#include "core/messages/english.h"

#include <gtest/gtest.h>

// The English texts of the table of codes.

namespace trc {
namespace {

TEST(English, HasTheRowsOfTheTable) {
  const auto rows = code_table();
  const auto english = english_rows();
  ASSERT_EQ(english.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(english[i].code, rows[i].code);
}

TEST(English, EveryRowSaysCauseAndRemedy) {
  for (const EnglishRow& row : english_rows()) {
    SCOPED_TRACE(static_cast<int>(row.code));
    EXPECT_FALSE(row.cause.empty());
    EXPECT_FALSE(row.cause.ends_with('.'));
    EXPECT_TRUE(row.remedy.ends_with('.'));
  }
}

TEST(English, OfACodeFromElsewhereSaysThatItIsUnknown) {
  EXPECT_EQ(english_row_of(static_cast<Code>(123)).remedy, "Update this program.");
}

}  // namespace
}  // namespace trc
