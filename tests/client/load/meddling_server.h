#pragma once

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>

#include "server/in_process.h"
#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::load {

// The service at a port of its own, with somebody in between who changes or holds up answers.
class MeddlingServer final : public v1::TrcService::Service {
 public:
  struct Meddling {
    bool flip_bit = false;       // the last one of one coordinate, of one stream
    bool flip_text_bit = false;  // of one byte of NC text
    bool lose_summary = false;
    // For so long after the start nothing is answered.
    std::chrono::milliseconds stall{};
  };
  explicit MeddlingServer(const Meddling& meddling);
  ~MeddlingServer() override;

  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

 private:
  grpc::Status CompensatePath(grpc::ServerContext* context,
                              grpc::ServerReaderWriter<v1::CompensatePathResponse,
                                                       v1::CompensatePathRequest>* stream) override;
  grpc::Status CompensateProgram(
      grpc::ServerContext* context,
      grpc::ServerReaderWriter<v1::CompensateProgramResponse, v1::CompensateProgramRequest>* stream)
      override;
  grpc::Status GetServerInfo(grpc::ServerContext* context, const v1::GetServerInfoRequest* request,
                             v1::GetServerInfoResponse* response) override;

  // Whether an answer may go on its way.
  bool meddle(v1::CompensatePathResponse& response);
  bool meddle(v1::CompensateProgramResponse& response);
  void wait_out_stall() const;
  template <class Request, class Response, class Open>
  grpc::Status pass_on(grpc::ServerReaderWriter<Response, Request>& stream, Open open);

  Meddling meddling_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::atomic<bool> flipped_{false};
  server::InProcessServer real_;
  std::unique_ptr<v1::TrcService::Stub> stub_;
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

}  // namespace trc::load
