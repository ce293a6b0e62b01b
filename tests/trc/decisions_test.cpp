#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <string_view>

#include "core/base/diagnostic.h"
#include "tests/support/places.h"

// Decisions of core/doc/decisions.md are pinned by tests that name them, as D-nn.

namespace trc {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// What the first group of the pattern matches.
void add_matches(const std::string& text, const std::regex& pattern, Names& names) {
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    names.insert((*match)[1]);
}

// Each has a row of a table, or an entry of a list.
Names all_decisions() {
  Names names;
  const fs::path document =
      fs::path(testing_support::source_dir()) / "core" / "doc" / "decisions.md";
  add_matches(content_of(document), std::regex("\n(?:\\| |\\* \\*\\*)(D-[0-9]{2,}) "), names);
  return names;
}

Names named_in_tests() {
  constexpr auto extensions =
      std::to_array<std::string_view>({".cpp", ".h", ".nc", ".expected", ".py", ".mjs"});
  const std::regex name("\\b(D-[0-9]{2,})\\b");
  Names names;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(testing_support::source_dir()) / "tests")) {
    if (!entry.is_regular_file() || entry.path().filename() == "decisions_test.cpp") continue;
    const std::string extension = entry.path().extension().string();
    if (std::ranges::find(extensions, extension) != extensions.end())
      add_matches(content_of(entry.path()), name, names);
  }
  return names;
}

TEST(Decisions, AreEachNamedByATest) {
  // No test names these yet. A decision is only taken off here, never added.
  const Names open{"D-99", "D-136", "D-146", "D-147", "D-148", "D-154"};
  const Names decisions = all_decisions();
  ASSERT_GT(decisions.size(), 100U);
  const Names named = named_in_tests();
  for (const std::string& decision : decisions) {
    if (decision == "D-32") continue;  // the next test
    EXPECT_NE(named.contains(decision), open.contains(decision))
        << decision << (open.contains(decision) ? " is no longer open" : " is named by no test");
  }
  for (const std::string& decision : open)
    EXPECT_TRUE(decisions.contains(decision)) << decision << " is none";
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
