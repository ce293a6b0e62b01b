#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/messages/diagnostic_text.h"
#include "tests/support/program_run.h"

namespace trc::support {
namespace {

// A slot 8 mm, then one 0.3 inch wide, both too narrow; the path is known blocks later.
constexpr std::string_view two_units =
    "N10 G71 G141 V.G.WZ_AKT.R=5\n"
    "N20 G01 X0 Y-20 F1000\n"
    "N30 G41 X0 Y0\n"
    "N40 X50\nN50 Y-30\nN60 X58\nN70 Y0\nN80 X120\nN90 G40 Y-20\n"
    "N100 G70 X0 Y-1\n"
    "N110 G41 X0 Y0\n"
    "N120 X2\nN130 Y-1\nN140 X2.3\nN150 Y0\nN160 X5\nN170 G40 Y-1\n"
    "N180 G71\nN190 M30\n";

TEST(DiagnosticUnit, IsThatOfItsLineAlsoWhereTheProgramHasGoneOn) {  // D-46
  for (const std::size_t piece : {1U, 30U, 0U}) {
    const std::vector<Diagnostic> found = to_text(two_units, {}, piece).diagnostics;
    ASSERT_FALSE(found.empty());
    bool mm = false;
    bool inch = false;
    for (const Diagnostic& one : found) {
      EXPECT_EQ(one.inch, one.source.number >= 100 && one.source.number < 180)
          << one.source.number << ": " << message_of(one);
      mm = mm || !one.inch;
      inch = inch || one.inch;
    }
    EXPECT_TRUE(mm);
    EXPECT_TRUE(inch);
  }
}

TEST(DiagnosticUnit, IsThatOfTheSetupBeforeTheProgramSays) {
  ProgramSessionSetup setup;
  setup.session.program.inch = true;
  const auto found = to_text("N10 G02 X1 Y0 I0.2 J2 F10\nN20 M30\n", setup).diagnostics;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, Code::circle_center_misfit);
  EXPECT_NE(message_of(found[0]).find("start radius 2.0100 in"), std::string::npos)
      << message_of(found[0]);
  EXPECT_EQ(found[0].detail, "I0.2 J2, X0 Y0 → X1 Y0");
}

// The diagnostic of a circle whose words do not fit together has their values.
TEST(DiagnosticWords, AreThoseOfTheCircle) {
  const auto detail_of = [](const std::string& text, DialectName dialect) {
    ProgramSessionSetup setup;
    setup.session.program.dialect = dialect;
    const auto found = to_text(text, setup).diagnostics;
    return found.empty() ? std::string() : found[0].detail;
  };
  using enum DialectName;
  EXPECT_EQ(detail_of("N10 G0 X0 Y20\nN20 G2 X20 Y40 I25 J0 F9\nM30\n", isg),
            "I25 J0, X0 Y20 → X20 Y40");
  EXPECT_EQ(detail_of("N10 G18 G0 X0 Z20\nN20 G2 X20 Z40 I25 K0 F9\nM30\n", isg),
            "K0 I25, Z20 X0 → Z40 X20");
  EXPECT_EQ(detail_of("G0 X0 Y20\nG2 X20 Y40 R5 F9\nM30\n", fanuc), "X0 Y20 → X20 Y40");
  EXPECT_EQ(detail_of("0 BEGIN PGM A MM\n1 L X+0 Y+20 F9\n2 CC X+25 Y+20\n3 C X+20 Y+40 DR-\n"
                      "4 END PGM A MM\n",
                      heidenhain),
            "CC X25 Y20, X0 Y20 → X20 Y40");
}

TEST(DiagnosticUnit, IsInchUnderG20OfFanucFromItsLineOn) {
  ProgramSessionSetup setup;
  setup.session.program.dialect = DialectName::fanuc;
  const auto found =
      to_text("N10 G0 X0 Y0\nN20 G20\nN30 G02 X1 Y0 I0.2 J2 F10\nN40 M30\n", setup).diagnostics;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(message_of(found[0]).find("2.0100 in"), std::string::npos) << message_of(found[0]);
}

TEST(DiagnosticLanguage, IsThatOfTheSetup) {
  ProgramSessionSetup setup;
  setup.session.language = Language::german;
  const auto found = to_text("N10 G1 X10,5\n", setup).diagnostics;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].language, Language::german);
  EXPECT_EQ(help_of(found[0], found[0].language), "Dezimalpunkt statt Komma schreiben: X10.5.");
}

TEST(DiagnosticWords, AreThoseOfTheDialect) {
  const auto help = [](DialectName dialect, std::string_view program) {
    ProgramSessionSetup setup;
    setup.session.program.dialect = dialect;
    setup.session.program.mode.tool_radius = 6;
    const auto found = to_text(program, setup).diagnostics;
    return found.empty() ? std::string() : help_of(found.back(), found.back().language);
  };
  // A slot 9 mm wide.
  EXPECT_NE(help(DialectName::fanuc,
                 "G0 X0. Y-20.\nG41 G1 X0. Y0. F500.\nX20.\nY-30.\nX29.\nY0.\nX60.\n"
                 "G40 Y-20.\nM30\n")
                .find("The setting contour_masking"),
            std::string::npos);
  EXPECT_NE(help(DialectName::isg,
                 "G0 X0 Y-20\nG41 G1 X0 Y0 F500\nX20\nY-30\nX29\nY0\nX60\nG40 Y-20\nM30\n")
                .find("#TRC [REMOVE_MASKED_BLOCKS=1]"),
            std::string::npos);
  EXPECT_EQ(help(DialectName::heidenhain,
                 "0 BEGIN PGM A MM\n1 L X+0 Y-20 R0 FMAX\n2 L X+0 Y+0 RL F500\n3 L X+20\n"
                 "4 L X+40 Y+20 RR\n5 L X+60 R0\n6 END PGM A MM\n")
                .find("G4"),
            std::string::npos);
}

}  // namespace
}  // namespace trc::support
