#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/programs/computing.h"

// Variables that outlive the program (D-88, D-89): what it sets comes out at its end, and what
// hangs on the values that the control itself holds is computed by the control, in its place.

namespace trc::support::kept {
namespace {

constexpr DialectName isg = DialectName::isg;
constexpr DialectName fanuc = DialectName::fanuc;
constexpr DialectName linuxcnc = DialectName::linuxcnc;
constexpr DialectName sinumerik = DialectName::sinumerik;

ProgramSessionSetup with(DialectName dialect, std::map<std::string, double> variables) {
  ProgramSessionSetup setup = computing_setup(dialect);
  for (const auto& [name, value] : variables) setup.session.program.variables[name] = value;
  return setup;
}

std::string flat(const std::string& text, DialectName dialect) {
  return flat_of(text, computing_setup(dialect));
}

// Given or not, and read again as it comes out.
void expect_kept(const std::string& text, const std::string& expected, DialectName dialect,
                 const std::string& counter) {
  EXPECT_EQ(flat(text, dialect), expected);
  EXPECT_EQ(flat_of(text, with(dialect, {{counter, 7}})), expected);
  EXPECT_EQ(flat(expected, dialect), expected);
}

TEST(KeptVariables, CountersAreRaisedByTheControl) {
  expect_kept("G90 G0 X0 Y0\n#1=2\nN5 #500=#500+1 (PARTS)\n#500 = [#500-#1*-1]/#[#1+498]\nM30\n",
              "G90 G0 X0 Y0\nN5 #500=#500+1 (PARTS)\n#500=[#500-2.*-1]/#500\nM30\n", fanuc, "#500");
  expect_kept("G90 G0 X0 Y0\n#<n>=2\n#<_parts>=[#<_parts>+1] (PARTS)\nX5 #31=[#31-#<n>]\nM2\n",
              "G90 G0 X0 Y0\n#<_parts>=[#<_parts>+1]\n(PARTS)\n#31=[#31-2]\nX5\nM2\n", linuxcnc,
              "#<_parts>");
  expect_kept("DEF INT N=-2\nG90 G0 X0 Y0\nR100=R100+1 ; PARTS\nR[100]=R100*N\nM30\n",
              "G90 G0 X0 Y0\nR100=R100+1\n; PARTS\nR100=R100*(-2)\nM30\n", sinumerik, "R100");
  expect_kept("P1 = 2\nG90 G0 X0 Y0\nV.S.PARTS = V.S.PARTS + P1\nV.E.SUM += P1\nM30\n",
              "G90 G0 X0 Y0\nV.S.PARTS = V.S.PARTS + 2\nV.E.SUM += 2\nM30\n", isg, "V.S.PARTS");
}

TEST(KeptVariables, OfTheControlAreRaisedByIt) {
  const std::string parts = "G90 G0 X0 Y0\n$AC_ACTUAL_PARTS=$AC_ACTUAL_PARTS+1\nM30\n";
  EXPECT_EQ(flat(parts, sinumerik), parts);
  EXPECT_EQ(flat("G90 G0 X0 Y0\nR1=2\n$AC_PARAM[2]=$AC_PARAM[2]*R1\nM30\n", sinumerik),
            "G90 G0 X0 Y0\n$AC_PARAM[2]=$AC_PARAM[2]*2\nM30\n");
}

TEST(KeptVariables, ComeOutAtTheEnd) {
  EXPECT_EQ(flat("G90 G0 X0 Y0\n#1=5\n#100=1\n#501=#1*2\nX#501\n#501=12\nM30\n", fanuc),
            "G90 G0 X0 Y0\nX10.\n#501=12.\nM30\n");
  EXPECT_EQ(flat("G90 G0 X0 Y0\n#500=1\n%\n", fanuc), "G90 G0 X0 Y0\n#500=1.\n%\n");
  EXPECT_EQ(flat("G90 G0 X0 Y0\n#31=1\n#<a>=2\n#<_side>=3\nM2\n", linuxcnc), "G90 G0 X0 Y0\nM2\n");
  EXPECT_EQ(flat("G90 G0 X0 Y0\nR1=5\nX=R1\nR1=R1+1\nM30\n", sinumerik),
            "G90 G0 X0 Y0\nX=5\nM30\n");
}

// A value that the control computes is unknown here unless it is given.
TEST(KeptVariables, AreRefusedWhereAPathHangsOnThem) {
  EXPECT_EQ(flat("G90 G0 X0 Y0\n#500=#500+1\nX#500\nM30\n", fanuc),
            "3: 900303 a variable is read that has no value: #500\n");
  EXPECT_EQ(flat("G90 G0 X0 Y0\n#31=[#31+1]\nX#31\nM2\n", linuxcnc),
            "3: 900303 a variable is read that has no value: #31\n");
  EXPECT_EQ(flat("G90 G0 X0 Y0\nR1=R1+1\nX=R1\nM30\n", sinumerik),
            "3: 900303 a variable is read that has no value: R1\n");
  EXPECT_EQ(flat("G90 G0 X0 Y0\nV.S.A = V.S.A + 1\nX[V.S.A]\nM30\n", isg),
            "3: 900303 a variable is read that has no value: V.S.A\n");
  EXPECT_EQ(flat_of("G90 G0 X0 Y0\n#500=#500+1\nX#500\nM30\n", with(fanuc, {{"#500", 4}})),
            "G90 G0 X0 Y0\n#500=#500+1\nX5.\nM30\n");
}

// By way of a variable that does not come out the number would be the same in each run.
TEST(KeptVariables, AreToldWhereAGivenValueStaysInThem) {
  const auto told = [](const std::string& text, const ProgramSessionSetup& setup) {
    return to_text(text, setup).report();
  };
  const std::string warning =
      ": 900228 a variable that the control keeps is set to a number that "
      "was computed from values given for the machine: ";
  EXPECT_EQ(told("G90 G0 X0 Y0\n#1=#500+1\n#500=#1\n#500=#1\nM30\n", with(fanuc, {{"#500", 7}})),
            "3" + warning + "#500\n");
  EXPECT_EQ(told("G90 G0 X0 Y0\n#500=#5021\nM30\n", with(fanuc, {{"#5021", 7}})),
            "2" + warning + "#500\n");
  EXPECT_EQ(told("G90 G0 X0 Y0\n#1=#31\n#31=#1\nM2\n", with(linuxcnc, {{"#31", 7}})),
            "3" + warning + "#31\n");
  EXPECT_EQ(told("DEF REAL A\nG90 G0 X0 Y0\nA=R1\nR1=A+1\nM30\n", with(sinumerik, {{"R1", 7}})),
            "4" + warning + "R1\n");
  EXPECT_EQ(told("G90 G0 X0 Y0\nP1=V.S.A\nV.S.A=P1\nM30\n", with(isg, {{"V.S.A", 7}})),
            "3" + warning + "V.S.A\n");
}

}  // namespace
}  // namespace trc::support::kept
