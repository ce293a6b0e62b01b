#include "server/work/open_streams.h"

#include <algorithm>
#include <utility>

#include "server/resources/round.h"

namespace trc::server {

OpenStreams::Ticket::Ticket(Ticket&& other) noexcept
    : streams_(std::exchange(other.streams_, nullptr)), place_(other.place_) {}

OpenStreams::Ticket& OpenStreams::Ticket::operator=(Ticket&& other) noexcept {
  if (this != &other) {
    release();
    streams_ = std::exchange(other.streams_, nullptr);
    place_ = other.place_;
  }
  return *this;
}

OpenStreams::Ticket::~Ticket() { release(); }

void OpenStreams::Ticket::release() {
  if (streams_ != nullptr) std::exchange(streams_, nullptr)->leave(place_);
}

OpenStreams::OpenStreams(std::size_t most, std::chrono::seconds idle_timeout,
                         std::chrono::seconds heartbeat)
    : most_(most),
      idle_timeout_(idle_timeout),
      heartbeat_(heartbeat),
      watcher_([this] { watch(); }) {}

OpenStreams::~OpenStreams() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  watcher_.join();
}

OpenStreams::Admission OpenStreams::admit(std::weak_ptr<OpenStream> stream) {
  const std::lock_guard lock(mutex_);
  if (draining_) return {.answer = Answer::draining};
  if (streams_.size() >= most_) return {.answer = Answer::full};
  streams_.push_back(std::move(stream));
  return {.answer = Answer::admitted, .ticket = Ticket(*this, std::prev(streams_.end()))};
}

std::vector<std::shared_ptr<OpenStream>> OpenStreams::held() const {
  std::vector<std::shared_ptr<OpenStream>> open;
  open.reserve(streams_.size());
  for (const auto& stream : streams_)
    if (auto alive = stream.lock()) open.push_back(std::move(alive));
  return open;
}

bool OpenStreams::evict_largest() {
  std::vector<std::shared_ptr<OpenStream>> open;
  {
    const std::lock_guard lock(mutex_);
    open = held();
  }
  const auto largest = std::max_element(open.begin(), open.end(), [](const auto& a, const auto& b) {
    return a->held_bytes() < b->held_bytes();
  });
  if (largest == open.end() || (*largest)->held_bytes() == 0) return false;
  {
    const std::lock_guard lock(mutex_);
    evicted_ = *largest;
  }
  (*largest)->evict();
  return true;
}

bool OpenStreams::is_evicting() const {
  std::shared_ptr<OpenStream> evicted;
  {
    const std::lock_guard lock(mutex_);
    evicted = evicted_.lock();
  }
  return evicted != nullptr && evicted->held_bytes() > 0;
}

void OpenStreams::drain() {
  const std::lock_guard lock(mutex_);
  draining_ = true;
}

bool OpenStreams::wait_until_none(Clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  return changed_.wait_until(lock, deadline, [this] { return streams_.empty(); });
}

void OpenStreams::cut_off(Clock::time_point deadline) {
  constexpr std::chrono::milliseconds between_rounds{10};
  do {
    do_round([this] { cut_off_each(); });
  } while (!wait_until_none(std::min(deadline, Clock::now() + between_rounds)) &&
           Clock::now() < deadline);
}

void OpenStreams::cut_off_each() {
  std::vector<std::shared_ptr<OpenStream>> open;
  {
    const std::lock_guard lock(mutex_);
    open = held();
  }
  for (const auto& stream : open) stream->cut_off();
}

bool OpenStreams::draining() const {
  const std::lock_guard lock(mutex_);
  return draining_;
}

std::size_t OpenStreams::count() const {
  const std::lock_guard lock(mutex_);
  return streams_.size();
}

void OpenStreams::leave(Ticket::Place place) {
  // Notified under the lock: the thread that waits for the last stream may then destroy this
  // object.
  const std::lock_guard lock(mutex_);
  streams_.erase(place);
  changed_.notify_all();
}

void OpenStreams::look() {
  std::vector<std::shared_ptr<OpenStream>> open;
  {
    const std::lock_guard lock(mutex_);
    open = held();
  }
  for (const auto& stream : open) {
    stream->end_if_idle(Clock::now() - idle_timeout_);
    if (beats()) stream->beat_if_silent(Clock::now() - heartbeat_);
  }
}

void OpenStreams::watch() {
  const Clock::duration shortest = beats() ? std::min(idle_timeout_, heartbeat_) : idle_timeout_;
  const Clock::duration interval = std::min<Clock::duration>(std::chrono::seconds(1), shortest / 4);
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, interval, [this] { return stopping_; })) {
    lock.unlock();
    do_round([this] { look(); });
    lock.lock();
  }
}

}  // namespace trc::server
