#include "client/cli/tool_file.h"

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace trc::cli {
namespace {

std::map<std::uint32_t, double> wear_in(std::string_view text) {
  v1::ProgramSetup setup;
  EXPECT_EQ(read_tool_table(text, setup), "");
  std::map<std::uint32_t, double> wear;
  for (const v1::Tool& tool : setup.tools()) wear[tool.number()] = tool.wear();
  return wear;
}

std::map<std::uint32_t, double> radii_in(std::string_view text, bool inch = false) {
  v1::ProgramSetup setup;
  if (inch) setup.set_unit(v1::LENGTH_UNIT_INCH);
  EXPECT_EQ(read_tool_table(text, setup), "");
  std::map<std::uint32_t, double> radii;
  for (const v1::Tool& tool : setup.tools()) radii[tool.number()] = tool.radius();
  return radii;
}

std::string fault_in(std::string_view text) {
  v1::ProgramSetup setup;
  return read_tool_table(text, setup);
}

// "T5 name edge radius" of each row.
std::vector<std::string> rows_in(std::string_view text) {
  v1::ProgramSetup setup;
  EXPECT_EQ(read_tool_table(text, setup), "");
  std::vector<std::string> rows;
  for (const v1::Tool& tool : setup.tools()) {
    std::ostringstream row;
    row << 'T' << tool.number() << ' ' << tool.name() << ' ' << tool.edge() << ' ' << tool.radius();
    rows.push_back(row.str());
  }
  return rows;
}

TEST(ToolFile, IsACsvWithAHeader) {
  const auto radii = radii_in("number,radius\n1,5\n# finishing\n 2 , 3.5 \r\n");
  EXPECT_EQ(radii, (std::map<std::uint32_t, double>{{1, 5}, {2, 3.5}}));
}

TEST(ToolFile, IsACsvAsSpreadsheetsWriteIt) {
  const std::map<std::uint32_t, double> expected{{1, 5.5}};
  EXPECT_EQ(radii_in("\xEF\xBB\xBFnumber,radius\r\n1,5.5\r\n"), expected);
  EXPECT_EQ(radii_in("\xEF\xBB\xBFnumber;radius\r\n1;5,5\r\n"), expected);
  EXPECT_EQ(radii_in("unit;mm\nnumber;wear;diameter\n1;-0,02;11\n"), expected);
  EXPECT_EQ(radii_in("Tool,Radius\n1,5.5\n"), expected);
  EXPECT_EQ(radii_in("T;Diameter\n1;11\n"), expected);
  EXPECT_EQ(fault_in("number;radius\n1;1.000,5\n"),
            "line 2: RADIUS is \"1.000,5\", which is no number");
  EXPECT_EQ(fault_in({"\xFF\xFEn\0u\0", 6}), "it is text in UTF-16; save it as CSV UTF-8");
}

// RFC 4180, with blanks around the quotes.
TEST(ToolFile, IsACsvWithQuotedCells) {
  using Rows = std::vector<std::string>;
  EXPECT_EQ(rows_in("number,name,radius\n1,\"VHM 1,5\",0.75\n"), (Rows{"T1 VHM 1,5 0 0.75"}));
  EXPECT_EQ(rows_in("\"number\" ; \"name\" ; \"radius\"\r\n \"1\" ; \"a;b\" ;\"2,5\"\r\n"),
            (Rows{"T1 A;B 0 2.5"}));
  EXPECT_EQ(rows_in("number,name,radius\n1,\"1/2\"\" mill\",6.35\n2,\"\",3\n3,a \"b\",4\n"),
            (Rows{"T1 1/2\" MILL 0 6.35", "T2  0 3", "T3 A \"B\" 0 4"}));
  EXPECT_EQ(rows_in("unit,\"inch\"\nnumber,radius\n1,\"0.25\"\n"), (Rows{"T1  0 6.35"}));
  EXPECT_EQ(fault_in("number,radius,name\n1,5,\"VHM\n2,6,A\n"),
            "line 2: a quotation mark is not closed in its line");
  EXPECT_EQ(fault_in("number,name,radius\n1,\"VHM\" 5,6\n"),
            "line 2: after the closing quotation mark of \"VHM\" more of the cell follows");
  EXPECT_EQ(fault_in("number,\"radius\n1,5\n"),
            "line 1: a quotation mark is not closed in its line");
  // Inches, which the unit does not say.
  EXPECT_EQ(fault_in("number,radius\n1,0.5\"\n"),
            "line 2: RADIUS is \"0.5\"\", which is no number");
}

TEST(ToolFile, MayHaveColumnsWithoutNamesThatAreEmpty) {
  const std::map<std::uint32_t, double> expected{{1, 5}, {2, 6}, {3, 7}};
  EXPECT_EQ(radii_in("number,radius,,\n1,5,,\n2,6\n3,7,,,\n"), expected);
  EXPECT_EQ(radii_in("number,,radius\n1,,5\n2,\"\",6\n3, ,7\n"), expected);
  EXPECT_EQ(fault_in("number,radius,,\n1,5,5,\n"),
            "line 2: \"5\" stands in a column that has no name; decimals have a point, or "
            "semicolons stand between the values");
}

std::string name_in(std::string_view text) {
  v1::ProgramSetup setup;
  EXPECT_EQ(read_tool_table(text, setup), "");
  return setup.tools().empty() ? std::string() : setup.tools(0).name();
}

TEST(ToolFile, HasNamesInEitherEncoding) {
  for (const std::string_view umlaut : {"\xC4", "\xE4", "Ä", "ä"}) {
    const std::string name = "FR" + std::string(umlaut) + "SER";
    EXPECT_EQ(name_in("number,name,radius\n1," + name + ",5\n"), "FRÄSER");
    EXPECT_EQ(name_in("$TC_TP2[1]=\"" + name + "\"\n$TC_DP6[1,1]=5\n"), "FRÄSER");
    const std::string table =
        "BEGIN TOOL .T MM\nT    NAME      R     DR\n1    " + name + "1234+5    +0.1\n[END]\n";
    EXPECT_EQ(name_in(table), "FRÄSER1234");
    EXPECT_EQ(radii_in(table).at(1), 5);
  }
}

TEST(ToolFile, HalvesDiametersAndTheirWear) {
  constexpr const char* table =
      "Holds,Number,Radius,Wear,Name\nDIAMETER,7,12,-0.1,\"finisher\"\nradius,8,4,,\n";
  const auto radii = radii_in(table);
  EXPECT_EQ(wear_in(table), (std::map<std::uint32_t, double>{{7, -0.05}, {8, 0}}));
  EXPECT_DOUBLE_EQ(radii.at(7), 6);
  EXPECT_DOUBLE_EQ(radii.at(8), 4);
  EXPECT_DOUBLE_EQ(radii_in("number,diameter\n3,10\n").at(3), 5);
}

TEST(ToolFile, IsATableOfLinuxcnc) {
  const auto radii = radii_in("T1 P1 D0.5 Z-1.2 ;mill, half an inch\nT12 P2 Z0.3 D.25\n", true);
  EXPECT_DOUBLE_EQ(radii.at(1), 6.35);
  EXPECT_DOUBLE_EQ(radii.at(12), 3.175);
}

// A probe, or a mill whose diameter nobody has measured.
TEST(ToolFile, HasADiameterOfNoughtWhereARowOfLinuxcncNamesNone) {
  const std::map<std::uint32_t, double> expected{{1, 0}, {2, 3}};
  EXPECT_EQ(radii_in("T1 P1 Z-1.2 ;probe\nT2 P2 D6\n"), expected);
}

// $TC_DP6 is the radius of an edge, $TC_DP15 its wear, $TC_DP1 from 500 to 599 a turning tool,
// whose $TC_DP6 is that of its nose.
TEST(ToolFile, IsTheToolDataOfSinumerik) {
  constexpr const char* table =
      "%_N_TO_TOA\r\n;$PATH=/_N_TOA1_DIR\r\nCHANDATA(1)\r\n$TC_TP1[1]=1\r\n"
      "$TC_TP2[1]=\"MILL[2]=12; "
      "D10\"\r\n$TC_TP3[1]=9999\r\n$TC_DP1[1,1]=120\r\n$TC_DP3[1,1]=110.25\r\n"
      "$TC_DP6[1,1]=5\r\n$TC_DP15[1,1]=-0.02\r\nN40 $tc_dp6[ 12 , 1 ] = +3.5 ;finisher\r\n"
      "$TC_DP1[7,1]=500\r\n$TC_DP6[7,1]=0.8\r\n$TC_DP6[9,1]=0\r\n$TC_DP15[9,1]=0\r\n"
      "$TC_DP15[8,1]=0\r\n$TC_MPP1[1,1]=2\r\n$TC_DPC1[1,1]=4\r\nM17\r\n";
  EXPECT_EQ(radii_in(table), (std::map<std::uint32_t, double>{{1, 5}, {9, 0}, {12, 3.5}}));
  EXPECT_EQ(wear_in(table), (std::map<std::uint32_t, double>{{1, -0.02}, {9, 0}, {12, 0}}));
  EXPECT_DOUBLE_EQ(radii_in("%_N_TOOLS_INI\n$TC_DP6[2,1]=0.25\nM30\n", true).at(2), 6.35);
}

TEST(ToolFile, HasNamesAndEdges) {  // D-138
  using Rows = std::vector<std::string>;
  EXPECT_EQ(rows_in("number,name,edge,radius\n5,Mill_16,,8\n5,,2,7.5\n,Finish,1,4\n"),
            (Rows{"T0 FINISH 0 4", "T5 MILL_16 0 8", "T5 MILL_16 2 7.5"}));
  EXPECT_EQ(rows_in("name,radius\nA,3\n"), (Rows{"T0 A 0 3"}));
  EXPECT_EQ(rows_in("$TC_TP2[1]=\"MILL\"\n$TC_DP6[1,1]=5\n$TC_DP6[1,2]=4\n$TC_DP6[3,2]=2\n"),
            (Rows{"T1 MILL 0 5", "T1 MILL 2 4", "T3  2 2"}));
  EXPECT_EQ(rows_in("BEGIN TOOL .T MM\nT    NAME  R\n5    A     5\n5.2  A     4.5\n[END]\n"),
            (Rows{"T5 A 0 5", "T5 A 3 4.5"}));
  EXPECT_EQ(fault_in("number,edge,radius\n1,2,5\n1,2,6\n"), "line 3: tool 1, edge 2 a second time");
  EXPECT_EQ(fault_in("name,edge,radius\nA,0,5\n"), "line 2: edge is \"0\", which is none");
  EXPECT_EQ(fault_in("number,name,radius\n,,5\n"), "line 2: the tool has neither number nor name");
}

TEST(ToolFile, SaysWhatIsWrongInToolDataOfSinumerik) {
  EXPECT_EQ(fault_in("%_N_TO_TOA\n$TC_DP6[1,1]=R5\n"),
            "line 2: $TC_DP6[1,1] is \"R5\", which is no number");
  EXPECT_EQ(fault_in("$TC_DP6[1]=5\n"),
            "line 1: \"$TC_DP6[1]=5\" names no tool and edge, as in $TC_DP6[1,1]");
  EXPECT_EQ(fault_in("%_N_TO_TOA\n$TC_TP2[1]=\"A\"\nM17\n"), "it names no tool with a radius");
  EXPECT_EQ(fault_in("$TC_DP15[4,1]=0.1\n$TC_DP6[5,1]=1\n"), "tool 4 has wear, but no radius");
}

TEST(ToolFile, IsATableOfLinuxcncWithAllItsWords) {
  const std::map<std::uint32_t, double> expected{{1, 0.75}, {2, 0.125}, {3, 2.5}};
  EXPECT_EQ(radii_in("; tools: 3, radius 7,5\n"
                     "T1 P1 X0 Y-0.5 Z+1.5 A0 B0 C0 U0 V0 W0 D+1.5 I45 J-45 Q2 ;mill, 1,5 (new)\n"
                     "T2 P2 D.25 ; D10\nt3 p3 d5.\n"),
            expected);
}

// A number read in part is another radius.
TEST(ToolFile, ReadsNoPartOfANumber) {
  for (const auto& [row, fault] : std::map<std::string, std::string>{
           {"T1 P1 D10,5 Z-20", "D is \"10,5\", which is no number"},
           {"T1 P1 D10.5.3", "D is \"10.5.3\", which is no number"},
           {"T1 P1 D+-5", "D is \"+-5\", which is no number"},
           {"T1 P1 D1O", "O has no number directly after it"},
           {"T1 P1 D1l", "L has no number directly after it"},
           {"T1 P1 D 10", "D has no number directly after it"},
           {"T1 P1 D10 5", "\"5\" has no letter before it"},
           {"T P1 D10", "T has no number directly after it"},
           {"T1 P1 D10 D12", "D a second time"},
           {"T1 T2 P1 D10", "T a second time"},
           {"T1 D1E3", "E is no word of a table of LinuxCNC"},
           {"T1 D5 M6", "M is no word of a table of LinuxCNC"},
           {"/T1 P1 D10",
            "whether a line with the block skip / counts is not known: remove the / or the line"},
           {"G10 L12 P1 R5,5", "R is \"5,5\", which is no number"},
           {"G10 L12 P1 R5O", "O has no number directly after it"},
           {"G10 L12 P1 R5.5.5", "R is \"5.5.5\", which is no number"},
           {"G10 L12 P1 R#100", "R is \"#100\", which is no number"},
           {"G10 L12 P1 R[2+3]", "R is \"[2+3]\", which is no number"},
           {"G10 L#1 P1 R5.", "L is \"#1\", which is no number"},
           {"G10 L12 P1 R5. R6.", "R a second time"},
           {"G10 L12 P1", "G10 L12 and G10 L13 need P and R"},
           {"/G10 L12 P1 R5.",
            "whether a line with the block skip / counts is not known: remove the / or the line"},
           {"/G20",
            "whether a line with the block skip / counts is not known: remove the / or the line"}})
    EXPECT_EQ(fault_in(row + "\nT9 P9 D1\n"), "line 1: " + fault) << row;
}

TEST(ToolFile, HoldsTheOffsetsOfFanuc) {
  constexpr const char* table =
      "%\nO9001\nG10 L10 P1 R120.5\nG10 L12 P1 R5.\nG10 L13 P1 R-0.02\nM30\n%\n";
  const auto radii = radii_in(table);
  EXPECT_EQ(radii.size(), 1u);
  EXPECT_DOUBLE_EQ(radii.at(1), 5);
  EXPECT_DOUBLE_EQ(wear_in(table).at(1), -0.02);
  for (const char* const line :
       {"G10 G90 L12 P1 R3.", "G10G90L12P1R3.", "G90 G10 L12 P1 R3.", "G21 G90 G10 L12 P1 R3.",
        "G91\nG10 G90 L12 P1 R3.", "N5 (R9.) G10 L12 P1 R3. (R4.) M1;",
        "/ G0 Z100.\nG10 L2 P1 X#500\nG10 L12 P1 R3."})
    EXPECT_EQ(radii_in(line).at(1), 3) << line;
  EXPECT_EQ(fault_in("G91 G10 L12 P1 R3.\n"),
            "line 1: under G91 its R is added to what the memory holds: give it under G90");
}

TEST(ToolFile, CountsRWithoutAPointAsTheProgramDoes) {
  v1::ProgramSetup setup;
  setup.set_whole_numbers(v1::WHOLE_NUMBERS_INCREMENTS);
  ASSERT_EQ(read_tool_table("G10 L12 P1 R3000\nG10 L12 P2 R3.\nG20\nG10 L12 P3 R1000\n", setup),
            "");
  ASSERT_EQ(setup.tools_size(), 3);
  EXPECT_EQ(setup.tools(0).radius(), 3);
  EXPECT_EQ(setup.tools(1).radius(), 3);
  EXPECT_NEAR(setup.tools(2).radius(), 2.54, 1e-12);
  for (const char* const line :
       {"G10 L12 P1 R3000", "G10 L12 P1 R50", "G10 L13 P1 R-20", "G20 G10 L12 P1 R2"})
    EXPECT_EQ(fault_in(line),
              "line 1: R has no decimal point: say what it counts in with --whole-numbers")
        << line;
  EXPECT_EQ(radii_in("G10 L12 P1 R49\nG10 L13 P1 R0\n"),
            (std::map<std::uint32_t, double>{{1, 49}}));
}

TEST(ToolFile, HasEachToolOfLinuxcncOnce) {
  EXPECT_EQ(fault_in("T1 P1 D6\nT1 P2 D8\n"), "line 2: tool 1 a second time");
}

TEST(ToolFile, IsATableOfHeidenhain) {
  constexpr const char* table =
      "BEGIN TOOL    .T MM\n"
      "T    NAME             L          R          R2    DL     DR     TL\n"
      "0\n"
      "1    MILL_D10         +100       +5         +0    +0     -0.02\n"
      "2    MILL D6          +80        3                +0\n"
      "[END]\n";
  EXPECT_EQ(radii_in(table), (std::map<std::uint32_t, double>{{1, 5}, {2, 3}}));
  EXPECT_EQ(wear_in(table), (std::map<std::uint32_t, double>{{1, -0.02}, {2, 0}}));
  EXPECT_NE(fault_in("BEGIN TOOL .T MM\nT NAME L\n1 A 3\n").find("no column R"), std::string::npos);
  EXPECT_NE(fault_in("BEGIN TOOL .T MM\nT  R\n1  x\n").find("R is \"x\""), std::string::npos);
}

// As controls write the first line, with their version after the unit.
TEST(ToolFile, IsATableOfHeidenhainInTheUnitAfterItsName) {
  const auto table = [](const std::string& begin) {
    return begin + "\nT    NAME      R       DR\n1    A         +0.25   +0.1\n[END]\n";
  };
  for (const char* const begin :
       {"BEGIN TOOL.T INCH Version: 'Update:120.23'", "BEGIN TOOL    .T INCH", "BEGIN TOOL.T inch",
        "BEGIN TOOL.T INCH Version: 'in MM'\r", "BEGIN MY.TABLE.T INCH"}) {
    EXPECT_DOUBLE_EQ(radii_in(table(begin)).at(1), 6.35) << begin;
    EXPECT_DOUBLE_EQ(wear_in(table(begin)).at(1), 2.54) << begin;
  }
  EXPECT_DOUBLE_EQ(radii_in(table("BEGIN TOOL.T MM Version: 'INCH'"), true).at(1), 0.25);
  EXPECT_DOUBLE_EQ(radii_in(table("BEGIN TOOL.T MM Version: INCH")).at(1), 0.25);
  for (const char* const begin : {"BEGIN TOOL.T", "BEGIN TOOL.T Version: 'INCH'"})
    EXPECT_EQ(fault_in(table(begin)),
              "line 1: its first line has neither MM nor INCH after the name of the table")
        << begin;
}

TEST(ToolFile, IsATableOfHeidenhainWithDecimalCommas) {
  const auto table = [](const std::string& row) {
    return "BEGIN TOOL.T MM\nT    NAME      R       DR\n" + row + "\n[END]\n";
  };
  EXPECT_EQ(radii_in(table("1    A         +7,000  -0,02")),
            (std::map<std::uint32_t, double>{{1, 7}}));
  EXPECT_EQ(wear_in(table("1    A         +7,000  -0,02")),
            (std::map<std::uint32_t, double>{{1, -0.02}}));
  EXPECT_EQ(fault_in(table("1    A         1.000,5 -0,02")),
            "line 3: R is \"1.000,5\", which is no number");
  EXPECT_EQ(fault_in(table("1    A         1,000,5")),
            "line 3: R is \"1,000,5\", which is no number");
}

// As blanks that were collapsed and tabs leave it: a cell is cut where its column begins.
TEST(ToolFile, IsNoTableOfHeidenhainWhoseColumnsDoNotLineUp) {
  const auto fault = [](std::string_view rows) {
    return fault_in("BEGIN TOOL .T MM\n" + std::string(rows) + "[END]\n");
  };
  const auto told = [](const std::string& name) {
    return "line 3: its values do not begin below the name of column " + name +
           ": restore the blanks between the columns, or make it a CSV";
  };
  EXPECT_EQ(fault("T NAME L R R2\n1 MILL10 100 5 0\n"), told("NAME"));
  EXPECT_EQ(fault("T NAME L R R2\n1 A 100 5 0\n"), told("R"));
  EXPECT_EQ(fault("T    L        R        R2\n1    +100     12.500   +0\n"), "");
  EXPECT_EQ(fault("T    L        R        R2\n1    +100    12.500   +0\n"), told("R"));
  EXPECT_EQ(fault("T    L        R        R2\n1    +100      12.500 +0\n"), told("R"));
  EXPECT_EQ(fault("T    L        R     R2\n1    +100     12.5005\n"), told("R"));
  EXPECT_EQ(fault("T    R     NAME\n123456     A\n"), told("T"));
  EXPECT_EQ(fault("T\tR\n1\t5\n"),
            "line 2: it has tabs, and columns are found by their place: replace each with blanks, "
            "or make it a CSV");
  EXPECT_EQ(fault("T    R\n1\t5\n"),
            "line 3: it has tabs, and columns are found by their place: replace each with blanks, "
            "or make it a CSV");
}

// As Beckhoff's manual of TF5200 has it, with comments after the values.
TEST(ToolFile, IsAListOfToolDataOfIsg) {
  constexpr const char* list =
      "# ***************************************************\n# Tool data\n"
      "# Tool data for tool no. 5\nwz[5].laenge           6000        # Tool length\n"
      "wz[5].radius           54000       # Tool radius\n"
      "wz[5].gueltig          1           # Tool validity flag TRUE\n"
      "wz[5].mass_einheit     0           # Tool data unit MM\n"
      "wz[5].ax_versatz[0]    205000      # Offset   1st axis\n"
      "wz[5].log_ax_nr_spdl   6           # Logical axis number of spindle\n"
      "wz[8].laenge 8000\r\nwz[8].radius 2500\r\nwz[8].mass_einheit 1\r\n";
  EXPECT_EQ(radii_in(list), (std::map<std::uint32_t, double>{{5, 5.4}, {8, 6.35}}));
  EXPECT_EQ(radii_in(list, true), (std::map<std::uint32_t, double>{{5, 5.4}, {8, 6.35}}));
  // D0, tools that may not be used and those of turning are none.
  EXPECT_EQ(radii_in("wz[0].radius 1\nwz[1].radius 50000\nwz[2].radius 1\nwz[2].gueltig 0\n"
                     "wz[3].typ 1\nwz[3].radius 8000\nwz[4].laenge 1\n"),
            (std::map<std::uint32_t, double>{{1, 5}}));
  for (const auto& [row, fault] : std::map<std::string, std::string>{
           {"wz[1].radius 5.4", "wz[1].radius is \"5.4\", which is no whole number"},
           {"wz[1].radius", "wz[1].radius is \"\", which is no whole number"},
           {"wz[1].mass_einheit 2", "wz[1].mass_einheit is neither 0 (mm) nor 1 (inch)"},
           {"wz[1].path[1].radius 5", "wz[1] has a radius for each path, and one is read"},
           {"wz[1].tool_id.basic 7",
            "wz[1] has another number by its tool_id: give such tools as a CSV"},
           {"wz[i].radius 5", "\"wz[i].radius\" names no tool, as in wz[1].radius"},
           {"WZ[9].radius 5", "WZ[9].radius a second time"}})
    EXPECT_EQ(fault_in("wz[9].radius 5\n" + row + "\n"), "line 2: " + fault) << row;
}

TEST(ToolFile, CountsInTheUnitItNames) {
  EXPECT_DOUBLE_EQ(radii_in("number,radius,unit\n1,0.25,inch\n2,5,MM\n3,4,\n").at(1), 6.35);
  EXPECT_DOUBLE_EQ(radii_in("number,radius,unit\n1,0.25,inch\n2,5,MM\n3,4,\n").at(2), 5);
  EXPECT_DOUBLE_EQ(radii_in("number,radius,unit\n1,0.25,inch\n2,5,MM\n3,4,\n", true).at(3), 4);
  constexpr const char* mixed =
      "# inches\nunit,inch\nnumber,diameter,wear,unit\n1,0.5,0.01,\n2,8,0,mm\n";
  EXPECT_DOUBLE_EQ(radii_in(mixed).at(1), 6.35);
  EXPECT_DOUBLE_EQ(wear_in(mixed).at(1), 0.127);
  EXPECT_DOUBLE_EQ(radii_in(mixed).at(2), 4);
  // Whatever the program counts in.
  EXPECT_DOUBLE_EQ(radii_in("number,radius\n1,5\n", true).at(1), 5);
  EXPECT_EQ(fault_in("number,radius,unit\n1,5,cm\n"), "line 2: unit is \"cm\", not mm or inch");
  EXPECT_EQ(fault_in("unit,cm\nnumber,radius\n1,5\n"), "line 1: unit is \"cm\", not mm or inch");
}

TEST(ToolFile, SaysWhetherAProgramCountsInInch) {
  const auto in_inch = [](std::string_view program, v1::Dialect dialect,
                          v1::LengthUnit given = v1::LENGTH_UNIT_UNSPECIFIED) {
    return says_inch(program, dialect, given);
  };
  EXPECT_TRUE(in_inch("(G21)\nN1 G90 G20\n", v1::DIALECT_FANUC));
  EXPECT_FALSE(in_inch("(G20)\nG90 G200 ; G20\n", v1::DIALECT_LINUXCNC));
  // Of older controls; with words beside it G70 is a cycle.
  EXPECT_TRUE(in_inch("O1\nN10 G70\nG90 G0 X1.\n", v1::DIALECT_FANUC));
  EXPECT_TRUE(in_inch("G70 G90 G17\n", v1::DIALECT_FANUC));
  EXPECT_FALSE(in_inch("G21\nG81 Z-5. R2. L0 F200.\nG70 I30. J0. L6\n", v1::DIALECT_FANUC));
  EXPECT_FALSE(in_inch("G70\n", v1::DIALECT_LINUXCNC));
  EXPECT_TRUE(in_inch("g701 g700 G90\n", v1::DIALECT_SINUMERIK));
  EXPECT_TRUE(in_inch("G70\n", v1::DIALECT_ISG));
  EXPECT_TRUE(in_inch("0 BEGIN PGM A INCH\n", v1::DIALECT_HEIDENHAIN));
  EXPECT_FALSE(in_inch("0 BEGIN PGM INCH MM\n", v1::DIALECT_HEIDENHAIN));
  // What the program says counts, not what it is given with.
  constexpr v1::LengthUnit inch = v1::LENGTH_UNIT_INCH;
  EXPECT_TRUE(in_inch("G90 G0 X1.\n", v1::DIALECT_FANUC, inch));
  EXPECT_TRUE(in_inch("G90 (G21)\n", v1::DIALECT_FANUC, inch));
  EXPECT_FALSE(in_inch("G90 G21\n", v1::DIALECT_FANUC, inch));
  EXPECT_FALSE(in_inch("G71 G90\n", v1::DIALECT_FANUC, inch));
  EXPECT_FALSE(in_inch("G71 G90\n", v1::DIALECT_ISG, inch));
  EXPECT_FALSE(in_inch("G710 G90\n", v1::DIALECT_SINUMERIK, inch));
  EXPECT_FALSE(in_inch("0 BEGIN PGM A MM\n", v1::DIALECT_HEIDENHAIN, inch));
}

TEST(ToolFile, SaysInWhichLineItIsWrong) {
  EXPECT_EQ(fault_in("number,radius\n1,five\n"), "line 2: RADIUS is \"five\", which is no number");
  EXPECT_EQ(fault_in("number,tool,radius\n1,2,5\n"), "line 1: column NUMBER a second time");
  EXPECT_EQ(fault_in("number,radius\n1,5\n1,6\n"), "line 3: tool 1 a second time");
  EXPECT_EQ(fault_in("number,radius\n1,five\n2,5\n2,5\n"),
            "line 2: RADIUS is \"five\", which is no number\nline 4: tool 2 a second time");
  std::string many = "number,radius\n";
  for (int i = 0; i < 13; ++i) many += "x,5\n";
  const std::string told = fault_in(many);
  EXPECT_NE(told.find("\nline 11: NUMBER is \"x\", which is no number\n3 more lines are wrong"),
            std::string::npos)
      << told;
  // Without a header the rows are none.
  EXPECT_EQ(fault_in("1;5\n2;6\n").find('\n'), std::string::npos);
  EXPECT_EQ(
      fault_in("number,size\n1,5\n2,6\n"),
      "line 1: unknown column \"SIZE\"; a table may have number, radius, diameter, wear, name, "
      "edge, holds, unit");
  EXPECT_EQ(fault_in("BEGIN TOOL .T MM\nT L\n1 5\n"), "line 2: the table has no column R");
  // A decimal comma: not a radius of 5.
  EXPECT_NE(fault_in("number,radius\n1,5,5\n").find("line 2: it has more values than"),
            std::string::npos);
  EXPECT_EQ(fault_in("number,radius\n1,5,,\n"), "");
  EXPECT_NE(fault_in("number,length\n").find("unknown column"), std::string::npos);
  EXPECT_NE(fault_in("number\n1\n").find("needs number or name"), std::string::npos);
  EXPECT_NE(fault_in("1;5\n").find("is no row"), std::string::npos);
  EXPECT_EQ(fault_in("G10 L13 P1 R-0.02\n"), "tool 1 has wear, but no radius");
  EXPECT_EQ(fault_in("\n"), "it names no tool with a radius");
}

}  // namespace
}  // namespace trc::cli
