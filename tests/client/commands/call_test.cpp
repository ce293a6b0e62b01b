#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/client/commands/called.h"
#include "tests/support/process.h"

namespace trc::testing_support {
namespace {

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

// What has an option of its own is no setting of --set.
TEST(WrongCall, SaysWhichOptionIsMeantBySet) {
  for (const auto& [given, meant] : std::to_array<std::array<const char*, 2>>(
           {{"dialect=fanuc", "write --dialect fanuc\n"},
            {"unit=inch", "write --unit inch\n"},
            {"radius=5", "write --radius 5\n"},
            {"unknown_words=copy", "write --unknown-words copy\n"}})) {
    const Ended ended = trc({"compensate", "part.nc", "--set", given});
    EXPECT_EQ(ended.code, 2);
    EXPECT_NE(ended.err.find(meant), std::string::npos) << ended.err;
    EXPECT_EQ(ended.err.find("nearest"), std::string::npos) << ended.err;
  }
  EXPECT_EQ(trc({"compensate", "-", "--set", "tool_radius=5", "--set", "wear=0"}, demo).code, 0);
  const Ended german = trc({"--lang", "de", "compensate", "part.nc", "--set", "lang=de"});
  EXPECT_NE(german.err.find("lang hat eine eigene Option: --lang de schreiben"), std::string::npos)
      << german.err;
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

// An option that is given without a value would otherwise count as not given.
TEST(WrongCall, GivesAnOptionNoValue) {
  const Folder folder;
  const std::string nc = folder.write("part.nc", demo);
  for (const auto& [command, option] :
       std::to_array<std::array<std::string, 2>>({{"compensate", "--wear"},
                                                  {"compensate", "--radius"},
                                                  {"compensate", "--record"},
                                                  {"compensate", "-o"},
                                                  {"compensate", "--output-dir"},
                                                  {"radii", "--picture"},
                                                  {"verify", "--record"}})) {
    const Ended ended = trc({command, nc, option, ""});
    EXPECT_EQ(ended.code, 2) << option;
    EXPECT_EQ(ended.out, "") << option;
    EXPECT_NE(ended.err.find(": its value is empty\n"), std::string::npos) << ended.err;
  }
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
  for (const auto& [option, number] : std::to_array<std::array<std::string, 2>>(
           {{"--radius", "0x10"}, {"--wear", "-0X1p-3"}, {"--max-executed-lines", "010000"}}))
    EXPECT_NE(told({option, number}).find(option + ": " + number + " is no number\n"),
              std::string::npos)
        << option;
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
  EXPECT_EQ(told({"--server", "127.0.0.1:99999"}),
            "trc: '127.0.0.1:99999': '99999' is no port: write a number from 1 to 65535\n");
  EXPECT_EQ(told({"--server", "127.0.0.1:1,127.0.0.1:port"}),
            "trc: '127.0.0.1:port': 'port' is no port: write a number from 1 to 65535\n");
}

TEST(ExitCode, IsToldByTheHelp) {
  const std::string help = trc({"--help"}).out;
  for (const char* word :
       {"0 done", "1 the program", "2 wrong", "3 server", "4 a limit", "5 internal"})
    EXPECT_NE(help.find(word), std::string::npos) << word;
}

TEST(WrongCall, IsToldInGerman) {
  const Folder folder;
  folder.write("a.nc", "G0 X0\nM30\n");
  folder.write("bad.csv", "number,radius\n1,x\n");
  folder.write("many.csv",
               "number,radius\n1,x\n1,x\n1,x\n1,x\n1,x\n1,x\n1,x\n1,x\n1,x\n1,x\n1,x\n1,x\n");
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
      {"compensate", nc, "--tools", folder.path("many.csv")},
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
      {"compensate", nc, "--wear", ""},
      {"compensate", nc, "--radius", "0x10"},
      {"compensate", nc, "--server", "127.0.0.1:99999"},
      {"radii", nc, "--picture", folder.path("a.pdf")},
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
