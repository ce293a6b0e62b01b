#include "client/trc/remote_program_session.h"

#include <grpcpp/channel.h>

#include <utility>

#include "client/trc/stream_session.h"
#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::client {
namespace {

using Request = v1::CompensateProgramRequest;
using Response = v1::CompensateProgramResponse;

}  // namespace

struct RemoteProgramSession::Parts {
  Parts(const Connection& connection, const v1::ProgramSetup& setup)
      : stub(v1::TrcService::NewStub(connection.channel())),
        session(
            setup,
            [this](auto* context, auto* reactor) {
              stub->async()->CompensateProgram(context, reactor);
            },
            connection) {}

  v1::ProgramText& write(std::string_view text) {
    v1::ProgramText& message = *session.outgoing().mutable_text();
    message.set_first_byte(sent_bytes);
    message.set_text(text.data(), text.size());
    message.set_final(false);
    sent_bytes += text.size();
    return message;
  }
  bool send(std::string_view text, Answers& out) {
    write(text);
    return session.send(sent_bytes, out);
  }
  bool send_end(Answers& out) {
    write({}).set_final(true);
    return session.send(session.end_of_input, out);
  }

  std::unique_ptr<v1::TrcService::Stub> stub;
  StreamSession<Request, Response, wire::ProgramSummary> session;
  std::uint64_t sent_bytes = 0;
};

RemoteProgramSession::RemoteProgramSession(const Connection& connection,
                                           const v1::ProgramSetup& setup)
    : parts_(std::make_unique<Parts>(connection, setup)) {}

RemoteProgramSession::~RemoteProgramSession() = default;

bool RemoteProgramSession::feed(std::string_view text, Answers& out) {
  Parts& parts = *parts_;
  if (!parts.session.open(out)) return false;
  while (!text.empty()) {
    const std::string_view chunk = text.substr(0, parts.session.message_size().text_bytes());
    if (!parts.send(chunk, out)) return false;
    text.remove_prefix(chunk.size());
  }
  return !parts.session.failure();
}

bool RemoteProgramSession::finish(Answers& out) {
  if (feed({}, out)) parts_->send_end(out);
  return parts_->session.finish(out);
}

void RemoteProgramSession::tell_measuring(
    std::function<void(std::uint64_t measured, std::uint64_t all)> measuring) {
  parts_->session.tell_measuring(std::move(measuring));
}

const std::optional<Failure>& RemoteProgramSession::failure() const {
  return parts_->session.failure();
}

std::uint64_t RemoteProgramSession::resumed() const { return parts_->session.resumed(); }

const std::string& RemoteProgramSession::core_version() const {
  return parts_->session.limits().core_version();
}

const std::optional<wire::ProgramSummary>& RemoteProgramSession::summary() const {
  return parts_->session.summary();
}

const std::string& RemoteProgramSession::record() const { return parts_->session.record(); }

}  // namespace trc::client
