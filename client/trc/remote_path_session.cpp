#include "client/trc/remote_path_session.h"

#include <grpcpp/channel.h>

#include <algorithm>

#include "client/trc/stream_session.h"
#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::client {
namespace {

using Request = v1::CompensatePathRequest;
using Response = v1::CompensatePathResponse;

v1::PathSetup message_of(const wire::PathSettings& settings) {
  v1::PathSetup setup;
  wire::to_proto(settings, setup);
  return setup;
}

}  // namespace

struct RemotePathSession::Parts {
  Parts(const Connection& connection, const v1::PathSetup& setup)
      : stub(v1::TrcService::NewStub(connection.channel())),
        session(
            setup,
            [this](auto* context, auto* reactor) {
              stub->async()->CompensatePath(context, reactor);
            },
            connection),
        columns(setup.response_layout() == v1::RESPONSE_LAYOUT_COLUMNS) {}

  bool send(std::span<const wire::PathInput> items, Answers& out) {
    if (columns)
      writer.write(items, *session.outgoing().mutable_columns());
    else
      writer.write(items, *session.outgoing().mutable_batch());
    return session.send(writer.next_block(), out);
  }
  bool send_end(Answers& out) {
    const auto write_end = [this](auto& batch) {
      writer.write({}, batch);
      batch.set_final(true);
    };
    if (columns)
      write_end(*session.outgoing().mutable_columns());
    else
      write_end(*session.outgoing().mutable_batch());
    return session.send(session.end_of_input, out);
  }

  std::unique_ptr<v1::TrcService::Stub> stub;
  StreamSession<Request, Response, wire::PathSummary> session;
  bool columns;
  wire::BlockWriter writer;
};

RemotePathSession::RemotePathSession(const Connection& connection,
                                     const wire::PathSettings& settings)
    : RemotePathSession(connection, message_of(settings)) {}

RemotePathSession::RemotePathSession(const Connection& connection, const v1::PathSetup& setup)
    : parts_(std::make_unique<Parts>(connection, setup)) {}

RemotePathSession::~RemotePathSession() = default;

bool RemotePathSession::feed(std::span<const wire::PathInput> items, Answers& out) {
  Parts& parts = *parts_;
  if (!parts.session.open(out)) return false;
  while (!items.empty()) {
    const auto part = items.first(std::min(items.size(), parts.session.message_size().blocks()));
    if (!parts.send(part, out)) return false;
    items = items.subspan(part.size());
  }
  return !parts.session.failure();
}

bool RemotePathSession::finish(Answers& out) {
  if (feed({}, out)) parts_->send_end(out);
  return parts_->session.finish(out);
}

const std::optional<Failure>& RemotePathSession::failure() const {
  return parts_->session.failure();
}

std::uint64_t RemotePathSession::resumed() const { return parts_->session.resumed(); }

const std::optional<wire::PathSummary>& RemotePathSession::summary() const {
  return parts_->session.summary();
}

}  // namespace trc::client
