#include "core/messages/explanation.h"

#include <gtest/gtest.h>

#include "core/messages/english.h"

namespace trc {
namespace {

TEST(Explanation, IsThereForEveryCode) {
  const auto all = explanations();
  const auto rows = code_table();
  ASSERT_EQ(all.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(all[i].code, rows[i].code);
  EXPECT_EQ(explanation_of(static_cast<Code>(123)), nullptr);
}

TEST(Explanation, SaysMeaningAndCausesInSentences) {
  for (const Explanation& one : explanations()) {
    SCOPED_TRACE(static_cast<int>(one.code));
    EXPECT_TRUE(one.meaning.ends_with('.'));
    EXPECT_FALSE(one.causes[0].empty());
    for (const std::string_view cause : one.causes)
      EXPECT_TRUE(cause.empty() || cause.ends_with('.')) << cause;
    EXPECT_TRUE(one.on_command_line.empty() || one.on_command_line.ends_with('.'));
    EXPECT_NE(one.meaning.substr(0, one.meaning.size() - 1), english_row_of(one.code).cause);
  }
}

TEST(Explanation, HasAnExample) {
  for (const Explanation& one : explanations()) {
    SCOPED_TRACE(static_cast<int>(one.code));
    EXPECT_TRUE(one.example.ends_with('\n'));
    EXPECT_NE(one.example.find(one.repeated), std::string_view::npos);
    EXPECT_EQ(example_of(one).size(), one.example.size() + (one.times - 1) * one.repeated.size());
  }
}

}  // namespace
}  // namespace trc
