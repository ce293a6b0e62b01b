#include "proto/wire/diagnostic.h"

#include <gtest/gtest.h>

#include "proto/wire/path_item.h"

namespace trc::wire {
namespace {

TEST(DiagnosticMessage, ReadsBackEveryField) {
  const Diagnostic sent{
      .code = Code::tool_not_smaller_than_arc,
      .severity = Severity::warning,
      .source = {.index = 4, .number = 60, .line = 7},
      .column = 3,
      .detail = "G03",
      .values = {{.name = "arc_radius", .value = 6}, {.name = "tool_radius", .value = 10}},
      .point = DiagnosticPoint{.x = 1, .y = 2, .z = 0}};
  v1::Diagnostic message;
  to_proto(sent, message);
  const ReceivedDiagnostic read = from_proto(message);
  EXPECT_EQ(read.diagnostic.code, sent.code);
  EXPECT_EQ(read.diagnostic.severity, sent.severity);
  EXPECT_EQ(read.diagnostic.source, sent.source);
  EXPECT_EQ(read.diagnostic.column, sent.column);
  EXPECT_EQ(read.diagnostic.detail, sent.detail);
  ASSERT_EQ(read.diagnostic.values.size(), 2U);
  EXPECT_EQ(read.diagnostic.values[0].name, "arc_radius");
  EXPECT_EQ(read.diagnostic.values[1].value, 10);
  ASSERT_TRUE(read.diagnostic.point);
  EXPECT_EQ(read.diagnostic.point->y, 2);
  EXPECT_EQ(read.message, message_of(sent));
  EXPECT_EQ(read.remedy, row_of(sent.code).remedy);
  EXPECT_EQ(read.reason, row_of(sent.code).reason);
}

TEST(DiagnosticMessage, ReadsBackAbsence) {
  v1::Diagnostic message;
  to_proto({.code = Code::line_reversed}, message);
  EXPECT_FALSE(message.has_source_number());
  EXPECT_FALSE(message.has_line());
  EXPECT_FALSE(message.has_point());
  const ReceivedDiagnostic read = from_proto(message);
  EXPECT_EQ(read.diagnostic.source, Source{});
  EXPECT_FALSE(read.diagnostic.point);
}

TEST(DiagnosticMessage, EveryCodeHasTextsAndReadsBack) {
  for (const CodeRow& row : code_table()) {
    v1::Diagnostic message;
    to_proto(diagnostic(row.code, {}), message);
    EXPECT_FALSE(message.message().empty()) << message.code();
    EXPECT_FALSE(message.remedy().empty()) << message.code();
    EXPECT_EQ(from_proto(message).diagnostic.code, row.code);
    EXPECT_EQ(from_proto(message).diagnostic.severity, row.severity) << message.code();
  }
}

TEST(DiagnosticMessage, SeverityFromANewerServerCountsAsError) {
  v1::Diagnostic message;
  message.set_severity(static_cast<v1::Diagnostic::Severity>(17));
  EXPECT_EQ(from_proto(message).diagnostic.severity, Severity::error);
}

TEST(SummaryMessage, ReadsBackEveryField) {
  ProgramSummary sent{
      .path = {.notes = 1, .warnings = 2, .wall_time_seconds = 0.5, .cpu_time_seconds = 0.25},
      .lines_in = 3,
      .bytes_in = 4,
      .bytes_out = 5};
  Summary& core = sent.path.summary;
  core.blocks_in = 20;
  core.blocks_out = 55;
  for (std::size_t origin = 0; origin < origin_count; ++origin)
    core.blocks_by_origin[origin] = origin + 1;
  core.programmed_length = 100.5;
  core.compensated_length = 99.5;
  sent.path.clearance = {.worst = verify::Clearance{.distance = 9.75,
                                                    .required = 10,
                                                    .place = {1, 2, 3},
                                                    .path = {.index = 4, .number = 50},
                                                    .contour = {.index = 6}},
                         .checked = 7,
                         .gouging = 8};
  v1::ProgramSummary message;
  to_proto(sent, message);
  const ProgramSummary read = from_proto(message);
  EXPECT_EQ(read.path.summary.blocks_in, 20U);
  EXPECT_EQ(read.path.summary.blocks_out, 55U);
  EXPECT_EQ(read.path.summary.blocks_by_origin, core.blocks_by_origin);
  EXPECT_EQ(read.path.summary.programmed_length, 100.5);
  EXPECT_EQ(read.path.summary.compensated_length, 99.5);
  ASSERT_TRUE(read.path.clearance.worst);
  EXPECT_EQ(read.path.clearance.worst->distance, 9.75);
  EXPECT_EQ(read.path.clearance.worst->required, 10);
  EXPECT_EQ(read.path.clearance.worst->place, (Position{1, 2, 3}));
  EXPECT_EQ(read.path.clearance.worst->path, (Source{.index = 4, .number = 50}));
  EXPECT_EQ(read.path.clearance.worst->contour, (Source{.index = 6}));
  EXPECT_EQ(read.path.clearance.checked, 7U);
  EXPECT_EQ(read.path.clearance.gouging, 8U);
  EXPECT_EQ(read.path.notes, 1U);
  EXPECT_EQ(read.path.warnings, 2U);
  EXPECT_EQ(read.path.wall_time_seconds, 0.5);
  EXPECT_EQ(read.path.cpu_time_seconds, 0.25);
  EXPECT_EQ(read.lines_in, 3U);
  EXPECT_EQ(read.bytes_in, 4U);
  EXPECT_EQ(read.bytes_out, 5U);
  EXPECT_EQ(message.path().masked_blocks(),
            core.blocks_by_origin[static_cast<std::size_t>(Origin::masked)]);
}

}  // namespace
}  // namespace trc::wire
