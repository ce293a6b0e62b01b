// A survey that does not come to its end at once: what is handed on, and when it is asked for anew.

#include "client/trc/survey.h"

#include <google/rpc/error_details.pb.h>
#include <google/rpc/status.pb.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::client {
namespace {

struct Call {
  std::vector<double> radii{};
  grpc::Status status{};
  // Of the summary, where one comes before a status that is not OK.
  std::optional<double> wall_time_s{};
  int pieces = 0;  // of the text, each answered by nothing
};

grpc::Status no_place() {
  google::rpc::Status rich;
  rich.set_code(grpc::RESOURCE_EXHAUSTED);
  google::rpc::ErrorInfo info;
  info.set_reason("MEMORY_LIMIT");
  rich.add_details()->PackFrom(info);
  google::rpc::RetryInfo retry;
  retry.mutable_retry_delay()->set_nanos(1'000'000);
  rich.add_details()->PackFrom(retry);
  return {grpc::RESOURCE_EXHAUSTED, "no place", rich.SerializeAsString()};
}

// Answers its calls as it was told, one after the other; with a summary where the status is OK.
class Told final : public v1::TrcService::Service {
 public:
  explicit Told(std::vector<Call> calls) : calls_(std::move(calls)) {
    server_ = grpc::ServerBuilder().RegisterService(this).BuildAndStart();
  }
  ~Told() override { server_->Shutdown(); }

  grpc::Status SurveyRadii(
      grpc::ServerContext* /*context*/,
      grpc::ServerReaderWriter<v1::SurveyRadiiResponse, v1::SurveyRadiiRequest>* stream) override {
    const Call& call = calls_.at(asked_++);
    v1::SurveyRadiiRequest request;
    while (stream->Read(&request)) {
    }
    v1::SurveyRadiiResponse accepted;
    accepted.mutable_accepted();
    stream->Write(accepted);
    for (int piece = 0; piece < call.pieces; ++piece) stream->Write({});
    for (const double radius : call.radii) {
      v1::SurveyRadiiResponse response;
      response.mutable_radius()->set_radius(radius);
      stream->Write(response);
    }
    if (!call.status.ok() && !call.wall_time_s) return call.status;
    v1::SurveyRadiiResponse last;
    last.mutable_summary()->set_wall_time_seconds(call.wall_time_s.value_or(0));
    stream->Write(last);
    return call.status;
  }

  // What is handed on, and why it ended.
  std::optional<Failure> ask(std::vector<double>& radii, std::size_t wanted = 100) {
    const Connection connection(server_->InProcessChannel({}),
                                {.patience = std::chrono::seconds(10)});
    return survey_program(connection, {}, "G0 X1\n", [&](const v1::SurveyRadiiResponse& response) {
      if (response.has_radius()) radii.push_back(response.radius().radius());
      return radii.size() < wanted;
    });
  }
  [[nodiscard]] std::size_t asked() const { return asked_; }

 private:
  std::vector<Call> calls_;
  std::size_t asked_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

TEST(Survey, ThatFindsNoPlaceOnItsWayIsAskedForAnew) {
  Told server({{{3}, no_place()}, {{3, 5}, no_place()}, {{3, 5, 8}, {}}});
  std::vector<double> radii;
  EXPECT_FALSE(server.ask(radii));
  EXPECT_EQ(radii, (std::vector<double>{3, 5, 8}));
  EXPECT_EQ(server.asked(), 3U);
}

TEST(Survey, ThatIsLostOnItsWayIsAskedForAnew) {
  Told server({{{3}, {grpc::UNAVAILABLE, "gone"}}, {{3, 5}, {}}});
  std::vector<double> radii;
  EXPECT_FALSE(server.ask(radii));
  EXPECT_EQ(radii, (std::vector<double>{3, 5}));
}

TEST(Survey, ThatIsLostAfterItsSummaryIsTheSameThoughItTakesAnotherTime) {
  Told server({{{3}, {grpc::UNAVAILABLE, "gone"}, 1.5}, {{3}, {}, 2.5}});
  std::vector<double> radii;
  EXPECT_FALSE(server.ask(radii));
  EXPECT_EQ(radii, std::vector<double>{3});
  EXPECT_EQ(server.asked(), 2U);
}

TEST(Survey, ThatIsCutIntoOtherPiecesTheNextTimeIsTheSame) {
  Told server({{{3}, no_place(), {}, 2}, {{3, 5}, no_place(), {}, 1}, {{3, 5, 8}, {}, {}, 3}});
  std::vector<double> radii;
  EXPECT_FALSE(server.ask(radii));
  EXPECT_EQ(radii, (std::vector<double>{3, 5, 8}));
}

TEST(Survey, ThatIsAnotherOneTheNextTimeFails) {
  Told server({{{3, 5}, no_place()}, {{3, 6, 8}, {}}});
  std::vector<double> radii;
  const auto failure = server.ask(radii);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->reason, "RESUMED_PATH_DIFFERS");
  EXPECT_EQ(radii, (std::vector<double>{3, 5}));
}

TEST(Survey, ThatIsNotWantedAnyMoreIsNotAskedForAgain) {
  Told server({{{3, 5, 8}, {}}});
  std::vector<double> radii;
  EXPECT_TRUE(server.ask(radii, 1));
  EXPECT_EQ(radii, std::vector<double>{3});
  EXPECT_EQ(server.asked(), 1U);
}

TEST(Survey, ThatIsRefusedForGoodIsNotAskedForAgain) {
  Told server({{{3}, {grpc::INVALID_ARGUMENT, "no"}}});
  std::vector<double> radii;
  const auto failure = server.ask(radii);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->status, "INVALID_ARGUMENT");
  EXPECT_EQ(server.asked(), 1U);
}

}  // namespace
}  // namespace trc::client
