#pragma once

#include <grpcpp/grpcpp.h>

#include <cstddef>

#include "server/rpc/arena_message.h"

namespace trc::server {

// A request of a stream: gRPC hands over its bytes. The message may take forty times as much
// memory, so it is read in a turn, which is limited and whose memory is counted.
template <class Message>
class IncomingRequest {
 public:
  // Where the bytes arrive.
  [[nodiscard]] grpc::ByteBuffer& bytes() { return bytes_; }
  // Whether the bytes are no more than `most`; else they are freed at once.
  bool keep_up_to(std::size_t most) {
    const std::size_t size = bytes_.Length();
    if (size <= most) return true;
    bytes_too_many_ = size;
    bytes_.Clear();
    return false;
  }
  // Size of the request that was too large; 0: none was.
  [[nodiscard]] std::size_t bytes_too_many() const { return bytes_too_many_; }

  // Reads the message, unless that is done. False when the bytes are no such message.
  bool read() {
    if (!is_read_) {
      using Bytes = grpc::SerializationTraits<Message>;
      is_unreadable_ = !Bytes::Deserialize(&bytes_, &*message_).ok();
      bytes_.Clear();
      is_read_ = true;
    }
    return !is_unreadable_;
  }
  // The message that was read; the next bytes belong to another one.
  [[nodiscard]] Message& take() {
    is_read_ = false;
    return *message_;
  }
  [[nodiscard]] const Message& message() { return *message_; }
  // Frees the message.
  void reset() { message_.reset(); }

 private:
  grpc::ByteBuffer bytes_;
  ArenaMessage<Message> message_;
  bool is_read_ = false;  // of the bytes
  bool is_unreadable_ = false;
  std::size_t bytes_too_many_ = 0;
};

}  // namespace trc::server
