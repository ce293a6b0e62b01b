// The programs of the commissioning documents and of the rule book: NC text in, NC text out.

#include <gtest/gtest.h>

#include "tests/support/program_run.h"

namespace trc::support {
namespace {

// T-01, as the reference manual prints it.
TEST(WorkedPrograms, WithoutBlockThenBothAxes) {
  const ProgramRun run = to_text(
      "%G239_Demo1.nc\n"
      "N010 G0 X0 Y0 Z0 F1000\n"
      "N020 G239 (TRC mode)\n"
      "N030 V.G.WZ_AKT.R = 10\n"
      "N040 G41 G01 X30 Y20 (Select TRC)\n"
      "N050 G01 X60\n"
      "N060 G01 X90\n"
      "N070 G01 X120\n"
      "N080 G40 (Deselect TRC without block)\n"
      "N100 G00 X150 Y0\n"
      "N110 M30\n");
  EXPECT_FALSE(run.stopped) << run.codes();
  EXPECT_EQ(run.text,
            "%G239_Demo1.nc\n"
            "N010 G0 X0 Y0 Z0 F1000\n"
            "N020 (TRC mode)\n"
            "N040 G01 X30 Y30 (Select TRC)\n"
            "N050 G01 X60 Y30\n"
            "N060 G01 X90 Y30\n"
            "N070 G01 X120 Y30\n"
            "N080 (Deselect TRC without block)\n"
            "N100 G00 X150 Y0\n"
            "N110 M30\n");
}

// T-02: the second axis stays where the equidistant has ended.
TEST(WorkedPrograms, WithoutBlockThenOneAxis) {
  const ProgramRun run = to_text(
      "N010 G0 X0 Y0 Z0 F1000\n"
      "N020 G239\n"
      "N030 V.G.WZ_AKT.R = 10\n"
      "N040 G41 G01 X30 Y20\n"
      "N050 G01 X60\n"
      "N070 G01 X120\n"
      "N080 G40\n"
      "N090 G00 X150\n"
      "N100 G00 X200\n"
      "N110 M30\n");
  EXPECT_FALSE(run.stopped) << run.codes();
  EXPECT_EQ(run.text,
            "N010 G0 X0 Y0 Z0 F1000\n"
            "N040 G01 X30 Y30\n"
            "N050 G01 X60 Y30\n"
            "N070 G01 X120 Y30\n"
            "N090 G00 X150\n"
            "N100 G00 X200\n"
            "N110 M30\n");
}

std::string reselected(const std::string& lines) {
  return "N010 G0 X0 Y0 Z0 F1000\n"
         "N020 G239\n"
         "N030 V.G.WZ_AKT.R = 10\n"
         "N040 G41 G01 X30 Y20\n"
         "N070 G01 X120\n"
         "N080 G40\n"
         "(Y is not programmed again)\n" +
         lines;
}

std::string after_first_contour(const std::string& lines) {
  return "N010 G0 X0 Y0 Z0 F1000\n"
         "N040 G01 X30 Y30\n"
         "N070 G01 X120 Y30\n"
         "(Y is not programmed again)\n" +
         lines;
}

// T-03, the three ways to select again.
TEST(WorkedPrograms, SelectedAgainFromTheEquidistant) {
  EXPECT_EQ(to_text(reselected("N090 G41 G01 X150\nN100 G00 X200\nN110 M30\n")).text,
            after_first_contour("N090 G01 X150 Y40\nN100 G00 X200 Y40\nN110 M30\n"));
  EXPECT_EQ(
      to_text(reselected("N090 G41 G01 X150\nN100 G00 X200 Y20\nN110 M30\n")).text,
      after_first_contour("N090 G01 X151.9612 Y39.8058\nN100 G00 X201.9612 Y29.8058\nN110 M30\n"));
  EXPECT_EQ(to_text(reselected("N090 G41 G01 X150 Y20\nN100 G00 X200\nN110 G40\nN120 M30\n")).text,
            after_first_contour("N090 G01 X150 Y30\nN100 G00 X200 Y30\nN120 M30\n"));
}

// T-04: an arc from where G239 has left the tool does not fit its centre.
TEST(WorkedPrograms, ArcAfterDeselectionWithoutBlock) {
  const ProgramRun run = to_text(
      "N005 G162\n"
      "N010 G0 X0 Y0 Z0 F1000\n"
      "N020 G239\n"
      "N030 V.G.WZ_AKT.R = 30\n"
      "N040 G41 G01 X30 Y20\n"
      "N050 G01 X60\n"
      "N060 G01 X90\n"
      "N070 G40\n"
      "N080 G02 X140 Y-30 J-50\n"
      "N100 G00 X200\n");
  EXPECT_TRUE(run.stopped);
  EXPECT_EQ(run.codes(), "20035 at line 9");
}

std::string stretched(const std::string& factor, const std::string& transition = "G25") {
  return "N10 G139 " + transition +
         "\n"
         "N20 V.G.WZ_AKT.R=5\n"
         "N30 #TRC[STRETCH_FACTOR=" +
         factor +
         "]\n"
         "N40 G0 X0 Y0\n"
         "N50 G41 F10000\n"
         "N60 G1 X10 Y20\n"
         "N70 X35 Y30\n"
         "N80 X30 Y20\n"
         "N90 Y10\n"
         "N100 G40\n"
         "N110 X20 Y0\n"
         "N120 G0 X0 Y0\n"
         "N130 M30\n";
}

std::string stretched_result(const std::string& corner) {
  return "N40 G0 X0 Y0\n"
         "N50 F10000\n"
         "N60 G01 X6.378 Y23.9364\n" +
         corner +
         "N90 G01 X35 Y7.9289\n"
         "N110 G01 X20 Y0\n"
         "N120 G0 X0 Y0\n"
         "N130 M30\n";
}

// T-09: how far the sides of a sharp outside corner are stretched.
TEST(WorkedPrograms, StretchFactor) {
  EXPECT_EQ(to_text(stretched("1")).text, stretched_result("N70 G01 X37.7854 Y36.4993\n"
                                                           "G01 X41.7082 Y32.2361\n"
                                                           "N80 G01 X35 Y18.8197\n"));
  EXPECT_EQ(to_text(stretched("2")).text, stretched_result("N70 G01 X42.4278 Y38.3563\n"
                                                           "G01 X43.9443 Y36.7082\n"
                                                           "N80 G01 X35 Y18.8197\n"));
  for (const char* factor : {"3", "4", "9"})
    EXPECT_EQ(to_text(stretched(factor)).text, stretched_result("N70 G01 X45.3534 Y39.5265\n"
                                                                "N80 G01 X35 Y18.8197\n"));
}

TEST(WorkedPrograms, StretchFactorOutOfRangeIsOne) {
  for (const char* factor : {"0", "10"}) {
    const ProgramRun run = to_text(stretched(factor));
    EXPECT_EQ(run.text, to_text(stretched("1")).text);
    EXPECT_EQ(run.codes(), "22007 at line 3");
  }
}

TEST(WorkedPrograms, SharpCornerWithCircularTransition) {
  EXPECT_EQ(to_text(stretched("1", "G26")).text,
            "N40 G0 X0 Y0\n"
            "N50 F10000\n"
            "N60 G01 X5.5279 Y22.2361\n"
            "G02 X8.143 Y24.6424 I4.4721 J-2.2361\n"
            "N70 G01 X33.143 Y34.6424\n"
            "G02 X39.4721 Y27.7639 I1.857 J-4.6424\n"
            "N80 G01 X35 Y18.8197\n"
            "N90 G01 X35 Y10\n"
            "G02 X33.5355 Y6.4645 I-5 J0\n"
            "N110 G01 X20 Y0\n"
            "N120 G0 X0 Y0\n"
            "N130 M30\n");
}

}  // namespace
}  // namespace trc::support
