#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/programs/computing.h"
#include "tests/programs/twins.h"

namespace trc::support::linuxcnc_computing {
namespace {

ProgramSessionSetup linuxcnc() { return computing_setup(DialectName::linuxcnc); }

std::string flat(const std::string& text) { return flat_of(text, linuxcnc()); }

std::string value_of(const std::string& expression) {
  const std::string text = flat("#31=3.5\n#32=-2\nG0 X[" + expression + "]\n");
  return text.starts_with("G0 X") ? text.substr(4, text.size() - 5) : text;
}

TEST(LinuxcncExpressions, KeepTheOrderOfTheirOperators) {
  EXPECT_EQ(value_of("1+2*3"), "7");
  EXPECT_EQ(value_of("2 ** 3 * 2"), "16");
  EXPECT_EQ(value_of("10-4-3"), "3");
  EXPECT_EQ(value_of("#31-#32"), "5.5");
  EXPECT_EQ(value_of("1 GT 0 AND 2 LT 1"), "0");
  EXPECT_EQ(value_of("5 AND 2"), "1");
  EXPECT_EQ(value_of("5 XOR 2"), "0");
  EXPECT_EQ(value_of("0 OR -1"), "1");
  EXPECT_EQ(value_of("-7 MOD 3"), "2");
  EXPECT_EQ(value_of("1 EQ 1.0000001"), "1");
  EXPECT_EQ(value_of("1 LT 1.0000001"), "1");
}

TEST(LinuxcncExpressions, KnowTheFunctions) {
  EXPECT_EQ(value_of("sin[30]"), "0.5");
  EXPECT_EQ(value_of("ATAN[-1]/[-1]"), "-135");
  EXPECT_EQ(value_of("ASIN[-0.5]"), "-30");
  EXPECT_EQ(value_of("FIX[-2.8]"), "-3");
  EXPECT_EQ(value_of("FUP[-2.8]"), "-2");
  EXPECT_EQ(value_of("ROUND[2.5]"), "3");
  EXPECT_EQ(value_of("SQRT[2.25]"), "1.5");
  EXPECT_EQ(value_of("EXISTS[#<_none>]"), "0");
  EXPECT_EQ(value_of("EXISTS[#31]"), "1");
  EXPECT_EQ(value_of("#<_metric>"), "1");
  EXPECT_EQ(value_of("#<_incremental>"), "0");
}

TEST(LinuxcncExpressions, RefuseExistsOfWhatIsNoParameter) {
  EXPECT_EQ(refusal_of("#1=[EXISTS[5]]\nG0 X#1\nM2\n", linuxcnc()), std::pair(900308, 1U));
  EXPECT_EQ(refusal_of("#1=EXISTS[\nG0 X#1\nM2\n", linuxcnc()), std::pair(900308, 1U));
  EXPECT_EQ(refusal_of("#1=[EXISTS[#2\nG0 X#1\nM2\n", linuxcnc()), std::pair(900308, 1U));
}

TEST(LinuxcncPrograms, HaveNoMotionFunctionAfterG80) {
  const std::string head = "G21 G90 G17\nG0 X0 Y0 Z5\nG81 Z-5 R2 F100\nG80\n";
  const std::string contour = "X10 Y0\nY20\nX40\nG40 X60\nM2\n";
  EXPECT_EQ(refusal_of(head + "G41.1 D4 " + contour, linuxcnc()), std::pair(900019, 5U));
  EXPECT_EQ(refusal_of(head + "G41.1 D4 G1 F300 " + contour, linuxcnc()), std::pair(0, 0U));
}

TEST(LinuxcncPrograms, HaveBothCentreWordsUnderG901) {
  const std::string head = "G21 G90 G17 G90.1 F200\nG0 X20 Y-10\nG42.1 D4 G1 X20 Y0\nY10\n";
  const std::string end = "G1 Y0\nG40 Y-10\nM2\n";
  EXPECT_EQ(refusal_of(head + "G3 X0 Y10 I10 J10\n" + end, linuxcnc()), std::pair(0, 0U));
  EXPECT_EQ(refusal_of(head + "G3 X0 Y10 I10\n" + end, linuxcnc()), std::pair(900101, 5U));
  EXPECT_EQ(refusal_of(head + "G3 X0 Y10 J10\n" + end, linuxcnc()), std::pair(900101, 5U));
}

// QtPlasmaC's filter reads the text before the control.
TEST(LinuxcncPrograms, KeepWhatAFilterLooksFor) {
  EXPECT_EQ(flat("#<pierce-only>=1\n#<holes> = 4\n#<other>=3\nG0 X#<other>\nM2\n"),
            "#<pierce-only>=1\n#<holes>=4\nG0 X3\nM2\n");
}

TEST(LinuxcncPrograms, LoseNoContourAfterTheirEnd) {
  const std::string contour = "G0 X-20 Y-20\nG41.1 D4 G1 X0 Y0 F300\nY40\nG40 X80\n";
  EXPECT_EQ(refusal_of("#31=5\nG0 X#31\nM2\n" + contour + "M2\n", linuxcnc()),
            std::pair(900015, 5U));
  EXPECT_EQ(refusal_of("#31=5\nG0 X#31\nM2\nO100\n" + contour + "M99\n", linuxcnc()),
            std::pair(0, 0U));
}

TEST(LinuxcncParameters, TakeTheirValueAfterTheLine) {
  EXPECT_EQ(flat("#3=15\n#3=6 G0 X#3\nG0 X#3\n"), "G0 X15\nG0 X6\n");
  EXPECT_EQ(flat("#31=1 #32=2\n#31=#32 #32=#31 (SWAPPED)\nG0 X#31 Y#32\n"),
            "(SWAPPED)\nG0 X2 Y1\n");
}

TEST(LinuxcncParameters, HaveNamesWithoutBlanksAndCase) {
  EXPECT_EQ(flat("#<Cut Depth> = -2\nG0 Z#<cutdepth>\n"), "G0 Z-2\n");
  EXPECT_EQ(flat("#31=40\n#40=7\nG0 X##31\n"), "G0 X7\n");
}

TEST(LinuxcncParameters, BelongToTheirSubOrToAll) {
  EXPECT_EQ(flat("#1=5 #<a>=6 #<_all>=7\no100 sub\n#1=8\n#<a>=9\n#<_all>=10\nG0 X#2\no100 endsub\n"
                 "#2=3\no100 call [1] [4]\nG0 X#1 Y#<a> Z#<_all>\n"),
            "(o100)\nG0 X4\nG0 X5 Y6 Z10\n");
}

TEST(LinuxcncParameters, AreZeroInASubThatIsNotGivenThem) {
  EXPECT_EQ(flat("o1 sub\nG1 X#1 Y#2\no1 endsub\n#1=1 #2=9\no1 call [5]\nG1 X#1 Y#2\n"),
            "(o1)\nG1 X5 Y0\nG1 X1 Y9\n");
}

TEST(LinuxcncParameters, AreEqualWithinATenThousandth) {  // D-48
  const std::string branch = "o1 if [#1 EQ 1]\nG1 X1\no1 else\nG1 X2\no1 endif\n";
  EXPECT_EQ(flat("#1=1.00005\n" + branch), "G1 X1\n");
  EXPECT_EQ(flat("#1=1.0002\n" + branch), "G1 X2\n");
  EXPECT_EQ(flat("#1=1.00005\no1 if [#1 GT 1]\nG1 X3\no1 endif\nG1 X4\n"), "G1 X3\nG1 X4\n");
}

TEST(LinuxcncParameters, HaveTheValuesOfTheSetup) {
  ProgramSessionSetup setup = linuxcnc();
  setup.session.program.variables = {{"#5221", 12.5}, {"#<_probe_z>", -3}};
  EXPECT_EQ(flat_of("G0 X#5221 Z#<_Probe_Z>\n", setup), "G0 X12.5 Z-3\n");
}

TEST(LinuxcncStatements, Choose) {
  const auto chosen = [](int value) {
    return flat("#1=" + std::to_string(value) +
                "\no1 if [#1 EQ 1]\nG0 X1\no1 elseif [#1 EQ 2]\nG0 X2\no1 elseif [#1 EQ 3]\nG0 X3\n"
                "o1 else\nG0 X4\no1 endif\nG0 Y1\n");
  };
  EXPECT_EQ(chosen(1), "G0 X1\nG0 Y1\n");
  EXPECT_EQ(chosen(2), "G0 X2\nG0 Y1\n");
  EXPECT_EQ(chosen(3), "G0 X3\nG0 Y1\n");
  EXPECT_EQ(chosen(4), "G0 X4\nG0 Y1\n");
}

TEST(LinuxcncStatements, Loop) {
  EXPECT_EQ(flat("#1=0\no1 while [#1 LT 3]\nG0 X#1\n#1=[#1+1]\no1 endwhile\nG0 Y1\n"),
            "G0 X0\nG0 X1\nG0 X2\nG0 Y1\n");
  EXPECT_EQ(flat("#1=5\no1 do\nG0 X#1\n#1=[#1+1]\no1 while [#1 LT 7]\nG0 Y1\n"),
            "G0 X5\nG0 X6\nG0 Y1\n");
  EXPECT_EQ(flat("G91\no1 repeat [3]\nG0 X1\no1 endrepeat\no2 repeat [0]\nG0 X9\no2 endrepeat\n"),
            "G91\nG0 X1\nG0 X1\nG0 X1\n");
}

TEST(LinuxcncStatements, LeaveLoopsAndGoOn) {
  EXPECT_EQ(flat("#1=0\no1 while [1]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\n"
                 "o3 if [#1 GT 4]\no1 break\no3 endif\nG0 X#1\no1 endwhile\nM2\n"),
            "G0 X1\nG0 X3\nG0 X4\nM2\n");
  EXPECT_EQ(flat("#1=0\no1 do\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\nG0 X#1\n"
                 "o1 while [#1 LT 3]\nM2\n"),
            "G0 X1\nG0 X3\nM2\n");
  EXPECT_EQ(flat("#1=0\no1 repeat [5]\n#1=[#1+1]\no2 if [#1 EQ 3]\no1 break\no2 endif\nG0 X#1\n"
                 "o1 endrepeat\nM2\n"),
            "G0 X1\nG0 X2\nM2\n");
}

TEST(LinuxcncCalls, ReturnValuesAndFindTheirSub) {
  EXPECT_EQ(flat("o<area> sub\no<area> endsub [#1*#2]\no<area> call [3] [4]\nG0 X#<_value>\n"),
            "(o<area>)\nG0 X12\n");
  EXPECT_EQ(flat("o100 sub\no1 if [#1 GT 5]\no100 return [1]\no1 endif\nG0 Y#1\no100 endsub\n"
                 "o100 call [6]\nG0 X#<_value_returned>\no[50*2] call [2]\n"),
            "(o100)\nG0 X1\n(o100)\nG0 Y2\n");
  ProgramSessionSetup setup = linuxcnc();
  setup.session.program.subprograms["square.ngc"] = "o<square> sub\nG0 X#1\no<square> endsub\nM2\n";
  EXPECT_EQ(flat_of("o<square> call [7]\nM2\n", setup), "(o<square>)\nG0 X7\nM2\n");
}

TEST(LinuxcncParameters, HaveTheDiameterOfTheToolInTheSpindle) {
  ProgramSessionSetup setup = linuxcnc();
  setup.session.program.tools = {{3, {2.5, 0.25}}};
  EXPECT_EQ(flat_of("G21\nT3 M6\nG0 X#5410\nM2\n", setup), "G21\nT3 M6\nG0 X5.5\nM2\n");
  EXPECT_EQ(refusal_of("G21\nT3\nG0 X#5410\nM2\n", setup), std::pair(900307, 3U));
  EXPECT_EQ(refusal_of("G21\nT4 M6\nG0 X#5410\nM2\n", setup), std::pair(900307, 3U));
  // The table counts in the unit of the machine, which G20 does not change.
  EXPECT_EQ(refusal_of("G20\nT3 M6\nG0 X#5410\nM2\n", setup), std::pair(900307, 3U));
  setup.session.program.variables["5410"] = 7;
  EXPECT_EQ(flat_of("G21\nT3 M6\nG0 X#5410\nM2\n", setup), "G21\nT3 M6\nG0 X7\nM2\n");
}

TEST(LinuxcncCalls, OfNumberedProgramsShareParameters) {
  EXPECT_EQ(flat("o1 (MAIN)\n#1=0\nM98 P100 L2\nM98 P100 L0\nG0 Y#1\nM30\no100\n#1=[#1+1]\nG0 X#1\n"
                 "M99\n"),
            "o1 (MAIN)\n(o100)\nG0 X1\n(o100)\nG0 X2\nG0 Y2\nM30\n");
}

TEST(LinuxcncRefusals, NameTheirLine) {
  struct Refusal {
    std::string text{};
    Code code{};
    std::uint32_t line = 0;
  };
  const std::vector<Refusal> refusals{
      {"G0 X#31\n", Code::variable_unset, 1},
      {"G0 X#<depth>\n", Code::variable_unset, 1},
      {"G0 X#5420\n", Code::machine_state, 1},
      {"G0 X#<_x>\n", Code::machine_state, 1},
      {"#5221=0\n", Code::machine_state, 1},
      {"#1=[1/0]\n", Code::division_by_zero, 1},
      {"#1=ATAN[1]\n", Code::expression_invalid, 1},
      {"#1=1+2\n", Code::expression_invalid, 1},
      {"o100 call\n", Code::subprogram_unknown, 1},
      {"M98 P100\n", Code::subprogram_unknown, 1},
      {"o100 endwhile\n", Code::block_structure, 1},
      {"o100 if [0]\nG0 X1\n", Code::block_structure, 1},
      {"o100 while [1]\nG0 X1\n", Code::block_structure, 1},
      {"o100 endsub\n", Code::block_structure, 1},
      {"o100 sub\n", Code::block_structure, 1},
      {"o100 jump\n", Code::expression_invalid, 1},
      {"o100 if #1\no100 endif\n", Code::expression_invalid, 1},
      {"o100 sub\no100 call\no100 endsub\no100 call\n", Code::calls_too_deep, 2},
  };
  for (const Refusal& refusal : refusals) {
    SCOPED_TRACE(refusal.text);
    const ProgramRun ran = to_text(refusal.text, linuxcnc(), 0, German::as_it_is);
    ASSERT_EQ(ran.diagnostics.size(), 1u) << ran.report() << ran.text;
    EXPECT_EQ(ran.diagnostics[0].code, refusal.code) << ran.report();
    EXPECT_EQ(ran.diagnostics[0].source.line, refusal.line);
  }
}

std::string holes(int count, double radius) {
  std::string text = "G21 G90\nG0 Z5\n";
  for (int hole = 0; hole < count; ++hole) {
    const double angle = 360.0 / count * hole;
    text += "G0 " + word('X', radius * cosine(angle)) + word('Y', radius * sine(angle)) +
            "\nG1 Z-3 F100\nG0 Z5\n";
  }
  return text + "M2\n";
}

std::string ellipse(double a, double b, double step) {
  std::string text = "G90 G0 X40 Y-10\nG42 G1 " + word('X', a) + " Y-10 F400\n";
  for (double angle = 0; angle < 360 + 1e-9; angle += step)
    text += "G1 " + word('X', a * cosine(angle)) + word('Y', b * sine(angle)) + "\n";
  return text + "G1 " + word('X', a) + "Y10\nG40 X50 Y10\nM2\n";
}

const std::string square_sub =
    "o100 sub\n#10=[#1/2]\nG0 Z#2\nG41 G1 X-#10 Y-#10 F500\nY#10\nX#10\nY-#10\nX-#10\nG40 X0 Y-40\n"
    "o100 endsub\n";

std::vector<Twin> twins() {
  const std::string begin = "G90 G0 X0 Y-40\n";
  std::vector<Twin> all;
  all.push_back({.name = "BoltCircle",
                 .computed = "G21 G90\nG0 Z5\n#<n>=8 #<r>=30 #<k>=0\no1 while [#<k> LT #<n>]\n"
                             "#<w>=[360/#<n>*#<k>]\nG0 X[#<r>*COS[#<w>]] Y[#<r>*SIN[#<w>]]\n"
                             "G1 Z-3 F100\nG0 Z5\n#<k>=[#<k>+1]\no1 endwhile\nM2\n",
                 .flat = holes(8, 30)});
  all.push_back({.name = "BoltCircleByRepeat",
                 .computed = "G21 G90\nG0 Z5\n#1=0\no1 repeat [5]\nG0 X[22*COS[#1]] Y[22*SIN[#1]]\n"
                             "G1 Z-3 F100\nG0 Z5\n#1=[#1+72]\no1 endrepeat\nM2\n",
                 .flat = holes(5, 22)});
  all.push_back({.name = "BoltCircleByADo",
                 .computed = "G21 G90\nG0 Z5\n#1=0\no1 do\nG0 X[22*COS[#1*60]] Y[22*SIN[#1*60]]\n"
                             "G1 Z-3 F100\nG0 Z5\n#1=[#1+1]\no1 while [#1 LT 6]\nM2\n",
                 .flat = holes(6, 22)});
  all.push_back({.name = "BoltCircleOfAGivenAngle",
                 .computed =
                     "G21 G90\nG0 Z5\no<hole> sub\nG0 X[#2*COS[#1]] Y[#2*SIN[#1]]\nG1 Z-3 F100\n"
                     "G0 Z5\no<hole> endsub\n#1=0\no1 while [#1 LT 360]\no<hole> call [#1] [18]\n"
                     "#1=[#1+90]\no1 endwhile\nM2\n",
                 .flat = holes(4, 18)});
  all.push_back({.name = "SquaresBySub",
                 .computed = begin + square_sub + "o100 call [40] [-1]\no100 call [30] [-2]\nM2\n",
                 .flat = begin + square(40, -1) + square(30, -2) + "M2\n"});
  all.push_back({.name = "SquaresInALoop",
                 .computed = begin + square_sub +
                             "#31=40\no1 while [#31 GT 15]\no100 call [#31] [#31-41]\n"
                             "#31=[#31-10]\no1 endwhile\nM2\n",
                 .flat = begin + square(40, -1) + square(30, -11) + square(20, -21) + "M2\n"});
  all.push_back({.name = "DepthPasses",
                 .computed = begin + square_sub +
                             "#<depth>=-1.5\no1 while [#<depth> GE -6]\no100 call [30] [#<depth>]\n"
                             "#<depth>=[#<depth>-1.5]\no1 endwhile\nM2\n",
                 .flat = begin + square(30, -1.5) + square(30, -3) + square(30, -4.5) +
                         square(30, -6) + "M2\n"});
  all.push_back({.name = "DepthPassesByPrograms",
                 .computed = begin +
                             "#1=0\nM98 P7 L3\nM2\no7\n#1=[#1-2]\nG0 Z#1\nG41 G1 X-10 Y-10 F500\n"
                             "Y10\nX10\nY-10\nX-10\nG40 X0 Y-40\nM99\n",
                 .flat = begin + square(20, -2) + square(20, -4) + square(20, -6) + "M2\n"});
  all.push_back(
      {.name = "NestedCalls",
       .computed = begin + square_sub +
                   "o200 sub\no100 call [#1] [#2]\no100 call [#1-10] [#2-1]\no200 endsub\n"
                   "o200 call [40] [-1]\no200 call [35] [-5]\nM2\n",
       .flat = begin + square(40, -1) + square(30, -2) + square(35, -5) + square(25, -6) + "M2\n"});
  all.push_back({.name = "EllipseByALoop",
                 .computed = "G90 G0 X40 Y-10\n#<a>=30 #<b>=18\nG42 G1 X#<a> Y-10 F400\n#1=0\n"
                             "o1 while [#1 LE 360]\nG1 X[#<a>*COS[#1]] Y[#<b>*SIN[#1]]\n#1=[#1+5]\n"
                             "o1 endwhile\nG1 X#<a> Y10\nG40 X50 Y10\nM2\n",
                 .flat = ellipse(30, 18, 5)});
  all.push_back({.name = "EllipseByRepeat",
                 .computed =
                     "G90 G0 X40 Y-10\nG42 G1 X25 Y-10 F400\n#1=0\no1 repeat [49]\n"
                     "G1 X[25*COS[#1]] Y[20*SIN[#1]]\n#1=[#1+7.5]\no1 endrepeat\nG1 X25 Y10\n"
                     "G40 X50 Y10\nM2\n",
                 .flat = ellipse(25, 20, 7.5)});
  all.push_back({.name = "NestedLoops",
                 .computed =
                     "G21 G90\n#1=0\no1 while [#1 LT 3]\n#2=0\no2 while [#2 LT 2]\n"
                     "G0 X[#1*10] Y[#2*5]\n#2=[#2+1]\no2 endwhile\n#1=[#1+1]\no1 endwhile\nM2\n",
                 .flat = "G21 G90\nG0 X0 Y0\nG0 X0 Y5\nG0 X10 Y0\nG0 X10 Y5\nG0 X20 Y0\nG0 X20 Y5\n"
                         "M2\n"});
  all.push_back(
      {.name = "ChoiceOfASize",
       .computed = begin + square_sub +
                   "#<kind>=2\no1 if [#<kind> EQ 1]\n#<size>=10\no1 elseif [#<kind> EQ 2]\n"
                   "#<size>=30\no1 else\n#<size>=20\no1 endif\no100 call [#<size>] [-1]\nM2\n",
       .flat = begin + square(30, -1) + "M2\n"});
  all.push_back({.name = "RoundPocketWithArcs",
                 .computed = "G90 G0 X0 Y0\n#<r>=15\nG41 G1 X#<r> Y0 F300\nG3 X#<r> Y0 I-#<r>\n"
                             "G40 G1 X0 Y0\nM2\n",
                 .flat = "G90 G0 X0 Y0\nG41 G1 X15 Y0 F300\nG3 X15 Y0 I-15\nG40 G1 X0 Y0\nM2\n"});
  all.push_back(
      {.name = "Inches",
       .computed = "G20 G90 G0 X0 Y-2\n#<s>=[1/2]\nG41 G1 X-#<s> Y-#<s> F20\nY#<s>\nX#<s>\n"
                   "Y-#<s>\nX-#<s>\nG40 X0 Y-2\nM2\n",
       .flat = "G20 G90 G0 X0 Y-2\nG41 G1 X-.5 Y-.5 F20\nY.5\nX.5\nY-.5\nX-.5\nG40 X0 Y-2\n"
               "M2\n"});
  all.push_back(
      {.name = "ValueOfASub",
       .computed = begin + square_sub +
                   "o<half> sub\no<half> return [#1/2]\no<half> endsub\no<half> call [60]\n"
                   "o100 call [#<_value>] [-1]\nM2\n",
       .flat = begin + square(30, -1) + "M2\n"});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Linuxcnc, Twins,
                         ::testing::ValuesIn(with_setup(twins(), DialectName::linuxcnc)),
                         name_of_twin);

// What they print is there for whoever reads it: the written program has no parameters (D-84).
TEST(LinuxcncMessages, HaveTheValuesOfParameters) {
  EXPECT_EQ(flat("#1=12.4 #<Depth>=-3\n(print,#1 and #<depth>, %d #1 %.2f#1 %f #1)\n"
                 "G0 X#1 ( DEBUG, #<depth> #<_unset> #5420)\n(msg, #1)\n(X#1)\n#1=7 (log,#1)\n"
                 "o1 if [#1 GT 0] (print,#1)\no1 endif\nM2\n"),
            "(print,12.400000 and -3.000000, %d 12 %.2f12.40 %f 12.4000)\n"
            "G0 X12.4 ( DEBUG, -3.000000 #<_unset> #5420)\n(msg, #1)\n(X#1)\n(log,7.000000)\n"
            "(print,7.000000)\nM2\n");
}

TEST(LinuxcncExpressions, StandInPolarWords) {
  EXPECT_EQ(flat("#1=12\nG0 @#1 ^[360/17*17]\nG90 G0 X0 Y0\nM2\n"),
            "G0 @12 ^360\nG90 G0 X0 Y0\nM2\n");
}

}  // namespace
}  // namespace trc::support::linuxcnc_computing
