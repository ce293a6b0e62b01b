#include "server/resources/thread_reserve.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <new>
#include <vector>

namespace trc::server {
namespace {

// A waiting thread, and the work it will be given.
struct Spare {
  pthread_t thread{};
  void* (*run)(void*) = nullptr;
  void* argument = nullptr;
  Spare* next = nullptr;
};

struct Reserve {
  std::mutex mutex;
  std::condition_variable given;
  Spare* first = nullptr;
  std::size_t count = 0;
  std::size_t wanted = 0;
  ThreadReserve::Create create = nullptr;
};

// Never destroyed, because its threads outlive main.
Reserve& reserve() {
  static auto* const only = new Reserve;
  return *only;
}

std::atomic<bool> somebody_went_without = false;
thread_local int dispensable = 0;

void* wait_until_given(void* argument) {
  auto* const spare = static_cast<Spare*>(argument);
  {
    std::unique_lock lock(reserve().mutex);
    reserve().given.wait(lock, [spare] { return spare->run != nullptr; });
  }
  const Spare work = *spare;
  delete spare;
  return work.run(work.argument);
}

long cores() { return std::max(1L, sysconf(_SC_NPROCESSORS_CONF)); }

// Gives the work to a thread of the reserve, which must not be empty.
pthread_t give_first(void* (*run)(void*), void* argument) {
  Reserve& all = reserve();
  Spare* const spare = all.first;
  all.first = spare->next;
  --all.count;
  const pthread_t thread = spare->thread;
  spare->argument = argument;
  spare->run = run;
  all.given.notify_all();
  return thread;
}

}  // namespace

std::size_t ThreadReserve::usual() {
  // gRPC's executor grows to two threads per core when threads hand over much work, which more
  // cores do not make more likely. Timers and events need a few more.
  constexpr long most_of_executor = 28;
  return static_cast<std::size_t>(std::min(2 * cores(), most_of_executor) + 4);
}

std::size_t ThreadReserve::at_start() {
  // Workers, gRPC's pollers and events need one per core at most; log, ports, watches and timers
  // need the rest.
  return static_cast<std::size_t>(3 * cores() + 16);
}

bool ThreadReserve::install(std::size_t threads, Create create) {
  std::vector<pthread_t> ending;
  {
    Reserve& all = reserve();
    const std::lock_guard lock(all.mutex);
    all.wanted = threads;
    all.create = create;
    while (all.count > all.wanted)
      ending.push_back(give_first([](void* nothing) { return nothing; }, nullptr));
  }
  for (const pthread_t thread : ending) pthread_join(thread, nullptr);
  return refill();
}

bool ThreadReserve::refill() noexcept {
  Reserve& all = reserve();
  const std::lock_guard lock(all.mutex);
  while (all.count < all.wanted) {
    auto* const spare = new (std::nothrow) Spare;
    if (spare == nullptr) return false;
    const Dispensable this_one;
    if (all.create(&spare->thread, nullptr, wait_until_given, spare) != 0) {
      delete spare;
      return false;
    }
    spare->next = all.first;
    all.first = spare;
    ++all.count;
  }
  return true;
}

bool ThreadReserve::give(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
                         void* argument) noexcept {
  if (dispensable > 0) return false;
  Reserve& all = reserve();
  const std::lock_guard lock(all.mutex);
  if (all.count == 0) {
    // Before the first reserve is complete, the caller gets the error and the start fails.
    if (all.wanted > 0) somebody_went_without = true;
    return false;
  }
  *thread = give_first(run, argument);
  int detached = PTHREAD_CREATE_JOINABLE;
  if (attributes != nullptr) pthread_attr_getdetachstate(attributes, &detached);
  if (detached == PTHREAD_CREATE_DETACHED) pthread_detach(*thread);
  return true;
}

bool ThreadReserve::failed() noexcept { return somebody_went_without; }

ThreadReserve::Dispensable::Dispensable() { ++dispensable; }
ThreadReserve::Dispensable::~Dispensable() { --dispensable; }

}  // namespace trc::server
