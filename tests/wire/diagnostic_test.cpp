#include "proto/wire/diagnostic.h"

#include <gtest/gtest.h>

#include <memory>

#include "core/base/entry_help.h"
#include "core/messages/diagnostic_text.h"
#include "core/messages/english.h"
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
  const Diagnostic read = from_proto(message);
  EXPECT_EQ(read.code, sent.code);
  EXPECT_EQ(read.severity, sent.severity);
  EXPECT_EQ(read.source, sent.source);
  EXPECT_EQ(read.column, sent.column);
  EXPECT_EQ(read.detail, sent.detail);
  ASSERT_EQ(read.values.size(), 2U);
  EXPECT_EQ(read.values[0].name, "arc_radius");
  EXPECT_EQ(read.values[1].value, 10);
  ASSERT_TRUE(read.point);
  EXPECT_EQ(read.point->y, 2);
  const DiagnosticTexts texts = texts_of(read);
  EXPECT_EQ(texts.message, message_of(sent));
  EXPECT_EQ(texts.remedy, english_row_of(sent.code).remedy);
  EXPECT_EQ(texts.reason, row_of(sent.code).reason);
}

TEST(DiagnosticMessage, CarriesTextsAndPlacesForPeople) {
  Diagnostic sent = diagnostic(Code::bottleneck, {.index = 4, .number = 60, .line = 7});
  sent.column = 3;
  sent.values = {{"clearance", 2.54}};
  append_place(sent.values, "other", {.index = 8, .number = 90, .line = 10});
  sent.inch = true;
  sent.language = Language::german;
  v1::Diagnostic message;
  to_proto(sent, message);
  EXPECT_EQ(message.title(), title_of(Code::bottleneck, Language::german));
  EXPECT_EQ(message.text(), message_of(sent, Language::german));
  EXPECT_NE(message.text().find("0.1000 in"), std::string::npos) << message.text();
  EXPECT_EQ(message.help(), help_of(sent, Language::german));
  EXPECT_EQ(message.message(), message_of(sent));
  EXPECT_EQ(message.remedy(), english_row_of(Code::bottleneck).remedy);
  EXPECT_EQ(message.language(), "de");
  EXPECT_EQ(message.place().line(), 7U);
  EXPECT_EQ(message.place().column(), 3U);
  EXPECT_EQ(message.place().source_number(), 60U);
  EXPECT_EQ(message.place().source_index(), 4U);
  ASSERT_EQ(message.related_places_size(), 1);
  EXPECT_EQ(message.related_places(0).name(), "other");
  EXPECT_EQ(message.related_places(0).text(), "anderer Satz");
  EXPECT_EQ(message.related_places(0).place().line(), 10U);
  EXPECT_EQ(message.related_places(0).place().source_number(), 90U);
  EXPECT_FALSE(message.related_places(0).place().has_column());

  // What a client writes down again is what it got.
  v1::Diagnostic again;
  to_proto(from_proto(message), again);
  EXPECT_EQ(again.title(), message.title());
  EXPECT_EQ(again.text(), message.text());
  EXPECT_EQ(again.help(), message.help());
  EXPECT_EQ(again.language(), message.language());
  EXPECT_TRUE(again.inch());
  EXPECT_EQ(again.place().SerializeAsString(), message.place().SerializeAsString());
  ASSERT_EQ(again.related_places_size(), 1);
  EXPECT_EQ(again.related_places(0).SerializeAsString(),
            message.related_places(0).SerializeAsString());
}

TEST(DiagnosticMessage, IsReadAlsoWhereItsProgramIsLatin1) {
  Diagnostic sent = diagnostic(Code::tool_unknown, {.line = 2}, "FR\xC4SER");
  v1::Diagnostic message;
  to_proto(sent, message);
  v1::Diagnostic received;
  ASSERT_TRUE(received.ParseFromString(message.SerializeAsString()));
  EXPECT_EQ(received.detail(), "FRÄSER");
  EXPECT_NE(received.text().find("FRÄSER"), std::string::npos) << received.text();
}

