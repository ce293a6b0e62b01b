#include <google/protobuf/struct.pb.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <regex>
#include <string>
#include <vector>

#include "tests/client/commands/called.h"
#include "tests/support/process.h"

namespace trc::testing_support {
namespace {

TEST(Compensate, TellsFileLineCodeAndRemedyOfARefusal) {
  const Folder folder;
  const std::string file = folder.write("part.nc", violating);
  const Ended ended = trc({"compensate", file});
  EXPECT_EQ(ended.code, 1);
  const auto lines = lines_of(ended.err);
  ASSERT_EQ(lines.size(), 3u) << ended.err;
  EXPECT_EQ(lines[0].rfind(file + ":5: N50: error 90019: ", 0), 0u) << lines[0];
  EXPECT_EQ(lines[1], "    5 | N50 X55 Y5");
  EXPECT_EQ(lines[2].rfind("help: Use a smaller tool", 0), 0u) << lines[2];
}

TEST(Compensate, MarksTheWordUnderTheLine) {
  const std::string program = "N10 G90 G17 G01 X0 Y20 F500\nN20 G02 X40 Y20 I25 J0\nM30\n";
  const Folder folder;
  const std::string file = folder.write("part.nc", program);
  // A program that comes through a pipe is shown as one that can be read again.
  for (const Ended& ended : {trc({"compensate", file}), trc({"compensate", "-"}, program)}) {
    EXPECT_EQ(ended.code, 1);
    const auto lines = lines_of(ended.err);
    ASSERT_EQ(lines.size(), 4u) << ended.err;
    EXPECT_NE(lines[0].find(":2:9: N20: error 20035: "), std::string::npos) << lines[0];
    EXPECT_EQ(lines[1], "    2 | N20 G02 X40 Y20 I25 J0");
    EXPECT_EQ(lines[2], "      |         ^~~");
    EXPECT_EQ(lines[3].rfind("help: ", 0), 0u);
  }
}

TEST(Language, IsThatOfTheOptionElseOfTheEnvironment) {
  const std::string program = "N10 G1 X10,5\nM30\n";
  const std::string german = "Hilfe: Dezimalpunkt statt Komma schreiben: X10.5.\n";
  const std::string english = "help: Write a decimal point: X10.5.\n";
  const auto told = [&](const std::string& environment, std::vector<std::string> arguments) {
    setenv("LC_ALL", environment.c_str(), 1);
    arguments.insert(arguments.begin(), {"compensate", "-"});
    const Ended ended = trc(arguments, program);
    setenv("LC_ALL", "C", 1);
    EXPECT_EQ(ended.code, 1);
    return ended.err;
  };
  EXPECT_NE(told("C", {"--lang", "de"}).find(german), std::string::npos);
  EXPECT_NE(told("de_DE.UTF-8", {}).find(german), std::string::npos);
  EXPECT_NE(told("de_DE.UTF-8", {"--lang", "en"}).find(english), std::string::npos);
  EXPECT_NE(told("fr_FR.UTF-8", {}).find(english), std::string::npos);
  EXPECT_NE(told("C", {"--lang", "de"}).find(": Fehler 900008: eine Zahl fehlt"),
            std::string::npos);
  EXPECT_EQ(trc({"compensate", "-", "--lang", "fr"}, program).code, 2);
  const Ended explained = trc({"explain", "90019", "--lang", "de"});
  EXPECT_NE(explained.out.find("Was hilft:\n  - Einen kleineren"), std::string::npos)
      << explained.out;
  EXPECT_NE(explained.out.find("Ursachen:\n  - Das Werkzeug ist zu groß"), std::string::npos)
      << explained.out;
  for (const char* word : {"Causes", "English", "Englisch", " the "})
    EXPECT_EQ(explained.out.find(word), std::string::npos) << word;
}

TEST(Compensate, SaysLengthsInTheUnitOfTheProgram) {
  const Ended ended = trc({"compensate", "-", "--format", "jsonl"},
                          "N10 G70 G01 X0 Y1 F20\nN20 G02 X2 Y1 I1.2 J0\nM30\n");
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.err.find("start radius 1.2000 in"), std::string::npos) << ended.err;
  const auto last = object_of(lines_of(ended.out).back());
  const auto& diagnostic = last.fields().at("diagnostic").struct_value().fields();
  EXPECT_TRUE(diagnostic.at("inch").bool_value());
  EXPECT_NEAR(diagnostic.at("values").struct_value().fields().at("start_radius").number_value(),
              30.48, 1e-4);
  EXPECT_EQ(diagnostic.at("place").struct_value().fields().at("line").number_value(), 2);
}

TEST(Compensate, CountsMessagesThatAreEqual) {
  const Ended ended = trc({"compensate", "-"},
                          "#TRC [STRETCH_FACTOR=30]\nG01 X1 F100\nN7 #TRC [STRETCH_FACTOR=30]\n"
                          "X2\n#TRC [STRETCH_FACTOR=30]\nM30\n");
  EXPECT_EQ(ended.code, 0);
  const auto lines = lines_of(ended.err);
  ASSERT_EQ(lines.size(), 5u) << ended.err;
  EXPECT_EQ(lines[4], "<stdin>: warning 22007: 2 more like it, in lines 3 (N7), 5");
}

// Standard error is a terminal there, and both outputs are one.
std::string on_a_terminal(const std::string& call, const std::string& environment) {
  const Ended ended =
      run({"/usr/bin/script", "-qec", environment + " " + trc_program() + " " + call, "/dev/null"});
  return ended.out;
}

TEST(Compensate, IsInColourOnATerminalOnly) {
  const Folder folder;
  const std::string call = "compensate " + folder.write("part.nc", violating);
  const std::string red = "\x1b[1;31merror 90019:\x1b[0m";
  EXPECT_NE(on_a_terminal(call, "NO_COLOR= TERM=xterm").find(red), std::string::npos);
  for (const char* environment : {"NO_COLOR=1 TERM=xterm", "NO_COLOR= TERM=dumb"}) {
    const std::string said = on_a_terminal(call, environment);
    EXPECT_NE(said.find("error 90019:"), std::string::npos) << said;
    EXPECT_EQ(said.find('\x1b'), std::string::npos) << said;
  }
  EXPECT_EQ(trc({"compensate", folder.path("part.nc")}).err.find('\x1b'), std::string::npos);
}

TEST(Summary, IsALineOnATerminal) {
  const Folder folder;
  const std::string call =
      "compensate " + folder.write("part.nc", demo) + " -o " + folder.path("out.nc");
  const std::regex line(R"(^\d+ blocks, clearance 10\.000 mm at N\d+, \d+\.\d\d s\r\n$)");
  const std::string said = on_a_terminal(call, "TERM=xterm");
  EXPECT_TRUE(std::regex_match(said, line)) << said;
  const std::regex german(R"(^\d+ Sätze, Abstand 10\.000 mm bei N\d+, \d+\.\d\d s\r\n$)");
  const std::string told = on_a_terminal(call + " --lang de", "TERM=xterm");
  EXPECT_TRUE(std::regex_match(told, german)) << told;
  // A script reads what is not for a terminal, and asked for nothing.
  EXPECT_EQ(on_a_terminal(call + " --quiet", "TERM=xterm"), "");
  EXPECT_EQ(trc({"compensate", folder.path("part.nc"), "-o", folder.path("out.nc")}).err, "");
  // Of what was refused there is nothing to sum up.
  folder.write("part.nc", violating);
  const std::string refused = on_a_terminal(call, "TERM=xterm");
  EXPECT_FALSE(std::regex_search(refused, std::regex(R"(\d+\.\d\d s\r\n$)"))) << refused;
}

TEST(Quiet, TellsErrorsAlone) {
  const std::string warned = "#TRC [STRETCH_FACTOR=30]\nG01 X1 F100\nM30\n";
  EXPECT_NE(trc({"compensate", "-"}, warned).err.find("warning 22007"), std::string::npos);
  for (const char* command : {"compensate", "verify"}) {
    const Ended ended = trc({command, "-", "-q"}, warned);
    EXPECT_EQ(ended.code, 0);
    EXPECT_EQ(ended.err, "") << command;
  }
  const Ended refused = trc({"compensate", "-", "-q"}, violating);
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.err.find("error 90019"), std::string::npos) << refused.err;
  EXPECT_EQ(trc({"compensate", "-", "-q", "-v"}, demo).code, 2);
}

