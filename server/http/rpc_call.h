#pragma once

#include <google/protobuf/message_lite.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace trc::server::http {

// One RPC of any kind to the service of this process: requests over HTTP are computed in the same
// place as all others, with the same limits, log and metrics. Messages are bytes here.
//
// The functions given are called in threads of gRPC, which they must not block. One write and one
// read may be outstanding.
class RpcCall final : public grpc::ClientBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer> {
 public:
  using Done = std::function<void(const grpc::Status& status)>;
  using Read = std::function<void(bool ok, const grpc::ByteBuffer& message)>;
  using Written = std::function<void(bool ok)>;

  struct Options {
    std::string method{};       // "/trc.v1.TrcService/GetServerInfo"
    std::string traceparent{};  // of the caller; may be empty
    std::optional<std::chrono::milliseconds> timeout{};
    std::string run_tap{};  // as of RunTaps; empty: none
    std::string client{};   // whose limits it counts to, as peer_of has it; empty: this process
    std::string address{};  // where that one is, for the log; empty: this process
  };

  // `done` comes last, after reading has ended.
  static std::shared_ptr<RpcCall> start(const std::shared_ptr<grpc::Channel>& channel,
                                        const Options& options, Done done);

  enum class Sequel : std::uint8_t { more, none };  // of requests, after a message

  void write(const grpc::ByteBuffer& message, Sequel sequel, Written then);
  // After a read that was not ok `done` follows, and nothing more may be read.
  void read(Read then);
  void cancel() { context_.TryCancel(); }

  [[nodiscard]] static grpc::ByteBuffer bytes_of(const google::protobuf::MessageLite& message);
  [[nodiscard]] static grpc::ByteBuffer bytes_of(const std::string& message);
  // False when it is none.
  static bool read_message(const grpc::ByteBuffer& bytes, google::protobuf::MessageLite& message);
  [[nodiscard]] static std::string text_of(const grpc::ByteBuffer& bytes);

 private:
  RpcCall() = default;

  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnDone(const grpc::Status& status) override;

  std::shared_ptr<RpcCall> self_;
  std::unique_ptr<grpc::GenericStub> stub_;
  grpc::ClientContext context_;
  grpc::ByteBuffer incoming_;
  grpc::ByteBuffer outgoing_;
  Done done_;
  Read read_;
  Written written_;
  std::mutex mutex_;
  bool over_ = false;  // nothing is written any more
};

}  // namespace trc::server::http
