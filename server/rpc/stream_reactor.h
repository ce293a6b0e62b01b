#pragma once

#include <grpcpp/grpcpp.h>
#include <malloc.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <utility>

#include "core/base/pages.h"
#include "server/backend.h"
#include "server/rpc/arena_message.h"
#include "server/rpc/caller.h"
#include "server/rpc/stream_context.h"
#include "server/rpc/stream_work.h"
#include "server/telemetry/call_record.h"

namespace trc::server {

// The life of one stream between gRPC and a StreamWork:
//
//   read ──► turn in the pool ──► write ──► read …      one step at a time
//
// There is never more than one read or write outstanding, which is also the back-pressure: nothing
// is read while an answer waits. Reactions only hand over, and turns compute; a turn that is known
// to be over sooner than it would be handed over is taken at once. The phase says who owns
// the stream, so that Finish is called once: by the owner, or by the watch for idle streams, which
// takes the ownership away from a pending read. The watch also writes the heartbeats of a silent
// stream.
template <class GrpcReactor, class Request, class Response>
class StreamReactor
    : public GrpcReactor,
      public OpenStream,
      private WorkerPool::Job,
      public std::enable_shared_from_this<StreamReactor<GrpcReactor, Request, Response>> {
 public:
  using Work = StreamWork<Request, Response>;

  StreamReactor(Backend& backend, grpc::CallbackServerContext& context, Method method)
      : backend_(backend),
        context_(context),
        record_(backend.telemetry, method, context.peer(), trace_of(context)) {}

  // Admits the stream or refuses it. The reactor keeps itself alive until OnDone.
  void start(std::unique_ptr<Work> work) {
    self_ = this->shared_from_this();
    work_ = std::move(work);
    if (const auto refused = refuse_caller(context_, backend_.config.tls_allowed_clients))
      return finish(*refused);
    OpenStreams::Admission admission = backend_.streams.admit(self_);
    switch (admission.answer) {
      case OpenStreams::Answer::admitted:
        ticket_ = std::move(admission.ticket);
        return read();
      case OpenStreams::Answer::full:
        return finish(refuse(Refusal::stream_limit, {},
                             {{"max_streams", std::to_string(backend_.config.max_streams)}}));
      case OpenStreams::Answer::draining:
        return finish(refuse(Refusal::draining));
    }
  }

  // Valid as long as the reactor.
  [[nodiscard]] StreamContext stream_context() { return {backend_, record_, cancelled_}; }

  void end_if_idle(Clock::time_point since) final {
    bool waits_for_request = false;
    bool was_reading = false;
    {
      const std::lock_guard lock(mutex_);
      if (phase_since_ > since) return;
      if (phase_ != Phase::reading && phase_ != Phase::writing) return;
      was_reading = phase_ == Phase::reading;
      waits_for_request = was_reading && !beating_;
      phase_ = waits_for_request ? Phase::finished : Phase::cancelling;
      stalled_ = !waits_for_request;
    }
    if (waits_for_request) return finish(idle());

    // The client does not read. The status would wait behind the answer, so the call is cancelled.
    // Finish is held back meanwhile: it would allow gRPC to destroy the context.
    context_.TryCancel();
    {
      const std::lock_guard lock(mutex_);
      if (beating_ || !written_while_cancelling_) {
        const bool still_reading = was_reading && !arrived_while_cancelling_;
        phase_ = still_reading ? Phase::reading : Phase::writing;
        return;
      }
    }
    finish(gone());
  }

  // A beat is a write beside a pending read or a running turn. What the turn wants written, and the
  // end of the stream, wait for it.
  void beat_if_silent(Clock::time_point since) final {
    if constexpr (requires { beat_.mutable_heartbeat(); }) {
      {
        const std::lock_guard lock(mutex_);
        if (answers_written_ == 0 || beating_ || written_at_ > since) return;
        if (phase_ != Phase::reading && phase_ != Phase::working) return;
        beating_ = true;
      }
      beat_.mutable_heartbeat();
      this->StartWrite(&beat_);
    }
  }

 protected:
  enum class Input { none, request, ended };

  // The next request: starts a read, or says that there is none.
  virtual void read() = 0;

  void await_request() { enter(Phase::reading); }

  void arrived(Input input) {
    {
      const std::lock_guard lock(mutex_);
      if (phase_ == Phase::finished) return;
      if (phase_ == Phase::cancelling) {
        arrived_while_cancelling_ = true;
        return;
      }
      phase_ = Phase::working;
    }
    input_ = input;
    take_turn();
  }

  ArenaMessage<Request> request_;

 private:
  enum class Phase { working, reading, writing, cancelling, finished };

  void enter(Phase phase) {
    const std::lock_guard lock(mutex_);
    phase_ = phase;
    phase_since_ = Clock::now();
  }

  // From a reaction.
  void take_turn() {
    const bool here =
        !cancelled_ && work_->is_short(input_ == Input::request ? &*request_ : nullptr);
    if (here)
      turn();
    else
      backend_.pool.submit(*this);
  }

  void turn() noexcept final {
    if (cancelled_ || context_.IsCancelled()) return abandon();
    try {
      turn_ = work();
      // Not held while the answer waits for its reader.
      request_.reset();
    } catch (const Abandoned&) {
      return abandon();
    } catch (const std::exception& bug) {
      turn_ = end(record_.incident(bug.what()));
    }
    if (turn_.next == Turn::Next::finish) let_go_of_work();
    conclude();
  }

  // Here in the pool: a session may hold so much that a reaction should not have to free it.
  void let_go_of_work() {
    constexpr std::uint64_t large = 32U << 20U;
    const std::uint64_t held = backend_.memory.used_bytes();
    work_.reset();
    if (held <= backend_.memory.used_bytes() + large) return;
    PagePiece::give_back_spare();
    // The heap keeps what lies between small blocks that are still in use.
    malloc_trim(0);
  }

  void abandon() {
    let_go_of_work();
    end_with(gone());
  }

  void end_with(Ending ending) {
    turn_ = end(std::move(ending));
    conclude();
  }

  Turn work() {
    response_.reset_if_large();
    switch (std::exchange(input_, Input::none)) {
      case Input::request:
        return work_->take(*request_, *response_);
      case Input::ended:
        return work_->ended(*response_);
      case Input::none:
        break;
    }
    return work_->proceed(*response_);
  }

  // Does what the last turn has asked for, or leaves it to the end of a heartbeat on its way.
  void conclude() {
    {
      const std::lock_guard lock(mutex_);
      if (beating_ || turn_.write) {
        phase_ = Phase::writing;
        phase_since_ = Clock::now();
      } else if (turn_.next == Turn::Next::finish) {
        phase_ = Phase::finished;
      }
      if (beating_) return;
    }
    if (turn_.write) return write();
    switch (turn_.next) {
      case Turn::Next::proceed:
        return take_turn();
      case Turn::Next::read:
        record_.answered();
        return read();
      case Turn::Next::finish:
        return finish(turn_.ending);
    }
  }

  // gRPC has made bytes of the answer when StartWrite returns, so that it need not be held as a
  // message as well until the client reads it. The first answer gRPC may still have to look at: it
  // can come before the handler has returned. Whoever goes on behind the write waits for the mutex.
  void write() {
    const std::shared_ptr<StreamReactor> alive = self_;
    const std::uint64_t before = answers_written_;
    this->StartWrite(&*response_);
    const std::lock_guard lock(mutex_);
    if (before > 0 && answers_written_ == before) response_.reset_if_large();
  }

  void OnWriteDone(bool ok) final {
    {
      const std::lock_guard lock(mutex_);
      const bool was_beat = std::exchange(beating_, false);
      written_at_ = Clock::now();
      if (!was_beat) ++answers_written_;
      if (phase_ == Phase::cancelling) {
        written_while_cancelling_ = true;
        return;
      }
      // After a beat that failed the call is over, which the read or the turn finds out.
      if (was_beat && phase_ != Phase::writing) return;
      phase_ = Phase::working;
      if (!was_beat) turn_.write = false;
    }
    if (ok) return conclude();
    cancelled_ = true;
    backend_.pool.submit(*this);
  }

  void OnCancel() final { cancelled_ = true; }

  void OnDone() final {
    // The ticket goes last: the server may end once no stream holds one.
    const OpenStreams::Ticket ticket = std::move(ticket_);
    work_.reset();
    self_.reset();
  }

  // The last thing anybody does with the stream: OnDone may have run when it returns.
  void finish(const Ending& ending) {
    enter(Phase::finished);
    record_.ended(ending);
    this->Finish(ending.status);
  }

  [[nodiscard]] Ending idle() const {
    return refuse(Refusal::stream_idle, {},
                  {{"idle_timeout_s", std::to_string(backend_.config.idle_timeout_s)}});
  }

  [[nodiscard]] Ending gone() const {
    if (stalled_) return idle();
    return refuse(context_.deadline() <= std::chrono::system_clock::now()
                      ? Refusal::deadline_exceeded
                      : Refusal::cancelled);
  }

  Backend& backend_;
  grpc::CallbackServerContext& context_;
  CallRecord record_;
  std::unique_ptr<Work> work_;
  OpenStreams::Ticket ticket_;
  std::shared_ptr<StreamReactor> self_;

  ArenaMessage<Response> response_;
  Response beat_;
  Input input_ = Input::none;
  Turn turn_;

  std::atomic<bool> cancelled_ = false;
  std::mutex mutex_;
  Phase phase_ = Phase::working;
  Clock::time_point phase_since_ = Clock::now();
  Clock::time_point written_at_ = Clock::now();
  std::uint64_t answers_written_ = 0;
  bool beating_ = false;
  bool stalled_ = false;
  bool written_while_cancelling_ = false;
  bool arrived_while_cancelling_ = false;
};

// A stream in both directions.
template <class Request, class Response>
class BidiReactor final
    : public StreamReactor<grpc::ServerBidiReactor<Request, Response>, Request, Response> {
 public:
  using StreamReactor<grpc::ServerBidiReactor<Request, Response>, Request, Response>::StreamReactor;

 private:
  using Base = StreamReactor<grpc::ServerBidiReactor<Request, Response>, Request, Response>;

  void read() override {
    this->await_request();
    this->StartRead(&*this->request_);
  }
  void OnReadDone(bool ok) override {
    this->arrived(ok ? Base::Input::request : Base::Input::ended);
  }
};

// One request, a stream of answers.
template <class Request, class Response>
class AnswerReactor final
    : public StreamReactor<grpc::ServerWriteReactor<Response>, Request, Response> {
 public:
  using Base = StreamReactor<grpc::ServerWriteReactor<Response>, Request, Response>;

  AnswerReactor(Backend& backend, grpc::CallbackServerContext& context, Method method,
                const Request& request)
      : Base(backend, context, method) {
    *this->request_ = request;
  }

 private:
  void read() override {
    this->arrived(std::exchange(asked_, true) ? Base::Input::ended : Base::Input::request);
  }

  bool asked_ = false;
};

}  // namespace trc::server
