#include <fcntl.h>
#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "server/resources/memory_account.h"
#include "tests/support/process.h"
#include "tests/support/slot.h"

namespace trc::testing_support {
namespace {

// In the manner of the G239 demonstration, R 10.
const std::string demo =
    "%demo\n"
    "N10 G90 G17 G00 X0 Y0\n"
    "N20 G239\n"
    "N30 V.G.WZ_AKT.R = 10\n"
    "N40 G41 G01 X30 Y20 F1000\n"
    "N50 X60\n"
    "N55 M8\n"
    "N60 X90\n"
    "N70 X120\n"
    "N80 G40\n"
    "N90 G00 X150 Y0\n"
    "N100 M30\n";

// The middle edge is too short for the tool in both of its inside corners.
const std::string violating =
    "N10 G90 G17 G00 X-20 Y0\n"
    "N20 V.G.WZ_AKT.R=10\n"
    "N30 G138 G41 G01 X0 Y0 F500\n"
    "N40 X50\n"
    "N50 X55 Y5\n"
    "N60 Y50\n"
    "N70 G40 X0 Y60\n"
    "N80 M30\n";

// Messages are expected in English, whatever the machine speaks.
const int in_english = setenv("LC_ALL", "C", 1);

Ended trc(std::vector<std::string> arguments, const std::string& input = "") {
  arguments.insert(arguments.begin(), trc_program());
  return run(arguments, input);
}

bool within_seconds(int seconds, const std::function<bool()>& true_now) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  while (!true_now()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const auto end = text.find('\n', begin);
    lines.push_back(text.substr(begin, end - begin));
    begin = end == std::string::npos ? text.size() : end + 1;
  }
  return lines;
}

google::protobuf::Struct object_of(const std::string& line) {
  google::protobuf::Struct object;
  EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(line, &object).ok()) << line;
  return object;
}

TEST(Compensate, WritesNcTextWithoutCompensation) {
  const Ended ended = trc({"compensate", "-"}, demo);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_EQ(ended.out.find("G41"), std::string::npos);
  EXPECT_NE(ended.out.find("N40 G01 X30 Y30"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("M8"), std::string::npos);
}

TEST(Compensate, ListsOneBlockALine) {
  const Ended ended = trc({"compensate", "-", "--format", "listing"}, demo);
  EXPECT_EQ(ended.code, 0) << ended.err;
  const auto lines = lines_of(ended.out);
  ASSERT_GE(lines.size(), 6u);
  EXPECT_NE(ended.out.find("40 approach line 0.0000 0.0000 0.0000 -> 30.0000 30.0000 0.0000 F1000"),
            std::string::npos)
      << ended.out;
}

TEST(Compensate, NamesJsonFieldsAsDocumented) {
  const Ended ended = trc({"compensate", "-", "--format", "jsonl"}, demo);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(
      ended.out.find(
          R"({"block":{"sourceNumber":"40","sourceIndex":3,"origin":"APPROACH","rapid":false,)"
          R"("start":{"x":0,"y":0,"z":0},"line":{"end":{"x":30,"y":30,"z":0}},"feed":1000)"),
      std::string::npos)
      << ended.out;
  EXPECT_NE(ended.out.find(R"("origin":"PASSTHROUGH")"), std::string::npos);
  EXPECT_NE(ended.out.find(R"("passthrough":{"text":"M8"})"), std::string::npos);
  const auto lines = lines_of(ended.out);
  for (const std::string& line : lines) EXPECT_EQ(object_of(line).fields_size(), 1) << line;
  const auto last = object_of(lines.back());
  ASSERT_TRUE(last.fields().contains("summary"));
  const auto& summary = last.fields().at("summary").struct_value().fields();
  for (const char* name :
       {"blocksIn", "blocksOut", "maskedBlocks", "programmedLength", "compensatedLength"})
    EXPECT_TRUE(summary.contains(name)) << name;
  EXPECT_EQ(summary.at("maskedBlocks").string_value(), "0");
}

TEST(Compensate, PutsTheDiagnosticIntoJsonAndNoSummaryBehindIt) {
  const Ended ended = trc({"compensate", "-", "--format", "jsonl"}, violating);
  EXPECT_EQ(ended.code, 1);
  const auto lines = lines_of(ended.out);
  ASSERT_FALSE(lines.empty());
  const auto last = object_of(lines.back());
  ASSERT_TRUE(last.fields().contains("diagnostic")) << lines.back();
  const auto& diagnostic = last.fields().at("diagnostic").struct_value().fields();
  EXPECT_EQ(diagnostic.at("code").number_value(), 90019);
  EXPECT_EQ(diagnostic.at("severity").string_value(), "ERROR");
  EXPECT_EQ(diagnostic.at("sourceNumber").string_value(), "50");
  EXPECT_EQ(diagnostic.at("line").number_value(), 5);
  EXPECT_NE(diagnostic.at("message").string_value(), "");
  EXPECT_TRUE(diagnostic.at("values").has_struct_value());
}

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
       {": Dialekt isg, Längen in mm, bis das Programm es sagt\n",
        ": Vorgaben: verify=report language=de\n",
        ": Werkzeuge: 1: Radius 5.000 mm; 2: Radius 3.500 mm, Verschleiß -0.020 mm\n",
        ": Dienst: dieser Prozess, trc ", ": 6 Zeilen, ", " 1 Anfahren",
        "Radius am Ende 0.2500 in, davon Verschleiß + 0.0000 in", ": Zeit "})
    EXPECT_NE(ended.err.find(said), std::string::npos) << said << '\n' << ended.err;
  for (const char* english : {"length", "blocks", "lines", "radius ", "none", "time"})
    EXPECT_EQ(ended.err.find(english), std::string::npos) << english << '\n' << ended.err;
}

// What is proposed is text that can be put in: from "… in mm: " on, one line of the program between
// two commas, with G41 where it says so.
std::string program_with(const std::string& proposal) {
  std::string lines = proposal.substr(proposal.find(", in mm: ") + 9);
  const std::string selection = " with G41 or G42 as before";
  lines.replace(lines.find(selection), selection.size(), " G41");
  for (std::size_t comma = 0; (comma = lines.find(", ")) != std::string::npos;)
    lines.replace(comma, 2, "\n");
  return "V.G.WZ_AKT.R=10\nG236 F1000\n" + lines + "\nX60 Y10\nG40\nX120 Y30\nM30\n";
}

TEST(Compensate, ProposesAnEntryThatIsAccepted) {
  const Ended refused = trc({"compensate", "-"},
                            "V.G.WZ_AKT.R=10\nG236 F1000\nG0 X0 Y0\nG1 G41 X5\nX60 "
                            "Y10\nG40\nX120 Y30\nM30\n");
  EXPECT_EQ(refused.code, 1);
  const auto lines = lines_of(refused.err);
  ASSERT_EQ(lines.size(), 6u) << refused.err;
  EXPECT_EQ(lines[0].rfind("<stdin>:4: error 900201: ", 0), 0u) << lines[0];
  EXPECT_EQ(lines[3],
            "help: the approach is 5.000 mm long and needs at least 10.000 mm; it may start at X-5 "
            "Y0");
  for (const std::size_t proposal : {4U, 5U}) {
    const std::string program = program_with(lines[proposal]);
    const Ended accepted = trc({"compensate", "-"}, program);
    EXPECT_EQ(accepted.code, 0) << program << accepted.err;
  }
}

TEST(Compensate, PutsTheProposedEntryIntoJson) {
  const Ended ended = trc({"compensate", "-", "--format", "jsonl"},
                          "V.G.WZ_AKT.R=10\nG236 F1000\nG0 X0 Y0\nG1 G41 X5\nX60 "
                          "Y10\nG40\nX120 Y30\nM30\n");
  EXPECT_EQ(ended.code, 1);
  const auto lines = lines_of(ended.out);
  ASSERT_FALSE(lines.empty());
  const auto last = object_of(lines.back());
  const auto& diagnostic = last.fields().at("diagnostic").struct_value().fields();
  const auto& help = diagnostic.at("entryHelp").struct_value().fields();
  EXPECT_EQ(help.at("neededLength").number_value(), 10);
  EXPECT_EQ(help.at("legalPoint").struct_value().fields().at("x").number_value(), -5);
  EXPECT_EQ(help.at("proposals").list_value().values_size(), 2);
}

TEST(Compensate, LeavesNoFileOfARefusedProgram) {
  const Folder folder;
  folder.write("in.nc", violating);
  const std::string kept = folder.write("out.nc", "older result");
  EXPECT_EQ(trc({"compensate", folder.path("in.nc"), "-o", kept}).code, 1);
  EXPECT_EQ(content_of(kept), "older result");
  EXPECT_EQ(trc({"compensate", folder.path("in.nc"), "-o", folder.path("new.nc")}).code, 1);
  EXPECT_EQ(folder.names().size(), 2u);
}

