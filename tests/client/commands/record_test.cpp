#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "tests/client/commands/called.h"
#include "tests/support/process.h"

namespace trc::testing_support {
namespace {

void write_file(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

TEST(Record, HoldsWhereTheSameComesOutAgain) {  // D-49
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
  ASSERT_EQ(
      trc({"compensate", part, "-o", folder.path("out"), "--decimals", "4", "--record", record})
          .code,
      0);
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

// A record stays one, whatever was written into it: what it then says is no wrong call.
TEST(Record, NamesAMemberThatWasAddedRenamedOrMadeSomethingElse) {
  const Folder folder;
  const std::string part = folder.write("part.nc", demo);
  const std::string record = folder.path("part.json");
  ASSERT_EQ(trc({"compensate", part, "-o", folder.path("out"), "--record", record}).code, 0);
  const std::string filed = content_of(record);
  const auto expect_shown = [&](const char* old, const char* changed, const std::string& place) {
    SCOPED_TRACE(changed);
    write_file(record, std::regex_replace(filed, std::regex(old), changed,
                                          std::regex_constants::format_first_only));
    const Ended shown = trc({"verify", "--record", record});
    EXPECT_EQ(shown.code, 1) << shown.out;
    EXPECT_NE(shown.err.find(record + ": it has been changed: " + place), std::string::npos)
        << shown.err;
  };
  expect_shown("\\{", "{\"note\": \"ok\",", "note: there is no such field");
  expect_shown("\"outcome\"", "\"outcom\"", "outcom: there is no such field");
  expect_shown("\"seconds\": [^,]*", "\"seconds\": \"long\"", "seconds: \"long\" is not possible");
  for (const std::string& none : {std::string("{"), std::string("[]"), filed.substr(1)}) {
    write_file(record, none);
    const Ended refused = trc({"verify", "--record", record});
    EXPECT_EQ(refused.code, 2) << none;
    EXPECT_NE(refused.err.find("it is no record of a job"), std::string::npos) << refused.err;
  }
}

TEST(Record, FindsItsFilesBesideItselfToo) {
  const Folder folder;
  folder.write("part.nc", demo);
  ASSERT_EQ(run({"/bin/sh", "-c",
                 "cd \"$0\" && exec \"$1\" compensate part.nc -o out.nc --record out.json",
                 folder.path(""), trc_program()})
                .code,
            0);
  const std::string record = folder.path("out.json");
  const Ended held = trc({"verify", "--record", record});
  EXPECT_EQ(held.code, 0) << held.err;
  EXPECT_EQ(held.out.find("is not here"), std::string::npos) << held.out;
  write_file(folder.path("out.nc"), "M30\n");
  const Ended changed = trc({"verify", "--record", record});
  EXPECT_EQ(changed.code, 1) << changed.out;
  EXPECT_NE(changed.err.find("out.nc does not hold what came out"), std::string::npos)
      << changed.err;
  ASSERT_EQ(std::remove(folder.path("part.nc").c_str()), 0);
  const Ended lost = trc({"verify", "--record", record});
  EXPECT_EQ(lost.code, 2);
  EXPECT_NE(lost.err.find("name the program: trc verify --record " + record + " FILE"),
            std::string::npos)
      << lost.err;
}

TEST(Record, SaysInGermanWhatDiffers) {
  const Folder folder;
  const std::string part = folder.write("part.nc", demo);
  const std::string record = folder.path("part.json");
  ASSERT_EQ(trc({"compensate", part, "-o", folder.path("out"), "--record", record}).code, 0);
  const std::string filed = content_of(record);
  const auto said = [&](const char* old, const char* changed) {
    write_file(record, std::regex_replace(filed, std::regex(old), changed));
    return trc({"--lang", "de", "verify", "--record", record}).err;
  };
  EXPECT_NE(said("\"clearance\": 10", "\"clearance\": 11").find(": Zusammenfassung: geändert: "),
            std::string::npos);
  EXPECT_NE(said("\"outcome\"", "\"note\"").find(": es wurde verändert: note: dieses Feld gibt es"),
            std::string::npos);
  folder.write("part.nc", violating);
  const std::string other = said("\"format\"", "\"format\"");
  EXPECT_NE(other.find(": Programm: SHA-256 ist "), std::string::npos) << other;
  EXPECT_NE(other.find(": Ergebnis: SHA-256 ist "), std::string::npos) << other;
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

// Names of files may hold anything but '/'.
TEST(Folder, IsToldInOneLineAFileWhateverItsName) {
  const Folder folder;
  const std::string out = folder.path("out");
  const std::string file = folder.path("\x1B[2Ja\nb.nc");
  write_file(file, demo);
  const Ended ended = trc({"compensate", "--output-dir", out, file});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out.find('\x1B'), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("?[2Ja?b.nc  done"), std::string::npos) << ended.out;
  EXPECT_EQ(lines_of(ended.out).size(), 2U) << ended.out;
  const Ended twice = trc({"compensate", "--output-dir", out, file, file});
  EXPECT_EQ(twice.code, 2);
  EXPECT_EQ(twice.err.find('\x1B'), std::string::npos) << twice.err;
  EXPECT_EQ(lines_of(twice.err).size(), 1U) << twice.err;
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

}  // namespace
}  // namespace trc::testing_support