TEST(DiagnosticMessage, ReadsBackAbsence) {
  v1::Diagnostic message;
  to_proto({.code = Code::line_reversed}, message);
  EXPECT_FALSE(message.has_source_number());
  EXPECT_FALSE(message.has_line());
  EXPECT_FALSE(message.has_point());
  const Diagnostic read = from_proto(message);
  EXPECT_EQ(read.source, Source{});
  EXPECT_FALSE(read.point);
}

TEST(DiagnosticMessage, ReadsBackWhatItProposes) {
  EntryHelp help{.leaves = true,
                 .third_axis = 1,
                 .given_length = 3,
                 .needed_length = 5,
                 .tried_on = 2,
                 .replaced = 6,
                 .left_out = 4,
                 .legal = DiagnosticPoint{.x = 1, .y = 2, .z = 3}};
  help.proposals.push_back({.shape = EntryProposal::Shape::quarter_circle,
                            .start = {.x = 4, .y = 5, .z = 6},
                            .blocks = {{.end = {.x = 7, .y = 8, .z = 9}},
                                       {.end = {.x = 10, .y = 11, .z = 12},
                                        .center = DiagnosticPoint{.x = 13, .y = 14, .z = 15},
                                        .sweep = -1.5}}});
  Diagnostic sent = diagnostic(Code::selection_block_too_short, {});
  sent.entry_help = std::make_shared<const EntryHelp>(help);
  v1::Diagnostic message;
  to_proto(sent, message);
  const auto read = from_proto(message).entry_help;
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->leaves);
  EXPECT_EQ(read->third_axis, 1);
  EXPECT_EQ(read->given_length, 3);
  EXPECT_EQ(read->needed_length, 5);
  EXPECT_EQ(read->tried_on, 2U);
  EXPECT_EQ(read->replaced, 6U);
  EXPECT_EQ(read->left_out, 4U);
  ASSERT_TRUE(read->legal);
  EXPECT_EQ(read->legal->y, 2);
  ASSERT_EQ(read->proposals.size(), 1U);
  const EntryProposal& proposal = read->proposals[0];
  EXPECT_EQ(proposal.shape, EntryProposal::Shape::quarter_circle);
  EXPECT_EQ(proposal.start.z, 6);
  ASSERT_EQ(proposal.blocks.size(), 2U);
  EXPECT_EQ(proposal.blocks[0].end.x, 7);
  EXPECT_FALSE(proposal.blocks[0].center);
  EXPECT_EQ(proposal.blocks[1].end.y, 11);
  ASSERT_TRUE(proposal.blocks[1].center);
  EXPECT_EQ(proposal.blocks[1].center->z, 15);
  EXPECT_EQ(proposal.blocks[1].sweep, -1.5);
}

// Where nothing is of use, nothing is sent of it.
TEST(DiagnosticMessage, LeavesOutWhatNothingIsProposedOf) {
  v1::Diagnostic message;
  to_proto({.code = Code::line_reversed}, message);
  EXPECT_FALSE(message.has_entry_help());
  EXPECT_FALSE(from_proto(message).entry_help);
  Diagnostic start = diagnostic(Code::selection_point_too_near, {});
  start.entry_help = std::make_shared<const EntryHelp>(EntryHelp{.given_length = 3});
  to_proto(start, message);
  EXPECT_FALSE(message.entry_help().has_needed_length());
  EXPECT_FALSE(message.entry_help().has_legal_point());
}

TEST(DiagnosticMessage, EveryCodeHasTextsAndReadsBack) {
  for (const CodeRow& row : code_table()) {
    v1::Diagnostic message;
    to_proto(diagnostic(row.code, {}), message);
    EXPECT_FALSE(message.message().empty()) << message.code();
    EXPECT_FALSE(message.remedy().empty()) << message.code();
    EXPECT_EQ(from_proto(message).code, row.code);
    EXPECT_EQ(from_proto(message).severity, row.severity) << message.code();
  }
}

TEST(DiagnosticMessage, SeverityFromANewerServerCountsAsError) {
  v1::Diagnostic message;
  message.set_severity(static_cast<v1::Diagnostic::Severity>(17));
  EXPECT_EQ(from_proto(message).severity, Severity::error);
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
