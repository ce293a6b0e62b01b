#include "client/load/generator.h"

#include <grpcpp/channel.h>

#include <algorithm>
#include <utility>

#include "client/load/schedule.h"
#include "client/trc/failure.h"

namespace trc::load {
namespace {

// The longest time between two checks of the run's own state.
constexpr std::chrono::milliseconds longest_sleep{50};

bool takes_part(const Stream& stream) { return !stream.orders().slow && !stream.orders().cancel; }

}  // namespace

Generator::Generator(const Plan& plan, const Job& job, const ExpectedResult* expected, pid_t server,
                     const std::vector<std::shared_ptr<grpc::Channel>>& channels)
    : plan_(plan), job_(job), expected_(expected), server_(server) {
  for (const auto& channel : channels) stubs_.push_back(std::make_unique<GenericStub>(channel));
}

Outcome Generator::run(const std::atomic<bool>& stop) {
  UseMeter meter(server_);
  start_ = Clock::now();
  begin_ = start_ + plan_.ramp;
  end_ = begin_ + plan_.duration;
  pace(stop, meter);
  const Clock::time_point over = Clock::now();
  {
    const std::lock_guard lock(mutex_);
    end_ = std::min(end_, over);
    begin_ = std::min(begin_, end_);
  }
  meter.finish(outcome_);
  wind_up(outcome_.interrupted ? over : end_ + plan_.grace);
  outcome_.seconds = std::chrono::duration<double>(end_ - begin_).count();
  return std::move(outcome_);
}

// Streams of a closed loop have no schedule; only the first ones begin one after another, during
// the ramp.
Clock::time_point Generator::intended_begin(std::uint64_t stream) const {
  if (plan_.open_loop()) return start_ + Schedule(plan_.rate, plan_.ramp).begin_of(stream);
  if (stream >= plan_.streams) return Clock::time_point::max();
  return start_ + plan_.ramp * stream / plan_.streams;
}

void Generator::pace(const std::atomic<bool>& stop, UseMeter& meter) {
  std::uint64_t offered = 0;
  for (;;) {
    const Clock::time_point now = Clock::now();
    outcome_.interrupted = stop;
    if (stop || now >= end_ || all_ended()) return;
    if (now >= begin_) meter.look();
    Clock::time_point next = intended_begin(offered);
    for (; next <= now && (plan_.jobs == 0 || offered < plan_.jobs); ++offered) {
      offer(next);
      next = intended_begin(offered + 1);
    }
    if (plan_.jobs != 0 && offered >= plan_.jobs) next = Clock::time_point::max();
    next = std::min({next, now + longest_sleep, now < begin_ ? begin_ : end_});
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, next,
                        [&] { return plan_.jobs != 0 && begun_ >= plan_.jobs && open_.empty(); });
  }
}

bool Generator::all_ended() {
  std::vector<std::shared_ptr<Stream>> finished;  // destroyed after the lock is released
  const std::lock_guard lock(mutex_);
  finished.swap(finished_);
  return plan_.jobs != 0 && begun_ >= plan_.jobs && open_.empty() && waiting_.empty();
}

void Generator::wind_up(Clock::time_point deadline) {
  std::vector<std::shared_ptr<Stream>> left;
  {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, deadline, [this] { return open_.empty() && waiting_.empty(); });
    over_ = true;
    const Clock::time_point now = Clock::now();
    for (const Clock::time_point intended : waiting_) {
      if (!is_measured(intended)) continue;
      ++outcome_.tally.unfinished;
      outcome_.tally.stream.add(now - intended);
    }
    waiting_.clear();
    for (const auto& [key, stream] : open_) left.push_back(stream);
  }
  for (const auto& stream : left) stream->cancel();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return open_.empty(); });
}

bool Generator::may_begin() const {
  return !over_ && (plan_.jobs == 0 || begun_ < plan_.jobs) &&
         (plan_.open_loop() || Clock::now() < end_);
}

std::shared_ptr<Stream> Generator::make_stream(Clock::time_point intended) {
  const std::uint64_t number = begun_++;
  const Stream::Orders orders{.number = number,
                              .intended = intended,
                              .first_window = plan_.first_window,
                              .slow = is_sampled(number, plan_.slow),
                              .cancel = is_sampled(number, plan_.cancel),
                              .expected = is_sampled(number, plan_.verify) ? expected_ : nullptr};
  auto stream = std::make_shared<Stream>(job_, orders, static_cast<Stream::Listener&>(*this));
  open_.emplace(stream.get(), stream);
  outcome_.most_open = std::max<std::uint64_t>(outcome_.most_open, open_.size());
  return stream;
}

