#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/nc/dialect/pass_words.h"
#include "tests/programs/computing.h"

// Which tool a contour has where the program writes its radius, computes it, or leaves the change
// of tools to what only the machine has: never another one than it says, and never silently (D-75
// to D-79).

namespace trc::support::tools_of_programs {
namespace {

using enum DialectName;

ProgramSessionSetup setup_of(DialectName dialect) { return computing_setup(dialect, 5); }

// A wall from X0 Y0 to X0 Y40, travelled from X-20 on its left.
std::string contour_of(DialectName dialect, const std::string& side) {
  if (dialect == heidenhain)
    return "L X-20 Y+0 Z-2 R0 FMAX\nL X+0 " + side + " F300\nL Y+40\nL X-20 R0\n";
  const std::string point = dialect == fanuc ? "." : "";
  return "G90 G0 X-20" + point + " Y0 Z2" + point + "\n" + side + " G1 X0 F300\nY40" + point +
         "\nG40 X-20" + point + "\n";
}

// Codes and details of all errors and warnings.
std::string told(const std::string& text, const ProgramSessionSetup& setup) {
  std::string all;
  for (const Diagnostic& found : to_text(text, setup).diagnostics)
    all += std::to_string(static_cast<int>(found.code)) + " " + std::to_string(found.source.line) +
           " " + found.detail + "\n";
  return all;
}

// The tool that is missing is told at its word, where the contour needs it: the lines before that
// have come out, whatever came at once.
TEST(MissingTool, IsToldBehindTheSameOutputHoweverTheTextIsCut) {
  ProgramSessionSetup setup = computing_setup(isg, 0);
  setup.session.program.tools = {{1, ToolRow(2)}};
  const std::string before = "N20 T3 D3\nN40 G00 X-20 Y-20\n";
  for (const std::size_t piece : {0U, 1U, 7U, 30U}) {
    const ProgramRun ran =
        to_text(before + "N70 G41 G01 X0 Y0 F300\nN80 Y50\nN90 G40 X-20\nM30\n", setup, piece);
    EXPECT_EQ(ran.text, before) << piece;
    EXPECT_EQ(ran.codes(), "900013 at line 1") << piece;
  }
  // Of two tools that one radius cannot serve, the second is told where its contour needs it.
  const std::string wall = "Y40.\nG40 X-20.\n";
  const std::string second = "T2 M6\nS900\nG0 X-20. Y0.\n";
  for (const std::size_t piece : {0U, 1U, 7U, 30U}) {
    const ProgramRun ran = to_text(
        "T1 M6\nG0 X-20. Y0.\nG41 G1 X0. F300.\n" + wall + second + "G41 G1 X0.\n" + wall + "M30\n",
        setup_of(fanuc), piece);
    EXPECT_TRUE(ran.text.ends_with(second)) << piece << '\n' << ran.text;
    EXPECT_EQ(ran.codes(), "900013 at line 6") << piece;
  }
}

// The chain of calls is that of the word, not of the contour.
TEST(MissingTool, IsToldWithTheCallThatItStandsIn) {
  const ProgramSessionSetup setup = [] {
    ProgramSessionSetup given = computing_setup(isg, 0);
    given.session.program.tools = {{1, ToolRow(2)}};
    return given;
  }();
  const ProgramRun ran = to_text(
      "%L TOOLS\nN2 T3 D3\nM17\n%MAIN\nN10 G00 X-20 Y-20\nN20 LL TOOLS\nN30 G41 G01 X0 Y0 F300\n"
      "N40 Y50\nN50 G40 X-20\nM30\n",
      setup);
  ASSERT_EQ(ran.codes(), "900013 at line 2");
  ASSERT_EQ(ran.diagnostics.front().calls.size(), 1U);
  EXPECT_EQ(ran.diagnostics.front().calls.front().subprogram, "TOOLS");
}

// How far the tool is from the wall of the last contour; -1: it was refused.
double distance(const std::string& text, const ProgramSessionSetup& setup) {
  const ProgramRun ran = to_blocks(text, setup);
  if (ran.stopped) return -1;
  double farthest = 0;
  for (const CompensatedBlock& block : ran.blocks)
    if (block.origin == Origin::programmed) farthest = -end_of(block.path).x();
  return farthest;
}

// L13 of G10: the wear of the register, with the radius of the table, of the program or of the
// setup. Another one than the setup says is none to choose from.
TEST(ToolsOfPrograms, HaveTheWearThatFanucWrites) {  // D-118
  const std::string wall = contour_of(fanuc, "G41 D1") + "M30\n";
  const std::string head = "G21 G17 G90\n";
  ProgramSessionSetup table = setup_of(fanuc);
  table.session.program.mode.tool_radius = 0;
  table.session.program.tools[1] = 4;
  EXPECT_EQ(distance(head + "G10 L13 P1 R0.2\n" + wall, table), 4.2);
  EXPECT_EQ(distance(head + "#12001=0.2\n" + wall, table), 4.2);
  EXPECT_EQ(distance(head + "G10 L13 P2 R0.2\n" + wall, table), 4);
  EXPECT_EQ(distance(head + "G10 L12 P1 R4.\nG10 L13 P1 R-0.5\n" + wall, table), 3.5);
  EXPECT_EQ(distance(head + "G10 L13 P1 R0.2\n" + wall, setup_of(fanuc)), 5.2);
  EXPECT_EQ(distance(head + "G10 L13 P1 R0.2\nG10 L13 P1 R0.\n" + wall, setup_of(fanuc)), 5);
  EXPECT_NEAR(distance("G20 G17 G90\nG10 L13 P1 R0.01\nG21\n" + wall, setup_of(fanuc)), 5.254,
              1e-9);
  ProgramSessionSetup worn = setup_of(fanuc);
  worn.session.program.wear = 0.1;
  EXPECT_EQ(distance(head + "G10 L13 P1 R0.1\n" + wall, worn), 5.1);
  EXPECT_EQ(told(head + "G10 L13 P1 R0.2\n" + wall, worn),
            "900003 2 G10 L13, another wear than the setup gives that tool\n");
  EXPECT_EQ(distance(head + "G91 G10 L13 P1 R0.2\nG90\n" + wall, table), -1);
}

// R5 is a radius of 5 mm, and R5000 one of 5 m or of 5 mm (D-50).
TEST(ToolsOfPrograms, HaveNoRadiusWithoutAPointThatMayCountInIncrements) {
  const std::string wall = contour_of(fanuc, "G41 D1") + "M30\n";
  const std::string head = "G21 G17 G90\nG0 Z50.\n";
  const ProgramSessionSetup unsaid = setup_of(fanuc);
  const std::string radius =
      "900008 3 a tool radius without a decimal point: say what whole numbers count in\n";
  const std::string wear =
      "900008 3 a wear without a decimal point: say what whole numbers count in\n";
  for (const std::string line : {"G10 L12 P1 R5000", "G10 L12 P1 R900", "G10 P1 R50",
                                 "G10L12P1R-50", "G10 L12 P9 R5000", "G20 G10 L12 P1 R2"})
    EXPECT_EQ(told(head + line + "\nG21\n" + wall, unsaid), radius) << line;
  for (const std::string line : {"G10 L13 P1 R-20", "G10 L13 P1 R1", "G91 G10 L13 P1 R1"})
    EXPECT_EQ(told(head + line + "\nG21 G90\n" + wall, unsaid), wear) << line;
  EXPECT_EQ(distance(head + "G10 L12 P1 R5\n" + wall, unsaid), 5);
  EXPECT_EQ(distance(head + "G10 L12 P1 R49\nG10 L13 P1 R0\n" + wall, unsaid), 49);
  EXPECT_EQ(distance(head + "#13001=60\n" + wall, unsaid), 60);
  EXPECT_EQ(distance(head + "#1=60\nG10 L12 P1 R#1\n" + wall, unsaid), 60);
  EXPECT_EQ(distance(head + "G10 L12 P1 R60.\n" + wall, unsaid), 60);
  // Lengths and zero points have no part in the path.
  EXPECT_EQ(told(head + "G10 L10 P1 R120000\nG10 L2 P1 X300000\nM30\n", unsaid), "");
  ProgramSessionSetup said = unsaid;
  said.session.program.whole_numbers = WholeNumbers::increments;
  EXPECT_EQ(distance(head + "G10 L12 P1 R5000\nG10 L13 P1 R-20\n" + wall, said), 4.98);
  said.session.program.whole_numbers = WholeNumbers::units;
  EXPECT_EQ(distance(head + "G10 L12 P1 R60\nG10 L13 P1 R-1\n" + wall, said), 59);
}

// LINUXCNC cuts with the tool in the spindle, which T alone does not change (D-40).
TEST(ToolsOfPrograms, HaveNoRadiusOfATThatLinuxcncOnlyPrepares) {
  const std::string wall = contour_of(linuxcnc, "G41") + "M30\n";
  const std::string head = "G21 G17 G90\nT2\n";
  ProgramSessionSetup table = computing_setup(linuxcnc, 0);
  table.session.program.tools[1] = 3;
  table.session.program.tools[2] = 4;
  EXPECT_EQ(told(head + wall, table), "900219 4 G41 or G42 in line 4, T2 without M06\n");
  EXPECT_EQ(distance(head + "M6\n" + wall, table), 4);
  EXPECT_EQ(distance(head + contour_of(linuxcnc, "G41 D1") + "M30\n", table), 3);
  EXPECT_EQ(distance(head + wall, setup_of(linuxcnc)), 5);
  for (const DialectName other : {fanuc, sinumerik}) {
    ProgramSessionSetup of_other = computing_setup(other, 0);
    of_other.session.program.tools = table.session.program.tools;
    EXPECT_EQ(distance("G17 G90\nT2\n" + contour_of(other, "G41") + "M30\n", of_other), 4);
  }
}

// Where a contour begins the control reads the register in force, of the last D word or of the tool
// in the spindle: what is written into it after that word counts (D-163).
TEST(ToolsOfPrograms, HaveWhatFanucWritesAfterTheWordOfTheirRegister) {
  const std::string wall = contour_of(fanuc, "G41") + "M30\n";
  const std::string first = contour_of(fanuc, "G41 D1");
  const std::string head = "G21 G17 G90\n";
  ProgramSessionSetup table = setup_of(fanuc);
  table.session.program.mode.tool_radius = 0;
  ProgramSessionSetup none = table;
  table.session.program.tools[1] = 4;
  for (const std::string& before : {std::string("D1\n"), first, std::string("T1 M6\n")}) {
    EXPECT_EQ(distance(head + before + "G10 L12 P1 R3.\n" + wall, table), 3) << before;
    EXPECT_EQ(distance(head + before + "#13001=3.\n" + wall, table), 3) << before;
    EXPECT_EQ(distance(head + before + "G10 P1 R3.\n" + wall, table), 3) << before;
    EXPECT_EQ(distance(head + before + "G10 L13 P1 R0.2\n" + wall, table), 4.2) << before;
    EXPECT_EQ(distance(head + before + "G10 L12 P2 R3.\n" + wall, table), 4) << before;
    EXPECT_EQ(distance(head + before + "G10 L12 P1 R3.\n" + wall, setup_of(fanuc)), 3) << before;
    EXPECT_EQ(distance(head + before + "G10 L13 P1 R0.2\n" + wall, setup_of(fanuc)), 5.2) << before;
    EXPECT_EQ(distance(head + before + "G10 L13 P2 R0.2\n" + wall, setup_of(fanuc)), 5) << before;
  }
  EXPECT_EQ(distance(head + "G41 H1 G1 X0 Y0 F300\nY4.\nG40 X-9.\nG10 P1 R3.\n" + wall, table), 3);
  for (const std::string before : {"D1\n", "T1 M6\n"}) {
    EXPECT_EQ(distance(head + before + "G10 L12 P1 R3.\n" + wall, none), 3) << before;
    EXPECT_EQ(distance(head + before + wall, none), -1) << before;
  }
}

// The tool in the spindle that no word has named is not the one of a D, nor of a later M06: a
// radius of the setup belongs to one of them (D-65).
TEST(ToolsOfPrograms, InTheSpindleAreNotThoseOfANumber) {
  const auto two = [](DialectName dialect, const std::string& first, const std::string& second) {
    return "G21 G17 G90\n" + contour_of(dialect, first) + contour_of(dialect, second) + "M2\n";
  };
  for (const DialectName dialect : {linuxcnc, fanuc}) {
    EXPECT_EQ(told(two(dialect, "G41", "G41 D2"), setup_of(dialect)), "900013 7 D2\n");
    EXPECT_EQ(told(two(dialect, "T2 M6\nG41", "G41 D2"), setup_of(dialect)), "");
    EXPECT_EQ(told(two(dialect, "T1 M6\nG41", "G41 D2"), setup_of(dialect)), "900013 8 D2\n");
    EXPECT_EQ(told(two(dialect, "G41", "T2 M6\nG41"), setup_of(dialect)), "900013 7 T2\n");
    EXPECT_EQ(distance(two(dialect, "G41", "G41"), setup_of(dialect)), 5);
  }
  const std::string unnamed = "900013 7 the tool in the spindle, without T and M6\n";
  EXPECT_EQ(told(two(linuxcnc, "G41 D2", "G41"), setup_of(linuxcnc)), unnamed);
  EXPECT_EQ(told(two(linuxcnc, "G41 D2", "G41 D0"), setup_of(linuxcnc)), unnamed);
  EXPECT_EQ(told(two(linuxcnc, "G41 D0", "G41 D2"), setup_of(linuxcnc)), "900013 7 D2\n");
  EXPECT_EQ(distance(two(linuxcnc, "G41 D0", "G41"), setup_of(linuxcnc)), 5);
  // The D of FANUC holds until the next one.
  EXPECT_EQ(distance(two(fanuc, "G41 D2", "G41"), setup_of(fanuc)), 5);
}

// R of G10 L10 and L11 is the radius, as that of L1 is: they differ in the lengths alone.
TEST(ToolsOfPrograms, HaveTheRadiusThatLinuxCncWrites) {
  ProgramSessionSetup table = setup_of(linuxcnc);
  table.session.program.mode.tool_radius = 0;
  for (const std::string data : {"G10 L1 P1 R4", "G10 L10 P1 R4", "G10 L11 P1 Z5 R4"})
    EXPECT_EQ(
        distance("G21 G17 G90\n" + data + "\n" + contour_of(linuxcnc, "G41 D1") + "M2\n", table), 4)
        << data;
  EXPECT_EQ(refusal_of("G21 G17 G90\nG91 G10 L10 P1 R4\nM2\n", table), std::pair(900003, 2U));
}

// A diameter in the program, or a tool of the table, is not that of the tool in the spindle.
TEST(ToolsOfPrograms, InTheSpindleOfLinuxCncHaveNoRadiusOfAnotherTool) {
  const auto two = [](const std::string& first) {
    return "G21 G17 G90\n" + contour_of(linuxcnc, first) + contour_of(linuxcnc, "G41") + "M2\n";
  };
  EXPECT_EQ(distance(two("G41.1 D6"), setup_of(linuxcnc)), 5);
  ProgramSessionSetup table = setup_of(linuxcnc);
  table.session.program.mode.tool_radius = 0;
  table.session.program.tools[1] = 4;
  const std::string none = "900219 7 G41 or G42 in line 7\n";
  EXPECT_EQ(told(two("G41 D1"), table), none);
  EXPECT_EQ(told(two("G41.1 D6"), table), none);
  EXPECT_EQ(distance(two("T1 M6\nG41.1 D6"), table), 4);
}

// What a register of wear mode holds is what the tool differs by: that of the setup (D-43).
TEST(ToolsOfPrograms, HaveTheDifferenceOfTheSetupInWearMode) {
  for (const DialectName dialect : {fanuc, linuxcnc, sinumerik}) {
    ProgramSessionSetup setup = computing_setup(dialect, 0);
    setup.session.program.nominal_radius = 5;
    for (const std::string side : {"G41 D1", "G41"}) {
      const std::string program = "G17 G90\nT1 M6\n" + contour_of(dialect, side) + "M30\n";
      EXPECT_EQ(distance(program, setup), 0) << side;
      ProgramSessionSetup worn = setup;
      worn.session.program.wear = 0.1;
      EXPECT_DOUBLE_EQ(distance(program, worn), 0.1) << side;
    }
  }
}

// The P of a function beside G41 is none of its radius.
TEST(ToolsOfPrograms, HaveNoRadiusFromTheWordsOfOthers) {
  const std::string head = "G21 G17 G90 G154 P1\n";
  for (const std::string side :
       {"M19 P90 G41 D1", "G154 P1 G41 D1", "G41 D1 M19 P90", "G41 M19 P90"})
    EXPECT_EQ(distance(head + contour_of(fanuc, side) + "M30\n", setup_of(fanuc)), 5) << side;
  EXPECT_EQ(distance(head + contour_of(fanuc, "G41 D1 M143 P5") + "M30\n", setup_of(fanuc)), 5);
  EXPECT_EQ(distance(head + contour_of(fanuc, "G41 P0.75") + "M30\n", setup_of(fanuc)), -1);
  EXPECT_EQ(told(head + contour_of(fanuc, "G41 D1 M8 P0.75") + "M30\n", setup_of(fanuc)),
            "900003 3 P, which no function of the line takes\n");
}

TEST(ToolsOfPrograms, HaveTheRadiusThatSinumerikWrites) {
  const std::string wall = contour_of(sinumerik, "G41") + "M30\n";
  ProgramSessionSetup setup = setup_of(sinumerik);
  setup.session.program.mode.tool_radius = 0;
  setup.session.program.tools[row_of_edge(2, 1)] = 5;
  setup.session.program.tools[row_of_edge(2, 2)] = 4;
  const std::string head = "G17 G71 G90\n$TC_DP6[1,1]=3.5 $TC_DP6[2,2]=4\n";
  EXPECT_EQ(distance(head + "T1 D1\n" + wall, setup), 3.5);
  EXPECT_EQ(distance(head + "T2 D1\n" + wall, setup), 5);
  EXPECT_EQ(distance(head + "T2 D2\n" + wall, setup), 4);
  EXPECT_EQ(told(head + "T2 D2\n" + wall, setup), "");
  // The machine would take what is written: so it counts, and is told.
  const std::string other = "G17 G71 G90\n$TC_DP6[2,1]=6\nT2 D1\n" + wall;
  EXPECT_EQ(distance(other, setup), 6);
  EXPECT_EQ(told(other, setup), "900224 2 T2 D1\n");
  EXPECT_EQ(told("G17 G71 G90\n$TC_DP6[1,1]=6\nT1 D1\n" + wall, setup_of(sinumerik)),
            "900224 2 T1 D1\n");
  // After the call the machine has the radius from before, up to the next one.
  const std::string late = "G17 G71 G90\nT2 D1\n$TC_DP6[2,1]=6\n";
  EXPECT_EQ(
      told(late + wall, setup),
      "900224 3 T2 D1\n900003 5 $TC_DP6 after the call of its tool: it counts from the next D\n");
  EXPECT_EQ(distance(late + "D1\n" + wall, setup), 6);
  EXPECT_EQ(distance("G17 G71 G90\nT2 D1\n$TC_DP6[2,1]=5\n" + wall, setup), 5);
  EXPECT_EQ(distance("G17 G71 G90\nT2 D1\n$TC_DP6[2,2]=6\n" + wall, setup), 5);
}

TEST(ToolsOfPrograms, AreNoneAfterT0OfSinumerik) {
  ProgramSessionSetup setup = setup_of(sinumerik);
  setup.session.program.mode.tool_radius = 0;
  setup.session.program.tools[row_of_edge(1, 1)] = 5;
  const std::string wall = contour_of(sinumerik, "G41");
  for (const std::string unload : {"T0 M6", "T0\nM6", "T0 D1 M6"})
    EXPECT_EQ(
        told("G17 G71 G90\nT1 D1 M6\n" + wall + unload + "\n" + wall + "M30\n", setup).substr(0, 6),
        "900219")
        << unload;
  EXPECT_EQ(distance("G17 G71 G90\nT1 D1 M6\n" + wall + "T0\n" + wall + "M30\n", setup), 5);
}

// A wall after these lines, with tool 1 of R 5, tool 2 of R 3.
ProgramSessionSetup two_tools(DialectName dialect) {
  ProgramSessionSetup setup = setup_of(dialect);
  setup.session.program.mode.tool_radius = 0;
  setup.session.program.tools = {{row_of_edge(1, 1), 5}, {row_of_edge(2, 1), 3}};
  return setup;
}

std::string klartext(const std::string& lines) {
  return "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\n" + lines + "\n" + contour_of(heidenhain, "RL") +
         "END PGM A MM\n";
}

// A line that says what the tool is holds no word that is passed over: it is read, or refused.
TEST(ToolsOfPrograms, AreCalledWithAndWithoutBlanks) {
  const ProgramSessionSetup setup = two_tools(heidenhain);
  for (const auto& [line, radius] :
       std::vector<std::pair<std::string, double>>{{"TOOL CALL 2Z S500", 3},
                                                   {"TOOL CALL2 Z", 3},
                                                   {"tool call 2zs500", 3},
                                                   {"TOOL CALL 2 Z S 1500,000 F 300", 3},
                                                   {"TOOL CALL 2 Z S(VC=100) FZ0.1 M3", 3},
                                                   {"TOOL CALL 1 Z S1000 DL+0,1DR+0,5", 5.5},
                                                   {"TOOL CALL 1 Z S1000DR+0.5", 5.5},
                                                   {"TOOL CALL 1 Z S1000 DR + 0.5 DR2+0.2", 5.5},
                                                   {"TOOL CALL DR0.5", 5.5},
                                                   {"TOOL CALL 1ZS900DR-0,05DR2:0.1", 4.95},
                                                   {"TOOL CALL S900", 5},
                                                   {"TOOL DEF 3 L+0 R+8,5\nTOOL CALL 3 Z", 8.5},
                                                   {"TOOL DEF3 L+0R+8\nTOOL CALL 3 Z", 8},
                                                   {"TOOL DEF 3 L + 0 R 8\nTOOL CALL 3 Z", 8},
                                                   {"TOOL DEF 3 R8L0\nTOOL CALL 3 Z", 8},
                                                   {"TOOL DEF \"MILL\"", 5}}) {
    EXPECT_NEAR(distance(klartext(line), setup), radius, 1e-9) << line;
    EXPECT_EQ(told(klartext(line), setup), "") << line;
  }
}

TEST(ToolsOfPrograms, AreNeverReadOver) {
  const ProgramSessionSetup setup = two_tools(heidenhain);
  for (const auto& [line, refused] : std::vector<std::pair<std::string, std::string>>{
           {"TOOL CALL 2,Z", "900001 3 ,Z of TOOL CALL\n"},
           {"TOOL CALL #2 Z", "900001 3 #2 of TOOL CALL\n"},
           {"TOOL CALL T2 Z", "900001 3 T2 of TOOL CALL\n"},
           {"TOOL CALL ABC", "900001 3 ABC of TOOL CALL\n"},
           {"TOOL CALL -2 Z", "900001 3 -2 of TOOL CALL\n"},
           {"TOOL CALL 2.25 Z", "900008 3 2.25 of TOOL CALL\n"},
           {"TOOL CALL 1 Z 2", "900001 3 2 of TOOL CALL\n"},
           {"TOOL CALL 1 Z S1000 D R+0.5", "900001 3 D of TOOL CALL\n"},
           {"TOOL CALL 1 Z DR", "900008 3 DR of TOOL CALL\n"},
           {"TOOL CALL 1 Z DR2", "900008 3 DR2 of TOOL CALL\n"},
           {"TOOL CALL 1 Z DR+0.1 DR+0.2", "900008 3 DR+0.2 of TOOL CALL\n"},
           {"TOOL CALL 1 Z M6 X", "900008 3 X of TOOL CALL\n"},
           {"TOOL CALX 2 Z", "900001 3 TOOL CALX 2 Z\n"},
           {"TOOL DEF", "900008 3 TOOL DEF without a tool\n"},
           {"TOOL DEF 1 L+0 R+8,5,5", "900008 3 R+8,5,5 of TOOL DEF\n"},
           {"TOOL DEF 1 L+0 F300", "900001 3 F300 of TOOL DEF\n"},
           {"TOOL DEF 1 L+0 R", "900008 3 R of TOOL DEF\n"},
           {"TOOL DEF 1 L+0 R+Q5", "900003 3 R+Q5 of TOOL DEF, a variable\n"},
           {"TOOL DEF \"MILL\" L+0 R+5", "900008 3 \"????\" of TOOL DEF with a radius\n"}})
    EXPECT_EQ(told(klartext(line), setup), refused) << line;
}

TEST(ToolsOfPrograms, CountInTheUnitThatSinumerikWritesThemIn) {
  const std::string wall = "T1 D1\nG90 G0 X-2 Y0\nG41 G1 X0 F10\nY2\nG40 X-2\nM30\n";
  ProgramSessionSetup setup = setup_of(sinumerik);
  setup.session.program.mode.tool_radius = 0;
  EXPECT_EQ(distance("G700\n$TC_DP6[1,1]=0.25\n" + wall, setup), 6.35);
  // G70 does not apply to it.
  EXPECT_EQ(distance("G70\n$TC_DP6[1,1]=6\n" + wall, setup), 6);
}

TEST(ToolsOfPrograms, HaveTheWearThatSinumerikWritesBesideTheirRadius) {
  const std::string wall = "T1 D1\nG90 G0 X-20 Y0\nG41 G1 X0 F10\nY20\nG40 X-20\nM30\n";
  ProgramSessionSetup setup = setup_of(sinumerik);
  setup.session.program.mode.tool_radius = 0;
  const std::string radius = "$TC_DP6[1,1]=6\n";
  EXPECT_EQ(distance(radius + "$TC_DP15[1,1]=-0.05\n" + wall, setup), 5.95);
  EXPECT_EQ(distance("$TC_DP15[1,1]=-0.05\n" + radius + wall, setup), 5.95);
  setup.session.program.tools[1] = 6;
  EXPECT_EQ(told(radius + "$TC_DP15[1,1]=-0.05\n" + wall, setup),
            "900003 2 $TC_DP15[1,1], another wear than the setup gives that tool\n");
}

TEST(ToolsOfPrograms, AreToldWhereOtherDialectsWriteAnotherRadius) {
  ProgramSessionSetup setup = setup_of(fanuc);
  setup.session.program.tools[1] = 5;
  EXPECT_EQ(told("G21 G17 G90\nG10 L12 P1 R4.\n" + contour_of(fanuc, "G41 D1") + "M30\n", setup),
            "900224 2 D1\n");
  EXPECT_EQ(told("BEGIN PGM A MM\nTOOL DEF 1 L+0 R+4\nTOOL CALL 1 Z S1000\n" +
                     contour_of(heidenhain, "RL") + "END PGM A MM\n",
                 setup_of(heidenhain)),
            "900224 2 T1\n");
}

// G12, G13 and G150 of Haas, which come out as they are.
TEST(ToolsOfPrograms, OfCyclesStayWithTheMachine) {  // D-66, D-102
  ProgramSessionSetup setup = setup_of(fanuc);
  setup.session.program.mode.tool_radius = 0;
  setup.session.program.tools = {{1, 5}, {2, 3}};
  const std::string head = "G21 G17 G90\nG0 X0. Y0. Z2.\n";
  const auto told_of = [&](const std::string& lines) {
    return told(head + lines + "M30\n", setup);
  };
  EXPECT_EQ(told_of("G13 I12. D7 F200.\n"), "900227 3 G13 D7\n");
  EXPECT_EQ(told_of("G12 I12. F200.\n"), "900227 3 G12\n");
  EXPECT_EQ(told_of("G13 I12. D0 F200.\nG12 I9. F200.\n"), "");
  EXPECT_EQ(told_of("D1\nG13 I12. F200.\n"), "900227 4 G13 D1\n");
  const std::string pocket = "G150 P2 X0. Y0. Z-1. R1. I1. K0.1 Q1. F100. G41 D2\nG40 X0. Y0.\n";
  EXPECT_EQ(told_of(pocket), "900227 3 G150 D2\n");
  // What G41 had does not come out, so that the machine would take an older one.
  const std::string wall = contour_of(fanuc, "G41 D1");
  EXPECT_EQ(told_of(wall + "G13 I12. F200.\n"), "900003 7 G13 without D after D1 in line 4\n");
  EXPECT_EQ(told_of(wall + "G13 I12. D1 F200.\n"), "900227 7 G13 D1\n");
  // The D of the cycle holds after it.
  EXPECT_EQ(distance(head + "D1\n" + pocket + contour_of(fanuc, "G41") + "M30\n", setup), 3);
}

TEST(ToolsOfPrograms, MayHaveBeenChangedByACall) {  // D-78
  const auto twice = [](DialectName dialect, const std::string& between, const std::string& side) {
    const std::string end = dialect == heidenhain ? "END PGM A MM\n" : "M30\n";
    return contour_of(dialect, side) + between + contour_of(dialect, side) + end;
  };
  const auto sinumerik_told = [&](const std::string& between) {
    return told("G17 G71 G90\nT1 D1\n" + twice(sinumerik, between, "G41"), setup_of(sinumerik));
  };
  EXPECT_EQ(sinumerik_told("G0 Z50\n"), "");
  EXPECT_EQ(sinumerik_told("TC(\"MILL\") ; the next one\n"), "900225 9 TC(\"MILL\") in line 7\n");
  EXPECT_EQ(sinumerik_told("TC(\"MILL\")\nD1\n"), "900225 10 TC(\"MILL\") in line 7\n");
  EXPECT_EQ(sinumerik_told("T1 D1\nCHANGE()\n"), "");
  EXPECT_EQ(sinumerik_told("CHANGE()\nT1 D1\n"), "");
  // Before the first contour it is the tool that the setup gives.
  EXPECT_EQ(told("G17 G71 G90\nTC(\"MILL\")\n" + contour_of(sinumerik, "G41") + "M30\n",
                 setup_of(sinumerik)),
            "");
  EXPECT_EQ(told("G21 G17\nT1 M6\n" + twice(fanuc, "M98 P9020\n", "G41"), setup_of(fanuc)),
            "900225 9 M98 P9020 in line 7\n");
  EXPECT_EQ(told("G21 G17\nT1 M6\n" + twice(fanuc, "M98 P9020\n", "G41 D1"), setup_of(fanuc)), "");
  ProgramSessionSetup declared = setup_of(fanuc);
  declared.session.program.pass_words = {"O9020"};
  EXPECT_EQ(told("G21 G17\nT1 M6\n" + twice(fanuc, "M98 P9020\n", "G41"), declared), "");
  EXPECT_EQ(told("TOOL CALL 1 Z S1000\n" + twice(heidenhain, "CALL PGM CHANGE\n", "RL"),
                 setup_of(heidenhain)),
            "900225 8 CALL PGM CHANGE in line 6\n");
}

TEST(ToolsOfPrograms, OfIsgMayBeOthersUnderOneRadius) {  // D-78
  const auto program = [](const std::string& between) {
    return "G17 G71 G90\nT1\nL TOOL\n" + contour_of(isg, "G41") + between + contour_of(isg, "G41") +
           "M30\n";
  };
  EXPECT_EQ(told(program(""), setup_of(isg)), "");
  EXPECT_EQ(told(program("L TOOL (again)\n"), setup_of(isg)),
            "900225 10 L TOOL in line 8\n900226 10 L TOOL\n");
  EXPECT_EQ(told(program("T2\nL TOOL\n"), setup_of(isg)), "900225 11 T2 in line 8\n");
  ProgramSessionSetup setup = setup_of(isg);
  setup.session.program.tools[2] = 3;
  EXPECT_EQ(told(program("T2\nL TOOL\n"), setup), "");
  EXPECT_EQ(distance(program("T2\nL TOOL\n"), setup), 3);
}

// What a call may leave in force is told: the radius that the program has written is that of the
// tool before it, the rest is taken as it was.
TEST(ToolsOfPrograms, OfIsgAreTheirsBeforeACall) {  // D-81
  const auto program = [](const std::string& head) {
    return "G17 G71 G90\n" + head + contour_of(isg, "G41") + "M30\n";
  };
  ProgramSessionSetup setup = setup_of(isg);
  EXPECT_EQ(told(program("L HEAD\n"), setup), "900226 4 L HEAD\n");
  EXPECT_EQ(told(program("V.G.WZ_AKT.R=4\nL HEAD\n"), setup),
            "900225 5 L HEAD in line 3\n900226 5 L HEAD\n");
  EXPECT_EQ(told(program("L HEAD\nV.G.WZ_AKT.R=4\n"), setup), "900226 5 L HEAD\n");
  EXPECT_EQ(told(program("V.G.WZ_AKT.R=4\nT1\nL TOOL\n"), setup), "");
  setup.session.program.pass_words = {"HEAD"};
  EXPECT_EQ(told(program("V.G.WZ_AKT.R=4\nL HEAD\n"), setup), "");
}

// Declared, a call of ISG leaves everything in force.
TEST(ToolsOfPrograms, StandWhereTheyWereAfterADeclaredCall) {
  const std::string text =
      "G17 G71 G90\nG00 X-20 Y0\nL \"LAMP\"\nG01 G41 X0 Y0 F300\nY40\nG40 X-20\nM30\n";
  ProgramSessionSetup setup = setup_of(isg);
  EXPECT_EQ(refusal_of(text, setup), std::pair(900106, 4U));
  setup.session.program.pass_words = {"LAMP"};
  EXPECT_EQ(refusal_of(text, setup), std::pair(0, 0U));
}

// The name of its file may have an extension, in the program and in the declaration.
TEST(ToolsOfPrograms, StandWhereTheyWereAfterADeclaredFile) {
  const std::string contour = "G01 G41 X0 Y0 F300\nY40\nG40 X-20\nM30\n";
  const auto refused = [&](const std::string& call, const std::string& word) {
    ProgramSessionSetup setup = setup_of(isg);
    setup.session.program.pass_words = {word};
    const std::string head = "G17 G71 G90\nG00 X-20 Y0\n";
    return refusal_of(head + call + "\n" + contour, setup).first;
  };
  const std::string call = "L Spindle_OK.up";
  EXPECT_EQ(refused(call, "SPINDLE_OK.UP"), 0);
  EXPECT_EQ(refused(call, "SPINDLE_OK"), 0);
  EXPECT_EQ(refused(call + " (LAMP)", "SPINDLE_OK.UP"), 0);
  EXPECT_EQ(refused("L \"Spindle_OK.up\"", "SPINDLE_OK.UP"), 0);
  EXPECT_EQ(refused(call, "SPINDLE_OK.NC"), 900106);
  EXPECT_EQ(refused("L Spindle_OK", "SPINDLE_OK.UP"), 900106);
  for (const char* const word : {"SPINDLE_OK.UP", "A.NC", "1000.NC", "DIR/LAMP-ON.NC"}) {
    EXPECT_EQ(fault_of_pass_word(word, isg), "") << word;
    EXPECT_NE(fault_of_pass_word(word, DialectName::sinumerik), "") << word;
  }
  for (const char* const word : {"X1.5", "X.5", "#HSC.A", "V.P.A=1", ".NC", "A.", "G41.0"})
    EXPECT_NE(fault_of_pass_word(word, isg), "") << word;
}

// The control executes such a cycle after each motion of the contour.
TEST(ToolsOfPrograms, CutNoContourUnderAModalCycleOfIsg) {  // D-81
  const auto program = [](const std::string& between) {
    return "G17 G71 G90\nL CYCLE [NAME=DRILL.cyc MODAL_MOVE @P1=2]\n" + between +
           "G90 G00 X-20 Y0\nG01 G41 X0 Y0 F300\nY40\nG40 X-20\nM30\n";
  };
  EXPECT_EQ(refusal_of(program(""), setup_of(isg)), std::pair(900003, 4U));
  EXPECT_EQ(refusal_of(program("#DISABLE MODAL CYCLE\n"), setup_of(isg)), std::pair(0, 0U));
}

TEST(ToolsOfPrograms, HaveTheRadiusThatIsgWrites) {
  const std::string wall = contour_of(isg, "G41") + "M30\n";
  ProgramSessionSetup setup = setup_of(isg);
  setup.session.program.tools[3] = 5;
  for (const std::string called : {"T3 D3\nM06\n", "T3 M06\n", "D3\n"}) {
    const std::string text = "G17 G71 G90\nV.G.WZ[3].R = 4 (reground)\n" + called + wall;
    EXPECT_EQ(distance(text, setup), 4) << called;
    EXPECT_EQ(told(text, setup), "900224 2 T3\n");
  }
  EXPECT_EQ(distance("G17 G71 G90\nP1=8\nV.G.WZ[3].R=P1/2\nP2=V.G.WZ[3].R\nT3 D3\n" + wall, setup),
            4);
}

// The builder's own word for a change of tools, beside its T: G90 holds after it as after M06.
TEST(ToolsOfPrograms, ChangedBesideTheirNumberLeaveG90InForce) {  // D-76
  const std::string wall = "G00 X-20 Y0\nG41 G01 X0 F300\nY40\nG40 X-20\nM30\n";
  EXPECT_EQ(told("G17 G71 G90\nT202 LM06\n" + wall, setup_of(isg)), "");
  EXPECT_EQ(told("G17 G71 G90\nLM06\n" + wall, setup_of(isg)),
            "900106 4 G90 or G91, which was not programmed anew after LM06 in line 2\n");
  EXPECT_EQ(told("G17 G71 G90\nLM07\nT202 LM06\n" + wall, setup_of(isg)),
            "900106 5 G90 or G91, which was not programmed anew after LM06 in line 3\n");
}

TEST(ToolsOfPrograms, AreCalledByParametersOfKlartext) {
  ProgramSessionSetup setup = setup_of(heidenhain);
  setup.session.program.mode.tool_radius = 0;
  setup.session.program.tools[1] = 5;
  setup.session.program.tools[2] = 3;
  const auto program = [](const std::string& head) {
    return "BEGIN PGM A MM\n" + head + contour_of(heidenhain, "RL") + "END PGM A MM\n";
  };
  EXPECT_EQ(distance(program("TOOL CALL 1 Z S1000 DR-0,05\n"), setup), 4.95);
  EXPECT_EQ(distance(program("Q5 = +0.2\nTOOL CALL 1 Z S1000 DR+Q5\n"), setup), 5.2);
  EXPECT_EQ(distance(program("FN 0: Q5 = +0.2 ; stock\nTOOL CALL 1 Z DR-Q5\n"), setup), 4.8);
  EXPECT_EQ(distance(program("FN 0: Q1 = +2\nTOOL CALL Q1 Z S Q3\n"), setup), 3);
  EXPECT_EQ(distance(program("Q5 = 0.1 * 2\nTOOL CALL 1 Z DR+Q5\n"), setup), 5.2);  // D-85
  const std::string unknown = "900003 4 DR+Q5 of TOOL CALL, a variable\n";
  for (const std::string lost :
       {"Q5 = LOG 0.04", "FN 18: SYSREAD Q5 = ID50 NR2", "LBL 1", "CALL PGM A",
        "CYCL DEF 200 DRILLING ~\n Q5=1", "/ Q5 = 0.3", "TCH PROBE 419"}) {
    const std::string text = program("Q5 = 0.2\n" + lost + "\nTOOL CALL 1 Z DR+Q5\n");
    EXPECT_EQ(distance(text, setup), -1) << lost;
    EXPECT_EQ(told(text, setup).substr(0, 7), unknown.substr(0, 7)) << lost;
  }
  EXPECT_EQ(told(program("Q5 = Q4\nQ6 = 2\nTOOL CALL 1 Z DR+Q5\n"), setup), unknown);
  // Without RL nothing depends on it.
  EXPECT_EQ(told("TOOL CALL 1 Z DR+Q5\nL X+5 R0 FMAX\n", setup), "");
}

// CALL LBL executes the lines after the label, a change of tool included.
TEST(ToolsOfPrograms, AreChangedByLabelsOfKlartext) {
  ProgramSessionSetup setup = setup_of(heidenhain);
  setup.session.program.mode.tool_radius = 0;
  setup.session.program.tools[1] = 5;
  setup.session.program.tools[2] = 3;
  const std::string wall = contour_of(heidenhain, "RL");
  const std::string labels = "LBL 1\nTOOL CALL 1 Z\nLBL 0\nLBL 2\nTOOL CALL 2 Z\nLBL 0\n";
  EXPECT_EQ(told(labels + wall, setup), "");
  EXPECT_EQ(told(labels + "CALL LBL 1\n" + wall, setup),
            "900003 9 RL, RR with the tool of the section that line 7 calls\n");
  EXPECT_EQ(told(labels + "CALL LBL 1\nTOOL CALL 1 Z\n" + wall, setup), "");
  const std::string behind = "M30\nLBL 7\nCALL LBL 8\nLBL 0\nLBL 8\nTOOL CALL 2 Z\nLBL 0\n";
  const std::string refused = "900003 4 RL, RR with the tool of the section that line 2 calls\n";
  EXPECT_EQ(told("TOOL CALL 1 Z\nCALL LBL 8\n" + wall + behind, setup), refused);
  EXPECT_EQ(told("TOOL CALL 1 Z\nCALL LBL 7\n" + wall + behind, setup), refused);
  EXPECT_EQ(told("TOOL CALL 1 Z\n" + wall + "CALL LBL 8\n" + behind, setup), "");
  EXPECT_EQ(told("CALL LBL 8\nTOOL CALL 1 Z\n" + wall + behind, setup), "");
}

TEST(ToolsOfPrograms, NamesOfDigitsAreNumbers) {  // D-116
  for (const DialectName dialect : {sinumerik, heidenhain}) {
    const bool klartext = dialect == heidenhain;
    const std::string wall = contour_of(dialect, klartext ? "RL" : "G41");
    const auto call = [&](const std::string& tool) {
      return (klartext ? "TOOL CALL " + tool + " Z\n" : "T=" + tool + " D1\n") + wall;
    };
    ProgramSessionSetup setup = setup_of(dialect);
    setup.session.program.mode.tool_radius = 0;
    setup.session.program.tools[row_of_edge(5, 1)] = 3;
    EXPECT_EQ(distance(call("\"5\""), setup), 3);
    EXPECT_NE(told(call("\"6\""), setup).find("900013"), std::string::npos);
    EXPECT_NE(told(call("\"MILL\""), setup).find("\"MILL\""), std::string::npos);
    EXPECT_EQ(distance(call("\"05\""), setup), -1);
    // The table may have it as a name of another tool.
    setup.session.program.tool_names["5"] = 7;
    setup.session.program.tools[row_of_edge(7, 1)] = 4;
    EXPECT_EQ(distance(call("\"5\""), setup), 4);
  }
}

}  // namespace
}  // namespace trc::support::tools_of_programs