TEST(Compensate, ReplacesTheFileOfAnEarlierRun) {
  const Folder folder;
  folder.write("in.nc", demo);
  const std::string out = folder.write("out.nc", "older result");
  ASSERT_EQ(::chmod(out.c_str(), 0640), 0);
  const Ended ended = trc({"compensate", folder.path("in.nc"), "-o", out});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out, "");
  EXPECT_EQ(content_of(out), trc({"compensate", "-"}, demo).out);
  EXPECT_EQ(folder.names().size(), 2u);
  struct stat status {};
  ASSERT_EQ(::stat(out.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(Compensate, KeepsHalfAProgramBack) {
  const Ended refused = trc({"compensate", "-"}, violating);
  EXPECT_EQ(refused.code, 1);
  EXPECT_EQ(refused.out, "");
  const Ended listed = trc({"compensate", "-", "--format", "listing"}, violating);
  EXPECT_EQ(listed.code, 1);
  EXPECT_NE(listed.out, "") << "what was certain is shown where no control runs it";
}

TEST(Compensate, ReplacesTheProgramItselfOnlyWhenForced) {
  const Folder folder;
  const std::string part = folder.write("part.nc", demo);
  const Ended refused = trc({"compensate", part, "-o", part});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--force"), std::string::npos) << refused.err;
  EXPECT_EQ(content_of(part), demo);
  EXPECT_EQ(trc({"compensate", part, "-o", part, "--force"}).code, 0);
  EXPECT_EQ(content_of(part).find("G41"), std::string::npos);
}

TEST(Compensate, WritesIntoDevices) {
  EXPECT_EQ(trc({"compensate", "-", "-o", "/dev/null"}, demo).code, 0);
}

TEST(Compensate, TakesInitialValues) {
  const std::string plain = "N10 G41 G01 X30 Y20 F100\nN20 X60\nN30 G40 X100 Y0\nN40 M30\n";
  const Ended ended = trc({"compensate", "-", "--format", "listing", "--set", "tool_radius=4",
                           "--set", "selection_mode=G138"},
                          plain);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("-> 30.0000 24.0000 0.0000"), std::string::npos) << ended.out;
}

TEST(Compensate, WritesAnotherDialect) {
  const std::string part =
      "G17 G21 G90\nT2 M6\nG0 X-9. Y-9.\nG41 D2 G1 X0 Y0 F90.\nY9.\nG40 X-9.\nM30\n";
  const std::vector<std::string> call{"compensate",    "-",    "--dialect", "fanuc", "--set",
                                      "tool_radius=2", "--to", "heidenhain"};
  const Ended ended = trc(call, part);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out,
            "BEGIN PGM CONVERTED MM\nTOOL CALL 2 Z\nL X-9 Y-9 FMAX\nL X-2 Y+0 F90\nL X-2 Y+9\n"
            "L X-9 Y+9\nM30\nEND PGM CONVERTED MM\n");
  const Ended refused = trc(call, "G54\n" + part);
  EXPECT_EQ(refused.code, 1);
  EXPECT_EQ(refused.out, "");
  EXPECT_NE(refused.err.find("does not convert G54 (line 1"), std::string::npos) << refused.err;
}

// Whoever counts in inch may have written the radii in inch as well.
TEST(Compensate, SaysThatItTookRadiiInMmForAProgramInInch) {
  const auto folder = std::filesystem::temp_directory_path() / "trc_commandline_tools";
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  };
  const std::string tools = write("tools.csv", "number,radius\n1,0.25\n");
  const std::string inches = write("inches.csv", "unit,inch\nnumber,radius\n1,0.25\n");
  const std::string part = "G0 X-1. Y-1.\nG41 D1 G1 X0 Y0 F9.\nY1.\nG40 X-1.\nM30\n";
  const std::string program = write("part.nc", "G20\n" + part);
  const auto told = [&](const std::string& file, const std::string& table,
                        std::vector<std::string> more = {}) {
    std::vector<std::string> call{"compensate", file, "--dialect", "fanuc", "--tools", table};
    call.insert(call.end(), more.begin(), more.end());
    const Ended ended = trc(call, part);
    EXPECT_EQ(ended.code, 0) << ended.err;
    return ended.err.find("are read in mm") != std::string::npos;
  };
  EXPECT_TRUE(told(program, tools));
  EXPECT_TRUE(told("-", tools, {"--unit", "inch"}));
  EXPECT_FALSE(told("-", tools));
  EXPECT_FALSE(told(program, inches));
  // Tables of controls say no unit either, but for G20 and G21 among the G10 lines of Fanuc.
  const std::string spindles = write("tool.tbl", "T1 P1 D0.5 Z1.0\n");
  EXPECT_TRUE(told(program, spindles));
  EXPECT_FALSE(told("-", spindles, {"--unit", "inch"}));
  EXPECT_TRUE(told(program, write("offsets.nc", "G10 L12 P1 R0.25\nM30\n")));
  const std::string saying = write("saying.nc", "G20\nG10 L12 P1 R0.25\nM30\n");
  EXPECT_FALSE(told(program, saying));
  EXPECT_NE(trc({"compensate", program, "--dialect", "fanuc", "--tools", saying}, "")
                .out.find("X-0.25 Y0"),
            std::string::npos);
  const auto told_of_options = [&](const std::string& option, const std::string& value) {
    const Ended ended = trc({"compensate", program, "--dialect", "fanuc", option, value}, "");
    EXPECT_EQ(ended.code, 0) << ended.err;
    return ended.err.find("--radius, --wear and --set are in mm") != std::string::npos;
  };
  EXPECT_TRUE(told_of_options("--radius", "0.25"));
  EXPECT_TRUE(told_of_options("--set", "tools=1:0.25"));
  EXPECT_FALSE(told_of_options("--tools", inches));
  std::filesystem::remove_all(folder);
}

TEST(Compensate, RefusesUnknownAndImpossibleSettings) {
  const Ended unknown = trc({"compensate", "-", "--set", "tol_radius=4"}, demo);
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("tool_radius"), std::string::npos);
  const Ended far = trc({"compensate", "-", "--set", "tool_radius=1e9"}, demo);
  EXPECT_EQ(far.code, 2) << far.err;
  EXPECT_EQ(far.err.rfind("trc: tool_radius: ", 0), 0u) << far.err;
  EXPECT_EQ(far.out, "");
}

TEST(Compensate, WritesAsManyDecimalsAsAsked) {
  const std::string third = "N10 G00 X0.123456789 Y0\nN20 G01 X1 Y1 F100\nN30 M30\n";
  const Ended ended = trc({"compensate", "-", "--format", "listing", "--decimals", "6"}, third);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("0.123457"), std::string::npos) << ended.out;
  EXPECT_EQ(trc({"compensate", "-", "--decimals", "9"}, third).code, 2);
}

TEST(Compensate, RefusesBadInputClearly) {
  const std::vector<std::pair<std::string, std::string>> programs{
      {"empty", ""},
      {"unclosed", "N10 #TRC[KERF_MASKING=1\n"},
      {"half a character", "N10 (\xC3"},
      {"binary", std::string("\x00\x01\xFF\xFE", 4)},
      {"huge", "N10 G01 X1e300 F100\n"},
      {"no number", "N10 G01 X F100\n"}};
  for (const auto& [name, text] : programs) {
    SCOPED_TRACE(name);
    const Ended ended = trc({"compensate", "-"}, text);
    EXPECT_EQ(ended.code, 1);
    EXPECT_EQ(ended.err.rfind("<stdin>", 0), 0u) << ended.err;
    EXPECT_NE(ended.err.find(": error "), std::string::npos) << ended.err;
    const auto lines = lines_of(ended.err);
    EXPECT_EQ(lines.back().rfind("help: ", 0), 0u) << ended.err;
    EXPECT_LE(lines.size(), 4u) << ended.err;
  }
}

TEST(Compensate, SaysWhatIsWrongWithTheCall) {
  EXPECT_EQ(trc({}).code, 2);
  EXPECT_EQ(trc({"compensat"}).code, 2);
  EXPECT_EQ(trc({"compensate"}).code, 2);
  EXPECT_EQ(trc({"compensate", "-", "--format", "xml"}, demo).code, 2);
  const Ended missing = trc({"compensate", "/nowhere/part.nc"});
  EXPECT_EQ(missing.code, 2);
  EXPECT_NE(missing.err.find("cannot read /nowhere/part.nc"), std::string::npos);
  const Ended folder = trc({"compensate", "/"});
  EXPECT_EQ(folder.code, 2);
  const Ended output = trc({"compensate", "-", "-o", "/nowhere/out.nc"}, demo);
  EXPECT_EQ(output.code, 2);
  EXPECT_NE(output.err.find("cannot write /nowhere/out.nc"), std::string::npos);
}

TEST(WrongCall, SaysWhatWasLikelyMeant) {
  const auto told = [](const std::vector<std::string>& call) {
    const Ended ended = trc(call);
    EXPECT_EQ(ended.code, 2);
    EXPECT_EQ(ended.out, "");
    return ended.err;
  };
  EXPECT_EQ(told({"compensat", "part.nc"}),
            "trc: there is no command compensat; did you mean compensate?\n");
  EXPECT_EQ(told({"compensate", "part.nc", "--raduis", "5"}),
            "trc compensate: there is no option --raduis; did you mean --radius?\n");
  EXPECT_EQ(told({"compensate", "part.nc", "--raduis=5"}),
            "trc compensate: there is no option --raduis; did you mean --radius?\n");
  EXPECT_EQ(told({"verify", "part.nc", "--tool-radius", "5"}),
            "trc verify: there is no option --tool-radius; did you mean --set tool_radius=…?\n");
  EXPECT_NE(told({"compensate", "part.nc", "--set", "tool_raduis=5"}).find("tool_radius"),
            std::string::npos);
  // A word that resembles none gets no suggestion.
  EXPECT_EQ(told({"mill"}).find("did you mean"), std::string::npos);
  EXPECT_NE(told({"mill"}).find("compensate, plot"), std::string::npos);
  EXPECT_EQ(told({"plot", "part.nc", "--no-such-thing"}).find("did you mean"), std::string::npos);
  EXPECT_EQ(told({"--no-such-thing"}),
            "trc: there is no option --no-such-thing; trc --help lists all\n");
  EXPECT_NE(told({}).find("trc: say what to do: commands are compensate, plot"), std::string::npos);
  EXPECT_NE(told({"compensate", "part.nc", "--set", "radus=5"}).find("nearest: tool_radius"),
            std::string::npos);
  EXPECT_NE(told({"compensate", "a.nc", "b.nc"}).find("several programs need --output-dir"),
            std::string::npos);
}

// Shops call controls and units by other names.
TEST(WrongCall, SaysWhichChoiceWasLikelyMeant) {
  for (const auto& [option, given, meant] :
       std::to_array<std::array<const char*, 3>>({{"--dialect", "siemens", "sinumerik"},
                                                  {"--dialect", "Haas", "fanuc"},
                                                  {"--dialect", "fanux", "fanuc"},
                                                  {"--dialect", "iTNC", "heidenhain"},
                                                  {"--to", "siemens", "sinumerik"},
                                                  {"--unit", "inches", "inch"}})) {
    const Ended ended = trc({"compensate", "part.nc", option, given});
    EXPECT_EQ(ended.code, 2);
    EXPECT_NE(ended.err.find("; did you mean " + std::string(meant) + "?\n"), std::string::npos)
        << ended.err;
  }
  EXPECT_EQ(trc({"compensate", "part.nc", "--dialect", "okuma"}).err.find("did you mean"),
            std::string::npos);
}

