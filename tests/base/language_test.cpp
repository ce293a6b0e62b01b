#include "core/base/language.h"

#include <gtest/gtest.h>

namespace trc {
namespace {

TEST(Language, IsReadFromATag) {
  EXPECT_EQ(language_of_tag("de"), Language::german);
  EXPECT_EQ(language_of_tag("de_DE.UTF-8"), Language::german);
  EXPECT_EQ(language_of_tag("DE-at"), Language::german);
  EXPECT_EQ(language_of_tag("en-GB"), Language::english);
  EXPECT_EQ(language_of_tag("C.UTF-8"), Language::english);
  EXPECT_EQ(language_of_tag("fr"), std::nullopt);
  EXPECT_EQ(language_of_tag("den"), std::nullopt);
  EXPECT_EQ(language_of_tag(""), std::nullopt);
}

TEST(Language, IsWhatAcceptLanguagePrefers) {
  EXPECT_EQ(accepted_language("de-DE,de;q=0.9,en;q=0.8"), Language::german);
  EXPECT_EQ(accepted_language("en-US,en;q=0.9,de;q=0.8"), Language::english);
  EXPECT_EQ(accepted_language("fr, de;q=0.5"), Language::german);
  EXPECT_EQ(accepted_language("en;q=0.2, de;q=0.9"), Language::german);
  EXPECT_EQ(accepted_language("de;q=0"), Language::english);
  EXPECT_EQ(accepted_language("de;q=x"), Language::english);
  EXPECT_EQ(accepted_language(""), Language::english);
  EXPECT_EQ(accepted_language("*"), Language::english);
}

}  // namespace
}  // namespace trc
