#include "tests/client/load/meddling_server.h"

#include <bit>
#include <cstdint>
#include <thread>

namespace trc::load {

MeddlingServer::MeddlingServer(const Meddling& meddling)
    : meddling_(meddling), stub_(v1::TrcService::NewStub(real_.channel())) {
  grpc::ServerBuilder builder;
  builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
  builder.RegisterService(this);
  server_ = builder.BuildAndStart();
}

MeddlingServer::~MeddlingServer() { server_->Shutdown(); }

void MeddlingServer::wait_out_stall() const {
  std::this_thread::sleep_until(start_ + meddling_.stall);
}

bool MeddlingServer::meddle(v1::CompensatePathResponse& response) {
  if (meddling_.lose_summary && response.has_summary()) return false;
  if (meddling_.flip_bit && response.columns().end_x_size() > 20 && !flipped_.exchange(true)) {
    double& place = *response.mutable_columns()->mutable_end_x()->Mutable(20);
    place = std::bit_cast<double>(std::bit_cast<std::uint64_t>(place) ^ 1U);
  }
  return true;
}

bool MeddlingServer::meddle(v1::CompensateProgramResponse& response) {
  if (meddling_.flip_text_bit && !response.nc_text().empty() && !flipped_.exchange(true))
    response.mutable_nc_text()->back() ^= 1;
  return true;
}

template <class Request, class Response, class Open>
grpc::Status MeddlingServer::pass_on(grpc::ServerReaderWriter<Response, Request>& stream,
                                     Open open) {
  wait_out_stall();
  grpc::ClientContext context;
  const auto real = open(context);
  std::thread requests([&] {
    Request request;
    while (stream.Read(&request) && real->Write(request)) {
    }
    real->WritesDone();
  });
  Response response;
  bool going = true;
  while (real->Read(&response))
    if (meddle(response)) going = going && stream.Write(response);
  requests.join();
  return real->Finish();
}

grpc::Status MeddlingServer::CompensatePath(
    grpc::ServerContext* /*context*/,
    grpc::ServerReaderWriter<v1::CompensatePathResponse, v1::CompensatePathRequest>* stream) {
  return pass_on(*stream, [&](auto& context) { return stub_->CompensatePath(&context); });
}

grpc::Status MeddlingServer::CompensateProgram(
    grpc::ServerContext* /*context*/,
    grpc::ServerReaderWriter<v1::CompensateProgramResponse, v1::CompensateProgramRequest>* stream) {
  return pass_on(*stream, [&](auto& context) { return stub_->CompensateProgram(&context); });
}

grpc::Status MeddlingServer::GetServerInfo(grpc::ServerContext* /*context*/,
                                           const v1::GetServerInfoRequest* request,
                                           v1::GetServerInfoResponse* response) {
  grpc::ClientContext context;
  return stub_->GetServerInfo(&context, *request, response);
}

}  // namespace trc::load
