#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "tests/programs/computing.h"
#include "tests/programs/twins.h"

// The language of ISG, statement by statement, and whole programs beside their paths.

namespace trc::support::isg_computing {
namespace {

ProgramSessionSetup isg() { return computing_setup(DialectName::isg); }

std::string flat(const std::string& text) { return flat_of(text, isg()); }

std::pair<int, unsigned> refusal(const std::string& text) { return refusal_of(text, isg()); }

// The value of an expression, as it is written after an address.
std::string value_of(const std::string& expression) {
  const std::string text = flat("P1=3.5 P2=-2 P3=10\nP10=" + expression + "\nG0 XP10\n");
  return text.starts_with("G0 X") ? text.substr(4, text.size() - 5) : text;
}

bool holds(const std::string& condition) {
  const std::string text = flat("P1=1 P2=2 P3=0\n$IF " + condition + "\nX1\n$ELSE\nX2\n$ENDIF\n");
  EXPECT_TRUE(text == "X1\n" || text == "X2\n") << text;
  return text == "X1\n";
}

TEST(IsgExpressions, KeepTheOrderOfTheirOperators) {
  EXPECT_EQ(value_of("1+2*3"), "7");
  EXPECT_EQ(value_of("[1+2]*3"), "9");
  EXPECT_EQ(value_of("10-4-3"), "3");
  EXPECT_EQ(value_of("16/4/2"), "2");
  EXPECT_EQ(value_of("2*3**2"), "18");
  EXPECT_EQ(value_of("7 MOD 4"), "3");
  EXPECT_EQ(value_of("-P2*3"), "6");
  EXPECT_EQ(value_of("P1 - P2"), "5.5");
  EXPECT_EQ(value_of("6 & 3"), "2");
  EXPECT_EQ(value_of("6 | 3"), "7");
  EXPECT_EQ(value_of("6 ^ 3"), "5");
  EXPECT_EQ(value_of("INV[0]"), "-1");
}

// A `/` skips a line where it stands before it, and after `=` divides.
TEST(IsgExpressions, StandAfterAnAddressWithBlanksAndDivisions) {
  EXPECT_EQ(flat("P1=80\nG0 X=P1/2 Y=50 + 10 Z=90/3\n"), "G0 X=40 Y=60 Z=30\n");
  ProgramSessionSetup setup = computing_setup(DialectName::isg, 5);
  const std::string plain = "G90 G17\nG0 X-20 Y0\nG41 G1 X0 F300\nY40\nX60\nG40 X80\nM30\n";
  const std::string computed =
      "G90 G17\nG0 X=-40/2 Y0\nG41 G1 X=4 - 4 F300\nY=80/2\nX=50 + 10\nG40 X=2*40\nM30\n";
  const std::string with_motion = "G0 X=-40/2 Y0";
  std::string expected = to_text(plain, setup).text;
  expected.replace(expected.find("G0 X-20 Y0"), 10, with_motion);
  EXPECT_EQ(to_text(computed, setup).text, expected);
  EXPECT_EQ(refusal("G90\n/X10\nG41 G1 X20 Y=80/2\n").first, 900017);
}

TEST(IsgExpressions, KnowTheirFunctions) {
  EXPECT_EQ(value_of("SIN[30]"), "0.5");
  EXPECT_EQ(value_of("ACOS[0.5]"), "60");
  EXPECT_EQ(value_of("ATAN[1]"), "45");
  EXPECT_EQ(value_of("COT[45]"), "1");
  EXPECT_EQ(value_of("SQR[P3]"), "100");
  EXPECT_EQ(value_of("SQRT[16]"), "4");
  EXPECT_EQ(value_of("INT[-3.7]"), "-3");
  EXPECT_EQ(value_of("FRACT[2.25]"), "0.25");
  EXPECT_EQ(value_of("ROUND[2.6]"), "3");
  EXPECT_EQ(value_of("DEXP[2]"), "100");
  EXPECT_EQ(value_of("LOG[1000]"), "3");
  EXPECT_EQ(value_of("ABS[P2]"), "2");
  EXPECT_EQ(value_of("MIN[P1, P2]"), "-2");
}

TEST(IsgExpressions, AskForBracketsWhereTheOrderIsNotSaid) {  // D-67
  EXPECT_EQ(refusal("P1=1\n$IF P1 == 1 || P1 == 2 && P1 == 3\nX1\n$ENDIF\n").first, 900308);
  EXPECT_EQ(refusal("P1=2\nXP1\nP2=-P1**2\n").first, 900308);
  EXPECT_EQ(refusal("P1=2**3**2\nXP1\n").first, 900308);
  EXPECT_TRUE(holds("[P1 == 1 && P2 == 3] || P3 == 0"));
  EXPECT_TRUE(holds("P1 == 1 && P2 == 2 && P3 == 0"));
}

TEST(IsgExpressions, DecideAsTheManualSays) {
  EXPECT_TRUE(holds("P1"));
  EXPECT_FALSE(holds("P3"));
  EXPECT_FALSE(holds("0.4"));
  EXPECT_TRUE(holds("NOT[P3]"));
  EXPECT_TRUE(holds("P1 < P2"));
  EXPECT_TRUE(holds("P1 != P2"));
  EXPECT_FALSE(holds("P1 >= P2"));
  EXPECT_TRUE(holds("TRUE"));
}

TEST(IsgExpressions, ComparisonsDoNotHangOnTheLastDigit) {  // D-54
  EXPECT_EQ(refusal("P1=0.1+0.2\n$IF P1 == 0.3\nX1\n$ENDIF\n").first, 900309);
}

TEST(IsgWords, HaveTheirValues) {
  EXPECT_EQ(flat("P1=10 P2=-2.5\nN20 G01 XP1 Y P2 Z=P1*2 FP1+90\n"),
            "N20 G01 X10 Y -2.5 Z=20 F100\n");
  EXPECT_EQ(flat("P1=10\nG01 X-P1 Y[P1+5] FP1\n"), "G01 X-10 Y15 F10\n");
  EXPECT_EQ(flat("P1=2\nG01 X SIN[P1*15] F100 (half)\n"), "G01 X 0.5 F100 (half)\n");
  EXPECT_EQ(flat("P5=3000\nS2=P5 M[1+2]\n"), "S2=3000 M3\n");
  EXPECT_EQ(flat("N10 G01 X[10+5] F500\n"), "N10 G01 X15 F500\n");
  EXPECT_EQ(flat("P1=5\nG01 X10+P1 F500\n"), "G01 X15 F500\n");
  EXPECT_EQ(flat("P1=1\n#CS ON [P1,-P1,0,0,0,P1*90]\n"), "#CS ON [1,-1,0,0,0,90]\n");
  EXPECT_EQ(refusal("P1=7\n#TRC [KERF_MASKING=P1]\nX1\n"), std::pair(900005, 2U));
}

TEST(IsgWords, AreNotReadBesideTheirAssignment) {  // D-67
  EXPECT_EQ(refusal("P1=1\nG01 XP1 P2=3 F100\nP1=2 G01 XP1\n"), std::pair(900309, 3U));
  EXPECT_EQ(flat("P1=20 P2=P1+1\nXP2\n"), "X21\n");
}

TEST(IsgParameters, AreDirectIndirectAndArrays) {
  EXPECT_EQ(flat("P1=20 P2=40\nPP1=50\nPP2=PP1\nXP20 YP40\n"), "X50 Y50\n");
  EXPECT_EQ(flat("$FOR P1=10,12,1\nP[P1+5]=P1\n$ENDFOR\nXP15 YP17\n"), "X10 Y12\n");
  EXPECT_EQ(flat("P1=5\nP1+=2\nP1*=3\nXP1\n"), "X21\n");
  EXPECT_EQ(flat("#VAR\nP10[3]=[1,2,3]\nV.P.DEEP : REAL64 = 4\nV.L.N : SGN32\n#ENDVAR\n"
                 "XP10[1] YV.P.DEEP ZV.L.N\n"),
            "X2 Y4 Z0\n");
  EXPECT_EQ(refusal("XP7\n"), std::pair(900303, 1U));
  EXPECT_EQ(refusal("#VAR\nV.P.N : UNS16\n#ENDVAR\nV.P.N = 2.5\n"), std::pair(900309, 4U));
}

TEST(IsgVariables, OfTheMachineAreNotKnown) {
  EXPECT_EQ(refusal("XV.A.ABS.X\n"), std::pair(900307, 1U));
  ProgramSessionSetup setup = isg();
  setup.session.program.variables = {{"V.A.MEAS.ACS.VALUE.X", 12}, {"V.A.ABS.X", 1}, {"P7", 3}};
  EXPECT_EQ(flat_of("XV.A.MEAS.ACS.VALUE.X YP7\n", setup), "X12 Y3\n");
  EXPECT_EQ(refusal_of("P1=V.A.ABS.X\nX[P1+5]\n", setup), std::pair(900307, 1U));
}

TEST(IsgVariables, OfALevelAreKnownInWhatItCalls) {
  const std::string in_front =
      "%L A\nX[V.L.LEN]\nV.L.LEN = 30\nM17\n%L B\nX[V.L.LEN]\n#VAR\nV.L.LEN = 7\n"
      "#ENDVAR\nY[V.L.LEN]\nM17\n%L C\nLL A\nM17\n%MAIN\n";
  const std::string declared = "#VAR\nV.L.LEN = 20\n#ENDVAR\n";
  EXPECT_EQ(flat(in_front + declared + "LL A\nZ[V.L.LEN]\n"), "%MAIN\n(A)\nX20\nZ30\n");
  EXPECT_EQ(flat(in_front + declared + "LL B\nZ[V.L.LEN]\n"), "%MAIN\n(B)\nX20\nY7\nZ20\n");
  // No manual says whether it reaches beyond the subprogram that is called directly.
  EXPECT_EQ(refusal(in_front + declared + "LL C\n"), std::pair(900303, 2U));
}

TEST(IsgVariables, AreWithinWhatIsDeclared) {
  EXPECT_EQ(refusal("P1=1\nV.L.A=20\nXV.L.A\n"), std::pair(900309, 2U));
  EXPECT_EQ(refusal("#VAR\nV.P.A[3]=[1,2,3]\n#ENDVAR\nV.P.A[5]=9\n"), std::pair(900309, 4U));
  EXPECT_EQ(flat("#VAR\nV.P.A[3]=[1,2,3]\n#ENDVAR\nV.P.A[2]=9\nXV.P.A[2]\n"), "X9\n");
  EXPECT_EQ(refusal("P0=4\nX1\n"), std::pair(900309, 1U));
  EXPECT_EQ(refusal("P1.5=4\nX1\n"), std::pair(900003, 1U));
}

TEST(IsgVariables, SayTheRadiiOfTools) {
  ProgramSessionSetup setup = isg();
  setup.session.program.mode.tool_radius = 0;
  setup.session.program.tools = {{5, ToolRow(4)}, {6, ToolRow(3)}};
  EXPECT_EQ(flat_of("D5\nXV.G.WZ_AKT.R YV.G.WZ[6].R\n", setup), "D5\nX4 Y3\n");
  EXPECT_EQ(flat_of("D5\nG70\nX[V.G.WZ_AKT.R*25.4]\n", setup), "D5\nG70\nX4\n");
  EXPECT_EQ(flat_of("D5\nP1=1\nV.G.WZ_AKT.R = V.G.WZ_AKT.R - P1*0.5\nXV.G.WZ_AKT.R\n", setup),
            "D5\nX3.5\n");
}

TEST(IsgVariables, ThatOutlastTheProgramComeOut) {  // D-67
  EXPECT_EQ(flat("P1=4\nV.S.COUNT = P1*2\nV.E.OUT = P1\nXV.S.COUNT\n"),
            "V.S.COUNT = 8\nV.E.OUT = 4\nX8\n");
  EXPECT_EQ(flat("V.P.DEEP = 5\nG0 X0\nZ-V.P.DEEP\n"), "V.P.DEEP = 5\nG0 X0\nZ-5\n");
}

TEST(IsgControl, Branches) {
  const std::string branches =
      "$IF P1 == 1\nX1\n$ELSEIF P1 == 2\nX2\n$ELSEIF P1 == 3\nX3\n$ELSE\nX9\n$ENDIF\n";
  EXPECT_EQ(flat("P1=1\n" + branches), "X1\n");
  EXPECT_EQ(flat("P1=2\n" + branches), "X2\n");
  EXPECT_EQ(flat("P1=3\n" + branches), "X3\n");
  EXPECT_EQ(flat("P1=4\n" + branches), "X9\n");
  EXPECT_EQ(flat("P1=1\n$IF P1 == 2\n$IF P1 == 1\nX1\n$ELSE\nX2\n$ENDIF\n$ENDIF\nX5\n"), "X5\n");
  const std::string choices =
      "$SWITCH P1=INT[P1]\n$CASE 1\nX1\n$BREAK\n$CASE 2\nX2\n$CASE 3\nX3\n$BREAK\n"
      "$DEFAULT\nX9\n$ENDSWITCH\nYP1\n";
  EXPECT_EQ(flat("P1=1.5\n" + choices), "X1\nY1\n");
  EXPECT_EQ(flat("P1=2\n" + choices), "X2\nX3\nY2\n");
  EXPECT_EQ(flat("P1=7\n" + choices), "X9\nY7\n");
}

TEST(IsgControl, Loops) {
  EXPECT_EQ(flat("$FOR P1=1,3,1\nXP1\n$ENDFOR\nYP1\n"), "X1\nX2\nX3\nY4\n");
  EXPECT_EQ(flat("$FOR P1=3,1,-1\nXP1\n$ENDFOR\n"), "X3\nX2\nX1\n");
  EXPECT_EQ(flat("$FOR P1=3,1,1\nXP1\n$ENDFOR\nX0\n"), "X0\n");
  EXPECT_EQ(flat("P1=0\n$WHILE P1 < 2\nP1=P1+1\nXP1\n$ENDWHILE\n"), "X1\nX2\n");
  EXPECT_EQ(flat("P1=0\n$REPEAT\nP1=P1+1\nXP1\n$UNTIL P1 >= 2\n"), "X1\nX2\n");
  EXPECT_EQ(flat("P1=0\n$DO\nP1=P1+1\nXP1\n$ENDDO P1 < 2\n"), "X1\nX2\n");
  EXPECT_EQ(flat("P1=0\n$DO\nP1=P1+1\n$IF P1 == 2\n$CONTINUE\n$ENDIF\n$IF P1 == 4\n$BREAK\n"
                 "$ENDIF\nXP1\n$ENDDO\n"),
            "X1\nX3\n");
  EXPECT_EQ(refusal("$FOR P1=0,0.3,0.1\nXP1\n$ENDFOR\n").first, 900309);
  EXPECT_EQ(refusal("$FOR P1=0,3,0\nXP1\n$ENDFOR\n").first, 900309);
  EXPECT_EQ(refusal("$FOR P1=0,3,1\nXP1\n").first, 900310);
  EXPECT_EQ(refusal("P1=1\n$BREAK\n").first, 900310);
}

TEST(IsgControl, Jumps) {
  EXPECT_EQ(flat("P1=0\nN10: P1=P1+1\nXP1\n$IF P1 < 3 $GOTO N10\nX0\n"), "X1\nX2\nX3\nX0\n");
  EXPECT_EQ(flat("$GOTO [END]\nX1\n[END] X2\n"), "X2\n");
  EXPECT_EQ(flat("P1=20\nX1 $GOTO N[P1+10]\nX2\nN30: X3\n"), "X1\nN30 X3\n");
  EXPECT_EQ(refusal("$GOTO N10\nX1\nN10 X2\n"), std::pair(900305, 1U));
  EXPECT_EQ(refusal("N10: $GOTO N10\n").first, 900301);
}

TEST(IsgCalls, OfTheTextStandWhereTheyAreCalled) {
  EXPECT_EQ(flat("%L SIDE\nN1 G01 XP1 F100\nM17\n%L OTHER (end is the next one)\nX7\n"
                 "%MAIN\nN10 P1=5\nN20 LL SIDE (first)\nLL OTHER\nN30 M30\n"),
            "%MAIN\nN20 (SIDE) (first)\nN1 G01 X5 F100\n(OTHER)\nX7\nN30 M30\n");
  EXPECT_EQ(refusal("%L SIDE\nX1\nM17\n%MAIN\nX0\nLL OTHER\nM30\n"), std::pair(900306, 6U));
  EXPECT_EQ(refusal("%L A\nLL A\nM17\n%MAIN\nLL A\nM30\n").first, 900302);
}

TEST(IsgCalls, OfTheSetupStandWhereTheyAreCalled) {
  ProgramSessionSetup setup = isg();
  setup.session.program.subprograms = {
      {"side.nc", "%L INNER\nXP1\nM29\n%SIDE\n#VAR\nV.L.A=3\n#ENDVAR\nLL INNER\nYV.L.A\nM17\n"}};
  EXPECT_EQ(flat_of("P1=5\nL prog/SIDE.nc\nX0\n", setup), "(SIDE)\n(INNER)\nX5\nY3\nX0\n");
}

TEST(IsgCalls, OfTheMachineKnowWhatTheProgramHasSet) {
  EXPECT_EQ(flat("P1=5\nV.P.Deep=P1*2\nG0 XP1\nL PARK\nG0 G90 X1\n"),
            "V.P.Deep=10\nG0 X5\nP1 = 5\nL PARK\nG0 G90 X1\n");
  EXPECT_EQ(flat("P1=5\nG0 X-20 Y-20\nG41 G138 G1 X0 Y0 F100\nV.P.Deep=P1*2\nY40\nX40\nG40 X-20\n"
                 "L PARK\n"),
            "G0 X-20 Y-20\nG01 X-2 Y0 F100\nG01 X-2 Y42\nG01 X40 Y42\nG01 X-20 Y40\nP1 = "
            "5\nV.P.Deep = 10\nG138\nL PARK\n");
  const std::string declared =
      "#VAR\nV.P.T_Nr[60] = [202, 152]\nV.P.Feed : REAL64 = 5\n#ENDVAR\nT202 LM06\n#DELETE "
      "V.P.Feed\n"
      "L PARK\n";
  EXPECT_EQ(flat(declared), declared);
  EXPECT_EQ(flat("P1=5\nL CYCLE [NAME=drill.cyc @P1=P1 @P2=-P1]\nG0 G90 X1\n"),
            "P1 = 5\nL CYCLE [NAME=drill.cyc @P1=5 @P2=-5]\nG0 G90 X1\n");
  EXPECT_EQ(refusal("P1=5\nL PARK\nG0 G90 XP1\n"), std::pair(900303, 3U));
}

// Text after a second % is no part of the program, but must not be lost.
TEST(IsgPrograms, EndBeforeAnotherOne) {
  const std::string contour =
      "P1=20\nG90 G00 X-10 Y-10\nG01 G42 X0 Y0 F100\nX[P1]\nY20\nX0\nY-5\nG40 G00 X-10 Y-10\n";
  EXPECT_EQ(refusal("G90 G00 X-10\n" + contour + "M30\n%L A\nX[P1]\nM17\n"),
            std::pair(900003, 11U));
  EXPECT_EQ(refusal(contour + "M30\n%L A\nM17\n"), std::pair(900003, 10U));
  EXPECT_EQ(refusal("%A\n" + contour + "M30\n%B\nG90 G00 X2\nM30\n"), std::pair(900003, 11U));
  EXPECT_EQ(refusal("P1=0\nX1\n%5\nX2\n"), std::pair(900003, 3U));
  EXPECT_EQ(refusal("$IF 1\nX1\n$ENDIF\n%\nX2\n"), std::pair(900003, 4U));
  EXPECT_EQ(refusal("G0 X1\n%L A\nX5\nM17\n%MAIN\nX2\nM30\n"), std::pair(900003, 2U));
  EXPECT_EQ(refusal("%L A\nX5\nM17\nX1\nM30\n").first, 900310);
  EXPECT_EQ(refusal("%L A\nX5\nM17\nG00 X77\n%MAIN\nLL A\nM30\n"), std::pair(900310, 4U));
  EXPECT_EQ(flat("P1=3\nXP1\nM30\n%\n"), "X3\nM30\n%\n");
  EXPECT_EQ(flat("(first)\n%L A\nX5\nM17\n%MAIN\nLL A\nM30\n"), "(first)\n%MAIN\n(A)\nX5\nM30\n");
}

TEST(IsgPrograms, KeepWhatMayBeSkipped) {
  for (const std::string line : {"/X[P1]", "/M[P1]", "/F[P1]", "/ #MSG[\"a\",P1]", "/N7: M8",
                                 "/P2=3", "N5 /X[P1]", "/[END] X1", "/L PARK"})
    EXPECT_EQ(refusal("P1=30\nG0 X20\n" + line + "\nX0\n"), std::pair(900017, 3U)) << line;
  EXPECT_EQ(flat("P1=30\nG0 XP1\n/M8\nX0\n"), "G0 X30\n/M8\nX0\n");
  EXPECT_EQ(refusal("P1=1\n$IF P1\nX1\n/$ENDIF\nX2\n"), std::pair(900017, 4U));
}

// The second line was executed once more on its own: X3 came out.
TEST(IsgControl, StandsOnOneLine) {
  EXPECT_EQ(refusal("P1=1\n$IF P1<2 AND \\\nP1=P1+1\nX[P1]\n$ENDIF\n"), std::pair(900003, 2U));
  EXPECT_EQ(refusal("P1=1\n$WHILE P1<2 \\\nX[P1]\n$ENDWHILE\n"), std::pair(900003, 2U));
  EXPECT_EQ(flat("P1=3\nG0 X[P1] \\\nY2\n"), "G0 X3  Y2\n");
}

TEST(IsgControl, HasNoWordsAfterIt) {
  EXPECT_EQ(refusal("$FOR P2=1,2,1\nXP2\n$ENDFOR X30\n"), std::pair(900308, 3U));
  EXPECT_EQ(refusal("P1=0\n$IF P1\nX1\n$ENDIF X88\n"), std::pair(900308, 4U));
  EXPECT_EQ(refusal("P1=0\n$IF P1\nX1\n$ENDIF M5\n"), std::pair(900308, 4U));
  EXPECT_EQ(refusal("P1=5\n$IF P1==1\nX1\n$ELSE IF P1==30\nX2\n$ENDIF\n"), std::pair(900308, 4U));
  EXPECT_EQ(refusal("P1=0\n$WHILE P1\nX1\n$ENDWHILE X3\n"), std::pair(900308, 4U));
  EXPECT_EQ(refusal("P1=5\n$SWITCH P1\n$CASE 5 X4\n$ENDSWITCH\n"), std::pair(900308, 3U));
  EXPECT_EQ(refusal("P1=4\n$SWITCH P1\n$CASE 4\nX1\n$CASE 5 X4\n$ENDSWITCH\n"),
            std::pair(900308, 5U));
  EXPECT_EQ(refusal("P1=4\n$SWITCH P1\n$DEFAULT X7\n$ENDSWITCH\n"), std::pair(900308, 3U));
  EXPECT_EQ(refusal("P1=4\n$SWITCH P1\n$CASE 1\n$ENDSWITCH X9\n"), std::pair(900308, 4U));
  EXPECT_EQ(refusal("#VAR\nV.P.A\n#ENDVAR\n#DELETE V.P.A X5\n"), std::pair(900308, 4U));
  EXPECT_EQ(flat("P1=1\n$IF P1\nX1\n$ELSE (other)\nX2\n$ENDIF ; end\n"), "X1\n");
}

TEST(IsgControl, IsWhole) {
  EXPECT_EQ(refusal("P1=5\n$CASE 1\nX1\n"), std::pair(900310, 2U));
  EXPECT_EQ(refusal("P1=5\n$DEFAULT\nX1\n"), std::pair(900310, 2U));
  EXPECT_EQ(refusal("P1=5\n$ENDIF\nX1\n"), std::pair(900310, 2U));
  EXPECT_EQ(refusal("P1=5\n$ENDSWITCH\nX1\n"), std::pair(900310, 2U));
  EXPECT_EQ(refusal("P1=5\n$IF P1\nX1\n$ELSE\nX2\n$ELSE\nX3\n$ENDIF\n"), std::pair(900310, 6U));
  EXPECT_EQ(refusal("P1=5\n$IF P1\nX1\n$ELSE\nX2\n$ELSEIF 1\nX3\n$ENDIF\n"), std::pair(900310, 6U));
  EXPECT_EQ(refusal("P1=5\n$SWITCH P1\nX1\n$CASE 5\n$ENDSWITCH\n"), std::pair(900310, 3U));
}

TEST(IsgControl, ComparesByTwoSigns) {
  EXPECT_EQ(refusal("P1=1\n$IF P1=2\nX30\n$ENDIF\n"), std::pair(900308, 2U));
  EXPECT_EQ(refusal("P1=1\n$WHILE P1=1\nX30\n$ENDWHILE\n"), std::pair(900308, 2U));
  EXPECT_EQ(refusal("P1=1\n$REPEAT\nX30\n$UNTIL P1=3\n"), std::pair(900308, 4U));
}

TEST(IsgWords, OfCommandsHaveTheirValues) {
  const auto command = [](const std::string& text) { return flat("P1=10 P2=-3\n" + text + "\n"); };
  EXPECT_EQ(command("#PSET XP1 Y0"), "#PSET X10 Y0\n");
  EXPECT_EQ(command("#PSET X P2 Y[P1]"), "#PSET X -3 Y[10]\n");
  EXPECT_EQ(command("#CONTOUR MODE [DEV, PATH_DEV P1/10]"), "#CONTOUR MODE [DEV, PATH_DEV 1]\n");
  EXPECT_EQ(command("#SIGNAL [IDP1]"), "#SIGNAL [ID10]\n");
  EXPECT_EQ(command("#WAIT [IDP1 CHP1]"), "#WAIT [ID10 CH10]\n");
  EXPECT_EQ(command("#VECTOR LIMIT ON [VEL=-P2]"), "#VECTOR LIMIT ON [VEL=3]\n");
  EXPECT_EQ(command("#SLOPE [TYPE=STEP1]"), "#SLOPE [TYPE=STEP1]\n");
  EXPECT_EQ(command("#MSG [\"P1 %d\", P1]"), "#MSG [\"P1 %d\", 10]\n");
  EXPECT_EQ(refusal("P1=10\n#HSC [BSPLINE PATH_DEV 2*P1]\n"), std::pair(900308, 2U));
}

TEST(IsgCalls, NeedNoBlank) {
  ProgramSessionSetup setup = isg();
  setup.session.program.subprograms = {{"part2.nc", "XP1\nM17\n"}, {"4712", "Y1\n"}};
  EXPECT_EQ(flat_of("G0\nP1=2\nLPART2.NC\n", setup), "G0\n(PART2)\nX2\n");
  EXPECT_EQ(flat_of("G0\nL4712\nL 4712\n", setup), "G0\n(4712)\nY1\n(4712)\nY1\n");
  EXPECT_EQ(flat("%L 100\nX1\nM17\n%MAIN\nP1=1\nLL 100\nLL100\n"), "%MAIN\n(100)\nX1\n(100)\nX1\n");
  EXPECT_EQ(flat("P1=2\nG0 XP1\nLOTHER.NC\nG0 G90 X1\n"), "G0 X2\nP1 = 2\nLOTHER.NC\nG0 G90 X1\n");
  EXPECT_EQ(flat("P1=2\nG0 XP1\nT5 LM06\nG0 G90 X1\n"), "G0 X2\nP1 = 2\nT5 LM06\nG0 G90 X1\n");
  EXPECT_EQ(refusal_of("P1=2\nT5 LPART2\n", setup), std::pair(900003, 2U));
}

TEST(IsgCalls, MayEndTheProgram) {
  EXPECT_EQ(flat("%L A\nX1\nM30\nM17\n%MAIN\nP1=1\nLL A\nX2\nM30\n"), "%MAIN\n(A)\nX1\nM30\n");
  EXPECT_EQ(flat("P1=1\n$IF P1==1\nX1\nM30\n$ENDIF\nG42 G1 X5\nX9\nG40 X10\nM30\n"), "X1\nM30\n");
}

TEST(IsgCalls, OfWhatIsNotThereAreRefused) {
  EXPECT_EQ(refusal("G90 G00 X0\nLL TYPO\nX5\nM30\n"), std::pair(900306, 2U));
  EXPECT_EQ(refusal("P1=0\nLL V.L.N\nX5\nM30\n"), std::pair(900003, 2U));
  EXPECT_EQ(refusal("%L A\nX1\nM17\n%L A\nX2\nM17\n%MAIN\nLL A\nM30\n"), std::pair(900305, 8U));
}

TEST(IsgPrograms, LeaveAloneWhatComputesNothing) {
  const std::string comment = "#COMMENT BEGIN\nP1=5 $IF\n#COMMENT END\n";
  EXPECT_EQ(flat(comment + "P1=2\nXP1\n"), comment + "X2\n");
  const std::string plain = "N10 G71 (P1=5 [X])\n; $IF\n#MSG [\"P1=5\"]\nX1\n";
  EXPECT_EQ(flat(plain), plain);
}

TEST(IsgPrograms, ContinueTheirLines) {
  EXPECT_EQ(flat("P1=1\nG01 X P1 \\\nY P1 F100\nX3\n"), "G01 X 1  Y 1 F100\nX3\n");
}

// Other languages are named as before.
TEST(IsgPrograms, OfOtherLanguagesAreToldSo) {
  EXPECT_EQ(refusal("O1000\nG21 G90\nG83 X1 Y1 Z-5 R2 Q1 P500 F100\nM98 P1000\nM30\n").first,
            900016);
}

class IsgTwins : public Twins {};

TEST_P(IsgTwins, MakeTheSamePath) {
  const ProgramRun computed = to_blocks(twin().computed, setup());
  const ProgramRun written = to_blocks(twin().flat, setup());
  ASSERT_FALSE(computed.stopped) << computed.report();
  ASSERT_FALSE(written.stopped) << written.report();
  ASSERT_EQ(computed.blocks.size(), written.blocks.size());
  for (std::size_t index = 0; index < written.blocks.size(); ++index) {
    const Point here = end_of(computed.blocks[index].path);
    const Point there = end_of(written.blocks[index].path);
    EXPECT_NEAR(here.x(), there.x(), 1e-6) << index;
    EXPECT_NEAR(here.y(), there.y(), 1e-6) << index;
  }
  for (const std::size_t piece : {1U, 7U, 64U}) {
    const ProgramRun cut = to_text(twin().computed, setup(), piece);
    EXPECT_EQ(cut.text, to_text(twin().computed, setup()).text) << piece;
  }
}

std::string squares(const std::vector<double>& depths) {
  std::string text = "G90 G00 X-20 Y-20\n";
  for (const double depth : depths)
    text +=
        "G00 Z" + number(depth) + "\nG41 G138 G01 X0 Y0 F500\nY40\nX60\nY0\nX0\nG40 X-20 Y-20\n";
  return text + "M30\n";
}

INSTANTIATE_TEST_SUITE_P(
    Programs, IsgTwins,
    ::testing::ValuesIn(with_setup(
        {{"PolygonByFor",
          "%HEX\nP1=6 P2=30\nG90 G00 X60 Y0\nG42 G138 G01 XP2 Y0 F400\n$FOR P3=1,P1,1\n"
          "X[P2*COS[-360/P1*P3]] Y[P2*SIN[-360/P1*P3]]\n$ENDFOR\nG40 X60 Y0\nM30\n",
          polygon(6, 30, "G42 G138")},
         {"DepthsByWhile",
          "P5=0\nG90 G00 X-20 Y-20\n$WHILE P5 < 6\nP5=P5+2\n"
          "G00 Z-P5\nG41 G138 G01 X0 Y0 F500\nY40\nX60\nY0\nX0\nG40 X-20 Y-20\n"
          "$ENDWHILE\nM30\n",
          squares({-2, -4, -6})},
         {"DepthsByASubprogram",
          "%L SQUARE\nN1 G00 Z-P1\nN2 G41 G138 G01 X0 Y0 F500\nN3 YP11\nN4 XP10\nN5 Y0\nN6 X0\n"
          "N7 G40 X-20 Y-20\nN8 M17\n%MAIN\nN10 P10=60 P11=40\nN20 G90 G00 X-20 Y-20\n"
          "N30 P1=1\nN40 LL SQUARE\nN50 P1=3\nN60 LL SQUARE\nN70 M30\n",
          squares({-1, -3})}},
        DialectName::isg)),
    name_of_twin);

}  // namespace
}  // namespace trc::support::isg_computing