TEST(WrongCall, SaysHowNumbersAreWritten) {
  const auto told = [](const std::vector<std::string>& more) {
    std::vector<std::string> call{"compensate", "-"};
    call.insert(call.end(), more.begin(), more.end());
    const Ended ended = trc(call, demo);
    EXPECT_EQ(ended.code, 2);
    return ended.err;
  };
  EXPECT_EQ(told({"--radius", "5mm"}), "trc compensate: --radius: 5mm is no number\n");
  EXPECT_EQ(
      told({"--set", "tool_radius=5,5"}),
      "trc: --set: tool_radius: \"5,5\" is not possible; it takes a number; write 5.5, with a "
      "decimal point\n");
  EXPECT_EQ(told({"--set", "tool_radius=5,5", "--lang", "de"}),
            "trc: --set: tool_radius: \"5,5\" ist nicht möglich; es nimmt eine Zahl; 5.5 "
            "schreiben, mit Dezimalpunkt\n");
  EXPECT_NE(told({"--set", "tools=1:5,5"}).find("; commas separate tools, decimals have a point\n"),
            std::string::npos);
  EXPECT_EQ(told({"--server", "box"}), "trc: 'box' has no port: write box:50051\n");
}

TEST(Output, ThatHasNoPlaceEndsTheCommand) {
  const Folder folder;
  const std::string file = folder.write("part.nc", demo);
  for (const std::string& call :
       {"radii " + file + " --radii 2", "verify " + file, "info " + file, "compensate " + file,
        std::string("info"), std::string("explain 90019"), std::string("completion bash"),
        std::string("generate"), std::string("--help"), std::string("compensate --help")}) {
    const Ended full = run({"/bin/sh", "-c", trc_program() + " " + call + " >/dev/full"});
    EXPECT_EQ(full.code, 2) << call << full.err;
    EXPECT_TRUE(full.err.starts_with("trc: cannot write standard output")) << call << full.err;
    const Ended closed = run({"/bin/sh", "-c", trc_program() + " " + call + " >&-"});
    EXPECT_EQ(closed.code, 2) << call << closed.err;
    EXPECT_TRUE(closed.err.starts_with("trc: cannot write standard output")) << call;
  }
  const Ended without_input = run({"/bin/sh", "-c", trc_program() + " compensate - <&-"});
  EXPECT_EQ(without_input.code, 2);
  EXPECT_NE(without_input.err.find("cannot read <stdin>: "), std::string::npos)
      << without_input.err;
}

TEST(Mark, StandsUnderTheWordBehindAByteOrderMark) {
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

TEST(Server, GivesTheSameBytesAsTheOwnProcess) {
  const ServerProcess server;
  ASSERT_NE(server.address(), "");
  for (const char* format : {"nc", "listing"}) {
    const Ended own = trc({"compensate", "-", "--format", format}, demo);
    const Ended remote =
        trc({"compensate", "-", "--format", format, "--server", server.address()}, demo);
    EXPECT_EQ(remote.code, 0) << remote.err;
    EXPECT_EQ(remote.out, own.out);
  }
  const Ended refused = trc({"compensate", "-", "--server", server.address()}, violating);
  const Ended own = trc({"compensate", "-"}, violating);
  EXPECT_EQ(refused.code, 1);
  EXPECT_EQ(refused.err, own.err);
  EXPECT_EQ(refused.out, own.out);
}

TEST(Server, TakesLongPrograms) {
  const ServerProcess server;
  ASSERT_NE(server.address(), "");
  const std::string text = trc({"generate", "--shape", "gear", "--blocks", "50000"}).out;
  const Ended own = trc({"compensate", "-"}, text);
  const Ended remote = trc({"compensate", "-", "--server", server.address()}, text);
  EXPECT_EQ(remote.code, 0) << remote.err;
  EXPECT_GT(remote.out.size(), 50000u * 20);
  EXPECT_TRUE(remote.out == own.out);
}

TEST(Server, IsNamedWhenItCannotBeReached) {
  // Port 1 of the loopback address: nobody listens there.
  for (const char* command : {"compensate", "verify"}) {
    const Ended ended = trc({command, "-", "--server", "127.0.0.1:1"}, demo);
    EXPECT_EQ(ended.code, 3);
    EXPECT_NE(ended.err.find("127.0.0.1:1"), std::string::npos) << ended.err;
    EXPECT_EQ(ended.err.find("gRPC"), std::string::npos);
    EXPECT_EQ(ended.err.find("rpc"), std::string::npos);
    EXPECT_EQ(ended.out, "");
  }
  EXPECT_EQ(trc({"health", "--server", "127.0.0.1:1"}).code, 3);
  EXPECT_EQ(trc({"info", "--server", "127.0.0.1:1"}).code, 3);
}

TEST(ExitCode, SaysThatALimitWasMet) {
  const ServerProcess server({"--max-blocks-per-selection", "3"});
  ASSERT_NE(server.address(), "");
  // Loops are removed from the whole, so that the server holds all of it.
  std::string masking = demo;
  masking.insert(masking.find("N40"), "N35 G141\n");
  const Ended ended = trc({"compensate", "-", "--server", server.address()}, masking);
  EXPECT_EQ(ended.code, 4) << ended.err;
  EXPECT_NE(ended.err.find("error"), std::string::npos) << ended.err;
  EXPECT_EQ(ended.out, "");
}

std::string masked_generated() {
  std::string masking = trc({"generate", "--shape", "meander", "--blocks", "8000"}).out;
  masking.insert(masking.find("\nN40") + 1, "N35 G141\n");
  return masking;
}

TEST(OwnLimits, AreOptionsAndEndWithTheCodeOfLimits) {
  const std::string masking = masked_generated();
  const auto ended = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"compensate", "-"});
    return trc(options, masking);
  };
  EXPECT_EQ(ended({}).code, 0);
  const Ended blocks = ended({"--max-blocks-per-selection", "1000"});
  EXPECT_EQ(blocks.code, 4) << blocks.err;
  EXPECT_NE(blocks.err.find("1000"), std::string::npos) << blocks.err;
  EXPECT_EQ(blocks.out, "");
  if (!server::counts_heap) return;
  const Ended memory = ended({"--max-session-memory-mib", "1"});
  EXPECT_EQ(memory.code, 4) << memory.err;
  EXPECT_NE(memory.err.find("max-session-memory-mib"), std::string::npos) << memory.err;
  EXPECT_EQ(memory.out, "");
}

TEST(OwnLimits, MustFitTogetherAndAreOfNoServer) {
  const Ended sum =
      trc({"compensate", "-", "--memory-limit-mib", "64", "--max-session-memory-mib", "100"}, demo);
  EXPECT_EQ(sum.code, 2);
  EXPECT_NE(sum.err.find("--memory-limit-mib: "), std::string::npos) << sum.err;
  const Ended other =
      trc({"compensate", "-", "--server", "127.0.0.1:1", "--max-blocks-per-selection", "5"}, demo);
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("trc info --server"), std::string::npos) << other.err;
}

// A program that does not end, through a pipe that this object holds open.
class Endless {
 public:
  explicit Endless(const std::string& server)
      : path_(made(folder_)),
        client_({trc_program(), "compensate", path_, "--server", server}),
        // No other program may hold it open.
        text_(::open(path_.c_str(), O_WRONLY | O_CLOEXEC)) {
    const std::string begin = demo.substr(0, demo.size() / 2);
    EXPECT_EQ(::write(text_, begin.data(), begin.size()), static_cast<ssize_t>(begin.size()));
  }
  ~Endless() { end(); }
  Endless(const Endless&) = delete;
  Endless& operator=(const Endless&) = delete;

  int end() {
    if (const int text = std::exchange(text_, -1); text >= 0) ::close(text);
    return client_.wait();
  }

 private:
  static std::string made(const Folder& folder) {
    std::string path = folder.path("endless.nc");
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    return path;
  }

  Folder folder_;
  std::string path_;
  Process client_;
  int text_;
};

bool has_one_stream(const ServerProcess& server) {
  return within_seconds(20, [&] {
    return http_get(server.admin(), "/metrics").find("\ntrc_streams_active 1\n") !=
           std::string::npos;
  });
}

TEST(Wait, ForAServerThatIsFullIsSaidAndEnds) {
  const ServerProcess server({"--max-streams", "1", "--admin-listen", "127.0.0.1:0"});
  ASSERT_NE(server.address(), "");
  Endless first(server.address());
  ASSERT_TRUE(has_one_stream(server));
  const Folder folder;
  const std::string file = folder.write("part.nc", demo);
  const auto waiting = [&](const std::string& seconds) {
    return trc({"compensate", file, "--server", server.address(), "--wait", seconds});
  };
  const Ended at_once = waiting("0");
  EXPECT_EQ(at_once.code, 4) << at_once.err;
  EXPECT_NE(at_once.err.find("max-streams"), std::string::npos) << at_once.err;
  EXPECT_EQ(at_once.err.find("waiting"), std::string::npos) << at_once.err;
  const Ended later = waiting("2.5");
  EXPECT_EQ(later.code, 4) << later.err;
  const std::string said = "has no room now: ";
  EXPECT_NE(later.err.find(said), std::string::npos) << later.err;
  EXPECT_EQ(later.err.find(said), later.err.rfind(said)) << later.err;
  EXPECT_NE(later.err.find("; waiting for up to 2.5 s (--wait)\n"), std::string::npos) << later.err;

  // Who has waited gets the place that becomes free.
  Process patient({trc_program(), "compensate", file, "--server", server.address()});
  ASSERT_TRUE(within_seconds(20, [&] { return patient.err().find(said) != std::string::npos; }));
  EXPECT_EQ(first.end(), 0);
  EXPECT_EQ(patient.wait(), 0) << patient.err();
  EXPECT_EQ(patient.out(), trc({"compensate", file}).out);
}

