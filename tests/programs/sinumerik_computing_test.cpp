#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/nc/program/program_reader.h"
#include "tests/programs/computing.h"

// The language of Sinumerik, statement by statement; whole programs: sinumerik_twins_test.cpp.

namespace trc::support::sinumerik_computing {
namespace {

ProgramSessionSetup sinumerik() { return computing_setup(DialectName::sinumerik); }

std::string flat(const std::string& text) { return flat_of(text, sinumerik()); }

// The value of an expression, as it is written after an address.
std::string value_of(const std::string& expression) {
  const std::string text = flat("R1=3.5 R2=-2 R3=10\nR10=" + expression + "\nG0 X=R10\n");
  return text.starts_with("G0 X=") ? text.substr(5, text.size() - 6) : text;
}

bool holds(const std::string& condition) {
  const std::string text = flat("R1=1 R2=2 R3=0\nIF " + condition + "\nX1\nELSE\nX2\nENDIF\n");
  EXPECT_TRUE(text == "X1\n" || text == "X2\n") << text;
  return text == "X1\n";
}

TEST(SinumerikExpressions, KeepTheOrderOfTheirOperators) {
  EXPECT_EQ(value_of("1+2*3"), "7");
  EXPECT_EQ(value_of("(1+2)*3"), "9");
  EXPECT_EQ(value_of("10-4-3"), "3");
  EXPECT_EQ(value_of("16/4/2"), "2");
  EXPECT_EQ(value_of("7/2"), "3.5");
  EXPECT_EQ(value_of("7 DIV 2"), "3");
  EXPECT_EQ(value_of("-7 DIV 2"), "-3");
  EXPECT_EQ(value_of("7 MOD 4"), "3");
  EXPECT_EQ(value_of("1+7 MOD 4*2"), "7");
  EXPECT_EQ(value_of("-R2*3"), "6");
  EXPECT_EQ(value_of("R1 - R2"), "5.5");
  EXPECT_EQ(value_of("2*-3"), "-6");
  EXPECT_EQ(value_of("6 B_OR 1 B_AND 5"), "7");
  EXPECT_EQ(value_of("6 B_XOR 3"), "5");
  EXPECT_EQ(value_of("6 B_AND 2+1"), "2");
  EXPECT_EQ(value_of("B_NOT 0"), "-1");
  EXPECT_EQ(value_of("NOT 0+1"), "2");
}

TEST(SinumerikExpressions, KnowTheirNumbers) {
  EXPECT_EQ(value_of("10EX-2"), "0.1");
  EXPECT_EQ(value_of("1.874EX3"), "1874");
  EXPECT_EQ(value_of("'HFF'"), "255");
  EXPECT_EQ(value_of("'B101'"), "5");
  EXPECT_EQ(value_of(".5+.25"), "0.75");
  EXPECT_EQ(value_of("TRUE+TRUE"), "2");
  EXPECT_EQ(value_of("$PI"), "3.14159265");
}

TEST(SinumerikExpressions, KnowTheFunctions) {
  EXPECT_EQ(value_of("SIN(30)"), "0.5");
  EXPECT_EQ(value_of("COS(60)*2"), "1");
  EXPECT_EQ(value_of("TAN(45)"), "1");
  EXPECT_EQ(value_of("ASIN(-0.5)"), "-30");
  EXPECT_EQ(value_of("ACOS(-1)"), "180");
  EXPECT_EQ(value_of("ATAN2(1,-1)"), "135");
  EXPECT_EQ(value_of("ATAN2(-1,-1)"), "-135");
  EXPECT_EQ(value_of("SQRT(2.25)"), "1.5");
  EXPECT_EQ(value_of("POT(R2)"), "4");
  EXPECT_EQ(value_of("ABS(R2)"), "2");
  EXPECT_EQ(value_of("TRUNC(-2.9)"), "-2");
  EXPECT_EQ(value_of("ROUND(2.5)"), "3");
  EXPECT_EQ(value_of("ROUNDUP(2.1)"), "3");
  EXPECT_EQ(value_of("LN(EXP(2))"), "2");
  EXPECT_EQ(value_of("MINVAL(R1,R2)"), "-2");
  EXPECT_EQ(value_of("MAXVAL(R1,R2)"), "3.5");
  EXPECT_EQ(value_of("BOUND(0,5,R3)"), "5");
  EXPECT_EQ(value_of("STRLEN(\"ABC\")"), "3");
}

// Relative equality, as the control has it.
TEST(SinumerikExpressions, CompareWithinTheLastDigits) {  // D-54
  EXPECT_TRUE(holds("0.1+0.2==0.3"));
  EXPECT_FALSE(holds("0.1+0.2>0.3"));
  EXPECT_TRUE(holds("0.1+0.2<=0.3"));
  EXPECT_FALSE(holds("0.1==0.1000001"));
  EXPECT_EQ(value_of("TRUNC((0.1+0.7)*10)"), "8");
}

TEST(SinumerikExpressions, KnowWhatIsTrue) {
  EXPECT_TRUE(holds("R1"));
  EXPECT_FALSE(holds("R3"));
  EXPECT_TRUE(holds("NOT R3"));
  EXPECT_TRUE(holds("(R1==1) AND (R2==2)"));
  EXPECT_FALSE(holds("(R1==1) XOR (R2==2)"));
  EXPECT_TRUE(holds("(R1==5) OR (R2<>5)"));
  EXPECT_TRUE(holds("R1<R2"));
  EXPECT_TRUE(holds("\"A\"<<R1==\"A1\""));
}

TEST(SinumerikVariables, HaveTheirTypes) {
  EXPECT_EQ(flat("DEF INT N=2.5, M\nX=N Y=M\nN=N/2\nX=N\n"), "X=3 Y=0\nX=2\n");
  EXPECT_EQ(flat("DEF BOOL B=7\nX=B\n"), "X=1\n");
  EXPECT_EQ(flat("DEF REAL A, B=1.5\nA=B*2\nX=A\n"), "X=3\n");
  EXPECT_EQ(flat("DEF STRING[20] S=\"MILL\"\nT=S<<10\n"), "T=\"MILL10\"\n");
  EXPECT_EQ(flat("DEF CHAR C=65\nX=C\n"), "X=65\n");
  EXPECT_EQ(flat("def real depth=-1\nx=Depth\n"), "x=-1\n");
}

TEST(SinumerikVariables, StandInArrays) {
  EXPECT_EQ(flat("DEF REAL A[3]=(1,2)\nX=A[0] Y=A[1] Z=A[2]\n"), "X=1 Y=2 Z=0\n");
  EXPECT_EQ(flat("DEF REAL A[3]=SET(1,2,3)\nA[1]=SET(8,9)\nX=A[0] Y=A[1] Z=A[2]\n"),
            "X=1 Y=8 Z=9\n");
  EXPECT_EQ(flat("DEF INT A[2,3]\nA[1,2]=5\nX=A[1,2] Y=A[0,2]\n"), "X=5 Y=0\n");
  EXPECT_EQ(flat("DEF REAL A[4]=REP(2.5)\nX=A[3]\n"), "X=2.5\n");
  EXPECT_EQ(flat("DEF REAL A[4]\nA[1]=REP(7,2)\nX=A[1] Y=A[2] Z=A[3]\n"), "X=7 Y=7 Z=0\n");
  EXPECT_EQ(flat("R1=3 R[R1]=9 R[R1+1]=R[R1]/2\nX=R3 Y=R4\n"), "X=9 Y=4.5\n");
}

TEST(SinumerikVariables, AreKnownFromTheSetup) {
  ProgramSessionSetup setup = sinumerik();
  setup.session.program.variables = {{"R5", 7}, {"$AA_IM[X]", 3}, {"_DEPTH", -2}, {"$P_TOOLR", 4}};
  EXPECT_EQ(flat_of("X=R5 Y=$AA_IM[X]+1 Z=_DEPTH F=$P_TOOLR*10\n", setup), "X=7 Y=4 Z=-2 F=40\n");
  EXPECT_EQ(flat_of("R5=R5+1\nX=R5\n", setup), "R5=R5+1\nX=8\n");  // D-88
}

TEST(SinumerikWords, TakeTheirValues) {
  EXPECT_EQ(flat("R1=5\nN10 G1 X=R1+1 Y=-R1 Z5.5 F=R1*100 ; feed\n"),
            "N10 G1 X=6 Y=-5 Z5.5 F=500 ; feed\n");
  EXPECT_EQ(flat("R1=5\nX=IC(R1/2) Y=AC(R1) Z=IC(-1)\n"), "X=IC(2.5) Y=AC(5) Z=IC(-1)\n");
  EXPECT_EQ(flat("R1=5\nG0 X0\nG2 X10 Y0 CR=R1 F100\n"), "G0 X0\nG2 X10 Y0 CR=5 F100\n");
  EXPECT_EQ(flat("R1=5\nS1=R1*100 M1=3\n"), "S1=500 M1=3\n");
  EXPECT_EQ(flat("R1=5 G0 X=R1 R2=R1*2 Y=R2\n"), "G0 X=5 Y=10\n");
  EXPECT_EQ(flat("R1=1\nMSG(\"PASS \"<<R1<<\" OF 3\")\nMSG(\"DONE\")\n"),
            "MSG(\"PASS 1 OF 3\")\nMSG(\"DONE\")\n");
  EXPECT_EQ(flat("R1=2\nCYCLE81(R1+3,0,,-R1,)\nFGROUP(X,Y)\n"), "CYCLE81(5,0,,-2,)\nFGROUP(X,Y)\n");
  EXPECT_EQ(flat("R1=2 G0 X1Y2\n"), "G0 X1Y2\n");
}

TEST(SinumerikWords, AreDroppedWithWhatIsOnlyComputed) {
  EXPECT_EQ(flat("N10 R1=5 ; the radius\nN20 R2=3\nN30 LABEL: X=R1\nN40 END_1:\nM30\n"),
            "N10 ; the radius\nN30 X=5\nM30\n");
}

TEST(SinumerikWords, PassAVariableOfTheMachine) {  // D-55
  const std::string text = "G0 Z=_HOME\nN20 X=_HOME Y=R5\nM30\n";
  EXPECT_EQ(flat(text), text);
  EXPECT_EQ(flat("R1=2\nG0 Z=_HOME\nM30\n"), "G0 Z=_HOME\nM30\n");
}

TEST(SinumerikFlow, Branches) {
  EXPECT_EQ(flat("R1=2\nIF R1==1\nX1\nELSE\nIF R1==2\nX2\nENDIF\nX3\nENDIF\nX4\n"), "X2\nX3\nX4\n");
  EXPECT_EQ(flat("R1=2\nIF R1==1\nX1\nENDIF\nX4\n"), "X4\n");
  EXPECT_EQ(flat("R1=1\nIF R1 GOTOF LA\nX1\nLA: X2\n"), "X2\n");
  EXPECT_EQ(flat("R1=0\nIF R1 GOTOF LA\nX1\nLA: X2\n"), "X1\nX2\n");
}

TEST(SinumerikFlow, Loops) {
  EXPECT_EQ(flat("FOR R1=1 TO 3\nX=R1\nENDFOR\nX=R1\n"), "X=1\nX=2\nX=3\nX=4\n");
  EXPECT_EQ(flat("DEF INT I\nFOR I=2 TO 1\nX=I\nENDFOR\nX9\n"), "X9\n");
  EXPECT_EQ(flat("R1=0\nWHILE R1<2\nX=R1\nR1=R1+1\nENDWHILE\n"), "X=0\nX=1\n");
  EXPECT_EQ(flat("R1=5\nREPEAT\nX=R1\nR1=R1+1\nUNTIL R1>5\n"), "X=5\n");
  EXPECT_EQ(flat("R1=0\nLOOP\nR1=R1+1\nIF R1>2 GOTOF OUT\nX=R1\nENDLOOP\nOUT: X9\n"),
            "X=1\nX=2\nX9\n");
}

TEST(SinumerikFlow, JumpsWhereItsWordsSay) {
  EXPECT_EQ(flat("GOTOF N30\nX1\nN30 X2\n"), "N30 X2\n");
  EXPECT_EQ(flat("R1=0\nAGAIN: X=R1\nR1=R1+1\nIF R1<2 GOTOB AGAIN\n"), "X=0\nX=1\n");
  EXPECT_EQ(flat("R1=0\nLA: R1=R1+1\nIF R1==1 GOTO LA\nGOTO LA\nX1\nLA: X2\n"), "X2\n");
  EXPECT_EQ(flat("GOTOC NOWHERE\nX1\n"), "X1\n");
  EXPECT_EQ(flat("GOTOF :30\nX1\n:30 X2\n"), ":30 X2\n");
  EXPECT_EQ(flat("DEF STRING[9] S=\"LB\"\nGOTOF S\nX1\nLB: X2\n"), "X2\n");
  EXPECT_EQ(
      flat("R1=3\nCASE R1 OF 1 GOTOF LA 3 GOTOF LB DEFAULT GOTOF LC\nLA: X1\nLB: X2\nLC: X3\n"),
      "X2\nX3\n");
  EXPECT_EQ(flat("R1=7\nCASE(R1) OF 1 GOTOF LA\nX5\nLA: X1\n"), "X5\nX1\n");
  EXPECT_EQ(flat("X0\nR9=R9_COUNT\n").substr(0, 2), "2:");
}

TEST(SinumerikFlow, RepeatsParts) {
  EXPECT_EQ(flat("LA: X1\nX2\nREPEAT LA P=2\nX3\n"),
            "LA: X1\nX2\n; LA\nX1\nX2\n; LA\nX1\nX2\nX3\n");
  EXPECT_EQ(flat("LA: X1\nX2\nREPEATB LA P2\n"), "LA: X1\nX2\n; LA\nX1\n; LA\nX1\n");
  EXPECT_EQ(flat("LA: X1\nLB: X2\nX3\nREPEAT LA LB\n"), "LA: X1\nLB: X2\nX3\n; LA\nX1\nX2\n");
  EXPECT_EQ(flat("LA: X1\nENDLABEL: X2\nX3\nREPEAT LA\n"),
            "LA: X1\nENDLABEL: X2\nX3\n; LA\nX1\nX2\n");
}

TEST(SinumerikCalls, PassTheirValues) {
  EXPECT_EQ(flat("N10 SUB(5,,\"A\") ; go\nM30\nPROC SUB(REAL X1, INT N=3, STRING[5] S)\n"
                 "G0 X=X1 Y=N\nMSG(S)\nM17\n"),
            "N10 ; SUB ; go\nG0 X=5 Y=3\nMSG(\"A\")\nM30\n");
  EXPECT_EQ(flat("DEF REAL A=1\nTWICE(A)\nX=A\nM30\nPROC TWICE(VAR REAL V1)\nV1=V1*2\nRET\n"),
            "; TWICE\nX=2\nM30\n");
  EXPECT_EQ(flat("R1=4\nTWICE(R1)\nX=R1\nM30\nPROC TWICE(VAR REAL V1)\nV1=V1*2\nRET\n"),
            "; TWICE\nX=8\nM30\n");
  // Of its own each time.
  EXPECT_EQ(flat("DEF REAL A=1\nSUB\nX=A\nM30\nPROC SUB\nDEF REAL A\nA=5\nM17\n"),
            "; SUB\nX=1\nM30\n");
}

TEST(SinumerikCalls, RepeatWithP) {
  EXPECT_EQ(flat("R1=0\nL10 P3\nM30\n%_N_L10_SPF\nR1=R1+1\nX=R1 M17\n"),
            "; L10\nX=1\n; L10\nX=2\n; L10\nX=3\nM30\n");
  EXPECT_EQ(flat("R1=0\nG0 X1 SUB P=1+1\nM30\n%_N_SUB_SPF\nG91 Y1\nRET\n"),
            "G0 X1\n; SUB\nG91 Y1\n; SUB\nG91 Y1\nM30\n");
  // The order of words is free.
  EXPECT_EQ(flat("N5 P2 L10 ; go\nM30\n%_N_L10_SPF\nX1\nM17\n"),
            "N5 ; L10 ; go\nX1\n; L10\nX1\nM30\n");
  EXPECT_EQ(flat("R1=2\nG0 P=R1 X1 SUB\nM30\n%_N_SUB_SPF\nG91 Y1\nRET\n"),
            "G0 X1\n; SUB\nG91 Y1\n; SUB\nG91 Y1\nM30\n");
}

TEST(SinumerikCalls, FindGivenSubprograms) {
  ProgramSessionSetup setup = sinumerik();
  setup.session.program.subprograms = {
      {"sub/L12.SPF", "X=R1\nM17\n"},
      {"_N_KONTUR_SPF", "PROC KONTUR(REAL W1)\nY=W1\nRET\n"},
      {"other.mpf", "%_N_NAMED_SPF\n;$PATH=/_N_SPF_DIR\nZ1\nRET\n"}};
  EXPECT_EQ(flat_of("R1=2\nL12\nKONTUR(3)\nNAMED\nOTHER\nCALL \"KONTUR\"\nM30\n", setup),
            "; L12\nX=2\n; KONTUR\nY=3\n; NAMED\n;$PATH=/_N_SPF_DIR\nZ1\n; OTHER\n"
            ";$PATH=/_N_SPF_DIR\nZ1\n; KONTUR\nY=0\nM30\n");
}

TEST(SinumerikCalls, LeaveWhatTheyDoNotKnowToTheReader) {
  const ProgramRun ran = to_text("FOO\nBAR(1)\nG0 X1\nM30\n", sinumerik());
  ASSERT_EQ(ran.diagnostics.size(), 1u) << ran.report();
  EXPECT_EQ(ran.diagnostics[0].detail, "FOO, a name");
  ProgramSessionSetup setup = sinumerik();
  setup.session.program.copies_unknown_words = true;
  EXPECT_EQ(flat_of("FOO\nBAR(1)\nR1=3\nBAR(R1)\nG0 X1\nM30\n", setup),
            "FOO\nBAR(1)\nR1=3\nBAR(R1)\nG0 X1\nM30\n");
}

TEST(SinumerikPrograms, EndWhereTheyReturn) {
  EXPECT_EQ(flat("R1=1\nG0 X=R1\nN9 RET\nX2\n"), "G0 X=1\nN9 M17\nX2\n");
  EXPECT_EQ(flat("R1=1\nG0 X=R1 M30\nX2\n"), "G0 X=1 M30\nX2\n");
  EXPECT_EQ(flat("PROC MAIN\nG0 X1\nM17\n"), "G0 X1\nM17\n");
}

// Cycles look for their contours in the program.
TEST(SinumerikPrograms, KeepTheContoursOfTheirCycles) {
  const std::string behind =
      "E_LAB_A_1: ;#SM Z:3\n;#7__DlgK\nG17 G90 DIAMOF;*GP*\nG0 X0 Y0 ;*GP*\nG1 X100 ;*GP*\n"
      "Y50 RND=5 ;*GP*\nE_LAB_E_1:\n";
  EXPECT_EQ(flat("R1=3\nCYCLE62(,2,\"E_LAB_A_1\",\"E_LAB_E_1\")\nG0 X=R1\nM30\n" + behind),
            "CYCLE62(,2,\"E_LAB_A_1\",\"E_LAB_E_1\")\nG0 X=3\nM30\n" + behind);
  EXPECT_EQ(flat("CYCLE62(,2,\"E_LAB_A_1\",\"E_LAB_E_1\")\nR1=3\nG0 X=R1\nM30\n" + behind),
            "CYCLE62(,2,\"E_LAB_A_1\",\"E_LAB_E_1\")\nG0 X=3\nM30\n" + behind);
  EXPECT_EQ(flat("R1=3\nCYCLE62(\"1\",1,,)\nG0 X=R1\nM30\nX7\n" + behind + "X8\n"),
            "CYCLE62(\"1\",1,,)\nG0 X=3\nM30\nX7\n" + behind);
  EXPECT_EQ(flat("R1=3\nCYCLE72(\"E_LAB_A_1:E_LAB_E_1\",100)\nG0 X=R1\nM30\n" + behind),
            "CYCLE72(\"E_LAB_A_1:E_LAB_E_1\",100)\nG0 X=3\nM30\n" + behind);
  const std::string contour = "%_N_KON_SPF\n;$PATH=/_N_WKS_DIR\nG0 X0 Y0\nG1 X100\nM17\n";
  EXPECT_EQ(flat("%_N_MAIN_MPF\nR1=3\nCYCLE62(\"KON\",0,,)\nSUB1\nG0 X=R1\nM30\n" + contour +
                 "%_N_SUB1_SPF\nG0 Z50\nM17\n"),
            "%_N_MAIN_MPF\nCYCLE62(\"KON\",0,,)\n; SUB1\nG0 Z50\nG0 X=3\nM30\n" + contour);
  EXPECT_EQ(flat("R1=3\nCYCLE62(\"KON\",0,,)\nG0 X=R1\nRET\nPROC KON\nG1 X100\nRET\n"),
            "CYCLE62(\"KON\",0,,)\nG0 X=3\nM17\nPROC KON\nG1 X100\nRET\n");
  EXPECT_EQ(flat("R1=3\nMSG(\"KON\")\nG0 X=R1\nM30\n" + contour), "MSG(\"KON\")\nG0 X=3\nM30\n");
}

TEST(SinumerikPrograms, WithoutAnythingToComputePassAsTheyStand) {
  const std::string text =
      "%_N_PART_MPF\n;$PATH=/_N_WKS_DIR\nN10 G17 G90 ; IF R1>5 GOTOF A\nLA: X=10 Y=-5.5\n"
      "MSG(\"R1=5 L10\")\nT=\"CUTTER 10\" M6\nG2 X20 Y-5.5 CR=5 F=1000\nMCALL CYCLE81(1,2,3)\n"
      "MCALL\nNORM G450\nG0 SUPA Z=_HOME\nM30\n";
  const ProgramRun ran = to_text(text, sinumerik());
  EXPECT_EQ(ran.text, text) << ran.report();
  ProgramSessionSetup setup = sinumerik();
  setup.nc_text = true;
  ProgramSession session(setup);
  Answers answers;
  EXPECT_TRUE(session.feed(text, answers));
  EXPECT_FALSE(session.is_computing());
}

struct Refusal {
  std::string text{};
  Code code{};
  std::uint32_t line = 0;
  std::string detail{};
};

TEST(SinumerikRefusals, NameWhatCannotBeFollowed) {
  const std::vector<Refusal> refusals{
      {"R1=1\nLA: GOTOB LA\n", Code::too_many_lines_executed, 2, ""},
      {"SUB\nM30\n%_N_SUB_SPF\nSUB\nRET\n", Code::calls_too_deep, 4, "SUB"},
      {"X=R7+1\n", Code::variable_unset, 1, "R7"},
      {"R1=DEPTH\n", Code::variable_unset, 1, "DEPTH"},
      {"DEPTH=5\nR1=DEPTH\n", Code::variable_unset, 2,
       "DEPTH, a variable of the machine that the program sets"},
      {"LEAD=5\nR1=2\n", Code::nc_unsupported, 1,
       "LEAD=5, a word of the language that is not read here"},
      {"R1=0\nX=1/R1\n", Code::division_by_zero, 2, "/"},
      {"R1=0\nX=1 DIV R1\n", Code::division_by_zero, 2, "DIV"},
      {"GOTOF LA\nX1\n", Code::jump_target_unknown, 1, "LA"},
      {"LA: X1\nGOTOF LA\n", Code::jump_target_unknown, 2, "LA"},
      {"X1\nREPEAT LA P=2\n", Code::jump_target_unknown, 2, "LA"},
      {"LA: X1\nIF R1 GOTOF LB\nREPEAT LA\nLB: X2\n", Code::variable_unset, 2, "R1"},
      {"G0 X1\nL77\n", Code::subprogram_unknown, 2, "L77"},
      {"R1=$AA_IM[X]\n", Code::machine_state, 1, "$AA_IM[X]"},
      {"$MC_CUTCOM_CORNER_LIMIT=100\n", Code::machine_state, 1, "$MC_CUTCOM_CORNER_LIMIT"},
      {"IF R1>2 AND R2<3\nENDIF\n", Code::variable_unset, 1, "R1"},
      {"R1=1 R2=2\nIF R1>2 AND R2<3\nENDIF\n", Code::expression_invalid, 2, "<"},
      {"R1=(1+2\n", Code::expression_invalid, 1, "(, a bracket without )"},
      {"R1=FOO(2)\n", Code::expression_invalid, 1, "FOO"},
      {"R1=\"A\"+1\n", Code::expression_invalid, 1, "a text"},
      {"DEF REAL X\nX=5\n", Code::expression_invalid, 2,
       "X, a variable with the name of an address"},
      {"DEF REAL I\nG0 X1 I=5\n", Code::expression_invalid, 2,
       "I, a variable with the name of an address"},
      {"IF 1 X5\nENDIF\n", Code::expression_invalid, 1, "X"},
      {"R1=SQRT(-1)\n", Code::value_invalid, 1, "SQRT(-1)"},
      {"DEF INT N=3000000000\n", Code::value_invalid, 1, "beyond the range of its type"},
      {"DEF REAL A[2]\nA[2]=1\n", Code::value_invalid, 2, "an index beyond its array"},
      {"R1=3\nFOR R2=1 TO R1\nR1=R1+1\nENDFOR\n", Code::value_invalid, 4,
       "FOR to an end that its loop changes"},
      {"IF 1\nX1\n", Code::block_structure, 1, "IF without ENDIF"},
      {"X1\nENDWHILE\n", Code::block_structure, 2, "ENDWHILE without WHILE"},
      {"SUB\nM30\n%_N_SUB_SPF\nX1\n", Code::block_structure, 4,
       "SUB, a subprogram without its end"},
      {"DEF AXIS A1\n", Code::nc_unsupported, 1, "AXIS, a type"},
      {"DEF FRAME F1\n", Code::nc_unsupported, 1, "FRAME, a type"},
      {"ID=1 WHEN $AA_IM[X]>5 DO M8\n", Code::nc_unsupported, 1, "ID, a synchronized action"},
      {"/ R1=5\n", Code::block_skip_undecided, 1, "/, a line to skip that computes"},
      {"SUB\nM30\nPROC SUB SAVE\nG0 X1\nRET\n", Code::nc_unsupported, 1, "SAVE of PROC SUB"},
      {"SUB\nM30\n%_N_SUB_SPF\nM30\n", Code::nc_unsupported, 4, "M30 in a subprogram"},
      {"MCALL SUB\nM30\n%_N_SUB_SPF\nRET\n", Code::nc_unsupported, 1, "MCALL of a subprogram"},
      {"MCALL L77\nM30\n%_N_L77_SPF\nRET\n", Code::nc_unsupported, 1, "MCALL of a subprogram"},
      {"G0 X1\nN5 MCALL L77 P2\nX5\nMCALL\nM30\n%_N_L77_SPF\nZ1\nM17\n", Code::nc_unsupported, 2,
       "MCALL of a subprogram"},
      {"P2 MCALL L77\nM30\n%_N_L77_SPF\nRET\n", Code::nc_unsupported, 1, "MCALL of a subprogram"},
      {"P2 L77 P3\nM30\n%_N_L77_SPF\nRET\n", Code::expression_invalid, 1,
       "P2, a second count of a call"},
      {"R1=1\nRET(\"LA\")\n", Code::nc_unsupported, 2, "RET with a target"},
      {"R1=1\nCYCLE62(\"KON\",0,,)\nM30\nPROC KON\nG1 X=R1\nRET\n", Code::nc_unsupported, 5,
       "a contour of a cycle that computes"},
      {"R1=1\nCYCLE62(,2,\"LA\",\"LB\")\nLA: G1 X1\nLB:\nM30\n", Code::nc_unsupported, 3,
       "a contour of a cycle that the program runs through"},
      {"R1=1\nCYCLE62(\"KON\",0,,)\nG0 X5\n%_N_KON_SPF\nG1 X1\nM17\n", Code::block_structure, 3,
       "a contour of a cycle after a program without M30"},
      {"SUB(1,2)\nM30\nPROC SUB(REAL A1)\nRET\n", Code::value_invalid, 1,
       "SUB with more values than it takes"},
  };
  for (const Refusal& refusal : refusals) {
    SCOPED_TRACE(refusal.text);
    ProgramSessionSetup setup = sinumerik();
    setup.session.program.max_executed_lines = 1000;
    const ProgramRun ran = to_text(refusal.text, setup);
    ASSERT_FALSE(ran.diagnostics.empty()) << ran.text;
    EXPECT_EQ(ran.diagnostics[0].code, refusal.code) << ran.report();
    EXPECT_EQ(ran.diagnostics[0].source.line, refusal.line);
    if (refusal.code != Code::too_many_lines_executed) {
      EXPECT_EQ(ran.diagnostics[0].detail, refusal.detail);
    }
  }
}

TEST(SinumerikRefusals, AreToldWithTheirCalls) {
  const ProgramRun ran = to_text("R1=0\nSUB\nM30\n%_N_SUB_SPF\nX=1/R1\nRET\n", sinumerik());
  ASSERT_EQ(ran.diagnostics.size(), 1u) << ran.report();
  EXPECT_EQ(ran.diagnostics[0].calls,
            (std::vector<CallPlace>{{.subprogram = "SUB", .called_from = 2}}));
}

// A value that nothing changes may stand in a line that may be skipped.
TEST(SinumerikWords, AreComputedInALineToSkip) {
  EXPECT_EQ(flat("R1=5\n/ G0 X=R1\n/2 N20 Y=R1\n"), "/ G0 X=5\n/2 N20 Y=5\n");
}

TEST(SinumerikPrograms, LoseNoContourAfterTheirEnd) {
  const std::string contour = "G0 X-20 Y-20\nG41 D1 G1 X0 Y0 F300\nY40\nG40 X80\n";
  EXPECT_EQ(refusal_of("R1=5\nG0 X=R1\nM30\n" + contour + "M30\n", sinumerik()),
            std::pair(900015, 5U));
  EXPECT_EQ(refusal_of("R1=5\nG0 X=R1\nM30\n%_N_OTHER_MPF\n" + contour + "M30\n", sinumerik()),
            std::pair(900015, 6U));
  // A jump leads there for another value.
  const std::string jumps = "R1=5\nIF R1==2 GOTOF PART\nG0 X=R1\nM30\nPART:\n" + contour + "M30\n";
  EXPECT_EQ(refusal_of(jumps, sinumerik()), std::pair(0, 0U));
  EXPECT_EQ(refusal_of(jumps + "PROC OTHER\n" + contour + "M17\n", sinumerik()),
            std::pair(900015, 13U));
}

}  // namespace
}  // namespace trc::support::sinumerik_computing
