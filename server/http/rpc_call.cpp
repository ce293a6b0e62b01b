#include "server/http/rpc_call.h"

#include <utility>
#include <vector>

#include "server/rpc/caller.h"
#include "server/rpc/run_taps.h"

namespace trc::server::http {

std::shared_ptr<RpcCall> RpcCall::start(const std::shared_ptr<grpc::Channel>& channel,
                                        const Options& options, Done done) {
  std::shared_ptr<RpcCall> call(new RpcCall);
  call->self_ = call;
  call->done_ = std::move(done);
  if (!options.traceparent.empty()) call->context_.AddMetadata("traceparent", options.traceparent);
  if (!options.client.empty()) call->context_.AddMetadata(client_of_http, options.client);
  if (!options.address.empty()) call->context_.AddMetadata(address_of_http, options.address);
  if (!options.run_tap.empty()) call->context_.AddMetadata(RunTaps::metadata, options.run_tap);
  if (options.timeout)
    call->context_.set_deadline(std::chrono::system_clock::now() + *options.timeout);
  call->stub_ = std::make_unique<grpc::GenericStub>(channel);
  call->stub_->PrepareBidiStreamingCall(&call->context_, options.method, {}, call.get());
  // The hold allows writes outside of reactions; it is released when reading has ended.
  call->AddHold();
  call->StartCall();
  return call;
}

void RpcCall::write(const grpc::ByteBuffer& message, Sequel sequel, Written then) {
  {
    const std::lock_guard lock(mutex_);
    if (!over_) {
      outgoing_ = message;
      written_ = std::move(then);
      if (sequel == Sequel::none)
        StartWriteLast(&outgoing_, grpc::WriteOptions());
      else
        StartWrite(&outgoing_);
      return;
    }
  }
  then(false);
}

void RpcCall::read(Read then) {
  read_ = std::move(then);
  StartRead(&incoming_);
}

void RpcCall::OnReadDone(bool ok) {
  const Read then = std::move(read_);
  then(ok, incoming_);
  if (ok) return;
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  RemoveHold();
}

void RpcCall::OnWriteDone(bool ok) {
  const Written then = std::move(written_);
  then(ok);
}

void RpcCall::OnDone(const grpc::Status& status) {
  const Done done = std::move(done_);
  const std::shared_ptr<RpcCall> last = std::move(self_);
  done(status);
}

grpc::ByteBuffer RpcCall::bytes_of(const google::protobuf::MessageLite& message) {
  return bytes_of(message.SerializeAsString());
}

grpc::ByteBuffer RpcCall::bytes_of(const std::string& message) {
  const grpc::Slice slice(message);
  return {&slice, 1};
}

std::string RpcCall::text_of(const grpc::ByteBuffer& bytes) {
  std::vector<grpc::Slice> slices;
  std::string text;
  if (!bytes.Dump(&slices).ok()) return text;
  text.reserve(bytes.Length());
  for (const grpc::Slice& slice : slices)
    text.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
  return text;
}

bool RpcCall::read_message(const grpc::ByteBuffer& bytes, google::protobuf::MessageLite& message) {
  std::vector<grpc::Slice> slices;
  if (bytes.Dump(&slices).ok() && slices.size() == 1)
    return message.ParseFromArray(slices[0].begin(), static_cast<int>(slices[0].size()));
  return message.ParseFromString(text_of(bytes));
}

}  // namespace trc::server::http
