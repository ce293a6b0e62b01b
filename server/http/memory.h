#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace trc::server::http {

// The memory that bodies, answers held back and views may take together.
class Memory {
 public:
  explicit Memory(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  [[nodiscard]] std::size_t used_bytes() const { return used_; }
  [[nodiscard]] std::size_t most_bytes() const { return most_bytes_; }

 private:
  friend class Share;
  const std::size_t most_bytes_;
  std::atomic<std::size_t> used_{0};
};

// The share of it that each client may take.
class MemoryOfPeers {
 public:
  explicit MemoryOfPeers(std::size_t most_bytes_each) : most_bytes_(most_bytes_each) {}

  // That of the client of this name, as long as somebody holds it.
  [[nodiscard]] std::shared_ptr<Memory> of(const std::string& name) {
    const std::lock_guard lock(mutex_);
    std::erase_if(peers_, [](const auto& entry) { return entry.second.expired(); });
    std::weak_ptr<Memory>& known = peers_[name];
    auto memory = known.lock();
    if (memory == nullptr) known = memory = std::make_shared<Memory>(most_bytes_);
    return memory;
  }

 private:
  const std::size_t most_bytes_;
  std::mutex mutex_;
  std::map<std::string, std::weak_ptr<Memory>> peers_;
};

// Whether there is memory; if not, whether all of it or only the share of the client is taken.
enum class Room : std::uint8_t { some, none, none_of_own };

// A part of it, given back when it is destroyed.
class Share {
 public:
  explicit Share(Memory& memory) : memory_(&memory) {}
  Share(Share&& other) noexcept : memory_(other.memory_), bytes_(std::exchange(other.bytes_, 0)) {}
  Share& operator=(Share&& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~Share() { release(); }

  [[nodiscard]] std::size_t bytes() const { return bytes_; }

  // False, and nothing is taken, when there is not as much.
  [[nodiscard]] bool take(std::size_t bytes) {
    if (memory_->used_.fetch_add(bytes) + bytes > memory_->most_bytes_) {
      memory_->used_ -= bytes;
      return false;
    }
    bytes_ += bytes;
    return true;
  }
  // Takes or gives back, so that it is as large as this. False, and nothing changes, when there is
  // not as much.
  [[nodiscard]] bool hold(std::size_t bytes) {
    if (bytes > bytes_) return take(bytes - bytes_);
    memory_->used_ -= bytes_ - bytes;
    bytes_ = bytes;
    return true;
  }
  void release() { memory_->used_ -= std::exchange(bytes_, 0); }

 private:
  Memory* memory_;
  std::size_t bytes_ = 0;
};

}  // namespace trc::server::http
