#pragma once

#include <grpcpp/grpcpp.h>
#include <grpcpp/support/proto_buffer_reader.h>

#include <cstddef>
#include <optional>

#include "proto/wire/unknown_fields.h"
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
      unknown_ = unknown_of_maps();
      is_unreadable_ = !Bytes::Deserialize(&bytes_, &*message_).ok();
      bytes_.Clear();
      is_read_ = true;
    }
    return !is_unreadable_;
  }
  // A field in the entries of its maps that nobody knows: once read, the message has it no more.
  [[nodiscard]] const std::optional<wire::UnknownField>& unknown() const { return unknown_; }
  // The message that was read; the next bytes belong to another one.
  [[nodiscard]] Message& take() {
    is_read_ = false;
    return *message_;
  }
  [[nodiscard]] const Message& message() { return *message_; }
  // Frees the message.
  void reset() { message_.reset(); }

 private:
  std::optional<wire::UnknownField> unknown_of_maps() {
    static const bool has_maps = wire::holds_maps(*Message::descriptor());
    if (!has_maps) return std::nullopt;
    grpc::ProtoBufferReader reader(&bytes_);
    return wire::unknown_field_of_maps(reader, *Message::descriptor());
  }

  grpc::ByteBuffer bytes_;
  ArenaMessage<Message> message_;
  bool is_read_ = false;  // of the bytes
  bool is_unreadable_ = false;
  std::optional<wire::UnknownField> unknown_{};
  std::size_t bytes_too_many_ = 0;
};

}  // namespace trc::server