TEST(Verbose, TellsWhatWasTakenAndHowLongItTook) {
  const Ended ended = trc({"compensate", "-", "-v", "--dialect", "isg", "--unit", "inch", "--set",
                           "tools=1:5,2:3.5:-0.02", "--set", "transition=G26"},
                          demo);
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.out, trc({"compensate", "-", "--unit", "inch"}, demo).out);
  for (const char* said :
       {"<stdin>: dialect isg, lengths in inch until the program says\n",
        "<stdin>: setup: transition=circular verify=report\n",
        "<stdin>: tools: 1: radius 5.000 mm; 2: radius 3.500 mm, wear -0.020 mm\n",
        "<stdin>: service: this process, trc ", "<stdin>: 12 lines, ", " 1 approach",
        "blocks of the path measured against", "<stdin>: time ", " inch at N"})
    EXPECT_NE(ended.err.find(said), std::string::npos) << said << '\n' << ended.err;
  for (const char* command : {"verify", "radii"}) {
    const Ended other = trc({command, "-", "-v"}, demo);
    EXPECT_EQ(other.code, 0) << command;
    EXPECT_NE(other.err.find("<stdin>: dialect isg, lengths in mm"), std::string::npos)
        << other.err;
  }
}

TEST(Verbose, SpeaksGermanAndInTheUnitOfTheProgram) {
  const Folder folder;
  const std::string file = folder.write(
      "part.nc", "G70 G17 G90 G0 X0 Y0\nV.G.WZ_AKT.R=0.25\nG41 G1 X1 Y0 F20\nX3\nG40 X4 Y1\nM30\n");
  const Ended ended =
      trc({"compensate", file, "-v", "--lang", "de", "--set", "tools=1:5,2:3.5:-0.02"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const char* said :
       {": Dialekt isg, Längen in mm, solange das Programm nichts anderes vorgibt\n",
        ": Vorgaben: verify=report language=de\n",
        ": Werkzeuge: 1: Radius 5.000 mm; 2: Radius 3.500 mm, Verschleiß -0.020 mm\n",
        ": Dienst: dieser Prozess, trc ", ": 6 Zeilen, ", " 1 Anfahren",
        "Radius am Ende 0.2500 in, davon Verschleiß + 0.0000 in", ": Zeit "})
    EXPECT_NE(ended.err.find(said), std::string::npos) << said << '\n' << ended.err;
  for (const char* english : {"length", "blocks", "lines", "radius ", "none", "time"})
    EXPECT_EQ(ended.err.find(english), std::string::npos) << english << '\n' << ended.err;
}

TEST(Mark, StandsUnderTheWordAfterAByteOrderMark) {
  const Ended refused = trc({"compensate", "-"}, "\xEF\xBB\xBFN10 G17 X1O\nM30\n");
  EXPECT_NE(refused.err.find("<stdin>:1:9: N10: error 900008"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("    1 | N10 G17 X1O\n      |         ^~~\n"), std::string::npos)
      << refused.err;
}

TEST(Mark, StandsUnderTheKeywordOrTheWholeCommand) {
  const Ended keyword = trc({"compensate", "-"}, "N20 #TRC [STRETCH_FACTOR=10]\nM30\n");
  EXPECT_NE(keyword.err.find("\n      |           ^~~~~~~~~~~~~~\n"), std::string::npos)
      << keyword.err;
  const Ended command = trc({"compensate", "-"}, "N20 #TRC [INVERSE=1]\nM30\n");
  EXPECT_NE(command.err.find("\n      |     ^~~~~~~~~~~~~~~~\n"), std::string::npos) << command.err;
}

TEST(Compensate, TellsOfProgramsInEitherEncoding) {
  const Folder folder;
  folder.write("tools.csv", "number,name,radius\n1,FR\xC4SER,5\n");
  folder.write("part.mpf", "T=\"fr\xE4ser\" D1 M6\nG0 X0 Y-20\nG41 G1 Y0 F100\nY9\nG40 X-9\nM30\n");
  const Ended done = trc({"compensate", folder.path("part.mpf"), "--dialect", "sinumerik",
                          "--tools", folder.path("tools.csv")});
  EXPECT_EQ(done.code, 0) << done.err;
  const Ended refused =
      trc({"compensate", folder.path("part.mpf"), "--dialect", "sinumerik", "--set", "tools=2:5"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.err.find("part.mpf:1:1: error 900013: "), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("no such tool: \"fräser\""), std::string::npos) << refused.err;
}

TEST(Compensate, ShowsTheLineOfASubprogramInItsFile) {
  const Folder folder;
  folder.write("O7.nc", "O7\nG0 X1.\nG0 X2. ?\nM99\n");
  folder.write("part.nc", "G0 Y1.\nM98 P7\nM30\n");
  const Ended ended = trc({"compensate", folder.path("part.nc"), "--dialect", "fanuc",
                           "--subprograms", folder.path("")});
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.err.find("O7.nc:3:8: error 900001: "), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("    3 | G0 X2. ?\n      |        ^\n"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("called from line 2"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace trc::testing_support
