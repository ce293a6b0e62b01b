#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace trc::server {

using Clock = std::chrono::steady_clock;

// A stream as the server sees it from outside.
class OpenStream {
 public:
  virtual ~OpenStream() = default;
  // Ends the stream when it has waited for its client since before `since`.
  virtual void end_if_idle(Clock::time_point since) = 0;
  // Sends a heartbeat when nothing was sent since then; while a path is measured, more often.
  virtual void beat_if_silent(Clock::time_point since) = 0;
  // Ends the stream at once, or where its turn passes by next: its memory is needed.
  virtual void evict() = 0;
  // Ends the stream and tells its client that draining is over: at once where it waits for input,
  // else where its turn passes by next. An answer on its way goes first, so this is to be called
  // again until the stream has ended.
  virtual void cut_off() = 0;
  [[nodiscard]] virtual std::uint64_t held_bytes() const = 0;
};

// The open streams: how many there may be, which of them are idle, and whether all have ended.
class OpenStreams {
 public:
  // The place of one stream; given back when it is destroyed. An empty ticket holds no place.
  class Ticket {
   public:
    Ticket() = default;
    Ticket(Ticket&& other) noexcept;
    Ticket& operator=(Ticket&& other) noexcept;
    ~Ticket();

   private:
    friend class OpenStreams;
    using Place = std::list<std::weak_ptr<OpenStream>>::iterator;
    Ticket(OpenStreams& streams, Place place) : streams_(&streams), place_(place) {}
    void release();

    OpenStreams* streams_ = nullptr;
    Place place_{};
  };

  enum class Answer { admitted, full, draining };
  struct Admission {
    Answer answer = Answer::full;
    Ticket ticket{};
  };

  // No heartbeats with an interval of 0.
  OpenStreams(std::size_t most, std::chrono::seconds idle_timeout,
              std::chrono::seconds heartbeat = {});
  // Every ticket must have been given back.
  ~OpenStreams();
  OpenStreams(const OpenStreams&) = delete;
  OpenStreams& operator=(const OpenStreams&) = delete;

  Admission admit(std::weak_ptr<OpenStream> stream);

  // Evicts the stream that holds most. False when none holds anything.
  bool evict_largest();
  // Whether the one that was evicted last still holds something.
  [[nodiscard]] bool is_evicting() const;

  // From now on no stream is admitted.
  void drain();
  // True once no stream is open; false when that has not come by the deadline.
  bool wait_until_none(Clock::time_point deadline);
  // Cuts off what is still open and waits for its end, at most until the deadline.
  void cut_off(Clock::time_point deadline);

  [[nodiscard]] bool draining() const;
  [[nodiscard]] std::size_t count() const;

 private:
  void leave(Ticket::Place place);
  // A stream may end while it is looked at, so each is held; not to be freed under the lock: its
  // end gives a ticket back.
  [[nodiscard]] std::vector<std::shared_ptr<OpenStream>> held() const;
  [[nodiscard]] bool beats() const { return heartbeat_ > heartbeat_.zero(); }
  void look();
  void cut_off_each();
  void watch();

  const std::size_t most_;
  const std::chrono::seconds idle_timeout_;
  const std::chrono::seconds heartbeat_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::list<std::weak_ptr<OpenStream>> streams_;
  std::weak_ptr<OpenStream> evicted_;
  bool draining_ = false;
  bool stopping_ = false;
  std::thread watcher_;
};

}  // namespace trc::server
