#include "client/load/stream.h"

#include <algorithm>
#include <chrono>

namespace trc::load {
namespace {

constexpr std::chrono::milliseconds pause_of_slow_reader{50};

}  // namespace

Stream::Stream(const Job& job, const Orders& orders, Listener& listener)
    : job_(job), orders_(orders), listener_(listener), window_(orders.first_window) {
  if (orders.expected != nullptr) check_.emplace(*orders.expected);
  conversation_ = converse(job, check_ ? &*check_ : nullptr);
}

void Stream::start(GenericStub& stub) {
  stub.PrepareBidiStreamingCall(&context_, method_of(job_.layout()), {}, this);
  outgoing_ = conversation_->setup();
  listener_.sent(outgoing_.Length());
  // A slow reader has no pending operation while it waits. The hold is released when the server has
  // ended the stream.
  AddHold();
  StartWrite(&outgoing_);
  StartRead(&incoming_);
  StartCall();
}

void Stream::OnWriteDone(bool ok) {
  {
    const std::lock_guard lock(mutex_);
    writing_ = false;
    write_ended_ = write_ended_ || !ok;
  }
  go_on_writing();
}

Stream::Next Stream::next_step() {
  const std::lock_guard lock(mutex_);
  if (writing_ || write_ended_) return Next::wait;
  const bool at_end = conversation_->at_end();
  if (orders_.cancel && (at_end || 2 * batches_sent_ >= job_.batches())) {
    write_ended_ = true;
    return Next::cancel;
  }
  if (at_end) {
    write_ended_ = true;
    return Next::close;
  }
  if (in_flight_.size() >= window_) return Next::wait;
  writing_ = true;
  return Next::batch;
}

void Stream::go_on_writing() {
  switch (next_step()) {
    case Next::wait:
      return;
    case Next::cancel:
      return context_.TryCancel();
    case Next::close:
      return StartWritesDone();
    case Next::batch:
      return send_batch();
  }
}

void Stream::send_batch() {
  const std::uint64_t blocks =
      std::min<std::uint64_t>(job_.batch(), job_.items() - batches_sent_ * job_.batch());
  outgoing_ = conversation_->next();
  listener_.sent(outgoing_.Length());
  {
    const std::lock_guard lock(mutex_);
    ++batches_sent_;
    in_flight_.push_back({conversation_->position(), blocks, Clock::now()});
  }
  StartWrite(&outgoing_);
}

void Stream::OnReadDone(bool ok) {
  if (!ok) {
    {
      const std::lock_guard lock(mutex_);
      write_ended_ = true;
    }
    RemoveHold();
    return;
  }
  const std::size_t bytes = incoming_.Length();
  const Response response = conversation_->read(incoming_);
  listener_.received(bytes, response.blocks_out);
  take(response);
  if (unreadable_) context_.TryCancel();
  if (orders_.slow)
    alarm_.Set(std::chrono::system_clock::now() + pause_of_slow_reader,
               [this](bool /*expired*/) { StartRead(&incoming_); });
  else
    StartRead(&incoming_);
  go_on_writing();
}

void Stream::take(const Response& response) {
  const Clock::time_point now = Clock::now();
  unreadable_ = unreadable_ || !response.readable;
  has_summary_ = has_summary_ || response.summary;
  if (response.output && !first_output_) first_output_ = now;
  std::deque<InFlight> answered;
  {
    const std::lock_guard lock(mutex_);
    if (response.window > 0) window_ = response.window;
    while (!in_flight_.empty() && in_flight_.front().end <= response.consumed) {
      answered.push_back(in_flight_.front());
      in_flight_.pop_front();
    }
  }
  for (const InFlight& batch : answered) listener_.answered(batch.blocks, now - batch.sent);
}

void Stream::OnDone(const grpc::Status& status) {
  if (check_ && status.ok()) check_->finish();
  listener_.ended(*this, status);
}

}  // namespace trc::load
