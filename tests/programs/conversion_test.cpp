#include "core/nc/convert/conversion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "core/nc/dialect/dialect.h"
#include "core/nc/text/number_format.h"
#include "tests/support/contours.h"
#include "tests/support/places.h"
#include "tests/support/program_run.h"
#include "tests/support/run.h"

// Plain programs written anew in another dialect: the same path, or each word named that means
// something else there.

namespace trc::support {
namespace {

std::string told(const ConvertedProgram& converted) {
  std::string all;
  for (const ConvertedProgram::Fault& fault : converted.faults)
    all += fault.word + ' ' + std::to_string(fault.line) + '\n';
  return all;
}

ConvertedProgram converted(const std::string& text, DialectName from, DialectName to) {
  ProgramSetup setup;
  setup.dialect = from;
  setup.decimals = 3;
  return convert_program(text, setup, to);
}

TEST(Conversion, SaysMotionsFeedsAndToolsInTheWordsOfTheOther) {
  const std::string fanuc =
      "%\nO0012 (PLATE)\nG17 G20 G90 G40 G49 G80\nT3 M06\nN1 G0 X1. Y2. S900 M3 (START)\nG91\n"
      "G1 X1. F10. M8\nG2 X1. Y-1. I0 J-1.\nG90 G1 G43 H3 Z-0.5\nG18\nM9\nM30\n%\n";
  EXPECT_EQ(converted(fanuc, DialectName::fanuc, DialectName::linuxcnc).text,
            "G17 G21 G40 G90 G91.1 G94\n(PLATE)\nT3 M6\nG00 X25.4 Y50.8 S900 M3 (START)\n"
            "G01 X50.8 F254 M8\nG02 X76.2 Y25.4 I0 J-25.4\nG43 H3\nG01 Z-12.7\nG18\nM9\nM30\n");
  const std::string plain = fanuc.substr(0, fanuc.find("G18")) + "M9\nM30\n%\n";
  EXPECT_EQ(converted(plain, DialectName::fanuc, DialectName::heidenhain).text,
            "BEGIN PGM CONVERTED MM\n; PLATE\nTOOL CALL 3 Z\nTOOL CALL Z S900\n"
            "L X+25.4 Y+50.8 FMAX M3 ; START\nL X+50.8 F254 M8\nCC X+50.8 Y+25.4\n"
            "C X+76.2 Y+25.4 DR-\nL Z-12.7\nM9\nM30\nEND PGM CONVERTED MM\n");
  const std::string klartext =
      "0 BEGIN PGM A MM\n1 TOOL CALL 4 Z S2000 F300\n2 L X+0 IY+5 R0 FMAX M3\n3 L X-4 F AUTO ; go\n"
      "4 CC X+6 Y+5\n5 C X+16 DR+\n6 L Z+2 M30\n7 END PGM A MM\n";
  EXPECT_EQ(told(converted(klartext, DialectName::heidenhain, DialectName::sinumerik)), "");
  EXPECT_EQ(converted(klartext, DialectName::heidenhain, DialectName::sinumerik).text,
            "G17 G71 G40 G90 G94\nT4 M6 S2000\nD1\nG00 X0 Y5 M3\nG01 X-4 F300 ; go\n"
            "G03 X16 Y5 I10 J0\nG01 Z2 M30\n");
}

TEST(Conversion, ChangesTheToolWhereSinumerikDoesByTAlone) {  // D-56, D-94
  const auto to = [](const std::string& text, DialectName other) {
    return converted(text, DialectName::sinumerik, other).text;
  };
  const std::string by_t = "T1 D1 S500 M3\nNORM CFC\nG0 X0 Y0\nT2 D1\nG1 X5 F100\nM30\n";
  EXPECT_EQ(to(by_t, DialectName::fanuc),
            "G17 G21 G40 G90 G94\nT1 M6 S500 M3\nG00 X0. Y0.\nT2 M6\nG01 X5. F100.\nM30\n");
  EXPECT_EQ(to(by_t, DialectName::heidenhain),
            "BEGIN PGM CONVERTED MM\nTOOL CALL 1 Z S500\nM3\nL X+0 Y+0 FMAX\nTOOL CALL 2 Z\n"
            "L X+5 F100\nM30\nEND PGM CONVERTED MM\n");
  EXPECT_EQ(to("T1\nM6\nG0 X0 Y0\nT2\nG1 X5 F100\nM30\n", DialectName::fanuc),
            "G17 G21 G40 G90 G94\nT1\nM6\nG00 X0. Y0.\nT2\nG01 X5. F100.\nM30\n");
}

TEST(Conversion, ChangesTheToolWhereAProgramHasNoM6) {  // D-40, D-94
  const std::string program = "T1\nG0 X1\nT2\nG0 X2\nM30\n";
  EXPECT_NE(converted(program, DialectName::fanuc, DialectName::linuxcnc).text.find("T2 M6"),
            std::string::npos);
  EXPECT_NE(converted(program, DialectName::isg, DialectName::heidenhain).text.find("TOOL CALL 2"),
            std::string::npos);
  EXPECT_EQ(converted(program, DialectName::linuxcnc, DialectName::fanuc).text.find("M6"),
            std::string::npos);
}

TEST(Conversion, MakesNoCommandOfAComment) {  // D-94
  const std::string text = "G0 X1\n(ABORT, IF THE VICE IS OPEN)\n(MESSAGE)\nM30\n";
  EXPECT_EQ(converted(text, DialectName::fanuc, DialectName::linuxcnc).text,
            "G17 G21 G40 G90 G91.1 G94\nG00 X1\n(- ABORT, IF THE VICE IS OPEN)\n(MESSAGE)\nM30\n");
}

// A plate milled outside with one tool and a round corner with another, spelled in a dialect.
class PlateProgram {
 public:
  PlateProgram(DialectName name, double width, double height, double corner)
      : klartext_(name == DialectName::heidenhain), fanuc_(name == DialectName::fanuc) {
    const bool twenty = fanuc_ || name == DialectName::linuxcnc;
    text_ = klartext_ ? "BEGIN PGM PLATE MM\n"
                      : std::string("G17 G90 G94 G40 ") + (twenty ? "G21\n" : "G71\n");
    for (const int tool : {1, 2}) {
      const std::string number = std::to_string(tool);
      text_ +=
          klartext_ ? "TOOL CALL " + number + " Z S3000\nL M3\n" : "T" + number + " M6\nS3000 M3\n";
      rapid("X", -30, " Y", -25);
      if (fanuc_ || name == DialectName::linuxcnc) text_ += "G43 H" + number + " ";
      if (name == DialectName::isg) text_ += "D" + number + " ";
      rapid("Z", 5);
      text_ += klartext_ ? "L Z-3 F200\n" : "G1 Z-3. F200\n";
      const std::string edge = name == DialectName::sinumerik ? "1" : number;
      feed(klartext_ ? "" : "G41 D" + edge + " ", 0, 0, klartext_ ? " RL F400" : " F400");
      feed("", 0, height - corner);
      arc(corner, height - corner, 0, height - corner, corner, height, true);
      feed("", width, height);
      feed("", width, 0);
      feed("", 0, 0);
      feed(klartext_ ? "" : "G40 ", -30, -25, klartext_ ? " R0" : "");
      rapid("Z", 50);
    }
    text_ += klartext_ ? "M30\nEND PGM PLATE MM\n" : "M30\n";
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  [[nodiscard]] static std::string number(double value) {
    std::ostringstream out;
    out << std::fixed << std::setprecision(3) << value;
    return out.str();
  }
  void rapid(const std::string& axis, double a, const std::string& second = {}, double b = 0) {
    text_ += (klartext_ ? "L " : "G0 ") + axis + number(a);
    if (!second.empty()) text_ += second + number(b);
    text_ += klartext_ ? " FMAX\n" : "\n";
  }
  void feed(const std::string& words, double x, double y, const std::string& behind = {}) {
    text_ +=
        (klartext_ ? "L " : words + "G1 ") + "X" + number(x) + " Y" + number(y) + behind + "\n";
  }
  void arc(double center_x, double center_y, double from_x, double from_y, double x, double y,
           bool clockwise) {
    const std::string end = "X" + number(x) + " Y" + number(y);
    if (klartext_)
      text_ += "CC X" + number(center_x) + " Y" + number(center_y) + "\nC " + end +
               (clockwise ? " DR-\n" : " DR+\n");
    else
      text_ += (clockwise ? "G2 " : "G3 ") + end + " I" + number(center_x - from_x) + " J" +
               number(center_y - from_y) + "\n";
  }

  bool klartext_;
  bool fanuc_;
  std::string text_{};
};

TEST(Conversion, HasTheDecimalsOfTheProgram) {  // D-180
  const std::string program = "G0 X1.123456 Y2\nG1 X3.12 F100\nM30\n";
  EXPECT_EQ(convert_program(program, {}, DialectName::linuxcnc).text,
            "G17 G21 G40 G90 G91.1 G94\nG00 X1.123456 Y2\nG01 X3.12 F100\nM30\n");
  EXPECT_NE(convert_program(program, {}, DialectName::heidenhain).text.find("X+1.12346"),
            std::string::npos);
}

TEST(Conversion, RefusesWhatTheControlDoesNotTake) {  // D-180
  const std::string comment(249, 'x');
  const std::string end = ")\nM30\n";
  EXPECT_EQ(told(convert_program("G0 X1\nM5 (" + comment + end, {}, DialectName::linuxcnc)), "");
  EXPECT_EQ(told(convert_program("G0 X1\nM5 (xy" + comment + end, {}, DialectName::linuxcnc)),
            "a line of 256 characters, of which the control takes 255 2\n");
  EXPECT_EQ(told(convert_program("G0 X1\nX123.4\nX123.456789\nM30\n", {}, DialectName::fanuc)),
            "a number of 9 digits, of which the control takes 8 3\n");
}

// Compensated and converted, a program is the same path in each dialect: written with 7 decimals,
// to 1e-6 mm, whichever dialect it has been written in.
TEST(Conversion, OfEveryPairOfDialectsIsTheSamePathTo1e6) {
  std::minstd_rand random(4711);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same in each run
  const auto between = [&](double low, double high) {
    const double share = static_cast<double>(random() - std::minstd_rand::min()) /
                         static_cast<double>(std::minstd_rand::max());
    return std::round((low + share * (high - low)) * 1000) / 1000;
  };
  constexpr double same = 1e-6;
  const auto expect_same = [&](const std::vector<CompensatedBlock>& path,
                               const std::vector<CompensatedBlock>& wanted,
                               const std::string& text) {
    ASSERT_EQ(path.size(), wanted.size()) << text;
    for (std::size_t k = 0; k < path.size(); ++k) {
      EXPECT_EQ(path[k].rapid, wanted[k].rapid) << text;
      EXPECT_NEAR(path[k].rapid ? 0 : path[k].feed - wanted[k].feed, 0, 1e-3) << text;
      for (const double t : {0.5, 1.0})
        EXPECT_LT((point_at(path[k].path, t) - point_at(wanted[k].path, t)).norm(), same)
            << k << '\n'
            << text;
      EXPECT_NEAR(path[k].normal.to, wanted[k].normal.to, same) << k << '\n' << text;
    }
  };
  for (int round = 0; round < 20; ++round) {
    const double width = between(40, 400);
    const double height = between(40, 400);
    const double corner = between(1, 20);
    std::vector<CompensatedBlock> first;
    for (const Dialect& from : all_dialects()) {
      const std::string text = PlateProgram(from.name, width, height, corner).text();
      ProgramSessionSetup setup;
      ProgramSetup& program = setup.session.program;
      program.decimals = 7;
      program.dialect = from.name;
      program.mode.selection = Selection::direct;
      program.mode.transition = Transition::circular;
      program.tools = {{1, 6.0}, {2, 4.125}};
      const ProgramRun written = to_text(text, setup);
      ASSERT_FALSE(written.stopped) << written.report() << text;
      const auto path = moving(to_blocks(text, setup).blocks, 1e-6);
      if (first.empty()) first = path;
      expect_same(path, first, text);
      for (const Dialect& to : all_dialects()) {
        if (to.name == from.name) continue;
        const ConvertedProgram converted = convert_program(written.text, program, to.name);
        ASSERT_EQ(told(converted), "") << from.spelling << " to " << to.spelling << '\n'
                                       << written.text;
        ProgramSessionSetup read;
        read.session.program.dialect = to.name;
        read.session.program.tools = program.tools;
        const ProgramRun again = to_blocks(converted.text, read);
        ASSERT_FALSE(again.stopped) << again.report() << converted.text;
        expect_same(moving(again.blocks, 1e-6), path, converted.text);
      }
    }
  }
}

// A plain program of lines and arcs in all three planes, with an axis that turns, in the words that
// all dialects of G code share.
std::string program_in_space(DialectName dialect, std::minstd_rand& random) {
  const auto below = [&](unsigned count) { return static_cast<unsigned>(random() % count); };
  const auto number = [&] { return static_cast<double>(random() % 200'000) / 1000 - 100; };
  std::ostringstream text;
  text << std::fixed << std::setprecision(3);
  const bool twenty = dialect == DialectName::fanuc || dialect == DialectName::linuxcnc;
  text << "G17 G90 G94 " << (twenty ? "G21" : "G71") << (dialect == DialectName::isg ? " G162" : "")
       << "\nG0 X0.5 Y0.5 Z0.5" << (below(2) == 0 ? " A0\nF200\n" : "\nF200\n");
  constexpr std::array<std::string_view, 3> planes{"G17", "G18", "G19"};
  constexpr std::array<std::string_view, 3> letters{"XYI", "ZXK", "YZJ"};
  std::array<double, 3> place{0.5, 0.5, 0.5};
  std::size_t plane = 0;
  for (int line = 0; line < 20; ++line) {
    if (below(3) == 0) {
      plane = below(3);
      text << planes[plane] << (below(2) == 0 ? "\n" : " ");
    }
    if (below(4) == 0) {  // half a turn
      const std::size_t first = plane == 0 ? 0 : plane == 1 ? 2 : 1;
      const std::size_t second = (first + 1) % 3;
      const double half = 1 + below(9);
      place[first] += 2 * half;
      text << (below(2) == 0 ? "G2 " : "G3 ") << letters[plane][0] << place[first] << ' '
           << letters[plane][1] << place[second] << ' ' << letters[plane][2] << half << '\n';
      continue;
    }
    text << (below(3) == 0 ? "G0" : "G1");
    const unsigned axes = 1 + below(7);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if ((axes >> axis & 1U) != 0) text << ' ' << "XYZ"[axis] << (place[axis] = number());
    if (below(5) == 0) text << " A" << (below(3) == 0 ? 0 : number());
    text << '\n';
  }
  text << "M30\n";
  return text.str();
}

// Selecting another plane does not change where the tool goes.
TEST(Conversion, OfProgramsInAllPlanesIsTheSamePathTo1e6) {
  std::minstd_rand random(20210);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same in each run
  constexpr double same = 1e-6;
  const auto end_of_turn = [](const CompensatedBlock& block) {
    return block.tracking.empty() ? 0 : block.tracking[0].to;
  };
  constexpr std::array dialects{DialectName::isg, DialectName::fanuc, DialectName::linuxcnc,
                                DialectName::sinumerik};
  for (int round = 0; round < 60; ++round) {
    const DialectName from = dialects[static_cast<std::size_t>(round) % dialects.size()];
    ProgramSessionSetup setup;
    setup.session.program.dialect = from;
    setup.session.program.decimals = 7;
    setup.session.program.tracking_axes = {"A"};
    const std::string text = program_in_space(from, random);
    const ProgramRun read = to_blocks(text, setup);
    ASSERT_FALSE(read.stopped) << read.report() << text;
    const auto wanted = moving(read.blocks, 1e-6);
    for (const DialectName to : dialects) {
      const ConvertedProgram converted = convert_program(text, setup.session.program, to);
      ASSERT_EQ(told(converted), "") << text;
      ProgramSessionSetup other = setup;
      other.session.program.dialect = to;
      const ProgramRun again = to_blocks(converted.text, other);
      ASSERT_FALSE(again.stopped) << again.report() << converted.text;
      const auto path = moving(again.blocks, 1e-6);
      ASSERT_EQ(path.size(), wanted.size()) << text << converted.text;
      for (std::size_t k = 0; k < path.size(); ++k) {
        EXPECT_EQ(path[k].rapid, wanted[k].rapid) << text << converted.text;
        EXPECT_NEAR(end_of_turn(path[k]), end_of_turn(wanted[k]), same) << text << converted.text;
        for (const double t : {0.5, 1.0})
          ASSERT_LT((point_in_space(path[k], t) - point_in_space(wanted[k], t)).norm(), same)
              << k << '\n'
              << text << converted.text;
      }
    }
  }
}

// What only the line says is said again: the table may stand at any angle.
TEST(Conversion, KeepsTheFirstWordOfAnAxisAlsoWhereItIsZero) {
  for (const DialectName to : {DialectName::isg, DialectName::fanuc, DialectName::linuxcnc,
                               DialectName::sinumerik, DialectName::heidenhain}) {
    ProgramSetup setup;
    setup.dialect = DialectName::fanuc;
    setup.decimals = 3;
    const std::string written =
        convert_program("T1 M6\nG0 A0\nG43 H1 G0 X0 Y0 Z5 B0 C90.\nM30\n", setup, to).text;
    for (const char* word : {"A[+]?0", "B[+]?0", "C[+]?90"})
      EXPECT_TRUE(std::regex_search(written, std::regex(std::string(" ") + word))) << written;
  }
}

// The feed before would stay in force.
TEST(Conversion, RefusesFeedsThatAreNoNumberPerMinute) {
  const auto with = [](const std::string& feed) {
    return "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S900\n2 L X+0 Y+0 FMAX\n3 L X+5 F400\n4 L X+9 " +
           feed + "\n5 L Y+9\n6 M30\n7 END PGM A MM\n";
  };
  for (const std::string feed : {"FZ0.1", "FU0.2", "FQ1", "F AUTO"})
    for (const DialectName to : {DialectName::fanuc, DialectName::isg, DialectName::sinumerik}) {
      const ConvertedProgram refused = converted(with(feed), DialectName::heidenhain, to);
      ASSERT_FALSE(refused.faults.empty()) << feed << refused.text;
      EXPECT_EQ(refused.faults[0].line, 5U) << feed;
      EXPECT_EQ(refused.faults[0].word.substr(0, 1), "F") << feed;
    }
  EXPECT_EQ(told(converted(with("F500"), DialectName::heidenhain, DialectName::fanuc)), "");
}

TEST(Conversion, SaysToolsSpeedsAndSwitchesAsTheyAreMeant) {
  const std::string next =
      converted("T2M06T3\nM6\nM30\n", DialectName::fanuc, DialectName::isg).text;
  EXPECT_NE(next.find("\nT2 M6\nT3\nM6\n"), std::string::npos) << next;
  const std::string called =
      converted("T2M06T3\nM6\nM30\n", DialectName::fanuc, DialectName::heidenhain).text;
  EXPECT_NE(called.find("TOOL CALL 2 Z\nTOOL CALL 3 Z\n"), std::string::npos) << called;
  EXPECT_EQ(told(converted("G50 S3000\nG0 X5\nM30\n", DialectName::fanuc, DialectName::fanuc)),
            "G50 with S, a limit of the speed 1\n");
  EXPECT_EQ(told(converted("0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S(VC=100)\n2 END PGM A MM\n",
                           DialectName::heidenhain, DialectName::fanuc)),
            "S(VC=100) of TOOL CALL 2\n");
  const std::string planes =
      converted("G18\nG3 X1 Z1 I1 K0 F9\nG17\nM30\n", DialectName::fanuc, DialectName::fanuc).text;
  EXPECT_EQ(std::count(planes.begin(), planes.end(), '8'), 1) << planes;
  for (const auto& [skip, word] :
       {std::pair{BlockSkip::execute, true}, std::pair{BlockSkip::leave_out, false}}) {
    ProgramSetup setup;
    setup.dialect = DialectName::fanuc;
    setup.block_skip = skip;
    const ConvertedProgram written =
        convert_program("G0 X5\n/M8\nG0 X6\nM30\n", setup, DialectName::isg);
    EXPECT_EQ(told(written), "");
    EXPECT_EQ(written.text.find("\nM8\n") != std::string::npos, word) << written.text;
  }
}

// A comment stays one: a bracket within it would end it, and words would follow.
TEST(Conversion, LeavesNoBracketInACommentInBrackets) {
  const std::string text = "N1 G0 X1 Y2 ; rapid) Z-100 (here\nN2 G1 X5 F100\nN3 M30\n";
  for (const DialectName to : {DialectName::fanuc, DialectName::linuxcnc, DialectName::isg}) {
    const std::string written = converted(text, DialectName::sinumerik, to).text;
    EXPECT_NE(written.find(" (rapid] Z-100 [here)\n"), std::string::npos) << written;
  }
  EXPECT_NE(converted(text, DialectName::sinumerik, DialectName::heidenhain)
                .text.find(" ; rapid) Z-100 (here\n"),
            std::string::npos);
}

TEST(Conversion, RefusesByNameWhatMeansSomethingElseThere) {
  for (const auto& [text, word] :
       std::vector<std::pair<std::string, std::string>>{{"G0 X1\nG54\nG0 X2\nM30\n", "G54"},
                                                        {"G0 X1\nG43 H1 Z5\nM30\n", "G43"},
                                                        {"G0 X1\nG4 P2\nM30\n", "G4"},
                                                        {"G0 X1\nM98 P1\nM30\n", "M98"},
                                                        {"G0 X1\nG81 X2 Z-3 R1\nM30\n", "G81"},
                                                        {"G0 X1\nM88\nM30\n", "M88"},
                                                        {"G0 X1\nG18\nM30\n", "G18"}}) {
    const ConvertedProgram refused = converted(text, DialectName::fanuc, DialectName::heidenhain);
    ASSERT_FALSE(refused.faults.empty()) << text;
    EXPECT_NE(refused.faults[0].word.find(word), std::string::npos) << text << told(refused);
    EXPECT_EQ(refused.faults[0].line, 2u) << text;
    EXPECT_EQ(refused.text, "") << text;
  }
}

// The words of a copied block of Klartext mean something only together.
TEST(Conversion, RefusesABlockOfKlartextOnce) {
  const auto refused = [](const std::string& lines) {
    return told(converted("0 BEGIN PGM A MM\n" + lines + "9 END PGM A MM\n",
                          DialectName::heidenhain, DialectName::fanuc));
  };
  EXPECT_EQ(refused("1 L M140 MB MAX ; up\n2 L Z-1 R0 FMAX M91\n3 L Z-1 R0 FMAX M91\n"),
            "L M140 MB MAX 2\nL Z-1 R0 FMAX M91 3\n");
  EXPECT_EQ(refused("1 CC X+10 Z+10\n2 L Z+5 F200 M25 M36\n"), "CC X+10 Z+10 2\nM25 3\nM36 3\n");
  EXPECT_EQ(refused("1 TOOL CALL \"MILL 8\" Z S200\n2 TOOL CALL\n"),
            "\"MILL 8\" of TOOL CALL 2\nTOOL CALL without a tool 3\n");
}

TEST(Conversion, TellsAllThatItRefusesAtOnce) {
  const std::string text =
      "G0 X1\nG54 G43 H1 Z5\nT1 G28 Z0 M6\nM6\nG81 X2 Z-3 R1\nG54\nG80\nG0 X1\nM30\n";
  EXPECT_EQ(told(converted(text, DialectName::fanuc, DialectName::heidenhain)),
            "G54 2\nG28 3\nZ0 3\nG81 5\nX2 5\nZ-3 5\nR1 5\n");
}

// D0 ends what D has begun, and another edge of Sinumerik has another length.
TEST(Conversion, LeavesOutTheRegisterOfTheRadiusAlone) {
  for (const auto& [from, word, goes_on] : std::vector<std::tuple<DialectName, std::string, bool>>{
           {DialectName::isg, "D3", true},
           {DialectName::isg, "D0", false},
           {DialectName::fanuc, "D21", true},
           {DialectName::fanuc, "D0", false},
           {DialectName::sinumerik, "D1", true},
           {DialectName::sinumerik, "D2", false},
           {DialectName::sinumerik, "D0", false}}) {
    ProgramSetup setup;
    setup.dialect = from;
    setup.tools = {{1, 1.0}, {3, 1.0}, {21, 1.0}};
    const ConvertedProgram written =
        convert_program("T1 M6\nG0 X1 " + word + "\nM30\n", setup, DialectName::linuxcnc);
    EXPECT_EQ(written.text.find('D'), std::string::npos) << written.text;
    EXPECT_EQ(told(written), goes_on ? "" : word + " 2\n");
  }
}

// What is told of the converted program, and its text; T1 and T2 have a radius.
std::string to(const std::string& text, DialectName from, DialectName other) {
  ProgramSetup setup;
  setup.dialect = from;
  setup.decimals = 3;
  setup.tools = {{1, 5.0}, {2, 5.0}};
  const ConvertedProgram written = convert_program(text, setup, other);
  return told(written) + written.text;
}

// The length of a tool is in force where it was, by the word that the other control has for it.
TEST(Conversion, KeepsTheLengthOfTheTool) {  // D-94
  const std::string by_d = "T1 M6\nD1\nS1000 M3\nG0 X-20 Y-20\nZ5\nG1 Z-5 F100\nM30\n";
  using enum DialectName;
  EXPECT_EQ(to(by_d, sinumerik, fanuc),
            "G17 G21 G40 G90 G94\nT1 M6\nS1000 M3\nG00 X-20. Y-20.\nG00 Z5. G43 H1\n"
            "G01 Z-5. F100.\nM30\n");
  EXPECT_EQ(to(by_d, sinumerik, linuxcnc),
            "G17 G21 G40 G90 G91.1 G94\nT1 M6\nG43 H1\nS1000 M3\nG00 X-20 Y-20\nG00 Z5\n"
            "G01 Z-5 F100\nM30\n");
  EXPECT_EQ(to(by_d, sinumerik, isg),
            "G17 G71 G40 G90 G94 G162\nT1 M6\nD1\nS1000 M3\nG00 X-20 Y-20\nG00 Z5\n"
            "G01 Z-5 F100\nM30\n");
  const std::string klartext =
      "BEGIN PGM A MM\nTOOL CALL 2 Z S900\nL X+0 Y+0 Z+5 R0 FMAX M3\nL Z-1 F100 M30\nEND PGM A "
      "MM\n";
  EXPECT_EQ(to(klartext, heidenhain, fanuc),
            "G17 G21 G40 G90 G94\nT2 M6 S900\nG00 X0. Y0. Z5. M3 G43 H2\nG01 Z-1. F100. M30\n");
  EXPECT_EQ(to(klartext, heidenhain, isg),
            "G17 G71 G40 G90 G94 G162\nT2 M6 S900\nD2\nG00 X0 Y0 Z5 M3\nG01 Z-1 F100 M30\n");
  const std::string by_g43 = "T1 M6\nG0 X1. Y2.\nG43 H1 Z5.\nG49 Z50.\nM30\n";
  EXPECT_EQ(to(by_g43, fanuc, sinumerik),
            "G17 G71 G40 G90 G94\nT1 M6\nG00 X1 Y2\nD1\nG00 Z5\nD0\nG00 Z50\nM30\n");
  EXPECT_EQ(to(by_g43, fanuc, linuxcnc),
            "G17 G21 G40 G90 G91.1 G94\nT1 M6\nG00 X1 Y2\nG43 H1\nG00 Z5\nG49\nG00 Z50\nM30\n");
  EXPECT_EQ(to(by_g43, fanuc, heidenhain), "G49 4\n");
  EXPECT_EQ(to("T1 M6\nG43 H2 Z5.\nM30\n", fanuc, heidenhain),
            "G43 H2, the length of another tool than the one loaded 2\n");
  EXPECT_EQ(to("D1\nG0 Z5\nM30\n", DialectName::isg, sinumerik),
            "D1, the length of a tool without its T 1\n");
  EXPECT_EQ(to("T1 M6\nH1 Z5.\nM30\n", fanuc, linuxcnc), "H1 2\n");
  EXPECT_EQ(to("D1\nG0 Z5\nM30\n", sinumerik, fanuc), "D1, the length of a tool without its T 1\n");
  EXPECT_EQ(to("T1 M6\nG18\nG0 Z5\nM30\n", sinumerik, fanuc), "G18 with the length of a tool 2\n");
}

// Where a length comes with its tool, a motion across the plane has none unless the program does.
TEST(Conversion, PutsNoLengthInForceThatTheProgramHasNot) {  // D-94
  using enum DialectName;
  const std::string head = "G17 G71 G40 G90 G94\nT1 M6\n";
  const std::string without = "T1 M6\nG49\nG0 X0 Y0 Z10.\nZ5.\nM30\n";
  EXPECT_EQ(to(without, fanuc, sinumerik), head + "D0\nG00 X0 Y0 Z10\nG00 Z5\nM30\n");
  EXPECT_EQ(to("T1 M6\nG0 X0 Y0\nZ10.\nG43 H1 Z5.\nM30\n", fanuc, sinumerik),
            head + "G00 X0 Y0\nD0\nG00 Z10\nD1\nG00 Z5\nM30\n");
  EXPECT_EQ(to("T1 M6\nG0 Z10\nG1 D1 Z5 F100\nM30\n", DialectName::isg, sinumerik),
            head + "D0\nG00 Z10\nD1\nG01 Z5 F100\nM30\n");
  const std::string twice = "T1 M6\nG43 H1 G0 Z5.\nG49\nG0 Z100.\nT2 M6\nG0 X5. Z10.\nM30\n";
  EXPECT_EQ(to(twice, fanuc, sinumerik),
            head + "D1\nG00 Z5\nD0\nG00 Z100\nT2 M6\nD0\nG00 X5 Z10\nM30\n");
  EXPECT_EQ(to("M6\nG0 Z10.\nM30\n", fanuc, sinumerik),
            "G17 G71 G40 G90 G94\nM6\nD0\nG00 Z10\nM30\n");
  EXPECT_EQ(to(without, fanuc, heidenhain), "Z without the length of tool 1 3\n");
  EXPECT_EQ(to("T1 M6\nG0 X0\nZ9\nG43 H1 Z5\nM30\n", linuxcnc, heidenhain),
            "Z without the length of tool 1 3\n");
  const std::string other = "T1 M6\nG43 H1 G0 Z5.\nT2 M6\nX9.\nZ10.\nG43 H2 Z5.\nM30\n";
  for (const DialectName own : {sinumerik, heidenhain})
    EXPECT_EQ(to(other, fanuc, own), "G43 H1, the length of another tool than the one loaded 5\n");
  // The length comes with the first Z.
  const std::string usual = "T1 M6\nG0 X0 Y0\nG43 H1 Z5.\nT2 M6\nX9.\nG43 H2\nZ10.\nM30\n";
  EXPECT_EQ(to(usual, fanuc, sinumerik),
            head + "G00 X0 Y0\nD1\nG00 Z5\nT2 M6\nG00 X9\nD1\nG00 Z10\nM30\n");
  EXPECT_EQ(to(usual, fanuc, heidenhain),
            "BEGIN PGM CONVERTED MM\nTOOL CALL 1 Z\nL X+0 Y+0 FMAX\nL Z+5 FMAX\nTOOL CALL 2 Z\n"
            "L X+9 FMAX\nL Z+10 FMAX\nM30\nEND PGM CONVERTED MM\n");
}

TEST(Conversion, TakesTheEdgeBesideAToolForThatOfTheTool) {  // D-56
  const std::string program = "T1 D1\nM6\nG0 Z5\nM30\n";
  const auto to = [&](DialectName other) {
    const ConvertedProgram written = converted(program, DialectName::sinumerik, other);
    return told(written) + written.text;
  };
  EXPECT_EQ(to(DialectName::isg), "G17 G71 G40 G90 G94 G162\nT1\nM6\nD1\nG00 Z5\nM30\n");
  EXPECT_EQ(to(DialectName::fanuc), "G17 G21 G40 G90 G94\nT1\nM6\nG00 Z5. G43 H1\nM30\n");
  EXPECT_EQ(to(DialectName::linuxcnc), "G17 G21 G40 G90 G91.1 G94\nT1\nM6\nG43 H1\nG00 Z5\nM30\n");
}

TEST(Conversion, LeavesOutWhatSaysHowTrcGoes) {  // D-94
  for (const std::string word : {"KONT", "NORM", "CFTCP", "CFIN", "CFC", "CDON", "CDOF2", "G451"}) {
    const auto plain =
        converted("G0 X1\n" + word + "\nM30\n", DialectName::sinumerik, DialectName::fanuc);
    EXPECT_EQ(told(plain), "") << word;
    EXPECT_EQ(plain.text.find(word), std::string::npos) << plain.text;
  }
}

TEST(Conversion, SaysSpindleAndCoolantOfKlartextApart) {
  const std::string text =
      converted("TOOL CALL 1 Z S100\nL X+5 M13\nM30\n", DialectName::heidenhain, DialectName::isg)
          .text;
  EXPECT_NE(text.find("M3 M8"), std::string::npos) << text;
  EXPECT_EQ(text.find("M13"), std::string::npos) << text;
}

TEST(Conversion, NamesWordsAsTheyAreWritten) {
  EXPECT_EQ(
      told(converted("G0 X1\n#SET SLOPE PROFIL[0]\nM30\n", DialectName::isg, DialectName::fanuc)),
      "#SET SLOPE PROFIL[0] 2\n");
}

TEST(Conversion, KeepsACommentFromGoingOnAndInTheBytesOfTheOther) {
  const std::string program = "G0 X1 (a ~)\nX2 (K\xFChl)\nM30\n";
  const std::string klartext = converted(program, DialectName::fanuc, DialectName::heidenhain).text;
  EXPECT_NE(klartext.find("; a -\n"), std::string::npos) << klartext;
  const std::string isg = converted(program, DialectName::fanuc, DialectName::isg).text;
  EXPECT_NE(isg.find("(K\xC3\xBChl)"), std::string::npos) << isg;
}

}  // namespace
}  // namespace trc::support
