#include <google/protobuf/struct.pb.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/client/commands/called.h"
#include "tests/support/process.h"

namespace trc::testing_support {
namespace {

TEST(Compensate, WritesNcTextWithoutCompensation) {
  const Ended ended = trc({"compensate", "-"}, demo);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_EQ(ended.out.find("G41"), std::string::npos);
  EXPECT_NE(ended.out.find("N40 G01 X30 Y30"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("M8"), std::string::npos);
}

// G141 alone selects nothing.
TEST(Compensate, SaysWhereNothingIsCompensated) {
  const std::string program = "G141\nG0 X0 Y0\nG1 X9 F100\nM30\n";
  const Ended ended = trc({"compensate", "-"}, program);
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.err,
            "<stdin>: warning: nothing is compensated: no G41, G42 (RL, RR) with a radius\n");
  EXPECT_EQ(trc({"compensate", "-", "--lang", "de"}, program).err,
            "<stdin>: Warnung: nichts wird korrigiert: kein G41, G42 (RL, RR) mit einem Radius\n");
  EXPECT_EQ(trc({"compensate", "-", "--quiet"}, program).err, "");
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

TEST(Compensate, PutsTheDiagnosticIntoJsonAndNoSummaryAfterIt) {
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

TEST(Compensate, KeepsHalfAProgramBack) {  // D-144
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
  EXPECT_FALSE(told(program, tools, {"-q"}));
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

}  // namespace
}  // namespace trc::testing_support
