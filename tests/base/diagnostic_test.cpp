#include "core/base/diagnostic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string_view>

namespace trc {
namespace {

TEST(CodeTable, IsInAscendingOrderWithoutDoubles) {
  const auto rows = code_table();
  for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_LT(rows[i - 1].code, rows[i].code);
}

TEST(CodeTable, EveryRowHasAReasonOfItsOwn) {
  std::set<std::string_view> reasons;
  for (const CodeRow& row : code_table()) {
    SCOPED_TRACE(static_cast<int>(row.code));
    EXPECT_TRUE(reasons.insert(row.reason).second) << row.reason;
    EXPECT_TRUE(std::ranges::all_of(row.reason, [](char letter) {
      return (letter >= 'A' && letter <= 'Z') || letter == '_';
    })) << row.reason;
  }
}

TEST(CodeTable, WarningsAreThoseThatDoNotStopTheReferenceControl) {
  std::set<int> warnings;
  for (const CodeRow& row : code_table())
    if (row.severity == Severity::warning) warnings.insert(static_cast<int>(row.code));
  EXPECT_EQ(warnings, (std::set<int>{21316, 22007, 90057, 900204, 900205, 900215, 900217, 900220,
                                     900221, 900224, 900225, 900227, 900228, 900236}));
}

TEST(CodeTable, ACodeFromElsewhereIsShownAsUnknown) {
  EXPECT_EQ(row_of(static_cast<Code>(123)).reason, "UNKNOWN");
}

}  // namespace
}  // namespace trc
