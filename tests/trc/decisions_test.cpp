#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "core/base/diagnostic.h"
#include "tests/support/places.h"

// Each decision of the rule book is pinned by a test that names it.

namespace trc {
namespace {

namespace fs = std::filesystem;

constexpr int decisions = 45;

std::string name_of(int decision) {
  return (decision < 10 ? "D-0" : "D-") + std::to_string(decision);
}

std::set<std::string> decisions_named_in_tests() {
  std::set<std::string> named;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(testing_support::source_dir()) / "tests")) {
    if (!entry.is_regular_file() || entry.path().filename() == "decisions_test.cpp") continue;
    const std::string extension = entry.path().extension().string();
    if (extension != ".cpp" && extension != ".nc" && extension != ".expected") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (int decision = 1; decision <= decisions; ++decision)
      if (text.find(name_of(decision)) != std::string::npos) named.insert(name_of(decision));
  }
  return named;
}

TEST(Decisions, AreEachNamedByATest) {
  // Functions that are refused so far; a test that names one takes it off here.
  const std::set<std::string> open{};
  const std::set<std::string> named = decisions_named_in_tests();
  for (int decision = 1; decision <= decisions; ++decision) {
    if (decision == 32) continue;  // the next test
    const std::string name = name_of(decision);
    EXPECT_TRUE(named.contains(name)) << name;
  }
}

// D-32: codes that are not published IDs lie from 900000 on.
TEST(Decisions, OwnCodesHaveARangeOfTheirOwn) {
  std::size_t own = 0;
  for (const CodeRow& row : code_table()) {
    const auto code = static_cast<int>(row.code);
    const bool published = (code >= 20000 && code < 23000) || (code >= 90000 && code < 100000);
    EXPECT_TRUE(published || (code > 900000 && code < 901000)) << code;
    own += published ? 0 : 1;
  }
  EXPECT_GT(own, 0U);
}

}  // namespace
}  // namespace trc
