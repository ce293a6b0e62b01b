#include "proto/wire/json_lines.h"

#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "proto/wire/compensated_block.h"
#include "proto/wire/diagnostic.h"
#include "proto/wire/path_item.h"

namespace trc::wire {
namespace {

std::string line_of(const v1::PathItem& item) {
  JsonLines lines;
  std::string out;
  lines.append(item, out);
  return out;
}

std::string line_of(const CompensatedBlock& block) {
  v1::PathItem item;
  to_proto(block, *item.mutable_block());
  return line_of(item);
}

// The lines of the output format that scripts rely on.
TEST(JsonLines, ApproachLine) {
  EXPECT_EQ(line_of({.source = {.index = 3, .number = 40},
                     .origin = Origin::approach,
                     .path = Line{.start = {0, 0}, .end = {30, 30}},
                     .feed = 1000}),
            R"({"block":{"sourceNumber":"40","sourceIndex":3,"origin":"APPROACH","rapid":false,)"
            R"("start":{"x":0,"y":0,"z":0},"line":{"end":{"x":30,"y":30,"z":0}},"feed":1000}})"
            "\n");
}

TEST(JsonLines, TransitionArc) {
  EXPECT_EQ(
      line_of({.source = {.index = 4, .number = 50},
               .origin = Origin::transition,
               .path = Arc{.start = {0, 10}, .end = {10, 0}, .center = {0, 0}, .sweep = -1.57},
               .feed = 1000}),
      R"({"block":{"sourceNumber":"50","sourceIndex":4,"origin":"TRANSITION",)"
      R"("start":{"x":0,"y":10,"z":0},"arc":{"end":{"x":10,"y":0,"z":0},)"
      R"("center":{"x":0,"y":0,"z":0},"sweep":-1.57},"feed":1000}})"
      "\n");
}

TEST(JsonLines, PassthroughHasTextAlone) {
  EXPECT_EQ(
      line_of({.source = {.index = 5, .number = 55}, .origin = Origin::passthrough, .text = "M8"}),
      R"({"block":{"sourceNumber":"55","sourceIndex":5,"origin":"PASSTHROUGH",)"
      R"("passthrough":{"text":"M8"}}})"
      "\n");
}

// A path through the wall, or a tool of radius 0: what is measured there is no absent field.
TEST(JsonLines, ClearanceOfZeroIsTold) {
  v1::PathItem item;
  to_proto(PathSummary{.clearance = {.worst = verify::Clearance{.distance = 0, .required = 0}}},
           *item.mutable_summary());
  const std::string line = line_of(item);
  const std::string clearance = R"({"distance":0,"toolRadius":0,"point":{"x":0,"y":0,"z":0}})";
  const std::string certificate =
      R"({"clearance":0,"toolRadius":0,"point":{"x":0,"y":0,"z":0},"methodVersion":2})";
  EXPECT_NE(line.find(R"("minClearance":)" + clearance), std::string::npos) << line;
  EXPECT_NE(line.find(R"("certificate":)" + certificate), std::string::npos) << line;
}

TEST(JsonLines, DiagnosticWithValuesInTheOrderOfTheirNames) {
  Diagnostic diagnostic{.code = Code::line_reversed,
                        .severity = Severity::error,
                        .source = {.index = 5, .number = 60, .line = 7},
                        .values = {{.name = "tool_radius", .value = 10},
                                   {.name = "beta", .value = 0.1},
                                   {.name = "alpha", .value = 1}}};
  v1::PathItem item;
  to_proto(diagnostic, *item.mutable_diagnostic());
  const std::string line = line_of(item);
  EXPECT_EQ(line.find(R"({"diagnostic":{"code":90019,"severity":"ERROR","sourceNumber":"60",)"
                      R"("sourceIndex":5,"line":7,"message":")"),
            0U)
      << line;
  EXPECT_NE(line.find(R"("values":{"alpha":1,"beta":0.1,"tool_radius":10})"), std::string::npos)
      << line;
  for (int i = 0; i < 50; ++i) ASSERT_EQ(line_of(item), line);
}

TEST(JsonLines, SummaryPrintsZeroesToo) {
  PathSummary summary;
  summary.summary.blocks_in = 9;
  summary.summary.blocks_out = 10;
  summary.summary.programmed_length = 12.5;
  v1::PathItem item;
  to_proto(summary, *item.mutable_summary());
  EXPECT_EQ(line_of(item), R"({"summary":{"blocksIn":"9","blocksOut":"10","maskedBlocks":"0",)"
                           R"("programmedLength":12.5,"compensatedLength":0}})"
                           "\n");
}

TEST(JsonLines, NumbersReadBackToTheSameDouble) {
  for (const double value : {0.1, 1.0 / 3, std::numbers::pi * 1e5, 5e-324, 999999.9999999999}) {
    v1::PathItem item;
    to_proto({.path = Line{.start = {value, -value}, .end = {0, value}}}, *item.mutable_block());
    v1::PathItem read;
    ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(line_of(item), &read).ok());
    EXPECT_EQ(read.block().start().x(), value);
    EXPECT_EQ(read.block().start().y(), -value);
    EXPECT_EQ(read.block().line().end().y(), value);
  }
}

TEST(JsonLines, LineBreaksInTextStayInTheLine) {
  const std::string line = line_of({.origin = Origin::passthrough, .text = "a\nb\"c"});
  EXPECT_EQ(line.find('\n'), line.size() - 1);
}

}  // namespace
}  // namespace trc::wire
