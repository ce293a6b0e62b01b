#pragma once

#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <utility>

#include "server/backend.h"
#include "server/rpc/arena_message.h"
#include "server/rpc/caller.h"
#include "server/rpc/incoming_request.h"
#include "server/rpc/stream_account.h"
#include "server/rpc/stream_context.h"
#include "server/rpc/stream_refusals.h"
#include "server/rpc/stream_work.h"
#include "server/telemetry/call_record.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server {

// The life of one stream between gRPC and a StreamWork:
//
//   read ──► turn in the pool ──► write ──► read …      one step at a time
//
// There is never more than one read or answer outstanding, which is also the back-pressure:
// nothing is read while an answer waits. Reactions only hand over, and turns compute; a turn known
// to take less time than handing it over is taken at once. The phase says who owns the stream, so
// that Finish is called once: by the owner, or by the watch for idle streams, which takes the
// ownership away from a pending read. The watch also writes the heartbeats of a silent stream,
// beside a read.
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
        peer_(backend.peers.of(peer_of(context, backend.config.trusted_proxies))),
        account_(backend, *peer_),
        record_(backend.telemetry, method, origin_of(context, backend.config.trusted_proxies),
                trace_of(context)) {}

  // Admits the stream or refuses it. The reactor keeps itself alive until OnDone.
  void start(std::unique_ptr<Work> work) {
    self_ = this->shared_from_this();
    work_ = std::move(work);
    if (const auto refused = refuse_caller(context_, backend_.config.tls_allowed_clients))
      return finish(*refused);
    if (!backend_.streams.draining()) {
      if (backend_.memory_watch.state() != MemoryWatch::State::ample)
        return finish(refuse(Refusal::memory_limit_of_process));
      place_ = Peer::Place(*peer_);
      if (const auto refused = refuse_crowd(backend_, *peer_)) return finish(*refused);
    }
    OpenStreams::Admission admission = backend_.streams.admit(self_);
    switch (admission.answer) {
      case OpenStreams::Answer::admitted:
        ticket_ = std::move(admission.ticket);
        return read();
      case OpenStreams::Answer::full:
        return finish(refuse_full(backend_.config));
      case OpenStreams::Answer::draining:
        return finish(refuse(Refusal::draining));
    }
  }

  // Valid as long as the reactor.
  [[nodiscard]] StreamContext stream_context() {
    return {backend_, record_, cancelled_, account_, backend_.run_taps.take(context_)};
  }

  void end_if_idle(Clock::time_point since) final { give_up(since, Refusal::stream_idle); }

  void evict() final {
    account_.end_with(Refusal::memory_limit_of_process);
    give_up(Clock::time_point::max(), Refusal::memory_limit_of_process);
  }

  void cut_off() final {
    account_.end_with(Refusal::drain_timeout);
    const Ending ending = refuse(Refusal::drain_timeout);
    {
      const std::lock_guard lock(mutex_);
      if (!may_be_ended_from_outside() || phase_ != Phase::reading || beating_) return;
      phase_ = Phase::finished;
    }
    release_work();
    finish(ending);
  }

  [[nodiscard]] std::uint64_t held_bytes() const final { return account_.held_bytes(); }

  // A beat is a write during a pending read or a running turn. Writes of the turn, and the end of
  // the stream, wait for it.
  void beat_if_silent(Clock::time_point since) final {
    if constexpr (requires(Response beat) { beat.mutable_heartbeat(); }) {
      // A client that waits for a measured path wants to know the progress.
      constexpr std::chrono::milliseconds between_news{200};
      const StreamAccount::Measuring measuring = account_.measuring();
      if (measuring.goes_on()) since = std::max(since, Clock::now() - between_news);
      {
        const std::lock_guard lock(mutex_);
        if (answers_written_ == 0 || beating_ || written_at_ > since) return;
        if (phase_ != Phase::reading && phase_ != Phase::working) return;
        beating_ = true;
      }
      Response beat;
      v1::Heartbeat& heartbeat = *beat.mutable_heartbeat();
      if (measuring.goes_on()) {
        heartbeat.set_measured_blocks(measuring.blocks);
        heartbeat.set_blocks_to_measure(measuring.all);
      }
      write_down(beat, beat_);
      this->StartWrite(&beat_);
    }
  }

 protected:
  enum class Input { none, request, ended };

  // The next request: starts a read, or says that there is none.
  virtual void read() = 0;

  // Around the start of a read. The stream is not ended from outside between the two: its end would
  // let gRPC destroy what the start still works on. It lives as long as what is returned.
  [[nodiscard]] std::shared_ptr<StreamReactor> await_request() {
    const std::lock_guard lock(mutex_);
    ++reads_starting_;
    phase_ = Phase::reading;
    phase_since_ = Clock::now();
    return this->shared_from_this();
  }
  void awaits_request() {
    const std::lock_guard lock(mutex_);
    --reads_starting_;
  }

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

  IncomingRequest<Request> request_;

 private:
  enum class Phase { working, reading, writing, cancelling, finished };

  void enter(Phase phase) {
    const std::lock_guard lock(mutex_);
    phase_ = phase;
    phase_since_ = Clock::now();
  }

  // Under the lock.
  [[nodiscard]] bool may_be_ended_from_outside() const { return reads_starting_ == 0; }

  // Ends a stream that has waited for its client since then. A running turn is left alone.
  void give_up(Clock::time_point since, Refusal why) {
    bool waits_for_request = false;
    bool was_reading = false;
    {
      const std::lock_guard lock(mutex_);
      if (phase_since_ > since || !may_be_ended_from_outside()) return;
      if (phase_ != Phase::reading && phase_ != Phase::writing) return;
      was_reading = phase_ == Phase::reading;
      waits_for_request = was_reading && !beating_;
      phase_ = waits_for_request ? Phase::finished : Phase::cancelling;
      if (!waits_for_request) given_up_ = why;
    }
    if (waits_for_request) {
      release_work();
      return finish(refuse_waiting(why, backend_.config));
    }

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

  // From a reaction.
  void take_turn() {
    if (input_ == Input::request) {
      const std::size_t size = request_.bytes().Length();
      // A request that is too large is refused in its turn.
      if (request_.keep_up_to(backend_.config.max_message_bytes)) record_.carried(size);
    }
    if (!cancelled_ && is_short())
      turn();
    else
      backend_.pool.submit(*this, peer_->turns);
  }

  // Whether the next turn takes no longer than handing it to a worker would. A small request is
  // read for that.
  [[nodiscard]] bool is_short() {
    constexpr std::size_t small = 16U << 10U;
    if (request_.bytes_too_many() > 0) return false;
    if (input_ != Input::request) return work_->is_short(nullptr);
    if (request_.bytes().Length() > small) return false;
    const StreamAccount::Turn accounted(account_);
    try {
      return request_.read() && work_->is_short(&request_.message());
    } catch (const std::bad_alloc&) {
      return false;
    }
  }

  // False when there is no memory.
  static bool write_down(const Response& message, grpc::ByteBuffer& bytes) {
    bool own = false;
    return grpc::SerializationTraits<Response>::Serialize(message, &bytes, &own).ok();
  }

  void turn() noexcept final {
    {
      const StreamAccount::Turn accounted(account_);
      take_turn_here();
      if (turn_.next == Turn::Next::finish) release_work();
    }
    conclude();
  }

  // A failure frees the work first, since memory may be the cause.
  void take_turn_here() noexcept {
    if (cancelled_ || context_.IsCancelled()) return give_up_work();
    try {
      account_.check();
      turn_ = work();
      account_.check();
    } catch (const Abandoned&) {
      give_up_work();
    } catch (Refused& refused) {
      turn_ = end(std::move(refused.ending));
    } catch (const std::bad_alloc&) {
      release_work();
      turn_ = end_for_want_of_memory();
    } catch (const std::exception& bug) {
      release_work();
      try {
        turn_ = end(record_.incident(bug.what()));
      } catch (const std::bad_alloc&) {
        turn_ = end_for_want_of_memory();
      }
    }
  }

  void give_up_work() noexcept {
    release_work();
    try {
      turn_ = end(gone());
    } catch (const std::bad_alloc&) {
      turn_ = end_for_want_of_memory();
    }
  }

  // Called in the thread that ends the stream, best in the pool: a session may hold too much for a
  // reaction to free.
  void release_work() noexcept {
    constexpr std::uint64_t large = 32U << 20U;
    const bool held_much = account_.held_bytes() > large;
    work_.reset();
    request_.reset();
    response_.reset();
    account_.close();
    if (held_much) backend_.memory_watch.give_back_soon();
  }

  Turn work() {
    response_.reset_if_large();
    Turn turn = compute();
    // Not held while the answer waits for its reader.
    request_.reset();
    if (turn.write && !write_down(*response_, answer_)) throw std::bad_alloc();
    account_.answers(turn.write ? answer_.Length() : 0);
    response_.reset_if_large();
    return turn;
  }

  Turn compute() {
    switch (std::exchange(input_, Input::none)) {
      case Input::request:
        if (const std::size_t bytes = request_.bytes_too_many(); bytes > 0)
          return end(refuse_too_large(bytes, backend_.config));
        if (!request_.read()) return end(refuse(Refusal::request_unreadable));
        if (const auto& unknown = request_.unknown()) return end(refuse(*unknown));
        return work_->take(request_.take(), *response_);
      case Input::ended:
        return work_->ended(*response_);
      case Input::none:
        break;
    }
    return work_->proceed(*response_);
  }

  // Does what the last turn has asked for, or leaves it to the end of a heartbeat being written.
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
    if (turn_.write) return this->StartWrite(&answer_);
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
      if (!was_beat) {
        turn_.write = false;
        answer_.Clear();
      }
    }
    if (ok) return conclude();
    cancelled_ = true;
    backend_.pool.submit(*this, peer_->turns);
  }

  void OnCancel() final { cancelled_ = true; }

  void OnDone() final {
    work_.reset();
    self_.reset();
  }

  // The last call for the stream: OnDone may have run when it returns.
  void finish(const Ending& ending) {
    enter(Phase::finished);
    record_.ended(ending);
    this->Finish(ending.status);
  }

  [[nodiscard]] Ending gone() const {
    if (given_up_) return refuse_waiting(*given_up_, backend_.config);
    return refuse(context_.deadline() <= std::chrono::system_clock::now()
                      ? Refusal::deadline_exceeded
                      : Refusal::cancelled);
  }

  Backend& backend_;
  grpc::CallbackServerContext& context_;
  // Destroyed last: the server may end once no stream holds one.
  OpenStreams::Ticket ticket_;
  const std::shared_ptr<Peer> peer_;
  Peer::Place place_;
  StreamAccount account_;
  CallRecord record_;
  std::unique_ptr<Work> work_;
  std::shared_ptr<StreamReactor> self_;

  ArenaMessage<Response> response_;
  grpc::ByteBuffer answer_;
  grpc::ByteBuffer beat_;
  Input input_ = Input::none;
  Turn turn_;

  std::atomic<bool> cancelled_ = false;
  std::mutex mutex_;
  Phase phase_ = Phase::working;
  Clock::time_point phase_since_ = Clock::now();
  Clock::time_point written_at_ = Clock::now();
  std::uint64_t answers_written_ = 0;
  int reads_starting_ = 0;
  bool beating_ = false;
  std::optional<Refusal> given_up_;
  bool written_while_cancelling_ = false;
  bool arrived_while_cancelling_ = false;
};

}  // namespace trc::server
