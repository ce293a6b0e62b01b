#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "tests/support/places.h"

// rules.txt says which tests pin each row of the tables of the rules down.

namespace trc {
namespace {

namespace fs = std::filesystem;

const fs::path tests = fs::path(testing_support::source_dir()) / "tests";

struct Row {
  std::string label;
  std::vector<std::string> pinned_by{};
};

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<Row> rows() {
  std::vector<Row> result;
  std::istringstream lines(content_of(tests / "trc" / "rules.txt"));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    Row row{.label = line.substr(0, line.find(' '))};
    const std::size_t bar = line.find(" | ");
    std::istringstream names(bar == std::string::npos ? "" : line.substr(bar + 3));
    for (std::string name; names >> name;) row.pinned_by.push_back(name);
    result.push_back(row);
  }
  return result;
}

// "Suite.Name" of every test and a program's "good/name".
std::set<std::string> names_of_tests() {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(tests)) {
    if (entry.path().extension() == ".nc")
      names.insert(entry.path().parent_path().filename().string() + '/' +
                   entry.path().stem().string());
    if (entry.path().extension() != ".cpp") continue;
    std::istringstream lines(content_of(entry.path()));
    for (std::string line; std::getline(lines, line);) {
      const std::size_t open = line.find('(');
      const std::size_t comma = line.find(", ");
      if (!line.starts_with("TEST") || open > 6 || comma == std::string::npos) continue;
      names.insert(line.substr(open + 1, comma - open - 1) + '.' +
                   line.substr(comma + 2, line.find(')') - comma - 2));
    }
  }
  return names;
}

TEST(Rules, AreEachPinnedDownByTestsThatExist) {
  const std::set<std::string> names = names_of_tests();
  std::set<std::string> labels;
  for (const Row& row : rows()) {
    EXPECT_TRUE(labels.insert(row.label).second) << row.label << " is there twice";
    EXPECT_FALSE(row.pinned_by.empty()) << row.label;
    for (const std::string& name : row.pinned_by)
      EXPECT_TRUE(names.contains(name)) << row.label << ": there is no " << name;
  }
  for (const char* section : {"3.", "4.", "8.", "9.", "10.", "12."})
    EXPECT_TRUE(std::ranges::any_of(labels, [&](const std::string& label) {
      return label.starts_with(section);
    })) << section;
}

// Each published message has a program that raises it, named by its row.
TEST(Rules, NameAProgramForEachPublishedMessage) {
  std::set<std::string> labels;
  for (const Row& row : rows()) {
    if (!row.label.starts_with("12.")) continue;
    labels.insert(row.label.substr(3));
    for (const std::string& name : row.pinned_by) {
      const std::string first_line = content_of(tests / "programs" / (name + ".nc")).substr(0, 40);
      EXPECT_NE(first_line.find("expect: " + row.label.substr(3)), std::string::npos)
          << row.label << ' ' << name;
    }
  }
  std::set<std::string> published;
  for (const CodeRow& row : code_table())
    if (static_cast<int>(row.code) < 900000)
      published.insert(std::to_string(static_cast<int>(row.code)));
  EXPECT_EQ(labels, published);
}

}  // namespace
}  // namespace trc
