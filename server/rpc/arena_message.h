#pragma once

#include <google/protobuf/arena.h>
#include <google/protobuf/message.h>
#include <google/protobuf/unknown_field_set.h>

#include <cstddef>

namespace trc::server {

// Fields of the message whose bytes are there already: Protobuf, which takes them for fields it
// does not know, sends them as they are, after the others.
inline google::protobuf::UnknownFieldSet& ready_bytes_of(google::protobuf::Message& message) {
  return *message.GetReflection()->MutableUnknownFields(&message);
}

// A message of a stream that is filled again and again. Its parts lie in one piece of memory: a
// batch of blocks as messages has several thousand of them, which the heap would hand out and take
// back one by one.
template <class Message>
class ArenaMessage {
 public:
  [[nodiscard]] Message& operator*() { return *message_; }
  [[nodiscard]] Message* operator->() { return message_; }

  // Empties the message and gives back its memory.
  void reset() {
    arena_.Reset();
    message_ = google::protobuf::Arena::CreateMessage<Message>(&arena_);
  }
  // reset() once the message has grown; until then what it has held may be used again.
  void reset_if_large() {
    // Ready bytes lie elsewhere.
    if (arena_.SpaceUsed() > large || !ready_bytes_of(*message_).empty()) reset();
  }

 private:
  static constexpr std::size_t large = 64U << 10U;

  static google::protobuf::ArenaOptions options() {
    google::protobuf::ArenaOptions options;
    options.start_block_size = 2U << 10U;
    options.max_block_size = 64U << 10U;
    return options;
  }

  google::protobuf::Arena arena_{options()};
  Message* message_ = google::protobuf::Arena::CreateMessage<Message>(&arena_);
};

}  // namespace trc::server
