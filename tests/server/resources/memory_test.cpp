#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/pages.h"
#include "server/resources/heap_reserve.h"
#include "server/resources/memory_account.h"
#include "server/resources/memory_budget.h"
#include "server/resources/memory_watch.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::server {
namespace {

using Standing = MemoryBudget::Standing;
constexpr std::uint64_t mib = 1U << 20U;

// The optimiser may leave out memory that nobody looks at.
void keep(const std::vector<char>& bytes) {
  static const volatile char* seen = nullptr;
  seen = bytes.data();
  EXPECT_NE(seen, nullptr);
}

TEST(MemoryAccount, CountsWhatATurnTakesAndGivesBack) {
  if (!counts_heap) GTEST_SKIP() << "the heap is not counted under ThreadSanitizer";
  MemoryAccount account;
  std::vector<char> kept;
  {
    const MemoryAccount::Turn turn(account);
    kept.resize(3 * mib);
    const std::vector<char> gone(5 * mib);
    keep(gone);
    account.settle();
    EXPECT_GE(account.bytes(), 8 * mib);
  }
  EXPECT_GE(account.bytes(), 3 * mib);
  EXPECT_LT(account.bytes(), 4 * mib);
  // What happens beside the turns is somebody else's.
  const std::vector<char> of_others(mib);
  {
    const MemoryAccount::Turn turn(account);
    const PagePiece pages;
    account.settle();
    EXPECT_GE(account.bytes(), 3 * mib + PagePiece::bytes);
    std::vector<char>().swap(kept);
  }
  EXPECT_LT(account.bytes(), mib);
}

TEST(MemoryAccount, CountsInWhateverThreadTheTurnIs) {
  if (!counts_heap) GTEST_SKIP() << "the heap is not counted under ThreadSanitizer";
  MemoryAccount account;
  auto kept = std::make_unique<std::vector<char>>();
  std::thread([&] {
    const MemoryAccount::Turn turn(account);
    kept->resize(mib);
  }).join();
  EXPECT_GE(account.bytes(), mib);
  std::thread([&] {
    const MemoryAccount::Turn turn(account);
    kept.reset();
  }).join();
  EXPECT_EQ(account.bytes(), 0U);
}

TEST(MemoryBudget, TheOneThatGrowsBeyondItHasToGo) {
  MemoryBudget all(100 * mib);
  MemoryBudget peer(100 * mib);
  {
    MemoryBudget::Share one(all, peer);
    MemoryBudget::Share other(all, peer);
    EXPECT_EQ(one.hold(60 * mib), Standing::good);
    EXPECT_EQ(other.hold(41 * mib), Standing::all_full);
    // Who stays as it was, or shrinks, may stay.
    EXPECT_EQ(one.hold(60 * mib), Standing::good);
    EXPECT_EQ(one.hold(59 * mib), Standing::good);
    other.release();
    EXPECT_EQ(all.used_bytes(), 59 * mib);
    EXPECT_EQ(other.hold(101 * mib), Standing::alone);
  }
  EXPECT_EQ(all.used_bytes(), 0U);
  EXPECT_EQ(peer.used_bytes(), 0U);
}

TEST(MemoryBudget, SparesTheSmall) {
  MemoryBudget all(100 * mib);
  MemoryBudget peer(100 * mib);
  MemoryBudget::Share hog(all, peer);
  MemoryBudget::Share small(all, peer);
  hog.hold(100 * mib);
  EXPECT_EQ(small.hold(mib), Standing::good);
  EXPECT_EQ(small.hold(2 * mib), Standing::all_full);
}

TEST(MemoryBudget, APeerHasItsOwn) {
  MemoryBudget all(100 * mib);
  MemoryBudget greedy(50 * mib);
  MemoryBudget modest(50 * mib);
  MemoryBudget::Share first(all, greedy);
  MemoryBudget::Share second(all, greedy);
  MemoryBudget::Share third(all, modest);
  EXPECT_EQ(first.hold(30 * mib), Standing::good);
  EXPECT_EQ(second.hold(30 * mib), Standing::peer_full);
  EXPECT_EQ(second.hold(51 * mib), Standing::alone);
  second.release();
  EXPECT_EQ(third.hold(40 * mib), Standing::good);
}

class LimitFiles {
 public:
  void write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder_.path(name);
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  [[nodiscard]] std::uint64_t limit() const {
    return memory_limit_bytes(folder_.path("self"), folder_.path("sys"), folder_.path("machine"));
  }

