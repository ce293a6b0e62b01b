#include <gtest/gtest.h>

#include <charconv>
#include <set>
#include <string>

#include "tests/nc/dialect/reading.h"
#include "tests/support/files.h"

namespace trc::testing {
namespace {

// What the first line of a program says: "; expect: 90019 at line 6".
struct Expectation {
  int code = 0;
  std::uint32_t line = 0;
};

Expectation expectation_of(std::string_view text) {
  const auto number_behind = [&](std::string_view mark) {
    int number = 0;
    const std::size_t at = text.substr(0, text.find('\n')).find(mark);
    if (at != std::string_view::npos)
      std::from_chars(text.data() + at + mark.size(), text.data() + text.size(), number);
    return number;
  };
  return {.code = number_behind("expect: "),
          .line = static_cast<std::uint32_t>(number_behind("at line "))};
}

// Whether a code comes out of compensation, not of reading.
bool is_of_compensation(int code) {
  static const std::set<int> published{90008, 90011, 90017, 90019, 90038, 90057, 90123, 90130};
  const bool own = code > 900200 && code != 900204 && code != 900205;
  return own || published.contains(code);
}

TEST(BadPrograms, EveryCodeOfTextAndProgramIsRaisedByOne) {
  std::set<int> raised;
  for (const auto& file : testing_support::nc_programs_in("bad")) {
    const std::string text = testing_support::content_of(file);
    const Expectation expected = expectation_of(text);
    EXPECT_NE(expected.code, 0) << file << " does not say what to expect";
    ProgramSetup setup;
    if (text.find("; setup: dialect fanuc\n") != std::string::npos)
      setup.dialect = DialectName::fanuc;
    // Without a table nobody has given a radius.
    if (expected.code == static_cast<int>(Code::tool_unknown)) setup.tools[1] = ToolRow(1);
    for (const Diagnostic& reported : read(text, setup).diagnostics)
      if (static_cast<int>(reported.code) == expected.code && reported.source.line == expected.line)
        raised.insert(expected.code);
  }
  for (const CodeRow& row : code_table()) {
    const int code = static_cast<int>(row.code);
    EXPECT_TRUE(raised.contains(code) || is_of_compensation(code))
        << code << " " << row.reason << " has no program";
  }
}

}  // namespace
}  // namespace trc::testing
