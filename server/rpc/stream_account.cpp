#include "server/rpc/stream_account.h"

#include <ctime>
#include <string>

namespace trc::server {
namespace {

std::chrono::nanoseconds thread_time() {
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

// When the process is short of memory, streams that hold less are not worth refusing.
constexpr std::uint64_t little_bytes = 1U << 20U;

void refuse_over(std::chrono::nanoseconds taken, std::uint32_t most_s, const char* setting) {
  if (most_s == 0 || taken <= std::chrono::seconds(most_s)) return;
  const std::string limit = std::to_string(most_s);
  throw Refused{refuse(Refusal::cpu_limit, std::string("the setting ") + setting + " is " + limit,
                       {{"setting", setting}, {"limit_s", limit}})};
}

}  // namespace

StreamAccount::StreamAccount(Backend& backend, Peer& peer)
    : backend_(backend), share_(backend.memory, peer.memory) {}

StreamAccount::Turn::Turn(StreamAccount& account) : account_(account), memory_(account.memory_) {
  account_.mark_ = thread_time();
}

StreamAccount::Turn::~Turn() {
  account_.note_time();
  account_.memory_.settle();
  if (!account_.closed_) account_.share_.hold(account_.memory_.bytes() + account_.answer_bytes_);
}

void StreamAccount::note_time() {
  const std::chrono::nanoseconds now = thread_time();
  since_progress_ += now - mark_;
  in_all_ += now - mark_;
  mark_ = now;
}

// This clock follows the ticks of the kernel, a few milliseconds apart; reading it takes a few
// nanoseconds.
bool StreamAccount::is_due() {
  std::timespec now{};
  clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
  if (now.tv_nsec == tick_) return false;
  tick_ = now.tv_nsec;
  return true;
}

void StreamAccount::check() {
  if (const auto why = ends_with_.load()) throw Refused{refuse(*why)};
  check_memory();
  note_time();
  refuse_over(since_progress_, backend_.config.max_selection_cpu_s, "max-selection-cpu-s");
  refuse_over(in_all_, backend_.config.max_stream_cpu_s, "max-stream-cpu-s");
}

void StreamAccount::check_memory() {
  memory_.settle();
  const std::uint64_t before = share_.bytes();
  const std::uint64_t now = memory_.bytes() + answer_bytes_;
  const auto limit = [](std::uint64_t bytes) {
    return Values{{"limit_bytes", std::to_string(bytes)}};
  };
  switch (share_.hold(now)) {
    case MemoryBudget::Standing::good:
      break;
    case MemoryBudget::Standing::all_full:
      throw Refused{refuse(Refusal::memory_limit, {}, limit(backend_.memory.most_bytes()))};
    case MemoryBudget::Standing::peer_full:
      throw Refused{
          refuse(Refusal::memory_limit_of_peer, {}, limit(backend_.peers.most_bytes_each()))};
    case MemoryBudget::Standing::alone:
      throw Refused{
          refuse(Refusal::memory_limit_of_stream, {}, limit(backend_.peers.most_bytes_each()))};
  }
  if (now > before && now > little_bytes &&
      backend_.memory_watch.state() != MemoryWatch::State::ample)
    throw Refused{
        refuse(Refusal::memory_limit_of_process, {}, limit(backend_.memory_watch.limit_bytes()))};
}

void StreamAccount::close() {
  closed_ = true;
  share_.release();
}

}  // namespace trc::server
