#include "tests/programs/computing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "core/nc/program/program_reader.h"

// Claims that hold for programs that compute in any dialect.

namespace trc::support::computing {
namespace {

ProgramSessionSetup fanuc() { return computing_setup(DialectName::fanuc); }

TEST(AProgramThatComputes, PassesItsFirstLinesAsTheyStand) {
  EXPECT_EQ(flat_of("%\r\nO1 (PART)\r\n/ G0 X1.\r\n#1=2\r\nG0 X#1\r\nM30\r\n%\r\n", fanuc()),
            "%\r\nO1 (PART)\r\n/ G0 X1.\r\nG0 X2.\r\nM30\r\n%\r\n");
}

// Text after the end (D-143).
TEST(AProgramThatComputes, KeepsTheTextAfterItsEnd) {
  const auto flat = [](DialectName dialect, const std::string& text) {
    return flat_of(text, computing_setup(dialect));
  };
  using enum DialectName;
  const std::string text = "\n(TOOLS)\n(T1 6 MM)\nX1 Y2\n";
  EXPECT_EQ(flat(fanuc, "#1=2\nG0 X#1\nM30\n" + text + "%\n"), "G0 X2.\nM30\n" + text + "%\n");
  EXPECT_EQ(flat(linuxcnc, "#1=2\nG0 X#1\nM2\n" + text + "%\n"), "G0 X2\nM2\n" + text + "%\n");
  EXPECT_EQ(flat(isg, "P1=2\nG0 XP1\nM30\n" + text + "N500 X1\n%\n"),
            "G0 X2\nM30\n" + text + "N500 X1\n%\n");
  EXPECT_EQ(flat(sinumerik, "R1=2\nG0 X=R1\nM30\n; TOOLS\nN500 X1\n"),
            "G0 X=2\nM30\n; TOOLS\nN500 X1\n");
  // Up to what another value may lead to, or what computes.
  const std::string head = "#1=2\nIF [#1 EQ 3] GOTO 20\nG0 X#1\n";
  EXPECT_EQ(flat(fanuc, head + "N10 M30\n(A)\nN11 (B)\nX1\nN20 X3\nM30\n(C)\n"),
            "G0 X2.\nN10 M30\n(A)\nN11 (B)\n");
  EXPECT_EQ(flat(fanuc, head + "N20 M30\n(A)\n#2=1\n(B)\n"), "G0 X2.\nN20 M30\n(A)\n");
  EXPECT_EQ(flat(isg, "P1=2\n$IF P1==2\nM30\n(A)\n$ENDIF\nX1\n"), "M30\n");
  // A comment of several lines computes nothing, and leads nowhere.
  const std::string comment = "#COMMENT BEGIN\n[A]\nP1=7\n$GOTO N9\n%L B\n#COMMENT END\n";
  EXPECT_EQ(flat(isg, "P1=2\nG0 XP1\nM30\n" + comment + "(A)\nP1=8\n(B)\n"),
            "G0 X2\nM30\n" + comment + "(A)\n");
  EXPECT_EQ(flat(sinumerik, "R1=2\nIF R1==2\nM30\n; A\nENDIF\nX1\n"), "M30\n; A\n");
  EXPECT_EQ(flat(sinumerik, "R1=2\nG0 X=R1\nM30\n; A\nPART: X1\n"), "G0 X=2\nM30\n; A\n");
  EXPECT_EQ(flat(linuxcnc, "#1=2\nG0 X#1\nM2\n(A)\no1 sub\nX1\no1 endsub\n"), "G0 X2\nM2\n(A)\n");
  // The end of the program in a call: these lines are after the call.
  EXPECT_EQ(flat(fanuc, "M98 P9\n(A)\nX1\nO9\nG0 X2.\nM30\n"), "(O0009)\nG0 X2.\nM30\n");
  EXPECT_EQ(flat(fanuc, "M98 P9\nM30\n(A)\nO9\nG0 X2.\nM99\n(B)\n"), "(O0009)\nG0 X2.\nM30\n(A)\n");
  EXPECT_EQ(flat(fanuc, "M98 P9\nM30\n(A)\nO9\nM99\nO7\nG0 X2.\nM99\n"),
            "(O0009)\nM30\n(A)\nO7\nG0 X2.\nM99\n");
}

// As the text of a program that does not compute, what stands after its last `%` comes out (D-143).
TEST(AProgramThatComputes, KeepsTheEndOfItsTapeByteForByte) {
  using enum DialectName;
  const auto flat = [](DialectName dialect, const std::string& text) {
    return flat_of(text, computing_setup(dialect));
  };
  for (const std::string end :
       {"%", "%\n", "% hello\n", "%\n\x1A", "%\r\n\x1A\r\n", "%\n(END)\n%\n", " %\ntext 5\n",
        "%\nX70.\nG0 Z50.\n%\n", "(A)\n%\n(B)"}) {
    EXPECT_EQ(flat(fanuc, "%\nO1\n#1=2\nG0 X#1\nM30\n" + end), "%\nO1\nG0 X2.\nM30\n" + end);
    EXPECT_EQ(flat(linuxcnc, "%\n#1=2\nG0 X#1\nM2\n" + end), "%\nG0 X2\nM2\n" + end);
    if (end[0] == '(') continue;
    EXPECT_EQ(flat(fanuc, "%\nO1\n#1=2\nG0 X#1\n" + end), "%\nO1\nG0 X2.\n" + end);
    EXPECT_EQ(flat(linuxcnc, "%\n#1=2\nG0 X#1\n" + end), "%\nG0 X2\n" + end);
  }
  // Another tape; of programs that are called only the end of the tape stays.
  const std::string called = "O9001\nG0 X3.\nM99\n";
  const std::string other = "O2\nG0 X4.\nM99\n";
  EXPECT_EQ(flat(fanuc, "%\nO1\nM98 P9001\nM30\n" + called + "%\n" + other + "%\n"),
            "%\nO1\n(O9001)\nG0 X3.\nM30\n%\n" + other + "%\n");
  EXPECT_EQ(flat(fanuc, "%\nO1\nM98 P9001\nM30\n%\n" + other + called + "%\n"),
            "%\nO1\n(O9001)\nG0 X3.\nM30\n%\n" + other + "%\n");
  EXPECT_EQ(flat(fanuc, "%\nO1\nM98 P9001\nM30\n%\n" + called + "%\n"),
            "%\nO1\n(O9001)\nG0 X3.\nM30\n%\n");
  EXPECT_EQ(flat(fanuc, "%\nO1\nM98 P9001\nM30\n%\n" + called + "(END)\n"),
            "%\nO1\n(O9001)\nG0 X3.\nM30\n%\n");
  EXPECT_EQ(refusal_of("%\nO1\n#1=2\nG0 X#1\nM30\n%\nG41 X5\n", computing_setup(fanuc)),
            std::pair(900015, 7U));
  EXPECT_EQ(flat(sinumerik, "R1=5\nG0 X=R1\nM30\nhello\nX5\n"), "G0 X=5\nM30\nhello\nX5\n");
}

// The `%` that ends a tape, before others (D-143).
TEST(ATape, EndsAtItsFirstPercentAfterBlocks) {
  const std::string contour = "G90 G0 X-20. Y-20.\nG41 G1 X0 Y-10. F500\nY40.\nX60.\n";
  const std::string behind = "%\nX70.\nG0 Z50.\n%\n";
  const auto codes = [](const std::string& text) { return to_text(text, fanuc()).codes(); };
  EXPECT_EQ(codes("%\nO1\n" + contour + behind), "900205 at line 7");
  EXPECT_EQ(codes("%\nO1\n#1=2\n" + contour + behind), "900205 at line 8");
  EXPECT_EQ(codes("%\nO1\n" + contour + "G40 X80.\n" + behind), "");
  EXPECT_EQ(refusal_of("%\nO1\n" + contour + "G40 X80.\n%\nG41 X70.\n%\n", fanuc()),
            std::pair(900015, 9U));
}

// The mark of UTF-8 stands before the first line, and is no part of it.
TEST(AProgramThatComputes, MayDoSoAfterAByteOrderMark) {
  const std::string mark = "\xEF\xBB\xBF";
  EXPECT_EQ(flat_of(mark + "#1=60.\nG0 X#1\nM30\n", fanuc()), mark + "G0 X60.\nM30\n");
  EXPECT_EQ(refusal_of(mark + "#3000=1 (NO DEPTH)\nM30\n", fanuc()), std::pair(900312, 1U));
  EXPECT_EQ(flat_of(mark + "GOTO 5\nX1.\nN5 G0 X2.\nM30\n", fanuc()), mark + "N5 G0 X2.\nM30\n");
  EXPECT_EQ(flat_of(mark + "R1=5\nG0 X=R1\nM30\n", computing_setup(DialectName::sinumerik)),
            mark + "G0 X=5\nM30\n");
  EXPECT_EQ(flat_of(mark + "#1=5\nG0 X#1\nM2\n", computing_setup(DialectName::linuxcnc)),
            mark + "G0 X5\nM2\n");
  ProgramSessionSetup setup = fanuc();
  setup.session.program.subprograms = {{"O7.nc", mark + "#1=3\nG0 X#1\nM99\n"}};
  EXPECT_EQ(flat_of(mark + "M98 P7\nM30\n", setup), mark + "(O0007)\nG0 X3.\nM30\n");
}

TEST(AProgramThatComputes, IsNoneForAnythingInAComment) {
  const std::string text =
      "O1\nG0 X1. (#1=2 M98 P5)\nG1 X2. F100 ; WHILE [1] DO1\nM30\nM98 P1\n%\n";
  EXPECT_EQ(flat_of(text, fanuc()), text);
}

TEST(AProgramThatComputes, ReachesBackBeforeItsFirstLineThatComputes) {
  EXPECT_EQ(flat_of("G91\nN10 G0 X1.\n#1=#1+1\nIF [#1 LT 3] GOTO 10\nM30\n", fanuc()),
            "G91\nN10 G0 X1.\nN10 G0 X1.\nN10 G0 X1.\nM30\n");
}

TEST(AProgramThatComputes, ReachesBackAsFarAsTextIsHeldAndSaysSoBeyond) {
  std::string text = "N10 G0 X1.\n";
  while (text.size() <= ProgramReader::most_text_before)
    text += "G0 X2. (A LINE OF A LONG PROGRAM)\n";
  const std::size_t lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  const ProgramRun ran = to_text(text + "GOTO 10\n", fanuc());
  ASSERT_EQ(ran.diagnostics.size(), 1u) << ran.report();
  EXPECT_EQ(ran.diagnostics[0].code, Code::jump_target_unknown);
  EXPECT_EQ(ran.diagnostics[0].source.line, lines + 1);
  const ProgramRun forward = to_text(text + "#1=3\nG0 X#1\nGOTO 20\nG0 X4.\nN20 M30\n", fanuc());
  EXPECT_EQ(forward.text, text + "G0 X3.\nN20 M30\n") << forward.report();
}

TEST(AProgramThatComputes, IsHeldUpToALimit) {
  ProgramSession session(fanuc());
  Answers answers;
  bool running = session.feed("#1=1\n", answers);
  const std::string text(1U << 20U, '\n');
  for (int piece = 0; running && piece < 17; ++piece) running = session.feed(text, answers);
  EXPECT_FALSE(running);
  const Answer whole = answers.take();
  ASSERT_EQ(whole.diagnostics.size(), 1u);
  EXPECT_EQ(whole.diagnostics[0].code, Code::computing_text_too_long);
  EXPECT_EQ(whole.diagnostics[0].source.line, 1u);
}

TEST(AProgramThatComputes, EndsAfterSoManyLines) {
  ProgramSessionSetup setup = fanuc();
  setup.session.program.max_executed_lines = 1000;
  const ProgramRun ran = to_blocks("G0 X5. Y0\nN10 G91 X1.\nGOTO 10\n", setup);
  ASSERT_EQ(ran.diagnostics.size(), 1u) << ran.report();
  EXPECT_EQ(ran.diagnostics[0].code, Code::too_many_lines_executed);
  // Line 3 is executed first; 500 times a line of motion follows it.
  EXPECT_EQ(ran.blocks.size(), 2u + 500);
  const ProgramRun just_enough = to_text("#1=0\nN10 #1=#1+1\nIF [#1 LT 499] GOTO 10\nM30\n", setup);
  EXPECT_EQ(just_enough.text, "M30\n") << just_enough.report();
}

TEST(AProgramThatComputes, IsInterruptedInALoopWithoutEnd) {
  ProgramSessionSetup setup = fanuc();
  int calls = 0;
  setup.session.compensator.interrupt = [&calls] {
    if (++calls == 10) throw std::runtime_error("cancelled");
  };
  ProgramSession session(setup);
  Answers answers;
  EXPECT_TRUE(session.feed("N10 GOTO 10\n", answers));
  EXPECT_THROW(session.finish(answers), std::runtime_error);
  EXPECT_LT(session.executed_lines(), 10'000u);
}

// A long text is looked at before its first line is executed.
TEST(AProgramThatComputes, IsInterruptedBeforeItsFirstLine) {
  const auto lines = [](const std::string& first, const std::string& line, const std::string& end) {
    std::string text = first;
    for (const std::string& each : {line, end})
      for (int count = 0; count < 200 && !each.empty(); ++count) text += each;
    return text;
  };
  const auto executed = [](DialectName dialect, const std::string& text) {
    ProgramSessionSetup setup = computing_setup(dialect);
    setup.session.compensator.interrupt = [] { throw std::runtime_error("cancelled"); };
    ProgramSession session(setup);
    Answers answers;
    EXPECT_TRUE(session.feed(text, answers));
    EXPECT_THROW(session.finish(answers), std::runtime_error) << text;
    return session.executed_lines();
  };
  using enum DialectName;
  EXPECT_LE(executed(isg, lines("P1=2\n", "$IF P1 == 2\n", "$ENDIF\n")), 2u);
  EXPECT_LE(executed(isg, lines("$SWITCH 1\n", "$CASE 2\n", "") + "$ENDSWITCH\n"), 2u);
  EXPECT_LE(executed(fanuc, lines("#1=2\n", "O1\n", "O2\n")), 2u);
  EXPECT_LE(executed(fanuc, lines("#1=2\n", "IF [#1 EQ 2] THEN\n", "ENDIF\n")), 2u);
  EXPECT_LE(executed(linuxcnc, lines("#1=2\n", "o1 if [#1]\n", "o1 endif\n")), 2u);
  EXPECT_LE(executed(sinumerik, lines("R1=2\n", "IF R1 == 2\n", "ENDIF\n")), 2u);
}

// The time that a text takes is that of its lines, however deep they stand in branches.
TEST(AProgramThatComputes, TakesNoLongerWhereItsBranchesAreDeep) {
  const auto repeated = [](const std::string& text, int times) {
    std::string whole;
    while (times-- > 0) whole += text;
    return whole;
  };
  using enum DialectName;
  const auto seconds = [](DialectName dialect, const std::string& text) {
    const std::clock_t begin = std::clock();
    static_cast<void>(flat_of(text, computing_setup(dialect)));
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  };
  constexpr int many = 60'000;
  constexpr double times = 6;
  const double flat = seconds(isg, repeated("$IF 0\n$ENDIF\n", many) + "M30\n");
  const auto isg_takes = [&](const std::string& first, const std::string& then) {
    return seconds(isg, repeated(first, many) + repeated(then, many) + "M30\n") / flat;
  };
  EXPECT_LT(isg_takes("$IF 0\n", "$ENDIF\n"), times);
  EXPECT_LT(isg_takes("$SWITCH 1\n", "$ELSE\n"), times);
  EXPECT_LT(isg_takes("$SWITCH 1\n$CASE 1\n", "$CONTINUE\n"), times);
  EXPECT_LT(seconds(linuxcnc, "o1 repeat [0]\n" + repeated("o1 break\n", many)), times * flat);
}

TEST(AProgramThatComputes, ComesOutInPieces) {
  ProgramSession session(fanuc());
  Answers answers;
  ASSERT_TRUE(session.feed("#1=0\nN10 G0 X#1\n#1=#1+1\nIF [#1 LT 9999] GOTO 10\nM30\n", answers));
  std::size_t most = 0;
  std::size_t pieces = 0;
  for (bool left = true; left; ++pieces) {
    left = session.resolve(answers);
    most = std::max(most, answers.take().text.size());
  }
  EXPECT_TRUE(session.finish(answers));
  EXPECT_GT(pieces, 20u);
  EXPECT_LT(most, 16'384u);
}

// What a control reads has no more decimals than the output; what comes from it has all.
TEST(AProgramThatComputes, WritesPlacesOutsideOfContoursInTheDecimalsOfTheOutput) {
  ProgramSessionSetup setup = computing_setup(DialectName::fanuc, 0);
  setup.session.program.decimals = 4;
  EXPECT_EQ(flat_of("G21 G17 G90\n"
                    "#1=10/3\n"
                    "G0 X#1 Y[2*#1] F#1\n"
                    "G81 X[3.7*#1] Z-#1 R[#1/7] F100.\n"
                    "G80\n"
                    "G0 X0. Y0.\n"
                    "G2 X#1 Y0. R[#1/2]\n"
                    "G91 G1 X#1 F100.\n"
                    "X#1\n"
                    "G90 G0 X#1\n"
                    "M30\n",
                    setup),
            "G21 G17 G90\n"
            "G0 X3.3333 Y6.6667 F3.3333\n"
            "G81 X12.3333 Z-3.3333 R0.4762 F100.\n"
            "G80\n"
            "G0 X0. Y0.\n"
            "G2 X3.33333333 Y0. R1.66666667\n"
            "G91 G1 X3.33333333 F100.\n"
            "X3.33333333\n"
            "G90 G0 X3.33333333\n"
            "M30\n");
}

TEST(AProgramThatComputes, IsCompensatedWithAllDecimalsOfItsContour) {
  constexpr std::string_view part =
      "G21 G17 G90\n#1=10/3\nG0 X-20. Y-20.\nG41 D1 G1 X#1 Y-5. F100.\nY[9*#1]\nX[6*#1]\n"
      "G40 X60.\nG0 Y3.\nM30\n";
  ProgramSessionSetup fine = computing_setup(DialectName::fanuc);
  ProgramSessionSetup coarse = fine;
  coarse.session.program.decimals = 1;
  const ProgramRun wanted = to_blocks(std::string(part), fine);
  const ProgramRun got = to_blocks(std::string(part), coarse);
  ASSERT_FALSE(wanted.stopped) << wanted.report();
  ASSERT_EQ(got.blocks.size(), wanted.blocks.size()) << got.report();
  for (std::size_t block = 0; block < wanted.blocks.size(); ++block) {
    if (wanted.blocks[block].origin == Origin::uncompensated) continue;
    EXPECT_EQ(end_of(got.blocks[block].path), end_of(wanted.blocks[block].path)) << block;
  }
}

TEST(AProgramThatComputes, StopsWithAllThatCannotBeReadInIt) {
  const ProgramRun ran = to_text("G0 X0\n#1=3\nG66 P5\nY#1\nG46 X1.\n#2=1/0\nM30\n", fanuc());
  ASSERT_EQ(ran.diagnostics.size(), 3u) << ran.report();
  EXPECT_EQ(ran.diagnostics[0].code, Code::subprogram_unknown);
  EXPECT_EQ(ran.diagnostics[0].source.line, 3u);
  EXPECT_EQ(ran.diagnostics[1].source.line, 5u);
  EXPECT_EQ(ran.diagnostics[2].code, Code::division_by_zero);
  EXPECT_EQ(ran.diagnostics[2].source.line, 6u);
}

TEST(WhatIsTold, NamesTheCallsThatLedThere) {
  const ProgramRun ran =
      to_text("G0 X0 Y0\nM98 P1\nM30\nO1\nG0 X1.\nM98 P2\nM99\nO2\nG0 X2.\n#1=1/0\nM99\n", fanuc());
  ASSERT_EQ(ran.diagnostics.size(), 1u);
  const Diagnostic& found = ran.diagnostics[0];
  EXPECT_EQ(found.source.line, 10u);
  EXPECT_EQ(found.calls, (std::vector<CallPlace>{{.subprogram = "O0002", .called_from = 6},
                                                 {.subprogram = "O0001", .called_from = 2}}));
  EXPECT_NE(message_of(found).find("in O0002, called from line 6 in O0001, called from line 2"),
            std::string::npos)
      << message_of(found);
  EXPECT_NE(message_of(found, Language::german)
                .find("in O0002, aufgerufen in Zeile 6 in O0001, aufgerufen in Zeile 2"),
            std::string::npos);
}

TEST(WhatIsTold, CountsEqualCalls) {
  const ProgramRun ran = to_text("G0 X0 Y0\nM98 P1\nM30\nO1\nM98 P1\nM99\n", fanuc());
  ASSERT_EQ(ran.diagnostics.size(), 1u) << ran.report();
  const Diagnostic& found = ran.diagnostics[0];
  EXPECT_EQ(found.code, Code::calls_too_deep);
  EXPECT_EQ(found.calls.size(), 32u);
  const std::string calls = "in O0001, called from line 5 (31 times) in O0001, called from line 2";
  EXPECT_TRUE(message_of(found).ends_with(calls)) << message_of(found);
  EXPECT_TRUE(message_of(found, Language::german)
                  .ends_with("in O0001, aufgerufen in Zeile 5 (31-mal) in O0001, aufgerufen in "
                             "Zeile 2"));
}

// A contour that the tool does not fit, in a subprogram: the compensation finds it.
TEST(WhatIsTold, NamesTheCallsOfWhatLaterPassesFind) {
  ProgramSessionSetup setup = fanuc();
  setup.session.program.mode.tool_radius = 5;
  const std::string text =
      "G0 X-20. Y-20.\nM98 P7\nM30\nO7\nG41 D1 G1 X0 Y0 F500\nY40.\nX26.\nY30.\nX34.\nY40.\nX60.\n"
      "Y0\nX0\nG40 X-20. Y-20.\nM99\n";
  const ProgramRun ran = to_blocks(text, setup);
  ASSERT_FALSE(ran.diagnostics.empty());
  const Diagnostic& found = ran.diagnostics.back();
  EXPECT_EQ(found.code, Code::line_reversed) << ran.report();
  EXPECT_EQ(found.source.line, 9u);
  EXPECT_EQ(found.calls, (std::vector<CallPlace>{{.subprogram = "O0007", .called_from = 2}}));
}

TEST(WhatIsTold, NamesTheLineOfAGivenSubprogram) {
  ProgramSessionSetup setup = fanuc();
  setup.session.program.subprograms["O9010.nc"] = "%\nO9010\nG0 X1.\n#1=SQRT[-1]\nM99\n%\n";
  const ProgramRun ran = to_text("G0 X0 Y0\nG65 P9010\nM30\n", setup);
  ASSERT_EQ(ran.diagnostics.size(), 1u) << ran.report();
  EXPECT_EQ(ran.diagnostics[0].code, Code::value_invalid);
  EXPECT_EQ(ran.diagnostics[0].source.line, 2u);
  EXPECT_NE(message_of(ran.diagnostics[0]).find("in line 4 of O9010, called from line 2"),
            std::string::npos)
      << message_of(ran.diagnostics[0]);
}

TEST(Blocks, OfAProgramThatComputesNameTheirLine) {
  const ProgramRun ran =
      to_blocks("G0 X5. Y0\nM98 P1 L2\nM30\nO1\nG91 G1 X1. F100\nY1.\nM99\n", fanuc());
  std::vector<std::uint32_t> lines;
  for (const CompensatedBlock& block : ran.blocks) lines.push_back(block.source.line);
  EXPECT_EQ(lines, (std::vector<std::uint32_t>{1, 5, 6, 5, 6, 3})) << ran.report();
}

// Lines of words that belong together and of such that do not: whatever comes of them is the same
// in pieces, and ends.
// Without a line besides that of its name.
TEST(Subprograms, MayBeTheLastLineAlone) {
  const ProgramSessionSetup setup = computing_setup(DialectName::fanuc);
  EXPECT_EQ(refusal_of("#1=1\nM98 P100\nM30\nO100\n", setup).first, 900310);
  EXPECT_EQ(refusal_of("#1=1\nM98 P100\nG0 X1.\nM30\nO100 M99\n", setup).first, 0);
}

TEST(LinesOfAnyKind, GiveTheSameInPieces) {
  const std::vector<std::string> words{
      "#1",      "#2",        "=",      "[",      "]",         "+",     "-",       "/",
      "*",       "1",         "2.5",    "N10",    "N20",       "GOTO",  "10",      "20",
      "IF",      "THEN",      "WHILE",  "DO1",    "END1",      "LT",    "EQ",      "AND",
      "X",       "Y#1",       "G1",     "G41 D1", "G40",       "M98",   "P100",    "L2",
      "O100",    "M99",       "M30",    "(A)",    "#[1+1]=3",  "SIN[",  "G65",     "A1.",
      "o1",      "sub",       "endsub", "call",   "if [#1]",   "endif", "while",   "endwhile",
      "repeat",  "#<a>=[1]",  "#<_b>",  "break",  "endrepeat", "/",     "#1=#1+1", "F100",
      "X[#1*2]", "ATAN[1]/[", "#500",   "%",      ",",         ";",     "\r",      "#3000=1"};
  constexpr unsigned seed = 11;
  std::mt19937 random(seed);
  const auto pick = [&](std::size_t count) { return random() % count; };
  std::size_t accepted = 0;
  for (int round = 0; round < 4000; ++round) {
    std::string text = "#1=1\n";
    for (std::size_t line = 0; line < 2 + pick(8); ++line) {
      for (std::size_t count = 1 + pick(5); count > 0; --count)
        text += words[pick(words.size())] + (pick(4) == 0 ? "" : " ");
      text += '\n';
    }
    SCOPED_TRACE("seed " + std::to_string(seed) + ", round " + std::to_string(round) + '\n' + text);
    ProgramSessionSetup setup =
        computing_setup(round % 2 == 0 ? DialectName::fanuc : DialectName::linuxcnc);
    setup.session.program.max_executed_lines = 300;
    const ProgramRun whole = to_text(text, setup, 0, German::as_it_is);
    const ProgramRun pieces = to_text(text, setup, 1 + pick(5), German::as_it_is);
    ASSERT_EQ(pieces.text, whole.text);
    ASSERT_EQ(pieces.report(), whole.report());
    accepted += whole.stopped ? 0 : 1;
  }
  EXPECT_GT(accepted, 20u);
}

}  // namespace
}  // namespace trc::support::computing