TEST(Wait, OfASurveyForAServerThatIsFull) {
  const ServerProcess server({"--max-streams", "1", "--admin-listen", "127.0.0.1:0"});
  ASSERT_NE(server.address(), "");
  Endless first(server.address());
  ASSERT_TRUE(has_one_stream(server));
  const Folder folder;
  const std::string file = folder.write("part.nc", demo);
  const std::vector<std::string> question{"radii", file,       "--radii",
                                          "2,4",   "--server", server.address()};
  std::vector<std::string> at_once = question;
  at_once.insert(at_once.end(), {"--wait", "0"});
  EXPECT_EQ(trc(at_once).code, 4);

  std::vector<std::string> words = question;
  words.insert(words.begin(), trc_program());
  Process patient(words);
  EXPECT_TRUE(within_seconds(
      20, [&] { return patient.err().find("has no room now: ") != std::string::npos; }));
  EXPECT_EQ(first.end(), 0);
  EXPECT_EQ(patient.wait(), 0) << patient.err();
  EXPECT_EQ(patient.out(), trc({"radii", file, "--radii", "2,4"}).out);
}

TEST(Server, ThatShutsDownIsToldFromOneThatIsNotThere) {
  ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  ASSERT_NE(server.address(), "");
  Endless first(server.address());
  ASSERT_TRUE(has_one_stream(server));
  server.signal(SIGTERM);
  Ended draining;
  const auto is_refused = [&] {
    draining = trc({"compensate", "-", "--server", server.address(), "--wait", "0"}, demo);
    return draining.code == 3;
  };
  EXPECT_TRUE(within_seconds(20, is_refused));
  EXPECT_NE(draining.err.find("is there, but shuts down"), std::string::npos) << draining.err;
  const Ended waited =
      trc({"compensate", "-", "--server", server.address(), "--wait", "1.5"}, demo);
  EXPECT_EQ(waited.code, 3);
  EXPECT_NE(waited.err.find("shuts down; waiting for up to 1.5 s (--wait)"), std::string::npos)
      << waited.err;
  first.end();
  EXPECT_EQ(server.wait(), 0);
  const Ended down = trc({"compensate", "-", "--server", server.address()}, demo);
  EXPECT_EQ(down.code, 3);
  EXPECT_NE(down.err.find("cannot reach a server at"), std::string::npos) << down.err;
}

TEST(Server, IsThatOfTheEnvironmentUnlessAnotherIsNamed) {
  const Folder folder;
  const std::string program = folder.write("part.nc", demo);
  const auto with_variable = [&](const std::string& value, std::vector<std::string> call) {
    call.insert(call.begin(), trc_program());
    Process process(call, 0, {"TRC_SERVER=" + value});
    const int code = process.wait();
    return std::pair(code, process.err());
  };
  const auto [nobody, told] = with_variable("127.0.0.1:1", {"compensate", program});
  EXPECT_EQ(nobody, 3);
  EXPECT_NE(told.find("127.0.0.1:1"), std::string::npos) << told;
  EXPECT_EQ(with_variable("127.0.0.1:1", {"compensate", program, "--server", ""}).first, 0);
  EXPECT_EQ(with_variable("", {"compensate", program}).first, 0);
  const ServerProcess server;
  ASSERT_NE(server.address(), "");
  EXPECT_EQ(with_variable(server.address(), {"health"}).first, 0);
  EXPECT_EQ(with_variable("127.0.0.1:1", {"health", "--server", server.address()}).first, 0);
  EXPECT_NE(trc({"compensate", "--help"}).out.find("TRC_SERVER"), std::string::npos);
}

TEST(ExitCode, IsToldByTheHelp) {
  const std::string help = trc({"--help"}).out;
  for (const char* word :
       {"0 done", "1 the program", "2 wrong", "3 server", "4 a limit", "5 internal"})
    EXPECT_NE(help.find(word), std::string::npos) << word;
}

TEST(Server, IsAskedForHealthAndInfo) {
  const ServerProcess server;
  ASSERT_NE(server.address(), "");
  const Ended health = trc({"health", "--server", server.address()});
  EXPECT_EQ(health.code, 0) << health.err;
  EXPECT_EQ(health.out, "serving\n");
  const Ended info = trc({"info", "--server", server.address()});
  EXPECT_EQ(info.code, 0) << info.err;
  // Some limits are filled in from the memory there is, and are those of the server.
  const auto tables = [](const std::string& text) {
    return text.substr(text.find("#TRC options"));
  };
  EXPECT_EQ(tables(info.out), tables(trc({"info"}).out));
}

TEST(Health, NeedsAServerToAsk) { EXPECT_EQ(trc({"health"}).code, 2); }

TEST(Health, DoesNotWaitLongForAServerThatHangs) {
  const ServerProcess server;
  ASSERT_NE(server.address(), "");
  server.signal(SIGSTOP);
  const auto start = std::chrono::steady_clock::now();
  const Ended health = trc({"health", "--server", server.address(), "--timeout-s", "1"});
  const auto took = std::chrono::steady_clock::now() - start;
  server.signal(SIGCONT);
  EXPECT_EQ(health.code, 3);
  EXPECT_EQ(health.out, "");
  EXPECT_GE(took, std::chrono::seconds(1));
  EXPECT_LT(took, std::chrono::seconds(8));
}

TEST(Health, TellsAServerThatIsAboutToStopFromOneThatServes) {
  ServerProcess server({"--health-listen", "127.0.0.1:0", "--admin-listen", "127.0.0.1:0"});
  ASSERT_NE(server.health(), "");
  EXPECT_EQ(trc({"health", "--server", server.health()}).code, 0);

  // A program that does not end, so that the server has something to wait for.
  const Folder folder;
  const std::string endless = folder.path("endless.nc");
  ASSERT_EQ(::mkfifo(endless.c_str(), 0600), 0);
  Process client({trc_program(), "compensate", endless, "--server", server.address()});
  std::ofstream text(endless);
  text << demo.substr(0, demo.size() / 2) << std::flush;
  const auto one_stream = [&] {
    return http_get(server.admin(), "/metrics").find("\ntrc_streams_active 1\n") !=
           std::string::npos;
  };
  ASSERT_TRUE(within_seconds(20, one_stream));

  server.signal(SIGTERM);
  Ended health;
  EXPECT_TRUE(within_seconds(20, [&] {
    health = trc({"health", "--server", server.health()});
    return health.code == 1;
  })) << health.err;
  EXPECT_EQ(health.out, "not serving\n");
  text.close();
  client.wait();
  EXPECT_EQ(server.wait(), 0);
}

// The first word of a German text that only English has; empty: none.
std::string english_word_in(const std::string& text) {
  static const std::regex english(
      R"(\b(the|or|of|with|not|has|is|are|that|which|and|to|line|there|cannot|did|Run|more|required|missing|names|no|allowed|value|Value|File|does|exist|unknown|range)\b)");
  std::smatch found;
  return std::regex_search(text, found, english) ? found.str() : std::string();
}

TEST(WrongCall, IsToldInGerman) {
  const Folder folder;
  folder.write("a.nc", "G0 X0\nM30\n");
  folder.write("bad.csv", "number,radius\n1,x\n");
  folder.write("twice.csv", "number,radius\n1,2\n1,3\n");
  folder.write("column.csv", "number,size\n1,2\n");
  const std::string nc = folder.path("a.nc");
  const std::vector<std::vector<std::string>> calls{
      {"compensat", nc},
      {},
      {"frobnicate"},
      {"compensate"},
      {"compensate", nc, "--tool-raduis", "5"},
      {"compensate", nc, "--tool-radius", "5"},
      {"compensate", nc, "--frob"},
      {"compensate", nc, "--decimals", "9"},
      {"compensate", nc, "--decimals", "x"},
      {"compensate", nc, "--format", "pdf"},
      {"compensate", nc, "--tools", folder.path("none.csv")},
      {"compensate", nc, "--tools", folder.path("bad.csv")},
      {"compensate", nc, "--tools", folder.path("twice.csv")},
      {"compensate", nc, "--tools", folder.path("column.csv")},
      {"compensate", nc, "--set", "radus=5"},
      {"compensate", nc, "--set", "tool_radius"},
      {"compensate", nc, "--set", "tool_radius=x"},
      {"compensate", nc, "--set", "stretch_factor=10"},
      {"compensate", nc, "--set", "tool_radius=1e9"},
      {"compensate", nc, "--variable", "#500"},
      {"compensate", nc, "--subprograms", folder.path("none")},
      {"compensate", nc, "-o", nc},
      {"compensate", nc, "-q", "-v"},
      {"compensate", nc, "--worker"},
      {"compensate", nc, nc},
      {"compensate", nc, nc, "--output-dir", folder.path("out")},
      {"compensate", folder.path("none.nc")},
      {"compensate", nc, "-o", folder.path("none/out.nc")},
      {"compensate", nc, "--server", "127.0.0.1:1", "--wait", "0"},
      {"compensate", nc, "--server", "127.0.0.1:1", "--memory-limit-mib", "100"},
      {"plot", nc, "-o", folder.path("out.pdf")},
      {"radii", nc, "--radii", "3:x"},
      {"radii", nc, "--radii", "1:2"},
      {"verify"},
      {"verify", "--record", nc},
      {"explain", "1"},
      {"generate", "--shape", "dog"},
      {"health", "--server", "127.0.0.1:1"}};
  setenv("LC_ALL", "de_DE.UTF-8", 1);
  for (const std::vector<std::string>& call : calls) {
    const Ended ended = trc(call);
    std::string all;
    for (const std::string& word : call) all += word + " ";
    EXPECT_GE(ended.code, 2) << all;
    EXPECT_FALSE(ended.err.empty()) << all;
    EXPECT_EQ(english_word_in(ended.err), "") << all << '\n' << ended.err;
  }
  folder.write("refused.nc", "G0 X0 Y0\n#TRC [REVERS=1]\nM30\n");
  folder.write("square.nc",
               "V.G.WZ_AKT.R=5\nG0 X-20 Y-20\nG41 G1 X0 Y0 F500\nY40\nX60\nY0\nX0\nG40 X-20 "
               "Y-20\nM30\n");
  for (const std::vector<std::string>& call :
       std::vector<std::vector<std::string>>{{"info", folder.path("refused.nc")},
                                             {"verify", folder.path("square.nc")},
                                             {"info", nc}}) {
    const Ended ended = trc(call);
    EXPECT_FALSE(ended.out.empty());
    EXPECT_EQ(english_word_in(ended.out), "") << ended.out;
    EXPECT_EQ(ended.out.find("GetServerInfo"), std::string::npos) << ended.out;
  }
  setenv("LC_ALL", "C", 1);
  // The option counts where nothing else of the call can be read.
  EXPECT_EQ(english_word_in(trc({"compensat", "--lang=de"}).err), "");
  EXPECT_NE(english_word_in(trc({"compensat"}).err), "");
}

