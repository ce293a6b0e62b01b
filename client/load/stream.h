#pragma once

#include <grpcpp/alarm.h>
#include <grpcpp/client_context.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/support/client_callback.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "client/load/conversation.h"
#include "client/load/tally.h"

namespace trc::load {

using GenericStub = grpc::TemplatedGenericStub<grpc::ByteBuffer, grpc::ByteBuffer>;

// One stream of the run, from its setup to its status. Works in gRPC's own threads: what is to do
// between two messages is little, and a further thread would cost more than it.
class Stream final : private grpc::ClientBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer> {
 public:
  struct Orders {
    std::uint64_t number = 0;
    Clock::time_point intended{};  // start
    std::uint32_t first_window = 1;
    bool slow = false;                         // waits before each answer it reads
    bool cancel = false;                       // gives up half way
    const ExpectedResult* expected = nullptr;  // to compare with; none: not verified
  };
  // Hears of everything, in any thread.
  class Listener {
   public:
    virtual ~Listener() = default;
    virtual void sent(std::size_t bytes) = 0;
    virtual void received(std::size_t bytes, std::uint64_t blocks_out) = 0;
    virtual void answered(std::uint64_t blocks_in, Clock::duration latency) = 0;
    // The last call; the stream may be destroyed then, but not in it.
    virtual void ended(Stream& stream, const grpc::Status& status) = 0;
  };

  Stream(const Job& job, const Orders& orders, Listener& listener);

  void start(GenericStub& stub);
  // From any thread, also when it has ended.
  void cancel() { context_.TryCancel(); }

  [[nodiscard]] const Orders& orders() const { return orders_; }
  // Of a stream that has ended.
  [[nodiscard]] std::optional<Clock::time_point> first_output() const { return first_output_; }
  [[nodiscard]] bool has_summary() const { return has_summary_; }
  [[nodiscard]] bool unreadable() const { return unreadable_; }
  [[nodiscard]] const ResultCheck* check() const { return check_ ? &*check_ : nullptr; }

 private:
  struct InFlight {
    std::uint64_t end = 0;  // input position after it
    std::uint64_t blocks = 0;
    Clock::time_point sent{};
  };
  enum class Next { wait, batch, close, cancel };

  void OnWriteDone(bool ok) override;
  void OnReadDone(bool ok) override;
  void OnDone(const grpc::Status& status) override;

  // Writes what is next, unless a write is on its way or the window is full.
  void go_on_writing();
  Next next_step();
  void send_batch();
  void take(const Response& response);

  const Job& job_;
  Orders orders_;
  Listener& listener_;
  std::optional<ResultCheck> check_;
  std::unique_ptr<Conversation> conversation_;
  grpc::ClientContext context_;
  grpc::Alarm alarm_;
  grpc::ByteBuffer outgoing_;
  grpc::ByteBuffer incoming_;

  std::mutex mutex_;
  bool writing_ = true;
  bool write_ended_ = false;
  std::uint32_t window_;
  std::deque<InFlight> in_flight_;
  std::uint64_t batches_sent_ = 0;

  std::optional<Clock::time_point> first_output_;
  bool has_summary_ = false;
  bool unreadable_ = false;
};

}  // namespace trc::load
