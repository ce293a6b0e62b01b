#include <gtest/gtest.h>

#include <optional>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/client/commands/called.h"
#include "tests/support/process.h"

namespace trc::testing_support {
namespace {

// What stands between two blanks or more, of the lines after the first ones.
std::vector<std::string> cells_of(const std::string& text) {
  std::vector<std::string> cells;
  static const std::regex between("  +");
  for (const std::string& line : lines_of(text))
    for (auto cell = std::sregex_token_iterator(line.begin(), line.end(), between, -1);
         cell != std::sregex_token_iterator(); ++cell)
      if (cell->length() > 0) cells.push_back(*cell);
  return cells;
}

TEST(Info, IsToldInGerman) {
  const Ended english = trc({"info"});
  const Ended german = trc({"info", "--lang", "de"});
  EXPECT_EQ(german.code, 0) << german.err;
  const auto theirs = cells_of(english.out);
  const std::set<std::string> words(theirs.begin(), theirs.end());
  // Numbers, names, units and values of settings are the same in both.
  static const std::regex same(
      R"([0-9.,… -]*( (mm|mm/min|s))?|mm|Option|Code|[A-Z0-9_,]+|[a-z0-9_.]+(, [a-z0-9_]+)*)"
      R"(( \(G\d+\))?|G\d+|trc .*|.*(gcc|gRPC).*)");
  for (const std::string& cell : cells_of(german.out)) {
    EXPECT_TRUE(std::regex_match(cell, same) || !words.contains(cell)) << cell;
    EXPECT_EQ(english_word_in(cell), "") << cell;
  }
  for (const char* word : {"Grenzen", "Meldungen", "nein, abgelehnt", "Nullpunktverschiebung"})
    EXPECT_NE(german.out.find(word), std::string::npos) << word;
  EXPECT_EQ(trc({"--lang", "de", "info"}).out, german.out);
}

TEST(Info, TellsTheSettings) {
  const Ended info = trc({"info"});
  EXPECT_NE(info.out.find("block_skip"), std::string::npos);
  EXPECT_NE(info.out.find("(900017): refuse, execute, leave_out\n"), std::string::npos);
}

TEST(Info, PrintsTheTablesOfTheDocumentation) {
  const Ended info = trc({"info"});
  EXPECT_EQ(info.code, 0) << info.err;
  for (const char* word : {"STRETCH_FACTOR", "G239", "90019", "Limits"})
    EXPECT_NE(info.out.find(word), std::string::npos) << word;
  const Ended diagnostics = trc({"info", "--markdown", "diagnostics"});
  EXPECT_EQ(diagnostics.out.rfind("| Code | Severity | Cause | Remedy |\n|---|---|---|---|\n", 0),
            0u);
  EXPECT_NE(diagnostics.out.find("\n| 90019 | error | "), std::string::npos);
  EXPECT_NE(trc({"info", "--markdown", "options"}).out.find("| KERF_MASKING | 0 … 1 | 0 |"),
            std::string::npos);
}

TEST(Explain, SaysWhatACodeMeansAndWhatHelps) {
  const Ended ended = trc({"explain", "90019"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const char* words : {"error 90019 LINE_REVERSED", "Causes:", "What helps:", "trc radii",
                            "trc explain 90019 --example | trc compensate -"})
    EXPECT_NE(ended.out.find(words), std::string::npos) << words;
  EXPECT_EQ(trc({"explain", "line_reversed"}).out, ended.out);
  for (const char* unknown : {"1", "90019x", "NO_REASON"}) {
    const Ended refused = trc({"explain", unknown});
    EXPECT_EQ(refused.code, 2) << unknown;
    EXPECT_NE(refused.err.find(unknown), std::string::npos);
  }
  EXPECT_EQ(trc({"explain", "--example"}).code, 2);
}

// Words of a call after "| trc compensate -" in what explains a code, as a shell takes them;
// nothing: no example.
std::optional<std::vector<std::string>> call_of(const std::string& explained,
                                                const std::string& command = "compensate") {
  const std::string before = "--example | trc " + command + " -";
  const std::size_t at = explained.find(before);
  if (at == std::string::npos) return std::nullopt;
  const std::size_t begin = at + before.size();
  const std::string words = explained.substr(begin, explained.find('\n', begin) - begin);
  std::vector<std::string> call{command, "-"};
  for (std::string& word : lines_of(run({"/bin/sh", "-c", "printf '%s\\n'" + words}).out))
    if (!word.empty()) call.push_back(std::move(word));
  return call;
}

TEST(Explain, HasAnExampleThatRaisesEachCode) {
  const Ended list = trc({"explain"});
  ASSERT_EQ(list.code, 0);
  int codes = 0;
  for (const std::string& line : lines_of(list.out)) {
    const std::string code = line.substr(0, line.find(' '));
    if (code.empty() || code.find_first_not_of("0123456789") != std::string::npos) continue;
    ++codes;
    const Ended explained = trc({"explain", code});
    EXPECT_EQ(explained.code, 0) << code << explained.err;
    const auto call = call_of(explained.out);
    ASSERT_TRUE(call) << code;
    const std::string program = trc({"explain", code, "--example"}).out;
    const Ended raised = trc(*call, program);
    const std::regex told("(^|\n)[^\n]*: (error|warning|note) " + code + ": ");
    EXPECT_TRUE(std::regex_search(raised.err, told)) << code << '\n'
                                                     << program.substr(0, 1000) << raised.err;
  }
  EXPECT_GT(codes, 75);
}

TEST(Explain, HasAPictureOfEachContour) {
  const Folder folder;
  int pictures = 0;
  for (const std::string& line : lines_of(trc({"explain"}).out)) {
    const std::string code = line.substr(0, line.find(' '));
    if (code.empty() || code.find_first_not_of("0123456789") != std::string::npos) continue;
    auto call = call_of(trc({"explain", code}).out, "plot");
    const std::string program = trc({"explain", code, "--example"}).out;
    if (!call) continue;
    ++pictures;
    EXPECT_EQ(call->back(), code + ".svg");
    call->back() = folder.path(code + ".svg");
    trc(*call, program);
    EXPECT_NE(content_of(call->back()).find("<path"), std::string::npos) << code;
  }
  EXPECT_GT(pictures, 40);
}

TEST(Compensate, RemediesNameWhatTheCommandLineHas) {
  const Ended ended = trc({"compensate", "-"}, "G41 G01 X10 Y0 F500\nX20\nG40 X30 Y10\nM30\n");
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.err.find("help: Give the radius: --radius 5"), std::string::npos) << ended.err;
  EXPECT_EQ(ended.err.find("setup"), std::string::npos) << ended.err;
  const Ended of_fanuc =
      trc({"compensate", "-"}, "O1\nG21 G41 D1 G01 X10 Y0 F500\nX20\nG40 X30 Y10\nM30\n");
  EXPECT_NE(
      of_fanuc.err.find("Haas or the like, declare it: --dialect fanuc. If it is one for ISG"),
      std::string::npos)
      << of_fanuc.err;
  const Ended calls = trc({"compensate", "-", "--dialect", "fanuc"}, "O1\nG41 D1\nM98 P7\nM30\n");
  EXPECT_NE(calls.err.find("help: Put it into the same file, or give its file: --subprograms FILE, "
                           "or the folder.\n"),
            std::string::npos)
      << calls.err;
}

TEST(Info, SaysThatAProgramComputes) {
  const Folder folder;
  folder.write("part.nc", "#1=0\nWHILE [#1 LT 3] DO1\nG0 X#1\n#1=#1+1\nEND1\nM30\n");
  const Ended ended = trc({"info", folder.path("part.nc"), "--dialect", "fanuc"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("computes: yes, 15 lines executed"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace trc::testing_support