// What stands between two blanks or more, of the lines behind the first ones.
std::vector<std::string> cells_of(const std::string& text) {
  std::vector<std::string> cells;
  static const std::regex between("  +");
  for (const std::string& line : lines_of(text))
    for (auto cell = std::sregex_token_iterator(line.begin(), line.end(), between, -1);
         cell != std::sregex_token_iterator(); ++cell)
      if (cell->length() > 0) cells.push_back(*cell);
  return cells;
}

TEST(Info, IsToldInGerman) {
  const Ended english = trc({"info"});
  const Ended german = trc({"info", "--lang", "de"});
  EXPECT_EQ(german.code, 0) << german.err;
  const auto theirs = cells_of(english.out);
  const std::set<std::string> words(theirs.begin(), theirs.end());
  // Numbers, names, units and values of settings are the same in both.
  static const std::regex same(
      R"([0-9.,… -]*( (mm|mm/min|s))?|mm|Option|Code|[A-Z0-9_,]+|[a-z0-9_.]+(, [a-z0-9_]+)*)"
      R"(( \(G\d+\))?|G\d+|trc .*|.*(gcc|gRPC).*)");
  for (const std::string& cell : cells_of(german.out)) {
    EXPECT_TRUE(std::regex_match(cell, same) || !words.contains(cell)) << cell;
    EXPECT_EQ(english_word_in(cell), "") << cell;
  }
  for (const char* word : {"Grenzen", "Meldungen", "nein, abgelehnt", "Nullpunktverschiebung"})
    EXPECT_NE(german.out.find(word), std::string::npos) << word;
  EXPECT_EQ(trc({"--lang", "de", "info"}).out, german.out);
}

TEST(Info, TellsTheSettings) {
  const Ended info = trc({"info"});
  EXPECT_NE(info.out.find("block_skip"), std::string::npos);
  EXPECT_NE(info.out.find("(900017): refuse, execute, leave_out\n"), std::string::npos);
}

// A language that is asked for is spoken, whatever the command is.
TEST(Language, IsTakenByEveryCommand) {
  const std::string german = "Language of messages";
  for (const char* command : {"compensate", "plot", "radii", "verify", "view", "generate", "load",
                              "info", "explain", "health", "completion"}) {
    const Ended help = trc({command, "--help"});
    EXPECT_NE(help.out.find(german), std::string::npos) << command;
    EXPECT_EQ(trc({"--lang", "de", command, "--help"}).out,
              trc({command, "--lang", "de", "--help"}).out)
        << command;
  }
  const Ended load = trc({"load", "--jobs", "1", "--blocks", "20", "--lang", "de"});
  EXPECT_EQ(load.code, 0) << load.err;
  EXPECT_EQ(english_word_in(load.out), "") << load.out;
  EXPECT_NE(load.out.find("geschlossener Kreis, 1 Streams zugleich, je "), std::string::npos)
      << load.out;
  const Ended health = trc({"health", "--server", "127.0.0.1:1", "--lang", "de"});
  EXPECT_NE(health.err.find("kein Server unter"), std::string::npos) << health.err;
  const Ended shape = trc({"generate", "--shape", "dog", "--lang", "de"});
  EXPECT_EQ(shape.code, 2);
  EXPECT_EQ(english_word_in(shape.err), "") << shape.err;
  EXPECT_NE(trc({"completion", "fish", "--lang", "de"}).out.find("Sprache der Meldungen"),
            std::string::npos);
}

TEST(Info, PrintsTheTablesOfTheDocumentation) {
  const Ended info = trc({"info"});
  EXPECT_EQ(info.code, 0) << info.err;
  for (const char* word : {"STRETCH_FACTOR", "G239", "90019", "Limits"})
    EXPECT_NE(info.out.find(word), std::string::npos) << word;
  const Ended diagnostics = trc({"info", "--markdown", "diagnostics"});
  EXPECT_EQ(diagnostics.out.rfind("| Code | Severity | Cause | Remedy |\n|---|---|---|---|\n", 0),
            0u);
  EXPECT_NE(diagnostics.out.find("\n| 90019 | error | "), std::string::npos);
  EXPECT_NE(trc({"info", "--markdown", "options"}).out.find("| KERF_MASKING | 0 … 1 | 0 |"),
            std::string::npos);
}

TEST(Explain, SaysWhatACodeMeansAndWhatHelps) {
  const Ended ended = trc({"explain", "90019"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const char* words : {"error 90019 LINE_REVERSED", "Causes:", "What helps:", "trc radii",
                            "trc explain 90019 --example | trc compensate -"})
    EXPECT_NE(ended.out.find(words), std::string::npos) << words;
  EXPECT_EQ(trc({"explain", "line_reversed"}).out, ended.out);
  for (const char* unknown : {"1", "90019x", "NO_REASON"}) {
    const Ended refused = trc({"explain", unknown});
    EXPECT_EQ(refused.code, 2) << unknown;
    EXPECT_NE(refused.err.find(unknown), std::string::npos);
  }
  EXPECT_EQ(trc({"explain", "--example"}).code, 2);
}

// Words of a call behind "| trc compensate -" in what explains a code; nothing: no example.
std::optional<std::vector<std::string>> call_of(const std::string& explained,
                                                const std::string& command = "compensate") {
  const std::string before = "--example | trc " + command + " -";
  const std::size_t at = explained.find(before);
  if (at == std::string::npos) return std::nullopt;
  const std::size_t begin = at + before.size();
  std::istringstream line(explained.substr(begin, explained.find('\n', begin) - begin));
  std::vector<std::string> call{command, "-"};
  for (std::string word; line >> word;) call.push_back(word);
  return call;
}

TEST(Explain, HasAnExampleThatRaisesEachCode) {
  const Ended list = trc({"explain"});
  ASSERT_EQ(list.code, 0);
  int codes = 0;
  for (const std::string& line : lines_of(list.out)) {
    const std::string code = line.substr(0, line.find(' '));
    if (code.empty() || code.find_first_not_of("0123456789") != std::string::npos) continue;
    ++codes;
    const Ended explained = trc({"explain", code});
    EXPECT_EQ(explained.code, 0) << code << explained.err;
    const auto call = call_of(explained.out);
    ASSERT_TRUE(call) << code;
    const std::string program = trc({"explain", code, "--example"}).out;
    const Ended raised = trc(*call, program);
    const std::regex told("(^|\n)[^\n]*: (error|warning|note) " + code + ": ");
    EXPECT_TRUE(std::regex_search(raised.err, told)) << code << '\n'
                                                     << program.substr(0, 1000) << raised.err;
  }
  EXPECT_GT(codes, 75);
}

TEST(Explain, HasAPictureOfEachContour) {
  const Folder folder;
  int pictures = 0;
  for (const std::string& line : lines_of(trc({"explain"}).out)) {
    const std::string code = line.substr(0, line.find(' '));
    if (code.empty() || code.find_first_not_of("0123456789") != std::string::npos) continue;
    auto call = call_of(trc({"explain", code}).out, "plot");
    const std::string program = trc({"explain", code, "--example"}).out;
    if (!call) continue;
    ++pictures;
    EXPECT_EQ(call->back(), code + ".svg");
    call->back() = folder.path(code + ".svg");
    trc(*call, program);
    EXPECT_NE(content_of(call->back()).find("<path"), std::string::npos) << code;
  }
  EXPECT_GT(pictures, 40);
}

TEST(Compensate, RemediesNameWhatTheCommandLineHas) {
  const Ended ended = trc({"compensate", "-"}, "G41 G01 X10 Y0 F500\nX20\nG40 X30 Y10\nM30\n");
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.err.find("help: Give the radius: --radius 5"), std::string::npos) << ended.err;
  EXPECT_EQ(ended.err.find("setup"), std::string::npos) << ended.err;
  const Ended of_fanuc =
      trc({"compensate", "-"}, "O1\nG21 G41 D1 G01 X10 Y0 F500\nX20\nG40 X30 Y10\nM30\n");
  EXPECT_NE(
      of_fanuc.err.find("Haas or the like, declare it: --dialect fanuc. If it is one for ISG"),
      std::string::npos)
      << of_fanuc.err;
  const Ended calls = trc({"compensate", "-", "--dialect", "fanuc"}, "O1\nG41 D1\nM98 P7\nM30\n");
  EXPECT_NE(calls.err.find("help: Put it into the same file, or give its file: --subprograms FILE, "
                           "or the folder.\n"),
            std::string::npos)
      << calls.err;
}

// Bytes of programs come out as they came in; what is said of them is UTF-8.
TEST(Compensate, TakesSubprogramsInEitherEncoding) {
  const Folder folder;
  folder.write("O7.nc",
               "O7 (Au\xDF"
               "en)\n(fr\xE4sen)\nG0 X4.5\nM99\n");
  folder.write("part.nc", "G0 Y1.\nM98 P7\nM30\n");
  const std::string picture("\x89PNG\r\n\x1A\n\0\0\0\rIHDR", 16);
  folder.write("picture.png", picture);
  for (const std::string& path : {folder.path("O7.nc"), folder.path("")}) {
    const Ended ended =
        trc({"compensate", folder.path("part.nc"), "--dialect", "fanuc", "--subprograms", path});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.out, "G0 Y1.\n(O0007)\n(fr\xE4sen)\nG0 X4.5\nM30\n");
  }
  const Ended no_text = trc({"compensate", folder.path("part.nc"), "--dialect", "fanuc",
                             "--subprograms", folder.path("picture.png")});
  EXPECT_EQ(no_text.code, 2);
  EXPECT_NE(no_text.err.find("picture.png is no NC text"), std::string::npos) << no_text.err;
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

