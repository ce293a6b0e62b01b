#include "client/trc/failure.h"

#include <grpcpp/support/status.h>
#include <gtest/gtest.h>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace trc::client {
namespace {

// The status of a refusal by the server.
grpc::Status refusal(const std::string& reason, int retry_after_s) {
  google::rpc::ErrorInfo info;
  info.set_reason(reason);
  google::rpc::Status rich;
  rich.set_code(grpc::RESOURCE_EXHAUSTED);
  rich.set_message("no place");
  rich.add_details()->PackFrom(info);
  if (retry_after_s > 0) {
    google::rpc::RetryInfo retry;
    retry.mutable_retry_delay()->set_seconds(retry_after_s);
    rich.add_details()->PackFrom(retry);
  }
  return {grpc::RESOURCE_EXHAUSTED, "no place", rich.SerializeAsString()};
}

// gRPC's own buffers were full: any stream may be hit.
TEST(Failure, AStreamThatWasCrowdedOutIsLost) {
  const auto failure = failure_of(grpc::Status(grpc::RESOURCE_EXHAUSTED, "Buffers full"));
  ASSERT_TRUE(failure);
  EXPECT_TRUE(failure->stream_lost());
  EXPECT_TRUE(failure->not_taken());
  EXPECT_TRUE(failure->unreachable());
}

TEST(Failure, AMessageThatIsTooLargeIsNot) {
  const auto failure = failure_of(grpc::Status(
      grpc::RESOURCE_EXHAUSTED, "Received message larger than max (2000012 vs. 1048576)"));
  ASSERT_TRUE(failure);
  EXPECT_FALSE(failure->stream_lost());
  EXPECT_FALSE(failure->unreachable());
}

TEST(Failure, WhoeverHasAReasonSaysWhetherWaitingHelps) {
  const auto full = failure_of(refusal("STREAM_LIMIT", 1));
  ASSERT_TRUE(full);
  EXPECT_FALSE(full->stream_lost());
  EXPECT_TRUE(full->asks_to_wait());
  const auto too_large = failure_of(refusal("MEMORY_LIMIT", 0));
  ASSERT_TRUE(too_large);
  EXPECT_FALSE(too_large->stream_lost());
  EXPECT_FALSE(too_large->asks_to_wait());
}

}  // namespace
}  // namespace trc::client
