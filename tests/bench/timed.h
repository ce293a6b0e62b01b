#pragma once

#include <benchmark/benchmark.h>
#include <valgrind/callgrind.h>

#include <cstdlib>
#include <ctime>

namespace trc::bench {

// CPU time of the calling thread, seconds: what other programs on the machine take is not in it.
inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// CPU time an item where one round works on so many.
inline benchmark::Counter per_item(std::size_t items) {
  return {static_cast<double>(items),
          benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

// Runs `prepare`, then `timed`, again and again; only the latter counts. One round works on
// `items`; the result is the counter `each`.
template <class Prepare, class Timed>
void run_timed(benchmark::State& state, std::size_t items, Prepare prepare, Timed timed) {
  for (auto _ : state) {
    prepare();
    const double begin = cpu_seconds();
    CALLGRIND_TOGGLE_COLLECT;
    timed();
    CALLGRIND_TOGGLE_COLLECT;
    state.SetIterationTime(cpu_seconds() - begin);
  }
  state.counters["each"] = per_item(items);
}

// Registers a benchmark under a name with blanks in it. With TRC_BENCH_ROUNDS in the environment it
// runs that many rounds, for counting instructions; else for as long as it takes to be sure.
template <class Function>
bool add(const char* name, Function function) {
  auto* benchmark = benchmark::RegisterBenchmark(name, function);
  benchmark->UseManualTime()->Unit(benchmark::kMicrosecond);
  if (const char* rounds = std::getenv("TRC_BENCH_ROUNDS"))
    benchmark->Iterations(std::strtol(rounds, nullptr, 10));
  return true;
}

}  // namespace trc::bench
