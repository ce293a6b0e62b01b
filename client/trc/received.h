#pragma once

#include <google/protobuf/arena.h>

#include <cstddef>
#include <memory>

namespace trc::client {

// Messages received one after the other, their parts in memory that stays: an answer in blocks as
// messages has several thousand, which the heap would hand out and take back one by one.
template <class Message>
class Received {
 public:
  Received() = default;
  Received(const Received&) = delete;
  Received& operator=(const Received&) = delete;

  // The message, empty. What it was is gone.
  [[nodiscard]] Message& fresh() {
    arena_.Reset();
    message_ = google::protobuf::Arena::CreateMessage<Message>(&arena_);
    return *message_;
  }
  // What fresh() gave last.
  [[nodiscard]] const Message& operator*() const { return *message_; }

 private:
  // What 1024 blocks as messages take, and more. Costs nothing where it is not written to.
  static constexpr std::size_t memory_bytes = 1U << 20U;

  google::protobuf::ArenaOptions options() {
    google::protobuf::ArenaOptions options;
    options.initial_block = memory_.get();
    options.initial_block_size = memory_bytes;
    return options;
  }

  std::unique_ptr<char[]> memory_ = std::make_unique_for_overwrite<char[]>(memory_bytes);
  google::protobuf::Arena arena_{options()};
  Message* message_ = nullptr;
};

}  // namespace trc::client
