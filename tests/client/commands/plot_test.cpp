#include <gtest/gtest.h>

#include <string>

#include "tests/client/commands/called.h"
#include "tests/support/process.h"

namespace trc::testing_support {
namespace {

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

}  // namespace
}  // namespace trc::testing_support
