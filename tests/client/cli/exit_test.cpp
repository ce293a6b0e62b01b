#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "client/cli/service.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "tests/support/process.h"
#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::cli {
namespace {

using client::Failure;

TEST(ExitOf, ALimitIsNoFaultOfTheProgram) {
  EXPECT_EQ(exit_of({.status = "RESOURCE_EXHAUSTED", .reason = "MEMORY_LIMIT"}, ServedBy::server),
            Exit::limit);
  EXPECT_EQ(exit_of({.status = "RESOURCE_EXHAUSTED",
                     .message = "Received message larger than max (2000012 vs. 1048576)"},
                    ServedBy::server),
            Exit::limit);
}

// gRPC's own buffers: they say nothing of the program.
TEST(ExitOf, AStreamThatWasCrowdedOutWasLost) {
  EXPECT_EQ(exit_of({.status = "RESOURCE_EXHAUSTED"}, ServedBy::server), Exit::unreachable);
}

TEST(ExitOf, AFaultOfTheServerIsNotThatNobodyIsThere) {
  EXPECT_EQ(exit_of({.status = "INTERNAL", .reason = "INTERNAL"}, ServedBy::server),
            Exit::internal);
  EXPECT_EQ(exit_of({.status = "INTERNAL", .reason = "SUMMARY_MISSING"}, ServedBy::server),
            Exit::internal);
  EXPECT_EQ(exit_of({.status = "INTERNAL"}, ServedBy::this_process), Exit::internal);
  // A balancer that lost its server.
  EXPECT_EQ(exit_of({.status = "INTERNAL"}, ServedBy::server), Exit::unreachable);
}

TEST(ExitOf, AServerThatStopsCannotBeReached) {
  EXPECT_EQ(exit_of({.status = "UNAVAILABLE", .reason = "SERVER_DRAINING"}, ServedBy::server),
            Exit::unreachable);
  EXPECT_EQ(exit_of({.status = "UNAVAILABLE"}, ServedBy::server), Exit::unreachable);
}

TEST(ExitOf, AServerThatWasStartedAnewWasLost) {
  EXPECT_EQ(
      exit_of({.status = "INVALID_ARGUMENT", .reason = "RESUME_TOKEN_INVALID"}, ServedBy::server),
      Exit::unreachable);
  EXPECT_EQ(exit_of({.status = "FAILED_PRECONDITION", .reason = "RESUME_TOKEN_OF_OTHER_VERSION"},
                    ServedBy::server),
            Exit::unreachable);
}

TEST(ExitOf, AWrongFieldIsAWrongCall) {
  EXPECT_EQ(exit_of({.status = "INVALID_ARGUMENT", .reason = "FIELD_INVALID"}, ServedBy::server),
            Exit::wrong_call);
}

// A server that fails in one way at every program.
class Failing final : public v1::TrcService::Service {
 public:
  explicit Failing(grpc::Status status) : status_(std::move(status)) {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
  }
  ~Failing() override { server_->Shutdown(); }
  Failing(const Failing&) = delete;
  Failing& operator=(const Failing&) = delete;

  grpc::Status CompensateProgram(
      grpc::ServerContext* /*context*/,
      grpc::ServerReaderWriter<v1::CompensateProgramResponse, v1::CompensateProgramRequest>* stream)
      override {
    v1::CompensateProgramRequest request;
    stream->Read(&request);
    v1::CompensateProgramResponse accepted;
    accepted.mutable_accepted()->set_max_batches_in_flight(4);
    stream->Write(accepted);
    while (stream->Read(&request) && !request.text().final()) {
    }
    return status_;
  }
  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

 private:
  grpc::Status status_;
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

grpc::Status with_reason(grpc::StatusCode code, const std::string& reason) {
  google::rpc::ErrorInfo info;
  info.set_reason(reason);
  google::rpc::Status rich;
  rich.set_code(static_cast<int>(code));
  rich.set_message("what happened");
  rich.add_details()->PackFrom(info);
  return {code, rich.message(), rich.SerializeAsString()};
}

testing_support::Ended ended_with(const grpc::Status& status) {
  const Failing server(status);
  return testing_support::run(
      {testing_support::trc_program(), "compensate", "-", "--server", server.address()},
      "G0 X1\nM30\n");
}

TEST(ExitCode, IsFiveForAFaultOfTheServer) {
  const auto failed = ended_with(with_reason(grpc::StatusCode::INTERNAL, "INTERNAL"));
  EXPECT_EQ(failed.code, 5) << failed.err;
  EXPECT_NE(failed.err.find("what happened"), std::string::npos) << failed.err;
  EXPECT_EQ(failed.out, "");
  const auto halved = ended_with(grpc::Status::OK);
  EXPECT_EQ(halved.code, 5) << halved.err;
  EXPECT_NE(halved.err.find("without a summary"), std::string::npos) << halved.err;
}

TEST(ExitCode, IsFourForALimitOfTheServer) {
  const auto limit = ended_with(with_reason(grpc::StatusCode::RESOURCE_EXHAUSTED, "CPU_LIMIT"));
  EXPECT_EQ(limit.code, 4) << limit.err;
}

}  // namespace
}  // namespace trc::cli
