#include <grpcpp/grpcpp.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <string>

#include "trc/v1/trc_service.grpc.pb.h"

// CompensatePath without compensation: every block of a request comes back as a block of the path,
// in messages of the real size. What `trc load` reaches against it is what gRPC and Protobuf leave
// for any service of this shape on this machine: the ceiling.

namespace trc::bench {
namespace {

void echo(const v1::BlockColumns& in, v1::CompensatedColumns& out) {
  const auto blocks = static_cast<int>(in.kinds().size());
  out.Clear();
  out.set_first_block(in.first_block());
  out.mutable_kinds()->assign(in.kinds().size(),
                              static_cast<char>(v1::CompensatedColumns::KIND_LINEAR));
  out.mutable_flags()->assign(in.kinds().size(),
                              static_cast<char>(v1::CompensatedColumns::FLAG_FEED));
  out.mutable_origins()->assign(1, static_cast<char>(v1::CompensatedBlock::PROGRAMMED));
  out.mutable_planes()->assign(1, static_cast<char>(v1::PLANE_XY));
  out.add_start_x(0);
  out.add_start_y(0);
  out.add_start_z(0);
  *out.mutable_end_x() = in.x();
  *out.mutable_end_y() = in.y();
  out.add_end_z(0);
  *out.mutable_center_x() = in.i();
  *out.mutable_center_y() = in.j();
  *out.mutable_sweep() = in.i();
  *out.mutable_feed() = in.feed();
  out.mutable_source_index()->Reserve(blocks);
  for (int i = 0; i < blocks; ++i) out.add_source_index(static_cast<std::uint32_t>(i));
}

void echo(const v1::Position& in, v1::Position& out) {
  out.set_x(in.x());
  out.set_y(in.y());
  out.set_z(0);
}

// Keeps the memory of the message, as far as the kind of its geometry stays.
void echo(const v1::Block& in, v1::CompensatedBlock& out) {
  out.set_source_index(1);
  out.set_origin(v1::CompensatedBlock::PROGRAMMED);
  if (in.has_linear()) {
    echo(in.linear().end(), *out.mutable_start());
    echo(in.linear().end(), *out.mutable_line()->mutable_end());
    out.set_feed(in.linear().feed());
  } else if (in.has_circular()) {
    echo(in.circular().end(), *out.mutable_start());
    echo(in.circular().end(), *out.mutable_arc()->mutable_end());
    echo(in.circular().center(), *out.mutable_arc()->mutable_center());
    out.mutable_arc()->set_sweep(1);
    out.set_feed(in.circular().feed());
  } else {
    out.Clear();
  }
}

void echo(const v1::BlockBatch& in, v1::CompensatedBatch& out) {
  out.set_first_block(in.first_block());
  while (out.blocks_size() > in.blocks_size()) out.mutable_blocks()->RemoveLast();
  while (out.blocks_size() < in.blocks_size()) out.add_blocks();
  for (int i = 0; i < in.blocks_size(); ++i) echo(in.blocks(i), *out.mutable_blocks(i));
}

constexpr std::uint32_t most_blocks = 4096;
constexpr std::uint32_t window = 16;

class Reactor final
    : public grpc::ServerBidiReactor<v1::CompensatePathRequest, v1::CompensatePathResponse> {
 public:
  Reactor() { StartRead(&request_); }

 private:
  void OnReadDone(bool ok) override {
    if (!ok) return Finish(grpc::Status::OK);
    response_.clear_consumed_through_block();
    if (request_.has_setup()) {
      v1::StreamAccepted& accepted = *response_.mutable_accepted();
      accepted.set_max_blocks_per_batch(most_blocks);
      accepted.set_max_batches_in_flight(window);
    } else if (request_.has_columns()) {
      echo(request_.columns(), *response_.mutable_columns());
      answer(request_.columns(), request_.columns().kinds().size());
    } else {
      echo(request_.batch(), *response_.mutable_batch());
      answer(request_.batch(), static_cast<std::size_t>(request_.batch().blocks_size()));
    }
    StartWrite(&response_);
  }

  template <class Batch>
  void answer(const Batch& batch, std::size_t blocks) {
    response_.set_consumed_through_block(batch.first_block() + blocks - 1);
    final_ = batch.final();
  }

  void OnWriteDone(bool ok) override {
    if (ok && final_) {
      final_ = false;
      response_.mutable_summary();
      return StartWrite(&response_);
    }
    StartRead(&request_);
  }

  void OnDone() override { delete this; }

  v1::CompensatePathRequest request_;
  v1::CompensatePathResponse response_;
  bool final_ = false;
};

class Echo final : public v1::TrcService::CallbackService {
  grpc::ServerBidiReactor<v1::CompensatePathRequest, v1::CompensatePathResponse>* CompensatePath(
      grpc::CallbackServerContext* /*context*/) override {
    return new Reactor;
  }
  grpc::ServerUnaryReactor* GetServerInfo(grpc::CallbackServerContext* context,
                                          const v1::GetServerInfoRequest* /*request*/,
                                          v1::GetServerInfoResponse* response) override {
    v1::Limits& limits = *response->mutable_limits();
    limits.set_max_blocks_per_batch(most_blocks);
    limits.set_max_batches_in_flight(window);
    limits.set_max_streams(1000);
    grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
    reactor->Finish(grpc::Status::OK);
    return reactor;
  }
};

int serve(const std::string& address) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  Echo echo;
  grpc::ServerBuilder builder;
  builder.AddListeningPort(address, grpc::InsecureServerCredentials());
  builder.RegisterService(&echo);
  const std::unique_ptr<grpc::Server> server = builder.BuildAndStart();
  if (!server) return 1;
  int signal = 0;
  sigwait(&signals, &signal);
  server->Shutdown(std::chrono::system_clock::now() + std::chrono::seconds(1));
  return 0;
}

}  // namespace
}  // namespace trc::bench

int main(int argc, char** argv) {
  return trc::bench::serve(argc > 1 ? argv[1] : "127.0.0.1:50051");
}
