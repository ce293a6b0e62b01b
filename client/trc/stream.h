#pragma once

#include <grpcpp/client_context.h>
#include <grpcpp/support/client_callback.h>

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "client/trc/received.h"

namespace trc::client {

// One bidirectional stream, used by one thread at a time. Reactions only move
// messages; everything else happens in the caller's thread.
//
// Responses are taken while a request is on its way, so that a server which has
// to get rid of output before it reads on cannot lock up with its client. At
// most `most_waiting` responses are held; then flow control stops the server.
template <class Request, class Response>
class Stream : private grpc::ClientBidiReactor<Request, Response> {
 public:
  // False: no more is wanted.
  using Sink = std::function<bool(const Response&)>;
  static constexpr std::size_t most_waiting = 16;

  // `start` binds a reactor to the RPC.
  template <class Start>
  explicit Stream(Start start) {
    start(&context_, static_cast<grpc::ClientBidiReactor<Request, Response>*>(this));
    // Reads and writes start outside of reactions; the hold keeps the call open
    // for them and is given back by `close`.
    this->AddHold();
    this->StartRead(&incoming_->fresh());
    this->StartCall();
  }
  ~Stream() {
    if (closed_) return;
    context_.TryCancel();
    close([](const Response&) { return true; });
  }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  // Sends a request and hands out what arrives meanwhile. False: the server has
  // ended the stream, or the sink wants no more; then call `close`.
  bool send(const Request& request, const Sink& sink) {
    {
      const std::lock_guard lock(mutex_);
      if (reading_ended_) return false;
      writing_ = true;
    }
    this->StartWrite(&request);
    return take_until([this] { return !writing_; }, sink) && !write_failed_;
  }

  // Waits for one more response, if none is there.
  bool receive(const Sink& sink) {
    bool received = false;
    const auto noted = [&](const Response& response) {
      received = true;
      return sink(response);
    };
    return take_until([&received] { return received; }, noted) && received;
  }

  // No more requests; hands out what arrives until the server ends the stream.
  grpc::Status close(const Sink& sink) {
    if (closed_) return status_;
    closed_ = true;
    if (!write_failed_) this->StartWritesDone();
    if (!take_until([] { return false; }, sink) && !at_end()) context_.TryCancel();
    const Sink drop = [](const Response&) { return true; };
    take_until([] { return false; }, drop);
    this->RemoveHold();
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return done_; });
    return status_;
  }

  void cancel() { context_.TryCancel(); }

 private:
  // Of one response.
  using Place = std::unique_ptr<Received<Response>>;

  void OnReadDone(bool ok) override {
    bool go_on = false;
    {
      const std::lock_guard lock(mutex_);
      if (ok) {
        waiting_.push_back(std::move(incoming_));
        incoming_ = place();
        go_on = waiting_.size() < most_waiting;
        reading_paused_ = !go_on;
      } else {
        reading_ended_ = true;
      }
    }
    if (go_on) this->StartRead(&incoming_->fresh());
    changed_.notify_all();
  }

  void OnWriteDone(bool ok) override {
    const std::lock_guard lock(mutex_);
    writing_ = false;
    write_failed_ = !ok;
    changed_.notify_all();
  }

  void OnDone(const grpc::Status& status) override {
    // Notified under the lock: the waiting thread destroys the stream next.
    const std::lock_guard lock(mutex_);
    done_ = true;
    status_ = status;
    changed_.notify_all();
  }

  // For the next response.
  Place place() { return spare_ ? std::move(spare_) : std::make_unique<Received<Response>>(); }

  // Hands out responses until `reached`, which is asked under the lock, or until
  // the server has ended the stream. False when the sink wants no more or the
  // stream has ended first.
  template <class Reached>
  bool take_until(Reached reached, const Sink& sink) {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [&] { return reached() || !waiting_.empty() || reading_ended_; });
      if (!waiting_.empty()) {
        Place response = std::move(waiting_.front());
        waiting_.pop_front();
        const bool resume = std::exchange(reading_paused_, false);
        lock.unlock();
        if (resume) this->StartRead(&incoming_->fresh());
        if (!sink(**response)) {
          wait_for_write();
          return false;
        }
        lock.lock();
        spare_ = std::move(response);
        continue;
      }
      if (reached()) return true;
      // A write that is still on its way ends with the stream.
      changed_.wait(lock, [this] { return !writing_; });
      return false;
    }
  }

  void wait_for_write() {
    std::unique_lock lock(mutex_);
    if (!writing_) return;
    lock.unlock();
    context_.TryCancel();
    lock.lock();
    changed_.wait(lock, [this] { return !writing_; });
  }

  [[nodiscard]] bool at_end() {
    const std::lock_guard lock(mutex_);
    return reading_ended_ && waiting_.empty();
  }

  grpc::ClientContext context_;
  Place incoming_ = std::make_unique<Received<Response>>();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Place> waiting_;
  Place spare_;  // of a response that was handed out
  bool reading_paused_ = false;
  bool reading_ended_ = false;
  bool writing_ = false;
  bool write_failed_ = false;
  bool done_ = false;
  bool closed_ = false;
  grpc::Status status_;
};

}  // namespace trc::client
