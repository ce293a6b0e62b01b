#include "server/rpc/status.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/messages/diagnostic_text.h"
#include "core/messages/english.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace trc::server {
namespace {

google::rpc::Status rich(const Ending& ending) {
  google::rpc::Status status;
  EXPECT_TRUE(status.ParseFromString(ending.status.error_details()));
  return status;
}

// The one detail of a type; a status carries each type at most once.
template <class Detail>
Detail detail(const google::rpc::Status& status) {
  Detail found;
  int count = 0;
  for (const auto& any : status.details())
    if (any.UnpackTo(&found)) ++count;
  EXPECT_EQ(count, 1) << Detail::descriptor()->full_name();
  return found;
}

struct Case {
  Refusal refusal;
  grpc::StatusCode code;
  const char* reason;
  bool retry;
};

const Case cases[] = {
    {Refusal::setup_missing, grpc::FAILED_PRECONDITION, "SETUP_MISSING", false},
    {Refusal::setup_repeated, grpc::FAILED_PRECONDITION, "SETUP_REPEATED", false},
    {Refusal::request_empty, grpc::INVALID_ARGUMENT, "REQUEST_EMPTY", false},
    {Refusal::request_unreadable, grpc::INVALID_ARGUMENT, "REQUEST_UNREADABLE", false},
    {Refusal::json_unreadable, grpc::INVALID_ARGUMENT, "REQUEST_UNREADABLE", false},
    {Refusal::call_invalid, grpc::INVALID_ARGUMENT, "CALL_INVALID", false},
    {Refusal::stream_needs_grpc, grpc::UNIMPLEMENTED, "STREAM_NEEDS_GRPC", false},
    {Refusal::rpc_unknown, grpc::UNIMPLEMENTED, "RPC_UNKNOWN", false},
    {Refusal::input_after_final, grpc::FAILED_PRECONDITION, "INPUT_AFTER_FINAL", false},
    {Refusal::batch_out_of_sequence, grpc::OUT_OF_RANGE, "BATCH_OUT_OF_SEQUENCE", false},
    {Refusal::text_out_of_sequence, grpc::OUT_OF_RANGE, "TEXT_OUT_OF_SEQUENCE", false},
    {Refusal::contour_incomplete, grpc::ABORTED, "CONTOUR_INCOMPLETE", false},
    {Refusal::stream_idle, grpc::ABORTED, "STREAM_IDLE", false},
    {Refusal::field_invalid, grpc::INVALID_ARGUMENT, "FIELD_INVALID", false},
    {Refusal::field_unknown, grpc::INVALID_ARGUMENT, "FIELD_UNKNOWN", false},
    {Refusal::message_too_large, grpc::RESOURCE_EXHAUSTED, "MESSAGE_TOO_LARGE", false},
    {Refusal::batch_too_large, grpc::RESOURCE_EXHAUSTED, "BATCH_TOO_LARGE", false},
    {Refusal::answer_too_large, grpc::RESOURCE_EXHAUSTED, "ANSWER_TOO_LARGE", false},
    {Refusal::stream_limit, grpc::RESOURCE_EXHAUSTED, "STREAM_LIMIT", true},
    {Refusal::stream_limit_of_peer, grpc::RESOURCE_EXHAUSTED, "STREAM_LIMIT", true},
    {Refusal::memory_limit, grpc::RESOURCE_EXHAUSTED, "MEMORY_LIMIT", true},
    {Refusal::memory_limit_of_peer, grpc::RESOURCE_EXHAUSTED, "MEMORY_LIMIT", true},
    {Refusal::memory_limit_of_stream, grpc::RESOURCE_EXHAUSTED, "MEMORY_LIMIT", false},
    {Refusal::memory_limit_of_process, grpc::RESOURCE_EXHAUSTED, "MEMORY_LIMIT", true},
    {Refusal::cpu_limit, grpc::RESOURCE_EXHAUSTED, "CPU_LIMIT", false},
    {Refusal::resume_token_invalid, grpc::INVALID_ARGUMENT, "RESUME_TOKEN_INVALID", false},
    {Refusal::resume_token_of_other_version, grpc::FAILED_PRECONDITION,
     "RESUME_TOKEN_OF_OTHER_VERSION", false},
    {Refusal::resume_setup_differs, grpc::FAILED_PRECONDITION, "RESUME_SETUP_DIFFERS", false},
    {Refusal::client_not_allowed, grpc::PERMISSION_DENIED, "CLIENT_NOT_ALLOWED", false},
    {Refusal::draining, grpc::UNAVAILABLE, "SERVER_DRAINING", true},
    {Refusal::drain_timeout, grpc::UNAVAILABLE, "DRAIN_TIMEOUT", true},
    {Refusal::cancelled, grpc::CANCELLED, "CANCELLED", false},
    {Refusal::deadline_exceeded, grpc::DEADLINE_EXCEEDED, "DEADLINE_EXCEEDED", false},
    {Refusal::internal, grpc::INTERNAL, "INTERNAL", false},
};

TEST(Status, EveryRefusalHasItsCodeAndReason) {
  for (const Case& tested : cases) {
    SCOPED_TRACE(tested.reason);
    const Ending ending = refuse(tested.refusal, "something", {{"got", "7"}});
    EXPECT_EQ(ending.status.error_code(), tested.code);
    EXPECT_EQ(ending.reason, tested.reason);
    const google::rpc::Status status = rich(ending);
    EXPECT_EQ(status.code(), tested.code);
    EXPECT_EQ(status.message(), ending.status.error_message());
    const auto info = detail<google::rpc::ErrorInfo>(status);
    EXPECT_EQ(info.reason(), tested.reason);
    EXPECT_EQ(info.domain(), "trc.v1");
    EXPECT_EQ(info.metadata().at("got"), "7");
    EXPECT_NE(status.message().find("something"), std::string::npos);
    const std::string german = translated(status.message(), {refusal_sentences()});
    EXPECT_NE(german, status.message());
    EXPECT_EQ(german.find(" the "), std::string::npos) << german;
    EXPECT_NE(german.find("something"), std::string::npos) << german;
    if (tested.retry) {
      EXPECT_GT(detail<google::rpc::RetryInfo>(status).retry_delay().seconds(), 0);
    }
  }
}

TEST(Status, InvalidPartOfARequestIsNamed) {
  for (const Refusal refusal : {Refusal::resume_token_invalid, Refusal::request_empty}) {
    const google::rpc::Status status =
        rich(refuse(refusal, "something", {{"field", "setup.part"}}));
    const auto fields = detail<google::rpc::BadRequest>(status);
    ASSERT_EQ(fields.field_violations_size(), 1);
    EXPECT_EQ(fields.field_violations(0).field(), "setup.part");
    EXPECT_EQ(fields.field_violations(0).description(), status.message());
    // What helps comes after what is wrong.
    EXPECT_NE(status.message().find("; "), std::string::npos) << status.message();
  }
  EXPECT_EQ(rich(refuse(Refusal::setup_missing, {}, {{"field", "setup"}})).details_size(), 1);
}

TEST(Status, DetailsAreInGermanAsWell) {
  for (const char* detail :
       {"setup, batch or columns", "SurveyRadii takes none",
        "it was changed, or comes from a server with another resume-key-file"}) {
    const Ending ending = refuse(Refusal::resume_token_invalid, detail);
    const std::string german = translated(ending.status.error_message(), {refusal_sentences()});
    EXPECT_EQ(german.find(detail), std::string::npos) << german;
  }
}

TEST(Status, FaultInTheProgramCarriesPlaceValuesAndRemedy) {
  Diagnostic fault = diagnostic(Code::line_reversed, {.index = 6, .number = 60, .line = 7});
  fault.column = 3;
  fault.values = {{.name = "tool_radius", .value = 10.25}};
  const Ending ending = refuse(fault);
  EXPECT_EQ(ending.status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(ending.reason, row_of(Code::line_reversed).reason);
  EXPECT_NE(ending.status.error_message().find("line 7: error 90019"), std::string::npos)
      << ending.status.error_message();
  const auto info = detail<google::rpc::ErrorInfo>(rich(ending));
  EXPECT_EQ(info.metadata().at("code"), "90019");
  EXPECT_EQ(info.metadata().at("line"), "7");
  EXPECT_EQ(info.metadata().at("column"), "3");
  EXPECT_EQ(info.metadata().at("source_number"), "60");
  EXPECT_EQ(info.metadata().at("source_index"), "6");
  EXPECT_EQ(info.metadata().at("tool_radius"), "10.25");
  EXPECT_EQ(info.metadata().at("remedy"), english_row_of(Code::line_reversed).remedy);
}

TEST(Status, AnotherLanguageIsADetailOfItsOwn) {
  Diagnostic fault = diagnostic(Code::line_reversed, {.index = 6, .number = 60, .line = 7});
  const google::rpc::Status english = rich(refuse(fault));
  fault.language = Language::german;
  const google::rpc::Status german = rich(refuse(fault));
  EXPECT_EQ(german.message(), english.message());
  ASSERT_EQ(german.details_size(), english.details_size() + 1);
  const auto localized = detail<google::rpc::LocalizedMessage>(german);
  EXPECT_EQ(localized.locale(), "de");
  EXPECT_NE(localized.message().find("in Zeile 7 (N60): "), std::string::npos)
      << localized.message();
  EXPECT_NE(localized.message().find(help_of(fault, Language::german)), std::string::npos)
      << localized.message();
}

TEST(Status, WrongFieldsAreNamedAndTheirNumberBounded) {
  wire::FieldFaults faults;
  for (int i = 0; i < 33; ++i)
    faults.add(
        {.field = "batch.blocks[" + std::to_string(i) + "].linear.end.x", .description = "is nan"});
  const google::rpc::Status status = rich(refuse(faults));
  EXPECT_EQ(status.code(), grpc::INVALID_ARGUMENT);
  const auto fields = detail<google::rpc::BadRequest>(status);
  ASSERT_EQ(fields.field_violations_size(), 20);
  EXPECT_EQ(fields.field_violations(19).field(), "batch.blocks[19].linear.end.x");
  EXPECT_EQ(detail<google::rpc::ErrorInfo>(status).metadata().at("field_violations_dropped"), "13");
}

// Trailers beyond 8 KB make the peer drop the whole status.
TEST(Status, FitsTheTrailersWhateverTheClientSent) {
  const std::string junk(100'000, '\xFF');
  wire::FieldFaults faults;
  for (int i = 0; i < 100; ++i) faults.add({.field = junk, .description = junk});
  Diagnostic fault = diagnostic(Code::nc_syntax, {});
  fault.detail = junk;
  Diagnostic german = fault;
  german.language = Language::german;
  for (const Ending& ending : {refuse(faults), refuse(Refusal::internal, junk, {{"got", junk}}),
                               refuse(fault), refuse(german)}) {
    // Base64 for the details, percent-encoding for the message.
    EXPECT_LT(
        ending.status.error_details().size() * 4 / 3 + ending.status.error_message().size() * 3,
        7500U);
    EXPECT_TRUE(rich(ending).IsInitialized());
  }
}

TEST(Status, EveryCodeOfTheCoreHasAReasonOfItsOwn) {
  std::set<std::string> reasons;
  for (const CodeRow& row : code_table()) {
    const Ending ending = refuse(diagnostic(row.code, {}));
    // The core has one limit of its own; every other code is a fault in the program.
    EXPECT_EQ(ending.status.error_code(), row.code == Code::selection_too_long
                                              ? grpc::RESOURCE_EXHAUSTED
                                              : grpc::INVALID_ARGUMENT)
        << row.reason;
    EXPECT_TRUE(reasons.insert(ending.reason).second) << ending.reason;
    EXPECT_EQ(ending.reason.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_"),
              std::string::npos)
        << ending.reason;
  }
}

}  // namespace
}  // namespace trc::server
