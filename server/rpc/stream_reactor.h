#pragma once

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <utility>

#include "server/backend.h"
#include "server/rpc/stream_context.h"
#include "server/rpc/stream_work.h"
#include "server/telemetry/call_record.h"

namespace trc::server {

// The life of one stream between gRPC and a StreamWork:
//
//   read ──► turn in the pool ──► write ──► read …      one step at a time
//
// There is never more than one read or write outstanding, which is also the back-pressure: nothing
// is read while an answer waits. Reactions only hand over; turns compute. The phase says who owns
// the stream, so that Finish is called once: by the owner, or by the watch for idle streams, which
// takes the ownership away from a pending read.
template <class GrpcReactor, class Request, class Response>
class StreamReactor
    : public GrpcReactor,
      public OpenStream,
      private WorkerPool::Job,
      public std::enable_shared_from_this<StreamReactor<GrpcReactor, Request, Response>> {
 public:
  using Work = StreamWork<Request, Response>;

  StreamReactor(Backend& backend, grpc::CallbackServerContext& context, Method method)
      : backend_(backend), context_(context), record_(backend.telemetry, method, context.peer()) {}

  // Admits the stream or refuses it. The reactor keeps itself alive until OnDone.
  void start(std::unique_ptr<Work> work) {
    self_ = this->shared_from_this();
    work_ = std::move(work);
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
    {
      const std::lock_guard lock(mutex_);
      if (phase_since_ > since) return;
      if (phase_ != Phase::reading && phase_ != Phase::writing) return;
      waits_for_request = phase_ == Phase::reading;
      phase_ = waits_for_request ? Phase::finished : Phase::cancelling;
      stalled_ = !waits_for_request;
    }
    if (waits_for_request) return finish(idle());

    // The client does not read. The status would wait behind the answer, so the call is cancelled.
    // Finish is held back meanwhile: it would allow gRPC to destroy the context.
    context_.TryCancel();
    {
      const std::lock_guard lock(mutex_);
      if (!written_while_cancelling_) {
        phase_ = Phase::writing;
        return;
      }
    }
    finish(gone());
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
      phase_ = Phase::working;
    }
    input_ = input;
    if (input == Input::ended && context_.IsCancelled()) return finish(gone());
    backend_.pool.submit(*this);
  }

  Request request_;

 private:
  enum class Phase { working, reading, writing, cancelling, finished };

  void enter(Phase phase) {
    const std::lock_guard lock(mutex_);
    phase_ = phase;
    phase_since_ = Clock::now();
  }

  void turn() noexcept final {
    if (cancelled_ || context_.IsCancelled()) return finish(gone());
    Turn turn;
    try {
      turn = work();
    } catch (const std::exception& bug) {
      turn = {.write = false, .next = Turn::Next::finish, .ending = record_.incident(bug.what())};
    }
    next_ = turn.next;
    ending_ = std::move(turn.ending);
    if (!turn.write) return go_on();
    enter(Phase::writing);
    this->StartWrite(&response_);
  }

  Turn work() {
    switch (std::exchange(input_, Input::none)) {
      case Input::request:
        return work_->take(request_, response_);
      case Input::ended:
        return work_->ended(response_);
      case Input::none:
        break;
    }
    return work_->proceed(response_);
  }

  void go_on() {
    switch (next_) {
      case Turn::Next::proceed:
        return backend_.pool.submit(*this);
      case Turn::Next::read:
        record_.answered();
        return read();
      case Turn::Next::finish:
        return finish(ending_);
    }
  }

  void OnWriteDone(bool ok) final {
    {
      const std::lock_guard lock(mutex_);
      if (phase_ == Phase::cancelling) {
        written_while_cancelling_ = true;
        return;
      }
      phase_ = Phase::working;
    }
    if (!ok) return finish(gone());
    go_on();
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

  Response response_;
  Input input_ = Input::none;
  Turn::Next next_ = Turn::Next::read;
  Ending ending_;

  std::atomic<bool> cancelled_ = false;
  std::mutex mutex_;
  Phase phase_ = Phase::working;
  Clock::time_point phase_since_ = Clock::now();
  bool stalled_ = false;
  bool written_while_cancelling_ = false;
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
    this->StartRead(&this->request_);
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
    this->request_ = request;
  }

 private:
  void read() override {
    this->arrived(std::exchange(asked_, true) ? Base::Input::ended : Base::Input::request);
  }

  bool asked_ = false;
};

}  // namespace trc::server
