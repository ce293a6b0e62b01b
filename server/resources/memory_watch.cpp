#include "server/resources/memory_watch.h"

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>

#include "core/base/pages.h"
#include "server/resources/heap_reserve.h"
#include "server/resources/round.h"

namespace trc::server {
namespace {

constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();

// Streams can fill a gigabyte in one or two seconds.
constexpr std::chrono::milliseconds round{20};
// Giving memory back holds up threads that allocate meanwhile.
constexpr unsigned rounds_between = 50;
constexpr std::uint64_t worth_giving_back = 32U << 20U;
// The smaller amount that counts when a stream would have to end otherwise.
constexpr std::uint64_t worth_giving_back_at_once = 1U << 20U;
// Memory that could not be given back earlier may be free by now: the memory of gRPC is not
// counted, and gRPC does not report when it frees some.
constexpr unsigned rounds_until_forgotten = 1500;
// A stream that was asked to end does so at its next check.
constexpr unsigned most_rounds_of_one_ending = 50;

// "max" means no limit; version 1 writes a number larger than any machine.
std::uint64_t number_in(const std::string& path) {
  std::uint64_t number = 0;
  return std::ifstream(path) >> number ? number : none;
}

// The limit of the group and of all groups above it. In a container the file names the path that
// the host sees, which does not exist here; the top of the hierarchy is the container's group then.
std::uint64_t smallest_limit(const std::string& hierarchy, std::string group, const char* file) {
  std::uint64_t smallest = number_in(hierarchy + "/" + file);
  while (!group.empty() && group != "/") {
    smallest = std::min(smallest, number_in(hierarchy + group + "/" + file));
    group.erase(group.rfind('/'));
  }
  return smallest;
}

std::uint64_t machine_bytes(const std::string& machine_file) {
  std::ifstream file(machine_file);
  std::string name;
  std::uint64_t kib = 0;
  while (file >> name >> kib) {
    if (name == "MemTotal:") return kib << 10U;
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return none;
}

}  // namespace

std::uint64_t memory_limit_bytes(const std::string& groups_file, const std::string& hierarchy,
                                 const std::string& machine_file) {
  std::uint64_t smallest = machine_bytes(machine_file);
  std::ifstream groups(groups_file);
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string group = line.substr(second + 1);
    if (controllers.empty())
      smallest = std::min(smallest, smallest_limit(hierarchy, group, "memory.max"));
    if (controllers == "memory")
      smallest =
          std::min(smallest, smallest_limit(hierarchy + "/memory", group, "memory.limit_in_bytes"));
  }
  return smallest;
}

std::uint64_t memory_limit_bytes() {
  return memory_limit_bytes("/proc/self/cgroup", "/sys/fs/cgroup", "/proc/meminfo");
}

std::uint64_t resident_bytes() {
  // Without the heap: this runs most often when no memory is left.
  std::array<char, 128> text{};
  const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  const ssize_t length = read(file, text.data(), text.size() - 1);
  close(file);
  if (length <= 0) return 0;
  char* rest = text.data();
  std::strtoull(rest, &rest, 10);  // skips the address space
  const std::uint64_t resident = std::strtoull(rest, &rest, 10);
  const std::uint64_t of_files = std::strtoull(rest, &rest, 10);
  return (resident - std::min(resident, of_files)) *
         static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

MemoryWatch::MemoryWatch(Settings settings)
    : settings_(std::move(settings)), thread_([this] { run(); }) {}

MemoryWatch::~MemoryWatch() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void MemoryWatch::run() {
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, round, [this] { return stopping_; })) {
    lock.unlock();
    has_room_ = HeapReserve::refill();
    do_round([this] {
      // Other threads wait for this thread, so it must not wait for memory.
      const HeapReserve::Turn turn;
      look();
    });
    lock.lock();
  }
}

void MemoryWatch::look() {
  // Asked before measuring: otherwise the measurement could include a stream that has just ended.
  const bool is_one_ending =
      settings_.is_one_ending() && ++rounds_of_one_ending_ < most_rounds_of_one_ending;
  if (!is_one_ending) rounds_of_one_ending_ = 0;
  std::uint64_t resident = settings_.resident_bytes();
  const auto passes = [&](std::uint64_t percent) {
    return settings_.limit_bytes > 0 && resident > settings_.limit_bytes / 100 * percent;
  };
  constexpr std::uint64_t scarce = 85;
  constexpr std::uint64_t critical = 95;
  if (passes(critical) || (passes(scarce) && state_ == State::ample)) {
    // Perhaps freed memory has only not been given back yet.
    rounds_until_give_back_ = 0;
    give_back(resident, worth_giving_back_at_once);
    resident = settings_.resident_bytes();
  }
  // The address space has a limit of its own (RLIMIT_AS).
  if (passes(critical) || !has_room_) {
    state_ = State::critical;
    if (!is_one_ending) settings_.end_largest();
  } else {
    state_ = passes(scarce) ? State::scarce : State::ample;
  }
  // No new stream starts while memory is scarce, so giving back is tried again.
  if (passes(scarce)) left_ = 0;
  give_back(resident, worth_giving_back);
}

void MemoryWatch::give_back(std::uint64_t resident, std::uint64_t worth) {
  if (gives_back_soon_.exchange(false)) {
    rounds_until_give_back_ = 0;
    // Memory that could not be given back before is free now.
    left_ = 0;
  }
  if (++rounds_since_trimmed_ >= rounds_until_forgotten) left_ = 0;
  if (rounds_until_give_back_ > 0) {
    --rounds_until_give_back_;
    return;
  }
  const std::uint64_t in_use = left_ + settings_.counted_bytes();
  left_ = std::min(left_, resident);
  if (resident < in_use + worth) return;
  rounds_until_give_back_ = rounds_between;
  rounds_since_trimmed_ = 0;
  PagePiece::give_back_spare();
  malloc_trim(0);
  const std::uint64_t now = settings_.resident_bytes();
  left_ = now - std::min(now, settings_.counted_bytes());
}

}  // namespace trc::server
