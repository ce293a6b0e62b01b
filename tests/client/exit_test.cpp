#include <gtest/gtest.h>

#include "client/cli/service.h"

namespace trc::cli {
namespace {

using client::Failure;

TEST(ExitOf, ALimitIsNoFaultOfTheProgram) {
  EXPECT_EQ(exit_of({.status = "RESOURCE_EXHAUSTED", .reason = "MEMORY_LIMIT"}, false),
            Exit::limit);
  EXPECT_EQ(exit_of({.status = "RESOURCE_EXHAUSTED",
                     .message = "Received message larger than max (2000012 vs. 1048576)"},
                    false),
            Exit::limit);
}

// gRPC's own buffers: they say nothing of the program.
TEST(ExitOf, AStreamThatWasCrowdedOutWasLost) {
  EXPECT_EQ(exit_of({.status = "RESOURCE_EXHAUSTED"}, false), Exit::unreachable);
}

TEST(ExitOf, AFaultOfTheServerIsNotThatNobodyIsThere) {
  EXPECT_EQ(exit_of({.status = "INTERNAL", .reason = "INTERNAL"}, false), Exit::internal);
  EXPECT_EQ(exit_of({.status = "INTERNAL", .reason = "SUMMARY_MISSING"}, false), Exit::internal);
  EXPECT_EQ(exit_of({.status = "INTERNAL"}, true), Exit::internal);
  // A balancer that lost its server.
  EXPECT_EQ(exit_of({.status = "INTERNAL"}, false), Exit::unreachable);
}

TEST(ExitOf, AServerThatStopsCannotBeReached) {
  EXPECT_EQ(exit_of({.status = "UNAVAILABLE", .reason = "SERVER_DRAINING"}, false),
            Exit::unreachable);
  EXPECT_EQ(exit_of({.status = "UNAVAILABLE"}, false), Exit::unreachable);
}

TEST(ExitOf, AWrongFieldIsAWrongCall) {
  EXPECT_EQ(exit_of({.status = "INVALID_ARGUMENT", .reason = "FIELD_INVALID"}, false),
            Exit::wrong_call);
}

}  // namespace
}  // namespace trc::cli