TEST(Compensate, TakesVariablesAndSubprogramsOfTheCall) {
  const Folder folder;
  folder.write("O7.nc", "O7\nG0 X#500\nM99\n");
  folder.write("part.nc", "G0 Y1.\nM98 P7\nM30\n");
  for (const std::string& path : {folder.path("O7.nc"), folder.path("")}) {
    const Ended ended = trc({"compensate", folder.path("part.nc"), "--dialect", "fanuc",
                             "--variable", "#500=4.5", "--subprograms", path});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.out, "G0 Y1.\n(O0007)\nG0 X4.5\nM30\n");
  }
  const Ended without = trc({"compensate", folder.path("part.nc"), "--dialect", "fanuc"});
  EXPECT_EQ(without.code, 1);
  EXPECT_NE(without.err.find("part.nc:2:5: error 900306: "), std::string::npos) << without.err;
  EXPECT_NE(without.err.find("--subprograms"), std::string::npos) << without.err;
  const Ended wrong = trc({"compensate", "-", "--variable", "#500"}, "M30\n");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("--variable: \"#500\" is no value; write NAME=VALUE"), std::string::npos)
      << wrong.err;
  const Ended bounded =
      trc({"compensate", "-", "--dialect", "fanuc", "--max-executed-lines", "10"}, "N1 GOTO 1\n");
  EXPECT_EQ(bounded.code, 1);
  EXPECT_NE(bounded.err.find("error 900301: "), std::string::npos) << bounded.err;
}

TEST(Info, SaysThatAProgramComputes) {
  const Folder folder;
  folder.write("part.nc", "#1=0\nWHILE [#1 LT 3] DO1\nG0 X#1\n#1=#1+1\nEND1\nM30\n");
  const Ended ended = trc({"info", folder.path("part.nc"), "--dialect", "fanuc"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("computes: yes, 15 lines executed"), std::string::npos) << ended.out;
}

TEST(Plot, DrawsContourAndPath) {
  const Folder folder;
  folder.write("part.nc", demo);
  const Ended ended =
      trc({"plot", folder.path("part.nc"), "-o", folder.path("part.svg"), "--numbers"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const std::string svg = content_of(folder.path("part.svg"));
  EXPECT_NE(svg.find("<g class=\"programmed\""), std::string::npos);
  EXPECT_NE(svg.find("<g class=\"path\""), std::string::npos);
  EXPECT_NE(svg.find("<title>N40 approach</title>"), std::string::npos);
  EXPECT_NE(svg.find(">N50<"), std::string::npos);
  EXPECT_NE(svg.find("R 10 mm"), std::string::npos);
}

TEST(Plot, WritesAPageThatLoadsNothing) {
  const Folder folder;
  folder.write("a<b.nc", demo);
  const Ended ended = trc({"plot", folder.path("a<b.nc"), "-o", folder.path("part.html")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const std::string page = content_of(folder.path("part.html"));
  EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0u);
  EXPECT_NE(
      page.find("Content-Security-Policy\" content=\"default-src 'none'; script-src 'sha256-"),
      std::string::npos);
  EXPECT_NE(page.find("a\\u003cb.nc"), std::string::npos);
  EXPECT_EQ(page.find("src="), std::string::npos);
  // The contour beside the path, and the tool that makes one of the other.
  EXPECT_NE(page.find("\"contourBlocks\":\"5\""), std::string::npos);
  EXPECT_NE(page.find("\"toolRadii\":[10]"), std::string::npos);
  EXPECT_EQ(trc({"plot", "-", "--format", "html", "-o", "-"}, demo).out.rfind("<!DOCTYPE", 0), 0u);
}

TEST(Plot, SaysWhereAPageWouldBeTooLarge) {
  std::string text = "G41 G01 X0 Y0 F500\n";
  for (int i = 1; i <= 130'000; ++i) text += "X" + std::to_string(i) + "\n";
  const Ended ended = trc({"plot", "-", "--format", "html", "-o", "-", "--radius", "5"},
                          "G00 X-20 Y-20\n" + text + "G40 X130020 Y20\nM30\n");
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("a page holds 250000; use trc view"), std::string::npos) << ended.err;
}

TEST(View, IsForThisMachineAlone) {
  const Ended ended = trc({"view", "-", "--no-browser", "--listen", "0.0.0.0:0"}, demo);
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("--listen 0.0.0.0:0: the page is for this machine alone"),
            std::string::npos)
      << ended.err;
}

TEST(Plot, DrawsTheSameThroughAServer) {
  const ServerProcess server;
  ASSERT_NE(server.address(), "");
  EXPECT_EQ(trc({"plot", "-", "-o", "-", "--server", server.address()}, demo).out,
            trc({"plot", "-", "-o", "-"}, demo).out);
}

TEST(Plot, MarksThePlaceOfARefusal) {
  const Folder folder;
  const Ended ended = trc({"plot", "-", "-o", folder.path("part.svg")}, violating);
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.err.rfind("<stdin>:5: N50: error 90019: ", 0), 0u) << ended.err;
  const std::string svg = content_of(folder.path("part.svg"));
  EXPECT_NE(svg.find("<g class=\"fault\""), std::string::npos);
  EXPECT_NE(svg.find("error 90019 in line 5 (N50)"), std::string::npos);
}

TEST(Plot, DrawsWhatIsProposed) {
  const Ended ended = trc({"plot", "-", "-o", "-"},
                          "V.G.WZ_AKT.R=10\nG236 F1000\nG0 X0 Y0\nG1 G41 X5\nX60 Y10\nG40\nX120 "
                          "Y30\nM30\n");
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.out.find("<title>proposed entry, quarter circle</title>"), std::string::npos);
}

TEST(Plot, KnowsTheKindOfPictureByItsName) {
  const Folder folder;
  EXPECT_EQ(trc({"plot", "-", "-o", folder.path("part.png")}, demo).code, 2);
  EXPECT_EQ(trc({"plot", "-"}, demo).code, 2);
  EXPECT_TRUE(folder.names().empty());
}

// A rounding is a motion of its own in its line.
TEST(Verify, TellsTheMotionsOfALineApart) {
  const Ended ended = trc({"verify", "-", "--dialect", "sinumerik", "--radius", "2"},
                          "N10 G17 G71 G90 T1 D1\nN20 G0 X-20 Y-20\nN30 G41 G1 X0 Y0 F300\n"
                          "N40 Y50\nN50 X40 RND=6\nN60 Y0\nN70 X-10\nN80 G40 X-20 Y-20\nN90 M30\n");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("smallest clearance 2.0000 mm of 2.0000 mm"), std::string::npos)
      << ended.out;
}

TEST(Verify, FindsTheToolRadiusOnAGoodPath) {
  const Ended ended = trc({"verify", "-"}, demo);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("smallest clearance 10.0000 mm of 10.0000 mm"), std::string::npos)
      << ended.out;
}

TEST(Verify, FindsAGougeThatWasIgnored) {
  const Ended ended = trc({"verify", "-", "--set", "ignore_cont_damage=1"}, violating);
  EXPECT_EQ(ended.code, 1) << ended.out;
  EXPECT_NE(ended.err.find("gouge"), std::string::npos) << ended.err;
  // N40 is trimmed to X 45.8579, N60 stands at X 55.
  EXPECT_NE(ended.err.find("smallest clearance 9.1421 mm of 10.0000 mm"), std::string::npos)
      << ended.err;
}

// Inside a square of 40 mm: 5 mm at both sides of each corner.
TEST(Verify, SaysWhyWallsAreNotTouched) {
  const Ended pocket = trc({"verify", "-", "--radius", "5"},
                           "N10 G0 X20 Y10 F1000\nN20 G41 G1 X20 Y0\nN30 X40\nN40 Y40\nN50 X0\n"
                           "N60 Y0\nN70 X20\nN80 G40 Y10\nM30\n");
  EXPECT_EQ(pocket.code, 0) << pocket.err;
  EXPECT_NE(pocket.out.find("the path touches 75.0 % of 160.0000 mm of wall\n"
                            "  40.0000 mm lie in inside corners, into which a round tool does not "
                            "reach: 8 stretches, the longest 5.0000 mm of N30 (line 3)\n"),
            std::string::npos)
      << pocket.out;
  EXPECT_EQ(pocket.out.find("left out"), std::string::npos) << pocket.out;

  const std::string slot =
      "#TRC[REMOVE_MASKED_BLOCKS=1]\nN10 G0 X-20 Y-20 F1000\nN20 G26 G41 G141\nN30 G1 X0 Y0\n"
      "N40 Y40\nN50 X26\nN60 Y30\nN70 X34\nN80 Y40\nN90 X60\nN100 Y0\nN110 X0\nN120 G40 X-20 Y-20\n"
      "M30\n";
  const Ended passed = trc({"verify", "-", "--radius", "5"}, slot);
  EXPECT_EQ(passed.code, 0) << passed.err;
  EXPECT_NE(passed.out.find(" mm are left out or passed by, as the tool has no room there: "),
            std::string::npos)
      << passed.out;
  EXPECT_EQ(passed.out.find("inside corners"), std::string::npos) << passed.out;
  const Ended german = trc({"verify", "-", "--radius", "5", "--lang", "de"}, slot);
  EXPECT_NE(german.out.find(" mm sind ausgelassen oder umgangen, weil das Werkzeug dort keinen "
                            "Platz hat: "),
            std::string::npos)
      << german.out;
}

TEST(Verify, FindsNoGougeInGeneratedContours) {
  for (const char* shape :
       {"polygon", "square", "star", "gear", "wave", "spiral", "meander", "random"}) {
    SCOPED_TRACE(shape);
    const Ended generated = trc({"generate", "--shape", shape, "--blocks", "700", "--seed", "5"});
    EXPECT_EQ(generated.code, 0) << generated.err;
    const Ended verified = trc({"verify", "-"}, generated.out);
    EXPECT_EQ(verified.code, 0) << verified.err;
  }
}

// A bottleneck of 15 mm for a tool of 20, which G140 does not see (rule 6).
const std::string neck =
    "N10 G00 X-60 Y-80 F1000\nN20 V.G.WZ_AKT.R = 10\nN30 G41 G01 X-60 Y-40\nN40 X0\nN50 Y0\n"
    "N60 X50\nN70 Y-10\nN80 X90\nN90 Y25\nN100 X0\nN110 Y15\nN120 X-60\nN130 G40 X-90 Y50\n";

