#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/client/commands/called.h"
#include "tests/support/files.h"

// What a call reads is not written over by what it writes, nor one result by another.

namespace trc::testing_support {
namespace {

namespace fs = std::filesystem;

class WrittenFiles : public ::testing::Test {
 protected:
  WrittenFiles() {
    std::string name = (fs::temp_directory_path() / "trc-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    write("o.nc", demo);
    write("t.csv", "number,radius\n1,5\n");
    write("sub.nc", "O2\nM99\n");
    fs::create_hard_link(at("o.nc"), at("link.nc"));
    fs::create_symlink(at("t.csv"), at("link.csv"));
  }
  ~WrittenFiles() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(at(name)).parent_path());
    std::ofstream(at(name), std::ios::binary) << text;
  }
  // What standard error says of a call that ends as a wrong one and leaves all files as they are.
  [[nodiscard]] std::string refused(std::vector<std::string> words) const {
    const Ended ended = trc(std::move(words));
    EXPECT_EQ(ended.code, 2) << ended.out;
    EXPECT_EQ(content_of(at("o.nc")), demo);
    EXPECT_EQ(content_of(at("t.csv")), "number,radius\n1,5\n");
    EXPECT_EQ(content_of(at("sub.nc")), "O2\nM99\n");
    const std::size_t begin = ended.err.find(folder_.string());
    return begin == std::string::npos ? ended.err
                                      : ended.err.substr(begin + folder_.string().size() + 1);
  }

  fs::path folder_;
};

TEST_F(WrittenFiles, AreNoneThatIsRead) {
  const std::string program = " is the program itself; write another file\n";
  EXPECT_EQ(refused({"compensate", at("o.nc"), "--record", at("o.nc")}), "o.nc" + program);
  EXPECT_EQ(refused({"compensate", at("o.nc"), "--record", at("link.nc")}), "link.nc" + program);
  EXPECT_EQ(
      refused({"compensate", at("o.nc"), "--force", "--record", at("o.nc"), "-o", at("out.nc")}),
      "o.nc" + program);
  EXPECT_EQ(refused({"compensate", at("o.nc"), "-o", at("link.nc")}),
            "link.nc is the program itself; write another file, or say --force\n");
  const std::string table = " is the table of --tools; write another file\n";
  EXPECT_EQ(refused({"compensate", at("o.nc"), "--tools", at("t.csv"), "-o", at("t.csv")}),
            "t.csv" + table);
  EXPECT_EQ(refused({"compensate", at("o.nc"), "--tools", at("t.csv"), "-o", at("link.csv")}),
            "link.csv" + table);
  EXPECT_EQ(
      refused({"compensate", at("o.nc"), "--tools", at("t.csv"), "--force", "-o", at("t.csv")}),
      "t.csv" + table);
  EXPECT_EQ(refused({"compensate", at("o.nc"), "--subprograms", at("sub.nc"), "-o", at("sub.nc")}),
            "sub.nc is a file of --subprograms; write another file\n");
  EXPECT_EQ(
      refused({"plot", at("o.nc"), "--tools", at("t.csv"), "--format", "svg", "-o", at("t.csv")}),
      "t.csv" + table);
  EXPECT_EQ(refused({"radii", at("o.nc"), "--picture", at("o.nc")}), "o.nc" + program);
}

TEST_F(WrittenFiles, AreEachWrittenOnce) {
  EXPECT_EQ(refused({"compensate", at("o.nc"), "-o", at("z.nc"), "--record", at("z.nc")}),
            "z.nc is the file of -o; write another file\n");
  EXPECT_EQ(refused({"compensate", at("o.nc"), "-o", at("z.nc"), "--record", at("./z.nc")}),
            "./z.nc is the file of -o; write another file\n");
  EXPECT_FALSE(fs::exists(at("z.nc")));
  // They hold nothing.
  EXPECT_EQ(trc({"compensate", at("o.nc"), "-o", "/dev/null", "--record", "/dev/null"}).code, 0);
}

TEST_F(WrittenFiles, OfAFolderHaveNamesOfTheirOwn) {
  write("in/p.nc", demo);
  write("in/p.nc.json", demo);
  EXPECT_NE(refused({"compensate", "--output-dir", at("out"), at("in/p.nc"), at("in/p.nc.json")})
                .find("p.nc.json is given twice; its results would have one name"),
            std::string::npos);
  EXPECT_EQ(refused({"compensate", "--output-dir", at("in"), at("in/p.nc.json"), at("o.nc")}),
            "in/p.nc.json would be written over the program itself\n");
  write("other/p.nc", demo);
  EXPECT_EQ(refused({"compensate", "--output-dir", at("in"), at("in/p.nc.json"), at("other/p.nc")}),
            "in/p.nc.json would be written over the program itself\n");
  write("t/o.nc", "number,radius\n1,5\n");
  EXPECT_EQ(refused({"compensate", "--output-dir", at("t"), "--tools", at("t/o.nc"), at("o.nc")}),
            "t/o.nc would be written over the table of --tools\n");
}

TEST_F(WrittenFiles, OfAnEarlierRunAreWrittenAnew) {
  const std::vector<std::string> call{"compensate",     at("o.nc"),     "--subprograms",
                                      folder_.string(), "-o",           at("made.nc"),
                                      "--record",       at("made.json")};
  EXPECT_EQ(trc(call).code, 0);
  EXPECT_EQ(trc(call).code, 0);
}

TEST(Settings, AreEachGivenOnce) {
  const auto said = [](std::vector<std::string> words) {
    words.insert(words.begin(), {"compensate", "-"});
    const Ended ended = trc(words, demo);
    EXPECT_EQ(ended.code, 2) << ended.out;
    return ended.err;
  };
  const std::string radius = "trc: --set: tool_radius: is given more than once\n";
  EXPECT_EQ(said({"--radius", "5", "--set", "tool_radius=6"}), radius);
  EXPECT_EQ(said({"--set", "tool_radius=5", "--set", "Tool_Radius=5"}), radius);
  EXPECT_EQ(said({"--radius", "5", "--wear", "-0.02", "--set", "wear=0.5"}),
            "trc: --set: wear: is given more than once\n");
  EXPECT_EQ(said({"--set", "stretch_factor=2", "--set", "options.stretch_factor=3"}),
            "trc: --set: options.stretch_factor: is given more than once\n");
  EXPECT_EQ(said({"--variable", "#500=40", "--variable", "#500=41"}),
            "trc: --variable: #500: is given more than once\n");
  EXPECT_EQ(said({"--variable", "#500=40", "--set", "variables=#500=41"}),
            "trc: --variable: #500: is given more than once\n");
  EXPECT_EQ(said({"--set", "variables=#500=40,#500=41"}),
            "trc: --set: variables: #500: is given more than once\n");
  EXPECT_EQ(trc({"compensate", "-", "--set", "tools=1:5", "--set", "tools=2:3", "--variable",
                 "#500=1", "--set", "variables=#501=2"},
                demo)
                .code,
            0);
}

}  // namespace
}  // namespace trc::testing_support
