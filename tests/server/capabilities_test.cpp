#include "server/rpc/capabilities.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "server/in_process.h"
#include "tests/server/calls.h"

// What GetServerInfo says is what the reader of NC text does.
namespace trc::server {
namespace {

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

TEST(Capabilities, EveryGFunctionIsRead) {
  const InProcessServer server;
  for (const GFunction& function : g_functions()) {
    const std::string name(function.name);
    const bool circle = name == "G02" || name == "G03";
    const std::string words = circle          ? " X20 Y0 I10 J0"
                              : name == "G04" ? " X1"
                              : name == "G00" ? " X5"
                                              : "";
    // G05 stands with a selection only.
    const std::string line = name == "G05" ? "G41 G05 G01 X10 Y10" : name + words;
    const Answer answer =
        run_program(server.channel(), {}, "G01 X0 Y0 F100\n" + line + "\nG40\nG01 X40 Y40\nM30\n");
    EXPECT_TRUE(answer.status.ok()) << name << ": " << answer.status.error_message();
  }
}

TEST(Capabilities, EveryKeywordIsReadOrRefusedAsSaid) {
  const InProcessServer server;
  for (const Keyword& keyword : trc_keywords()) {
    const std::string name(keyword.name);
    const std::string words = name.starts_with("DIST_") || name.starts_with("FEED_")
                                  ? "SPLIT_PATH PRE DIST_SEG1=5 FEED_SEG1=200 DIST_SEG2=5 "
                                    "FEED_SEG2=200"
                              : name == "SPLIT"      ? "SPLIT AX=X PRE DIST_SEG1=5 FEED_SEG1=200"
                              : name == "SPLIT_PATH" ? "SPLIT_PATH PRE DIST_SEG1=5 FEED_SEG1=200"
                              : name == "INVERSE"    ? "ONLINE=1 INVERSE=1"
                              : name == "SPLIT_OFF"  ? "SPLIT_OFF"
                                                     : name + "=" + number(keyword.max);
    const Answer answer =
        run_program(server.channel(), {},
                    "G01 X0 Y0 F100\n#TRC [" + words +
                        "]\nV.G.WZ_AKT.R=1\nG141 G41 G01 X40\nX80\nG40 X120 Y-20\nM30\n");
    if (keyword.available) {
      EXPECT_TRUE(answer.status.ok()) << words << ": " << answer.status.error_message();
      EXPECT_TRUE(answer.diagnostics.empty()) << words;
    } else {
      EXPECT_EQ(answer.metadata("code"), "900102") << words << answer.status.error_message();
    }
  }
}

}  // namespace
}  // namespace trc::server
