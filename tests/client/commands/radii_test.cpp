#include <google/protobuf/struct.pb.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "tests/client/commands/called.h"
#include "tests/support/process.h"
#include "tests/support/slot.h"

namespace trc::testing_support {
namespace {

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

TEST(Radii, AreDrawnAsSvgAlone) {
  const Folder folder;
  const Ended ended = trc({"radii", "-", "--radii", "2", "--picture", folder.path("a.pdf")}, slot);
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.err, "trc: --picture " + folder.path("a.pdf") + ": the name must end in .svg\n");
  EXPECT_EQ(ended.out, "");
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

}  // namespace
}  // namespace trc::testing_support
