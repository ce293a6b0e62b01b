#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "client/load/plan.h"
#include "client/load/stream.h"
#include "client/load/tally.h"
#include "client/load/use_meter.h"

namespace grpc {
class Channel;
}

namespace trc::load {

// Runs the streams of a plan against a server and counts.
//
//   closed loop  `streams` at a time, each followed by the next at once: what the server can do
//   open loop    streams begin when the schedule says so; those for which there is no place wait,
//                and their wait counts: what clients feel who do not know of each other
class Generator final : private Stream::Listener {
 public:
  // `expected`: the result streams are compared with. `server`: whose use is measured, 0: nobody's.
  Generator(const Plan& plan, const Job& job, const ExpectedResult* expected, pid_t server,
            const std::vector<std::shared_ptr<grpc::Channel>>& channels);

  // Returns when all streams have ended. `stop` ends the run early.
  [[nodiscard]] Outcome run(const std::atomic<bool>& stop);

 private:
  void sent(std::size_t bytes) override;
  void received(std::size_t bytes, std::uint64_t blocks_out) override;
  void answered(std::uint64_t blocks_in, Clock::duration latency) override;
  void ended(Stream& stream, const grpc::Status& status) override;

  // The following functions are called with the lock held.
  void count_ended(const Stream& stream, const grpc::Status& status);
  void count_error(const Stream& stream, const grpc::Status& status);
  void count_check(const Stream& stream);
  [[nodiscard]] bool may_begin() const;
  [[nodiscard]] std::shared_ptr<Stream> make_stream(Clock::time_point intended);
  // The stream to begin in place of one that has ended; none: no stream waits.
  [[nodiscard]] std::shared_ptr<Stream> successor();

  void begin(const std::shared_ptr<Stream>& stream);
  void offer(Clock::time_point intended);
  // Begins streams in their time until the run is over.
  void pace(const std::atomic<bool>& stop, UseMeter& meter);
  // Lets open streams end until then, and cancels what is left.
  void wind_up(Clock::time_point deadline);
  [[nodiscard]] Clock::time_point intended_begin(std::uint64_t stream) const;
  [[nodiscard]] bool all_ended();
  [[nodiscard]] bool is_measured(Clock::time_point at) const { return at >= begin_ && at < end_; }

  Plan plan_;
  const Job& job_;
  const ExpectedResult* expected_;
  pid_t server_;
  std::vector<std::unique_ptr<GenericStub>> stubs_;

  Clock::time_point start_{};
  Clock::time_point begin_{};  // measured from here …
  Clock::time_point end_{};    // … to here

  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<const Stream*, std::shared_ptr<Stream>> open_;
  std::vector<std::shared_ptr<Stream>> finished_;  // to be destroyed by our own thread
  std::deque<Clock::time_point> waiting_;          // intended begins, open loop
  std::uint64_t begun_ = 0;
  bool over_ = false;
  Outcome outcome_;
};

}  // namespace trc::load