TEST(Verify, CompensateTellsOfAPathThatComesTooNear) {
  const Ended told = trc({"compensate", "-"}, neck);
  EXPECT_EQ(told.code, 0) << told.err;
  EXPECT_NE(told.err.find("warning 900216"), std::string::npos) << told.err;
  const Ended refused = trc({"compensate", "-", "--set", "verify=enforce"}, neck);
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.err.find("error 900216"), std::string::npos) << refused.err;
  const Ended not_measured = trc({"compensate", "-", "--set", "verify=off"}, neck);
  EXPECT_EQ(not_measured.code, 0);
  EXPECT_EQ(not_measured.err, "");
  EXPECT_EQ(not_measured.out, told.out);
}

void write_file(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

TEST(Record, HoldsWhereTheSameComesOutAgain) {
  const Folder folder;
  const std::string part = folder.path("part.nc");
  const std::string record = folder.path("part.json");
  write_file(part, demo);
  for (const char* format : {"nc", "jsonl", "listing"}) {
    SCOPED_TRACE(format);
    const Ended made =
        trc({"compensate", part, "-o", folder.path("out"), "--format", format, "--record", record});
    ASSERT_EQ(made.code, 0) << made.err;
    const std::string filed = content_of(record);
    for (const char* key : {"\"sha256\"", "\"certificate\"", "\"method", "\"clientVersion\"",
                            "\"serverCommit\"", "\"started\""})
      EXPECT_NE(filed.find(key), std::string::npos) << key << '\n' << filed;
    const Ended held = trc({"verify", "--record", record});
    EXPECT_EQ(held.code, 0) << held.err;
    EXPECT_NE(held.out.find("the record holds"), std::string::npos) << held.out;
  }
}

// As files come from controls and old Windows machines: Latin-1, "Flügel.nc".
TEST(Record, TakesANameThatIsNoUtf8) {
  const Folder folder;
  const std::string program = folder.write("Fl\xFCgel.nc", demo);
  const std::string record = folder.path("out.json");
  const Ended made = trc({"compensate", program, "-o", folder.path("\xFC.nc"), "--record", record});
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_NE(content_of(record).find(R"(Fl\\xFCgel.nc")"), std::string::npos) << content_of(record);
  EXPECT_EQ(trc({"verify", "--record", record}).code, 0);
  EXPECT_EQ(trc({"verify", program}).code, 0);
  const Ended refused = trc({"compensate", folder.write("\xE4.nc", violating)});
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.err.find("\\xE4.nc:"), std::string::npos) << refused.err;
  // The end of a long name is cut off at a character.
  std::string umlauts;
  for (int i = 0; i < 120; ++i) umlauts += "\u00E4";
  EXPECT_EQ(trc({"compensate", folder.write(umlauts + ".nc", demo)}).code, 0);
}

TEST(Record, ShowsWhatWasTamperedWith) {
  const Folder folder;
  const std::string part = folder.path("part.nc");
  const std::string record = folder.path("part.json");
  // With coordinates that fewer decimals would change.
  write_file(part, std::regex_replace(demo, std::regex("Y20"), "Y20.1234"));
  ASSERT_EQ(trc({"compensate", part, "-o", folder.path("out"), "--record", record}).code, 0);
  const std::string filed = content_of(record);
  const auto expect_shown = [&](const std::string& tampered, const char* what) {
    ASSERT_NE(tampered, filed) << what;
    write_file(record, tampered);
    const Ended shown = trc({"verify", "--record", record});
    EXPECT_EQ(shown.code, 1) << what << shown.out;
    EXPECT_NE(shown.err.find(what), std::string::npos) << shown.err;
  };
  expect_shown(std::regex_replace(filed, std::regex("\"clearance\": 10"), "\"clearance\": 11"),
               "summary");
  expect_shown(std::regex_replace(filed, std::regex("\"decimals\": 4"), "\"decimals\": 3"),
               "output");
  write_file(part, std::regex_replace(demo, std::regex("N70 X120"), "N70 X121"));
  expect_shown(filed + "\n", "input");
  write_file(part, std::regex_replace(demo, std::regex("Y20"), "Y20.1234"));
  const std::string out = folder.path("out");
  const std::string made = content_of(out);
  for (const std::string& changed : {made + "\n", made.substr(1), std::string()}) {
    write_file(out, changed);
    expect_shown(filed + "\n", "does not hold what came out");
  }
  // What no second run knows.
  expect_shown(std::regex_replace(filed, std::regex("\"started\": \"2"), "\"started\": \"1"),
               "it has been changed since it was written");
  write_file(record, "{\"format\": \"something\"}");
  EXPECT_EQ(trc({"verify", "--record", record}).code, 2);
  EXPECT_EQ(trc({"verify"}).code, 2);
}

TEST(Record, TellsOfARefusedProgramToo) {
  const Folder folder;
  const std::string part = folder.path("part.nc");
  const std::string record = folder.path("part.json");
  write_file(part, violating);
  EXPECT_EQ(trc({"compensate", part, "-o", folder.path("out"), "--record", record}).code, 1);
  EXPECT_NE(content_of(record).find("\"REFUSED\""), std::string::npos);
  EXPECT_EQ(trc({"verify", "--record", record}).code, 0);
}

TEST(Folder, IsCompensatedAndOnlyWhatChangedAgain) {
  const Folder folder;
  const std::string out = folder.path("out");
  std::vector<std::string> call{"compensate", "--output-dir", out, "--jobs",
                                "2",          "--decimals",   "4"};
  for (const char* name : {"a.nc", "b.nc", "bad.nc"}) {
    write_file(folder.path(name), std::string(name) == "bad.nc" ? violating : demo);
    call.push_back(folder.path(name));
  }
  const Ended first = trc(call);
  EXPECT_EQ(first.code, 1) << first.err;
  EXPECT_NE(first.out.find("3 programs, 2 done, 1 refused"), std::string::npos) << first.out;
  EXPECT_NE(first.out.find("clearance 10.0000 of 10.0000 mm"), std::string::npos) << first.out;
  EXPECT_NE(first.err.find("bad.nc:"), std::string::npos) << first.err;
  const std::string made = content_of(out + "/a.nc");
  EXPECT_EQ(made, trc({"compensate", folder.path("a.nc")}).out);
  EXPECT_EQ(content_of(out + "/bad.nc"), "");

  const Ended second = trc(call);
  EXPECT_NE(second.out.find("3 programs, 1 refused, 2 unchanged"), std::string::npos) << second.out;
  write_file(out + "/a.nc", made + "M0\n");
  write_file(folder.path("b.nc"), std::regex_replace(demo, std::regex("X120"), "X121"));
  EXPECT_NE(trc(call).out.find("2 done, 1 refused"), std::string::npos);
  EXPECT_EQ(content_of(out + "/a.nc"), made);
  call[6] = "3";
  EXPECT_NE(trc(call).out.find("2 done, 1 refused"), std::string::npos);
}

TEST(Folder, IsNotMixedUp) {
  const Folder folder;
  write_file(folder.path("a.nc"), demo);
  const std::string file = folder.path("a.nc");
  EXPECT_EQ(trc({"compensate", file, file, "--output-dir", folder.path("out")}).code, 2);
  EXPECT_EQ(trc({"compensate", file, file}).code, 2);
  EXPECT_EQ(trc({"compensate", file, "--output-dir", folder.path("")}).code, 2);
  EXPECT_EQ(trc({"compensate", file, "--jobs", "2"}).code, 2);
  EXPECT_EQ(content_of(file), demo);
}

// The contour without a radius of its own.
const std::string unsized =
    "N10 G90 G17 G00 X0 Y0\n"
    "N40 G138 G41 G01 X30 Y20 F1000\n"
    "N60 X90\n"
    "N80 G40 X120 Y0\n";

TEST(Compensate, TakesRadiusAndWear) {
  const Ended ended =
      trc({"compensate", "-", "--format", "jsonl", "--radius", "10", "--wear", "-0.25"}, unsized);
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto last = object_of(lines_of(ended.out).back());
  const auto& summary = last.fields().at("summary").struct_value().fields();
  EXPECT_EQ(summary.at("effectiveRadius").number_value(), 9.75);
  EXPECT_EQ(summary.at("wear").number_value(), -0.25);
  const Ended same = trc({"compensate", "-", "--radius", "10", "--wear", "-0.25"}, unsized);
  EXPECT_EQ(
      same.out,
      trc({"compensate", "-", "--set", "tool_radius=10", "--set", "wear=-0.25"}, unsized).out);
  const Ended whole = trc({"compensate", "-", "--radius", "10", "--wear", "5"}, unsized);
  EXPECT_EQ(whole.code, 1);
  EXPECT_NE(whole.err.find("900222"), std::string::npos) << whole.err;
}

const std::string slot(support::slot);

TEST(Radii, AreATable) {
  const Ended ended = trc({"radii", "-", "--radii", "3,5"}, slot);
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto lines = lines_of(ended.out);
  ASSERT_EQ(lines.size(), 4U) << ended.out;
  EXPECT_NE(lines[0].find("radius"), std::string::npos);
  const std::regex fits(R"( +3\.000  reaches all +0\.0 % +3\.000 +12\.000 +\d+\.\d{3})");
  EXPECT_TRUE(std::regex_match(lines[1], fits)) << ended.out;
  EXPECT_NE(lines[2].find("5.000  refused 9"), std::string::npos) << ended.out;
  EXPECT_EQ(lines[3].find("4.000 mm is the largest radius that reaches every wall, limited by line "
                          "3 (N30) and line 5 (N50)"),
            0U)
      << ended.out;
}

// In inch the slot is 8/25.4 wide.
TEST(Radii, AreToldInTheUnitAndLanguageAskedFor) {
  const std::string inch =
      "G70\nN10 G00 X-0.4 Y0.4\nN20 G138 G41 G01 X0 Y0 F10\nN30 Y1\nN40 X1\nN50 Y0.8\n"
      "N60 X2\nN70 Y-1\nN80 G40 X3\nN90 M30\n";
  const Folder folder;
  const std::string file = folder.write("inch.nc", inch);
  const std::string picture = folder.path("inch.svg");
  const Ended ended = trc({"radii", file, "--radii", "2.54", "--lang", "de", "--picture", picture});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("Radius, in"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("0.1000  erreicht alles"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("jeder Radius bis 31.2410 in passt"), std::string::npos) << ended.out;
  const std::string drawn = testing_support::content_of(picture);
  EXPECT_NE(drawn.find("programmierte Kontur"), std::string::npos);
  EXPECT_NE(drawn.find("X -0.544 … 2.144, Y -1.144 … 1.144 in"), std::string::npos) << drawn;
}

TEST(Radii, AreThoseOfTheTools) {
  const Folder folder;
  const std::string tools =
      folder.write("tools.csv", "number,radius,wear\n1,3,\n2,4.02,-0.05\n3,6,\n");
  const Ended ended = trc({"radii", "-", "--tools", tools, "--no-largest"}, slot);
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto lines = lines_of(ended.out);
  ASSERT_EQ(lines.size(), 4U) << ended.out;
  // The reground tool fits.
  EXPECT_NE(lines[2].find("3.970  T2    reaches all"), std::string::npos) << ended.out;
  EXPECT_NE(lines[3].find("6.000  T3    refused"), std::string::npos) << ended.out;
}

TEST(Radii, AreJson) {
  const Ended ended = trc({"radii", "-", "--radii", "1:3:1", "--json"}, slot);
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto answer = object_of(ended.out);
  EXPECT_EQ(answer.fields().at("radii").list_value().values_size(), 3);
  const auto& largest =
      answer.fields().at("summary").struct_value().fields().at("largest").struct_value().fields();
  EXPECT_NEAR(largest.at("radius").number_value(), 4, 1e-3 + 1e-9);
}

TEST(Radii, AreDrawn) {
  const Folder folder;
  const std::string picture = folder.path("radii.svg");
  const Ended ended = trc({"radii", "-", "--radii", "2,3,5", "--picture", picture}, slot);
  ASSERT_EQ(ended.code, 0) << ended.err;
  const std::string svg = content_of(picture);
  EXPECT_EQ(svg.rfind("<?xml", 0), 0U);
  std::size_t drawn = 0;
  for (std::size_t at = svg.find("class=\"uncut\""); at != std::string::npos;
       at = svg.find("class=\"uncut\"", at + 1))
    ++drawn;
  // Of the largest one nothing would be left at all: it is marked where it is refused.
  EXPECT_EQ(drawn, 2U);
  EXPECT_NE(svg.find("class=\"refused\""), std::string::npos);
  EXPECT_NE(svg.find("class=\"limits\""), std::string::npos);
  EXPECT_NE(svg.find("R 3.000: reaches all, 12.000 mm of wall uncut"), std::string::npos);
}

TEST(Radii, RefuseWhatCannotBeRead) {
  EXPECT_EQ(trc({"radii", "-", "--radii", "3"}, "N10 G999\n").code, 1);
  EXPECT_EQ(trc({"radii", "-", "--radii", "3;5"}, slot).code, 2);
  EXPECT_EQ(trc({"radii", "-", "--radii", "0"}, slot).code, 2);
  EXPECT_EQ(trc({"radii", "-", "--radii", "3", "--server", "127.0.0.1:1"}, slot).code, 3);
}

TEST(Generate, WritesTheSameTextAgain) {
  const std::vector<std::string> call{"generate", "--shape", "random", "--blocks",
                                      "50",       "--seed",  "3"};
  EXPECT_EQ(trc(call).out, trc(call).out);
  EXPECT_EQ(trc({"generate", "--shape", "cube"}).code, 2);
  EXPECT_EQ(trc({"generate", "--blocks", "0"}).code, 2);
}

// Names of the lines between "title:" and an empty line, as the help lists them.
std::vector<std::string> listed(const std::string& help, const std::string& title,
                                const std::regex& name) {
  const std::size_t begin = help.find(title + ":\n");
  if (begin == std::string::npos) return {};
  const std::string part = help.substr(begin, help.find("\n\n", begin) - begin);
  std::vector<std::string> names;
  for (std::sregex_iterator it(part.begin(), part.end(), name), end; it != end; ++it)
    names.push_back((*it)[1]);
  return names;
}

TEST(Help, IsGermanWhereThatIsAskedFor) {
  const auto german = [](std::vector<std::string> words) {
    words.insert(words.begin(), {"/usr/bin/env", "LC_ALL=de_DE.UTF-8", trc_program()});
    words.emplace_back("--help");
    const Ended ended = run(words);
    EXPECT_EQ(ended.code, 0) << ended.err;
    return ended.out;
  };
  // What all commands and options are described as.
  const std::string script = trc({"completion", "fish"}).out;
  const std::regex description(" -d '([^']+)'\n");
  std::set<std::string> english;
  for (std::sregex_iterator it(script.begin(), script.end(), description), end; it != end; ++it)
    if ((*it)[1].length() > 2) english.insert((*it)[1]);  // not "mm"
  ASSERT_GT(english.size(), 60u);
  english.erase("columns or blocks (CompensatePath), text (CompensateProgram)");  // in both
  const auto none_is_left = [&](const std::string& help) {
    for (const std::string& text : english)
      EXPECT_EQ(help.find(" " + text + "\n"), std::string::npos) << text << '\n' << help;
    for (const char* text :
         {"Usage:", "Options:", "Exit code", "The path", "The same", "with what"})
      EXPECT_EQ(help.find(text), std::string::npos) << text << '\n' << help;
  };
  const std::regex command_name("\n  ([a-z]+) ");
  const std::string all = german({});
  none_is_left(all);
  EXPECT_NE(all.find("\nRückgabewerte: 0 erledigt, "), std::string::npos) << all;
  const auto commands = listed(all, "Befehle", command_name);
  ASSERT_EQ(commands.size(), listed(trc({"--help"}).out, "Subcommands", command_name).size());
  for (const std::string& command : commands) none_is_left(german({command}));
  const std::string option = trc({"compensate", "--lang", "de", "--help"}).out;
  EXPECT_EQ(option, german({"compensate"}));
  EXPECT_NE(option.find("Aufruf: trc compensate [OPTIONEN] file..."), std::string::npos) << option;
  EXPECT_NE(option.find("Einstellungen (--set NAME=WERT)"), std::string::npos) << option;
}

TEST(Completion, HasEveryCommandAndOption) {
  const std::regex command_name("\n  ([a-z]+) ");
  const std::regex option_name("\n  (?:-[a-zA-Z],)?(--[a-z-]+)");
  const auto commands = listed(trc({"--help"}).out, "Subcommands", command_name);
  ASSERT_GE(commands.size(), 11u);
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    const Ended ended = trc({"completion", shell});
    EXPECT_EQ(ended.code, 0) << ended.err;
    for (const std::string& command : commands) {
      EXPECT_NE(ended.out.find(command), std::string::npos) << shell << ' ' << command;
      const auto options = listed(trc({command, "--help"}).out, "Options", option_name);
      EXPECT_FALSE(options.empty()) << command;
      for (const std::string& option : options) {
        const std::string word = shell == "fish" ? " -l " + option.substr(2) : option;
        EXPECT_NE(ended.out.find(word), std::string::npos)
            << shell << ' ' << command << ' ' << option;
      }
    }
  }
  EXPECT_EQ(trc({"completion", "csh"}).code, 2);
}

TEST(Completion, CompletesInBash) {
  const Folder folder;
  const std::string script = folder.write("trc.bash", trc({"completion", "bash"}).out);
  const Ended checked = run({"/usr/bin/shellcheck", "--shell=bash", script});
  EXPECT_EQ(checked.code, 0) << checked.out;
  const auto completed = [&](const std::string& words, int at) {
    return run({"/bin/bash", "-c",
                "compopt() { :; }; . " + script + "; COMP_WORDS=(" + words +
                    "); COMP_CWORD=" + std::to_string(at) + "; _trc; echo \"${COMPREPLY[*]}\""})
        .out;
  };
  EXPECT_EQ(completed("trc comp", 1), "compensate completion\n");
  EXPECT_EQ(completed("trc verify --ra", 2), "--radius\n");
  EXPECT_EQ(completed("trc compensate --unit ''", 3), "mm inch\n");
  EXPECT_EQ(completed("trc compensate --dialect fa", 3), "fanuc\n");
  EXPECT_EQ(completed("trc completion fi", 2), "fish\n");
  EXPECT_EQ(completed("trc radii --set tool_r", 3), "tool_radius=\n");
  EXPECT_EQ(completed("trc load --layout ''", 3), "columns blocks text\n");
  EXPECT_EQ(completed("trc explain 9001", 2).substr(0, 6), "90011 ");
}

TEST(Help, SaysOfSettingsInGermanWhatTheyAre) {
  const Ended german =
      run({"/usr/bin/env", "LC_ALL=de_DE.UTF-8", trc_program(), "compensate", "--help"});
  for (const char* said :
       {"\nEinstellungen (--set NAME=WERT), mit dem, was ohne sie gilt:\n",
        "\n  tool_radius: eine Zahl in mm, -214748.3647 bis 214748.3647; nichts\n      die Größe "
        "des Werkzeugs; negativ:",
        "\n  options.tangential_limit: eine Zahl in Grad, 0.1 bis 3; 3\n"})
    EXPECT_NE(german.out.find(said), std::string::npos) << said;
}

TEST(Help, SaysOfSettingsWhatTheyAre) {
  const std::string help = trc({"compensate", "--help"}).out;
  for (const char* said :
       {"\n  tool_radius: a number in mm, -214748.3647 to 214748.3647; none\n      the size of the "
        "tool; negative:",
        "\n  options.stretch_factor: a number, 1 to 9; 1\n      longest stretch of a block, in "
        "tool",
        "\n  options.tangential_limit: a number in degrees, 0.1 to 3; 3\n",
        "\n  options.online: a whole number, 0 alone; 0\n",
        "\n  transition: linear (G25), circular (G26); linear\n      what is inserted at outside"})
    EXPECT_NE(help.find(said), std::string::npos) << said;
}

TEST(Help, NamesEverySubcommand) {
  const Ended help = trc({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* name : {"compensate", "plot", "verify", "radii", "generate", "info", "health"}) {
    EXPECT_NE(help.out.find(name), std::string::npos) << name;
    EXPECT_EQ(trc({name, "--help"}).code, 0) << name;
  }
  EXPECT_NE(trc({"compensate", "--help"}).out.find("tool_radius"), std::string::npos);
  EXPECT_EQ(trc({"--version"}).out.rfind("trc ", 0), 0u);
}

}  // namespace
}  // namespace trc::testing_support