 private:
  testing_support::Folder folder_;
};

TEST(MemoryLimit, IsTheMachineWithoutGroups) {
  const LimitFiles files;
  files.write("machine", "MemFree: 1 kB\nMemTotal:       2048 kB\nMemAvailable: 3 kB\n");
  EXPECT_EQ(files.limit(), 2048U << 10U);
  files.write("self", "0::/\n");
  files.write("sys/memory.max", "max\n");
  EXPECT_EQ(files.limit(), 2048U << 10U);
}

TEST(MemoryLimit, OfVersion2IsTheSmallestOnTheWayUp) {
  const LimitFiles files;
  files.write("machine", "MemTotal: 4096 kB\n");
  files.write("self", "0::/one/two\n");
  files.write("sys/one/two/memory.max", "max\n");
  files.write("sys/one/memory.max", "1048576\n");
  EXPECT_EQ(files.limit(), 1U << 20U);
  // In a container the path is the host's.
  files.write("self", "0::/somewhere/else\n");
  files.write("sys/memory.max", "524288\n");
  EXPECT_EQ(files.limit(), 512U << 10U);
}

TEST(MemoryLimit, OfVersion1HasItsOwnHierarchy) {
  const LimitFiles files;
  files.write("machine", "MemTotal: 4096 kB\n");
  files.write("self", "9:pids:/\n4:memory:/box\n0::/\n");
  files.write("sys/memory/memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_EQ(files.limit(), 4U << 20U);
  files.write("sys/memory/box/memory.limit_in_bytes", "2097152\n");
  EXPECT_EQ(files.limit(), 2U << 20U);
}

TEST(MemoryWatch, EndsTheLargestWhileItIsCritical) {
  std::atomic<std::uint64_t> resident = 10 * mib;
  std::atomic<int> ended = 0;
  const MemoryWatch watch({.limit_bytes = 1000 * mib,
                           .end_largest =
                               [&] {
                                 if (++ended == 3) resident = 900 * mib;
                               },
                           .counted_bytes = [] { return std::uint64_t{0}; },
                           .resident_bytes = [&] { return resident.load(); }});
  const auto is = [&](MemoryWatch::State state) {
    return eventually([&] { return watch.state() == state; });
  };
  EXPECT_TRUE(is(MemoryWatch::State::ample));
  resident = 870 * mib;
  EXPECT_TRUE(is(MemoryWatch::State::scarce));
  EXPECT_EQ(ended, 0);
  resident = 960 * mib;
  EXPECT_TRUE(eventually([&] { return ended == 3; }));
  EXPECT_TRUE(is(MemoryWatch::State::scarce));
  resident = 100 * mib;
  EXPECT_TRUE(is(MemoryWatch::State::ample));
  EXPECT_EQ(ended, 3);
}

// What one holds is not free at once: nobody else goes for it meanwhile.
TEST(MemoryWatch, EndsOneAfterTheOther) {
  std::atomic<int> ended = 0;
  std::atomic<int> asked_until_the_second = 0;
  int asked = 0;
  constexpr int rounds = 20;
  const MemoryWatch watch({.limit_bytes = 1000 * mib,
                           .end_largest =
                               [&] {
                                 if (ended == 1) asked_until_the_second = asked;
                                 ++ended;
                               },
                           .is_one_ending = [&] { return ended == 1 && ++asked < rounds; },
                           .counted_bytes = [] { return std::uint64_t{0}; },
                           .resident_bytes = [] { return 960 * mib; }});
  EXPECT_TRUE(eventually([&] { return ended >= 2; }));
  EXPECT_EQ(asked_until_the_second, rounds);
}

// Memory that is free, but still held, is given back before a stream has to end for it.
TEST(MemoryWatch, EndsNobodyForWhatIsOnlyNotGivenBack) {
  std::atomic<bool> is_full = false;
  std::atomic<int> rounds = 0;
  std::atomic<int> ended = 0;
  bool is_first = false;  // measure of a round
  const MemoryWatch watch(
      {.limit_bytes = 1000 * mib,
       .end_largest = [&] { ++ended; },
       .is_one_ending =
           [&] {
             is_first = is_full;
             if (is_full) ++rounds;
             return false;
           },
       .counted_bytes = [] { return std::uint64_t{0}; },
       .resident_bytes = [&] { return (std::exchange(is_first, false) ? 960 : 870) * mib; }});
  ASSERT_TRUE(eventually([&] { return watch.state() == MemoryWatch::State::scarce; }));
  is_full = true;
  ASSERT_TRUE(eventually([&] { return rounds > 5; }));
  EXPECT_EQ(ended, 0);
}

TEST(MemoryWatch, GoesOnWhereARoundFindsNoMemory) {
  std::atomic<int> rounds = 0;
  std::atomic<std::uint64_t> resident = 10 * mib;
  const MemoryWatch watch({.limit_bytes = 1000 * mib,
                           .end_largest = [] {},
                           .counted_bytes = [] { return std::uint64_t{0}; },
                           .resident_bytes =
                               [&] {
                                 if (++rounds < 4) throw std::bad_alloc();
                                 return resident.load();
                               }});
  resident = 870 * mib;
  EXPECT_TRUE(eventually([&] { return watch.state() == MemoryWatch::State::scarce; }));
}

// AddressSanitizer and ThreadSanitizer have an address space of their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
std::uint64_t address_space_bytes() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void expect(bool held, int what) {
  if (!held) std::_Exit(what);
}

using Taken = std::vector<std::unique_ptr<char[]>>;

bool fails(Taken& taken) {
  try {
    taken.emplace_back(new char[mib]);
    return false;
  } catch (const std::bad_alloc&) {
    return true;
  }
}

// Of a process of its own: the exit code says what did not hold.
Taken with_an_end_of_the_heap() {
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
  const rlim_t most = address_space_bytes() + 200 * mib;
  const rlimit limit{most, most};
  expect(setrlimit(RLIMIT_AS, &limit) == 0, 2);
  HeapReserve::install();
  Taken taken;
  taken.reserve(1000);
  return taken;
}

void use_up_in_a_turn(Taken& taken) {
  const HeapReserve::Turn turn;
  while (!fails(taken)) expect(taken.size() < 900, 3);
  // What is left is for the others.
  expect(fails(taken), 7);
}

[[noreturn]] void use_up_the_heap() {
  Taken taken = with_an_end_of_the_heap();
  for (int round = 0; round < 2; ++round) {
    use_up_in_a_turn(taken);
    // The turn has failed and left the reserve to the others.
    for (int i = 0; i < 8; ++i) expect(!fails(taken), 4);
    while (!fails(taken)) expect(taken.size() < 900, 5);
    HeapReserve::refill();
    expect(fails(taken), 6);
    taken.clear();
    HeapReserve::refill();
  }
  std::_Exit(0);
}

[[noreturn]] void leave_the_heap_to_the_heap() {
  Taken taken = with_an_end_of_the_heap();
  for (int round = 0; round < 2; ++round) {
    use_up_in_a_turn(taken);
    while (!fails(taken)) expect(taken.size() < 900, 5);
    // What lies at its end keeps the heap from giving back what is free before it.
    const std::unique_ptr<char[]> last = std::move(taken.back());
    taken.clear();
    expect(HeapReserve::refill(), 8);
    const HeapReserve::Turn turn;
    expect(!fails(taken), 9);
  }
  std::_Exit(0);
}

TEST(HeapReserve, IsLeftToTheOthersWhereATurnFindsTheHeapEmpty) {
  EXPECT_EXIT(use_up_the_heap(), testing::ExitedWithCode(0), "");
}

TEST(HeapReserve, IsTakenAgainOutOfWhatTheHeapDoesNotGiveBack) {
  EXPECT_EXIT(leave_the_heap_to_the_heap(), testing::ExitedWithCode(0), "");
}
#endif

TEST(MemoryWatch, KnowsTheProcess) {
  EXPECT_GT(memory_limit_bytes(), mib);
  const std::uint64_t before = resident_bytes();
  EXPECT_GT(before, mib);
  const std::vector<char> taken(64 * mib, 'x');
  keep(taken);
  EXPECT_GT(resident_bytes(), before + 32 * mib);
}

}  // namespace
}  // namespace trc::server
