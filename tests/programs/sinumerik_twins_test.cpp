#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/programs/computing.h"
#include "tests/programs/twins.h"

// Programs as they are written on the shop floor, each beside its path worked out here.

namespace trc::support::sinumerik_computing {
namespace {

std::string hole(double x, double y) {
  return "G0 X" + number(x) + " Y" + number(y) + "\nG1 Z-3 F100\nG0 Z5\n";
}

std::string holes(int count, double radius, double first = 0) {
  std::string text = "G17 G71 G90\nG0 Z5\n";
  for (int place = 0; place < count; ++place) {
    const double angle = first + 360.0 / count * place;
    text += hole(radius * cosine(angle), radius * sine(angle));
  }
  return text + "M30\n";
}

std::string ellipse(double a, double b, double step) {
  std::string text = "G90 G0 X50 Y-10\nG42 G1 X" + number(a) + " Y-10 F400\n";
  for (double angle = 0; angle < 360 + 1e-9; angle += step)
    text += "G1 X" + number(a * cosine(angle)) + " Y" + number(b * sine(angle)) + "\n";
  return text + "G1 X" + number(a) + " Y10\nG40 X50 Y10\nM30\n";
}

std::string zigzag(int rows, double step, double length) {
  std::string text = "G90 G0 X0 Y0 Z2\nG1 Z-1 F200\n";
  for (int row = 0; row < rows; ++row)
    text += "G1 Y" + number(row * step) + "\nX" + number(row % 2 == 0 ? length : 0) + "\n";
  return text + "G0 Z50\nM30\n";
}

std::string grid(int columns, int rows, double dx, double dy) {
  std::string text = "G17 G71 G90\nG0 Z5\n";
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) text += hole(column * dx, row * dy);
  return text + "M30\n";
}

const std::string begin_of_holes = "G17 G71 G90\nG0 Z5\n";
const std::string drill = "G1 Z-3 F100\nG0 Z5\n";
const std::string begin = "G90 G0 X0 Y-40\n";
const std::string square_proc =
    "PROC SQUARE(REAL SIZE, REAL DEPTH=-1)\nDEF REAL H\nH=SIZE/2\nG0 Z=DEPTH\n"
    "G41 G1 X=-H Y=-H F500\nY=H\nX=H\nY=-H\nX=-H\nG40 X0 Y-40\nRET\n";
const std::string square_by_parameters =
    "%_N_L100_SPF\nR50=R10/2\nG0 Z=R11\nG41 G1 X=-R50 Y=-R50 F500\nY=R50\nX=R50\nY=-R50\nX=-R50\n"
    "G40 X0 Y-40\nM17\n";

std::vector<Twin> hole_patterns() {
  std::vector<Twin> all;
  all.push_back({.name = "BoltCircleByFor",
                 .computed = begin_of_holes +
                             "DEF INT I, N=8\nFOR I=0 TO N-1\n"
                             "G0 X=30*COS(360/N*I) Y=30*SIN(360/N*I)\n" +
                             drill + "ENDFOR\nM30\n",
                 .flat = holes(8, 30)});
  all.push_back({.name = "BoltCircleByWhile",
                 .computed = begin_of_holes +
                             "R1=22 R2=0 R3=5\nWHILE R2<R3\nR4=R2*360/R3\n"
                             "G0 X=R1*COS(R4) Y=R1*SIN(R4)\n" +
                             drill + "R2=R2+1\nENDWHILE\nM30\n",
                 .flat = holes(5, 22)});
  all.push_back({.name = "BoltCircleByUntil",
                 .computed = begin_of_holes + "R2=15\nREPEAT\nG0 X=18*COS(R2) Y=18*SIN(R2)\n" +
                             drill + "R2=R2+90\nUNTIL R2>=375\nM30\n",
                 .flat = holes(4, 18, 15)});
  all.push_back(
      {.name = "BoltCircleByLoop",
       .computed = begin_of_holes +
                   "R2=0\nLOOP\nIF R2==6 GOTOF READY\nG0 X=22*COS(R2*60) Y=22*SIN(R2*60)\n" +
                   drill + "R2=R2+1\nENDLOOP\nREADY: M30\n",
       .flat = holes(6, 22)});
  all.push_back({.name = "BoltCircleByGotob",
                 .computed = begin_of_holes + "R2=12 R3=0\nN100 G0 X=40*COS(R3) Y=40*SIN(R3)\n" +
                             drill + "R3=R3+30 R2=R2-1\nIF R2>0 GOTOB N100\nM30\n",
                 .flat = holes(12, 40)});
  all.push_back({.name = "BoltCircleBySubprogram",
                 .computed = begin_of_holes +
                             "FOR R1=0 TO 2\nHOLE(R1*120,25)\nENDFOR\nM30\n"
                             "PROC HOLE(REAL ANGLE, REAL RADIUS)\n"
                             "G0 X=RADIUS*COS(ANGLE) Y=RADIUS*SIN(ANGLE)\n" +
                             drill + "RET\n",
                 .flat = holes(3, 25)});
  all.push_back({.name = "HolesFromAnArray",
                 .computed = begin_of_holes +
                             "DEF REAL PX[3]=SET(10,25,-7.5)\nDEF REAL PY[3]=(0,4,8)\nDEF INT I\n"
                             "FOR I=0 TO 2\nG0 X=PX[I] Y=PY[I]\n" +
                             drill + "ENDFOR\nM30\n",
                 .flat = begin_of_holes + hole(10, 0) + hole(25, 4) + hole(-7.5, 8) + "M30\n"});
  all.push_back({.name = "HolesFromATable",
                 .computed = begin_of_holes +
                             "DEF REAL P[2,2]\nDEF INT I\nP[0,0]=SET(1,2,30,40)\nFOR I=0 TO 1\n"
                             "G0 X=P[I,0] Y=P[I,1]\n" +
                             drill + "ENDFOR\nM30\n",
                 .flat = begin_of_holes + hole(1, 2) + hole(30, 40) + "M30\n"});
  all.push_back({.name = "HolesFromParameters",
                 .computed = begin_of_holes +
                             "R10=5 R11=15 R12=45\nFOR R1=10 TO 12\nG0 X=R[R1] Y=R[R1]/5\n" +
                             drill + "ENDFOR\nM30\n",
                 .flat = begin_of_holes + hole(5, 1) + hole(15, 3) + hole(45, 9) + "M30\n"});
  all.push_back(
      {.name = "Grid",
       .computed = begin_of_holes +
                   "DEF INT ROW, COL\nFOR ROW=0 TO 2\nFOR COL=0 TO 3\nG0 X=COL*12 Y=ROW*8\n" +
                   drill + "ENDFOR\nENDFOR\nM30\n",
       .flat = grid(4, 3, 12, 8)});
  all.push_back({.name = "GridByDivAndMod",
                 .computed = begin_of_holes +
                             "DEF INT K\nFOR K=0 TO 5\nG0 X=(K MOD 3)*10 Y=(K DIV 3)*15\n" + drill +
                             "ENDFOR\nM30\n",
                 .flat = grid(3, 2, 10, 15)});
  all.push_back({.name = "HolesOfABitPattern",
                 .computed = begin_of_holes +
                             "DEF INT K, BIT=1, PATTERN='B1011'\nFOR K=0 TO 3\n"
                             "IF (PATTERN B_AND BIT)<>0\nG0 X=K*10 Y0\n" +
                             drill + "ENDIF\nBIT=BIT*2\nENDFOR\nM30\n",
                 .flat = begin_of_holes + hole(0, 0) + hole(10, 0) + hole(30, 0) + "M30\n"});
  all.push_back({.name = "HolesByRepeatedPart",
                 .computed = begin_of_holes + "R1=0\nNEXT_HOLE: R1=R1+10\nG0 X=R1 Y=R1\n" + drill +
                             "REPEAT NEXT_HOLE P=3\nM30\n",
                 .flat = begin_of_holes + hole(10, 10) + hole(20, 20) + hole(30, 30) +
                         hole(40, 40) + "M30\n"});
  all.push_back({.name = "HolesAtAMeasuredAngle",
                 .computed = begin_of_holes +
                             "R1=ATAN2(30,40) R2=SQRT(POT(30)+POT(40))\n"
                             "G0 X=R2*COS(R1) Y=R2*SIN(R1)\n" +
                             drill + "G0 X=ROUND(12.4) Y=TRUNC(-7.9)\n" + drill + "M30\n",
                 .flat = begin_of_holes + hole(40, 30) + hole(12, -7) + "M30\n"});
  return all;
}

std::vector<Twin> squares() {
  std::vector<Twin> all;
  all.push_back({.name = "SquaresByProc",
                 .computed = begin + "SQUARE(40,-1)\nSQUARE(30,-2)\nM30\n" + square_proc,
                 .flat = begin + square(40, -1) + square(30, -2) + "M30\n"});
  all.push_back({.name = "SquareOfTheUsualDepth",
                 .computed = begin + "R1=20\nSQUARE(R1*1.5)\nM30\n" + square_proc,
                 .flat = begin + square(30, -1) + "M30\n"});
  all.push_back(
      {.name = "SquareByNumber",
       .computed = begin + "R10=40 R11=-2\nL100\nR10=20\nL100\nM30\n" + square_by_parameters,
       .flat = begin + square(40, -2) + square(20, -2) + "M30\n"});
  all.push_back({.name = "DepthPassesByP",
                 .computed = begin +
                             "R10=30 R11=0\nL200 P3\nM30\n%_N_L200_SPF\nR11=R11-1.5\nL100\nM17\n" +
                             square_by_parameters,
                 .flat = begin + square(30, -1.5) + square(30, -3) + square(30, -4.5) + "M30\n"});
  all.push_back({.name = "DepthPassesByWhile",
                 .computed = begin +
                             "DEF REAL DEPTH=0\nWHILE DEPTH>-6\nDEPTH=DEPTH-2\nSQUARE(30,DEPTH)\n"
                             "ENDWHILE\nM30\n" +
                             square_proc,
                 .flat = begin + square(30, -2) + square(30, -4) + square(30, -6) + "M30\n"});
  all.push_back(
      {.name = "LastPassToTheFullDepth",
       .computed = begin +
                   "R1=0\nLOOP\nR1=MAXVAL(R1-2.5,-6)\nSQUARE(30,R1)\nIF R1<=-6 GOTOF OUT\n"
                   "ENDLOOP\nOUT:\nM30\n" +
                   square_proc,
       .flat = begin + square(30, -2.5) + square(30, -5) + square(30, -6) + "M30\n"});
  all.push_back({.name = "NestedCalls",
                 .computed = begin +
                             "PAIR(40,-1)\nPAIR(35,-5)\nM30\nPROC PAIR(REAL SIZE, REAL DEPTH)\n"
                             "SQUARE(SIZE,DEPTH)\nSQUARE(SIZE-10,DEPTH-1)\nRET\n" +
                             square_proc,
                 .flat = begin + square(40, -1) + square(30, -2) + square(35, -5) + square(25, -6) +
                         "M30\n"});
  all.push_back({.name = "SizeGivenBack",
                 .computed = begin +
                             "DEF REAL SIZE=20\nLARGER(SIZE,1.5)\nSQUARE(SIZE)\nM30\n"
                             "PROC LARGER(VAR REAL V1, REAL BY)\nV1=V1*BY\nRET\n" +
                             square_proc,
                 .flat = begin + square(30, -1) + "M30\n"});
  all.push_back({.name = "ChoiceByCase",
                 .computed = begin +
                             "R1=2\nCASE R1 OF 1 GOTOF SMALL 2 GOTOF LARGE DEFAULT GOTOF DONE\n"
                             "SMALL: SQUARE(10)\nGOTOF DONE\nLARGE: SQUARE(30)\nDONE: M30\n" +
                             square_proc,
                 .flat = begin + square(30, -1) + "M30\n"});
  all.push_back({.name = "ChoiceByIf",
                 .computed = begin +
                             "DEF BOOL ROUGH=TRUE\nDEF REAL SIZE\nIF ROUGH AND NOT FALSE\n"
                             "IF SIZE==0\nSIZE=30\nELSE\nSIZE=10\nENDIF\nELSE\nSIZE=20\nENDIF\n"
                             "SQUARE(SIZE)\nM30\n" +
                             square_proc,
                 .flat = begin + square(30, -1) + "M30\n"});
  all.push_back({.name = "SquareOfIncrements",
                 .computed = begin +
                             "R1=30 R2=R1/2\nG0 Z-1\nG41 G1 X=-R2 Y=-R2 F500\nY=IC(R1)\nX=IC(R1)\n"
                             "Y=IC(-R1)\nX=IC(-R1)\nG40 X=AC(0) Y=AC(-R1-10)\nM30\n",
                 .flat = begin + square(30, -1) + "M30\n"});
  all.push_back(
      {.name = "RoundedSquare",
       .computed = begin + "R1=15 R2=4\nG0 Z-1\nG41 G1 X=-R1 Y=-R1 F500\nY=R1 RND=R2\nX=R1 RND=R2\n"
                           "Y=-R1 RND=R2/2\nX=-R1\nG40 X0 Y-40\nM30\n",
       .flat = begin + "G0 Z-1\nG41 G1 X-15 Y-15 F500\nY15 RND=4\nX15 RND=4\nY-15 RND=2\nX-15\n"
                       "G40 X0 Y-40\nM30\n"});
  all.push_back(
      {.name = "Inches",
       .computed = "G70 G90 G0 X0 Y-2\nR1=1/2\nG41 G1 X=-R1 Y=-R1 F20\nY=R1\nX=R1\nY=-R1\nX=-R1\n"
                   "G40 X0 Y-2\nM30\n",
       .flat = "G70 G90 G0 X0 Y-2\nG41 G1 X-.5 Y-.5 F20\nY.5\nX.5\nY-.5\nX-.5\nG40 X0 Y-2\n"
               "M30\n"});
  return all;
}

std::vector<Twin> contours() {
  std::vector<Twin> all;
  all.push_back({.name = "EllipseByFor",
                 .computed = "DEF INT K\nDEF REAL HALF_X=30, HALF_Y=18\nG90 G0 X50 Y-10\n"
                             "G42 G1 X=HALF_X Y-10 F400\nFOR K=0 TO 72\n"
                             "G1 X=HALF_X*COS(K*5) Y=HALF_Y*SIN(K*5)\nENDFOR\n"
                             "G1 X=HALF_X Y10\nG40 X50 Y10\nM30\n",
                 .flat = ellipse(30, 18, 5)});
  all.push_back({.name = "EllipseByGotob",
                 .computed = "G90 G0 X50 Y-10\nR1=25 R2=20 R3=0\nG42 G1 X=R1 Y-10 F400\n"
                             "MA1: G1 X=R1*COS(R3) Y=R2*SIN(R3)\nR3=R3+7.5\n"
                             "IF R3<=360 GOTOB MA1\nG1 X=R1 Y10\nG40 X50 Y10\nM30\n",
                 .flat = ellipse(25, 20, 7.5)});
  for (const int corners : {5, 6, 8})
    all.push_back(
        {.name = "PolygonOf" + std::to_string(corners),
         .computed = "R1=" + std::to_string(corners) +
                     " R2=35\nG90 G0 X60 Y0\nG42 G1 X=R2 Y0 F400\nFOR R3=1 TO R1\n"
                     "X=R2*COS(-360/R1*R3) Y=R2*SIN(-360/R1*R3)\nENDFOR\nG40 X60 Y0\nM30\n",
         .flat = polygon(corners, 35)});
  all.push_back({.name = "Facing",
                 .computed =
                     "DEF INT ROW\nG90 G0 X0 Y0 Z2\nG1 Z-1 F200\nFOR ROW=0 TO 4\n"
                     "G1 Y=ROW*6\nIF ROW MOD 2==0\nX80\nELSE\nX0\nENDIF\nENDFOR\nG0 Z50\nM30\n",
                 .flat = zigzag(5, 6, 80)});
  all.push_back({.name = "RoundPocketInRings",
                 .computed = "G90 G0 X0 Y0\nR1=6\nWHILE R1<=18\nG41 G1 X=R1 Y0 F300\n"
                             "G3 X=R1 Y0 I=-R1 J0\nG40 G1 X0 Y0\nR1=R1+6\nENDWHILE\nM30\n",
                 .flat = "G90 G0 X0 Y0\nG41 G1 X6 Y0 F300\nG3 X6 Y0 I-6 J0\nG40 G1 X0 Y0\n"
                         "G41 G1 X12 Y0 F300\nG3 X12 Y0 I-12 J0\nG40 G1 X0 Y0\n"
                         "G41 G1 X18 Y0 F300\nG3 X18 Y0 I-18 J0\nG40 G1 X0 Y0\nM30\n"});
  all.push_back({.name = "SlotOfArcs",
                 .computed = "R1=40 R2=12\nG90 G0 X0 Y0\nG41 G1 X0 Y=R2 F300\nG3 Y=-R2 CR=R2\n"
                             "G1 X=R1\nG3 X=R1 Y=R2 CR=R2\nG1 X0\nG40 X0 Y0\nM30\n",
                 .flat =
                     "G90 G0 X0 Y0\nG41 G1 X0 Y12 F300\nG3 Y-12 CR=12\nG1 X40\nG3 X40 Y12 CR=12\n"
                     "G1 X0\nG40 X0 Y0\nM30\n"});
  all.push_back({.name = "CentresByAc",
                 .computed = "R1=20\nG90 G0 X40 Y-10\nG42 G1 X=R1 Y-10 F300\nY0\n"
                             "G3 X=-R1 Y0 I=AC(R1-20) J=AC(0)\nG1 Y-10\nG40 X-40\nM30\n",
                 .flat = "G90 G0 X40 Y-10\nG42 G1 X20 Y-10 F300\nY0\nG3 X-20 Y0 I-20 J0\nG1 Y-10\n"
                         "G40 X-40\nM30\n"});
  all.push_back({.name = "PolarHexagon",
                 .computed = "G90 G0 X60 Y0\nG111 X0 Y0\nR1=35\nG42 G1 RP=R1 AP=0 F400\n"
                             "FOR R2=1 TO 6\nRP=R1 AP=-60*R2\nENDFOR\nG40 X60 Y0\nM30\n",
                 .flat = polygon(6, 35)});
  all.push_back({.name = "TwoPartsByRepeat",
                 .computed =
                     "G90 G0 X0 Y-40\nG91\nPART: G41 G1 X-10 Y20 F500\nY20\nX20\nY-20\nX-20\n"
                     "G40 X10 Y-20\nPART_END: G0 X50\nREPEAT PART PART_END P=1\nG90 M30\n",
                 .flat = "G90 G0 X0 Y-40\nG91\nG41 G1 X-10 Y20 F500\nY20\nX20\nY-20\nX-20\n"
                         "G40 X10 Y-20\nG0 X50\nG41 G1 X-10 Y20 F500\nY20\nX20\nY-20\nX-20\n"
                         "G40 X10 Y-20\nG0 X50\nG90 M30\n"});
  return all;
}

INSTANTIATE_TEST_SUITE_P(SinumerikHoles, Twins,
                         ::testing::ValuesIn(with_setup(hole_patterns(), DialectName::sinumerik)),
                         name_of_twin);
INSTANTIATE_TEST_SUITE_P(SinumerikSquares, Twins,
                         ::testing::ValuesIn(with_setup(squares(), DialectName::sinumerik)),
                         name_of_twin);
INSTANTIATE_TEST_SUITE_P(SinumerikContours, Twins,
                         ::testing::ValuesIn(with_setup(contours(), DialectName::sinumerik)),
                         name_of_twin);

}  // namespace
}  // namespace trc::support::sinumerik_computing
