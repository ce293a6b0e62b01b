#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "trc/v1/trc_service.pb.h"

namespace trc::client {

// How much goes into one request. Before the server has said what it takes, in its answer to the
// setup, that is what every server takes: `max-message-bytes` is at least 4096.
class MessageSize {
 public:
  void take(const v1::StreamAccepted& accepted) {
    most_bytes_ = std::max<std::uint64_t>(accepted.max_message_bytes(), every_server_takes);
  }

  // Bytes of text: enough to cost nothing, with room for the fields around them.
  [[nodiscard]] std::size_t text_bytes() const {
    return static_cast<std::size_t>(std::min<std::uint64_t>(most_bytes_, 64U * 1024U)) - 64;
  }

  // Blocks: at most 1024, which every server takes in a batch (D-58); more would only add delay. A
  // plain block takes 45 bytes; 128 leave room for one with many axes.
  [[nodiscard]] std::size_t blocks() const {
    return static_cast<std::size_t>(std::clamp<std::uint64_t>(most_bytes_ / 128, 1, 1024));
  }

 private:
  static constexpr std::uint64_t every_server_takes = 4096;

  std::uint64_t most_bytes_ = every_server_takes;
};

}  // namespace trc::client