void Generator::begin(const std::shared_ptr<Stream>& stream) {
  stream->start(*stubs_[stream->orders().number % stubs_.size()]);
}

void Generator::offer(Clock::time_point intended) {
  std::shared_ptr<Stream> stream;
  {
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = Clock::now();
    if (open_.size() >= plan_.streams) {
      waiting_.push_back(intended);
      return;
    }
    if (!may_begin()) return;
    if (plan_.open_loop() && intended >= begin_)
      outcome_.generator_lag = std::max(outcome_.generator_lag, now - intended);
    stream = make_stream(intended);
  }
  begin(stream);
}

std::shared_ptr<Stream> Generator::successor() {
  if (!may_begin()) return nullptr;
  if (!plan_.open_loop()) return make_stream(Clock::now());
  if (waiting_.empty()) return nullptr;
  const Clock::time_point intended = waiting_.front();
  waiting_.pop_front();
  return make_stream(intended);
}

void Generator::sent(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  if (is_measured(Clock::now())) outcome_.tally.bytes_sent += bytes;
}

void Generator::received(std::size_t bytes, std::uint64_t blocks_out) {
  const std::lock_guard lock(mutex_);
  if (!is_measured(Clock::now())) return;
  outcome_.tally.bytes_received += bytes;
  outcome_.tally.blocks_out += blocks_out;
}

void Generator::answered(std::uint64_t blocks_in, Clock::duration latency) {
  const std::lock_guard lock(mutex_);
  if (!is_measured(Clock::now())) return;
  outcome_.tally.blocks_in += blocks_in;
  outcome_.tally.batch.add(latency);
}

void Generator::ended(Stream& stream, const grpc::Status& status) {
  std::shared_ptr<Stream> next;
  {
    const std::lock_guard lock(mutex_);
    count_ended(stream, status);
    count_check(stream);
    const auto ended = open_.find(&stream);
    finished_.push_back(std::move(ended->second));
    open_.erase(ended);
    next = successor();
    // Under the lock: if no stream follows, the waiting thread may then destroy this object.
    changed_.notify_all();
  }
  if (next) begin(next);
}

void Generator::count_ended(const Stream& stream, const grpc::Status& status) {
  Tally& tally = outcome_.tally;
  const Clock::time_point now = Clock::now();
  const bool counts = takes_part(stream) && is_measured(stream.orders().intended);
  if (!status.ok() && status.error_code() == grpc::StatusCode::CANCELLED) {
    if (stream.orders().cancel) {
      ++tally.cancelled;
      return;
    }
    if (over_) {
      ++tally.unfinished;
      if (counts && plan_.open_loop()) tally.stream.add(now - stream.orders().intended);
      return;
    }
  }
  if (!status.ok() || !stream.has_summary()) return count_error(stream, status);
  if (is_measured(now)) ++tally.completed;
  if (stream.orders().slow) ++tally.slow;
  if (!counts) return;
  tally.stream.add(now - stream.orders().intended);
  if (stream.first_output())
    tally.first_output.add(*stream.first_output() - stream.orders().intended);
}

void Generator::count_error(const Stream& stream, const grpc::Status& status) {
  Tally& tally = outcome_.tally;
  client::Failure failure = client::failure_of(status).value_or(client::missing_summary());
  if (stream.unreadable())
    failure = {.status = "UNREADABLE", .message = "a response is none of this service"};
  std::string name = failure.status;
  if (!failure.reason.empty()) name += " " + failure.reason;
  ++tally.errors[name];
  if (tally.first_error.empty()) tally.first_error = failure.message;
}

void Generator::count_check(const Stream& stream) {
  const ResultCheck* check = stream.check();
  if (check == nullptr) return;
  Tally& tally = outcome_.tally;
  ++tally.verified;
  if (!check->differs()) return;
  if (tally.differing++ > 0) return;
  tally.first_difference = "stream " + std::to_string(stream.orders().number) + ": what follows " +
                           std::to_string(check->right()) +
                           (job_.layout() == Layout::text ? " bytes" : " blocks") +
                           " is not what the core gives";
}

}  // namespace trc::load
