// Preloaded into a process: something in it takes as many MiB as the file named by BALLAST says,
// eight bytes that may change at any time, and that nobody in the process has counted.

#include <fcntl.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <thread>

namespace {

using Mib = std::atomic<std::int64_t>;

const Mib* mapped(const char* path) {
  const int file = open(path, O_RDONLY | O_CLOEXEC);
  void* memory =
      file < 0 ? MAP_FAILED : mmap(nullptr, sizeof(std::int64_t), PROT_READ, MAP_SHARED, file, 0);
  if (file >= 0) close(file);
  return memory == MAP_FAILED ? nullptr : static_cast<const Mib*>(memory);
}

// Not of the heap, and touched: it is resident.
void* taken(std::size_t bytes) {
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return nullptr;
  std::memset(memory, 1, bytes);
  return memory;
}

void hold(const Mib& wanted) {
  std::size_t bytes = 0;
  void* memory = nullptr;
  for (;;) {
    const auto now = static_cast<std::size_t>(wanted.load()) << 20U;
    if (now != bytes) {
      if (memory != nullptr) munmap(memory, bytes);
      memory = now > 0 ? taken(now) : nullptr;
      bytes = memory != nullptr ? now : 0;
    }
    constexpr timespec pause{.tv_sec = 0, .tv_nsec = 5'000'000};
    nanosleep(&pause, nullptr);
  }
}

[[gnu::constructor]] void start() {
  const char* path = std::getenv("BALLAST");
  const Mib* wanted = path == nullptr ? nullptr : mapped(path);
  if (wanted != nullptr) std::thread([wanted] { hold(*wanted); }).detach();
}

}  // namespace
